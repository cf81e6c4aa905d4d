//! The night sky as it would really look: where everything stands, and how bright it is.

pub mod frame;
pub mod image;
pub mod units;

pub mod camera;
pub mod catalog;
pub mod place;
pub mod time;

pub mod ephemeris;

pub mod sky;

pub mod air;
pub mod eye;

pub mod light;

pub mod scene;

pub mod plan;
#[cfg(feature = "gpu")]
pub mod render;

pub mod export;
#[cfg(feature = "cli")]
pub mod overlay;

#[cfg(feature = "cli")]
pub mod cli;

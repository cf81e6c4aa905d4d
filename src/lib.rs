//! The night sky as it would really look: where everything stands, and how bright it is.

pub mod camera;
pub mod catalog;
pub mod export;
pub mod eye;
pub mod frame;
pub mod image;
#[cfg(feature = "cli")]
pub mod overlay;
pub mod place;
pub mod plan;
#[cfg(feature = "gpu")]
pub mod render;
pub mod time;
pub mod units;

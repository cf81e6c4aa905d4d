//! The night sky as it would really look: where everything stands, and how bright it is.

pub mod catalog;
pub mod ephemeris;
pub mod frame;
pub mod place;
pub mod sky;
pub mod time;
pub mod units;

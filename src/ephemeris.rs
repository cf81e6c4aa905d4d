//! Where bodies and stars are, by theories of motion of known error.

pub mod apparent;
mod body;
mod bounds;
mod moon;
pub mod moon_orientation;
pub mod orientation;
mod paper;
mod planets;
mod polynomial;
pub mod stars;
mod tier;

pub use body::{Body, UnknownBody};
pub use tier::{EarthState, EphemerisError, Tier, Tolerance, choose, earth, geometric};

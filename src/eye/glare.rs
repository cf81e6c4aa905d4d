//! Glare: light that the eye scatters on its way to the retina, so that a bright star looks larger
//! than a faint one and the Moon wears a veil.
//!
//! [`cie`] and [`spencer`] hold the published functions, [`spread`] what an eye of an age, a pigment
//! and a pupil does after them. For extended light [`pyramid`] shares every pixel's light among ever
//! wider surroundings. A star is no pixel: [`point`] parts its light into a core, a near halo and
//! what goes into the pyramid, and [`flare`] draws the needles and the ring of wide pupils.
//!
//! No light is made and none is lost: all shares of a light sum to 1.

pub mod cie;
pub mod flare;
pub mod point;
pub mod pyramid;
pub mod spencer;
pub mod spread;

pub use self::flare::Flare;
pub use self::point::Halo;
pub use self::pyramid::{scattered_by, scattered_with, shares};
pub use self::spread::{Glare, Spread};

/// What of an observer decides how much the eyes scatter.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Optics {
    /// Years, 0 to 100.
    pub age_years: f64,
    /// Colour of the iris: 0 very dark, 0.5 brown, 1 blue-green, 1.2 very light blue.
    pub pigment: f64,
}

impl Default for Optics {
    fn default() -> Self {
        Optics { age_years: 30.0, pigment: 0.5 }
    }
}

//! Refraction: how much higher things seem to stand than they do.
//!
//! Two forms, cheapest first, each a pair of exact inverses, true altitude from apparent and back:
//!
//! - [`Bennett`]: a formula of pressure and temperature, for sea level, in yellow light.
//! - [`Traced`]: rays followed through air of a pressure, temperature, humidity, wavelength and height
//!   of the observer, down to the horizon that lies below him.
//!
//! # Accuracy
//!
//! Largest differences from the traced form over eight airs, -20 to 30 degrees Celsius, sea level to
//! 4205 m, dry to moist, 400 to 700 nm, by apparent altitude (`tests/refraction.rs` prints them):
//!
//! | | 0° | 1° | 2° | 5° | 15° | 45° |
//! |---|---|---|---|---|---|---|
//! | rays after Hohenkerk & Sinclair 1985 (PAL `refro`) | 2.4" | 0.9" | 0.45" | 0.19" | 0.07" | 0.02" |
//! | `A tan z + B tan^3 z` of ERFA (`refco`), as Astropy uses it | | | | | 0.07" | 0.02" |
//! | [`Bennett`], in the same airs | 155" | 72" | 40" | 11" | 6.6" | 2.2" |
//!
//! The Refraction Tables of Pulkovo Observatory, in their own air, are 1" off at the horizon, in 1976",
//! and 0.006" at 30 degrees and above. Bennett's formula is 0.07' off the tables of its time in yellow
//! light at sea level; it knows neither colour nor height. True and apparent altitude invert each other
//! to 1e-9 degree in both forms.
//!
//! The horizon of real air wanders by several arcminutes from day to day. Above 15 degrees refraction
//! is as good as pressure and temperature are: 0.7" in a kelvin at 15 degrees, 0.2" at 45.

mod bennett;
mod profile;
mod refractivity;
mod traced;

use std::sync::Arc;

use crate::air::AirError;
use crate::frame::{Apparent, Dir, Horizon};
use crate::units::Angle;

pub use bennett::Bennett;
pub use profile::ObserverAir;
pub(super) use profile::Profile;
pub use traced::{Rays, Traced};

/// The refraction of one air. The default has none.
#[derive(Debug, Clone, PartialEq)]
pub enum Refraction {
    Bennett(Bennett),
    Traced(Arc<Traced>),
}

impl Default for Refraction {
    fn default() -> Self {
        Refraction::NONE
    }
}

impl Refraction {
    /// Things are seen where they stand.
    pub const NONE: Refraction = Refraction::Bennett(Bennett::NONE);

    /// By formula, for the pressure and the temperature at the observer: 0 to 1100 mbar, -90 to 60
    /// degrees Celsius; what lies outside is brought to the nearer end.
    pub fn new(pressure_mbar: f64, temperature_c: f64) -> Self {
        Refraction::Bennett(Bennett::new(pressure_mbar, temperature_c))
    }

    /// By rays followed through the air; some milliseconds to make, then as quick as the formula.
    /// Clones share the tables.
    ///
    /// # Errors
    ///
    /// See [`Rays::over_ground`].
    pub fn traced(air: &ObserverAir) -> Result<Self, AirError> {
        Refraction::traced_over_ground(air, 0.0)
    }

    /// The same over ground of a height above sea level, metres: see [`Traced::over_ground`].
    ///
    /// # Errors
    ///
    /// See [`Rays::over_ground`].
    pub fn traced_over_ground(air: &ObserverAir, ground_m: f64) -> Result<Self, AirError> {
        Ok(Refraction::Traced(Arc::new(Traced::over_ground(air, ground_m)?)))
    }

    /// Apparent minus true altitude, given the apparent one.
    pub fn at_apparent_altitude(&self, apparent: Angle) -> Angle {
        match self {
            Refraction::Bennett(formula) => formula.at_apparent_altitude(apparent),
            Refraction::Traced(rays) => rays.at_apparent_altitude(apparent),
        }
    }

    /// The true altitude of what is seen at an apparent one.
    pub fn true_from_apparent(&self, apparent: Angle) -> Angle {
        apparent - self.at_apparent_altitude(apparent)
    }

    /// The apparent altitude of what stands at a true one.
    pub fn apparent_from_true(&self, altitude: Angle) -> Angle {
        match self {
            Refraction::Bennett(formula) => formula.apparent_from_true(altitude),
            Refraction::Traced(rays) => rays.apparent_from_true(altitude),
        }
    }

    /// How much smaller a small solid angle is seen than it is, `d(apparent) / d(true)`, at an
    /// apparent altitude: 0.82 at the horizon of the sea, 1 in the zenith.
    ///
    /// Air keeps radiance, so that what is seen smaller gives less light: the same factor dims a
    /// point of light (the divergence of its beam).
    pub fn divergence(&self, apparent: Angle) -> f64 {
        let slope = match self {
            Refraction::Bennett(formula) => formula.slope_at_apparent_altitude(apparent),
            Refraction::Traced(rays) => rays.slope_at_apparent_altitude(apparent),
        };
        let (across, true_across) = (apparent.cos(), self.true_from_apparent(apparent).cos());
        // In the zenith both vanish, and their ratio is that of the altitudes.
        let level = if across > 1e-6 { across / true_across } else { 1.0 / (1.0 - slope) };
        level / (1.0 - slope)
    }

    /// Where the light of a direction is seen to come from.
    pub fn apparent_from_horizon(&self, dir: Dir<Horizon>) -> Dir<Apparent> {
        dir.raised_to(self.apparent_from_true(dir.altitude()))
    }

    /// Where that stands whose light is seen to come from a direction.
    pub fn horizon_from_apparent(&self, dir: Dir<Apparent>) -> Dir<Horizon> {
        dir.raised_to(self.true_from_apparent(dir.altitude()))
    }
}

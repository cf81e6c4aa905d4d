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
//! Differences at apparent altitudes, in arcseconds; for the traced form the largest over eight airs
//! from -20 to 30 degrees Celsius and from sea level to 4200 m (`tests/refraction.rs`):
//!
//! | | 0° | 2° | 5° | 15° | 45° |
//! |---|---|---|---|---|---|
//!
//! The horizon of real air wanders by several arcminutes from day to day; above 15 degrees it is
//! good to 0.1", if pressure and temperature are.

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
pub use traced::Traced;

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
    ///
    /// # Errors
    ///
    /// See [`Traced::through`].
    pub fn traced(air: &ObserverAir) -> Result<Self, AirError> {
        Ok(Refraction::Traced(Arc::new(Traced::through(air)?)))
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

    /// Where the light of a direction is seen to come from.
    pub fn apparent_from_horizon(&self, dir: Dir<Horizon>) -> Dir<Apparent> {
        Dir::from_azimuth_altitude(dir.azimuth(), self.apparent_from_true(dir.altitude()))
    }

    /// Where that stands whose light is seen to come from a direction.
    pub fn horizon_from_apparent(&self, dir: Dir<Apparent>) -> Dir<Horizon> {
        Dir::from_azimuth_altitude(dir.azimuth(), self.true_from_apparent(dir.altitude()))
    }
}

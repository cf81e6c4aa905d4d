//! What eclipses ask of the theories of motion: all calls are here.

use crate::ephemeris::{Body, Ephemeris, EphemerisError, Observation, Tolerance};
use crate::frame::{Pos, TrueOfDate};
use crate::place::Place;
use crate::time::Instant;
use crate::units::Angle;

/// What eclipses are made of, at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Syzygy {
    /// Apparent place (light time and aberration) from the centre of the Earth.
    pub sun: Pos<TrueOfDate>,
    /// The same.
    pub moon: Pos<TrueOfDate>,
    /// Greenwich apparent sidereal time, in `[0, 2 pi)`.
    pub sidereal_time: Angle,
    /// Bound of the error of the direction from Sun to Moon.
    pub error_bound: Angle,
}

impl Syzygy {
    /// Sun and Moon as the theories that are good enough have them.
    ///
    /// # Errors
    ///
    /// A date that no theory serves.
    pub fn at(
        ephemeris: &Ephemeris,
        instant: &Instant,
        tolerance: Tolerance,
    ) -> Result<Syzygy, EphemerisError> {
        // Geocentric places are taken: where on the Earth the observer stands does not matter.
        let anywhere = Place {
            name: None,
            latitude: Angle::ZERO,
            longitude: Angle::ZERO,
            height_m: 0.0,
            time_zone: None,
        };
        let mut observation = Observation::at(ephemeris, instant, &anywhere, tolerance);
        let sidereal_time = observation.observer().orientation.sidereal_time;
        let sun = observation.seen(Body::Sun)?;
        let moon = observation.seen(Body::Moon)?;
        Ok(Syzygy {
            sun: sun.place.geocentric.at_km(sun.place.geocentric_distance_km),
            moon: moon.place.geocentric.at_km(moon.place.geocentric_distance_km),
            sidereal_time,
            error_bound: sun.error_bound + moon.error_bound,
        })
    }
}

//! What is compiled in: where bodies are by the formulas of the paper and by the series.
//!
//! The origin is the centre of the Sun.

use super::body::Body;
use super::tables::EarthState;
use super::{moon, paper, planets};
use crate::frame::{Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::DAY_S;

/// A theory that needs no table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Analytic {
    Paper,
    Series,
}

impl Analytic {
    /// Position of a body; the paper, which has no planets, gives those of the series.
    pub fn position(self, body: Body, tdb: JulianDate<Tdb>) -> Pos<Icrs> {
        match (self, body) {
            (_, Body::Sun) => Pos::ORIGIN,
            (Analytic::Paper, Body::Moon) => paper::moon(tdb) - paper::sun(tdb),
            (Analytic::Series, Body::Moon) => {
                let moon = moon::moon(tdb);
                let from_barycentre = 1.0 - 1.0 / (1.0 + moon::EARTH_MOON_MASS_RATIO);
                planets::earth_moon_barycentre(tdb) + moon * from_barycentre
            }
            (_, Body::Mercury) => planets::mercury(tdb),
            (_, Body::Venus) => planets::venus(tdb),
            (_, Body::Mars) => planets::mars(tdb),
            (_, Body::Jupiter) => planets::jupiter(tdb),
            (_, Body::Saturn) => planets::saturn(tdb),
            (_, Body::Uranus) => planets::uranus(tdb),
            (_, Body::Neptune) => planets::neptune(tdb),
            (_, Body::Pluto) => planets::pluto(tdb),
        }
    }

    /// The Earth; its velocity is that with respect to the Sun.
    ///
    /// The Sun moves about the barycentre by 16 m/s at most: 0.011" of aberration.
    pub fn earth(self, tdb: JulianDate<Tdb>) -> EarthState {
        // Central difference: 2e-5 km/s of error from the month, 4e-7 km/s from rounding.
        let step_days = 0.1;
        let (before, after) = (
            self.earth_position(tdb.plus_days(-step_days)),
            self.earth_position(tdb.plus_days(step_days)),
        );
        EarthState {
            position: self.earth_position(tdb),
            velocity_km_s: (after - before).km() / (2.0 * step_days * DAY_S),
            sun: Pos::ORIGIN,
        }
    }

    fn earth_position(self, tdb: JulianDate<Tdb>) -> Pos<Icrs> {
        match self {
            Analytic::Paper => -paper::sun(tdb),
            Analytic::Series => {
                planets::earth_moon_barycentre(tdb) + moon::earth_from_barycentre(tdb)
            }
        }
    }
}

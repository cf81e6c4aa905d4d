//! Geometric positions: what each tier says of where a body is.

use glam::DVec3;

use super::body::Body;
use super::tier::Tier;
use super::{moon, paper, planets};
use crate::frame::{Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::DAY_S;

/// Where the Earth is, how fast it moves, and where the Sun is meanwhile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EarthState {
    /// From the same origin as [`crate::ephemeris::Ephemeris::geometric`].
    pub position: Pos<Icrs>,
    /// Kilometres per second, ICRS axes.
    pub velocity_km_s: DVec3,
    /// The Sun at the same moment, from the same origin: the origin itself by the analytic tiers,
    /// off it by up to two radii of the Sun where the origin is the barycentre.
    pub sun: Pos<Icrs>,
}

/// Position and velocity of the centre of the Earth, also a little outside the range.
pub(super) fn earth(tdb: JulianDate<Tdb>, tier: Tier) -> EarthState {
    // Central difference: 2e-5 km/s of error from the month, 4e-7 km/s from rounding.
    let step_days = 0.1;
    let (before, after) = (
        earth_unchecked(tdb.plus_days(-step_days), tier),
        earth_unchecked(tdb.plus_days(step_days), tier),
    );
    EarthState {
        position: earth_unchecked(tdb, tier),
        velocity_km_s: (after - before).km() / (2.0 * step_days * DAY_S),
        sun: Pos::ORIGIN,
    }
}

fn earth_unchecked(tdb: JulianDate<Tdb>, tier: Tier) -> Pos<Icrs> {
    match tier {
        Tier::Paper => -paper::sun(tdb),
        Tier::Series => planets::earth_moon_barycentre(tdb) + moon::earth_from_barycentre(tdb),
    }
}

/// Position of a body from the centre of the Sun; the range of the tier is not looked at.
pub(super) fn unchecked(body: Body, tdb: JulianDate<Tdb>, tier: Tier) -> Pos<Icrs> {
    match (tier, body) {
        (_, Body::Sun) => Pos::ORIGIN,
        (Tier::Paper, Body::Moon) => paper::moon(tdb) - paper::sun(tdb),
        (Tier::Series, Body::Moon) => {
            let moon = moon::moon(tdb);
            let from_barycentre = 1.0 - 1.0 / (1.0 + moon::EARTH_MOON_MASS_RATIO);
            planets::earth_moon_barycentre(tdb) + moon * from_barycentre
        }
        // The paper has no planets; `check` has refused them.
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

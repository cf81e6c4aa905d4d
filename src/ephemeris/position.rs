//! Geometric positions: what each tier says of where a body is.

use glam::DVec3;

use super::body::Body;
use super::tier::{EphemerisError, Tier};
use super::{moon, paper, planets};
use crate::frame::{Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::DAY_S;

/// Where the Earth is, and how fast it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EarthState {
    /// From the same origin as [`geometric`].
    pub position: Pos<Icrs>,
    /// Kilometres per second, ICRS axes.
    pub velocity_km_s: DVec3,
}

/// Geometric position of a body: where it is at that moment, no light time, no aberration.
///
/// The origin belongs to the tier, and [`earth`] has the same one: here the centre of the Sun in
/// both tiers. Giant planets and Pluto are the barycentres of their systems. Refused outside the
/// range of the tier.
pub fn geometric(
    body: Body,
    tdb: JulianDate<Tdb>,
    tier: Tier,
) -> Result<Pos<Icrs>, EphemerisError> {
    tier.check(body, tdb)?;
    Ok(unchecked(body, tdb, tier))
}

/// Geometric position and velocity of the centre of the Earth, origin as in [`geometric`].
///
/// The velocity with respect to the Sun differs from that with respect to the barycentre by 16 m/s
/// at most: 0.011" of aberration.
pub fn earth(tdb: JulianDate<Tdb>, tier: Tier) -> Result<EarthState, EphemerisError> {
    // The Sun is asked: that is whom the range is about.
    tier.check(Body::Sun, tdb)?;
    // Central difference: 2e-5 km/s of error from the month, 4e-7 km/s from rounding.
    let step_days = 0.1;
    let (before, after) = (
        earth_unchecked(tdb.plus_days(-step_days), tier),
        earth_unchecked(tdb.plus_days(step_days), tier),
    );
    Ok(EarthState {
        position: earth_unchecked(tdb, tier),
        velocity_km_s: (after - before).km() / (2.0 * step_days * DAY_S),
    })
}

fn earth_unchecked(tdb: JulianDate<Tdb>, tier: Tier) -> Pos<Icrs> {
    match tier {
        Tier::Paper => -paper::sun(tdb),
        Tier::Series => planets::earth_moon_barycentre(tdb) + moon::earth_from_barycentre(tdb),
    }
}

/// As [`geometric`], also a little outside the range, where light that arrives within it left.
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

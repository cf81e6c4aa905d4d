//! Theories of motion, their ranges and their errors: which one is good enough, and what it says.

use std::fmt;
use std::ops::RangeInclusive;

use glam::DVec3;
use thiserror::Error;

use super::body::Body;
use super::bounds;
use super::{moon, paper, planets};
use crate::frame::{Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::{Angle, DAY_S};

/// How far off a direction may be.
pub type Tolerance = Angle;

/// A theory of motion, cheapest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Tier {
    /// The formulas of the paper, Sun and Moon only: arcminutes, some 0.2 microseconds.
    Paper,
    /// Truncated ELP-2000/82 for the Moon, Simon et al. 1994 for the planets, Standish for Pluto:
    /// arcseconds, some microseconds.
    Series,
}

/// What can keep a position from being given.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EphemerisError {
    #[error(
        "{body}: the year {year:.1} is outside {low} to {high}, where the {tier} tier holds; choose \
         a date within"
    )]
    Date { body: Body, tier: Tier, year: f64, low: f64, high: f64 },
    #[error("{body}: the {tier} tier has no theory of it; use the series tier")]
    NoTheory { body: Body, tier: Tier },
}

/// Where the Earth is, and how fast it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EarthState {
    /// From the same origin as [`geometric`].
    pub position: Pos<Icrs>,
    /// Kilometres per second, ICRS axes.
    pub velocity_km_s: DVec3,
}

impl fmt::Display for Tier {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Tier::Paper => "paper",
            Tier::Series => "series",
        })
    }
}

/// Julian epoch: the year and its fraction.
fn julian_year(tdb: JulianDate<Tdb>) -> f64 {
    2000.0 + tdb.centuries_since_j2000() * 100.0
}

impl Tier {
    /// All tiers, cheapest first.
    pub const ALL: [Tier; 2] = [Tier::Paper, Tier::Series];

    /// Julian years in which the tier may be asked.
    pub const fn years(self) -> RangeInclusive<f64> {
        match self {
            Tier::Paper => bounds::PAPER_YEARS,
            Tier::Series => bounds::SERIES_YEARS,
        }
    }

    /// Whether the tier knows the body at all.
    pub const fn knows(self, body: Body) -> bool {
        match self {
            Tier::Paper => matches!(body, Body::Sun | Body::Moon),
            Tier::Series => true,
        }
    }

    /// Bound of the error of the apparent direction of a body, seen from the centre or the surface
    /// of the Earth, whose time and place are known exactly.
    ///
    /// Measured, with margin: see the table in [`crate::ephemeris`]. `None` where the tier does not
    /// serve the body or the date.
    pub fn bound(self, body: Body, tdb: JulianDate<Tdb>) -> Option<Angle> {
        self.check(body, tdb).ok()?;
        Some(bounds::bound(self, body, julian_year(tdb)))
    }

    fn check(self, body: Body, tdb: JulianDate<Tdb>) -> Result<(), EphemerisError> {
        if !self.knows(body) {
            return Err(EphemerisError::NoTheory { body, tier: self });
        }
        let (year, years) = (julian_year(tdb), self.years());
        if years.contains(&year) {
            Ok(())
        } else {
            let (low, high) = years.into_inner();
            Err(EphemerisError::Date { body, tier: self, year, low, high })
        }
    }
}

/// The cheapest tier whose error stays within the tolerance, else the best there is; with the bound
/// of its error.
pub fn choose(
    body: Body,
    tolerance: Tolerance,
    tdb: JulianDate<Tdb>,
) -> Result<(Tier, Angle), EphemerisError> {
    let served = || Tier::ALL.into_iter().filter_map(|t| t.bound(body, tdb).map(|b| (t, b)));
    if let Some(cheapest) = served().find(|(_, bound)| *bound <= tolerance) {
        return Ok(cheapest);
    }
    let best = served().min_by(|(_, a), (_, b)| a.rad().total_cmp(&b.rad()));
    // No tier serves it: the widest one says why.
    best.map_or_else(|| Tier::Series.check(body, tdb).map(|()| (Tier::Series, Angle::ZERO)), Ok)
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

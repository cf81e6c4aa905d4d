//! Which theory is good enough: the tiers, their ranges, and the measured bounds of their errors.
//!
//! The bounds were measured against apparent geocentric places of DE431 (2500 to 10,000 dates per
//! body and era) and of DE440, with a margin of a quarter to a third, and for the Moon the difference
//! between DE422 and DE431 (84" at -3000, growing as the square of time). A comparison only: nothing
//! was fitted. `tests/ephemeris.rs` repeats it on fewer dates.

use std::fmt;
use std::ops::RangeInclusive;

use thiserror::Error;

use super::body::Body;
use super::resampled::Depth;
use crate::time::{J2000, JulianDate, Tdb};
use crate::units::{Angle, JULIAN_CENTURY_DAYS};

/// How far off a direction may be.
pub type Tolerance = Angle;

/// A theory of motion, cheapest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Tier {
    /// JPL's DE440, resampled; read to a depth.
    De440(Depth),
    /// JPL's DE431, resampled to half an arcsecond: three millennia both ways.
    De431,
    /// The formulas of the paper, Sun and Moon only: arcminutes. `benches/ephemeris.rs` prints what
    /// a place costs by each tier.
    Paper,
    /// Truncated ELP-2000/82 for the Moon, Simon et al. 1994 for the planets, Standish for Pluto:
    /// arcseconds.
    Series,
}

/// What can keep a position from being given.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EphemerisError {
    #[error(
        "{body}: the year {year:.1} is outside {low:.0} to {high:.0}, where the {tier} tier holds; choose \
         a date within"
    )]
    Date { body: Body, tier: Tier, year: f64, low: f64, high: f64 },
    #[error("{body}: the {tier} tier has no theory of it; use the series tier")]
    NoTheory { body: Body, tier: Tier },
    #[error("{body}: the table of the {tier} tier was not read, or not to that depth; load it")]
    NotLoaded { body: Body, tier: Tier },
}

/// Julian years that the table of DE440 holds.
/// 1550-01-01 to 2650-01-24; light that arrives then left within the day before.
const DE440_YEARS: RangeInclusive<f64> = 1550.008..=2650.05;
/// Julian years that the table of DE431 holds.
const DE431_YEARS: RangeInclusive<f64> = -3000.0..=3001.0;
/// Julian years in which the formulas of the paper stay within three degrees.
const PAPER_YEARS: RangeInclusive<f64> = -1000.0..=4001.0;
/// Julian years in which the series were measured; every theory stays within five degrees.
const SERIES_YEARS: RangeInclusive<f64> = -4000.0..=4001.0;

/// First year of each era after the first; the last one has no end.
const ERA_STARTS: [f64; 10] =
    [-3000.0, -2000.0, -1000.0, 0.0, 1000.0, 1550.0, 1800.0, 2050.0, 2650.0, 3000.0];

/// Arcseconds in each era. Where a tier is not asked there is no bound.
type Eras = [f64; 11];

const JULIAN_YEAR_DAYS: f64 = JULIAN_CENTURY_DAYS / 100.0;

const NONE: f64 = f64::INFINITY;

/// DE440 resampled, whole span: arcseconds by depth.
const DE440: [f64; 3] = [0.1, 0.01, 0.001];
const DE431: Eras = [NONE, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
const DE431_MOON: Eras = [NONE, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0];

const PAPER_SUN: Eras = [NONE, NONE, NONE, 1150.0, 520.0, 150.0, 55.0, 65.0, 125.0, 230.0, 680.0];
const PAPER_MOON: Eras =
    [NONE, NONE, NONE, 10_800.0, 5100.0, 1450.0, 600.0, 600.0, 830.0, 1600.0, 5400.0];

const SUN: Eras = [65.0, 40.0, 35.0, 22.0, 22.0, 15.0, 14.0, 14.0, 16.0, 16.0, 18.0];
const MOON: Eras = [570.0, 400.0, 240.0, 130.0, 65.0, 30.0, 24.0, 24.0, 28.0, 36.0, 65.0];
const MERCURY: Eras = [100.0, 60.0, 55.0, 36.0, 28.0, 21.0, 20.0, 20.0, 23.0, 24.0, 28.0];
const VENUS: Eras = [260.0, 130.0, 110.0, 62.0, 62.0, 48.0, 42.0, 42.0, 42.0, 50.0, 75.0];
const MARS: Eras = [580.0, 370.0, 180.0, 145.0, 145.0, 120.0, 85.0, 85.0, 110.0, 105.0, 115.0];
const JUPITER: Eras = [1400.0, 950.0, 550.0, 290.0, 180.0, 95.0, 95.0, 125.0, 95.0, 95.0, 100.0];
const SATURN: Eras =
    [2600.0, 1900.0, 1150.0, 600.0, 370.0, 190.0, 130.0, 130.0, 130.0, 145.0, 200.0];
const URANUS: Eras = [650.0, 560.0, 520.0, 380.0, 350.0, 150.0, 110.0, 120.0, 135.0, 120.0, 220.0];
const NEPTUNE: Eras = [260.0, 140.0, 150.0, 90.0, 60.0, 50.0, 20.0, 16.0, 22.0, 40.0, 50.0];
const PLUTO: Eras =
    [14_000.0, 1000.0, 400.0, 1150.0, 1050.0, 1000.0, 550.0, 320.0, 370.0, 650.0, 9000.0];

impl fmt::Display for Tier {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Tier::De440(Depth::Tenth) => "DE440 to 0.1\"",
            Tier::De440(Depth::Hundredth) => "DE440 to 0.01\"",
            Tier::De440(Depth::Thousandth) => "DE440 to 0.001\"",
            Tier::De431 => "DE431",
            Tier::Paper => "paper",
            Tier::Series => "series",
        })
    }
}

/// Julian epoch: the year and its fraction.
fn julian_year(tdb: JulianDate<Tdb>) -> f64 {
    2000.0 + tdb.days_since_j2000() / JULIAN_YEAR_DAYS
}

impl Tier {
    /// All tiers, cheapest first.
    pub const ALL: [Tier; 6] = [
        Tier::De440(Depth::Tenth),
        Tier::De440(Depth::Hundredth),
        Tier::De440(Depth::Thousandth),
        Tier::De431,
        Tier::Paper,
        Tier::Series,
    ];

    /// Julian years in which the tier may be asked.
    pub const fn years(self) -> RangeInclusive<f64> {
        match self {
            Tier::De440(_) => DE440_YEARS,
            Tier::De431 => DE431_YEARS,
            Tier::Paper => PAPER_YEARS,
            Tier::Series => SERIES_YEARS,
        }
    }

    /// Whether the tier knows the body at all.
    pub const fn knows(self, body: Body) -> bool {
        match self {
            Tier::Paper => matches!(body, Body::Sun | Body::Moon),
            Tier::De440(_) | Tier::De431 | Tier::Series => true,
        }
    }

    /// Bound of the error of the apparent direction of a body, seen from the centre or the surface
    /// of the Earth, whose time and place are known exactly.
    ///
    /// Measured, with margin: see the table in [`crate::ephemeris`]. `None` where the tier does not
    /// serve the body or the date.
    pub fn bound(self, body: Body, tdb: JulianDate<Tdb>) -> Option<Angle> {
        self.check(body, tdb).ok()?;
        if let Tier::De440(depth) = self {
            return Some(Angle::from_arcsec(DE440[depth as usize]));
        }
        let era = ERA_STARTS.iter().filter(|&&start| julian_year(tdb) >= start).count();
        Some(Angle::from_arcsec(self.eras(body)[era]))
    }

    /// How deep the table of DE440 must be read for a tolerance, if that can be kept at all.
    pub(super) fn depth_for(tolerance: Tolerance) -> Depth {
        let within = |depth: &Depth| Angle::from_arcsec(DE440[*depth as usize]) <= tolerance;
        Depth::ALL.into_iter().find(within).unwrap_or(Depth::Thousandth)
    }

    /// The years in which the tier may be asked, as Julian dates.
    pub(super) fn days_jd(self) -> RangeInclusive<f64> {
        let (first, last) = self.years().into_inner();
        let jd = |year: f64| J2000 + (year - 2000.0) * JULIAN_YEAR_DAYS;
        jd(first)..=jd(last)
    }

    /// Refuses what the tier does not serve, and says why.
    pub(super) fn check(self, body: Body, tdb: JulianDate<Tdb>) -> Result<(), EphemerisError> {
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

    const fn eras(self, body: Body) -> &'static Eras {
        match (self, body) {
            (Tier::De440(_), _) => &[NONE; 11],
            (Tier::De431, Body::Moon) => &DE431_MOON,
            (Tier::De431, _) => &DE431,
            (Tier::Paper, Body::Sun) => &PAPER_SUN,
            (Tier::Paper, Body::Moon) => &PAPER_MOON,
            (Tier::Paper, _) => &[NONE; 11],
            (Tier::Series, Body::Sun) => &SUN,
            (Tier::Series, Body::Moon) => &MOON,
            (Tier::Series, Body::Mercury) => &MERCURY,
            (Tier::Series, Body::Venus) => &VENUS,
            (Tier::Series, Body::Mars) => &MARS,
            (Tier::Series, Body::Jupiter) => &JUPITER,
            (Tier::Series, Body::Saturn) => &SATURN,
            (Tier::Series, Body::Uranus) => &URANUS,
            (Tier::Series, Body::Neptune) => &NEPTUNE,
            (Tier::Series, Body::Pluto) => &PLUTO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_in_the_documentation_is_the_table_in_use() {
        let documentation = include_str!("../ephemeris.rs");
        for tier in Tier::ALL {
            for body in Body::ALL.into_iter().filter(|&body| tier.knows(body)) {
                let cells: Vec<String> = tier
                    .eras(body)
                    .iter()
                    .map(|arcsec| if *arcsec == NONE { "-".into() } else { arcsec.to_string() })
                    .collect();
                let row = format!("//! | {body}, {tier} | {} |", cells.join(" | "));
                assert!(documentation.contains(&row), "missing: {row}");
            }
        }
    }

    #[test]
    fn a_bound_is_finite_wherever_its_tier_is_asked() {
        for tier in Tier::ALL {
            for body in Body::ALL.into_iter().filter(|&body| tier.knows(body)) {
                for year in [*tier.years().start(), 0.0, 2000.0, *tier.years().end()] {
                    let tdb = JulianDate::from_jd(2_451_545.0 + (year - 2000.0) * 365.25);
                    let bound = tier.bound(body, tdb).expect("within the range");
                    assert!(bound.deg() < 5.0, "{body}, {tier}, {year}: {bound:?}");
                }
            }
        }
    }
}

//! Measured bounds of the error of each tier, by era.
//!
//! Measured against apparent geocentric places of DE431 (2500 to 10,000 dates per body and era) and
//! of DE440, with a margin of a quarter to a third, and for the Moon the difference between DE422
//! and DE431 (84" at -3000, growing as the square of time). A comparison only: nothing was fitted.
//! `tests/ephemeris.rs` repeats it on fewer dates.

use std::ops::RangeInclusive;

use super::body::Body;
use super::tier::Tier;
use crate::units::Angle;

/// Julian years in which the formulas of the paper stay within five degrees (and a bit: three).
pub const PAPER_YEARS: RangeInclusive<f64> = -1000.0..=4001.0;
/// Julian years in which the series were measured; every theory stays within five degrees.
pub const SERIES_YEARS: RangeInclusive<f64> = -4000.0..=4001.0;

/// First year of each era after the first; the last one has no end.
const ERA_STARTS: [f64; 10] =
    [-3000.0, -2000.0, -1000.0, 0.0, 1000.0, 1550.0, 1800.0, 2050.0, 2650.0, 3000.0];

/// Arcseconds in each era. Where a tier is not asked there is no bound.
type Eras = [f64; 11];

const NONE: f64 = f64::INFINITY;

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

const fn eras(tier: Tier, body: Body) -> &'static Eras {
    match (tier, body) {
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

/// The bound in the era of a Julian year; infinite where the tier is not asked.
pub fn bound(tier: Tier, body: Body, year: f64) -> Angle {
    let era = ERA_STARTS.iter().filter(|&&start| year >= start).count();
    Angle::from_arcsec(eras(tier, body)[era])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_in_the_documentation_is_the_table_in_use() {
        let documentation = include_str!("../ephemeris.rs");
        for tier in Tier::ALL {
            for body in Body::ALL.into_iter().filter(|&body| tier.knows(body)) {
                let cells: Vec<String> = eras(tier, body)
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
        for (tier, years) in [(Tier::Paper, PAPER_YEARS), (Tier::Series, SERIES_YEARS)] {
            for body in Body::ALL.into_iter().filter(|&body| tier.knows(body)) {
                for year in [*years.start(), 0.0, 2000.0, *years.end()] {
                    assert!(bound(tier, body, year).deg() < 5.0, "{body}, {tier}, {year}");
                }
            }
        }
    }
}

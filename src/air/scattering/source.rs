//! Stand-in: straight beams.

use super::columns::{self, SourceColumns};
use super::lanes::Lanes;
use super::profile::{Optics, Profile};
use crate::units::Angle;

#[derive(Debug, Clone)]
pub(crate) struct Beams(SourceColumns);
impl Beams {
    pub fn new(profile: &Profile, _ground_km: f64, _refractivity: f64, _disc: Angle) -> Beams {
        Beams(SourceColumns::new(profile))
    }
    pub fn refraction(&self, _height_km: f64, _mu: f64) -> Angle {
        Angle::ZERO
    }
}
pub(crate) type SourceRow = columns::SourceRow;
#[derive(Debug, Clone)]
pub(crate) struct SourceTable(SourceColumns, Optics);
impl SourceTable {
    pub fn new(beams: &Beams, optics: &Optics) -> SourceTable {
        SourceTable(beams.0.clone(), optics.clone())
    }
    pub fn row(&self, height_km: f64) -> SourceRow {
        self.0.row(height_km)
    }
    #[inline]
    pub fn irradiance(&self, row: &SourceRow, mu: f64) -> Lanes {
        self.0.columns(row, mu).map_or(Lanes::ZERO, |c| (-self.1.optical_depth(c)).exp())
    }
}

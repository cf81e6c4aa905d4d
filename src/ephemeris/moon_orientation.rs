//! How the Moon stands in space: the axes of its map, and what they make of its disc.
//!
//! [`MoonOrientation`] takes the integrated librations of DE421 (`table.rs`) from 1899-12-04 to
//! 2200-02-01, if their table was read, and series (`series.rs`) on all other dates. For
//! [`FADE_DAYS`] beyond either end of the table the series are turned by what they lack at the end,
//! less and less, so that nothing jumps.
//!
//! [`MoonPhysical`] is the physical ephemeris that almanacs print: librations, axis, phase.
//!
//! # Accuracy
//!
//! Largest difference of the axes from DE421, degrees (`tests/moon.rs`): table 0.000008, series
//! 0.0018. Librations against DE440 and DE421 by another program, 1900-2050, with the table: 0.00001
//! degrees, if the Moon stands where it should.

mod de421;
mod physical;
mod series;
mod table;

use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};

use super::body::Body;
use super::resampled::{Depth, Table};
use super::tier::Tier;
use crate::catalog::{CatalogError, Catalogs};
use crate::frame::{Icrs, MoonFixed, Rot};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

pub use physical::{Libration, MoonFace, MoonPhysical, axis_position_angle};
pub use table::{PackedLibrations, pack};

/// Name of the file with the integrated librations among the catalogues.
pub const LIBRATION_FILE: &str = "libration.bin";

/// Days before and after the table over which the series are led to it.
pub const FADE_DAYS: f64 = 100.0;

/// All of the bits of the table lie in its first layer.
const DEPTH: Depth = Depth::Tenth;

/// Bounds of the axes against DE421: measured, with margin.
const TABLE_BOUND: Angle = Angle::from_deg(0.00002);
const SERIES_BOUND: Angle = Angle::from_deg(0.0025);

/// By which theory the Moon is turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LibrationSource {
    /// The integrated librations of DE421.
    Integrated,
    /// Series in the mean arguments.
    Series,
}

/// Knows how the Moon stands. Cheap to clone.
#[derive(Debug, Clone, Default)]
pub struct MoonOrientation {
    integrated: Option<Arc<Joined>>,
}

/// The table, and how it is joined to the series.
#[derive(Debug)]
struct Joined {
    table: table::Integrated,
    first: End,
    last: End,
}

/// One end of the table.
#[derive(Debug)]
struct End {
    at: JulianDate<Tdb>,
    /// Turn of the axes from the series to the table there, as a vector in radians.
    lacking: DVec3,
}

impl MoonOrientation {
    /// By series alone: all dates, no file.
    pub fn series() -> MoonOrientation {
        MoonOrientation::default()
    }

    /// With the table among the catalogues.
    ///
    /// # Errors
    ///
    /// A table that is missing or damaged.
    pub fn load(catalogs: &Catalogs) -> Result<MoonOrientation, CatalogError> {
        let layers = catalogs.layers(LIBRATION_FILE, DEPTH.layers())?;
        Table::open(layers)
            .and_then(MoonOrientation::with)
            .map_err(|what| catalogs.damaged(LIBRATION_FILE, what))
    }

    /// An error says what is wrong with the table, to be read behind the name of its file.
    fn with(table: Table) -> Result<MoonOrientation, String> {
        let table = table::Integrated::new(table)?;
        let end = |at: JulianDate<Tdb>| {
            let axes = table.moon_fixed_from_icrs(at) * series::moon_fixed_from_icrs(at).inverse();
            End { at, lacking: DQuat::from_mat3(&axes.matrix()).to_scaled_axis() }
        };
        let (first, last) = table.span();
        let (first, last) = (end(first), end(last));
        Ok(MoonOrientation { integrated: Some(Arc::new(Joined { table, first, last })) })
    }

    /// Who answers for a date: the table wherever it can, for it is the better and the cheaper one.
    pub fn source(&self, tdb: JulianDate<Tdb>) -> LibrationSource {
        match &self.integrated {
            Some(joined) if joined.first.at <= tdb && tdb <= joined.last.at => {
                LibrationSource::Integrated
            }
            _ => LibrationSource::Series,
        }
    }

    /// Bound of the error of the axes, as a turn about any of them.
    ///
    /// Where there is no integration to compare with, the series may be off as far as those of the
    /// Moon, whose mean longitude and node they share. `None` where those are not asked.
    pub fn bound(&self, tdb: JulianDate<Tdb>) -> Option<Angle> {
        match self.source(tdb) {
            LibrationSource::Integrated => Some(TABLE_BOUND),
            LibrationSource::Series if de421::SPAN_JD.contains(&tdb.jd()) => Some(SERIES_BOUND),
            LibrationSource::Series => {
                Tier::Series.bound(Body::Moon, tdb).map(|moon| SERIES_BOUND + moon)
            }
        }
    }

    /// The axes of the Moon's map at the moment when the light leaves it: mean Earth and mean
    /// rotation. Any date; how good, [`MoonOrientation::bound`] says.
    pub fn moon_fixed_from_icrs(&self, tdb: JulianDate<Tdb>) -> Rot<MoonFixed, Icrs> {
        let Some(joined) = &self.integrated else {
            return series::moon_fixed_from_icrs(tdb);
        };
        let (end, days_beyond) = if tdb < joined.first.at {
            (&joined.first, joined.first.at - tdb)
        } else if tdb > joined.last.at {
            (&joined.last, tdb - joined.last.at)
        } else {
            return joined.table.moon_fixed_from_icrs(tdb);
        };
        let axes = series::moon_fixed_from_icrs(tdb);
        if days_beyond >= FADE_DAYS {
            return axes;
        }
        // From 1 to 0, level at both ends.
        let gone = days_beyond / FADE_DAYS;
        let left = (1.0 - gone).powi(2) * (1.0 + 2.0 * gone);
        // A turn within the Moon's own axes.
        Rot::<MoonFixed, MoonFixed>::claim(DMat3::from_quat(DQuat::from_scaled_axis(
            end.lacking * left,
        ))) * axes
    }
}

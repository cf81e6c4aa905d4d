//! Which form of nutation is good enough, and where it comes from.

use std::sync::Arc;

use super::Nutation;
use super::table::{self, CHANNEL};
use crate::catalog::{CatalogError, Catalogs};
use crate::ephemeris::resampled::{Channel, Depth, Table};
use crate::ephemeris::tier::Tolerance;
use crate::time::{JulianDate, Tt};
use crate::units::Angle;

/// How nutation is had, cheapest first. `benches/positions.rs` prints what each one costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum NutationForm {
    /// IAU 2000A out of a table, 1550 to 2650.
    Interpolated,
    /// The 77 terms of IAU 2000B.
    Iau2000b,
    /// All 1365 terms of IAU 2000A with the adjustments to IAU 2006.
    Iau2000a,
}

impl NutationForm {
    pub const ALL: [NutationForm; 3] =
        [NutationForm::Interpolated, NutationForm::Iau2000b, NutationForm::Iau2000a];

    /// Bound of the difference from IAU 2000A with the adjustments to IAU 2006 (`nut06a` of ERFA), in
    /// longitude, in obliquity, and of sidereal time; from -4000 to +4000. Measured, with margin.
    pub const fn bound(self) -> Angle {
        match self {
            NutationForm::Interpolated => Angle::from_arcsec(0.000_05),
            NutationForm::Iau2000b => Angle::from_arcsec(0.0035),
            NutationForm::Iau2000a => Angle::from_arcsec(0.000_15),
        }
    }
}

/// Nutation in all forms: the series, which are compiled in, and the table, if it was read.
#[derive(Debug, Clone, Default)]
pub struct Nutations {
    table: Option<Arc<Table>>,
    /// First and last moment of the table, Julian centuries from J2000.0.
    span: (f64, f64),
}

impl Nutations {
    /// The series alone.
    pub fn series() -> Nutations {
        Nutations::default()
    }

    /// With the table among the catalogues.
    ///
    /// # Errors
    ///
    /// A table that is missing or damaged.
    pub fn load(catalogs: &Catalogs) -> Result<Nutations, CatalogError> {
        let layers = catalogs.layers(table::FILE, Depth::Thousandth.layers())?;
        Table::open(layers).and_then(Nutations::with_table).map_err(|what| CatalogError::Damaged {
            path: catalogs.directory().join(table::FILE),
            what,
        })
    }

    /// With a table as [`table::encode`] makes it; an error says what is wrong, to be read behind the
    /// name of the file.
    pub fn with_table(table: Table) -> Result<Nutations, String> {
        let channel = table.channel(CHANNEL).ok_or(format!("has no channel {CHANNEL:?}"))?;
        let (first, last) = channel.span();
        let span = (first.centuries_since_j2000(), last.centuries_since_j2000());
        Ok(Nutations { table: Some(Arc::new(table)), span })
    }

    /// The cheapest form whose error stays within the tolerance, else the best there is.
    pub fn choose(&self, tolerance: Tolerance, tt: JulianDate<Tt>) -> NutationForm {
        let is_at_hand =
            |form: &NutationForm| *form != NutationForm::Interpolated || self.channel(tt).is_some();
        let mut forms = NutationForm::ALL.into_iter().filter(is_at_hand);
        let best = || {
            let at_hand = NutationForm::ALL.into_iter().filter(is_at_hand);
            at_hand.min_by(|a, b| a.bound().rad().total_cmp(&b.bound().rad()))
        };
        forms.find(|form| form.bound() <= tolerance).or_else(best).unwrap_or(NutationForm::Iau2000a)
    }

    /// Nutation in a form. Where there is no table, the whole series stands in for it.
    pub fn at(&self, tt: JulianDate<Tt>, form: NutationForm) -> Nutation {
        match form {
            NutationForm::Iau2000b => Nutation::iau2000b(tt),
            NutationForm::Iau2000a => Nutation::iau2000a(tt),
            NutationForm::Interpolated => match self.channel(tt) {
                Some(channel) => table::value(channel, tt),
                None => Nutation::iau2000a(tt),
            },
        }
    }

    /// Nutation within a tolerance, at the least cost.
    pub fn within(&self, tolerance: Tolerance, tt: JulianDate<Tt>) -> Nutation {
        self.at(tt, self.choose(tolerance, tt))
    }

    /// The table, if it holds the moment.
    fn channel(&self, tt: JulianDate<Tt>) -> Option<&Channel> {
        let table = self.table.as_ref()?;
        let (first, last) = self.span;
        let is_held = (first..=last).contains(&tt.centuries_since_j2000());
        if is_held { table.channel(CHANNEL) } else { None }
    }
}

//! Nutation in longitude and obliquity, in three forms.
//!
//! *Theory.* IAU 2000A (Mathews, Herring & Buffett 2002; IERS Conventions 2010, tables 5.3a and
//! 5.3b) with the adjustments to the precession IAU 2006 (Wallace & Capitaine 2006, eq. 5). IAU 2000B
//! (McCarthy & Luzum 2003) is the first 77 terms of it and two constants. Free core nutation (below
//! 0.0003") cannot be predicted and is left out.
//!
//! *How we differ.* All forms have the full arguments of [`super::arguments`]; IAU 2000B by the
//! letter drops their powers and would have the node 7.5 degrees off at -4000.

mod terms;

use std::sync::LazyLock;

use super::series::Series;
use crate::ephemeris::tier::Tolerance;
use crate::frame::{MeanOfDate, Rot, TrueOfDate, turn_axes_x, turn_axes_z};
use crate::time::{JulianDate, Tt};
use crate::units::Angle;

/// Nutation with respect to the mean ecliptic and equinox of date.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nutation {
    /// Of the true equinox from the mean one, along the ecliptic.
    pub longitude: Angle,
    pub obliquity: Angle,
    /// Periodic part of s + XY/2, which places the celestial intermediate origin on the true
    /// equator (IERS Conventions 2010, table 5.2d): sidereal time needs it.
    pub locator: Angle,
}

/// How nutation is had, cheapest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum NutationForm {
    /// The 77 terms of IAU 2000B.
    Iau2000b,
    /// All 1365 terms of IAU 2000A with the adjustments to IAU 2006.
    Iau2000a,
}

impl NutationForm {
    pub const ALL: [NutationForm; 2] = [NutationForm::Iau2000b, NutationForm::Iau2000a];

    /// Bound of the difference from IAU 2000A with the adjustments to IAU 2006, in longitude, in
    /// obliquity, and of sidereal time; from -4000 to +4000. Measured, with margin.
    pub const fn bound(self) -> Angle {
        match self {
            NutationForm::Iau2000b => Angle::from_arcsec(0.0035),
            NutationForm::Iau2000a => Angle::from_arcsec(0.000_15),
        }
    }

    /// The cheapest form whose error stays within the tolerance, else the best there is.
    pub fn choose(tolerance: Tolerance) -> NutationForm {
        let good = NutationForm::ALL.into_iter().find(|form| form.bound() <= tolerance);
        good.unwrap_or(NutationForm::Iau2000a)
    }
}

/// How many terms of IAU 2000A make IAU 2000B.
const IAU_2000B_TERMS: usize = 77;
/// Stands in for the planetary terms of IAU 2000B: longitude and obliquity, arcseconds (Luzum 2001).
const IAU_2000B_PLANETARY_ARCSEC: [f64; 2] = [-0.000_135, 0.000_388];

static IAU_2000B: LazyLock<Series> = LazyLock::new(|| series(IAU_2000B_TERMS));
static IAU_2000A: LazyLock<Series> = LazyLock::new(|| series(usize::MAX));

fn series(nutation_terms: usize) -> Series {
    Series::new(
        &terms::read(nutation_terms)
            .expect("the embedded series are well formed (a test reads them)"),
    )
}

impl Nutation {
    /// Nutation by its series.
    pub fn at(tt: JulianDate<Tt>, form: NutationForm) -> Nutation {
        let t = tt.centuries_since_j2000();
        let (sums, constant_arcsec) = match form {
            NutationForm::Iau2000b => (IAU_2000B.at(t), IAU_2000B_PLANETARY_ARCSEC),
            NutationForm::Iau2000a => (IAU_2000A.at(t), [0.0, 0.0]),
        };
        // Wallace & Capitaine 2006, eq. 5: the obliquity of IAU 2006, and the flattening of the
        // Earth, which wears off.
        let flattening = -2.7774e-6 * t;
        let longitude_arcsec = sums.longitude + constant_arcsec[0];
        let obliquity_arcsec = sums.obliquity + constant_arcsec[1];
        Nutation {
            longitude: Angle::from_arcsec(longitude_arcsec * (1.0 + 0.4697e-6 + flattening)),
            obliquity: Angle::from_arcsec(obliquity_arcsec * (1.0 + flattening)),
            locator: Angle::from_arcsec(sums.locator),
        }
    }

    /// True axes from mean axes.
    pub fn true_from_mean(self, mean_obliquity: Angle) -> Rot<TrueOfDate, MeanOfDate> {
        // To the ecliptic, along it, and back by the true obliquity.
        Rot::claim(
            turn_axes_x(-(mean_obliquity + self.obliquity))
                * turn_axes_z(-self.longitude)
                * turn_axes_x(mean_obliquity),
        )
    }
}

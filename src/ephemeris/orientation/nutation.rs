//! Nutation in longitude and obliquity, in three forms.
//!
//! *Theory.* IAU 2000A (Mathews, Herring & Buffett 2002; IERS Conventions 2010, tables 5.3a and
//! 5.3b) with the adjustments to the precession IAU 2006 (Wallace & Capitaine 2006, eq. 5). IAU 2000B
//! (McCarthy & Luzum 2003) is the first 77 terms of it and two constants. Free core nutation (below
//! 0.0003") cannot be predicted and is left out.
//!
//! *How we differ.* All forms have the full arguments (`arguments`); IAU 2000B by the letter drops
//! their powers and would have the node 7.5 degrees off at -4000.

mod forms;
pub mod table;
mod terms;

use std::sync::LazyLock;

use glam::DVec3;

use super::series::{Series, Term};
use crate::frame::{MeanOfDate, Rot, TrueOfDate, turn_axes_x, turn_axes_z};
use crate::time::{JulianDate, Tt};
use crate::units::Angle;

pub use forms::{NutationForm, Nutations};

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

/// How many terms of IAU 2000A make IAU 2000B.
const IAU_2000B_TERMS: usize = 77;
/// Stands in for the planetary terms of IAU 2000B: longitude and obliquity, arcseconds (Luzum 2001).
const IAU_2000B_PLANETARY_ARCSEC: [f64; 2] = [-0.000_135, 0.000_388];

static IAU_2000B: LazyLock<Series> = LazyLock::new(|| {
    let mut terms = published(IAU_2000B_TERMS);
    // The planets give the locator 0.0000005".
    terms.retain(|term| !term.is_planetary());
    Series::new(&terms)
});
static IAU_2000A: LazyLock<Series> = LazyLock::new(|| Series::new(&published(usize::MAX)));

fn published(nutation_terms: usize) -> Vec<Term> {
    terms::read(nutation_terms).expect("the embedded series are well formed (a test reads them)")
}

impl Nutation {
    /// All 1365 terms of IAU 2000A with the adjustments to IAU 2006.
    pub fn iau2000a(tt: JulianDate<Tt>) -> Nutation {
        Nutation::summed(&IAU_2000A, [0.0, 0.0], tt)
    }

    /// The 77 terms of IAU 2000B.
    pub fn iau2000b(tt: JulianDate<Tt>) -> Nutation {
        Nutation::summed(&IAU_2000B, IAU_2000B_PLANETARY_ARCSEC, tt)
    }

    fn summed(series: &Series, planetary_arcsec: [f64; 2], tt: JulianDate<Tt>) -> Nutation {
        let t = tt.centuries_since_j2000();
        let sums = series.at(t);
        // Wallace & Capitaine 2006, eq. 5: the obliquity of IAU 2006, and the flattening of the
        // Earth, which wears off.
        let flattening = -2.7774e-6 * t;
        let longitude_arcsec = sums.longitude + planetary_arcsec[0];
        let obliquity_arcsec = sums.obliquity + planetary_arcsec[1];
        Nutation {
            longitude: Angle::from_arcsec(longitude_arcsec * (1.0 + 0.4697e-6 + flattening)),
            obliquity: Angle::from_arcsec(obliquity_arcsec * (1.0 + flattening)),
            locator: Angle::from_arcsec(sums.locator),
        }
    }

    /// Longitude, obliquity and locator in radians, as tables hold them.
    pub(in crate::ephemeris) fn vector_rad(self) -> DVec3 {
        DVec3::new(self.longitude.rad(), self.obliquity.rad(), self.locator.rad())
    }

    fn from_vector_rad(vector: DVec3) -> Nutation {
        Nutation {
            longitude: Angle::from_rad(vector.x),
            obliquity: Angle::from_rad(vector.y),
            locator: Angle::from_rad(vector.z),
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

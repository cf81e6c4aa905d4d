//! Precession IAU 2006 with the frame bias: the Fukushima-Williams angles.
//!
//! *Theory.* Capitaine, Wallace & Chapront 2003 (A&A 412, 567); the angles with the bias in them,
//! Hilton et al. 2006, as in IERS Conventions 2010, eq. 5.40. Agrees with `pmat06` of ERFA within
//! rounding.

use glam::DMat3;

use crate::ephemeris::polynomial::polynomial;
use crate::frame::{turn_axes_x, turn_axes_z};
use crate::units::Angle;

/// Arcseconds, powers of Julian centuries of TT from J2000.0. In the axes of the ICRS: longitude of
/// the pole of the ecliptic of date from -y, and its distance from the pole of the ICRS.
const GAMMA_ARCSEC: [f64; 6] =
    [-0.052_928, 10.556_378, 0.493_204_4, -0.000_312_38, -0.000_002_788, 0.000_000_026_0];
const PHI_ARCSEC: [f64; 6] =
    [84_381.412_819, -46.811_016, 0.051_126_8, 0.000_532_89, -0.000_000_440, -0.000_000_017_6];
/// How far the equinox has gone along that ecliptic.
const PSI_ARCSEC: [f64; 6] =
    [-0.041_775, 5_038.481_484, 1.558_417_5, -0.000_185_22, -0.000_026_452, -0.000_000_014_8];
/// Obliquity.
const EPSILON_ARCSEC: [f64; 6] =
    [84_381.406, -46.836_769, -0.000_183_1, 0.002_003_40, -0.000_000_576, -0.000_000_043_4];

fn angle(coefficients: &[f64; 6], t: f64) -> Angle {
    Angle::from_arcsec(polynomial(coefficients, t))
}

/// Mean ecliptic and equinox of date from ICRS axes.
pub fn ecliptic_from_icrs(t: f64) -> DMat3 {
    turn_axes_z(-angle(&PSI_ARCSEC, t))
        * turn_axes_x(angle(&PHI_ARCSEC, t))
        * turn_axes_z(angle(&GAMMA_ARCSEC, t))
}

/// Angle between the mean equator and the mean ecliptic of date.
pub fn mean_obliquity(t: f64) -> Angle {
    angle(&EPSILON_ARCSEC, t)
}

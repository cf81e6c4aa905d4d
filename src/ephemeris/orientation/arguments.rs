//! The fundamental arguments of nutation: angles that the Sun, the Moon and the planets go through.
//!
//! *Theory.* IERS Conventions 2010, eq. 5.43 (Delaunay arguments, Simon et al. 1994) and 5.44
//! (mean longitudes of the planets and the general precession, Souchay et al. 1999).
//!
//! *How we differ.* The code of IAU 2000A takes shorter expressions for its planetary terms, and IAU
//! 2000B for all; here every term has the full ones. That moves the nutation by at most 0.0000015" in
//! 1550-2650 and by 0.00014" at -4000.

use std::f64::consts::TAU;

use crate::ephemeris::polynomial::polynomial;
use crate::units::Angle;

/// How many arguments there are: l, l', F, D, the node; Mercury to Neptune; the general precession.
pub const ARGUMENTS: usize = 14;
/// Those that belong to the Sun and the Moon, the first ones.
pub const DELAUNAY_ARGUMENTS: usize = 5;
const NODE: usize = 4;
const GENERAL_PRECESSION: usize = 13;

/// Multiples of the arguments, which make the argument of a term.
pub type Multiples = [i8; ARGUMENTS];

/// Mean anomaly of the Moon, of the Sun, argument of latitude, elongation and node of the Moon:
/// arcseconds, powers of Julian centuries.
const DELAUNAY_ARCSEC: [[f64; 5]; DELAUNAY_ARGUMENTS] = [
    [485_868.249_036, 1_717_915_923.217_8, 31.879_2, 0.051_635, -0.000_244_70],
    [1_287_104.793_05, 129_596_581.048_1, -0.553_2, 0.000_136, -0.000_011_49],
    [335_779.526_232, 1_739_527_262.847_8, -12.751_2, -0.001_037, 0.000_004_17],
    [1_072_260.703_69, 1_602_961_601.209_0, -6.370_6, 0.006_593, -0.000_031_69],
    [450_160.398_036, -6_962_890.543_1, 7.472_2, 0.007_702, -0.000_059_39],
];

/// Mean longitudes of Mercury to Neptune: radians at J2000.0 and per Julian century.
const PLANETS_RAD: [[f64; 2]; 8] = [
    [4.402_608_842, 2_608.790_314_157_4],
    [3.176_146_697, 1_021.328_554_621_1],
    [1.753_470_314, 628.307_584_999_1],
    [6.203_480_913, 334.061_242_670_0],
    [0.599_546_497, 52.969_096_264_1],
    [0.874_016_757, 21.329_910_496_0],
    [5.481_293_872, 7.478_159_856_7],
    [5.311_886_287, 3.813_303_563_8],
];

/// General precession in longitude: radians, powers of Julian centuries.
const GENERAL_PRECESSION_RAD: [f64; 3] = [0.0, 0.024_381_750, 0.000_005_386_91];

fn delaunay_rad(index: usize, t: f64) -> f64 {
    Angle::from_arcsec(polynomial(&DELAUNAY_ARCSEC[index], t)).rad()
}

/// An argument by its place among [`Multiples`], radians; `t` in Julian centuries of TT from J2000.0.
pub fn argument_rad(index: usize, t: f64) -> f64 {
    match index {
        0..DELAUNAY_ARGUMENTS => delaunay_rad(index, t),
        GENERAL_PRECESSION => polynomial(&GENERAL_PRECESSION_RAD, t),
        planet => polynomial(&PLANETS_RAD[planet - DELAUNAY_ARGUMENTS], t),
    }
}

/// Mean longitude of the ascending node of the Moon, in `(-2 pi, 2 pi)`.
pub fn lunar_node(t: f64) -> Angle {
    Angle::from_rad(delaunay_rad(NODE, t) % TAU)
}

//! Nutation in longitude and obliquity.

use super::terms::{NUTATION, NutationTerm};
use crate::ephemeris::polynomial::polynomial;
use crate::frame::{MeanOfDate, Rot, TrueOfDate, turn_axes_x, turn_axes_z};
use crate::time::{JulianDate, Tt};
use crate::units::Angle;

/// Nutation with respect to the mean ecliptic and equinox of date.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nutation {
    pub longitude: Angle,
    pub obliquity: Angle,
    /// Mean longitude of the ascending node of the Moon.
    node: Angle,
}

/// Mean anomaly of the Moon, of the Sun, argument of latitude, elongation and node of the Moon:
/// arcseconds, powers of Julian centuries. IERS Conventions 2003, eq. 5.43 (Simon et al. 1994).
const ARGUMENTS: [[f64; 5]; 5] = [
    [485_868.249_036, 1_717_915_923.217_8, 31.879_2, 0.051_635, -0.000_244_70],
    [1_287_104.793_05, 129_596_581.048_1, -0.553_2, 0.000_136, -0.000_011_49],
    [335_779.526_232, 1_739_527_262.847_8, -12.751_2, -0.001_037, 0.000_004_17],
    [1_072_260.703_69, 1_602_961_601.209_0, -6.370_6, 0.006_593, -0.000_031_69],
    [450_160.398_036, -6_962_890.543_1, 7.472_2, 0.007_702, -0.000_059_39],
];

/// Stands in for the planetary terms: longitude and obliquity, arcseconds (Luzum 2001).
const PLANETARY_ARCSEC: [f64; 2] = [-0.000_135, 0.000_388];

const ARCSEC_PER_TURN: f64 = 1_296_000.0;

/// Nutation: the 77 terms of IAU 2000B. Within 0.005" of IAU 2000A from -4000 to +4000.
pub fn nutation(tt: JulianDate<Tt>) -> Nutation {
    let t = tt.centuries_since_j2000();
    let arguments =
        ARGUMENTS.map(|c| Angle::from_arcsec(polynomial(&c, t) % ARCSEC_PER_TURN).rad());
    let (mut longitude, mut obliquity) = (0.0, 0.0);
    for NutationTerm(multiples, psi, epsilon) in NUTATION.iter().rev() {
        let argument: f64 = multiples.iter().zip(arguments).map(|(&m, a)| f64::from(m) * a).sum();
        let (sin, cos) = argument.sin_cos();
        longitude += (psi[0] + psi[1] * t) * sin + psi[2] * cos;
        obliquity += (epsilon[0] + epsilon[1] * t) * cos + epsilon[2] * sin;
    }
    Nutation {
        longitude: Angle::from_arcsec(longitude * 1e-7 + PLANETARY_ARCSEC[0]),
        obliquity: Angle::from_arcsec(obliquity * 1e-7 + PLANETARY_ARCSEC[1]),
        node: Angle::from_rad(arguments[4]),
    }
}

impl Nutation {
    /// True axes from mean axes.
    pub fn true_from_mean(self, mean_obliquity: Angle) -> Rot<TrueOfDate, MeanOfDate> {
        // To the ecliptic, along it, and back by the true obliquity.
        Rot::claim(
            turn_axes_x(-(mean_obliquity + self.obliquity))
                * turn_axes_z(-self.longitude)
                * turn_axes_x(mean_obliquity),
        )
    }

    /// Apparent less mean sidereal time.
    ///
    /// The two largest complementary terms are kept (IERS Conventions 2003, table 5.2e); the rest
    /// is below 0.00002".
    pub fn equation_of_equinoxes(self, mean_obliquity: Angle) -> Angle {
        let complementary_arcsec =
            0.002_640_96 * self.node.sin() + 0.000_063_52 * (self.node * 2.0).sin();
        self.longitude * mean_obliquity.cos() + Angle::from_arcsec(complementary_arcsec)
    }
}

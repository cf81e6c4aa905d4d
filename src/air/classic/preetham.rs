//! The daylight of Preetham, Shirley & Smits 1999, *Proc. SIGGRAPH*, 91.
//!
//! Luminance `Y` and chromaticity `x`, `y` are each a value at the zenith times a gradation over its
//! own value there (appendix 2 of the paper), all polynomials in the turbidity and in the zenith
//! distance of the Sun, fitted to a simulation of two orders of scattering in a spherical air of
//! molecules and haze (without ozone, as recalled), at turbidities 2 to 6.
//!
//! The numbers have five decimals in the authors' program and four in print; these are the five. The
//! directions of the chromaticity are as printed in the paper, not as in the course notes of 2003,
//! where one gradation stands for all three.
//!
//! Where it fails: `ClassicModel::fails`, and, recalled, Zotti, Wilkie & Purgathofer 2007, *A Critical
//! Review of the Preetham Skylight Model*.

use std::f64::consts::PI;

use crate::units::Angle;

use super::gradation::{Direction, Gradation};

/// Below, the horizon turns over; above, the sky is no longer one.
pub(super) const TURBIDITIES: (f64, f64) = (1.7, 10.0);

/// Slope with the turbidity, and value at zero, of a to e.
type Coefficients = [(f64, f64); 5];

const LUMINANCE: Coefficients = [
    (0.17872, -1.46303),
    (-0.35540, 0.42749),
    (-0.02266, 5.32505),
    (0.12064, -2.57705),
    (-0.06696, 0.37027),
];
const CHROMATICITY_X: Coefficients = [
    (-0.01925, -0.25922),
    (-0.06651, 0.00081),
    (-0.00041, 0.21247),
    (-0.06409, -0.89887),
    (-0.00325, 0.04517),
];
const CHROMATICITY_Y: Coefficients = [
    (-0.01669, -0.26078),
    (-0.09495, 0.00921),
    (-0.00792, 0.21023),
    (-0.04405, -1.65369),
    (-0.01092, 0.05291),
];

/// Chromaticity of the zenith: for each power of the turbidity (2, 1, 0) a cubic in the zenith distance
/// of the Sun, its highest power first.
type Zenith = [[f64; 4]; 3];

const ZENITH_X: Zenith = [
    [0.00165, -0.00374, 0.00208, 0.0],
    [-0.02902, 0.06377, -0.03202, 0.00394],
    [0.11693, -0.21196, 0.06052, 0.25885],
];
const ZENITH_Y: Zenith = [
    [0.00275, -0.00610, 0.00316, 0.0],
    [-0.04214, 0.08970, -0.04153, 0.00515],
    [0.15346, -0.26756, 0.06669, 0.26688],
];

/// A sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Daylight {
    pub zenith_cd_m2: f64,
    /// CIE 1931.
    pub zenith_xy: (f64, f64),
    sun_altitude: Angle,
    luminance: Gradation,
    x: Gradation,
    y: Gradation,
}

impl Daylight {
    /// From the turbidity and the altitude of the Sun.
    pub fn under(turbidity: f64, sun_altitude: Angle) -> Daylight {
        let sun_zenith = PI / 2.0 - sun_altitude.rad();
        let chi = (4.0 / 9.0 - turbidity / 120.0) * (PI - 2.0 * sun_zenith);
        let zenith_kcd_m2 = (4.0453 * turbidity - 4.9710) * chi.tan() - 0.2155 * turbidity + 2.4192;
        let zenith = |rows: &Zenith| {
            rows.iter().fold(0.0, |sum, row| {
                sum * turbidity + row.iter().fold(0.0, |sum, factor| sum * sun_zenith + factor)
            })
        };
        let gradation = |rows: &Coefficients| {
            let [a, b, c, d, e] = rows.map(|(slope, at_zero)| slope * turbidity + at_zero);
            Gradation { a, b, c, d, e }
        };
        Daylight {
            zenith_cd_m2: 1000.0 * zenith_kcd_m2,
            zenith_xy: (zenith(&ZENITH_X), zenith(&ZENITH_Y)),
            sun_altitude,
            luminance: gradation(&LUMINANCE),
            x: gradation(&CHROMATICITY_X),
            y: gradation(&CHROMATICITY_Y),
        }
    }

    /// Luminance, cd/m2.
    pub fn cd_m2(&self, direction: &Direction) -> f64 {
        self.zenith_cd_m2 * self.luminance.over_zenith(direction, self.sun_altitude).max(0.0)
    }

    /// Chromaticity, CIE 1931.
    pub fn xy(&self, direction: &Direction) -> (f64, f64) {
        (
            self.zenith_xy.0 * self.x.over_zenith(direction, self.sun_altitude),
            self.zenith_xy.1 * self.y.over_zenith(direction, self.sun_altitude),
        )
    }
}

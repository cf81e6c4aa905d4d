//! The two standard skies of the CIE: overcast and clear.
//!
//! **Overcast.** `L = Lz (1 + 2 cos z) / 3`, with `z` the zenith distance: Moon & Spencer 1942,
//! *Illum. Eng.* 37, 707; CIE 1955, CIE 110-1994. The horizon has a third of the zenith, level ground
//! `7/9 pi Lz`. The zenith is `Lz = 123 + 8600 sin h` cd/m2 under a Sun at `h` (Krochmann & Seidl 1974,
//! as in Radiance's `gensky`).
//!
//! **Clear.** `L = Lz f(g) p(z) / (f(zs) p(0))`, `f(g) = 0.91 + 10 exp(-3 g) + 0.45 cos^2 g`,
//! `p(z) = 1 - exp(-0.32 / cos z)`, with `g` the angle from the Sun and `zs` the Sun's zenith distance:
//! Kittler 1967, CIE 22 (1973), CIE 110-1994 (the formula as in Preetham's notes of SIGGRAPH 2003). The zenith is
//! `Lz = (1376 T - 1810) tan h + 380` cd/m2 with the turbidity `T` (the formula of `gensky`; recalled
//! to be that of Karayel et al. 1984, *Energy and Buildings* 6, 283, from San Francisco).
//!
//! Where they fail: `ClassicModel::fails`. The zenith of the clear sky is held at that of a Sun at
//! 75 degrees from there on: the tangent has no bound, and the measurements end sooner.

use crate::units::Angle;

use super::gradation::{Direction, Gradation};

/// Above it, the zenith of the clear sky does not grow any more.
const HIGHEST_SUN: Angle = Angle::from_deg(75.0);

/// The overcast sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overcast {
    pub zenith_cd_m2: f64,
}

impl Overcast {
    pub fn under(sun_altitude: Angle) -> Overcast {
        Overcast { zenith_cd_m2: 123.0 + 8600.0 * sun_altitude.sin() }
    }

    /// Luminance, cd/m2.
    pub fn cd_m2(&self, direction: &Direction) -> f64 {
        self.zenith_cd_m2 * (1.0 + 2.0 * direction.cos_zenith) / 3.0
    }
}

/// The clear sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clear {
    pub zenith_cd_m2: f64,
    sun_altitude: Angle,
}

impl Clear {
    /// `f(g) p(z)`, over 0.91, as a gradation.
    const GRADATION: Gradation =
        Gradation { a: -1.0, b: -0.32, c: 10.0 / 0.91, d: -3.0, e: 0.45 / 0.91 };

    /// From Linke's turbidity and the altitude of the Sun.
    pub fn under(turbidity: f64, sun_altitude: Angle) -> Clear {
        let tan = sun_altitude.rad().min(HIGHEST_SUN.rad()).tan();
        Clear { zenith_cd_m2: (1376.0 * turbidity - 1810.0) * tan + 380.0, sun_altitude }
    }

    /// Luminance, cd/m2.
    pub fn cd_m2(&self, direction: &Direction) -> f64 {
        self.zenith_cd_m2 * Clear::GRADATION.over_zenith(direction, self.sun_altitude)
    }
}

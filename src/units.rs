//! Quantities whose mix-up would be silent, and the constants of nature used here.
//!
//! Angles are radians inside and degrees at the edges. Plain floats elsewhere carry their unit in
//! their name (`distance_km`, `wavelength_nm`).

use std::f64::consts::{PI, TAU};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use serde::{Deserialize, Serialize};

/// The astronomical unit, kilometres (IAU 2012 Resolution B2, exact).
pub const AU_KM: f64 = 149_597_870.7;
/// The speed of light, kilometres per second (SI, exact).
pub const LIGHT_SPEED_KM_S: f64 = 299_792.458;
/// Seconds in a day.
pub const DAY_S: f64 = 86_400.0;
/// Days in a Julian century.
pub const JULIAN_CENTURY_DAYS: f64 = 36_525.0;
/// Nominal radius of the Sun, kilometres (IAU 2015 Resolution B3).
pub const SUN_RADIUS_KM: f64 = 695_700.0;
/// Mean radius of the Moon, kilometres (LRO/LOLA reference sphere).
pub const MOON_RADIUS_KM: f64 = 1_737.4;
/// Equatorial radius of the Earth, kilometres (WGS84).
pub const EARTH_EQUATORIAL_RADIUS_KM: f64 = 6_378.137;

/// A plane angle.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Angle {
    rad: f64,
}

impl Angle {
    pub const ZERO: Angle = Angle { rad: 0.0 };

    pub const fn from_rad(rad: f64) -> Self {
        Angle { rad }
    }
    pub const fn from_deg(deg: f64) -> Self {
        Angle { rad: deg * (PI / 180.0) }
    }
    pub const fn from_arcmin(arcmin: f64) -> Self {
        Angle::from_deg(arcmin / 60.0)
    }
    pub const fn from_arcsec(arcsec: f64) -> Self {
        Angle::from_deg(arcsec / 3600.0)
    }
    /// From hours of right ascension or hour angle: 24 h is a full turn.
    pub const fn from_hours(hours: f64) -> Self {
        Angle::from_deg(hours * 15.0)
    }
    pub const fn rad(self) -> f64 {
        self.rad
    }
    pub const fn deg(self) -> f64 {
        self.rad * (180.0 / PI)
    }
    pub const fn arcmin(self) -> f64 {
        self.deg() * 60.0
    }
    pub const fn arcsec(self) -> f64 {
        self.deg() * 3600.0
    }
    pub const fn hours(self) -> f64 {
        self.deg() / 15.0
    }
    pub fn sin(self) -> f64 {
        self.rad.sin()
    }
    pub fn cos(self) -> f64 {
        self.rad.cos()
    }
    pub fn tan(self) -> f64 {
        self.rad.tan()
    }
    pub fn sin_cos(self) -> (f64, f64) {
        self.rad.sin_cos()
    }
    pub const fn abs(self) -> Self {
        Angle { rad: self.rad.abs() }
    }
    pub fn max(self, other: Self) -> Self {
        Angle { rad: self.rad.max(other.rad) }
    }
    /// The same direction in `[0, 2 pi)`.
    pub fn positive(self) -> Self {
        // Most angles are within a turn: a division would cost more than all the rest.
        let rad = match self.rad {
            rad if (0.0..TAU).contains(&rad) => return self,
            rad if (-TAU..0.0).contains(&rad) => rad + TAU,
            rad => rad.rem_euclid(TAU),
        };
        // rem_euclid rounds a tiny negative angle up to the full turn itself.
        Angle { rad: if rad >= TAU { 0.0 } else { rad } }
    }
    /// The same direction in `[-pi, pi)`.
    pub fn signed(self) -> Self {
        Angle { rad: Angle { rad: self.rad + PI }.positive().rad - PI }
    }
}

impl Add for Angle {
    type Output = Angle;
    fn add(self, other: Angle) -> Angle {
        Angle { rad: self.rad + other.rad }
    }
}
impl AddAssign for Angle {
    fn add_assign(&mut self, other: Angle) {
        self.rad += other.rad;
    }
}
impl Sub for Angle {
    type Output = Angle;
    fn sub(self, other: Angle) -> Angle {
        Angle { rad: self.rad - other.rad }
    }
}
impl Neg for Angle {
    type Output = Angle;
    fn neg(self) -> Angle {
        Angle { rad: -self.rad }
    }
}
impl Mul<f64> for Angle {
    type Output = Angle;
    fn mul(self, factor: f64) -> Angle {
        Angle { rad: self.rad * factor }
    }
}
impl Div<f64> for Angle {
    type Output = Angle;
    fn div(self, divisor: f64) -> Angle {
        Angle { rad: self.rad / divisor }
    }
}

/// An astronomical magnitude in Johnson V.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Magnitude(pub f64);

/// Illuminance of a star of magnitude zero in V, outside the air, lux.
///
/// `E = 2.54e-6 * 10^(-0.4 V)` lx, Crumey 2014, *MNRAS* 442, 2600.
pub const ILLUMINANCE_OF_MAGNITUDE_ZERO_LX: f64 = 2.54e-6;

impl Magnitude {
    /// Illuminance outside the air.
    pub fn illuminance(self) -> Illuminance {
        Illuminance { lx: ILLUMINANCE_OF_MAGNITUDE_ZERO_LX * 10f64.powf(-0.4 * self.0) }
    }
}

/// Photopic illuminance on a plane that faces the source.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Illuminance {
    lx: f64,
}

impl Illuminance {
    pub const fn from_lx(lx: f64) -> Self {
        Illuminance { lx }
    }
    pub const fn lx(self) -> f64 {
        self.lx
    }
    /// The magnitude in V that gives this illuminance; infinite for no light.
    pub fn magnitude(self) -> Magnitude {
        Magnitude(-2.5 * (self.lx / ILLUMINANCE_OF_MAGNITUDE_ZERO_LX).log10())
    }
}

/// A light, weighed by four observers: CIE 1931 X, Y, Z and CIE 1951 scotopic V'.
///
/// In cd/m2 for radiance, in lux for irradiance; the scotopic member in the same units with
/// 1700 lm/W at 507 nm. Lights add and scale. They are never multiplied with each other: what
/// the air does to a light is done to its spectrum, before the weighing.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Xyzv {
    pub x: f64,
    pub y: f64,
    pub z: f64,
    pub v: f64,
}

impl Xyzv {
    pub const BLACK: Xyzv = Xyzv { x: 0.0, y: 0.0, z: 0.0, v: 0.0 };

    pub const fn new(x: f64, y: f64, z: f64, v: f64) -> Self {
        Xyzv { x, y, z, v }
    }
    pub const fn to_f32(self) -> [f32; 4] {
        [self.x as f32, self.y as f32, self.z as f32, self.v as f32]
    }
}

impl Add for Xyzv {
    type Output = Xyzv;
    fn add(self, o: Xyzv) -> Xyzv {
        Xyzv::new(self.x + o.x, self.y + o.y, self.z + o.z, self.v + o.v)
    }
}
impl AddAssign for Xyzv {
    fn add_assign(&mut self, o: Xyzv) {
        *self = *self + o;
    }
}
impl Mul<f64> for Xyzv {
    type Output = Xyzv;
    fn mul(self, s: f64) -> Xyzv {
        Xyzv::new(self.x * s, self.y * s, self.z * s, self.v * s)
    }
}
impl std::iter::Sum for Xyzv {
    fn sum<I: Iterator<Item = Xyzv>>(iter: I) -> Xyzv {
        iter.fold(Xyzv::BLACK, Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_wrap_into_their_ranges_at_both_ends() {
        assert_eq!(Angle::from_rad(-1e-30).positive(), Angle::ZERO);
        assert_eq!(Angle::from_rad(TAU).positive(), Angle::ZERO);
        assert_eq!(Angle::from_rad(PI).signed().rad(), -PI);
        assert!((Angle::from_deg(-190.0).signed().deg() - 170.0).abs() < 1e-12);
    }

    #[test]
    fn magnitude_and_illuminance_are_inverse() {
        for v in [-26.7, -1.46, 0.0, 6.5] {
            assert!((Magnitude(v).illuminance().magnitude().0 - v).abs() < 1e-12);
        }
    }
}

//! Eight wavelengths side by side: the innermost loop of everything here.
//!
//! Plain arrays and loops that a compiler turns into vector instructions; no fused multiply-add,
//! which is a library call on machines without it.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// How many wavelengths travel together.
pub(crate) const LANES: usize = 8;

/// One value per wavelength of a band.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Lanes(pub [f32; LANES]);

impl Lanes {
    pub const ZERO: Lanes = Lanes([0.0; LANES]);

    #[inline(always)]
    pub fn splat(value: f32) -> Lanes {
        Lanes([value; LANES])
    }
    pub fn from_fn(value: impl FnMut(usize) -> f64) -> Lanes {
        Lanes(std::array::from_fn(value).map(|v| v as f32))
    }
    #[inline(always)]
    fn zip(self, other: Lanes, f: impl Fn(f32, f32) -> f32) -> Lanes {
        let mut out = self;
        for i in 0..LANES {
            out.0[i] = f(self.0[i], other.0[i]);
        }
        out
    }
    #[inline(always)]
    pub fn map(self, f: impl Fn(f32) -> f32) -> Lanes {
        let mut out = self;
        for i in 0..LANES {
            out.0[i] = f(self.0[i]);
        }
        out
    }
    /// `self` at weight 0, `other` at weight 1.
    #[inline(always)]
    pub fn lerp(self, other: Lanes, weight: f32) -> Lanes {
        self.zip(other, |a, b| a + (b - a) * weight)
    }
    /// e to the power of each lane: within 3e-7 relative for -87 to 88, held constant outside.
    ///
    /// Splits off a power of two by adding `1.5 * 2^23` (rounding to the nearest integer in the
    /// low bits) and sums the Taylor series to the sixth power in the rest, |r| < 0.347.
    #[inline(always)]
    pub fn exp(self) -> Lanes {
        const ROUND: f32 = 12_582_912.0;
        // ln 2 in two parts, the first exact in few bits.
        const LN2_HIGH: f32 = 0.693_359_4;
        const LN2_LOW: f32 = -2.121_944_4e-4;
        self.map(|x| {
            let x = if x > -87.0 { x } else { -87.0 };
            let x = if x < 88.0 { x } else { 88.0 };
            let shifted = x * std::f32::consts::LOG2_E + ROUND;
            let k = shifted - ROUND;
            let r = (x - k * LN2_HIGH) - k * LN2_LOW;
            let p = 1.0 / 720.0;
            let p = p * r + 1.0 / 120.0;
            let p = p * r + 1.0 / 24.0;
            let p = p * r + 1.0 / 6.0;
            let p = p * r + 0.5;
            let p = (p * r + 1.0) * r + 1.0;
            p * f32::from_bits((shifted.to_bits() << 23).wrapping_add(127 << 23))
        })
    }
    /// e to the power of each lane near zero: within 1e-5 relative to 0.7, 4e-4 to 1.2; arguments are
    /// held within 1.5 of zero.
    #[inline(always)]
    pub fn exp_near_zero(self) -> Lanes {
        self.map(|x| {
            let x = if x > -1.5 { x } else { -1.5 };
            let x = if x < 1.5 { x } else { 1.5 };
            let p = x * (1.0 / 120.0) + 1.0 / 24.0;
            let p = p * x + 1.0 / 6.0;
            let p = p * x + 0.5;
            (p * x + 1.0) * x + 1.0
        })
    }
    /// Natural logarithm; what is below `floor` counts as `floor`.
    pub fn ln_above(self, floor: f32) -> Lanes {
        self.map(|x| x.max(floor).ln())
    }
}

impl Add for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn add(self, o: Lanes) -> Lanes {
        self.zip(o, |a, b| a + b)
    }
}
impl Sub for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn sub(self, o: Lanes) -> Lanes {
        self.zip(o, |a, b| a - b)
    }
}
impl Mul for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn mul(self, o: Lanes) -> Lanes {
        self.zip(o, |a, b| a * b)
    }
}
impl Mul<f32> for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn mul(self, s: f32) -> Lanes {
        self.map(|a| a * s)
    }
}
impl Neg for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn neg(self) -> Lanes {
        self.map(|a| -a)
    }
}
impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, o: Lanes) {
        *self = *self + o;
    }
}
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_follows_the_library() {
        for i in 0..17_300 {
            let x = -86.9 + 0.01 * i as f32;
            let got = f64::from(Lanes::splat(x).exp().0[3]);
            let want = f64::from(x).exp();
            assert!((got / want - 1.0).abs() < 3e-7, "exp({x}) = {got}, not {want}");
        }
        for (x, within) in [(0.0f32, 1e-7), (0.3, 1e-6), (-0.7, 6e-4), (0.7, 1.2e-4), (1.2, 2e-3)] {
            let got = f64::from(Lanes::splat(x).exp_near_zero().0[5]);
            assert!((got / f64::from(x).exp() - 1.0).abs() <= within, "exp({x}) = {got}");
        }
        assert!(Lanes::splat(-1e4).exp().0[0] < 2e-38);
        assert_eq!(Lanes::ZERO.exp().0, [1.0; LANES]);
    }
}

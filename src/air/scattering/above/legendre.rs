//! Associated Legendre functions of one order, normalised for real spherical harmonics.
//!
//! `P_lm(z)` such that `P_lm(cos theta) cos(m phi)`, and the same with the sine for `m > 0`, have an
//! integral of their square over the sphere of 1; positive at small `theta`. By the recurrence in the
//! degree, which is stable: `P_l = a_l (z P_(l-1) - b_l P_(l-2))`, `a_l^2 = (4 l^2 - 1) / (l^2 - m^2)`,
//! `b_l = 1 / a_(l-1)` (Abramowitz & Stegun 1964, 8.5.3, with the norm put in). These are the
//! functions of `harmonics`, of any degree, one order at a time.

use std::f64::consts::PI;

/// The functions of one order, up to a degree.
#[derive(Debug, Clone)]
pub(super) struct Legendre {
    pub order: usize,
    /// Of `P_mm`, without the power of the sine.
    first: f64,
    /// `a_l` and `b_l` for the degrees after the order.
    steps: Vec<(f64, f64)>,
}

impl Legendre {
    pub fn new(order: usize, degree: usize) -> Legendre {
        let m = order as f64;
        let product: f64 = (1..=order).map(|k| (2 * k + 1) as f64 / (2 * k) as f64).product();
        let two = if order == 0 { 1.0 } else { 2.0 };
        let a = |l: usize| {
            let l = l as f64;
            ((4.0 * l * l - 1.0) / (l * l - m * m)).sqrt()
        };
        let steps = (order + 1..=degree)
            .map(|l| (a(l), if l == order + 1 { 0.0 } else { 1.0 / a(l - 1) }))
            .collect();
        Legendre { order, first: (two * product / (4.0 * PI)).sqrt(), steps }
    }

    /// Calls back with each degree, from the order on, and its value at the cosine `z`.
    #[inline(always)]
    pub fn each(&self, z: f64, mut take: impl FnMut(usize, f64)) {
        let sine = (1.0 - z * z).max(0.0).sqrt();
        let (mut before, mut value) = (0.0, self.first * sine.powi(self.order as i32));
        take(self.order, value);
        for (l, (a, b)) in (self.order + 1..).zip(&self.steps) {
            (before, value) = (value, a * (z * value - b * before));
            take(l, value);
        }
    }

    /// Integral of the square of cosine or sine over azimuth.
    pub fn azimuth_norm(&self) -> f64 {
        if self.order == 0 { 2.0 * PI } else { PI }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::harmonics::{MAX_DEGREE, gauss_legendre, index, zonal_part};
    use super::*;

    #[test]
    fn they_are_those_of_the_short_list() {
        for z in [-0.97, -0.3, 0.0, 0.6, 1.0f64] {
            let zonal = zonal_part(MAX_DEGREE, z);
            for m in 0..=MAX_DEGREE {
                let sine = (1.0 - z * z).sqrt().powi(m as i32);
                Legendre::new(m, MAX_DEGREE).each(z, |l, value| {
                    let want = f64::from(zonal[index(l, m)]) * sine;
                    assert!((value - want).abs() < 1e-6, "{l} {m} at {z}: {value}, not {want}");
                });
            }
        }
    }

    #[test]
    fn they_are_orthonormal_to_a_high_degree() {
        for order in [0, 1, 7] {
            let legendre = Legendre::new(order, 24);
            let count = 25 - order;
            let mut gram = vec![0.0; count * count];
            for (t, w) in gauss_legendre(32) {
                let mut y = Vec::new();
                legendre.each(2.0 * t - 1.0, |_, value| y.push(value));
                for i in 0..count {
                    for j in 0..count {
                        gram[i * count + j] += 2.0 * w * legendre.azimuth_norm() * y[i] * y[j];
                    }
                }
            }
            for (k, value) in gram.iter().enumerate() {
                let want = f64::from(u8::from(k / count == k % count));
                assert!((value - want).abs() < 1e-12, "order {order}, {k}: {value}");
            }
        }
    }
}

//! Real spherical harmonics, even in azimuth, without a single angle.
//!
//! With the local vertical as axis, azimuth counted from the source, `z = cos(theta)` and
//! `x = sin(theta) cos(phi)`: `Y_lm = N_lm Q_lm(z) C_m(x, z)`, where `C_m = sin^m(theta) cos(m phi)`
//! follows `C_{m+1} = 2 x C_m - (1 - z^2) C_{m-1}` and `Q_lm` is the associated Legendre function
//! without its `sin^m(theta)`. Nothing is singular at the pole.

use std::f64::consts::PI;

pub(crate) use crate::air::phase::quadrature::gauss_legendre;

/// The highest degree supported.
pub(crate) const MAX_DEGREE: usize = 8;
/// Coefficients up to [`MAX_DEGREE`].
pub(crate) const MAX_COEFFICIENTS: usize = coefficient_count(MAX_DEGREE);

/// Number of coefficients with `l <= degree` and `0 <= m <= l`.
pub(crate) const fn coefficient_count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// Where `(l, m)` stands in a list of coefficients.
pub(crate) const fn index(l: usize, m: usize) -> usize {
    l * (l + 1) / 2 + m
}

/// `N_lm Q_lm(z)` for all `l <= degree`: the part of the harmonics that knows no azimuth.
pub(crate) fn zonal_part(degree: usize, z: f64) -> [f32; MAX_COEFFICIENTS] {
    let mut out = [0.0; MAX_COEFFICIENTS];
    let mut q_mm = 1.0; // (2m-1)!!
    for m in 0..=degree {
        let (mut below, mut q) = (0.0, q_mm);
        for l in m..=degree {
            // (l-m)! / (l+m)!
            let ratio: f64 = ((l - m + 1)..=(l + m)).map(|k| 1.0 / k as f64).product();
            let two = if m == 0 { 1.0 } else { 2.0 };
            let norm = (two * (2 * l + 1) as f64 / (4.0 * PI) * ratio).sqrt();
            out[index(l, m)] = (norm * q) as f32;
            let next = ((2 * l + 1) as f64 * z * q - (l + m) as f64 * below) / (l - m + 1) as f64;
            (below, q) = (q, next);
        }
        q_mm *= (2 * m + 1) as f64;
    }
    out
}

/// `C_m = sin^m(theta) cos(m phi)` for all `m <= degree`, from `x` and `1 - z^2`.
#[inline(always)]
pub(crate) fn azimuthal_part(degree: usize, x: f32, sin2: f32) -> [f32; MAX_DEGREE + 1] {
    let mut c = [0.0; MAX_DEGREE + 1];
    c[0] = 1.0;
    c[1] = x;
    for m in 1..degree.min(MAX_DEGREE) {
        c[m + 1] = 2.0 * x * c[m] - sin2 * c[m - 1];
    }
    c
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_are_orthonormal() {
        let count = coefficient_count(MAX_DEGREE);
        let mut gram = vec![0.0; count * count];
        let n_phi = 2 * MAX_DEGREE + 2;
        for (t, w) in gauss_legendre(12) {
            let z = 2.0 * t - 1.0;
            let zonal = zonal_part(MAX_DEGREE, z);
            let sin2 = 1.0 - z * z;
            for k in 0..n_phi {
                let phi = 2.0 * PI * k as f64 / n_phi as f64;
                let c = azimuthal_part(MAX_DEGREE, (sin2.sqrt() * phi.cos()) as f32, sin2 as f32);
                let y: Vec<f64> = (0..=MAX_DEGREE)
                    .flat_map(|l| (0..=l).map(move |m| (l, m)))
                    .map(|(l, m)| f64::from(zonal[index(l, m)] * c[m]))
                    .collect();
                for i in 0..count {
                    for j in 0..count {
                        gram[i * count + j] += 2.0 * w * 2.0 * PI / n_phi as f64 * y[i] * y[j];
                    }
                }
            }
        }
        for i in 0..count {
            for j in 0..count {
                let want = f64::from(u8::from(i == j));
                assert!((gram[i * count + j] - want).abs() < 3e-5, "{i} {j}");
            }
        }
    }

    #[test]
    fn second_degree_reads_as_in_the_books() {
        let z = 0.3;
        let y = zonal_part(2, z);
        assert!((f64::from(y[0]) - 0.282_094_8).abs() < 1e-6);
        assert!((f64::from(y[index(2, 0)]) - 0.315_391_6 * (3.0 * z * z - 1.0)).abs() < 1e-6);
        assert!((f64::from(y[index(2, 1)]) - 1.092_548_4 * z).abs() < 1e-6);
        assert!((f64::from(y[index(2, 2)]) - 0.546_274_2).abs() < 1e-6);
        let (x, sin2) = (0.5, 0.91);
        assert!((azimuthal_part(2, x, sin2)[2] - (2.0 * x * x - sin2)).abs() < 1e-6);
    }
}

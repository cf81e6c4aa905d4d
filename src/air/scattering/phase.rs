//! Phase functions, normalised to 1 over the sphere, and their Legendre moments.
//!
//! `P(nu) = sum (2l+1)/(4 pi) chi_l P_l(nu)` with `nu` the cosine of the angle by which light turns.

use std::f64::consts::PI;

/// Rayleigh scattering of unpolarised light, without depolarisation, per steradian:
/// `3/(16 pi) (1 + nu^2)` (Chandrasekhar 1960, section 16).
pub fn rayleigh(nu: f64) -> f64 {
    3.0 / (16.0 * PI) * (1.0 + nu * nu)
}

/// Legendre moment of [`rayleigh`]: 1, 0, 1/10, and 0 from there on.
pub fn rayleigh_moment(l: usize) -> f64 {
    match l {
        0 => 1.0,
        2 => 0.1,
        _ => 0.0,
    }
}

/// Henyey & Greenstein 1941, per steradian; `g` is the mean cosine, |g| < 1.
pub fn henyey_greenstein(g: f64, nu: f64) -> f64 {
    let d = 1.0 + g * g - 2.0 * g * nu;
    (1.0 - g * g) / (4.0 * PI * d * d.sqrt())
}

/// Legendre moment of [`henyey_greenstein`]: `g^l`.
pub fn henyey_greenstein_moment(g: f64, l: usize) -> f64 {
    g.powi(l as i32)
}

#[cfg(test)]
mod tests {
    use super::super::harmonics::gauss_legendre;
    use super::*;

    /// `2 pi` times the integral of `P P_l`, by quadrature.
    fn moment(phase: impl Fn(f64) -> f64, l: usize) -> f64 {
        let legendre = |nu: f64| {
            let (mut p, mut q) = (1.0, nu);
            for k in 1..=l {
                (p, q) = (q, ((2 * k + 1) as f64 * nu * q - k as f64 * p) / (k + 1) as f64);
            }
            p
        };
        gauss_legendre(64)
            .iter()
            .map(|&(t, w)| {
                let nu = 2.0 * t - 1.0;
                2.0 * PI * 2.0 * w * phase(nu) * legendre(nu)
            })
            .sum()
    }

    #[test]
    fn moments_are_those_of_the_functions() {
        for l in 0..=6 {
            assert!((moment(rayleigh, l) - rayleigh_moment(l)).abs() < 1e-12, "Rayleigh {l}");
            let hg = moment(|nu| henyey_greenstein(0.7, nu), l);
            assert!((hg - henyey_greenstein_moment(0.7, l)).abs() < 1e-9, "aerosol {l}: {hg}");
        }
    }
}

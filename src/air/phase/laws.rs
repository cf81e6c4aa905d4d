//! Phase functions that are formulas, per steradian, 1 over the sphere; and their Legendre moments.

use std::f64::consts::PI;

use super::quadrature::{gauss_legendre, legendre};

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

/// Rayleigh scattering by molecules that are no spheres (Chandrasekhar 1960, section 18); the
/// depolarisation of natural light scattered at a right angle, 0 to 0.5 (air: about 0.028).
///
/// `3/(16 pi) / (1 + 2 gamma) ((1 + 3 gamma) + (1 - gamma) nu^2)`, `gamma = d/(2 - d)`.
pub fn rayleigh_depolarised(depolarisation: f64, nu: f64) -> f64 {
    let gamma = depolarisation / (2.0 - depolarisation);
    let shape = (1.0 + 3.0 * gamma) + (1.0 - gamma) * nu * nu;
    3.0 / (16.0 * PI) / (1.0 + 2.0 * gamma) * shape
}

/// Legendre moment of [`rayleigh_depolarised`]; that of degree 2 is `(1 - gamma)/(10 (1 + 2 gamma))`.
pub fn rayleigh_depolarised_moment(depolarisation: f64, l: usize) -> f64 {
    let gamma = depolarisation / (2.0 - depolarisation);
    rayleigh_moment(l) * if l == 2 { (1.0 - gamma) / (1.0 + 2.0 * gamma) } else { 1.0 }
}

/// King's factor: by how much depolarisation raises the cross-section, `(6 + 3d)/(6 - 7d)` (King
/// 1923; 1.049 for air). The cross-section of [`crate::air::cross_section`] holds it already.
pub fn king_factor(depolarisation: f64) -> f64 {
    (6.0 + 3.0 * depolarisation) / (6.0 - 7.0 * depolarisation)
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

/// Two of [`henyey_greenstein`], one of which may look back (Kattawar 1975), per steradian.
pub fn double_henyey_greenstein(
    forward_g: f64,
    backward_g: f64,
    forward_share: f64,
    nu: f64,
) -> f64 {
    forward_share * henyey_greenstein(forward_g, nu)
        + (1.0 - forward_share) * henyey_greenstein(backward_g, nu)
}

/// Legendre moment of [`double_henyey_greenstein`].
pub fn double_henyey_greenstein_moment(
    forward_g: f64,
    backward_g: f64,
    forward_share: f64,
    l: usize,
) -> f64 {
    forward_share * henyey_greenstein_moment(forward_g, l)
        + (1.0 - forward_share) * henyey_greenstein_moment(backward_g, l)
}

/// Schlick's stand-in for Henyey and Greenstein, per steradian: `(1 - k^2)/(4 pi (1 - k nu)^2)`.
///
/// Positive `k`, |k| < 1, throws light forward. Blasi, Le Saëc & Schlick 1993 write `1 + k nu` with
/// the angle counted from the way back. Near `g` of Henyey and Greenstein: `k = 1.55 g - 0.55 g^3`
/// (a fit recalled from pbrt).
pub fn schlick(k: f64, nu: f64) -> f64 {
    let d = 1.0 - k * nu;
    (1.0 - k * k) / (4.0 * PI * d * d)
}

/// Legendre moment of [`schlick`], by quadrature in `t = ln(1 - k nu)`, where it is smooth.
pub fn schlick_moment(k: f64, l: usize) -> f64 {
    if k.abs() < 1e-3 {
        // The first terms of the series in k: 1, 2k/3, 2k^2/5; relative error k^2.
        return match l {
            0 => 1.0,
            1 => 2.0 * k / 3.0,
            2 => 0.4 * k * k,
            _ => 0.0,
        };
    }
    let (low, high) = ((-k).ln_1p(), k.ln_1p());
    // d nu = -(1 - k nu)/k dt: the sign goes with the order of the ends.
    let sum: f64 = gauss_legendre(48 + 2 * l)
        .iter()
        .map(|&(t, w)| {
            let d = (low + (high - low) * t).exp();
            let nu = ((1.0 - d) / k).clamp(-1.0, 1.0);
            w * legendre(l, nu) / d
        })
        .sum();
    2.0 * PI * (1.0 - k * k) / (4.0 * PI * k) * (high - low) * sum
}

/// Cornette & Shanks 1992, eq. 8: Henyey and Greenstein's with the `1 + nu^2` of Rayleigh, per
/// steradian. `g`, |g| < 1, is not the mean cosine; 0 is [`rayleigh`].
pub fn cornette_shanks(g: f64, nu: f64) -> f64 {
    1.5 * (1.0 + nu * nu) / (2.0 + g * g) * henyey_greenstein(g, nu)
}

/// Legendre moment of [`cornette_shanks`], by the recurrence of `nu^2 P_l`; that of degree 1 is
/// `3 g (4 + g^2) / (5 (2 + g^2))`.
pub fn cornette_shanks_moment(g: f64, l: usize) -> f64 {
    let n = l as f64;
    let hg = |degree: usize| henyey_greenstein_moment(g, degree);
    // nu^2 P_l = a P_{l+2} + b P_l + c P_{l-2}.
    let a = (n + 1.0) * (n + 2.0) / ((2.0 * n + 1.0) * (2.0 * n + 3.0));
    let b = (n + 1.0).powi(2) / ((2.0 * n + 1.0) * (2.0 * n + 3.0))
        + if l == 0 { 0.0 } else { n * n / (4.0 * n * n - 1.0) };
    let c = if l < 2 { 0.0 } else { n * (n - 1.0) / (4.0 * n * n - 1.0) * hg(l - 2) };
    1.5 / (2.0 + g * g) * (hg(l) * (1.0 + b) + a * hg(l + 2) + c)
}

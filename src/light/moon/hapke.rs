//! Hapke's model of the light that a rough, dusty ground sends back.
//!
//! Theory: Hapke 2012, *Theory of Reflectance and Emittance Spectroscopy*, 2nd edition, chapters 8, 9
//! and 12, in the form that Sato et al. 2014, *JGR Planets* 119, 1775, eqs. 2 to 9, fitted to the Moon.
//! With `mu0`, `mu` the effective cosines of incidence and emission, `g` the phase angle, the radiance
//! factor (pi times the radiance over the irradiance of a plane that faces the Sun) is
//!
//! ```text
//! w/4  mu0 / (mu0 + mu)  [p(g) (1 + B_S0 B_S(g)) + H(mu0) H(mu) - 1]  S(i, e, psi)
//!
//! p   = (1+c)/2 (1-b²) / (1 - 2b cos g + b²)^1.5  +  (1-c)/2 (1-b²) / (1 + 2b cos g + b²)^1.5
//! B_S = 1 / (1 + tan(g/2) / h_S)
//! H   = 1 / (1 - w x [r0 + (1 - 2 r0 x)/2 ln((1+x)/x)]),  r0 = (1-y) / (1+y),  y = sqrt(1-w)
//! ```
//!
//! The lobe with `1+c` points back to the Sun: `c` is positive on the Moon and follows the "hockey
//! stick" `c = 3.29 exp(-17.4 b²) - 0.908` (Hapke 2012) there. H is that of Hapke 2002, *Icarus* 157,
//! 523, eq. 13, good to 0.4 % for the albedos of the Moon. Effective cosines and the shadowing `S` of facets whose slopes have the
//! mean `theta` are those of Hapke 1984, *Icarus* 59, 41, eqs. 47 to 52. (Numbers of equations are
//! recalled; the formulas were compared with two other programs.)
//!
//! Omitted, as in Sato et al.: coherent backscattering, porosity (filling factor 1).
//!
//! Accuracy: with the maps of Sato et al., REFF(30°, 0°, 30°) agrees with the calibrated colour map
//! as well as that was fitted (rms 0.0028 at 415 nm, 0.0036 at 566, 0.0050 at 643; the means are
//! 0.066, 0.096 and 0.113). For the light of the
//! whole disc see [`super::surface`]. Below 5 degrees of phase the maps have no data of all places;
//! at large angles the model is a little bright.

use std::f64::consts::PI;

use crate::catalog::moon::HapkeCell;
use crate::catalog::moon::hapke::ROUGHNESS_DEG;
use crate::units::Angle;

/// Smallest cosine, sine or width that is told from 0.
const TINY: f64 = 1e-6;

/// What roughness makes of the directions of light and view: the same at all wavelengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facets {
    /// Effective cosine of incidence: how steeply the Sun stands on the facets that are lit and seen.
    pub cos_incidence: f64,
    /// Effective cosine of emission.
    pub cos_emission: f64,
    /// Shadowing function, 0 to 1; its approximations let it reach 1.09 where light and view graze
    /// the ground from opposite sides.
    pub shadowing: f64,
}

impl Facets {
    /// On ground as rough as the Moon's; the cosines are those of the smooth ground, above 0.
    pub fn of(cos_incidence: f64, cos_emission: f64, phase: Angle) -> Self {
        Facets::with_roughness(Angle::from_deg(ROUGHNESS_DEG), cos_incidence, cos_emission, phase)
    }

    /// The same for any mean slope of the facets above 0 and below 60 degrees.
    pub fn with_roughness(
        mean_slope: Angle,
        cos_incidence: f64,
        cos_emission: f64,
        phase: Angle,
    ) -> Self {
        let slope = mean_slope.tan();
        let (sun, eye) = (Ray::new(cos_incidence, slope), Ray::new(cos_emission, slope));
        // The azimuth between Sun and observer, seen from the ground.
        let cos_azimuth =
            ((phase.cos() - sun.cos * eye.cos) / (sun.sin * eye.sin)).clamp(-1.0, 1.0);
        let sin2_half = 0.5 * (1.0 - cos_azimuth);
        let half_turns = cos_azimuth.acos() / PI;
        // How much of the shadows hides behind what the eye cannot see anyway.
        let hidden = (-2.0 * (sin2_half / (1.0 - sin2_half).max(1e-12)).sqrt()).exp();
        let contraction = 1.0 / (1.0 + PI * slope * slope).sqrt();
        let sun_is_higher = sun.cos >= eye.cos;
        let (steep, flat) = if sun_is_higher { (&sun, &eye) } else { (&eye, &sun) };
        let divisor = 2.0 - flat.e1 - half_turns * steep.e1;
        let effective = |ray: &Ray, tilt: f64| {
            (contraction * (ray.cos + ray.sin * slope * tilt / divisor)).max(TINY)
        };
        let of_steep = effective(steep, cos_azimuth * flat.e2 + sin2_half * steep.e2);
        let of_flat = effective(flat, flat.e2 - sin2_half * steep.e2);
        let (cos_incidence, cos_emission) =
            if sun_is_higher { (of_steep, of_flat) } else { (of_flat, of_steep) };
        // Each ray alone, without regard to the other.
        let alone = |ray: &Ray| contraction * (ray.cos + ray.sin * slope * ray.e2 / (2.0 - ray.e1));
        let steep_lit = steep.cos / alone(steep);
        let shadowing = (cos_emission / alone(&eye)) * (sun.cos / alone(&sun)) * contraction
            / (1.0 - hidden + hidden * contraction * steep_lit);
        Facets { cos_incidence, cos_emission, shadowing }
    }
}

/// A direction over rough ground.
struct Ray {
    cos: f64,
    sin: f64,
    e1: f64,
    e2: f64,
}

impl Ray {
    fn new(cos: f64, slope: f64) -> Self {
        let cos = cos.clamp(TINY, 1.0);
        let sin = (1.0 - cos * cos).sqrt().max(TINY);
        let cot = cos / (sin * slope);
        Ray { cos, sin, e1: (-2.0 / PI * cot).exp(), e2: (-cot * cot / PI).exp() }
    }
}

/// Radiance factor: pi times the radiance over the irradiance of a plane that faces the Sun. From
/// the cosines of incidence and emission at the smooth ground and the phase angle; 0 where Sun or
/// observer is below it.
pub fn radiance_factor(
    cell: &HapkeCell,
    cos_incidence: f64,
    cos_emission: f64,
    phase: Angle,
) -> f64 {
    if cos_incidence <= 0.0 || cos_emission <= 0.0 {
        return 0.0;
    }
    let facets = Facets::of(cos_incidence, cos_emission, phase);
    radiance_factor_of(&facets, cell.w, single_scattering(cell, phase), 0.25 * cell.w)
}

/// The same with the parts of it that are the same all over the disc made before: `single` is
/// [`single_scattering`] and `multiple` a quarter of `w`, both times a factor of the caller's.
pub fn radiance_factor_of(facets: &Facets, w: f64, single: f64, multiple: f64) -> f64 {
    let (mu0, mu) = (facets.cos_incidence, facets.cos_emission);
    mu0 / (mu0 + mu) * facets.shadowing * (single + multiple * again(w, mu0, mu))
}

/// What grains of single-scattering albedo `w` make of light that they scatter more than once, `H H - 1`, by
/// effective cosines above 0.
pub fn again(w: f64, cos_incidence: f64, cos_emission: f64) -> f64 {
    h_function(w, cos_incidence) * h_function(w, cos_emission) - 1.0
}

/// A quarter of the light that grains scatter once, `w/4 p(g) (1 + B_S0 B_S(g))`.
pub fn single_scattering(cell: &HapkeCell, phase: Angle) -> f64 {
    let HapkeCell { w, b, c, b_s0, h_s } = *cell;
    let phase = phase.abs();
    let lobe = |cos: f64| {
        let square = 1.0 - 2.0 * b * cos + b * b;
        (1.0 - b * b) / (square * square.sqrt())
    };
    let cos = phase.cos();
    let phase_function = 0.5 * ((1.0 + c) * lobe(cos) + (1.0 - c) * lobe(-cos));
    let surge = 1.0 / (1.0 + (0.5 * phase.rad()).tan() / h_s.max(TINY));
    0.25 * w * phase_function * (1.0 + b_s0 * surge)
}

/// REFF(30°, 0°, 30°) of the model: the radiance factor over the cosine of incidence.
pub fn reff_30_0_30(cell: &HapkeCell) -> f64 {
    let incidence = Angle::from_deg(30.0);
    radiance_factor(cell, incidence.cos(), 1.0, incidence) / incidence.cos()
}

/// The function of Ambartsumian and Chandrasekhar for isotropic scatterers of albedo `w`, at the
/// cosine `x` above 0.
fn h_function(w: f64, x: f64) -> f64 {
    let y = (1.0 - w).sqrt();
    let r0 = (1.0 - y) / (1.0 + y);
    1.0 / (1.0 - w * x * (r0 + 0.5 * (1.0 - 2.0 * r0 * x) * ((1.0 + x) / x).ln()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Medians of the maps at 566 nm.
    const GROUND: HapkeCell = HapkeCell { w: 0.338, b: 0.233, c: 0.370, b_s0: 1.716, h_s: 0.060 };

    /// Solves `H(x) = 1 + w/2 x H(x) integral of H(y) / (x + y)`, Chandrasekhar 1960, by repetition.
    #[test]
    fn h_solves_the_equation_it_stands_for() {
        let n = 400;
        let at = |k: usize| (k as f64 + 0.5) / n as f64;
        for w in [0.1, 0.3, 0.5, 0.65] {
            let mut h = vec![1.0; n];
            for _ in 0..60 {
                h = (0..n)
                    .map(|k| {
                        let sum: f64 = (0..n).map(|m| h[m] / (at(k) + at(m))).sum();
                        1.0 / (1.0 - 0.5 * w * at(k) * sum / n as f64)
                    })
                    .collect();
            }
            for (k, wanted) in h.into_iter().enumerate() {
                let got = h_function(w, at(k));
                assert!((got / wanted - 1.0).abs() < 0.004, "{w} {}: {got}, not {wanted}", at(k));
            }
        }
        assert!((h_function(0.3, 1e-9) - 1.0).abs() < 1e-6);
    }

    /// Directions of Sun and observer over the ground: cosines and phase.
    fn pairs() -> impl Iterator<Item = (f64, f64, Angle)> {
        let angles = [0.0, 3.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0];
        let azimuths = [0.0, 1.0, 40.0, 90.0, 130.0, 179.0, 180.0];
        angles.into_iter().flat_map(move |i| {
            angles.into_iter().flat_map(move |e| {
                azimuths.into_iter().map(move |azimuth: f64| {
                    let (i, e) = (Angle::from_deg(i), Angle::from_deg(e));
                    let cos_phase =
                        i.cos() * e.cos() + i.sin() * e.sin() * azimuth.to_radians().cos();
                    (i.cos(), e.cos(), Angle::from_rad(cos_phase.clamp(-1.0, 1.0).acos()))
                })
            })
        })
    }

    #[test]
    fn light_runs_both_ways_and_is_finite() {
        for (cos_i, cos_e, phase) in pairs() {
            let there = radiance_factor(&GROUND, cos_i, cos_e, phase) / cos_i;
            let back = radiance_factor(&GROUND, cos_e, cos_i, phase) / cos_e;
            assert!(there.is_finite() && there >= 0.0);
            assert!((there - back).abs() < 1e-9 * there.max(1e-3), "{cos_i} {cos_e} {phase:?}");
            let shadowing = Facets::of(cos_i, cos_e, phase).shadowing;
            assert!((0.0..=1.1).contains(&shadowing), "{cos_i} {cos_e}: {shadowing}");
        }
        assert_eq!(radiance_factor(&GROUND, -0.1, 0.5, Angle::from_deg(100.0)), 0.0);
        assert_eq!(radiance_factor(&GROUND, 0.1, 0.0, Angle::from_deg(100.0)), 0.0);
    }

    #[test]
    fn smooth_ground_has_no_shadows() {
        for (cos_i, cos_e, phase) in pairs().filter(|(i, e, _)| i.min(*e) > 0.1) {
            let facets = Facets::with_roughness(Angle::from_deg(0.01), cos_i, cos_e, phase);
            assert!((facets.shadowing - 1.0).abs() < 2e-3, "{facets:?}");
            assert!((facets.cos_incidence - cos_i).abs() < 1e-5);
            assert!((facets.cos_emission - cos_e).abs() < 1e-5);
        }
    }

    #[test]
    fn swapping_which_ray_is_higher_is_no_step() {
        for (cos_i, cos_e, phase) in pairs().filter(|(i, e, _)| i == e && *i < 0.99) {
            let [a, b] = [-1e-9, 1e-9]
                .map(|step| radiance_factor(&GROUND, cos_i + step, cos_e - step, phase));
            assert!((a / b - 1.0).abs() < 1e-5, "{cos_i} {phase:?}: {a} {b}");
        }
    }

    #[test]
    fn the_surge_is_as_high_and_as_wide_as_it_should() {
        let plain = HapkeCell { b_s0: 0.0, ..GROUND };
        let raised =
            |phase| single_scattering(&GROUND, phase) / single_scattering(&plain, phase) - 1.0;
        assert!((raised(Angle::ZERO) - 1.716).abs() < 1e-9);
        let half = Angle::from_rad(2.0 * 0.060f64.atan());
        assert!((raised(half) - 0.858).abs() < 1e-9);
        // The lobe with 1 + c is the one that points back.
        let (back, forth) = (Angle::ZERO, Angle::from_deg(180.0));
        assert!(single_scattering(&plain, back) > 1.5 * single_scattering(&plain, forth));
        // A grain scatters all of w: the mean of 4 times this over the sphere.
        let n = 2000;
        let mean: f64 = (0..n)
            .map(|k| {
                let cos = 2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0;
                4.0 * single_scattering(&plain, Angle::from_rad(cos.acos())) / f64::from(n)
            })
            .sum();
        assert!((mean / plain.w - 1.0).abs() < 1e-4, "{mean}");
    }
}

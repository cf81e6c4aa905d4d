//! The surface law of the paper that this program descends from.
//!
//! Theory: Jensen et al. 2001, "A physically-based night sky model", eqs. 2 to 4, after Hapke 1963:
//! Lommel and Seeliger's law, a retrodirective factor and one for light scattered forwards.
//!
//! Accuracy: the integral over the disc fades as the Moon does within 20 % from 30 to 120 degrees of
//! phase; see [`lunar_brdf`].

use std::f64::consts::PI;

use crate::units::Angle;

/// Retrodirective and forward parts of Jensen et al. 2001 as fitted there.
const JENSEN_G: f64 = 0.6;
const JENSEN_T: f64 = 0.1;

/// Reflectance distribution of the lunar surface for an albedo of 1, per steradian; Jensen et al.
/// 2001, eqs. 2 to 4, after Hapke 1963. Multiply by the albedo.
///
/// Given the cosines of incidence and of reflection at the surface (0 to 1) and the phase angle: the
/// radiance is this times `cos_incidence` times the irradiance of a plane that faces the Sun. Zero
/// where the Sun or the observer is below the surface.
///
/// How we differ: eq. 2 of the paper, `1 / (1 + cos_r / cos_i)`, has the cosine of incidence folded
/// in; with `1 / (cos_i + cos_r)` it is reciprocal, and the full Moon has no limb darkening. The
/// integral over the disc at 30, 60, 90 and 120 degrees is 0.46, 0.21, 0.08 and 0.02 of that at 1
/// degree, a little slower than [`irradiance`](super::irradiance): the renderer scales the drawn disc to
/// [`disc_mean_luminance`](super::disc_mean_luminance).
pub fn lunar_brdf(cos_incidence: f64, cos_reflection: f64, phase: Angle) -> f64 {
    if cos_incidence <= 0.0 || cos_reflection <= 0.0 {
        return 0.0;
    }
    let phase = phase.abs();
    2.0 / (3.0 * PI) * retrodirective(phase) * forward(phase) / (cos_incidence + cos_reflection)
}

/// Eq. 3: the shadows that grains cast on each other vanish towards full Moon, 2 there and 1 from
/// half Moon on.
fn retrodirective(phase: Angle) -> f64 {
    let tan = phase.tan();
    // Towards full Moon the exponentials vanish and the tangent with them.
    if phase.rad() >= PI / 2.0 {
        return 1.0;
    }
    let hidden = if tan > 0.0 { (-JENSEN_G / tan).exp() } else { 0.0 };
    2.0 - tan / (2.0 * JENSEN_G) * (1.0 - hidden) * (3.0 - hidden)
}

/// Eq. 4: light scattered forwards.
fn forward(phase: Angle) -> f64 {
    let (sin, cos) = phase.sin_cos();
    let lambert = (sin + (PI - phase.rad()) * cos) / PI;
    lambert + JENSEN_T * (1.0 - 0.5 * cos).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The surface's light summed over the visible disc: the observer along z, the Sun in the xz
    /// plane.
    fn disc_integral(phase_deg: f64) -> f64 {
        let phase = Angle::from_deg(phase_deg);
        let (sin_phase, cos_phase) = phase.sin_cos();
        let n = 400;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let x = (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0;
                let y = (f64::from(j) + 0.5) / f64::from(n) * 2.0 - 1.0;
                let cos_reflection = (1.0 - x * x - y * y).max(0.0).sqrt();
                let cos_incidence = x * sin_phase + cos_reflection * cos_phase;
                sum += lunar_brdf(cos_incidence, cos_reflection, phase) * cos_incidence.max(0.0);
            }
        }
        sum * 4.0 / f64::from(n * n)
    }

    #[test]
    fn the_drawn_disc_fades_as_the_paper_has_it() {
        let full = disc_integral(1.0);
        for (phase_deg, share) in [(30.0, 0.461), (60.0, 0.212), (90.0, 0.079), (120.0, 0.023)] {
            let got = disc_integral(phase_deg) / full;
            assert!((got - share).abs() < 1.5e-3, "{phase_deg}°: {got}");
        }
    }

    #[test]
    fn the_full_moon_has_no_limb_darkening() {
        let radiance = |cos: f64| lunar_brdf(cos, cos, Angle::ZERO) * cos;
        assert!((radiance(0.05) - radiance(1.0)).abs() < 1e-12);
        // B = 2 and S = 1 + t / 4 at full phase.
        assert!((radiance(1.0) - 2.0 / (3.0 * PI) * 1.025).abs() < 1e-12);
        assert_eq!(lunar_brdf(-0.1, 0.5, Angle::from_deg(120.0)), 0.0);
        let there = lunar_brdf(0.3, 0.8, Angle::from_deg(70.0));
        assert_eq!(there, lunar_brdf(0.8, 0.3, Angle::from_deg(-70.0)), "light runs both ways");
        let quarter = |deg: f64| lunar_brdf(0.5, 0.5, Angle::from_deg(deg));
        assert!((quarter(90.0 - 1e-7) / quarter(90.0 + 1e-7) - 1.0).abs() < 1e-6);
    }
}

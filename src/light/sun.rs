//! The Sun: spectral irradiance, and how its disc darkens towards the limb.
//!
//! Spectrum: Wehrli 1985 (WMO reference, 1 nm), 133.5 klx at one astronomical unit.
//! Limb darkening: Neckel 2005, *Solar Physics* 229, 13, analytical reference functions for the
//! measurements of Neckel & Labs 1994. Spots, faculae and the 11-year variation (0.1 %) are left
//! out.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::light::spectrum::{Spectrum, shipped_column};
use crate::units::{AU_KM, SUN_RADIUS_KM};

const WEHRLI_1985: &str = include_str!("../../catalogs/spectra/solar_wehrli1985.csv");

static IRRADIANCE_1AU: LazyLock<Spectrum> = LazyLock::new(|| Spectrum::from_table(&wehrli_table()));

/// The published table: wavelength in nanometres, irradiance in W m-2 nm-1.
pub(crate) fn wehrli_table() -> Vec<(f64, f64)> {
    shipped_column(WEHRLI_1985, 1)
}

/// Spectral irradiance at one astronomical unit, W m-2 nm-1, on a plane that faces the Sun.
pub fn irradiance_1au() -> Spectrum {
    *IRRADIANCE_1AU
}

/// Spectral irradiance at a distance from the Sun's centre, W m-2 nm-1.
pub fn irradiance(distance_km: f64) -> Spectrum {
    debug_assert!(distance_km > SUN_RADIUS_KM);
    irradiance_1au() * (AU_KM / distance_km).powi(2)
}

/// Spectral radiance averaged over the disc, W m-2 sr-1 nm-1; the same at every distance.
pub fn mean_radiance() -> Spectrum {
    irradiance_1au() * (1.0 / projected_solid_angle_sr(SUN_RADIUS_KM, AU_KM))
}

/// Spectral radiance of a point of the disc, W m-2 sr-1 nm-1.
///
/// Given the cosine of the angle between the line of sight and the normal of the Sun's surface:
/// 1 at the centre, 0 at the limb; at `r` radii from the centre it is `sqrt(1 - r^2)`.
pub fn radiance(cos_emergence: f64) -> Spectrum {
    mean_radiance().weighted(|nm| {
        let law = LimbDarkening::at_nm(nm);
        law.relative_to_centre(cos_emergence) / law.disc_mean()
    })
}

/// The solid angle of a ball times the mean cosine over it, `pi (R/d)^2`: irradiance divided by
/// this is the mean radiance of the disc. For small discs it is the solid angle itself.
pub fn projected_solid_angle_sr(radius_km: f64, distance_km: f64) -> f64 {
    debug_assert!(distance_km > radius_km);
    PI * (radius_km / distance_km).powi(2)
}

/// Radiance across the disc at one wavelength: a polynomial in the cosine of emergence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimbDarkening([f64; 6]);

/// Neckel 2005: coefficient `k` is `constant + inverse / l + fifth / l^5`, `l` in micrometres.
struct Range {
    from_nm: f64,
    to_nm: f64,
    constant: [f64; 6],
    inverse: [f64; 6],
    fifth: [f64; 6],
}

const RANGES: [Range; 3] = [
    Range {
        from_nm: 303.3,
        to_nm: 372.98,
        constant: [0.35601, 1.11529, -0.67237, 0.18696, 0.00038, 0.01373],
        inverse: [-0.085217, 0.085217, 0.0, 0.0, 0.0, 0.0],
        fifth: [0.0, -0.001871, 0.003589, -0.002415, 0.000897, -0.000200],
    },
    Range {
        from_nm: 385.0,
        to_nm: 422.57,
        constant: [0.09900, 1.96884, -2.80511, 3.32780, -2.17878, 0.58825],
        inverse: [0.010643, -0.010643, 0.0, 0.0, 0.0, 0.0],
        fifth: [0.0, -0.009166, 0.024873, -0.029317, 0.018273, -0.004663],
    },
    Range {
        from_nm: 422.57,
        to_nm: 1100.0,
        constant: [0.75267, 0.93874, -1.89287, 2.42234, -1.71150, 0.49062],
        inverse: [-0.265577, 0.265577, 0.0, 0.0, 0.0, 0.0],
        fifth: [0.0, -0.004095, 0.012582, -0.017117, 0.011977, -0.003347],
    },
];

impl LimbDarkening {
    /// The law at a wavelength from 303 to 1100 nm; outside, that of the nearest end. Between 373
    /// and 385 nm, across the Balmer jump, the paper has no function: mixed linearly.
    pub fn at_nm(wavelength_nm: f64) -> Self {
        let nm = wavelength_nm.clamp(RANGES[0].from_nm, RANGES[2].to_nm);
        let (below, above) = (&RANGES[0], &RANGES[1]);
        if nm > below.to_nm && nm < above.from_nm {
            let share = (nm - below.to_nm) / (above.from_nm - below.to_nm);
            let (low, high) = (below.coefficients(below.to_nm), above.coefficients(above.from_nm));
            return LimbDarkening(std::array::from_fn(|k| {
                low[k] * (1.0 - share) + high[k] * share
            }));
        }
        let range = RANGES.iter().find(|range| nm <= range.to_nm).unwrap_or(&RANGES[2]);
        LimbDarkening(range.coefficients(nm))
    }

    /// Coefficients `a_k` of the polynomial, lowest power first.
    pub const fn coefficients(&self) -> [f64; 6] {
        self.0
    }

    /// Radiance relative to the centre of the disc.
    pub fn relative_to_centre(&self, cos_emergence: f64) -> f64 {
        debug_assert!((0.0..=1.0).contains(&cos_emergence));
        self.0.iter().rev().fold(0.0, |sum, a| sum * cos_emergence + a)
    }

    /// Mean over the disc, relative to the centre: the integral of `2 mu I(mu)`.
    pub fn disc_mean(&self) -> f64 {
        self.0.iter().enumerate().map(|(power, a)| 2.0 * a / (power as f64 + 2.0)).sum()
    }
}

impl Range {
    fn coefficients(&self, nm: f64) -> [f64; 6] {
        let inverse_um = 1000.0 / nm;
        std::array::from_fn(|k| {
            self.constant[k] + self.inverse[k] * inverse_um + self.fifth[k] * inverse_um.powi(5)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sunlight_has_its_published_totals() {
        let light = irradiance_1au().xyzv();
        assert!((light.y / 133_500.0 - 1.0).abs() < 1e-3, "{} lx", light.y);
        assert!((light.v / light.y / 2.354 - 1.0).abs() < 1e-3, "S/P {}", light.v / light.y);
        // Perihelion against aphelion: 6.9 %.
        let ratio = irradiance(0.98329 * AU_KM).xyzv().y / irradiance(1.01671 * AU_KM).xyzv().y;
        assert!((ratio - 1.0691).abs() < 1e-4, "{ratio}");
    }

    #[test]
    fn the_drawn_disc_gives_back_the_irradiance() {
        // Rings of equal area: r^2 in equal steps.
        let rings = 2000;
        let mean: f64 = (0..rings)
            .map(|k| {
                let r_squared = (k as f64 + 0.5) / rings as f64;
                radiance((1.0 - r_squared).sqrt()).at_nm(550.0) / rings as f64
            })
            .sum();
        assert!((mean / mean_radiance().at_nm(550.0) - 1.0).abs() < 1e-4, "{mean}");
        let luminance = mean_radiance().xyzv().y;
        assert!((1.95e9..1.98e9).contains(&luminance), "{luminance}");
    }

    #[test]
    fn the_limb_is_darker_and_redder() {
        for nm in [360.0, 380.0, 400.0, 450.0, 550.0, 650.0, 830.0] {
            let law = LimbDarkening::at_nm(nm);
            assert!((law.relative_to_centre(1.0) - 1.0).abs() < 2e-5, "{nm}");
            for step in 0..20 {
                let cos = f64::from(step) / 20.0;
                let (here, inwards) =
                    (law.relative_to_centre(cos), law.relative_to_centre(cos + 0.05));
                assert!(here > 0.0 && here < inwards, "{nm} nm, {cos}");
            }
        }
        // The classical linear law 1 - 0.6 (1 - cos) has 0.70 there, and a disc mean of 0.80.
        let green = LimbDarkening::at_nm(550.0);
        assert!((green.relative_to_centre(0.5) - 0.70).abs() < 0.015);
        assert!((green.disc_mean() - 0.80).abs() < 0.01);
        assert!(LimbDarkening::at_nm(450.0).disc_mean() < green.disc_mean());
    }

    #[test]
    fn the_ranges_meet() {
        for edge_nm in [372.98, 385.0, 422.57] {
            for cos in [0.2, 0.5, 0.9] {
                let below = LimbDarkening::at_nm(edge_nm - 1e-6).relative_to_centre(cos);
                let above = LimbDarkening::at_nm(edge_nm + 1e-6).relative_to_centre(cos);
                assert!((below - above).abs() < 0.01, "{edge_nm} nm, {cos}: {below} {above}");
            }
        }
    }
}

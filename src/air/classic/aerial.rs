//! Aerial perspective after Hoffman & Preetham 2002, *Rendering Outdoor Light Scattering in Real Time*,
//! Game Developers Conference; also Preetham in *Light and Color in the Outdoors*, SIGGRAPH 2003.
//!
//! Along a path of length `s` near the ground, light `L0` of what stands there becomes
//! `L0 F_ex + L_in`, with `F_ex = exp(-(bR + bM) s)` and
//! `L_in = E (bR(t) + bM(t)) / (bR + bM) (1 - F_ex)`: air of molecules (R) and haze (M) of even density,
//! lit by the Sun alone, whose irradiance `E` at the ground is the same all along, `t` the angle by
//! which its light turns.
//!
//! Changes: the formulas hold for one wavelength and are taken at each of the 95 of the grid, not for
//! three colours; scattering per kilometre is that of the air at the ground, not a slider; haze that
//! absorbs counts in `bM` and not in `bM(t)`.
//!
//! Where it fails: light of the sky and higher orders are left out, so that haze is too dark, and
//! black after sunset; and far hills do not take the colour of the sky at
//! the horizon but one of their own.

use std::f64::consts::PI;

use crate::air::Atmosphere;
use crate::air::aerosol::Aerosol;
use crate::air::cross_section::rayleigh_cross_section_m2;
use crate::air::standard::number_density_per_m3;
use crate::light::spectrum::{Spectrum, Transmittance, wavelength_nm};

/// Air near the ground, even all along.
#[derive(Debug, Clone, PartialEq)]
pub struct AerialPerspective {
    molecules_per_m3: f64,
    haze: Aerosol,
    /// Share of the haze of the whole column in a kilometre.
    haze_per_km: f64,
}

impl AerialPerspective {
    /// The air around an observer of the given height above sea level.
    pub fn new(air: &Atmosphere, height_m: f64) -> AerialPerspective {
        let height_km = height_m / 1000.0;
        AerialPerspective {
            molecules_per_m3: number_density_per_m3(height_km) * air.density_ratio_at(height_m),
            haze: air.aerosol.clone(),
            haze_per_km: air.aerosol.density_per_km(height_km, air.ground_km(height_m)),
        }
    }

    /// Extinction by molecules (`bR`) and by haze (`bM`), per kilometre.
    pub fn extinction_per_km(&self, wavelength_nm: f64) -> [f64; 2] {
        const M_PER_KM: f64 = 1000.0;
        [
            M_PER_KM * self.molecules_per_m3 * rayleigh_cross_section_m2(wavelength_nm),
            self.haze.optical_depth(wavelength_nm) * self.haze_per_km,
        ]
    }

    /// `F_ex`: the share of the light that comes through.
    pub fn through(&self, distance_km: f64) -> Transmittance {
        let depth = |node| self.depth(wavelength_nm(node), distance_km);
        Transmittance::from_optical_depths(&std::array::from_fn(depth))
    }

    /// `L_in`: radiance of the air in between, W m-2 sr-1 nm-1, by the distance, the cosine of the angle
    /// between the line of sight and the direction to the Sun, and the irradiance of the Sun at the
    /// ground on a plane that faces it, W m-2 nm-1.
    pub fn scattered_in(&self, distance_km: f64, cos_from_sun: f64, sun: &Spectrum) -> Spectrum {
        sun.weighted(|nm| {
            let [molecules, haze] = self.extinction_per_km(nm);
            let by_haze = self.haze.albedo(nm) * self.haze.phase(nm, cos_from_sun);
            let by_molecules = 3.0 / (16.0 * PI) * (1.0 + cos_from_sun.powi(2));
            let scattered = (molecules * by_molecules + haze * by_haze) / (molecules + haze);
            scattered * -(-self.depth(nm, distance_km)).exp_m1()
        })
    }

    /// What is left of a radiance at a distance, and what the air adds: `L0 F_ex + L_in`.
    pub fn seen(
        &self,
        radiance: Spectrum,
        distance_km: f64,
        cos_from_sun: f64,
        sun: &Spectrum,
    ) -> Spectrum {
        radiance * self.through(distance_km) + self.scattered_in(distance_km, cos_from_sun, sun)
    }

    fn depth(&self, wavelength_nm: f64, distance_km: f64) -> f64 {
        self.extinction_per_km(wavelength_nm).iter().sum::<f64>() * distance_km
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn molecules_dim_as_penndorf_says() {
        // Penndorf 1957, air at 15 degrees C and 1013 mbar: 0.01162 per kilometre at 550 nm. His
        // refractivity and depolarisation are older.
        let air = AerialPerspective::new(&Atmosphere::molecular(), 0.0);
        let [molecules, haze] = air.extinction_per_km(550.0);
        assert!((molecules / 0.01162 - 1.0).abs() < 0.02, "{molecules}");
        assert_eq!(haze, 0.0);
    }

    #[test]
    fn far_away_all_light_is_scattered_light() {
        let air = AerialPerspective::new(&Atmosphere::default(), 0.0);
        let sun = Spectrum::from_fn(|_| 1.0);
        let near = air.seen(sun, 0.0, 0.3, &sun);
        let far = air.seen(sun, 1e5, 0.3, &sun);
        let further = air.seen(Spectrum::DARK, 1e6, 0.3, &sun);
        assert_eq!(near, sun);
        assert_eq!(far, further);
        // Between the phase functions of haze, 0.95 of 0.0367, and of molecules, 0.0651.
        for value in far.values() {
            assert!((0.0348..0.0651).contains(value), "{value}");
        }
        // In a kilometre little is lost, and more of the blue.
        let through = air.through(1.0);
        assert!(through.values()[8] < through.values()[68] && through.values()[8] > 0.8);
    }
}

//! The air along the limb of the Earth, as sunlight passes it on its way to the Moon.
//!
//! *Rays.* One that touches a height is twice the half that an observer at that height sees level:
//! bending and columns are those of [`crate::air::refraction`] and [`crate::air::extinction`], in the
//! US Standard Atmosphere 1976 less five kelvin, with the ozone of the air that is given. A ray that
//! touches the sea is bent by 70 arcminutes.
//!
//! *Scattered light.* Looking at the limb from the Moon the Sun stands behind it, within a degree. Light
//! that is scattered once by so little runs all but the same way as the ray: whatever the place of the
//! scattering, a chord of optical depth `t`, of which `t_s` scatters with the phase function `P(0)`, has
//! the radiance `P(0) t_s exp(-t)` for an irradiance of one. It is 3e-7 of sunlight in all, which
//! matters where the umbra is darkest: in the blue. Higher orders are left out.
//!
//! *Darkness.* Danjon's number L says how dark a total eclipse is, 0 (almost invisible) to 4 (bright
//! copper or orange, with a bluish rim). What makes the difference is cloud and haze in the lower air
//! and, after eruptions, droplets about the tropopause and above (Keen 1983, *Science* 222, 1011).
//! Here, as a choice of ours between clear and volcanic states, each straight from L = 0 to L = 4:
//!
//! | | L = 0 | L = 4 |
//! |---|---|---|
//! | optical depth at 550 nm of high haze, 10 to 22 km | 0.090 | 0.003 |
//! | height up to which clouds stand in the way | 13 km | 9 km |
//! | part of the limb without them at the ground | 0.10 | 0.60 |
//!
//! The background of the stratosphere is 0.003 to 0.005; Pinatubo made 0.15 (recalled). A ray that
//! touches the lower air crosses the haze at a slant of some thirty times its depth, so that the
//! light falls by the same factor from each number to the next. Between the ground and the cloud tops the
//! part of the limb that is free grows smoothly to 1. The numbers are set so that the middle of the
//! umbra spans a millionth to a ten-thousandth of full sunlight.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::air::aerosol::{Aerosol, AerosolProfile};
use crate::air::extinction::SightLines;
use crate::air::refraction::Rays;
use crate::air::{
    AirError, Atmosphere, EARTH_RADIUS_KM, Ground, LightPaths, ObserverWeather, SEEN_NM,
};
use crate::light::spectrum::{LEN, Transmittance, wavelength_nm};
use crate::units::Angle;

/// Height above which the air neither bends nor dims, kilometres.
pub const LIMB_TOP_KM: f64 = 100.0;

/// Heights at which the distance between rays changes, and that distance below, kilometres.
const SPACING_KM: [(f64, f64); 4] = [(14.0, 0.2), (40.0, 0.5), (70.0, 1.0), (LIMB_TOP_KM, 2.0)];

/// Optical depth of the high haze at 550 nm, height of cloud tops in kilometres, and free part of the
/// limb at the ground, for L = 0 and L = 4.
const DEPTHS_550: [f64; 2] = [0.090, 0.003];
const CLOUD_TOPS_KM: [f64; 2] = [13.0, 9.0];
const FREE_AT_GROUND: [f64; 2] = [0.10, 0.60];
/// Cosine of the angle by which light turns that is scattered towards the Moon: a degree.
const FORWARD: f64 = 0.999_85;
/// Where the high haze is, kilometres.
const HAZE_KM: [f64; 2] = [10.0, 22.0];

/// Danjon's number of the darkness of a lunar eclipse: 0, very dark, to 4, bright orange.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Danjon(f64);

/// A number that is not on Danjon's scale.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "Danjon's number {0} is outside 0 to 4; give 0 for the darkest eclipse, 4 for the brightest"
)]
pub struct OutsideDanjon(f64);

impl TryFrom<f64> for Danjon {
    type Error = OutsideDanjon;
    fn try_from(number: f64) -> Result<Danjon, OutsideDanjon> {
        // Written so that NaN, which is in no range, is refused too.
        let is_inside = (0.0..=Danjon::BRIGHTEST).contains(&number);
        if is_inside { Ok(Danjon(number)) } else { Err(OutsideDanjon(number)) }
    }
}
impl From<Danjon> for f64 {
    fn from(danjon: Danjon) -> f64 {
        danjon.0
    }
}

impl Danjon {
    /// The largest number.
    pub const BRIGHTEST: f64 = 4.0;

    /// # Errors
    ///
    /// A number that is not between 0 and 4.
    pub fn new(number: f64) -> Result<Danjon, OutsideDanjon> {
        number.try_into()
    }

    /// The number itself, 0 to 4.
    pub fn number(self) -> f64 {
        self.0
    }

    fn between(self, [dark, bright]: [f64; 2]) -> f64 {
        dark + (bright - dark) * self.0 / Danjon::BRIGHTEST
    }

    /// Optical depth of the high haze at 550 nm.
    pub fn haze_depth_550(self) -> f64 {
        self.between(DEPTHS_550)
    }

    /// Part of the limb, 0 to 1, in which no cloud stands in the way of a ray that comes down to a
    /// height, kilometres.
    pub fn free_of_cloud(self, height_km: f64) -> f64 {
        let free = self.between(FREE_AT_GROUND);
        let up = (height_km / self.between(CLOUD_TOPS_KM)).clamp(0.0, 1.0);
        free + (1.0 - free) * up * up * (3.0 - 2.0 * up)
    }
}

impl Default for Danjon {
    /// 2.5: the mean of the eclipses between eruptions.
    fn default() -> Self {
        Danjon(2.5)
    }
}

/// A ray that touches a height on its way past the Earth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimbRay {
    /// Height above sea level of its lowest point, kilometres.
    pub height_km: f64,
    /// Distance from the Earth's centre at which it would pass if it were straight.
    pub impact_km: f64,
    /// How far it turns in all.
    pub bending: Angle,
    /// What is left of its light.
    pub passes: Transmittance,
    /// Radiance along it of light that the air scattered, for an irradiance of one by a Sun behind it,
    /// per steradian.
    pub scattered_sr: [f64; LEN],
}

/// Grazing rays from the sea to [`LIMB_TOP_KM`], ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct EarthLimb {
    rays: Vec<LimbRay>,
}

impl EarthLimb {
    /// Of the air its ozone counts; aerosol is that of Danjon's number, and weather is standard:
    /// the limb is elsewhere than the observer.
    ///
    /// # Errors
    ///
    /// Air that cannot be: see [`Atmosphere::validate`].
    pub fn new(air: &Atmosphere, danjon: Danjon) -> Result<EarthLimb, AirError> {
        let [bottom_km, top_km] = HAZE_KM;
        let haze = Aerosol {
            optical_depth_550: danjon.haze_depth_550(),
            angstrom_exponent: Some(1.0),
            profile: AerosolProfile::Layer { bottom_km, top_km },
            ..Aerosol::default()
        };
        let limb = Atmosphere {
            observer: ObserverWeather::default(),
            ozone: air.ozone.clone(),
            aerosol: Aerosol { optical_depth_550: 0.0, ..Aerosol::default() },
            stratospheric_aerosol: Some(haze),
            ground: Ground { height_m: Some(0.0), ..Ground::default() },
            paths: LightPaths::default(),
        };
        limb.validate()?;
        let mut rays = Vec::new();
        let mut height_km = 0.0;
        for (end_km, step_km) in SPACING_KM {
            while height_km < end_km - 0.5 * step_km {
                rays.push(ray(&limb, danjon, height_km)?);
                height_km += step_km;
            }
            height_km = end_km;
        }
        rays.push(LimbRay {
            height_km,
            impact_km: EARTH_RADIUS_KM + height_km,
            bending: Angle::ZERO,
            passes: Transmittance::CLEAR,
            scattered_sr: [0.0; LEN],
        });
        Ok(EarthLimb { rays })
    }

    /// Ascending.
    pub fn rays(&self) -> &[LimbRay] {
        &self.rays
    }
}

fn ray(air: &Atmosphere, danjon: Danjon, height_km: f64) -> Result<LimbRay, AirError> {
    /// Refractive index of air at 1013.25 mbar and 15 degrees Celsius less one, 550 nm (Ciddor 1996).
    const REFRACTIVITY: f64 = 2.778e-4;
    let height_m = 1000.0 * height_km;
    let rays = Rays::over_ground(&air.observer_air(height_m, SEEN_NM), 0.0)?;
    let kelvin = air.temperature_c_at(height_m) + 273.15;
    let density = air.pressure_mbar_at(height_m) / 1013.25 * 288.15 / kelvin;
    let columns = SightLines::over(air, height_m).columns(Angle::ZERO);
    let free = danjon.free_of_cloud(height_km);
    let (mut passes, mut scattered_sr) = ([0.0; LEN], [0.0; LEN]);
    for (node, half) in columns.optical_depths(air).into_iter().enumerate() {
        let [molecules, _, haze] = half.map(|depth| 2.0 * depth);
        passes[node] = free * (-2.0 * half.iter().sum::<f64>()).exp();
        let forward = |aerosol: &Aerosol| {
            let nm = wavelength_nm(node);
            aerosol.albedo(nm) * aerosol.phase(nm, FORWARD)
        };
        let by_haze = air.stratospheric_aerosol.as_ref().map_or(0.0, forward);
        let by_molecules = 3.0 / (16.0 * PI) * (1.0 + FORWARD * FORWARD);
        scattered_sr[node] = passes[node] * (molecules * by_molecules + haze * by_haze);
    }
    Ok(LimbRay {
        height_km,
        impact_km: (1.0 + REFRACTIVITY * density) * (EARTH_RADIUS_KM + height_km),
        bending: rays.at_apparent_altitude(Angle::ZERO) * 2.0,
        passes: Transmittance::from_fractions(passes),
        scattered_sr,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grazing_rays_are_bent_as_published() {
        let limb = EarthLimb::new(&Atmosphere::molecular(), Danjon::default()).unwrap();
        let at = |km: f64| {
            let near = |ray: &&LimbRay| (ray.height_km - km).abs() < 0.05;
            limb.rays().iter().find(near).copied().unwrap()
        };
        // Twice the horizontal refraction, 33 to 35 arcminutes; half of it every 5 to 6 km.
        assert!((64.0..72.0).contains(&at(0.0).bending.arcmin()), "{}", at(0.0).bending.arcmin());
        let half = at(12.0).bending.rad() / at(6.0).bending.rad();
        assert!((0.40..0.55).contains(&half), "{half}");
        assert!(at(80.0).bending.arcsec() < 0.5);
        assert!(limb.rays().windows(2).all(|pair| pair[0].impact_km < pair[1].impact_km));
        // Red below; within the ozone green and yellow are lost before blue.
        let low = at(6.0).passes;
        assert!(low.at_nm(670.0) > 10.0 * low.at_nm(450.0));
        let high = at(30.0).passes;
        assert!(high.at_nm(450.0) > 1.1 * high.at_nm(600.0), "{high:?}");
    }

    #[test]
    fn numbers_outside_the_scale_are_refused() {
        let message = Danjon::new(4.1).unwrap_err().to_string();
        assert!(message.starts_with("Danjon's number 4.1 is outside 0 to 4;"), "{message}");
        assert!(Danjon::new(f64::NAN).is_err());
        assert_eq!(Danjon::new(4.0).map(Danjon::number), Ok(4.0));
        assert!(toml::from_str::<std::collections::BTreeMap<String, Danjon>>("l = -1.0").is_err());
    }
}

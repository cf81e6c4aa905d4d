//! What shines on a dark night over a place and an instant: settings become lights.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use super::airglow::{self, AirglowConditions, GlowLayer};
use super::lamps::Lamps;
use super::solar_cycle;
use super::town_glow::TownLight;
use crate::frame::{Dir, Helioecliptic, Horizon, Icrs, Rot};
use crate::sky::SkyState;
use crate::units::Angle;

/// Obliquity of the ecliptic of J2000.0 (IAU 2006).
const OBLIQUITY: Angle = Angle::from_arcsec(84_381.406);

/// How the dark sky glows, as plain data; what is left out follows from the date.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct NightGlow {
    /// Flux of the Sun at 10.7 cm, solar flux units, which airglow follows: 60 to 400. Without it,
    /// that of the [solar cycle](super::solar_cycle) at the date.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solar_flux_sfu: Option<f64>,
    /// Town glow all around by the class of Bortle's scale, 1 to 9.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bortle: Option<u8>,
    /// The same by the surface brightness of the zenith of a moonless night in V, magnitudes per
    /// square arcsecond.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zenith_mag_per_arcsec2: Option<f64>,
    /// Whether the towns of the gazetteer around the place glow.
    #[serde(skip_serializing_if = "is_false")]
    pub towns: bool,
    /// The lamps of the towns.
    #[serde(skip_serializing_if = "is_usual")]
    pub lamps: Lamps,
    /// Whether airglow is the three lines of Jensen et al. 2001.
    #[serde(skip_serializing_if = "is_false")]
    pub paper: bool,
}

fn is_false(it: &bool) -> bool {
    !*it
}

fn is_usual(lamps: &Lamps) -> bool {
    *lamps == Lamps::default()
}

/// What can be wrong with a [`NightGlow`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NightGlowError {
    #[error("night.solar_flux_sfu is {0}, outside 60 to 400; choose a value inside")]
    SolarFlux(f64),
    #[error(transparent)]
    Towns(#[from] super::town_glow::TownLightError),
    #[error(
        "the glow of towns is asked for twice; give one of bortle, zenith_mag_per_arcsec2, towns"
    )]
    Twice,
}

impl NightGlow {
    /// Says what is wrong, if anything.
    pub fn validate(&self) -> Result<(), NightGlowError> {
        if let Some(flux) = self.solar_flux_sfu.filter(|flux| !(60.0..=400.0).contains(flux)) {
            return Err(NightGlowError::SolarFlux(flux));
        }
        let ways = [self.bortle.is_some(), self.zenith_mag_per_arcsec2.is_some(), self.towns];
        if ways.into_iter().filter(|way| *way).count() > 1 {
            return Err(NightGlowError::Twice);
        }
        Ok(self.town_light_all_round().validate()?)
    }

    /// Town glow from all around, if that is asked for.
    pub fn town_light_all_round(&self) -> TownLight {
        match (self.bortle, self.zenith_mag_per_arcsec2) {
            (Some(class), _) => TownLight::Bortle(class),
            (None, Some(mag_per_arcsec2)) => TownLight::Zenith { mag_per_arcsec2 },
            (None, None) => TownLight::None,
        }
    }

    /// The flux of the Sun at 10.7 cm at the date of a sky, solar flux units.
    pub fn solar_flux_sfu(&self, sky: &SkyState) -> f64 {
        let year = 2000.0 + 100.0 * sky.instant.tt.centuries_since_j2000();
        self.solar_flux_sfu.unwrap_or_else(|| solar_cycle::solar_flux_sfu(year))
    }

    /// The airglow over a sky.
    pub fn airglow(&self, sky: &SkyState) -> Vec<GlowLayer> {
        if self.paper {
            return airglow::paper_airglow();
        }
        airglow::airglow(&AirglowConditions {
            solar_flux_sfu: self.solar_flux_sfu(sky),
            month: month(sky),
            local_time_h: local_time_h(sky),
            latitude: sky.place.latitude,
        })
    }
}

/// Months since the beginning of the year, 0 to 12.
fn month(sky: &SkyState) -> f64 {
    let civil = sky.instant.utc_civil();
    let days = crate::time::days_in_month(civil.year, civil.month);
    f64::from(civil.month - 1) + f64::from(civil.day - 1) / f64::from(days)
}

/// True solar time, hours from midnight, -12 to 12.
fn local_time_h(sky: &SkyState) -> f64 {
    let (sun, latitude) = (sky.sun.dir.vector(), sky.place.latitude);
    let from_noon = (-sun.x).atan2(sun.z * latitude.cos() - sun.y * latitude.sin());
    Angle::from_rad(from_noon + std::f64::consts::PI).signed().hours()
}

/// Axes of the zodiacal light over a sky: the ecliptic of J2000.0, longitude from the Sun.
pub fn helioecliptic_from_horizon(sky: &SkyState) -> Rot<Helioecliptic, Horizon> {
    let pole: Dir<Icrs> = Dir::from_vector(DVec3::new(0.0, -OBLIQUITY.sin(), OBLIQUITY.cos()));
    let pole = (sky.horizon_from_icrs * pole).vector();
    let towards_sun = sky.sun.dir.vector().reject_from(pole).normalize();
    let horizon_from_helioecliptic = DMat3::from_cols(towards_sun, pole.cross(towards_sun), pole);
    Rot::claim(horizon_from_helioecliptic.transpose())
}

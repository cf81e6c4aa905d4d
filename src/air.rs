//! The air between the light and the eye: what it is made of.
//!
//! Three ingredients, each with its own profile of height: air molecules (Rayleigh scattering), ozone
//! (absorption), and aerosol, the haze of dust and droplets. The defaults are a clear night at sea
//! level: 300 Dobson units of ozone and an aerosol optical depth of 0.10.
//!
//! Left out: water vapour and oxygen bands (beyond 590 nm, a few per cent of the red), the
//! nitrogen dioxide of towns, clouds.

use serde::{Deserialize, Serialize};
use thiserror::Error;

pub mod aerosol;
pub mod classic;
pub mod cross_section;
pub mod extinction;
pub mod monte_carlo;
mod named;
pub mod phase;
mod ray;
pub mod refraction;
pub mod scattering;
pub mod standard;

use aerosol::Aerosol;
use refraction::{ObserverAir, Rays, Refraction};
use standard::{standard_pressure_mbar, standard_temperature_c};

/// Radius of the sphere that the air lies on, kilometres: the mean radius of the Earth.
pub const EARTH_RADIUS_KM: f64 = 6371.0;
/// Height at which the air ends for every table here, kilometres.
pub const AIR_TOP_KM: f64 = 120.0;

/// Wavelength whose refraction stands for all where one will do, in vacuum, nanometres.
pub const SEEN_NM: f64 = 550.0;

/// The air over a place, as plain data.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Atmosphere {
    pub observer: ObserverWeather,
    pub ozone: Ozone,
    /// The haze of the lower air.
    pub aerosol: Aerosol,
    /// A second layer high up: the droplets that volcanoes leave.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stratospheric_aerosol: Option<Aerosol>,
    pub ground: Ground,
    pub paths: LightPaths,
}

/// The air at the observer.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ObserverWeather {
    /// Millibars, not brought down to sea level; without it, that of the US Standard Atmosphere 1976
    /// at the height of the place. Above 0, up to 1100.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_mbar: Option<f64>,
    /// Degrees Celsius; without it, 10 at the sea and on heights as much less as in the US Standard
    /// Atmosphere 1976. -90 to 60.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature_c: Option<f64>,
    /// 0 to 1.
    pub relative_humidity: f64,
}

/// Ozone: its amount, and the triangle over height that it fills.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ozone {
    /// In the whole column, Dobson units; 0 to 1000.
    pub column_du: f64,
    /// Foot, peak and head of the layer, kilometres, ascending; 0 to 120.
    pub tent_km: [f64; 3],
}

/// The ground all around.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ground {
    /// Lambert albedo; 0 to 1.
    pub albedo: f64,
    /// Height of the land all around above sea level, metres: 0 for a mountain by the sea. Without
    /// it, land lies as high as the observer stands, and at the sea for one who flies above all
    /// mountains. -430 to 9000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
}

/// How light runs through the air.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightPaths {
    /// Whether air bends rays, and beams spread by it.
    pub refracted: bool,
    /// Whether Sun and Moon are discs that set bit by bit, not points.
    pub source_disc: bool,
}

impl Default for Ozone {
    fn default() -> Self {
        Ozone { column_du: 300.0, tent_km: [10.0, 25.0, 40.0] }
    }
}
impl Default for Ground {
    fn default() -> Self {
        Ground { albedo: 0.1, height_m: None }
    }
}
impl Default for LightPaths {
    fn default() -> Self {
        LightPaths { refracted: true, source_disc: true }
    }
}

/// What can be wrong with a description of the air.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum AirError {
    #[error("air: {what} is {value}, outside {low} to {high}; choose a value inside")]
    Range { what: String, value: f64, low: f64, high: f64 },
    #[error("air: line {line}: {message}")]
    Syntax { line: usize, message: String },
    #[error("air: none is called '{name}'; {way_out}")]
    Unknown { name: String, way_out: String },
    #[error(
        "air: {pressure_mbar} mbar at {height_m} m make air on the ground that bends light around the \
         Earth; give the pressure at the height of the observer"
    )]
    Duct { pressure_mbar: f64, height_m: f64 },
    #[error(
        "air: observer.pressure_mbar is {pressure_mbar:.4} at a height of {height_m:.0} m, more than \
         {DENSEST} times the {standard_mbar:.4} of the standard atmosphere there; give the pressure at the \
         height of the observer, or leave it out"
    )]
    Dense { pressure_mbar: f64, height_m: f64, standard_mbar: f64 },
}

/// Lowest temperature of the air that is believed, degrees Celsius.
const COLDEST_C: f64 = -90.0;

/// Height above sea level that no land exceeds, metres.
const HIGHEST_LAND_M: f64 = 9000.0;

/// Height in which the haze over the ground grows thinner by a factor e, kilometres: such that moonlit
/// skies over mountains are as bright as they were measured (0.17 magnitudes of extinction in V on Mauna
/// Kea, Krisciunas & Schaefer 1991; the ESO sky model for Paranal). Photometers of stars and the Sun find
/// less haze on the clearest nights, 0.03 to 0.05 (Patat et al. 2011).
pub const HAZE_THINS_KM: f64 = 12.0;

/// How much denser than the standard atmosphere air may be.
const DENSEST: f64 = 3.0;

impl Atmosphere {
    /// Air as it usually is in a clear night over land of a height in metres: as by default, with haze
    /// that thins by a factor e in [`HAZE_THINS_KM`]. For Paranal 0.08 at 550 nm, for Mauna Kea 0.07.
    pub fn clear_over(height_m: f64) -> Self {
        let mut air = Atmosphere::default();
        let land_km = air.ground_km(height_m);
        air.aerosol.optical_depth_550 *= (-land_km / HAZE_THINS_KM).exp();
        air
    }

    /// Air without aerosol, otherwise as by default.
    pub fn molecular() -> Self {
        Atmosphere {
            aerosol: Aerosol { optical_depth_550: 0.0, ..Aerosol::default() },
            ..Atmosphere::default()
        }
    }

    /// The same air with straight rays and parallel light.
    pub fn straight(self) -> Self {
        Atmosphere { paths: LightPaths { refracted: false, source_disc: false }, ..self }
    }

    /// The aerosols: of the lower air, of the stratosphere.
    pub fn aerosols(&self) -> [Option<&Aerosol>; 2] {
        let haze = Some(&self.aerosol);
        [haze, self.stratospheric_aerosol.as_ref()].map(|a| a.filter(|a| a.optical_depth_550 > 0.0))
    }

    /// Height above sea level of the eye of an observer, kilometres: 2 m above the ground he stands on,
    /// so that his horizon lies 2.5 arcminutes below the level.
    pub fn eye_km(&self, observer_height_m: f64) -> f64 {
        const EYE_KM: f64 = 0.002;
        (observer_height_m / 1000.0).max(self.ground_km(observer_height_m) + EYE_KM)
    }

    /// Height of the ground around an observer of the given height, kilometres above sea level.
    pub fn ground_km(&self, observer_height_m: f64) -> f64 {
        let stands_on = if observer_height_m <= HIGHEST_LAND_M { observer_height_m } else { 0.0 };
        let ground_m = self.ground.height_m.unwrap_or(stands_on).min(observer_height_m);
        (ground_m / 1000.0).max(0.0)
    }

    /// Says which number, if any, lies outside what the formulas hold for.
    pub fn validate(&self) -> Result<(), AirError> {
        let weather = &self.observer;
        let pressure = weather.pressure_mbar.unwrap_or(standard::SEA_LEVEL_PRESSURE_MBAR);
        let [foot, peak, head] = self.ozone.tent_km;
        let numbers = [
            ("observer.pressure_mbar", pressure, f64::MIN_POSITIVE, 1100.0),
            ("observer.temperature_c", weather.temperature_c.unwrap_or(0.0), COLDEST_C, 60.0),
            ("observer.relative_humidity", weather.relative_humidity, 0.0, 1.0),
            ("ozone.column_du", self.ozone.column_du, 0.0, 1000.0),
            ("ozone.tent_km[0]", foot, 0.0, AIR_TOP_KM),
            ("ozone.tent_km[1]", peak, foot, AIR_TOP_KM),
            ("ozone.tent_km[2]", head, peak.max(foot + 1.0), AIR_TOP_KM),
            ("ground.albedo", self.ground.albedo, 0.0, 1.0),
            ("ground.height_m", self.ground.height_m.unwrap_or(0.0), -430.0, HIGHEST_LAND_M),
        ];
        let aerosols = [
            ("aerosol", Some(&self.aerosol)),
            ("stratospheric_aerosol", self.stratospheric_aerosol.as_ref()),
        ];
        let numbers = numbers.map(|(what, value, low, high)| (what.to_owned(), value, low, high));
        let of_aerosols =
            aerosols.into_iter().filter_map(|(name, a)| Some(a?.ranges(name))).flatten();
        for (what, value, low, high) in numbers.into_iter().chain(of_aerosols) {
            // Written so that NaN, which is in no range, is refused too.
            if !(low..=high).contains(&value) {
                return Err(AirError::Range { what, value, low, high });
            }
        }
        Ok(())
    }

    /// Pressure at an observer of the given height, millibars.
    pub fn pressure_mbar_at(&self, height_m: f64) -> f64 {
        self.observer.pressure_mbar.unwrap_or_else(|| standard_pressure_mbar(height_m))
    }

    /// Temperature at an observer of the given height, degrees Celsius.
    pub fn temperature_c_at(&self, height_m: f64) -> f64 {
        /// By how much a usual night is colder than the standard.
        const COLDER_K: f64 = 5.0;
        let usual_c = || standard_temperature_c(height_m) - COLDER_K;
        self.observer.temperature_c.unwrap_or_else(|| usual_c().max(COLDEST_C))
    }

    /// How dense the air is over the observer, relative to the US Standard Atmosphere 1976.
    pub fn density_ratio_at(&self, height_m: f64) -> f64 {
        self.pressure_mbar_at(height_m) / standard_pressure_mbar(height_m)
    }

    /// The air at an observer of the given height, as refraction of one wavelength asks for it.
    pub fn observer_air(&self, height_m: f64, wavelength_nm: f64) -> ObserverAir {
        ObserverAir {
            height_m: 1000.0 * self.eye_km(height_m),
            pressure_mbar: self.pressure_mbar_at(height_m),
            temperature_c: self.temperature_c_at(height_m),
            relative_humidity: self.observer.relative_humidity,
            wavelength_nm,
        }
    }

    /// The refraction that an observer of the given height sees, for [`SEEN_NM`], with the horizon of
    /// the ground around him; none if rays run straight. Some milliseconds: keep it and clone it.
    ///
    /// Air that [`Atmosphere::validate_at`] refuses is given Bennett's formula instead.
    pub fn refraction_at(&self, height_m: f64) -> Refraction {
        if !self.paths.refracted {
            return Refraction::NONE;
        }
        let air = self.observer_air(height_m, SEEN_NM);
        let ground_m = 1000.0 * self.ground_km(height_m);
        Refraction::traced_over_ground(&air, ground_m)
            .unwrap_or_else(|_| Refraction::new(air.pressure_mbar, air.temperature_c))
    }

    /// [`Atmosphere::validate`], and that an observer of the given height can stand in the air and see
    /// through it.
    pub fn validate_at(&self, height_m: f64) -> Result<(), AirError> {
        self.validate()?;
        if self.density_ratio_at(height_m) > DENSEST {
            return Err(AirError::Dense {
                pressure_mbar: self.pressure_mbar_at(height_m),
                height_m,
                standard_mbar: standard_pressure_mbar(height_m),
            });
        }
        let ground_m = 1000.0 * self.ground_km(height_m);
        match self.paths.refracted {
            true => Rays::over_ground(&self.observer_air(height_m, SEEN_NM), ground_m).map(|_| ()),
            false => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::aerosol::PhaseLaw;
    use super::*;

    #[test]
    fn the_default_is_valid_and_survives_a_file() {
        let air = Atmosphere::default();
        air.validate().unwrap();
        let text = toml::to_string(&air).unwrap();
        assert_eq!(toml::from_str::<Atmosphere>(&text).unwrap(), air);
        let air: Atmosphere =
            toml::from_str("ozone.column_du = 250\nobserver.pressure_mbar = 780").unwrap();
        assert_eq!((air.ozone.column_du, air.pressure_mbar_at(0.0)), (250.0, 780.0));
        assert!(toml::from_str::<Atmosphere>("ozone.column = 250").is_err());
    }

    #[test]
    fn impossible_air_is_refused_by_name() {
        let ground = Ground { albedo: 1.2, ..Ground::default() };
        let air = Atmosphere { ground, ..Atmosphere::default() };
        let message = air.validate().unwrap_err().to_string();
        assert_eq!(message, "air: ground.albedo is 1.2, outside 0 to 1; choose a value inside");
        let mut airs = [(); 3].map(|()| Atmosphere::default());
        airs[0].ozone.column_du = f64::NAN;
        airs[1].observer.pressure_mbar = Some(0.0);
        airs[2].aerosol.phase = PhaseLaw::HenyeyGreenstein { g: 1.0 };
        for air in airs {
            assert!(air.validate().is_err(), "{air:?}");
        }
    }
}

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

pub mod extinction;
mod ray;
pub mod refraction;
pub mod scattering;
pub mod standard;

use refraction::Refraction;
use standard::standard_pressure_mbar;

/// Radius of the sphere that the air lies on, kilometres: the mean radius of the Earth.
pub const EARTH_RADIUS_KM: f64 = 6371.0;
/// Height at which the air ends for every table here, kilometres.
pub const AIR_TOP_KM: f64 = 120.0;

/// The air over a place, as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Atmosphere {
    /// Aerosol optical depth of the whole column above sea level at 550 nm: 0.02 on a mountain
    /// night, 0.1 on a clear one, 0.5 in haze. 0 to 3.
    pub aerosol_optical_depth_550: f64,
    /// Exponent `a` of Angstrom's law, optical depth as `(l / 550 nm)^-a`; -1 to 4.
    pub angstrom_exponent: f64,
    /// Height over which the aerosol falls by a factor e, kilometres; 0.5 to 10.
    pub aerosol_scale_height_km: f64,
    /// Fraction of the light removed by aerosol that is scattered, not absorbed; 0 to 1.
    pub aerosol_single_scattering_albedo: f64,
    /// Asymmetry `g` of the Henyey-Greenstein phase function of the aerosol; -0.9 to 0.9.
    pub aerosol_asymmetry: f64,
    /// Ozone in the whole column, Dobson units; 0 to 1000.
    pub ozone_du: f64,
    /// Lambert albedo of the ground all around; 0 to 1.
    pub ground_albedo: f64,
    /// Pressure at the observer, millibars; without it, that of the US Standard Atmosphere 1976 at
    /// the height of the place. Above 0, up to 1100.
    pub pressure_mbar: Option<f64>,
    /// Temperature at the observer, degrees Celsius; -90 to 60.
    pub temperature_c: f64,
}

impl Default for Atmosphere {
    fn default() -> Self {
        Atmosphere {
            aerosol_optical_depth_550: 0.10,
            angstrom_exponent: 1.3,
            aerosol_scale_height_km: 1.2,
            aerosol_single_scattering_albedo: 0.95,
            aerosol_asymmetry: 0.7,
            ozone_du: 300.0,
            ground_albedo: 0.1,
            pressure_mbar: None,
            temperature_c: 10.0,
        }
    }
}

/// What can be wrong with a description of the air.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum AirError {
    #[error("air: {what} is {value}, outside {low} to {high}; choose a value inside")]
    Range { what: &'static str, value: f64, low: f64, high: f64 },
    #[error(
        "air: {pressure_mbar} mbar at {height_m} m make air on the ground that bends light around the \
         Earth; give the pressure at the height of the observer"
    )]
    Duct { pressure_mbar: f64, height_m: f64 },
}

impl Atmosphere {
    /// Air without aerosol, otherwise as by default.
    pub fn molecular() -> Self {
        Atmosphere { aerosol_optical_depth_550: 0.0, ..Atmosphere::default() }
    }

    /// Says which number, if any, lies outside what the formulas hold for.
    pub fn validate(&self) -> Result<(), AirError> {
        // The harmonics of the scattering solver do not follow sharper peaks.
        const MOST_ASYMMETRIC: f64 = 0.9;
        let pressure = self.pressure_mbar.unwrap_or(standard::SEA_LEVEL_PRESSURE_MBAR);
        let checks = [
            ("aerosol_optical_depth_550", self.aerosol_optical_depth_550, 0.0, 3.0),
            ("angstrom_exponent", self.angstrom_exponent, -1.0, 4.0),
            ("aerosol_scale_height_km", self.aerosol_scale_height_km, 0.5, 10.0),
            ("aerosol_single_scattering_albedo", self.aerosol_single_scattering_albedo, 0.0, 1.0),
            ("aerosol_asymmetry", self.aerosol_asymmetry, -MOST_ASYMMETRIC, MOST_ASYMMETRIC),
            ("ozone_du", self.ozone_du, 0.0, 1000.0),
            ("ground_albedo", self.ground_albedo, 0.0, 1.0),
            ("pressure_mbar", pressure, f64::MIN_POSITIVE, 1100.0),
            ("temperature_c", self.temperature_c, -90.0, 60.0),
        ];
        for (what, value, low, high) in checks {
            // Written so that NaN, which is in no range, is refused too.
            if !(low..=high).contains(&value) {
                return Err(AirError::Range { what, value, low, high });
            }
        }
        Ok(())
    }

    /// Pressure at an observer of the given height, millibars.
    pub fn pressure_mbar_at(&self, height_m: f64) -> f64 {
        self.pressure_mbar.unwrap_or_else(|| standard_pressure_mbar(height_m))
    }

    /// How dense the air is over the observer, relative to the US Standard Atmosphere 1976.
    pub fn density_ratio_at(&self, height_m: f64) -> f64 {
        self.pressure_mbar_at(height_m) / standard_pressure_mbar(height_m)
    }

    /// The refraction that an observer of the given height sees.
    pub fn refraction_at(&self, height_m: f64) -> Refraction {
        Refraction::new(self.pressure_mbar_at(height_m), self.temperature_c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_valid_and_survives_a_file() {
        let air = Atmosphere::default();
        air.validate().unwrap();
        let text = toml::to_string(&air).unwrap();
        assert_eq!(toml::from_str::<Atmosphere>(&text).unwrap(), air);
        let air: Atmosphere = toml::from_str("ozone_du = 250\npressure_mbar = 780").unwrap();
        assert_eq!((air.ozone_du, air.pressure_mbar_at(0.0)), (250.0, 780.0));
        assert!(toml::from_str::<Atmosphere>("ozone = 250").is_err());
    }

    #[test]
    fn impossible_air_is_refused_by_name() {
        let air = Atmosphere { ground_albedo: 1.2, ..Atmosphere::default() };
        let message = air.validate().unwrap_err().to_string();
        assert_eq!(message, "air: ground_albedo is 1.2, outside 0 to 1; choose a value inside");
        for air in [
            Atmosphere { ozone_du: f64::NAN, ..Atmosphere::default() },
            Atmosphere { pressure_mbar: Some(0.0), ..Atmosphere::default() },
            Atmosphere { aerosol_asymmetry: 1.0, ..Atmosphere::default() },
        ] {
            assert!(air.validate().is_err(), "{air:?}");
        }
    }
}

//! Aerosol: dust and droplets, how much of them and what they do to light.

use serde::{Deserialize, Serialize};

/// The harmonics of the scattering solver do not follow sharper peaks.
const MOST_ASYMMETRIC: f64 = 0.9;
/// Above this, the exponential profile holds no aerosol, kilometres.
const EXPONENTIAL_TOP_KM: f64 = 30.0;

/// One aerosol.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Aerosol {
    /// Optical depth of the whole column above sea level at 550 nm: 0.02 on a mountain night, 0.1
    /// on a clear one, 0.5 in haze. 0 to 3.
    pub optical_depth_550: f64,
    /// Exponent `a` of Angstrom's law, optical depth as `(l / 550 nm)^-a`; -1 to 4.
    pub angstrom_exponent: f64,
    /// Fraction of the light removed that is scattered, not absorbed; 0 to 1.
    pub single_scattering_albedo: f64,
    /// Height over which it falls by a factor e, kilometres; 0.5 to 10.
    pub scale_height_km: f64,
    /// Asymmetry `g` of the Henyey-Greenstein phase function; -0.9 to 0.9.
    pub asymmetry: f64,
}

impl Default for Aerosol {
    fn default() -> Self {
        Aerosol {
            optical_depth_550: 0.10,
            angstrom_exponent: 1.3,
            single_scattering_albedo: 0.95,
            scale_height_km: 1.2,
            asymmetry: 0.7,
        }
    }
}

impl Aerosol {
    /// Name, value and allowed range of every number.
    pub(crate) fn ranges(&self) -> Vec<(&'static str, f64, f64, f64)> {
        vec![
            ("aerosol.optical_depth_550", self.optical_depth_550, 0.0, 3.0),
            ("aerosol.angstrom_exponent", self.angstrom_exponent, -1.0, 4.0),
            ("aerosol.single_scattering_albedo", self.single_scattering_albedo, 0.0, 1.0),
            ("aerosol.scale_height_km", self.scale_height_km, 0.5, 10.0),
            ("aerosol.asymmetry", self.asymmetry, -MOST_ASYMMETRIC, MOST_ASYMMETRIC),
        ]
    }

    /// Optical depth of the whole column above sea level.
    pub fn optical_depth(&self, wavelength_nm: f64) -> f64 {
        self.optical_depth_550 * (wavelength_nm / 550.0).powf(-self.angstrom_exponent)
    }

    /// Fraction of the light removed that is scattered.
    pub fn albedo(&self, _wavelength_nm: f64) -> f64 {
        self.single_scattering_albedo
    }

    /// Phase function, per steradian, 1 over the sphere; by the cosine of the angle by which light
    /// turns.
    pub fn phase(&self, _wavelength_nm: f64, cosine: f64) -> f64 {
        super::scattering::phase::henyey_greenstein(self.asymmetry, cosine)
    }

    /// Legendre moment of the phase function.
    pub fn moment(&self, _wavelength_nm: f64, l: usize) -> f64 {
        super::scattering::phase::henyey_greenstein_moment(self.asymmetry, l)
    }

    /// Share of the whole column in a kilometre at a height above sea level.
    pub fn density_per_km(&self, height_km: f64) -> f64 {
        if height_km > EXPONENTIAL_TOP_KM {
            return 0.0;
        }
        (-height_km / self.scale_height_km).exp() / self.scale_height_km
    }
}

//! Aerosol: dust and droplets, how much of them and what they do to light.
//!
//! An amount (optical depth at 550 nm), a law of wavelength (Angstrom's), a share that is scattered,
//! a profile of height and a phase function: five fields of a file.

mod kind;
mod law;
mod profile;

use serde::{Deserialize, Serialize};

pub use kind::MieKind;
pub use law::PhaseLaw;
pub use profile::AerosolProfile;

/// Angstrom's exponent of an aerosol whose file does not tell it: continental haze (Angstrom 1929).
const USUAL_ANGSTROM_EXPONENT: f64 = 1.3;
/// Albedo of an aerosol whose file does not tell it.
const USUAL_ALBEDO: f64 = 0.95;

/// A field by its path in the file, its value, and the range it must be in.
pub(crate) type Checked = (String, f64, f64, f64);

/// One aerosol.
///
/// Between Rust structs mind that [`Aerosol::default`] gives exponent and albedo: a Mie kind that is
/// to have its own wants `None` for both ([`Aerosol::mie`]).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Aerosol {
    /// Optical depth of the whole column above the ground at 550 nm: 0.02 in the cleanest nights, 0.1 in
    /// clear ones, 0.5 in haze. 0 to 3.
    pub optical_depth_550: f64,
    /// Exponent `a` of Angstrom's law, optical depth as `(l / 550 nm)^-a`; -1 to 4. Without it, a
    /// Mie kind has its own law, everything else 1.3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angstrom_exponent: Option<f64>,
    /// Fraction of the light removed that is scattered, not absorbed; 0 to 1. Without it, a Mie
    /// kind has its own, by wavelength, everything else 0.95.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub single_scattering_albedo: Option<f64>,
    /// How it lies over height.
    pub profile: AerosolProfile,
    /// How it scatters.
    pub phase: PhaseLaw,
}

impl Default for Aerosol {
    fn default() -> Self {
        Aerosol {
            optical_depth_550: 0.10,
            angstrom_exponent: Some(USUAL_ANGSTROM_EXPONENT),
            single_scattering_albedo: Some(USUAL_ALBEDO),
            profile: AerosolProfile::Exponential { scale_height_km: 1.2 },
            phase: PhaseLaw::HenyeyGreenstein { g: 0.7 },
        }
    }
}

impl Aerosol {
    /// A shipped kind with its own extinction and albedo, in the profile of the default.
    pub fn mie(kind: MieKind, optical_depth_550: f64) -> Aerosol {
        Aerosol {
            optical_depth_550,
            angstrom_exponent: None,
            single_scattering_albedo: None,
            phase: PhaseLaw::Mie { kind },
            ..Aerosol::default()
        }
    }

    /// Path, value and allowed range of every number; `name` is the path of the aerosol.
    pub(crate) fn ranges(&self, name: &str) -> Vec<Checked> {
        let exponent = self.angstrom_exponent.unwrap_or(USUAL_ANGSTROM_EXPONENT);
        let albedo = self.single_scattering_albedo.unwrap_or(USUAL_ALBEDO);
        let mut ranges = vec![
            (format!("{name}.optical_depth_550"), self.optical_depth_550, 0.0, 3.0),
            (format!("{name}.angstrom_exponent"), exponent, -1.0, 4.0),
            (format!("{name}.single_scattering_albedo"), albedo, 0.0, 1.0),
        ];
        ranges.extend(self.profile.ranges(&format!("{name}.profile")));
        ranges.extend(self.phase.ranges(&format!("{name}.phase")));
        ranges
    }

    /// Optical depth of the whole column above sea level.
    pub fn optical_depth(&self, wavelength_nm: f64) -> f64 {
        let relative = match (self.angstrom_exponent, &self.phase) {
            (None, PhaseLaw::Mie { kind }) => kind.table().extinction(wavelength_nm),
            (exponent, _) => {
                (wavelength_nm / 550.0).powf(-exponent.unwrap_or(USUAL_ANGSTROM_EXPONENT))
            }
        };
        self.optical_depth_550 * relative
    }

    /// Fraction of the light removed that is scattered.
    pub fn albedo(&self, wavelength_nm: f64) -> f64 {
        match (self.single_scattering_albedo, &self.phase) {
            (None, PhaseLaw::Mie { kind }) => kind.table().albedo(wavelength_nm),
            (albedo, _) => albedo.unwrap_or(USUAL_ALBEDO),
        }
    }

    /// Phase function, per steradian, 1 over the sphere; by the cosine of the angle by which light
    /// turns.
    pub fn phase(&self, wavelength_nm: f64, cosine: f64) -> f64 {
        self.phase.value(wavelength_nm, cosine)
    }

    /// Legendre moment of the phase function.
    pub fn moment(&self, wavelength_nm: f64, l: usize) -> f64 {
        self.phase.moment(wavelength_nm, l)
    }

    /// Share of the whole column in a kilometre at a height above sea level, over ground of a height:
    /// what falls exponentially lies on the ground, a layer lies above the sea.
    pub fn density_per_km(&self, height_km: f64, ground_km: f64) -> f64 {
        match self.profile {
            AerosolProfile::Exponential { .. } => {
                self.profile.density_per_km(height_km - ground_km)
            }
            AerosolProfile::Layer { .. } => self.profile.density_per_km(height_km),
        }
    }
}

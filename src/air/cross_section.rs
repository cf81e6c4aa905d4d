//! Cross-sections of molecules of air and of ozone.
//!
//! Air scatters after Bodhaine et al. 1999, *J. Atmos. Oceanic Technol.* 16, 1854, eq. 29; ozone
//! absorbs after Serdyuchenko et al. 2014, *Atmos. Meas. Tech.* 7, 625, at 233 K.

use std::sync::LazyLock;

use crate::light::spectrum::{interpolate, shipped_column};

/// Molecules in a column of one Dobson unit, per square metre: 10 micrometres of gas at 273.15 K and
/// 101 325 Pa.
pub const DOBSON_UNIT_PER_M2: f64 = 2.686_78e20;

/// Scattering cross-section of a molecule of air, square metres; Bodhaine et al. 1999, eq. 29,
/// 250 to 850 nm.
pub fn rayleigh_cross_section_m2(wavelength_nm: f64) -> f64 {
    let um_squared = (wavelength_nm / 1000.0).powi(2);
    let above = 1.045_599_6 - 341.290_61 / um_squared - 0.902_308_50 * um_squared;
    let below = 1.0 + 0.002_705_988_9 / um_squared - 85.968_563 * um_squared;
    1e-32 * above / below
}

const OZONE: &str = include_str!("../../catalogs/spectra/ozone_xsec_serdyuchenko_10nm.csv");
static OZONE_TABLE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| shipped_column(OZONE, 1));

/// Absorption cross-section of an ozone molecule at 233 K, square metres: means over 10 nm, straight
/// between, 360 to 830 nm, zero outside.
pub fn ozone_cross_section_m2(wavelength_nm: f64) -> f64 {
    interpolate(&OZONE_TABLE, wavelength_nm)
}

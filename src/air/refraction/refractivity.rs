//! How much moist air bends light: the refractive index at one pressure, temperature, humidity and
//! wavelength.
//!
//! *Theory.* Ciddor 1996, *Applied Optics* 35, 1566: dry air and water vapour each have a
//! refractivity at a standard density (eqs. 1 to 3), and each contributes in proportion to its own
//! density, which the equation of state of BIPM 1981/91 gives (eqs. 4 to 12 and appendix). 450 parts
//! per million of carbon dioxide, for which eq. 2 is unity.
//!
//! *Accuracy.* The author's: 5e-8 of the index at 300 to 1690 nm, -40 to 100 degrees Celsius, 800 to
//! 1200 mbar, any humidity; 1.5e-4 of the refractivity, 0.01" of the refraction at 45 degrees. Outside
//! these ranges the formula is carried on: it tends to the law of ideal gases.

/// Molar gas constant as the equation of state was written with it, J / (mol K).
const GAS_J_MOL_K: f64 = 8.314_510;
/// Molar masses of dry air with 450 ppm of carbon dioxide (Ciddor's eq. for `M_a`) and of water, kg.
pub(super) const DRY_AIR_KG_MOL: f64 = 0.028_963_5 + 12.011e-9 * 50.0;
pub(super) const WATER_KG_MOL: f64 = 0.018_015;

/// Refractivity `(dry (p - e) + vapour e) / T` of air at pressure `p` with vapour of pressure `e`, in
/// millibars, at `T` kelvin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Refractivity {
    pub dry_k_per_mbar: f64,
    pub vapour_k_per_mbar: f64,
}

impl Refractivity {
    /// Exact at the given pressure, temperature and pressure of vapour; nearby the air is taken for
    /// an ideal gas, which is 0.04 % off where it is thin.
    pub fn at(
        wavelength_nm: f64,
        pressure_mbar: f64,
        temperature_k: f64,
        vapour_mbar: f64,
    ) -> Refractivity {
        const PA_PER_MBAR: f64 = 100.0;
        let waves_squared = (1000.0 / wavelength_nm).powi(2);
        let (dry, vapour) = (standard_dry_air(waves_squared), standard_vapour(waves_squared));
        let per_kg_m3 = |refractivity: f64, molar_kg: f64, pa: f64, k: f64, share: f64| {
            refractivity * compressibility(pa, k, share) * GAS_J_MOL_K * k / (pa * molar_kg)
        };
        let dry_m3_kg = per_kg_m3(dry, DRY_AIR_KG_MOL, 101_325.0, 288.15, 0.0);
        let vapour_m3_kg = per_kg_m3(vapour, WATER_KG_MOL, 1333.0, 293.15, 1.0);
        let share = if pressure_mbar > 0.0 { vapour_mbar / pressure_mbar } else { 0.0 };
        let gas = compressibility(pressure_mbar * PA_PER_MBAR, temperature_k, share) * GAS_J_MOL_K;
        Refractivity {
            dry_k_per_mbar: dry_m3_kg * DRY_AIR_KG_MOL / gas * PA_PER_MBAR,
            vapour_k_per_mbar: vapour_m3_kg * WATER_KG_MOL / gas * PA_PER_MBAR,
        }
    }

    /// Refractive index less one.
    pub fn of(&self, pressure_mbar: f64, vapour_mbar: f64, temperature_k: f64) -> f64 {
        let dry_mbar = pressure_mbar - vapour_mbar;
        (self.dry_k_per_mbar * dry_mbar + self.vapour_k_per_mbar * vapour_mbar) / temperature_k
    }
}

/// Pressure of the water vapour in air of a relative humidity of 0 to 1, millibars. Over water, also
/// where there would be ice (Giacomo 1982, *Metrologia* 18, 33, as Ciddor 1996 has it).
pub(super) fn vapour_mbar(pressure_mbar: f64, temperature_k: f64, humidity: f64) -> f64 {
    let (k, c, pa) = (temperature_k, temperature_k - 273.15, pressure_mbar * 100.0);
    let saturation_pa =
        (1.237_884_7e-5 * k * k - 1.912_131_6e-2 * k + 33.937_110_47 - 6.343_164_5e3 / k).exp();
    let enhancement = 1.000_62 + 3.14e-8 * pa + 5.6e-7 * c * c;
    humidity * enhancement * saturation_pa / 100.0
}

/// Refractivity of dry air at 15 degrees Celsius and 101325 Pa, given the squared number of waves in
/// a micrometre of vacuum (Ciddor 1996, eq. 1).
fn standard_dry_air(waves_squared: f64) -> f64 {
    1e-8 * (5_792_105.0 / (238.018_5 - waves_squared) + 167_917.0 / (57.362 - waves_squared))
}

/// Refractivity of water vapour at 20 degrees Celsius and 1333 Pa (Ciddor 1996, eq. 3).
fn standard_vapour(waves_squared: f64) -> f64 {
    let s = waves_squared;
    1.022e-8 * (295.235 + s * (2.6422 + s * (-0.032_380 + s * 0.004_028)))
}

/// How much less room moist air takes than an ideal gas; `share` is that of the molecules of vapour
/// (Ciddor 1996, eq. 12).
fn compressibility(pressure_pa: f64, temperature_k: f64, share: f64) -> f64 {
    let c = temperature_k - 273.15;
    let pa_per_k = pressure_pa / temperature_k;
    let first = 1.581_23e-6 - 2.9331e-8 * c
        + 1.1043e-10 * c * c
        + (5.707e-6 - 2.051e-8 * c) * share
        + (1.9898e-4 - 2.376e-6 * c) * share * share;
    let second = 1.83e-11 - 0.765e-8 * share * share;
    1.0 - pa_per_k * (first - pa_per_k * second)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `ref_index.ciddor` 1.0, an independent program after the same paper: wavelength in nm, degrees
    /// Celsius, Pa, relative humidity, index less one. It has another digit of the gas constant.
    #[test]
    fn indices_are_those_of_the_paper() {
        for (nm, c, pa, humidity, wanted) in [
            (633.0, 20.0, 101_325.0, 0.5, 2.713_727_468e-4),
            (633.0, 20.0, 100_000.0, 0.0, 2.682_443_331e-4),
            (590.0, 15.0, 101_325.0, 0.0, 2.771_362_999e-4),
            (550.0, 6.85, 67_890.0, 0.9, 1.912_228_302e-4),
            (450.0, 30.0, 101_325.0, 0.8, 2.654_522_264e-4),
        ] {
            let (mbar, k) = (pa / 100.0, c + 273.15);
            let vapour = vapour_mbar(mbar, k, humidity);
            let got = Refractivity::at(nm, mbar, k, vapour).of(mbar, vapour, k);
            assert!((got / wanted - 1.0).abs() < 1e-6, "{nm} nm, {c} °C: {got:e}");
        }
    }

    #[test]
    fn vapour_is_that_of_the_tables() {
        // Saturation pressures (Smithsonian Meteorological Tables, 6th ed., table 94): mbar.
        for (c, mbar) in [(0.0, 6.108), (20.0, 23.37), (40.0, 73.78)] {
            let got = vapour_mbar(1000.0, c + 273.15, 1.0);
            assert!((got / mbar - 1.0).abs() < 6e-3, "{c} °C: {got}");
        }
        assert_eq!(vapour_mbar(1000.0, 293.15, 0.0), 0.0);
    }
}

//! US Standard Atmosphere 1976: temperature, pressure and number density against height.
//!
//! Source: NOAA/NASA/USAF 1976, NOAA-S/T 76-1562, tables 2 and 4 and eqs. 18, 23, 33a, 33b. Exact to
//! 86 km (the mean molecular weight changes by 0.04 % between 80 and 86 km: ignored). Above, an
//! isothermal tail of 187 K stands in for the real one: it holds 4 millionths of the air.

/// Pressure at sea level, millibars.
pub const SEA_LEVEL_PRESSURE_MBAR: f64 = 1013.25;

/// Zero of the Celsius scale, kelvin.
pub(super) const ICE_POINT_K: f64 = 273.15;

/// Radius that turns geometric into geopotential height, kilometres.
const GEOPOTENTIAL_RADIUS_KM: f64 = 6356.766;
/// `g0 M0 / R*`, kelvin per geopotential kilometre.
pub(super) const HYDROSTATIC_K_PER_KM: f64 = 34.163_195;
/// Boltzmann constant, J/K (SI 2019, exact).
const BOLTZMANN_J_K: f64 = 1.380_649e-23;

/// Base of a layer: geopotential height (km), temperature (K), its slope (K/km), pressure (mbar).
#[derive(Debug, Clone, Copy)]
pub(super) struct Layer {
    pub base_km: f64,
    pub base_k: f64,
    pub slope_k_per_km: f64,
    pub base_mbar: f64,
}

const fn layer(base_km: f64, base_k: f64, slope_k_per_km: f64, base_mbar: f64) -> Layer {
    Layer { base_km, base_k, slope_k_per_km, base_mbar }
}

pub(super) const LAYERS: [Layer; 8] = [
    layer(0.0, 288.15, -6.5, SEA_LEVEL_PRESSURE_MBAR),
    layer(11.0, 216.65, 0.0, 226.320_6),
    layer(20.0, 216.65, 1.0, 54.748_89),
    layer(32.0, 228.65, 2.8, 8.680_187),
    layer(47.0, 270.65, 0.0, 1.109_063),
    layer(51.0, 270.65, -2.8, 0.669_388_7),
    layer(71.0, 214.65, -2.0, 0.039_564_20),
    layer(84.852, 186.946, 0.0, 0.003_733_8),
];

pub(super) fn geopotential_km(height_km: f64) -> f64 {
    GEOPOTENTIAL_RADIUS_KM * height_km / (GEOPOTENTIAL_RADIUS_KM + height_km)
}

/// Slope of the geopotential height against the geometric one.
pub(super) fn geopotential_slope(height_km: f64) -> f64 {
    (GEOPOTENTIAL_RADIUS_KM / (GEOPOTENTIAL_RADIUS_KM + height_km)).powi(2)
}

/// Number of the layer, lowest first.
pub(super) fn layer_at(geopotential_km: f64) -> usize {
    let above = LAYERS.partition_point(|layer| layer.base_km <= geopotential_km);
    // What lies below the sea continues the lowest layer.
    above.max(1) - 1
}

impl Layer {
    pub fn temperature_k(&self, geopotential_km: f64) -> f64 {
        self.base_k + self.slope_k_per_km * (geopotential_km - self.base_km)
    }
}

/// Temperature (K) and pressure (mbar) at a geometric height above sea level, kilometres.
fn temperature_and_pressure(height_km: f64) -> (f64, f64) {
    let geopotential_km = geopotential_km(height_km);
    let layer = &LAYERS[layer_at(geopotential_km)];
    let rise_km = geopotential_km - layer.base_km;
    let temperature_k = layer.temperature_k(geopotential_km);
    let pressure_ratio = if layer.slope_k_per_km == 0.0 {
        (-HYDROSTATIC_K_PER_KM * rise_km / layer.base_k).exp()
    } else {
        (layer.base_k / temperature_k).powf(HYDROSTATIC_K_PER_KM / layer.slope_k_per_km)
    };
    (temperature_k, layer.base_mbar * pressure_ratio)
}

/// Temperature at a geometric height above sea level, degrees Celsius; -0.5 to 120 km.
pub fn standard_temperature_c(height_m: f64) -> f64 {
    temperature_and_pressure(height_m / 1000.0).0 - ICE_POINT_K
}

/// Pressure at a geometric height above sea level, millibars; -0.5 to 120 km.
pub fn standard_pressure_mbar(height_m: f64) -> f64 {
    temperature_and_pressure(height_m / 1000.0).1
}

/// Molecules per cubic metre at a geometric height above sea level, kilometres; -0.5 to 120 km.
pub fn number_density_per_m3(height_km: f64) -> f64 {
    /// Pascals in a millibar.
    const PA: f64 = 100.0;
    let (temperature_k, pressure_mbar) = temperature_and_pressure(height_km);
    pressure_mbar * PA / (BOLTZMANN_J_K * temperature_k)
}

/// How fast the logarithm of the number density changes with height, per kilometre; negative.
pub fn logarithmic_density_slope_per_km(height_km: f64) -> f64 {
    let geopotential_km = geopotential_km(height_km);
    let layer = &LAYERS[layer_at(geopotential_km)];
    let per_geopotential_km =
        -(HYDROSTATIC_K_PER_KM + layer.slope_k_per_km) / layer.temperature_k(geopotential_km);
    per_geopotential_km * geopotential_slope(height_km)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_join() {
        for layer in &LAYERS[1..] {
            let height_km =
                layer.base_km * GEOPOTENTIAL_RADIUS_KM / (GEOPOTENTIAL_RADIUS_KM - layer.base_km);
            let (below_k, below) = temperature_and_pressure(height_km - 1e-9);
            let (above_k, above) = temperature_and_pressure(height_km + 1e-9);
            assert!((below / above - 1.0).abs() < 2e-5, "{} km: {below} {above}", layer.base_km);
            assert!((below_k - above_k).abs() < 1e-3, "{} km", layer.base_km);
        }
    }

    #[test]
    fn published_heights_have_their_pressures_and_densities() {
        // Tables 1 and 3 of the standard, geometric heights: mbar.
        for (height_m, mbar) in [
            (0.0, 1013.25),
            (2000.0, 795.01),
            (5000.0, 540.48),
            (10_000.0, 264.99),
            (30_000.0, 11.970),
        ] {
            let got = standard_pressure_mbar(height_m);
            assert!((got / mbar - 1.0).abs() < 1e-4, "{height_m} m: {got}");
        }
        assert!((standard_pressure_mbar(-400.0) - 1062.0).abs() < 1.0);
        for (height_km, per_m3) in [(0.0, 2.5470e25), (20.0, 1.8486e24), (80.0, 3.8378e20)] {
            let got = number_density_per_m3(height_km);
            assert!((got / per_m3 - 1.0).abs() < 1e-3, "{height_km} km: {got:e}");
        }
    }

    #[test]
    fn the_slope_is_that_of_the_density() {
        let step_km = 1e-4;
        for height_km in [0.0, 5.0, 15.0, 25.0, 40.0, 49.0, 60.0, 80.0, 100.0] {
            let (above, below) = (
                number_density_per_m3(height_km + step_km),
                number_density_per_m3(height_km - step_km),
            );
            let slope = (above / below).ln() / (2.0 * step_km);
            let got = logarithmic_density_slope_per_km(height_km);
            assert!((got / slope - 1.0).abs() < 1e-6, "{height_km} km: {got} {slope}");
        }
    }
}

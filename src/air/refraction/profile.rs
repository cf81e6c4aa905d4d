//! The air over an observer, as refraction needs it: refractivity against height.
//!
//! *Theory.* Temperature as in the US Standard Atmosphere 1976, warmer or colder by the same amount
//! at every height, so that it is right at the observer; pressure in hydrostatic balance with it.
//! Water vapour falls in the troposphere as the power 18.36 of the temperature (Hohenkerk & Sinclair
//! 1985, *NAO Technical Note* 63, which has the closed form of the pressure); above it, or if the
//! observer is above it, vapour keeps its share of the molecules.
//!
//! *What is left out.* Inversions, the weather, the latitude (gravity by 0.3 %, the curvature of the
//! ground by 0.3 %).

use super::refractivity::{DRY_AIR_KG_MOL, Refractivity, WATER_KG_MOL, vapour_mbar};
use crate::air::ray::{Bending, RefractiveAir};
use crate::air::standard::{
    HYDROSTATIC_K_PER_KM, ICE_POINT_K, LAYERS, Layer, geopotential_km, geopotential_slope, layer_at,
};

/// Power of the temperature by which the pressure of vapour falls (Hohenkerk & Sinclair 1985).
const VAPOUR_POWER: f64 = 18.36;
/// The same for the pressure of dry air in the troposphere.
const DRY_POWER: f64 = -HYDROSTATIC_K_PER_KM / LAYERS[0].slope_k_per_km;
/// How much lighter than dry air vapour is.
const LIGHTNESS: f64 = 1.0 - WATER_KG_MOL / DRY_AIR_KG_MOL;

/// The air at an observer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObserverAir {
    /// Above sea level, metres; -430 to 100,000.
    pub height_m: f64,
    /// At the observer, not brought down to sea level; millibars, 0 to 1100.
    pub pressure_mbar: f64,
    /// Degrees Celsius; -90 to 60.
    pub temperature_c: f64,
    /// 0 to 1.
    pub relative_humidity: f64,
    /// In vacuum, nanometres; 300 to 1700.
    pub wavelength_nm: f64,
}

/// Temperature, pressure and vapour against height, over and below one observer.
pub(in crate::air) struct Profile {
    layers: [Layer; LAYERS.len()],
    refractivity: Refractivity,
    /// Where vapour thins out upwards, if the observer stands in it.
    troposphere: Option<Troposphere>,
    /// Share of vapour in the molecules elsewhere.
    share: f64,
}

/// What the closed form of the pressure asks for (Hohenkerk & Sinclair 1985).
struct Troposphere {
    observer_k: f64,
    observer_mbar: f64,
    vapour_mbar: f64,
    /// What the lightness of vapour adds to the pressure, millibars.
    lightness_mbar: f64,
}

/// Pressures at one height, millibars, and their slopes against the geopotential height in kilometres.
struct Pressures {
    air: f64,
    air_slope: f64,
    vapour: f64,
    vapour_slope: f64,
}

impl Profile {
    pub fn over(air: &ObserverAir) -> Profile {
        let observer_km = geopotential_km(air.height_m / 1000.0);
        let observer_k = air.temperature_c + ICE_POINT_K;
        let at = layer_at(observer_km);
        let warmer_k = observer_k - LAYERS[at].temperature_k(observer_km);
        let layers = LAYERS.map(|layer| Layer { base_k: layer.base_k + warmer_k, ..layer });
        // No more than half of the molecules of the air, here and down at the sea.
        let growth = if at == 0 { (layers[0].base_k / observer_k).max(1.0) } else { 1.0 };
        let most_mbar = 0.5 * air.pressure_mbar * growth.powf(DRY_POWER - VAPOUR_POWER);
        let vapour_mbar =
            vapour_mbar(air.pressure_mbar, observer_k, air.relative_humidity).min(most_mbar);
        let share = share_of(vapour_mbar, air.pressure_mbar);
        let mut profile = Profile {
            layers,
            refractivity: Refractivity::at(
                air.wavelength_nm,
                air.pressure_mbar,
                observer_k,
                vapour_mbar,
            ),
            troposphere: (at == 0).then(|| Troposphere {
                observer_k,
                observer_mbar: air.pressure_mbar,
                vapour_mbar,
                lightness_mbar: LIGHTNESS * vapour_mbar * DRY_POWER / (VAPOUR_POWER - DRY_POWER),
            }),
            share,
        };
        // Downwards from the observer, then upwards, each layer from the end of the one before.
        let (mut known_mbar, mut known_km) = (air.pressure_mbar, observer_km);
        for layer in profile.layers[..=at].iter_mut().rev() {
            known_mbar /= pressure_ratio(layer, known_km, share);
            known_km = layer.base_km;
            layer.base_mbar = known_mbar;
        }
        for above in at + 1..profile.layers.len() {
            let end_km = profile.layers[above].base_km;
            let end = profile.pressures_in(above - 1, end_km);
            profile.layers[above].base_mbar = end.air;
            profile.share = share_of(end.vapour, end.air);
        }
        profile
    }

    fn pressures_in(&self, at: usize, geopotential_km: f64) -> Pressures {
        let layer = &self.layers[at];
        let temperature_k = layer.temperature_k(geopotential_km);
        match &self.troposphere {
            Some(troposphere) if at == 0 => troposphere.pressures(temperature_k),
            _ => {
                let air = layer.base_mbar * pressure_ratio(layer, geopotential_km, self.share);
                let air_slope = -hydrostatic_k_per_km(self.share) / temperature_k * air;
                Pressures {
                    air,
                    air_slope,
                    vapour: self.share * air,
                    vapour_slope: self.share * air_slope,
                }
            }
        }
    }
}

impl RefractiveAir for Profile {
    fn bending_at(&self, height_km: f64) -> Bending {
        let geopotential_km = geopotential_km(height_km);
        let at = layer_at(geopotential_km);
        let temperature_k = self.layers[at].temperature_k(geopotential_km);
        let p = self.pressures_in(at, geopotential_km);
        let refractivity = self.refractivity.of(p.air, p.vapour, temperature_k);
        let of_pressures = self.refractivity.of(p.air_slope, p.vapour_slope, temperature_k);
        let of_warmth = refractivity * self.layers[at].slope_k_per_km / temperature_k;
        let slope_per_km = (of_pressures - of_warmth) * geopotential_slope(height_km);
        Bending { refractivity, slope_per_km }
    }
}

impl Troposphere {
    /// Where the air is as warm as given.
    fn pressures(&self, temperature_k: f64) -> Pressures {
        let logarithm = (temperature_k / self.observer_k).ln();
        let dry = (DRY_POWER * logarithm).exp();
        let wet = (VAPOUR_POWER * logarithm).exp();
        let air = self.observer_mbar * dry + self.lightness_mbar * (dry - wet);
        let vapour = self.vapour_mbar * wet;
        Pressures {
            air,
            air_slope: -HYDROSTATIC_K_PER_KM / temperature_k * (air - LIGHTNESS * vapour),
            vapour,
            vapour_slope: VAPOUR_POWER * LAYERS[0].slope_k_per_km / temperature_k * vapour,
        }
    }
}

/// Share of the vapour in the molecules.
fn share_of(vapour_mbar: f64, pressure_mbar: f64) -> f64 {
    if pressure_mbar > 0.0 { vapour_mbar / pressure_mbar } else { 0.0 }
}

/// Weight of air of a molar mass lessened by its share of vapour, kelvin per geopotential kilometre.
fn hydrostatic_k_per_km(share: f64) -> f64 {
    HYDROSTATIC_K_PER_KM * (1.0 - LIGHTNESS * share)
}

/// Pressure at a height over that at the base of its layer.
fn pressure_ratio(layer: &Layer, geopotential_km: f64, share: f64) -> f64 {
    let weight = hydrostatic_k_per_km(share);
    if layer.slope_k_per_km == 0.0 {
        (-weight * (geopotential_km - layer.base_km) / layer.base_k).exp()
    } else {
        let warmth = layer.temperature_k(geopotential_km) / layer.base_k;
        warmth.powf(-weight / layer.slope_k_per_km)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::standard::{SEA_LEVEL_PRESSURE_MBAR, standard_pressure_mbar};

    const STANDARD: ObserverAir = ObserverAir {
        height_m: 0.0,
        pressure_mbar: SEA_LEVEL_PRESSURE_MBAR,
        temperature_c: 15.0,
        relative_humidity: 0.0,
        wavelength_nm: 550.0,
    };
    const HUMID: ObserverAir =
        ObserverAir { height_m: 800.0, temperature_c: 28.0, relative_humidity: 0.9, ..STANDARD };

    fn pressures(profile: &Profile, geopotential_km: f64) -> Pressures {
        profile.pressures_in(layer_at(geopotential_km), geopotential_km)
    }
    fn mbar(profile: &Profile, height_km: f64) -> f64 {
        pressures(profile, geopotential_km(height_km)).air
    }

    #[test]
    fn standard_air_is_the_standard_atmosphere_wherever_the_observer_stands() {
        for height_m in [-400.0, 0.0, 4000.0, 15_000.0, 60_000.0] {
            let geopotential_km = geopotential_km(height_m / 1000.0);
            let temperature_k = LAYERS[layer_at(geopotential_km)].temperature_k(geopotential_km);
            let profile = Profile::over(&ObserverAir {
                height_m,
                pressure_mbar: standard_pressure_mbar(height_m),
                temperature_c: temperature_k - ICE_POINT_K,
                ..STANDARD
            });
            for height_km in [0.0, 5.0, 10.9, 11.1, 25.0, 40.0, 60.0, 80.0] {
                let ratio = mbar(&profile, height_km) / standard_pressure_mbar(height_km * 1000.0);
                assert!((ratio - 1.0).abs() < 3e-5, "{height_m} m, {height_km} km: {ratio}");
            }
        }
    }

    #[test]
    fn pressure_is_the_weight_of_the_air_above_and_slopes_are_slopes() {
        for air in [STANDARD, HUMID, ObserverAir { height_m: 13_000.0, ..HUMID }] {
            let profile = Profile::over(&air);
            for height_km in [0.1, 0.79, 0.81, 5.0, 10.0, 12.0, 25.0, 49.0, 75.0] {
                let step_km = 1e-3;
                let at = |km: f64| pressures(&profile, geopotential_km(km));
                let (above, below) = (at(height_km + step_km), at(height_km - step_km));
                let stretch =
                    geopotential_km(height_km + step_km) - geopotential_km(height_km - step_km);
                let here = at(height_km);
                for (slope, wanted) in [
                    ((above.air - below.air) / stretch, here.air_slope),
                    ((above.vapour - below.vapour) / stretch, here.vapour_slope),
                ] {
                    assert!((slope - wanted).abs() <= 1e-6 * wanted.abs(), "{height_km}: {slope}");
                }
                let (above, below) = (
                    profile.bending_at(height_km + step_km).refractivity,
                    profile.bending_at(height_km - step_km).refractivity,
                );
                let slope = (above - below) / (2.0 * step_km);
                let wanted = profile.bending_at(height_km).slope_per_km;
                assert!((slope / wanted - 1.0).abs() < 1e-6, "{height_km} km: {slope} {wanted}");
            }
        }
    }

    #[test]
    fn layers_join() {
        for air in [STANDARD, HUMID] {
            let profile = Profile::over(&air);
            for layer in &profile.layers[1..] {
                let at = |km: f64| pressures(&profile, km);
                let (below, above) = (at(layer.base_km - 1e-9), at(layer.base_km + 1e-9));
                assert!((below.air / above.air - 1.0).abs() < 1e-8, "{} km", layer.base_km);
                assert!((below.vapour - above.vapour).abs() < 1e-8, "{} km", layer.base_km);
            }
        }
    }
}

//! The dark sky: what glows where no Sun, no Moon and no town shine.
//!
//! A first sky: one spectrum for everything that glows, brightest towards the horizon. The zodiacal
//! light and the Milky Way are not in it as shapes; their average is part of the level.
//!
//! Theory: a thin glowing layer at height `h` is seen through a longer path towards the horizon (van
//! Rhijn 1921), `X = (1 - (R cos a / (R + h))^2)^(-1/2)` at altitude `a`, and is dimmed by the air
//! below. Krisciunas & Schaefer 1991, *PASP* 103, 1033, eq. 2: the sky is `X 10^(-0.4 k (X - 1))` of
//! the zenith. Taking `X`, 6 at most, for the path through the air as well is their way of giving
//! back what the air scatters in.
//!
//! How we differ: `k` is the extinction of the given air at each wavelength, not one number for V, so
//! that the low sky reddens; and `X` follows from the height of the layer (theirs has 0.96 for
//! `(R / (R + h))^2`, a layer at 130 km).
//!
//! Accuracy: the level changes by a factor of 2 with the Sun's activity, the season and the hour.
//! Within 10 degrees of the horizon the law is not known to better than a factor of 2.

use crate::air::Atmosphere;
use crate::air::EARTH_RADIUS_KM;
use crate::air::extinction::vertical_columns;
use crate::light::spectrum::{Spectrum, Transmittance};
use crate::light::sun;
use crate::units::{Angle, Xyzv};

/// Luminance of a surface brightness in V, cd/m2: `10^((12.58 - m) / 2.5)`, Crumey 2014, *MNRAS* 442,
/// 2600. Magnitudes per square arcsecond.
pub fn luminance_cd_m2(mag_per_arcsec2: f64) -> f64 {
    10f64.powf((12.58 - mag_per_arcsec2) / 2.5)
}

/// Scotopic over photopic luminance of the night sky after Crumey 2014.
pub const CRUMEY_RATIO: f64 = 1.38;
/// The same integrated from the moonless zenith spectrum of the ESO sky model (Noll et al. 2012,
/// SkyCalc 1.4.3) with the observers used here. Rods then see a sky 0.4 magnitudes brighter, and its
/// chromaticity is a pale (0.35, 0.36) instead of an orange (0.43, 0.41).
pub const SKYCALC_RATIO: f64 = 1.98;

/// The glow of a moonless, townless sky.
#[derive(Debug, Clone, PartialEq)]
pub struct NightSky {
    /// Surface brightness of the zenith in V, as seen from the ground; 21.0 at the Sun's maximum of
    /// activity to 22.1 on the darkest nights.
    pub zenith_mag_per_arcsec2: f64,
    /// Scotopic over photopic luminance: [`CRUMEY_RATIO`] by default, see [`SKYCALC_RATIO`].
    pub scotopic_over_photopic: f64,
    /// Height of the glowing layer, kilometres, above every observer.
    pub layer_height_km: f64,
}

impl Default for NightSky {
    fn default() -> Self {
        NightSky {
            zenith_mag_per_arcsec2: 22.0,
            scotopic_over_photopic: SKYCALC_RATIO,
            layer_height_km: 90.0,
        }
    }
}

/// Airglow lines: wavelength in nanometres and brightness in rayleighs. Oxygen after PALACE v1.0
/// (Noll et al. 2024), sodium about 40 R in all.
const LINES_NM_R: [(f64, f64); 5] =
    [(557.7, 162.7), (589.0, 26.7), (589.6, 13.3), (630.0, 122.7), (636.4, 41.1)];
/// Zenith luminance that the lines above were measured with: 22.0 mag per square arcsecond. They are
/// scaled with the level.
const LEVEL_OF_LINES_MAG: f64 = 22.0;

/// Radiance of a line, W m-2 sr-1: a rayleigh is 1e10 / (4 pi) photons s-1 m-2 sr-1.
fn line(at_nm: f64, rayleighs: f64) -> Spectrum {
    /// Planck constant times speed of light, joule nanometres (SI, exact).
    const PHOTON_J_NM: f64 = 1.986_445_857e-16;
    let photons = rayleighs * 1e10 / (4.0 * std::f64::consts::PI);
    Spectrum::line(at_nm, photons * PHOTON_J_NM / at_nm)
}

impl NightSky {
    /// Spectral radiance of the zenith as seen from the ground, W m-2 sr-1 nm-1: airglow lines on a
    /// continuum of sunlight that is tilted by a power of the wavelength until the whole has the
    /// scotopic-to-photopic ratio asked for (0.6 to 3.5; what lies outside is brought to the end).
    pub fn zenith_radiance(&self) -> Spectrum {
        let level_cd_m2 = luminance_cd_m2(self.zenith_mag_per_arcsec2);
        let lines: Spectrum = LINES_NM_R.iter().map(|(nm, r)| line(*nm, *r)).sum();
        let lines = lines * (level_cd_m2 / luminance_cd_m2(LEVEL_OF_LINES_MAG));
        let continuum_cd_m2 = level_cd_m2 - lines.xyzv().y;
        let with_power = |power: f64| {
            sun::irradiance_1au()
                .weighted(|nm| (nm / 550.0).powf(power))
                .scaled_to_photopic(continuum_cd_m2)
                + lines
        };
        // The ratio falls steadily with the power: halve the interval.
        let (mut blue, mut red) = (-8.0, 12.0);
        for _ in 0..40 {
            let middle = 0.5 * (blue + red);
            let light = with_power(middle).xyzv();
            if light.v > self.scotopic_over_photopic * light.y {
                blue = middle
            } else {
                red = middle
            }
        }
        with_power(0.5 * (blue + red))
    }

    /// Spectral radiance at an apparent altitude, W m-2 sr-1 nm-1, for an observer at a height above
    /// sea level in metres. Below the horizontal plane that of the plane.
    pub fn radiance(&self, air: &Atmosphere, height_m: f64, apparent_altitude: Angle) -> Spectrum {
        let altitude = apparent_altitude.max(Angle::ZERO);
        let observer_km = EARTH_RADIUS_KM + height_m / 1000.0;
        let layer_km = EARTH_RADIUS_KM + self.layer_height_km;
        // An observer near the layer or in it would see it edge on without end.
        let path = (1.0 - (observer_km * altitude.cos() / layer_km).powi(2)).max(0.01).powf(-0.5);
        let depths = vertical_columns(air, height_m).optical_depths(air);
        let lost = depths.map(|parts| parts.iter().sum::<f64>() * (path - 1.0));
        self.zenith_radiance() * path * Transmittance::from_optical_depths(&lost)
    }

    /// Luminance at an apparent altitude, cd/m2.
    pub fn luminance(&self, air: &Atmosphere, height_m: f64, apparent_altitude: Angle) -> Xyzv {
        self.radiance(air, height_m, apparent_altitude).xyzv()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_zenith_has_its_level_and_ratio() {
        assert!((luminance_cd_m2(22.0) - 1.706e-4).abs() < 1e-7);
        for (level, ratio) in [(22.0, CRUMEY_RATIO), (21.0, SKYCALC_RATIO), (22.0, 2.3)] {
            let sky = NightSky {
                zenith_mag_per_arcsec2: level,
                scotopic_over_photopic: ratio,
                ..NightSky::default()
            };
            for light in [
                sky.zenith_radiance().xyzv(),
                sky.luminance(&Atmosphere::default(), 0.0, Angle::from_deg(90.0)),
            ] {
                assert!((light.y / luminance_cd_m2(level) - 1.0).abs() < 1e-6, "{light:?}");
                assert!((light.v / light.y / ratio - 1.0).abs() < 1e-6, "{light:?}");
            }
        }
    }

    #[test]
    fn the_green_line_is_a_fifth_of_the_sky() {
        // 163 R of 557.7 nm are 4.6e-8 W m-2 sr-1 and 3.2e-5 cd/m2.
        let green = line(557.7, 163.0);
        let power: f64 = green.values().iter().sum::<f64>() * 5.0;
        assert!((power - 4.6e-8).abs() < 1e-9, "{power:e}");
        assert!((green.xyzv().y - 3.2e-5).abs() < 1e-6, "{}", green.xyzv().y);
    }

    #[test]
    fn the_low_sky_follows_krisciunas_and_schaefer() {
        let (sky, air) = (NightSky::default(), Atmosphere::default());
        let zenith = sky.zenith_radiance().xyzv().y;
        for altitude_deg in [10.0, 20.0, 30.0, 45.0, 60.0] {
            let altitude = Angle::from_deg(altitude_deg);
            let x = (1.0 - 0.96 * altitude.cos().powi(2)).powf(-0.5);
            // Their coefficient, with the extinction of this air in V: 0.245 magnitudes.
            let expected = x * 10f64.powf(-0.4 * 0.245 * (x - 1.0));
            let got = sky.luminance(&air, 0.0, altitude).y / zenith;
            assert!((got / expected - 1.0).abs() < 0.07, "{altitude_deg}°: {got} {expected}");
        }
        let horizon = sky.luminance(&air, 0.0, Angle::ZERO);
        assert_eq!(horizon, sky.luminance(&air, 0.0, Angle::from_deg(-20.0)));
        assert!(horizon.y > zenith && horizon.y < 5.0 * zenith);
    }

    #[test]
    fn without_air_the_layer_alone_brightens() {
        let mut void = Atmosphere::molecular();
        void.ozone.column_du = 0.0;
        void.observer.pressure_mbar = Some(1e-9);
        let sky = NightSky { layer_height_km: 89.2, ..NightSky::default() };
        let ratio = sky.luminance(&void, 0.0, Angle::ZERO).y / sky.zenith_radiance().xyzv().y;
        // Noll et al. 2012: (1 - 0.972)^(-1/2) = 5.98 at the horizon.
        let expected = (1.0 - (6371.0f64 / 6460.2).powi(2)).powf(-0.5);
        assert!((ratio - expected).abs() < 1e-6 && (ratio - 5.98).abs() < 0.1, "{ratio}");
    }
}

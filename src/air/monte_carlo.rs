//! The clear sky by backward Monte Carlo: slow, without tables, the check on everything that is fast.
//!
//! It shares with [`scattering`](crate::air::scattering) what the air is (densities linear between the
//! same heights, the same cross-sections and phase functions) and nothing of how light is followed.
//! The first order is integrated along the line of sight; all others, up to the 40th, are the mean of
//! random paths. Up to eight wavelengths share a path, which makes their ratios better than themselves.
//!
//! Theory: Marchuk et al. 1980, *The Monte Carlo Methods in Atmospheric Optics* (backward paths, local
//! estimation, forced collisions; recalled); Veach & Guibas 1995, SIGGRAPH (several ways to draw, one
//! weight: the balance heuristic; recalled). How the paths are drawn stands in `walk`.
//!
//! Omitted: polarisation, refraction and the disc of the source: rays are straight, light is parallel,
//! whatever [`LightPaths`](crate::air::LightPaths) say.
//!
//! The standard error is that of the sample, sqrt(variance / paths). Below -9 degrees few paths carry
//! much of the light: three standard errors are then the honest 95 %.
//!
//! The same seed gives the same numbers whatever the number of threads: paths are counted in blocks,
//! each with its own stream, and summed in order.

mod directions;
mod first_order;
mod matter;
mod random;
mod shells;
mod walk;

use glam::DVec3;
use rayon::prelude::*;

use crate::air::Atmosphere;
use crate::air::scattering::lanes::LANES;
use crate::air::scattering::profile::{Optics, Profile};
use crate::air::scattering::shaded::LeftAt;
use crate::air::scattering::{EARTH_RADIUS_KM, ScatteringError};
use crate::units::Angle;

use first_order::first_order;
use matter::{Light, Matter};
use random::Random;
use shells::Shells;
use walk::{LitTable, Scene, Shade, Source, Start, Walker};

/// Paths of one stream.
const BLOCK_PATHS: u64 = 128;
/// Blocks of the first round; their variance says how many more there have to be.
const FIRST_BLOCKS: u64 = 32;

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Standard error wanted, relative to the whole radiance, of every wavelength.
    pub relative_error: f64,
    /// No more paths than this, rounded up to whole blocks of 128.
    pub most_paths: u64,
    pub seed: u64,
}

impl Default for Effort {
    /// 1 %, at most ten million paths.
    fn default() -> Effort {
        Effort { relative_error: 0.01, most_paths: 10_000_000, seed: 1 }
    }
}

/// A result at one wavelength, per unit irradiance of the source outside the air: a radiance, sr^-1,
/// or an irradiance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    /// Light scattered once, by quadrature; 0 for irradiances, where all orders are drawn.
    pub first_order: f64,
    /// The mean over the paths.
    pub by_paths: f64,
    /// Its standard error.
    pub standard_error: f64,
    pub paths: u64,
}

impl Estimate {
    pub fn total(&self) -> f64 {
        self.first_order + self.by_paths
    }
}

/// Up to eight wavelengths that share their paths.
#[derive(Debug, Clone)]
struct Band {
    matter: Matter,
    lit: LitTable,
}

/// The air, ready for random paths.
#[derive(Debug, Clone)]
pub struct MonteCarlo {
    shells: Shells,
    bands: Vec<Band>,
}

impl MonteCarlo {
    /// For the air around an observer of a height above sea level, metres: its pressure is given
    /// for there, and the ground may lie as high. Wavelengths in nm, 360 to 830, in any order.
    pub fn new(
        air: &Atmosphere,
        observer_height_m: f64,
        wavelengths_nm: &[f64],
    ) -> Result<MonteCarlo, ScatteringError> {
        air.validate()?;
        ScatteringError::check_wavelengths(wavelengths_nm)?;
        let ground_km = air.ground_km(observer_height_m);
        let shells = Shells::new(&Profile::new(air, ground_km), ground_km);
        let density_ratio = air.density_ratio_at(observer_height_m);
        let band = |chunk: &[f64]| {
            let matter = Matter::new(&Optics::new(air, density_ratio, chunk), chunk.len());
            Band { lit: LitTable::new(&shells, &matter), matter }
        };
        let bands = wavelengths_nm.par_chunks(LANES).map(band).collect();
        Ok(MonteCarlo { shells, bands })
    }

    /// Diffuse radiance, each wavelength. The source itself is not in it; the ground is, below the
    /// horizon. The observer's height above sea level is clamped to the air; the azimuth counts
    /// from the source.
    pub fn radiance(
        &self,
        observer_height_km: f64,
        cos_sun_zenith: f64,
        view_elevation: Angle,
        azimuth_from_sun: Angle,
        effort: &Effort,
    ) -> Vec<Estimate> {
        let view = (view_elevation, azimuth_from_sun);
        self.seen(observer_height_km, cos_sun_zenith, view, None, effort)
    }

    /// The same where something stands before the source, seen from a part of the air: what is left of
    /// it at each place. Paths do not know where it is bright: of deep shade they need many.
    pub fn radiance_in_shade(
        &self,
        observer_height_km: f64,
        cos_sun_zenith: f64,
        (view_elevation, azimuth_from_sun): (Angle, Angle),
        left_at: &LeftAt,
        effort: &Effort,
    ) -> Vec<Estimate> {
        let shade = Shade { left_at, origin: DVec3::Z * EARTH_RADIUS_KM };
        let view = (view_elevation, azimuth_from_sun);
        self.seen(observer_height_km, cos_sun_zenith, view, Some(shade), effort)
    }

    fn seen(
        &self,
        observer_height_km: f64,
        cos_sun_zenith: f64,
        (view_elevation, azimuth_from_sun): (Angle, Angle),
        shade: Option<Shade>,
        effort: &Effort,
    ) -> Vec<Estimate> {
        let sun = sun_direction(cos_sun_zenith);
        let r = (EARTH_RADIUS_KM + observer_height_km)
            .clamp(self.shells.ground_km(), self.shells.top_km());
        let eye = DVec3::Z * r;
        let (sin, cos) = view_elevation.sin_cos();
        let (sin_azimuth, cos_azimuth) = azimuth_from_sun.sin_cos();
        let dir = DVec3::new(cos * cos_azimuth, cos * sin_azimuth, sin).normalize();
        let of_band = |band: &Band| {
            let scene = Scene { shade, ..self.scene(band, Source::Beam(sun)) };
            let known = first_order(&scene, eye, dir, sun);
            estimate(scene, Start::Sight { eye, dir }, 2, known, effort)
        };
        self.bands.iter().flat_map(of_band).collect()
    }

    /// Irradiance of level ground, each wavelength: that of the sky, and that of the source itself,
    /// which is exact.
    pub fn ground_irradiance(
        &self,
        cos_sun_zenith: f64,
        effort: &Effort,
    ) -> (Vec<Estimate>, Vec<f64>) {
        let sun = sun_direction(cos_sun_zenith);
        let at = DVec3::Z * self.shells.ground_km();
        let of_band = |band: &Band| {
            let scene = self.scene(band, Source::Beam(sun));
            estimate(scene, Start::Plane { at }, 1, [0.0; LANES], effort)
        };
        let direct = |band: &Band| {
            let beam = self.scene(band, Source::Beam(sun)).beam(at, sun);
            let count = band.matter.count;
            let on_plane = |light: Light| light.map(|light| light * cos_sun_zenith.max(0.0));
            beam.map_or([0.0; LANES], on_plane).into_iter().take(count)
        };
        let diffuse = self.bands.iter().flat_map(of_band).collect();
        (diffuse, self.bands.iter().flat_map(direct).collect())
    }

    fn scene<'a>(&'a self, band: &'a Band, source: Source) -> Scene<'a> {
        Scene { shells: &self.shells, matter: &band.matter, lit: &band.lit, source, shade: None }
    }
}

/// In the plane of x and z, the zenith at z.
fn sun_direction(cos_zenith: f64) -> DVec3 {
    let cos = cos_zenith.clamp(-1.0, 1.0);
    DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)
}

/// Sums over paths.
#[derive(Debug, Clone, Copy)]
struct Tally {
    paths: u64,
    sum: Light,
    squares: Light,
}

impl Tally {
    const NONE: Tally = Tally { paths: 0, sum: [0.0; LANES], squares: [0.0; LANES] };

    fn add(&mut self, light: Light) {
        self.paths += 1;
        for (i, light) in light.into_iter().enumerate() {
            self.sum[i] += light;
            self.squares[i] += light * light;
        }
    }

    fn join(&mut self, other: &Tally) {
        self.paths += other.paths;
        for i in 0..LANES {
            self.sum[i] += other.sum[i];
            self.squares[i] += other.squares[i];
        }
    }

    fn estimate(&self, known: &Light, lane: usize) -> Estimate {
        let n = self.paths as f64;
        let mean = self.sum[lane] / n;
        let variance = (self.squares[lane] / n - mean * mean).max(0.0) / (n - 1.0).max(1.0);
        Estimate {
            first_order: known[lane],
            by_paths: mean,
            standard_error: variance.sqrt(),
            paths: self.paths,
        }
    }
}

/// Follows paths until the error is small enough.
fn estimate(
    scene: Scene,
    start: Start,
    from_order: u32,
    known: Light,
    effort: &Effort,
) -> Vec<Estimate> {
    let most_blocks = effort.most_paths.div_ceil(BLOCK_PATHS).max(1);
    let mut tally = Tally::NONE;
    let mut blocks = 0;
    let mut wanted = FIRST_BLOCKS.min(most_blocks);
    loop {
        let round: Vec<Tally> = (blocks..wanted)
            .into_par_iter()
            .map_init(
                || Walker::new(scene, start, from_order),
                |walker, block| {
                    let mut random = Random::stream(effort.seed, block);
                    let mut tally = Tally::NONE;
                    for _ in 0..BLOCK_PATHS {
                        tally.add(walker.walk(&mut random));
                    }
                    tally
                },
            )
            .collect();
        round.iter().for_each(|part| tally.join(part));
        blocks = wanted;
        let estimates: Vec<Estimate> =
            (0..scene.matter.count).map(|lane| tally.estimate(&known, lane)).collect();
        let excess = estimates.iter().fold(0.0, |most: f64, estimate| {
            let allowed = effort.relative_error * estimate.total();
            let ratio = if allowed > 0.0 { estimate.standard_error / allowed } else { 0.0 };
            most.max(ratio)
        });
        if excess <= 1.0 || blocks >= most_blocks {
            return estimates;
        }
        // As many as the variance asks for and some; at least half as many again, at most four times.
        let asked = blocks as f64 * (1.1 * excess * excess).clamp(1.5, 4.0);
        wanted = (asked as u64).min(most_blocks);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::{Ground, Ozone};

    /// The light that paths bring under a sky of radiance 1, of which nothing is absorbed.
    fn under_even_light(air: &Atmosphere, height_km: f64, elevation_deg: f64) -> Vec<Estimate> {
        let solver = MonteCarlo::new(air, 0.0, &[400.0, 550.0, 700.0]).unwrap();
        let eye = DVec3::Z * (EARTH_RADIUS_KM + height_km);
        let (sin, cos) = Angle::from_deg(elevation_deg).sin_cos();
        let start = Start::Sight { eye, dir: DVec3::new(cos, 0.0, sin) };
        let effort = Effort { relative_error: 1e-3, most_paths: 100_000, seed: 5 };
        let scene = solver.scene(&solver.bands[0], Source::Above);
        estimate(scene, start, 1, [0.0; LANES], &effort)
    }

    #[test]
    fn even_light_over_white_ground_is_even_everywhere() {
        let mut air = Atmosphere {
            ground: Ground { albedo: 1.0, ..Ground::default() },
            ozone: Ozone { column_du: 0.0, ..Ozone::default() },
            ..Atmosphere::molecular()
        };
        for haze in [0.0, 0.1] {
            air.aerosol.optical_depth_550 = haze;
            air.aerosol.single_scattering_albedo = Some(1.0);
            for (height_km, elevation_deg) in [(0.001, 90.0), (0.001, 5.0), (20.0, -30.0)] {
                for got in under_even_light(&air, height_km, elevation_deg) {
                    let off = (got.total() - 1.0).abs();
                    // Four standard errors, and what is left after 40 orders.
                    let allowed = 4.0 * got.standard_error + 2e-4;
                    assert!(off < allowed, "{haze}, {height_km} km, {elevation_deg}: {got:?}");
                    assert!(got.standard_error < 0.01, "{got:?}");
                }
            }
        }
    }

    #[test]
    fn threads_do_not_change_the_numbers() {
        let solver = MonteCarlo::new(&Atmosphere::default(), 0.0, &[550.0]).unwrap();
        let effort = Effort { relative_error: 0.02, most_paths: 20_000, seed: 9 };
        let of = |threads: usize, effort: &Effort| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let [elevation, azimuth] = [10.0, 45.0].map(Angle::from_deg);
            pool.install(|| solver.radiance(0.001, -0.05, elevation, azimuth, effort))
        };
        assert_eq!(of(1, &effort), of(3, &effort));
        assert_ne!(of(1, &effort), of(1, &Effort { seed: 10, ..effort }));
    }
}

//! Light that goes up from the ground at some distance and is scattered down to the observer.
//!
//! *Theory.* A patch of ground sends light up by an emission function. A line of sight is lit along
//! its way: at each point the light of the patch, weakened by the air on its way and by the square of
//! the distance, is scattered by molecules and aerosols (their densities and phase functions are those
//! of all solvers here) and weakened again on its way to the eye. Straight rays over a spherical Earth:
//! what lies below the horizon of the patch is dark. Garstang 1986, *PASP* 98, 364; 1989, *PASP* 101,
//! 306, on a curved Earth. Light scattered twice is his factor on the way up, `1 + t_a + t_m / 3`, with
//! the scattering depths of aerosols and molecules there (1989; form recalled): most of what aerosols
//! scatter goes nearly straight on.
//!
//! *Softening.* Lamps lie behind walls and trees and spread over streets: the squared distance never
//! falls below that of [`PATCH_KM`].
//!
//! *How.* Tables over apparent altitude, distance and azimuth from the patch, for eight wavelengths. The
//! azimuth is kept as an integral, so that means over arcs are exact and a narrow dome is never missed.
//! A law of distance is taken out, so that what is left is smooth.
//!
//! *Omitted.* Bending of rays (half a degree at the horizon), polarisation, screening by hills, ground
//! that lies higher or lower than that of the observer's air, and higher orders beyond the factor.
//!
//! *Accuracy.* Of the quadrature 0.4 %; of the interpolation within 12 %, and 25 % in the lowest degrees (20 and 40 %
//! beyond 100 km), on the flanks of a dome, where it has a hundredth of its brightest (tested below). That of the factor for higher orders is not known
//! here.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::lanes::LANES;
use super::profile::{Optics, SCATTERERS, SPECIES, SPECIES_OF_SCATTERER};
use super::rays::Geometry;
use super::{SKY_NODES_NM, ScatteringError, columns};
use crate::air::{Atmosphere, EARTH_RADIUS_KM};

/// No light comes from nearer than this, kilometres.
pub const PATCH_KM: f64 = 0.25;
/// Apparent altitudes of the tables, degrees.
pub const ALTITUDES_DEG: [f64; 17] = [
    0.0, 1.0, 2.0, 3.5, 5.0, 7.5, 10.0, 14.0, 18.0, 24.0, 30.0, 38.0, 47.0, 57.0, 68.0, 79.0, 90.0,
];
/// Azimuths from the patch, degrees.
const AZIMUTHS_DEG: [f64; 17] = [
    0.0, 1.0, 2.5, 5.0, 8.0, 12.0, 16.0, 21.0, 27.0, 34.0, 43.0, 54.0, 68.0, 85.0, 105.0, 135.0,
    180.0,
];
/// Nearest and farthest distance of the tables, and how many there are.
const NEAREST_KM: f64 = 0.1;
const FARTHEST_KM: f64 = 400.0;
const DISTANCES: usize = 21;
/// What lies higher scatters nothing, kilometres.
const TOP_OF_LIGHT_KM: f64 = 60.0;
/// Above the observer: no step of a line of sight crosses these heights, kilometres.
const CUTS_KM: [f64; 7] = [0.5, 1.4, 3.0, 6.0, 11.0, 20.0, 36.0];
/// Longest step in the logarithm of the distance from the patch.
const LONGEST_STEP: f64 = 1.0;
/// Nodes of Gauss and Legendre's rule of order 2 on [-1, 1]; weights 1.
const GAUSS_2: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];

/// A value at each of [`SKY_NODES_NM`].
pub type NodeLight = [f64; LANES];

/// How light from the ground at a distance reaches an eye. Cheap to clone.
#[derive(Debug, Clone)]
pub struct GroundLight {
    solved: Arc<Solved>,
}

#[derive(Debug)]
struct Solved {
    /// Radiance over [`distance_law`], `[altitude][distance][azimuth]`.
    density: Vec<[f32; LANES]>,
    /// Its integral from azimuth zero, radians.
    integral: Vec<[f32; LANES]>,
}

/// What is taken out of the tables, km^-2.
fn distance_law(distance_km: f64) -> f64 {
    (1.0 + distance_km / 15.0).powi(-2) / distance_km.hypot(PATCH_KM)
}

fn distance_km(node: usize) -> f64 {
    NEAREST_KM * (FARTHEST_KM / NEAREST_KM).powf(node as f64 / (DISTANCES - 1) as f64)
}

impl GroundLight {
    /// For the air over an observer of a height in metres. The emission function is told the cosine of
    /// the zenith distance, 0 to 1, and gives the share of the light that goes there, per steradian.
    pub fn solve(
        air: &Atmosphere,
        observer_height_m: f64,
        emission: impl Fn(f64) -> f64 + Sync,
    ) -> Result<GroundLight, ScatteringError> {
        air.validate()?;
        let scene = Scene::new(air, observer_height_m, emission);
        let rows: Vec<[f32; LANES]> = (0..ALTITUDES_DEG.len() * DISTANCES)
            .into_par_iter()
            .flat_map_iter(|row| {
                let (altitude, distance) = (row / DISTANCES, distance_km(row % DISTANCES));
                let altitude_rad = ALTITUDES_DEG[altitude].to_radians();
                let scene = &scene;
                AZIMUTHS_DEG.iter().map(move |azimuth| {
                    let light = scene.radiance(altitude_rad, distance, azimuth.to_radians());
                    light.map(|light| (light / distance_law(distance)) as f32)
                })
            })
            .collect();
        let mut integral = rows.clone();
        for (sums, values) in
            integral.chunks_mut(AZIMUTHS_DEG.len()).zip(rows.chunks(AZIMUTHS_DEG.len()))
        {
            sums[0] = [0.0; LANES];
            for i in 1..values.len() {
                let width = (AZIMUTHS_DEG[i] - AZIMUTHS_DEG[i - 1]).to_radians() as f32;
                sums[i] = std::array::from_fn(|k| {
                    sums[i - 1][k] + 0.5 * width * (values[i][k] + values[i - 1][k])
                });
            }
        }
        Ok(GroundLight { solved: Arc::new(Solved { density: rows, integral }) })
    }

    /// Radiance at an altitude of the table by a patch at a distance, the mean over azimuths from the
    /// patch, radians, -pi to 2 pi, from less than to: per unit of light sent up, km^-2 sr^-1.
    pub fn mean(&self, altitude: usize, distance_km: f64, azimuths: [f64; 2]) -> NodeLight {
        self.arc(altitude, distance_km).mean(azimuths)
    }

    /// The same for many azimuths.
    pub fn arc(&self, altitude: usize, distance_km: f64) -> Arcs {
        let place = (distance_km.max(NEAREST_KM) / NEAREST_KM).ln()
            / (FARTHEST_KM / NEAREST_KM).ln()
            * (DISTANCES - 1) as f64;
        let node = (place as usize).min(DISTANCES - 2);
        let share = (place - node as f64).min(1.0);
        // Beyond the last distance there is no light.
        let law = if distance_km > FARTHEST_KM { 0.0 } else { distance_law(distance_km) };
        let row = |node: usize| (altitude * DISTANCES + node) * AZIMUTHS_DEG.len();
        let (near, far) = (row(node), row(node + 1));
        let mix = |table: &[[f32; LANES]]| {
            std::array::from_fn(|azimuth| {
                std::array::from_fn(|k| {
                    let (near, far) = (table[near + azimuth][k], table[far + azimuth][k]);
                    law * (f64::from(near) * (1.0 - share) + f64::from(far) * share)
                })
            })
        };
        Arcs { density: mix(&self.solved.density), integral: mix(&self.solved.integral) }
    }
}

/// The light of a patch at one altitude.
pub struct Arcs {
    /// At each azimuth of the tables, and the integral up to there.
    density: [NodeLight; AZIMUTHS_DEG.len()],
    integral: [NodeLight; AZIMUTHS_DEG.len()],
}

impl Arcs {
    /// The mean over azimuths from the patch, radians, -pi to 2 pi, from less than to.
    pub fn mean(&self, [from, to]: [f64; 2]) -> NodeLight {
        let (low, high) = (self.up_to(from), self.up_to(to));
        std::array::from_fn(|k| (high[k] - low[k]) / (to - from))
    }

    /// Integral from azimuth zero, which is odd and grows by as much each turn.
    fn up_to(&self, azimuth: f64) -> NodeLight {
        if azimuth < 0.0 {
            return self.up_to(-azimuth).map(|sum| -sum);
        }
        let (folded, sign, whole) =
            if azimuth > PI { (2.0 * PI - azimuth, -1.0, 2.0) } else { (azimuth, 1.0, 0.0) };
        let deg = folded.max(0.0).to_degrees();
        let last = AZIMUTHS_DEG.len() - 1;
        let node = AZIMUTHS_DEG.partition_point(|&a| a <= deg).clamp(1, last) - 1;
        let width = (AZIMUTHS_DEG[node + 1] - AZIMUTHS_DEG[node]).to_radians();
        let step = (deg - AZIMUTHS_DEG[node]).to_radians();
        let half_square = 0.5 * step * step / width;
        let (from, to) = (&self.density[node], &self.density[node + 1]);
        let (before, all) = (&self.integral[node], &self.integral[last]);
        std::array::from_fn(|k| {
            let here = before[k] + from[k] * step + (to[k] - from[k]) * half_square;
            sign * here + whole * all[k]
        })
    }
}

/// All that a line of sight asks for.
struct Scene<E> {
    geometry: Geometry,
    optics: Optics,
    /// Scattering of each scatterer at density 1, km^-1.
    scattering: [[f64; LANES]; SCATTERERS],
    eye_radius_km: f64,
    emission: E,
}

impl<E: Fn(f64) -> f64> Scene<E> {
    fn new(air: &Atmosphere, observer_height_m: f64, emission: E) -> Scene<E> {
        let density_ratio = air.density_ratio_at(observer_height_m);
        let geometry = Geometry::of(air, observer_height_m).straight();
        let optics = Optics::new(air, density_ratio, &SKY_NODES_NM);
        let scattering = std::array::from_fn(|k| {
            let extinction = &optics.extinction[SPECIES_OF_SCATTERER[k]];
            std::array::from_fn(|i| extinction[i] * optics.albedo[k][i])
        });
        let eye_radius_km = EARTH_RADIUS_KM + air.eye_km(observer_height_m);
        Scene { geometry, optics, scattering, eye_radius_km, emission }
    }

    /// Radiance by a patch at a distance along the ground, by azimuth from it.
    fn radiance(&self, altitude_rad: f64, distance_km: f64, azimuth_rad: f64) -> NodeLight {
        let ground_km = self.geometry.ground_radius_km();
        let eye = DVec3::new(0.0, 0.0, self.eye_radius_km);
        let (sin, cos) = altitude_rad.sin_cos();
        let dir = DVec3::new(cos * azimuth_rad.cos(), cos * azimuth_rad.sin(), sin);
        let (along, up) = (distance_km / ground_km).sin_cos();
        let patch_up = DVec3::new(along, 0.0, up);
        let patch = patch_up * ground_km;

        // The line rises over the horizon of the patch, and leaves the air.
        let (rise, below) = (dir.dot(patch_up), (patch - eye).dot(patch_up));
        if rise <= 0.0 && below >= 0.0 {
            return [0.0; LANES];
        }
        let crossing = below / rise;
        let to_height = |height_km: f64| {
            let (r, half) = (self.eye_radius_km, self.eye_radius_km * sin);
            let rise = 2.0 * r * height_km + height_km * height_km;
            rise / (half + (half * half + rise).sqrt())
        };
        let top_km = EARTH_RADIUS_KM + TOP_OF_LIGHT_KM - self.eye_radius_km;
        let mut start_km = 0.0;
        let mut end_km = to_height(top_km.max(0.0));
        if rise > 0.0 {
            start_km = crossing.max(0.0)
        } else {
            end_km = end_km.min(crossing)
        }
        if start_km >= end_km {
            return [0.0; LANES];
        }

        // Distance along the line from where it is nearest, as the hyperbolic sine of a step.
        let nearest_km = (patch - eye).dot(dir);
        let beside_km =
            ((patch - eye).length_squared() - nearest_km * nearest_km + PATCH_KM * PATCH_KM).sqrt();
        let step_of = |s: f64| ((s - nearest_km) / beside_km).asinh();
        let cuts = CUTS_KM.map(|height| step_of(to_height(height).clamp(start_km, end_km)));
        let (mut from, last) = (step_of(start_km), step_of(end_km));
        let mut light = [0.0; LANES];
        for cut in cuts.into_iter().chain([last]) {
            if cut - from < 1e-9 {
                continue;
            }
            let pieces = ((cut - from) / LONGEST_STEP).ceil();
            let half = 0.5 * (cut - from) / pieces;
            for piece in 0..pieces as usize {
                for node in GAUSS_2 {
                    let step = from + half * (2.0 * piece as f64 + 1.0 + node);
                    let s = (nearest_km + beside_km * step.sinh()).max(0.0);
                    let length_km = half * beside_km * step.cosh();
                    self.add_point(&mut light, eye, dir, s, length_km, (patch, patch_up));
                }
            }
            from = cut;
        }
        light
    }

    /// What a piece of the line sends to the eye.
    fn add_point(
        &self,
        light: &mut NodeLight,
        eye: DVec3,
        dir: DVec3,
        s: f64,
        length_km: f64,
        (patch, patch_up): (DVec3, DVec3),
    ) {
        let at = eye + dir * s;
        let (way, r) = (at - patch, at.length());
        let square = way.length_squared().max(1e-12);
        let up = way / square.sqrt();
        let cos_zenith = up.dot(patch_up);
        if cos_zenith <= 0.0 {
            return;
        }
        let profile = &self.geometry.profile;
        let to_point = self.columns(patch.length(), cos_zenith, r);
        let to_eye = self.columns(self.eye_radius_km, dir.z, r);
        let density = profile.density(r - EARTH_RADIUS_KM);
        let phases = self.optics.phases(-up.dot(dir));
        let sent = (self.emission)(cos_zenith) / (square + PATCH_KM * PATCH_KM) * length_km;
        for (i, light) in light.iter_mut().enumerate() {
            let depth: f64 = (0..SPECIES)
                .map(|k| self.optics.extinction[k][i] * (to_point[k] + to_eye[k]))
                .sum();
            let on_way = |k: usize| self.scattering[k][i] * to_point[SPECIES_OF_SCATTERER[k]];
            let twice = 1.0 + on_way(0) / 3.0 + on_way(1) + on_way(2);
            let scattered: f64 = (0..SCATTERERS)
                .map(|k| {
                    self.scattering[k][i]
                        * density[SPECIES_OF_SCATTERER[k]]
                        * f64::from(phases[k].0[i])
                })
                .sum();
            *light += sent * (-depth).exp() * twice * scattered;
        }
    }

    /// Columns from a radius outwards to another.
    fn columns(&self, from_km: f64, cos_zenith: f64, to_km: f64) -> [f64; SPECIES] {
        let p2 = from_km * from_km * (1.0 - cos_zenith * cos_zenith).max(0.0);
        columns::between(&self.geometry.profile, p2, from_km, to_km.max(from_km))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lambert(cos_zenith: f64) -> f64 {
        cos_zenith / PI
    }

    /// The same integral in equal steps along the line.
    fn in_steps(
        scene: &Scene<fn(f64) -> f64>,
        altitude_deg: f64,
        distance_km: f64,
        azimuth_deg: f64,
    ) -> NodeLight {
        const STEP_KM: f64 = 0.02;
        let (sin, cos) = altitude_deg.to_radians().sin_cos();
        let azimuth = azimuth_deg.to_radians();
        let dir = DVec3::new(cos * azimuth.cos(), cos * azimuth.sin(), sin);
        let eye = DVec3::new(0.0, 0.0, scene.eye_radius_km);
        let (along, up) = (distance_km / scene.geometry.ground_radius_km()).sin_cos();
        let patch_up = DVec3::new(along, 0.0, up);
        let patch = patch_up * scene.geometry.ground_radius_km();
        let mut light = [0.0; LANES];
        for step in 0.. {
            let s = (f64::from(step) + 0.5) * STEP_KM;
            if (eye + dir * s).length() > EARTH_RADIUS_KM + TOP_OF_LIGHT_KM {
                return light;
            }
            scene.add_point(&mut light, eye, dir, s, STEP_KM, (patch, patch_up));
        }
        light
    }

    #[test]
    fn few_points_find_the_light_of_many() {
        let emission: fn(f64) -> f64 = lambert;
        let scene = Scene::new(&Atmosphere::default(), 0.0, emission);
        let mut most: f64 = 0.0;
        for (altitude, distance, azimuth) in [
            (90.0, 0.5, 0.0),
            (90.0, 20.0, 0.0),
            (45.0, 30.0, 0.0),
            (45.0, 80.0, 0.0),
            (10.0, 5.0, 0.0),
            (10.0, 60.0, 20.0),
            (10.0, 60.0, 180.0),
            (2.0, 100.0, 3.0),
            (0.0, 2.0, 5.0),
            (0.0, 200.0, 0.0),
        ] {
            let got = scene.radiance(f64::to_radians(altitude), distance, f64::to_radians(azimuth));
            let want = in_steps(&scene, altitude, distance, azimuth);
            for (got, want) in got.iter().zip(want) {
                most = most.max((got / want - 1.0).abs());
                let place = format!("{altitude} {distance} {azimuth}");
                assert!((got / want - 1.0).abs() < 0.02, "{place}: {got:e} {want:e}");
            }
        }
        println!("quadrature: at most {:.2} %", 100.0 * most);
    }

    #[test]
    fn tables_hold_what_lies_between_their_nodes() {
        let air = Atmosphere::default();
        let emission: fn(f64) -> f64 = lambert;
        let scene = Scene::new(&air, 0.0, emission);
        let tables = GroundLight::solve(&air, 0.0, emission).unwrap();
        let mut most = [0.0f64; 2];
        for altitude in [1, 4, 8, 12, 16] {
            // Near a patch, a line that runs just over it changes much from node to node.
            let low = usize::from(altitude == 1);
            for distance in [0.23, 1.7, 9.0, 33.0, 77.0, 190.0] {
                // Far patches light the high air alone.
                let within = if distance < 100.0 { [0.12, 0.25] } else { [0.2, 0.4] }[low];
                for [from, to] in [[-10.0, 10.0], [20.0, 60.0], [-30.0, 75.0], [120.0, 230.0]] {
                    let got = tables.mean(altitude, distance, [from, to].map(f64::to_radians));
                    let steps = 60;
                    let mut want = [0.0; LANES];
                    for step in 0..steps {
                        let t = (f64::from(step) + 0.5) / f64::from(steps);
                        let azimuth = f64::to_radians(from + (to - from) * t);
                        let altitude_rad = ALTITUDES_DEG[altitude].to_radians();
                        let one = scene.radiance(altitude_rad, distance, azimuth);
                        want.iter_mut().zip(one).for_each(|(w, o)| *w += o / f64::from(steps));
                    }
                    // What is a hundredth of the light over the patch itself is not seen beside it.
                    let front = tables.mean(altitude, distance, [-0.1, 0.1]);
                    for ((got, want), front) in got.iter().zip(want).zip(front) {
                        let want = want.max(0.01 * front);
                        let got = got.max(0.01 * front);
                        most[low] = most[low].max((got / want - 1.0).abs());
                        let place = format!("{altitude} {distance} {from}");
                        let apart = (got / want - 1.0).abs();
                        assert!(apart < within, "{place}: {got:e} {want:e}");
                    }
                }
            }
        }
        println!("interpolation: at most {most:.3?}, 1 degree high the second");
        // All around is all around, wherever one begins.
        let whole = tables.mean(5, 30.0, [0.0, PI]);
        let again = tables.mean(5, 30.0, [0.3 - PI, 0.3 + PI]);
        assert!(whole.iter().zip(again).all(|(a, b)| (a / b - 1.0).abs() < 1e-5));
    }

    #[test]
    fn beyond_the_horizon_there_is_no_light_low_down() {
        let emission: fn(f64) -> f64 = lambert;
        let scene = Scene::new(&Atmosphere::default(), 0.0, emission);
        // A patch so far away that all of the air over a level line lies below its horizon.
        let behind = scene.radiance(0.0, 300.0, PI);
        assert!(behind.iter().all(|light| *light < 1e-20), "{behind:?}");
        assert!(scene.radiance(0.0, 300.0, 0.0).iter().all(|light| *light > 0.0));
        let tables = GroundLight::solve(&Atmosphere::default(), 0.0, emission).unwrap();
        assert_eq!(tables.mean(5, 1e4, [0.0, PI]), [0.0; LANES]);
    }
}

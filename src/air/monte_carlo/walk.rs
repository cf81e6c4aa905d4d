//! One path of light, followed backwards from the eye.
//!
//! Along a ray a collision is forced: its distance is drawn from a mixture, part by what the air lets
//! through, part evenly, part where the source shines on the ray; the weight is the true density over
//! that of the mixture, for each wavelength. Where a ray meets the ground, ground and air are drawn by
//! what they are likely to send. At each scattering the source is asked directly (next-event
//! estimation), then a new direction is drawn, part by the phase functions, part from the lobe at
//! the horizon ([`Lobe`]). Paths end by Russian roulette that keeps their expectation.

use std::f64::consts::PI;

use glam::DVec3;

use crate::air::scattering::lanes::LANES;
use crate::air::scattering::shaded::LeftAt;

use super::directions::{Lobe, from_ground, turned};
use super::matter::{Light, Matter};
use super::random::Random;
use super::shells::{Columns, Path, Shells};

/// The last order that is counted.
const ORDERS: u32 = 40;
/// Paths may be ended after this order.
const SURE_ORDERS: u32 = 3;
/// The least chance to go on.
const LEAST_SURVIVAL: f64 = 0.1;
/// Steps of the table of what the source lights.
const LIT_STEPS: usize = 1024;
/// Cosines of the zenith distance of the source that it spans.
const LIT_COSINES: [f64; 2] = [-0.45, 0.15];

/// What shines into the air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Source {
    /// A parallel beam of irradiance 1 from a direction.
    Beam(DVec3),
    /// Radiance 1 from everywhere above: for tests of the balance of energy.
    #[cfg_attr(not(test), allow(dead_code, reason = "what is even is known beforehand"))]
    Above,
}

/// How the draws are shared.
#[derive(Debug, Clone, Copy)]
struct Shares {
    by_transmittance: f64,
    evenly: f64,
    where_lit: f64,
    lobe: f64,
}

impl Shares {
    /// For a source of this sine of the elevation.
    fn of(source: &Source, up: DVec3) -> Shares {
        let of = |by_transmittance, evenly, where_lit, lobe| Shares {
            by_transmittance,
            evenly,
            where_lit,
            lobe,
        };
        match source {
            Source::Above => of(0.8, 0.2, 0.0, 0.0),
            Source::Beam(dir) if dir.dot(up) > 0.3 => of(0.8, 0.2, 0.0, 0.1),
            Source::Beam(dir) if dir.dot(up) > 0.05 => of(0.6, 0.2, 0.2, 0.25),
            Source::Beam(_) => of(0.30, 0.15, 0.55, 0.45),
        }
    }
}

/// Which part of the light of a source arrives in each layer, by its zenith distance, at one
/// wavelength: a guide for draws, no part of the result.
#[derive(Debug, Clone)]
pub(super) struct LitTable(Vec<f32>);

impl LitTable {
    pub fn new(shells: &Shells, matter: &Matter) -> LitTable {
        let lane = matter.count / 2;
        let [low, high] = LIT_COSINES;
        let of = |layer: usize, step: usize| {
            let cosine = low + (high - low) * step as f64 / (LIT_STEPS - 1) as f64;
            let columns = shells.to_space(shells.middle_km(layer), cosine);
            columns.map_or(0.0, |columns| (-matter.depth_of(lane, &columns)).exp() as f32)
        };
        let layers = 0..shells.layer_count();
        let of = &of;
        LitTable(layers.flat_map(|l| (0..LIT_STEPS).map(move |step| of(l, step))).collect())
    }

    fn at(&self, layer: usize, cosine: f64) -> f64 {
        let [low, high] = LIT_COSINES;
        let step = (cosine - low) / (high - low) * (LIT_STEPS - 1) as f64;
        let step = step.clamp(0.0, (LIT_STEPS - 1) as f64) as usize;
        f64::from(self.0[layer * LIT_STEPS + step])
    }
}

/// What is left of the source at a place, by wavelength: see [`super::MonteCarlo::radiance_in_shade`].
#[derive(Clone, Copy)]
pub(super) struct Shade<'a> {
    pub left_at: &'a LeftAt<'a>,
    /// The point at sea level from which places are counted, from the Earth's centre, kilometres.
    pub origin: DVec3,
}

impl std::fmt::Debug for Shade<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Shade").field("origin", &self.origin).finish_non_exhaustive()
    }
}

/// The air as paths see it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scene<'a> {
    pub shells: &'a Shells,
    pub matter: &'a Matter,
    pub lit: &'a LitTable,
    pub source: Source,
    pub shade: Option<Shade<'a>>,
}

impl Scene<'_> {
    /// Irradiance of the beam at a point, on a plane that faces it.
    pub fn beam(&self, at: DVec3, dir: DVec3) -> Option<Light> {
        let r = at.length();
        let columns = self.shells.to_space(r, at.dot(dir) / r)?;
        let mut beam = self.matter.transmittance(&columns);
        if let Some(shade) = self.shade {
            let left = (shade.left_at)(at - shade.origin);
            beam.iter_mut().zip(left).for_each(|(beam, left)| *beam *= left);
        }
        Some(beam)
    }
}

/// Where a path begins.
#[derive(Debug, Clone, Copy)]
pub(super) enum Start {
    /// Along a line of sight.
    Sight { eye: DVec3, dir: DVec3 },
    /// In all directions above a level plane, for its irradiance.
    Plane { at: DVec3 },
}

/// A drawn collision.
struct Collision {
    distance_km: f64,
    piece: usize,
    columns: Columns,
    /// Per kilometre.
    probability: f64,
}

/// Follows paths through one scene.
pub(super) struct Walker<'a> {
    scene: Scene<'a>,
    start: Start,
    /// Orders below are not counted.
    from_order: u32,
    shares: Shares,
    /// The line of sight, which all paths begin with.
    sight: Path,
    path: Path,
    /// What is lit up to each piece of the path.
    lit: Vec<f64>,
}

impl<'a> Walker<'a> {
    pub fn new(scene: Scene<'a>, start: Start, from_order: u32) -> Walker<'a> {
        let mut sight = Path::default();
        let up = match start {
            Start::Sight { eye, dir } => {
                let r = eye.length();
                scene.shells.cut(r, eye.dot(dir) / r, &mut sight);
                eye / r
            }
            Start::Plane { at } => at.normalize(),
        };
        let shares = Shares::of(&scene.source, up);
        Walker { scene, start, from_order, shares, sight, path: Path::default(), lit: Vec::new() }
    }

    /// The light that one path brings: radiance, or irradiance of a plane.
    pub fn walk(&mut self, random: &mut Random) -> Light {
        let Scene { shells, matter, source, .. } = self.scene;
        let count = matter.count;
        let mut light = [0.0; LANES];
        let mut weight = [1.0; LANES];
        let (mut at, mut dir) = match self.start {
            Start::Sight { eye, dir } => (eye, dir),
            Start::Plane { at } => {
                let Some((dir, factor)) = self.off_ground(at.normalize(), random) else {
                    return light;
                };
                weight = [PI * factor; LANES];
                (at, dir)
            }
        };
        for order in 1..=ORDERS {
            let counts = order >= self.from_order;
            match (order, self.start) {
                (1, Start::Sight { .. }) => self.path.clone_from(&self.sight),
                _ => {
                    let r = at.length();
                    shells.cut(r, at.dot(dir) / r, &mut self.path);
                }
            }
            let through = matter.transmittance(self.path.all_columns());
            if source == Source::Above && !self.path.hits_ground() {
                for i in 0..count {
                    light[i] += weight[i] * through[i];
                }
            }
            let ground_share = self.ground_share(&through);
            if random.unit() < ground_share {
                at += dir * self.path.length_km();
                let up = at.normalize();
                at = up * (shells.ground_km());
                for i in 0..count {
                    weight[i] *= through[i] * matter.ground_albedo / ground_share;
                }
                if let Source::Beam(sun) = source
                    && counts
                    && sun.dot(up) > 0.0
                    && let Some(beam) = self.scene.beam(at, sun)
                {
                    for i in 0..count {
                        light[i] += weight[i] * beam[i] * sun.dot(up) / PI;
                    }
                }
                let Some((next, factor)) = self.off_ground(up, random) else { break };
                weight.iter_mut().for_each(|weight| *weight *= factor);
                dir = next;
            } else {
                let Some(hit) = self.collide(at, dir, &through, random) else { break };
                let passed = matter.transmittance(&hit.columns);
                let factor = 1.0 / (hit.probability * (1.0 - ground_share));
                for i in 0..count {
                    weight[i] *= passed[i] * factor;
                }
                at += dir * hit.distance_km;
                let density = shells.density(self.path.layer(hit.piece), at.length());
                let scatter = matter.scatter(&density);
                if let Source::Beam(sun) = source
                    && counts
                    && let Some(beam) = self.scene.beam(at, sun)
                {
                    let scattered = matter.scattered(&scatter, dir.dot(sun));
                    for i in 0..count {
                        light[i] += weight[i] * beam[i] * scattered[i];
                    }
                }
                let shares = matter.shares(&scatter);
                let lobe = match source {
                    Source::Beam(sun) => Some(Lobe::new(at.normalize(), sun)),
                    Source::Above => None,
                };
                let next = match lobe {
                    Some(lobe) if random.unit() < self.shares.lobe => lobe.draw(random),
                    _ => turned(dir, matter.draw(&shares, random), random),
                };
                let nu = dir.dot(next);
                let of_lobe = lobe.map_or(0.0, |lobe| self.shares.lobe * lobe.probability(next));
                let of_phase = (1.0 - self.shares.lobe) * matter.probability(&shares, nu);
                let scattered = matter.scattered(&scatter, nu);
                for i in 0..count {
                    weight[i] *= scattered[i] / (of_lobe + of_phase);
                }
                dir = next;
            }
            let greatest = weight[..count].iter().fold(0.0, |a: f64, &b| a.max(b));
            if greatest <= 0.0 {
                break;
            }
            if order >= SURE_ORDERS {
                let survival = greatest.clamp(LEAST_SURVIVAL, 1.0);
                if random.unit() >= survival {
                    break;
                }
                weight.iter_mut().for_each(|weight| *weight /= survival);
            }
        }
        light
    }

    /// A direction from Lambert ground, and `cos / pi` over its probability; none below it.
    fn off_ground(&self, up: DVec3, random: &mut Random) -> Option<(DVec3, f64)> {
        let lobe = match self.scene.source {
            Source::Beam(sun) => Some(Lobe::new(up, sun)),
            Source::Above => None,
        };
        let dir = match lobe {
            Some(lobe) if random.unit() < self.shares.lobe => lobe.draw(random),
            _ => from_ground(up, random),
        };
        let lambert = dir.dot(up) / PI;
        let of_lobe = lobe.map_or(0.0, |lobe| self.shares.lobe * lobe.probability(dir));
        let probability = of_lobe + (1.0 - self.shares.lobe) * lambert.max(0.0);
        (lambert > 0.0).then(|| (dir, lambert / probability))
    }

    /// How often the ground at the end of the path is chosen.
    fn ground_share(&self, through: &Light) -> f64 {
        let Matter { count, ground_albedo, .. } = *self.scene.matter;
        if !self.path.hits_ground() || ground_albedo <= 0.0 {
            return 0.0;
        }
        let through = through[..count].iter().sum::<f64>() / count as f64;
        let ground = through * ground_albedo;
        (ground / (ground + 1.0 - through)).clamp(0.02, 0.98)
    }

    /// Draws where the path collides; none where there is nothing to collide with.
    fn collide(
        &mut self,
        at: DVec3,
        dir: DVec3,
        through: &Light,
        random: &mut Random,
    ) -> Option<Collision> {
        let Scene { shells, matter, source, .. } = self.scene;
        let length = self.path.length_km();
        if length <= 0.0 || self.path.pieces() == 0 {
            return None;
        }
        let mut shares = self.shares;
        let lit = match source {
            Source::Beam(sun) if shares.where_lit > 0.0 => self.light_up(at, dir, sun),
            _ => 0.0,
        };
        if lit <= 0.0 {
            let rest = 1.0 - shares.where_lit;
            shares.where_lit = 0.0;
            shares.by_transmittance /= rest;
            shares.evenly /= rest;
        }
        let path = &self.path;
        let count = matter.count;
        let kind = random.unit();
        let draw = random.unit();
        let inside = |piece: usize, share: f64| {
            let (from, to) = (path.distance_km(piece), path.distance_km(piece + 1));
            from + (to - from) * share.clamp(0.0, 1.0)
        };
        let (piece, distance_km) = if kind < shares.by_transmittance {
            let lane = ((random.unit() * count as f64) as usize).min(count - 1);
            let depth = -(draw * (through[lane] - 1.0)).ln_1p();
            let (mut low, mut high) = (0, path.pieces());
            while high - low > 1 {
                let middle = (low + high) / 2;
                match matter.depth_of(lane, path.columns(middle)) <= depth {
                    true => low = middle,
                    false => high = middle,
                }
            }
            let from = matter.depth_of(lane, path.columns(low));
            let to = matter.depth_of(lane, path.columns(low + 1));
            let share = if to > from { (depth - from) / (to - from) } else { 0.5 };
            (low, inside(low, share))
        } else if kind < shares.by_transmittance + shares.evenly {
            let distance = draw * length;
            (path.piece_at(distance), distance)
        } else {
            let wanted = draw * lit;
            let piece = self.lit.partition_point(|&sum| sum <= wanted).min(path.pieces() - 1);
            (piece, inside(piece, random.unit()))
        };

        let (from, to) = (path.distance_km(piece), path.distance_km(piece + 1));
        let thickness = to - from;
        if thickness <= 0.0 {
            return None;
        }
        let share = (distance_km - from) / thickness;
        let (near, far) =
            (matter.depth(path.columns(piece)), matter.depth(path.columns(piece + 1)));
        let mut by_transmittance = 0.0;
        for i in 0..count {
            let step = far[i] - near[i];
            if step > 0.0 {
                let density = step / thickness * (-(near[i] + step * share)).exp();
                by_transmittance += density / (1.0 - through[i]).max(1e-300);
            }
        }
        let mut probability =
            shares.by_transmittance * by_transmittance / count as f64 + shares.evenly / length;
        if shares.where_lit > 0.0 {
            let before = if piece > 0 { self.lit[piece - 1] } else { 0.0 };
            probability += shares.where_lit * (self.lit[piece] - before) / (lit * thickness);
        }
        let columns = path.columns_at(shells, piece, distance_km);
        Some(Collision { distance_km, piece, columns, probability })
    }

    /// Sums up, along the path, how much sunlight it scatters, roughly.
    fn light_up(&mut self, at: DVec3, dir: DVec3, sun: DVec3) -> f64 {
        let Scene { matter, lit, .. } = self.scene;
        let lane = matter.count / 2;
        let (at_sun, dir_sun) = (at.dot(sun), dir.dot(sun));
        self.lit.clear();
        let (mut sum, mut before) = (0.0, 1.0);
        for piece in 0..self.path.pieces() {
            let after = (-matter.depth_of(lane, self.path.columns(piece + 1))).exp();
            let (from, to) = (self.path.distance_km(piece), self.path.distance_km(piece + 1));
            let middle = 0.5 * (from + to);
            let cosine = (at_sun + middle * dir_sun) / self.path.radius_km(middle);
            sum += (before - after) * lit.at(self.path.layer(piece), cosine);
            self.lit.push(sum);
            before = after;
        }
        sum
    }
}

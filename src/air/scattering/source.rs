//! Light of a distant source on its bent way to every point of the air.
//!
//! A placeholder head.

mod beams;
mod shells;

use std::f64::consts::{FRAC_PI_2, PI};

use rayon::prelude::*;

pub(crate) use beams::Beams;
use beams::{Node, Shadow};

use super::harmonics::gauss_legendre;
use super::lanes::Lanes;
use super::profile::{Optics, SPECIES};
use crate::units::Angle;

/// Zenith distances of the table.
const NODES: usize = 128;
/// How the nodes crowd towards the dark, in cosines: at the ground, high up, and half way at a height.
const BEND_LOW: f64 = 0.03;
const BEND_HIGH: f64 = 0.02;
const BEND_KM: f64 = 3.0;
/// Chords that the disc of the source is cut in.
const CHORDS: usize = 8;
/// Linear law of limb darkening: radiance falls by this part from the centre of the disc to its limb.
const LIMB_DARKENING: f64 = 0.6;
/// Farther from the edge of the shadow a disc is as good as a point, radians.
const DISC_MATTERS: f64 = 0.27;

/// Transmitted irradiance of a distant source everywhere in the air, one band of wavelengths.
#[derive(Debug, Clone)]
pub(crate) struct SourceTable {
    shadow: Shadow,
    disc_radius: Angle,
    /// `[level][zenith distance]`, from where the source has set up to the zenith: fourth roots.
    roots: Vec<Lanes>,
}

/// A height, prepared for many look-ups.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SourceRow {
    /// Of the first node of the lower level.
    index: usize,
    weight: f32,
    /// Cosine of the zenith distance at which the whole source has set.
    mu_dark: f64,
    scale: Scale,
}

/// Where in a row of the table a source stands that is `light` above the dark, in cosines:
/// `light / (light + bend)` in units of its value at the zenith.
#[derive(Debug, Clone, Copy)]
struct Scale {
    bend: f32,
    places: f32,
}

impl Scale {
    fn new(height_above_ground_km: f64, mu_dark: f64) -> Scale {
        // The air near a level ray is as high as that ray is far: from far off it looks thin.
        let bend = BEND_HIGH + (BEND_LOW - BEND_HIGH) / (1.0 + height_above_ground_km / BEND_KM);
        let places = (NODES - 1) as f64 * (1.0 - mu_dark + bend) / (1.0 - mu_dark);
        Scale { bend: bend as f32, places: places as f32 }
    }
    fn light(self, node: usize) -> f64 {
        let part = node as f64 / f64::from(self.places);
        f64::from(self.bend) * part / (1.0 - part)
    }
}

impl SourceTable {
    /// Geometry shared by all bands of one air.
    pub fn new(beams: &Beams, optics: &Optics) -> SourceTable {
        let disc = Disc::new(beams.disc_radius());
        let shadow = beams.shadow().clone();
        let ground_km = beams.heights_km()[0];
        let roots = beams
            .heights_km()
            .par_iter()
            .enumerate()
            .flat_map_iter(|(level, &height_km)| {
                let source = PointSource { nodes: beams.nodes(level), optics };
                let edge = shadow.edge(height_km);
                let mu_dark = edge.cos_below(disc.radius);
                let disc = &disc;
                let scale = Scale::new(height_km - ground_km, mu_dark);
                (0..NODES).map(move |i| {
                    let mu = mu_dark + scale.light(i);
                    disc.irradiance(&source, mu.min(1.0).acos()).map(|f| f.sqrt().sqrt())
                })
            })
            .collect();
        SourceTable { shadow, disc_radius: beams.disc_radius(), roots }
    }

    /// Prepares a height above sea level; clamped to the air.
    pub fn row(&self, height_km: f64) -> SourceRow {
        let edge = self.shadow.edge(height_km);
        let mu_dark = edge.cos_below(self.disc_radius.rad());
        SourceRow {
            index: edge.level * NODES,
            weight: edge.weight as f32,
            mu_dark,
            scale: Scale::new(edge.height_km - self.shadow.ground_km(), mu_dark),
        }
    }

    /// Irradiance on a plane facing the source, per unit irradiance outside the air.
    ///
    /// `mu` is the cosine of the true zenith distance of the source at that height. Zero in full
    /// shadow.
    #[inline]
    pub fn irradiance(&self, row: &SourceRow, mu: f64) -> Lanes {
        let light = (mu - row.mu_dark) as f32;
        if light <= 0.0 {
            return Lanes::ZERO;
        }
        let place = light / (light + row.scale.bend) * row.scale.places;
        let i = (place as i32 as usize).min(NODES - 2);
        let weight = place - i as f32;
        let low = &self.roots[row.index + i..][..2];
        let high = &self.roots[row.index + NODES + i..][..2];
        let root = low[0].lerp(low[1], weight).lerp(high[0].lerp(high[1], weight), row.weight);
        let square = root * root;
        square * square
    }
}

/// What a point source sends to one level.
struct PointSource<'a> {
    nodes: &'a [Node],
    optics: &'a Optics,
}

impl PointSource<'_> {
    /// True zenith distance at which the ground hides it, radians.
    fn edge(&self) -> f64 {
        self.nodes.last().map_or(0.0, |n| n.true_zenith)
    }

    /// Irradiance on a plane facing it, at a true zenith distance not past the edge.
    fn irradiance(&self, true_zenith: f64) -> Lanes {
        let nodes = self.nodes;
        if nodes.len() < 4 {
            return Lanes::ZERO;
        }
        let after = nodes.partition_point(|n| n.true_zenith < true_zenith);
        let first = after.clamp(2, nodes.len() - 2) - 2;
        let near = &nodes[first..first + 4];
        let mut values = [0.0; SPECIES + 1];
        for (i, node) in near.iter().enumerate() {
            let mut weight = 1.0;
            for (j, other) in near.iter().enumerate() {
                if i != j {
                    weight *=
                        (true_zenith - other.true_zenith) / (node.true_zenith - other.true_zenith);
                }
            }
            for (sum, value) in values.iter_mut().zip(node.values) {
                *sum += weight * value;
            }
        }
        let columns = std::array::from_fn(|k| values[k] as f32);
        (Lanes::splat(values[SPECIES] as f32) - self.optics.optical_depth(columns)).exp()
    }
}

/// The disc of the source, cut in level chords.
struct Disc {
    radius: f64,
    nodes: Vec<(f64, f64)>,
}

impl Disc {
    fn new(radius: Angle) -> Disc {
        Disc { radius: radius.rad(), nodes: gauss_legendre(CHORDS) }
    }

    /// The mean over the disc of what its points send, with its centre at a true zenith distance.
    fn irradiance(&self, point: &PointSource, true_zenith: f64) -> Lanes {
        let edge = point.edge();
        if self.radius == 0.0 || true_zenith < edge - DISC_MATTERS {
            return point.irradiance(true_zenith.min(edge));
        }
        // Chords lie at the sine of an angle, from the upper limb to the lower or the edge.
        let lowest = ((edge - true_zenith) / self.radius).clamp(-1.0, 1.0).asin();
        let span = lowest + FRAC_PI_2;
        let mut sum = Lanes::ZERO;
        for (t, weight) in &self.nodes {
            let (sin, cos) = (span * t - FRAC_PI_2).sin_cos();
            // Length of the chord times its mean radiance, times the distance to the next.
            let chord = 2.0 * (1.0 - LIMB_DARKENING) * cos + LIMB_DARKENING * FRAC_PI_2 * cos * cos;
            let share = chord * cos * span * weight / (PI * (1.0 - LIMB_DARKENING / 3.0));
            let zenith = (true_zenith + self.radius * sin).clamp(0.0, edge);
            sum += point.irradiance(zenith) * share as f32;
        }
        sum
    }
}

#[cfg(test)]
mod tests;

//! What comes from a point of a distant source to each height, against the true zenith distance.
//!
//! *How.* With the same `p = n r sin(zenith distance)` one ray serves all heights that it crosses, on
//! its way down and on its way out again. Rays are followed once: to the ground, dense towards the level
//! one, and past it, one for each level that they touch and one between each two. At each level the
//! rays that reach it are its nodes; between them everything is a cubic in the true zenith distance.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;

use super::super::profile::{Profile, SPECIES};
use super::shells::{Beam, Shells, Trace};
use crate::units::Angle;

/// Rays that end on the ground.
const GROUND_RAYS: usize = 120;
/// Rays closer than this count once, radians.
const CLOSEST: f64 = 1e-4;

/// Columns and beam divergence over height and true zenith distance, for all wavelengths.
#[derive(Debug, Clone)]
pub(crate) struct Beams {
    shells: Shells,
    /// From the zenith to the edge of the shadow, for each level.
    rows: Vec<Vec<Node>>,
    shadow: Shadow,
    disc_radius: Angle,
}

/// Where the ground hides a point of the source, height by height.
#[derive(Debug, Clone)]
pub(super) struct Shadow {
    heights_km: Vec<f64>,
    /// Scaled radii.
    x_km: Vec<f64>,
    /// `u` of the ray that grazes the ground.
    u_km: Vec<f64>,
    /// True less apparent zenith distance of that ray, radians.
    turns: Vec<f64>,
}

/// A height between two levels, and the edge of the shadow there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// The level below.
    pub level: usize,
    /// The part of the way to the level above, by the distance to the horizon.
    pub weight: f64,
    /// Zenith distances from which the edge is seen, and less of which it truly lies, radians.
    pub apparent_cos: f64,
    pub apparent_sin: f64,
    pub turn: f64,
}

impl Shadow {
    fn new(shells: &Shells) -> Shadow {
        let levels = shells.levels();
        let ground_x_km = shells.ground().x_km;
        let turns: Vec<f64> =
            shells.trace(ground_x_km).after_lowest.iter().map(Beam::turn).collect();
        debug_assert_eq!(turns.len(), levels.len());
        Shadow {
            heights_km: levels.iter().map(|l| l.height_km).collect(),
            x_km: levels.iter().map(|l| l.x_km).collect(),
            u_km: levels.iter().map(|l| leg_km(l.x_km, ground_x_km)).collect(),
            turns,
        }
    }

    pub fn edge(&self, height_km: f64) -> Edge {
        let last = self.heights_km.len() - 1;
        let height_km = height_km.clamp(self.heights_km[0], self.heights_km[last]);
        let level = self.heights_km.partition_point(|&h| h <= height_km).clamp(1, last) - 1;
        let between = |of: &[f64], weight: f64| of[level] + (of[level + 1] - of[level]) * weight;
        let gap_km = self.heights_km[level + 1] - self.heights_km[level];
        let x_km = between(&self.x_km, (height_km - self.heights_km[level]) / gap_km);
        // Everything here changes with the distance to the horizon, not with the height.
        let u_km = leg_km(x_km, self.x_km[0]);
        let weight = (u_km - self.u_km[level]) / (self.u_km[level + 1] - self.u_km[level]);
        Edge {
            level,
            weight,
            apparent_cos: -u_km / x_km,
            apparent_sin: self.x_km[0] / x_km,
            turn: between(&self.turns, weight),
        }
    }
}

impl Edge {
    /// Cosine of the true zenith distance of what lies so many radians below the edge.
    pub fn cos_below(&self, rad: f64) -> f64 {
        let (sin, cos) = (self.turn + rad).sin_cos();
        self.apparent_cos * cos - self.apparent_sin * sin
    }
}

/// `sqrt(a^2 - b^2)`.
fn leg_km(hypotenuse_km: f64, leg_km: f64) -> f64 {
    ((hypotenuse_km - leg_km) * (hypotenuse_km + leg_km)).max(0.0).sqrt()
}

/// One ray at one level.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// Radians.
    pub true_zenith: f64,
    /// Columns in km of relative density; the logarithm of the divergence.
    pub values: [f64; SPECIES + 1],
}

impl From<&Beam> for Node {
    fn from(beam: &Beam) -> Node {
        let mut values = [0.0; SPECIES + 1];
        values[..SPECIES].copy_from_slice(&beam.columns);
        values[SPECIES] = beam.divergence.ln();
        Node { true_zenith: beam.true_zenith, values }
    }
}

impl Beams {
    /// For a ground at a height above sea level, air of a refractivity at sea level (0: straight rays),
    /// and a source of an angular radius (0: a point).
    pub fn new(
        profile: &Profile,
        ground_km: f64,
        sea_level_refractivity: f64,
        disc_radius: Angle,
    ) -> Beams {
        let shells = Shells::new(profile, ground_km, sea_level_refractivity, 1);
        let traces: Vec<Trace> =
            invariants_km(&shells).into_par_iter().map(|p_km| shells.trace(p_km)).collect();
        let rows: Vec<Vec<Node>> =
            (0..shells.levels().len()).into_par_iter().map(|level| nodes(&traces, level)).collect();
        let shadow = Shadow::new(&shells);
        Beams { shells, rows, shadow, disc_radius }
    }

    pub(super) fn shadow(&self) -> &Shadow {
        &self.shadow
    }
    pub fn disc_radius(&self) -> Angle {
        self.disc_radius
    }
    /// Heights of the levels, km.
    pub(super) fn heights_km(&self) -> &[f64] {
        &self.shadow.heights_km
    }
    /// The rays that reach a level.
    pub(super) fn nodes(&self, level: usize) -> &[Node] {
        &self.rows[level]
    }

    /// Apparent minus true altitude of a point of the source, seen from a height; `mu` is the cosine of
    /// its true zenith distance. Below the horizon, that of the horizon.
    pub fn refraction(&self, height_km: f64, mu: f64) -> Angle {
        if self.shells.is_straight() {
            return Angle::ZERO;
        }
        let true_zenith = mu.clamp(-1.0, 1.0).acos();
        let turn = |apparent: f64| self.shells.beam_at(height_km, apparent).turn();
        let edge = self.shadow.edge(height_km);
        let lowest = edge.apparent_sin.atan2(edge.apparent_cos);
        // The root of a function that grows, between two points where its signs differ, by secants;
        // the end that stays counts half each time (the Illinois rule).
        let (mut low, mut low_error) = (0.0, -true_zenith);
        let (mut high, mut high_error) = (lowest, lowest + turn(lowest) - true_zenith);
        if high_error <= 0.0 {
            return Angle::from_rad(turn(lowest));
        }
        let mut last_side = 0;
        for _ in 0..40 {
            let apparent = high - high_error * (high - low) / (high_error - low_error);
            let error = apparent + turn(apparent) - true_zenith;
            if error.abs() < 1e-10 || high - low < 1e-12 {
                return Angle::from_rad(true_zenith - apparent);
            }
            if error > 0.0 {
                (high, high_error) = (apparent, error);
                if last_side == 1 {
                    low_error *= 0.5;
                }
                last_side = 1;
            } else {
                (low, low_error) = (apparent, error);
                if last_side == -1 {
                    high_error *= 0.5;
                }
                last_side = -1;
            }
        }
        Angle::from_rad(true_zenith - 0.5 * (low + high))
    }
}

impl Beam {
    /// True less apparent zenith distance, radians.
    fn turn(&self) -> f64 {
        self.true_zenith - self.apparent_zenith
    }
}

/// Rays to follow, by their invariants, ascending.
fn invariants_km(shells: &Shells) -> Vec<f64> {
    let ground_x_km = shells.ground().x_km;
    let to_ground = (0..GROUND_RAYS).map(|i| {
        let part = 1.0 - i as f64 / GROUND_RAYS as f64;
        ground_x_km * (FRAC_PI_2 * part * part).cos()
    });
    let levels = shells.levels();
    let past_ground = levels.windows(2).flat_map(|l| {
        let (low, high) = (l[0].x_km, l[1].x_km);
        [low, 0.5 * (low + high)]
    });
    to_ground.chain(past_ground).chain([levels[levels.len() - 1].x_km]).collect()
}

/// What rays bring to a level, by true zenith distance.
fn nodes(traces: &[Trace], level: usize) -> Vec<Node> {
    let at = |trace: &Trace| level.checked_sub(trace.first);
    let descending = traces.iter().filter_map(|t| t.before_lowest.get(at(t)?));
    let ascending = traces.iter().rev().filter_map(|t| t.after_lowest.get(at(t)?));
    let mut nodes: Vec<Node> = Vec::with_capacity(2 * traces.len());
    for beam in descending.chain(ascending) {
        if nodes.last().is_none_or(|last| beam.true_zenith > last.true_zenith + CLOSEST) {
            nodes.push(Node::from(beam));
        }
    }
    // The edge of the shadow is exact.
    if let Some(edge) = traces.iter().find_map(|t| t.after_lowest.get(at(t)?)) {
        if nodes.len() > 1 && edge.true_zenith < nodes[nodes.len() - 1].true_zenith + CLOSEST {
            nodes.pop();
        }
        nodes.push(Node::from(edge));
    }
    nodes
}

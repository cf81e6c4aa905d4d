//! The field that a sky makes in the air, for one order in azimuth: `x = b + A x`, a small matrix.
//!
//! Unknown are the moments of the whole radiance, direct, scattered and from the ground, at each
//! height, and (order 0) the irradiance of the ground. `A` marches rays from every height through the
//! source function of the moments and takes moments of what arrives; `b` are the moments of what
//! comes straight from outside. The whole radiance rather than its scattered part is expanded, so
//! that an even light stays even to rounding, whatever the degree: its expansion ends with degree 0.
//!
//! Degrees above 2 are kept at heights with aerosol only; molecules do not ask for them.

use rayon::prelude::*;

use super::super::harmonics::gauss_legendre;
use super::super::lanes::{LANES, Lanes};
use super::super::profile::SCATTERERS;
use super::super::rays::RaySteps;
use super::legendre::Legendre;
use super::path::{Air, Path};
use crate::air::EARTH_RADIUS_KM;

/// The degree that molecules ask for.
pub(super) const MOLECULAR_DEGREE: usize = 2;
/// The iteration ends when nothing changes by more than this part of the greatest moment.
const TOLERANCE: f32 = 1e-6;
/// It ends here if rounding keeps it from that; the densest air over white ground takes 300.
const MOST_ITERATIONS: usize = 1000;

/// Where the field is known, and to which degree.
#[derive(Debug, Clone)]
pub(super) struct Nodes {
    pub altitudes_km: Vec<f64>,
    pub degrees: Vec<usize>,
    /// Legendre moments of the phase functions by degree.
    pub phases: Vec<[Lanes; SCATTERERS]>,
}

/// What one sample scatters out of each degree.
#[inline(always)]
pub(super) fn scattered(weights: &[Lanes; SCATTERERS], phase: &[Lanes; SCATTERERS]) -> Lanes {
    weights[0] * phase[0] + weights[1] * phase[1] + weights[2] * phase[2]
}

/// A direction at a node, and its share.
#[derive(Debug, Clone, Copy)]
struct Spoke {
    altitude: usize,
    cos_zenith: f64,
    /// Width in the cosine.
    width: f64,
    passed: Lanes,
}

/// The unknowns of one order.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    pub legendre: Legendre,
    /// Of the lowest degree at each height; one more for the end.
    pub starts: Vec<usize>,
    /// The irradiance of the ground, order 0 only.
    pub ground: Option<usize>,
    pub len: usize,
}

impl Layout {
    pub fn new(nodes: &Nodes, order: usize) -> Layout {
        let mut starts = vec![0];
        for &degree in &nodes.degrees {
            starts.push(starts[starts.len() - 1] + (degree + 1).saturating_sub(order));
        }
        let moments = starts[starts.len() - 1];
        let ground = (order == 0).then_some(moments);
        let highest = nodes.degrees.iter().copied().max().unwrap_or(0).max(order);
        let len = moments + usize::from(order == 0);
        Layout { legendre: Legendre::new(order, highest), starts, ground, len }
    }

    /// How many degrees there are at a height.
    #[inline(always)]
    pub fn degrees(&self, altitude: usize) -> usize {
        self.starts[altitude + 1] - self.starts[altitude]
    }

    /// Visits the unknowns that light a path: their place, and their weight in its radiance.
    #[inline(always)]
    pub fn along(&self, nodes: &Nodes, path: &Path, mut visit: impl FnMut(usize, Lanes)) {
        let order = self.legendre.order;
        for sample in &path.samples {
            let (low, t) = (sample.altitude.index, sample.altitude.weight);
            let (n_low, n_high) = (self.degrees(low), self.degrees(low + 1));
            let most = n_low.max(n_high);
            self.legendre.each(sample.cos_view, |l, p| {
                let k = l - order;
                if k >= most {
                    return;
                }
                let weight = scattered(&sample.weights, &nodes.phases[l]) * p as f32;
                if k < n_low {
                    visit(self.starts[low] + k, weight * (1.0 - t));
                }
                if k < n_high {
                    visit(self.starts[low + 1] + k, weight * t);
                }
            });
        }
    }
}

/// `A` of one order.
#[derive(Debug, Clone)]
pub(super) struct Operator {
    pub layout: Layout,
    /// Row by row.
    matrix: Vec<Lanes>,
}

/// All that is needed to find the field of any sky.
#[derive(Debug, Clone)]
pub(super) struct Operators {
    pub nodes: Nodes,
    spokes: Vec<Spoke>,
    /// By order.
    pub orders: Vec<Operator>,
}

/// Directions at a node, and how its rays are cut.
pub(super) struct Rule {
    pub above: usize,
    pub below: usize,
    pub steps: RaySteps,
}

impl Operators {
    /// For the orders up to one.
    pub fn new(air: &Air, nodes: Nodes, rule: &Rule, order: usize) -> Operators {
        let layouts: Vec<Layout> = (0..=order).map(|m| Layout::new(&nodes, m)).collect();
        let (above, below) = (gauss_legendre(rule.above), gauss_legendre(rule.below));
        let per_altitude: Vec<(Vec<Spoke>, Vec<Rows>)> = (0..nodes.altitudes_km.len())
            .into_par_iter()
            .map(|altitude| {
                let height_km = nodes.altitudes_km[altitude];
                let mut rows: Vec<Rows> =
                    layouts.iter().map(|layout| Rows::new(layout, altitude)).collect();
                // Dense next to the horizon, on both sides of it.
                let ratio = air.geometry.ground_radius_km() / (EARTH_RADIUS_KM + height_km);
                let horizon = -(1.0 - ratio * ratio).max(0.0).sqrt();
                let up = above.iter().map(|&(t, w)| (1.0 - horizon, t, w));
                let down = below.iter().map(|&(t, w)| (-1.0 - horizon, t, w));
                let spokes = up
                    .chain(down)
                    .map(|(span, t, w)| {
                        let cos_zenith = horizon + span * t * t;
                        let width = span.abs() * 2.0 * t * w;
                        let path = Path::cut(air, &rule.steps, height_km, cos_zenith);
                        for (rows, layout) in rows.iter_mut().zip(&layouts) {
                            rows.add(layout, &nodes, air, &path, cos_zenith, width);
                        }
                        Spoke { altitude, cos_zenith, width, passed: path.passed() }
                    })
                    .collect();
                (spokes, rows)
            })
            .collect();

        let mut orders: Vec<Operator> =
            layouts.into_iter().map(|layout| Operator { layout, matrix: Vec::new() }).collect();
        let mut spokes = Vec::new();
        let mut ground = Vec::new();
        for (mine, rows) in per_altitude {
            spokes.extend(mine);
            for (operator, rows) in orders.iter_mut().zip(rows) {
                operator.matrix.extend(rows.moments);
                ground.extend(rows.ground);
            }
        }
        orders[0].matrix.extend(ground);
        Operators { nodes, spokes, orders }
    }

    /// The field of a light from outside, given by height and cosine of zenith distance, with the
    /// azimuth of one order.
    pub fn solve(&self, order: usize, light: impl Fn(f64, f64) -> f64) -> Vec<Lanes> {
        let Operator { layout, .. } = &self.orders[order];
        let mut first = vec![Lanes::ZERO; layout.len];
        let norm = layout.legendre.azimuth_norm();
        for spoke in &self.spokes {
            let height_km = self.nodes.altitudes_km[spoke.altitude];
            if spoke.passed == Lanes::ZERO {
                continue;
            }
            let seen =
                spoke.passed * (light(height_km, spoke.cos_zenith) * spoke.width * norm) as f32;
            let start = layout.starts[spoke.altitude];
            let count = layout.degrees(spoke.altitude);
            layout.legendre.each(spoke.cos_zenith, |l, p| {
                if l - order < count {
                    first[start + l - order] += seen * p as f32;
                }
            });
            if let (0, Some(ground)) = (spoke.altitude, layout.ground) {
                first[ground] += seen * spoke.cos_zenith.max(0.0) as f32;
            }
        }
        self.orders[order].iterate(&first)
    }
}

/// The rows of `A` that belong to one height.
struct Rows {
    altitude: usize,
    moments: Vec<Lanes>,
    /// That of the irradiance of the ground, at the lowest height, order 0.
    ground: Vec<Lanes>,
    scratch: Vec<Lanes>,
}

impl Rows {
    fn new(layout: &Layout, altitude: usize) -> Rows {
        let has_ground = altitude == 0 && layout.ground.is_some();
        Rows {
            altitude,
            moments: vec![Lanes::ZERO; layout.degrees(altitude) * layout.len],
            ground: vec![Lanes::ZERO; if has_ground { layout.len } else { 0 }],
            scratch: vec![Lanes::ZERO; layout.len],
        }
    }

    /// Adds one direction.
    fn add(
        &mut self,
        layout: &Layout,
        nodes: &Nodes,
        air: &Air,
        path: &Path,
        cos_zenith: f64,
        width: f64,
    ) {
        if layout.len == 0 {
            return;
        }
        let radiance = &mut self.scratch;
        radiance.fill(Lanes::ZERO);
        layout.along(nodes, path, |place, weight| radiance[place] += weight);
        if let (true, Some(ground)) = (path.meets_ground, layout.ground) {
            radiance[ground] += path.transmittance * reflectance(air);
        }
        let solid_angle = width * layout.legendre.azimuth_norm();
        let count = layout.degrees(self.altitude);
        let add = |row: &mut [Lanes], share: f64| {
            let share = share as f32;
            row.iter_mut().zip(radiance.iter()).for_each(|(a, &r)| *a += r * share);
        };
        layout.legendre.each(cos_zenith, |l, p| {
            let k = l - layout.legendre.order;
            if k < count {
                add(&mut self.moments[k * layout.len..][..layout.len], p * solid_angle);
            }
        });
        if !self.ground.is_empty() && cos_zenith > 0.0 {
            add(&mut self.ground, cos_zenith * solid_angle);
        }
    }
}

/// Radiance of the ground per unit irradiance, sr^-1.
pub(super) fn reflectance(air: &Air) -> f32 {
    (air.optics.ground_albedo / std::f64::consts::PI) as f32
}

impl Operator {
    /// Solves `x = first + A x` by orders of scattering.
    fn iterate(&self, first: &[Lanes]) -> Vec<Lanes> {
        let mut x = first.to_vec();
        if self.layout.len == 0 {
            return x;
        }
        let mut term = first.to_vec();
        for _ in 0..MOST_ITERATIONS {
            term = self
                .matrix
                .par_chunks_exact(self.layout.len)
                .with_min_len(64)
                .map(|row| {
                    let mut sum = Lanes::ZERO;
                    row.iter().zip(&term).for_each(|(&a, &x)| sum += a * x);
                    sum
                })
                .collect();
            x.iter_mut().zip(&term).for_each(|(x, &t)| *x += t);
            let greatest = |v: &[Lanes]| -> [f32; LANES] {
                v.iter().fold([0.0; LANES], |most, l| {
                    std::array::from_fn(|i| f32::max(most[i], l.0[i].abs()))
                })
            };
            let (change, whole) = (greatest(&term), greatest(&x));
            if (0..LANES).all(|i| change[i] <= TOLERANCE * whole[i]) {
                break;
            }
        }
        x
    }
}

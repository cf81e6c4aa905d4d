//! Solves for the diffuse field by iterating the whole of it: `M <- M1 + K M`.
//!
//! `M1` are the moments of the first order; `K` marches rays through the source function of the
//! field and takes moments of what arrives. Iterating the total rather than adding orders keeps
//! every node lit, also deep in the shadow.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::Resolution;
use super::field::Field;
use super::harmonics::{
    MAX_COEFFICIENTS, MAX_DEGREE, azimuthal_part, gauss_legendre, index, zonal_part,
};
use super::lanes::Lanes;
use super::rays::{Medium, Ray, RaySteps, Source};
use super::view::{add_higher_orders, first_order};
use crate::background::Interrupt;

/// The iteration ends here if it has not converged before.
const MOST_ITERATIONS: usize = 30;

/// How many directions to look in from a node, and how finely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Directions {
    /// Zenith distances above the horizon.
    pub above: usize,
    /// Zenith distances below the horizon.
    pub below: usize,
    /// Azimuths over the half circle from the source to the opposite side.
    pub azimuths: usize,
    pub steps: RaySteps,
}

/// A ray from a node, and its share of the sphere.
struct Spoke {
    ray: Ray,
    /// Solid angle over `2 pi`.
    weight: f64,
}

/// Harmonics in the directions of one spoke: what takes its radiances to moments.
struct Basis {
    degree: usize,
    order: usize,
    zonal: [f32; MAX_COEFFICIENTS],
    azimuthal: Vec<[f32; MAX_DEGREE + 1]>,
}

impl Basis {
    /// Adds the share of radiances, one per azimuth, to the moments of a node.
    fn project(&self, radiances: &[Lanes], node: &mut [Lanes]) {
        for m in 0..=self.order {
            let mut sum = Lanes::ZERO;
            for (c, &radiance) in self.azimuthal.iter().zip(radiances) {
                sum += radiance * c[m];
            }
            for l in m..=self.degree {
                node[index(l, m)] += sum * self.zonal[index(l, m)];
            }
        }
    }
}

/// All rays from all nodes of a field, node by node from the ground up: what moments are taken over.
struct Sweep {
    spokes: Vec<Spoke>,
    /// Cosines of the azimuths.
    azimuths: Vec<f64>,
}

/// Moments `[altitude][source][coefficient]` and downward irradiances at the ground `[source]`.
struct Moments {
    moments: Vec<Lanes>,
    ground: Vec<Lanes>,
}

impl Sweep {
    fn new(
        medium: &Medium,
        directions: &Directions,
        cut: impl Fn(&Medium, &RaySteps, f64, f64) -> Ray + Sync,
    ) -> Sweep {
        let mut starts = Vec::new();
        for &height_km in medium.altitudes_km {
            // Dense next to the horizon, on both sides of it.
            let horizon = medium.geometry.cos_horizon(height_km);
            for (t, w) in gauss_legendre(directions.above) {
                let span = 1.0 - horizon;
                starts.push((height_km, horizon + span * t * t, span * 2.0 * t * w));
            }
            for (t, w) in gauss_legendre(directions.below) {
                let span = 1.0 + horizon;
                starts.push((height_km, horizon - span * t * t, span * 2.0 * t * w));
            }
        }
        let spokes = starts
            .into_par_iter()
            .map(|(height_km, cos_zenith, weight)| Spoke {
                ray: cut(medium, &directions.steps, height_km, cos_zenith),
                weight,
            })
            .collect();
        let n = directions.azimuths;
        let azimuths = (0..n).map(|i| ((i as f64 + 0.5) * PI / n as f64).cos()).collect();
        Sweep { spokes, azimuths }
    }

    /// Moments of a radiance, which is asked for all sources of one ray, azimuth innermost.
    fn moments(
        &self,
        field: &Field,
        interrupt: &Interrupt,
        radiance: impl Fn(&Ray, &[Source], &mut [Lanes]) + Sync,
    ) -> Moments {
        let cosines = &field.sources.cosines;
        let seen: Vec<Vec<Lanes>> = self
            .spokes
            .par_iter()
            .map(|spoke| {
                let sources: Vec<Source> = cosines
                    .iter()
                    .flat_map(|&cos_source| {
                        self.azimuths.iter().map(move |&cos_azimuth| {
                            Source::new(cos_source, spoke.ray.cos_zenith, cos_azimuth)
                        })
                    })
                    .collect();
                let mut out = vec![Lanes::ZERO; sources.len()];
                if !interrupt.is_raised() {
                    radiance(&spoke.ray, &sources, &mut out);
                }
                out
            })
            .collect();

        let n_az = self.azimuths.len();
        let stride = field.stride();
        let mut moments = vec![Lanes::ZERO; field.altitudes_km.len() * cosines.len() * stride];
        let per_altitude = self.spokes.len() / field.altitudes_km.len();
        moments
            .par_chunks_exact_mut(cosines.len() * stride)
            .zip(
                self.spokes.par_chunks_exact(per_altitude).zip(seen.par_chunks_exact(per_altitude)),
            )
            .for_each(|(nodes, (spokes, seen))| {
                for (spoke, seen) in spokes.iter().zip(seen) {
                    let basis = self.basis(spoke, field.degree);
                    for (node, seen) in nodes.chunks_exact_mut(stride).zip(seen.chunks_exact(n_az))
                    {
                        basis.project(seen, node);
                    }
                }
            });

        let mut ground = vec![Lanes::ZERO; cosines.len()];
        for (spoke, seen) in self.spokes.iter().zip(&seen).take(per_altitude) {
            let flux =
                (spoke.ray.cos_zenith.max(0.0) * spoke.weight * 2.0 * PI / n_az as f64) as f32;
            for (ground, seen) in ground.iter_mut().zip(seen.chunks_exact(n_az)) {
                *ground += seen.iter().fold(Lanes::ZERO, |sum, &l| sum + l) * flux;
            }
        }
        Moments { moments, ground }
    }

    /// The harmonics in the directions of a spoke, times their solid angle.
    fn basis(&self, spoke: &Spoke, degree: usize) -> Basis {
        let mu = spoke.ray.cos_zenith;
        let sin2 = 1.0 - mu * mu;
        let solid_angle = (spoke.weight * 2.0 * PI / self.azimuths.len() as f64) as f32;
        // Orders from the number of azimuths on look like lower ones at their midpoints.
        let order = degree.min(self.azimuths.len() - 1);
        Basis {
            degree,
            order,
            zonal: zonal_part(degree, mu).map(|y| y * solid_angle),
            azimuthal: self
                .azimuths
                .iter()
                .map(|&a| azimuthal_part(order, (sin2.sqrt() * a) as f32, sin2 as f32))
                .collect(),
        }
    }

    /// `K`: moments of what the field sends along all rays.
    fn gather(&self, medium: &Medium, field: &Field, interrupt: &Interrupt) -> Moments {
        self.moments(field, interrupt, |ray, sources, out| {
            add_higher_orders(medium, field, ray, sources, &mut field.step_field(), out);
        })
    }
}

/// The diffuse field of a distant source of unit irradiance, or none if it was interrupted. Rays are
/// straight but for those of the source.
pub(crate) fn solve(
    medium: &Medium,
    field: Field,
    resolution: &Resolution,
    interrupt: &Interrupt,
) -> Option<Field> {
    let sweep = Sweep::new(medium, &resolution.first_order, Ray::for_beam);
    let first = sweep.moments(&field, interrupt, |ray, sources, out| {
        for (light, out) in first_order(medium, ray, sources).iter().zip(out.iter_mut()) {
            *out = light.smooth + light.haze;
        }
    });
    let sweep = Sweep::new(medium, &resolution.higher_orders, Ray::for_field);
    iterate(medium, &sweep, &first, field, resolution.tolerance, interrupt)
}

/// Fixed point of `M = first + K M`, to a change of `ln M_00` below `tolerance`.
fn iterate(
    medium: &Medium,
    sweep: &Sweep,
    first: &Moments,
    mut field: Field,
    tolerance: f32,
    interrupt: &Interrupt,
) -> Option<Field> {
    let add = |a: &[Lanes], b: &[Lanes]| -> Vec<Lanes> {
        a.iter().zip(b).map(|(&a, &b)| a + b).collect()
    };
    field.set(&first.moments, &first.ground);
    for _ in 0..MOST_ITERATIONS {
        let higher = sweep.gather(medium, &field, interrupt);
        if interrupt.is_raised() {
            return None;
        }
        let moments = add(&first.moments, &higher.moments);
        let ground = add(&first.ground, &higher.ground);
        if field.set(&moments, &ground) < tolerance {
            break;
        }
    }
    Some(field)
}

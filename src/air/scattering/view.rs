//! Radiance along a ray: what the source sends, scattered once, and what the field sends.
//!
//! The first order is exact but for the cutting of the ray: phase functions as they are, and the
//! light of the source as it arrives at each step.

use std::f64::consts::PI;
use std::ops::Range;

use multiversion::multiversion;

use super::field::{Field, StepField};
use super::lanes::Lanes;
use super::rays::{FieldStep, Medium, Ray, Source};

/// Light that has been scattered once or reflected once by the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FirstOrder {
    /// By molecules and by the ground.
    pub smooth: Lanes,
    /// By aerosols, with its aureole.
    pub haze: Lanes,
}

/// Light of each source scattered once, or reflected once by the ground, per unit irradiance.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn first_order(medium: &Medium, ray: &Ray, sources: &[Source]) -> Vec<FirstOrder> {
    sources.iter().map(|source| first_order_of(medium, ray, source)).collect()
}

#[inline(always)]
fn first_order_of(medium: &Medium, ray: &Ray, source: &Source) -> FirstOrder {
    let phases = medium.optics.phases(source.nu);
    let (mut smooth, mut haze) = (Lanes::ZERO, Lanes::ZERO);
    for step in &ray.beam {
        let arriving = medium.source.irradiance(&step.row, source.local_cosine(step.turn));
        smooth += step.weights[0] * arriving;
        if step.is_hazy {
            haze += (step.weights[1] * phases[1] + step.weights[2] * phases[2]) * arriving;
        }
    }
    smooth = smooth * phases[0];
    if let Some(turn) = ray.end.ground {
        let mu_s = source.local_cosine(turn);
        let reflected = (medium.optics.ground_albedo / PI) as f32;
        smooth += ray.end.transmittance * medium.on_ground.at(mu_s) * reflected;
    }
    FirstOrder { smooth, haze }
}

/// Adds the light of the field, scattered along the ray or reflected at its end, for each source.
///
/// Steps are the outer loop: the field is brought to a step once for all sources.
pub(crate) fn add_higher_orders(
    medium: &Medium,
    field: &Field,
    ray: &Ray,
    sources: &[Source],
    scratch: &mut StepField,
    out: &mut [Lanes],
) {
    for step in &ray.field {
        let (mut low, mut high) = (1.0f64, -1.0f64);
        for source in sources {
            let mu_s = source.local_cosine(step.turn);
            low = low.min(mu_s);
            high = high.max(mu_s);
        }
        let range = field.sources.bracket(low).index..field.sources.bracket(high).index + 2;
        scatter(field, step, range, sources, scratch, out);
    }
    if let Some(turn) = ray.end.ground {
        let reflected = ray.end.transmittance * (medium.optics.ground_albedo / PI) as f32;
        for (source, out) in sources.iter().zip(out.iter_mut()) {
            *out += reflected * field.ground_irradiance(source.local_cosine(turn));
        }
    }
}

/// Adds what the field scatters in one step.
#[multiversion(targets("x86_64+avx2"))]
fn scatter(
    field: &Field,
    step: &FieldStep,
    range: Range<usize>,
    sources: &[Source],
    scratch: &mut StepField,
    out: &mut [Lanes],
) {
    field.at_step(step, range, scratch);
    for (source, out) in sources.iter().zip(out.iter_mut()) {
        *out += field.scattered(step, scratch, source);
    }
}

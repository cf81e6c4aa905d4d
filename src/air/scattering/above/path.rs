//! What this folder asks of a ray: where it is sampled, what is scattered there, where it ends.

use super::super::lanes::Lanes;
use super::super::profile::{Optics, SCATTERERS};
use super::super::rays::{Bracket, Geometry, RaySteps, walk};

/// A sample of a ray.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// Between which heights of the field it lies.
    pub altitude: Bracket,
    /// Cosine between the ray and the vertical there.
    pub cos_view: f64,
    /// Weight of light scattered by each scatterer.
    pub weights: [Lanes; SCATTERERS],
}

/// A ray, cut.
#[derive(Debug, Clone)]
pub(super) struct Path {
    pub samples: Vec<Sample>,
    /// Transmittance to its end.
    pub transmittance: Lanes,
    pub meets_ground: bool,
}

/// What a path is cut in.
#[derive(Debug, Clone, Copy)]
pub(super) struct Air<'a> {
    pub geometry: &'a Geometry,
    pub optics: &'a Optics,
    pub altitudes_km: &'a [f64],
}

impl Path {
    pub fn cut(air: &Air, rule: &RaySteps, height_km: f64, cos_zenith: f64) -> Path {
        let mut samples = Vec::new();
        let end = walk(air.geometry, air.optics, rule, (height_km, cos_zenith), |step| {
            samples.push(Sample {
                altitude: Bracket::of(air.altitudes_km, step.height_km),
                cos_view: step.cos_view,
                weights: step.weights,
            });
        });
        Path { samples, transmittance: end.transmittance, meets_ground: end.ground.is_some() }
    }

    /// What of the light outside arrives unscattered.
    pub fn passed(&self) -> Lanes {
        if self.meets_ground { Lanes::ZERO } else { self.transmittance }
    }
}

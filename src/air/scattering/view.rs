//! Radiance along a ray: what the source sends, scattered once, and what the field sends.
//!
//! The first order is exact but for the cutting of the ray: phase functions as they are, and the
//! light of the source dimmed on its own way to each step.

use std::f64::consts::PI;

use super::field::Field;
use super::lanes::Lanes;
use super::profile::EARTH_RADIUS_KM;
use super::rays::{Medium, Ray};

/// A distant source, seen from the start of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Source {
    pub cos_zenith: f64,
    /// Cosine of the angle between ray and source; the same all along the ray.
    pub nu: f64,
}

impl Source {
    /// Zenith distances by cosine, and the azimuth between ray and source by its cosine.
    pub fn new(cos_zenith: f64, cos_view: f64, cos_azimuth: f64) -> Source {
        let sines = ((1.0 - cos_zenith * cos_zenith) * (1.0 - cos_view * cos_view)).max(0.0).sqrt();
        Source { cos_zenith, nu: (cos_zenith * cos_view + sines * cos_azimuth).clamp(-1.0, 1.0) }
    }
}

/// Transmittance towards the source on the ground; dark below the horizon.
pub(crate) fn transmittance_to_ground(medium: &Medium, mu_s: f64) -> Lanes {
    let source = &medium.geometry.source;
    if mu_s <= 0.0 {
        return Lanes::ZERO;
    }
    source
        .columns(&source.row(0.0), mu_s)
        .map_or(Lanes::ZERO, |columns| (-medium.optics.optical_depth(columns)).exp())
}

/// Light of the source scattered once, or reflected once by the ground, per unit irradiance.
pub(crate) fn first_order(medium: &Medium, ray: &Ray, source: Source) -> Lanes {
    let Source { cos_zenith, nu } = source;
    let phases = medium.optics.phases(nu);
    let mut sum = Lanes::ZERO;
    for step in &ray.steps {
        let mu_s = ray.local_cos_source(step.distance_km, step.r_km, cos_zenith, nu);
        if let Some(columns) = medium.geometry.source.columns(&step.row, mu_s) {
            let mut scattered = step.weights[0] * phases[0];
            if step.is_hazy {
                scattered += step.weights[1] * phases[1] + step.weights[2] * phases[2];
            }
            sum += scattered * (-medium.optics.optical_depth(columns)).exp();
        }
    }
    if let Some(length) = ray.ground_km {
        let mu_s = ray.cos_source_on_ground(length, cos_zenith, nu);
        let reflected = (medium.optics.ground_albedo / PI * mu_s.max(0.0)) as f32;
        sum += ray.transmittance * transmittance_to_ground(medium, mu_s) * reflected;
    }
    sum
}

/// Adds the light of the field, scattered along the ray or reflected at its end, for each source.
///
/// Steps are the outer loop: the field is brought to the height of a step once for all sources.
/// `row` is scratch of [`Field::row_len`].
pub(crate) fn add_higher_orders(
    medium: &Medium,
    field: &Field,
    ray: &Ray,
    sources: &[Source],
    row: &mut [Lanes],
    out: &mut [Lanes],
) {
    for step in &ray.steps {
        let local =
            |s: &Source| ray.local_cos_source(step.distance_km, step.r_km, s.cos_zenith, s.nu);
        let (mut low, mut high) = (1.0f64, -1.0f64);
        for source in sources {
            let mu_s = local(source);
            low = low.min(mu_s);
            high = high.max(mu_s);
        }
        let range = field.sources.bracket(low).index..field.sources.bracket(high).index + 2;
        field.at_height(step, range, row);
        for (source, out) in sources.iter().zip(out.iter_mut()) {
            *out += field.scattered(step, row, local(source), source.nu);
        }
    }
    if ray.ground_km.is_some() {
        for (source, out) in sources.iter().zip(out.iter_mut()) {
            *out += field.reflected(medium.optics, ray, source.cos_zenith, source.nu);
        }
    }
}

/// Cosine of the zenith distance of the horizon, from a height.
pub(crate) fn cos_horizon(height_km: f64) -> f64 {
    let ratio = EARTH_RADIUS_KM / (EARTH_RADIUS_KM + height_km);
    -(1.0 - ratio * ratio).max(0.0).sqrt()
}

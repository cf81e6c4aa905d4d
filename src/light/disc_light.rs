//! The light of a disc in the lower air: of Sun and Moon as much as stands above the horizon.
//!
//! *Theory.* Air keeps radiance, so that the light of a disc is the integral of its radiance, times
//! the transmittance of the air, over the solid angle in which it is *seen*: flattened by refraction
//! and cut by the horizon. It is taken over the apparent altitude. A level strip of the Sun has its
//! share of the light in closed form: with `I(mu)` a polynomial in the cosine of emergence, the
//! integral of `mu^k` across a disc of radius 1 at a distance `y` from its middle is
//! `(1 - y^2)^((k+1)/2)` times a constant. Other bodies follow the law of Lommel and Seeliger, without
//! a map.
//!
//! *Accuracy.* 32 strips: 0.1 % of the integral (tested). Higher than 15 degrees the middle of the disc
//! stands for all of it, which is 0.01 % off. What hides a part of the disc, in an eclipse, is left
//! out.

use std::f64::consts::PI;

use glam::DVec3;

use crate::air::extinction::SightLines;
use crate::air::refraction::Refraction;
use crate::ephemeris::Body;
use crate::frame::{Dir, Horizon};
use crate::light::spectrum::{FIRST_NM, LEN, STEP_NM, Spectrum, wavelength_nm};
use crate::light::sun::LimbDarkening;
use crate::sky::BodyState;
use crate::units::{Angle, Xyzv};

/// Above this altitude a disc is as bright as its middle makes it.
const HIGH: Angle = Angle::from_deg(15.0);
/// Level strips of a disc, and points across a strip of a body that is lit from aside.
const STRIPS: usize = 32;
const ACROSS: usize = 24;

/// Integral of `mu^k` across the middle of a disc of radius 1, `sqrt(pi) G(k/2 + 1) / G(k/2 + 3/2)`.
const ACROSS_MIDDLE: [f64; 6] =
    [2.0, PI / 2.0, 4.0 / 3.0, 3.0 * PI / 8.0, 16.0 / 15.0, 5.0 * PI / 16.0];

/// Illuminance by the visible part of a body through the air, lux, on a plane that faces it.
///
/// Given its spectral irradiance outside the air. Black when all of it is below the horizon.
pub fn visible_light(
    state: &BodyState,
    irradiance: &Spectrum,
    sight: &SightLines,
    refraction: &Refraction,
) -> Xyzv {
    let (altitude, radius) = (state.dir.altitude(), state.angular_radius);
    if altitude - radius > HIGH {
        let apparent = refraction.apparent_from_true(altitude);
        return point_light(apparent, irradiance, sight, refraction);
    }
    let top = refraction.apparent_from_true(altitude + radius);
    let low = refraction.apparent_from_true(altitude - radius).max(sight.horizon());
    if top <= low {
        return Xyzv::BLACK;
    }
    let strips = Strips::of(state);
    let (middle, half) = ((top + low) / 2.0, (top - low) / 2.0);
    let mut shares = [0.0; LEN];
    for strip in 0..STRIPS {
        // Crowded towards the limb, where the shares rise as a root.
        let (sin, cos) = ((strip as f64 + 0.5) / STRIPS as f64 * PI).sin_cos();
        let apparent = middle - half * cos;
        let width = half.rad() * sin * PI / STRIPS as f64;
        let stands = refraction.true_from_apparent(apparent);
        let off_middle = (stands - altitude).rad() / radius.rad();
        let seen = width / radius.rad() * apparent.cos() / stands.cos();
        let through = sight.transmittance(apparent);
        for (node, share) in shares.iter_mut().enumerate() {
            *share += strips.density(node, off_middle) * seen * through.values()[node];
        }
    }
    irradiance.weighted(|nm| shares[((nm - FIRST_NM) / STEP_NM).round() as usize]).xyzv()
}

/// Illuminance by a point of light through the air, lux, given the apparent altitude at which it is
/// seen and its spectral irradiance outside; dimmed by the divergence of its beam too.
pub fn point_light(
    apparent: Angle,
    irradiance: &Spectrum,
    sight: &SightLines,
    refraction: &Refraction,
) -> Xyzv {
    if apparent < sight.horizon() {
        return Xyzv::BLACK;
    }
    (*irradiance * sight.transmittance(apparent)).xyzv() * refraction.divergence(apparent)
}

/// What share of the light of a disc lies in a level strip of it.
enum Strips {
    /// Limb darkening at the nodes of the grid.
    Sun(Box<[LimbDarkening; LEN]>),
    /// Lit from the direction given by its parts along the level, upwards and away from the observer.
    Lit { to_sun: DVec3, total: f64 },
}

impl Strips {
    fn of(state: &BodyState) -> Strips {
        if state.body == Body::Sun {
            let laws = std::array::from_fn(|node| LimbDarkening::at_nm(wavelength_nm(node)));
            return Strips::Sun(Box::new(laws));
        }
        let to_sun = disc_axes(state.dir).map(|axis| axis.dot(state.dir_to_sun.vector()));
        let to_sun = DVec3::from_array(to_sun);
        let total = (0..STRIPS)
            .map(|strip| {
                let (sin, cos) = ((strip as f64 + 0.5) / STRIPS as f64 * PI).sin_cos();
                lit_strip(to_sun, cos) * sin * PI / STRIPS as f64
            })
            .sum();
        Strips::Lit { to_sun, total }
    }

    /// Share of the light for each radius of height, at a height above the middle in radii.
    fn density(&self, node: usize, off_middle: f64) -> f64 {
        let half_squared = 1.0 - off_middle * off_middle;
        if half_squared <= 0.0 {
            return 0.0;
        }
        match self {
            Strips::Sun(laws) => {
                let half = half_squared.sqrt();
                let law = &laws[node];
                let terms = law.coefficients().into_iter().zip(ACROSS_MIDDLE);
                let strip = terms.rev().fold(0.0, |sum, (a, whole)| sum * half + a * whole) * half;
                strip / (PI * law.disc_mean())
            }
            Strips::Lit { to_sun, total } => {
                if *total > 0.0 {
                    lit_strip(*to_sun, off_middle) / total
                } else {
                    0.0
                }
            }
        }
    }
}

/// Light across a strip of a body that follows the law of Lommel and Seeliger.
fn lit_strip(to_sun: DVec3, off_middle: f64) -> f64 {
    let half = (1.0 - off_middle * off_middle).max(0.0).sqrt();
    let step = PI / ACROSS as f64;
    (0..ACROSS)
        .map(|point| {
            let (sin, cos) = ((point as f64 + 0.5) * step).sin_cos();
            let cos_emission = half * sin;
            let normal = DVec3::new(half * cos, off_middle, -cos_emission);
            let cos_incidence = normal.dot(to_sun).max(0.0);
            cos_incidence / (cos_incidence + cos_emission) * half * sin * step
        })
        .sum()
}

/// The axes of a disc: level towards growing azimuth, upwards, and from the observer to its middle.
pub fn disc_axes(centre: Dir<Horizon>) -> [DVec3; 3] {
    let (sin_azimuth, cos_azimuth) = centre.azimuth().sin_cos();
    let level = DVec3::new(cos_azimuth, -sin_azimuth, 0.0);
    let toward = centre.vector();
    [level, level.cross(toward), toward]
}

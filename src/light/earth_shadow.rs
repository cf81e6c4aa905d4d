//! The shadow of the Earth, as light: how much of the Sun still reaches a point of the Moon.
//!
//! *Theory.* Air keeps radiance but for what it takes out. The light at a point is therefore the
//! integral of the Sun's radiance, times the transmittance of the air, over the solid angle in which
//! the Sun is *seen* from there: beside the Earth directly, and through its air by rays that the air
//! bends, on both sides of the Earth at once. A ray that leaves at an angle `a` from the Earth's
//! centre and is bent by `w` comes from an angle `e = a - w S / (S + D)` from it, D the distance of
//! the Earth from the point and S that of the Sun from the Earth. The ratio `a da / (e de)` is the
//! attenuation by refraction of Link 1969 (*Eclipse Phenomena in Astronomy*, chapter 1, recalled: the
//! product `[1 - D w / b] [1 - D dw/dh]` to the power -1), with its focus on the axis. The disc of the
//! Sun is darkened towards its limb as in [`crate::light::sun`], so that the light of the rim of
//! the umbra, which is that of a crescent, is redder than the Sun even without air.
//!
//! *How.* [`limb`] follows grazing rays through the air of [`crate::air`]. Their light is put into bins
//! of `e` by the solid angle in which it is seen, which needs no division and bears rays that cross.
//! Each node of the table is the sum over the rings about the Earth's centre that cut the Sun; its
//! integrals of the powers of `mu` along a ring serve all wavelengths. Sums are divided by the same
//! sums without the Earth, so that nothing is lost outside the shadow.
//!
//! *Size.* There is no rule of enlargement in it. The air makes the shadow larger by itself. Where the
//! upper limb of the Sun sinks below 71 km, by Danjon's enlargement of 1 % of the equatorial radius, there
//! the logarithm of the light falls most steeply: within 3" for L = 0 to 2.5 and 4" for L = 4, at any
//! distance of the Moon. Above it a crescent is left, below only light that the air bent. The
//! Moon's limb crosses 3" in 5 to 10 s.
//!
//! *Scattered light.* Sunlight that the limb scatters towards the Moon is added in its first order
//! ([`limb`]): as Garcia-Munoz & Pallé 2011, *JQSRT* 112, 1609, find, it matters in the blue and in
//! the darkest eclipses alone.
//!
//! *Left out.* Higher orders of scattering, the flattening of the Earth (0.3 % of
//! its radius), dispersion, weather and ozone that differ along the limb, bands of oxygen and water.
//!
//! *Accuracy.* The table is read within 2 % (tested). The penumbra is that of an opaque Earth of
//! 6407 km within 0.005 of the full Sun, and the light falls most steeply within 3" of the umbra of
//! Danjon, and within 10 s of each contact (tested for the eclipses of 2025-03-14, 2026-03-03 and
//! 2029-01-01). The umbra is as dark as the air along the terminator makes it, which nobody knows in
//! advance: that is [`Danjon`]'s number.
//! In its middle, at mean distances, for L = 0 to 4: 2.0e-6, 5.8e-6, 1.5e-5, 3.5e-5 and 8.0e-5 of the
//! illuminance of the full Sun, 14.2 to 10.2 magnitudes; the eclipse of 2025-03-14 has the whole Moon
//! at magnitude 0.7, -0.4, -1.5, -2.6 and -3.8. At 40' from the axis light of 450 nm is 2.3 times
//! that of 600 nm for L = 2.5, and half of it without ozone.

mod limb;
mod place;

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::air::{AirError, Atmosphere, EARTH_RADIUS_KM};
use crate::light::spectrum::{LEN, Spectrum, Transmittance, wavelength_nm};
use crate::light::sun::LimbDarkening;
use crate::units::{AU_KM, Angle, SUN_RADIUS_KM, Xyzv};

pub use limb::{Danjon, EarthLimb, LIMB_TOP_KM, LimbRay, OutsideDanjon};
pub use place::ShadowedMoon;

/// Steps of the table about the edge of the umbra, and all others from the axis of the shadow to its
/// outermost rim.
const EDGE_STEPS: usize = 64;
const STEPS: usize = 191;
/// How far the steps about the edge reach to both sides of it, and where it is: light fails most steeply
/// at a Sun that stands behind this height.
const EDGE_REACH: Angle = Angle::from_arcsec(128.0);
const EDGE_KM: f64 = 71.0;
/// Rings about the Earth's centre that sort the light by where it comes from.
const RINGS: usize = 2048;
/// Points along half of a ring.
const ALONG: usize = 8;
/// Rings across the Moon's disc.
const ACROSS_MOON: usize = 96;
/// Wavelengths of [`ShadowRow::bands`], nanometres.
pub const BANDS_NM: [f64; 4] = [450.0, 530.0, 600.0, 670.0];
/// Less light than this is none: it keeps logarithms finite.
const NO_LIGHT: f64 = 1e-12;

/// How far the Sun and the Earth are from a point of the Moon, kilometres between centres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadowDistances {
    pub sun_km: f64,
    pub earth_km: f64,
}

impl ShadowDistances {
    /// The mean distances.
    pub const MEAN: ShadowDistances =
        ShadowDistances { sun_km: AU_KM + 384_400.0, earth_km: 384_400.0 };

    /// Angle between the Sun's centre and its limb.
    pub fn sun_radius(&self) -> Angle {
        Angle::from_rad((SUN_RADIUS_KM / self.sun_km).asin())
    }

    /// Angle between the Earth's centre and a ray that passes the centre at a distance.
    fn limb_rad(&self, impact_km: f64) -> f64 {
        (impact_km / self.earth_km).min(1.0).asin()
    }

    /// The angle between Sun and Earth from which on no air is in the way of the Sun.
    pub fn outer_rim(&self) -> Angle {
        let top = self.limb_rad(EARTH_RADIUS_KM + LIMB_TOP_KM);
        Angle::from_rad(top) + self.sun_radius()
    }

    /// Nodes of the table: in even steps, shorter ones about the edge of the umbra.
    fn nodes_rad(&self) -> Vec<f64> {
        let (rim, sun) = (self.outer_rim().rad(), self.sun_radius().rad());
        let edge = self.limb_rad(EARTH_RADIUS_KM + EDGE_KM) - sun;
        let [first, last] = [edge - EDGE_REACH.rad(), edge + EDGE_REACH.rad()];
        let share = (first / (first + rim - last)).clamp(0.0, 1.0);
        let before = ((STEPS as f64 * share) as usize).clamp(1, STEPS - 1);
        let pieces = [(0.0, first, before), (first, last, EDGE_STEPS), (last, rim, STEPS - before)];
        let even = |(from, to, steps): (f64, f64, usize)| {
            (0..steps).map(move |step| from + (to - from) * step as f64 / steps as f64)
        };
        pieces.into_iter().flat_map(even).chain([rim]).collect()
    }
}

/// The light at a point of the Moon over that of the full Sun, by wavelength, against the angle
/// between the centres of the Sun and of the Earth seen from there.
#[derive(Debug, Clone, PartialEq)]
pub struct EarthShadow {
    distances: ShadowDistances,
    /// Of the nodes, ascending from zero, radians.
    offsets_rad: Vec<f64>,
    /// Logarithms of the shares of light, by node and wavelength.
    logarithms: Vec<[f64; LEN]>,
}

/// One node of the table, for a renderer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadowRow {
    /// Between the centres of the Sun and of the Earth.
    pub offset: Angle,
    /// Share of the light at [`BANDS_NM`], 0 to 1.
    pub bands: [f64; 4],
    /// What is left of the light that was given, in its units.
    pub light: Xyzv,
}

impl EarthShadow {
    /// The shadow of the Earth with an air of this ozone, as dark as the number says. Some tens
    /// of milliseconds.
    ///
    /// # Errors
    ///
    /// Air that cannot be: see [`Atmosphere::validate`].
    pub fn new(
        air: &Atmosphere,
        danjon: Danjon,
        distances: ShadowDistances,
    ) -> Result<EarthShadow, AirError> {
        Ok(EarthShadow::of_limb(&EarthLimb::new(air, danjon)?, distances))
    }

    /// The same for a limb that is known.
    pub fn of_limb(limb: &EarthLimb, distances: ShadowDistances) -> EarthShadow {
        let sun_rad = distances.sun_radius().rad();
        let rim_rad = distances.outer_rim().rad();
        let offsets_rad = distances.nodes_rad();
        let rings = Rings::lit_through(limb, &distances, rim_rad + sun_rad);
        let laws: Vec<[f64; 6]> =
            (0..LEN).map(|k| LimbDarkening::at_nm(wavelength_nm(k)).coefficients()).collect();
        let scattered = scattered(limb, &distances);
        let node = |&offset: &f64| rings.logarithms_at(offset, sun_rad, &laws, &scattered);
        let mut logarithms: Vec<[f64; LEN]> = offsets_rad.par_iter().map(node).collect();
        if let Some(rim) = logarithms.last_mut() {
            *rim = [0.0; LEN];
        }
        EarthShadow { distances, offsets_rad, logarithms }
    }

    /// The distances that it was made for.
    pub fn distances(&self) -> ShadowDistances {
        self.distances
    }

    /// Share of the Sun's light, by wavelength, where the centres of the Sun and of the Earth are seen
    /// this far apart. 1 outside the shadow.
    pub fn light_at(&self, offset: Angle) -> Transmittance {
        let (at, nodes) = (offset.abs().rad(), &self.offsets_rad);
        let after = nodes.partition_point(|&node| node <= at).max(1);
        if after >= nodes.len() {
            return Transmittance::CLEAR;
        }
        let node = after - 1;
        let share = (at - nodes[node]) / (nodes[after] - nodes[node]);
        let (low, high) = (&self.logarithms[node], &self.logarithms[node + 1]);
        let logarithm = |k: usize| low[k] + (high[k] - low[k]) * share;
        Transmittance::from_fractions(std::array::from_fn(|k| logarithm(k).exp()))
    }

    /// The mean share over a disc, every point of which counts the same, as on the full Moon.
    ///
    /// Given the offset of its middle and its radius, both as angles between Sun and Earth:
    /// [`ShadowedMoon`] knows both.
    pub fn over_disc(&self, offset: Angle, radius: Angle) -> Transmittance {
        let (offset, radius) = (offset.abs().rad(), radius.rad());
        let (nearest, farthest) = ((offset - radius).max(0.0), offset + radius);
        let mut sums = [0.0; LEN];
        let mut whole = 0.0;
        let (middle, half) = ((nearest + farthest) / 2.0, (farthest - nearest) / 2.0);
        for ring in 0..ACROSS_MOON {
            let (sin, cos) = ((ring as f64 + 0.5) / ACROSS_MOON as f64 * PI).sin_cos();
            let at = middle - half * cos;
            let weight = at * arc(at, offset, radius) * sin;
            let light = self.light_at(Angle::from_rad(at));
            for (sum, share) in sums.iter_mut().zip(light.values()) {
                *sum += weight * share;
            }
            whole += weight;
        }
        Transmittance::from_fractions(sums.map(|sum| (sum / whole).min(1.0)))
    }

    /// The table, for a renderer: shares in four bands, and what is left of a light.
    pub fn rows(&self, light: &Spectrum) -> Vec<ShadowRow> {
        let row = |node: usize| {
            let offset = Angle::from_rad(self.offsets_rad[node]);
            let shares = Transmittance::from_fractions(self.logarithms[node].map(f64::exp));
            let bands = BANDS_NM.map(|nm| shares.at_nm(nm));
            ShadowRow { offset, bands, light: (*light * shares).xyzv() }
        };
        (0..self.offsets_rad.len()).map(row).collect()
    }
}

/// Half of the arc of a circle about the origin that lies within a disc of a given radius, whose
/// middle is `offset` away, radians.
pub(super) fn arc(circle: f64, offset: f64, radius: f64) -> f64 {
    if circle + offset <= radius {
        return PI;
    }
    if (circle - offset).abs() >= radius {
        return 0.0;
    }
    let cos = (circle * circle + offset * offset - radius * radius) / (2.0 * circle * offset);
    cos.clamp(-1.0, 1.0).acos()
}

/// Light by the angle from the Earth's centre from which it comes.
struct Rings {
    width_rad: f64,
    /// Solid angle, over 2 pi, in which a ring of sky is seen, times what comes through.
    seen: Vec<[f64; LEN]>,
}

impl Rings {
    fn lit_through(limb: &EarthLimb, distances: &ShadowDistances, end_rad: f64) -> Rings {
        let width_rad = end_rad / RINGS as f64;
        let mut rings = Rings { width_rad, seen: vec![[0.0; LEN]; RINGS] };
        // Beside the air nothing is in the way.
        let top_rad = distances.limb_rad(EARTH_RADIUS_KM + LIMB_TOP_KM);
        rings.spread(top_rad, end_rad, top_rad, end_rad, &[1.0; LEN]);
        let to_sun = (distances.sun_km - distances.earth_km) / distances.sun_km;
        let angles = |ray: &LimbRay| {
            let seen_rad = distances.limb_rad(ray.impact_km);
            (seen_rad, seen_rad - ray.bending.rad() * to_sun)
        };
        // Between two rays light varies by a few per cent: a few pieces will do.
        const PIECES: usize = 4;
        for pair in limb.rays().windows(2) {
            let [(low_seen, low_from), (high_seen, high_from)] = [&pair[0], &pair[1]].map(angles);
            let logarithms =
                [0, 1].map(|k: usize| pair[k].passes.values().map(|t| t.max(1e-300).ln()));
            let between = |low: f64, high: f64, share: f64| low + (high - low) * share;
            for piece in 0..PIECES {
                let [start, end] = [piece, piece + 1].map(|k| k as f64 / PIECES as f64);
                let passes = std::array::from_fn(|k| {
                    between(logarithms[0][k], logarithms[1][k], 0.5 * (start + end)).exp()
                });
                rings.spread(
                    between(low_seen, high_seen, start),
                    between(low_seen, high_seen, end),
                    between(low_from, high_from, start),
                    between(low_from, high_from, end),
                    &passes,
                );
            }
        }
        rings
    }

    /// Light seen between two angles that comes from between two others, radians; negative ones are
    /// on the other side of the Earth.
    fn spread(&mut self, seen_0: f64, seen_1: f64, from_0: f64, from_1: f64, passes: &[f64; LEN]) {
        let solid = 0.5 * (seen_1 * seen_1 - seen_0 * seen_0);
        let (low, high) = (from_0.min(from_1), from_0.max(from_1));
        // On each side the light of a ring goes as its length, where nothing bends it.
        let parts = [(low.max(0.0), high.max(0.0)), ((-high).max(0.0), (-low).max(0.0))];
        let whole = high - low;
        for (start, end) in parts.into_iter().filter(|(start, end)| end > start) {
            let first = (start / self.width_rad) as usize;
            let last = ((end / self.width_rad) as usize).min(RINGS - 1);
            for ring in first..=last.max(first).min(RINGS - 1) {
                let from = start.max(ring as f64 * self.width_rad);
                let to = end.min((ring + 1) as f64 * self.width_rad);
                // The solid angle grows across a wide piece of open sky.
                let share = match seen_0 == from_0 && seen_1 == from_1 {
                    true => 0.5 * (to * to - from * from),
                    false => solid * (to - from) / whole,
                };
                for (sum, pass) in self.seen[ring].iter_mut().zip(passes) {
                    *sum += share.max(0.0) * pass;
                }
            }
        }
    }

    /// Logarithms of the shares of light of a Sun whose middle is this far from the Earth's.
    fn logarithms_at(
        &self,
        offset: f64,
        sun: f64,
        laws: &[[f64; 6]],
        scattered: &[f64; LEN],
    ) -> [f64; LEN] {
        let (mut light, mut whole) = ([0.0; LEN], [0.0; LEN]);
        let first = ((offset - sun).max(0.0) / self.width_rad) as usize;
        let last = (((offset + sun) / self.width_rad) as usize).min(RINGS - 1);
        for ring in first..=last {
            let (start, end) = (ring as f64 * self.width_rad, (ring + 1) as f64 * self.width_rad);
            // The first and the last ring reach beyond the Sun.
            let (near, far) = (start.max(offset - sun), end.min(offset + sun));
            let middle = 0.5 * (near + far);
            let solid = 0.5 * (far * far - near * near);
            let Some(moments) = moments(middle, offset, sun) else { continue };
            let inside = solid / (0.5 * (end * end - start * start));
            for k in 0..LEN {
                let radiance: f64 = laws[k].iter().zip(moments).map(|(a, m)| a * m).sum();
                light[k] += radiance * self.seen[ring][k] * inside;
                whole[k] += radiance * solid;
            }
        }
        std::array::from_fn(|k| (light[k] / whole[k] + scattered[k]).clamp(NO_LIGHT, 1.0).ln())
    }
}

/// Light of the whole limb that the air scattered, over that of the Sun.
fn scattered(limb: &EarthLimb, distances: &ShadowDistances) -> [f64; LEN] {
    let mut sums = [0.0; LEN];
    for pair in limb.rays().windows(2) {
        let [low, high] = [&pair[0], &pair[1]].map(|ray| distances.limb_rad(ray.impact_km));
        let solid_sr = PI * (high * high - low * low);
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += 0.5 * (pair[0].scattered_sr[k] + pair[1].scattered_sr[k]) * solid_sr;
        }
    }
    sums
}

/// Integrals of the powers 0 to 5 of the cosine of emergence along a circle about the Earth's centre,
/// over the angle about that centre; none where it misses the Sun.
fn moments(circle: f64, offset: f64, sun: f64) -> Option<[f64; 6]> {
    let half = arc(circle, offset, sun);
    if half == 0.0 {
        return None;
    }
    let mut sums = [0.0; 6];
    for point in 0..ALONG {
        // Crowded towards the limb, where the cosine goes as a root.
        let (sin, cos) = ((point as f64 + 0.5) / ALONG as f64 * PI / 2.0).sin_cos();
        let turn = half * sin;
        let squared = circle * circle + offset * offset - 2.0 * circle * offset * turn.cos();
        let mu = (1.0 - squared / (sun * sun)).max(0.0).sqrt();
        let mut power = 2.0 * half * cos * PI / 2.0 / ALONG as f64;
        for sum in &mut sums {
            *sum += power;
            power *= mu;
        }
    }
    Some(sums)
}

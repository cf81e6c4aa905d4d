//! A sky outside the air as real spherical harmonics about the local zenith.
//!
//! `L(theta, phi) = sum P_lm(cos theta) (c_lm cos(m phi) + s_lm sin(m phi))`, degrees to 8, with the
//! functions of `legendre` and any azimuth, as long as it is the same when the sky is asked for. The
//! sky is the whole sphere: what the ground hides from the observer still shines on the air far
//! away and high up.

use std::f64::consts::PI;

use glam::DVec3;

use super::super::harmonics::{MAX_COEFFICIENTS, MAX_DEGREE, gauss_legendre, index};
use super::legendre::Legendre;
use crate::units::Angle;

/// Nodes of the expansion in each half of the sky, and around it.
const ZENITH_DISTANCES: usize = 20;
const AZIMUTHS: usize = 40;

/// Radiance from outside the air, by direction.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyHarmonics {
    cos: [f64; MAX_COEFFICIENTS],
    sin: [f64; MAX_COEFFICIENTS],
}

impl SkyHarmonics {
    /// The highest degree.
    pub const DEGREE: usize = MAX_DEGREE;
    /// No light.
    pub const DARK: SkyHarmonics =
        SkyHarmonics { cos: [0.0; MAX_COEFFICIENTS], sin: [0.0; MAX_COEFFICIENTS] };

    /// The same radiance everywhere.
    pub fn uniform(radiance: f64) -> SkyHarmonics {
        let mut sky = SkyHarmonics::DARK;
        sky.cos[0] = radiance * (4.0 * PI).sqrt();
        sky
    }

    /// Of a radiance that depends on the elevation alone, -90 to 90 degrees; order 0 only.
    pub fn from_elevation(radiance: impl Fn(Angle) -> f64) -> SkyHarmonics {
        let mut sky = SkyHarmonics::DARK;
        let legendre = Legendre::new(0, MAX_DEGREE);
        for (z, weight) in zenith_nodes() {
            let seen = radiance(elevation_of(z)) * weight * 2.0 * PI;
            legendre.each(z, |l, p| sky.cos[index(l, 0)] += p * seen);
        }
        sky
    }

    /// Of a radiance by elevation, -90 to 90 degrees, and azimuth. Exact for what is made of degrees
    /// to 8; detail finer than some 9 degrees is blurred or, beyond that, mistaken for coarser.
    pub fn from_fn(radiance: impl Fn(Angle, Angle) -> f64) -> SkyHarmonics {
        let mut sky = SkyHarmonics::DARK;
        let orders: Vec<Legendre> =
            (0..=MAX_DEGREE).map(|m| Legendre::new(m, MAX_DEGREE)).collect();
        for (z, weight) in zenith_nodes() {
            for k in 0..AZIMUTHS {
                let azimuth = Angle::from_rad(2.0 * PI * k as f64 / AZIMUTHS as f64);
                let seen = radiance(elevation_of(z), azimuth) * weight * 2.0 * PI / AZIMUTHS as f64;
                for (m, legendre) in orders.iter().enumerate() {
                    let (sine, cosine) = (m as f64 * azimuth.rad()).sin_cos();
                    legendre.each(z, |l, p| {
                        sky.cos[index(l, m)] += p * seen * cosine;
                        sky.sin[index(l, m)] += p * seen * sine;
                    });
                }
            }
        }
        sky
    }

    /// Of a light made of many small patches: the direction of each (z to the zenith, x to azimuth 0)
    /// and its radiance times its solid angle. Nothing is sampled, so detail of any size is right.
    pub fn of_points(points: impl IntoIterator<Item = (DVec3, f64)>) -> SkyHarmonics {
        let mut sky = SkyHarmonics::DARK;
        let orders: Vec<Legendre> =
            (0..=MAX_DEGREE).map(|m| Legendre::new(m, MAX_DEGREE)).collect();
        for (dir, light) in points {
            let (sine_1, cosine_1) = dir.y.atan2(dir.x).sin_cos();
            let (mut sine, mut cosine) = (0.0, 1.0);
            for (m, legendre) in orders.iter().enumerate() {
                legendre.each(dir.z, |l, p| {
                    sky.cos[index(l, m)] += p * light * cosine;
                    sky.sin[index(l, m)] += p * light * sine;
                });
                (sine, cosine) =
                    (sine * cosine_1 + cosine * sine_1, cosine * cosine_1 - sine * sine_1);
            }
        }
        sky
    }

    /// Coefficients of cosine and sine, `m <= l <= 8`.
    pub fn coefficients(&self, l: usize, m: usize) -> (f64, f64) {
        (self.cos[index(l, m)], self.sin[index(l, m)])
    }

    /// Adds to the coefficients of cosine and sine, `m <= l <= 8`.
    pub fn add(&mut self, l: usize, m: usize, (cos, sin): (f64, f64)) {
        self.cos[index(l, m)] += cos;
        self.sin[index(l, m)] += sin;
    }

    /// The sum of the series in a direction.
    pub fn radiance(&self, elevation: Angle, azimuth: Angle) -> f64 {
        let z = elevation.sin();
        (0..=MAX_DEGREE)
            .map(|m| {
                let (sine, cosine) = (m as f64 * azimuth.rad()).sin_cos();
                let mut sum = 0.0;
                Legendre::new(m, MAX_DEGREE).each(z, |l, p| {
                    let (c, s) = self.coefficients(l, m);
                    sum += p * (c * cosine + s * sine);
                });
                sum
            })
            .sum()
    }

    /// The highest order that is not dark.
    pub(super) fn order(&self) -> usize {
        let lit = |m: usize| (m..=MAX_DEGREE).any(|l| self.coefficients(l, m) != (0.0, 0.0));
        (0..=MAX_DEGREE).rev().find(|&m| lit(m)).unwrap_or(0)
    }
}

/// Cosines of zenith distances and their widths: Gauss and Legendre's in each half of the sky, for
/// functions with a kink or a step at the horizontal.
fn zenith_nodes() -> impl Iterator<Item = (f64, f64)> {
    gauss_legendre(ZENITH_DISTANCES).into_iter().flat_map(|(t, w)| [(t, w), (-t, w)])
}

fn elevation_of(cos_zenith: f64) -> Angle {
    Angle::from_rad(cos_zenith.asin())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn angle(deg: f64) -> Angle {
        Angle::from_deg(deg)
    }

    #[test]
    fn what_is_expanded_is_found_again() {
        let direction = |e: Angle, a: Angle| [e.cos() * a.cos(), e.cos() * a.sin(), e.sin()];
        // A polynomial of degree 5 in the direction, without any symmetry.
        let sky = |e: Angle, a: Angle| {
            let [x, y, z] = direction(e, a);
            1.0 + 0.3 * x - 0.7 * y * z + x * x * y - 0.4 * x * y.powi(3) * z
        };
        let harmonics = SkyHarmonics::from_fn(sky);
        for (e, a) in [(90.0, 0.0), (30.0, 77.0), (-12.0, 200.0), (2.0, 300.0), (-80.0, 10.0)] {
            let got = harmonics.radiance(angle(e), angle(a));
            assert!((got - sky(angle(e), angle(a))).abs() < 1e-12, "{e} {a}: {got}");
        }
    }

    #[test]
    fn points_make_the_sky_that_they_are() {
        let light = |dir: DVec3| 1.0 + 0.3 * dir.x - 0.7 * dir.y * dir.z;
        let points: Vec<(DVec3, f64)> = (0..20_000)
            .map(|k| {
                let z = 1.0 - 2.0 * (f64::from(k) + 0.5) / 20_000.0;
                let (sine, cosine) = (2.399_963_229_728_653 * f64::from(k)).sin_cos();
                let dir = DVec3::new((1.0 - z * z).sqrt() * cosine, (1.0 - z * z).sqrt() * sine, z);
                (dir, light(dir) * 4.0 * PI / 20_000.0)
            })
            .collect();
        let harmonics = SkyHarmonics::of_points(points);
        for (e, a) in [(90.0, 0.0), (30.0, 77.0), (-12.0, 200.0), (-80.0, 10.0)] {
            let (e, a) = (angle(e), angle(a));
            let dir = DVec3::new(e.cos() * a.cos(), e.cos() * a.sin(), e.sin());
            assert!((harmonics.radiance(e, a) - light(dir)).abs() < 2e-3);
        }
    }

    #[test]
    fn the_cheap_way_is_the_general_one() {
        let glow = |e: Angle| (1.0 - 0.972 * e.cos().powi(2)).powf(-0.5);
        let (axial, general) =
            (SkyHarmonics::from_elevation(glow), SkyHarmonics::from_fn(|e, _| glow(e)));
        for l in 0..=SkyHarmonics::DEGREE {
            for m in 0..=l {
                let ((c, s), (want, sine)) = (axial.coefficients(l, m), general.coefficients(l, m));
                assert!((c - want).abs() < 1e-12 && s == 0.0 && sine.abs() < 1e-12, "{l} {m}");
            }
        }
        assert_eq!((axial.order(), SkyHarmonics::DARK.order()), (0, 0));
        let uniform = SkyHarmonics::uniform(3.0);
        assert!((uniform.radiance(angle(20.0), angle(5.0)) - 3.0).abs() < 1e-12);
        let mut tilted = uniform;
        tilted.add(3, 2, (0.0, 1e-3));
        assert_eq!(tilted.order(), 2);
    }
}

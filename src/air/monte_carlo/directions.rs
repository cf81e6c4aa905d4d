//! Directions: how they turn, and the lobe at the horizon where a low source is.

use std::f64::consts::PI;

use glam::DVec3;

use super::random::Random;

/// Half width of the lobe in the sine of the elevation.
const LOBE_HEIGHT: f64 = 0.10;
/// Sine of the elevation where it is densest.
const LOBE_MIDDLE: f64 = 0.04;
/// How it gathers in azimuth: 0 evenly, 1 in the source's alone.
const LOBE_GATHERING: f64 = 0.55;

/// A direction of a given angle to another, turned about it by a drawn angle.
pub(super) fn turned(axis: DVec3, cosine: f64, random: &mut Random) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (a, b) = axis.any_orthonormal_pair();
    let (sin, cos) = (2.0 * PI * random.unit()).sin_cos();
    (axis * cosine + (a * cos + b * sin) * sine).normalize()
}

/// A direction above level ground, by the cosine of its zenith distance; and its probability.
pub(super) fn from_ground(up: DVec3, random: &mut Random) -> DVec3 {
    turned(up, random.unit().sqrt(), random)
}

/// Directions near the horizon towards a source: in the sine of the elevation a Lorentz curve cut
/// at the poles, in azimuth a wrapped Cauchy curve; both are drawn by their inverse.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lobe {
    up: DVec3,
    /// Level, towards the source.
    ahead: DVec3,
    aside: DVec3,
}

impl Lobe {
    pub fn new(up: DVec3, source: DVec3) -> Lobe {
        let level = source - up * source.dot(up);
        let ahead = level.try_normalize().unwrap_or_else(|| up.any_orthonormal_vector());
        Lobe { up, ahead, aside: up.cross(ahead) }
    }

    fn ends() -> (f64, f64) {
        let end = |z: f64| ((z - LOBE_MIDDLE) / LOBE_HEIGHT).atan();
        (end(-1.0), end(1.0))
    }

    pub fn draw(&self, random: &mut Random) -> DVec3 {
        let (low, high) = Lobe::ends();
        let z = LOBE_MIDDLE + LOBE_HEIGHT * (low + (high - low) * random.unit()).tan();
        let z = z.clamp(-1.0, 1.0);
        let narrow = (1.0 - LOBE_GATHERING) / (1.0 + LOBE_GATHERING);
        let azimuth = 2.0 * (narrow * (PI * (random.unit() - 0.5)).tan()).atan();
        let (sin, cos) = azimuth.sin_cos();
        let level = (1.0 - z * z).sqrt();
        (self.up * z + (self.ahead * cos + self.aside * sin) * level).normalize()
    }

    /// Per steradian.
    pub fn probability(&self, dir: DVec3) -> f64 {
        let (low, high) = Lobe::ends();
        let z = dir.dot(self.up);
        let x = (z - LOBE_MIDDLE) / LOBE_HEIGHT;
        let in_height = 1.0 / (LOBE_HEIGHT * (high - low) * (1.0 + x * x));
        let level = (1.0 - z * z).max(1e-24).sqrt();
        let cos = (dir.dot(self.ahead) / level).clamp(-1.0, 1.0);
        let g = LOBE_GATHERING;
        let in_azimuth = (1.0 - g * g) / (2.0 * PI * (1.0 + g * g - 2.0 * g * cos));
        in_height * in_azimuth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lobe_is_drawn_as_often_as_stated() {
        let up = DVec3::new(0.2, -0.5, 0.8).normalize();
        let lobe = Lobe::new(up, DVec3::new(1.0, 0.1, 0.0).normalize());
        let mut random = Random::stream(3, 0);
        // Mean of 1 / probability over the draws is the whole sphere.
        let n = 400_000;
        let (mut all, mut upper, mut ahead) = (0.0, 0.0, 0.0);
        for _ in 0..n {
            let dir = lobe.draw(&mut random);
            assert!((dir.length() - 1.0).abs() < 1e-12);
            let weight = 1.0 / (lobe.probability(dir) * f64::from(n));
            all += weight;
            upper += if dir.dot(up) > 0.0 { weight } else { 0.0 };
            ahead += if dir.dot(lobe.ahead) > 0.0 { weight } else { 0.0 };
        }
        for (got, want) in [(all, 4.0 * PI), (upper, 2.0 * PI), (ahead, 2.0 * PI)] {
            assert!((got / want - 1.0).abs() < 0.02, "{got} {want}");
        }
    }

    #[test]
    fn a_source_overhead_has_a_lobe_too() {
        let lobe = Lobe::new(DVec3::Z, DVec3::Z);
        assert!(lobe.probability(DVec3::X).is_finite() && lobe.probability(DVec3::Z) > 0.0);
    }
}

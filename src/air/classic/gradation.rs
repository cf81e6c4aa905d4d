//! What the models share: the angles of a direction, and the gradation of luminance over the sky.
//!
//! Source: Perez, Seals & Michalsky 1993, *Solar Energy* 50, 235, eq. 1:
//! `f = (1 + a exp(b / cos z)) (1 + c exp(d g) + e cos^2 g)`, with `z` the zenith distance of the
//! direction and `g` its angle from the Sun, radians. The clear sky of the CIE is a case of it, and
//! Preetham et al. 1999 use it for luminance and chromaticity alike.
//!
//! At the horizon `cos z` is kept at 0.01, half a degree up: with `b` below zero nothing changes, with
//! `b` above it the formula would be infinite.

use crate::units::Angle;

/// The least cosine of the zenith distance.
const LEAST_COSINE: f64 = 0.01;

/// A direction in the sky, as the models see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// Cosine of the zenith distance.
    pub cos_zenith: f64,
    pub from_sun: Angle,
}

impl Direction {
    /// From the altitude of the direction, its azimuth from that of the Sun, and the Sun's altitude.
    pub fn of(altitude: Angle, azimuth_from_sun: Angle, sun_altitude: Angle) -> Direction {
        let ((sin, cos), (sun_sin, sun_cos)) = (altitude.sin_cos(), sun_altitude.sin_cos());
        let azimuth = azimuth_from_sun.rad();
        // By the chord, which keeps small angles: an arc cosine would lose them.
        let chord = [cos * azimuth.cos() - sun_cos, cos * azimuth.sin(), sin - sun_sin];
        let half = 0.5 * chord.iter().map(|x| x * x).sum::<f64>().sqrt();
        Direction { cos_zenith: sin, from_sun: Angle::from_rad(2.0 * half.min(1.0).asin()) }
    }

    /// The zenith.
    pub fn zenith(sun_altitude: Angle) -> Direction {
        Direction { cos_zenith: 1.0, from_sun: Angle::from_deg(90.0) - sun_altitude }
    }
}

/// The five coefficients of the gradation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gradation {
    /// Darkens (below 0) or brightens the horizon.
    pub a: f64,
    /// How near to the horizon that happens; below 0.
    pub b: f64,
    /// Strength of the aureole.
    pub c: f64,
    /// Width of the aureole, per radian; below 0.
    pub d: f64,
    /// Light scattered back.
    pub e: f64,
}

impl Gradation {
    /// The relative luminance of a direction.
    pub fn at(&self, direction: &Direction) -> f64 {
        let cos_zenith = direction.cos_zenith.max(LEAST_COSINE);
        let cos_from_sun = direction.from_sun.cos();
        let from_zenith = 1.0 + self.a * (self.b / cos_zenith).exp();
        let from_sun = 1.0
            + self.c * (self.d * direction.from_sun.rad()).exp()
            + self.e * cos_from_sun.powi(2);
        from_zenith * from_sun
    }

    /// The same, relative to the zenith under a Sun of the given altitude.
    pub fn over_zenith(&self, direction: &Direction, sun_altitude: Angle) -> f64 {
        self.at(direction) / self.at(&Direction::zenith(sun_altitude))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_from_the_sun_are_right_near_and_far() {
        let sun = Angle::from_deg(30.0);
        let from_sun = |altitude, azimuth| {
            Direction::of(Angle::from_deg(altitude), Angle::from_deg(azimuth), sun).from_sun.deg()
        };
        for (altitude, azimuth, expected) in [
            (30.0, 0.0, 0.0),
            (30.0 + 1e-9, 0.0, 1e-9),
            (90.0, 77.0, 60.0),
            (60.0, 180.0, 90.0),
            (0.0, 90.0, 90.0),
        ] {
            assert!((from_sun(altitude, azimuth) - expected).abs() < 1e-12, "{altitude} {azimuth}");
        }
        let zenith = Direction::of(Angle::from_deg(90.0), Angle::ZERO, sun);
        assert!((zenith.from_sun - Direction::zenith(sun).from_sun).abs().rad() < 1e-12);
    }
}

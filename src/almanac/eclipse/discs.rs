//! Two discs in the sky: how much of the Sun the Moon covers.

use std::f64::consts::PI;
use std::fmt;

use super::radii::{MOON_INNER_KM, MOON_OUTER_KM, SUN_KM};
use crate::frame::{Pos, TrueOfDate};

/// What an eclipse of the Sun is at one place at one moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cover {
    /// The Moon bites into the Sun.
    Partial,
    /// The Moon stands within the Sun.
    Annular,
    /// The Sun stands within the Moon.
    Total,
}

impl fmt::Display for Cover {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Cover::Partial => "partial",
            Cover::Annular => "annular",
            Cover::Total => "total",
        })
    }
}

/// Sun and Moon as one observer sees them, radians.
#[derive(Debug, Clone, Copy)]
pub struct Discs {
    sun: f64,
    /// With the mountains of the rim.
    moon_outer: f64,
    /// To the depth of its valleys.
    moon_inner: f64,
    separation: f64,
}

impl Discs {
    /// Both vectors start at the eye.
    pub fn of(sun: Pos<TrueOfDate>, moon: Pos<TrueOfDate>) -> Discs {
        let radius = |km: f64, pos: Pos<TrueOfDate>| (km / pos.distance_km()).min(1.0).asin();
        Discs {
            sun: radius(SUN_KM, sun),
            moon_outer: radius(MOON_OUTER_KM, moon),
            moon_inner: radius(MOON_INNER_KM, moon),
            separation: sun.dir().separation(moon.dir()).rad(),
        }
    }

    /// Negative while the discs touch.
    pub fn outer_gap(&self) -> f64 {
        self.separation - (self.sun + self.moon_outer)
    }

    /// Negative while one disc stands within the other.
    pub fn inner_gap(&self) -> f64 {
        self.separation - (self.sun - self.moon_inner).abs()
    }

    pub fn cover(&self) -> Option<Cover> {
        if self.outer_gap() >= 0.0 {
            None
        } else if self.inner_gap() >= 0.0 {
            Some(Cover::Partial)
        } else if self.moon_inner >= self.sun {
            Some(Cover::Total)
        } else {
            Some(Cover::Annular)
        }
    }

    /// Diameter of the Moon over that of the Sun.
    pub fn diameter_ratio(&self) -> f64 {
        self.moon() / self.sun
    }

    /// Part of the diameter of the Sun that is covered, on the line through both centres; above 1
    /// in a total eclipse, where it counts the part of the Moon that sticks out; negative without
    /// eclipse.
    pub fn magnitude(&self) -> f64 {
        (self.sun + self.moon() - self.separation) / (2.0 * self.sun)
    }

    /// The magnitude with one radius of the Moon through all phases, the outer one: it has no
    /// step, so that the maximum can be sought.
    pub fn smooth_magnitude(&self) -> f64 {
        -self.outer_gap() / (2.0 * self.sun)
    }

    /// Part of the disc of the Sun that is covered, 0 to 1.
    pub fn obscuration(&self) -> f64 {
        match self.cover() {
            None => 0.0,
            Some(Cover::Total) => 1.0,
            Some(Cover::Annular) => self.diameter_ratio().powi(2),
            Some(Cover::Partial) => {
                // Two segments, cut by the chord where the rims cross.
                let (r, m, d) = (self.sun, self.moon(), self.separation);
                let sun_side = (d * d + r * r - m * m) / (2.0 * d);
                let segment = |radius: f64, to_chord: f64| {
                    let cos = (to_chord / radius).clamp(-1.0, 1.0);
                    radius * radius * (cos.acos() - cos * (1.0 - cos * cos).sqrt())
                };
                (segment(r, sun_side) + segment(m, d - sun_side)) / (PI * r * r)
            }
        }
    }

    /// The radius of the Moon that suits the phase.
    fn moon(&self) -> f64 {
        if self.inner_gap() < 0.0 { self.moon_inner } else { self.moon_outer }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn discs(moon: f64, separation: f64) -> Discs {
        Discs { sun: 1.0, moon_outer: moon, moon_inner: moon, separation }
    }

    #[test]
    fn areas_of_two_discs() {
        // Equal discs, centres a radius apart: 2 pi / 3 - sqrt(3) / 2.
        let equal = discs(1.0, 1.0).obscuration();
        assert!((equal - (2.0 * PI / 3.0 - 0.75f64.sqrt()) / PI).abs() < 1e-12);
        assert_eq!(discs(0.5, 0.2).obscuration(), 0.25);
        assert_eq!(discs(1.1, 0.05).obscuration(), 1.0);
        assert_eq!(discs(0.9, 1.9).obscuration(), 0.0);
        // It goes over into both ends without a step.
        assert!((discs(0.5, 0.5 + 1e-9).obscuration() - 0.25).abs() < 1e-6);
        assert!(discs(0.9, 1.9 - 1e-9).obscuration() < 1e-9);
        // Half the sum over a grid says the same.
        let (moon, separation) = (0.93, 0.7);
        let steps = 1000;
        let coordinate = |i: i32| f64::from(i) / f64::from(steps) * 2.0 - 1.0;
        let (mut all, mut covered) = (0, 0);
        for x in (0..steps).map(coordinate) {
            for y in (0..steps).map(coordinate) {
                if x * x + y * y < 1.0 {
                    all += 1;
                    covered += i32::from((x - separation).powi(2) + y * y < moon * moon);
                }
            }
        }
        let counted = f64::from(covered) / f64::from(all);
        assert!((discs(moon, separation).obscuration() - counted).abs() < 1e-3);
    }

    #[test]
    fn covers_and_magnitudes() {
        assert_eq!(discs(1.1, 0.05).cover(), Some(Cover::Total));
        assert_eq!(discs(0.9, 0.05).cover(), Some(Cover::Annular));
        assert_eq!(discs(0.9, 0.15).cover(), Some(Cover::Partial));
        assert_eq!(discs(0.9, 1.95).cover(), None);
        assert!((discs(0.9, 1.9).magnitude()).abs() < 1e-12);
        assert!((discs(1.2, 0.2).magnitude() - 1.0).abs() < 1e-12);
    }
}

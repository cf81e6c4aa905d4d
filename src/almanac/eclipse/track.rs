//! Sun and Moon over the hours of one eclipse, as polynomials.
//!
//! An eclipse asks a hundred times where Sun and Moon stand, within eight hours. The theories are
//! asked six times; between, Chebyshev polynomials of the rectangular coordinates are taken. In
//! half the span the Moon moves by 0.04 radian: the sixth power of that, times its distance, over
//! `2^5 6!` is 0.1 mm.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::EclipseError;
use super::theory::Syzygy;
use crate::ephemeris::{Ephemeris, Tolerance};
use crate::frame::{Itrs, Pos, Rot, TrueOfDate, turn_axes_z};
use crate::time::{Instant, JulianDate, TimeError, Tt};
use crate::units::{Angle, DAY_S};

/// Seconds from the middle to either end. The longest eclipse lasts 6.3 hours.
pub const HALF_WIDTH_S: f64 = 4.0 * 3600.0;

/// How many times the theories are asked.
const NODES: usize = 6;

/// Sidereal seconds in a second of UT1, beyond one: precession included (Aoki et al. 1982, *A&A*
/// 105, 359, eq. 18).
const SIDEREAL_GAIN: f64 = 0.002_737_909_35;

/// Slowest motion of the Moon with respect to the Sun, arcseconds per second of time.
const SLOWEST_ARCSEC_PER_S: f64 = 0.44;

/// Where Sun and Moon are, and how the Earth stands below them.
#[derive(Debug, Clone, Copy)]
pub struct Positions {
    /// Apparent, from the centre of the Earth.
    pub sun: Pos<TrueOfDate>,
    /// The same.
    pub moon: Pos<TrueOfDate>,
    pub itrs_from_true: Rot<Itrs, TrueOfDate>,
}

/// Sun and Moon over [`HALF_WIDTH_S`] on either side of an instant.
///
/// Times are seconds of TT from the middle.
#[derive(Debug, Clone)]
pub struct Track {
    middle: JulianDate<Tt>,
    sun: Polynomial,
    moon: Polynomial,
    sidereal_time: Angle,
    error_bound: Angle,
}

impl Track {
    /// Asks the theories.
    ///
    /// # Errors
    ///
    /// Dates that no theory or no clock serves.
    pub fn around(
        ephemeris: &Ephemeris,
        middle: JulianDate<Tt>,
        tolerance: Tolerance,
    ) -> Result<Track, EclipseError> {
        let mut sun = [DVec3::ZERO; NODES];
        let mut moon = [DVec3::ZERO; NODES];
        let mut error_bound = Angle::ZERO;
        let mut sidereal_time = Angle::ZERO;
        for (i, node) in nodes().enumerate() {
            let seconds = node * HALF_WIDTH_S;
            let instant = Instant::from_tt(middle.plus_seconds(seconds))?;
            let syzygy = Syzygy::at(ephemeris, &instant, tolerance)?;
            (sun[i], moon[i]) = (syzygy.sun.km(), syzygy.moon.km());
            error_bound = error_bound.max(syzygy.error_bound);
            // One node gives the sidereal time: it goes evenly to 0.02" (of nutation) in these
            // hours.
            if i == NODES / 2 {
                sidereal_time = syzygy.sidereal_time - turned(seconds);
            }
        }
        Ok(Track {
            middle,
            sun: Polynomial::through(&sun),
            moon: Polynomial::through(&moon),
            sidereal_time,
            error_bound,
        })
    }

    pub fn at(&self, seconds: f64) -> Positions {
        let sidereal_time = self.sidereal_time + turned(seconds);
        Positions {
            sun: Pos::from_km(self.sun.at(seconds / HALF_WIDTH_S)),
            moon: Pos::from_km(self.moon.at(seconds / HALF_WIDTH_S)),
            // By definition of sidereal time.
            itrs_from_true: Rot::claim(turn_axes_z(sidereal_time)),
        }
    }

    pub fn tt(&self, seconds: f64) -> JulianDate<Tt> {
        self.middle.plus_seconds(seconds)
    }

    /// # Errors
    ///
    /// A date that no clock serves.
    pub fn instant(&self, seconds: f64) -> Result<Instant, TimeError> {
        Instant::from_tt(self.tt(seconds))
    }

    /// Bound of the error of times, seconds of TT: that of the theories, over how fast the Moon
    /// moves.
    pub fn uncertainty_s(&self) -> f64 {
        self.error_bound.arcsec() / SLOWEST_ARCSEC_PER_S
    }
}

/// How far the Earth turns in so many seconds.
fn turned(seconds: f64) -> Angle {
    Angle::from_rad(TAU * seconds / DAY_S * (1.0 + SIDEREAL_GAIN))
}

/// The zeros of the Chebyshev polynomial of degree [`NODES`].
fn nodes() -> impl Iterator<Item = f64> {
    (0..NODES).map(|i| node_angle(i).cos())
}

fn node_angle(i: usize) -> f64 {
    PI * (i as f64 + 0.5) / NODES as f64
}

/// Coefficients of Chebyshev polynomials, lowest degree first.
#[derive(Debug, Clone)]
struct Polynomial([DVec3; NODES]);

impl Polynomial {
    /// Through the values at the nodes.
    fn through(values: &[DVec3; NODES]) -> Polynomial {
        let mut coefficients = [DVec3::ZERO; NODES];
        for (degree, coefficient) in coefficients.iter_mut().enumerate() {
            for (i, value) in values.iter().enumerate() {
                *coefficient += *value * (degree as f64 * node_angle(i)).cos();
            }
            *coefficient *= if degree == 0 { 1.0 } else { 2.0 } / NODES as f64;
        }
        Polynomial(coefficients)
    }

    /// The value at `x` in `[-1, 1]`, by Clenshaw's recurrence.
    fn at(&self, x: f64) -> DVec3 {
        let (mut next, mut after) = (DVec3::ZERO, DVec3::ZERO);
        for coefficient in self.0[1..].iter().rev() {
            (next, after) = (*coefficient + 2.0 * x * next - after, next);
        }
        self.0[0] + x * next - after
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_the_nodes_stands_what_the_theories_say() {
        let ephemeris = Ephemeris::analytic();
        let tolerance = Angle::from_arcsec(0.001);
        let middle = JulianDate::from_jd(2_460_409.26);
        let track = Track::around(&ephemeris, middle, tolerance).unwrap();
        for hours in [-4.0, -2.7, -0.1, 1.3, 3.9] {
            let seconds = hours * 3600.0;
            let instant = track.instant(seconds).unwrap();
            let truth = Syzygy::at(&ephemeris, &instant, tolerance).unwrap();
            let found = track.at(seconds);
            assert!((found.moon - truth.moon).distance_km() < 0.001, "{hours}");
            assert!(found.sun.dir().separation(truth.sun.dir()).arcsec() < 1e-4, "{hours}");
            let prime_meridian =
                (found.itrs_from_true.inverse().matrix().x_axis).truncate().to_angle();
            let off = Angle::from_rad(prime_meridian) - truth.sidereal_time;
            assert!(off.signed().abs().arcsec() < 0.05, "{hours}: {}", off.arcsec());
        }
    }
}

//! Precession over millennia: the poles of equator and ecliptic, and the way of the equinox.
//!
//! *Theory.* Vondrák, Capitaine & Wallace 2011, made for +-200 millennia.
//!
//! *Method.* The published sums have 22 periods, and the way of the equinox is an integral over all
//! of them. From -4200 to +4200 everything is folded into one Chebyshev series of degree 20 when it is
//! first asked for; that costs a thirtieth and differs by less than 1e-8".

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use glam::DVec3;

use super::terms::{
    ECLIPTIC_PERIODIC, ECLIPTIC_POLYNOMIAL, EQUATOR_PERIODIC, EQUATOR_POLYNOMIAL, LongPeriod,
};
use crate::ephemeris::polynomial::polynomial;
use crate::units::Angle;

/// Obliquity at J2000.0 (IAU 2006), arcseconds.
const OBLIQUITY_J2000_ARCSEC: f64 = 84_381.406;

/// The poles of date in mean axes of J2000.0, unit vectors, and how far the mean equinox has moved
/// along the moving equator since J2000.0, eastward positive.
#[derive(Debug, Clone, Copy)]
pub struct LongTerm {
    pub equator: DVec3,
    pub ecliptic: DVec3,
    pub travel: Angle,
}

/// At `t` Julian centuries of TT from J2000.0.
pub fn at(t: f64) -> LongTerm {
    let x = (t - MIDDLE) / HALF;
    if x.abs() <= 1.0 { from_coordinates(folded(x)) } else { from_coordinates(summed(t)) }
}

/// X and Y of the pole of the equator, P and Q of the pole of the ecliptic, travel of the equinox,
/// radians.
type Coordinates = [f64; 5];

fn from_coordinates([x, y, p, q, travel]: Coordinates) -> LongTerm {
    LongTerm {
        equator: equator_axes(x, y),
        ecliptic: ecliptic_axes(p, q),
        travel: Angle::from_rad(travel),
    }
}

fn equator_axes(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
}

fn ecliptic_axes(p: f64, q: f64) -> DVec3 {
    ecliptic_turn(p, q, (1.0 - p * p - q * q).max(0.0).sqrt())
}

/// P and Q are written in axes of the ecliptic J2000.0, Q away from the y axis.
fn ecliptic_turn(p: f64, q: f64, z: f64) -> DVec3 {
    let (sin, cos) = Angle::from_arcsec(OBLIQUITY_J2000_ARCSEC).sin_cos();
    DVec3::new(p, -q * cos - z * sin, -q * sin + z * cos)
}

const DEGREE: usize = 20;
/// Middle and half of the span of the folded series, Julian centuries from J2000.0.
const MIDDLE: f64 = -20.0;
const HALF: f64 = 42.0;

static FOLDED: LazyLock<[Coordinates; DEGREE + 1]> = LazyLock::new(|| {
    // Interpolation at the zeros of the next polynomial.
    let count = DEGREE + 1;
    let angle = |k: usize| PI * (k as f64 + 0.5) / count as f64;
    let mut coefficients = [[0.0; 5]; DEGREE + 1];
    for k in 0..count {
        let value = summed(MIDDLE + HALF * angle(k).cos());
        for (n, coefficient) in coefficients.iter_mut().enumerate() {
            let weight = if n == 0 { 1.0 } else { 2.0 } / count as f64;
            for (sum, value) in coefficient.iter_mut().zip(value) {
                *sum += weight * value * (n as f64 * angle(k)).cos();
            }
        }
    }
    coefficients
});

/// The Chebyshev series by Clenshaw's recurrence.
fn folded(x: f64) -> Coordinates {
    let (mut one, mut two) = ([0.0; 5], [0.0; 5]);
    for coefficient in FOLDED[1..].iter().rev() {
        let next = std::array::from_fn(|i| coefficient[i] + 2.0 * x * one[i] - two[i]);
        (one, two) = (next, one);
    }
    std::array::from_fn(|i| FOLDED[0][i] + x * one[i] - two[i])
}

/// The published sums and the integral over them.
fn summed(t: f64) -> Coordinates {
    let [[x, y], _] = coordinates(&EQUATOR_POLYNOMIAL, &EQUATOR_PERIODIC, t);
    let [[p, q], _] = coordinates(&ECLIPTIC_POLYNOMIAL, &ECLIPTIC_PERIODIC, t);
    [x, y, p, q, equinox_travel(t)]
}

/// A pole and how fast it moves, per Julian century, in mean axes of J2000.0.
#[derive(Clone, Copy)]
struct Pole {
    dir: DVec3,
    rate: DVec3,
}

/// Two coordinates and their rates per century, radians: polynomial and long periods.
fn coordinates(polynomials: &[[f64; 4]; 2], periodic: &[LongPeriod], t: f64) -> [[f64; 2]; 2] {
    let mut value = [polynomial(&polynomials[0], t), polynomial(&polynomials[1], t)];
    let mut rate = [0, 1].map(|i| {
        let [_, c1, c2, c3] = polynomials[i];
        polynomial(&[c1, 2.0 * c2, 3.0 * c3], t)
    });
    for [period, cos_a, cos_b, sin_a, sin_b] in periodic {
        let frequency = TAU / period;
        let (sin, cos) = (frequency * t).sin_cos();
        for (i, (c, s)) in [(cos_a, sin_a), (cos_b, sin_b)].into_iter().enumerate() {
            value[i] += c * cos + s * sin;
            rate[i] += frequency * (s * cos - c * sin);
        }
    }
    let rad = Angle::from_arcsec(1.0).rad();
    [value.map(|v| v * rad), rate.map(|r| r * rad)]
}

/// Pole of the mean equator: Vondrák et al. 2011, eq. 9.
fn equator_pole(t: f64) -> Pole {
    let [[x, y], [x_rate, y_rate]] = coordinates(&EQUATOR_POLYNOMIAL, &EQUATOR_PERIODIC, t);
    let dir = equator_axes(x, y);
    Pole { dir, rate: DVec3::new(x_rate, y_rate, -(x * x_rate + y * y_rate) / dir.z) }
}

/// Pole of the ecliptic: Vondrák et al. 2011, eq. 8.
fn ecliptic_pole(t: f64) -> Pole {
    let [[p, q], [p_rate, q_rate]] = coordinates(&ECLIPTIC_POLYNOMIAL, &ECLIPTIC_PERIODIC, t);
    let z = (1.0 - p * p - q * q).max(0.0).sqrt();
    let z_rate = -(p * p_rate + q * q_rate) / z;
    Pole { dir: ecliptic_axes(p, q), rate: ecliptic_turn(p_rate, q_rate, z_rate) }
}

/// How far the mean equinox has moved along the moving equator since J2000.0, radians.
///
/// The origin that does not rotate about the pole stays behind the equinox by the integral of the
/// equinox's velocity along the equator (the definition of a non-rotating origin, Guinot 1979).
/// Integrated with five Gauss points in panels of ten centuries: the terms have periods of 158
/// centuries and more, the error is below 1e-9 arcsecond.
fn equinox_travel(t: f64) -> f64 {
    const PANEL_CENTURIES: f64 = 10.0;
    // Abscissae and weights: Abramowitz & Stegun 1964, table 25.4.
    const GAUSS: [(f64, f64); 5] = [
        (0.0, 0.568_888_888_888_889),
        (-0.538_469_310_105_683, 0.478_628_670_499_366),
        (0.538_469_310_105_683, 0.478_628_670_499_366),
        (-0.906_179_845_938_664, 0.236_926_885_056_189),
        (0.906_179_845_938_664, 0.236_926_885_056_189),
    ];
    let panels = (t.abs() / PANEL_CENTURIES).ceil().max(1.0);
    let half = t / panels / 2.0;
    (0..panels as usize)
        .flat_map(|panel| {
            let middle = (2 * panel + 1) as f64 * half;
            GAUSS.map(|(x, weight)| weight * half * equinox_rate(middle + x * half))
        })
        .sum()
}

/// Speed of the mean equinox along the mean equator, radians per century.
fn equinox_rate(t: f64) -> f64 {
    let (equator, ecliptic) = (equator_pole(t), ecliptic_pole(t));
    let node = equator.dir.cross(ecliptic.dir);
    let node_rate = equator.rate.cross(ecliptic.dir) + equator.dir.cross(ecliptic.rate);
    let along_equator = equator.dir.cross(node.normalize());
    node_rate.dot(along_equator) / node.length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_the_derivatives_of_the_poles() {
        for t in [-55.0, -3.0, 0.0, 18.0] {
            for pole in [equator_pole, ecliptic_pole] {
                let difference = (pole(t + 1e-3).dir - pole(t - 1e-3).dir) / 2e-3;
                assert!(difference.abs_diff_eq(pole(t).rate, 1e-11));
            }
        }
    }

    #[test]
    fn folding_loses_nothing() {
        for i in 0..=500 {
            let x = -1.0 + f64::from(i) / 250.0;
            for (a, b) in folded(x).into_iter().zip(summed(MIDDLE + HALF * x)) {
                let error_arcsec = Angle::from_rad(a - b).arcsec().abs();
                assert!(error_arcsec < 1e-8, "{x}: {error_arcsec}");
            }
        }
    }
}

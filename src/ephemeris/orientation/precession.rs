//! Long-term precession of the equator and of the ecliptic, and what follows from both.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::terms::{
    ECLIPTIC_PERIODIC, ECLIPTIC_POLYNOMIAL, EQUATOR_PERIODIC, EQUATOR_POLYNOMIAL, LongPeriod,
};
use crate::ephemeris::polynomial::polynomial;
use crate::frame::{EclipticOfDate, Icrs, MeanOfDate, Rot};
use crate::time::{JulianDate, Tt};
use crate::units::Angle;

/// Obliquity at J2000.0 (IAU 2006), arcseconds.
const OBLIQUITY_J2000_ARCSEC: f64 = 84_381.406;

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
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    Pole {
        dir: DVec3::new(x, y, z),
        rate: DVec3::new(x_rate, y_rate, -(x * x_rate + y * y_rate) / z),
    }
}

/// Pole of the ecliptic: Vondrák et al. 2011, eq. 8.
fn ecliptic_pole(t: f64) -> Pole {
    let [[p, q], [p_rate, q_rate]] = coordinates(&ECLIPTIC_POLYNOMIAL, &ECLIPTIC_PERIODIC, t);
    let z = (1.0 - p * p - q * q).max(0.0).sqrt();
    let z_rate = -(p * p_rate + q * q_rate) / z;
    // P and Q are written in axes of the ecliptic J2000.0, Q away from the y axis.
    let (sin, cos) = Angle::from_arcsec(OBLIQUITY_J2000_ARCSEC).sin_cos();
    Pole {
        dir: DVec3::new(p, -q * cos - z * sin, -q * sin + z * cos),
        rate: DVec3::new(p_rate, -q_rate * cos - z_rate * sin, -q_rate * sin + z_rate * cos),
    }
}

/// The matrix whose rows are the three axes.
fn axes(x: DVec3, y: DVec3, z: DVec3) -> DMat3 {
    DMat3::from_cols(x, y, z).transpose()
}

/// ICRS axes to mean axes of J2000.0: offsets of the pole -16.617 and -6.8192 mas, of the equinox
/// -14.6 mas (Capitaine & Wallace 2006; IERS Conventions 2010, eq. 5.21 and 5.33).
fn frame_bias() -> DMat3 {
    let [x, y, equinox] =
        [-0.016_617, -0.006_819_2, -0.014_600].map(|arcsec| Angle::from_arcsec(arcsec).rad());
    // First order in the offsets: 1e-14 from orthogonal.
    axes(DVec3::new(1.0, equinox, -x), DVec3::new(-equinox, 1.0, -y), DVec3::new(x, y, 1.0))
}

/// Mean equator and equinox of date from ICRS axes: frame bias and precession.
pub fn mean_from_icrs(tt: JulianDate<Tt>) -> Rot<MeanOfDate, Icrs> {
    let t = tt.centuries_since_j2000();
    let (equator, ecliptic) = (equator_pole(t).dir, ecliptic_pole(t).dir);
    let equinox = equator.cross(ecliptic).normalize();
    // The equinox is where the ecliptic rises through the equator, by definition.
    Rot::claim(axes(equinox, equator.cross(equinox), equator) * frame_bias())
}

/// Mean ecliptic and equinox of date from ICRS axes.
pub fn ecliptic_from_icrs(tt: JulianDate<Tt>) -> Rot<EclipticOfDate, Icrs> {
    let t = tt.centuries_since_j2000();
    let (equator, ecliptic) = (equator_pole(t).dir, ecliptic_pole(t).dir);
    let equinox = equator.cross(ecliptic).normalize();
    // As above, with the pole of the ecliptic.
    Rot::claim(axes(equinox, ecliptic.cross(equinox), ecliptic) * frame_bias())
}

/// Mean ecliptic from mean equator: a turn about the equinox by the mean obliquity.
pub fn ecliptic_from_mean(tt: JulianDate<Tt>) -> Rot<EclipticOfDate, MeanOfDate> {
    // Both share the equinox as x.
    Rot::claim(crate::frame::turn_axes_x(mean_obliquity(tt)))
}

/// Angle between mean equator and mean ecliptic of date.
pub fn mean_obliquity(tt: JulianDate<Tt>) -> Angle {
    let t = tt.centuries_since_j2000();
    let (equator, ecliptic) = (equator_pole(t).dir, ecliptic_pole(t).dir);
    Angle::from_rad(equator.cross(ecliptic).length().atan2(equator.dot(ecliptic)))
}

/// How far the mean equinox has moved along the moving equator since J2000.0, eastward positive;
/// `t` in Julian centuries.
///
/// The origin that does not rotate about the pole stays behind the equinox by the integral of the
/// equinox's velocity along the equator (the definition of a non-rotating origin, Guinot 1979).
/// Integrated with five Gauss points in panels of ten centuries: the terms have periods of 158
/// centuries and more, the error is below 1e-9 arcsecond.
pub(super) fn equinox_travel(t: f64) -> Angle {
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
    let travel_rad: f64 = (0..panels as usize)
        .flat_map(|panel| {
            let middle = (2 * panel + 1) as f64 * half;
            GAUSS.map(|(x, weight)| weight * half * equinox_rate(middle + x * half))
        })
        .sum();
    Angle::from_rad(travel_rad)
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

    /// Equinox and poles of equator and ecliptic in ICRS axes: ERFA 2.0.1, `ltpb` and `ltecm`.
    #[test]
    fn axes_agree_with_erfa_over_millennia() {
        type Axis = [f64; 3];
        let truth: [(f64, Axis, Axis, Axis); 3] = [
            (
                -3000.0,
                [0.356410564486, 0.853057573862, 0.381135520780],
                [-0.379008094749, -0.240853751432, 0.893500047306],
                [0.001431636191, -0.408422256696, 0.912791986519],
            ),
            (
                1200.0,
                [0.981105707286, 0.177326283431, 0.077375579714],
                [-0.077374062882, -0.006934209067, 0.996978019385],
                [-0.000102254324, -0.399455409141, 0.916752619659],
            ),
            (
                3500.0,
                [0.933441711222, -0.329412985371, -0.142033998821],
                [0.142054408082, -0.024140772172, 0.989564433609],
                [0.000513094439, -0.394710235649, 0.918805510763],
            ),
        ];
        for (year, equinox, equator, ecliptic) in truth {
            let tt = JulianDate::from_jd(2_451_545.0 + (year - 2000.0) * 365.25);
            let icrs_from_mean = mean_from_icrs(tt).matrix().transpose();
            let icrs_from_ecliptic = ecliptic_from_icrs(tt).matrix().transpose();
            assert!(icrs_from_mean.x_axis.abs_diff_eq(DVec3::from(equinox), 1e-11));
            assert!(icrs_from_mean.z_axis.abs_diff_eq(DVec3::from(equator), 1e-11));
            assert!(icrs_from_ecliptic.z_axis.abs_diff_eq(DVec3::from(ecliptic), 1e-11));
            // The way over the mean equator leads to the same ecliptic.
            let over_equator = ecliptic_from_mean(tt) * mean_from_icrs(tt);
            assert!(over_equator.matrix().abs_diff_eq(ecliptic_from_icrs(tt).matrix(), 1e-14));
        }
    }
}

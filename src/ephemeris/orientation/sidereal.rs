//! The rotation of the Earth: rotation angle and sidereal time.
//!
//! *Theory.* The Earth rotation angle runs evenly with UT1 and counts from the celestial intermediate
//! origin, which does not rotate about the pole (Capitaine, Guinot & McCarthy 2000). Sidereal time
//! counts from the equinox; what lies between the two is the equation of the origins. Within the span
//! of the standard precession it comes from the matrix and the published locator s of the origin
//! (Wallace & Capitaine 2006, eq. 16), as in `gst06` of ERFA. With the long-term precession, for
//! which there is no locator, it is the way of the equinox along the equator, by the definition of the
//! origin, and the classical equation of the equinoxes.
//!
//! *Accuracy.* Within 0.000002" of `gst06a` of ERFA from 1550 to 2650. By its definition the origin does
//! not turn about the pole; the published one turns by less than 0.00005" until 1560 and until 2400,
//! and by 0.0004" until 2600, where the polynomials of the standard wear out.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::arguments::lunar_node;
use super::nutation::Nutation;
use super::precession::Mean;
use crate::ephemeris::polynomial::polynomial;
use crate::frame::{Icrs, Rot, TrueOfDate};
use crate::time::{JulianDate, Tt, Ut1};
use crate::units::Angle;

/// s + XY/2 without its periodic terms: arcseconds, powers of Julian centuries (IERS Conventions
/// 2010, table 5.2d).
const LOCATOR_ARCSEC: [f64; 6] =
    [94.00e-6, 3_808.65e-6, -122.68e-6, -72_574.11e-6, 27.98e-6, 15.62e-6];

/// The equinox of J2000.0 stood west of the origin of the rotation angle (Capitaine, Wallace &
/// Chapront 2003, eq. 42). The loops of nutation, which the mean equator does not make, carry that
/// origin along (IERS Conventions 2010, table 5.2d). Arcseconds, and per Julian century.
const ORIGIN_ARCSEC: [f64; 2] = [0.014_506, -0.003_808_65];

/// The Earth rotation angle, in `[0, 2 pi)`: Capitaine, Guinot & McCarthy 2000, eq. 14 (exact by
/// definition of UT1).
pub fn earth_rotation_angle(ut1: JulianDate<Ut1>) -> Angle {
    // The day is whole: its turns are left out before they cost digits.
    let turns =
        ut1.fraction() + 0.779_057_273_264_0 + 0.002_737_811_911_354_48 * ut1.days_since_j2000();
    Angle::from_rad(TAU * turns.rem_euclid(1.0)).positive()
}

/// Greenwich mean sidereal time, in `[0, 2 pi)`: the angle from the mean equinox of date to the
/// prime meridian. Within 0.00003" of `gmst06` of ERFA from 1550 to 2400, and 0.0007" until 2650.
pub fn mean_sidereal_time(ut1: JulianDate<Ut1>, tt: JulianDate<Tt>) -> Angle {
    let mean = Mean::at(tt);
    let matrix = mean.mean_from_icrs.matrix();
    from_rotation_angle(ut1, tt, &mean, matrix, Angle::ZERO, || Angle::ZERO)
}

/// Greenwich apparent sidereal time, in `[0, 2 pi)`: the angle from the true equinox of date to the
/// prime meridian.
pub(super) fn apparent_sidereal_time(
    ut1: JulianDate<Ut1>,
    tt: JulianDate<Tt>,
    mean: &Mean,
    true_from_icrs: Rot<TrueOfDate, Icrs>,
    nutation: &Nutation,
) -> Angle {
    from_rotation_angle(ut1, tt, mean, true_from_icrs.matrix(), nutation.locator, || {
        equation_of_equinoxes(tt, mean, nutation)
    })
}

/// Sidereal time of the equinox whose axes are the rows of `matrix`, whose origin has the
/// periodic `locator`, and which stands off the mean equinox by `off_mean`.
fn from_rotation_angle(
    ut1: JulianDate<Ut1>,
    tt: JulianDate<Tt>,
    mean: &Mean,
    matrix: DMat3,
    locator: Angle,
    off_mean: impl Fn() -> Angle,
) -> Angle {
    let t = tt.centuries_since_j2000();
    let by_locator = || {
        let s_plus_half_xy = Angle::from_arcsec(polynomial(&LOCATOR_ARCSEC, t)) + locator;
        -equation_of_origins(matrix, s_plus_half_xy)
    };
    let by_travel =
        |travel: Angle| Angle::from_arcsec(polynomial(&ORIGIN_ARCSEC, t)) - travel + off_mean();
    let past_origin = match mean.long_term {
        None => by_locator(),
        Some((share, travel)) if share < 1.0 => {
            by_locator() * (1.0 - share) + by_travel(travel) * share
        }
        Some((_, travel)) => by_travel(travel),
    };
    (earth_rotation_angle(ut1) + past_origin).positive()
}

/// Right ascension of the celestial intermediate origin: Earth rotation angle less sidereal time.
///
/// Wallace & Capitaine 2006, eq. 16. The rows of `matrix` are the equinox, the axis at right angles
/// and the pole, in ICRS axes.
fn equation_of_origins(matrix: DMat3, s_plus_half_xy: Angle) -> Angle {
    let pole = matrix.row(2);
    let a = pole.x / (1.0 + pole.z);
    let origin = DVec3::new(1.0 - a * pole.x, -a * pole.y, -pole.x);
    let s_rad = s_plus_half_xy.rad() - 0.5 * pole.x * pole.y;
    Angle::from_rad(s_rad - matrix.row(1).dot(origin).atan2(matrix.row(0).dot(origin)))
}

/// Apparent less mean sidereal time.
///
/// The two largest complementary terms are kept (IERS Conventions 2010, table 5.2e); the rest is
/// below 0.00004".
fn equation_of_equinoxes(tt: JulianDate<Tt>, mean: &Mean, nutation: &Nutation) -> Angle {
    let node = lunar_node(tt.centuries_since_j2000());
    let complementary_arcsec = 0.002_640_96 * node.sin() + 0.000_063_52 * (node * 2.0).sin();
    nutation.longitude * mean.obliquity.cos() + Angle::from_arcsec(complementary_arcsec)
}

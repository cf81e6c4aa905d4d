//! How the Earth stands in space: frame bias, precession, nutation and rotation.
//!
//! *Theory.* Precession of equator and ecliptic by Vondrák, Capitaine & Wallace 2011 (A&A 534,
//! A22, with the corrigendum 541, C1), made for +-200 millennia; it agrees with IAU 2006 within
//! 0.1 mas in 1900-2100. Nutation by the 77 lunisolar terms of IAU 2000B (McCarthy & Luzum 2003).
//! Rotation by the Earth rotation angle (Capitaine, Guinot & McCarthy 2000).
//!
//! *How we differ.* The arguments of nutation keep their powers of time (IERS Conventions 2003,
//! eq. 5.43), which IAU 2000B drops: without them the node is 7.5 degrees off at -4000. Sidereal
//! time does not use the polynomial of IAU 2006, which was fitted to a few centuries and leaves the
//! equinox of the long-term precession; it follows the equinox itself, by its definition
//! (`precession::equinox_travel`).
//!
//! *Accuracy.* True pole and equinox within 0.006" of IAU 2006/2000A in 1800-2200, nutation within
//! 0.005" of IAU 2000A from -4000 to +4000. The precession is good to a few arcseconds in historical
//! times (Vondrák et al.). Sidereal time is within 0.002" of IAU 2006 in 1800-2200 and consistent
//! with the precession everywhere. Polar motion (at most 0.6") is omitted.

mod nutation;
mod precession;
mod terms;

use std::f64::consts::TAU;

use crate::frame::{EclipticOfDate, Icrs, Itrs, MeanOfDate, Rot, TrueOfDate, turn_axes_z};
use crate::time::{Instant, JulianDate, Tt, Ut1};
use crate::units::Angle;

pub use nutation::{Nutation, nutation};
pub use precession::{ecliptic_from_icrs, ecliptic_from_mean, mean_from_icrs, mean_obliquity};

/// All axes of one instant, computed together.
#[derive(Debug, Clone, Copy)]
pub struct Orientation {
    pub mean_from_icrs: Rot<MeanOfDate, Icrs>,
    pub ecliptic_from_mean: Rot<EclipticOfDate, MeanOfDate>,
    pub true_from_mean: Rot<TrueOfDate, MeanOfDate>,
    pub itrs_from_true: Rot<Itrs, TrueOfDate>,
    /// Angle from the mean equator to the mean ecliptic.
    pub mean_obliquity: Angle,
    pub nutation: Nutation,
    /// Greenwich apparent sidereal time.
    pub sidereal_time: Angle,
}

impl Orientation {
    pub fn at(instant: &Instant) -> Orientation {
        let mean_obliquity = mean_obliquity(instant.tt);
        let nutation = nutation(instant.tt);
        let sidereal_time = mean_sidereal_time(instant.ut1, instant.tt)
            + nutation.equation_of_equinoxes(mean_obliquity);
        Orientation {
            mean_from_icrs: mean_from_icrs(instant.tt),
            ecliptic_from_mean: ecliptic_from_mean(instant.tt),
            true_from_mean: nutation.true_from_mean(mean_obliquity),
            itrs_from_true: Rot::claim(turn_axes_z(sidereal_time)), // by definition of the angle
            mean_obliquity,
            nutation,
            sidereal_time,
        }
    }

    pub fn true_from_icrs(&self) -> Rot<TrueOfDate, Icrs> {
        self.true_from_mean * self.mean_from_icrs
    }

    pub fn itrs_from_icrs(&self) -> Rot<Itrs, Icrs> {
        self.itrs_from_true * self.true_from_icrs()
    }
}

/// True axes from mean axes: nutation alone.
pub fn true_from_mean(tt: JulianDate<Tt>) -> Rot<TrueOfDate, MeanOfDate> {
    nutation(tt).true_from_mean(mean_obliquity(tt))
}

/// Axes that turn with the Earth from true axes; polar motion is omitted.
pub fn itrs_from_true(ut1: JulianDate<Ut1>, tt: JulianDate<Tt>) -> Rot<Itrs, TrueOfDate> {
    // Greenwich apparent sidereal time is the angle from the true equinox to the prime meridian.
    Rot::claim(turn_axes_z(apparent_sidereal_time(ut1, tt)))
}

/// The Earth rotation angle, in `[0, 2 pi)`: Capitaine, Guinot & McCarthy 2000, eq. 14 (exact by
/// definition of UT1).
pub fn earth_rotation_angle(ut1: JulianDate<Ut1>) -> Angle {
    // Whole turns are taken away before they cost digits.
    let turns = ut1.day().rem_euclid(1.0)
        + ut1.fraction()
        + 0.779_057_273_264_0
        + 0.002_737_811_911_354_48 * ut1.days_since_j2000();
    Angle::from_rad(TAU * turns.rem_euclid(1.0)).positive()
}

/// Greenwich mean sidereal time, in `[0, 2 pi)`.
///
/// The Earth rotation angle less the travel of the mean equinox along the moving equator. The
/// equinox stood 0.014506" west of the origin of the rotation angle at J2000.0 (Capitaine, Wallace
/// & Chapront 2003, eq. 42). The loops of nutation, which the mean equator does not make, carry that
/// origin along by 3808.65 microarcseconds a century (IERS Conventions 2010, table 5.2d).
pub fn mean_sidereal_time(ut1: JulianDate<Ut1>, tt: JulianDate<Tt>) -> Angle {
    let t = tt.centuries_since_j2000();
    let origin = Angle::from_arcsec(0.014_506 - 0.003_808_65 * t);
    (earth_rotation_angle(ut1) + origin - precession::equinox_travel(t)).positive()
}

/// Greenwich apparent sidereal time, in `[0, 2 pi)`.
pub fn apparent_sidereal_time(ut1: JulianDate<Ut1>, tt: JulianDate<Tt>) -> Angle {
    let equation_of_equinoxes = nutation(tt).equation_of_equinoxes(mean_obliquity(tt));
    (mean_sidereal_time(ut1, tt) + equation_of_equinoxes).positive()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    use crate::ephemeris::polynomial::polynomial;

    #[test]
    fn sidereal_time_follows_iau_2006_while_that_holds() {
        // Capitaine, Wallace & Chapront 2003, eq. 42 with the signs of its powers, arcseconds.
        let iau = [
            0.014_506,
            4_612.156_534,
            1.391_581_7,
            -0.000_000_44,
            -0.000_029_956,
            -0.000_000_036_8,
        ];
        let tolerances_arcsec =
            [(-10.0, 0.05), (-2.0, 0.002), (-0.5, 2e-4), (0.0, 1e-9), (0.3, 2e-4), (2.0, 0.002)];
        for (t, tolerance_arcsec) in tolerances_arcsec {
            let (ut1, tt) = (
                JulianDate::from_jd(2_451_545.25),
                JulianDate::from_jd(2_451_545.0 + 36_525.0 * t),
            );
            let expected = earth_rotation_angle(ut1) + Angle::from_arcsec(polynomial(&iau, t));
            let error = (mean_sidereal_time(ut1, tt) - expected).signed();
            assert!(error.abs().arcsec() < tolerance_arcsec, "{t}: {} arcsec", error.arcsec());
        }
    }

    /// Values of ERFA 2.0.1 (`nut06a`, `gst06a`, `pnm06a`): Julian date (TT, UT1 0.75 days
    /// earlier), nutation in longitude and obliquity, apparent sidereal time, true equinox and true
    /// pole in ICRS axes.
    #[test]
    fn orientation_agrees_with_iau_2006_and_2000a() {
        type Axis = [f64; 3];
        let truth: [(f64, f64, f64, f64, Axis, Axis); 8] = [
            (
                2378496.5,
                -8.527613,
                7.228171,
                3.310179308087,
                [0.998810516861, 0.044712984774, 0.019449946042],
                [-0.019451516041, -0.000400013368, 0.999810721343],
            ),
            (
                2415020.3,
                17.398811,
                -2.292028,
                2.046432580442,
                [0.999705003751, 0.022273809916, 0.009684155511],
                [-0.009683909637, -0.000118903344, 0.999953102778],
            ),
            (
                2433282.7,
                -3.281349,
                8.316780,
                4.564608720202,
                [0.999925525368, 0.011192629608, 0.004865055046],
                [-0.004865506649, 0.000013118673, 0.999988163266],
            ),
            (
                2451545.0,
                -13.932003,
                -5.769398,
                0.169608707650,
                [0.999999997721, 0.000061899864, 0.000026948114],
                [-0.000026946380, -0.000028004721, 0.999999999245],
            ),
            (
                2455197.9,
                16.522243,
                2.839652,
                5.832835972355,
                [0.999996828617, -0.002309912090, -0.001003524805],
                [0.001003556500, 0.000012562380, 0.999999496358],
            ),
            (
                2460676.1,
                0.135171,
                8.486110,
                0.798769462275,
                [0.999981419462, -0.005591063285, -0.002429144396],
                [0.002429374061, 0.000034286070, 0.999997048479],
            ),
            (
                2488069.5,
                3.288400,
                8.564317,
                3.316121932079,
                [0.999702303052, -0.022379302243, -0.009719676095],
                [0.009720602155, -0.000067405772, 0.999952751559],
            ),
            (
                2524593.5,
                11.083523,
                -8.015050,
                3.312412687021,
                [0.998807818227, -0.044778409998, -0.019438010352],
                [0.019436264292, -0.000474415071, 0.999810985417],
            ),
        ];
        for (jd, longitude_arcsec, obliquity_arcsec, sidereal_rad, equinox, pole) in truth {
            let tt = JulianDate::from_jd(jd);
            let instant = Instant {
                utc: JulianDate::from_jd(jd - 0.75),
                ut1: JulianDate::from_jd(jd - 0.75),
                tt,
                tdb: tt.read_on(0.0),
            };
            let axes = Orientation::at(&instant);
            let nutation = nutation(tt);
            assert!((nutation.longitude.arcsec() - longitude_arcsec).abs() < 0.005, "{jd}");
            assert!((nutation.obliquity.arcsec() - obliquity_arcsec).abs() < 0.005, "{jd}");
            let sidereal_error = (axes.sidereal_time - Angle::from_rad(sidereal_rad)).signed();
            assert!(sidereal_error.abs().arcsec() < 0.006, "{jd}: {}", sidereal_error.arcsec());
            let icrs_from_true = axes.true_from_icrs().inverse().matrix();
            for (axis, expected) in
                [(icrs_from_true.x_axis, equinox), (icrs_from_true.z_axis, pole)]
            {
                let error_arcsec =
                    Angle::from_rad((axis - DVec3::from(expected)).length()).arcsec();
                assert!(error_arcsec < 0.006, "{jd}: {error_arcsec}");
            }
        }
    }
}

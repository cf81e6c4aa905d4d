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
//! ([`precession::equinox_travel`]).
//!
//! *Accuracy.* True pole and equinox within 0.005" of IAU 2006/2000A in 1800-2200. The
//! precession is good to a few arcseconds in historical times (Vondrák et al.), nutation to 0.1"
//! beyond. Sidereal time is within 0.003" of IAU 2006 in 1800-2200 and consistent with the
//! precession everywhere. Polar motion (at most 0.6") is omitted.

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
/// & Chapront 2003, eq. 42).
pub fn mean_sidereal_time(ut1: JulianDate<Ut1>, tt: JulianDate<Tt>) -> Angle {
    let travel = precession::equinox_travel(tt.centuries_since_j2000());
    (earth_rotation_angle(ut1) + Angle::from_arcsec(0.014_506) - travel).positive()
}

/// Greenwich apparent sidereal time, in `[0, 2 pi)`.
pub fn apparent_sidereal_time(ut1: JulianDate<Ut1>, tt: JulianDate<Tt>) -> Angle {
    let equation_of_equinoxes = nutation(tt).equation_of_equinoxes(mean_obliquity(tt));
    (mean_sidereal_time(ut1, tt) + equation_of_equinoxes).positive()
}

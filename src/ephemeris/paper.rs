//! Sun and Moon by the appendix of the paper: Jensen, Durand, Stark, Premože, Dorsey & Shirley
//! 2001, "A physically-based night sky model", *SIGGRAPH 2001*, "Position Computations".
//!
//! The formulas are as printed, down to the truncated constants. Longitude and latitude refer to
//! the mean ecliptic and equinox of date; the paper turns them with a mean obliquity of its own,
//! we turn them with the precession of [`orientation`], so that this tier differs from the others
//! in the theory of motion alone. The paper gives 1 arcminute for the Sun and 8 arcminutes for
//! the Moon within five centuries of 2000.

use crate::ephemeris::orientation;
use crate::frame::{Dir, EclipticOfDate, Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::{AU_KM, Angle, EARTH_EQUATORIAL_RADIUS_KM};

/// Geocentric geometric position of the Sun.
pub fn sun(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    let t = tdb.centuries_since_j2000();
    let m = 6.24 + 628.302 * t;
    let longitude = 4.895048
        + 628.331951 * t
        + (0.033417 - 0.000084 * t) * m.sin()
        + 0.000351 * (2.0 * m).sin();
    let distance_au = 1.000140 - (0.016708 - 0.000042 * t) * m.cos() - 0.000141 * (2.0 * m).cos();
    icrs_from_ecliptic(tdb, longitude, 0.0, distance_au * AU_KM)
}

/// Geocentric geometric position of the Moon.
pub fn moon(tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    let t = tdb.centuries_since_j2000();
    let l = 3.8104 + 8399.7091 * t;
    let mp = 2.3554 + 8328.6911 * t;
    let m = 6.2300 + 628.3019 * t;
    let d = 5.1985 + 7771.3772 * t;
    let f = 1.6280 + 8433.4663 * t;
    let (d2, mp2) = (2.0 * d, 2.0 * mp);

    let longitude =
        l + 0.1098 * mp.sin() + 0.0222 * (d2 - mp).sin() + 0.0115 * d2.sin() + 0.0037 * mp2.sin()
            - 0.0032 * m.sin()
            - 0.0020 * (2.0 * f).sin()
            + 0.0010 * (d2 - mp2).sin()
            + 0.0010 * (d2 - m - mp).sin()
            + 0.0009 * (d2 + mp).sin()
            + 0.0008 * (d2 - m).sin()
            + 0.0007 * (mp - m).sin()
            - 0.0006 * d.sin()
            - 0.0005 * (m + mp).sin();
    let latitude = 0.0895 * f.sin()
        + 0.0049 * (mp + f).sin()
        + 0.0048 * (mp - f).sin()
        + 0.0030 * (d2 - f).sin()
        + 0.0010 * (d2 + f - mp).sin()
        + 0.0008 * (d2 - f - mp).sin()
        + 0.0006 * (d2 + f).sin();
    let parallax = 0.016593
        + 0.000904 * mp.cos()
        + 0.000166 * (d2 - mp).cos()
        + 0.000137 * d2.cos()
        + 0.000049 * mp2.cos()
        + 0.000015 * (d2 + mp).cos()
        + 0.000009 * (d2 - m).cos();
    icrs_from_ecliptic(tdb, longitude, latitude, EARTH_EQUATORIAL_RADIUS_KM / parallax)
}

fn icrs_from_ecliptic(
    tdb: JulianDate<Tdb>,
    longitude_rad: f64,
    latitude_rad: f64,
    distance_km: f64,
) -> Pos<Icrs> {
    let dir: Dir<EclipticOfDate> =
        Dir::from_spherical(Angle::from_rad(longitude_rad), Angle::from_rad(latitude_rad));
    // TDB and TT differ by 2 ms at most: 1e-8 arcsecond of precession.
    orientation::ecliptic_from_icrs(tdb.read_on(0.0)).inverse() * dir.at_km(distance_km)
}

//! How the Moon stands in space: the axes of its map, libration, position angle of its axis.
//!
//! *Theory.* Cassini's laws with a mean inclination of 1.54242 degrees (optical libration), and
//! Eckhardt's physical libration as truncated in Meeus 1998, *Astronomical Algorithms*, 2nd ed.,
//! chapter 53. Axes of mean Earth and mean rotation.
//!
//! *How we differ.* Meeus' series turn the principal axes of inertia. Two of their terms,
//! -0.02245 sin F in rho and 0.02244 cos F in sigma, are together nothing but a constant tilt of
//! 0.0224 degrees between the principal axes and those of mean Earth and mean rotation, which maps
//! of the Moon use. They are left out. (DE421 has 78.56" = 0.0218 degrees for this tilt.)
//!
//! *Accuracy.* Within 0.01 degrees of the integrated librations of DE421 in 1900-2050. In deep time
//! the mean arguments drift with those of the Moon's position: 0.1 degrees at -4000.

use super::moon::Arguments;
use super::orientation;
use crate::frame::{
    Dir, EclipticOfDate, Icrs, MoonFixed, Rot, TrueOfDate, turn_axes_x, turn_axes_z,
};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

/// Inclination of the mean lunar equator to the ecliptic (Eckhardt 1981; Meeus 1998, p. 372).
pub const EQUATOR_INCLINATION: Angle = Angle::from_deg(1.542_42);

/// Eckhardt's physical libration: of the inclination, of the node times the sine of the
/// inclination, and in longitude.
struct PhysicalLibration {
    rho: Angle,
    sigma: Angle,
    tau: Angle,
}

fn physical_libration(tdb: JulianDate<Tdb>, arguments: &Arguments) -> PhysicalLibration {
    let t = tdb.centuries_since_j2000();
    let Arguments { longitude, elongation: d, sun_anomaly: m, anomaly: mp, latitude: f, .. } =
        *arguments;
    let node = longitude - f;
    let e = arguments.eccentricity;
    let k1 = Angle::from_deg(119.75 + 131.849 * t);
    let k2 = Angle::from_deg(72.56 + 20.186 * t);
    let (d2, f2, mp2) = (d * 2.0, f * 2.0, mp * 2.0);
    let rho = -0.02752 * mp.cos() + 0.00684 * (mp - f2).cos()
        - 0.00293 * f2.cos()
        - 0.00085 * (f2 - d2).cos()
        - 0.00054 * (mp - d2).cos()
        - 0.00020 * (mp + f).sin()
        - 0.00020 * (mp + f2).cos()
        - 0.00020 * (mp - f).cos()
        + 0.00014 * (mp + f2 - d2).cos();
    let sigma = -0.02816 * mp.sin()
        - 0.00682 * (mp - f2).sin()
        - 0.00279 * f2.sin()
        - 0.00083 * (f2 - d2).sin()
        + 0.00069 * (mp - d2).sin()
        + 0.00040 * (mp + f).cos()
        - 0.00025 * mp2.sin()
        - 0.00023 * (mp + f2).sin()
        + 0.00020 * (mp - f).cos()
        + 0.00019 * (mp - f).sin()
        + 0.00013 * (mp + f2 - d2).sin()
        - 0.00010 * (mp - f * 3.0).cos();
    let tau = 0.02520 * e * m.sin() + 0.00473 * (mp2 - f2).sin() - 0.00467 * mp.sin()
        + 0.00396 * k1.sin()
        + 0.00276 * (mp2 - d2).sin()
        + 0.00196 * node.sin()
        - 0.00183 * (mp - f).cos()
        + 0.00115 * (mp - d2).sin()
        - 0.00096 * (mp - d).sin()
        + 0.00046 * (f2 - d2).sin()
        - 0.00039 * (mp - f).sin()
        - 0.00032 * (mp - m - d).sin()
        + 0.00027 * (mp2 - m - d2).sin()
        + 0.00023 * k2.sin()
        - 0.00014 * d2.sin()
        + 0.00014 * (mp2 - f2).cos()
        - 0.00012 * (mp - f2).sin()
        - 0.00012 * mp2.sin()
        + 0.00011 * (mp2 - m * 2.0 - d2).sin();
    PhysicalLibration {
        rho: Angle::from_deg(rho),
        sigma: Angle::from_deg(sigma),
        tau: Angle::from_deg(tau),
    }
}

/// The axes of the Moon's map at the moment when the light leaves it.
pub fn moon_fixed_from_icrs(tdb: JulianDate<Tdb>) -> Rot<MoonFixed, Icrs> {
    let arguments = Arguments::at(tdb);
    let physical = physical_libration(tdb, &arguments);
    let node_shift = physical.sigma / EQUATOR_INCLINATION.sin();
    let node = arguments.longitude - arguments.latitude + node_shift;
    let from_node = Angle::from_deg(180.0) + arguments.latitude + physical.tau - node_shift;
    // Cassini: the equator descends through the ecliptic where the orbit ascends; x, half a turn
    // and the mean argument of latitude further, faces the Earth.
    let moon_fixed_from_ecliptic: Rot<MoonFixed, EclipticOfDate> = Rot::claim(
        turn_axes_z(from_node)
            * turn_axes_x(-(EQUATOR_INCLINATION + physical.rho))
            * turn_axes_z(node),
    );
    // TDB and TT differ by 2 ms at most.
    moon_fixed_from_ecliptic * orientation::ecliptic_from_icrs(tdb.read_on(0.0))
}

/// Selenographic point that faces an observer: longitude positive towards Mare Crisium (east on
/// the Moon, west in the sky), in `[-pi, pi)`, and latitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Libration {
    pub longitude: Angle,
    pub latitude: Angle,
}

impl Libration {
    /// Given the direction from the Moon to whom it faces.
    pub fn facing(moon_fixed_from_icrs: Rot<MoonFixed, Icrs>, dir: Dir<Icrs>) -> Libration {
        let point = moon_fixed_from_icrs * dir;
        Libration { longitude: point.longitude().signed(), latitude: point.latitude() }
    }
}

/// Position angle of the Moon's north pole at its place in the sky, from the north of date through
/// east, in `[0, 2 pi)`.
pub fn axis_position_angle(
    moon_fixed_from_icrs: Rot<MoonFixed, Icrs>,
    true_from_icrs: Rot<TrueOfDate, Icrs>,
    moon: Dir<Icrs>,
) -> Angle {
    let pole: Dir<MoonFixed> = Dir::from_vector(glam::DVec3::Z);
    let pole = (true_from_icrs * (moon_fixed_from_icrs.inverse() * pole)).vector();
    let moon = (true_from_icrs * moon).vector();
    let east = glam::DVec3::new(-moon.y, moon.x, 0.0);
    let north = moon.cross(east);
    Angle::from_rad(pole.dot(east).atan2(pole.dot(north))).positive()
}

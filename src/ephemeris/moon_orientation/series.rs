//! Libration by series: for all dates, and without a file.
//!
//! *Theory.* Cassini's laws with a mean inclination of 1.54242 degrees (optical libration), and
//! Eckhardt's forced physical libration as truncated in Meeus 1998, *Astronomical Algorithms*, 2nd ed.,
//! chapter 53. Axes of mean Earth and mean rotation.
//!
//! *How we differ.* Meeus' series turn the principal axes of inertia. Two of their terms,
//! -0.02245 sin F in rho and 0.02244 cos F in sigma, are together nothing but a constant tilt of
//! 0.0224 degrees between the principal axes and those of mean Earth and mean rotation, which maps
//! of the Moon use. They are left out. (DE421 has 78.56" = 0.0218 degrees for this tilt.) What the
//! truncation leaves out of the theory and what is not forced is added:
//!
//! - The free librations in longitude and of the pole (wobble), with the amplitudes, periods and
//!   phases of Rambaux & Williams 2011, *Celest. Mech. Dyn. Astr.* 109, 85, abstract.
//! - The mean pole does not turn about the pole of the ecliptic but about a point 11.4" off. As the
//!   pole of the orbit it follows the equator of the Earth, whose bulge tilts the mean plane of the
//!   orbit by 8.05" (the term -0.002235 sin L' of the latitude), for it has all the time to follow what
//!   stands still. And it lags behind the ecliptic, which turns by 47.0" a century: by 6.00" with its
//!   own period of 80.6 years, on top of the 1.39" by which the orbit lags with its 18.6 years (motion
//!   times period over a full turn). The period of the pole is what Cassini's laws give: the forced tilt
//!   of 1.542 degrees against 5.145 of the orbit.
//!
//! *Accuracy.* Within 0.0018 degrees of the integrated librations of DE421 in 1900-2200; nothing
//! was fitted to them. Elsewhere there is nothing to compare with. The mean longitude and the node are
//! those of the series of the Moon, and err as it does.

use super::super::moon::Arguments;
use super::super::orientation;
use crate::frame::{EclipticOfDate, Icrs, MoonFixed, Rot, turn_axes_x, turn_axes_y, turn_axes_z};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

/// Inclination of the mean lunar equator to the ecliptic (Eckhardt 1981; Meeus 1998, p. 372).
const EQUATOR_INCLINATION: Angle = Angle::from_deg(1.542_42);

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

/// Where the mean pole turns about: off the pole of the ecliptic, along the axes of the mean ecliptic
/// and equinox of date. The bulge of the Earth gives the tilt towards y; the lag is at right angles to
/// the motion of the ecliptic, which is almost towards y in our millennia.
const POLE_OFFSET: [Angle; 2] = [Angle::from_arcsec(-7.39), Angle::from_arcsec(8.05 + 0.66)];

/// A mode of free libration: period and phase at J2000.0.
struct FreeMode {
    period_days: f64,
    phase: Angle,
}

/// In longitude, and of the pole (Rambaux & Williams 2011).
const FREE_LONGITUDE: FreeMode = FreeMode { period_days: 1056.13, phase: Angle::from_deg(207.01) };
const FREE_LONGITUDE_AMPLITUDE: Angle = Angle::from_arcsec(1.296);
const WOBBLE: FreeMode = FreeMode { period_days: 27_257.27, phase: Angle::from_deg(161.64) };
/// Semi-axes of the ellipse of the pole: along y and along x of the Moon.
const WOBBLE_AMPLITUDES: [Angle; 2] = [Angle::from_arcsec(8.183), Angle::from_arcsec(3.306)];

impl FreeMode {
    fn argument(&self, tdb: JulianDate<Tdb>) -> Angle {
        Angle::from_deg(360.0 * (tdb.days_since_j2000() / self.period_days % 1.0)) + self.phase
    }
}

/// The axes of the Moon's map at the moment when the light leaves it.
pub(super) fn moon_fixed_from_icrs(tdb: JulianDate<Tdb>) -> Rot<MoonFixed, Icrs> {
    let arguments = Arguments::at(tdb);
    let physical = physical_libration(tdb, &arguments);
    let free = FREE_LONGITUDE_AMPLITUDE * FREE_LONGITUDE.argument(tdb).sin();
    let node_shift = physical.sigma / EQUATOR_INCLINATION.sin();
    let node = arguments.longitude - arguments.latitude + node_shift;
    let from_node = Angle::from_deg(180.0) + arguments.latitude + physical.tau + free - node_shift;
    let (wobble_sin, wobble_cos) = WOBBLE.argument(tdb).sin_cos();
    let [along_y, along_x] = WOBBLE_AMPLITUDES;
    let [pole_x, pole_y] = POLE_OFFSET;
    // Cassini: the equator descends through the ecliptic where the orbit ascends; x, half a turn
    // and the mean argument of latitude further, faces the Earth.
    let moon_fixed_from_ecliptic: Rot<MoonFixed, EclipticOfDate> = Rot::claim(
        turn_axes_x(along_y * wobble_cos)
            * turn_axes_y(along_x * wobble_sin)
            * turn_axes_z(from_node)
            * turn_axes_x(-(EQUATOR_INCLINATION + physical.rho))
            * turn_axes_z(node)
            * turn_axes_x(-pole_y)
            * turn_axes_y(pole_x),
    );
    // TDB and TT differ by 2 ms at most.
    moon_fixed_from_ecliptic * orientation::ecliptic_from_icrs(tdb.read_on(0.0))
}

//! The columns that the Moon alone has.

use crate::ephemeris::Body;
use crate::ephemeris::apparent::{ApparentPlace, Observer};
use crate::ephemeris::moon_orientation::{Libration, axis_position_angle, moon_fixed_from_icrs};
use crate::frame::{Dir, Icrs, TrueOfDate};
use crate::units::{Angle, DAY_S, LIGHT_SPEED_KM_S};

use super::{MOON_GEOCENTRIC, MOON_TOPOCENTRIC};

/// The columns from the libration in longitude to the topocentric diameter, degrees and arcseconds.
///
/// Directions are those of the light that arrives, without aberration; the point below the Earth, the
/// Sun and the observer are in the axes of mean Earth and mean rotation.
pub fn figures(
    observer: &Observer,
    moon: &ApparentPlace,
) -> [f64; MOON_TOPOCENTRIC.end - MOON_GEOCENTRIC.start] {
    let light_time_s = moon.geocentric_distance_km / LIGHT_SPEED_KM_S;
    let axes = moon_fixed_from_icrs(observer.tdb.plus_days(-light_time_s / DAY_S));
    let (from_earth, from_observer) = (moon.from_earth.dir(), moon.from_observer.dir());
    let to_sun = -moon.from_sun.dir();
    let [geocentric, topocentric, subsolar] =
        [-from_earth, -from_observer, to_sun].map(|dir| Libration::facing(axes, dir));
    let axis = |dir: Dir<Icrs>| axis_position_angle(axes, observer.true_from_icrs, dir).deg();
    let phase_angle = to_sun.separation(-from_earth);
    let bright_limb =
        position_angle(observer.true_from_icrs * to_sun, observer.true_from_icrs * from_earth);
    let diameter_arcsec = |distance_km: f64| {
        2.0 * Angle::from_rad((Body::Moon.radius_km() / distance_km).asin()).arcsec()
    };
    [
        geocentric.longitude.deg(),
        geocentric.latitude.deg(),
        subsolar.longitude.deg(),
        subsolar.latitude.deg(),
        (Angle::from_deg(90.0) - subsolar.longitude).positive().deg(),
        phase_angle.deg(),
        (1.0 + phase_angle.cos()) / 2.0,
        axis(from_earth),
        bright_limb.deg(),
        diameter_arcsec(moon.geocentric_distance_km),
        topocentric.longitude.deg(),
        topocentric.latitude.deg(),
        axis(from_observer),
        diameter_arcsec(moon.topocentric_distance_km),
    ]
}

/// In which direction a vector points at a place in the sky: from the north of date through east, in
/// `[0, 2 pi)`.
fn position_angle(vector: Dir<TrueOfDate>, place: Dir<TrueOfDate>) -> Angle {
    let (v, p) = (vector.vector(), place.vector());
    let east = glam::DVec3::new(-p.y, p.x, 0.0);
    Angle::from_rad(v.dot(east).atan2(v.dot(p.cross(east)))).positive()
}

//! The columns that the Moon alone has.

use crate::ephemeris::moon_orientation::MoonPhysical;

use super::{MOON_GEOCENTRIC, MOON_TOPOCENTRIC};

/// The columns from the libration in longitude to the topocentric diameter, degrees and arcseconds.
pub fn figures(moon: &MoonPhysical) -> [f64; MOON_TOPOCENTRIC.end - MOON_GEOCENTRIC.start] {
    let MoonPhysical { geocentric, topocentric, subsolar, colongitude, phase } = moon;
    [
        geocentric.libration.longitude.deg(),
        geocentric.libration.latitude.deg(),
        subsolar.longitude.deg(),
        subsolar.latitude.deg(),
        colongitude.deg(),
        phase.angle.deg(),
        phase.illuminated_fraction,
        geocentric.axis_position_angle.deg(),
        phase.bright_limb.deg(),
        geocentric.angular_diameter.arcsec(),
        topocentric.libration.longitude.deg(),
        topocentric.libration.latitude.deg(),
        topocentric.axis_position_angle.deg(),
        topocentric.angular_diameter.arcsec(),
    ]
}

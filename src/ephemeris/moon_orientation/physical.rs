//! The physical ephemeris of the Moon: which point faces us, where the Sun rises on it, how its axis
//! stands in the sky.

use crate::ephemeris::phase::{Phase, angular_diameter, position_angle};
use crate::frame::{Dir, Icrs, MoonFixed, Pos, Rot, TrueOfDate};
use crate::units::{Angle, MOON_RADIUS_KM};

/// A point of the Moon, by the direction that it faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Libration {
    /// Positive towards Mare Crisium (east on the Moon, west in the sky), in `[-pi, pi)`.
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
    let pole = moon_fixed_from_icrs.inverse() * pole;
    position_angle(true_from_icrs * moon, true_from_icrs * pole)
}

/// The face of the Moon that one observer sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MoonFace {
    /// The point below the observer, optical and physical libration together.
    pub libration: Libration,
    /// See [`axis_position_angle`].
    pub axis_position_angle: Angle,
    /// Of the sphere of [`MOON_RADIUS_KM`].
    pub angular_diameter: Angle,
}

/// What almanacs say of the Moon's disc. All of it is geometric: the Moon stands where the light left
/// it, without aberration and without air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MoonPhysical {
    /// From the centre of the Earth.
    pub geocentric: MoonFace,
    /// From the place of the observer.
    pub topocentric: MoonFace,
    /// The point below the Sun.
    pub subsolar: Libration,
    /// Selenographic longitude of the morning terminator, counted westwards: 90 degrees less the
    /// longitude of the point below the Sun, in `[0, 2 pi)`. 270 degrees at new Moon, 0 at first
    /// quarter.
    pub colongitude: Angle,
    /// From the centre of the Earth.
    pub phase: Phase,
}

impl MoonPhysical {
    /// Given the Moon's axes when the light left it, the true equator of the date when the light
    /// arrives, and where the Moon was when the light left: from the centre of the Earth, from the
    /// observer, and from the Sun.
    pub fn of(
        moon_fixed_from_icrs: Rot<MoonFixed, Icrs>,
        true_from_icrs: Rot<TrueOfDate, Icrs>,
        from_earth: Pos<Icrs>,
        from_observer: Pos<Icrs>,
        from_sun: Pos<Icrs>,
    ) -> MoonPhysical {
        let face = |from: Pos<Icrs>| MoonFace {
            libration: Libration::facing(moon_fixed_from_icrs, -from.dir()),
            axis_position_angle: axis_position_angle(
                moon_fixed_from_icrs,
                true_from_icrs,
                from.dir(),
            ),
            angular_diameter: angular_diameter(MOON_RADIUS_KM, from.distance_km()),
        };
        let subsolar = Libration::facing(moon_fixed_from_icrs, -from_sun.dir());
        MoonPhysical {
            geocentric: face(from_earth),
            topocentric: face(from_observer),
            subsolar,
            colongitude: (Angle::from_deg(90.0) - subsolar.longitude).positive(),
            phase: Phase::seen(true_from_icrs, from_earth, from_sun),
        }
    }
}

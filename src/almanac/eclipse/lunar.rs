//! Eclipses of the Moon.
//!
//! *Theory.* The shadow of the Earth is a circle about the point opposite to the apparent Sun,
//! with the radii of Danjon as Espenak & Meeus write them (NASA/TP-2009-214172, on the enlargement
//! of Earth's shadows): `1.01 P + p + s` for the penumbra and `1.01 P + p - s` for the umbra, P
//! and p the equatorial horizontal parallaxes of Moon and Sun, s the semidiameter of the Sun. The
//! eclipse is greatest when the centre of the Moon passes nearest to the axis of the shadow, in
//! kilometres. The angle is smallest up to 10 s earlier or later, because the Moon comes closer or
//! goes.

use std::fmt;

use super::EclipseError;
use super::local::{LocalMoment, Site};
use super::lunation::Lunation;
use super::radii::{MOON_IN_SHADOW_KM, SHADOW_ENLARGEMENT, SUN_KM};
use super::solve::crossing;
use super::track::{HALF_WIDTH_S, Positions, Track};
use crate::place::Place;
use crate::time::{Instant, TimeError};
use crate::units::EARTH_EQUATORIAL_RADIUS_KM;

/// How far into the shadow of the Earth the Moon goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LunarKind {
    /// Into the penumbra alone, where some of the Sun is still seen.
    Penumbral,
    /// Partly into the umbra.
    Partial,
    /// Wholly into the umbra.
    Total,
}

/// First and last moment of each phase; `None` for a phase that does not come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LunarContacts<T> {
    /// P1 and P4: the Moon touches the penumbra from outside.
    pub penumbral: [T; 2],
    /// U1 and U4: the Moon touches the umbra from outside.
    pub partial: Option<[T; 2]>,
    /// U2 and U3: the Moon touches the umbra from inside.
    pub total: Option<[T; 2]>,
}

/// An eclipse of the Moon.
#[derive(Debug, Clone)]
pub struct LunarEclipse {
    /// The deepest phase.
    pub kind: LunarKind,
    /// When the centre of the Moon is nearest to the axis of the shadow.
    pub greatest: Instant,
    /// When the Moon touches the rims of the shadow.
    pub contacts: LunarContacts<Instant>,
    /// Least distance of the Moon from the axis, equatorial radii of the Earth; positive where it
    /// passes north of it.
    pub gamma: f64,
    /// Part of the diameter of the Moon within the umbra; above 1 in a total eclipse, negative
    /// without umbra.
    pub umbral_magnitude: f64,
    /// Part of the diameter of the Moon within the penumbra.
    pub penumbral_magnitude: f64,
    /// Number of the Saros series.
    pub saros: i32,
    /// Brown's lunation number less 953: the new moon before, counted from that of 2000-01-06.
    pub lunation: i32,
    /// Bound of the error of the times, seconds of TT. What is not known of the rotation of the
    /// Earth (see [`crate::time::delta_t`]) comes on top for clocks and places.
    pub uncertainty_s: f64,
    track: Track,
    contacts_s: LunarContacts<f64>,
    greatest_s: f64,
}

/// An eclipse of the Moon at one place. Whoever sees the Moon sees the same eclipse; the places
/// differ in when the Moon is up.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalLunarEclipse {
    /// The greatest eclipse, seen or not.
    pub greatest: LocalMoment,
    /// The contacts, seen or not.
    pub contacts: LunarContacts<LocalMoment>,
    /// From when to when the Moon is up between P1 and P4: empty where nothing is seen.
    pub visible: Vec<[LocalMoment; 2]>,
    /// The deepest phase that is seen, in part at least.
    pub seen: Option<LunarKind>,
}

impl fmt::Display for LunarKind {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            LunarKind::Penumbral => "penumbral",
            LunarKind::Partial => "partial",
            LunarKind::Total => "total",
        })
    }
}

impl<T> LunarContacts<T> {
    /// The same contacts, told otherwise.
    fn try_map<U, E>(&self, tell: impl Fn(&T) -> Result<U, E>) -> Result<LunarContacts<U>, E> {
        let both = |[first, last]: &[T; 2]| Ok([tell(first)?, tell(last)?]);
        Ok(LunarContacts {
            penumbral: both(&self.penumbral)?,
            partial: self.partial.as_ref().map(both).transpose()?,
            total: self.total.as_ref().map(both).transpose()?,
        })
    }
}

impl LunarEclipse {
    /// The eclipse of a full moon that comes nearest to the axis at `greatest_s`, if there is one.
    pub(super) fn of(
        lunation: Lunation,
        track: Track,
        greatest_s: f64,
    ) -> Result<Option<LunarEclipse>, EclipseError> {
        let shadow = EarthShadow::at(&track, greatest_s);
        let (umbral_magnitude, penumbral_magnitude) =
            (shadow.magnitude(shadow.umbra), shadow.magnitude(shadow.penumbra));
        let kind = if umbral_magnitude >= 1.0 {
            LunarKind::Total
        } else if umbral_magnitude > 0.0 {
            LunarKind::Partial
        } else if penumbral_magnitude > 0.0 {
            LunarKind::Penumbral
        } else {
            return Ok(None);
        };
        let phase = |gap: fn(&EarthShadow) -> f64| {
            let gap = |t: f64| gap(&EarthShadow::at(&track, t));
            [-HALF_WIDTH_S, HALF_WIDTH_S].map(|end_s| crossing(gap, greatest_s, end_s))
        };
        let contacts_s = LunarContacts {
            penumbral: phase(|s| s.distance - s.penumbra - s.moon),
            partial: (kind >= LunarKind::Partial).then(|| phase(|s| s.distance - s.umbra - s.moon)),
            total: (kind >= LunarKind::Total).then(|| phase(|s| s.distance - s.umbra + s.moon)),
        };
        Ok(Some(LunarEclipse {
            kind,
            greatest: track.instant(greatest_s)?,
            contacts: contacts_s.try_map(|&t| track.instant(t))?,
            gamma: shadow.gamma,
            umbral_magnitude,
            penumbral_magnitude,
            saros: lunation.saros(),
            lunation: lunation.number,
            uncertainty_s: track.uncertainty_s(),
            track,
            contacts_s,
            greatest_s,
        }))
    }

    /// The square of what is smallest at greatest eclipse, km2.
    pub(super) fn axis_distance_squared(positions: &Positions) -> f64 {
        positions.moon.km().reject_from_normalized(positions.sun.dir().vector()).length_squared()
    }

    /// Where the Moon stands meanwhile in the sky of a place.
    ///
    /// # Errors
    ///
    /// A date that no clock serves: at the ends of time alone.
    pub fn at(&self, place: &Place) -> Result<LocalLunarEclipse, TimeError> {
        let site = Site::new(place);
        let moment = |&t: &f64| site.moment(&self.track, t, |positions| positions.moon);
        let [first_s, last_s] = self.contacts_s.penumbral;
        let visible = site.up(&self.track, first_s, last_s, |positions| positions.moon);
        let is_seen = |phase: Option<[f64; 2]>| {
            phase.is_some_and(|[from, to]| visible.iter().any(|v| v[0] < to && from < v[1]))
        };
        let seen = [
            (LunarKind::Total, self.contacts_s.total),
            (LunarKind::Partial, self.contacts_s.partial),
            (LunarKind::Penumbral, Some(self.contacts_s.penumbral)),
        ];
        Ok(LocalLunarEclipse {
            greatest: moment(&self.greatest_s)?,
            contacts: self.contacts_s.try_map(moment)?,
            seen: seen.into_iter().find(|(_, phase)| is_seen(*phase)).map(|(kind, _)| kind),
            visible: visible
                .iter()
                .map(|[from, to]| Ok([moment(from)?, moment(to)?]))
                .collect::<Result<_, _>>()?,
        })
    }
}

/// The shadow of the Earth and the Moon in it, at one moment; radians from the centre of the Earth.
#[derive(Debug, Clone, Copy)]
struct EarthShadow {
    penumbra: f64,
    umbra: f64,
    moon: f64,
    /// From the centre of the Moon to the axis.
    distance: f64,
    /// The same in radii of the Earth, positive in the north.
    gamma: f64,
}

impl EarthShadow {
    fn at(track: &Track, seconds: f64) -> EarthShadow {
        let Positions { sun, moon, .. } = track.at(seconds);
        let (sun_km, moon_km) = (sun.distance_km(), moon.distance_km());
        let earth_km = EARTH_EQUATORIAL_RADIUS_KM;
        let (moon_parallax, sun_parallax) =
            ((earth_km / moon_km).asin(), (earth_km / sun_km).asin());
        let sun_radius = (SUN_KM / sun_km).asin();
        let earth_radius = SHADOW_ENLARGEMENT * moon_parallax + sun_parallax;
        let from_axis = moon.km().reject_from_normalized(sun.dir().vector());
        EarthShadow {
            penumbra: earth_radius + sun_radius,
            umbra: earth_radius - sun_radius,
            moon: (MOON_IN_SHADOW_KM / moon_km).asin(),
            distance: (-sun.dir()).separation(moon.dir()).rad(),
            gamma: (from_axis.length() / earth_km).copysign(from_axis.z),
        }
    }

    /// Part of the diameter of the Moon within a circle about the axis.
    fn magnitude(&self, radius: f64) -> f64 {
        (radius + self.moon - self.distance) / (2.0 * self.moon)
    }
}

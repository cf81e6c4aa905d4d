//! Eclipses of the Sun: what one place sees.
//!
//! *Theory.* The discs of Sun and Moon as they stand for an observer on the ellipsoid, from
//! apparent geocentric places less the place of the observer: no elements, no fundamental plane.
//! The maximum is when the largest part of the diameter of the Sun is covered. Centres are nearest
//! some seconds earlier or later, because the Moon grows towards noon.

use glam::DVec3;

use super::discs::{Cover, Discs};
use super::local::{LocalMoment, Site};
use super::solve::{crossing, minimum};
use super::track::{HALF_WIDTH_S, Track};
use crate::place::Place;
use crate::time::TimeError;
use crate::units::Angle;

/// A moment at which the rims of Sun and Moon touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolarContact {
    /// When, and where the Sun stands.
    pub moment: LocalMoment,
    /// Where on the rim of the Sun: from celestial north through east.
    pub position_angle: Angle,
    /// The same from the top of the Sun, in the same sense (to the left in the northern sky).
    pub angle_from_zenith: Angle,
}

/// A moment of an eclipse of the Sun, and how much is covered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolarPhase {
    /// When, and where the Sun stands.
    pub moment: LocalMoment,
    /// Part of the diameter of the Sun that is covered, on the line through both centres.
    pub magnitude: f64,
    /// Part of the disc of the Sun that is covered, 0 to 1.
    pub obscuration: f64,
    /// Diameter of the Moon over that of the Sun.
    pub diameter_ratio: f64,
}

/// An eclipse of the Sun as one place sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalSolarEclipse {
    /// At the maximum, seen or not.
    pub kind: Cover,
    /// C1 and C4: the first and the last bite.
    pub partial: [SolarContact; 2],
    /// C2 and C3: the total or annular phase begins and ends.
    pub central: Option<[SolarContact; 2]>,
    /// When most is covered, be the Sun up or not.
    pub maximum: SolarPhase,
    /// From when to when the Sun is up between C1 and C4: empty where nothing is seen.
    pub visible: Vec<[LocalMoment; 2]>,
    /// The most that is seen: the maximum, or the phase when the Sun rises or sets.
    pub seen: Option<SolarPhase>,
}

/// A place that looks at the Sun over the hours of an eclipse.
pub(super) struct SolarView<'a> {
    track: &'a Track,
    site: Site,
}

impl SolarView<'_> {
    pub fn new<'a>(track: &'a Track, place: &Place) -> SolarView<'a> {
        SolarView { track, site: Site::new(place) }
    }

    pub fn discs(&self, seconds: f64) -> Discs {
        let positions = self.track.at(seconds);
        Discs::of(
            self.site.topocentric(&positions, positions.sun),
            self.site.topocentric(&positions, positions.moon),
        )
    }

    /// When the total or annular phase begins and ends; `inside_s` is a time between.
    pub fn central(&self, inside_s: f64) -> Option<[f64; 2]> {
        self.span(Discs::inner_gap, inside_s)
    }

    /// Everything.
    pub fn eclipse(&self) -> Result<Option<LocalSolarEclipse>, TimeError> {
        // The slope is asked a few seconds outside.
        let end_s = HALF_WIDTH_S - 60.0;
        let covered = |t: f64| self.discs(t).smooth_magnitude();
        let Some(maximum_s) = minimum(|t| -covered(t), -end_s, end_s) else { return Ok(None) };
        let (Some(kind), Some(partial)) =
            (self.discs(maximum_s).cover(), self.span(Discs::outer_gap, maximum_s))
        else {
            return Ok(None);
        };
        // The Moon within the Sun touches on the side on which it stands; one that hides the Sun
        // lets the last light out on the other.
        let inner = if kind == Cover::Total { Angle::from_deg(180.0) } else { Angle::ZERO };
        let contacts = |[first, last]: [f64; 2], turn: Angle| {
            Ok::<_, TimeError>([self.contact(first, turn)?, self.contact(last, turn)?])
        };
        let stretches = self.site.up(self.track, partial[0], partial[1], |positions| positions.sun);
        let mut best: Option<f64> = None;
        for stretch in &stretches {
            let t = maximum_s.clamp(stretch[0], stretch[1]);
            if best.is_none_or(|best| covered(t) > covered(best)) {
                best = Some(t);
            }
        }
        Ok(Some(LocalSolarEclipse {
            kind,
            partial: contacts(partial, Angle::ZERO)?,
            central: self.central(maximum_s).map(|span| contacts(span, inner)).transpose()?,
            maximum: self.phase(maximum_s)?,
            visible: stretches
                .iter()
                .map(|[from, to]| Ok([self.moment(*from)?, self.moment(*to)?]))
                .collect::<Result<_, TimeError>>()?,
            seen: best.map(|t| self.phase(t)).transpose()?,
        }))
    }

    /// Where a gap that is negative at a time opens before and after.
    fn span(&self, gap: fn(&Discs) -> f64, inside_s: f64) -> Option<[f64; 2]> {
        let gap = |t: f64| gap(&self.discs(t));
        let ends = [-HALF_WIDTH_S, HALF_WIDTH_S];
        (gap(inside_s) < 0.0).then(|| ends.map(|end_s| crossing(gap, inside_s, end_s)))
    }

    fn moment(&self, seconds: f64) -> Result<LocalMoment, TimeError> {
        self.site.moment(self.track, seconds, |positions| positions.sun)
    }

    fn phase(&self, seconds: f64) -> Result<SolarPhase, TimeError> {
        let discs = self.discs(seconds);
        Ok(SolarPhase {
            moment: self.moment(seconds)?,
            magnitude: discs.magnitude(),
            obscuration: discs.obscuration(),
            diameter_ratio: discs.diameter_ratio(),
        })
    }

    /// `turn` leads from the side of the Moon to the side where the rims touch.
    fn contact(&self, seconds: f64, turn: Angle) -> Result<SolarContact, TimeError> {
        let positions = self.track.at(seconds);
        let sun = self.site.topocentric(&positions, positions.sun).dir().vector();
        let moon = self.site.topocentric(&positions, positions.moon).dir().vector();
        let zenith = self.site.horizon_from_true(&positions).inverse().matrix().z_axis;
        let east = DVec3::Z.cross(sun).normalize();
        let north = sun.cross(east);
        let angle = |v: DVec3| Angle::from_rad(v.dot(east).atan2(v.dot(north)));
        let position_angle = (angle(moon) + turn).positive();
        Ok(SolarContact {
            moment: self.moment(seconds)?,
            position_angle,
            angle_from_zenith: (position_angle - angle(zenith)).positive(),
        })
    }
}

//! Eclipses of the Sun: what happens on the Earth as a whole.
//!
//! *Theory.* See [`super::shadow`]. The eclipse is greatest when the axis of the shadow passes
//! nearest to the centre of the Earth. The place of the greatest eclipse is where the axis meets
//! the ground, or, if it does not, the point of the Earth nearest to it, where the Sun stands on
//! the horizon. That point is sought on the ellipsoid itself; the usual stretched sphere puts it
//! some 2 km elsewhere, the Swiss Ephemeris up to 0.09 degree.

use std::fmt;

use glam::DVec3;

use super::EclipseError;
use super::lunation::Lunation;
use super::shadow::MoonShadow;
use super::solar_local::{LocalSolarEclipse, SolarView};
use super::solve::{crossing, minimum};
use super::track::{HALF_WIDTH_S, Positions, Track};
use crate::frame::{Itrs, Pos};
use crate::place::{Place, WGS84_FLATTENING};
use crate::time::{Instant, TimeError};
use crate::units::Angle;

/// Half the time over which the motion of the shadow on the ground is taken, seconds.
const MOTION_STEP_S: f64 = 10.0;

/// What the best place sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolarKind {
    /// No place sees more than a part of the Sun covered.
    Partial,
    /// The Moon is too small to cover the Sun.
    Annular,
    /// The Moon covers the Sun.
    Total,
    /// Total along a part of the path, annular along the other.
    Hybrid,
}

/// When shadows fall on the Earth; `None` for those that miss it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolarContacts {
    /// P1 and P4: the penumbra touches the Earth from outside.
    pub partial: [Instant; 2],
    /// U1 and U4: the umbra, or what lies behind its tip, touches the Earth from outside.
    pub umbral: Option<[Instant; 2]>,
    /// C1 and C2: the axis comes to the Earth and leaves it.
    pub central: Option<[Instant; 2]>,
}

/// An eclipse of the Sun.
#[derive(Debug, Clone)]
pub struct SolarEclipse {
    /// What the best place sees.
    pub kind: SolarKind,
    /// When the axis of the shadow is nearest to the centre of the Earth.
    pub greatest: Instant,
    /// When shadows touch the Earth.
    pub contacts: SolarContacts,
    /// Least distance of the axis from the centre of the Earth, equatorial radii; positive where it
    /// passes north of it.
    pub gamma: f64,
    /// Where the eclipse is greatest then; sea level.
    pub place: Place,
    /// Part of the diameter of the Sun that is covered there and then, on the line through both
    /// centres. Where the axis meets the ground it is half the ratio of diameters and a half.
    pub magnitude: f64,
    /// Part of the disc of the Sun that is covered there and then, 0 to 1.
    pub obscuration: f64,
    /// Diameter of the Moon over that of the Sun there and then. Canons print this number as the
    /// magnitude of total and annular eclipses.
    pub diameter_ratio: f64,
    /// Duration of the total or annular phase at the place of the greatest eclipse, seconds.
    pub central_duration_s: Option<f64>,
    /// Width of the path of the total or annular phase there, kilometres across its way; `None`
    /// where a part of the umbra misses the Earth.
    pub path_width_km: Option<f64>,
    /// Number of the Saros series.
    pub saros: i32,
    /// Brown's lunation number less 953: counted from the new moon of 2000-01-06.
    pub lunation: i32,
    /// Bound of the error of the times, seconds of TT. What is not known of the rotation of the
    /// Earth (see [`crate::time::delta_t`]) comes on top for clocks and places.
    pub uncertainty_s: f64,
    track: Track,
}

impl fmt::Display for SolarKind {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            SolarKind::Partial => "partial",
            SolarKind::Annular => "annular",
            SolarKind::Total => "total",
            SolarKind::Hybrid => "hybrid",
        })
    }
}

impl SolarEclipse {
    /// The eclipse of a new moon whose axis comes nearest to the Earth at `greatest_s`, if there
    /// is one.
    pub(super) fn of(
        lunation: Lunation,
        track: Track,
        greatest_s: f64,
    ) -> Result<Option<SolarEclipse>, EclipseError> {
        let shadow_at = |t: f64| MoonShadow::of(&track.at(t));
        let span = |gap: fn(&MoonShadow) -> f64| {
            let gap = |t: f64| gap(&shadow_at(t));
            let ends = [-HALF_WIDTH_S, HALF_WIDTH_S];
            (gap(greatest_s) < 0.0).then(|| ends.map(|end_s| crossing(gap, greatest_s, end_s)))
        };
        let Some(partial) = span(MoonShadow::penumbra_gap_km) else { return Ok(None) };
        let umbral = span(MoonShadow::umbra_gap_km);
        let central = span(|shadow| shadow.rim().clearance_km);

        // Signed: positive where the eclipse is total.
        let umbra_km = |t: f64| {
            let shadow = shadow_at(t);
            shadow.umbra_km(shadow.nearest_ground())
        };
        let kind = match (umbral, central) {
            (None, _) => SolarKind::Partial,
            (Some(_), None) => SolarKind::of(umbra_km(greatest_s), umbra_km(greatest_s)),
            (Some(_), Some([from, to])) => {
                // Widest where the ground is nearest to the Moon, narrowest at one of the ends.
                let ends = [umbra_km(from), umbra_km(to)];
                let middle = umbra_km(minimum(|t| -umbra_km(t), from, to).unwrap_or(greatest_s));
                SolarKind::of(ends[0].min(ends[1]), middle.max(ends[0]).max(ends[1]))
            }
        };

        let positions = track.at(greatest_s);
        let place = place_of(positions.itrs_from_true * shadow_at(greatest_s).nearest_ground());
        let view = SolarView::new(&track, &place);
        let discs = view.discs(greatest_s);
        let duration_s = view.central(greatest_s).map(|[from, to]| to - from);
        let instants =
            |[from, to]: [f64; 2]| Ok::<_, TimeError>([track.instant(from)?, track.instant(to)?]);
        let maybe = |span: Option<[f64; 2]>| span.map(instants).transpose();
        Ok(Some(SolarEclipse {
            kind,
            greatest: track.instant(greatest_s)?,
            contacts: SolarContacts {
                partial: instants(partial)?,
                umbral: maybe(umbral)?,
                central: maybe(central)?,
            },
            gamma: shadow_at(greatest_s).gamma(),
            magnitude: discs.magnitude(),
            obscuration: discs.obscuration(),
            diameter_ratio: discs.diameter_ratio(),
            central_duration_s: duration_s,
            path_width_km: path_width_km(&track, greatest_s),
            place,
            saros: lunation.saros(),
            lunation: lunation.number,
            uncertainty_s: track.uncertainty_s(),
            track,
        }))
    }

    /// The square of what is smallest at greatest eclipse, km2.
    pub(super) fn axis_distance_squared(positions: &Positions) -> f64 {
        MoonShadow::of(positions).foot().km().length_squared()
    }

    /// The eclipse as a place sees it, below the horizon too; `None` where the Moon passes the Sun.
    ///
    /// # Errors
    ///
    /// A date that no clock serves: at the ends of time alone.
    pub fn at(&self, place: &Place) -> Result<Option<LocalSolarEclipse>, TimeError> {
        SolarView::new(&self.track, place).eclipse()
    }
}

impl SolarKind {
    /// From the least and the largest radius of the umbra along the path, negative behind its tip.
    fn of(least_km: f64, largest_km: f64) -> SolarKind {
        if least_km >= 0.0 {
            SolarKind::Total
        } else if largest_km <= 0.0 {
            SolarKind::Annular
        } else {
            SolarKind::Hybrid
        }
    }
}

/// The place on the ellipsoid at a position.
fn place_of(position: Pos<Itrs>) -> Place {
    let p = position.km();
    let polar = (1.0 - WGS84_FLATTENING).powi(2);
    Place {
        name: None,
        latitude: Angle::from_rad(p.z.atan2(p.x.hypot(p.y) * polar)),
        longitude: Angle::from_rad(p.y.atan2(p.x)).signed(),
        height_m: 0.0,
        time_zone: None,
    }
}

/// Width of the path where the axis meets the ground, across its way.
///
/// On the ground the umbra is an ellipse, drawn out along the azimuth of the Sun by one over the
/// sine of its altitude; the path is as wide as that is across the motion of its centre. The
/// ground is taken for flat: NASA/TP-2006-214141 does the same.
fn path_width_km(track: &Track, greatest_s: f64) -> Option<f64> {
    let ground_at = |t: f64| {
        let positions = track.at(t);
        Some(positions.itrs_from_true * MoonShadow::of(&positions).ground()?)
    };
    let motion = ground_at(greatest_s + MOTION_STEP_S)? - ground_at(greatest_s - MOTION_STEP_S)?;
    let positions = track.at(greatest_s);
    let shadow = MoonShadow::of(&positions);
    let ground = shadow.ground()?;
    let umbra_km = shadow.umbra_km(ground).abs();
    if shadow.rim().clearance_km + umbra_km > 0.0 {
        return None;
    }
    let place = place_of(positions.itrs_from_true * ground);
    let horizon_from_itrs = place.horizon_from_itrs();
    let sun = horizon_from_itrs * positions.itrs_from_true * shadow.sunward();
    let across = (horizon_from_itrs * motion).km().cross(DVec3::Z).normalize();
    let towards_sun = (sun.vector() * DVec3::new(1.0, 1.0, 0.0)).normalize_or(DVec3::X);
    let (sine, along) = (sun.vector().z, across.dot(towards_sun));
    Some(2.0 * umbra_km * ((along / sine).powi(2) + 1.0 - along * along).sqrt())
}

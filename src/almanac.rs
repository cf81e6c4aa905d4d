//! What happens in the sky, and when: an almanac of any place and any time.
//!
//! [`Almanac::new`] is told what is asked for ([`Request`]), [`Almanac::events`] gives the events of a
//! length of time in order, one after the other, however many there are.
//!
//! ```
//! use nocturne::almanac::{Almanac, Class, Request};
//! use nocturne::ephemeris::Ephemeris;
//! use nocturne::time;
//!
//! let instant = |text| time::to_instant(&time::parse(text)?, None);
//! let request = Request { classes: vec![Class::Phase], ..Request::default() };
//! let almanac = Almanac::new(&Ephemeris::analytic(), None, request)?;
//! let phases = almanac.events(&instant("2026-08-01")?, &instant("2026-09-01")?)?;
//! let phases: Vec<String> = phases.map(|event| Ok(event?.what.to_string())).collect::<Result<_, nocturne::almanac::AlmanacError>>()?;
//! assert_eq!(phases[1], "New Moon");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Definitions
//!
//! [`Almanac::definitions`] says them in words, and every file that is written carries them. See
//! [`limits`] for rise and set.
//!
//! # Method
//!
//! Every event is a zero or an extremum of a smooth function of time. On spans of days each function
//! is replaced by a polynomial that follows it within 0.01" (`chebyshev`), and all zeros of that are
//! found (`crossing`): whether the Sun grazes the horizon of a polar summer, sets twice in one day of
//! the clock, or not for months, is settled by bounds and not by luck with a step. The exact theory
//! then corrects each instant. An event belongs to the time that is asked for from its beginning
//! up to, not with, its end.
//!
//! # Accuracy
//!
//! What the search adds to the errors of the ephemeris, as `tests/almanac.rs` measures it with the
//! tables of DE440 against brute force with the same ephemeris: 0.02 s in rise, set, transit and
//! twilight (at the poles, in polar summers and where the Sun grazes the horizon, too), 0.01 s in phases,
//! seasons and meetings with the Sun, 0.2 s in the slowest conjunctions, seconds in the ends of orbits
//! and in nearest approaches, where a metre shifts the moment by as much.
//!
//! An error of 1" in the ephemeris is 0.07 s of rise and set at the equator, more where bodies rise at
//! a slant, and 2 s in phases of the Moon. Instants that are kept in universal time share the error of
//! Delta-T ([`delta_t_error_s`]): phases and seasons all of it, rise and set as much as the body
//! moves among the stars meanwhile (1/365 of it for the Sun, 1/27 for the Moon).

mod certainty;
mod chebyshev;
mod crossing;
mod dark;
pub mod eclipse;
mod event;
mod events;
mod geocentric;
pub mod limits;
mod local;
mod shadows;
mod span;
mod theory;

use thiserror::Error;

use crate::ephemeris::{Body, Ephemeris, EphemerisError, Tolerance};
use crate::place::{Place, PlaceError};
use crate::time::{Instant, TimeError};
use crate::units::Angle;

pub use certainty::delta_t_error_s;
pub use event::{
    Apsis, Class, Contact, Coordinate, Edge, Event, Meridian, Quarter, Season, Side, Target,
    Twilight, UnknownClass, View, What,
};
pub use events::Events;
pub use limits::Limits;

use eclipse::EclipseError;
use geocentric::GeocentricSearch;
use local::{LocalFound, LocalSearch};
use span::Stretch;
use theory::Theory;

/// What the words mean: a sentence, and the events that it is about; none where it is about all.
const DEFINITIONS: [(&[Class], &str); 10] = [
    (
        &[Class::Rise, Class::Set],
        "rise and set: airless topocentric altitude of the centre is -50' for the Sun, -(34' + \
         topocentric semidiameter for a radius of 1737.4 km) for the Moon, -34' for planets and stars",
    ),
    (
        &[Class::Twilight],
        "dawn and dusk: airless topocentric altitude of the Sun's centre is -6 (civil), -12 \
         (nautical) or -18 degrees (astronomical)",
    ),
    (
        &[Class::Transit, Class::LowerTransit],
        "transit: topocentric hour angle is 0 (lower transit: 12 hours)",
    ),
    (
        &[Class::Phase, Class::Season],
        "phases and seasons: apparent geocentric ecliptic longitude of date, of the Moon from the Sun \
         and of the Sun, is a multiple of 90 degrees",
    ),
    (
        &[Class::Apsis],
        "perihelion, aphelion, perigee and apogee: extrema of the geometric distance between the \
         centres of the Earth and of the Sun or the Moon",
    ),
    (
        &[Class::Conjunction, Class::LongitudeConjunction, Class::Opposition],
        "conjunction: equal apparent geocentric right ascension, or ecliptic longitude of date where \
         it says so; with the Sun, and opposition: ecliptic longitude of date",
    ),
    (
        &[Class::Appulse, Class::Elongation],
        "nearest: least apparent geocentric separation; greatest elongation: greatest one from the Sun",
    ),
    (
        &[Class::Eclipse],
        "eclipses: greatest where the axis of the shadow is nearest to the centre of the Moon or of the \
         Earth; magnitudes are parts of the diameter; radii and shadows of the canons of Espenak & Meeus",
    ),
    (
        &[
            Class::Rise,
            Class::Set,
            Class::Transit,
            Class::LowerTransit,
            Class::Twilight,
            Class::Eclipse,
        ],
        "azimuths, from north through east, and altitudes are airless and topocentric, on WGS84, \
         without polar motion",
    ),
    (
        &[],
        "times: UTC from 1972 on as far as it is announced, else UT1; dates before 1582-10-15 are \
         Julian, years astronomical (0 is 1 BCE)",
    ),
];

/// Stars of the first magnitude that the Moon and the planets pass, by number in the Bright Star
/// Catalogue: Aldebaran, Pollux, Regulus, Spica, Antares.
pub const ECLIPTIC_STARS_HR: [u16; 5] = [1457, 2990, 3982, 5056, 6134];

/// Why there are no events.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum AlmanacError {
    #[error("{0}")]
    Ephemeris(#[from] EphemerisError),
    #[error("{0}")]
    Time(#[from] TimeError),
    #[error("{0}")]
    Place(#[from] PlaceError),
    #[error("from {from} to {to} no time passes; give an end after the beginning")]
    Order { from: String, to: String },
    #[error("{class} of what? give a place to see it from, or ask for other events")]
    NoPlace { class: &'static str },
    #[error("a horizon at altitude {deg}° is outside {low}° to {high}°; give degrees above the level",
        low = limits::SKYLINE_RANGE_DEG.start(), high = limits::SKYLINE_RANGE_DEG.end())]
    Skyline { deg: f64 },
    #[error("the Sun at {deg}° is outside -90° to 0°; give the depth at which it is dark")]
    DarkLimit { deg: f64 },
}

/// Each of a list once, however often it was named.
fn once<T: Clone + PartialEq>(list: &[T]) -> Vec<T> {
    let mut known = Vec::new();
    for item in list {
        if !known.contains(item) {
            known.push(item.clone());
        }
    }
    known
}

impl From<EclipseError> for AlmanacError {
    fn from(error: EclipseError) -> AlmanacError {
        match error {
            EclipseError::Time(error) => error.into(),
            EclipseError::Ephemeris(error) => error.into(),
        }
    }
}

/// What an almanac is asked for.
#[derive(Debug, Clone)]
pub struct Request {
    pub classes: Vec<Class>,
    /// Who rises, sets, passes the meridian and meets others.
    pub bodies: Vec<Body>,
    /// Stars that rise, set and pass the meridian.
    pub stars: Vec<Target>,
    /// Stars that the Moon and planets may meet.
    pub met_stars: Vec<Target>,
    pub limits: Limits,
    /// Of nearest approaches, those closer than this.
    pub nearer_than: Angle,
    /// How well positions are asked to be known, if a theory knows them as well.
    pub tolerance: Tolerance,
}

impl Default for Request {
    /// Everything but lower transits and conjunctions in longitude, of all bodies.
    fn default() -> Request {
        let is_usual =
            |class: &Class| !matches!(class, Class::LowerTransit | Class::LongitudeConjunction);
        Request {
            classes: Class::ALL.into_iter().filter(is_usual).collect(),
            bodies: Body::ALL.to_vec(),
            stars: Vec::new(),
            met_stars: Vec::new(),
            limits: Limits::default(),
            nearer_than: Angle::from_deg(5.0),
            tolerance: Angle::from_arcsec(0.01),
        }
    }
}

/// Knows what happens in the sky of a place, or of everybody.
#[derive(Debug, Clone)]
pub struct Almanac {
    classes: Vec<Class>,
    place: Option<Place>,
    limits: Limits,
    theory: Theory,
    local: Option<LocalSearch>,
    geocentric: GeocentricSearch,
}

impl Almanac {
    /// Without a place, what everybody sees alone can be asked for.
    ///
    /// # Errors
    ///
    /// A class of events that needs a place where there is none; limits that cannot be.
    pub fn new(
        ephemeris: &Ephemeris,
        place: Option<&Place>,
        request: Request,
    ) -> Result<Almanac, AlmanacError> {
        let Request { classes, limits, nearer_than, tolerance, .. } = request;
        let bodies = once(&request.bodies);
        let [stars, met_stars] = [&request.stars, &request.met_stars].map(|stars| once(stars));
        let skyline_deg = limits.skyline.deg();
        if !limits::SKYLINE_RANGE_DEG.contains(&skyline_deg) {
            return Err(AlmanacError::Skyline { deg: skyline_deg });
        }
        let dark_deg = limits.dark_sun_altitude.deg();
        if !(-90.0..=0.0).contains(&dark_deg) {
            return Err(AlmanacError::DarkLimit { deg: dark_deg });
        }
        if let (None, Some(class)) = (place, classes.iter().find(|class| class.is_local())) {
            return Err(AlmanacError::NoPlace { class: class.name() });
        }
        let targets: Vec<Target> = bodies.iter().copied().map(Target::Body).chain(stars).collect();
        Ok(Almanac {
            theory: Theory::new(ephemeris, tolerance)?,
            local: place.map(|place| LocalSearch::new(place, limits, &classes, &targets)),
            geocentric: GeocentricSearch::new(&classes, &bodies, &met_stars, nearer_than),
            place: place.cloned(),
            classes,
            limits,
        })
    }

    /// What the words mean for the events that are asked for, a sentence each.
    pub fn definitions(&self) -> Vec<String> {
        let is_about =
            |classes: &[Class]| classes.is_empty() || classes.iter().any(|class| self.has(*class));
        let mut sentences: Vec<String> = DEFINITIONS
            .iter()
            .filter(|(classes, _)| is_about(classes))
            .map(|(_, sentence)| (*sentence).to_owned())
            .collect();
        if is_about(&[Class::Rise, Class::Set, Class::Dark]) {
            let skyline = self.limits.skyline;
            sentences.push(if skyline == Angle::ZERO {
                "horizon: that of the sea, at the height of the eye".to_owned()
            } else {
                format!(
                    "horizon: at an apparent altitude of {:.3} degrees all around, which takes the \
                     place of 0; refraction there by Bennett 1982, scaled to 34' at 0",
                    skyline.deg()
                )
            });
        }
        if self.has(Class::Dark) {
            let limit_deg = self.limits.dark_sun_altitude.deg();
            sentences.push(format!(
                "dark: the centre of the Sun is below {limit_deg} degrees, airless, and the Moon has set"
            ));
        }
        sentences
    }

    /// The events from one instant up to another, in order.
    ///
    /// # Errors
    ///
    /// An end that is not after the beginning, or a date that no theory serves.
    pub fn events(&self, from: &Instant, to: &Instant) -> Result<Events<'_>, AlmanacError> {
        Events::between(self, from, to)
    }

    /// Bound of the error of the direction to a body at an instant.
    ///
    /// # Errors
    ///
    /// A date that no theory serves.
    pub fn error_bound(&self, instant: &Instant, body: Body) -> Result<Angle, AlmanacError> {
        self.theory.error_bound(instant, body)
    }

    fn has(&self, class: Class) -> bool {
        self.classes.contains(&class)
    }

    fn theory(&self) -> &Theory {
        &self.theory
    }

    fn local(&self) -> Option<&LocalSearch> {
        self.local.as_ref()
    }

    /// Everything in a stretch of time but the dark, in any order.
    fn look_through(&self, stretch: &Stretch) -> Result<LocalFound, AlmanacError> {
        let mut found = match &self.local {
            Some(local) => local.run(&self.theory, stretch)?,
            None => LocalFound::default(),
        };
        found.events.extend(self.geocentric.run(&self.theory, stretch)?);
        if self.has(Class::Eclipse) {
            found.events.extend(shadows::run(&self.theory, self.place.as_ref(), stretch)?);
        }
        Ok(found)
    }
}

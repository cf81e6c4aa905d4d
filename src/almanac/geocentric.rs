//! What happens in the sky of everybody: phases, seasons, ends of orbits, meetings.
//!
//! *Theory.* Phases, seasons, conjunctions and oppositions are zeros of the sine of a difference of
//! apparent geocentric coordinates, times the cosines of the other coordinates: a component of a cross
//! product of two directions. Nearness and greatest elongation are extrema of the square of the chord
//! between two directions, which is smooth where they meet; ends of orbits are extrema of a distance.
//!
//! *How we differ.* Distances are geometric, between centres at one moment. The way of the light to
//! the Moon is not: while it travels the Earth moves on by 38 km, and the least way comes up to a
//! quarter of an hour from the least distance.

use glam::DVec2;

use crate::almanac::AlmanacError;
use crate::almanac::event::{Apsis, Class, Coordinate, Event, Quarter, Season, Side, Target, What};
use crate::almanac::span::{Found, Sought, Stretch, search};
use crate::almanac::theory::{FromEarth, Theory};
use crate::ephemeris::Body;
use crate::time::Instant;
use crate::units::{AU_KM, Angle, DAY_S};

/// Over a quarter of the Moon's round she is followed to 1e-11.
const SPAN_DAYS: f64 = 8.0;
/// Mean distance of the Moon, kilometres: only a scale.
const MOON_DISTANCE_KM: f64 = 384_400.0;
/// A last correction of an instant, which is milliseconds, is not believed where it is more: there a
/// planet stands still.
const CORRECTION_MAX_S: f64 = 60.0;

/// A function of time whose zeros or extrema are events. Numbers are indices of targets.
#[derive(Debug, Clone, Copy)]
enum Function {
    /// Longitude of the Moon from the Sun, its sine: new and full.
    Syzygy,
    /// Its cosine: the quarters.
    Quadrature,
    /// Sine of the longitude of the Sun.
    Equinox,
    Solstice,
    /// Distance of a body from the Earth, relative to its mean.
    Distance(Body),
    /// Sine of the difference of a coordinate.
    Line(usize, usize, Coordinate),
    /// Square of the chord between two directions: how near they come.
    Nearness(usize, usize),
    /// The same of a planet from the Sun: how far.
    Elongation(usize),
}

/// Looks at the sky from the centre of the Earth.
#[derive(Debug, Clone)]
pub struct GeocentricSearch {
    classes: Vec<Class>,
    /// The Sun, the Moon, then the others.
    targets: Vec<Target>,
    functions: Vec<Function>,
    nearer_than: Angle,
}

const SUN: usize = 0;
const MOON: usize = 1;
const FIRST_PLANET: usize = 2;

/// Classes that ask for more than the Sun and the Moon.
const MEETINGS: [Class; 5] = [
    Class::Conjunction,
    Class::LongitudeConjunction,
    Class::Opposition,
    Class::Elongation,
    Class::Appulse,
];

impl GeocentricSearch {
    /// `bodies` and `stars` are those whose meetings are asked for; stars meet bodies alone. Of
    /// nearest approaches those closer than `nearer_than` are noted.
    pub fn new(classes: &[Class], bodies: &[Body], stars: &[Target], nearer_than: Angle) -> Self {
        let mut search = GeocentricSearch {
            classes: classes.to_vec(),
            targets: vec![Target::Body(Body::Sun), Target::Body(Body::Moon)],
            functions: Vec::new(),
            nearer_than,
        };
        if search.has(Class::Phase) {
            search.functions.extend([Function::Syzygy, Function::Quadrature]);
        }
        if search.has(Class::Season) {
            search.functions.extend([Function::Equinox, Function::Solstice]);
        }
        if search.has(Class::Apsis) {
            search.functions.extend([Body::Sun, Body::Moon].map(Function::Distance));
        }
        if MEETINGS.iter().any(|class| search.has(*class)) {
            search.add_meetings(bodies, stars);
        }
        search
    }

    fn add_meetings(&mut self, bodies: &[Body], stars: &[Target]) {
        let is_planet = |body: &&Body| !matches!(body, Body::Sun | Body::Moon);
        self.targets.extend(bodies.iter().filter(is_planet).map(|body| Target::Body(*body)));
        let planets = FIRST_PLANET..self.targets.len();
        self.targets.extend_from_slice(stars);
        for planet in planets.clone() {
            if self.has(Class::Conjunction) || self.has(Class::Opposition) {
                self.functions.push(Function::Line(planet, SUN, Coordinate::EclipticLongitude));
            }
            if self.has(Class::Elongation) && is_inner(&self.targets[planet]) {
                self.functions.push(Function::Elongation(planet));
            }
        }
        let wanderers = if bodies.contains(&Body::Moon) { MOON } else { FIRST_PLANET }..planets.end;
        for first in wanderers {
            for second in first + 1..self.targets.len() {
                if self.has(Class::Conjunction) {
                    self.functions.push(Function::Line(first, second, Coordinate::RightAscension));
                }
                if self.has(Class::LongitudeConjunction) {
                    let line = Function::Line(first, second, Coordinate::EclipticLongitude);
                    self.functions.push(line);
                }
                if self.has(Class::Appulse) {
                    self.functions.push(Function::Nearness(first, second));
                }
            }
        }
    }

    fn has(&self, class: Class) -> bool {
        self.classes.contains(&class)
    }

    /// Everything between two instants.
    pub fn run(&self, theory: &Theory, stretch: &Stretch) -> Result<Vec<Event>, AlmanacError> {
        let sought: Vec<Sought> = self.functions.iter().map(Function::sought).collect();
        let sample = |instant: &Instant| {
            let seen = theory.seen_from_earth(instant, &self.targets)?;
            let value = |function: &Function| self.value(theory, *function, instant, &seen);
            self.functions.iter().map(value).collect()
        };
        let mut events = Vec::new();
        for found in search(stretch, SPAN_DAYS, &sought, sample)? {
            if let Some(event) = self.event(theory, &found)? {
                events.push(event);
            }
        }
        Ok(events)
    }

    fn value(
        &self,
        theory: &Theory,
        function: Function,
        instant: &Instant,
        seen: &[FromEarth],
    ) -> Result<f64, AlmanacError> {
        let (sun, moon) = (&seen[SUN], &seen[MOON]);
        let chord_squared = |first: usize, second: usize| {
            (seen[first].equatorial.vector() - seen[second].equatorial.vector()).length_squared()
        };
        Ok(match function {
            Function::Syzygy => turn(moon, sun, Coordinate::EclipticLongitude).y,
            Function::Quadrature => turn(moon, sun, Coordinate::EclipticLongitude).x,
            Function::Equinox => sun.longitude.sin(),
            Function::Solstice => sun.longitude.cos(),
            Function::Distance(Body::Moon) => {
                theory.distance_km(instant, Body::Moon)? / MOON_DISTANCE_KM
            }
            Function::Distance(body) => theory.distance_km(instant, body)? / AU_KM,
            Function::Line(first, second, coordinate) => {
                turn(&seen[first], &seen[second], coordinate).y
            }
            Function::Nearness(first, second) => chord_squared(first, second),
            Function::Elongation(planet) => chord_squared(planet, SUN),
        })
    }

    /// The event that was found, if it is one that was asked for.
    fn event(&self, theory: &Theory, found: &Found) -> Result<Option<Event>, AlmanacError> {
        let function = self.functions[found.function];
        let mut instant = found.instant;
        let seen = theory.seen_from_earth(&instant, &self.targets)?;
        if function.sought() == Sought::Zero {
            let value = self.value(theory, function, &instant, &seen)?;
            let correction_s = -value / found.slope_per_day * DAY_S;
            if correction_s.abs() < CORRECTION_MAX_S {
                instant = instant.plus_seconds(correction_s)?;
            }
        }
        let what = match (function, found.is_rising) {
            (Function::Syzygy, true) => What::MoonPhase(Quarter::New),
            (Function::Syzygy, false) => What::MoonPhase(Quarter::Full),
            (Function::Quadrature, false) => What::MoonPhase(Quarter::First),
            (Function::Quadrature, true) => What::MoonPhase(Quarter::Last),
            (Function::Equinox, true) => What::Season(Season::MarchEquinox),
            (Function::Equinox, false) => What::Season(Season::SeptemberEquinox),
            (Function::Solstice, false) => What::Season(Season::JuneSolstice),
            (Function::Solstice, true) => What::Season(Season::DecemberSolstice),
            (Function::Distance(body), is_least) => {
                let apsis = match (body, is_least) {
                    (Body::Moon, true) => Apsis::Perigee,
                    (Body::Moon, false) => Apsis::Apogee,
                    (_, true) => Apsis::Perihelion,
                    (_, false) => Apsis::Aphelion,
                };
                What::Apsis { apsis, distance_km: theory.distance_km(&instant, body)? }
            }
            (Function::Line(first, SUN, coordinate), _) => {
                match self.line_with_sun(first, coordinate, &seen) {
                    Some(what) => what,
                    None => return Ok(None),
                }
            }
            (Function::Line(first, second, coordinate), _) => {
                if turn(&seen[first], &seen[second], coordinate).x < 0.0 {
                    return Ok(None);
                }
                let offset = offset(&seen[first], &seen[second], coordinate);
                let of = [first, second].map(|index| self.targets[index].clone());
                What::Conjunction { of, coordinate, offset }
            }
            (Function::Nearness(first, second), true) => {
                let separation = seen[first].equatorial.separation(seen[second].equatorial);
                if separation > self.nearer_than {
                    return Ok(None);
                }
                let of = [first, second].map(|index| self.targets[index].clone());
                What::Appulse { of, separation }
            }
            (Function::Elongation(planet), false) => {
                let Target::Body(body) = self.targets[planet] else { return Ok(None) };
                let elongation = seen[planet].equatorial.separation(seen[SUN].equatorial);
                let is_east =
                    turn(&seen[planet], &seen[SUN], Coordinate::EclipticLongitude).y > 0.0;
                What::GreatestElongation { planet: body, elongation, is_east }
            }
            (Function::Nearness(..), false) | (Function::Elongation(_), true) => return Ok(None),
        };
        Ok(self.has(what.class()).then_some(Event { instant, what }))
    }

    /// A planet in line with the Sun, on her side or opposite.
    fn line_with_sun(
        &self,
        index: usize,
        coordinate: Coordinate,
        seen: &[FromEarth],
    ) -> Option<What> {
        let Target::Body(planet) = self.targets[index] else { return None };
        let (place, sun) = (&seen[index], &seen[SUN]);
        if turn(place, sun, coordinate).x < 0.0 {
            let separation = place.equatorial.separation(sun.equatorial);
            return Some(What::Opposition { planet, separation });
        }
        let side = match (is_inner(&self.targets[index]), place.distance_km < sun.distance_km) {
            (true, true) => Side::Inferior,
            (true, false) => Side::Superior,
            (false, _) => Side::Outer,
        };
        Some(What::SolarConjunction { planet, side, offset: offset(place, sun, coordinate) })
    }
}

impl Function {
    fn sought(&self) -> Sought {
        match self {
            Function::Distance(_) | Function::Nearness(..) | Function::Elongation(_) => {
                Sought::Extremum
            }
            _ => Sought::Zero,
        }
    }
}

/// Whether a target can come between the Earth and the Sun.
fn is_inner(target: &Target) -> bool {
    matches!(target, Target::Body(Body::Mercury | Body::Venus))
}

/// Cosine and sine of how far a coordinate of the first is ahead of the second's, both times the
/// cosines of the other coordinate.
fn turn(first: &FromEarth, second: &FromEarth, coordinate: Coordinate) -> DVec2 {
    let [first, second] = [first, second].map(|place| match coordinate {
        Coordinate::RightAscension => place.equatorial.vector().truncate(),
        Coordinate::EclipticLongitude => place.ecliptic.vector().truncate(),
    });
    DVec2::new(second.dot(first), second.perp_dot(first))
}

/// How far north of the second the first stands, along the other coordinate.
fn offset(first: &FromEarth, second: &FromEarth, coordinate: Coordinate) -> Angle {
    match coordinate {
        Coordinate::RightAscension => first.equatorial.latitude() - second.equatorial.latitude(),
        Coordinate::EclipticLongitude => first.ecliptic.latitude() - second.ecliptic.latitude(),
    }
}

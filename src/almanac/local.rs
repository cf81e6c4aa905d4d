//! What happens in the sky of a place: rise and set, passage of the meridian, twilight.
//!
//! *Theory.* The sine of an altitude and the eastward component of a direction are smooth functions
//! of time everywhere, at the poles and the zenith too. A body rises or sets where the sine of its
//! airless altitude passes that of the horizon; it is on the meridian where it passes from the
//! eastern half of the sky to the western (upper) or back (lower). Both are multiplied by the
//! topocentric distance, relative to the mean one, for the Moon: her parallax is then linear.

use crate::almanac::AlmanacError;
use crate::almanac::event::{Class, Edge, Event, Meridian, Target, Twilight, What};
use crate::almanac::limits::Limits;
use crate::almanac::span::{Found, Sought, Stretch, search};
use crate::almanac::theory::{FromPlace, Theory};
use crate::ephemeris::Body;
use crate::place::Place;
use crate::time::Instant;
use crate::units::{Angle, DAY_S};

/// Two turns of the sky: the polynomials follow them to 1e-11.
const SPAN_DAYS: f64 = 2.0;
/// Mean distance of the Moon, kilometres: only a scale.
const MOON_DISTANCE_KM: f64 = 384_400.0;
/// A last correction of an instant, which is microseconds, is not believed where it is more: the
/// body grazes the horizon there.
const CORRECTION_MAX_S: f64 = 1.0;

/// A function of time whose zeros are events.
#[derive(Debug, Clone, Copy)]
enum Function {
    /// Height over the horizon at which a target rises and sets.
    Horizon,
    Meridian,
    Twilight(Twilight),
    /// Height of the Sun over the limit of darkness.
    Darkness,
}

/// Looks at the sky of one place.
#[derive(Debug, Clone)]
pub struct LocalSearch {
    place: Place,
    limits: Limits,
    classes: Vec<Class>,
    targets: Vec<Target>,
    wanted: Vec<Wanted>,
}

/// A function of one target.
#[derive(Debug, Clone, Copy)]
struct Wanted {
    function: Function,
    /// Index of the target.
    target: usize,
    /// Whether its zeros are events; else they serve the dark alone.
    is_listed: bool,
}

/// What a place sees in a stretch of time.
#[derive(Debug, Default)]
pub struct LocalFound {
    pub events: Vec<Event>,
    /// For the dark: where the Sun passes its limit, or the Moon the horizon.
    pub switches: Vec<Switch>,
}

/// One of the two lights of the sky comes or goes.
#[derive(Debug, Clone, Copy)]
pub struct Switch {
    pub instant: Instant,
    pub light: Body,
    /// It is up from now on, by the limit that goes for it.
    pub is_up: bool,
}

impl LocalSearch {
    /// `targets` are those that are asked to rise, set and pass the meridian.
    pub fn new(place: &Place, limits: Limits, classes: &[Class], targets: &[Target]) -> Self {
        let has = |class: Class| classes.contains(&class);
        let mut search = LocalSearch {
            place: place.clone(),
            limits,
            classes: classes.to_vec(),
            targets: Vec::new(),
            wanted: Vec::new(),
        };
        for target in targets {
            if has(Class::Rise) || has(Class::Set) {
                search.want(Function::Horizon, target, true);
            }
            if has(Class::Transit) || has(Class::LowerTransit) {
                search.want(Function::Meridian, target, true);
            }
        }
        let [sun, moon] = [Body::Sun, Body::Moon].map(Target::Body);
        if has(Class::Twilight) {
            for twilight in Twilight::ALL {
                search.want(Function::Twilight(twilight), &sun, true);
            }
        }
        if has(Class::Dark) {
            search.want(Function::Darkness, &sun, false);
            let rises = has(Class::Rise) || has(Class::Set);
            if !(rises && targets.contains(&moon)) {
                search.want(Function::Horizon, &moon, false);
            }
        }
        search
    }

    fn want(&mut self, function: Function, target: &Target, is_listed: bool) {
        let known = self.targets.iter().position(|known| known == target);
        let target = known.unwrap_or_else(|| {
            self.targets.push(target.clone());
            self.targets.len() - 1
        });
        self.wanted.push(Wanted { function, target, is_listed });
    }

    fn has(&self, class: Class) -> bool {
        self.classes.contains(&class)
    }

    /// Everything between two instants.
    pub fn run(&self, theory: &Theory, stretch: &Stretch) -> Result<LocalFound, AlmanacError> {
        let sought = vec![Sought::Zero; self.wanted.len()];
        let sample = |instant: &Instant| {
            let seen = theory.seen_from_place(instant, &self.place, &self.targets)?;
            let value = |&Wanted { function, target, .. }: &Wanted| {
                self.value(function, &self.targets[target], &seen[target])
            };
            Ok(self.wanted.iter().map(value).collect())
        };
        let mut result = LocalFound::default();
        for found in search(stretch, SPAN_DAYS, &sought, sample)? {
            self.note(theory, &found, &mut result)?;
        }
        Ok(result)
    }

    /// Whether a light of the sky is up at an instant, by the limits of the dark.
    pub fn is_up(
        &self,
        theory: &Theory,
        instant: &Instant,
        light: Body,
    ) -> Result<bool, AlmanacError> {
        let function = if light == Body::Sun { Function::Darkness } else { Function::Horizon };
        let target = Target::Body(light);
        let seen = theory.seen_from_place(instant, &self.place, std::slice::from_ref(&target))?;
        Ok(self.value(function, &target, &seen[0]) >= 0.0)
    }

    fn value(&self, function: Function, target: &Target, seen: &FromPlace) -> f64 {
        let [east, _, up] = seen.dir.vector().to_array();
        let scale = match target {
            Target::Body(Body::Moon) => seen.distance_km / MOON_DISTANCE_KM,
            _ => 1.0,
        };
        let above = |altitude: Angle| up - altitude.sin();
        scale
            * match function {
                Function::Horizon => above(self.limits.altitude(target, seen.distance_km)),
                Function::Meridian => -east,
                Function::Twilight(twilight) => above(twilight.sun_altitude()),
                Function::Darkness => above(self.limits.dark_sun_altitude),
            }
    }

    /// Makes events and switches of what was found.
    fn note(
        &self,
        theory: &Theory,
        found: &Found,
        result: &mut LocalFound,
    ) -> Result<(), AlmanacError> {
        let Wanted { function, target, is_listed } = self.wanted[found.function];
        let target = &self.targets[target];
        let seen =
            theory.seen_from_place(&found.instant, &self.place, std::slice::from_ref(target))?[0];
        let correction_s = -self.value(function, target, &seen) / found.slope_per_day * DAY_S;
        let instant = if correction_s.abs() < CORRECTION_MAX_S {
            found.instant.plus_seconds(correction_s)?
        } else {
            found.instant
        };
        let is_up = found.is_rising;
        let light = match (function, target) {
            (Function::Darkness, _) => Some(Body::Sun),
            (Function::Horizon, Target::Body(Body::Moon)) => Some(Body::Moon),
            _ => None,
        };
        if let Some(light) = light.filter(|_| self.has(Class::Dark)) {
            result.switches.push(Switch { instant, light, is_up });
        }
        let (azimuth, altitude) = (seen.dir.azimuth(), seen.dir.altitude());
        let target = target.clone();
        let what = match function {
            Function::Horizon if is_up => What::Rise { target, azimuth },
            Function::Horizon => What::Set { target, azimuth },
            Function::Meridian => {
                let meridian = if is_up { Meridian::Upper } else { Meridian::Lower };
                What::Transit { target, meridian, azimuth, altitude }
            }
            Function::Twilight(twilight) => {
                let edge = if is_up { Edge::Dawn } else { Edge::Dusk };
                What::Twilight { twilight, edge, azimuth }
            }
            Function::Darkness => return Ok(()),
        };
        if is_listed && self.has(what.class()) {
            result.events.push(Event { instant, what });
        }
        Ok(())
    }
}

//! Jumps in time: the next event of a kind, or the one before, looked for beside the window.

use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::sync::{Arc, OnceLock};
use std::thread;

use crate::almanac::eclipse::{
    LocalMoment, LunarEclipse, LunarKind, SolarEclipse, SolarKind, lunar_eclipses, solar_eclipses,
};
use crate::almanac::{Almanac, Class, Event, Meridian, Quarter, Request, Target, What};
use crate::app::action::Jump;
use crate::background::Interrupt;
use crate::catalog::Catalogs;
use crate::ephemeris::{Body, Ephemeris};
use crate::frame::{Apparent, Dir};
use crate::place::Place;
use crate::sky::{self, SkyState};
use crate::time::{CivilDateTime, Instant};
use crate::units::{Angle, DAY_S};

/// Directions this good: 0.2 s in the phases of the Moon.
const TOLERANCE: Angle = Angle::from_arcsec(0.1);
/// What happens so near to the beginning has just been jumped to.
const MARGIN_S: f64 = 1.0;
/// The first length of time that is looked through, days, and how much longer the next is.
const FIRST_DAYS: f64 = 2.0;
const GROWTH: f64 = 4.0;
/// What does not happen within so many days is not looked for longer: daily events in a year, others in
/// a century.
const LONGEST_DAILY_DAYS: f64 = 400.0;
const LONGEST_DAYS: f64 = 36_525.0;
/// Where the Sun rises, the eye sees it: half the disc and the refraction of the horizon.
const LOWEST_SEEN: Angle = Angle::from_deg(-1.0);

/// What is looked for, and from where.
#[derive(Debug, Clone)]
pub struct Search {
    pub jump: Jump,
    /// Back in time.
    pub is_back: bool,
    pub from: Instant,
    pub place: Place,
    pub selected: Option<sky::Target>,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    pub instant: Instant,
    /// `Full Moon 2026-12-24 01:28 UTC`.
    pub words: String,
    /// Where it is seen, if it is above the horizon.
    pub towards: Option<Dir<Apparent>>,
}

/// The tables that jumps are looked up in, read at the first.
type Tables = Arc<OnceLock<Result<Ephemeris, String>>>;

/// The jump that is under way.
#[derive(Default)]
pub struct Jumps {
    tables: Tables,
    under_way: Option<(Interrupt, Receiver<Result<Found, String>>)>,
}

impl Drop for Jumps {
    fn drop(&mut self) {
        self.give_up();
    }
}

impl Jumps {
    /// Starts one; another that is under way is given up. `wake` is called when it has ended.
    pub fn begin(&mut self, search: Search, catalogs: Catalogs, wake: impl Fn() + Send + 'static) {
        self.give_up();
        let (tell, told) = mpsc::channel();
        let interrupt = Interrupt::default();
        self.under_way = Some((interrupt.clone(), told));
        let tables = Arc::clone(&self.tables);
        thread::spawn(move || {
            let load = || Ephemeris::load(&catalogs, TOLERANCE).map_err(|error| error.to_string());
            let found = match tables.get_or_init(load) {
                Ok(ephemeris) => find(&search, ephemeris, &catalogs, &interrupt),
                Err(words) => Err(words.clone()),
            };
            // Nobody may listen any more.
            tell.send(found).ok();
            wake();
        });
    }

    pub fn is_under_way(&self) -> bool {
        self.under_way.is_some()
    }

    fn give_up(&mut self) {
        if let Some((interrupt, _)) = self.under_way.take() {
            interrupt.raise();
        }
    }

    /// What the jump has found, once.
    pub fn take(&mut self) -> Option<Result<Found, String>> {
        let (_, told) = self.under_way.as_ref()?;
        let found = match told.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Ok(found) => found,
            Err(TryRecvError::Disconnected) => {
                Err("The search for the event broke off; try another jump.".to_owned())
            }
        };
        self.under_way = None;
        Some(found)
    }
}

impl Jump {
    /// `sunset`, `lunar eclipse`.
    pub fn name(self) -> &'static str {
        match self {
            Jump::Sunrise => "sunrise",
            Jump::Sunset => "sunset",
            Jump::Moonrise => "moonrise",
            Jump::Moonset => "moonset",
            Jump::NewMoon => "new Moon",
            Jump::FullMoon => "full Moon",
            Jump::SolarEclipse => "solar eclipse",
            Jump::LunarEclipse => "lunar eclipse",
            Jump::SolarEclipseHere => "solar eclipse seen from here",
            Jump::LunarEclipseHere => "lunar eclipse seen from here",
            Jump::Rise => "rise",
            Jump::Transit => "transit",
            Jump::Set => "set",
        }
    }

    /// Under which class the almanac has it; none for eclipses, which have their own search.
    fn class(self) -> Option<Class> {
        match self {
            Jump::Sunrise | Jump::Moonrise | Jump::Rise => Some(Class::Rise),
            Jump::Sunset | Jump::Moonset | Jump::Set => Some(Class::Set),
            Jump::Transit => Some(Class::Transit),
            Jump::NewMoon | Jump::FullMoon => Some(Class::Phase),
            _ => None,
        }
    }

    fn is_it(self, what: &What) -> bool {
        match self {
            Jump::NewMoon => *what == What::MoonPhase(Quarter::New),
            Jump::FullMoon => *what == What::MoonPhase(Quarter::Full),
            Jump::Transit => matches!(what, What::Transit { meridian: Meridian::Upper, .. }),
            _ => true,
        }
    }
}

/// Looks for an event. The error is a sentence.
pub fn find(
    search: &Search,
    ephemeris: &Ephemeris,
    catalogs: &Catalogs,
    interrupt: &Interrupt,
) -> Result<Found, String> {
    match search.jump.class() {
        Some(class) => {
            let target = target(search, catalogs)?;
            let (event, longest_days) = (
                Kind::Almanac(class, target.clone()),
                match class {
                    Class::Phase => LONGEST_DAYS,
                    _ => LONGEST_DAILY_DAYS,
                },
            );
            look_through(search, ephemeris, &event, longest_days, interrupt)
        }
        None => look_through(search, ephemeris, &Kind::Eclipse, LONGEST_DAYS, interrupt),
    }
}

enum Kind {
    Almanac(Class, Target),
    Eclipse,
}

/// Whom the event happens to.
fn target(search: &Search, catalogs: &Catalogs) -> Result<Target, String> {
    let body = |body| Ok(Target::Body(body));
    match search.jump {
        Jump::Sunrise | Jump::Sunset => return body(Body::Sun),
        Jump::Moonrise | Jump::Moonset | Jump::NewMoon | Jump::FullMoon => return body(Body::Moon),
        _ => {}
    }
    match &search.selected {
        Some(sky::Target::Body(which)) => body(*which),
        Some(sky::Target::Satellite(_)) => body(Body::Jupiter),
        Some(sky::Target::MoonFeature(_)) => body(Body::Moon),
        Some(sky::Target::Star { hr }) => {
            let stars = catalogs.stars().map_err(|error| error.to_string())?;
            let star = stars.into_iter().find(|star| star.hr == *hr);
            let star = star.ok_or_else(|| format!("There is no star HR {hr}; select another."))?;
            Ok(Target::Star(Arc::new(star)))
        }
        Some(_) => Err("Rise, transit and set are known of the Sun, the Moon, planets and stars; \
                        select one of those."
            .to_owned()),
        None => Err("Nothing is selected; click something in the sky first.".to_owned()),
    }
}

/// Goes through growing lengths of time until something is found.
fn look_through(
    search: &Search,
    ephemeris: &Ephemeris,
    kind: &Kind,
    longest_days: f64,
    interrupt: &Interrupt,
) -> Result<Found, String> {
    let sign = if search.is_back { -1.0 } else { 1.0 };
    let mut near = search.from.plus_seconds(sign * MARGIN_S).unwrap_or(search.from);
    let (mut span_days, mut done_days) = (FIRST_DAYS, 0.0);
    while done_days < longest_days && !interrupt.is_raised() {
        let end = last_instant(search.is_back);
        let far = near.plus_seconds(sign * span_days * DAY_S);
        let (far, is_end) = far.map_or((end, true), |far| (far, false));
        let (from, to) = if search.is_back { (far, near) } else { (near, far) };
        if to.tt - from.tt <= 0.0 {
            break;
        }
        let found = match kind {
            Kind::Almanac(class, target) => happens(search, ephemeris, *class, target, from, to)?,
            Kind::Eclipse => darkens(search, ephemeris, from, to)?,
        };
        if let Some(found) = found {
            return Ok(found);
        }
        if is_end {
            break;
        }
        near = far;
        done_days += span_days;
        span_days *= GROWTH;
    }
    Err(nothing(search, longest_days))
}

fn nothing(search: &Search, longest_days: f64) -> String {
    let name = search.jump.name();
    let whose = match (&search.jump, &search.selected) {
        (Jump::Rise | Jump::Transit | Jump::Set, Some(target)) => format!("{name} of {target}"),
        _ => name.to_owned(),
    };
    let while_ = if longest_days > LONGEST_DAILY_DAYS { "a century" } else { "a year" };
    let when = if search.is_back { "before" } else { "after" };
    let instant = minute(&search.from);
    format!("There is no {whose} within {while_} {when} {instant}; try another date or place.")
}

/// The beginning or the end of the dates that are known.
fn last_instant(is_first: bool) -> Instant {
    let civil = match is_first {
        true => CivilDateTime { year: -4000, month: 1, day: 1, hour: 0, minute: 0, second: 1.0 },
        false => {
            CivilDateTime { year: 4000, month: 12, day: 31, hour: 23, minute: 59, second: 58.0 }
        }
    };
    Instant::from_civil_utc(&civil).expect("the calendar has its ends")
}

/// The first, or last, event of the almanac between two instants.
fn happens(
    search: &Search,
    ephemeris: &Ephemeris,
    class: Class,
    target: &Target,
    from: Instant,
    to: Instant,
) -> Result<Option<Found>, String> {
    let (bodies, stars) = match target {
        Target::Body(body) => (vec![*body], Vec::new()),
        Target::Star(_) => (Vec::new(), vec![target.clone()]),
    };
    let request =
        Request { classes: vec![class], bodies, stars, tolerance: TOLERANCE, ..Request::default() };
    let words = |error: &dyn std::fmt::Display| error.to_string();
    let almanac =
        Almanac::new(ephemeris, Some(&search.place), request).map_err(|error| words(&error))?;
    let events = almanac.events(&from, &to).map_err(|error| words(&error))?;
    let mut last = None;
    for event in events {
        let event = event.map_err(|error| words(&error))?;
        if search.jump.is_it(&event.what) {
            last = Some(event);
            if !search.is_back {
                break;
            }
        }
    }
    last.map(|event| told(search, ephemeris, &event)).transpose()
}

fn told(search: &Search, ephemeris: &Ephemeris, event: &Event) -> Result<Found, String> {
    let what = match search.jump {
        Jump::Sunrise => "Sunrise".to_owned(),
        Jump::Sunset => "Sunset".to_owned(),
        Jump::Moonrise => "Moonrise".to_owned(),
        Jump::Moonset => "Moonset".to_owned(),
        _ => event.what.to_string(),
    };
    let towards = match (&event.what, event.what.azimuth()) {
        // At the horizon, where refraction has lifted it.
        (What::Rise { .. } | What::Set { .. }, Some(azimuth)) => {
            Some(Dir::from_azimuth_altitude(azimuth, Angle::ZERO))
        }
        (_, Some(azimuth)) => {
            let altitude = event.what.altitude().unwrap_or(Angle::ZERO);
            seen(azimuth, altitude)
        }
        _ => {
            let state = SkyState::at(ephemeris, &event.instant, &search.place, TOLERANCE)
                .map_err(|error| error.to_string())?;
            let moon = state.moon.state.dir;
            seen(moon.azimuth(), moon.altitude())
        }
    };
    let words = format!("{what} {}", minute(&event.instant));
    Ok(Found { instant: event.instant, words, towards })
}

/// The first, or last, eclipse between two instants.
fn darkens(
    search: &Search,
    ephemeris: &Ephemeris,
    from: Instant,
    to: Instant,
) -> Result<Option<Found>, String> {
    let mut last = None;
    let mut take = |found: Option<Found>| {
        // One seen from here may be at its best before or after its greatest.
        let is_within = |found: &Found| from.tt <= found.instant.tt && found.instant.tt < to.tt;
        last = found.filter(is_within).or(last.take());
        last.is_some() && !search.is_back
    };
    // What is seen from here is not far from the greatest.
    let reach_s = DAY_S / 2.0;
    let wide_from = from.plus_seconds(-reach_s).unwrap_or(from);
    let wide_to = to.plus_seconds(reach_s).unwrap_or(to);
    match search.jump {
        Jump::LunarEclipse | Jump::LunarEclipseHere => {
            for eclipse in lunar_eclipses(ephemeris, wide_from, wide_to, TOLERANCE) {
                let eclipse = eclipse.map_err(|error| error.to_string())?;
                if take(lunar(search, &eclipse)?) {
                    break;
                }
            }
        }
        _ => {
            for eclipse in solar_eclipses(ephemeris, wide_from, wide_to, TOLERANCE) {
                let eclipse = eclipse.map_err(|error| error.to_string())?;
                if take(solar(search, &eclipse)?) {
                    break;
                }
            }
        }
    }
    Ok(last)
}

/// The greatest moment of an eclipse of the Moon; for those that are seen from here the seen moment
/// nearest to it, of those that reach the umbra.
fn lunar(search: &Search, eclipse: &LunarEclipse) -> Result<Option<Found>, String> {
    let local = eclipse.at(&search.place).map_err(|error| error.to_string())?;
    let kind = match eclipse.kind {
        LunarKind::Penumbral => "Penumbral",
        LunarKind::Partial => "Partial",
        LunarKind::Total => "Total",
    };
    let moment = if search.jump == Jump::LunarEclipse || local.greatest.is_up() {
        local.greatest
    } else {
        let umbral = local.contacts.partial.into_iter().chain(local.contacts.total).flatten();
        let away = |moment: &LocalMoment| (moment.instant.tt - eclipse.greatest.tt).abs();
        let nearest = umbral
            .filter(LocalMoment::is_up)
            .min_by(|one, other| away(one).total_cmp(&away(other)));
        let Some(nearest) = nearest else { return Ok(None) };
        nearest
    };
    if search.jump == Jump::LunarEclipseHere && eclipse.kind == LunarKind::Penumbral {
        return Ok(None);
    }
    let words = format!("{kind} eclipse of the Moon {}", minute(&moment.instant));
    Ok(Some(Found { instant: moment.instant, words, towards: towards(&moment) }))
}

/// The greatest moment of an eclipse of the Sun; for those that are seen from here, the most of it here.
fn solar(search: &Search, eclipse: &SolarEclipse) -> Result<Option<Found>, String> {
    let local = eclipse.at(&search.place).map_err(|error| error.to_string())?;
    let here = local.as_ref().and_then(|local| local.seen.as_ref());
    let kind = match eclipse.kind {
        SolarKind::Partial => "Partial",
        SolarKind::Annular => "Annular",
        SolarKind::Total => "Total",
        SolarKind::Hybrid => "Hybrid",
    };
    match (search.jump, here) {
        (Jump::SolarEclipseHere, None) => Ok(None),
        (Jump::SolarEclipseHere, Some(here)) => {
            let instant = here.moment.instant;
            let part = here.obscuration * 100.0;
            let words =
                format!("Eclipse of the Sun {}, {part:.0} % covered here", minute(&instant));
            Ok(Some(Found { instant, words, towards: towards(&here.moment) }))
        }
        _ => {
            let instant = eclipse.greatest;
            let words = format!("{kind} eclipse of the Sun {}", minute(&instant));
            let towards = here.and_then(|here| towards(&here.moment));
            Ok(Some(Found { instant, words, towards }))
        }
    }
}

fn towards(moment: &LocalMoment) -> Option<Dir<Apparent>> {
    moment.is_up().then(|| seen(moment.azimuth, moment.altitude)).flatten()
}

/// A direction, if something there is above the horizon.
fn seen(azimuth: Angle, altitude: Angle) -> Option<Dir<Apparent>> {
    (altitude > LOWEST_SEEN).then(|| Dir::from_azimuth_altitude(azimuth, altitude))
}

/// `2026-12-24 01:28 UTC`, rounded to the minute.
fn minute(instant: &Instant) -> String {
    let rounded = instant.plus_seconds(30.0).unwrap_or(*instant);
    let CivilDateTime { year, month, day, hour, minute, .. } = rounded.utc_civil();
    let places = if year < 0 { 5 } else { 4 };
    format!("{year:0places$}-{month:02}-{day:02} {hour:02}:{minute:02} UTC")
}

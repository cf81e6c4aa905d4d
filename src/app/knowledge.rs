//! What takes longer than a frame to know: when something rises and sets, and how bright the sky is.
//! Each is found out beside the window, once, and is not there until then.

use std::cell::RefCell;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::almanac::{Almanac, Class, Meridian, Request, Target as Riser, What};
use crate::background::Background;
use crate::catalog::{Catalogs, Star, messier};
use crate::ephemeris::{Body, Ephemeris};
use crate::frame::{Apparent, Dir, Icrs};
use crate::light::night::Night;
use crate::light::night_lights::NightGlow;
use crate::place::Place;
use crate::plan::brightness::{MeasuredSky, SkyBrightness};
use crate::plan::lay::Kept;
use crate::scene::Layers;
use crate::sky::Target;
use crate::store::Store;
use crate::time::{self, Instant, Written};
use crate::units::{Angle, DAY_S, Magnitude};

use super::pointing;

/// Directions are asked to be so good: rise and set to the second.
const TOLERANCE: Angle = Angle::from_arcsec(2.0);
/// A target that rises once a day does so within this time from any moment, seconds.
const A_DAY_AND_MORE_S: f64 = 1.1 * DAY_S;
/// Within so many seconds of the sky it is as bright as it was.
const SAME_LIGHT_S: f64 = 60.0;

/// What happens to something above a horizon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Daily {
    Rise,
    Transit,
    Set,
}

impl Daily {
    pub const ALL: [Daily; 3] = [Daily::Rise, Daily::Transit, Daily::Set];

    pub fn name(self) -> &'static str {
        match self {
            Daily::Rise => "Rise",
            Daily::Transit => "Transit",
            Daily::Set => "Set",
        }
    }
}

/// Something that happens at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DailyEvent {
    pub what: Daily,
    pub instant: Instant,
    /// Airless: at rise and set the azimuth, at transit the altitude.
    pub at: Angle,
}

/// A day of a target at a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Day {
    /// From midnight to midnight, by the clocks of the place.
    pub from: Instant,
    pub to: Instant,
    /// Those of the day and of the next, in order.
    pub events: Vec<DailyEvent>,
}

impl Day {
    /// What happens on the day itself; some things twice, some not at all.
    pub fn today(&self, what: Daily) -> impl Iterator<Item = &DailyEvent> {
        let end = self.to.tt.jd();
        self.events.iter().filter(move |event| event.what == what && event.instant.tt.jd() < end)
    }

    /// The next after an instant of the day.
    pub fn next(&self, what: Daily, after: &Instant) -> Option<&DailyEvent> {
        let after = after.tt.jd();
        self.events.iter().find(|event| event.what == what && event.instant.tt.jd() > after)
    }
}

#[derive(Clone)]
struct DayAsked {
    from: Instant,
    to: Instant,
    place: Place,
    target: Target,
    riser: Riser,
}

impl DayAsked {
    fn is_about(&self, from: &Instant, place: &Place, target: &Target) -> bool {
        (&self.from, &self.place, &self.target) == (from, place, target)
    }
}

impl PartialEq for DayAsked {
    fn eq(&self, other: &DayAsked) -> bool {
        self.is_about(&other.from, &other.place, &other.target)
    }
}

/// Knows when what rises and sets.
pub struct Days {
    catalogs: Catalogs,
    background: OnceLock<Background<DayAsked, Result<Day, String>>>,
}

impl Days {
    pub fn new(catalogs: Catalogs) -> Days {
        Days { catalogs, background: OnceLock::new() }
    }

    /// The day of a target that an instant belongs to, in the sky of a night; none while it is being
    /// found out, an error in words where there is no such day.
    pub fn of(&self, target: &Target, night: &Night) -> Option<Result<Day, String>> {
        let place = &night.sky.place;
        let (from, to) = match day_around(&night.sky.instant, place) {
            Ok(day) => day,
            Err(error) => return Some(Err(error.to_string())),
        };
        let background = self.background.get_or_init(|| {
            let catalogs = self.catalogs.clone();
            let ephemeris: RefCell<Option<Ephemeris>> = RefCell::new(None);
            Background::new(move |asked: &DayAsked, _| {
                Some(look_up(asked, &catalogs, &mut ephemeris.borrow_mut()))
            })
        });
        if let Some(answer) = background.latest()
            && answer.0.is_about(&from, place, target)
        {
            return Some(answer.1.clone());
        }
        if !background.is_working() {
            let riser = riser(target, night)?;
            let (place, target) = (place.clone(), target.clone());
            background.ask(DayAsked { from, to, place, target, riser });
        }
        None
    }
}

/// Who rises when the target does; a place on the Moon rises with the Moon.
fn riser(target: &Target, night: &Night) -> Option<Riser> {
    match target {
        Target::Body(body) => Some(Riser::Body(*body)),
        Target::Satellite(_) => Some(Riser::Body(Body::Jupiter)),
        Target::MoonFeature(_) => Some(Riser::Body(Body::Moon)),
        Target::Star { hr } => {
            let star = night.stars[pointing::star(*hr, night)?].clone();
            Some(Riser::Star(Arc::new(star)))
        }
        Target::Constellation(id) => Some(fixed(*id.get().labels.first()?)),
        Target::Messier(number) => Some(fixed(messier(*number)?.dir_j2000)),
    }
}

/// Something far that stands among the stars.
fn fixed(dir_j2000: Dir<Icrs>) -> Riser {
    Riser::Star(Arc::new(Star {
        hr: 0,
        hip: None,
        hd: None,
        designation: None,
        flamsteed: None,
        name: None,
        dir_j2000,
        proper_motion_ra_arcsec_yr: 0.0,
        proper_motion_dec_arcsec_yr: 0.0,
        parallax_arcsec: 0.0,
        radial_velocity_km_s: 0.0,
        magnitude: Magnitude(0.0),
        b_v: 0.0,
        spectral_type: String::new(),
        variable: None,
        companion: None,
    }))
}

/// The day by the clocks of a place; where none are known by mean solar time, to the full minute.
fn day_around(instant: &Instant, place: &Place) -> Result<(Instant, Instant), time::TimeError> {
    let Some(zone) = place.time_zone else {
        let ahead_s = (place.longitude.hours() * 60.0).round() * 60.0;
        let since_s = (instant.utc_civil().second_of_day() + ahead_s).rem_euclid(DAY_S);
        let from = whole_seconds(&instant.plus_seconds(-since_s)?)?;
        return Ok((from, from.plus_seconds(DAY_S)?));
    };
    let midnight = |at: &Instant| {
        let mut civil = at.to_local(zone).civil;
        (civil.hour, civil.minute, civil.second) = (0, 0, 0.0);
        // Some clocks jump over midnight.
        time::to_instant(&Written { civil, offset_s: None }, Some(zone)).or_else(|_| {
            civil.hour = 1;
            time::to_instant(&Written { civil, offset_s: None }, Some(zone))
        })
    };
    let from = midnight(instant)?;
    // The longest day of any clock has 25 hours, the shortest 23.
    let to = midnight(&from.plus_seconds(1.25 * DAY_S)?)?;
    Ok((from, to))
}

/// The same day has the same beginning, however it was come by.
fn whole_seconds(instant: &Instant) -> Result<Instant, time::TimeError> {
    let mut civil = instant.utc_civil();
    let rounded = (civil.second / 60.0).round();
    civil.second = 0.0;
    Instant::from_civil_utc(&civil)?.plus_seconds(60.0 * rounded)
}

fn look_up(
    asked: &DayAsked,
    catalogs: &Catalogs,
    ephemeris: &mut Option<Ephemeris>,
) -> Result<Day, String> {
    let words = |error: &dyn std::error::Error| error.to_string();
    let ephemeris = match ephemeris {
        Some(known) => known,
        None => ephemeris.insert(Ephemeris::load(catalogs, TOLERANCE).map_err(|e| words(&e))?),
    };
    let (bodies, stars) = match asked.riser.clone() {
        Riser::Body(body) => (vec![body], Vec::new()),
        star => (Vec::new(), vec![star]),
    };
    let request = Request {
        classes: vec![Class::Rise, Class::Set, Class::Transit],
        bodies,
        stars,
        tolerance: TOLERANCE,
        ..Request::default()
    };
    let almanac = Almanac::new(ephemeris, Some(&asked.place), request).map_err(|e| words(&e))?;
    let until = asked.to.plus_seconds(A_DAY_AND_MORE_S).map_err(|e| words(&e))?;
    let mut events = Vec::new();
    for event in almanac.events(&asked.from, &until).map_err(|e| words(&e))? {
        let event = event.map_err(|e| words(&e))?;
        let (what, at) = match event.what {
            What::Rise { azimuth, .. } => (Daily::Rise, azimuth),
            What::Set { azimuth, .. } => (Daily::Set, azimuth),
            What::Transit { meridian: Meridian::Upper, altitude, .. } => (Daily::Transit, altitude),
            _ => continue,
        };
        events.push(DailyEvent { what, instant: event.instant, at });
    }
    Ok(Day { from: asked.from, to: asked.to, events })
}

/// A sky to be measured in a direction.
#[derive(Clone)]
struct LightAsked {
    night: Arc<Night>,
    glow: NightGlow,
    layers: Layers,
    dir: Dir<Apparent>,
}

impl LightAsked {
    /// Whether it is as bright there as here.
    fn is_like(&self, other: &LightAsked) -> bool {
        let (sky, others) = (&self.night.sky, &other.night.sky);
        let passed_s = (sky.instant.tt.jd() - others.instant.tt.jd()).abs() * DAY_S;
        passed_s < SAME_LIGHT_S
            && sky.place == others.place
            && self.night.air == other.night.air
            && (&self.glow, &self.layers, self.dir) == (&other.glow, &other.layers, other.dir)
    }
}

impl PartialEq for LightAsked {
    fn eq(&self, other: &LightAsked) -> bool {
        Arc::ptr_eq(&self.night, &other.night) && self.is_like(other)
    }
}

/// Measures the sky.
pub struct LightMeter {
    catalogs: Catalogs,
    background: OnceLock<Background<LightAsked, Result<SkyBrightness, String>>>,
    /// What was wished for last: it is not wished for again for every picture.
    asked: Mutex<Option<LightAsked>>,
}

impl LightMeter {
    pub fn new(catalogs: Catalogs) -> LightMeter {
        LightMeter { catalogs, background: OnceLock::new(), asked: Mutex::new(None) }
    }

    /// How bright the sky of a night is in a direction; none while it is being measured, in words why it
    /// cannot be. As it was a minute ago is good enough.
    pub fn measure(
        &self,
        night: &Arc<Night>,
        glow: &NightGlow,
        layers: &Layers,
        dir: Dir<Apparent>,
    ) -> Option<Result<SkyBrightness, String>> {
        let wish =
            LightAsked { night: Arc::clone(night), glow: *glow, layers: layers.clone(), dir };
        let background = self.background.get_or_init(|| {
            let catalogs = self.catalogs.clone();
            let kept = RefCell::new(Kept::new(Store::of_user()));
            Background::new(move |asked: &LightAsked, _| {
                let LightAsked { night, glow, layers, dir } = asked;
                let mut kept = kept.borrow_mut();
                let sky = MeasuredSky::of(night, glow, layers, &catalogs, &mut kept);
                let seen = sky.and_then(|sky| sky.at(*dir, &mut kept));
                Some(seen.map_err(|error| error.to_string()))
            })
        });
        let answer = background.latest().filter(|answer| answer.0.dir == dir);
        let is_fresh = answer.as_ref().is_some_and(|answer| answer.0.is_like(&wish));
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        let is_asked = asked.as_ref().is_some_and(|asked| asked.is_like(&wish));
        let is_awaited = is_asked && answer.is_none();
        if !(is_fresh || is_awaited || background.is_working()) {
            background.ask(wish.clone());
            *asked = Some(wish);
        }
        answer.map(|answer| answer.1.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str) -> Instant {
        time::to_instant(&time::parse(text).unwrap(), None).unwrap()
    }

    #[test]
    fn days_are_those_of_the_clocks() {
        let mut place = Place::new(39.7, -105.0, 1600.0).unwrap();
        place.time_zone = Some("America/Denver".parse().unwrap());
        let day = |text: &str| {
            let (from, to) = day_around(&at(text), &place).unwrap();
            (from.to_string(), to.to_string())
        };
        let same = ("2026-08-13T06:00:00Z".to_owned(), "2026-08-14T06:00:00Z".to_owned());
        assert_eq!(day("2026-08-13T06:00Z"), same);
        assert_eq!(day("2026-08-14T05:59:59.9Z"), same);
        // Clocks go forwards, then back.
        assert_eq!(day("2026-03-08T20:00Z").1, "2026-03-09T06:00:00Z");
        assert_eq!(day("2026-03-08T20:00Z").0, "2026-03-08T07:00:00Z");
        assert_eq!(day("2026-11-01T20:00Z").1, "2026-11-02T07:00:00Z");
    }

    #[test]
    fn without_clocks_the_mean_sun_tells_the_day() {
        let place = Place::new(10.0, 30.0, 0.0).unwrap();
        for text in ["2026-08-12T22:00:00Z", "2026-08-13T12:34:56.789Z", "2026-08-13T21:59:59Z"] {
            let (from, to) = day_around(&at(text), &place).unwrap();
            assert_eq!(from.to_string(), "2026-08-12T22:00:00Z", "{text}");
            assert_eq!(to.to_string(), "2026-08-13T22:00:00Z", "{text}");
        }
    }
}

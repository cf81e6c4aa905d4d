//! What the tests of the almanac share: tables, and how far an event may be from them.

use std::collections::BTreeMap;

use nocturne::almanac::{Almanac, Event, Request, Target};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris, Observation};
use nocturne::frame::Dir;
use nocturne::place::Place;
use nocturne::time::{Instant, JulianDate};
use nocturne::units::{Angle, DAY_S};

/// As well as positions are known.
pub const TOLERANCE: Angle = Angle::from_arcsec(0.002);

/// With the tables that are shipped.
pub fn ephemeris() -> Ephemeris {
    let catalogs = Catalogs::locate(None).expect("the catalogues");
    Ephemeris::load(&catalogs, TOLERANCE).expect("sound tables")
}

/// The rows of a table with named columns.
pub fn rows(table: &'static str) -> impl Iterator<Item = Row> {
    let mut lines = table.lines().filter(|line| !line.starts_with('#'));
    let columns: Vec<&str> = lines.next().expect("a header").split(',').collect();
    lines.map(move |line| Row(columns.iter().copied().zip(line.split(',')).collect()))
}

pub struct Row(BTreeMap<&'static str, &'static str>);

impl Row {
    pub fn text(&self, column: &str) -> &'static str {
        self.0.get(column).unwrap_or_else(|| panic!("no column {column}"))
    }
    pub fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or_else(|_| panic!("{column}: {:?}", self.text(column)))
    }
    pub fn place(&self) -> Place {
        let [lat, lon, height] = ["lat_deg_N", "lon_deg_E", "height_m"].map(|c| self.number(c));
        Place::new(lat, lon, height).expect("a place")
    }
    /// A day of UT1 and its fraction, with the Delta-T of the table.
    pub fn ut1_instant(&self, fraction: f64) -> Instant {
        let ut1 = JulianDate::from_parts(self.number("jd_ut1_day"), fraction);
        Instant::from_tt_ut1(ut1.read_on(self.number("delta_t_s")), ut1).expect("a date")
    }
}

pub fn seconds(from: &Instant, to: &Instant) -> f64 {
    (to.tt - from.tt) * DAY_S
}

pub fn list(almanac: &Almanac, from: &Instant, to: &Instant) -> Vec<Event> {
    almanac.events(from, to).expect("a span").collect::<Result<_, _>>().expect("within range")
}

/// An almanac of a place, as good as it gets.
pub fn almanac(ephemeris: &Ephemeris, place: Option<&Place>, request: Request) -> Almanac {
    Almanac::new(ephemeris, place, Request { tolerance: TOLERANCE, ..request }).expect("sensible")
}

/// What an error of the ephemeris may do to a time: the bound over the speed.
pub fn uncertainty_s(
    almanac: &Almanac,
    instant: &Instant,
    bodies: &[Body],
    rate_arcsec_s: f64,
) -> f64 {
    let bound = |body: &Body| almanac.error_bound(instant, *body).expect("in range").arcsec();
    bodies.iter().map(bound).sum::<f64>() / rate_arcsec_s.abs()
}

/// Speed of an altitude or of the eastward component of a direction, arcseconds a second.
pub fn local_rate_arcsec_s(
    ephemeris: &Ephemeris,
    place: &Place,
    instant: &Instant,
    body: Body,
    is_transit: bool,
) -> f64 {
    let at = |offset_s: f64| {
        let instant = instant.plus_seconds(offset_s).expect("in range");
        let mut observation = Observation::at(ephemeris, &instant, place, TOLERANCE);
        let dir = observation.seen(body).expect("in range").place.horizon;
        if is_transit { Angle::from_rad(dir.vector().x) } else { dir.altitude() }
    };
    (at(30.0) - at(-30.0)).arcsec() / 60.0
}

/// Speed at which one body overtakes another in a coordinate, arcseconds a second.
pub fn overtaking_arcsec_s(
    ephemeris: &Ephemeris,
    instant: &Instant,
    bodies: [Body; 2],
    is_ecliptic: bool,
) -> f64 {
    let anywhere = Place::new(0.0, 0.0, 0.0).expect("a place");
    let at = |offset_s: f64| {
        let instant = instant.plus_seconds(offset_s).expect("in range");
        let mut observation = Observation::at(ephemeris, &instant, &anywhere, TOLERANCE);
        let observer = *observation.observer();
        let axes = observer.orientation;
        let mean_from_true = axes.mean_from_icrs * observer.true_from_icrs.inverse();
        let [first, second] = bodies.map(|body| {
            let dir = observation.seen(body).expect("in range").place.geocentric;
            if is_ecliptic {
                let ecliptic: Dir<_> = axes.ecliptic_from_mean * (mean_from_true * dir);
                ecliptic.longitude()
            } else {
                dir.longitude()
            }
        });
        (first - second).signed()
    };
    (at(1800.0) - at(-1800.0)).signed().arcsec() / 3600.0
}

pub fn body(target: &Target) -> Body {
    match target {
        Target::Body(body) => *body,
        Target::Star(_) => panic!("{target} is a star"),
    }
}

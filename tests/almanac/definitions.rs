//! What must be true of any almanac: events are what they are said to be, and none is missing.

use nocturne::almanac::{Class, Event, Limits, Request, Target, Twilight, What, limits};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris, Observation};
use nocturne::place::Place;
use nocturne::time::{Instant, parse, to_instant};
use nocturne::units::Angle;

use super::truth::{TOLERANCE, almanac, ephemeris, list, seconds};

/// Somewhere, and when; the last ones are the poles and where the midnight Sun grazes the horizon.
const PLACES: [(f64, f64, f64, &str); 9] = [
    (35.2, -111.65, 2100.0, "2026-03-25"),
    (-33.9, 18.4, 0.0, "1900-01-01"),
    (0.0, 179.9, 10.0, "0001-06-01"),
    (69.65, 18.95, 10.0, "2026-05-15"),
    (78.2, 15.6, 0.0, "2025-10-20"),
    (-54.8, -68.3, 0.0, "-2000-12-20"),
    (65.75, 25.0, 0.0, "2026-06-18"),
    (90.0, 0.0, 0.0, "2026-03-10"),
    (-90.0, 0.0, 2835.0, "2025-09-10"),
];
const DAYS: f64 = 20.0;

fn instant(text: &str) -> Instant {
    to_instant(&parse(text).unwrap(), None).unwrap()
}

fn altitude(ephemeris: &Ephemeris, place: &Place, at: &Instant, body: Body) -> (Angle, f64) {
    let mut observation = Observation::at(ephemeris, at, place, TOLERANCE);
    let place = observation.seen(body).unwrap().place;
    (place.horizon.altitude(), place.topocentric_distance_km)
}

/// Height of a body above where it rises and sets.
fn above(ephemeris: &Ephemeris, place: &Place, at: &Instant, body: Body, limits: &Limits) -> Angle {
    let (altitude, distance_km) = altitude(ephemeris, place, at, body);
    altitude - limits.altitude(&Target::Body(body), distance_km)
}

/// All cases, each with its almanac of twenty days.
fn for_each_place(classes: &[Class], check: impl Fn(&Ephemeris, &Place, [Instant; 2], &[Event])) {
    let ephemeris = ephemeris();
    for (lat, lon, height, start) in PLACES {
        let place = Place::new(lat, lon, height).unwrap();
        let request = Request {
            classes: classes.to_vec(),
            bodies: vec![Body::Sun, Body::Moon, Body::Venus],
            ..Request::default()
        };
        let from = instant(start);
        let to = from.plus_seconds(DAYS * 86_400.0).unwrap();
        let events = list(&almanac(&ephemeris, Some(&place), request), &from, &to);
        for pair in events.windows(2) {
            assert!(pair[0].instant.tt <= pair[1].instant.tt, "{} too late", pair[1].what);
        }
        check(&ephemeris, &place, [from, to], &events);
    }
}

#[test]
fn at_each_event_its_definition_holds() {
    let classes = [Class::Rise, Class::Set, Class::Transit, Class::LowerTransit, Class::Twilight];
    // A millisecond of the sky.
    let tolerance = Angle::from_arcsec(0.015);
    for_each_place(&classes, |ephemeris, place, _, events| {
        assert!(!events.is_empty());
        for Event { instant, what } in events {
            let off = match what {
                What::Rise { target: Target::Body(body), .. }
                | What::Set { target: Target::Body(body), .. } => {
                    above(ephemeris, place, instant, *body, &Limits::default())
                }
                What::Twilight { twilight, .. } => {
                    altitude(ephemeris, place, instant, Body::Sun).0 - twilight.sun_altitude()
                }
                What::Transit { target: Target::Body(body), .. } => {
                    let mut observation = Observation::at(ephemeris, instant, place, TOLERANCE);
                    let east = observation.seen(*body).unwrap().place.horizon.vector().x;
                    Angle::from_rad(east)
                }
                what => panic!("{what}"),
            };
            assert!(off.abs() < tolerance, "{what} at {instant}: {} arcsec", off.arcsec());
        }
    });
}

/// Between events nothing changes: at many moments each body is where its last event left it. This
/// finds what is missing as well as what is too much.
#[test]
fn between_events_bodies_stay_on_their_side() {
    let classes = [Class::Rise, Class::Set, Class::Twilight];
    for_each_place(&classes, |ephemeris, place, [from, to], events| {
        let steps = 5_000;
        let step_s = seconds(&from, &to) / f64::from(steps);
        let limits = Limits::default();
        let mut next = 0;
        let is_up = |at: &Instant, k: usize| match k {
            0..3 => {
                let body = [Body::Sun, Body::Moon, Body::Venus][k];
                above(ephemeris, place, at, body, &limits) >= Angle::ZERO
            }
            _ => {
                let twilight = Twilight::ALL[k - 3];
                altitude(ephemeris, place, at, Body::Sun).0 >= twilight.sun_altitude()
            }
        };
        let index = |what: &What| match what {
            What::Twilight { twilight, .. } => {
                3 + Twilight::ALL.iter().position(|t| t == twilight).unwrap()
            }
            what => ["Sun", "Moon", "Venus"]
                .iter()
                .position(|name| *name == what.targets()[0].name())
                .unwrap(),
        };
        let mut state: [bool; 6] = std::array::from_fn(|k| is_up(&from, k));
        for step in 1..steps {
            let at = from.plus_seconds(step_s * f64::from(step)).unwrap();
            while events.get(next).is_some_and(|event| event.instant.tt <= at.tt) {
                let Event { instant, what } = &events[next];
                let rises = match what {
                    What::Rise { .. } => true,
                    What::Twilight { .. } => what.code().ends_with("dawn"),
                    _ => false,
                };
                assert_ne!(state[index(what)], rises, "{what} at {instant} happens twice");
                state[index(what)] = rises;
                next += 1;
            }
            let is_beside_an_event = events[next.saturating_sub(1)..]
                .iter()
                .take(2)
                .any(|event| seconds(&at, &event.instant).abs() < 0.01);
            if !is_beside_an_event {
                // Each in its turn: looking is the cost.
                let k = step as usize % 6;
                assert_eq!(is_up(&at, k), state[k], "{place:?} at {at}, number {k}");
            }
        }
    });
}

#[test]
fn dark_windows_are_dark_and_end_where_it_is_not() {
    for_each_place(&[Class::Dark], |ephemeris, place, [from, to], events| {
        let is_dark = |at: &Instant| {
            altitude(ephemeris, place, at, Body::Sun).0 < Angle::from_deg(-18.0)
                && above(ephemeris, place, at, Body::Moon, &Limits::default()) < Angle::ZERO
        };
        let mut edges = vec![from];
        for event in events {
            let What::Dark { end } = &event.what else { panic!("{}", event.what) };
            edges.extend([event.instant, *end]);
        }
        edges.push(to);
        let mut dark = false;
        for pair in edges.windows(2) {
            let length_s = seconds(&pair[0], &pair[1]);
            assert!(length_s >= 0.0);
            for part in [0.03, 0.25, 0.5, 0.75, 0.97] {
                let at = pair[0].plus_seconds(length_s * part).unwrap();
                assert!(length_s < 1.0 || is_dark(&at) == dark, "{place:?} at {at}");
            }
            dark = !dark;
        }
    });
}

#[test]
fn a_higher_horizon_shortens_the_day() {
    let ephemeris = ephemeris();
    let place = Place::new(46.5, 8.0, 560.0).unwrap();
    let [from, to] = ["2026-05-01", "2026-05-02"].map(instant);
    let day_s = |skyline: Angle| {
        let request = Request {
            classes: vec![Class::Rise, Class::Set],
            bodies: vec![Body::Sun],
            limits: Limits { skyline, ..Limits::default() },
            ..Request::default()
        };
        let events = list(&almanac(&ephemeris, Some(&place), request), &from, &to);
        assert_eq!(events.len(), 2);
        seconds(&events[0].instant, &events[1].instant)
    };
    let level = day_s(Angle::ZERO);
    assert!(day_s(Angle::from_deg(5.0)) < level - 3000.0);
    assert!(day_s(limits::sea_horizon(560.0)) > level + 300.0);
}

#[test]
fn stars_rise_and_are_met() {
    let catalogs = Catalogs::locate(None).unwrap();
    let stars = catalogs.stars().unwrap();
    let named = |name: &str| {
        let star = stars.iter().find(|star| star.name.as_deref() == Some(name)).unwrap();
        Target::Star(std::sync::Arc::new(star.clone()))
    };
    let place = Place::new(0.0, 0.0, 0.0).unwrap();
    let request = Request {
        classes: vec![Class::Rise, Class::Transit, Class::Set, Class::Appulse],
        bodies: vec![Body::Moon],
        stars: vec![named("Sirius")],
        met_stars: vec![named("Regulus")],
        nearer_than: Angle::from_deg(5.0),
        ..Request::default()
    };
    let [from, to] = ["2026-01-01", "2026-01-29"].map(instant);
    let events = list(&almanac(&ephemeris(), Some(&place), request), &from, &to);
    let of_sirius: Vec<&Event> =
        events.iter().filter(|event| event.what.targets()[0].name() == "Sirius").collect();
    // 28 days are 28.08 turns of the stars.
    assert!((84..=85).contains(&of_sirius.len()), "{}", of_sirius.len());
    for pair in of_sirius.windows(4) {
        // Four stages further the same thing happens a sidereal day later.
        let days = pair[3].instant.tt - pair[0].instant.tt;
        assert!((days - 0.997_27).abs() < 1e-5, "{days}");
    }
    let met: Vec<&Event> =
        events.iter().filter(|event| matches!(event.what, What::Appulse { .. })).collect();
    assert_eq!(met.len(), 1);
    // Occultations of Regulus by the Moon of 2025 and 2026: near, whatever the place.
    assert!(met[0].what.separation().unwrap().deg() < 1.0);
}

//! Phases, seasons, ends of orbits and meetings against brute force.

use std::collections::BTreeMap;

use nocturne::almanac::{Almanac, Class, Event, Quarter, Request, Season, What};
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::time::{Instant, JulianDate, parse, to_instant};
use nocturne::units::Angle;

use super::truth::{
    Row, almanac, body, ephemeris, list, overtaking_arcsec_s, rows, seconds, uncertainty_s,
};

const TABLE: &str = include_str!("../truth/almanac_geocentric.csv");

/// What the almanac and the table may add to the error of the ephemeris: zeros and extrema.
const ZERO_ERROR_S: f64 = 0.5;
const EXTREMUM_ERROR_S: f64 = 15.0;
/// What takes the place of a speed for extrema: 14" of the Sun shift a perihelion by five hours.
const SLOPE_ARCSEC_S: f64 = 0.0008;

fn instant(row: &Row) -> Instant {
    let tt = JulianDate::from_parts(row.number("jd_tt_day"), row.number("jd_tt_frac"));
    Instant::from_tt(tt).unwrap()
}

#[test]
fn spans_hold_the_events_of_the_table_and_no_others() {
    let ephemeris = ephemeris();
    let rows: Vec<_> = rows(TABLE).collect();
    let (mut checked, mut worst_s) = (0, BTreeMap::new());
    let mut rest = &rows[..];
    while let [span, after @ ..] = rest {
        let length = after.iter().take_while(|row| row.text("event") != "span").count();
        let (truth, next) = after.split_at(length);
        rest = next;
        let mut classes = vec![Class::Phase, Class::Season, Class::Apsis];
        if span.text("first") == "meetings" {
            classes.extend([Class::Conjunction, Class::Opposition]);
            classes.extend([Class::Elongation, Class::Appulse]);
        }
        let almanac = almanac(&ephemeris, None, Request { classes, ..Request::default() });
        let tt = JulianDate::from_parts(span.number("jd_tt_day"), 0.0);
        let from = Instant::from_tt(tt).unwrap();
        let to = from.plus_seconds(span.number("jd_tt_frac") * 86_400.0).unwrap();
        let mut events = list(&almanac, &from, &to);
        for row in truth {
            let expected = instant(row);
            let code = row.text("event");
            let names = [row.text("first"), row.text("second")];
            let is_it = |event: &Event| {
                let targets = event.what.targets();
                let is_named = |k: usize| targets.get(k).is_none_or(|t| t.name() == names[k]);
                event.what.code() == code && is_named(0) && (names[1].is_empty() || is_named(1))
            };
            // Meetings may come thrice within months: the nearest counts.
            let nearest = (0..events.len()).filter(|&k| is_it(&events[k])).min_by(|&a, &b| {
                let off = |k: usize| seconds(&expected, &events[k].instant).abs();
                off(a).total_cmp(&off(b))
            });
            let event =
                events.remove(nearest.unwrap_or_else(|| panic!("no {code} {names:?} {expected}")));
            let error_s = seconds(&expected, &event.instant).abs();
            let allowed_s = allowed_s(&ephemeris, &almanac, &expected, &event.what);
            let worst = worst_s.entry(code).or_insert(0.0f64);
            *worst = worst.max(error_s);
            assert!(
                error_s < allowed_s,
                "{code} {names:?} {expected}: {error_s} s > {allowed_s} s"
            );
            check_value(row, &event, &almanac);
            checked += 1;
        }
        assert!(events.is_empty(), "too many: {events:?}");
    }
    println!("{checked} events, the worst seconds: {worst_s:.3?}");
    assert!(checked > 2500, "{checked}");
}

/// How far off an event may be.
fn allowed_s(ephemeris: &Ephemeris, almanac: &Almanac, at: &Instant, what: &What) -> f64 {
    let bodies: Vec<Body> = what.targets().iter().map(body).collect();
    let by_bound = |arcsec_s: f64| uncertainty_s(almanac, at, &bodies, arcsec_s);
    match what {
        // The longitude of the Moon grows by 0.4" a second at least, that of the Sun by 0.039".
        What::MoonPhase(_) => {
            ZERO_ERROR_S + uncertainty_s(almanac, at, &[Body::Sun, Body::Moon], 0.4)
        }
        What::Season(_) => ZERO_ERROR_S + by_bound(0.039),
        What::Conjunction { .. } | What::SolarConjunction { .. } | What::Opposition { .. } => {
            let is_ecliptic = !matches!(what, What::Conjunction { .. });
            let pair = [bodies[0], bodies[1]];
            ZERO_ERROR_S + by_bound(overtaking_arcsec_s(ephemeris, at, pair, is_ecliptic))
        }
        // Of an extremum the slope is zero, and no bound tells the slope of an error.
        _ => EXTREMUM_ERROR_S + by_bound(SLOPE_ARCSEC_S),
    }
}

fn check_value(row: &Row, event: &Event, almanac: &Almanac) {
    if row.text("value").is_empty() {
        return;
    }
    let expected = row.number("value");
    if let Some(distance_km) = event.what.distance_km() {
        let relative = (distance_km / expected - 1.0).abs();
        assert!(relative < 1e-4, "{row_event}: {distance_km} km", row_event = row.text("event"));
        return;
    }
    let bodies: Vec<Body> = event.what.targets().iter().map(body).collect();
    let separation = event.what.separation().expect("two of them");
    let error = (separation - Angle::from_deg(expected)).abs().arcsec();
    let bound = uncertainty_s(almanac, &event.instant, &bodies, 1.0);
    assert!(error < 0.1 + 2.0 * bound, "{} {bodies:?}: {error} arcsec", row.text("event"));
}

#[test]
fn phases_and_seasons_follow_each_other_for_a_lifetime() {
    let classes = vec![Class::Phase, Class::Season];
    // The order does not ask for arcseconds.
    let tolerance = Angle::from_arcmin(20.0);
    let request = Request { classes, tolerance, ..Request::default() };
    let almanac = Almanac::new(&Ephemeris::analytic(), None, request).unwrap();
    let [from, to] =
        ["1950-01-01", "2030-01-01"].map(|text| to_instant(&parse(text).unwrap(), None).unwrap());
    let events = list(&almanac, &from, &to);
    let mut phases = Vec::new();
    let mut seasons = Vec::new();
    for event in events {
        match event.what {
            What::MoonPhase(quarter) => phases.push((event.instant, quarter)),
            What::Season(season) => seasons.push(season),
            what => panic!("{what}"),
        }
    }
    // 29219.5 days are 989.46 lunations of 29.530589 days.
    assert_eq!(phases.len() / 4, 989);
    let after = |quarter: Quarter| match quarter {
        Quarter::New => Quarter::First,
        Quarter::First => Quarter::Full,
        Quarter::Full => Quarter::Last,
        Quarter::Last => Quarter::New,
    };
    for pair in phases.windows(2) {
        assert_eq!(pair[1].1, after(pair[0].1), "{}", pair[1].0);
        let days = pair[1].0.tt - pair[0].0.tt;
        assert!((6.4..8.5).contains(&days), "{}: {days} days", pair[1].0);
    }
    let year = [
        Season::MarchEquinox,
        Season::JuneSolstice,
        Season::SeptemberEquinox,
        Season::DecemberSolstice,
    ];
    assert_eq!(seasons.len(), 4 * 80);
    assert!(seasons.chunks(4).all(|chunk| chunk == year));
}

#[test]
fn it_does_not_matter_where_one_begins() {
    let ephemeris = ephemeris();
    let classes = vec![Class::Phase, Class::Apsis, Class::Appulse, Class::Eclipse];
    let almanac = almanac(&ephemeris, None, Request { classes, ..Request::default() });
    let [from, to] =
        ["2026-01-01", "2026-12-01"].map(|text| to_instant(&parse(text).unwrap(), None).unwrap());
    let whole = list(&almanac, &from, &to);
    // Cut into uneven pieces, some of which end on an event.
    let mut cuts: Vec<Instant> = whole.iter().step_by(23).map(|event| event.instant).collect();
    cuts.insert(0, from);
    cuts.push(to);
    let pieces: Vec<Event> =
        cuts.windows(2).flat_map(|cut| list(&almanac, &cut[0], &cut[1])).collect();
    // An event within its own noise of a cut may fall to either side, where order is by time.
    assert_eq!(pieces.len(), whole.len());
    for (piece, event) in pieces.iter().zip(&whole) {
        assert_eq!(piece.what.code(), event.what.code());
        let noise_s = if event.what.distance_km().is_some() { 30.0 } else { 1.0 };
        assert!(seconds(&piece.instant, &event.instant).abs() < noise_s, "{}", event.what);
    }
}

//! The bar and the panel of date and time, and jumps against the almanac.

use std::sync::Arc;

use eframe::egui::Key;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::almanac::{Almanac, Class, Quarter, Request, What};
use nocturne::app::App;
use nocturne::app::action::Jump;
use nocturne::app::clock::Clock;
use nocturne::app::errands::jump::{Found, Search, find};
use nocturne::app::local_clock::LocalClock;
use nocturne::app::model::{Model, Panel};
use nocturne::background::Interrupt;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::place::Place;
use nocturne::sky::Target;
use nocturne::time::{self, CivilDateTime, Instant};
use nocturne::units::{Angle, DAY_S};

use crate::{until, window, write};

fn instant(text: &str) -> Instant {
    time::to_instant(&time::parse(text).unwrap(), None).unwrap()
}

/// A summer evening in Greenwich, 05:30 on its clocks, with the panel open.
fn with_panel() -> Harness<'static, App> {
    let mut model = Model { clock: Clock::at(instant("2026-08-13T04:30Z")), ..Model::default() };
    model.panels.set(Panel::Time, true);
    window(model)
}

fn civil(harness: &Harness<App>) -> CivilDateTime {
    let model = harness.state().model();
    LocalClock::of(&model.place).read(&model.clock.instant).civil
}

#[test]
fn the_bar_shows_the_clock_and_its_buttons_work() {
    let mut harness =
        window(Model { clock: Clock::at(instant("2026-08-13T04:30Z")), ..Model::default() });
    harness.get_by_label_contains("2026-08-13 05:30:00 BST (UTC+01:00)");
    harness.get_by_label("Greenwich");
    harness.get_by_label("paused");
    harness.get_by_label("Play").click();
    harness.run_steps(2);
    assert!(harness.state().model().clock.runs());
    harness.get_by_label("Faster").click();
    harness.run_steps(2);
    assert_eq!(harness.state().model().clock.speed(), 10.0);
    for _ in 0..3 {
        harness.get_by_label("Slower").click();
        harness.run_steps(2);
    }
    assert_eq!(harness.state().model().clock.speed(), -1.0);
    harness.get_by_label("Now").click();
    harness.run_steps(2);
    assert!(harness.state().model().clock.is_live);
    harness.get_by_label("Place").click();
    harness.run_steps(2);
    assert!(harness.state().model().panels.is_open(Panel::Place));
}

#[test]
fn signs_of_buttons_are_in_the_fonts() {
    let harness = window(Model::default());
    let font = eframe::egui::FontId::default();
    let missing: String = "«»‹›×−°…"
        .chars()
        .filter(|sign| !harness.ctx.fonts_mut(|fonts| fonts.has_glyph(&font, *sign)))
        .collect();
    assert_eq!(missing, "");
}

#[test]
fn parts_of_a_date_are_typed() {
    let mut harness = with_panel();
    write(&mut harness, "Year", "585 BC");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    let now = civil(&harness);
    assert_eq!((now.year, now.month, now.day, now.hour, now.minute), (-584, 8, 13, 5, 30));
    harness.get_by_label_contains("585 BC, LMT");
    write(&mut harness, "Day", "31");
    // Leaving the field takes it, too.
    harness.key_press(Key::Tab);
    harness.run_steps(3);
    assert_eq!(civil(&harness).day, 31);
    // There is no 31st of February.
    write(&mut harness, "Month", "2");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!((civil(&harness).month, civil(&harness).day), (2, 29));
}

#[test]
fn nonsense_is_marked_and_not_taken() {
    let mut harness = with_panel();
    let before = harness.state().model().clock.instant;
    for (label, text, said) in [
        ("Month", "13", "month 13"),
        ("Day", "32", "day 32"),
        ("Hour", "noon", "'noon'"),
        ("Year", "4001", "year 4001"),
        ("Julian date (UTC)", "1e300", "outside the years"),
    ] {
        write(&mut harness, label, text);
        harness.get_by_label_contains(said);
        harness.get_by_label_contains("! ");
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        assert_eq!(harness.state().model().clock.instant, before, "{label}");
        assert!(harness.query_by_label_contains("! ").is_none());
    }
}

#[test]
fn arrows_step_and_run_over() {
    let mut harness = with_panel();
    let before = harness.state().model().clock.instant;
    harness.get_by_role_and_label(eframe::egui::accesskit::Role::TextInput, "Hour").focus();
    harness.run_steps(2);
    for _ in 0..19 {
        harness.key_press(Key::ArrowUp);
        harness.run_steps(2);
    }
    let hours = (harness.state().model().clock.instant.tt - before.tt) * 24.0;
    assert!((hours - 19.0).abs() < 1e-6, "{hours}");
    assert_eq!((civil(&harness).day, civil(&harness).hour), (14, 0));
    // The sky has not been turned meanwhile.
    assert_eq!(harness.state().model().view, Model::default().view);
}

#[test]
fn a_day_of_the_calendar_is_clicked_and_a_julian_date_typed() {
    let mut harness = with_panel();
    until(&mut harness, |harness| {
        harness.query_by_label("28 August 2026, full Moon").is_some()
            && harness.query_by_label("12 August 2026, new Moon").is_some()
    });
    harness.get_by_label("Next month").click();
    harness.run_steps(2);
    harness.get_by_label_contains("20 September 2026").click();
    harness.run_steps(3);
    let now = civil(&harness);
    assert_eq!((now.month, now.day, now.hour, now.minute), (9, 20, 5, 30));
    write(&mut harness, "Julian date (UTC)", "2451545.0");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().model().clock.instant.to_string(), "2000-01-01T12:00:00Z");
    harness.get_by_label("A lunation on").click();
    harness.run_steps(3);
    let days = harness.state().model().clock.instant.tt - instant("2000-01-01T12:00Z").tt;
    assert!((days - 29.530_588_86).abs() < 1e-6, "{days}");
}

#[test]
fn a_button_jumps_while_the_window_goes_on() {
    let mut harness = with_panel();
    harness.get_by_label("Next full Moon").click();
    until(&mut harness, |harness| {
        harness.query_by_label_contains("Full Moon 2026-08-28 04:19 UTC").is_some()
    });
    let found = harness.state().model().clock.instant;
    let expected = full_moon(&instant("2026-08-13T04:30Z"));
    assert!((found.tt - expected.tt).abs() * DAY_S < 0.5, "{found} and {expected}");
    assert!(!harness.state().model().clock.is_live);
    harness.get_by_label("Dismiss").click();
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("Full Moon").is_none());
}

fn full_moon(from: &Instant) -> Instant {
    let ephemeris = ephemeris();
    let request = Request { classes: vec![Class::Phase], ..Request::default() };
    let almanac = Almanac::new(&ephemeris, None, request).unwrap();
    let events = almanac.events(from, &from.plus_seconds(40.0 * DAY_S).unwrap()).unwrap();
    let is_full = |what: &What| *what == What::MoonPhase(Quarter::Full);
    events.map(Result::unwrap).find(|event| is_full(&event.what)).unwrap().instant
}

fn ephemeris() -> Arc<Ephemeris> {
    let catalogs = Catalogs::locate(None).unwrap();
    Arc::new(Ephemeris::load(&catalogs, Angle::from_arcsec(0.01)).unwrap())
}

fn look(
    jump: Jump,
    is_back: bool,
    from: Instant,
    selected: Option<Target>,
) -> Result<Found, String> {
    let place = Place::new(51.4769, 0.0, 46.0).unwrap();
    let search = Search { jump, is_back, from, place, selected };
    let catalogs = Catalogs::locate(None).unwrap();
    find(&search, &ephemeris(), &catalogs, &Interrupt::default())
}

#[test]
fn daily_jumps_are_those_of_the_almanac() {
    let from = instant("2026-08-13T04:30Z");
    let place = Place::new(51.4769, 0.0, 46.0).unwrap();
    let ephemeris = ephemeris();
    for (jump, class, body) in [
        (Jump::Sunrise, Class::Rise, Body::Sun),
        (Jump::Sunset, Class::Set, Body::Sun),
        (Jump::Moonrise, Class::Rise, Body::Moon),
        (Jump::Moonset, Class::Set, Body::Moon),
        (Jump::Rise, Class::Rise, Body::Jupiter),
        (Jump::Transit, Class::Transit, Body::Jupiter),
    ] {
        let request = Request { classes: vec![class], bodies: vec![body], ..Request::default() };
        let almanac = Almanac::new(&ephemeris, Some(&place), request).unwrap();
        let between = |from: f64, to: f64| -> Vec<Instant> {
            let at = |days: f64| instant("2026-08-13T04:30Z").plus_seconds(days * DAY_S).unwrap();
            let events = almanac.events(&at(from), &at(to)).unwrap();
            events.map(|event| event.unwrap().instant).collect()
        };
        let (before, after) = (between(-3.0, 0.0), between(0.0, 3.0));
        let selected = Some(Target::Body(Body::Jupiter));
        let next = look(jump, false, from, selected.clone()).unwrap();
        let last = look(jump, true, from, selected.clone()).unwrap();
        assert!((next.instant.tt - after[0].tt).abs() * DAY_S < 0.5, "{}", next.words);
        assert!(
            (last.instant.tt - before[before.len() - 1].tt).abs() * DAY_S < 0.5,
            "{}",
            last.words
        );
        // Again from there is the next after, not the same.
        let second = look(jump, false, next.instant, selected).unwrap();
        assert!((second.instant.tt - after[1].tt).abs() * DAY_S < 0.5, "{}", second.words);
        let towards = next.towards.expect("it is seen where it rises, sets and culminates");
        assert!(towards.altitude().deg() >= 0.0);
    }
}

#[test]
fn eclipses_are_found_anywhere_and_here() {
    // Espenak's canons: partial of the Moon 2026-08-28 04:13 UT; total of the Sun 2026-08-12 17:46 UT,
    // annular 2027-02-06 16:00; on 2027-08-02 the Moon covers part of the Sun in England.
    let from = instant("2026-08-13T04:30Z");
    let cases = [
        (Jump::LunarEclipse, false, "Partial eclipse of the Moon 2026-08-28 04:13 UTC", true),
        (Jump::LunarEclipseHere, false, "Partial eclipse of the Moon 2026-08-28 04:13 UTC", true),
        (Jump::SolarEclipse, true, "Total eclipse of the Sun 2026-08-12 17:4", true),
        (Jump::SolarEclipse, false, "Annular eclipse of the Sun 2027-02-06 16:0", false),
        (Jump::SolarEclipseHere, false, "Eclipse of the Sun 2027-08-02 09:", true),
    ];
    for (jump, is_back, words, is_seen) in cases {
        let found = look(jump, is_back, from, None).unwrap();
        assert!(found.words.starts_with(words), "{}", found.words);
        assert_eq!(found.towards.is_some(), is_seen, "{}", found.words);
    }
}

#[test]
fn what_never_happens_is_said() {
    let from = instant("2026-08-13T04:30Z");
    let polaris = Some(Target::Star { hr: 424 });
    let words = look(Jump::Set, false, from, polaris).unwrap_err();
    assert!(words.starts_with("There is no set of HR 424 within a year"), "{words}");
    assert!(look(Jump::Rise, false, from, None).unwrap_err().contains("Nothing is selected"));
    let m31 = look(Jump::Rise, false, from, Some(Target::Messier(31))).unwrap_err();
    assert!(m31.contains("select one of those"), "{m31}");
    let end = instant("4000-12-31T23:00Z");
    assert!(look(Jump::FullMoon, false, end, None).unwrap_err().contains("There is no full Moon"));
    assert!(look(Jump::FullMoon, true, end, None).is_ok());
}

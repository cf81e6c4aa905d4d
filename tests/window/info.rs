//! A click, and what the panel says of what was under it.

use std::time::Duration;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Pos2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT;
use nocturne::almanac::{Almanac, Class, Request};
use nocturne::app::App;
use nocturne::app::clock::Clock;
use nocturne::app::model::Model;
use nocturne::app::pointing;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::frame::{Dir, galactic_from_icrs};
use nocturne::light::photometry::Band;
use nocturne::plan::brightness::MeasuredSky;
use nocturne::plan::lay::Kept;
use nocturne::sky::Target;
use nocturne::store::Store;
use nocturne::time::{self, Instant};
use nocturne::units::{AU_KM, Angle};

use crate::{settle, window};

pub fn at(utc: &str) -> Instant {
    time::to_instant(&time::parse(utc).unwrap(), None).unwrap()
}

/// All words in the window, in order.
pub fn labels(harness: &Harness<App>) -> Vec<String> {
    let nodes = harness.root().children_recursive();
    nodes
        .map(|node| node.accesskit_node())
        // A part of another node.
        .filter(|node| node.role() != Role::TextRun)
        .filter_map(|node| node.label().or_else(|| node.value()))
        .collect()
}

/// Waits for words that are found out beside the window.
pub fn until(harness: &mut Harness<App>, is_it: impl Fn(&str) -> bool) -> String {
    for _ in 0..3000 {
        harness.run_steps(1);
        if let Some(label) = labels(harness).into_iter().find(|label| is_it(label)) {
            return label;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    panic!("it was never said: {:?}", labels(harness));
}

/// What stands beside a word in the table.
fn value(harness: &Harness<App>, what: &str) -> Option<String> {
    let labels = labels(harness);
    let row = labels.iter().position(|label| label == what)?;
    labels.get(row + 1).cloned()
}

/// A field of 60 degrees in a direction at a time.
fn looking(utc: &str, azimuth_deg: f64, altitude_deg: f64, field_deg: f64) -> Model {
    let mut model = Model { clock: Clock::at(at(utc)), ..Model::default() };
    let [azimuth, altitude] = [azimuth_deg, altitude_deg].map(Angle::from_deg);
    let latitude = model.latitude();
    model.view.set_field(field_deg);
    model.view.look(Dir::from_azimuth_altitude(azimuth, altitude), latitude);
    model
}

fn click(harness: &mut Harness<App>, point: Pos2) {
    harness.hover_at(point);
    harness.run_steps(1);
    harness.drag_at(point);
    harness.run_steps(1);
    harness.drop_at(point);
    harness.run_steps(3);
    settle(harness);
}

/// Where a target lies in the window; a picture has a pixel for each point here.
fn point_of(harness: &Harness<App>, target: &Target) -> Pos2 {
    let shown = harness.state().shown().expect("a sky");
    let dir = pointing::towards(target, &shown.night).expect("it is known");
    let [x, y] = shown.setting.camera.pixel_from_apparent(dir).expect("it is in the picture");
    pos2(x as f32, y as f32)
}

/// Degrees of an angle as the panel writes it, from degrees or hours, minutes and seconds.
fn read(words: &str) -> f64 {
    let negative = words.starts_with('−');
    let per_one = if words.contains('h') { 15.0 } else { 1.0 };
    let marks = ['°', '\'', '"', 'h', 'm', 's', '+', '−', ' '];
    let parts = words.split(marks).filter(|part| !part.is_empty());
    let parts: Vec<f64> = parts.map_while(|part| part.parse().ok()).collect();
    let sum: f64 = parts.iter().zip([1.0, 60.0, 3600.0]).map(|(part, of)| part / of).sum();
    per_one * if negative { -sum } else { sum }
}

#[test]
fn a_star_that_is_clicked_is_selected_and_told_of_as_the_core_has_it() {
    let mut harness = window(looking("2026-08-13T01:00Z", 250.0, 50.0, 60.0));
    let vega = Target::Star { hr: 7001 };
    let point = point_of(&harness, &vega) + eframe::egui::vec2(4.0, -3.0);
    click(&mut harness, point);
    assert_eq!(harness.state().model().selected, Some(vega));
    assert!(labels(&harness).iter().any(|label| label == "Vega"));
    let said = |what: &str| value(&harness, what).unwrap_or_else(|| panic!("{what}"));
    let night = harness.state().shown().unwrap().night.clone();
    let star = night.find("Vega").unwrap();
    let near = |what: &str, words: &str, wanted_deg: f64, within_arcsec: f64| {
        let off_arcsec = (read(words) - wanted_deg) * 3600.0;
        assert!(off_arcsec.abs() <= within_arcsec, "{what}: {words} is off by {off_arcsec} arcsec");
    };
    // Half of the last digit, which is an arcsecond.
    let azimuth = said("Azimuth");
    let azimuth_words = azimuth.rsplit_once(' ').unwrap().0;
    near("azimuth", azimuth_words, star.dir.azimuth().deg(), 0.51);
    let altitude = star.dir.altitude().deg();
    near("altitude", &said("Altitude, without air"), altitude, 0.51);
    let seen = star.apparent.altitude().deg();
    near("seen", &said("Altitude, as seen"), seen, 5.01);
    let icrs = night.sky.horizon_from_icrs.inverse() * star.dir;
    let pair = said("RA, Dec in axes of J2000");
    let (ra, dec) = pair.split_once("  ").unwrap();
    near("ra", ra, icrs.longitude().deg(), 0.8);
    near("dec", dec, icrs.latitude().deg(), 0.51);
    let galactic = galactic_from_icrs() * icrs;
    near("galactic", said("Galactic").split_once("  ").unwrap().1, galactic.latitude().deg(), 0.51);
    assert_eq!(said("Magnitude, outside the air"), "0.03");
    assert_eq!(said("Spectral type"), night.stars[night.stars.find("Vega").unwrap()].spectral_type);
    assert_eq!(said("Constellation"), "Lyra");
    assert_eq!(said("Error of the direction"), "at most 3\"");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(harness.state().model().selected, None);
    assert!(value(&harness, "Azimuth").is_none(), "the panel is closed");
}

#[test]
fn the_day_of_a_planet_is_that_of_the_almanac() {
    let mut model = looking("2026-08-13T01:00Z", 150.0, 30.0, 60.0);
    model.selected = Some(Target::Body(Body::Saturn));
    let mut harness = window(model);
    until(&mut harness, |label| label.contains(" at altitude "));
    let said = value(&harness, "Transit").unwrap();
    let night = harness.state().shown().unwrap().night.clone();
    let catalogs = Catalogs::locate(None).unwrap();
    let tolerance = Angle::from_arcsec(2.0);
    let request = Request {
        classes: vec![Class::Transit],
        bodies: vec![Body::Saturn],
        tolerance,
        ..Request::default()
    };
    let ephemeris = Ephemeris::load(&catalogs, tolerance).unwrap();
    let almanac = Almanac::new(&ephemeris, Some(&night.sky.place), request).unwrap();
    // The day by clocks in London.
    let (from, to) = (at("2026-08-12T23:00Z"), at("2026-08-13T23:00Z"));
    let transit = almanac.events(&from, &to).unwrap().next().unwrap().unwrap();
    let civil = transit.instant.to_local(night.sky.place.time_zone.unwrap()).civil;
    let wanted = f64::from(civil.hour) * 3600.0 + f64::from(civil.minute) * 60.0 + civil.second;
    let time = said.split(' ').next().unwrap();
    let parts: Vec<f64> = time.split(':').map(|part| part.parse().unwrap()).collect();
    let second = parts[0] * 3600.0 + parts[1] * 60.0 + parts[2];
    assert!((second - wanted).abs() <= 0.51, "{said}, not {wanted} s");
    assert!(said.contains(" BST at altitude "), "{said}");
    let saturn = night.sky.body(Body::Saturn).unwrap();
    let said = value(&harness, "Distance").unwrap();
    let au: f64 = said.strip_suffix(" au").unwrap().parse().unwrap();
    assert!((au * AU_KM / saturn.distance_km - 1.0).abs() < 1e-5, "{said}");
}

#[test]
fn empty_sky_is_measured() {
    let mut harness = window(looking("2026-08-13T01:00Z", 90.0, 45.0, 60.0));
    // The emptiest place of a few.
    let shown = harness.state().shown().unwrap();
    let model = harness.state().model().clone();
    let mut places = (0..200).map(|n| [500.0 + 4.0 * f64::from(n), 90.0 + 2.5 * f64::from(n)]);
    let empty = places
        .find(|pixel| pointing::under(*pixel, 40.0, shown, &model).is_none())
        .expect("some sky is empty");
    let dir = pointing::direction(empty, shown).unwrap();
    click(&mut harness, pos2(empty[0] as f32, empty[1] as f32));
    assert_eq!(harness.state().model().selected, None);
    until(&mut harness, |label| label.ends_with("mag/arcsec²"));
    let catalogs = Catalogs::locate(None).unwrap();
    let shown = harness.state().shown().unwrap();
    let (glow, layers) = (&shown.setting.night, &harness.state().model().layers);
    let mut kept = Kept::new(Store::NONE);
    let sky = MeasuredSky::of(&shown.night, glow, layers, &catalogs, &mut kept).unwrap();
    let seen = sky.at(dir, &mut kept).unwrap();
    let said = value(&harness, "Brightness in V").unwrap();
    let mag: f64 = said.split(' ').next().unwrap().parse().unwrap();
    let wanted = seen.mag_per_arcsec2(Band::V).unwrap();
    assert!((mag - wanted).abs() < 0.011, "{said}, not {wanted}");
    let share = |what: &str| -> f64 {
        let words = value(&harness, what).unwrap_or_else(|| panic!("{what}"));
        words.strip_suffix(" %").unwrap().parse().unwrap()
    };
    assert!(share("Airglow") > 1.0 && share("Zodiacal light") > 0.1);
    harness.key_press_modifiers(Modifiers::NONE, Key::Escape);
    harness.run_steps(3);
    assert!(value(&harness, "Brightness in V").is_none(), "the panel is closed");
}

#[test]
fn a_large_moon_shows_its_places_and_a_small_one_itself() {
    let mut model = looking("2026-08-26T00:00Z", 180.0, 20.0, 1.0);
    model.view.follow = Some(Target::Body(Body::Moon));
    let harness = window(model);
    let shown = harness.state().shown().unwrap();
    let model = harness.state().model();
    let seen = |target: &Target| {
        let dir = pointing::towards(target, &shown.night).unwrap();
        shown.setting.camera.pixel_from_apparent(dir).unwrap()
    };
    let tycho = Target::MoonFeature("Tycho".to_owned());
    assert_eq!(pointing::under(seen(&tycho), 14.0, shown, model), Some(tycho));
    let mut model = model.clone();
    model.view.set_field(60.0);
    let harness = window(model);
    let shown = harness.state().shown().unwrap();
    let moon = Target::Body(Body::Moon);
    let dir = pointing::towards(&moon, &shown.night).unwrap();
    let pixel = shown.setting.camera.pixel_from_apparent(dir).unwrap();
    assert_eq!(pointing::under(pixel, 14.0, shown, harness.state().model()), Some(moon));
}

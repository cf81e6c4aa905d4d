//! The panel of places.

use eframe::egui::{Key, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::app::App;
use nocturne::app::clock::Clock;
use nocturne::app::model::{Model, Panel};
use nocturne::time;

use crate::{until, window_of, write};

const MAP: &str = "World map: click to go there";

fn with_panel() -> Harness<'static, App> {
    let evening = time::to_instant(&time::parse("2026-08-13T04:30Z").unwrap(), None).unwrap();
    let mut model = Model { clock: Clock::at(evening), ..Model::default() };
    model.panels.set(Panel::Place, true);
    window_of(model, [1280.0, 900.0])
}

/// Clicks the map at a longitude and a latitude, degrees.
fn click_map(harness: &mut Harness<App>, longitude_deg: f32, latitude_deg: f32) {
    let rect = harness.get_by_label(MAP).rect();
    let share = vec2((longitude_deg + 180.0) / 360.0, (90.0 - latitude_deg) / 180.0);
    let point = rect.min + share * rect.size();
    harness.drag_at(point);
    harness.run_steps(1);
    harness.drop_at(point);
    harness.run_steps(3);
}

#[test]
fn a_place_is_searched_and_gone_to() {
    let mut harness = with_panel();
    write(&mut harness, "Search", "flagstaff");
    until(&mut harness, |harness| {
        harness.query_by_label_contains("Flagstaff (Arizona), United States").is_some()
    });
    harness.get_by_label_contains("Flagstaff (Arizona), United States").click();
    harness.run_steps(3);
    let place = &harness.state().model().place;
    assert_eq!(place.name.as_deref(), Some("Flagstaff"));
    assert_eq!(place.time_zone.as_deref(), Some("America/Phoenix"));
    assert!(place.height_m > 2000.0);
    write(&mut harness, "Search", "qqqqzzzzqqqq");
    until(&mut harness, |harness| harness.query_by_label_contains("No place is called").is_some());
}

#[test]
fn the_map_is_clicked() {
    let mut harness = with_panel();
    // The towns are read beside the window.
    write(&mut harness, "Search", "paris");
    until(&mut harness, |harness| harness.query_all_by_label_contains("Paris").next().is_some());
    write(&mut harness, "Search", " ");
    harness.run_steps(3);
    click_map(&mut harness, -111.7, 35.2);
    let place = harness.state().model().place.clone();
    // A point of the map is three quarters of a degree.
    assert!((place.longitude_deg + 111.7).abs() < 0.5 && (place.latitude_deg - 35.2).abs() < 0.5);
    assert_eq!(place.time_zone.as_deref(), Some("America/Phoenix"));
    let name = place.name.unwrap();
    assert!(name.contains("° N 111.") && name.ends_with("° W"), "{name}");
    assert!(place.height_m > 500.0, "{}", place.height_m);
    // No town is near in the southern Pacific.
    click_map(&mut harness, -120.0, -45.0);
    let place = &harness.state().model().place;
    assert_eq!((place.time_zone.as_deref(), place.height_m), (Some("Etc/GMT+8"), 0.0));
}

#[test]
fn coordinates_are_typed_and_nonsense_is_not_taken() {
    let mut harness = with_panel();
    write(&mut harness, "Latitude", "35 12 S");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert!((harness.state().model().place.latitude_deg + 35.2).abs() < 1e-9);
    write(&mut harness, "Elevation (m)", "2100");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().model().place.height_m, 2100.0);
    let before = harness.state().model().place.clone();
    for (label, text) in [
        ("Latitude", "91"),
        ("Longitude", "far"),
        ("Elevation (m)", "-9000"),
        ("Time zone", "Mars/Olympus"),
    ] {
        write(&mut harness, label, text);
        harness.get_by_label_contains("! ");
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        assert_eq!(harness.state().model().place, before, "{label}");
    }
    write(&mut harness, "Time zone", "Asia/Tokyo");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().model().place.time_zone.as_deref(), Some("Asia/Tokyo"));
}

#[test]
fn favourites_are_added_gone_to_and_removed() {
    let mut harness = with_panel();
    harness.get_by_label("Add this place").click();
    harness.run_steps(3);
    let greenwich = harness.state().model().place.clone();
    assert_eq!(harness.state().model().favourites, std::slice::from_ref(&greenwich));
    write(&mut harness, "Latitude", "-33");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_ne!(harness.state().model().place, greenwich);
    harness.get_by_label("Greenwich").click();
    harness.run_steps(3);
    assert_eq!(harness.state().model().place, greenwich);
    harness.get_by_label("Remove Greenwich").click();
    harness.run_steps(3);
    assert!(harness.state().model().favourites.is_empty());
}

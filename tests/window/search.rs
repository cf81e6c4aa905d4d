//! The search: by name to the middle of the sky.

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::app::App;
use nocturne::app::clock::Clock;
use nocturne::app::model::{Model, Panel};
use nocturne::app::pointing;
use nocturne::ephemeris::Body;
use nocturne::sky::Target;

use crate::info::{at, labels, until};
use crate::{settle, window};

fn searching(utc: &str) -> Harness<'static, App> {
    let mut harness = window(Model { clock: Clock::at(at(utc)), ..Model::default() });
    harness.key_press_modifiers(Modifiers::COMMAND, Key::F);
    harness.run_steps(3);
    harness
}

fn typed(harness: &mut Harness<'static, App>, text: &str) {
    harness.event(eframe::egui::Event::Text(text.to_owned()));
    harness.run_steps(2);
}

#[test]
fn what_is_typed_is_found_selected_and_brought_to_the_middle() {
    let mut harness = searching("2026-08-13T01:00Z");
    assert!(harness.get_by_role(Role::TextInput).is_focused());
    typed(&mut harness, "vega");
    assert!(labels(&harness).iter().any(|label| label.starts_with("Vega ")));
    // A letter is a letter here, and no key of the sky.
    assert!(!harness.state().model().overlays.equatorial_grid);
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    settle(&mut harness);
    let vega = Target::Star { hr: 7001 };
    let app = harness.state();
    assert_eq!(app.model().selected, Some(vega.clone()));
    assert_eq!(app.model().view.follow, Some(vega.clone()));
    assert!(!app.model().panels.is_open(Panel::Search), "it is up: there is nothing to say");
    let shown = app.shown().unwrap();
    let camera = &shown.setting.camera;
    let dir = pointing::towards(&vega, &shown.night).unwrap();
    let [x, y] = camera.pixel_from_apparent(dir).unwrap();
    let off = (x - f64::from(camera.width_px) / 2.0).hypot(y - f64::from(camera.height_px) / 2.0);
    assert!(off < 0.5, "{off} pixels from the middle");
}

#[test]
fn arrows_choose_and_letters_narrow() {
    let mut harness = searching("2026-08-13T01:00Z");
    typed(&mut harness, "ju");
    harness.key_press(Key::ArrowDown);
    harness.run_steps(2);
    let shown: Vec<String> =
        labels(&harness).into_iter().filter(|label| label.contains("   ")).collect();
    assert!(shown.len() > 1 && shown[0].starts_with("Jupiter"), "{shown:?}");
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    let selected = harness.state().model().selected.clone();
    assert!(selected.is_some() && selected != Some(Target::Body(Body::Jupiter)), "{selected:?}");
}

#[test]
fn what_is_below_the_horizon_is_said_with_its_rise() {
    // In the evening of this day Jupiter is near the Sun, which has set.
    let mut harness = searching("2026-08-12T22:30Z");
    typed(&mut harness, "Jupiter");
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    settle(&mut harness);
    assert!(harness.state().model().panels.is_open(Panel::Search));
    let said = until(&mut harness, |label| {
        label.starts_with("Jupiter is ") && label.contains("it rises at ") && !label.contains('…')
    });
    assert!(said.contains("° below the horizon") && said.contains("BST tomorrow"), "{said}");
    assert!(labels(&harness).iter().any(|label| label == "Go to its rise"));
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert!(!harness.state().model().panels.is_open(Panel::Search));
}

#[test]
fn an_empty_field_suggests_what_is_up() {
    let harness = searching("2026-08-13T01:00Z");
    let labels = labels(&harness);
    let has = |name: &str| labels.iter().any(|label| label.starts_with(&format!("{name}   ")));
    assert!(has("Saturn") && has("Vega") && has("Altair"), "{labels:?}");
    assert!(!has("Sun") && !has("Sirius") && !has("Jupiter"), "{labels:?}");
}

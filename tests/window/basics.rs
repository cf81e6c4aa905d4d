//! That there is a sky, and that keys and the hand move it.

use eframe::egui::{Key, Modifiers, pos2};
use nocturne::app::clock::Clock;
use nocturne::app::model::{Model, Panel};
use nocturne::time::{self, Instant};

use crate::{settle, window};

fn an_evening() -> Instant {
    time::to_instant(&time::parse("2026-08-13T04:30Z").unwrap(), None).unwrap()
}

fn standing() -> Model {
    Model { clock: Clock::at(an_evening()), ..Model::default() }
}

#[test]
fn a_sky_is_laid_for_the_window() {
    let harness = window(standing());
    let shown = harness.state().shown().expect("a sky");
    assert_eq!(shown.night.sky.instant, an_evening());
    assert_eq!(shown.setting.camera.width_px, 1280);
    assert!(!shown.plan.splats.is_empty());
}

#[test]
fn keys_turn_steps_and_switches() {
    let mut harness = window(standing());
    let before = harness.state().model().clone();
    harness.key_press(Key::ArrowRight);
    harness.key_press(Key::C);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::W);
    harness.key_press(Key::F1);
    settle(&mut harness);
    let after = harness.state().model();
    assert!((after.view.longitude_deg - 270.0).abs() < 1e-9);
    assert!(after.overlays.constellation_lines && !before.overlays.constellation_lines);
    assert!(after.panels.is_open(Panel::Help));
    harness.key_press(Key::Equals);
    harness.run_steps(2);
    let days = harness.state().model().clock.instant.tt.jd() - an_evening().tt.jd();
    assert!((days - 1.0).abs() < 1e-8, "{days}");
}

#[test]
fn a_hand_drags_the_sky_along() {
    let mut harness = window(standing());
    let before = harness.state().model().view.longitude_deg;
    harness.drag_at(pos2(600.0, 300.0));
    harness.run_steps(1);
    harness.hover_at(pos2(700.0, 300.0));
    harness.run_steps(2);
    let after = harness.state().model().view.longitude_deg;
    let turned = before - after;
    // A field of 90 degrees over 1280 points.
    assert!((5.0..12.0).contains(&turned), "{turned}");
}

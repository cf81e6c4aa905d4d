//! How tests use the controls of panels, by the names that screen readers tell.

use eframe::egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::app::App;
use nocturne::app::model::{Model, Panel};

use crate::window_of;

/// A window with one panel open, on a night that stands still.
pub fn with_panel(panel: Panel, mut model: Model) -> Harness<'static, App> {
    let evening = nocturne::time::parse("2026-08-13T04:30Z").expect("a time");
    let instant = nocturne::time::to_instant(&evening, None).expect("an instant");
    model.clock = nocturne::app::clock::Clock::at(instant);
    model.panels.set(panel, true);
    let mut harness = window_of(model, [1280.0, 1400.0]);
    harness.run_steps(3);
    harness
}

/// Presses a button.
pub fn press(harness: &mut Harness<App>, name: &str) {
    harness.get_by_role_and_label(Role::Button, name).click_accesskit();
    harness.run_steps(3);
}

/// Presses a check box.
pub fn switch(harness: &mut Harness<App>, name: &str) {
    harness.get_by_role_and_label(Role::CheckBox, name).click_accesskit();
    harness.run_steps(3);
}

/// Gives a slider a value.
pub fn set(harness: &mut Harness<App>, name: &str, value: f64) {
    harness.get_by_role_and_label(Role::Slider, name).set_value_accesskit(value);
    harness.run_steps(3);
}

/// Gives the number beside a slider a value.
pub fn enter(harness: &mut Harness<App>, name: &str, value: f64) {
    harness.get_by_role_and_label(Role::SpinButton, name).set_value_accesskit(value);
    harness.run_steps(3);
}

/// Opens a list and takes one of it.
pub fn choose(harness: &mut Harness<App>, name: &str, one: &str) {
    harness.get_by_role_and_label(Role::ComboBox, name).click_accesskit();
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, one).click_accesskit();
    harness.run_steps(3);
}

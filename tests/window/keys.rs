//! Keys open and close panels, and switch what the sheet says.

use eframe::egui::{Key, Modifiers};
use nocturne::app::action::Action;
use nocturne::app::keys;
use nocturne::app::model::{Model, Panel};

use crate::window;

#[test]
fn every_panel_has_a_key_and_escape_closes_it() {
    let mut harness = window(Model::default());
    for panel in Panel::ALL {
        let groups = keys::groups();
        let mut all = groups.iter().flat_map(|group| &group.bindings);
        let opens = all.find(|binding| binding.action == Action::TogglePanel(panel));
        let shortcut = opens.unwrap_or_else(|| panic!("{panel:?} has no key")).shortcut;
        harness.key_press_modifiers(shortcut.modifiers, shortcut.logical_key);
        harness.run_steps(3);
        assert!(harness.state().model().panels.is_open(panel), "{panel:?}");
        // The first may leave a field that is written in.
        for _ in 0..2 {
            if harness.state().model().panels.is_open(panel) {
                harness.key_press(Key::Escape);
                harness.run_steps(3);
            }
        }
        assert!(!harness.state().model().panels.is_open(panel), "{panel:?}");
    }
}

#[test]
fn keys_switch_layers_and_light() {
    let mut harness = window(Model::default());
    for binding in keys::groups().iter().flat_map(|group| &group.bindings) {
        let Action::Toggle(layer) = binding.action else { continue };
        let mut before = harness.state().model().clone();
        let shortcut = binding.shortcut;
        harness.key_press_modifiers(shortcut.modifiers, shortcut.logical_key);
        harness.run_steps(2);
        let mut after = harness.state().model().clone();
        assert_ne!(*layer.switch(&mut before), *layer.switch(&mut after), "{layer:?}");
    }
    harness.key_press_modifiers(Modifiers::COMMAND, Key::N);
    harness.key_press(Key::R);
    harness.run_steps(2);
    let model = harness.state().model();
    assert!(model.display.red && model.uses_camera);
}

#[test]
fn question_mark_opens_the_sheet() {
    let mut harness = window(Model::default());
    harness.key_press_modifiers(Modifiers::SHIFT, Key::Slash);
    harness.run_steps(3);
    assert!(harness.state().model().panels.is_open(Panel::Help));
}

//! The sheet of keys.

use eframe::egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::app::App;
use nocturne::app::keys;
use nocturne::app::model::{Model, Panel};

use crate::controls::with_panel;

fn words(harness: &Harness<App>) -> Vec<String> {
    harness.query_all_by_role(Role::Label).filter_map(|node| node.value()).collect()
}

#[test]
fn all_keys_stand_on_the_sheet() {
    let harness = with_panel(Panel::Help, Model::default());
    let told = words(&harness);
    for group in keys::groups() {
        assert!(told.iter().any(|words| words == group.name), "{}", group.name);
        for binding in &group.bindings {
            assert!(told.iter().any(|words| words == binding.words), "{}", binding.words);
        }
    }
    assert!(told.iter().any(|words| words == "Wheel"));
}

#[test]
fn keys_are_found_by_words() {
    let mut harness = with_panel(Panel::Help, Model::default());
    harness.get_by_role_and_label(Role::TextInput, "Find a key").set_text_value_accesskit("lunat");
    harness.run_steps(3);
    let told = words(&harness);
    assert!(told.iter().any(|words| words == "A lunation on"), "{told:?}");
    assert!(!told.iter().any(|words| words == "Now" || words == "Turn left"), "{told:?}");
    harness.get_by_role_and_label(Role::TextInput, "Find a key").set_text_value_accesskit("xyzzy");
    harness.run_steps(3);
    assert!(words(&harness).iter().any(|words| words.contains("xyzzy")));
}

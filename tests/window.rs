//! The window by its controls: what a person clicks and types, and what comes of it. No graphics adapter
//! is needed: there are lines and words alone.
#![cfg(feature = "app")]

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::app::model::Model;
use nocturne::app::state::StateFile;
use nocturne::app::{App, Options};
use nocturne::catalog::Catalogs;

#[path = "window/air.rs"]
mod air;
#[path = "window/basics.rs"]
mod basics;
#[path = "window/controls.rs"]
mod controls;
#[path = "window/export.rs"]
mod export;
#[path = "window/help.rs"]
mod help;
#[path = "window/info.rs"]
mod info;
#[path = "window/inspector.rs"]
mod inspector;
#[path = "window/keys.rs"]
mod keys;
#[path = "window/layers.rs"]
mod layers;
#[path = "window/monkey.rs"]
mod monkey;
#[path = "window/overlays.rs"]
mod overlays;
#[path = "window/panels.rs"]
mod panels;
#[path = "window/place.rs"]
mod place;
#[path = "window/search.rs"]
mod search;
#[path = "window/snapshots.rs"]
mod snapshots;
#[path = "window/state.rs"]
mod state;
#[path = "window/time.rs"]
mod time;
#[path = "window/viewer.rs"]
mod viewer;

/// A window of 1280 by 720 points on a model, its first sky laid.
pub fn window(model: Model) -> Harness<'static, App> {
    window_of(model, [1280.0, 720.0])
}

/// The same of a size.
pub fn window_of(model: Model, size: [f32; 2]) -> Harness<'static, App> {
    let catalogs = Catalogs::locate(None).expect("the catalogues are there");
    let mut harness = Harness::builder().with_size(size).build_eframe(|creation| {
        let state = StateFile::at(None);
        App::new(&creation.egui_ctx, Options::default(), model, state, catalogs, None)
    });
    settle(&mut harness);
    harness
}

/// Goes on until the sky that is wished for is there.
pub fn settle(harness: &mut Harness<App>) {
    for _ in 0..4 {
        harness.run_steps(2);
        harness.state().wait();
    }
    harness.run_steps(2);
}

/// Goes on until something has happened beside the window; a minute is more than enough.
pub fn until(harness: &mut Harness<App>, has_happened: impl Fn(&Harness<App>) -> bool) {
    for _ in 0..3000 {
        harness.run_steps(1);
        if has_happened(harness) {
            harness.run_steps(2);
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    panic!("it has not happened; there is {:?}", info::labels(harness));
}

/// Writes into a field in place of what is in it, and stays there.
pub fn write(harness: &mut Harness<App>, label: &str, text: &str) {
    let field = harness.get_by_role_and_label(Role::TextInput, label);
    field.focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(1);
    harness.get_by_role_and_label(Role::TextInput, label).type_text(text);
    harness.run_steps(2);
}

//! The inspector tells what is known of the picture that is seen.

use eframe::egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::app::App;
use nocturne::app::model::{Model, Panel};

use crate::controls::with_panel;

fn words(harness: &Harness<App>) -> Vec<String> {
    harness.query_all_by_role(Role::Label).filter_map(|node| node.value()).collect()
}

#[test]
fn it_tells_times_accuracy_and_what_was_drawn() {
    let harness = with_panel(Panel::Inspector, Model::default());
    for part in ["Sky", "Laying", "Drawing"] {
        let bar = harness
            .query_all_by_role(Role::ProgressIndicator)
            .find(|node| format!("{node:?}").contains(&format!("{part} ")));
        assert!(bar.is_some(), "{part}");
    }
    let told = words(&harness);
    let has = |part: &str| told.iter().any(|words| words.contains(part));
    assert!(has("a second") && has("MiB"), "{told:?}");
    assert!(has("within") && has("Jupiter"), "{told:?}");
    let shown = harness.state().shown().expect("a sky");
    for entry in &shown.ledger.entries {
        assert!(has(&format!("{}: {}", entry.layer, entry.drawn)), "{}", entry.layer);
        for (reason, many) in &entry.skipped {
            assert!(has(&format!("{many} left out: {reason}")), "{reason}");
        }
    }
    assert!(!shown.ledger.entries.is_empty());
}

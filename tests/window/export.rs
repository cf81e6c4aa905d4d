//! The panel of pictures for files.

use egui_kittest::kittest::Queryable;
use nocturne::app::model::{Model, Panel};

use crate::controls::{choose, press, set, with_panel};

#[test]
fn pictures_and_scenes_are_asked_for() {
    let mut harness = with_panel(Panel::Export, Model::default());
    let before = harness.state().model().clone();
    choose(&mut harness, "File", "OpenEXR, light in cd/m²");
    choose(&mut harness, "Size", "Own size");
    set(&mut harness, "Width", 640.0);
    // What is asked for is of the picture, not of the sky that is seen.
    assert_eq!(*harness.state().model(), before);
    press(&mut harness, "Copy the scene");
    // In the bar and in the panel.
    assert_eq!(harness.query_all_by_label_contains("clipboard").count(), 2);
}

//! The panel of the layers: switches, the view, the size of text.

use eframe::egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use nocturne::app::App;
use nocturne::app::action::Layer;
use nocturne::app::model::{Model, Overlays, Panel};
use nocturne::app::view::Mount;
use nocturne::camera::Projection;
use nocturne::scene::Layers;

use crate::controls::{choose, press, set, switch, with_panel};

fn opened() -> Harness<'static, App> {
    with_panel(Panel::Layers, Model::default())
}

#[test]
fn each_layer_is_switched_by_its_name() {
    let mut harness = opened();
    for layer in Layer::ALL {
        let mut before = harness.state().model().clone();
        switch(&mut harness, layer.name());
        let mut after = harness.state().model().clone();
        assert_ne!(*layer.switch(&mut before), *layer.switch(&mut after), "{layer:?}");
    }
    for name in ["Sun", "Moon"] {
        switch(&mut harness, name);
    }
    let layers = &harness.state().model().layers;
    assert!(!layers.sun && !layers.moon);
}

#[test]
fn everything_and_as_usual() {
    let mut harness = opened();
    switch(&mut harness, "Faintest stars");
    assert_eq!(harness.state().model().layers.magnitude_limit, Some(6.5));
    set(&mut harness, "Faintest stars", 4.0);
    assert_eq!(harness.state().model().layers.magnitude_limit, Some(4.0));
    press(&mut harness, "Everything");
    let mut model = harness.state().model().clone();
    assert!(Layer::ALL.iter().all(|layer| *layer.switch(&mut model)));
    assert_eq!(model.layers.magnitude_limit, None);
    press(&mut harness, "As usual");
    let model = harness.state().model();
    assert_eq!((&model.layers, model.overlays), (&Layers::default(), Overlays::default()));
}

#[test]
fn keys_stand_beside_the_layers() {
    let harness = opened();
    for key in ["A", "C", "Z", "Alt+G"] {
        assert!(
            harness.query_all_by_role(Role::Label).any(|node| node.value().as_deref() == Some(key))
        );
    }
}

#[test]
fn the_view_turns_and_zooms() {
    let mut harness = opened();
    choose(&mut harness, "Projection", "Perspective");
    assert_eq!(harness.state().model().view.projection, Projection::Perspective);
    set(&mut harness, "Field of view", 12.0);
    assert!((harness.state().model().view.field_deg - 12.0).abs() < 1e-9);
    choose(&mut harness, "Mount", "Equatorial");
    assert_eq!(harness.state().model().view.mount, Mount::Equatorial);
    choose(&mut harness, "Mount", "Altazimuth");
    for (words, azimuth_deg) in
        [("Look east", 90.0), ("Look south", 180.0), ("Look west", 270.0), ("Look north", 0.0)]
    {
        press(&mut harness, words);
        let off_deg = (harness.state().model().view.longitude_deg - azimuth_deg + 180.0)
            .rem_euclid(360.0)
            - 180.0;
        assert!(off_deg.abs() < 1e-6, "{words}: {off_deg}");
    }
    press(&mut harness, "Zenith");
    assert!(harness.state().model().view.latitude_deg > 89.0);
}

#[test]
fn text_grows_and_shrinks() {
    let mut harness = opened();
    press(&mut harness, "Larger text");
    assert!((harness.state().model().zoom - 1.1).abs() < 1e-5);
    press(&mut harness, "Usual text");
    assert!((harness.state().model().zoom - 1.0).abs() < 1e-5);
    press(&mut harness, "Smaller text");
    assert!(harness.state().model().zoom < 0.95);
}

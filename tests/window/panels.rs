//! What all panels have in common: names, room, colours.

use eframe::egui::accesskit::Role;
use eframe::egui::epaint::{Mesh, Primitive};
use eframe::egui::{Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use nocturne::app::App;
use nocturne::app::action::Layer;
use nocturne::app::model::{Model, Overlays, Panel, Panels};

use crate::controls::{press, with_panel};
use crate::{settle, window_of};

/// What a user can use, or is told by.
const USED: [Role; 10] = [
    Role::Button,
    Role::CheckBox,
    Role::RadioButton,
    Role::Slider,
    Role::SpinButton,
    Role::ComboBox,
    Role::TextInput,
    Role::DisclosureTriangle,
    Role::ProgressIndicator,
    Role::Window,
];

fn all_open(model: Model) -> Model {
    let mut panels = Panels::default();
    for panel in Panel::ALL {
        panels.set(panel, true);
    }
    Model { panels, ..model }
}

#[test]
fn every_control_has_a_name() {
    for uses_camera in [false, true] {
        for panel in Panel::ALL {
            let harness = with_panel(panel, Model { uses_camera, ..Model::default() });
            let root = harness.root();
            let nameless: Vec<String> = root
                .children_recursive()
                .filter(|node| USED.contains(&node.accesskit_node().role()))
                .filter(|node| {
                    node.accesskit_node().label().is_none_or(|name| name.trim().is_empty())
                })
                .map(|node| format!("{node:?}"))
                .collect();
            assert!(nameless.is_empty(), "{panel:?}: {nameless:#?}");
        }
    }
}

#[test]
fn panels_fit_into_any_window() {
    for (size, zoom) in [
        ([320.0, 240.0], 1.0),
        ([320.0, 240.0], 3.0),
        ([1280.0, 720.0], 3.0),
        ([3840.0, 2160.0], 1.0),
        ([3840.0, 2160.0], 0.6),
    ] {
        let mut harness = window_of(all_open(Model { zoom, ..Model::default() }), size);
        harness.run_steps(4);
        for panel in Panel::ALL {
            assert!(harness.state().model().panels.is_open(panel), "{size:?}, {zoom}");
        }
    }
}

fn window_rects(harness: &Harness<App>) -> Vec<Rect> {
    harness.query_all_by_role(Role::Window).map(|node| node.rect()).collect()
}

#[test]
fn panels_stay_in_a_window_that_shrinks_and_off_its_middle() {
    let mut harness = window_of(all_open(Model::default()), [1600.0, 1000.0]);
    harness.run_steps(4);
    let rects = window_rects(&harness);
    assert!(rects.len() >= 6, "{rects:?}");
    for rect in &rects {
        assert!(!rect.contains(eframe::egui::pos2(800.0, 500.0)), "{rect:?}");
    }
    harness.set_size(vec2(700.0, 500.0));
    harness.run_steps(6);
    let room = Rect::from_min_size(eframe::egui::Pos2::ZERO, vec2(700.0, 500.0)).expand(1.0);
    for rect in window_rects(&harness) {
        assert!(room.contains_rect(rect), "{rect:?}");
    }
}

#[test]
fn a_window_that_is_all_bar_is_no_end_of_it() {
    let overlays = Overlays {
        equatorial_grid: true,
        constellation_lines: true,
        ecliptic: true,
        ..Overlays::default()
    };
    let model = all_open(Model { overlays, ..Model::default() });
    let mut harness = window_of(model, [640.0, 400.0]);
    for size in [vec2(640.0, 30.0), vec2(30.0, 400.0), vec2(1.0, 1.0), vec2(640.0, 400.0)] {
        harness.set_size(size);
        settle(&mut harness);
    }
    assert!(harness.state().overlays().corners() > 0);
}

#[test]
fn a_panel_closes_by_its_button() {
    let mut harness = with_panel(Panel::Layers, Model::default());
    press(&mut harness, "Close window");
    assert!(!harness.state().model().panels.is_open(Panel::Layers));
}

/// The colours of all that is drawn.
fn drawn(harness: &Harness<App>) -> Vec<[u8; 4]> {
    let output = harness.output();
    let shapes = output.shapes.clone();
    let primitives = harness.ctx.tessellate(shapes, output.pixels_per_point);
    let meshes = primitives.iter().filter_map(|clipped| match &clipped.primitive {
        Primitive::Mesh(mesh) => Some(mesh),
        Primitive::Callback(_) => None,
    });
    let colours = |mesh: &Mesh| -> Vec<[u8; 4]> {
        mesh.vertices.iter().map(|vertex| vertex.color.to_array()).collect()
    };
    meshes.flat_map(colours).collect()
}

#[test]
fn red_light_is_red_on_every_panel() {
    let mut model = all_open(Model::default());
    for layer in Layer::ALL {
        *layer.switch(&mut model) = true;
    }
    model.display.red = true;
    let mut harness = window_of(model, [1600.0, 1000.0]);
    harness.run_steps(4);
    let colours = drawn(&harness);
    assert!(colours.iter().any(|[red, ..]| *red > 150));
    let other: Vec<_> =
        colours.iter().filter(|[_, green, blue, _]| *green > 0 || *blue > 0).collect();
    assert!(other.is_empty(), "{} of {}: {:?}", other.len(), colours.len(), other.first());
    harness.state_mut().model_mut().display.red = false;
    harness.run_steps(4);
    assert!(drawn(&harness).iter().any(|[_, green, ..]| *green > 150));
}

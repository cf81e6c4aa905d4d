//! What is drawn, and how the window looks at it.

use eframe::egui::{Ui, vec2};

use crate::app::action::{Action, Layer, cardinal, zenith};
use crate::app::model::Overlays;
use crate::app::view::{Mount, WIDEST_FIELD_DEG};
use crate::camera::{NARROWEST_FIELD_DEG, Projection};
use crate::scene::Layers;

use super::Desk;
use super::controls::{Scale, button, choice, key_of, number, optional, section, switch};

/// Layers that belong together.
const GROUPS: [(&str, &[Layer]); 4] = [
    (
        "Light",
        &[
            Layer::Atmosphere,
            Layer::Ground,
            Layer::Stars,
            Layer::Planets,
            Layer::MilkyWay,
            Layer::ZodiacalLight,
            Layer::Airglow,
            Layer::TownGlow,
        ],
    ),
    (
        "Names",
        &[
            Layer::StarNames,
            Layer::PlanetNames,
            Layer::ConstellationNames,
            Layer::DeepSky,
            Layer::MoonFeatures,
            Layer::CardinalPoints,
        ],
    ),
    (
        "Lines",
        &[
            Layer::ConstellationLines,
            Layer::ConstellationBoundaries,
            Layer::Horizon,
            Layer::Meridian,
            Layer::CelestialEquator,
            Layer::Ecliptic,
            Layer::PlanetTrails,
        ],
    ),
    (
        "Grids",
        &[
            Layer::AzimuthalGrid,
            Layer::EquatorialGrid,
            Layer::J2000Grid,
            Layer::EclipticGrid,
            Layer::GalacticGrid,
        ],
    ),
];

/// Magnitude of the faintest stars, when somebody first asks for a limit.
const USUAL_LIMIT: f64 = 6.5;
const LIMIT: Scale = Scale::even(-2.0, 16.0, "").within(-30.0, 100.0);
/// Text larger or smaller by such a factor.
const TEXT_STEP: f32 = 1.1;
/// Width of a switch with its key, points.
const SWITCH_WIDTH: f32 = 200.0;

const PROJECTIONS: [(Projection, &str); 5] = [
    (Projection::Stereographic, "Stereographic"),
    (Projection::Perspective, "Perspective"),
    (Projection::Equidistant, "Equidistant"),
    (Projection::EqualArea, "Equal-area"),
    (Projection::Equirectangular, "Equirectangular"),
];
const MOUNTS: [(Mount, &str); 2] =
    [(Mount::Altazimuth, "Altazimuth"), (Mount::Equatorial, "Equatorial")];
const WAYS: [(&str, &str, f64); 4] = [
    ("N", "Look north", 0.0),
    ("E", "Look east", 90.0),
    ("S", "Look south", 180.0),
    ("W", "Look west", 270.0),
];

/// Switches of the layers, and the view.
#[derive(Default)]
pub struct LayersPanel {}

impl LayersPanel {
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        ui.horizontal_wrapped(|ui| {
            if button(ui, "Everything", "Switches all layers on") {
                everything(desk);
            }
            if button(ui, "As usual", "Switches the layers as they are at first") {
                (desk.model.layers, desk.model.overlays) = (Layers::default(), Overlays::default());
            }
        });
        for (title, layers) in GROUPS {
            section(ui, title, |ui| {
                for layer in layers {
                    layer_switch(ui, desk, *layer);
                }
                if title == "Light" {
                    let layers = &mut desk.model.layers;
                    switch(ui, "Sun", &mut layers.sun);
                    switch(ui, "Moon", &mut layers.moon);
                    let limit = &mut layers.magnitude_limit;
                    optional(ui, "Faintest stars", limit, USUAL_LIMIT, "all that are seen", &LIMIT);
                }
            });
        }
        section(ui, "View", |ui| view(ui, desk));
    }
}

fn everything(desk: &mut Desk) {
    for layer in Layer::ALL {
        *layer.switch(desk.model) = true;
    }
    let layers = &mut desk.model.layers;
    (layers.sun, layers.moon, layers.magnitude_limit) = (true, true, None);
}

fn layer_switch(ui: &mut Ui, desk: &mut Desk, layer: Layer) {
    let action = Action::Toggle(layer);
    let key = key_of(ui.ctx(), desk.keys, &action);
    ui.horizontal(|ui| {
        let height = ui.spacing().interact_size.y;
        ui.allocate_ui(vec2(SWITCH_WIDTH, height), |ui| {
            ui.set_min_width(SWITCH_WIDTH);
            let mut is_on = *layer.switch(desk.model);
            if switch(ui, layer.name(), &mut is_on) {
                desk.actions.push(action);
            }
        });
        if !key.is_empty() {
            ui.weak(key);
        }
    });
}

fn view(ui: &mut Ui, desk: &mut Desk) {
    let view = &desk.model.view;
    let mut projection = view.projection;
    if choice(ui, "Projection", &mut projection, &PROJECTIONS) {
        desk.actions.push(Action::SetProjection(projection));
    }
    let mut mount = view.mount;
    if choice(ui, "Mount", &mut mount, &MOUNTS) {
        desk.actions.push(Action::ToggleMount);
    }
    let mut field_deg = view.field_deg;
    let widest_deg = view.projection.widest_deg().min(WIDEST_FIELD_DEG);
    let scale = Scale::factors(NARROWEST_FIELD_DEG, widest_deg, "°");
    if number(ui, "Field of view", &mut field_deg, &scale) {
        desk.actions.push(Action::SetField(field_deg));
    }
    ui.horizontal_wrapped(|ui| {
        ui.label("Look");
        for (letter, words, azimuth_deg) in WAYS {
            let way = ui.button(letter).on_hover_text(words);
            super::controls::name(&way, words);
            if way.clicked() {
                desk.actions.push(cardinal(azimuth_deg));
            }
        }
        if button(ui, "Zenith", "Look straight up") {
            desk.actions.push(zenith());
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.label(format!("Text {:.0} %", desk.model.zoom * 100.0));
        if button(ui, "Smaller text", "Text and buttons a tenth smaller") {
            desk.actions.push(Action::ScaleText(1.0 / TEXT_STEP));
        }
        if button(ui, "Larger text", "Text and buttons a tenth larger") {
            desk.actions.push(Action::ScaleText(TEXT_STEP));
        }
        if button(ui, "Usual text", "Text and buttons as the system has them") {
            desk.actions.push(Action::ScaleText(1.0 / desk.model.zoom));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_layer_has_one_switch() {
        let shown: Vec<Layer> = GROUPS.iter().flat_map(|(_, layers)| *layers).copied().collect();
        assert_eq!(shown.len(), Layer::ALL.len());
        for layer in Layer::ALL {
            assert!(shown.contains(&layer), "{layer:?}");
        }
    }
}

//! Keys, as users of planetariums know them, and the sheet that lists them.

use eframe::egui::{Context, Key, KeyboardShortcut, Modifiers};

use super::action::{Action, Layer, cardinal, zenith};
use super::clock::Step;
use super::model::Panel;

/// A key, and what it does.
pub struct Binding {
    pub shortcut: KeyboardShortcut,
    pub action: Action,
    pub words: &'static str,
}

/// Bindings that belong together.
pub struct Group {
    pub name: &'static str,
    pub bindings: Vec<Binding>,
}

const NONE: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
const CTRL: Modifiers = Modifiers::COMMAND;
const ALT: Modifiers = Modifiers::ALT;
/// Share of the field that an arrow key turns by.
const TURN: f64 = 0.08;
/// What moves and presses a control.
const MOVING: [Key; 7] = [
    Key::Space,
    Key::ArrowLeft,
    Key::ArrowRight,
    Key::ArrowUp,
    Key::ArrowDown,
    Key::PageUp,
    Key::PageDown,
];
/// Powers of e of the field that a key zooms by.
const ZOOM: f64 = 0.35;

/// All keys, in groups, in the order of the sheet.
pub fn groups() -> Vec<Group> {
    let bind = |modifiers, key, action, words| Binding {
        shortcut: KeyboardShortcut::new(modifiers, key),
        action,
        words,
    };
    let layer = |key, layer: Layer| bind(NONE, key, Action::Toggle(layer), layer.name());
    let panel = |key, panel: Panel| bind(NONE, key, Action::TogglePanel(panel), panel.title());
    vec![
        Group {
            name: "Time",
            bindings: vec![
                bind(NONE, Key::J, Action::Slower, "Slower, then back in time"),
                bind(NONE, Key::K, Action::RealTime, "Real time"),
                bind(NONE, Key::L, Action::Faster, "Faster"),
                bind(NONE, Key::Num7, Action::PlayOrPause, "Pause or go on"),
                bind(NONE, Key::Num8, Action::Now, "Now"),
                bind(NONE, Key::Equals, Action::Step(Step::Day, 1), "A day on"),
                bind(NONE, Key::Minus, Action::Step(Step::Day, -1), "A day back"),
                bind(CTRL, Key::Equals, Action::Step(Step::Hour, 1), "An hour on"),
                bind(CTRL, Key::Minus, Action::Step(Step::Hour, -1), "An hour back"),
                bind(SHIFT, Key::Equals, Action::Step(Step::Minute, 1), "A minute on"),
                bind(SHIFT, Key::Minus, Action::Step(Step::Minute, -1), "A minute back"),
                bind(ALT, Key::Equals, Action::Step(Step::SiderealDay, 1), "A sidereal day on"),
                bind(ALT, Key::Minus, Action::Step(Step::SiderealDay, -1), "A sidereal day back"),
                bind(NONE, Key::CloseBracket, Action::Step(Step::Week, 1), "A week on"),
                bind(NONE, Key::OpenBracket, Action::Step(Step::Week, -1), "A week back"),
                bind(ALT, Key::CloseBracket, Action::Step(Step::Lunation, 1), "A lunation on"),
                bind(ALT, Key::OpenBracket, Action::Step(Step::Lunation, -1), "A lunation back"),
            ],
        },
        Group {
            name: "View",
            bindings: vec![
                bind(NONE, Key::ArrowLeft, Action::Turn([-TURN, 0.0]), "Turn left"),
                bind(NONE, Key::ArrowRight, Action::Turn([TURN, 0.0]), "Turn right"),
                bind(NONE, Key::ArrowUp, Action::Turn([0.0, TURN]), "Turn up"),
                bind(NONE, Key::ArrowDown, Action::Turn([0.0, -TURN]), "Turn down"),
                bind(NONE, Key::PageUp, Action::Zoom(-ZOOM), "Zoom in"),
                bind(NONE, Key::PageDown, Action::Zoom(ZOOM), "Zoom out"),
                bind(SHIFT, Key::N, cardinal(0.0), "Look north"),
                bind(SHIFT, Key::E, cardinal(90.0), "Look east"),
                bind(SHIFT, Key::S, cardinal(180.0), "Look south"),
                bind(SHIFT, Key::W, cardinal(270.0), "Look west"),
                bind(SHIFT, Key::Z, zenith(), "Look to the zenith"),
                bind(NONE, Key::Space, Action::FollowSelected, "Follow what is selected"),
                bind(NONE, Key::T, Action::StopFollowing, "Stop following"),
                bind(CTRL, Key::M, Action::ToggleMount, "Equatorial or azimuthal mount"),
                bind(CTRL, Key::P, Action::NextProjection, "Next projection"),
            ],
        },
        Group {
            name: "Layers",
            bindings: vec![
                layer(Key::A, Layer::Atmosphere),
                layer(Key::G, Layer::Ground),
                layer(Key::S, Layer::Stars),
                layer(Key::M, Layer::MilkyWay),
                layer(Key::C, Layer::ConstellationLines),
                layer(Key::B, Layer::ConstellationBoundaries),
                layer(Key::V, Layer::ConstellationNames),
                bind(ALT, Key::S, Action::Toggle(Layer::StarNames), Layer::StarNames.name()),
                layer(Key::P, Layer::PlanetNames),
                layer(Key::D, Layer::DeepSky),
                layer(Key::F, Layer::MoonFeatures),
                layer(Key::Z, Layer::AzimuthalGrid),
                layer(Key::E, Layer::EquatorialGrid),
                bind(ALT, Key::E, Action::Toggle(Layer::J2000Grid), Layer::J2000Grid.name()),
                bind(
                    ALT,
                    Key::Comma,
                    Action::Toggle(Layer::EclipticGrid),
                    Layer::EclipticGrid.name(),
                ),
                bind(ALT, Key::G, Action::Toggle(Layer::GalacticGrid), Layer::GalacticGrid.name()),
                layer(Key::Comma, Layer::Ecliptic),
                layer(Key::Period, Layer::CelestialEquator),
                layer(Key::Semicolon, Layer::Meridian),
                layer(Key::H, Layer::Horizon),
                layer(Key::Q, Layer::CardinalPoints),
                bind(
                    SHIFT,
                    Key::T,
                    Action::Toggle(Layer::PlanetTrails),
                    Layer::PlanetTrails.name(),
                ),
            ],
        },
        Group {
            name: "Panels",
            bindings: vec![
                panel(Key::F1, Panel::Help),
                bind(SHIFT, Key::Slash, Action::TogglePanel(Panel::Help), Panel::Help.title()),
                panel(Key::F2, Panel::Viewer),
                panel(Key::F3, Panel::Search),
                bind(CTRL, Key::F, Action::TogglePanel(Panel::Search), Panel::Search.title()),
                panel(Key::F4, Panel::Layers),
                panel(Key::F5, Panel::Time),
                panel(Key::F6, Panel::Place),
                panel(Key::F7, Panel::Air),
                panel(Key::F8, Panel::Export),
                panel(Key::F12, Panel::Inspector),
                bind(NONE, Key::Escape, Action::Escape, "Close, or select nothing"),
            ],
        },
        Group {
            name: "Window",
            bindings: vec![
                bind(CTRL, Key::S, Action::Screenshot, "Save a picture"),
                bind(CTRL | SHIFT, Key::C, Action::CopyScene, "Copy the scene"),
                bind(NONE, Key::R, Action::ToggleCamera, "Eye or camera"),
                bind(CTRL, Key::N, Action::ToggleRedMode, "Red light"),
                bind(CTRL, Key::Period, Action::ScaleText(1.1), "Larger text"),
                bind(CTRL, Key::Comma, Action::ScaleText(1.0 / 1.1), "Smaller text"),
                bind(NONE, Key::F11, Action::ToggleFullScreen, "Full screen"),
                bind(CTRL, Key::Q, Action::Quit, "Quit"),
            ],
        },
    ]
}

/// What the keys that were pressed ask for; none while somebody writes. A control that has the focus keeps
/// the keys that move it.
pub fn pressed(ctx: &Context, groups: &[Group]) -> Vec<Action> {
    if ctx.text_edit_focused() {
        return Vec::new();
    }
    let is_taken = ctx.memory(|memory| memory.focused().is_some());
    let bindings = || groups.iter().flat_map(|group| &group.bindings);
    // Those with modifiers first: egui takes a key with more modifiers for the one with fewer.
    let mut order: Vec<&Binding> = bindings()
        .filter(|binding| !(is_taken && MOVING.contains(&binding.shortcut.logical_key)))
        .collect();
    let modifiers = |binding: &Binding| {
        let Modifiers { alt, shift, command, .. } = binding.shortcut.modifiers;
        [alt, shift, command].into_iter().filter(|down| *down).count()
    };
    order.sort_by_key(|binding| std::cmp::Reverse(modifiers(binding)));
    ctx.input_mut(|input| {
        let mut actions = Vec::new();
        for binding in order {
            while input.consume_shortcut(&binding.shortcut) {
                actions.push(binding.action.clone());
            }
        }
        actions
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things() {
        let groups = groups();
        let all: Vec<_> = groups.iter().flat_map(|group| &group.bindings).collect();
        for (n, one) in all.iter().enumerate() {
            for other in &all[n + 1..] {
                assert_ne!(one.shortcut, other.shortcut, "{} and {}", one.words, other.words);
            }
        }
    }
}

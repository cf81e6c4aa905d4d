//! A monkey at the window: keys, drags, zooms, sizes, dates and places without any sense, from a seed.

use eframe::egui::{
    Event, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, TouchPhase, pos2, vec2,
};
use egui_kittest::Harness;
use nocturne::app::App;
use nocturne::app::action::{Action, Layer};
use nocturne::app::keys;
use nocturne::app::model::{Model, Panel};
use nocturne::scene::ScenePlace;
use nocturne::sky::Target;
use nocturne::time::{Instant, JulianDate};

/// Its hands.
pub struct Monkey {
    state: u64,
    /// Of the window, points.
    pub size: [f32; 2],
}

impl Monkey {
    pub fn new(seed: u64) -> Monkey {
        Monkey { state: seed, size: [1280.0, 720.0] }
    }

    /// SplitMix64 (Steele, Lea & Flood 2014).
    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, many: usize) -> usize {
        (self.next() % many as u64) as usize
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn point(&mut self) -> Pos2 {
        let [width, height] = self.size.map(f64::from);
        pos2(self.between(-10.0, width + 10.0) as f32, self.between(-10.0, height + 10.0) as f32)
    }

    /// Does one thing to a window, and says what.
    pub fn act(&mut self, harness: &mut Harness<App>) -> String {
        match self.below(14) {
            0..=3 => self.press(harness),
            4 => self.click(harness),
            5 | 6 => self.drag(harness),
            7 => {
                let delta = vec2(0.0, self.between(-400.0, 400.0) as f32);
                harness.hover_at(self.point());
                harness.event(Event::MouseWheel {
                    unit: MouseWheelUnit::Point,
                    delta,
                    phase: TouchPhase::Move,
                    source: MouseWheelSource::Wheel,
                    modifiers: Modifiers::NONE,
                });
                format!("wheel {delta}")
            }
            8 => {
                self.size = [self.between(200.0, 1600.0), self.between(150.0, 1000.0)]
                    .map(|edge| edge.round() as f32);
                harness.set_size(self.size.into());
                format!("size {:?}", self.size)
            }
            9 => {
                // The years -4000 to 4000.
                let jd = self.between(260_058.0, 3_182_030.0);
                let Ok(instant) = Instant::from_tt(JulianDate::from_jd(jd)) else {
                    return format!("no instant {jd}");
                };
                self.have(harness, Action::SetInstant(instant))
            }
            10 => {
                let place = ScenePlace {
                    name: None,
                    latitude_deg: [90.0, -90.0, self.between(-90.0, 90.0)][self.below(3)],
                    longitude_deg: self.between(-180.0, 180.0),
                    height_m: self.between(-400.0, 9000.0),
                    time_zone: None,
                };
                self.have(harness, Action::GoTo(place))
            }
            11 => {
                let stars = ["HR 2491", "HR 424", "HR 9110"];
                let targets =
                    ["Sun", "Moon", "Jupiter", "Pluto", "Jupiter/Io", "Moon/Tycho", "M 31"];
                let all = [&stars[..], &targets, &["Constellation/Oct"]].concat();
                let target: Option<Target> = all[self.below(all.len())].parse().ok();
                self.have(harness, Action::Select(target));
                self.have(harness, Action::FollowSelected)
            }
            12 => {
                let field_deg = 10f64.powf(self.between(-4.0, 2.4));
                self.have(harness, Action::SetField(field_deg))
            }
            _ => match self.below(3) {
                0 => {
                    let layer = Layer::ALL[self.below(Layer::ALL.len())];
                    self.have(harness, Action::Toggle(layer))
                }
                1 => {
                    let panel = Panel::ALL[self.below(Panel::ALL.len())];
                    self.have(harness, Action::TogglePanel(panel))
                }
                _ => {
                    let words = ["sir", "-4712", "½ ∞", "m31", "Ω", "1e999", "NaN", "2026-02-30"];
                    let word = words[self.below(words.len())];
                    harness.event(Event::Text(word.to_owned()));
                    format!("text {word}")
                }
            },
        }
    }

    fn have(&mut self, harness: &mut Harness<App>, action: Action) -> String {
        let said = format!("{action:?}");
        let ctx = harness.ctx.clone();
        harness.state_mut().act(&ctx, action);
        said
    }

    fn press(&mut self, harness: &mut Harness<App>) -> String {
        let groups = keys::groups();
        let all: Vec<_> = groups.iter().flat_map(|group| &group.bindings).collect();
        let binding = all[self.below(all.len())];
        // It would write files, and go away.
        let is_sane = !matches!(binding.action, Action::Screenshot | Action::Quit);
        if is_sane {
            let shortcut = binding.shortcut;
            harness.key_press_modifiers(shortcut.modifiers, shortcut.logical_key);
        }
        binding.words.to_owned()
    }

    fn click(&mut self, harness: &mut Harness<App>) -> String {
        let point = self.point();
        harness.hover_at(point);
        for pressed in [true, false] {
            harness.event(Event::PointerButton {
                pos: point,
                button: PointerButton::Primary,
                pressed,
                modifiers: Modifiers::NONE,
            });
        }
        format!("click {point}")
    }

    fn drag(&mut self, harness: &mut Harness<App>) -> String {
        let (from, to) = (self.point(), self.point());
        harness.drag_at(from);
        harness.run_steps(1);
        harness.hover_at(to);
        harness.run_steps(1);
        harness.drop_at(to);
        format!("drag {from} {to}")
    }
}

/// What is no number in a model; none in a sound one.
pub fn nonsense(model: &Model) -> Option<String> {
    let view = &model.view;
    let numbers = [
        ("longitude", view.longitude_deg),
        ("latitude", view.latitude_deg),
        ("field", view.field_deg),
        ("rate", model.clock.rate),
        ("instant", model.clock.instant.tt.jd()),
        ("height", model.place.height_m),
    ];
    let bad = numbers.into_iter().find(|(_, number)| !number.is_finite());
    bad.map(|(what, number)| format!("{what} is {number}"))
}

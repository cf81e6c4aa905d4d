//! What the picture is made of, and what it cost.

use std::collections::VecDeque;

use eframe::egui::{Grid, ProgressBar, Ui};

use crate::app::sky::{Cost, Shown};
use crate::eye::limiting_magnitude::limiting_magnitude;
use crate::render::Made;
use crate::units::Angle;

use super::Desk;
use super::controls::{section, significant};

/// Frames of the window are counted over so long, seconds.
const COUNTED_S: f64 = 2.0;
/// Memory is looked up so often, seconds.
const MEMORY_S: f64 = 1.0;
/// Bars are full at this time, or at the longest part, milliseconds: a frame of 60 in a second.
const FULL_MS: f64 = 16.7;

/// What it counts from frame to frame.
#[derive(Default)]
pub struct InspectorPanel {
    /// The graphics adapter; none without one.
    pub adapter: Option<String>,
    /// When the last frames of the window were, seconds.
    frames_s: VecDeque<f64>,
    /// When memory was looked up, seconds; and how much it was, MiB.
    memory: Option<(f64, Option<f64>)>,
}

impl InspectorPanel {
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let now_s = ui.input(|input| input.time);
        self.count(now_s);
        section(ui, "Window", |ui| self.window(ui, now_s));
        if let Some(failure) = desk.failure {
            ui.colored_label(ui.visuals().warn_fg_color, failure);
        }
        let Some(shown) = desk.shown else {
            ui.label("There is no picture yet.");
            return;
        };
        section(ui, "Time of the picture", |ui| times(ui, shown));
        section(ui, "Viewer", |ui| viewer(ui, shown, desk));
        section(ui, "Accuracy", |ui| accuracy(ui, shown));
        section(ui, "Drawn and left out", |ui| ledger(ui, shown));
    }

    fn count(&mut self, now_s: f64) {
        self.frames_s.push_back(now_s);
        while self.frames_s.front().is_some_and(|first| now_s - first > COUNTED_S) {
            self.frames_s.pop_front();
        }
    }

    fn window(&mut self, ui: &mut Ui, now_s: f64) {
        let looked_up =
            self.memory.filter(|(then_s, _)| (0.0..MEMORY_S).contains(&(now_s - then_s)));
        let (_, memory_mib) =
            *self.memory.insert(looked_up.unwrap_or((now_s, crate::memory::resident_mib())));
        rows(ui, "window", |row| {
            let frames = self.frames_s.len() as f64 / COUNTED_S;
            row("Frames", format!("{frames:.0} a second"));
            let memory = memory_mib.map_or("not known".to_owned(), |mib| format!("{mib:.0} MiB"));
            row("Memory", memory);
            row("Adapter", self.adapter.clone().unwrap_or_else(|| "none".to_owned()));
        });
    }
}

fn times(ui: &mut Ui, shown: &Shown) {
    let Cost { night_ms, lay_ms, draw_ms } = shown.cost;
    let parts = [("Sky", night_ms), ("Laying", lay_ms), ("Drawing", draw_ms)];
    let passes = shown.passes.iter().map(|pass| (pass.pass.as_str(), pass.milliseconds));
    let longest = passes.clone().chain(parts).map(|(_, ms)| ms).fold(FULL_MS, f64::max);
    ui.label(format!("{:.1} ms on the thread of the sky", shown.cost.all_ms()));
    for (part, ms) in parts {
        bar(ui, part, ms, longest);
    }
    if shown.passes.is_empty() {
        ui.weak("The passes were not timed.");
        return;
    }
    let all_ms: f64 = passes.clone().map(|(_, ms)| ms).sum();
    ui.label(format!("{all_ms:.1} ms on the graphics adapter"));
    for (pass, ms) in passes {
        bar(ui, pass, ms, longest);
    }
}

fn bar(ui: &mut Ui, words: &str, ms: f64, longest: f64) {
    let share = (ms / longest).clamp(0.0, 1.0) as f32;
    ui.add(ProgressBar::new(share).text(format!("{words} {ms:.2} ms")));
}

fn viewer(ui: &mut Ui, shown: &Shown, desk: &Desk) {
    match &shown.made {
        None => {
            ui.weak("Nobody has looked: there is no adapter to draw on.");
        }
        Some(Made::Seen(seeing)) => rows(ui, "eye", |row| {
            row("Adapted to", format!("{} cd/m²", significant(seeing.adaptation_cd_m2)));
            row("Pupil", format!("{:.1} mm", seeing.pupil_mm));
            let eye = &desk.model.eye;
            let faintest = limiting_magnitude(seeing.adaptation_cd_m2, eye.field_factor);
            row("Faintest stars", format!("{faintest:.1} mag"));
            row("Exposure", format!("{:+.1} stops", eye.exposure_stops));
        }),
        Some(Made::Exposed(exposure)) => {
            ui.label(exposure.to_string());
        }
    }
}

fn accuracy(ui: &mut Ui, shown: &Shown) {
    let sky = &shown.night.sky;
    rows(ui, "accuracy", |row| {
        row("Asked for", angle(shown.setting.tolerance));
        let bodies = [("Sun", &sky.sun), ("Moon", &sky.moon.state)];
        for (body, state) in bodies {
            row(body, format!("{}, within {}", state.tier, angle(state.error_bound)));
        }
        for state in &sky.planets {
            row(
                &state.body.to_string(),
                format!("{}, within {}", state.tier, angle(state.error_bound)),
            );
        }
        let bound = crate::light::night::STAR_ERROR_BOUND;
        row("Stars", format!("within {}", angle(bound)));
    });
}

fn ledger(ui: &mut Ui, shown: &Shown) {
    for entry in &shown.ledger.entries {
        ui.strong(format!("{}: {}", entry.layer, entry.drawn));
        for how in &entry.how {
            ui.label(how);
        }
        for (reason, many) in &entry.skipped {
            ui.weak(format!("{many} left out: {reason}"));
        }
    }
}

/// A table of words and what is known.
fn rows(ui: &mut Ui, id: &str, write: impl FnOnce(&mut dyn FnMut(&str, String))) {
    Grid::new(id).num_columns(2).show(ui, |ui| {
        write(&mut |words, value| {
            ui.weak(words);
            ui.label(value);
            ui.end_row();
        });
    });
}

fn angle(angle: Angle) -> String {
    match angle.arcsec().abs() {
        arcsec if arcsec < 60.0 => format!("{} arcsec", significant(arcsec)),
        arcsec if arcsec < 3600.0 => format!("{} arcmin", significant(arcsec / 60.0)),
        arcsec => format!("{}°", significant(arcsec / 3600.0)),
    }
}

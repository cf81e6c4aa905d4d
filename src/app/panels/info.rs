//! What is known of what is selected; of empty sky, how bright it is and why.

pub mod facts;
pub mod measured;
pub mod written;

use std::sync::Arc;
use std::time::Duration;

use eframe::egui::text_selection::LabelSelectionState;
use eframe::egui::{self, Align2, Grid, Label, RichText, ScrollArea, Ui, Window};

use crate::app::action::{Action, Jump};
use crate::app::knowledge::{Daily, Day};
use crate::app::pointing;
use crate::app::sky::Shown;
use crate::frame::{Apparent, Dir};
use crate::light::night::Night;
use crate::sky::Target;
use crate::time::Instant;

use super::Desk;
use facts::Facts;

/// From the edges of the window, points.
const MARGIN: f32 = 8.0;
/// What is left free below for the bar, points.
const BELOW: f32 = 90.0;
/// What is being found out is looked for so often.
const WAIT: Duration = Duration::from_millis(100);
/// In place of what is being found out.
pub const WAITING: &str = "…";

/// The panel over the sky. It is there while something is selected or measured.
#[derive(Default)]
pub struct InfoPanel {
    measured: Option<Dir<Apparent>>,
    /// Of the picture and the target that they were made for.
    kept: Option<(Arc<Night>, Subject, Arc<Facts>)>,
    named: Option<(Target, Called)>,
}

/// The name of a target, what it is, and its other names with commas between.
pub type Called = (String, &'static str, String);

/// What it is about.
#[derive(Debug, Clone, PartialEq)]
enum Subject {
    Target(Target),
    Sky(Dir<Apparent>),
}

impl InfoPanel {
    /// Tells how bright the sky is there, from now on.
    pub fn measure(&mut self, dir: Dir<Apparent>) {
        self.measured = Some(dir);
    }

    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let Some(shown) = desk.shown else { return };
        let selects = |action: &Action| matches!(action, Action::Select(_));
        let escapes = desk.actions.contains(&Action::Escape) && desk.model.panels.are_closed();
        if desk.model.selected.is_some() || desk.actions.iter().any(selects) || escapes {
            self.measured = None;
        }
        let subject = match (&desk.model.selected, self.measured) {
            (Some(target), _) => Subject::Target(target.clone()),
            (None, Some(dir)) => Subject::Sky(dir),
            (None, None) => {
                self.kept = None;
                return;
            }
        };
        let Some(facts) = self.facts(&subject, shown) else { return };
        if let Subject::Target(target) = &subject
            && self.named.as_ref().is_none_or(|(of, _)| of != target)
        {
            self.named = Some((target.clone(), called(target, desk)));
        }
        let screen = ui.ctx().content_rect();
        Window::new("Information")
            .anchor(Align2::LEFT_TOP, [MARGIN, MARGIN])
            .title_bar(false)
            .resizable(false)
            .show(ui.ctx(), |ui| match &subject {
                Subject::Target(target) => {
                    if let Some((_, called)) = &self.named {
                        about_target(ui, desk, shown, (target, called), &facts, screen.height());
                    }
                }

                Subject::Sky(dir) => {
                    if about_sky(ui, desk, shown, *dir, &facts, screen.height()) {
                        self.measured = None;
                    }
                }
            });
    }

    fn facts(&mut self, subject: &Subject, shown: &Shown) -> Option<Arc<Facts>> {
        if let Some((night, of, facts)) = &self.kept
            && Arc::ptr_eq(night, &shown.night)
            && of == subject
        {
            return Some(Arc::clone(facts));
        }
        let facts = match subject {
            Subject::Target(target) => facts::facts(target, &shown.night)?,
            Subject::Sky(dir) => {
                measured::direction(*dir, shown.setting.camera.pixel_angle(), &shown.night)
            }
        };
        let facts = Arc::new(facts);
        self.kept = Some((Arc::clone(&shown.night), subject.clone(), Arc::clone(&facts)));
        Some(facts)
    }
}

/// Whether the keys for copying were pressed, and nothing else is to be copied.
fn asks_for_copy(ui: &Ui) -> bool {
    let has_selection = ui.ctx().plugin::<LabelSelectionState>().lock().has_selection();
    !has_selection
        && !ui.ctx().text_edit_focused()
        && ui.input(|input| input.events.contains(&egui::Event::Copy))
}

/// What a target is called.
pub fn called(target: &Target, desk: &Desk) -> Called {
    match desk.data.finder().ok().and_then(|finder| finder.get(target)) {
        Some(found) => (found.name.clone(), found.kind, found.also.clone()),
        None => (target.to_string(), "", String::new()),
    }
}

fn about_target(
    ui: &mut Ui,
    desk: &mut Desk,
    shown: &Shown,
    (target, (name, kind, also)): (&Target, &Called),
    facts: &Facts,
    height: f32,
) {
    let day = desk.data.days.of(target, &shown.night);
    if day.is_none() {
        ui.ctx().request_repaint_after(WAIT);
    }
    let dated = daily(day.as_ref(), &shown.night);
    ui.heading(name.as_str());
    ui.label(RichText::new(*kind).weak());
    if !also.is_empty() {
        ui.add(Label::new(also.as_str()).wrap().selectable(true));
    }
    ui.horizontal_wrapped(|ui| {
        let centre =
            ui.button("Centre").on_hover_text("Bring it to the middle and follow it (Space)");
        if centre.clicked() {
            desk.actions.push(Action::FollowSelected);
        }
        let copies = ui.button("Copy").on_hover_text("Copy all of this as text (Ctrl+C)");
        if copies.clicked() || asks_for_copy(ui) {
            let mut all = facts.clone();
            dated.rows.iter().for_each(|fact| all.rows.push(fact.clone()));
            let title = [name.as_str(), kind, also.as_str()];
            let title: Vec<&str> = title.into_iter().filter(|word| !word.is_empty()).collect();
            ui.ctx().copy_text(all.text(&title.join(", ")));
        }
        if ui.button("Close").on_hover_text("Select nothing (Esc)").clicked() {
            desk.actions.push(Action::Select(None));
        }
    });
    ui.horizontal_wrapped(|ui| {
        for (jump, words, hint) in [
            (Jump::Rise, "To its rise", "Time jumps to when it next rises"),
            (Jump::Transit, "To its transit", "Time jumps to when it next passes the meridian"),
            (Jump::Set, "To its set", "Time jumps to when it next sets"),
        ] {
            if ui.button(words).on_hover_text(hint).clicked() {
                desk.actions.push(Action::Jump(jump, 1));
            }
        }
    });
    table(ui, &[&dated, facts], height);
}

/// True when it is to be closed.
fn about_sky(
    ui: &mut Ui,
    desk: &mut Desk,
    shown: &Shown,
    dir: Dir<Apparent>,
    facts: &Facts,
    height: f32,
) -> bool {
    let Shown { night, setting, .. } = shown;
    let light = match desk.data.light.measure(night, &setting.night, &desk.model.layers, dir) {
        Some(Ok(seen)) => measured::light(&seen),
        other => {
            let mut waiting = Facts::default();
            let words = match other {
                Some(Err(words)) => words,
                _ => {
                    ui.ctx().request_repaint_after(WAIT);
                    WAITING.to_owned()
                }
            };
            waiting.add("Brightness in V", words);
            waiting
        }
    };
    ui.heading("Sky");
    ui.label(RichText::new("its own light, without stars and discs").weak());
    let mut closes = false;
    ui.horizontal_wrapped(|ui| {
        if ui.button("Centre").on_hover_text("Look there").clicked() {
            desk.actions.push(Action::Look(dir));
        }
        let copies = ui.button("Copy").on_hover_text("Copy all of this as text (Ctrl+C)");
        if copies.clicked() || asks_for_copy(ui) {
            let mut all = light.clone();
            all.rows.extend(facts.rows.iter().cloned());
            ui.ctx().copy_text(all.text("Sky"));
        }
        closes = ui.button("Close").on_hover_text("Close (Esc)").clicked();
    });
    table(ui, &[&light, facts], height);
    closes
}

/// Two columns: what, and how much.
fn table(ui: &mut Ui, parts: &[&Facts], height: f32) {
    let room = (height - ui.cursor().top() - BELOW).max(80.0);
    ScrollArea::vertical().max_height(room).show(ui, |ui| {
        Grid::new("facts").num_columns(2).striped(true).show(ui, |ui| {
            for fact in parts.iter().flat_map(|part| &part.rows) {
                ui.label(RichText::new(fact.what).weak());
                ui.add(Label::new(fact.value.as_str()).selectable(true));
                ui.end_row();
            }
        });
    });
}

/// Rise, transit and set of the day.
fn daily(day: Option<&Result<Day, String>>, night: &Night) -> Facts {
    let mut facts = Facts::default();
    for what in Daily::ALL {
        let value = match day {
            None => WAITING.to_owned(),
            Some(Err(words)) => words.clone(),
            Some(Ok(day)) => {
                let times: Vec<String> = day
                    .today(what)
                    .map(|event| {
                        let at = format!("{:.0}°", event.at.deg());
                        let time = clock_words(&event.instant, night, what == Daily::Transit);
                        match what {
                            Daily::Transit => format!("{time} at altitude {at}"),
                            Daily::Rise | Daily::Set => format!("{time} at azimuth {at}"),
                        }
                    })
                    .collect();
                if times.is_empty() { "not on this day".to_owned() } else { times.join(", ") }
            }
        };
        facts.add(what.name(), value);
    }
    facts
}

/// The time of clocks at the place, to the minute, or to the second where it is known so well.
pub fn clock_words(instant: &Instant, night: &Night, with_seconds: bool) -> String {
    let place = &night.sky.place;
    let step_s = if with_seconds { 1.0 } else { 60.0 };
    // Rounded before it is split, so that nothing is 60.
    let second = instant.utc_civil().second;
    let rounded = instant.plus_seconds((second / step_s).round() * step_s - second);
    let rounded = rounded.as_ref().unwrap_or(instant);
    let (civil, zone) = match place.time_zone {
        Some(zone) => {
            let local = rounded.to_local(zone);
            (local.civil, local.abbreviation)
        }
        None => (rounded.utc_civil(), "UTC".to_owned()),
    };
    match with_seconds {
        true => format!("{:02}:{:02}:{:02.0} {zone}", civil.hour, civil.minute, civil.second),
        false => format!("{:02}:{:02} {zone}", civil.hour, civil.minute),
    }
}

/// Altitude at which a target is seen, if it is below the horizon of a night.
pub fn below_horizon(target: &Target, night: &Night) -> Option<crate::units::Angle> {
    let seen = pointing::towards(target, night)?;
    (seen.altitude() < night.horizon).then(|| seen.altitude())
}

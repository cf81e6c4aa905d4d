//! The bar below the sky: where and when it is, how time goes, and the buttons of the panels.

use eframe::egui::{self, Ui};

use crate::app::action::Action;
use crate::app::local_clock::{LocalClock, signed_offset};
use crate::app::model::Panel;

use super::Desk;
use super::typed::named_button;

/// The bar.
#[derive(Default)]
pub struct Bar {
    /// A failure that the user has seen.
    dismissed: Option<String>,
}

impl Bar {
    /// Shows it. `notice` is what the user should know once.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk, notice: &mut Option<String>) {
        egui::Panel::bottom("bar").show(ui, |ui| {
            self.sayings(ui, desk, notice);
            ui.horizontal_wrapped(|ui| {
                place(ui, desk);
                ui.separator();
                date_and_time(ui, desk);
                rates(ui, desk);
                ui.separator();
                let field = field_in_words(desk.model.view.field_deg);
                ui.label(&field).on_hover_text("Field of view across the window");
                ui.separator();
                for panel in Panel::ALL {
                    let is_open = desk.model.panels.is_open(panel);
                    let button = ui.selectable_label(is_open, short_title(panel));
                    button.widget_info(|| {
                        let title = panel.title();
                        egui::WidgetInfo::selected(egui::Role::Button, true, is_open, title)
                    });
                    if button.on_hover_text(hint(desk, panel)).clicked() {
                        desk.actions.push(Action::TogglePanel(panel));
                    }
                }
            });
        });
    }

    /// What was done, what is wrong, and what one should know, each until it is dismissed.
    fn sayings(&mut self, ui: &mut Ui, desk: &mut Desk, notice: &mut Option<String>) {
        if notice.as_deref().is_some_and(|words| saying(ui, words)) {
            *notice = None;
        }
        if desk.errands.said.as_deref().is_some_and(|words| saying(ui, words)) {
            desk.actions.push(Action::Dismiss);
        }
        if desk.failure.is_none() {
            self.dismissed = None;
        }
        if let Some(failure) = desk.failure
            && self.dismissed.as_deref() != Some(failure)
            && saying(ui, failure)
        {
            self.dismissed = Some(failure.to_owned());
        }
    }
}

/// A sentence with a button that takes it away; true when that was pressed.
fn saying(ui: &mut Ui, words: &str) -> bool {
    ui.horizontal_wrapped(|ui| {
        let is_over = named_button(ui, "×", "Dismiss").clicked();
        ui.label(words);
        is_over
    })
    .inner
}

fn place(ui: &mut Ui, desk: &mut Desk) {
    let at = &desk.model.place;
    let name = at.name.clone().unwrap_or_else(|| super::place::coordinates_in_words(at));
    let details = format!("{}, {:.0} m", super::place::coordinates_in_words(at), at.height_m);
    if ui.button(name).on_hover_text(details).clicked() {
        desk.actions.push(Action::TogglePanel(Panel::Place));
    }
}

fn date_and_time(ui: &mut Ui, desk: &mut Desk) {
    let instant = desk.model.clock.instant;
    let civil = LocalClock::of(&desk.model.place).read(&instant);
    let universal = LocalClock::UTC.read(&instant);
    let offset = signed_offset(civil.offset_s);
    let zone = match civil.abbreviation.starts_with(['+', '-']) {
        true => format!("UTC{offset}"),
        false => format!("{} (UTC{offset})", civil.abbreviation),
    };
    let words = format!("{} {zone}", civil.in_words());
    let details = format!("{} UTC", universal.in_words());
    if ui.button(words).on_hover_text(details).clicked() {
        desk.actions.push(Action::TogglePanel(Panel::Time));
    }
}

/// Buttons that change how time goes, and how it goes.
pub fn rates(ui: &mut Ui, desk: &mut Desk) {
    let runs = desk.model.clock.runs();
    let (sign, name) = if runs { ("Pause", "Pause") } else { ("Play", "Play") };
    for (sign, name, action) in [
        ("«", "Slower", Action::Slower),
        (sign, name, Action::PlayOrPause),
        ("»", "Faster", Action::Faster),
        ("Now", "Now", Action::Now),
    ] {
        if named_button(ui, sign, name).clicked() {
            desk.actions.push(action);
        }
    }
    ui.label(desk.model.clock.rate_in_words());
}

/// As short as the bar needs it.
fn short_title(panel: Panel) -> &'static str {
    match panel {
        Panel::Time => "Time",
        Panel::Viewer => "Eye",
        other => other.title(),
    }
}

/// The whole title, with the key.
fn hint(desk: &Desk, panel: Panel) -> String {
    let bindings = desk.keys.iter().flat_map(|group| &group.bindings);
    let key = bindings
        .filter(|binding| binding.action == Action::TogglePanel(panel))
        .map(|binding| format!("{:?}", binding.shortcut.logical_key))
        .next();
    match key {
        Some(key) => format!("{} ({key})", panel.title()),
        None => panel.title().to_owned(),
    }
}

/// A field of view as people say it: `90°`, `1.5°`, `12.0'`, `3.0"`.
fn field_in_words(field_deg: f64) -> String {
    match field_deg {
        deg if deg >= 10.0 => format!("{deg:.0}°"),
        deg if deg >= 1.0 => format!("{deg:.1}°"),
        deg if deg * 60.0 >= 1.0 => format!("{:.1}'", deg * 60.0),
        deg => format!("{:.1}\"", deg * 3600.0),
    }
}

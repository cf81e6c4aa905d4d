//! Finds anything in the sky by its name.

use std::time::Duration;

use eframe::egui::{self, Key, Modifiers, RichText, ScrollArea, TextEdit, Ui};

use crate::app::action::{Action, Jump};
use crate::app::knowledge::Daily;
use crate::app::model::Panel;
use crate::app::sky::Shown;
use crate::ephemeris::Body;
use crate::light::night::{LitObject, Night};
use crate::sky::Target;
use crate::sky::finder::Found;
use crate::units::Magnitude;

use super::Desk;
use super::info::{below_horizon, called, clock_words};

/// So many are listed.
const LISTED: usize = 12;
/// So many stars are suggested, no fainter than this.
const STARS: usize = 5;
const BRIGHT: Magnitude = Magnitude(1.6);
/// What is being found out is looked for so often.
const WAIT: Duration = Duration::from_millis(100);

/// What is typed, and what was found.
#[derive(Default)]
pub struct SearchPanel {
    query: String,
    /// What the list was made for.
    asked: Option<String>,
    found: Vec<Found>,
    /// The row that Enter takes.
    row: usize,
    was_open: bool,
    /// Taken from the list, and below the horizon.
    chosen: Option<Target>,
}

impl SearchPanel {
    /// Forgets that it was open, so that the field has the keyboard when it opens again.
    pub fn closed(&mut self) {
        self.was_open = false;
        self.chosen = None;
    }

    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        // Before the field sees them.
        let key = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let (up, down) = (key(Key::ArrowUp), key(Key::ArrowDown));
        let enter = ui.input(|input| input.key_pressed(Key::Enter));
        let escape = ui.input(|input| input.key_pressed(Key::Escape));
        let label = ui.label("Name or number");
        let field = TextEdit::singleline(&mut self.query)
            .hint_text("Jupiter, Betelgeuse, alp Cen, HIP 71683, Tycho, Orion, M 31")
            .desired_width(340.0);
        let field = ui.add(field).labelled_by(label.id);
        if !self.was_open {
            field.request_focus();
            self.was_open = true;
        }
        self.look_up(desk);
        if let Err(words) = desk.data.finder() {
            ui.label(words);
        }
        let last = self.found.len().saturating_sub(1);
        if down {
            self.row = (self.row + 1).min(last);
        }
        if up {
            self.row = self.row.saturating_sub(1);
        }
        let mut taken = None;
        if enter && (field.has_focus() || field.lost_focus()) {
            taken = self.found.get(self.row).map(|found| found.target.clone());
            field.request_focus();
        }
        if escape && (field.has_focus() || field.lost_focus()) {
            desk.actions.push(Action::TogglePanel(Panel::Search));
        }
        if self.found.is_empty() && !self.query.trim().is_empty() {
            ui.label("Nothing is called so.");
        }
        if self.query.trim().is_empty() && !self.found.is_empty() {
            ui.label(RichText::new("Up now").weak());
        }
        ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
            for (number, found) in self.found.iter().enumerate() {
                let is_next = number == self.row;
                let words = format!("{}   {}", found.name, found.kind);
                let row = ui.selectable_label(is_next, words);
                let row = match found.also.is_empty() {
                    true => row,
                    false => row.on_hover_text(found.also.as_str()),
                };
                if is_next && (up || down) {
                    row.scroll_to_me(None);
                }
                if row.clicked() {
                    taken = Some(found.target.clone());
                }
            }
        });
        if let Some(target) = taken {
            self.take(target, desk);
        }
        self.say_below(ui, desk);
    }

    /// Selects it and follows it; the panel stays where there is something to say.
    fn take(&mut self, target: Target, desk: &mut Desk) {
        let is_below =
            desk.shown.is_some_and(|shown| below_horizon(&target, &shown.night).is_some());
        desk.actions.push(Action::Select(Some(target.clone())));
        desk.actions.push(Action::FollowSelected);
        if is_below {
            self.chosen = Some(target);
        } else {
            self.chosen = None;
            desk.actions.push(Action::TogglePanel(Panel::Search));
        }
    }

    fn look_up(&mut self, desk: &Desk) {
        let query = self.query.trim();
        if self.asked.as_deref() == Some(query) && !(query.is_empty() && self.found.is_empty()) {
            return;
        }
        if self.asked.as_deref() != Some(query) {
            self.row = 0;
        }
        let Ok(finder) = desk.data.finder() else { return };
        self.found = match (query.is_empty(), desk.shown) {
            (false, _) => finder.search(query, LISTED),
            (true, Some(shown)) => {
                let targets = suggestions(&shown.night).into_iter();
                targets.filter_map(|target| finder.get(&target).cloned()).collect()
            }
            (true, None) => Vec::new(),
        };
        self.asked = Some(query.to_owned());
    }

    /// Says that what was taken is below the horizon, and when it rises.
    fn say_below(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let (Some(target), Some(shown)) = (self.chosen.clone(), desk.shown) else { return };
        if desk.model.selected.as_ref().is_some_and(|selected| *selected != target) {
            self.chosen = None;
            return;
        }
        let Some(words) = self.below(&target, desk, shown, ui.ctx()) else {
            self.chosen = None;
            return;
        };
        ui.separator();
        ui.label(words);
        if ui.button("Go to its rise").on_hover_text("Time jumps to when it rises").clicked() {
            desk.actions.push(Action::Jump(Jump::Rise, 1));
        }
    }

    /// `Jupiter is 12° below the horizon; it rises at 22:41 BST.`
    fn below(
        &self,
        target: &Target,
        desk: &Desk,
        shown: &Shown,
        ctx: &egui::Context,
    ) -> Option<String> {
        let altitude = below_horizon(target, &shown.night)?;
        let (name, _, _) = called(target, desk);
        let depth = match altitude.deg().abs() {
            deg if deg < 1.0 => "less than 1°".to_owned(),
            deg => format!("{deg:.0}°"),
        };
        let day = desk.data.days.of(target, &shown.night);
        let rises = match &day {
            None => {
                ctx.request_repaint_after(WAIT);
                "it rises at …".to_owned()
            }
            Some(Err(words)) => words.clone(),
            Some(Ok(day)) => match day.next(Daily::Rise, &shown.night.sky.instant) {
                Some(rise) => {
                    let time = clock_words(&rise.instant, &shown.night, false);
                    let is_later = rise.instant.tt.jd() >= day.to.tt.jd();
                    format!("it rises at {time}{}", if is_later { " tomorrow" } else { "" })
                }
                None => "it does not rise today or tomorrow".to_owned(),
            },
        };
        Some(format!("{name} is {depth} below the horizon; {rises}."))
    }
}

/// What is worth looking at: the Sun and the Moon, planets, bright stars, of those that are up.
fn suggestions(night: &Night) -> Vec<Target> {
    let is_up = |object: &LitObject| object.apparent.altitude() >= night.horizon;
    let bodies = [Body::Sun, Body::Moon].into_iter().chain(Body::PLANETS);
    let seen = |body: &Body| {
        let faint = matches!(body, Body::Uranus | Body::Neptune | Body::Pluto);
        !faint && night.body(*body).is_some_and(is_up)
    };
    let zenith = crate::frame::Dir::from_vector(glam::DVec3::Z);
    let mut stars = night.stars_in(zenith, crate::units::Angle::from_deg(92.0), Some(BRIGHT));
    stars.sort_by(|a, b| a.magnitude.0.total_cmp(&b.magnitude.0));
    let stars = stars.into_iter().take(STARS).filter_map(|star| match star.kind {
        crate::light::night::Kind::Star(index) => {
            Some(Target::Star { hr: night.stars.get(index)?.hr })
        }
        _ => None,
    });
    bodies.filter(seen).map(Target::Body).chain(stars).collect()
}

//! Controls that the panels share: each has its words beside it, the same words for screen readers, and
//! gives back nothing that lies outside its range.

use eframe::egui::{
    Button, Checkbox, CollapsingHeader, ComboBox, Context, DragValue, Response, RichText, Slider,
    SliderClamping, Ui,
};

use crate::app::action::Action;
use crate::app::keys::Group;

/// Width of the words before a control, points.
const WORDS_WIDTH: f32 = 118.0;
/// Digits of numbers that count.
const DIGITS: i32 = 4;
/// Share of a number that a point of dragging changes, where steps are factors.
const DRAG_SHARE: f64 = 0.01;

/// What a number may be, and how it is told.
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    /// Ends of the slider.
    slider: [f64; 2],
    /// What may be typed.
    range: [f64; 2],
    /// Least value above zero of a slider whose steps are factors; none for even steps.
    smallest: Option<f64>,
    unit: &'static str,
    is_whole: bool,
}

impl Scale {
    /// Even steps.
    pub const fn even(low: f64, high: f64, unit: &'static str) -> Scale {
        Scale { slider: [low, high], range: [low, high], smallest: None, unit, is_whole: false }
    }

    /// Steps by factors, from a least value above zero.
    pub const fn factors(low: f64, high: f64, unit: &'static str) -> Scale {
        Scale { smallest: Some(low), ..Scale::even(low, high, unit) }
    }

    /// The same down to zero.
    pub const fn and_zero(self) -> Scale {
        let [_, high] = self.slider;
        Scale { slider: [0.0, high], range: [0.0, self.range[1]], ..self }
    }

    /// Whole numbers alone.
    pub const fn whole(self) -> Scale {
        Scale { is_whole: true, ..self }
    }

    /// What may be typed beyond the ends of the slider.
    pub const fn within(self, low: f64, high: f64) -> Scale {
        Scale { range: [low, high], ..self }
    }

    /// The least and the greatest value that it gives.
    #[cfg(test)]
    pub const fn range(&self) -> [f64; 2] {
        self.range
    }

    /// A value brought into the range; none of what is no number.
    fn accepted(&self, value: f64) -> Option<f64> {
        let [low, high] = self.range;
        let value = if self.is_whole { value.round() } else { value };
        (!value.is_nan()).then(|| value.clamp(low, high))
    }

    fn drag_speed(&self, value: f64) -> f64 {
        let [low, high] = self.slider;
        match self.smallest {
            _ if self.is_whole => 0.1,
            Some(smallest) => value.abs().max(smallest) * DRAG_SHARE,
            None => (high - low) / 400.0,
        }
    }
}

/// Gives a control its name for screen readers.
pub fn name(response: &Response, words: &str) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(words.to_owned()));
}

/// A number, with a slider. True if it changed.
pub fn number(ui: &mut Ui, words: &str, value: &mut f64, scale: &Scale) -> bool {
    ui.horizontal(|ui| {
        words_before(ui, words);
        slider(ui, words, value, scale)
    })
    .inner
}

/// A number that may be left out; `usual` is what it then is.
pub fn optional(
    ui: &mut Ui,
    words: &str,
    value: &mut Option<f64>,
    usual: f64,
    left_out: &str,
    scale: &Scale,
) -> bool {
    ui.horizontal(|ui| {
        let mut is_given = value.is_some();
        let mut changed = switch_before(ui, words, &mut is_given);
        if changed {
            *value = is_given.then(|| scale.accepted(usual).unwrap_or(scale.range[0]));
        }
        match value {
            Some(number) => changed |= slider(ui, words, number, scale),
            None => {
                ui.weak(left_out);
            }
        }
        changed
    })
    .inner
}

/// A switch. True if it changed.
pub fn switch(ui: &mut Ui, words: &str, is_on: &mut bool) -> bool {
    ui.checkbox(is_on, words).changed()
}

/// One of a few, told by their words. True if another was chosen.
pub fn choice<T: PartialEq + Copy>(
    ui: &mut Ui,
    words: &str,
    chosen: &mut T,
    all: &[(T, &str)],
) -> bool {
    let before = all.iter().position(|(one, _)| one == chosen);
    let mut index = before;
    let now = before.map_or("as set", |index| all[index].1);
    choice_of(ui, words, now, &mut index, all.iter().map(|(_, words)| *words));
    match index {
        Some(index) if Some(index) != before => {
            *chosen = all[index].0;
            true
        }
        _ => false,
    }
}

/// One of a list of words, by its place in it.
pub fn choice_of<'a>(
    ui: &mut Ui,
    words: &str,
    now: &str,
    index: &mut Option<usize>,
    all: impl Iterator<Item = &'a str>,
) {
    ui.horizontal(|ui| {
        words_before(ui, words);
        let response = ComboBox::from_id_salt(words)
            .selected_text(now)
            .show_ui(ui, |ui| {
                for (place, words) in all.enumerate() {
                    if ui.selectable_label(*index == Some(place), words).clicked() {
                        *index = Some(place);
                        // A hand closes a list; keys and screen readers do not.
                        ui.close();
                    }
                }
            })
            .response;
        name(&response, words);
    });
}

/// A button that says more when a hand rests on it.
pub fn button(ui: &mut Ui, words: &str, hint: &str) -> bool {
    ui.add(Button::new(words)).on_hover_text(hint).clicked()
}

/// A part of a panel that can be folded.
pub fn section(ui: &mut Ui, title: &str, body: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(RichText::new(title).strong())
        .id_salt(title)
        .default_open(true)
        .show_unindented(ui, body);
}

/// The key that does something, in words; empty if none does.
pub fn key_of(ctx: &Context, keys: &[Group], action: &Action) -> String {
    let all = keys.iter().flat_map(|group| &group.bindings);
    let bound = all.into_iter().find(|binding| binding.action == *action);
    bound.map_or_else(String::new, |binding| ctx.format_shortcut(&binding.shortcut))
}

/// A number with the digits that count.
pub fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-4..7).contains(&magnitude) {
        return format!("{value:.2e}");
    }
    let decimals = (DIGITS - 1 - magnitude).clamp(0, 8) as usize;
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn words_before(ui: &mut Ui, words: &str) {
    let height = ui.spacing().interact_size.y;
    ui.allocate_ui(eframe::egui::vec2(WORDS_WIDTH, height), |ui| {
        ui.set_min_width(WORDS_WIDTH);
        ui.label(words);
    });
}

fn switch_before(ui: &mut Ui, words: &str, is_on: &mut bool) -> bool {
    let height = ui.spacing().interact_size.y;
    ui.allocate_ui(eframe::egui::vec2(WORDS_WIDTH, height), |ui| {
        ui.set_min_width(WORDS_WIDTH);
        ui.add(Checkbox::new(is_on, words)).changed()
    })
    .inner
}

/// A slider and the number beside it.
fn slider(ui: &mut Ui, words: &str, value: &mut f64, scale: &Scale) -> bool {
    let [low, high] = scale.slider;
    let mut edited = *value;
    let mut rail = Slider::new(&mut edited, low..=high)
        .show_value(false)
        .clamping(SliderClamping::Never)
        .logarithmic(scale.smallest.is_some());
    if let Some(smallest) = scale.smallest {
        rail = rail.smallest_positive(smallest);
    }
    if scale.is_whole {
        rail = rail.integer();
    }
    let rail = ui.add(rail);
    name(&rail, words);
    let is_whole = scale.is_whole;
    let [least, greatest] = scale.range;
    let field = ui.add(
        DragValue::new(&mut edited)
            .range(least..=greatest)
            .clamp_existing_to_range(false)
            .speed(scale.drag_speed(*value))
            .custom_formatter(move |value, _| match is_whole {
                true => format!("{value:.0}"),
                false => significant(value),
            })
            .suffix(scale.unit),
    );
    name(&field, words);
    match scale.accepted(edited) {
        Some(accepted) if (rail.changed() || field.changed()) && accepted != *value => {
            *value = accepted;
            true
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_told_with_the_digits_that_count() {
        for (value, words) in [
            (0.0, "0"),
            (300.0, "300"),
            (0.1, "0.1"),
            (2.0 / 3.0, "0.6667"),
            (12_345.678, "12346"),
            (1e-6, "1.00e-6"),
            (-3.25, "-3.25"),
            (1000.0, "1000"),
        ] {
            assert_eq!(significant(value), words);
        }
    }

    #[test]
    fn nothing_outside_its_range_is_given() {
        let scale = Scale::factors(0.01, 3.0, "").and_zero();
        assert_eq!(scale.accepted(f64::NAN), None);
        assert_eq!(scale.accepted(f64::INFINITY), Some(3.0));
        assert_eq!(scale.accepted(-1.0), Some(0.0));
        assert_eq!(Scale::even(0.0, 9.0, "").whole().accepted(3.6), Some(4.0));
        assert_eq!(Scale::even(0.0, 1.0, "").within(-5.0, 5.0).accepted(-7.0), Some(-5.0));
    }
}

//! Fields that are typed into: what makes no sense is marked and not taken.

use eframe::egui::{
    self, Color32, Event, Id, Key, Modifiers, MouseWheelUnit, Response, TextEdit, Ui,
};

/// Colour of what is wrong; a sign stands beside it, for those who see no colours.
const WRONG: Color32 = Color32::from_rgb(255, 140, 90);

/// A touchpad is moved so far for a step.
const POINTS_PER_STEP: f32 = 40.0;

/// What has become of a field.
#[derive(Debug, Clone, PartialEq)]
pub enum Change<T> {
    /// Typed, and left with Enter or by going elsewhere.
    Taken(T),
    /// Arrow keys or the wheel: so many up.
    Stepped(i32),
}

/// What is being typed, in one of several fields, and what is wrong with it.
#[derive(Default)]
pub struct Typed {
    draft: Option<(Id, String)>,
    fault: Option<String>,
    /// Scrolled, and not yet a step.
    scrolled: f32,
}

/// How a field looks.
pub struct Field<'a> {
    /// What it is called.
    pub label: &'a str,
    /// What is in it while nobody types.
    pub shown: &'a str,
    pub width: f32,
}

impl Typed {
    /// A field behind its label. What is typed is read by `read`, whose errors are sentences.
    pub fn field<T>(
        &mut self,
        ui: &mut Ui,
        field: &Field,
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Option<Change<T>> {
        let label = ui.label(field.label);
        let id = ui.make_persistent_id(("typed", field.label));
        let has_focus = ui.memory(|memory| memory.has_focus(id));
        let mut steps = if has_focus { arrows(ui) } else { 0 };
        let is_mine = self.draft.as_ref().is_some_and(|(whose, _)| *whose == id);
        if is_mine && steps != 0 {
            self.forget();
        }
        let mut text = match &self.draft {
            Some((whose, draft)) if *whose == id => draft.clone(),
            _ => field.shown.to_owned(),
        };
        let before = text.clone();
        let wrong = (text != field.shown).then(|| read(&text).err()).flatten();
        let edit = TextEdit::singleline(&mut text).id(id).desired_width(field.width);
        let edit = edit.text_color_opt(wrong.is_some().then_some(WRONG));
        let response = ui.add(edit).labelled_by(label.id);
        if text != before {
            self.fault = (text != field.shown).then(|| read(&text).err()).flatten();
            self.draft = Some((id, text.clone()));
        }
        if steps == 0 {
            steps = self.wheel(ui, &response);
        }
        if response.lost_focus() {
            let is_given_up = ui.input(|input| input.key_pressed(Key::Escape));
            let taken = (text != field.shown && !is_given_up).then(|| read(&text).ok()).flatten();
            self.forget();
            if let Some(value) = taken {
                return Some(Change::Taken(value));
            }
        }
        (steps != 0).then_some(Change::Stepped(steps))
    }

    /// Says what is wrong with what is typed, if something is.
    pub fn say(&self, ui: &mut Ui) {
        if let Some(fault) = &self.fault {
            ui.colored_label(WRONG, format!("! {fault}"));
        }
    }

    /// Steps of the wheel over a field; a touchpad needs some way for one.
    fn wheel(&mut self, ui: &Ui, response: &Response) -> i32 {
        if !response.hovered() {
            return 0;
        }
        ui.input(|input| {
            for event in &input.events {
                match event {
                    Event::MouseWheel { unit: MouseWheelUnit::Point, delta, .. } => {
                        self.scrolled += delta.y / POINTS_PER_STEP;
                    }
                    Event::MouseWheel { delta, .. } => self.scrolled += delta.y,
                    _ => {}
                }
            }
        });
        let steps = self.scrolled.trunc().clamp(-100.0, 100.0);
        self.scrolled = self.scrolled.fract();
        steps as i32
    }

    fn forget(&mut self) {
        (self.draft, self.fault) = (None, None);
    }
}

/// Steps that arrow keys ask for in a field that is written in.
fn arrows(ui: &Ui) -> i32 {
    let count = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
    let up = count(Key::ArrowUp) as i32;
    up - count(Key::ArrowDown) as i32
}

/// A button of few signs, with a name for screen readers and for the pointer.
pub fn named_button(ui: &mut Ui, sign: &str, name: &str) -> Response {
    let response = ui.button(sign).on_hover_text(name);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    response
}

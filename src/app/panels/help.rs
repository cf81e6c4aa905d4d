//! The sheet of keys, and what the hand does.

use eframe::egui::{self, Context, TextEdit, Ui};

use crate::app::keys::Group;

use super::Desk;
use super::controls::name;

/// Width of a column, points.
const COLUMN_WIDTH: f32 = 270.0;
/// Width of a key, points.
const KEY_WIDTH: f32 = 104.0;

/// What hands do on the sky.
const GESTURES: [(&str, &str); 6] = [
    ("Drag", "Turn the sky"),
    ("Wheel", "Zoom"),
    ("Pinch", "Zoom"),
    ("Click", "Select what is nearest, or the empty sky"),
    ("Double click", "Follow what is selected"),
    ("Tab", "To the next control"),
];

/// The sheet, and what is searched in it.
#[derive(Default)]
pub struct HelpPanel {
    pub wanted: String,
}

impl HelpPanel {
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        let field = TextEdit::singleline(&mut self.wanted)
            .hint_text("Find a key")
            .desired_width(COLUMN_WIDTH.min(ui.available_width()));
        let field = ui.add(field);
        name(&field, "Find a key");
        let sheet = sheet(ui.ctx(), desk.keys, &self.wanted);
        if sheet.is_empty() {
            ui.label(format!("No key has to do with '{}'.", self.wanted.trim()));
        }
        let many = ((ui.available_width() / COLUMN_WIDTH) as usize).clamp(1, 3);
        ui.columns(many, |columns| {
            for (group, column) in sheet.iter().zip(in_columns(&sheet, many)) {
                show_group(&mut columns[column], group);
            }
        });
    }
}

/// Lines of the sheet under a title.
struct Part {
    title: &'static str,
    /// A key, and what it does.
    lines: Vec<(String, &'static str)>,
}

/// What has to do with some words; all if there are none.
fn sheet(ctx: &Context, keys: &[Group], wanted: &str) -> Vec<Part> {
    let wanted = wanted.trim().to_lowercase();
    let of_keys = keys.iter().map(|group| {
        let line = |binding: &crate::app::keys::Binding| {
            (ctx.format_shortcut(&binding.shortcut), binding.words)
        };
        Part { title: group.name, lines: group.bindings.iter().map(line).collect() }
    });
    let hand = GESTURES.iter().map(|(hand, words)| ((*hand).to_owned(), *words)).collect();
    let all = of_keys.chain([Part { title: "Hand", lines: hand }]);
    all.filter_map(|mut part| {
        let has = |words: &str| words.to_lowercase().contains(&wanted);
        if !has(part.title) {
            part.lines.retain(|(key, words)| has(key) || has(words));
        }
        (!part.lines.is_empty()).then_some(part)
    })
    .collect()
}

/// The column of each part, so that columns are about as long.
fn in_columns(sheet: &[Part], many: usize) -> Vec<usize> {
    let mut lengths = vec![0; many];
    let shortest = |lengths: &[usize]| (0..many).min_by_key(|column| lengths[*column]).unwrap_or(0);
    sheet
        .iter()
        .map(|part| {
            let column = shortest(&lengths);
            lengths[column] += part.lines.len() + 2;
            column
        })
        .collect()
}

fn show_group(ui: &mut Ui, part: &Part) {
    ui.strong(part.title);
    for (key, words) in &part.lines {
        ui.horizontal(|ui| {
            let height = ui.spacing().interact_size.y;
            ui.allocate_ui(egui::vec2(KEY_WIDTH, height), |ui| {
                ui.set_min_width(KEY_WIDTH);
                ui.monospace(key);
            });
            ui.label(*words);
        });
    }
    ui.add_space(8.0);
}

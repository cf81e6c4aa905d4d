//! Colours and text of the window: dark and quiet; and red on black for eyes in the dark.

use eframe::egui::epaint::Shadow;
use eframe::egui::epaint::shape_transform::adjust_colors;
use eframe::egui::layers::ShapeIdx;
use eframe::egui::style::{TextCursorStyle, WidgetVisuals};
use eframe::egui::{self, Color32, Context, LayerId, Stroke, Visuals};

use crate::app::model::Model;

/// Text is so bright, of 255: black behind it makes a contrast of 14 to 1.
const TEXT_GREY: u8 = 214;
/// Text of less weight; a contrast of 6 to 1.
const WEAK_GREY: u8 = 146;

/// What a theme depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dress {
    is_red: bool,
    zoom: f32,
}

impl Dress {
    pub fn of(model: &Model) -> Dress {
        Dress { is_red: model.display.red, zoom: model.zoom }
    }
}

/// Colours and text of the window.
pub fn theme(ctx: &Context, model: &Model) {
    ctx.set_theme(egui::Theme::Dark);
    ctx.set_visuals_of(egui::Theme::Dark, visuals(model.display.red));
    ctx.set_zoom_factor(model.zoom);
}

/// A colour for lines and words as it may be shown: in red light red alone, as bright as its brightest part.
pub fn shade(is_red: bool, colour: Color32) -> Color32 {
    match is_red {
        false => colour,
        true => {
            let [r, g, b, a] = colour.to_array();
            Color32::from_rgba_premultiplied(r.max(g).max(b), 0, 0, a)
        }
    }
}

/// Makes red of all that was drawn in this frame, also of what has colours of its own.
pub fn redden(ctx: &Context) {
    let redder = |colour: &mut Color32| {
        // A mark of egui for a colour that is chosen later, among those that are red by then.
        if *colour != Color32::PLACEHOLDER {
            *colour = shade(true, *colour);
        }
    };
    let areas: Vec<LayerId> = ctx.memory(|memory| memory.layer_ids().collect());
    let background = Some(LayerId::background()).filter(|layer| !areas.contains(layer));
    ctx.graphics_mut(|graphics| {
        for layer in areas.into_iter().chain(background) {
            let Some(shapes) = graphics.get_mut(layer) else { continue };
            for index in 0..shapes.next_idx().0 {
                shapes.mutate_shape(ShapeIdx(index), |drawn| {
                    adjust_colors(&mut drawn.shape, redder);
                });
            }
        }
    });
}

/// The colours of all that egui draws.
pub fn visuals(is_red: bool) -> Visuals {
    let mut visuals = quiet();
    if is_red {
        for colour in colours(&mut visuals) {
            *colour = shade(true, *colour);
        }
    }
    visuals
}

fn quiet() -> Visuals {
    let mut visuals = Visuals::dark();
    let panel = Color32::from_rgb(13, 14, 18);
    (visuals.window_fill, visuals.panel_fill) = (panel, panel);
    visuals.window_stroke = Stroke::new(1.0, Color32::from_gray(52));
    // Soft shadows cost more than all else that a panel draws.
    (visuals.window_shadow, visuals.popup_shadow) = (Shadow::NONE, Shadow::NONE);
    visuals.extreme_bg_color = Color32::from_gray(4);
    visuals.weak_text_color = Some(Color32::from_gray(WEAK_GREY));
    visuals.selection.bg_fill = Color32::from_rgb(22, 70, 104);
    visuals.selection.stroke.color = Color32::from_gray(232);
    visuals.slider_trailing_fill = true;
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.fg_stroke.color = Color32::from_gray(TEXT_GREY);
    widgets.inactive.fg_stroke.color = Color32::from_gray(TEXT_GREY);
    // Where the keyboard is must be seen at once: a bright edge, not a colour alone.
    widgets.active.bg_stroke = Stroke::new(1.5, Color32::from_gray(236));
    widgets.active.fg_stroke.color = Color32::from_gray(244);
    visuals
}

/// Every colour of a theme.
fn colours(visuals: &mut Visuals) -> Vec<&mut Color32> {
    let Visuals {
        override_text_color,
        weak_text_color,
        widgets,
        selection,
        ime_composition,
        hyperlink_color,
        faint_bg_color,
        extreme_bg_color,
        text_edit_bg_color,
        code_bg_color,
        warn_fg_color,
        error_fg_color,
        window_shadow,
        window_fill,
        window_stroke,
        panel_fill,
        popup_shadow,
        text_cursor: TextCursorStyle { stroke: cursor, .. },
        ..
    } = visuals;
    let mut all = vec![
        &mut selection.bg_fill,
        &mut selection.stroke.color,
        &mut ime_composition.active_underline_stroke.color,
        &mut ime_composition.inactive_underline_stroke.color,
        hyperlink_color,
        faint_bg_color,
        extreme_bg_color,
        code_bg_color,
        warn_fg_color,
        error_fg_color,
        &mut window_shadow.color,
        window_fill,
        &mut window_stroke.color,
        panel_fill,
        &mut popup_shadow.color,
        &mut cursor.color,
    ];
    all.extend([override_text_color, weak_text_color, text_edit_bg_color].into_iter().flatten());
    let egui::style::Widgets { noninteractive, inactive, hovered, active, open } = widgets;
    for widget in [noninteractive, inactive, hovered, active, open] {
        let WidgetVisuals { bg_fill, weak_bg_fill, bg_stroke, fg_stroke, .. } = widget;
        all.extend([bg_fill, weak_bg_fill, &mut bg_stroke.color, &mut fg_stroke.color]);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Colours as they stand in the words of a theme, so that none is forgotten.
    fn told(visuals: &Visuals) -> Vec<String> {
        let words = format!("{visuals:?}");
        let all = words.split('#').skip(1);
        all.map(|rest| rest.chars().take_while(|c| c.is_ascii_hexdigit() || *c == '_').collect())
            .collect()
    }

    #[test]
    fn red_light_has_neither_green_nor_blue() {
        let all = told(&visuals(true));
        assert!(all.len() > 30, "{all:?}");
        for colour in all {
            let digits: String = colour.chars().filter(|c| *c != '_').collect();
            assert_eq!(&digits[2..6], "0000", "{colour}");
        }
        assert!(told(&visuals(false)).iter().any(|colour| !colour.contains("_00_00")));
    }

    #[test]
    fn text_stands_out_from_panels() {
        // WCAG 2: contrast of relative luminances, each with 0.05 of stray light; 4.5 is asked for.
        let linear = |code: u8| {
            let share = f64::from(code) / 255.0;
            if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
        };
        let luminance = |colour: Color32| {
            let [r, g, b, _] = colour.to_array();
            0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b) + 0.05
        };
        let visuals = visuals(false);
        let panel = luminance(visuals.panel_fill);
        for (text, least) in [(visuals.text_color(), 12.0), (visuals.weak_text_color(), 4.5)] {
            let contrast = luminance(text) / panel;
            assert!(contrast > least, "{text:?}: {contrast}");
        }
    }
}

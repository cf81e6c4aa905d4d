//! The mark around what is selected: four short arcs, as wide as its disc at least.

use eframe::egui::{Painter, Pos2, Shape, Stroke, pos2};

use crate::app::canvas::Frame;
use crate::app::panels::Desk;
use crate::app::pointing;
use crate::app::sky::Shown;

use super::MARK;

/// Radius of the smallest mark, points.
const SMALLEST: f32 = 11.0;
/// Between the limb and the mark, points.
const GAP: f32 = 5.0;
/// Half the length of an arc, radians: four arcs leave most of the circle free.
const HALF_ARC: f32 = 0.35;
const STEPS: usize = 8;
const WIDTH: f32 = 1.8;

/// Draws it, if what is selected is in the picture.
pub fn draw(painter: &Painter, frame: &Frame, shown: &Shown, desk: &Desk) {
    let Some(target) = &desk.model.selected else { return };
    let Some(dir) = pointing::towards(target, &shown.night) else { return };
    let Some(pixel) = frame.camera.pixel_from_apparent(dir) else { return };
    let centre = frame.point(pixel);
    let radius_px =
        pointing::angular_radius(target, &shown.night).rad() / frame.camera.pixel_angle().rad();
    let per_px = frame.rect.width() / frame.camera.width_px.max(1) as f32;
    let radius = (radius_px as f32 * per_px + GAP).max(SMALLEST);
    // A disc that fills the window needs no mark.
    if radius > frame.rect.size().max_elem() || !frame.rect.expand(radius).contains(centre) {
        return;
    }
    let stroke = Stroke::new(WIDTH, MARK);
    painter.extend(arcs(centre, radius).map(|points| Shape::line(points, stroke)));
}

/// Arcs of a circle, at its upper right, upper left, lower left and lower right.
fn arcs(centre: Pos2, radius: f32) -> impl Iterator<Item = Vec<Pos2>> {
    (0..4).map(move |quarter| {
        let middle = (quarter as f32 + 0.5) * std::f32::consts::FRAC_PI_2;
        (0..=STEPS)
            .map(|step| {
                let along = 2.0 * step as f32 / STEPS as f32 - 1.0;
                let (sin, cos) = (middle + along * HALF_ARC).sin_cos();
                pos2(centre.x + radius * cos, centre.y - radius * sin)
            })
            .collect()
    })
}

//! Messier's objects: a symbol for each kind, as large as the object, and its name.

use eframe::egui::{Pos2, Vec2, vec2};

use super::Sketch;
use super::axes::far_away;
use super::ink::Pen;
use super::labels::{AROUND, Label, id};
use crate::catalog::{MessierObject, messier_objects};
use crate::sky::Target;

const COLOUR: [u8; 3] = [120, 200, 170];
const WHOLE: Pen = Pen::new(COLOUR, 0.9, 1.2, &[]);
const DOTTED: Pen = Pen::new(COLOUR, 0.9, 1.2, &[2.0, 2.5]);
/// No symbol is smaller, points.
const LEAST_POINTS: f32 = 4.0;

/// Draws them, if they are switched on.
pub fn draw(sketch: &mut Sketch) {
    if !sketch.on.deep_sky {
        return;
    }
    // Wide fields have room for the bright ones alone.
    let faintest = 8.0 + 5.0 * (60.0 / sketch.field_deg()).max(0.1).log10();
    for object in messier_objects() {
        let selected = sketch.is_selected(&Target::Messier(object.number));
        let seen = sketch.seen(far_away(&sketch.night.sky, object.dir_j2000));
        let Some(at) = sketch.point(seen) else { continue };
        let points_per_rad = sketch.points_per_rad();
        let across = object
            .size
            .map_or(0.0, |(length, width)| 0.25 * (length.rad() + width.rad()) * points_per_rad);
        let radius = (across as f32).max(LEAST_POINTS);
        symbol(sketch, object, at, radius);
        if object.magnitude.0 > faintest && !selected {
            continue;
        }
        let number = format!("M {}", object.number);
        let text = match &object.name {
            Some(name) if sketch.field_deg() < 30.0 => format!("{number} {name}"),
            _ => number,
        };
        sketch.labels.push(Label {
            id: id(("messier", object.number)),
            text,
            at,
            gap: radius.min(60.0) + 4.0,
            places: AROUND,
            size: 11.0,
            spacing: 0.0,
            colour: COLOUR,
            opacity: 0.95,
            rank: if selected { -100.0 } else { 4.0 + 0.1 * object.magnitude.0 as f32 },
        });
    }
}

fn symbol(sketch: &mut Sketch, object: &MessierObject, at: Pos2, radius: f32) {
    let ink = &mut sketch.ink;
    let mut cross = |inner: f32, outer: f32| {
        for dir in [Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y] {
            ink.line(&[at + dir * inner, at + dir * outer], &WHOLE);
        }
    };
    match object.kind {
        "globular cluster" => {
            cross(0.0, radius);
            ink.ellipse(at, Vec2::splat(radius), 0.0, &WHOLE);
        }
        "planetary nebula" => {
            cross(radius, radius + 3.0);
            ink.ellipse(at, Vec2::splat(radius), 0.0, &WHOLE);
        }
        "double star" | "asterism" => cross(1.5, radius),
        "spiral galaxy" | "elliptical galaxy" | "irregular galaxy" => {
            let flat = object.size.map_or(0.5, |(length, width)| width.rad() / length.rad());
            let flat = (flat as f32).clamp(0.4, 0.75);
            // The way it lies is not known here.
            ink.ellipse(at, vec2(1.25 * radius, 1.25 * flat * radius), -0.5, &WHOLE);
        }
        "nebula" | "reflection nebula" | "supernova remnant" => {
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
            let square: Vec<Pos2> =
                corners.iter().map(|&(x, y)| at + 0.9 * radius * vec2(x, y)).collect();
            let pen = if object.kind == "supernova remnant" { DOTTED } else { WHOLE };
            ink.line(&square, &pen);
        }
        // Clusters and clouds of stars.
        _ => ink.ellipse(at, Vec2::splat(radius), 0.0, &DOTTED),
    }
}

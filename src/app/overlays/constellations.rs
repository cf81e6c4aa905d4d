//! Figures, boundaries and names of constellations.

use super::Sketch;
use super::axes::far_away;
use super::ink::Pen;
use super::labels::{Label, ON_OR_AROUND, id};
use crate::catalog::{ConstellationId, FigureStar};
use crate::frame::{Dir, Horizon};
use crate::sky::constellation::boundary_lines;

const FIGURE: Pen = Pen::new([140, 170, 220], 0.55, 1.2, &[]);
const BOUNDARY: Pen = Pen::new([204, 121, 167], 0.5, 0.9, &[3.0, 3.0]);
/// Figures stop so far from their stars, points, so that these are seen.
const FREE_OF_STARS: f64 = 6.0;
/// Names are written in the whole sky at a time, or less, degrees.
const WIDEST_DEG: f64 = 240.0;

/// Draws what is switched on.
pub fn draw(sketch: &mut Sketch) {
    let sky = &sketch.night.sky;
    if sketch.on.constellation_lines {
        for id in ConstellationId::all() {
            for line in &id.get().figure {
                let corners: Vec<Dir<Horizon>> =
                    line.iter().map(|star| corner(sketch, star)).collect();
                sketch.path(&corners, FREE_OF_STARS, &FIGURE);
            }
        }
    }
    if sketch.on.constellation_boundaries {
        for line in boundary_lines() {
            let corners: Vec<Dir<Horizon>> =
                line.iter().map(|&dir| sky.horizon_from_icrs * dir).collect();
            sketch.path(&corners, 0.0, &BOUNDARY);
        }
    }
    if sketch.on.constellation_names && sketch.field_deg() <= WIDEST_DEG {
        for constellation in ConstellationId::all() {
            let known = constellation.get();
            for (number, &place) in known.labels.iter().enumerate() {
                let seen = sketch.seen(far_away(sky, place));
                let Some(at) = sketch.point(seen) else { continue };
                // Where many are on the picture the three letters must do.
                let is_far = sketch.field_deg() > 110.0;
                let text = match is_far {
                    true => known.abbreviation.to_owned(),
                    false => known.latin.to_uppercase(),
                };
                sketch.labels.push(Label {
                    id: id(("constellation", constellation, number)),
                    text,
                    at,
                    gap: 8.0,
                    places: ON_OR_AROUND,
                    size: 12.0,
                    spacing: if is_far { 1.0 } else { 3.0 },
                    colour: FIGURE.colour,
                    opacity: 0.8,
                    rank: 1.5,
                });
            }
        }
    }
}

/// The star of a corner as it stands now.
fn corner(sketch: &Sketch, star: &FigureStar) -> Dir<Horizon> {
    let night = sketch.night;
    match sketch.number_of(star.hr) {
        Some(number) => night.sky.star(&night.stars[number]),
        None => far_away(&night.sky, star.dir_j2000),
    }
}

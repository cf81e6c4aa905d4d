//! The line of the horizon, and the winds along it.

use std::f64::consts::PI;

use eframe::egui::Align2;

use super::Sketch;
use super::curve::Curve;
use super::ink::Pen;
use super::labels::{Label, id};
use crate::frame::{Apparent, Dir, WINDS};
use crate::units::Angle;

const PEN: Pen = Pen::new(super::MARK_RGB, 0.9, 1.3, &[]);
/// Below this field all sixteen winds are named.
const NARROW_DEG: f64 = 75.0;
/// Letters stand on the ground, else above the line.
const ON_GROUND: &[Align2] = &[Align2::CENTER_TOP, Align2::CENTER_BOTTOM];

/// Draws what is switched on.
pub fn draw(sketch: &mut Sketch) {
    let altitude = sketch.night.horizon;
    if sketch.on.horizon {
        let at = |azimuth: f64| -> Dir<Apparent> {
            // A hair above the ground, which would hide it.
            let up = Angle::from_rad(altitude.rad() + 1e-9);
            Dir::from_azimuth_altitude(Angle::from_rad(azimuth), up)
        };
        let middle = sketch.picture.axis().azimuth().rad();
        let curve = Curve { at, from: middle - PI, to: middle + PI, rate_rad: 1.0 };
        sketch.curve(&curve, &PEN);
    }
    if sketch.on.cardinal_points {
        let every = if sketch.field_deg() < NARROW_DEG { 1 } else { 2 };
        for (number, name) in WINDS.iter().enumerate().step_by(every) {
            let azimuth = Angle::from_deg(22.5 * number as f64);
            let up = Angle::from_rad(altitude.rad() + 1e-9);
            let Some(at) = sketch.point(Dir::from_azimuth_altitude(azimuth, up)) else { continue };
            let main = 3 - name.len();
            sketch.labels.push(Label {
                id: id(("wind", number)),
                text: (*name).to_owned(),
                at,
                gap: 4.0,
                places: ON_GROUND,
                size: [12.0, 15.0, 20.0][main],
                spacing: 0.0,
                colour: super::MARK_RGB,
                opacity: 1.0,
                rank: -30.0 - main as f32,
            });
        }
    }
}

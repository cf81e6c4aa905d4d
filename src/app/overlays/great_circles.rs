//! Great circles with a name: ecliptic, celestial equator, meridian.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Sketch;
use super::axes::Axes;
use super::curve::Curve;
use super::ink::Pen;

const ECLIPTIC: Pen = Pen::new([240, 228, 66], 0.85, 1.6, &[10.0, 3.0, 2.0, 3.0]);
const EQUATOR: Pen = Pen::new([86, 180, 233], 0.85, 1.6, &[]);
const MERIDIAN: Pen = Pen::new([213, 94, 0], 0.85, 1.4, &[6.0, 3.0]);
/// Names are laid before the numbers of grids.
const NAME_RANK: f32 = 3.5;

/// Draws those that are switched on.
pub fn draw(sketch: &mut Sketch) {
    let (on, night) = (sketch.on, sketch.night);
    if on.ecliptic {
        equator(sketch, &Axes::ecliptic(night), "Ecliptic", &ECLIPTIC);
    }
    if on.celestial_equator {
        equator(sketch, &Axes::equator(night), "Celestial equator", &EQUATOR);
    }
    if on.meridian {
        let at = |along: f64| Axes::Local.at(0.0, along);
        let curve = Curve { at, from: -FRAC_PI_2, to: 3.0 * FRAC_PI_2, rate_rad: 1.0 };
        let lines = sketch.curve(&curve, &MERIDIAN);
        sketch.name_at_edges(&lines, "Meridian", "meridian", &MERIDIAN, NAME_RANK);
    }
}

fn equator(sketch: &mut Sketch, axes: &Axes, name: &str, pen: &Pen) {
    let (middle, _) = axes.of(sketch.picture.axis());
    let at = |longitude: f64| axes.at(longitude, 0.0);
    let curve = Curve { at, from: middle - PI, to: middle + PI, rate_rad: 1.0 };
    let lines = sketch.curve(&curve, pen);
    sketch.name_at_edges(&lines, name, name, pen, NAME_RANK);
}

//! Grids of longitude and latitude. The step follows the field, and the numbers stand at the edges.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::Sketch;
use super::axes::Axes;
use super::curve::Curve;
use super::ink::Pen;

/// A field is crossed by about so many lines.
const LINES_ACROSS: f64 = 7.0;
/// How much more sky than the picture spans there may be on it: air squeezes the low sky.
const SQUEEZED: f64 = 1.4;
/// Near a pole no more meridians than these.
const POLE_STEP_DEG: f64 = 15.0;
/// Steps in arcseconds.
const STEPS_ARCSEC: [f64; 21] = [
    0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1200.0, 1800.0,
    3600.0, 7200.0, 18_000.0, 36_000.0, 72_000.0, 108_000.0,
];
/// Steps of right ascension, seconds of time.
const STEPS_S: [f64; 18] = [
    0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 60.0, 120.0, 300.0, 600.0,
    1800.0, 3600.0,
];
/// Numbers are laid after names of things.
const EDGE_RANK: f32 = 8.0;
const ARCSEC_RAD: f64 = PI / 648_000.0;
const SECOND_RAD: f64 = PI / 43_200.0;

/// Azimuth and altitude: thin and whole.
pub const AZIMUTHAL: Pen = Pen::new([230, 159, 0], 0.45, 0.8, &[]);
/// Equator of date: stronger and whole.
pub const EQUATORIAL: Pen = Pen::new([86, 180, 233], 0.55, 1.1, &[]);
/// Equator of J2000.0: long dashes.
pub const J2000: Pen = Pen::new([0, 158, 115], 0.65, 1.0, &[9.0, 4.0]);
/// Ecliptic: dash and dot.
pub const ECLIPTIC: Pen = Pen::new([240, 228, 66], 0.55, 1.0, &[8.0, 3.0, 1.5, 3.0]);
/// Galactic: dots.
pub const GALACTIC: Pen = Pen::new([204, 121, 167], 0.8, 1.4, &[2.0, 5.0]);

/// How longitudes are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Count {
    Degrees,
    Hours,
}

/// Draws the grids that are switched on.
pub fn draw(sketch: &mut Sketch) {
    let (on, night) = (sketch.on, sketch.night);
    if on.azimuthal_grid {
        grid(sketch, "azimuthal", &Axes::Local, &AZIMUTHAL, Count::Degrees);
    }
    if on.equatorial_grid {
        grid(sketch, "equatorial", &Axes::equator(night), &EQUATORIAL, Count::Hours);
    }
    if on.j2000_grid {
        grid(sketch, "J2000", &Axes::j2000(night), &J2000, Count::Hours);
    }
    if on.ecliptic_grid {
        grid(sketch, "ecliptic", &Axes::ecliptic(night), &ECLIPTIC, Count::Degrees);
    }
    if on.galactic_grid {
        grid(sketch, "galactic", &Axes::galactic(night), &GALACTIC, Count::Degrees);
    }
}

fn grid(sketch: &mut Sketch, name: &str, axes: &Axes, pen: &Pen, count: Count) {
    let (lon, lat) = axes.of(sketch.picture.axis());
    let reach = (SQUEEZED * sketch.picture.reach().rad()).min(PI);
    let wanted_rad = sketch.span_rad() / LINES_ACROSS;
    let lat_step_arcsec = step(&STEPS_ARCSEC, wanted_rad / ARCSEC_RAD);
    let lat_step = lat_step_arcsec * ARCSEC_RAD;
    let (low, high) = ((lat - reach).max(-FRAC_PI_2), (lat + reach).min(FRAC_PI_2));
    let farthest = low.abs().max(high.abs());
    let holds_pole = lat.abs() + reach >= FRAC_PI_2;
    // Meridians draw together towards the pole.
    let wanted_lon = match holds_pole {
        true => wanted_rad.max(POLE_STEP_DEG.to_radians()),
        false => wanted_rad / lat.cos().max(1e-6),
    };
    let (unit_rad, lon_step) = match count {
        Count::Degrees => (ARCSEC_RAD, step(&STEPS_ARCSEC, wanted_lon / ARCSEC_RAD)),
        Count::Hours => (SECOND_RAD, step(&STEPS_S, wanted_lon / SECOND_RAD)),
    };
    let aside = match holds_pole {
        true => PI,
        false => (reach.sin() / lat.cos()).clamp(0.0, 1.0).asin().min(farthest + PI),
    };

    let first = (low / lat_step).ceil() as i64;
    let last = (high / lat_step).floor() as i64;
    for number in first..=last {
        let latitude = number as f64 * lat_step;
        if latitude.abs() > FRAC_PI_2 - 1e-9 {
            continue;
        }
        let curve = Curve {
            at: |longitude| axes.at(longitude, latitude),
            from: lon - aside,
            to: lon + aside,
            rate_rad: latitude.cos(),
        };
        let lines = sketch.curve(&curve, pen);
        let words = in_degrees(number as f64 * lat_step_arcsec, lat_step_arcsec, true);
        sketch.name_at_edges(&lines, &words, (name, "lat", number), pen, EDGE_RANK);
    }

    let lon_step_rad = lon_step * unit_rad;
    let around = (TAU / lon_step_rad).round() as i64;
    let first = ((lon - aside) / lon_step_rad).ceil() as i64;
    let last = ((lon + aside) / lon_step_rad).floor() as i64;
    for number in first..=last.min(first + around - 1) {
        let longitude = number as f64 * lon_step_rad;
        // Only every quarter runs to the pole itself.
        let quarter = around / 4;
        let is_long = quarter > 0 && number.rem_euclid(quarter) == 0;
        let end = if is_long { FRAC_PI_2 } else { FRAC_PI_2 - lat_step.min(0.2) };
        let (from, to) = (low.max(-end), high.min(end));
        if from >= to {
            continue;
        }
        let curve = Curve { at: |latitude| axes.at(longitude, latitude), from, to, rate_rad: 1.0 };
        let lines = sketch.curve(&curve, pen);
        let value = number.rem_euclid(around) as f64 * lon_step;
        let words = match count {
            Count::Degrees => in_degrees(value, lon_step, false),
            Count::Hours => in_hours(value, lon_step),
        };
        sketch.name_at_edges(
            &lines,
            &words,
            (name, "lon", number.rem_euclid(around)),
            pen,
            EDGE_RANK,
        );
    }
}

/// The least step that is no smaller than wanted, else the greatest.
fn step(steps: &[f64], wanted: f64) -> f64 {
    steps.iter().copied().find(|&step| step >= wanted).unwrap_or(steps[steps.len() - 1])
}

/// An angle as finely as steps of some arcseconds ask.
fn in_degrees(arcsec: f64, step_arcsec: f64, is_signed: bool) -> String {
    let sign = match is_signed {
        true if arcsec < 0.0 => "-",
        true if arcsec > 0.0 => "+",
        _ => "",
    };
    sign.to_owned() + &sexagesimal(arcsec.abs(), step_arcsec, ["\u{b0}", "'", "\""])
}

/// A right ascension as finely as steps of some seconds ask.
fn in_hours(seconds: f64, step_s: f64) -> String {
    sexagesimal(seconds, step_s, ["h", "m", "s"])
}

fn sexagesimal(value: f64, step: f64, [whole, sixtieth, second]: [&str; 3]) -> String {
    // In units of the hundredth, so that nothing is rounded up to sixty.
    let hundredths = (value * 100.0).round() as i64;
    let (high, rest) = (hundredths / 360_000, hundredths % 360_000);
    let (middle, low) = (rest / 6000, rest % 6000);
    let mut words = format!("{high}{whole}");
    if step % 3600.0 != 0.0 {
        words += &format!("{middle:02}{sixtieth}");
    }
    if step % 60.0 != 0.0 {
        words += &match step {
            step if step >= 1.0 => format!("{:02}{second}", low / 100),
            step if step >= 0.1 => format!("{:04.1}{second}", low as f64 / 100.0),
            _ => format!("{:05.2}{second}", low as f64 / 100.0),
        };
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_fine_as_the_step() {
        assert_eq!(in_degrees(-108_000.0, 36_000.0, true), "-30\u{b0}");
        assert_eq!(in_degrees(3600.0 + 20.0 * 60.0, 1200.0, false), "1\u{b0}20'");
        assert_eq!(in_degrees(0.0, 1200.0, true), "0\u{b0}00'");
        assert_eq!(in_degrees(59.9, 0.1, true), "+0\u{b0}00'59.9\"");
        assert_eq!(in_hours(5.0 * 3600.0 + 620.0, 20.0), "5h10m20s");
        assert_eq!(in_hours(3600.0, 3600.0), "1h");
        assert_eq!(step(&STEPS_S, 45.0), 60.0);
        assert_eq!(step(&STEPS_S, 1e9), 3600.0);
    }
}

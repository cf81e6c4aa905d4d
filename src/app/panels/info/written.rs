//! Numbers in words, to their error: the last digit is the first that may be wrong.

use crate::units::Angle;

/// Marks of minutes and seconds of arc: the fonts of the window have no primes.
pub const MINUTE: &str = "'";
pub const SECOND: &str = "\"";

/// Decimals of a number with an error: the last counts no more than the error, none finer than
/// `most`.
pub fn decimals(error: f64, most: usize) -> usize {
    (0..most).find(|&n| 10f64.powi(-(n as i32)) <= error * (1.0 + 1e-9)).unwrap_or(most)
}

/// A number with an error, digit groups unmarked; what is uncertain in front of the point is rounded.
pub fn number(value: f64, error: f64) -> String {
    let decimals = decimals(error, 9);
    let step = if error >= 10.0 { 10f64.powf(error.log10().floor()) } else { 1.0 };
    minus(format!(
        "{:.decimals$}",
        if decimals == 0 { (value / step).round() * step } else { value }
    ))
}

/// The same with a relative error.
pub fn relative(value: f64, share: f64) -> String {
    number(value, (value * share).abs().max(f64::MIN_POSITIVE))
}

/// A true minus, and no sign where there is nothing.
fn minus(digits: String) -> String {
    match digits.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| matches!(c, '0' | '.')) => rest.to_owned(),
        Some(rest) => format!("−{rest}"),
        None => digits,
    }
}

/// Parts of a whole, of degrees or of hours.
const PARTS: f64 = 60.0;

/// The value in units of the last digit that is written, rounded, and how it is written: 0 whole ones, 1
/// minutes, 2 seconds and more decimals of them.
fn steps(value: f64, error: f64) -> (i64, usize) {
    let (per_one, depth) = match error {
        e if e >= 1.0 => (1.0, 0),
        e if e >= 1.0 / PARTS => (PARTS, 1),
        e => {
            let seconds = decimals(e * PARTS * PARTS, 3);
            (PARTS * PARTS * 10f64.powi(seconds as i32), 2 + seconds)
        }
    };
    ((value * per_one).round() as i64, depth)
}

fn sexagesimal(steps: i64, depth: usize, marks: [&str; 3]) -> String {
    let [whole, minute, second] = marks;
    match depth {
        0 => format!("{steps}{whole}"),
        1 => format!("{}{whole} {:02}{minute}", steps / 60, steps % 60),
        _ => {
            let decimals = depth - 2;
            let scale = 10i64.pow(decimals as u32);
            let (seconds, part) = (steps / scale, steps % scale);
            let (degrees, minutes) = (seconds / 3600, seconds / 60 % 60);
            let part = if decimals > 0 { format!(".{part:0decimals$}") } else { String::new() };
            format!("{degrees}{whole} {minutes:02}{minute} {:02}{part}{second}", seconds % 60)
        }
    }
}

/// Degrees, minutes and seconds: `−16° 42' 58"`.
pub fn degrees(angle: Angle, error: Angle) -> String {
    let (steps, depth) = steps(angle.deg().abs(), error.deg());
    let sign = if angle.rad() < 0.0 && steps != 0 { "−" } else { "" };
    format!("{sign}{}", sexagesimal(steps, depth, ["°", MINUTE, SECOND]))
}

/// The same with its sign, as latitudes have it: `+7° 24' 25"`.
pub fn latitude(angle: Angle, error: Angle) -> String {
    let words = degrees(angle, error);
    if words.starts_with('−') { words } else { format!("+{words}") }
}

/// In `[0, 360°)`, after rounding too.
pub fn longitude(angle: Angle, error: Angle) -> String {
    let (steps, depth) = steps(angle.positive().deg(), error.deg());
    let (around, _) = self::steps(360.0, error.deg());
    sexagesimal(steps.rem_euclid(around), depth, ["°", MINUTE, SECOND])
}

/// Hours in `[0, 24)`: `6h 45m 08.9s`. An error of 15" is one of a second.
pub fn hours(angle: Angle, error: Angle) -> String {
    let (steps, depth) = steps(angle.positive().hours(), error.hours());
    let (around, _) = self::steps(24.0, error.hours());
    sexagesimal(steps.rem_euclid(around), depth, ["h", "m", "s"])
}

/// Hours from the meridian, west positive.
pub fn hour_angle(angle: Angle, error: Angle) -> String {
    let angle = angle.signed();
    let (steps, depth) = steps(angle.hours().abs(), error.hours());
    let sign = if angle.rad() < 0.0 && steps != 0 { "−" } else { "+" };
    format!("{sign}{}", sexagesimal(steps, depth, ["h", "m", "s"]))
}

/// A small angle in one unit: degrees, minutes or seconds, whichever suits it.
pub fn small(angle: Angle, error: Angle) -> String {
    match angle.deg().abs() {
        deg if deg >= 2.0 => format!("{}°", number(angle.deg(), error.deg())),
        deg if deg >= 2.0 / 60.0 => format!("{}{MINUTE}", number(angle.arcmin(), error.arcmin())),
        _ => format!("{}{SECOND}", number(angle.arcsec(), error.arcsec())),
    }
}

/// A bound of an error, to one digit, rounded up: `0.3"`.
pub fn bound(error: Angle) -> String {
    let (value, unit) = match error.arcsec() {
        s if s < 60.0 => (s, SECOND),
        s if s < 3600.0 => (s / 60.0, MINUTE),
        s => (s / 3600.0, "°"),
    };
    if value <= 0.0 {
        return format!("0{unit}");
    }
    let step = 10f64.powf(value.log10().floor());
    let up = (value / step - 1e-9).ceil() * step;
    let decimals = (-step.log10().round()).max(0.0) as usize;
    format!("{up:.decimals$}{unit}")
}

/// Time that light takes, from seconds.
pub fn light_time(seconds: f64, share: f64) -> String {
    match seconds {
        s if s < 100.0 => format!("{} s", relative(s, share.max(1e-4))),
        s if s < 6000.0 => format!("{} min", relative(s / 60.0, share.max(1e-4))),
        s => format!("{} h", relative(s / 3600.0, share.max(1e-4))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_end_where_the_error_begins() {
        let sec = Angle::from_arcsec;
        let angle = Angle::from_deg(16.716_111_1);
        assert_eq!(degrees(-angle, sec(3.0)), r#"−16° 42' 58""#);
        assert_eq!(degrees(angle, sec(0.3)), r#"16° 42' 58.0""#);
        assert_eq!(degrees(angle, sec(0.02)), r#"16° 42' 58.00""#);
        assert_eq!(degrees(angle, sec(100.0)), r#"16° 43'"#);
        assert_eq!(degrees(angle, sec(4000.0)), "17°");
        assert_eq!(degrees(-Angle::from_arcsec(0.2), sec(3.0)), r#"0° 00' 00""#);
        assert_eq!(latitude(Angle::from_deg(7.5), sec(1.0)), r#"+7° 30' 00""#);
        // Rounding carries over, and never says 60 or 360.
        assert_eq!(degrees(Angle::from_deg(9.999_999), sec(1.0)), r#"10° 00' 00""#);
        assert_eq!(longitude(Angle::from_deg(359.999_99), sec(1.0)), r#"0° 00' 00""#);
        assert_eq!(longitude(-sec(0.1), sec(1.0)), r#"0° 00' 00""#);
        assert_eq!(hours(Angle::from_hours(23.999_999_9), sec(3.0)), "0h 00m 00.0s");
        assert_eq!(hours(Angle::from_deg(101.287_155), sec(3.0)), "6h 45m 08.9s");
        assert_eq!(hour_angle(Angle::from_hours(23.5), sec(30.0)), "−0h 30m 00s");
    }

    #[test]
    fn numbers_bounds_and_small_angles() {
        assert_eq!(number(-2.345, 0.1), "−2.3");
        assert_eq!(number(-0.04, 0.1), "0.0");
        assert_eq!(number(384_399.8, 3.0), "384400");
        assert_eq!(number(384_399.8, 30.0), "384400");
        assert_eq!(number(8317.0, 300.0), "8300");
        assert_eq!(relative(5.203_363, 1e-6), "5.203363");
        assert_eq!(small(Angle::from_arcsec(45.26), Angle::from_arcsec(0.1)), r#"45.3""#);
        assert_eq!(small(Angle::from_arcmin(31.4), Angle::from_arcsec(6.0)), r#"31.4'"#);
        assert_eq!(bound(Angle::from_arcsec(0.31)), r#"0.4""#);
        assert_eq!(bound(Angle::from_arcsec(3.0)), r#"3""#);
        assert_eq!(bound(Angle::from_arcsec(90.0)), r#"2'"#);
        assert_eq!(light_time(499.0, 1e-6), "8.3167 min");
    }
}

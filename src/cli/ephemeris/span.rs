//! Rows at equal steps of civil time.

use std::ops::Range;

use crate::cli::error::CliError;
use crate::place::Place;
use crate::time::{self, CivilDateTime, Instant, JulianDate};
use crate::units::{Angle, DAY_S};

use super::names::Target;
use super::sheet::{Asked, KEY_NUMBERS};

/// Rows that one task reckons.
const BLOCK_ROWS: u64 = 512;
/// Steps between the last step and the end that are still rounding.
const ROUNDING: f64 = 1e-9;
/// The shortest step: civil time is kept to the nanosecond.
const SHORTEST_STEP_S: f64 = 1e-3;

/// A clock on the wall whose days all have 86400 s.
enum Civil {}

/// Which bodies, when and from where.
pub struct Span<'a> {
    targets: Vec<(&'a str, Target)>,
    /// As it was written; the other instants are so many steps later.
    from: Instant,
    step_s: f64,
    pub instants: u64,
    place: Option<Place>,
    /// Longitude, latitude and height of the place as people write them.
    place_numbers: [f64; 3],
}

impl<'a> Span<'a> {
    /// From the words of the command line.
    pub fn read(
        targets: Vec<(&'a str, Target)>,
        from: &str,
        to: Option<&str>,
        step: &str,
        place: Option<&Place>,
    ) -> Result<Span<'a>, CliError> {
        let zone = place.and_then(|place| place.time_zone);
        let instant = |text: &str| time::to_instant(&time::parse(text)?, zone);
        let step_s = step_s(step)?;
        let first = instant(from)?;
        let last = to.map_or(Ok(first), instant)?;
        let days = civil(&last) - civil(&first);
        if days < 0.0 {
            return Err(CliError::Usage(format!(
                "--to {last} is before --from {first}; give a later instant"
            )));
        }
        let instants = (days * DAY_S / step_s + ROUNDING).floor() as u64 + 1;
        // Radians round what people write: 30, not 29.999...96. The rows can be given back as they are
        // written.
        let rounded = |angle: Angle| (angle.deg() * 1e11).round() / 1e11;
        let place_numbers = place.map_or([0.0; 3], |place| {
            [rounded(place.longitude), rounded(place.latitude), place.height_m]
        });
        let [longitude_deg, latitude_deg, height_m] = place_numbers;
        Ok(Span {
            targets,
            from: first,
            step_s,
            instants,
            place: place.map(|_| Place::new(latitude_deg, longitude_deg, height_m)).transpose()?,
            place_numbers,
        })
    }

    pub fn has_place(&self) -> bool {
        self.place.is_some()
    }

    /// Whether the Moon is among the bodies.
    pub fn has_moon(&self) -> bool {
        let is_moon = |target: &Target| *target == Target::Body(crate::ephemeris::Body::Moon);
        self.targets.iter().any(|(_, target)| is_moon(target))
    }

    /// Ranges of instants, in order.
    pub fn blocks(&self) -> impl Iterator<Item = Range<u64>> {
        let size = (BLOCK_ROWS / self.targets.len() as u64).max(1);
        let end = self.instants;
        (0..end.div_ceil(size)).map(move |block| block * size..((block + 1) * size).min(end))
    }

    /// Each body at each of these instants.
    pub fn for_each_row(
        &self,
        instants: &Range<u64>,
        row: &mut dyn FnMut(&Asked) -> Result<(), String>,
    ) -> Result<(), CliError> {
        let centre = Place::new(0.0, 0.0, 0.0)?;
        let place = self.place.as_ref().unwrap_or(&centre);
        for index in instants.clone() {
            let instant = self.instant(index)?;
            let Instant { tt, ut1, .. } = instant;
            let [longitude_deg, latitude_deg, height_m] = self.place_numbers;
            let dates = [tt.day(), tt.fraction(), ut1.day(), ut1.fraction()];
            let [tt_1, tt_2, ut1_1, ut1_2] = dates;
            let numbers = [tt_1, tt_2, ut1_1, ut1_2, longitude_deg, latitude_deg, height_m];
            for &(body, target) in &self.targets {
                let written = [""; KEY_NUMBERS];
                row(&Asked { body, target, instant, place, numbers, written })
                    .map_err(|what| CliError::Usage(format!("{body}, {instant}: {what}")))?;
            }
        }
        Ok(())
    }

    /// So many steps after the first: by the clock on the wall, so that a table of days keeps its
    /// hour. Where a leap second falls into a step, it is a second longer.
    fn instant(&self, index: u64) -> Result<Instant, CliError> {
        if index == 0 {
            return Ok(self.from);
        }
        let later_s = self.step_s * index as f64;
        let days = (later_s / DAY_S).floor();
        let jd = civil(&self.from).plus_days(days).plus_seconds(later_s - days * DAY_S);
        Ok(Instant::from_civil_utc(&CivilDateTime::from_julian_date(jd)?)?)
    }
}

/// What the clock on the wall shows.
fn civil(instant: &Instant) -> JulianDate<Civil> {
    instant.utc_civil().julian_date()
}

/// Seconds in a step such as `1d`, `6h`, `10m`, `0.5s`.
fn step_s(step: &str) -> Result<f64, CliError> {
    let unit_s = match step.trim().as_bytes().last() {
        Some(b'd') => DAY_S,
        Some(b'h') => 3600.0,
        Some(b'm') => 60.0,
        Some(b's') => 1.0,
        _ => f64::NAN,
    };
    let number: Option<f64> =
        step.trim().get(..step.trim().len().saturating_sub(1)).and_then(|n| n.parse().ok());
    match number.map(|number| number * unit_s) {
        Some(step_s) if step_s >= SHORTEST_STEP_S && step_s.is_finite() => Ok(step_s),
        _ => Err(CliError::Usage(format!(
            "--step '{step}' is no step of a millisecond or more; write one like 1d, 6h, 10m or 30s"
        ))),
    }
}

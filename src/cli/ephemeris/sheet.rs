//! The columns of the tables, and rows put into them.

use crate::ephemeris::Tier;
use crate::export::table::{Cell, Column, Format, Kind, Part, Sheet};
use crate::place::Place;
use crate::time::Instant;

use super::names::Target;
use super::reckon::{FIGURES, Figures, GEOCENTRIC, MOON_GEOCENTRIC, MOON_TOPOCENTRIC, TOPOCENTRIC};

/// Columns that say what a row is about, in the order in which they are written.
pub const KEYS: [&str; 8] =
    ["body", "jd_tt_1", "jd_tt_2", "jd_ut1_1", "jd_ut1_2", "lon_deg_E", "lat_deg_N", "height_m"];
/// How many of them are numbers: all but the body.
pub const KEY_NUMBERS: usize = KEYS.len() - 1;

/// A row that is asked for.
#[derive(Debug, Clone)]
pub struct Asked<'a> {
    /// As it was written.
    pub body: &'a str,
    pub target: Target,
    pub instant: Instant,
    pub place: &'a Place,
    /// What [`KEYS`] say of instant and place, in their order.
    pub numbers: [f64; KEY_NUMBERS],
    /// The same as they were written; empty where nobody wrote them.
    pub written: [&'a str; KEY_NUMBERS],
}

/// Where a column comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Field {
    Body,
    /// By its place in [`Asked::numbers`].
    Key(usize),
    Utc,
    /// By its place in [`FIGURES`].
    Figure(usize),
    Tier,
    ErrorBound,
}

/// Which columns a table has.
#[derive(Debug, Clone)]
pub struct Layout {
    fields: Vec<Field>,
    /// What the tiers are called, in the order of [`Tier::ALL`].
    tiers: Vec<String>,
}

const JULIAN_DATES: std::ops::Range<usize> = 0..4;
const PLACE: std::ops::Range<usize> = 4..KEY_NUMBERS;

impl Layout {
    /// For rows that were given: all columns. People get the date instead of Julian dates.
    pub fn of_rows(format: Format) -> Layout {
        let is_for_people = format == Format::Aligned;
        Layout::new(!is_for_people, is_for_people, true, 0..FIGURES.len())
    }

    /// For a span: without a place what is seen from the centre of the Earth. People get the
    /// columns of the Moon where they ask for the Moon.
    pub fn of_span(format: Format, has_place: bool, has_moon: bool) -> Layout {
        let is_for_people = format == Format::Aligned;
        let wanted = (0..FIGURES.len()).filter(|index| {
            let is_of_moon = MOON_GEOCENTRIC.contains(index) || MOON_TOPOCENTRIC.contains(index);
            let is_topocentric = TOPOCENTRIC.contains(index) || MOON_TOPOCENTRIC.contains(index);
            (has_place || !is_topocentric) && (has_moon || !is_of_moon || !is_for_people)
        });
        Layout::new(!is_for_people, true, has_place && !is_for_people, wanted)
    }

    fn new(
        has_julian_dates: bool,
        has_utc: bool,
        has_place: bool,
        figures: impl Iterator<Item = usize>,
    ) -> Layout {
        let mut fields = vec![Field::Body];
        if has_julian_dates {
            fields.extend(JULIAN_DATES.map(Field::Key));
        }
        if has_utc {
            fields.push(Field::Utc);
        }
        if has_place {
            fields.extend(PLACE.map(Field::Key));
        }
        fields.extend(figures.map(Field::Figure));
        fields.extend([Field::Tier, Field::ErrorBound]);
        Layout { fields, tiers: Tier::ALL.iter().map(Tier::to_string).collect() }
    }

    pub fn columns(&self) -> Vec<Column> {
        let column = |field: &Field| match *field {
            Field::Body => Column { name: KEYS[0], kind: Kind::Text(10) },
            Field::Key(index) => Column { name: KEYS[index + 1], kind: Kind::Exact },
            Field::Utc => Column { name: "utc_iso", kind: Kind::Text(24) },
            Field::Figure(index) => Column { name: FIGURES[index].0, kind: FIGURES[index].1 },
            Field::Tier => Column { name: "tier", kind: Kind::Text(6) },
            Field::ErrorBound => Column { name: "error_bound_arcsec", kind: Kind::Fixed(4) },
        };
        self.fields.iter().map(column).collect()
    }

    /// Adds a row to a part of a sheet with these columns.
    pub fn add(&self, sheet: &Sheet, part: &mut Part, asked: &Asked, figures: &Figures) {
        let utc = if self.fields.contains(&Field::Utc) {
            asked.instant.to_string()
        } else {
            String::new()
        };
        let tier = Tier::ALL.iter().position(|tier| *tier == figures.tier);
        let tier = tier.map_or("", |index| &self.tiers[index]);
        let mut cells = [Cell::Blank; 4 + KEY_NUMBERS + FIGURES.len()];
        for (cell, field) in cells.iter_mut().zip(&self.fields) {
            *cell = match *field {
                Field::Body => Cell::Text(asked.body),
                Field::Key(index) if asked.written[index].is_empty() => {
                    Cell::Number(asked.numbers[index])
                }
                Field::Key(index) => Cell::Written(asked.written[index], asked.numbers[index]),
                Field::Utc => Cell::Text(&utc),
                Field::Figure(index) if figures.values[index].is_nan() => Cell::Blank,
                Field::Figure(index) => Cell::Number(figures.values[index]),
                Field::Tier => Cell::Text(tier),
                Field::ErrorBound => Cell::Number(figures.error_bound.arcsec()),
            };
        }
        sheet.add(part, &cells[..self.fields.len()]);
    }
}

const _: () = {
    // The ranges cut the columns where they should.
    assert!(GEOCENTRIC.end == TOPOCENTRIC.start && TOPOCENTRIC.end == MOON_GEOCENTRIC.start);
    assert!(MOON_GEOCENTRIC.end == MOON_TOPOCENTRIC.start && MOON_TOPOCENTRIC.end == FIGURES.len());
};

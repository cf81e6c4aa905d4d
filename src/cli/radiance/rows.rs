//! What each row of a file asks for.
//!
//! The columns stand in any order, others are passed over; so are blank lines and those that begin
//! with `#`. What the columns are says what is asked: with those of a view the sky there, without
//! them the ground.

use std::io::Read;

use crate::air::{AIR_TOP_KM, Atmosphere};
use crate::cli::ephemeris::Source;
use crate::cli::ephemeris::rows::{BYTE_ORDER_MARK, fields, is_passed_over, number, wrong};
use crate::cli::error::CliError;
use crate::units::Angle;

/// Columns about a sky that is described.
pub const SKY_KEYS: [&str; 6] = [
    "case",
    "wavelength_nm",
    "sun_elevation_deg",
    "view_elevation_deg",
    "rel_azimuth_deg",
    "observer_height_m",
];
/// Places in [`SKY_KEYS`].
const CASE: usize = 0;
const WAVELENGTH: usize = 1;
const SUN: usize = 2;
const VIEW: usize = 3;
const AZIMUTH: usize = 4;
const HEIGHT: usize = 5;
/// Columns about directions in a scene.
pub const SCENE_KEYS: [&str; 2] = ["altitude_deg", "azimuth_deg"];

/// Where observers stand without a column that says it, metres: as in the reference.
const REFERENCE_HEIGHT_M: f64 = 1.0;

/// A file of rows: the columns that were understood, and their cells.
pub struct Sheet {
    name: String,
    /// By place in the keys, in the order of the keys.
    pub columns: Vec<usize>,
    /// The number of the line, and a cell for each column.
    pub rows: Vec<(usize, Vec<String>)>,
}

impl Sheet {
    /// Reads a file whole.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, a head that lacks `needed` columns, a line with too many fields
    /// or too few.
    pub fn read(source: Source, keys: &[&str], needed: &[usize]) -> Result<Sheet, CliError> {
        let Source { name, mut reader, .. } = source;
        let mut bytes = Vec::new();
        reader
            .read_to_end(&mut bytes)
            .map_err(|error| CliError::Failure(format!("cannot read {name}: {error}")))?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
            wrong(&name, line, "is not UTF-8; save the file as UTF-8")
        })?;
        let text = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&text);
        let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !is_passed_over(line));
        let known = keys.join(",");
        let (number, head) = lines.next().ok_or_else(|| {
            let what = format!("there are no rows; the first line names the columns, of {known}");
            CliError::Usage(format!("{name}: {what}"))
        })?;
        let refuse = |what: String| wrong(&name, number, &what);
        let mut slots = Vec::new();
        for field in fields(head) {
            let field = field.map_err(&refuse)?;
            let slot = keys.iter().position(|key| *key == field);
            if slot.is_some() && slots.contains(&slot) {
                return Err(refuse(format!("the column {field} is there twice; leave one out")));
            }
            slots.push(slot);
        }
        let missing: Vec<&str> = needed
            .iter()
            .filter(|key| !slots.contains(&Some(**key)))
            .map(|key| keys[*key])
            .collect();
        if !missing.is_empty() {
            let missing = missing.join(", ");
            return Err(refuse(format!(
                "no column {missing} in its head; the first line names the columns, of {known}"
            )));
        }
        let mut columns: Vec<usize> = slots.iter().flatten().copied().collect();
        columns.sort_unstable();
        let mut rows = Vec::new();
        for (number, line) in lines {
            let refuse = |what: String| wrong(&name, number, &what);
            let cells: Vec<&str> = fields(line).collect::<Result<_, _>>().map_err(refuse)?;
            if cells.len() != slots.len() {
                let (there, wanted) = (cells.len(), slots.len());
                return Err(refuse(format!("there are {there} fields under {wanted} columns")));
            }
            let of = |key: &usize| {
                let at = slots.iter().position(|slot| *slot == Some(*key));
                at.map_or("", |at| cells[at]).to_owned()
            };
            rows.push((number, columns.iter().map(of).collect()));
        }
        Ok(Sheet { name, columns, rows })
    }

    fn has(&self, key: usize) -> bool {
        self.columns.contains(&key)
    }

    fn cell(&self, row: usize, key: usize) -> &str {
        let at = self.columns.iter().position(|column| *column == key);
        at.map_or("", |at| self.rows[row].1[at].as_str())
    }

    fn refuse(&self, row: usize, what: &str) -> CliError {
        wrong(&self.name, self.rows[row].0, what)
    }

    /// The number in a cell, within a range.
    fn number(
        &self,
        row: usize,
        keys: &[&str],
        key: usize,
        range: [f64; 2],
    ) -> Result<f64, CliError> {
        let name = keys[key];
        let value = number(name, self.cell(row, key)).map_err(|what| self.refuse(row, &what))?;
        let [low, high] = range;
        if !(low..=high).contains(&value) {
            let what = format!("{name} is {value}, outside {low} to {high}; choose a value inside");
            return Err(self.refuse(row, &what));
        }
        Ok(value)
    }
}

/// A direction, seen from the observer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    pub elevation: Angle,
    pub azimuth_from_sun: Angle,
}

/// What a row about a sky asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// Which of the airs.
    pub air: usize,
    pub height_m: f64,
    pub sun: Angle,
    pub wavelength_nm: Option<f64>,
    /// None: the ground.
    pub view: Option<View>,
}

/// A file of rows about skies.
pub struct SkyRows {
    pub sheet: Sheet,
    pub airs: Vec<Atmosphere>,
    pub asked: Vec<Asked>,
}

impl SkyRows {
    /// Understands a file; an air that is given stands for all cases.
    pub fn read(source: Source, air: Option<Atmosphere>) -> Result<SkyRows, CliError> {
        let needed: &[usize] = if air.is_some() { &[SUN] } else { &[CASE, SUN] };
        let sheet = Sheet::read(source, &SKY_KEYS, needed)?;
        if sheet.has(VIEW) != sheet.has(AZIMUTH) {
            let message = format!(
                "{}: one of the columns view_elevation_deg and rel_azimuth_deg is missing; give both \
                 for the sky, none for the ground",
                sheet.name
            );
            return Err(CliError::Usage(message));
        }
        let is_given = air.is_some();
        let airs = match air {
            Some(air) => vec![air],
            None => vec![Atmosphere::named("reference-a")?, Atmosphere::named("reference-b")?],
        };
        let asked = (0..sheet.rows.len())
            .map(|row| asked(&sheet, row, is_given))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(SkyRows { sheet, airs, asked })
    }

    /// Whether the rows are about the sky, not the ground.
    pub fn has_views(&self) -> bool {
        self.sheet.has(VIEW)
    }

    pub fn has_wavelengths(&self) -> bool {
        self.sheet.has(WAVELENGTH)
    }
}

fn asked(sheet: &Sheet, row: usize, air_is_given: bool) -> Result<Asked, CliError> {
    let number = |key: usize, low: f64, high: f64| sheet.number(row, &SKY_KEYS, key, [low, high]);
    let air = match sheet.cell(row, CASE).as_bytes().first() {
        _ if air_is_given => 0,
        Some(b'A') => 0,
        Some(b'B') => 1,
        _ => {
            let case: String = sheet.cell(row, CASE).chars().take(40).collect();
            let what = format!(
                "case '{case}' begins with neither A nor B, the reference airs; give --atmosphere for \
                 another"
            );
            return Err(sheet.refuse(row, &what));
        }
    };
    let degrees = |key: usize, most: f64| number(key, -most, most).map(Angle::from_deg);
    let view = match sheet.has(VIEW) {
        true => {
            let (elevation, azimuth_from_sun) = (degrees(VIEW, 90.0)?, degrees(AZIMUTH, 3600.0)?);
            Some(View { elevation, azimuth_from_sun })
        }
        false => None,
    };
    Ok(Asked {
        air,
        height_m: match sheet.has(HEIGHT) {
            true => number(HEIGHT, -430.0, HIGHEST_M)?,
            false => REFERENCE_HEIGHT_M,
        },
        sun: degrees(SUN, 90.0)?,
        wavelength_nm: match sheet.has(WAVELENGTH) {
            true => Some(number(WAVELENGTH, 360.0, 830.0)?),
            false => None,
        },
        view,
    })
}

/// No observer stands higher: half of the air of the tables.
const HIGHEST_M: f64 = 500.0 * AIR_TOP_KM;

/// Directions in a scene: apparent altitude and azimuth.
pub fn directions(sheet: &Sheet) -> Result<Vec<[Angle; 2]>, CliError> {
    (0..sheet.rows.len())
        .map(|row| {
            let degrees = |key: usize, most: f64| {
                sheet.number(row, &SCENE_KEYS, key, [-most, most]).map(Angle::from_deg)
            };
            Ok([degrees(0, 90.0)?, degrees(1, 3600.0)?])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, air: Option<Atmosphere>) -> Result<SkyRows, String> {
        let reader = Box::new(std::io::Cursor::new(text.to_owned().into_bytes()));
        let source = Source { name: "rows.csv".to_owned(), reader, bytes: None };
        SkyRows::read(source, air).map_err(|error| error.message().unwrap_or_default())
    }

    #[test]
    fn columns_stand_in_any_order() {
        let rows = read(
            "\u{feff}# a comment\nnote,rel_azimuth_deg,case,view_elevation_deg,sun_elevation_deg\n\
             \"x, y\",45,B_hazy,30,-3\n",
            None,
        )
        .unwrap();
        let [Asked { air, height_m, sun, wavelength_nm, view }] = rows.asked[..] else {
            panic!("one row")
        };
        assert_eq!((air, height_m, wavelength_nm), (1, 1.0, None));
        assert!((sun.deg() + 3.0).abs() < 1e-12);
        assert!((view.unwrap().elevation.deg() - 30.0).abs() < 1e-12);
        assert_eq!(rows.sheet.rows[0].1, ["B_hazy", "-3", "30", "45"]);
        assert!(rows.airs[1].aerosols()[0].is_some() && rows.airs[0].aerosols()[0].is_none());
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let head = "case,wavelength_nm,sun_elevation_deg,view_elevation_deg,rel_azimuth_deg\n";
        for (row, told) in [
            ("C,550,45,90,0", "line 2: case 'C' begins with neither A nor B"),
            ("A,550,95,90,0", "line 2: sun_elevation_deg is 95, outside -90 to 90"),
            ("A,200,45,90,0", "line 2: wavelength_nm is 200, outside 360 to 830"),
            ("A,550,45,,0", "line 2: view_elevation_deg is blank"),
            ("A,550,45,NaN,0", "line 2: view_elevation_deg 'NaN' is no number"),
            ("A,550,45,90", "line 2: there are 4 fields under 5 columns"),
            ("A,550,\"45,90,0", "line 2: a quoted field is not closed"),
        ] {
            let message = read(&format!("{head}{row}\n"), None).err().unwrap();
            assert!(message.starts_with(&format!("rows.csv, {told}")), "{row}: {message}");
        }
        for (file, told) in [
            ("", "rows.csv: there are no rows"),
            ("case,wavelength_nm\n", "line 1: no column sun_elevation_deg in its head"),
            ("sun_elevation_deg\n", "line 1: no column case in its head"),
            ("case,case,sun_elevation_deg\n", "line 1: the column case is there twice"),
            ("case,sun_elevation_deg,view_elevation_deg\n", "rel_azimuth_deg is missing"),
        ] {
            let message = read(file, None).err().unwrap();
            assert!(message.contains(told), "{file}: {message}");
        }
        assert!(read("sun_elevation_deg\n3\n", Some(Atmosphere::default())).is_ok());
    }
}

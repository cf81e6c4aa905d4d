//! From the raw tables to the files that the program reads.
//!
//! Same input, same bytes: no clock, no random order, no map that iterates as it likes.

use std::fs;
use std::path::Path;

use crate::frame::{Dir, Galactic};
use crate::units::Angle;

use super::bsc5::{self, BscError};
use super::csv::RowError;
use super::milky_way::{self, Picture};
use super::moon::albedo::{self, Calibration};
use super::moon::{hapke, relief};
use super::places;
use super::seal::sha256_hex;
use super::stars;
use super::{
    CatalogError, HAPKE_FILE, MILKY_WAY_FILE, MOON_FILE, PLACES_FILE, RELIEF_FILE, STARS_FILE,
};

/// The file that says where every other file comes from.
pub const SOURCES_FILE: &str = "SOURCES.toml";

const RAW_STARS: &str = "bsc5.csv";
const RAW_NAMES: &str = "star_names_iau.csv";
const RAW_PLACES: &str = "cities.csv";
const RAW_CALIBRATION: &str = "moon_albedo_calibration.csv";

/// A file to be written, by its name in the directory of the catalogues.
#[derive(Debug, Clone, PartialEq)]
pub struct Packed {
    pub file: &'static str,
    pub bytes: Vec<u8>,
    /// What was done, for people.
    pub summary: String,
}

/// `stars.bin` from the Bright Star Catalogue and the names in the directory `raw`.
pub fn stars(raw: &Path) -> Result<Packed, CatalogError> {
    let (catalogue, names) = (read_text(raw, RAW_STARS)?, read_text(raw, RAW_NAMES)?);
    let records = bsc5::records(&catalogue, &names).map_err(|error| match error {
        BscError::Catalogue(error) => raw_error(raw, RAW_STARS, error),
        BscError::Names(error) => raw_error(raw, RAW_NAMES, error),
    })?;
    let bytes = stars::encode(&records).map_err(|what| raw_error(raw, RAW_STARS, (1, what)))?;
    let estimated = records.iter().filter(|star| star.b_v_estimated).count();
    let named = records.iter().filter(|star| star.name.is_some()).count();
    let summary = format!(
        "{} stars, {named} with a name, {estimated} with B-V estimated from the spectral type",
        records.len()
    );
    Ok(Packed { file: STARS_FILE, bytes, summary })
}

/// `places.csv` from the gazetteer in the directory `raw`.
pub fn places(raw: &Path) -> Result<Packed, CatalogError> {
    let cleaned = places::clean(&read_text(raw, RAW_PLACES)?)
        .map_err(|error| raw_error(raw, RAW_PLACES, error))?;
    let summary = format!(
        "{} places; {} values corrected, {} elevations and {} time zones taken from neighbours",
        cleaned.table.lines().count() - 1,
        places::CORRECTIONS.len(),
        cleaned.elevations_filled,
        cleaned.timezones_filled
    );
    Ok(Packed { file: PLACES_FILE, bytes: places::seal(&cleaned.table), summary })
}

/// `moon_albedo.bin` from a picture (red, green, blue, a byte each; longitude -180° to 180° from
/// left to right) and the calibration in the directory `raw`.
pub fn moon(raw: &Path, rgb: &[u8], size: (usize, usize)) -> Result<Packed, CatalogError> {
    let calibration = Calibration::from_csv(&read_text(raw, RAW_CALIBRATION)?)
        .map_err(|error| raw_error(raw, RAW_CALIBRATION, error))?;
    let bytes =
        albedo::encode(rgb, size, &calibration).map_err(|what| CatalogError::Picture { what })?;
    let (width, height) = albedo::PACKED_SIZE;
    let summary = format!("{width} x {height} pixels from {} x {}", size.0, size.1);
    Ok(Packed { file: MOON_FILE, bytes, summary })
}

/// `moon_relief.bin` from a picture of heights: metres above 1737.4 km plus 32768, longitude 0° to
/// 360° from left to right.
pub fn moon_relief(metres: &[u16], size: (usize, usize)) -> Result<Packed, CatalogError> {
    let bytes = relief::encode(metres, size).map_err(|what| CatalogError::Picture { what })?;
    let summary = format!("{} x {} heights within 1 m", size.0, size.1);
    Ok(Packed { file: RELIEF_FILE, bytes, summary })
}

/// `moon_hapke.bin` from the maps of Sato et al. 2014: 16-bit floating-point numbers, three bands of
/// 140 rows of 360 cells of five parameters.
pub fn moon_hapke(f16_bytes: &[u8]) -> Result<Packed, CatalogError> {
    let bytes = hapke::encode(f16_bytes).map_err(|what| CatalogError::Picture { what })?;
    let summary = "cells of 2 degrees, 3 bands of 5 parameters".into();
    Ok(Packed { file: HAPKE_FILE, bytes, summary })
}

/// `milky_way.bin` from Gaia's sky in colour (red, green, blue, a byte each; galactic, `l = 0` in the
/// middle, growing to the left).
pub fn milky_way(rgb: &[u8], size: (usize, usize)) -> Result<Packed, CatalogError> {
    let wrong = |what| CatalogError::Picture { what };
    let bytes = milky_way::encode(&Picture::new(rgb, size).map_err(wrong)?).map_err(wrong)?;
    let edge = milky_way::PACKED_SIZE;
    let summary = format!("{edge} x {edge} texels from {} x {}", size.0, size.1);
    Ok(Packed { file: MILKY_WAY_FILE, bytes, summary })
}

/// A table of places (`name,l_deg,b_deg`, further columns are replaced) with the starlight that the
/// picture of [`milky_way`] has within half a degree of them: S10(V) and colour, before packing.
pub fn starlight_table(
    rgb: &[u8],
    size: (usize, usize),
    places: &str,
) -> Result<String, CatalogError> {
    let wrong = |what| CatalogError::Picture { what };
    let picture = Picture::new(rgb, size).map_err(wrong)?;
    let mut table = String::from("name,l_deg,b_deg,s10,colour\n");
    for line in places.lines().skip(1) {
        let mut cells = line.split(',');
        let (name, l, b) = (cells.next(), cells.next(), cells.next());
        let number = |cell: Option<&str>| cell.and_then(|cell| cell.trim().parse::<f64>().ok());
        let (Some(name), Some(l), Some(b)) = (name, number(l), number(b)) else {
            return Err(wrong(format!("cannot be read at {line:?}, which is no name,l_deg,b_deg")));
        };
        let dir = Dir::<Galactic>::from_spherical(Angle::from_deg(l), Angle::from_deg(b));
        let (s10, colour) = picture.mean_within(dir.vector(), Angle::from_deg(0.5));
        table += &format!("{name},{l},{b},{s10:.3},{colour:.4}\n");
    }
    Ok(table)
}

/// The text of `SOURCES.toml` with the SHA-256 of these files brought up to date.
///
/// In each `[[file]]` table the line `path = "..."` stands before the line `sha256 = "..."`.
pub fn refresh_sources(sources: &str, packed: &[Packed]) -> Result<String, CatalogError> {
    let mut refreshed = String::with_capacity(sources.len());
    let mut current = None;
    let mut done = Vec::new();
    for line in sources.lines() {
        if let Some(path) = line.strip_prefix("path = ") {
            current = packed.iter().find(|packed| path.trim_matches('"') == packed.file);
        }
        match current {
            Some(packed) if line.starts_with("sha256 = ") => {
                refreshed += &format!("sha256 = \"{}\"", sha256_hex(&packed.bytes));
                done.push(packed.file);
            }
            _ => refreshed += line,
        }
        refreshed.push('\n');
    }
    match packed.iter().find(|packed| !done.contains(&packed.file)) {
        Some(packed) => Err(CatalogError::NoSource { file: packed.file }),
        None => Ok(refreshed),
    }
}

fn read_text(directory: &Path, file: &str) -> Result<String, CatalogError> {
    let path = directory.join(file);
    fs::read_to_string(&path).map_err(|source| CatalogError::RawUnreadable { path, source })
}

fn raw_error(directory: &Path, file: &str, (line, what): RowError) -> CatalogError {
    CatalogError::Raw { path: directory.join(file), line, what }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_refreshed_in_their_own_table_only() {
        let packed = Packed { file: STARS_FILE, bytes: b"abc".to_vec(), summary: String::new() };
        let sources = "[[file]]\npath = \"stars.bin\"\nsource = \"x\"\nsha256 = \"0\"\n\n\
            [[file]]\npath = \"places.csv\"\nsha256 = \"1\"\n";
        let digest = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        let wanted = sources.replace("\"0\"", &format!("{digest:?}"));
        assert_eq!(refresh_sources(sources, std::slice::from_ref(&packed)).unwrap(), wanted);
        let other = Packed { file: MOON_FILE, ..packed };
        let message = refresh_sources(sources, &[other]).unwrap_err().to_string();
        assert!(message.contains("moon_albedo.bin"), "{message}");
    }
}

//! `places.csv`: the gazetteer, cleaned, under a first line that says its version and SHA-256.
//!
//! It stays a table that people can read and search: one line of seal, one line of column names,
//! then one line per place. Degrees north and east, metres above sea level, IANA time zones.

use std::ops::RangeInclusive;

use super::csv::{self, RowError};
use super::seal::sha256_hex;
use crate::frame::{Dir, Itrs};
use crate::units::{Angle, EARTH_EQUATORIAL_RADIUS_KM};

/// The columns of the gazetteer, in order.
pub const COLUMNS: &str = "name,admin1,region,kind,population,lat_deg,lon_deg,elevation_m,timezone";
const VERSION: u32 = 1;

const NAME: usize = 0;
const REGION: usize = 2;
const KIND: usize = 3;
const POPULATION: usize = 4;
const LAT_DEG: usize = 5;
const LON_DEG: usize = 6;
const ELEVATION_M: usize = 7;
const TIMEZONE: usize = 8;

const KINDS: [&str; 4] = ["capital", "regional_capital", "city", "observatory"];
/// From the shore of the Dead Sea to above every town and observatory.
const ELEVATION_RANGE_M: RangeInclusive<f64> = -430.0..=6000.0;

/// A single value of the raw table that is wrong, and the right one.
pub struct Correction {
    pub name: &'static str,
    column: usize,
    wrong: &'static str,
    right: &'static str,
    pub reason: &'static str,
}

/// Values of the raw table known to be wrong. Each must still be there, or packing stops.
pub const CORRECTIONS: [Correction; 6] = [
    Correction {
        name: "North Georgia Astronomical Observatory",
        column: LON_DEG,
        wrong: "84.05389",
        right: "-84.05389",
        reason: "Georgia, USA, is west of Greenwich; the sign was lost",
    },
    Correction {
        name: "Guernsey Observatory",
        column: LON_DEG,
        wrong: "2.6358",
        right: "-2.6358",
        reason: "Guernsey is west of Greenwich; the sign was lost",
    },
    Correction {
        name: "Detroit Observatory",
        column: TIMEZONE,
        wrong: "America/Chicago",
        right: "America/Detroit",
        reason: "it stands in Ann Arbor, Michigan",
    },
    Correction {
        name: "Fremont Peak Observatory",
        column: TIMEZONE,
        wrong: "America/Phoenix",
        right: "America/Los_Angeles",
        reason: "it stands in California",
    },
    Correction {
        name: "Mountain Skies Observatory",
        column: TIMEZONE,
        wrong: "America/Los_Angeles",
        right: "America/Denver",
        reason: "it stands in Wyoming",
    },
    Correction {
        name: "Huairou Solar Observing Station",
        column: REGION,
        wrong: "Western Europe",
        right: "Eastern Asia",
        reason: "it stands by Beijing",
    },
];

/// An elevation is looked for in places no farther than this; beyond it sea level stands in.
const ELEVATION_WITHIN_KM: f64 = 50.0;
/// A time zone likewise; beyond it packing stops.
const TIMEZONE_WITHIN_KM: f64 = 200.0;

/// The raw table without [`CORRECTIONS`]' errors and without holes, and what was filled in.
///
/// Named steps, in this order:
///
/// 1. [`CORRECTIONS`], value by value.
/// 2. An elevation is *unknown* if it is below -430 m (the raw table writes -9999 for unknown, and
///    -2000 for a detector in a mine), or if an observatory has 10 m or less (more than 200 do,
///    in the Alps and on Mauna Kea too: the raw table writes 0 for unknown). It takes the
///    elevation of the nearest place that has one.
/// 3. An empty time zone takes that of the nearest place that has one.
pub(super) fn clean(raw: &str) -> Result<Cleaned, RowError> {
    let mut rows: Vec<(usize, Vec<String>)> = csv::rows(raw, COLUMNS)?
        .into_iter()
        .map(|(line, row)| (line, row.into_iter().map(|field| field.into_owned()).collect()))
        .collect();
    for correction in &CORRECTIONS {
        correct(&mut rows, correction)?;
    }
    let mut directions = Vec::with_capacity(rows.len());
    for (line, row) in &rows {
        directions.push(direction(row).map_err(|what| (*line, what))?);
    }
    let nearest = |to: usize, known: &dyn Fn(&[String]) -> bool, within_km: f64| {
        let cos_limit = (within_km / EARTH_EQUATORIAL_RADIUS_KM).cos();
        (0..rows.len())
            .filter(|&other| known(&rows[other].1))
            .map(|other| (directions[to].dot(directions[other]), other))
            .filter(|&(cosine, _)| cosine >= cos_limit)
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, other)| &rows[other].1)
    };
    let mut fills = Vec::new();
    for (at, (line, row)) in rows.iter().enumerate() {
        if !elevation_is_known(row) {
            let value = nearest(at, &|other| elevation_is_known(other), ELEVATION_WITHIN_KM)
                .map_or("0", |other| other[ELEVATION_M].as_str());
            fills.push((at, ELEVATION_M, value.to_owned()));
        }
        if row[TIMEZONE].is_empty() {
            let value = nearest(at, &|other| !other[TIMEZONE].is_empty(), TIMEZONE_WITHIN_KM)
                .ok_or_else(|| (*line, format!("{} has no time zone", row[NAME])))?;
            fills.push((at, TIMEZONE, value[TIMEZONE].clone()));
        }
    }
    let [mut elevations_filled, mut timezones_filled] = [0, 0];
    for (at, column, value) in fills {
        *(if column == TIMEZONE { &mut timezones_filled } else { &mut elevations_filled }) += 1;
        rows[at].1[column] = value;
    }
    let mut table = format!("{COLUMNS}\n");
    for (line, row) in &rows {
        check(row).map_err(|what| (*line, what))?;
        table.push_str(&csv::line(row));
        table.push('\n');
    }
    Ok(Cleaned { table, elevations_filled, timezones_filled })
}

/// What [`clean`] gives.
pub(super) struct Cleaned {
    pub table: String,
    pub elevations_filled: usize,
    pub timezones_filled: usize,
}

fn correct(rows: &mut [(usize, Vec<String>)], correction: &Correction) -> Result<(), RowError> {
    let Correction { name, column, wrong, right, .. } = *correction;
    let mut found = rows.iter_mut().filter(|(_, row)| row[NAME] == name && row[column] == wrong);
    match (found.next(), found.next()) {
        (Some((_, row)), None) => {
            row[column] = right.to_owned();
            Ok(())
        }
        (Some(_), Some(&mut (line, _))) => Err((line, format!("there are two of {name}"))),
        (None, _) => Err((1, format!("the correction of {name} from {wrong:?} has no row"))),
    }
}

fn elevation_is_known(row: &[String]) -> bool {
    let Ok(elevation_m) = row[ELEVATION_M].parse::<f64>() else { return false };
    elevation_m >= *ELEVATION_RANGE_M.start()
        && !(row[KIND] == "observatory" && elevation_m <= 10.0)
}

fn direction(row: &[impl AsRef<str>]) -> Result<Dir<Itrs>, String> {
    let latitude = within(row, LAT_DEG, "latitude", -90.0..=90.0)?;
    let longitude = within(row, LON_DEG, "longitude", -180.0..=180.0)?;
    Ok(Dir::from_spherical(Angle::from_deg(longitude), Angle::from_deg(latitude)))
}

fn within(
    row: &[impl AsRef<str>],
    column: usize,
    what: &str,
    range: RangeInclusive<f64>,
) -> Result<f64, String> {
    let field = row[column].as_ref();
    match field.parse::<f64>() {
        Ok(value) if range.contains(&value) => Ok(value),
        _ => {
            let (name, (low, high)) = (row[NAME].as_ref(), range.into_inner());
            Err(format!("{name} has {what} {field:?}, not a number from {low} to {high}"))
        }
    }
}

/// Says what cannot be true of a place, if anything.
fn check(row: &[impl AsRef<str>]) -> Result<(), String> {
    let name = row[NAME].as_ref();
    if name.is_empty() {
        return Err("a place has no name".into());
    }
    direction(row)?;
    within(row, ELEVATION_M, "elevation (m)", ELEVATION_RANGE_M)?;
    if row[POPULATION].as_ref().parse::<u64>().is_err() {
        return Err(format!("{name} has population {:?}", row[POPULATION].as_ref()));
    }
    if !KINDS.contains(&row[KIND].as_ref()) {
        return Err(format!("{name} is of the kind {:?}", row[KIND].as_ref()));
    }
    if row[TIMEZONE].as_ref().parse::<chrono_tz::Tz>().is_err() {
        return Err(format!("{name} has the unknown time zone {:?}", row[TIMEZONE].as_ref()));
    }
    Ok(())
}

fn first_line(table: &str) -> String {
    format!(
        "# Nocturne gazetteer {VERSION}, SHA-256 of the lines below: {}",
        sha256_hex(table.as_bytes())
    )
}

/// The bytes of `places.csv` for a table.
pub(super) fn seal(table: &str) -> Vec<u8> {
    format!("{}\n{table}", first_line(table)).into_bytes()
}

/// The table in `places.csv`, from its line of column names on, every row checked.
pub(super) fn open(bytes: Vec<u8>) -> Result<String, String> {
    let text = String::from_utf8(bytes).map_err(|_| "is not UTF-8")?;
    let (first, table) = text.split_once('\n').ok_or("has no second line")?;
    let version = first
        .strip_prefix("# Nocturne gazetteer ")
        .and_then(|rest| rest.split_once(','))
        .ok_or("does not begin as a gazetteer: it is another kind of file")?
        .0;
    if version != VERSION.to_string() {
        return Err(format!(
            "is in format version {version}, and this program reads version {VERSION}"
        ));
    }
    if first != first_line(table) {
        return Err("does not match the SHA-256 in its first line".into());
    }
    let rows = csv::rows(table, COLUMNS).map_err(|(line, what)| format!("line {line}: {what}"))?;
    for (_, row) in rows {
        check(&row)?;
    }
    Ok(table.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "name,admin1,region,kind,population,lat_deg,lon_deg,elevation_m,timezone\n\
        Bern,Bern,Western Europe,capital,121631,46.94809,7.44744,549,Europe/Zurich\n\
        \"Washington (Washington, D.C.)\",\"Washington, D.C.\",Northern America,capital,689545,\
        38.89511,-77.03637,6,America/New_York\n";

    #[test]
    fn what_was_sealed_opens() {
        assert_eq!(open(seal(TABLE)).unwrap(), TABLE);
    }

    #[test]
    fn every_flipped_bit_and_every_cut_is_refused() {
        let bytes = seal(TABLE);
        for at in 0..bytes.len() * 8 {
            let mut flipped = bytes.clone();
            flipped[at / 8] ^= 1 << (at % 8);
            assert!(open(flipped).is_err(), "bit {at}");
        }
        for length in 0..bytes.len() {
            assert!(open(bytes[..length].to_vec()).is_err(), "length {length}");
        }
    }

    #[test]
    fn another_kind_and_another_version_are_named_as_such() {
        let other = open(TABLE.as_bytes().to_vec()).unwrap_err();
        assert!(other.contains("another kind"), "{other}");
        let newer =
            String::from_utf8(seal(TABLE)).unwrap().replacen("gazetteer 1", "gazetteer 2", 1);
        let newer = open(newer.into_bytes()).unwrap_err();
        assert!(newer.contains("format version 2"), "{newer}");
    }

    #[test]
    fn impossible_places_are_refused_in_a_sealed_file_too() {
        for (right, wrong, what) in [
            ("46.94809", "96.94809", "latitude"),
            ("7.44744", "187.44744", "longitude"),
            ("7.44744", "NaN", "longitude"),
            (",549,", ",-9999,", "elevation"),
            (",121631,", ",many,", "population"),
            (",capital,121631", ",village,121631", "kind"),
            ("Europe/Zurich", "Europe/Bern", "time zone"),
            ("\nBern,", "\n,", "no name"),
            ("\nBern,", "\n", "fields"),
        ] {
            let message = open(seal(&TABLE.replacen(right, wrong, 1))).unwrap_err();
            assert!(message.contains(what), "{message}");
        }
    }

    /// A raw table with what [`CORRECTIONS`] expect, and more rows.
    fn raw(rows: &str) -> String {
        let mut raw = format!("{COLUMNS}\n");
        for correction in &CORRECTIONS {
            let mut row = ["", "", "R", "observatory", "0", "50.0", "20.0", "2000", "UTC"];
            row[NAME] = correction.name;
            row[correction.column] = correction.wrong;
            raw += &(row.join(",") + "\n");
        }
        raw + rows
    }

    #[test]
    fn corrections_are_made_and_must_find_their_row() {
        let table = clean(&raw("")).unwrap().table;
        assert!(
            table
                .contains("North Georgia Astronomical Observatory,,R,observatory,0,50.0,-84.05389")
        );
        assert!(
            table.contains("Detroit Observatory,,R,observatory,0,50.0,20.0,2000,America/Detroit")
        );
        let corrected = raw("").replace("84.05389", "-84.05389");
        assert!(clean(&corrected).is_err_and(|(_, what)| what.contains("North Georgia")));
    }

    #[test]
    fn unknown_elevations_and_zones_come_from_the_nearest_place_that_has_them() {
        let cleaned = clean(&raw("Far,,R,city,1,-10.0,0.4,700,Africa/Lagos\n\
             Near,,R,city,1,-10.0,0.1,300,Africa/Accra\n\
             Dome,,R,observatory,0,-10.0,0.0,0,\n\
             Mine,,R,observatory,0,-10.0,0.3,-2000,UTC\n\
             Port,,R,city,1,-40.0,0.0,-9999,UTC\n\
             Harbour,,R,city,1,-50.0,0.0,0,UTC\n"))
        .unwrap();
        assert!(cleaned.table.contains("Dome,,R,observatory,0,-10.0,0.0,300,Africa/Accra"));
        assert!(cleaned.table.contains("Mine,,R,observatory,0,-10.0,0.3,700,UTC"));
        assert!(cleaned.table.contains("Port,,R,city,1,-40.0,0.0,0,UTC"));
        assert!(cleaned.table.contains("Harbour,,R,city,1,-50.0,0.0,0,UTC"));
        assert_eq!((cleaned.elevations_filled, cleaned.timezones_filled), (3, 1));
    }
}

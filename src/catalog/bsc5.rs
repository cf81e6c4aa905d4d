//! From the Yale Bright Star Catalogue as published to the records of `stars.bin`.
//!
//! Source: Hoffleit & Warren 1991, *The Bright Star Catalogue*, 5th revised edition, CDS V/50.
//! Its 14 entries without a position (novae, clusters and the like that kept their HR number)
//! are left out. Proper motion in right ascension is on a great circle already (times the cosine
//! of declination). Parallaxes that are not positive say "too far to measure" and become 0;
//! dynamical parallaxes are used as they are. A number alone in the field of variable stars is one of the
//! New Catalogue of Suspected Variable Stars. Of companions the distance and the difference of magnitudes
//! are taken; position angles the catalogue does not have.

use std::collections::HashMap;

use super::Companion;
use super::colour::b_v_from_spectral_type;
use super::csv::{self, RowError};
use super::stars::StarRecord;

/// The columns of the raw catalogue, in order.
const COLUMNS: &str = "hr,hip,hd,name,ra_deg_j2000,dec_deg_j2000,vmag,b_v,u_b,r_i,sptype,\
    pmra_arcsec_yr,pmdec_arcsec_yr,parallax_arcsec,plx_flag,rv_km_s,rv_note,vsini_km_s,var_id,\
    ads,ads_comp,mult_dmag,mult_sep_arcsec,mult_id,mult_count";
const NAME_COLUMNS: &str = "name,hr,hip,hd";

/// Greek letters by the three characters that BSC5 writes for them.
const GREEK: [(&str, char); 24] = [
    ("Alp", 'α'),
    ("Bet", 'β'),
    ("Gam", 'γ'),
    ("Del", 'δ'),
    ("Eps", 'ε'),
    ("Zet", 'ζ'),
    ("Eta", 'η'),
    ("The", 'θ'),
    ("Iot", 'ι'),
    ("Kap", 'κ'),
    ("Lam", 'λ'),
    ("Mu ", 'μ'),
    ("Nu ", 'ν'),
    ("Xi ", 'ξ'),
    ("Omi", 'ο'),
    ("Pi ", 'π'),
    ("Rho", 'ρ'),
    ("Sig", 'σ'),
    ("Tau", 'τ'),
    ("Ups", 'υ'),
    ("Phi", 'φ'),
    ("Chi", 'χ'),
    ("Psi", 'ψ'),
    ("Ome", 'ω'),
];

const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// Bayer designation, else Flamsteed's, and the number of Flamsteed, from the ten characters of BSC5's name field:
/// `"  9Alp CMa"` is `α CMa` and 9, `"   Alp2Cen"` is `α² Cen`, `" 61    Cyg"` is `61 Cyg` and 61.
fn designation(field: &str) -> Result<(Option<String>, Option<u8>), String> {
    if field.trim().is_empty() {
        return Ok((None, None));
    }
    let wrong =
        || format!("the name field {field:?} is not a number, a letter and a constellation");
    if !field.is_ascii() || field.len() != 10 {
        return Err(wrong());
    }
    let (number, letter) = (field[..3].trim(), &field[3..6]);
    let (index, constellation) = (field[6..7].trim(), field[7..].trim());
    let flamsteed: Option<u8> = match number {
        "" => None,
        number => Some(number.parse().map_err(|_| wrong())?),
    };
    if constellation.len() != 3 || flamsteed == Some(0) {
        return Err(wrong());
    }
    if let Some((_, greek)) = GREEK.iter().find(|(written, _)| *written == letter) {
        let index = match index {
            "" => String::new(),
            digit => {
                let digit: usize = digit.parse().map_err(|_| wrong())?;
                SUPERSCRIPTS.get(digit).ok_or_else(wrong)?.to_string()
            }
        };
        return Ok((Some(format!("{greek}{index} {constellation}")), flamsteed));
    }
    match flamsteed {
        Some(number) if letter.trim().is_empty() && index.is_empty() => {
            Ok((Some(format!("{number} {constellation}")), flamsteed))
        }
        _ => Err(wrong()),
    }
}

/// Names by HR number, from the list of names that the IAU approved.
///
/// The HIP and HD numbers in the list must be those of the same star in `catalogue`.
fn names(text: &str) -> Result<HashMap<u16, Name>, RowError> {
    let mut names = HashMap::new();
    for (line, row) in csv::rows(text, NAME_COLUMNS)? {
        let hr = parse(&row[1], "HR number").map_err(|what| (line, what))?;
        let name = Name {
            line,
            name: row[0].to_string(),
            hip: row[2].to_string(),
            hd: row[3].to_string(),
        };
        if let Some(other) = names.insert(hr, name) {
            return Err((line, format!("HR {hr} has a second name, after {}", other.name)));
        }
    }
    Ok(names)
}

struct Name {
    line: usize,
    name: String,
    hip: String,
    hd: String,
}

/// Which of the two raw tables is wrong.
pub(super) enum BscError {
    Catalogue(RowError),
    Names(RowError),
}

/// The records of all stars that have a position, in the order of HR.
pub(super) fn records(catalogue: &str, star_names: &str) -> Result<Vec<StarRecord>, BscError> {
    let mut names = names(star_names).map_err(BscError::Names)?;
    let mut records = Vec::new();
    for (line, row) in csv::rows(catalogue, COLUMNS).map_err(BscError::Catalogue)? {
        let row: Vec<&str> = row.iter().map(AsRef::as_ref).collect();
        let Some(mut record) = record(&row).map_err(|what| BscError::Catalogue((line, what)))?
        else {
            continue;
        };
        if let Some(name) = names.remove(&record.hr) {
            if (name.hip.as_str(), name.hd.as_str()) != (row[1], row[2]) {
                let what = format!(
                    "{} is HIP {:?} HD {:?}, but HR {} is HIP {:?} HD {:?}",
                    name.name, name.hip, name.hd, record.hr, row[1], row[2]
                );
                return Err(BscError::Names((name.line, what)));
            }
            record.name = Some(name.name);
        }
        records.push(record);
    }
    if let Some((hr, name)) = names.into_iter().min_by_key(|(_, name)| name.line) {
        let what = format!("{} is HR {hr}, which the catalogue does not have", name.name);
        return Err(BscError::Names((name.line, what)));
    }
    Ok(records)
}

/// One row of the catalogue; none if it has no position.
fn record(row: &[&str]) -> Result<Option<StarRecord>, String> {
    let (hr, hip, hd, name, ra_deg, dec_deg) = (row[0], row[1], row[2], row[3], row[4], row[5]);
    let (v, b_v, spectral_type) = (row[6], row[7], row[10].trim());
    let (motion_ra, motion_dec, parallax, radial_velocity) = (row[11], row[12], row[13], row[15]);
    if ra_deg.is_empty() || dec_deg.is_empty() {
        return Ok(None);
    }
    let measured = if b_v.is_empty() { None } else { Some(parse(b_v, "B-V")?) };
    let b_v = match measured {
        Some(b_v) => b_v,
        None => b_v_from_spectral_type(spectral_type).ok_or_else(|| {
            format!("there is no B-V, and none follows from the type {spectral_type:?}")
        })?,
    };
    let number = |field: &str, what| match field {
        "" => Ok(None),
        field => parse(field, what).map(Some),
    };
    let (designation, flamsteed) = designation(name)?;
    Ok(Some(StarRecord {
        hr: parse(hr, "HR number")?,
        hip: number(hip, "HIP number")?,
        hd: number(hd, "HD number")?,
        ra_rad: parse::<f64>(ra_deg, "right ascension")?.to_radians(),
        dec_rad: parse::<f64>(dec_deg, "declination")?.to_radians(),
        proper_motion_ra_arcsec_yr: parse(motion_ra, "proper motion")?,
        proper_motion_dec_arcsec_yr: parse(motion_dec, "proper motion")?,
        parallax_arcsec: Some(zero_if_empty(parallax, "parallax")?)
            .filter(|&parallax| parallax > 0.0)
            .unwrap_or(0.0),
        radial_velocity_km_s: zero_if_empty(radial_velocity, "radial velocity")?,
        v: parse(v, "V")?,
        b_v,
        b_v_estimated: measured.is_none(),
        designation,
        flamsteed,
        name: None,
        spectral_type: spectral_type.to_owned(),
        variable: variable(row[18]),
        companion: companion(row[22], row[21])?,
    }))
}

/// What a variable star is called.
fn variable(field: &str) -> Option<String> {
    let is_number = !field.is_empty() && field.bytes().all(|byte| byte.is_ascii_digit());
    match is_number {
        true => Some(format!("NSV {field}")),
        false => Some(field.trim().to_owned()).filter(|name| !name.is_empty()),
    }
}

/// A companion at a distance, arcsec, fainter by so many magnitudes; none without a distance.
fn companion(separation: &str, difference: &str) -> Result<Option<Companion>, String> {
    let number = |field: &str, what| match field.trim() {
        "" => Ok(None),
        field => parse::<f64>(field, what).map(Some),
    };
    let magnitude_difference = number(difference, "difference of magnitudes")?;
    let separation = number(separation, "distance of a companion")?;
    Ok(separation.map(|separation_arcsec| Companion { separation_arcsec, magnitude_difference }))
}

fn zero_if_empty(field: &str, what: &str) -> Result<f64, String> {
    if field.is_empty() { Ok(0.0) } else { parse(field, what) }
}

fn parse<T: std::str::FromStr>(field: &str, what: &str) -> Result<T, String> {
    field.parse().map_err(|_| format!("the {what} {field:?} is not a number"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_fields_become_designations() {
        for (field, wanted, flamsteed) in [
            ("  9Alp CMa", "α CMa", Some(9)),
            ("   Alp2Cen", "α² Cen", None),
            (" 61    Cyg", "61 Cyg", Some(61)),
            (" 65Xi 1Cet", "ξ¹ Cet", Some(65)),
            ("   Mu  Cas", "μ Cas", None),
            (" 19Tau9Eri", "τ⁹ Eri", Some(19)),
            ("139    Tau", "139 Tau", Some(139)),
        ] {
            assert_eq!(designation(field), Ok((Some(wanted.to_owned()), flamsteed)), "{field}");
        }
        assert_eq!(designation(""), Ok((None, None)));
        for wrong in [
            "Sirius",
            "  9Alb CMa",
            "       CMa",
            "  9Alp    ",
            "x 9Alp CMa",
            "  0Alp CMa",
            "300    CMa",
            "αβγδε",
        ] {
            assert!(designation(wrong).is_err(), "{wrong}");
        }
    }

    fn row(change: impl Fn(&mut Vec<&'static str>)) -> Result<Option<StarRecord>, String> {
        let sirius = "2491,32349,48915,  9Alp CMa,101.287083,-16.716111,-1.46,0.00,-0.05,,A1Vm,\
            -0.553,-1.205,+.375,,-008,,13,,5423,A,10.3,11.2,AB,3";
        let mut fields: Vec<&str> = sirius.split(',').collect();
        change(&mut fields);
        record(&fields)
    }

    #[test]
    fn a_row_becomes_a_star() {
        let sirius = row(|_| ()).unwrap().unwrap();
        assert_eq!((sirius.hr, sirius.hip, sirius.hd), (2491, Some(32349), Some(48915)));
        assert_eq!(sirius.flamsteed, Some(9));
        assert!((sirius.ra_rad.to_degrees() - 101.287083).abs() < 1e-12);
        assert_eq!((sirius.v, sirius.b_v, sirius.b_v_estimated), (-1.46, 0.0, false));
        assert_eq!((sirius.parallax_arcsec, sirius.radial_velocity_km_s), (0.375, -8.0));
        assert_eq!(sirius.variable, None);
        let companion = Companion { separation_arcsec: 11.2, magnitude_difference: Some(10.3) };
        assert_eq!(sirius.companion, Some(companion));
        let other = row(|fields| {
            (fields[18], fields[21], fields[22]) = ("33", "", "0.0");
        });
        let other = other.unwrap().unwrap();
        assert_eq!(other.variable.as_deref(), Some("NSV 33"));
        let close = Companion { separation_arcsec: 0.0, magnitude_difference: None };
        assert_eq!(other.companion, Some(close));
        assert_eq!(row(|fields| fields[22] = "").unwrap().unwrap().companion, None);
    }

    #[test]
    fn what_a_row_lacks_is_left_out_or_zero_or_estimated() {
        assert_eq!(row(|fields| fields[4] = "").unwrap(), None);
        let star = row(|fields| {
            fields[1] = "";
            fields[7] = "";
            fields[13] = "-.012";
            fields[15] = "";
        });
        let star = star.unwrap().unwrap();
        assert_eq!((star.hip, star.parallax_arcsec, star.radial_velocity_km_s), (None, 0.0, 0.0));
        assert!(star.b_v_estimated);
        assert!((star.b_v - 0.015).abs() < 1e-12);
        assert!(row(|fields| fields[6] = "bright").unwrap_err().contains("V \"bright\""));
    }

    #[test]
    fn a_name_given_to_the_wrong_star_is_refused() {
        let catalogue = format!("{COLUMNS}\n2491,32349,48915,,1,1,1,0,,,A1,0,0,,,,,,,,,,,,\n");
        let named = |list: &str| records(&catalogue, &format!("{NAME_COLUMNS}\n{list}\n"));
        assert!(named("Sirius,2491,32349,48915").is_ok());
        for wrong in [
            "Sirius,2491,32350,48915",
            "Sirius,2492,32349,48915",
            "Sirius,2491,32349,48915\nSothis,2491,32349,48915",
        ] {
            assert!(matches!(named(wrong), Err(BscError::Names(_))), "{wrong}");
        }
    }
}

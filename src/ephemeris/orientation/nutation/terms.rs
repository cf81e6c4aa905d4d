//! The terms of nutation and of the locator of the celestial intermediate origin, as published.

use crate::ephemeris::orientation::arguments::ARGUMENTS;
use crate::ephemeris::orientation::series::{Sum, Term};

const NUTATION: &str = include_str!("../../../../catalogs/earth/nutation_2000a.csv");
const LOCATOR: &str = include_str!("../../../../catalogs/earth/cio_locator_2006.csv");

/// Arcseconds in a unit of the table of nutation.
const NUTATION_UNIT_ARCSEC: f64 = 1e-7;
/// Arcseconds in a unit of the table of the locator.
const LOCATOR_UNIT_ARCSEC: f64 = 1e-8;

/// So many terms of nutation, the first ones, and all of the locator; arcseconds.
///
/// `None` if a table is not what it should be.
pub fn read(nutation_terms: usize) -> Option<Vec<Term>> {
    let mut terms = Vec::new();
    for row in rows(NUTATION).take(nutation_terms) {
        let (multiples, values) = split(row?)?;
        let [psi_sin, psi_sin_t, psi_cos, eps_cos, eps_cos_t, eps_sin] = values[..] else {
            return None;
        };
        for (sum, power, sin, cos) in [
            (Sum::Longitude, 0, psi_sin, psi_cos),
            (Sum::Longitude, 1, psi_sin_t, 0),
            (Sum::Obliquity, 0, eps_sin, eps_cos),
            (Sum::Obliquity, 1, 0, eps_cos_t),
        ] {
            if (sin, cos) != (0, 0) {
                let [sin, cos] = [sin, cos].map(|value| f64::from(value) * NUTATION_UNIT_ARCSEC);
                terms.push(Term { sum, power, multiples, sin, cos });
            }
        }
    }
    for row in rows(LOCATOR) {
        let mut row = row?;
        let power = row.remove(0);
        let (multiples, values) = split(row)?;
        let [sin, cos] = values[..] else { return None };
        let [sin, cos] = [sin, cos].map(|value| f64::from(value) * LOCATOR_UNIT_ARCSEC);
        terms.push(Term { sum: Sum::Locator, power, multiples, sin, cos });
    }
    Some(terms)
}

/// The numbers of a table's rows; its comments and its header are passed over.
fn rows(table: &str) -> impl Iterator<Item = Option<Vec<i32>>> + '_ {
    let is_row = |line: &&str| line.starts_with(|c: char| c == '-' || c.is_ascii_digit());
    table.lines().filter(is_row).map(|row| row.split(',').map(|field| field.parse().ok()).collect())
}

/// The multiples that stand before the coefficients, and the coefficients.
fn split(row: Vec<i32>) -> Option<([i8; ARGUMENTS], Vec<i32>)> {
    let (multiples, values) = row.split_at_checked(ARGUMENTS)?;
    let multiples: Option<Vec<i8>> = multiples.iter().map(|&m| i8::try_from(m).ok()).collect();
    Some((multiples?.try_into().ok()?, values.to_vec()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_have_the_published_number_of_terms() {
        assert_eq!(rows(NUTATION).count(), 678 + 687);
        assert_eq!(rows(LOCATOR).count(), 33 + 3 + 25 + 4 + 1);
        let terms = read(usize::MAX).unwrap();
        let planetary = terms
            .iter()
            .filter(|term| term.sum != Sum::Locator && term.multiples[5..].iter().any(|&m| m != 0));
        assert!(planetary.count() > 687);
        // The largest: 17.2" by the node of the Moon.
        assert_eq!(terms[0].multiples, [0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        assert!((terms[0].sin + 17.206_416_1).abs() < 1e-12);
    }
}

//! The 88 constellations: names, figures and boundaries.
//!
//! Source: the data of d3-celestial (O. Frohn, BSD-3-Clause; `catalogs/sky/`), whose boundaries are
//! those of Davenhall & Leggett 1989 (CDS VI/49) after Delporte 1930. They run along circles of right
//! ascension and declination of the equinox B1875.0, and their corners stand here in the whole seconds
//! and minutes of that equinox. Figures are a custom, not a rule of the IAU; each corner is a star of the
//! Bright Star Catalogue. The tables are small and always needed: they are compiled in.

use std::sync::LazyLock;

use super::csv::{RowError, rows};
use crate::frame::{Dir, Icrs};
use crate::units::Angle;

const NAMES: &str = include_str!("../../catalogs/sky/constellations.csv");
const FIGURES: &str = include_str!("../../catalogs/sky/figures.csv");
const BOUNDARIES: &str = include_str!("../../catalogs/sky/boundaries.csv");

const NAME_COLUMNS: &str = "abbreviation,latin,genitive,english,labels_ra_dec_deg";
const FIGURE_COLUMNS: &str = "abbreviation,line,hr,ra_deg,dec_deg";
const BOUNDARY_COLUMNS: &str = "abbreviation,ring,ra_s,dec_arcmin";

/// A constellation.
#[derive(Debug, Clone, PartialEq)]
pub struct Constellation {
    /// Three letters of the IAU: `CMa`.
    pub abbreviation: &'static str,
    /// `Canis Major`.
    pub latin: &'static str,
    /// Of the constellation: `Canis Majoris`.
    pub genitive: &'static str,
    /// What it is called in English: `Great Dog`.
    pub english: &'static str,
    /// Where its name may stand: one place, of Serpens two, head and tail.
    pub labels: Vec<Dir<Icrs>>,
    /// The lines of its figure.
    pub figure: Vec<Vec<FigureStar>>,
    /// Its boundary: one ring, of Serpens two. The last corner is joined to the first.
    pub rings: Vec<Vec<Corner>>,
}

/// A corner of a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FigureStar {
    /// The star that stands there.
    pub hr: u16,
    /// Where it stands at J2000.0, within 2 arcminutes.
    pub dir_j2000: Dir<Icrs>,
}

/// A corner of a boundary: mean equator and equinox of B1875.0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Corner {
    /// Right ascension, seconds of time, 0 to 86399.
    pub ra_s: i32,
    /// Declination, arcminutes.
    pub dec_arcmin: i32,
}

/// One of the 88, by its place in [`constellations`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ConstellationId(u8);

impl ConstellationId {
    /// The constellation with this place in [`constellations`], if there is one.
    pub fn new(index: usize) -> Option<ConstellationId> {
        let index = u8::try_from(index).ok()?;
        (usize::from(index) < constellations().len()).then_some(ConstellationId(index))
    }

    /// The constellation with these three letters, in any case.
    pub fn from_abbreviation(abbreviation: &str) -> Option<ConstellationId> {
        let is_it = |known: &Constellation| known.abbreviation.eq_ignore_ascii_case(abbreviation);
        ConstellationId::new(constellations().iter().position(is_it)?)
    }

    /// All of them, in the order of the Latin names.
    pub fn all() -> impl Iterator<Item = ConstellationId> {
        (0..constellations().len()).filter_map(ConstellationId::new)
    }

    /// Its place in [`constellations`].
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// What is known of it.
    pub fn get(self) -> &'static Constellation {
        &constellations()[self.index()]
    }
}

/// All 88, in the order of their Latin names.
pub fn constellations() -> &'static [Constellation] {
    static ALL: LazyLock<Vec<Constellation>> = LazyLock::new(|| {
        read(NAMES, FIGURES, BOUNDARIES)
            .unwrap_or_else(|(line, what)| panic!("compiled-in constellations, {line}: {what}"))
    });
    &ALL
}

fn read(
    names: &'static str,
    figures: &'static str,
    boundaries: &'static str,
) -> Result<Vec<Constellation>, RowError> {
    let mut all = Vec::new();
    for line in names.lines().skip(1).enumerate().map(|(index, line)| (index + 2, line)) {
        all.push(constellation(line.1).map_err(|what| (line.0, what))?);
    }
    rows(names, NAME_COLUMNS)?;
    for (line, fields) in rows(figures, FIGURE_COLUMNS)? {
        let star = || {
            let hr = number(&fields[2])?;
            Ok(FigureStar { hr, dir_j2000: direction(&fields[3], &fields[4])? })
        };
        append(&mut all, &fields[0], &fields[1], star(), |one| &mut one.figure)
            .map_err(|what| (line, what))?;
    }
    for (line, fields) in rows(boundaries, BOUNDARY_COLUMNS)? {
        let corner = || Ok(Corner { ra_s: number(&fields[2])?, dec_arcmin: number(&fields[3])? });
        append(&mut all, &fields[0], &fields[1], corner(), |one| &mut one.rings)
            .map_err(|what| (line, what))?;
    }
    Ok(all)
}

fn constellation(line: &'static str) -> Result<Constellation, String> {
    let fields: Vec<&'static str> = line.split(',').collect();
    let &[abbreviation, latin, genitive, english, labels] = &fields[..] else {
        return Err(format!("{line:?} is no constellation"));
    };
    let numbers: Vec<&str> = labels.split(' ').collect();
    let labels = numbers.chunks(2).map(|pair| match pair {
        [ra_deg, dec_deg] => direction(ra_deg, dec_deg),
        _ => Err(format!("{labels:?} is no pair of angles")),
    });
    Ok(Constellation {
        abbreviation,
        latin,
        genitive,
        english,
        labels: labels.collect::<Result<_, _>>()?,
        figure: Vec::new(),
        rings: Vec::new(),
    })
}

/// Appends to the line with this number of a constellation; a number may be that of the last line or
/// the next.
fn append<T>(
    all: &mut [Constellation],
    abbreviation: &str,
    line: &str,
    item: Result<T, String>,
    lines: impl Fn(&mut Constellation) -> &mut Vec<Vec<T>>,
) -> Result<(), String> {
    let known = all.iter_mut().find(|one| one.abbreviation == abbreviation);
    let lines = lines(known.ok_or_else(|| format!("{abbreviation:?} is no constellation"))?);
    let line: usize = number(line)?;
    if line == lines.len() {
        lines.push(Vec::new());
    }
    match lines.get_mut(line) {
        Some(items) => items.push(item?),
        None => return Err(format!("line {line} of {abbreviation} is out of order")),
    }
    Ok(())
}

fn number<T: std::str::FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{text:?} is not a number"))
}

fn direction(ra_deg: &str, dec_deg: &str) -> Result<Dir<Icrs>, String> {
    let (ra, dec) = (number(ra_deg)?, number(dec_deg)?);
    Ok(Dir::from_spherical(Angle::from_deg(ra), Angle::from_deg(dec)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_88_have_names_figures_and_boundaries() {
        let all = constellations();
        assert_eq!(all.len(), 88);
        assert!(all.windows(2).all(|pair| pair[0].latin < pair[1].latin));
        for one in all {
            let parts = if one.abbreviation == "Ser" { 2 } else { 1 };
            assert_eq!((one.labels.len(), one.rings.len()), (parts, parts), "{}", one.latin);
            assert!(one.abbreviation.len() == 3 && !one.genitive.is_empty());
            assert!(!one.english.is_empty() && !one.figure.is_empty(), "{}", one.latin);
            assert!(one.figure.iter().all(|line| line.len() >= 2), "{}", one.latin);
            for ring in &one.rings {
                // Right angles all around: sides along right ascension and declination in turn.
                for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                    assert!((a.ra_s == b.ra_s) != (a.dec_arcmin == b.dec_arcmin), "{}", one.latin);
                }
            }
        }
        let dog = ConstellationId::from_abbreviation("cma").unwrap();
        assert_eq!((dog.get().latin, dog.get().genitive), ("Canis Major", "Canis Majoris"));
        assert_eq!(ConstellationId::new(88), None);
        assert_eq!(ConstellationId::all().count(), 88);
    }

    #[test]
    fn tables_that_are_spoilt_are_refused() {
        let head = "abbreviation,latin,genitive,english,labels_ra_dec_deg\n";
        let (figures, boundaries) = ("abbreviation,line,hr,ra_deg,dec_deg\n", BOUNDARIES);
        assert!(read(NAMES, figures, boundaries).is_ok());
        assert_eq!(read(head, figures, boundaries).unwrap_err().0, 2);
        assert!(constellation("And,Andromeda,Andromedae,Andromeda,0.75 43 1").is_err());
        assert!(constellation("And,Andromeda").is_err());
        let late = "abbreviation,line,hr,ra_deg,dec_deg\nAnd,1,603,30,42\n";
        assert!(read(NAMES, late, boundaries).unwrap_err().1.contains("out of order"));
    }
}

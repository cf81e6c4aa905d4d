//! The stars of a catalogue by where they stand, so that a picture touches only those it may show.
//!
//! The sphere of J2000.0 is cut into the cells of a cube, each face in [`ACROSS`] times [`ACROSS`]
//! squares. A cell keeps its stars from the brightest to the faintest, and a cone that holds them all.
//! A search turns the view back into the axes of the catalogue and asks of each cell whether its cone
//! can meet that of the view, then of the cell's stars only the bright ones: it costs the number of
//! cells, 0.01 ms, and what it finds, however many stars the catalogue has.
//!
//! Margins: a star of velocity `v` (per year, in units of its distance) has moved by no more than
//! `asin(v t)` after `t` years, so that a cone grows by what its fastest star makes of that: seconds of
//! arc today, degrees in -3000 in the few cells that hold a 61 Cygni. Aberration, parallax and the
//! deflection by the Sun are [`APPARENT_MARGIN`]; refraction is the searcher's.

use std::collections::HashMap;
use std::ops::{Deref, Range};
use std::sync::{Arc, OnceLock};

use glam::DVec3;

use crate::catalog::Star;
use crate::ephemeris::stars::SpaceMotion;
use crate::frame::{Dir, Icrs};
use crate::sky::names::{Designation, plain};
use crate::units::{Angle, Magnitude};

/// Cells along the edge of a face of the cube: 384 of 7 to 11 degrees in all.
const ACROSS: usize = 8;
/// Aberration is 20.8" at most with the turning of the Earth, parallax 0.8", deflection 1.9".
pub const APPARENT_MARGIN: Angle = Angle::from_arcsec(30.0);

/// A catalogue of stars in its own order, with an index over the sphere. Clones share it.
#[derive(Debug, Clone)]
pub struct StarIndex(Arc<Shared>);

#[derive(Debug)]
struct Shared {
    stars: Vec<Star>,
    /// Numbers of the stars, cell by cell, in a cell by rising magnitude.
    order: Vec<usize>,
    /// Johnson V, in that order.
    magnitudes: Vec<f64>,
    /// Motions, in that order.
    motions: Vec<SpaceMotion>,
    cells: Vec<Cell>,
    /// Made when somebody asks.
    names: OnceLock<Names>,
}

/// Stars that stand together.
#[derive(Debug, Clone)]
pub struct Cell {
    axis: Dir<Icrs>,
    /// Of the cone that holds all of them at J2000.0.
    radius: Angle,
    /// The fastest of them, per Julian year in units of its distance.
    fastest_per_year: f64,
    ranks: Range<usize>,
}

impl Cell {
    /// Middle of the cell.
    pub fn axis(&self) -> Dir<Icrs> {
        self.axis
    }

    /// Radius around the axis within which all its stars are seen, Julian years from J2000.0.
    pub fn radius(&self, years: f64) -> Angle {
        let moved = Angle::from_rad((self.fastest_per_year * years.abs()).min(1.0).asin());
        self.radius + moved + APPARENT_MARGIN
    }

    /// How many stars there are.
    pub fn len(&self) -> usize {
        self.ranks.len()
    }

    /// Whether there is none; no cell of an index is empty.
    pub fn is_empty(&self) -> bool {
        self.ranks.is_empty()
    }
}

impl StarIndex {
    /// Sorts a catalogue into cells: 2 ms for 9096 stars.
    pub fn new(stars: Vec<Star>) -> StarIndex {
        let mut numbers: Vec<(usize, usize)> =
            stars.iter().enumerate().map(|(n, star)| (square_of(star.dir_j2000), n)).collect();
        numbers.sort_by(|&(cell_a, a), &(cell_b, b)| {
            let by_light = || stars[a].magnitude.0.total_cmp(&stars[b].magnitude.0);
            cell_a.cmp(&cell_b).then_with(by_light).then(a.cmp(&b))
        });
        let order: Vec<usize> = numbers.iter().map(|&(_, number)| number).collect();
        let motions: Vec<SpaceMotion> = order.iter().map(|&n| (&stars[n]).into()).collect();
        let mut cells = Vec::new();
        let mut begin = 0;
        for square in numbers.chunk_by(|a, b| a.0 == b.0) {
            let ranks = begin..begin + square.len();
            begin = ranks.end;
            let dirs = || square.iter().map(|&(_, n)| stars[n].dir_j2000);
            let axis: DVec3 = dirs().map(Dir::vector).sum();
            // Stars of one square lie within a few degrees: their sum never vanishes.
            let axis = Dir::from_vector(axis);
            let radius = dirs().map(|dir| dir.separation(axis).rad()).fold(0.0, f64::max);
            let speeds = motions[ranks.clone()].iter().map(SpaceMotion::speed_per_year);
            let fastest_per_year = speeds.fold(0.0, f64::max);
            cells.push(Cell { axis, radius: Angle::from_rad(radius), fastest_per_year, ranks });
        }
        let magnitudes = order.iter().map(|&n| stars[n].magnitude.0).collect();
        let names = OnceLock::new();
        StarIndex(Arc::new(Shared { stars, order, magnitudes, motions, cells, names }))
    }

    /// The cells that hold any star.
    pub fn cells(&self) -> &[Cell] {
        &self.0.cells
    }

    /// How many stars of a cell are no fainter than a magnitude; all of them, if none is given.
    pub fn bright(&self, cell: &Cell, faintest: Option<Magnitude>) -> usize {
        match faintest {
            // What is not a number is sorted behind all others, and fainter than any limit.
            Some(Magnitude(limit)) => {
                self.0.magnitudes[cell.ranks.clone()].partition_point(|&v| v <= limit)
            }
            None => cell.len(),
        }
    }

    /// The brightest so many stars of a cell: their numbers in the catalogue and their motions.
    pub fn brightest(
        &self,
        cell: &Cell,
        count: usize,
    ) -> impl Iterator<Item = (usize, SpaceMotion)> {
        let ranks = cell.ranks.start..cell.ranks.end.min(cell.ranks.start + count);
        ranks.map(|rank| (self.0.order[rank], self.0.motions[rank]))
    }

    /// A star by name: `Sirius`, `α CMa`, `alpha CMa`, `alp Canis Majoris`, `9 CMa`, `HR 2491`,
    /// `HD 48915`, `HIP 32349`; capitals, accents and blanks do not count. Of two stars of one name the
    /// brighter; `α Cen` is the brightest of `α¹ Cen` and `α² Cen`.
    pub fn find(&self, name: &str) -> Option<usize> {
        let names = self.0.names.get_or_init(|| Names::of(self));
        names.find(name)
    }
}

/// Numbers of the stars by all their names.
#[derive(Debug)]
struct Names {
    /// By proper names and catalogue numbers, [plain] and without blanks.
    words: HashMap<String, usize>,
    designations: HashMap<Designation, usize>,
}

impl Names {
    fn of(stars: &[Star]) -> Names {
        let mut names = Names { words: HashMap::new(), designations: HashMap::new() };
        let mut alone = Vec::new();
        let mut by_light: Vec<usize> = (0..stars.len()).collect();
        by_light.sort_by(|&a, &b| stars[a].magnitude.0.total_cmp(&stars[b].magnitude.0));
        for &number in &by_light {
            let star = &stars[number];
            let numbers = [("hr", Some(star.hr.into())), ("hip", star.hip), ("hd", star.hd)];
            let numbers = numbers.into_iter().filter_map(|(list, n)| Some(format!("{list}{}", n?)));
            for word in star.name.iter().map(|name| joined(name)).chain(numbers) {
                names.words.entry(word).or_insert(number);
            }
            let flamsteed = star.flamsteed.iter().filter(|&f| star.designation.as_ref() != Some(f));
            for text in star.designation.iter().chain(flamsteed) {
                match Designation::parse(text) {
                    Some(read) => {
                        if read.index.is_some() {
                            alone.push((Designation { index: None, ..read.clone() }, number));
                        }
                        names.designations.entry(read).or_insert(number);
                    }
                    None => _ = names.words.entry(joined(text)).or_insert(number),
                }
            }
        }
        // Where no star has a letter alone, the brightest of those that have it with a figure.
        for (read, number) in alone {
            names.designations.entry(read).or_insert(number);
        }
        names
    }

    fn find(&self, name: &str) -> Option<usize> {
        let by_word = self.words.get(&joined(name));
        let by_designation = || self.designations.get(&Designation::parse(name)?);
        by_word.or_else(by_designation).copied()
    }
}

/// A plain name without blanks.
fn joined(name: &str) -> String {
    plain(name).replace(' ', "")
}

impl StarIndex {
    /// Whether both share one catalogue.
    pub fn is_same(&self, other: &StarIndex) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Deref for StarIndex {
    type Target = [Star];
    fn deref(&self) -> &[Star] {
        &self.0.stars
    }
}

impl From<Vec<Star>> for StarIndex {
    fn from(stars: Vec<Star>) -> StarIndex {
        StarIndex::new(stars)
    }
}

/// A name without the differences that people do not mean.
pub fn folded(name: &str) -> String {
    name.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect()
}

/// The square of the cube that a direction falls into.
fn square_of(dir: Dir<Icrs>) -> usize {
    let v = dir.vector();
    let size = v.abs();
    let (face, along, a, b) = if size.x >= size.y && size.x >= size.z {
        (0, v.x, v.y, v.z)
    } else if size.y >= size.z {
        (1, v.y, v.z, v.x)
    } else {
        (2, v.z, v.x, v.y)
    };
    let place =
        |side: f64| (((side / along.abs() + 1.0) * 0.5 * ACROSS as f64) as usize).min(ACROSS - 1);
    let face = 2 * face + usize::from(along < 0.0);
    (face * ACROSS + place(a)) * ACROSS + place(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::Catalogs;
    use crate::time::JulianDate;

    fn index() -> StarIndex {
        Catalogs::locate(None).unwrap().stars().unwrap().into()
    }

    #[test]
    fn every_star_stands_in_one_cell_and_cells_are_small() {
        let index = index();
        let mut seen = vec![0; index.len()];
        for cell in index.cells() {
            let mut before = f64::NEG_INFINITY;
            for (number, _) in index.brightest(cell, usize::MAX - index.len()) {
                seen[number] += 1;
                assert!(index[number].magnitude.0 >= before);
                before = index[number].magnitude.0;
            }
            assert!(cell.radius.deg() < 11.0, "{}", cell.radius.deg());
        }
        assert!(seen.iter().all(|&count| count == 1));
        assert!((350..=6 * ACROSS * ACROSS).contains(&index.cells().len()));
    }

    #[test]
    fn stars_stay_in_the_cones_of_their_cells_for_millennia() {
        let index = index();
        for years in [-6000.0, -500.0, 26.0, 2000.0] {
            let tdb = JulianDate::from_jd(2_451_545.0 + 365.25 * years);
            let mut wide = 0;
            for cell in index.cells() {
                let radius = cell.radius(years);
                wide += usize::from(radius - cell.radius > Angle::from_deg(1.0));
                for (number, motion) in index.brightest(cell, cell.len()) {
                    let off = motion.direction(tdb).separation(cell.axis());
                    assert!(off < radius, "HR {} in {years}", index[number].hr);
                }
            }
            assert!(wide < 150, "{wide} cells have grown by a degree after {years} years");
        }
    }

    #[test]
    fn what_is_bright_is_counted_and_names_are_found() {
        let index = index();
        let count =
            |limit| index.cells().iter().map(|cell| index.bright(cell, limit)).sum::<usize>();
        let direct = index.iter().filter(|star| star.magnitude.0 <= 4.0).count();
        assert_eq!(count(Some(Magnitude(4.0))), direct);
        assert_eq!(count(None), index.len());
        for name in [
            "sirius",
            "α CMa",
            "αcma",
            "alpha CMa",
            "alp canis majoris",
            "9 CMa",
            "HR 2491",
            "HD 48915",
            "hd48915",
            "hip 32349",
            "HIP 32349",
        ] {
            assert_eq!(index.find(name).map(|n| index[n].hr), Some(2491), "{name}");
        }
        // Of a pair the brighter; a letter alone where the catalogue has it with figures.
        for (name, hr) in [("Castor", 2891), ("α Gem", 2891), ("α Cen", 5459), ("61 Cyg", 8085)] {
            assert_eq!(index.find(name).map(|n| index[n].hr), Some(hr), "{name}");
        }
        for name in ["Sirious", "", "HD", "α", "300 CMa"] {
            assert_eq!(index.find(name), None, "{name}");
        }
        assert!(StarIndex::new(Vec::new()).cells().is_empty());
    }
}

//! What is found out for a row, and the columns that it is written in.

use crate::air::scattering::{Matrix, SKY_NODES_NM, reconstruction_matrix};
use crate::export::table::{Cell, Column, Kind};
use crate::light::spectrum::{FIRST_NM, LEN, STEP_NM, wavelength_nm};
use crate::light::sun;
use crate::units::Xyzv;

/// Digits that numbers are written with: more than any tier is good to.
const DIGITS: i32 = 7;

/// What is found out for a row. Radiances and irradiances are per unit irradiance of the Sun outside
/// the air; light is that of the Sun at one astronomical unit.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Answer {
    /// Radiance of the sky, sr^-1, or irradiance of level ground by the sky.
    pub diffuse: Option<f64>,
    /// Irradiance of level ground by the Sun itself.
    pub direct: Option<f64>,
    /// Luminance, cd/m2, or illuminance, lux.
    pub diffuse_light: f64,
    pub direct_light: f64,
    /// Of `diffuse`, by chance.
    pub error: Option<f64>,
    /// Of `diffuse_light`, by chance.
    pub light_error: f64,
    /// Random paths that `diffuse` is the mean of, or else `diffuse_light`.
    pub paths: u64,
}

/// A column of results, and its number in an answer.
type Figure = (&'static str, fn(&Answer) -> Option<f64>);

const SKY: [Figure; 2] = [
    ("radiance_per_unit_toa_irradiance_sr-1", |a| a.diffuse),
    ("luminance_cd_m2", |a| Some(a.diffuse_light)),
];
const SKY_BY_CHANCE: [Figure; 3] = [
    ("std_error_sr-1", |a| a.error),
    ("std_error_cd_m2", |a| Some(a.light_error)),
    ("n_paths", |a| Some(a.paths as f64)),
];
const GROUND: [Figure; 4] = [
    ("E_diffuse_horizontal_per_unit_TOA_irradiance", |a| a.diffuse),
    ("E_direct_horizontal", |a| a.direct),
    ("E_diffuse_horizontal_lx", |a| Some(a.diffuse_light)),
    ("E_direct_horizontal_lx", |a| Some(a.direct_light)),
];
const GROUND_BY_CHANCE: [Figure; 3] = [
    ("std_error", |a| a.error),
    ("std_error_lx", |a| Some(a.light_error)),
    ("n_paths", |a| Some(a.paths as f64)),
];

/// The columns of the results; those of single wavelengths only where there are any.
pub fn figures(has_views: bool, has_wavelengths: bool, by_chance: bool) -> Vec<Figure> {
    let (known, chance): (&[Figure], &[Figure]) = match has_views {
        true => (&SKY, &SKY_BY_CHANCE),
        false => (&GROUND, &GROUND_BY_CHANCE),
    };
    let chance = if by_chance { chance } else { &[] };
    let spectral =
        Answer { diffuse: Some(0.0), direct: Some(0.0), error: Some(0.0), ..Answer::default() };
    let is_wanted = |(_, number): &&Figure| {
        let is_spectral = number(&Answer::default()).is_none() && number(&spectral).is_some();
        has_wavelengths || !is_spectral
    };
    known.iter().chain(chance).filter(is_wanted).copied().collect()
}

pub fn columns(figures: &[Figure]) -> impl Iterator<Item = Column> {
    figures.iter().map(|&(name, _)| Column { name, kind: Kind::Exact })
}

/// A number as it is written.
pub fn cell(value: Option<f64>) -> Cell<'static> {
    match value {
        Some(value) if value.is_finite() => Cell::Number(rounded(value)),
        _ => Cell::Blank,
    }
}

/// To some digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS as usize - 1).parse().unwrap_or(value)
}

/// From light at the nodes to the light that eyes see.
pub struct Eyes {
    spectrum_from_nodes: Matrix,
}

impl Eyes {
    pub fn new() -> Eyes {
        let grid: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
        Eyes { spectrum_from_nodes: reconstruction_matrix(&SKY_NODES_NM, &grid) }
    }

    /// Light of the Sun, weighed by radiances at [`SKY_NODES_NM`].
    pub fn see(&self, nodes: &[f64]) -> Xyzv {
        let shares = self.spectrum_from_nodes.spectrum(nodes);
        let share = |nm: f64| shares[((nm - FIRST_NM) / STEP_NM).round() as usize];
        sun::irradiance_1au().weighted(share).xyzv()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_those_that_rows_ask_for() {
        let names = |views, wavelengths, chance| -> Vec<&str> {
            figures(views, wavelengths, chance).iter().map(|(name, _)| *name).collect()
        };
        assert_eq!(names(true, true, false), [SKY[0].0, SKY[1].0]);
        assert_eq!(names(true, false, false), ["luminance_cd_m2"]);
        assert_eq!(names(true, true, true)[2..], ["std_error_sr-1", "std_error_cd_m2", "n_paths"]);
        assert_eq!(names(false, false, true).len(), 4);
        assert_eq!(names(false, true, false)[1], "E_direct_horizontal");
    }

    #[test]
    fn numbers_keep_seven_digits() {
        assert_eq!(cell(Some(0.021_575_619_9)), Cell::Number(0.021_575_62));
        assert_eq!(cell(Some(0.0)), Cell::Number(0.0));
        assert_eq!((cell(None), cell(Some(f64::NAN))), (Cell::Blank, Cell::Blank));
    }

    #[test]
    fn eyes_see_the_whole_sun_through_nothing() {
        let seen = Eyes::new().see(&[1.0; SKY_NODES_NM.len()]).y;
        assert!((seen / sun::irradiance_1au().xyzv().y - 1.0).abs() < 1e-3, "{seen}");
    }
}

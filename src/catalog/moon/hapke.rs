//! `moon_hapke.bin`: how each part of the Moon sends light back, in the parameters of Hapke's model.
//!
//! Counts in the header: width, height, bands (3). Then, for each band and parameter, the lowest and
//! the highest value (thirty f64, little-endian), and as many maps coded as [`super::super::rice`]
//! says, row by row from the north: a number `n` stands for `low + (high - low) n / 255`.
//!
//! Theory: Sato et al. 2014, *JGR Planets* 119, 1775, fitted the model of Hapke 2012 to 66 000 images
//! of the Lunar Reconnaissance Orbiter's wide-angle camera, degree by degree from 70° south to 70°
//! north, with one roughness (23.657°), filling factor 1 and no coherent backscattering. Cells here
//! are 2 degrees wide, means of four; towards the poles those at 70° go on.
//!
//! Accuracy: a step of 1/255 of the range of each parameter.

use crate::catalog::rice;
use crate::catalog::seal::{self, Kind};

const KIND: Kind = Kind { magic: b"NOCTHAPK", version: 1 };
/// Wavelengths of the bands, nanometres.
pub const BANDS_NM: [f64; 3] = [415.0, 566.0, 643.0];
/// Mean slope of the facets of the ground, degrees: the same for all of the Moon.
pub const ROUGHNESS_DEG: f64 = 23.657;
const PARAMETERS: usize = 5;
const MAPS: usize = 3 * PARAMETERS;
const STEPS: f64 = 255.0;
/// Degrees of longitude and latitude of a cell.
const CELL_DEG: usize = 2;
/// The source: cells of 1 degree, 360 by 140.
const SOURCE_SIZE: (usize, usize) = (360, 140);
/// Rows of the source that are missing at each pole.
const SOURCE_MISSING: usize = 20;
const LARGEST_WIDTH: u32 = 3_600;

/// Parameters of one cell in one band. No units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HapkeCell {
    /// Single-scattering albedo, 0.09 to 0.65.
    pub w: f64,
    /// Sharpness of the lobes of a grain's phase function, 0.16 to 0.32.
    pub b: f64,
    /// Share of the lobes: 1 all backward, -1 all forward; -0.3 to 1.2.
    pub c: f64,
    /// Height of the opposition surge, 1.4 to 3.
    pub b_s0: f64,
    /// Angular half width of the surge: the tangent of half the phase angle; 0 to 0.2.
    pub h_s: f64,
}

impl HapkeCell {
    fn from_array([w, b, c, b_s0, h_s]: [f64; PARAMETERS]) -> Self {
        HapkeCell { w, b, c, b_s0, h_s }
    }
}

/// The parameters of the whole Moon; see [`super`] for how the map lies.
#[derive(Debug, Clone, PartialEq)]
pub struct MoonHapke {
    /// Cells; twice the height.
    pub width: usize,
    pub height: usize,
    /// Row by row; in each cell 415, 566 and 643 nm.
    pub cells: Vec<[HapkeCell; 3]>,
}

/// The packed maps out of 16-bit floating-point numbers, little-endian: three bands, 140 rows from
/// 70° north, 360 columns from 0° eastward, five parameters.
pub fn encode(f16_bytes: &[u8]) -> Result<Vec<u8>, String> {
    let (columns, rows) = SOURCE_SIZE;
    let wanted = 2 * columns * rows * MAPS;
    if f16_bytes.len() != wanted {
        return Err(format!("holds {} bytes, not {wanted}", f16_bytes.len()));
    }
    let (width, height) = (columns / CELL_DEG, 180 / CELL_DEG);
    let source = |band: usize, row: usize, column: usize, parameter: usize| {
        let at = 2 * (((band * rows + row) * columns + column) * PARAMETERS + parameter);
        f64_from_f16(u16::from_le_bytes([f16_bytes[at], f16_bytes[at + 1]]))
    };
    let (mut bounds, mut coded) = (Vec::new(), Vec::new());
    for map in 0..MAPS {
        let (band, parameter) = (map / PARAMETERS, map % PARAMETERS);
        let mut means = Vec::with_capacity(width * height);
        for row in 0..height {
            for column in 0..width {
                let mut sum = 0.0;
                for part in 0..CELL_DEG * CELL_DEG {
                    let from_pole = row * CELL_DEG + part / CELL_DEG;
                    let source_row = from_pole.saturating_sub(SOURCE_MISSING).min(rows - 1);
                    let east = column * CELL_DEG + part % CELL_DEG;
                    sum += source(band, source_row, (east + columns / 2) % columns, parameter);
                }
                means.push(sum / (CELL_DEG * CELL_DEG) as f64);
            }
        }
        let low = means.iter().copied().fold(f64::INFINITY, f64::min);
        let high = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if !(low > -2.0 && high < 4.0 && low < high) {
            return Err(format!("has values from {low} to {high} in map {map}"));
        }
        bounds.extend(low.to_le_bytes());
        bounds.extend(high.to_le_bytes());
        let steps = means.iter().map(|mean| ((mean - low) / (high - low) * STEPS).round() as i16);
        coded.extend(rice::encode(&steps.collect::<Vec<_>>(), width));
    }
    bounds.extend(coded);
    Ok(seal::seal(KIND, [width as u32, height as u32, 3], &bounds))
}

/// The maps in `moon_hapke.bin`; an error says what is wrong with the file.
pub fn decode(bytes: &[u8]) -> Result<MoonHapke, String> {
    let ([width, height, bands], payload) = seal::open(KIND, bytes)?;
    if width == 0 || width != height.saturating_mul(2) || width > LARGEST_WIDTH || bands != 3 {
        return Err(format!("is a map of {width} x {height} cells in {bands} bands"));
    }
    let (bounds, mut rest) =
        payload.split_at_checked(16 * MAPS).ok_or("ends within the bounds of its values")?;
    let mut cells = vec![[[0.0; PARAMETERS]; 3]; (width * height) as usize];
    for (map, bounds) in bounds.chunks_exact(16).enumerate() {
        let [low, high] = [f64_at(bounds, 0), f64_at(bounds, 8)];
        // Written so that NaN, which is in no range, is refused too.
        if !(-2.0..=4.0).contains(&low) || !(low..=4.0).contains(&high) {
            return Err(format!("has values from {low} to {high}"));
        }
        let (steps, after) = rice::decode(rest, width as usize, height as usize)?;
        rest = after;
        for (cell, step) in cells.iter_mut().zip(steps) {
            let share = f64::from(step) / STEPS;
            if !(0.0..=1.0).contains(&share) {
                return Err(format!("has a step {step} of {STEPS}"));
            }
            cell[map / PARAMETERS][map % PARAMETERS] = low + (high - low) * share;
        }
    }
    if !rest.is_empty() {
        return Err(format!("holds {} bytes too many", rest.len()));
    }
    let cells: Vec<_> = cells.into_iter().map(|bands| bands.map(HapkeCell::from_array)).collect();
    if cells.iter().flatten().any(|cell| !sensible(cell)) {
        return Err("has parameters that no ground can have".into());
    }
    Ok(MoonHapke { width: width as usize, height: height as usize, cells })
}

/// Within what the model is made for.
fn sensible(cell: &HapkeCell) -> bool {
    (0.0..1.0).contains(&cell.w)
        && (0.0..1.0).contains(&cell.b)
        && (-1.5..=1.5).contains(&cell.c)
        && cell.b_s0 >= 0.0
        && cell.h_s >= 0.0
}

fn f64_at(bytes: &[u8], at: usize) -> f64 {
    let mut number = [0; 8];
    number.copy_from_slice(&bytes[at..at + 8]);
    f64::from_le_bytes(number)
}

/// IEEE 754 binary16.
fn f64_from_f16(bits: u16) -> f64 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let exponent = i32::from(bits >> 10 & 0x1f);
    let fraction = f64::from(bits & 0x3ff) / 1024.0;
    sign * match exponent {
        0 => fraction * 2f64.powi(-14),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction) * 2f64.powi(exponent - 15),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_precision_is_read() {
        for (bits, value) in
            [(0x3c00, 1.0), (0xc000, -2.0), (0x3555, 0.333_251_953_125), (0x0001, 2f64.powi(-24))]
        {
            assert_eq!(f64_from_f16(bits), value);
        }
        assert!(f64_from_f16(0x7e00).is_nan());
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(encode(&[0; 10]).is_err());
        // NaN everywhere.
        assert!(encode(&[0xff; 2 * 360 * 140 * 15]).is_err());
        for counts in [[0, 0, 3], [180, 90, 2], [180, 91, 3], [u32::MAX, 1 << 31, 3]] {
            assert!(decode(&seal::seal(KIND, counts, &[0; 1000])).is_err(), "{counts:?}");
        }
    }
}

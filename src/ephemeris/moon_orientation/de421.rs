//! The librations of DE421 as its package gives them. For packing; a reader of the packed table does
//! not need it.
//!
//! The Python package `de421` holds JPL's Chebyshev coefficients as one array of NumPy: segments of
//! eight days, three Euler angles, degrees 0 to 9, radians.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::time::{JulianDate, Tdb};

/// Julian dates (TDB) of the package, 1899-12-04 to 2200-02-01 (its `jalpha` and `jomega`).
pub(super) const SPAN_JD: RangeInclusive<f64> = START_JD..=2_524_624.5;
pub(super) const START_JD: f64 = 2_414_992.5;
/// Length of a segment, days (`jdelta` of the package over four).
pub(super) const SEGMENT_DAYS: f64 = 8.0;
/// Mark of an array of NumPy, with the version of its format.
const NPY_MARK: &[u8] = b"\x93NUMPY\x01\x00";
const ANGLES: usize = 3;

/// The integrated angles.
pub(super) struct De421 {
    /// Coefficients of one angle after the other, segment after segment.
    coefficients: Vec<f64>,
    /// Coefficients of one angle in one segment.
    count: usize,
}

impl De421 {
    /// From the bytes of `jpl-librations.npy`; an error says what is wrong with them.
    pub fn from_npy(bytes: &[u8]) -> Result<De421, String> {
        let (head, rest) = bytes
            .split_at_checked(NPY_MARK.len() + 2)
            .filter(|(head, _)| head.starts_with(NPY_MARK))
            .ok_or("is no array of NumPy in format 1.0")?;
        let length = usize::from(u16::from_le_bytes([head[head.len() - 2], head[head.len() - 1]]));
        let (header, data) =
            rest.split_at_checked(length).ok_or("ends within the header of its array")?;
        let header = String::from_utf8_lossy(header);
        if !header.contains("'descr': '<f8'") || !header.contains("'fortran_order': False") {
            return Err("holds other numbers than 64-bit floats, row after row".into());
        }
        let shape: Vec<usize> = header
            .split_once("'shape': (")
            .and_then(|(_, shape)| shape.split_once(')'))
            .map(|(shape, _)| shape.split(',').filter_map(|n| n.trim().parse().ok()).collect())
            .unwrap_or_default();
        let (segments, count) = match shape[..] {
            [segments, ANGLES, count] if segments > 0 && count > 0 => (segments, count),
            _ => return Err(format!("has the shape {shape:?}, not segments of {ANGLES} angles")),
        };
        let (numbers, rest) = data.as_chunks();
        if numbers.len() != segments * ANGLES * count || !rest.is_empty() {
            return Err(format!("has {} bytes of numbers, not those of {shape:?}", data.len()));
        }
        Ok(De421 { coefficients: numbers.iter().map(|n| f64::from_le_bytes(*n)).collect(), count })
    }

    pub fn segments(&self) -> usize {
        self.coefficients.len() / (ANGLES * self.count)
    }

    /// The Euler angles phi, theta, psi, radians; psi grows without end. Within the span of the array.
    pub fn angles_rad(&self, tdb: JulianDate<Tdb>) -> DVec3 {
        let days = (tdb.day() - START_JD) + tdb.fraction();
        let segment = ((days / SEGMENT_DAYS) as usize).min(self.segments() - 1);
        let x = 2.0 * (days - segment as f64 * SEGMENT_DAYS) / SEGMENT_DAYS - 1.0;
        let first = segment * ANGLES * self.count;
        let angle = |n: usize| {
            let at = first + n * self.count;
            clenshaw(&self.coefficients[at..at + self.count], x)
        };
        DVec3::new(angle(0), angle(1), angle(2))
    }
}

/// A sum of Chebyshev polynomials.
fn clenshaw(coefficients: &[f64], x: f64) -> f64 {
    let (mut one, mut two) = (0.0, 0.0);
    for c in coefficients[1..].iter().rev() {
        (one, two) = (c + 2.0 * x * one - two, one);
    }
    coefficients[0] + x * one - two
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// An array in the format of NumPy: `value` of segment, angle and degree.
    pub fn npy(
        segments: usize,
        count: usize,
        value: impl Fn(usize, usize, usize) -> f64,
    ) -> Vec<u8> {
        let header = format!(
            "{{'descr': '<f8', 'fortran_order': False, 'shape': ({segments}, 3, {count}), }}\n"
        );
        let mut bytes = NPY_MARK.to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        for segment in 0..segments {
            for angle in 0..ANGLES {
                for n in 0..count {
                    bytes.extend(value(segment, angle, n).to_le_bytes());
                }
            }
        }
        bytes
    }

    #[test]
    fn polynomials_are_read_and_summed() {
        let value = |segment: usize, angle: usize, n: usize| {
            (segment + 1) as f64 * [1.0, 10.0, 100.0][angle] * [3.0, 2.0, 1.0, 0.5][n]
        };
        let array = De421::from_npy(&npy(2, 4, value)).unwrap();
        assert_eq!(array.segments(), 2);
        // x = 0.5: T1 = 0.5, T2 = -0.5, T3 = -1.
        let at = array.angles_rad(JulianDate::from_parts(START_JD, 6.0));
        assert!((at - DVec3::new(3.0, 30.0, 300.0)).length() < 1e-12, "{at}");
        // The end of the span belongs to the last segment.
        let at = array.angles_rad(JulianDate::from_parts(START_JD, 16.0));
        assert!((at - DVec3::new(13.0, 130.0, 1300.0)).length() < 1e-12, "{at}");
    }

    #[test]
    fn other_arrays_are_refused() {
        let good = npy(2, 4, |_, _, _| 1.0);
        let refused = |bytes: &[u8]| De421::from_npy(bytes).err().expect("refused");
        assert!(refused(&good[..good.len() - 1]).contains("bytes of numbers"));
        assert!(refused(b"PK").contains("no array"));
        assert!(refused(&good[..20]).contains("ends within"));
        let text = String::from_utf8_lossy(&good[10..90]).into_owned();
        let swap = |from: &str, to: &str| {
            assert!(text.contains(from) && from.len() == to.len());
            let at = good.windows(from.len()).position(|w| w == from.as_bytes()).unwrap();
            [&good[..at], to.as_bytes(), &good[at + from.len()..]].concat()
        };
        assert!(refused(&swap("<f8", "<f4")).contains("64-bit"));
        assert!(refused(&swap("False", "True ")).contains("row after row"));
        assert!(refused(&swap(", 3, ", ", 2, ")).contains("shape"));
    }
}

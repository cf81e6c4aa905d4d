//! Ephemerides as JPL gives them away: Chebyshev segments in an SPK file. For packing and comparing.
//!
//! The file is a DAF ("double precision array file"): records of 1024 bytes, a list of summaries, and
//! arrays of 64-bit numbers. Of the kinds of segments only type 2 is read, Chebyshev polynomials of
//! positions in intervals of equal length: DE440 has no others. Layout: NAIF, *DAF Required Reading*
//! and *SPK Required Reading*, section "Type 2".

use glam::DVec3;

use crate::time::{J2000, JulianDate, Tdb};
use crate::units::DAY_S;

const RECORD_BYTES: usize = 1024;
const WORD_BYTES: usize = 8;
/// Bytes of one summary: two numbers and six integers.
const SUMMARY_BYTES: usize = 40;
/// The frame whose axes SPICE calls J2000: those of the ICRF in modern ephemerides.
const FRAME_ICRF: i32 = 1;
const TYPE_CHEBYSHEV_POSITION: i32 = 2;

/// A kernel in memory.
pub struct Kernel {
    bytes: Vec<u8>,
    segments: Vec<Segment>,
}

/// Positions of one body with respect to another.
#[derive(Debug, Clone, PartialEq)]
struct Segment {
    target: i32,
    center: i32,
    /// Seconds of TDB from J2000.0.
    first_s: f64,
    interval_s: f64,
    intervals: usize,
    /// Bytes before the first record, numbers in a record.
    at: usize,
    record_len: usize,
}

impl Kernel {
    /// From the bytes of an SPK file; an error is to be read behind its name.
    pub fn open(bytes: Vec<u8>) -> Result<Kernel, String> {
        if bytes.get(..8) != Some(b"DAF/SPK ") || bytes.get(88..96) != Some(b"LTL-IEEE") {
            return Err("is no little-endian SPK file; give one such as de440.bsp".into());
        }
        let file = Words(&bytes);
        if (file.integer(8)?, file.integer(12)?) != (2, 6) {
            return Err("has summaries of another size than SPK files have".into());
        }
        let mut segments = Vec::new();
        let mut record = file.integer(76)? as usize;
        // The last record of summaries names none; no file has more of them than records.
        for _ in 0..=bytes.len() / RECORD_BYTES {
            let Some(at) = record.checked_sub(1).map(|before| before.saturating_mul(RECORD_BYTES))
            else {
                break;
            };
            let (next, count) = (file.number(at)?, file.number(at + 16)?);
            for index in 0..count as usize {
                let summary = at + 24 + index * SUMMARY_BYTES;
                segments.extend(Segment::read(file, summary)?);
            }
            record = next as usize;
        }
        if segments.is_empty() {
            return Err("has no positions as Chebyshev polynomials (type 2)".into());
        }
        Ok(Kernel { bytes, segments })
    }

    /// First and last Julian date (TDB) that every segment knows.
    pub fn span_jd(&self) -> (f64, f64) {
        let jd = |seconds: f64| J2000 + seconds / DAY_S;
        self.segments.iter().fold((f64::NEG_INFINITY, f64::INFINITY), |(first, last), segment| {
            let end_s = segment.first_s + segment.interval_s * segment.intervals as f64;
            (jd(segment.first_s).max(first), jd(end_s).min(last))
        })
    }

    /// Position of a body with respect to another, km in ICRS axes, by the numbers of NAIF.
    ///
    /// An error if the kernel has no segment of just these two, or none for that moment.
    pub fn position_km(
        &self,
        target: i32,
        center: i32,
        tdb: JulianDate<Tdb>,
    ) -> Result<DVec3, String> {
        let is_asked = |s: &&Segment| (s.target, s.center) == (target, center);
        let Some(segment) = self.segments.iter().find(is_asked) else {
            return Err(format!("has no positions of {target} from {center}"));
        };
        let seconds = (tdb.day() - J2000) * DAY_S - segment.first_s;
        let index = (seconds + tdb.fraction() * DAY_S) / segment.interval_s;
        if !(0.0..=segment.intervals as f64).contains(&index) {
            return Err(format!("does not know where {target} is at {tdb:?}"));
        }
        let index = (index as usize).min(segment.intervals - 1);
        let begin_s = segment.interval_s * index as f64;
        let x = 2.0 * ((seconds - begin_s) + tdb.fraction() * DAY_S) / segment.interval_s - 1.0;
        let record = segment.at + index * segment.record_len * WORD_BYTES;
        let coefficients = (segment.record_len - 2) / 3;
        let file = Words(&self.bytes);
        let mut position = DVec3::ZERO;
        for component in 0..3 {
            let begin = record + (2 + component * coefficients) * WORD_BYTES;
            let (mut next, mut after) = (0.0, 0.0);
            for index in (1..coefficients).rev() {
                let c = file.number(begin + index * WORD_BYTES)?;
                (next, after) = (c + 2.0 * x * next - after, next);
            }
            position[component] = file.number(begin)? + x * next - after;
        }
        Ok(position)
    }
}

impl Segment {
    /// From its summary; nothing if it is of a type that has another use.
    fn read(file: Words, summary: usize) -> Result<Option<Segment>, String> {
        let [target, center, frame, kind, first, last] =
            [16, 20, 24, 28, 32, 36].map(|offset| file.integer(summary + offset));
        if (frame?, kind?) != (FRAME_ICRF, TYPE_CHEBYSHEV_POSITION) {
            return Ok(None);
        }
        let (first, last) = (first? as usize, last? as usize);
        let Some(tail) = last.checked_sub(4) else {
            return Err("has a segment that ends before it begins".into());
        };
        let word = |index: usize| file.number((tail + index) * WORD_BYTES);
        let (first_s, interval_s) = (word(0)?, word(1)?);
        let (record_len, intervals) = (word(2)? as usize, word(3)? as usize);
        let words = record_len.saturating_mul(intervals).saturating_add(4);
        // Numbered from 1, and both ends belong to the segment.
        if first == 0 || record_len < 5 || (last + 1).checked_sub(first) != Some(words) {
            return Err(format!("has a segment of other than {words} numbers"));
        }
        if interval_s.is_nan() || interval_s <= 0.0 || intervals == 0 {
            return Err("has a segment without intervals".into());
        }
        let at = (first - 1) * WORD_BYTES;
        let (target, center) = (target?, center?);
        Ok(Some(Segment { target, center, first_s, interval_s, intervals, at, record_len }))
    }
}

/// Little-endian numbers at places in a file.
#[derive(Clone, Copy)]
struct Words<'a>(&'a [u8]);

impl Words<'_> {
    fn array<const N: usize>(self, at: usize) -> Result<[u8; N], String> {
        let bytes = at.checked_add(N).and_then(|end| self.0.get(at..end));
        let bytes = bytes.ok_or("ends before its last number; fetch it again")?;
        let mut array = [0; N];
        array.copy_from_slice(bytes);
        Ok(array)
    }
    fn integer(self, at: usize) -> Result<i32, String> {
        self.array(at).map(i32::from_le_bytes)
    }
    fn number(self, at: usize) -> Result<f64, String> {
        self.array(at).map(f64::from_le_bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXCERPT: &[u8] = include_bytes!("../../tests/truth/de440_excerpt.bsp");
    const TRUTH: &str = include_str!("../../tests/truth/de440_excerpt.csv");

    #[test]
    fn positions_are_those_of_jplephem() {
        let kernel = Kernel::open(EXCERPT.to_vec()).unwrap();
        let mut rows = 0;
        for line in TRUTH.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())) {
            let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
            let tdb = JulianDate::from_parts(cells[2], cells[3]);
            let seen = kernel.position_km(cells[0] as i32, cells[1] as i32, tdb).unwrap();
            let truth = DVec3::new(cells[4], cells[5], cells[6]);
            // Rounding of 64-bit numbers.
            assert!((seen - truth).length() <= 2e-15 * truth.length(), "{line}: {seen}");
            rows += 1;
        }
        assert_eq!(rows, 48);
    }

    #[test]
    fn what_a_kernel_does_not_hold_is_said() {
        let kernel = Kernel::open(EXCERPT.to_vec()).unwrap();
        let (first, last) = kernel.span_jd();
        assert!(first <= 2_451_545.0 && 2_451_560.0 <= last, "{first} {last}");
        let at = |jd: f64| JulianDate::from_jd(jd);
        let error = kernel.position_km(10, 3, at(first)).unwrap_err();
        assert!(error.contains("no positions of 10 from 3"), "{error}");
        for jd in [first - 400.0, last + 400.0, f64::NAN] {
            let error = kernel.position_km(10, 0, at(jd)).unwrap_err();
            assert!(error.contains("does not know"), "{error}");
        }
    }

    #[test]
    fn a_damaged_kernel_is_refused_not_believed() {
        let refused = |bytes: &[u8]| Kernel::open(bytes.to_vec()).err().unwrap();
        assert!(refused(b"NAIF/DAF").contains("no little-endian SPK"));
        assert!(refused(&EXCERPT[..100]).contains("ends before"));
        assert!(refused(&EXCERPT[..EXCERPT.len() / 2]).contains("ends before"));
        // Any byte of the heads may be any other: no panic.
        for at in 0..3 * RECORD_BYTES {
            let mut bytes = EXCERPT.to_vec();
            bytes[at] ^= 0xff;
            if let Ok(kernel) = Kernel::open(bytes) {
                drop(kernel.position_km(10, 0, JulianDate::from_jd(2_451_545.0)));
            }
        }
    }
}

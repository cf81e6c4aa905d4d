//! Samples of DE431 as `scripts/de431_samples.py` writes them. For packing and comparing.

use std::f64::consts::PI;

use glam::DVec3;

use crate::time::{JulianDate, Tdb};

/// Mark at the begin of the file.
const MARK: &[u8; 8] = b"DE431SMP";
const NAME_BYTES: usize = 16;
/// Bytes of the description of one channel.
const HEAD_BYTES: usize = NAME_BYTES + 3 * 8 + 2 * 4;
/// Bytes of one place: three 32-bit integers.
const PLACE_BYTES: usize = 12;

/// A file of samples in memory.
pub struct Samples {
    bytes: Vec<u8>,
    channels: Vec<Blocks>,
}

/// Positions at Chebyshev nodes in blocks of equal length.
struct Blocks {
    name: String,
    start_jd: f64,
    days: f64,
    unit_km: f64,
    blocks: usize,
    nodes: usize,
    /// Bytes of the file before the first place.
    at: usize,
}

impl Samples {
    /// From the bytes of the file; an error is to be read behind its name.
    pub fn open(bytes: Vec<u8>) -> Result<Samples, String> {
        if !bytes.starts_with(MARK) {
            return Err("holds no samples; make it with scripts/de431_samples.py".into());
        }
        let cut = || "ends within its description; make it again".to_string();
        let count = u32_at(&bytes, MARK.len()).ok_or_else(cut)? as usize;
        let first = MARK.len() + 4;
        let mut at = first.saturating_add(count.saturating_mul(HEAD_BYTES));
        let mut channels = Vec::new();
        for head in 0..count {
            let fields = bytes.get(first + head * HEAD_BYTES..).ok_or_else(cut)?;
            let blocks = Blocks::read(fields, at).ok_or_else(cut)?;
            at = at.saturating_add(blocks.blocks.saturating_mul(blocks.nodes * PLACE_BYTES));
            channels.push(blocks);
        }
        match at == bytes.len() {
            true => Ok(Samples { bytes, channels }),
            false => Err(format!("has {} bytes where {at} are due; make it again", bytes.len())),
        }
    }

    /// Position in a channel, km in ICRS axes, interpolated within a block.
    ///
    /// An error if there is no such channel, or if it does not reach to that moment.
    pub fn position_km(&self, channel: &str, tdb: JulianDate<Tdb>) -> Result<DVec3, String> {
        let blocks = self.channels.iter().find(|blocks| blocks.name == channel);
        let blocks = blocks.ok_or_else(|| format!("has no samples of {channel:?}"))?;
        let position = (tdb - JulianDate::from_jd(blocks.start_jd)) / blocks.days;
        if !(0.0..=blocks.blocks as f64).contains(&position) {
            return Err(format!("has no samples of {channel:?} at JD {}", tdb.day()));
        }
        let block = (position as usize).min(blocks.blocks - 1);
        let x = 2.0 * (position - block as f64) - 1.0;
        // Barycentric interpolation (Berrut & Trefethen 2004, SIAM Review 46, 501, eq. 4.2), with the
        // weights of Chebyshev nodes.
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for node in 0..blocks.nodes {
            let (sin, cos) = (PI * (node as f64 + 0.5) / blocks.nodes as f64).sin_cos();
            let place = self.place(blocks, block * blocks.nodes + node);
            let away = x + cos;
            if away.abs() < 1e-13 {
                return Ok(place);
            }
            let weight = if node % 2 == 0 { sin } else { -sin } / away;
            sum += place * weight;
            weights += weight;
        }
        Ok(sum / weights)
    }

    fn place(&self, blocks: &Blocks, index: usize) -> DVec3 {
        let at = blocks.at + index * PLACE_BYTES;
        let coordinate = |axis: usize| {
            // The length of the file was checked when it was opened.
            let unsigned = u32_at(&self.bytes, at + 4 * axis).unwrap_or_default();
            f64::from(unsigned as i32)
        };
        DVec3::new(coordinate(0), coordinate(1), coordinate(2)) * blocks.unit_km
    }
}

impl Blocks {
    fn read(fields: &[u8], at: usize) -> Option<Blocks> {
        let name = fields.get(..NAME_BYTES)?.split(|&byte| byte == 0).next()?;
        let number = |index: usize| {
            let at = NAME_BYTES + 8 * index;
            Some(f64::from_le_bytes(*fields.get(at..)?.first_chunk()?))
        };
        let counts = NAME_BYTES + 3 * 8;
        Some(Blocks {
            name: String::from_utf8_lossy(name).into_owned(),
            start_jd: number(0)?,
            days: number(1)?,
            unit_km: number(2)?,
            blocks: u32_at(fields, counts)? as usize,
            nodes: u32_at(fields, counts + 4)? as usize,
            at,
        })
    }
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One channel, two blocks of four days from JD 1000, four nodes, of a cubic in time.
    fn file() -> Vec<u8> {
        let mut bytes = [&MARK[..], &1u32.to_le_bytes(), b"cubic", &[0; 11]].concat();
        for number in [1000.0, 4.0, 0.5f64] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend([2u32, 4].map(u32::to_le_bytes).concat());
        for block in 0..2 {
            for node in 0..4 {
                let x = -(PI * (f64::from(node) + 0.5) / 4.0).cos();
                let place = cubic(4.0 * f64::from(block) + 2.0 * (1.0 + x)) / 0.5;
                for coordinate in place.to_array() {
                    bytes.extend((coordinate.round() as i32).to_le_bytes());
                }
            }
        }
        bytes
    }

    fn cubic(days: f64) -> DVec3 {
        DVec3::new(days * days * days, -1000.0 * days, 7e6 - 3e4 * days * days)
    }

    #[test]
    fn a_cubic_is_found_again() {
        let samples = Samples::open(file()).unwrap();
        for eighth in 0..=64 {
            let days = f64::from(eighth) / 8.0;
            let found = samples.position_km("cubic", JulianDate::from_parts(1000.0, days)).unwrap();
            assert!((found - cubic(days)).abs().max_element() < 1.0, "{days}: {found}");
        }
    }

    #[test]
    fn what_is_not_there_is_said() {
        let samples = Samples::open(file()).unwrap();
        let error = |name, jd| samples.position_km(name, JulianDate::from_jd(jd)).unwrap_err();
        assert!(error("cube", 1001.0).contains("cube"));
        assert!(error("cubic", 999.9).contains("JD"));
        assert!(error("cubic", 1008.1).contains("JD"));
        for length in 0..file().len() {
            assert!(Samples::open(file()[..length].to_vec()).is_err(), "{length}");
        }
        assert!(Samples::open([file(), vec![0]].concat()).is_err());
    }
}

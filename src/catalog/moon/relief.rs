//! `moon_relief.bin`: how high each part of the Moon stands.
//!
//! Counts in the header: width, height, step in metres. Then the heights in steps, coded as
//! [`super::super::rice`] says, row by row from the north.
//!
//! Theory: GLD100, the stereo model of the Lunar Reconnaissance Orbiter's wide-angle camera
//! (Scholten et al. 2012, *JGR Planets* 117, E00H17), 8 pixels per degree; caps within about 3 degrees
//! of the poles from the altimeters LOLA and LALT. Heights are above a sphere of 1737.4 km.
//!
//! Accuracy: a step of 3 m, so that each height is within 1 m of that of the source; the source
//! itself is within 24 m of LOLA (median).

use crate::catalog::rice;
use crate::catalog::seal::{self, Kind};
use crate::units::Angle;

const KIND: Kind = Kind { magic: b"NOCTRELF", version: 1 };
/// Metres: the error is then 1 m at most, as the heights of the source are whole metres.
const STEP_M: i16 = 3;
/// A picture's value that stands for the sphere.
const PICTURE_ZERO: i32 = 32_768;
/// Beyond what the Moon has, metres.
const HIGHEST_M: i16 = 12_000;
const LARGEST_WIDTH: u32 = 16_384;

/// The Moon's heights; see [`super`] for how the map lies.
#[derive(Debug, Clone, PartialEq)]
pub struct MoonRelief {
    /// Pixels; twice the height.
    pub width: usize,
    pub height: usize,
    /// Above the sphere of 1737.4 km, row by row; -12000 to 12000.
    pub elevation_m: Vec<i16>,
}

impl MoonRelief {
    /// The height at a place, metres above the sphere of 1737.4 km: straight between pixels.
    pub fn elevation_m(&self, longitude: Angle, latitude: Angle) -> f64 {
        let around = super::around((self.width, self.height), longitude, latitude);
        around.iter().map(|&(at, weight)| f64::from(self.elevation_m[at]) * weight).sum()
    }
}

/// The packed map out of a picture of 16-bit values, metres above the sphere plus 32768, whose
/// longitude grows from 0° at the left edge to 360°; its width is even.
pub fn encode(metres: &[u16], (width, height): (usize, usize)) -> Result<Vec<u8>, String> {
    if width == 0 || width != 2 * height || metres.len() != width * height {
        return Err(format!("has {} values, {width} x {height}", metres.len()));
    }
    let mut steps = Vec::with_capacity(metres.len());
    for row in metres.chunks_exact(width) {
        let (east, west) = row.split_at(width / 2);
        for &value in west.iter().chain(east) {
            let metres = i32::from(value) - PICTURE_ZERO;
            if metres.abs() > i32::from(HIGHEST_M) {
                return Err(format!("has a height of {metres} m"));
            }
            steps.push((f64::from(metres) / f64::from(STEP_M)).round() as i16);
        }
    }
    let counts = [width as u32, height as u32, STEP_M as u32];
    Ok(seal::seal(KIND, counts, &rice::encode(&steps, width)))
}

/// The map in `moon_relief.bin`; an error says what is wrong with the file.
pub fn decode(bytes: &[u8]) -> Result<MoonRelief, String> {
    let ([width, height, step_m], payload) = seal::open(KIND, bytes)?;
    let wrong = || format!("is a map of {width} x {height} pixels in steps of {step_m} m");
    if width == 0 || width != height.saturating_mul(2) || width > LARGEST_WIDTH {
        return Err(wrong());
    }
    let step_m = i16::try_from(step_m).ok().filter(|step| *step > 0).ok_or_else(wrong)?;
    let (mut steps, rest) = rice::decode(payload, width as usize, height as usize)?;
    if !rest.is_empty() {
        return Err(format!("holds {} bytes too many", rest.len()));
    }
    let most = HIGHEST_M / step_m + 1;
    if steps.iter().any(|step| !(-most..=most).contains(step)) {
        return Err(format!("has heights above {HIGHEST_M} m"));
    }
    for step in &mut steps {
        *step *= step_m;
    }
    Ok(MoonRelief { width: width as usize, height: height as usize, elevation_m: steps })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_survive_within_a_metre_and_half_a_turn_apart() {
        let (width, height) = (720, 360);
        let metre = |row: usize, column: usize| (7 * row + column % 360) as i32 - 2000;
        let picture: Vec<u16> = (0..width * height)
            .map(|at| (metre(at / width, at % width) + PICTURE_ZERO) as u16)
            .collect();
        let map = decode(&encode(&picture, (width, height)).unwrap()).unwrap();
        assert_eq!((map.width, map.height), (width, height));
        for row in 0..height {
            for column in 0..width {
                let got = i32::from(map.elevation_m[row * width + (column + 360) % width]);
                assert!((got - metre(row, column)).abs() <= 1);
            }
        }
        let between = map.elevation_m(Angle::from_deg(45.5), Angle::from_deg(10.0));
        let wanted = 0.25 * f64::from(2 * metre(159, 90) + 2 * metre(160, 91)) + 0.0;
        assert!((between - wanted).abs() < 2.0, "{between} {wanted}");
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(encode(&[32_768; 18], (6, 3)).is_ok());
        assert!(encode(&[32_768; 18], (3, 6)).is_err());
        assert!(encode(&[32_768; 17], (6, 3)).is_err());
        assert!(encode(&[0; 18], (6, 3)).unwrap_err().contains("-32768 m"));
        for counts in [[0, 0, 3], [6, 4, 3], [6, 3, 0], [6, 3, 70_000], [u32::MAX, 1 << 31, 3]] {
            assert!(decode(&seal::seal(KIND, counts, &[0; 100])).is_err(), "{counts:?}");
        }
        let high = rice::encode(&[30_000; 18], 6);
        assert!(decode(&seal::seal(KIND, [6, 3, 3], &high)).unwrap_err().contains("heights"));
    }
}

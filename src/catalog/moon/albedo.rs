//! `moon_albedo.bin`: how bright each part of the Moon is, in three colours.
//!
//! Counts in the header: width, height, channels (3). Then, little-endian, the lowest and the
//! highest reflectance of each channel (six f64), and three maps of whole numbers coded as
//! [`super::super::rice`] says, row by row from the north: red; green less red; blue less red. A
//! number `n` from 0 to 255 stands for `low * (high / low)^(n / 255)`: equal steps of 0.7 to 0.8 %
//! everywhere, so that the dark seas lose no more than the bright highlands.
//!
//! Theory: REFF(30°, 0°, 30°) is pi times the radiance over the irradiance of the Sun, lit at 30°
//! and seen from straight above, as a plate of the reflectance REFF that scatters like Lambert's
//! would show it. The map is the LROC WAC colour map of the CGI Moon Kit, brought from its
//! display values to REFF by a power law per channel that was fitted to the Hapke maps of
//! Sato et al. 2014, *JGR Planets* 119, 1775 (rms 0.003 to 0.006).

use crate::catalog::csv::{self, RowError};
use crate::catalog::rice;
use crate::catalog::seal::{self, Kind};
use crate::units::Angle;

const KIND: Kind = Kind { magic: b"NOCTMOON", version: 2 };
const BOUNDS_LEN: usize = 48;
const CALIBRATION_COLUMNS: &str = "channel,wavelength_nm,gamma,slope,intercept,rms_REFF";

/// Size of the packed map, pixels.
pub const PACKED_SIZE: (usize, usize) = (2048, 1024);
const LARGEST_WIDTH: u32 = 16_384;

/// The Moon's reflectance REFF(30°, 0°, 30°), linear, at 643 (red), 566 (green) and 415 nm (blue).
///
/// See [`super`] for how the map lies. Between 0.02 and 0.25 everywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct MoonMap {
    /// Pixels; twice the height.
    pub width: usize,
    pub height: usize,
    /// Row by row, `width * height` of them.
    pub reff: Vec<[f32; 3]>,
}

impl MoonMap {
    /// REFF at a place, at 643, 566 and 415 nm: straight between pixels.
    pub fn reff(&self, longitude: Angle, latitude: Angle) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (at, weight) in super::around((self.width, self.height), longitude, latitude) {
            for (sum, reff) in sum.iter_mut().zip(self.reff[at]) {
                *sum += weight * f64::from(reff);
            }
        }
        sum
    }
}

/// From display values to REFF: `slope * (DN / 255)^gamma + intercept` in each channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    channels: [Channel; 3],
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Channel {
    gamma: f64,
    slope: f64,
    intercept: f64,
}

impl Calibration {
    /// From the table with the rows R, G and B.
    pub(in crate::catalog) fn from_csv(text: &str) -> Result<Calibration, RowError> {
        let rows = csv::rows(text, CALIBRATION_COLUMNS)?;
        let mut channels = Vec::new();
        for (line, row) in &rows {
            let number = |column: usize| {
                row[column]
                    .parse::<f64>()
                    .ok()
                    .filter(|value| (0.01..10.0).contains(value))
                    .ok_or((*line, format!("{:?} is not a number from 0.01 to 10", row[column])))
            };
            let [gamma, slope, intercept] = [number(2)?, number(3)?, number(4)?];
            channels.push(Channel { gamma, slope, intercept });
        }
        let names: Vec<_> = rows.iter().map(|(_, row)| row[0].as_ref()).collect();
        match (names.as_slice(), channels.try_into()) {
            (["R", "G", "B"], Ok(channels)) => Ok(Calibration { channels }),
            _ => Err((2, format!("the channels are {names:?}, not R, G, B"))),
        }
    }

    /// Lowest and highest REFF that a display value can stand for.
    fn bounds(&self) -> [(f64, f64); 3] {
        self.channels.map(|channel| (channel.intercept, channel.intercept + channel.slope))
    }
}

/// The packed map out of a picture of display values (red, green, blue, a byte each).
///
/// The picture covers the same area, `width` times `height` pixels, an integer multiple of
/// [`PACKED_SIZE`]. Averages are taken of REFF, not of display values, and by area on the sphere.
pub fn encode(
    rgb: &[u8],
    (width, height): (usize, usize),
    calibration: &Calibration,
) -> Result<Vec<u8>, String> {
    let (packed_width, packed_height) = PACKED_SIZE;
    let factor = width / packed_width;
    if factor == 0 || (width, height) != (packed_width * factor, packed_height * factor) {
        return Err(format!(
            "is {width} x {height} pixels, no multiple of {packed_width} x {packed_height}"
        ));
    }
    if rgb.len() != width * height * 3 {
        return Err(format!("holds {} bytes for {width} x {height} pixels", rgb.len()));
    }
    let reff_from_display = calibration.channels.map(|channel| -> Vec<f64> {
        let reff = |display: u8| {
            channel.slope * (f64::from(display) / 255.0).powf(channel.gamma) + channel.intercept
        };
        (0..=u8::MAX).map(reff).collect()
    });
    let bounds = calibration.bounds();
    let mut payload = Vec::with_capacity(BOUNDS_LEN);
    for (low, high) in bounds {
        payload.extend(low.to_le_bytes());
        payload.extend(high.to_le_bytes());
    }
    let mut maps = [const { Vec::new() }; 3];
    for packed_row in 0..packed_height {
        let rows = packed_row * factor..(packed_row + 1) * factor;
        // The area of a pixel goes with the cosine of its latitude.
        let weights: Vec<f64> = rows
            .clone()
            .map(|row| (std::f64::consts::PI * (row as f64 + 0.5) / height as f64).sin())
            .collect();
        let total = weights.iter().sum::<f64>() * factor as f64;
        for packed_column in 0..packed_width {
            let mut sums = [0.0; 3];
            for (row, weight) in rows.clone().zip(&weights) {
                let start = (row * width + packed_column * factor) * 3;
                for pixel in rgb[start..start + factor * 3].chunks_exact(3) {
                    for channel in 0..3 {
                        sums[channel] +=
                            weight * reff_from_display[channel][usize::from(pixel[channel])];
                    }
                }
            }
            let [red, green, blue]: [i16; 3] = std::array::from_fn(|channel| {
                i16::from(byte_from_reff(sums[channel] / total, bounds[channel]))
            });
            for (map, number) in maps.iter_mut().zip([red, green - red, blue - red]) {
                map.push(number);
            }
        }
    }
    for map in &maps {
        payload.extend(rice::encode(map, packed_width));
    }
    Ok(seal::seal(KIND, [packed_width as u32, packed_height as u32, 3], &payload))
}

/// The map in `moon_albedo.bin`; an error says what is wrong with the file.
pub fn decode(bytes: &[u8]) -> Result<MoonMap, String> {
    let ([width, height, channels], payload) = seal::open(KIND, bytes)?;
    let twice = u64::from(width) == 2 * u64::from(height);
    if channels != 3 || height == 0 || !twice || width > LARGEST_WIDTH {
        return Err(format!("is a map of {width} x {height} pixels in {channels} channels"));
    }
    let (width, height) = (width as usize, height as usize);
    let (bounds, coded) = payload
        .split_at_checked(BOUNDS_LEN)
        .ok_or_else(|| format!("holds {} bytes, too few for its bounds", payload.len()))?;
    let mut numbers = bounds.chunks_exact(8).map(|bytes| {
        let mut number = [0; 8];
        number.copy_from_slice(bytes);
        f64::from_le_bytes(number)
    });
    let mut reff_from_byte = Vec::with_capacity(3);
    while let (Some(low), Some(high)) = (numbers.next(), numbers.next()) {
        // Written so that NaN, which is in no range, is refused too.
        if !(0.001..=1.0).contains(&low) || !(low..=1.0).contains(&high) {
            return Err(format!("has reflectances from {low} to {high}, outside 0.001 to 1"));
        }
        let reff = |byte| reff_from_byte_within(byte, (low, high)) as f32;
        reff_from_byte.push((0..=u8::MAX).map(reff).collect::<Vec<f32>>());
    }
    let (red, rest) = rice::decode(coded, width, height)?;
    let (green, rest) = rice::decode(rest, width, height)?;
    let (blue, rest) = rice::decode(rest, width, height)?;
    if !rest.is_empty() {
        return Err(format!("holds {} bytes too many", rest.len()));
    }
    let mut reff = Vec::with_capacity(width * height);
    for ((&red, &green), &blue) in red.iter().zip(&green).zip(&blue) {
        let numbers = [red, green.wrapping_add(red), blue.wrapping_add(red)];
        let mut pixel = [0.0; 3];
        for channel in 0..3 {
            match u8::try_from(numbers[channel]) {
                Ok(byte) => pixel[channel] = reff_from_byte[channel][usize::from(byte)],
                Err(_) => return Err(format!("has a pixel of {numbers:?} steps of 255")),
            }
        }
        reff.push(pixel);
    }
    Ok(MoonMap { width, height, reff })
}

fn reff_from_byte_within(byte: u8, (low, high): (f64, f64)) -> f64 {
    low * (high / low).powf(f64::from(byte) / 255.0)
}

/// The nearest byte, in equal ratios between the bounds.
fn byte_from_reff(reff: f64, (low, high): (f64, f64)) -> u8 {
    (255.0 * (reff / low).ln() / (high / low).ln()).round().clamp(0.0, 255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "channel,wavelength_nm,gamma,slope,intercept,rms_REFF\n\
        R,643,1.90,0.21313,0.03550,0.00568\n\
        G,566,1.80,0.18303,0.02732,0.00435\n\
        B,415,2.00,0.13464,0.02339,0.00333\n";

    fn calibration() -> Calibration {
        Calibration::from_csv(TABLE).unwrap()
    }

    #[test]
    fn bytes_and_reflectances_are_inverse() {
        for bounds in calibration().bounds() {
            for byte in 0..=u8::MAX {
                assert_eq!(byte_from_reff(reff_from_byte_within(byte, bounds), bounds), byte);
            }
            assert!((reff_from_byte_within(0, bounds) - bounds.0).abs() < 1e-15);
            assert!((reff_from_byte_within(255, bounds) - bounds.1).abs() < 1e-15);
        }
    }

    #[test]
    fn a_flat_picture_keeps_its_reflectance_within_half_a_step() {
        let (width, height) = (PACKED_SIZE.0 * 2, PACKED_SIZE.1 * 2);
        let picture = [200u8, 120, 60].repeat(width * height);
        let map = decode(&encode(&picture, (width, height), &calibration()).unwrap()).unwrap();
        assert_eq!((map.width, map.height, map.reff.len()), (2048, 1024, 2048 * 1024));
        let wanted = [
            0.21313 * (200.0f64 / 255.0).powf(1.9) + 0.03550,
            0.18303 * (120.0f64 / 255.0).powf(1.8) + 0.02732,
            0.13464 * (60.0f64 / 255.0).powf(2.0) + 0.02339,
        ];
        for pixel in [map.reff[0], map.reff[2048 * 300 + 17]] {
            for channel in 0..3 {
                let ratio = f64::from(pixel[channel]) / wanted[channel];
                assert!((ratio - 1.0).abs() < 0.0040, "{ratio}");
            }
        }
    }

    #[test]
    fn light_is_averaged_not_display_values() {
        // Black and white in equal parts: REFF is the mean of the bounds.
        let (width, height) = (PACKED_SIZE.0 * 2, PACKED_SIZE.1 * 2);
        let picture = [0u8, 0, 0, 255, 255, 255].repeat(width * height / 2);
        let map = decode(&encode(&picture, (width, height), &calibration()).unwrap()).unwrap();
        for (channel, (low, high)) in calibration().bounds().into_iter().enumerate() {
            let ratio = f64::from(map.reff[0][channel]) / (0.5 * (low + high));
            assert!((ratio - 1.0).abs() < 0.0040, "{ratio}");
        }
    }

    #[test]
    fn rows_and_columns_stay_where_they_are() {
        let (width, height) = PACKED_SIZE;
        let mut picture = vec![0u8; width * height * 3];
        let at = 100 * width + 900;
        picture[at * 3] = 255;
        let map = decode(&encode(&picture, (width, height), &calibration()).unwrap()).unwrap();
        let brightest =
            (0..map.reff.len()).max_by(|&a, &b| map.reff[a][0].total_cmp(&map.reff[b][0]));
        assert_eq!(brightest, Some(at));
        assert!((f64::from(map.reff[at][0]) - 0.24863).abs() < 1e-6);
    }

    #[test]
    fn other_sizes_and_other_channels_are_refused() {
        assert!(encode(&[0; 30], (5, 2), &calibration()).is_err());
        assert!(encode(&[0; 30], PACKED_SIZE, &calibration()).is_err());
        assert!(Calibration::from_csv(&TABLE.replace("G,566", "X,566")).is_err());
        assert!(Calibration::from_csv(&TABLE.replace("1.80", "-1.80")).is_err());
        let mut payload = vec![0; BOUNDS_LEN + 2 * 3];
        assert!(decode(&seal::seal(KIND, [2, 1, 3], &payload)).unwrap_err().contains("reflect"));
        payload.pop();
        assert!(decode(&seal::seal(KIND, [2, 1, 3], &payload)).is_err());
        assert!(decode(&seal::seal(KIND, [0, 0, 3], &[0; BOUNDS_LEN])).is_err());
    }
}

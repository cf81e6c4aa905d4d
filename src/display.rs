//! The screen: from shares of its white to the codes that are sent to it.
//!
//! Light comes as X, Y and Z in shares of the luminance of the screen's white. A matrix takes it to
//! the linear primaries of the screen (sRGB, IEC 61966-2-1, or Display P3, whose primaries are those
//! of SMPTE RP 431-2 with the white and the curve of sRGB). What the screen cannot show is brought into
//! its gamut, a night mode may put all of it into red, the transfer curve makes codes of it, and
//! dithering rounds them.
//!
//! *Gamut.* No channel is cut by itself: that would turn hues. A negative channel goes towards the grey
//! of the same luminance until it is zero. A channel above one: a part of what is shown has moved
//! to the grey of its luminance (white, when it is brighter than that), the square of that luminance, and
//! the rest has been dimmed. So a
//! bright orange light becomes paler and stays orange. The part that moves begins to when a channel has
//! used more than half of the room between that grey and white, and never uses all of it: a bright blue sky gets paler
//! before its blue is all there is.
//!
//! *Dithering* adds noise of a triangular density, two codes wide, before rounding: neither the mean nor the
//! variance of what is shown then depends on where between two codes it lies (Lipshitz, Wannamaker
//! & Vanderkooy 1992, *J. Audio Eng. Soc.* 40, 355), so that a slow gradient has no bands. Within half
//! a code of black and white it is uniform, one code wide, where both have the same variance: black
//! stays black. The noise is not random: it is the additive sequence R2 of Roberts 2018 (*The
//! unreasonable effectiveness of quasirandom sequences*), in whole numbers, whose neighbours differ
//! as much as they can.
//!
//! `shaders/lib/display.wgsl` does the same in 32 bits; `tests/display.rs` compares both.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::image::Image;

/// What can be wrong with a screen.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DisplayError {
    #[error("display.{what} is {value}, outside {low} to {high}; choose a value inside")]
    Range { what: &'static str, value: f64, low: f64, high: f64 },
}

/// The primaries and the transfer curve of a screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColourSpace {
    /// IEC 61966-2-1.
    #[default]
    Srgb,
    /// Primaries of SMPTE RP 431-2, white D65, the curve of sRGB.
    DisplayP3,
    /// Primaries of sRGB without a transfer curve.
    Linear,
}

/// Chromaticity of D65, as both standards round it.
const D65: [f64; 2] = [0.3127, 0.3290];

impl ColourSpace {
    /// Chromaticities of red, green and blue.
    pub const fn primaries(self) -> [[f64; 2]; 3] {
        match self {
            ColourSpace::Srgb | ColourSpace::Linear => [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]],
            ColourSpace::DisplayP3 => [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]],
        }
    }

    /// Whether codes follow the transfer curve of sRGB.
    pub const fn is_encoded(self) -> bool {
        !matches!(self, ColourSpace::Linear)
    }

    /// X, Y and Z of linear RGB: white (1, 1, 1) is D65 of luminance one.
    pub fn xyz_from_rgb(self) -> DMat3 {
        let xyz = |[x, y]: [f64; 2]| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
        let [red, green, blue] = self.primaries().map(xyz);
        let primaries = DMat3::from_cols(red, green, blue);
        let luminances = primaries.inverse() * xyz(D65);
        primaries * DMat3::from_diagonal(luminances)
    }
}

/// How the picture is shown.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Display {
    pub space: ColourSpace,
    /// Luminance of the screen's white, cd/m2.
    pub peak_cd_m2: f64,
    /// Night mode: the luminance of what is shown goes into the red of the screen alone.
    pub red: bool,
    /// Whether codes are dithered; pictures of 16 bits and more never are.
    pub dither: bool,
    /// The angle that a pixel of the screen spans for its viewer, minutes of arc: 1.3 for 24 inches,
    /// 1920 pixels across, seen from 70 cm.
    pub pixel_arcmin: f64,
    /// Luminance that the viewer of the screen is adapted to besides the place that is looked at, cd/m2: half
    /// the white of a screen of 100 (Ward 1994), as in a lit room. The reference room of IEC 61966-2-1,
    /// dim, has 4.1.
    pub surround_cd_m2: f64,
}

impl Default for Display {
    fn default() -> Self {
        Display {
            space: ColourSpace::Srgb,
            peak_cd_m2: 100.0,
            red: false,
            dither: true,
            pixel_arcmin: 1.3,
            surround_cd_m2: 50.0,
        }
    }
}

/// The highest code of 8 bits.
const STEPS: f64 = 255.0;

/// The additive sequence R2: the inverses of the plastic number 1.32471795724474602596 and of its square, in
/// units of 2^-32.
const R2: [u32; 2] = [3_242_174_889, 2_447_445_414];

impl Display {
    /// Checks every value.
    pub fn validate(&self) -> Result<(), DisplayError> {
        let checks = [
            ("peak_cd_m2", self.peak_cd_m2, 1.0, 10_000.0),
            ("pixel_arcmin", self.pixel_arcmin, 0.01, 120.0),
            ("surround_cd_m2", self.surround_cd_m2, 0.0, 10_000.0),
        ];
        for (what, value, low, high) in checks {
            if !(low..=high).contains(&value) {
                return Err(DisplayError::Range { what, value, low, high });
            }
        }
        Ok(())
    }

    /// Linear RGB of X, Y and Z: white (1, 1, 1) is D65 of luminance one.
    pub fn rgb_from_xyz(&self) -> DMat3 {
        self.space.xyz_from_rgb().inverse()
    }

    /// What is sent to the screen of linear RGB within its gamut: the same, or its luminance in red.
    pub fn shown_from_rgb(&self) -> DMat3 {
        match self.red {
            false => DMat3::IDENTITY,
            true => {
                let luminance = self.space.xyz_from_rgb().row(1);
                DMat3::from_cols(luminance, DVec3::ZERO, DVec3::ZERO).transpose()
            }
        }
    }

    /// The transfer curve: codes, 0 to 1, of linear shares of white.
    pub fn encoded(&self, linear: [f64; 3]) -> [f64; 3] {
        match self.space.is_encoded() {
            true => linear.map(srgb_curve),
            false => linear,
        }
    }

    /// The same before rounding: codes, 0 to 1, of X, Y and Z in shares of white.
    pub fn encoded_xyz(&self, xyz: [f64; 3]) -> [f64; 3] {
        self.encoded_rgb(within_gamut(self.rgb_from_xyz() * DVec3::from_array(xyz), xyz[1]))
    }

    /// The codes of a pixel in 8 bits, of X, Y and Z in shares of white.
    pub fn code(&self, xyz: [f64; 3], x: u32, y: u32) -> [u8; 3] {
        self.rounded(self.encoded_xyz(xyz), x, y)
    }

    /// The same of linear RGB within the gamut.
    pub fn code_of_rgb(&self, rgb: DVec3, x: u32, y: u32) -> [u8; 3] {
        self.rounded(self.encoded_rgb(rgb), x, y)
    }

    /// The codes of 16 bits of a picture in linear shares of white; not dithered.
    pub fn sixteen_bits(&self, linear: &Image<[f32; 3]>) -> Image<[u16; 3]> {
        let code = |code: f64| (code.clamp(0.0, 1.0) * 65_535.0).round() as u16;
        linear.map(|rgb| self.encoded(rgb.map(f64::from)).map(code))
    }

    fn encoded_rgb(&self, rgb: DVec3) -> [f64; 3] {
        let shown = (self.shown_from_rgb() * rgb).clamp(DVec3::ZERO, DVec3::ONE);
        self.encoded(shown.to_array())
    }

    /// Codes, 0 to 1, in whole steps.
    fn rounded(&self, codes: [f64; 3], x: u32, y: u32) -> [u8; 3] {
        codes.map(|code| {
            let steps = code * STEPS;
            let dithered = if self.dither { dithered(steps, dither(x, y)) } else { steps };
            (dithered + 0.5).floor().clamp(0.0, STEPS) as u8
        })
    }
}

/// IEC 61966-2-1: the code of a linear share of white.
pub fn srgb_curve(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Share of the room between grey and white that a channel uses as it is.
const FREE: f64 = 0.6;

/// A colour within the gamut, and with its hue, of any linear RGB and its luminance.
pub fn within_gamut(rgb: DVec3, luminance: f64) -> DVec3 {
    let grey = luminance.max(0.0);
    let low = rgb.min_element().min(0.0);
    // A luminance of zero leaves nothing to mix with.
    let keep = if grey > low { grey / (grey - low) } else { 0.0 };
    // Rounding leaves the one that should be zero a little below.
    let positive = (DVec3::splat(grey) + (rgb - grey) * keep).max(DVec3::ZERO);
    let high = positive.max_element();
    let white = grey.min(1.0);
    let (room, used) = (1.0 - white, high - white);
    if used <= FREE * room {
        return positive;
    }
    // Beyond, ever less of what remains, smoothly.
    let left = (1.0 - FREE).powi(2) * room / (used + (1.0 - 2.0 * FREE) * room);
    let keep = room / used * (1.0 - left);
    let paler = DVec3::splat(white) + (positive - grey) * keep;
    // The brighter it is, the more of it goes to white.
    let share = white * white;
    paler * share + positive / high.max(1.0) * (1.0 - share)
}

/// Noise of a pixel, 0 up to 1, spread evenly over any few neighbours: the sequence R2.
pub fn dither(x: u32, y: u32) -> f64 {
    let phase = x.wrapping_mul(R2[0]).wrapping_add(y.wrapping_mul(R2[1]));
    f64::from(phase >> 8) / f64::from(1 << 24)
}

/// A code with noise in it, to be rounded; both in units of a code, the noise from 0 to 1.
fn dithered(code: f64, noise: f64) -> f64 {
    let centred = 2.0 * noise - 1.0;
    let triangular = centred.signum() * (1.0 - (1.0 - centred.abs()).sqrt());
    let is_near_an_end = !(0.5..=STEPS - 0.5).contains(&code);
    code + if is_near_an_end { 0.5 * centred } else { triangular }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACES: [ColourSpace; 3] =
        [ColourSpace::Srgb, ColourSpace::DisplayP3, ColourSpace::Linear];

    #[test]
    fn matrices_are_those_of_the_standards() {
        // IEC 61966-2-1, Amendment 1, to its seven digits; and of Display P3 as Apple and CSS Color 4
        // publish it.
        let srgb = [
            [3.240_969_9, -1.537_383_2, -0.498_610_8],
            [-0.969_243_6, 1.875_967_5, 0.041_555_1],
            [0.055_630_1, -0.203_977_0, 1.056_971_5],
        ];
        let p3 = [
            [2.493_496_9, -0.931_383_6, -0.402_710_8],
            [-0.829_489_0, 1.762_664_1, 0.023_624_7],
            [0.035_845_8, -0.076_172_4, 0.956_884_5],
        ];
        for (space, published) in [(ColourSpace::Srgb, srgb), (ColourSpace::DisplayP3, p3)] {
            let matrix = Display { space, ..Display::default() }.rgb_from_xyz();
            for (row, published) in published.iter().enumerate() {
                for (column, published) in published.iter().enumerate() {
                    let value = matrix.col(column)[row];
                    assert!((value - published).abs() < 2e-6, "{space:?} {row} {column}: {value}");
                }
            }
        }
    }

    #[test]
    fn white_is_white_and_red_is_as_bright() {
        for space in SPACES {
            for red in [false, true] {
                let display = Display { space, red, dither: false, ..Display::default() };
                let white = space.xyz_from_rgb() * DVec3::ONE;
                let expected = if red { [255, 0, 0] } else { [255; 3] };
                assert_eq!(display.code(white.to_array(), 3, 5), expected);
                assert_eq!(display.code([0.0; 3], 3, 5), [0; 3]);
            }
        }
        // Green of luminance 0.2 and white of luminance 0.2 look alike at night.
        let night = Display { red: true, ..Display::default() };
        let green = night.encoded_xyz([0.1, 0.2, 0.04]);
        let white = night.encoded_xyz([0.19009, 0.2, 0.21782]);
        assert!((green[0] - white[0]).abs() < 1e-4 && green[1] == 0.0, "{green:?} {white:?}");
    }

    #[test]
    fn colours_beyond_the_gamut_keep_their_hue() {
        let display = Display { dither: false, ..Display::default() };
        // Sodium light, ever brighter: red stays ahead of green, green of blue, no channel turns back.
        let mut last = 0.0;
        for exponent in -40..=100 {
            let y = 10f64.powf(f64::from(exponent) / 10.0);
            let [r, g, b] = display.encoded_xyz([1.36 * y, y, 0.01 * y]);
            assert!(r <= 1.0 && r >= g && g >= b && b >= 0.0, "{y}: {r} {g} {b}");
            let brightness = r + g + b;
            assert!(brightness >= last - 1e-9, "{y}: {brightness} after {last}");
            last = brightness;
        }
        // Below white and with one negative channel the luminance stays.
        let rgb = within_gamut(DVec3::new(-0.1, 0.4, 0.3), 0.285_52);
        assert!(rgb.x.abs() < 1e-12 && rgb.y < 0.4);
        let weights = ColourSpace::Srgb.xyz_from_rgb().row(1);
        let before = weights.dot(DVec3::new(-0.1, 0.4, 0.3));
        let after = weights.dot(within_gamut(DVec3::new(-0.1, 0.4, 0.3), before));
        assert!((after / before - 1.0).abs() < 1e-9, "{after} {before}");
        for bad in [[1e30, 1e30, 1e30], [-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1e-30, 1.0]] {
            let shown = display.encoded_xyz(bad);
            assert!(shown.iter().all(|c| (0.0..=1.0).contains(c)), "{bad:?}: {shown:?}");
        }
    }

    #[test]
    fn dithering_keeps_mean_and_variance() {
        let pixels = || (0..256u32).flat_map(|y| (0..256u32).map(move |x| (x, y)));
        for step in 0..=60 {
            let code = f64::from(step) / 20.0;
            let shown = |(x, y)| (dithered(code, dither(x, y)) + 0.5).floor();
            let mean = pixels().map(shown).sum::<f64>() / 65536.0;
            let square = pixels().map(|at| (shown(at) - code).powi(2)).sum::<f64>() / 65536.0;
            assert!((mean - code).abs() < 2e-3, "{code}: {mean}");
            if code >= 0.5 {
                assert!((square - 0.25).abs() < 3e-3, "{code}: variance {square}");
            }
        }
    }

    #[test]
    fn a_dark_gradient_shows_no_band() {
        // Four codes over 512 pixels. What is seen from afar, means of 8 x 8 pixels, follows the
        // gradient: undithered it is off by half a code.
        let gradient = |x: u32| 4.0 * (f64::from(x) + 0.5) / 512.0;
        for first in (0..512).step_by(8) {
            let block = (first..first + 8).flat_map(|x| (0..8).map(move |y| (x, y)));
            let shown = |(x, y)| (dithered(gradient(x), dither(x, y)) + 0.5).floor();
            let mean = block.map(shown).sum::<f64>() / 64.0;
            let meant = (0..8).map(|x| gradient(first + x)).sum::<f64>() / 8.0;
            assert!((mean - meant).abs() < 0.1, "{first}: {mean}, not {meant}");
        }
    }

    #[test]
    fn bad_values_are_refused_by_name() {
        assert!(Display::default().validate().is_ok());
        let bad = Display { peak_cd_m2: f64::NAN, ..Display::default() };
        assert!(bad.validate().unwrap_err().to_string().contains("peak_cd_m2"));
        let bad = Display { pixel_arcmin: 0.0, ..Display::default() };
        assert!(bad.validate().unwrap_err().to_string().contains("pixel_arcmin"));
    }
}

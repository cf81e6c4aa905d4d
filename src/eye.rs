//! A first eye: from absolute light to what a screen shows of it.
//!
//! The eye adapts to a mean of what it sees. What it can just tell apart there is
//! shown as what the viewer of the screen can just tell apart (visibility matching, Ward Larson,
//! Rushmeier & Piatko 1997, *IEEE TVCG* 3, 291). By night the rods take over and see all light
//! as a bluish grey (Jensen et al. 2000, *Night Rendering*, UUCS-00-016).
//!
//! How we differ: one scale for rods and cones, set by the better of the two, so that a brighter
//! point is never shown darker; highlights are compressed by Reinhard et al. 2002, Eq. 3. Acuity
//! and the time that adaptation takes are not here yet.

pub mod glare;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::image::{HdrFrame, Image};
use crate::units::{Angle, Xyzv};

use self::glare::{Glare, Scratch};

/// How the picture is seen and shown.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Eye {
    /// Luminance of the screen's white, cd/m2.
    pub display_peak_cd_m2: f64,
    /// Brighter or darker than the eye would have it, in factors of two.
    pub exposure_stops: f64,
    /// What the eye is adapted to, cd/m2; from the picture itself when not given.
    pub adaptation_cd_m2: Option<f64>,
    /// Whether the rods see, in blue-grey; without them colours are those of day at any light.
    pub rods: bool,
    /// Whether the eye scatters light, so that what is bright has a veil around it.
    pub glare: bool,
}

impl Default for Eye {
    fn default() -> Self {
        Eye {
            display_peak_cd_m2: 100.0,
            exposure_stops: 0.0,
            adaptation_cd_m2: None,
            rods: true,
            glare: true,
        }
    }
}

/// What the eye made of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// 8-bit sRGB.
    pub picture: Image<[u8; 3]>,
    /// The luminance that the eye was adapted to, cd/m2.
    pub adaptation_cd_m2: f64,
}

/// The eye adapts to the mean of this power of the luminance. Nearer to 0, the black around a
/// magnified Moon would leave it overexposed; nearer to 1, the Sun in the corner of a landscape
/// would darken all of it. Chosen by eye on the Moon of 2026-08-27 in a field of 0.7 degrees.
const ADAPTATION_EXPONENT: f64 = 0.4;
/// Pixels summed at a time.
const ADAPTATION_PIECE: usize = 1 << 14;
/// What an eye adapts to that sees nothing, cd/m2: its own noise, about that of a starless sky.
const DARKEST_CD_M2: f64 = 1e-4;

/// A picture finer than this, about what an eye resolves, is seen magnified, as through a telescope
/// or on a nearby screen: its pixels appear this far apart. Without it a close-up of the Moon
/// would be no sharper than the naked eye sees her.
const FINEST_PIXEL_DEG: f64 = 1.0 / 60.0;

/// Below this the rods see alone, and above [`CONES_ALONE_LOG`] the cones: log10 of cd/m2
/// (Jensen et al. 2000).
const RODS_ALONE_LOG: f64 = -2.0;
const CONES_ALONE_LOG: f64 = 0.6;
/// Chromaticity of what rods see, and the share of scotopic luminance that they show as light
/// (Jensen et al. 2000).
const ROD_CHROMATICITY: [f64; 2] = [0.25, 0.25];
const ROD_GAIN: f64 = 0.4468;

/// The share of the cones in what is seen at a luminance, zero to one.
fn cone_share(luminance_cd_m2: f64) -> f64 {
    let log = luminance_cd_m2.max(1e-12).log10();
    let x = ((log - RODS_ALONE_LOG) / (CONES_ALONE_LOG - RODS_ALONE_LOG)).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The smallest difference of luminance that an eye adapted to `luminance_cd_m2` sees, cd/m2.
///
/// Ward Larson et al. 1997, table 1, after Ferwerda et al. 1996: the better of rods and cones.
pub fn threshold_cd_m2(luminance_cd_m2: f64) -> f64 {
    let log = luminance_cd_m2.max(1e-12).log10();
    let log_threshold = if log < -3.94 {
        -2.86
    } else if log < -1.44 {
        (0.405 * log + 1.6).powf(2.18) - 2.86
    } else if log < -0.0184 {
        log - 0.395
    } else if log < 1.9 {
        (0.249 * log + 0.65).powf(2.7) - 0.72
    } else {
        log - 1.255
    };
    10f64.powf(log_threshold)
}

impl Eye {
    /// What an eye in front of the frame adapts to, cd/m2.
    fn adapted_to(&self, frame: &HdrFrame) -> f64 {
        if let Some(given) = self.adaptation_cd_m2 {
            return given;
        }
        // Summed piece by piece and in order, so that the same frame gives the same bits.
        let pieces: Vec<(f64, u64)> = frame
            .pixels()
            .par_chunks(ADAPTATION_PIECE)
            .map(|pixels| {
                let lit = pixels.iter().map(|&pixel| self.seen(pixel).y).filter(|&y| y > 0.0);
                lit.fold((0.0, 0), |(sum, n), y| (sum + y.powf(ADAPTATION_EXPONENT), n + 1))
            })
            .collect();
        let (sum, count) = pieces.iter().fold((0.0, 0), |(s, n), piece| (s + piece.0, n + piece.1));
        if count == 0 {
            DARKEST_CD_M2
        } else {
            (sum / count as f64).powf(1.0 / ADAPTATION_EXPONENT)
        }
    }

    /// The frame as the screen shows it; `pixel_angle` is between pixels in its middle.
    pub fn see(&self, frame: &HdrFrame, pixel_angle: Angle) -> Seen {
        let adaptation_cd_m2 = self.adapted_to(frame);
        let screen_adaptation = self.display_peak_cd_m2 / 2.0;
        let scale = threshold_cd_m2(screen_adaptation) / threshold_cd_m2(adaptation_cd_m2)
            * self.exposure_stops.exp2()
            / self.display_peak_cd_m2;
        let glare = self
            .glare
            .then(|| Glare::of(frame, Angle::from_deg(pixel_angle.deg().max(FINEST_PIXEL_DEG))));
        let mut picture = Image::filled(frame.width_px(), frame.height_px(), [0; 3]);
        let width = frame.width_px() as usize;
        picture
            .pixels_mut()
            .par_chunks_mut(width)
            .zip(frame.pixels().par_chunks(width))
            .enumerate()
            .for_each_init(Scratch::default, |scratch, (y, (row, lights))| {
                let lights = glare.as_ref().map_or(lights, |glare| glare.row(y, scratch));
                for (x, (shown, &light)) in row.iter_mut().zip(lights).enumerate() {
                    *shown = encoded(self.shown(light, scale), dither(x as u32, y as u32));
                }
            });
        Seen { picture, adaptation_cd_m2 }
    }

    /// The light that rods and cones make of a pixel together; X, Y and Z count.
    fn seen(&self, [x, y, z, v]: [f32; 4]) -> Xyzv {
        let light = Xyzv::new(x.into(), y.into(), z.into(), v.into());
        let cones = if self.rods { cone_share(light.y) } else { 1.0 };
        let [rod_x, rod_y] = ROD_CHROMATICITY;
        let grey = Xyzv::new(rod_x / rod_y, 1.0, (1.0 - rod_x - rod_y) / rod_y, 0.0);
        light * cones + grey * ((1.0 - cones) * ROD_GAIN * light.v)
    }

    /// A pixel as sRGB, 0 to 1; `scale` takes cd/m2 to shares of the screen's white.
    fn shown(&self, pixel: [f32; 4], scale: f64) -> [f64; 3] {
        let seen = self.seen(pixel) * scale;
        if seen.y <= 0.0 {
            return [0.0; 3];
        }
        // Reinhard et al. 2002, Eq. 3, on the luminance; the colour stays.
        let luminance = seen.y / (1.0 + seen.y);
        srgb_from_linear(within_gamut(linear_srgb(seen * (luminance / seen.y)), luminance))
    }
}

/// Linear sRGB of a light, IEC 61966-2-1.
fn linear_srgb(light: Xyzv) -> [f64; 3] {
    let Xyzv { x, y, z, .. } = light;
    [
        3.240_969_9 * x - 1.537_383_2 * y - 0.498_610_8 * z,
        -0.969_243_6 * x + 1.875_967_5 * y + 0.041_555_1 * z,
        0.055_630_1 * x - 0.203_977_0 * y + 1.056_971_5 * z,
    ]
}

/// A colour that the screen cannot show, mixed with the grey of its luminance until it can.
fn within_gamut(rgb: [f64; 3], luminance: f64) -> [f64; 3] {
    let mut keep = 1.0f64;
    for channel in rgb {
        let room = if channel > luminance { 1.0 - luminance } else { luminance };
        let reach = (channel - luminance).abs();
        if reach > room {
            keep = keep.min(room / reach);
        }
    }
    rgb.map(|channel| luminance + (channel - luminance) * keep)
}

/// sRGB of linear shares of white, IEC 61966-2-1.
fn srgb_from_linear(rgb: [f64; 3]) -> [f64; 3] {
    rgb.map(|c| if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 })
}

/// 8 bits of sRGB, rounded up where the fraction reaches the threshold.
fn encoded(srgb: [f64; 3], threshold: f64) -> [u8; 3] {
    srgb.map(|c| (c * 255.0 + 1.0 - threshold).floor().clamp(0.0, 255.0) as u8)
}

/// Threshold of rounding at a pixel, above 0 and up to 1, spread evenly over neighbours so that
/// dark gradients show no bands: interleaved gradient noise (Jimenez 2014, SIGGRAPH course).
fn dither(x: u32, y: u32) -> f64 {
    let phase = 0.067_110_56 * f64::from(x) + 0.005_837_15 * f64::from(y);
    1.0 - (52.982_918_9 * phase.fract()).fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Luminances from the dark between the stars to the disc of the Sun.
    fn ladder() -> impl Iterator<Item = f64> {
        (-60..=93).map(|tenth| 10f64.powf(f64::from(tenth) / 10.0))
    }

    #[test]
    fn thresholds_are_continuous_and_grow_with_light() {
        for pair in ladder().collect::<Vec<_>>().windows(2) {
            let (low, high) = (threshold_cd_m2(pair[0]), threshold_cd_m2(pair[1]));
            assert!(high >= low * 0.999 && high < low * 1.4, "{} {low} {high}", pair[0]);
        }
        assert!((threshold_cd_m2(1e3).log10() - 1.745).abs() < 1e-9);
    }

    #[test]
    fn brighter_is_never_shown_darker() {
        let eye = Eye::default();
        // The light of a star of the Sun's colour, and that of the night sky.
        for scotopic_ratio in [1.4f32, 2.35] {
            let shown: Vec<f64> = ladder()
                .map(|l| {
                    let y = l as f32;
                    eye.shown([0.95 * y, y, 1.09 * y, scotopic_ratio * y], 20.0)[1]
                })
                .collect();
            assert!(shown.windows(2).all(|pair| pair[1] >= pair[0]), "{shown:?}");
            assert!(shown[0] < 0.001 && shown[shown.len() - 1] > 0.999, "{shown:?}");
        }
    }

    #[test]
    fn night_is_bluish_and_day_is_white() {
        let eye = Eye::default();
        let white = |y: f32| [0.9505 * y, y, 1.089 * y, 2.3 * y];
        let [r, g, b] = eye.shown(white(1e-4), 1e4);
        assert!(b > g && g > r, "{r} {g} {b}");
        let [r, g, b] = eye.shown(white(1e3), 1e-3);
        assert!((r - g).abs() < 0.002 && (g - b).abs() < 0.002, "{r} {g} {b}");
    }

    #[test]
    fn an_eye_adapts_to_what_it_sees() {
        let eye = Eye { rods: false, ..Eye::default() };
        let frame = Image::filled(8, 4, [10.0, 10.0, 10.0, 20.0]);
        assert!((eye.adapted_to(&frame) - 10.0).abs() < 1e-6);
        // What is adapted to is shown as what the screen's viewer adapts to: somewhat over half
        // of white by the ratio of thresholds, 0.357 after compression, 161 encoded.
        let [_, g, _] = Eye { rods: false, ..Eye::default() }
            .see(&Image::filled(4, 4, [950.5, 1000.0, 1089.0, 2300.0]), Angle::from_deg(0.05))
            .picture
            .at(0, 0);
        assert!((160..=162).contains(&g), "{g}");
    }

    #[test]
    fn dithering_keeps_the_mean() {
        for level in [0.0, 10.2, 100.5, 254.9, 255.0] {
            let pixels = (0..256).flat_map(|y| (0..256).map(move |x| (x, y)));
            let sum: f64 =
                pixels.map(|(x, y)| f64::from(encoded([level / 255.0; 3], dither(x, y))[0])).sum();
            assert!((sum / 65536.0 - level).abs() < 0.01, "{level}: {}", sum / 65536.0);
        }
    }
}

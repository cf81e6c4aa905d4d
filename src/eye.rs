//! A first eye: from absolute light to what a screen shows of it.
//!
//! The eye adapts to a mean of what it sees. What it can just tell apart there is
//! shown as what the viewer of the screen can just tell apart (visibility matching, Ward Larson,
//! Rushmeier & Piatko 1997, *IEEE TVCG* 3, 291). By night the rods take over and see all light
//! as a bluish grey (Jensen et al. 2000, *Night Rendering*, UUCS-00-016).
//!
//! How we differ: one scale for rods and cones, set by the better of the two, so that a brighter
//! point is never shown darker; highlights are compressed by Reinhard et al. 2002, Eq. 3. Glare
//! keeps the colour of what it comes from: rods and cones see each point before its light is
//! scattered, not after. The other order would put a rod-blue ring around every orange star; one
//! looks at a star with the fovea, whose middle degree has no rods. Acuity and the time that
//! adaptation takes are not here yet.

pub mod acuity;
pub mod adaptation;
pub mod extended_threshold;
pub mod glare;
pub mod histogram_adjustment;
pub mod limiting_magnitude;
pub mod mesopic;
pub mod paper;
pub mod pupil;
pub mod receptors;
pub mod rod_intrusion;
pub mod rods;
pub mod threshold;
pub mod tone_curve;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::image::{HdrFrame, Image};
use crate::units::{Angle, Xyzv};

use self::glare::scattered;
use self::threshold::combined_cd_m2 as threshold_cd_m2;

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
/// or on a nearby screen: its pixels appear this far apart, one minute of arc. Otherwise a
/// close-up of the Moon would be no sharper than the naked eye sees her.
const FINEST_PIXEL: Angle = Angle::from_arcmin(1.0);

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

impl Eye {
    /// What an eye that sees this adapts to, cd/m2. Glare is not part of it.
    fn adapted_to(&self, seen: &HdrFrame) -> f64 {
        if let Some(given) = self.adaptation_cd_m2 {
            return given;
        }
        // Summed piece by piece and in order, so that the same frame gives the same bits.
        let pieces: Vec<(f64, u64)> = seen
            .pixels()
            .par_chunks(ADAPTATION_PIECE)
            .map(|pixels| {
                let lit = pixels.iter().map(|&[_, y, ..]| f64::from(y)).filter(|&y| y > 0.0);
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
        let mut seen = self.seen_frame(frame);
        if self.glare {
            seen = scattered(&seen, pixel_angle.max(FINEST_PIXEL));
        }
        // The retina adapts to what reaches it, the veil of the glare included.
        let adaptation_cd_m2 = self.adapted_to(&seen);
        let screen_adaptation = self.display_peak_cd_m2 / 2.0;
        let scale = threshold_cd_m2(screen_adaptation) / threshold_cd_m2(adaptation_cd_m2)
            * self.exposure_stops.exp2()
            / self.display_peak_cd_m2;
        let mut picture = Image::filled(frame.width_px(), frame.height_px(), [0; 3]);
        let width = frame.width_px() as usize;
        picture
            .pixels_mut()
            .par_chunks_mut(width)
            .zip(seen.pixels().par_chunks(width))
            .enumerate()
            .for_each(|(y, (row, lights))| {
                for (x, (shown, &light)) in row.iter_mut().zip(lights).enumerate() {
                    *shown = encoded(srgb(light, scale), dither(x as u32, y as u32));
                }
            });
        Seen { picture, adaptation_cd_m2 }
    }

    /// What rods and cones make of a frame together; X, Y and Z count.
    fn seen_frame(&self, frame: &HdrFrame) -> HdrFrame {
        let mut seen = frame.clone();
        if self.rods {
            seen.pixels_mut().par_iter_mut().for_each(|pixel| *pixel = by_rods_and_cones(*pixel));
        }
        seen
    }
}

/// The light that rods and cones make of a pixel together; X, Y and Z count.
fn by_rods_and_cones([x, y, z, v]: [f32; 4]) -> [f32; 4] {
    let light = Xyzv::new(x.into(), y.into(), z.into(), v.into());
    let cones = cone_share(light.y);
    let [rod_x, rod_y] = ROD_CHROMATICITY;
    let grey = Xyzv::new(rod_x / rod_y, 1.0, (1.0 - rod_x - rod_y) / rod_y, 0.0);
    (light * cones + grey * ((1.0 - cones) * ROD_GAIN * light.v)).to_f32()
}

/// What is seen as sRGB, 0 to 1; `scale` takes cd/m2 to shares of the screen's white.
fn srgb([x, y, z, v]: [f32; 4], scale: f64) -> [f64; 3] {
    let seen = Xyzv::new(x.into(), y.into(), z.into(), v.into()) * scale;
    if seen.y <= 0.0 {
        return [0.0; 3];
    }
    // Reinhard et al. 2002, Eq. 3, on the luminance; the colour stays.
    let luminance = seen.y / (1.0 + seen.y);
    srgb_from_linear(within_gamut(linear_srgb(seen * (luminance / seen.y)), luminance))
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
        // The light of a star of the Sun's colour, and that of the night sky.
        for scotopic_ratio in [1.4f32, 2.35] {
            let shown: Vec<f64> = ladder()
                .map(|l| {
                    let y = l as f32;
                    let light = [0.95 * y, y, 1.09 * y, scotopic_ratio * y];
                    srgb(by_rods_and_cones(light), 20.0)[1]
                })
                .collect();
            assert!(shown.windows(2).all(|pair| pair[1] >= pair[0]), "{shown:?}");
            assert!(shown[0] < 0.001 && shown[shown.len() - 1] > 0.999, "{shown:?}");
        }
    }

    #[test]
    fn night_is_bluish_and_day_is_white() {
        let white = |y: f32| [0.9505 * y, y, 1.089 * y, 2.3 * y];
        let [r, g, b] = srgb(by_rods_and_cones(white(1e-4)), 1e4);
        assert!(b > g && g > r, "{r} {g} {b}");
        let [r, g, b] = srgb(by_rods_and_cones(white(1e3)), 1e-3);
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

    /// A star over a dark sky, by its magnitude, in a picture of 0.05 degrees per pixel.
    fn star(magnitude: f64) -> HdrFrame {
        let mut frame = Image::filled(101, 101, [2e-4, 2e-4, 2e-4, 4e-4]);
        let pixel_sr = Angle::from_deg(0.05).rad().powi(2);
        let light = (2.54e-6 * 10f64.powf(-0.4 * magnitude) / pixel_sr) as f32;
        frame.pixels_mut()[50 * 101 + 50] = [light, light, light, 2.0 * light];
        frame
    }

    #[test]
    fn a_brighter_star_looks_larger() {
        let size = |magnitude, glare| {
            let eye = Eye { glare, adaptation_cd_m2: Some(2e-4), ..Eye::default() };
            let picture = eye.see(&star(magnitude), Angle::from_deg(0.05)).picture;
            let [_, sky, _] = picture.at(0, 0);
            picture.pixels().iter().filter(|[_, g, _]| *g > 2 * sky).count()
        };
        let sizes = [6.0, 4.0, 2.0, 0.0].map(|magnitude| size(magnitude, true));
        assert!(sizes.windows(2).all(|pair| pair[1] >= 2 * pair[0]), "{sizes:?}");
        assert!((1..=9).contains(&sizes[0]) && sizes[3] < 2000, "{sizes:?}");
        assert_eq!([6.0, 0.0].map(|magnitude| size(magnitude, false)), [1, 1]);
    }

    #[test]
    fn glare_keeps_the_colour_of_its_star_and_raises_the_adaptation() {
        let mut orange = star(0.0);
        orange.pixels_mut()[50 * 101 + 50][0] *= 1.3;
        orange.pixels_mut()[50 * 101 + 50][2] *= 0.3;
        let seen = Eye::default().see(&orange, Angle::from_deg(0.05));
        for off in [0, 2, 4] {
            let [r, g, b] = seen.picture.at(50 + off, 50);
            assert!(r > g && g > b, "{off}: {r} {g} {b}");
        }
        let without = Eye { glare: false, ..Eye::default() }.see(&orange, Angle::from_deg(0.05));
        assert!(seen.adaptation_cd_m2 > without.adaptation_cd_m2);
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

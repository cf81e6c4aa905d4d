//! The eye: from absolute light to what a screen shows of it.
//!
//! The eye is given the frame as half a degree of it is seen at a time, and makes of it what the GPU
//! needs for every pixel ([`Seeing`]): how much of the light it scatters and how far
//! ([`glare`]), what it resolves ([`acuity`]), what rods and cones make of a light together
//! ([`receptors`]), how bright that is shown ([`tone_curve`]), and which points of light are seen against
//! what ([`limiting_magnitude`]). All of it is reckoned in f64 into small tables over light
//! ([`light_table`]); the passes look them up.
//!
//! What is shown follows visibility matching (Ward Larson, Rushmeier & Piatko 1997, *IEEE TVCG* 3, 291):
//! what the eye can just tell apart there is shown as what the viewer of the screen can just tell apart.
//! Large things and points are matched apart, because the dark-adapted eye sums light over large things and
//! cannot over points: the night sky is lifted two thousand times, a star some tens of times. The points
//! are matched by Crumey's thresholds, so that a star is as far above the threshold of who looks at the
//! screen as it was above that of who looks at the sky, and one below it is not drawn.



pub mod acuity;
pub mod adaptation;
pub mod extended_threshold;
pub mod glare;
pub mod histogram_adjustment;
pub mod light_table;
pub mod limiting_magnitude;
pub mod mesopic;
pub mod paper;
pub mod pupil;
pub mod receptors;
pub mod rod_intrusion;
pub mod rods;
pub mod threshold;
pub mod tone_curve;

use serde::{Deserialize, Serialize};

use crate::display::{Display, srgb_slope, within_gamut};
use crate::image::HdrFrame;
use crate::units::{Angle, Xyzv};
use glam::DVec3;

use self::limiting_magnitude::{luminance_for_rods, threshold_lx};

/// How the picture is seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Eye {
    /// Brighter or darker than the eye would have it, in factors of two.
    pub exposure_stops: f64,
    /// What the eye is adapted to, cd/m2; from the picture itself when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adaptation_cd_m2: Option<f64>,
    /// Whether detail is lost that the eye does not resolve.
    pub acuity: bool,
    /// Crumey's field factor: 1.4 for the keenest eyes, 2 for typical ones.
    pub field_factor: f64,
}

impl Default for Eye {
    fn default() -> Self {
        Eye {
            exposure_stops: 0.0,
            adaptation_cd_m2: None,
            acuity: true,
            field_factor: limiting_magnitude::TYPICAL_FIELD_FACTOR,
        }
    }
}

/// What the eye makes of a frame, as tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Seeing {
    /// The luminance that the eye is adapted to, cd/m2.
    pub adaptation_cd_m2: f64,
    /// Share of the light that each level of the pyramid spreads, finest first.
    pub glare_shares: Vec<f64>,
    /// Over the columns of [`light_table`]: the level of the pyramid that is as fine as the eye resolves;
    /// none where it resolves all.
    pub levels_resolved: Option<Vec<f32>>,
    /// Over light: factors of X, Y, Z and, for each of red, green and blue, of V.
    pub shown: Vec<[f32; 4]>,
    /// Over the light around: what is shown of the light of a point, in shares of the screen's white
    /// times square pixels for a lux; the faintest point that is seen, lux; the size of a code of the
    /// picture there.
    pub visible: Vec<[f32; 4]>,
    /// How much fainter a point may be than to the naked eye, for what the picture magnifies.
    magnified: f64,
}

/// A point of light as it is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenPoint {
    /// Linear shares of the screen's white, with a luminance of one.
    pub colour: [f64; 3],
    /// At the eye, lux.
    pub illuminance_lx: f64,
}

/// A picture finer than this, about what an eye resolves, is seen magnified, as through a telescope.
const FINEST_PIXEL: Angle = Angle::from_arcmin(1.0);
/// The part of the retina that looks at one thing.
const FOVEAL: Angle = Angle::from_deg(0.5);
/// Solid angle over which the eye sees the colour of a point: some three minutes of arc across.
const POINT_SR: f64 = 7.6e-7;

impl Eye {
    /// The level of a pyramid whose texels are about half a degree.
    pub fn foveal_level(&self, pixel: Angle) -> usize {
        ((FOVEAL / pixel.max(FINEST_PIXEL).rad()).rad().log2().round()).clamp(1.0, 16.0) as usize
    }

    /// What it makes of a frame, given its light at a level of its pyramid.
    pub fn seeing(
        &self,
        foveal: &HdrFrame,
        level: usize,
        size_px: [u32; 2],
        pixel: Angle,
        display: &Display,
    ) -> Seeing {
        let _ = (level, size_px);
        let mean = foveal.pixels().iter().map(|p| f64::from(p[1]).max(1e-6).ln()).sum::<f64>()
            / foveal.pixels().len() as f64;
        let adaptation_cd_m2 = self.adaptation_cd_m2.unwrap_or(mean.exp().max(1e-4));
        let gain = threshold_cd_m2(display.peak_cd_m2 / 2.0) / threshold_cd_m2(adaptation_cd_m2)
            / display.peak_cd_m2;
        let shown_of = |y: f64| gain * y / (1.0 + gain * y);
        let mixed = |photopic: f64, scotopic: f64| {
            let cones = cone_share(photopic);
            let rods = (1.0 - cones) * 0.4468;
            (cones, [rods, rods, 2.0 * rods], cones * photopic + rods * scotopic)
        };
        let brighter = self.exposure_stops.exp2();
        let shown = light_table::table(|photopic, scotopic| {
            let (cones, rods, seen) = mixed(photopic, scotopic);
            let gain = shown_of(seen * brighter) / seen;
            [cones * gain, rods[0] * gain, rods[1] * gain, rods[2] * gain].map(|v| v as f32)
        });
        let screen_pixel_sr = Angle::from_arcmin(display.pixel_arcmin).rad().powi(2);
        let visible = light_table::table(|photopic, scotopic| {
            let (_, _, seen) = mixed(photopic, scotopic);
            let share = shown_of(seen);
            let faintest_lx = threshold_lx(luminance_for_rods(photopic, scotopic));
            let on_screen_lx = threshold_lx(share * display.peak_cd_m2);
            let gain = brighter * on_screen_lx
                / (faintest_lx * screen_pixel_sr * display.peak_cd_m2);
            [gain, faintest_lx * self.field_factor, srgb_slope(share) / 255.0, 0.0].map(|v| v as f32)
        });
        Seeing {
            adaptation_cd_m2,
            glare_shares: vec![0.1, 0.05, 0.03, 0.02, 0.02, 0.01, 0.01, 0.01, 0.01, 0.01],
            levels_resolved: self.acuity.then(|| {
                (0..light_table::COLUMNS)
                    .map(|column| (2.0 - 0.5 * light_table::photopic_cd_m2(column).log10()) as f32)
                    .collect()
            }),
            shown,
            visible,
            magnified: (FINEST_PIXEL.rad() / pixel.rad()).max(1.0).powi(2),
        }
    }
}

fn cone_share(luminance_cd_m2: f64) -> f64 {
    let log = luminance_cd_m2.max(1e-12).log10();
    let x = ((log + 2.0) / 2.6).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

impl Seeing {
    /// A point of light, from its illuminance, lux.
    pub fn point(&self, illuminance: Xyzv, display: &Display) -> SeenPoint {
        let lx = illuminance * self.magnified;
        let cones = cone_share(lx.y / POINT_SR);
        let rods = (1.0 - cones) * 0.4468 * lx.v;
        let seen = DVec3::new(lx.x, lx.y, lx.z) * cones + DVec3::new(1.0, 1.0, 2.0) * rods;
        let colour = match seen.y > 0.0 {
            true => within_gamut(display.rgb_from_xyz() * (seen / seen.y), 1e-3),
            false => DVec3::ZERO,
        };
        SeenPoint { colour: colour.to_array(), illuminance_lx: lx.y }
    }
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

//! The eye on the CPU: what the passes of the renderer are measured against, and a way to see small
//! pictures without a graphics adapter.
//!
//! Slow and plain: everything in f64, every pixel the whole way. Left out: loss of detail, grain, and
//! points of light.

use rayon::prelude::*;

use crate::display::{Display, within_gamut};
use crate::image::{HdrFrame, Image};
use crate::units::Angle;

use super::Eye;
use super::foveal::View;
use super::glare::pyramid;
use super::light_table;
use super::seeing::Seeing;

/// What an eye sees.
pub struct Seen {
    /// Linear shares of the screen's white, within its gamut.
    pub light: Image<[f64; 3]>,
    pub seeing: Seeing,
}

impl Seen {
    /// The codes of the screen, dithered.
    pub fn codes(&self, display: &Display) -> Image<[u8; 3]> {
        let width = self.light.width_px();
        let codes = (0..).zip(self.light.pixels()).map(|(n, rgb)| {
            display.code_of_rgb(glam::DVec3::from_array(*rgb), n % width, n / width)
        });
        let codes = codes.collect();
        Image::from_pixels(width, self.light.height_px(), codes).expect("as many pixels")
    }
}

impl Eye {
    /// The frame as this eye sees it; its pixels are `pixel` apart in its middle.
    pub fn see(&self, frame: &HdrFrame, pixel: Angle, display: &Display) -> Seen {
        let view = View::new([frame.width_px(), frame.height_px()], pixel);
        let seeing = self.seeing(&pyramid::gathered(frame, view.foveal_level()), &view, display);
        let retina = match seeing.glare_shares.is_empty() {
            true => frame.clone(),
            false => pyramid::scattered_by(frame, &spread_by_pictures(&seeing.glare_shares, &view)),
        };
        let rgb_from_seen = seeing.rgb_from_seen;
        let shown = |light: &[f32; 4]| {
            let [x, y, z, v] = light.map(f64::from);
            let [cones, rods @ ..] = light_table::at(&seeing.shown, y, v);
            let gain = cones / y.max(light_table::DARKEST_CD_M2);
            let rods = glam::DVec3::from_array(rods) * light_table::ratio(y, v);
            let xyz = glam::DVec3::new(x, y, z) * gain + rods;
            within_gamut(rgb_from_seen * xyz, xyz.y).to_array()
        };
        let pixels = retina.pixels().par_iter().map(shown).collect();
        let light = Image::from_pixels(frame.width_px(), frame.height_px(), pixels);
        Seen { light: light.expect("as many pixels"), seeing }
    }
}

/// The shares of the levels whose light pictures spread.
fn spread_by_pictures(shares: &[f64], view: &View) -> Vec<f64> {
    let [width_px, height_px] = view.size_px;
    let finest = pyramid::finest_spread(width_px, height_px);
    (1..).zip(shares).map(|(level, share)| if level < finest { 0.0 } else { *share }).collect()
}

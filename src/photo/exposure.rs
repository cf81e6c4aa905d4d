//! What the settings of a camera come to for one picture: metering, gain, noise, development.
//!
//! *Metering.* A mean of the scene that leaves out the brightest [`LEFT_OUT`] of it: the disc of the Sun or of a small
//! Moon does not darken the rest. It is no less than what brings the brightest of what is left to
//! saturation, so that a large Moon on a black sky is not burnt out. *Program.* Up to 1/30 s at the base ISO;
//! in less light the shutter stays open longer and the ISO rises with it, both reaching their ends,
//! 20 s and 6400, together. Beyond, pictures are dark.
//!
//! *Noise.* Electrons are counted: their variance is their mean. To it comes that of reading. Both together are drawn
//! from one distribution that is nearly normal, the sum of four even ones (Irwin & Hall): mean 0, variance
//! 1, excess kurtosis -0.3, nothing beyond 3.46. A mean below some ten electrons has a skew that is left
//! out. The random numbers are a hash of the pixel and the seed, PCG3D of Jarzynski & Olano 2020 (*JCGT* 9 (3),
//! 21), in whole numbers: the same on every machine. The black level is subtracted and nothing cut
//! there, so that the mean of what is recorded is right in the dark; the sensor's saturation cuts.
//!
//! `shaders/photo.wgsl` does the same in 32 bits.

use std::f64::consts::PI;
use std::fmt;

use glam::{DMat3, DVec3};

use crate::camera::Camera;
use crate::display::{Display, within_gamut};
use crate::image::{HdrFrame, Image};
use crate::units::Xyzv;

use super::colour::{balance, camera_from_xyz, xyz_from_balanced};
use super::lens::Falloff;
use super::sensor::{PicturePixel, metered_lx_s, saturation_lx_s};
use super::{Curve, Photo};

/// The share of a scene, its brightest, that the meter does not see.
pub const LEFT_OUT: f64 = 0.02;
/// The longest time that a meter chooses, seconds.
pub const LONGEST_S: f64 = 20.0;
/// The shortest.
pub const SHORTEST_S: f64 = 1.0 / 8000.0;
/// The highest ISO that a meter chooses.
pub const HIGHEST_ISO: f64 = 6400.0;
/// A hand holds a camera still for as long, seconds: before, the ISO stays.
const HAND_S: f64 = 1.0 / 30.0;

/// What a meter reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metered {
    /// The luminance that is to be shown as a grey card, cd/m2.
    pub luminance_cd_m2: f64,
    /// The mean light, for white balance.
    pub mean: Xyzv,
}

/// What a meter reads of sparse samples of a scene, cd/m2, each of the same part of it.
pub fn metered(samples: &[Xyzv]) -> Metered {
    let mut lit: Vec<Xyzv> =
        samples.iter().copied().filter(|light| light.y.is_finite() && light.y >= 0.0).collect();
    lit.sort_by(|a, b| a.y.total_cmp(&b.y));
    let seen = lit.len() - (LEFT_OUT * lit.len() as f64) as usize;
    let seen = &lit[..seen];
    let Some(brightest) = seen.last() else {
        return Metered { luminance_cd_m2: 0.0, mean: Xyzv::BLACK };
    };
    let mean = seen.iter().copied().sum::<Xyzv>() * (seen.len() as f64).recip();
    let unburnt = brightest.y * metered_lx_s(1.0) / saturation_lx_s(1.0);
    Metered { luminance_cd_m2: mean.y.max(unburnt), mean }
}

/// The settings of one picture, and what they do to its light: plain numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exposure {
    pub shutter_s: f64,
    pub iso: f64,
    pub f_number: f64,
    pub focal_mm: f64,
    /// The sensor's width, millimetres.
    pub sensor_width_mm: f64,
    /// Channels as shares of saturation of X, Y and Z, cd/m2, on the axis.
    pub raw_from_xyz: DMat3,
    /// What the channels are multiplied with for white balance.
    pub balance: DVec3,
    /// X, Y and Z as shares of the screen's white, of balanced channels.
    pub xyz_from_balanced: DMat3,
    /// Variance of a share for each share: that of counting.
    pub shot: f64,
    /// Variance of a share in the dark: that of reading.
    pub read: f64,
    /// Whether there is any noise.
    pub noise: bool,
    pub seed: u32,
    pub curve: Curve,
    pub falloff: Falloff,
    /// Size of the picture and its focal length, pixels.
    pub size_px: [f64; 2],
    pub focal_px: f64,
}

impl Photo {
    /// Shutter and ISO for a luminance that is to become a grey card.
    fn program(&self, luminance_cd_m2: f64) -> (f64, f64) {
        let base = self.body.sensor().base_iso;
        let top = base.max(HIGHEST_ISO);
        let lens = &self.lens;
        let lux = super::sensor::illuminance_lx(luminance_cd_m2, lens.transmission, lens.f_number);
        // Seconds times ISO, which is all that the meter asks for.
        let product = match lux * self.compensation_stops.exp2().recip() {
            lux if lux > 0.0 => metered_lx_s(1.0) / lux,
            _ => f64::INFINITY,
        };
        match (self.shutter_s, self.iso) {
            (Some(shutter_s), Some(iso)) => (shutter_s, iso),
            (Some(shutter_s), None) => (shutter_s, (product / shutter_s).clamp(base, top)),
            (None, Some(iso)) => ((product / iso).clamp(SHORTEST_S, LONGEST_S), iso),
            (None, None) => {
                let beyond = (product / (HAND_S * base)).log2();
                if beyond <= 0.0 {
                    return ((product / base).clamp(SHORTEST_S, HAND_S), base);
                }
                let (longer, higher) = ((LONGEST_S / HAND_S).log2(), (top / base).log2());
                let way = (beyond / (longer + higher)).min(1.0);
                (HAND_S * (way * longer).exp2(), base * (way * higher).exp2())
            }
        }
    }

    /// What these settings come to, for what the meter reads and a picture.
    pub fn exposed(&self, metered: &Metered, camera: &Camera) -> Exposure {
        let (shutter_s, iso) = self.program(metered.luminance_cd_m2);
        let sensor = self.body.sensor();
        let pixel: PicturePixel = sensor.picture_pixel(camera.width_px, iso);
        let lens = &self.lens;
        let lx_s_per_cd_m2 = PI / 4.0 * lens.transmission / lens.f_number.powi(2) * shutter_s;
        let shares = lx_s_per_cd_m2 / pixel.saturation_lx_s();
        Exposure {
            shutter_s,
            iso,
            f_number: lens.f_number,
            focal_mm: lens.focal_mm,
            sensor_width_mm: sensor.width_mm,
            raw_from_xyz: camera_from_xyz() * shares,
            balance: balance(self.white_balance.white(metered.mean)),
            xyz_from_balanced: xyz_from_balanced(),
            shot: pixel.saturation_e.recip(),
            read: (pixel.read_noise_e / pixel.saturation_e).powi(2),
            noise: self.noise,
            seed: self.seed,
            curve: self.curve,
            falloff: lens.falloff(camera.projection),
            size_px: [camera.width_px, camera.height_px].map(f64::from),
            focal_px: camera.focal_px(),
        }
    }
}

impl fmt::Display for Exposure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Camera at {:.1} mm, f/{}, ", self.focal_mm, self.f_number)?;
        match self.shutter_s {
            long if long >= 0.3 => write!(f, "{long:.1} s")?,
            short => write!(f, "1/{:.0} s", short.recip())?,
        }
        write!(f, ", ISO {:.0}", self.iso)
    }
}

impl Exposure {
    /// The share of the light that the lens leaves at a point of the picture.
    pub fn falloff_at(&self, [x, y]: [f64; 2]) -> f64 {
        let [width, height] = self.size_px;
        let off = (x - width / 2.0).powi(2) + (y - height / 2.0).powi(2);
        let corner = (width * width + height * height) / 4.0;
        self.falloff.at(off / (self.focal_px * self.focal_px), off / corner)
    }

    /// What the sensor records of the light of a pixel, without noise: shares of saturation.
    pub fn mean_raw(&self, light: Xyzv, x: u32, y: u32) -> DVec3 {
        let falloff = self.falloff_at([f64::from(x) + 0.5, f64::from(y) + 0.5]);
        (self.raw_from_xyz * DVec3::new(light.x, light.y, light.z) * falloff).max(DVec3::ZERO)
    }

    /// What the sensor records of the light of a pixel: shares of saturation, the black level
    /// subtracted.
    pub fn raw(&self, light: Xyzv, x: u32, y: u32) -> DVec3 {
        let mean = self.mean_raw(light, x, y);
        if !self.noise {
            return mean.min(DVec3::ONE);
        }
        let deviation = (mean * self.shot + self.read).map(f64::sqrt);
        (mean + deviation * DVec3::from_array(noise(x, y, self.seed))).min(DVec3::ONE)
    }

    /// Linear RGB of the screen, within its gamut, of what was recorded.
    pub fn developed(&self, raw: DVec3, display: &Display) -> DVec3 {
        let balanced = (raw * self.balance).min(DVec3::ONE);
        let xyz = self.xyz_from_balanced * balanced;
        within_gamut(display.rgb_from_xyz() * xyz, xyz.y).map(|c| self.curve.shown(c))
    }

    /// The picture of a frame in 8 bits: the twin of `shaders/photo.wgsl`, for those without a GPU.
    pub fn picture(&self, frame: &HdrFrame, display: &Display) -> Image<[u8; 3]> {
        let mut picture = Image::filled(frame.width_px(), frame.height_px(), [0; 3]);
        let width = frame.width_px() as usize;
        for (index, code) in picture.pixels_mut().iter_mut().enumerate() {
            let (x, y) = ((index % width) as u32, (index / width) as u32);
            let rgb = self.developed(self.raw(frame.xyzv(x, y), x, y), display);
            *code = display.code_of_rgb(rgb, x, y);
        }
        picture
    }
}

/// Noise of the three channels of a pixel: mean 0, variance 1.
pub fn noise(x: u32, y: u32, seed: u32) -> [f64; 3] {
    // The standard deviation of four even numbers from 0 to 255.
    let deviation = (4.0 * (256.0f64 * 256.0 - 1.0) / 12.0).sqrt();
    pcg3d([x, y, seed]).map(|hash| {
        let pairs = (hash & 0x00ff_00ff) + ((hash >> 8) & 0x00ff_00ff);
        let sum = (pairs & 0xffff) + (pairs >> 16);
        (f64::from(sum) - 510.0) / deviation
    })
}

/// PCG3D: three numbers of three.
fn pcg3d(of: [u32; 3]) -> [u32; 3] {
    let [mut x, mut y, mut z] = of.map(|v| v.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let mix = |x: &mut u32, y: &mut u32, z: &mut u32| {
        *x = x.wrapping_add(y.wrapping_mul(*z));
        *y = y.wrapping_add(z.wrapping_mul(*x));
        *z = z.wrapping_add(x.wrapping_mul(*y));
    };
    mix(&mut x, &mut y, &mut z);
    [x, y, z] = [x, y, z].map(|v| v ^ (v >> 16));
    mix(&mut x, &mut y, &mut z);
    [x, y, z]
}

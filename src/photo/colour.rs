//! Colours of a camera: its three channels, its white, and the way back to X, Y and Z.
//!
//! The channels are those of the Canon EOS 5D Mark II, as the matrix that Adobe publishes for it in the
//! DNG Converter (and dcraw carries in `adobe_coeff`): camera from X, Y, Z, for D65. A matrix is not a
//! spectral response: narrow lines (sodium lamps, airglow) come out as the matrix has them.
//!
//! White balance scales each channel so that a white light is recorded alike in all three, the least by one:
//! so that what saturates any channel ends as white. Back from there, the light that was balanced becomes D65
//! (von Kries, in the channels of the camera).

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::light::spectrum::Spectrum;
use crate::units::Xyzv;

/// The lowest temperature that a white may have, kelvin.
pub const COLDEST_K: f64 = 1500.0;
/// The highest.
pub const HOTTEST_K: f64 = 40_000.0;
/// What cameras find by themselves, kelvin: typical.
const AUTO_K: [f64; 2] = [2500.0, 10_000.0];

/// Which light is recorded as white.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WhiteBalance {
    /// D65: colours stay as they are.
    #[default]
    Daylight,
    /// CIE illuminant A, 2856 K.
    Tungsten,
    /// The temperature whose white has the red and the blue of the mean of the picture.
    Auto,
    /// A black body, or daylight from 4000 K on.
    Kelvin(f64),
}

/// Camera from X, Y, Z; rows red, green, blue.
const CAMERA_FROM_XYZ: [[f64; 3]; 3] =
    [[0.4716, 0.0603, -0.0830], [-0.7798, 1.5474, 0.2480], [-0.1496, 0.1937, 0.6651]];

/// X, Y and Z of D65 with Y of one, from x and y of 0.3127 and 0.3290.
const D65: DVec3 = DVec3::new(0.3127 / 0.3290, 1.0, 0.3583 / 0.3290);

/// What the channels record of a light, one in green for a white of luminance one.
pub fn camera_from_xyz() -> DMat3 {
    let matrix = DMat3::from_cols_array_2d(&CAMERA_FROM_XYZ).transpose();
    matrix * (1.0 / (matrix * D65).y)
}

/// X, Y and Z of a white by its temperature, Y of one.
///
/// A black body below 4000 K, the daylight of CIE 15 (Judd, MacAdam & Wyszecki 1964) from 5000 K on, mixed between.
pub fn white(kelvin: f64) -> DVec3 {
    let body = || {
        // Wien's constant, nanometre kelvin; the factor in front does not matter.
        let planck =
            |nm: f64| (560.0 / nm).powi(5) / ((1.438_776_877e7 / (nm * kelvin)).exp() - 1.0);
        let Xyzv { x, y, z, .. } = Spectrum::from_fn(planck).xyzv();
        DVec3::new(x / y, 1.0, z / y)
    };
    let mix = (kelvin / 1000.0 - 4.0).clamp(0.0, 1.0);
    match mix {
        0.0 => body(),
        1.0 => daylight(kelvin),
        mix => body() * (1.0 - mix) + daylight(kelvin) * mix,
    }
}

/// Daylight by its temperature: CIE 15, from 4000 K on.
fn daylight(kelvin: f64) -> DVec3 {
    let k = 1000.0 / kelvin;
    let x = match kelvin {
        low if low <= 7000.0 => 0.244_063 + k * (0.099_11 + k * (2.967_8 - k * 4.607_0)),
        _ => 0.237_040 + k * (0.247_48 + k * (1.901_8 - k * 2.006_4)),
    };
    let y = -3.0 * x * x + 2.87 * x - 0.275;
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

impl WhiteBalance {
    /// X, Y and Z of what is recorded as white, of the mean light of the picture.
    pub fn white(self, mean: Xyzv) -> DVec3 {
        match self {
            WhiteBalance::Daylight => D65,
            WhiteBalance::Tungsten => white(2856.0),
            WhiteBalance::Kelvin(kelvin) => white(kelvin),
            WhiteBalance::Auto => white(temperature_k(mean)),
        }
    }
}

/// The temperature of the white with the red and blue of a light, within what cameras find; that of daylight
/// for no light.
fn temperature_k(light: Xyzv) -> f64 {
    let matrix = camera_from_xyz();
    let red_over_blue = |xyz: DVec3| {
        let camera = matrix * xyz;
        camera.x.max(1e-9) / camera.z.max(1e-9)
    };
    if !(light.y > 0.0 && light.y.is_finite()) {
        return 6504.0;
    }
    let wanted = red_over_blue(DVec3::new(light.x, light.y, light.z) / light.y);
    let [mut low, mut high] = AUTO_K;
    for _ in 0..30 {
        // Hotter whites have less red.
        let middle = (low * high).sqrt();
        match red_over_blue(white(middle)) > wanted {
            true => low = middle,
            false => high = middle,
        }
    }
    (low * high).sqrt()
}

/// What each channel is multiplied with, the least with one, to record a white alike.
pub fn balance(white: DVec3) -> DVec3 {
    let camera = (camera_from_xyz() * white).max(DVec3::splat(1e-6));
    camera.max_element() / camera
}

/// X, Y and Z of balanced channels: (1, 1, 1) is D65 of luminance one.
pub fn xyz_from_balanced() -> DMat3 {
    let matrix = camera_from_xyz();
    matrix.inverse() * DMat3::from_diagonal(matrix * D65)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whites_are_those_of_the_tables() {
        // CIE 15: illuminants A, D50, D65 and D75.
        for (kelvin, x, y) in [
            (2855.5, 0.447_58, 0.407_45),
            (5002.8, 0.345_67, 0.358_50),
            (6503.6, 0.312_72, 0.329_03),
            (7504.2, 0.299_02, 0.314_85),
        ] {
            let white = white(kelvin);
            let sum = white.element_sum();
            let off = (white.x / sum - x).abs().max((white.y / sum - y).abs());
            assert!(off < 3e-4, "{kelvin}: {} {}", white.x / sum, white.y / sum);
        }
    }

    #[test]
    fn a_balanced_white_is_white() {
        for kelvin in [2000.0, 2856.0, 4500.0, 6504.0, 12_000.0] {
            let white = white(kelvin);
            let gains = balance(white);
            assert!((gains.min_element() - 1.0).abs() < 1e-12);
            let balanced = camera_from_xyz() * white * gains;
            let xyz = xyz_from_balanced() * (balanced / balanced.y);
            assert!((xyz - D65).abs().max_element() < 1e-9, "{kelvin}: {xyz}");
        }
        // By daylight colours stay.
        let light = DVec3::new(0.3, 0.4, 0.7);
        let back = xyz_from_balanced() * (camera_from_xyz() * light * balance(D65));
        assert!((back - light).abs().max_element() < 1e-9, "{back}");
    }

    #[test]
    fn the_temperature_of_a_white_is_found() {
        for kelvin in [2856.0, 5000.0, 6504.0, 9000.0] {
            let DVec3 { x, y, z } = white(kelvin) * 0.01;
            let found = temperature_k(Xyzv::new(x, y, z, 0.0));
            assert!((found / kelvin - 1.0).abs() < 0.01, "{kelvin}: {found}");
        }
        assert_eq!(temperature_k(Xyzv::BLACK), 6504.0);
        assert!((temperature_k(Xyzv::new(3.0, 1.0, 0.01, 0.0)) - 2500.0).abs() < 1.0);
    }
}

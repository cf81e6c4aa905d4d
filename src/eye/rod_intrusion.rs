//! The colour of the night by physiology: what the signals of rods do in the pathways of the cones.
//!
//! *Theory.* Rods have no pathway of their own; their signals join those of the cones, and so are seen
//! as light of some colour. Cao, Pokorny, Smith & Zele 2008 (*Vision Research* 48, 2586) measured which
//! colour, by matching rod signals with cone lights; Kirk & O'Brien 2011 (*ACM TOG* 30(4), 42) made an
//! operator of it. With cone signals `L, M, S`, rod signal `R` and gains of the cones' pathways
//!
//! `g = 1 / sqrt(1 + 0.33 (q + k R) / q_max)` for `q` of `L, M, S`,
//!
//! the rods add to the channels red-green `M - L`, blue-yellow `S - L - M` and luminance `L + M`
//!
//! - `(K/S) (-(k3 + rw) k_L g_L/L_max + (1 + k3 rw) k_M g_M/M_max) R`,
//! - `(K/S) (p k3 k_L g_L/L_max + (1 - p) k3 k_M g_M/M_max + k_S g_S/S_max) R`,
//! - `K (p k_L g_L/L_max + (1 - p) k_M g_M/M_max) R`,
//!
//! with `k = (0.2, 0.2, 0.29)`, K = 45, S = 10, k3 = 0.6, rw = 0.139, p = 0.6189. This form and its
//! constants were looked up in three public programs after J. Patry (SIGGRAPH 2021, *Advances in
//! Real-Time Rendering*), not in the papers.
//!
//! *Our numbers.* Cone fundamentals are those of Smith & Pokorny 1975, as a matrix on XYZ (the rows sum
//! to luminance: `L + M = Y`; looked up in public code). They are meant for the observer of Judd and Vos;
//! with that of CIE 1931 they are too low below 460 nm. `L_max` and `M_max` come out as 0.6367 and 0.3925
//! (published: 0.6372 and 0.3924); `S_max` is 1.783 with `S = Z`, so that white of equal energy has
//! `S = L + M` (published: 1.6064, on a scale that we could not find out). R is in trolands of rods:
//! those of white of equal energy count as much as its photopic ones. Trolands come from the unified
//! pupil of someone of [`AGE_YEARS`] who has adapted to the light.
//!
//! *How we differ.* (1) The published programs have rows of cone responses that are not on the scale of
//! `L_max` and `M_max`, so that their channels are not zero for white and their rods add a colour that no
//! light has, deep blue, by day too. On one scale for all, `S - L - M` is zero for white, and the first
//! channel moves M against L from where white has them, 1 to 2. (2) The luminance channel of the formula
//! lets rods be a half of what is seen at 100 cd/m2: rods do not saturate in it. It is used for the
//! colour alone, per unit of luminance; how much rods add is the mesopic luminance of CIE 191.
//! (3) Gains are those of a white light, so that the mixture is linear in X, Y, Z and V.
//!
//! *What comes out* is blue-green: x, y of (0.265, 0.350) in the dark, (0.264, 0.348) at 1 cd/m2. It is
//! less blue and more green than the convention of [`super::rods`], and goes the way that was
//! measured: rods weigh more with M than with L, "leading to a more greenish percept" at 2 to 20 td
//! (Cao, Pokorny & Smith, *Journal of Vision*, abstract 2131691). The public formula says how far; on
//! our scale that is far from white, and may be too far.

use std::sync::LazyLock;

use crate::light::spectrum::{self, Spectrum};

use super::mesopic;
use super::pupil;

/// L, M and S of X, Y and Z, in units of luminance: Smith & Pokorny 1975; S is Z.
pub const LMS_FROM_XYZ: [[f64; 3]; 3] =
    [[0.155_14, 0.543_12, -0.032_86], [-0.155_14, 0.456_88, 0.032_86], [0.0, 0.0, 1.0]];
/// Age of the eye whose pupil is taken, years.
pub const AGE_YEARS: f64 = 30.0;

/// How strongly rods enter the pathways of L, M and S cones.
const ROD_INPUT: [f64; 3] = [0.2, 0.2, 0.29];
/// How fast the gain of a pathway falls with the light, per troland.
const GAIN_PER_TROLAND: f64 = 0.33;
/// K / S: luminance channel against colour channels.
const LUMINANCE_GAIN: f64 = 10.0;
/// k3: the strength of the surround in opponent signals.
const SURROUND: f64 = 0.6;
/// rw: the response to white.
const WHITE_RESPONSE: f64 = 0.139;
/// p: the part of L cones.
const L_PART: f64 = 0.6189;

/// What our spectra say of the receptors.
struct Receptors {
    /// The most that L, M and S reach along the spectrum, where Y reaches 1.
    most_lms: [f64; 3],
    /// Scotopic over photopic luminance of white of equal energy.
    white_ratio: f64,
}

static RECEPTORS: LazyLock<Receptors> = LazyLock::new(|| {
    let mut most_lms = [0.0f64; 3];
    for node in 0..spectrum::LEN {
        let light = Spectrum::line(spectrum::wavelength_nm(node), 1.0).xyzv();
        let lms = lms([light.x, light.y, light.z]);
        for (most, here) in most_lms.iter_mut().zip(lms) {
            *most = most.max(here / spectrum::PHOTOPIC_LM_W);
        }
    }
    let white = Spectrum::from_fn(|_| 1.0).xyzv();
    Receptors { most_lms, white_ratio: white.v / white.y }
});

/// Signals of L, M and S cones, cd/m2: `L + M = Y`, and `S = Y` for white of equal energy.
pub fn lms([x, y, z]: [f64; 3]) -> [f64; 3] {
    LMS_FROM_XYZ.map(|row| row[0] * x + row[1] * y + row[2] * z)
}

/// X, Y and Z of signals of the cones: the inverse of [`lms`].
pub fn xyz([l, m, s]: [f64; 3]) -> [f64; 3] {
    let y = l + m;
    let [a, b, c] = LMS_FROM_XYZ[0];
    [(l - b * y - c * s) / a, y, s]
}

/// X, Y and Z, for Y = 1, of what rods add to a light with luminances in cd/m2.
pub fn rod_colour_xyz(photopic_cd_m2: f64, scotopic_cd_m2: f64) -> [f64; 3] {
    let Receptors { most_lms, white_ratio } = &*RECEPTORS;
    let adapted_to = mesopic::luminance_cd_m2(photopic_cd_m2, scotopic_cd_m2);
    let pupil_mm = pupil::open_sky_mm(adapted_to, AGE_YEARS);
    let rods = pupil::trolands(scotopic_cd_m2 / white_ratio, pupil_mm);
    let white = lms([1.0; 3]);
    let input: [f64; 3] = std::array::from_fn(|cone| {
        let cones = pupil::trolands(photopic_cd_m2 * white[cone], pupil_mm);
        let light = (cones + ROD_INPUT[cone] * rods) / most_lms[cone];
        ROD_INPUT[cone] / (most_lms[cone] * (1.0 + GAIN_PER_TROLAND * light).sqrt())
    });
    let [l, m, s] = input;
    let luminance = LUMINANCE_GAIN * (L_PART * l + (1.0 - L_PART) * m);
    let red_green = (1.0 + SURROUND * WHITE_RESPONSE) * m - (SURROUND + WHITE_RESPONSE) * l;
    let blue_yellow = SURROUND * (L_PART * l + (1.0 - L_PART) * m) + s;
    // M - L grows by twice what M gains from L.
    let shift = 0.5 * red_green / luminance;
    xyz([white[0] - shift, white[1] + shift, 1.0 + blue_yellow / luminance])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::spectrum::chromaticity_xy;
    use crate::units::Xyzv;

    #[test]
    fn the_receptors_are_those_of_the_paper() {
        let Receptors { most_lms, white_ratio } = &*RECEPTORS;
        for (got, want) in most_lms.iter().zip([0.637_21, 0.392_42]) {
            assert!((got / want - 1.0).abs() < 2e-3, "{most_lms:?}");
        }
        // The rows of the matrix sum to the luminance, and white has S = L + M.
        let [l, m, s] = lms([1.0; 3]);
        assert!((l + m - 1.0).abs() < 1e-12 && s == 1.0 && (l - 0.6654).abs() < 1e-12);
        assert!((2.2..2.4).contains(white_ratio), "{white_ratio}");
        for node in 0..spectrum::LEN {
            let light = Spectrum::line(spectrum::wavelength_nm(node), 1.0).xyzv();
            let lms = lms([light.x, light.y, light.z]).map(|q| q / spectrum::PHOTOPIC_LM_W);
            assert!(
                lms.iter().all(|q| *q > -2e-3),
                "{} nm: {lms:?}",
                spectrum::wavelength_nm(node)
            );
        }
    }

    #[test]
    fn the_two_matrices_are_inverse() {
        let light = [0.3, 1.7, 2.9];
        for (got, want) in xyz(lms(light)).iter().zip(light) {
            assert!((got - want).abs() < 1e-12);
        }
    }

    #[test]
    fn rods_look_blue_green_at_any_light() {
        for step in -160..=200 {
            let y = 10f64.powf(f64::from(step) / 20.0);
            for ratio in [0.0, 0.3, 1.0, 2.3, 6.0] {
                let [x, one, z] = rod_colour_xyz(y, ratio * y);
                assert!((one - 1.0).abs() < 1e-12 && x.is_finite() && z.is_finite(), "{y} {ratio}");
                assert!(
                    (0.6..0.9).contains(&x) && (1.05..1.3).contains(&z),
                    "{y} {ratio}: {x} {z}"
                );
            }
        }
        let [x, y, z] = rod_colour_xyz(0.0, 0.0);
        let (x, y) = chromaticity_xy(Xyzv::new(x, y, z, 0.0)).unwrap();
        assert!((x - 0.2646).abs() < 1e-3 && (y - 0.3499).abs() < 1e-3, "{x} {y}");
    }
}

//! How fine a detail the eye resolves, and how far a picture is to be blurred for it.
//!
//! *Source.* Ward Larson, Rushmeier & Piatko 1997 (*IEEE TVCG* 3, 291), section 4.4, a fit to the
//! gratings of Shlaer 1937 (*J. Gen. Physiol.* 21, 165):
//!
//! `R(L) = 17.25 arctan(1.4 log10 L + 0.35) + 25.72` in cycles per degree, `L` in cd/m2.
//!
//! It runs from 51 by day over 46 at 25 cd/m2 and 9 at 0.05 to 2 at 1e-4 cd/m2, where the data end.
//! Below, it is a continuation; we follow it down to 1e-7 cd/m2, where it gives 0.44, and keep it there.
//! A picture is never blurred for less than 2 cycles per degree ([`FEWEST_CYCLES_DEG`]): an eye in the
//! dark has a light of its own, and is never adapted to less than some 1e-4 cd/m2.
//!
//! *The blur.* What is finer than R is to go, what is coarser to stay: a Gaussian blur that leaves a
//! half of the contrast at R leaves 84 % at half of R and 6 % at twice R.
//!
//! *The pyramid.* Level 0 is the picture. Level 1 holds means of 2 by 2 pixels; each next level halves
//! the one before through the taps 1 3 3 1. A level is looked up bilinearly. In each axis its blur has
//! the variance, in pixels of the picture,
//!
//! `4^l / 4 - 3/4` of the way down, and `4^l / 6 + 1/12` of the looking up (the mean over the pixels),
//!
//! together 0, 1, 6, 26, 106 at levels 0 to 4. (Brought up bilinearly step by step, a level has
//! `4^l / 2 - 1`: its sigma is the same at level 1, 8 % greater at level 2, and 10 % at the end.)
//! Between two levels one mixes them in proportion; the variance then goes in proportion too, and so
//! does [`blur_level`].
//!
//! *Omitted.* The eye's finer vision in the middle of its field, contrast sensitivity at frequencies
//! below the limit, and orientation.

use std::f64::consts::{LN_2, PI};

use crate::units::Angle;

/// The range of luminance in which the formula is used, log10 of cd/m2.
const RANGE_LOG: [f64; 2] = [-7.0, 7.0];
/// No eye is taken to resolve less than this, cycles per degree: about what Shlaer's darkest gratings
/// had.
pub const FEWEST_CYCLES_DEG: f64 = 2.0;

/// The finest grating that an eye adapted to a luminance in cd/m2 resolves, cycles per degree.
pub fn resolved_cycles_deg(luminance_cd_m2: f64) -> f64 {
    let log = luminance_cd_m2.max(f64::MIN_POSITIVE).log10().clamp(RANGE_LOG[0], RANGE_LOG[1]);
    17.25 * (1.4 * log + 0.35).atan() + 25.72
}

/// Standard deviation of the Gaussian blur that just removes what an eye adapted to a luminance in
/// cd/m2 does not resolve.
pub fn blur(luminance_cd_m2: f64) -> Angle {
    let cycles_deg = resolved_cycles_deg(luminance_cd_m2).max(FEWEST_CYCLES_DEG);
    // A Gaussian passes exp(-2 (pi sigma f)^2) of the contrast at a frequency f.
    Angle::from_deg((0.5 * LN_2).sqrt() / (PI * cycles_deg))
}

/// Variance of the blur of a level of the pyramid along one axis, pixels squared; between levels that
/// of their mixture.
pub fn level_variance_px2(level: f64) -> f64 {
    let low = level.max(0.0).floor();
    let [fine, coarse] = [whole_variance_px2(low), whole_variance_px2(low + 1.0)];
    fine + (coarse - fine) * (level.max(0.0) - low)
}

/// The level of the pyramid, 0 or more, that just removes what an eye adapted to a luminance in cd/m2
/// does not resolve in a picture whose pixels are so far apart. With a fraction f, levels l and l + 1
/// are mixed as 1 - f to f.
pub fn blur_level(luminance_cd_m2: f64, pixel: Angle) -> f64 {
    if pixel.rad() <= 0.0 {
        return 0.0;
    }
    let variance_px2 = (blur(luminance_cd_m2).rad() / pixel.rad()).powi(2);
    // Any level above 40 is wider than a picture could be.
    let low = (0..40).map(f64::from).find(|l| whole_variance_px2(l + 1.0) > variance_px2);
    low.map_or(40.0, |low| {
        let [fine, coarse] = [whole_variance_px2(low), whole_variance_px2(low + 1.0)];
        low + (variance_px2 - fine) / (coarse - fine)
    })
}

/// The sum of the two parts told above.
fn whole_variance_px2(level: f64) -> f64 {
    if level < 1.0 {
        return 0.0;
    }
    let width_px2 = 4f64.powf(level);
    (width_px2 / 4.0 - 0.75) + (width_px2 / 6.0 + 1.0 / 12.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_the_published_values() {
        for (luminance, want) in [
            (1e-4, 1.870_6),
            (1e-2, 5.308_5),
            (0.05, 8.920_4),
            (1.0, 31.527_6),
            (25.0, 45.761_0),
            (1e3, 49.084_4),
            (1e6, 50.853_3),
        ] {
            let got = resolved_cycles_deg(luminance);
            assert!((got / want - 1.0).abs() < 1e-3, "{luminance}: {got}, not {want}");
        }
    }

    #[test]
    fn more_light_shows_finer_detail() {
        let rungs = (-700..=700).map(|step| 10f64.powf(f64::from(step) / 100.0));
        let resolved: Vec<f64> = rungs.map(resolved_cycles_deg).collect();
        assert!(resolved.windows(2).all(|pair| pair[1] > pair[0]));
        assert!(resolved[0] > 0.4 && resolved[1400] < 52.0, "{} {}", resolved[0], resolved[1400]);
        assert_eq!(resolved_cycles_deg(0.0), resolved[0]);
    }

    /// One line of a level, from a finer one, with taps around the middle between two pixels.
    fn halved(fine: &[f64], taps: &[f64]) -> Vec<f64> {
        let first = taps.len() / 2 - 1;
        let at = |i: usize, k: usize| (2 * i + k).checked_sub(first).and_then(|j| fine.get(j));
        let sum = |i| taps.iter().enumerate().map(|(k, t)| t * at(i, k).unwrap_or(&0.0)).sum();
        (0..fine.len() / 2).map(sum).collect()
    }

    /// Variance of what a point in a line becomes at a level, mean over where the point is.
    fn measured_px2(level: u32) -> f64 {
        const LEN: usize = 1024;
        let step = 1usize << level;
        let mut sum = 0.0;
        for start in 0..step {
            let mut line = vec![0.0; LEN];
            let place = LEN / 2 + start;
            line[place] = 1.0;
            for l in 0..level {
                line =
                    halved(&line, if l == 0 { &[0.5, 0.5] } else { &[0.125, 0.375, 0.375, 0.125] });
            }
            for pixel in 0..LEN {
                let coarse = ((pixel as f64 + 0.5) / step as f64 - 0.5).clamp(0.0, LEN as f64);
                let (low, share) = (coarse as usize, coarse.fract());
                let next = line.get(low + 1).unwrap_or(&0.0);
                let value = line[low] * (1.0 - share) + next * share;
                sum += value * (pixel as f64 - place as f64).powi(2);
            }
        }
        sum / step as f64
    }

    #[test]
    fn levels_have_the_blur_of_the_pyramid() {
        for level in 1..=5 {
            let (got, want) = (level_variance_px2(f64::from(level)), measured_px2(level));
            assert!((got / want - 1.0).abs() < 1e-9, "{level}: {got} {want}");
        }
        assert_eq!([0.0, 1.0, 2.0, 2.5, 3.0].map(level_variance_px2), [0.0, 1.0, 6.0, 16.0, 26.0]);
    }

    #[test]
    fn the_level_has_the_blur_that_the_eye_has() {
        for luminance in [1e-6, 1e-3, 0.1, 10.0, 1e4] {
            for pixel_deg in [0.001, 0.02, 0.05, 0.5] {
                let level = blur_level(luminance, Angle::from_deg(pixel_deg));
                let sigma_px = blur(luminance).deg() / pixel_deg;
                assert!(
                    (level_variance_px2(level).sqrt() / sigma_px - 1.0).abs() < 1e-9,
                    "{level}"
                );
            }
        }
        // A half of the contrast is left at the limit: by day at 46 cycles per degree.
        let passed = (-2.0 * (PI * blur(25.0).deg() * 45.762).powi(2)).exp();
        assert!((passed - 0.5).abs() < 1e-3, "{passed}");
        // On a picture of 0.05 degrees a pixel the day is not blurred, and the night is.
        assert!(blur_level(1000.0, Angle::from_deg(0.05)) < 0.01);
        assert!((1.0..2.0).contains(&blur_level(1e-4, Angle::from_deg(0.05))));
        assert_eq!(blur_level(1.0, Angle::from_deg(0.0)), 0.0);
    }
}

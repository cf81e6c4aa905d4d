//! The least contrast at which the naked eye sees a disc or a patch of light against a sky.
//!
//! *Source.* Crumey 2014, *MNRAS* 442, 2600, after Blackwell 1946: a uniform target of the area `A` is
//! seen when its luminance exceeds the background `B` (cd/m2) by `C B`,
//!
//! `C = F ((R / A)^q + Cinf^q)^(1/q)`,
//!
//! where small targets follow Ricco's law, `C A = R`, and large ones need the contrast `Cinf`. With `A` in
//! steradians `R B` is the illuminance of the faintest point, and agrees with
//! [`super::limiting_magnitude::threshold_lx`] within 6 % from 18 to 22 magnitudes per square arcsecond.
//! The field factor `F` is that of the limiting magnitude: 1.4 to 2.4, 2 for a typical observer.
//!
//! *Range.* From 1e-5 cd/m2, below which the threshold stays, to 1e3 cd/m2, where the data end; the
//! formulas go on as they are.
//!
//! *Omitted.* Shape, soft edges (a nebula counts as a disc of its mean luminance), and colour.

/// Below this the formulas are not followed, cd/m2.
const DARKEST_CD_M2: f64 = 1e-5;
/// Rods see small targets below this, cones above, cd/m2.
const SMALL_BY_RODS_CD_M2: f64 = 0.0708;
/// Rods see large targets below this, cones above, cd/m2.
const LARGE_BY_RODS_CD_M2: f64 = 0.354;

/// The least contrast (difference of luminance over that of the background) at which a target of an area
/// in steradians is seen against a background in cd/m2, with a field factor of 1 or more.
pub fn contrast(background_cd_m2: f64, area_sr: f64, field_factor: f64) -> f64 {
    let background_cd_m2 = background_cd_m2.max(DARKEST_CD_M2);
    let q = sharpness(background_cd_m2);
    let small = ricco_sr(background_cd_m2) / area_sr;
    let large = least_contrast(background_cd_m2);
    // Written about the greater of the two, so that neither overflows.
    let (greater, ratio) = (small.max(large), small.min(large) / small.max(large));
    field_factor * greater * (1.0 + ratio.powf(q)).powf(1.0 / q)
}

/// Contrast times area of small targets, steradians: R.
fn ricco_sr(background_cd_m2: f64) -> f64 {
    let root = background_cd_m2.powf(-0.25);
    if background_cd_m2 < SMALL_BY_RODS_CD_M2 {
        (6.505e-4 * root - 8.461e-4).powi(2)
    } else {
        (1.772e-4 * root + 7.167e-5).powi(2)
    }
}

/// The contrast that large targets need.
fn least_contrast(background_cd_m2: f64) -> f64 {
    if background_cd_m2 < LARGE_BY_RODS_CD_M2 {
        7.633e-3 * background_cd_m2.powf(-0.25) - 7.174e-3
    } else {
        2.72e-3
    }
}

/// How sharply small targets give way to large ones: q.
fn sharpness(background_cd_m2: f64) -> f64 {
    let log = background_cd_m2.log10();
    (0.8861 + 0.4 * log).max(0.6).min(1.146 - 0.0885 * log)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eye::limiting_magnitude::threshold_lx;

    const ARCMIN2_SR: f64 = 8.461_595e-8;

    #[test]
    fn it_has_the_published_values() {
        // Background, R and the least contrast, worked out from the formulas.
        for (background, ricco, least) in [
            (2e-4, 2.138_0e-5, 0.057_012),
            (1e-2, 1.466_4e-6, 0.016_964),
            (1.0, 6.193_6e-8, 0.002_72),
            (100.0, 1.630_9e-8, 0.002_72),
        ] {
            let (got_r, got_c) = (ricco_sr(background), least_contrast(background));
            assert!((got_r / ricco - 1.0).abs() < 1e-3, "{background}: {got_r}");
            assert!((got_c / least - 1.0).abs() < 1e-3, "{background}: {got_c}");
            // A target where both laws count the same needs 2^(1/q) of either.
            let joined = contrast(background, ricco / least, 2.0) / (2.0 * least);
            let want = 2f64.powf(1.0 / sharpness(background));
            assert!((joined / want - 1.0).abs() < 2e-3, "{background}: {joined} {want}");
        }
        assert_eq!([1e-4, 0.1].map(sharpness), [0.6, 0.6]);
        assert!(
            (sharpness(1.0) - 0.8861).abs() < 1e-12 && (sharpness(100.0) - 0.969).abs() < 1e-12
        );
    }

    #[test]
    fn a_small_target_is_a_point() {
        for mag_per_arcsec2 in [22.0, 21.0, 20.0, 19.0, 18.0] {
            let background = 10f64.powf((12.58 - mag_per_arcsec2) / 2.5);
            let area_sr = 1e-4 * ARCMIN2_SR;
            let point_lx = contrast(background, area_sr, 1.0) * background * area_sr;
            let ratio = point_lx / threshold_lx(background);
            assert!((ratio - 1.0).abs() < 0.06, "{mag_per_arcsec2}: {ratio}");
        }
    }

    #[test]
    fn the_pieces_meet() {
        for (curve, at, within) in [
            (ricco_sr as fn(f64) -> f64, SMALL_BY_RODS_CD_M2, 3e-3),
            (least_contrast, LARGE_BY_RODS_CD_M2, 3e-3),
        ] {
            let step = curve(at.next_up()) / curve(at.next_down()) - 1.0;
            assert!(step.abs() < within, "{at}: {step}");
        }
    }

    #[test]
    fn larger_and_brighter_fields_need_less_contrast() {
        let backgrounds = (-50..=30).map(|step| 10f64.powf(f64::from(step) / 10.0));
        for background in backgrounds {
            let needed =
                [0.1, 1.0, 10.0, 100.0, 1e4].map(|a| contrast(background, a * ARCMIN2_SR, 2.0));
            assert!(needed.windows(2).all(|pair| pair[1] < pair[0]), "{background}: {needed:?}");
            let brighter = contrast(1.26 * background, ARCMIN2_SR, 2.0);
            assert!(brighter < needed[1], "{background}: {brighter}");
        }
        assert_eq!(contrast(0.0, 1e-6, 2.0), contrast(1e-5, 1e-6, 2.0));
        assert!(contrast(1e-4, 1e-30, 1.0).is_finite());
    }
}

//! The diameter of the pupil, and the light on the retina.
//!
//! *Source.* Moon & Spencer 1944 (*JOSA* 34, 319), in the form of Watson & Yellott; Stanley & Davies
//! 1995 (*Ophthal. Physiol. Opt.* 15, 601); Watson & Yellott 2012 (*Journal of Vision* 12(10), 12), who
//! unite eight formulas: that of Stanley & Davies for the size of the field, a tenth of the light for
//! one eye alone, and a slope with age. Their constants were looked up in four public ports of the
//! paper, which agree.
//!
//! *Range.* Luminance in cd/m2, any; ages of 20 to 83 years (others are brought to the end); fields up
//! to some 30 degrees were measured, larger ones are extrapolated. People differ by 1 mm or more.
//!
//! *Omitted.* Hippus, the time that a pupil takes, and the colour of the light: the pupil of the dark
//! is set by rods, so a bluer sky makes it smaller than its luminance says.

use std::f64::consts::PI;

/// The field that an open sky fills, square degrees: 60 degrees across, the largest for which Watson &
/// Yellott 2012 draw their formula.
pub const OPEN_FIELD_DEG2: f64 = 900.0 * PI;
/// Age of the mean observer of Stanley & Davies, years (Watson & Yellott 2012).
const REFERENCE_YEARS: f64 = 28.58;
/// Ages for which the slope was measured, years.
const AGES_YEARS: [f64; 2] = [20.0, 83.0];
/// What the flux of light counts to one eye when the other is covered (Watson & Yellott 2012).
const ONE_EYE: f64 = 0.1;

/// How many eyes see the light.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Eyes {
    One,
    Both,
}

/// Diameter in mm: Moon & Spencer 1944, 4.9 - 3 tanh(0.4 log10 L), between 7.9 and 1.9 mm.
pub fn moon_spencer_mm(luminance_cd_m2: f64) -> f64 {
    if luminance_cd_m2 <= 0.0 {
        return 7.9;
    }
    4.9 - 3.0 * (0.4 * luminance_cd_m2.log10()).tanh()
}

/// Diameter in mm for a field of a size in square degrees: Stanley & Davies 1995, between 7.75 and
/// 2 mm.
pub fn stanley_davies_mm(luminance_cd_m2: f64, field_deg2: f64) -> f64 {
    let flux = (luminance_cd_m2 * field_deg2 / 846.0).max(0.0).powf(0.41);
    // Written so that an infinite flux gives 2 mm.
    2.0 + 5.75 * (2.0 / (flux + 2.0))
}

/// Diameter in mm: the unified formula of Watson & Yellott 2012, Eq. 21.
pub fn unified_mm(luminance_cd_m2: f64, field_deg2: f64, age_years: f64, eyes: Eyes) -> f64 {
    let counted = match eyes {
        Eyes::One => ONE_EYE,
        Eyes::Both => 1.0,
    };
    let young = stanley_davies_mm(luminance_cd_m2 * counted, field_deg2);
    let years = age_years.clamp(AGES_YEARS[0], AGES_YEARS[1]) - REFERENCE_YEARS;
    young + years * (0.021_323 - 0.009_562_3 * young)
}

/// Diameter in mm of the pupils of someone under an open sky: [`unified_mm`], both eyes.
pub fn open_sky_mm(luminance_cd_m2: f64, age_years: f64) -> f64 {
    unified_mm(luminance_cd_m2, OPEN_FIELD_DEG2, age_years, Eyes::Both)
}

/// Retinal illuminance in trolands of a luminance in cd/m2 through a pupil of a diameter in mm:
/// luminance times area in mm2 (photopic or scotopic, as the luminance is).
pub fn trolands(luminance_cd_m2: f64, diameter_mm: f64) -> f64 {
    luminance_cd_m2 * 0.25 * PI * diameter_mm * diameter_mm
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(got: f64, want: f64, what: &str) {
        assert!((got / want - 1.0).abs() < 1e-3, "{what}: {got}, not {want}");
    }

    #[test]
    fn moon_and_spencer() {
        for (log, want) in [
            (-4.0, 7.665_01),
            (-2.0, 6.892_11),
            (0.0, 4.9),
            (1.0, 3.760_15),
            (2.0, 2.907_89),
            (4.0, 2.134_99),
        ] {
            assert_close(moon_spencer_mm(10f64.powf(log)), want, "Moon & Spencer");
        }
        assert_eq!(moon_spencer_mm(0.0), 7.9);
    }

    #[test]
    fn stanley_and_davies() {
        // At 846 cd/m2 deg2 the flux counts 1 and a third of the way is gone.
        assert_close(stanley_davies_mm(846.0, 1.0), 7.75 - 5.75 / 3.0, "unit");
        assert_close(stanley_davies_mm(8.46, 100.0), 7.75 - 5.75 / 3.0, "unit");
        for (light, field, want) in [(1.0, 30.0, 7.101_29), (100.0, 30.0, 5.124_71)] {
            assert_close(stanley_davies_mm(light, field), want, "Stanley & Davies");
        }
        assert_eq!(stanley_davies_mm(0.0, 100.0), 7.75);
        assert_eq!(stanley_davies_mm(f64::INFINITY, 100.0), 2.0);
    }

    #[test]
    fn watson_and_yellott() {
        let young = stanley_davies_mm(1.0, 900.0);
        assert_close(unified_mm(1.0, 900.0, REFERENCE_YEARS, Eyes::Both), young, "reference age");
        assert_close(unified_mm(10.0, 900.0, REFERENCE_YEARS, Eyes::One), young, "one eye");
        // In the dark an eye of 80 years opens 2.71 mm less than one of 28.58.
        let lost = 7.75 - unified_mm(0.0, 900.0, 80.0, Eyes::Both);
        assert_close(lost, 51.42 * (0.009_562_3 * 7.75 - 0.021_323), "old eye");
        assert_eq!(open_sky_mm(1e-3, 90.0), open_sky_mm(1e-3, 83.0));
    }

    #[test]
    fn more_light_never_opens_a_pupil() {
        for age in [20.0, 30.0, 60.0, 83.0] {
            let mut before = f64::INFINITY;
            for step in -120..=200 {
                let light = 10f64.powf(f64::from(step) / 20.0);
                let here = open_sky_mm(light, age);
                assert!(here < before && (1.9..8.3).contains(&here), "{light}: {here} mm");
                before = here;
            }
        }
        assert!((trolands(100.0, 2.0) - 100.0 * PI).abs() < 1e-9);
    }
}

//! The faintest star that the naked eye sees against a sky.
//!
//! *Source.* Crumey 2014, *MNRAS* 442, 2600: thresholds of points for dark-adapted young eyes that look
//! with both and know where (Blackwell 1946; Knoll, Tousey & Hulburt 1946), Eqs. 28 and 34:
//!
//! `dI = (sqrt(a1 B^1/2 + a2 B^3/4 + a3 B) + a4 B^1/4 + a5 B^1/2)^2` in lux, `m = -2.5 log10(F dI / 2.54e-6)`
//!
//! with the luminance `B` of the sky in cd/m2 and the field factor `F` of observer and task: 1.4 for the
//! keenest eyes in the best of circumstances, 2 for a typical observer, 2.4 for less.
//!
//! *How we differ.* Where rods give way to cones (some 16.5 magnitudes per square arcsecond) the formula
//! has the threshold fall by a little while the sky gets brighter. Here it never falls: it stays until
//! the formula passes it again.
//!
//! *Range.* The data go from 1e-5 cd/m2, below which the threshold stays, to 1e3 cd/m2; above, the
//! formula goes on as Weber's law. `B` is photopic luminance of a light with a scotopic-to-photopic
//! ratio of 1.38, `m` is V of a star of the same colour as the tests' lamps (some 2850 K). Under a
//! bluer sky the rods see more of it: [`luminance_for_rods`] turns scotopic luminance into the `B` that
//! has the same effect on them.
//!
//! *Left out.* Age and acuity of the observer, the colour of the star, scintillation, the loss of light in
//! the air: `m` is what arrives.

use std::sync::LazyLock;

/// Field factor of a typical observer.
pub const TYPICAL_FIELD_FACTOR: f64 = 2.0;
/// Scotopic over photopic luminance of the night sky that the formula takes for granted.
pub const SCOTOPIC_RATIO: f64 = 1.38;
/// Below, the threshold is that of this luminance, cd/m2.
pub const DARKEST_CD_M2: f64 = 1e-5;

/// Illuminance of a star of magnitude 0 in the formula, lux.
const ZERO_LX: f64 = 2.54e-6;
const A: [f64; 5] = [5.949e-8, -2.389e-7, 2.459e-7, 4.120e-4, -4.225e-4];

/// The formula as it stands, lux.
fn formula_lx(luminance_cd_m2: f64) -> f64 {
    let b = luminance_cd_m2.powf(0.25);
    let root = (b * b * (A[0] + A[1] * b + A[2] * b * b)).max(0.0).sqrt();
    (root + b * (A[3] + A[4] * b)).powi(2)
}

/// Luminance and threshold where the formula begins to fall, cd/m2 and lux.
static CREST: LazyLock<(f64, f64)> = LazyLock::new(|| {
    // From 1e-4 to 1 cd/m2 in steps of 0.1 %.
    let luminance = |step: i32| 1e-4 * 1.001f64.powi(step);
    let falls = |step: &i32| formula_lx(luminance(step + 1)) < formula_lx(luminance(*step));
    let at = (0..9215).find(falls).map_or(f64::INFINITY, luminance);
    (at, if at.is_finite() { formula_lx(at) } else { 0.0 })
});

/// Illuminance at the eye of the faintest point of light that is seen, lux, for a field factor of 1,
/// against a luminance in cd/m2. Never falls while the luminance grows.
pub fn threshold_lx(luminance_cd_m2: f64) -> f64 {
    let luminance_cd_m2 = luminance_cd_m2.max(DARKEST_CD_M2);
    let formula = formula_lx(luminance_cd_m2);
    let (crest_cd_m2, crest_lx) = *CREST;
    if luminance_cd_m2 > crest_cd_m2 { formula.max(crest_lx) } else { formula }
}

/// V of the faintest star that is seen, as it arrives at the eye, against a sky of a luminance in cd/m2,
/// with a field factor of 1 to 10 ([`TYPICAL_FIELD_FACTOR`]; what lies outside is brought to the end).
pub fn limiting_magnitude(luminance_cd_m2: f64, field_factor: f64) -> f64 {
    -2.5 * (field_factor.clamp(1.0, 10.0) * threshold_lx(luminance_cd_m2) / ZERO_LX).log10()
}

/// The luminance for [`limiting_magnitude`] of a sky that cones and rods see as given, cd/m2: by the
/// rods where they decide, below 0.005 cd/m2, by the cones above 5, mixed by the logarithm between (the
/// bounds of mesopic vision, CIE 191).
pub fn luminance_for_rods(photopic_cd_m2: f64, scotopic_cd_m2: f64) -> f64 {
    let by_rods = scotopic_cd_m2 / SCOTOPIC_RATIO;
    if photopic_cd_m2 <= 0.0 || by_rods <= 0.0 {
        return photopic_cd_m2.max(by_rods).max(0.0);
    }
    let cones = ((photopic_cd_m2 / 0.005).log10() / 3.0).clamp(0.0, 1.0);
    (cones * photopic_cd_m2.ln() + (1.0 - cones) * by_rods.ln()).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(mag_per_arcsec2: f64, field_factor: f64) -> f64 {
        limiting_magnitude(10f64.powf((12.58 - mag_per_arcsec2) / 2.5), field_factor)
    }

    #[test]
    fn it_has_the_published_values() {
        for (sky, expected) in [
            (22.0, 6.26),
            (21.83, 6.19),
            (21.0, 5.87),
            (20.0, 5.51),
            (18.0, 4.98),
            (14.0, 4.16),
            (10.0, 1.55),
            (8.0, 0.06),
        ] {
            let got = at(sky, TYPICAL_FIELD_FACTOR);
            assert!((got - expected).abs() < 0.01, "{sky}: {got} {expected}");
        }
        assert!((at(21.83, 1.4) - 6.58).abs() < 0.01);
    }

    #[test]
    fn it_falls_with_the_light_from_night_to_noon() {
        let mut before = f64::INFINITY;
        for step in 0..12_000 {
            let here = limiting_magnitude(1e-6 * 1.002f64.powi(step), 2.0);
            assert!(here.is_finite() && here <= before, "{step}: {here} {before}");
            assert!(before - here < 0.01 || step == 0, "{step}: {here} {before}");
            before = here;
        }
        // Venus at -4.5 is just seen by day, Sirius not.
        let day = limiting_magnitude(4000.0, 2.0);
        assert!((-5.0..-1.5).contains(&day), "{day}");
        assert_eq!(limiting_magnitude(0.0, 2.0), limiting_magnitude(1e-5, 2.0));
    }

    #[test]
    fn the_crest_is_short_and_low() {
        let (crest_cd_m2, crest_lx) = *CREST;
        let mag = 12.58 - 2.5 * crest_cd_m2.log10();
        assert!((15.0..18.0).contains(&mag), "{mag}");
        let least = (0..3000).map(|k| formula_lx(crest_cd_m2 * 1.002f64.powi(k)) / crest_lx);
        let dip = -2.5 * least.fold(f64::INFINITY, f64::min).log10();
        assert!((0.0..0.3).contains(&dip), "{dip}");
    }

    #[test]
    fn rods_decide_by_night() {
        assert!((luminance_for_rods(2e-4, 2e-4 * SCOTOPIC_RATIO) - 2e-4).abs() < 1e-12);
        assert!((luminance_for_rods(2e-4, 2e-4 * 2.76) - 4e-4).abs() < 1e-12);
        assert!((luminance_for_rods(100.0, 250.0) - 100.0).abs() < 1e-9);
        assert_eq!(luminance_for_rods(0.0, 0.0), 0.0);
    }
}

//! Daylight of a chromaticity: what the models' light is made of.
//!
//! The spectrum is `S0 + M1 S1 + M2 S2`, `M1` and `M2` rational in the chromaticity: Judd, MacAdam &
//! Wyszecki 1964; CIE 15:2004, table T.2; `M1` and `M2` as in Preetham's
//! notes of SIGGRAPH 2003, which took them from Wyszecki & Stiles 1982. Luminance and
//! chromaticity of a light are kept as the model gives them; only the scotopic member is taken from the
//! spectrum, by its ratio to the luminance, which is 2.5 for D65.
//!
//! Off the locus of daylight the spectrum stands for no light that was measured, and very far off it
//! turns negative; the scotopic ratio is then held within 0 to 6.

use std::sync::LazyLock;

use crate::light::spectrum::{Spectrum, interpolate};
use crate::units::Xyzv;

/// Chromaticity (CIE 1931) of the illuminant D65.
pub const D65_XY: (f64, f64) = (0.3127, 0.3290);

/// The largest ratio of scotopic to photopic luminance of any blue sky, with room.
const MOST_SCOTOPIC: f64 = 6.0;

/// S0, S1 and S2 of CIE 15:2004, table T.2, from 360 nm by 10 nm.
#[rustfmt::skip]
const COMPONENTS: [[f64; 3]; 48] = [
    [61.5, 38.0, 5.3], [68.8, 42.4, 6.1], [63.4, 38.5, 3.0], [65.8, 35.0, 1.2],
    [94.8, 43.4, -1.1], [104.8, 46.3, -0.5], [105.9, 43.9, -0.7], [96.8, 37.1, -1.2],
    [113.9, 36.7, -2.6], [125.6, 35.9, -2.9], [125.5, 32.6, -2.8], [121.3, 27.9, -2.6],
    [121.3, 24.3, -2.6], [113.5, 20.1, -1.8], [113.1, 16.2, -1.5], [110.8, 13.2, -1.3],
    [106.5, 8.6, -1.2], [108.8, 6.1, -1.0], [105.3, 4.2, -0.5], [104.4, 1.9, -0.3],
    [100.0, 0.0, 0.0], [96.0, -1.6, 0.2], [95.1, -3.5, 0.5], [89.1, -3.5, 2.1],
    [90.5, -5.8, 3.2], [90.3, -7.2, 4.1], [88.4, -8.6, 4.7], [84.0, -9.5, 5.1],
    [85.1, -10.9, 6.7], [81.9, -10.7, 7.3], [82.6, -12.0, 8.6], [84.9, -14.0, 9.8],
    [81.3, -13.6, 10.2], [71.9, -12.0, 8.3], [74.3, -13.3, 9.6], [76.4, -12.9, 8.5],
    [63.3, -10.6, 7.0], [71.7, -11.6, 7.6], [77.0, -12.2, 8.0], [65.2, -10.2, 6.7],
    [47.7, -7.8, 5.2], [68.6, -11.2, 7.4], [65.0, -10.4, 6.8], [66.0, -10.6, 7.0],
    [61.0, -9.7, 6.4], [53.3, -8.3, 5.5], [58.9, -9.3, 6.1], [61.9, -9.8, 6.5],
];

/// The three components on the grid.
static SPECTRA: LazyLock<[Spectrum; 3]> = LazyLock::new(|| {
    std::array::from_fn(|component| {
        let row = |(k, row): (usize, &[f64; 3])| (360.0 + 10.0 * k as f64, row[component]);
        let table: Vec<(f64, f64)> = COMPONENTS.iter().enumerate().map(row).collect();
        Spectrum::from_fn(|nm| interpolate(&table, nm))
    })
});

/// What the observers see of the three components.
static SEEN: LazyLock<[Xyzv; 3]> = LazyLock::new(|| SPECTRA.each_ref().map(Spectrum::xyzv));

/// `M1` and `M2` of a chromaticity.
fn weights((x, y): (f64, f64)) -> [f64; 2] {
    let below = 0.0241 + 0.2562 * x - 0.7341 * y;
    [(-1.3515 - 1.7703 * x + 5.9114 * y) / below, (0.0300 - 31.4424 * x + 30.0717 * y) / below]
}

/// Relative spectrum of daylight of a chromaticity (CIE 1931).
pub fn spectrum(xy: (f64, f64)) -> Spectrum {
    let [first, second] = weights(xy);
    SPECTRA[0] + SPECTRA[1] * first + SPECTRA[2] * second
}

/// Ratio of scotopic to photopic luminance of daylight of a chromaticity.
pub fn scotopic_ratio(xy: (f64, f64)) -> f64 {
    let [first, second] = weights(xy);
    let seen = SEEN[0] + SEEN[1] * first + SEEN[2] * second;
    if seen.y > 0.0 { (seen.v / seen.y).clamp(0.0, MOST_SCOTOPIC) } else { 0.0 }
}

/// Light of a luminance (cd/m2) and a chromaticity.
pub fn light((x, y): (f64, f64), cd_m2: f64) -> Xyzv {
    let per_y = cd_m2 / y;
    let z = (1.0 - x - y).max(0.0);
    Xyzv::new(per_y * x, cd_m2, per_y * z, cd_m2 * scotopic_ratio((x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::spectrum::chromaticity_xy;

    #[test]
    fn the_spectrum_has_the_chromaticity_that_was_asked_for() {
        // D50, D55, D65, D75 of CIE 15:2004, and a blue sky: the published weights are rounded.
        for xy in [(0.3457, 0.3585), (0.3324, 0.3474), D65_XY, (0.2990, 0.3149), (0.2500, 0.2500)] {
            let (x, y) = chromaticity_xy(spectrum(xy).xyzv()).unwrap();
            assert!((x - xy.0).abs() < 1e-3 && (y - xy.1).abs() < 1e-3, "{xy:?}: {x} {y}");
        }
    }

    #[test]
    fn d65_is_itself() {
        // CIE 15:2004, table T.1: relative to 100 at 560 nm.
        let d65 = spectrum(D65_XY);
        for (nm, value) in [(400.0, 82.7549), (450.0, 117.008), (500.0, 109.354), (650.0, 80.0268)]
        {
            let got = 100.0 * d65.at_nm(nm) / d65.at_nm(560.0);
            assert!((got / value - 1.0).abs() < 0.005, "{nm} nm: {got}");
        }
        // S/P ratio of D65: 2.47 (recalled from CIE 191:2010).
        assert!((scotopic_ratio(D65_XY) - 2.47).abs() < 0.02, "{}", scotopic_ratio(D65_XY));
    }

    #[test]
    fn light_keeps_luminance_and_chromaticity() {
        let light = light((0.26, 0.27), 3000.0);
        let (x, y) = chromaticity_xy(light).unwrap();
        assert!((x - 0.26).abs() < 1e-12 && (y - 0.27).abs() < 1e-12 && light.y == 3000.0);
        // Bluer light is better for rods.
        assert!(light.v / light.y > scotopic_ratio(D65_XY));
    }
}

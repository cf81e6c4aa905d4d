//! Magnitudes from spectra: B, V and R, and what a Sky Quality Meter reads.
//!
//! *Bands.* Bessell 1990, *PASP* 102, 1181, Table 2. His responses are those of energy: a magnitude
//! weighs power per wavelength with them, not photons (they hold the factor of the wavelength already;
//! Maíz Apellániz 2006, recalled). Zero points: the mean power of a star of magnitude 0 after Bessell,
//! Castelli & Plez 1998, *A&A* 333, 231, Table A2, of a Vega of 0.03 in V.
//!
//! *What the grid cuts off.* B and V lie within 360 to 830 nm. R goes on to 900 nm, with 1.1 % of its
//! area; the mean is taken over the rest, so that an even spectrum has the right magnitude. Strong
//! bands of OH beyond 830 nm are missing: a few hundredths of a magnitude of the night sky.
//!
//! *The Sky Quality Meter* is a silicon diode (TAOS TSL237S) behind a glass that stops the infrared
//! (Hoya CM-500); Cinzano 2005, ISTIL Internal Report 9. Its response is broad, half of its peak at 390
//! and 620 nm. The numbers are recalled from his figure, good to 0.05 of the peak. It tells magnitudes
//! as if it saw V; makers set it with lamps, to 0.1 magnitudes. Here it reads V for sunlight, the colour
//! of the natural sky without the airglow. Light bluer by 0.28 in B - V reads 0.1 brighter.
//!
//! *Luminance.* `10^((12.58 - V) / 2.5)` cd/m2 (Crumey 2014) is 3.5 % low for sunlight here and 11 % for
//! the dark sky, whose green line stands where the eye sees best: luminance is better taken from the
//! spectrum.
//!
//! *Accuracy.* The Sun has V -26.76, B - V 0.66, V - R 0.38 with Wehrli's spectrum (tested below).

use std::f64::consts::LOG10_2;
use std::sync::LazyLock;

use crate::light::spectrum::{LEN, Spectrum, interpolate, wavelength_nm};
use crate::light::sun;
use crate::units::Angle;

/// Square arcseconds in a steradian.
pub const ARCSEC2_PER_SR: f64 = 4.254_517_029_615_221e10;

/// V of one star of magnitude 10 in a square degree, per square arcsecond: the unit S10(V).
pub const S10_V_MAG: f64 = 27.78;

/// Luminance of a surface brightness in V, cd/m2: `10^((12.58 - m) / 2.5)`, Crumey 2014, *MNRAS* 442,
/// 2600. Magnitudes per square arcsecond.
pub fn luminance_cd_m2(mag_per_arcsec2: f64) -> f64 {
    10f64.powf((12.58 - mag_per_arcsec2) / 2.5)
}

/// A band of Johnson and Cousins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Band {
    B,
    V,
    R,
}

impl Band {
    pub const ALL: [Band; 3] = [Band::B, Band::V, Band::R];

    /// Response to power per wavelength by wavelength in nanometres, 1 at its peak.
    fn table(self) -> &'static [(f64, f64)] {
        match self {
            Band::B => &BESSELL_B,
            Band::V => &BESSELL_V,
            Band::R => &BESSELL_R,
        }
    }

    /// The mean over the band of a star of magnitude 0, W m-2 nm-1.
    pub const fn zero_w_m2_nm(self) -> f64 {
        match self {
            Band::B => 6.32e-11,
            Band::V => 3.631e-11,
            Band::R => 2.177e-11,
        }
    }

    /// The mean of a spectrum over the band, in its own unit.
    pub fn mean(self, spectrum: &Spectrum) -> f64 {
        static WEIGHTS: LazyLock<[[f64; LEN]; 3]> =
            LazyLock::new(|| Band::ALL.map(|band| mean_weights(band.table())));
        weighed(&WEIGHTS[self as usize], spectrum)
    }
}

/// Magnitude of a light by its irradiance, W m-2 nm-1. Infinite for no light.
pub fn magnitude(irradiance: &Spectrum, band: Band) -> f64 {
    -2.5 * (band.mean(irradiance) / band.zero_w_m2_nm()).log10()
}

/// Magnitude per square arcsecond of a radiance, W m-2 sr-1 nm-1. Infinite for no light.
pub fn mag_per_arcsec2(radiance: &Spectrum, band: Band) -> f64 {
    magnitude(radiance, band) + 2.5 * ARCSEC2_PER_SR.log10()
}

/// Brightness in stars of magnitude 10 per square degree, by V, of a radiance in W m-2 sr-1 nm-1.
pub fn s10_v(radiance: &Spectrum) -> f64 {
    10f64.powf(0.4 * (S10_V_MAG - mag_per_arcsec2(radiance, Band::V)))
}

/// What a Sky Quality Meter reads of a radiance, W m-2 sr-1 nm-1, that fills its field. Infinite for no
/// light.
pub fn sqm_mag_per_arcsec2(radiance: &Spectrum) -> f64 {
    /// Weights, and what sunlight of V = 0 has with them, W m-2 nm-1.
    static METER: LazyLock<([f64; LEN], f64)> = LazyLock::new(|| {
        let weights = mean_weights(&SQM);
        let sunlight = sun::irradiance_1au();
        let v = magnitude(&sunlight, Band::V);
        (weights, weighed(&weights, &sunlight) * 10f64.powf(0.4 * v))
    });
    let (weights, zero) = &*METER;
    -2.5 * (weighed(weights, radiance) / zero / ARCSEC2_PER_SR).log10()
}

/// Response of a Sky Quality Meter with a lens (SQM-L) to light from an angle off its axis, 1 on it:
/// half at 10 degrees, a tenth at 19, a hundredth at 40 (its maker's numbers, recalled), nothing from
/// the side.
pub fn sqm_l_weight(angle_from_axis: Angle) -> f64 {
    /// Degrees and the decimal logarithm of the response.
    const LAW: [(f64, f64); 4] = [(10.0, -LOG10_2), (19.0, -1.0), (40.0, -2.0), (90.0, -4.0)];
    let deg = angle_from_axis.deg().abs();
    if deg >= LAW[3].0 {
        0.0
    } else if deg < LAW[0].0 {
        10f64.powf(LAW[0].1 * (deg / LAW[0].0).powi(2))
    } else {
        10f64.powf(interpolate(&LAW, deg))
    }
}

fn weighed(weights: &[f64; LEN], spectrum: &Spectrum) -> f64 {
    weights.iter().zip(spectrum.values()).map(|(weight, value)| weight * value).sum()
}

/// Weights of the nodes for the mean over a response: those of a spectrum that is straight between
/// the nodes.
fn mean_weights(response: &[(f64, f64)]) -> [f64; LEN] {
    /// Steps of the integral to a step of the grid.
    const FINE: usize = 10;
    let step_nm = wavelength_nm(1) - wavelength_nm(0);
    let mut weights = [0.0; LEN];
    for node in 0..LEN - 1 {
        for k in 0..FINE {
            let share = (k as f64 + 0.5) / FINE as f64;
            let here = interpolate(response, wavelength_nm(node) + share * step_nm);
            weights[node] += here * (1.0 - share);
            weights[node + 1] += here * share;
        }
    }
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

const BESSELL_B: [(f64, f64); 21] = [
    (360.0, 0.0),
    (370.0, 0.030),
    (380.0, 0.134),
    (390.0, 0.567),
    (400.0, 0.920),
    (410.0, 0.978),
    (420.0, 1.0),
    (430.0, 0.978),
    (440.0, 0.935),
    (450.0, 0.853),
    (460.0, 0.740),
    (470.0, 0.640),
    (480.0, 0.536),
    (490.0, 0.424),
    (500.0, 0.325),
    (510.0, 0.235),
    (520.0, 0.150),
    (530.0, 0.095),
    (540.0, 0.043),
    (550.0, 0.009),
    (560.0, 0.0),
];
const BESSELL_V: [(f64, f64); 24] = [
    (470.0, 0.0),
    (480.0, 0.030),
    (490.0, 0.163),
    (500.0, 0.458),
    (510.0, 0.780),
    (520.0, 0.967),
    (530.0, 1.0),
    (540.0, 0.973),
    (550.0, 0.898),
    (560.0, 0.792),
    (570.0, 0.684),
    (580.0, 0.574),
    (590.0, 0.461),
    (600.0, 0.359),
    (610.0, 0.270),
    (620.0, 0.197),
    (630.0, 0.135),
    (640.0, 0.081),
    (650.0, 0.045),
    (660.0, 0.025),
    (670.0, 0.017),
    (680.0, 0.013),
    (690.0, 0.009),
    (700.0, 0.0),
];
const BESSELL_R: [(f64, f64); 24] = [
    (550.0, 0.0),
    (560.0, 0.23),
    (570.0, 0.74),
    (580.0, 0.91),
    (590.0, 0.98),
    (600.0, 1.0),
    (610.0, 0.98),
    (620.0, 0.96),
    (630.0, 0.93),
    (640.0, 0.90),
    (650.0, 0.86),
    (660.0, 0.81),
    (670.0, 0.78),
    (680.0, 0.72),
    (690.0, 0.67),
    (700.0, 0.61),
    (710.0, 0.56),
    (720.0, 0.51),
    (730.0, 0.46),
    (740.0, 0.40),
    (750.0, 0.35),
    (800.0, 0.14),
    (850.0, 0.03),
    (900.0, 0.0),
];
/// Recalled, see above.
const SQM: [(f64, f64); 19] = [
    (300.0, 0.0),
    (325.0, 0.02),
    (350.0, 0.12),
    (375.0, 0.35),
    (400.0, 0.56),
    (425.0, 0.68),
    (450.0, 0.79),
    (475.0, 0.89),
    (500.0, 0.97),
    (525.0, 1.0),
    (550.0, 0.98),
    (575.0, 0.88),
    (600.0, 0.69),
    (625.0, 0.45),
    (650.0, 0.25),
    (675.0, 0.11),
    (700.0, 0.045),
    (725.0, 0.015),
    (750.0, 0.0),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_has_its_magnitudes() {
        let [b, v, r] = Band::ALL.map(|band| magnitude(&sun::irradiance_1au(), band));
        assert!((v + 26.74).abs() < 0.03, "{v}");
        assert!((b - v - 0.65).abs() < 0.02, "{}", b - v);
        assert!((v - r - 0.36).abs() < 0.03, "{}", v - r);
    }

    #[test]
    fn an_even_spectrum_has_the_zero_points() {
        for band in Band::ALL {
            let zero = Spectrum::from_fn(|_| band.zero_w_m2_nm());
            assert!(magnitude(&zero, band).abs() < 1e-9);
            assert!((mag_per_arcsec2(&(zero * ARCSEC2_PER_SR), band)).abs() < 1e-9);
        }
        assert_eq!(magnitude(&Spectrum::DARK, Band::V), f64::INFINITY);
        // What R has beyond the grid.
        let area = |from: f64, to: f64| -> f64 {
            let steps = 1000;
            let width = (to - from) / f64::from(steps);
            (0..steps)
                .map(|k| interpolate(&BESSELL_R, from + (f64::from(k) + 0.5) * width) * width)
                .sum()
        };
        let lost = area(830.0, 900.0) / area(550.0, 900.0);
        assert!((lost - 0.011).abs() < 0.001, "{lost}");
    }

    #[test]
    fn one_star_of_magnitude_ten_in_a_square_degree_is_one_s10() {
        let sunlight = sun::irradiance_1au();
        let ten = sunlight * 10f64.powf(0.4 * (magnitude(&sunlight, Band::V) - 10.0));
        let square_degree_sr = 3.046_174e-4;
        let s10 = s10_v(&(ten * (1.0 / square_degree_sr)));
        assert!((s10 - 1.0).abs() < 3e-3, "{s10}");
        // Leinert's unit for sunlight: 1.28e-8 W m-2 sr-1 um-1 at 500 nm.
        // That is for a Sun of -26.74; this one is 2 % brighter.
        let at_500 = ten.at_nm(500.0) / square_degree_sr * 1e3;
        assert!((at_500 / 1.28e-8 - 1.0).abs() < 0.04, "{at_500:e}");
    }

    #[test]
    fn a_meter_reads_v_of_sunlight_and_more_of_bluer_light() {
        let sunlight = sun::irradiance_1au() * 1e-15;
        let off = |light: &Spectrum| sqm_mag_per_arcsec2(light) - mag_per_arcsec2(light, Band::V);
        assert!(off(&sunlight).abs() < 1e-9);
        // Bluer by 0.28 in B - V.
        let blue = sunlight.weighted(|nm| (nm / 550.0).powf(-1.2));
        let colour = mag_per_arcsec2(&blue, Band::B) - mag_per_arcsec2(&blue, Band::V);
        assert!((colour - 0.38).abs() < 0.02, "{colour}");
        assert!((-0.12..-0.02).contains(&off(&blue)), "{}", off(&blue));
    }

    #[test]
    fn the_lens_sees_twenty_degrees() {
        let weight = |deg: f64| sqm_l_weight(Angle::from_deg(deg));
        assert_eq!(weight(0.0), 1.0);
        assert!((weight(10.0) - 0.5).abs() < 1e-4 && (weight(19.0) - 0.1).abs() < 1e-9);
        assert_eq!(weight(95.0), 0.0);
        assert!((0..899).all(|k| weight(f64::from(k) * 0.1) > weight(f64::from(k) * 0.1 + 0.1)));
    }
}

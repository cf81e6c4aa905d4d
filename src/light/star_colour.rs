//! Colours of stars: from B-V to a temperature, and from there to a black body.
//!
//! The default is Ballesteros 2012, *EPL* 97, 34008, eq. 14; the law of Jensen et al. 2001, eq. 8,
//! is kept for comparison. The spectrum is that of a black body without lines: its colour is right
//! to about 0.1 in B-V for ordinary stars, and wrong for carbon stars and M giants, whose bands of
//! TiO the eye's observers notice.

use crate::light::point_light::PointLight;
use crate::light::spectrum::Spectrum;
use crate::units::Magnitude;

/// Planck constant, J s (SI 2019, exact).
const PLANCK_J_S: f64 = 6.626_070_15e-34;
/// Boltzmann constant, J/K (SI 2019, exact).
const BOLTZMANN_J_K: f64 = 1.380_649e-23;
/// Speed of light, m/s (SI, exact).
const LIGHT_SPEED_M_S: f64 = 299_792_458.0;

/// B-V that the laws below accept; what lies outside is brought to the nearer end.
pub const B_V_RANGE: std::ops::RangeInclusive<f64> = -0.4..=2.0;

/// Effective temperature, kelvin, after Ballesteros 2012, eq. 14: 21,700 K to 3,170 K over
/// [`B_V_RANGE`]. Too cool for O stars, where B-V hardly depends on temperature.
pub fn temperature_k(b_v: f64) -> f64 {
    let b_v = in_range(b_v);
    4600.0 * (1.0 / (0.92 * b_v + 1.7) + 1.0 / (0.92 * b_v + 0.62))
}

/// Effective temperature, kelvin, after Jensen et al. 2001, "A physically-based night sky model",
/// eq. 8: 7000 / (B-V + 0.56), clamped as above.
pub fn temperature_jensen_k(b_v: f64) -> f64 {
    7000.0 / (in_range(b_v) + 0.56)
}

/// Not a number counts as the colour of the Sun, so that a bad catalogue entry stays a star.
fn in_range(b_v: f64) -> f64 {
    if b_v.is_nan() { 0.65 } else { b_v.clamp(*B_V_RANGE.start(), *B_V_RANGE.end()) }
}

/// Spectral radiance of a black body, W m-2 sr-1 nm-1 (Planck's law, CODATA constants).
pub fn planck_radiance(wavelength_nm: f64, temperature_k: f64) -> f64 {
    debug_assert!(wavelength_nm > 0.0 && temperature_k > 0.0);
    let wavelength_m = wavelength_nm * 1e-9;
    let exponent = PLANCK_J_S * LIGHT_SPEED_M_S / (wavelength_m * BOLTZMANN_J_K * temperature_k);
    let per_m =
        2.0 * PLANCK_J_S * LIGHT_SPEED_M_S.powi(2) / (wavelength_m.powi(5) * exponent.exp_m1());
    per_m * 1e-9
}

/// A black body of the temperature that belongs to B-V, radiance in W m-2 sr-1 nm-1.
pub fn black_body(b_v: f64) -> Spectrum {
    let temperature_k = temperature_k(b_v);
    Spectrum::from_fn(|nm| planck_radiance(nm, temperature_k))
}

/// The light of a star outside the air: a black body with the illuminance of its V magnitude.
pub fn star(magnitude: Magnitude, b_v: f64) -> PointLight {
    PointLight::from_shape(black_body(b_v), magnitude)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::spectrum::chromaticity_xy;

    #[test]
    fn the_sun_and_sirius_have_their_temperatures() {
        assert!((temperature_k(0.65) - 5770.0).abs() < 50.0, "{}", temperature_k(0.65));
        assert!((temperature_jensen_k(0.65) - 5785.0).abs() < 1.0);
        // Vega is the zero of B-V; its temperature is 9,600 K or so, the law says 10,125 K.
        assert!((temperature_k(0.0) - 10_125.0).abs() < 1.0, "{}", temperature_k(0.0));
        for b_v in [-9.0, f64::NEG_INFINITY] {
            assert_eq!(temperature_k(b_v), temperature_k(-0.4));
        }
        assert_eq!(temperature_k(f64::NAN), temperature_k(0.65));
    }

    #[test]
    fn the_black_body_obeys_its_two_laws() {
        // Wien: the peak of 5000 K lies at 2897.771955 um K / 5000 K = 579.55 nm.
        let at = |nm| planck_radiance(nm, 5000.0);
        assert!(at(579.55) > at(579.0) && at(579.55) > at(580.1));
        // Stefan and Boltzmann: sigma T^4 / pi, over 50 nm to 100 um in equal logarithmic steps.
        let steps = 20_000;
        let ratio = (100_000.0f64 / 50.0).ln() / f64::from(steps);
        let total: f64 = (0..steps)
            .map(|k| {
                let nm = 50.0 * ((f64::from(k) + 0.5) * ratio).exp();
                at(nm) * nm * ratio
            })
            .sum();
        let expected = 5.670_374_419e-8 * 5000f64.powi(4) / std::f64::consts::PI;
        // What lies beyond 100 um is 2e-5 of the whole.
        assert!((total / expected - 1.0).abs() < 5e-5, "{}", total / expected);
    }

    #[test]
    fn a_star_gives_the_illuminance_of_its_magnitude() {
        for b_v in [-0.3, 0.65, 1.9] {
            let star = star(Magnitude(1.25), b_v);
            assert!((star.xyzv.y / Magnitude(1.25).illuminance().lx() - 1.0).abs() < 1e-12);
        }
        let (x_blue, _) = chromaticity_xy(star(Magnitude(0.0), -0.2).xyzv).unwrap();
        let (x_red, _) = chromaticity_xy(star(Magnitude(0.0), 1.8).xyzv).unwrap();
        assert!(x_blue < 0.28 && x_red > 0.40, "{x_blue} {x_red}");
    }

    #[test]
    fn a_black_body_lies_on_the_published_locus() {
        // Illuminant A is 2855.5 K (c2 = 1.4388e-2 m K): x 0.4476, y 0.4074, S/P 1.41.
        let light = Spectrum::from_fn(|nm| planck_radiance(nm, 2855.5)).xyzv();
        let (x, y) = chromaticity_xy(light).unwrap();
        assert!((x - 0.4476).abs() < 3e-4 && (y - 0.4074).abs() < 3e-4, "{x} {y}");
        assert!((light.v / light.y - 1.41).abs() < 0.01, "{}", light.v / light.y);
    }
}

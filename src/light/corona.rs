//! The corona of the Sun: what is left to see when the Moon hides the disc.
//!
//! *Theory.* Light of the disc, scattered by free electrons (K) and by dust before the Sun (F): it has
//! the colour of the Sun. Its radiance falls with the distance `r` from the Sun's centre, in radii, as
//! `0.0532 r^-2.5 + 1.425 r^-7 + 2.565 r^-17` millionths of the middle of the disc (Baumbach 1937,
//! *Astronomische Nachrichten* 263, 121; the coefficients as they are usually quoted, recalled).
//! Here the law is scaled to [`TOTAL`] of the Sun between 1 and [`OUTER_RADII`] radii, the order of
//! the mean over the cycle of spots: 0.6e-6 at the minimum and 1.5e-6 at the maximum are usual
//! (recalled from Allen 1976, *Astrophysical Quantities*); the law as quoted has 1.3e-6.
//!
//! *Left out.* Streamers, plumes and the flattening (the corona of the maximum is round), emission
//! lines, the chromosphere and prominences, the change over the cycle.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::light::earth_shadow::arc;
use crate::light::spectrum::Spectrum;
use crate::light::sun;
use crate::units::AU_KM;

/// Light of the corona over that of the Sun.
pub const TOTAL: f64 = 1.0e-6;
/// Radii of the Sun at which it is cut off. Beyond, it is the zodiacal light.
pub const OUTER_RADII: f64 = 10.0;

/// Coefficients of the powers -2.5, -7 and -17.
const BAUMBACH: [f64; 3] = [0.0532, 1.425, 2.565];
/// Rings of the integrals.
const RINGS: usize = 256;

/// What makes the law sum up to [`TOTAL`], in units of the mean radiance of the disc.
static SCALE: LazyLock<f64> = LazyLock::new(|| TOTAL / sum(|_| 1.0));

/// Radiance at a distance from the Sun's centre in radii of the Sun, over the mean radiance of its
/// disc. Zero on the disc, which outshines it, and beyond [`OUTER_RADII`].
pub fn relative_radiance(radii: f64) -> f64 {
    if (1.0..=OUTER_RADII).contains(&radii) { *SCALE * baumbach(radii) } else { 0.0 }
}

/// Spectral radiance at a distance from the Sun's centre in radii of the Sun, W m-2 sr-1 nm-1.
pub fn radiance(radii: f64) -> Spectrum {
    sun::mean_radiance() * relative_radiance(radii)
}

/// Spectral irradiance by all of it at a distance from the Sun, W m-2 nm-1.
pub fn irradiance(sun_distance_km: f64) -> Spectrum {
    sun::irradiance(sun_distance_km.max(0.01 * AU_KM)) * TOTAL
}

/// What part of its light is not hidden by a disc, 0 to 1; given the radius of that disc and the
/// distance of its middle from the Sun's, both in radii of the Sun.
pub fn visible_share(moon_radii: f64, separation_radii: f64) -> f64 {
    let seen = |radii: f64| 1.0 - arc(radii, separation_radii, moon_radii) / PI;
    (*SCALE * sum(seen) / TOTAL).clamp(0.0, 1.0)
}

/// The law for a renderer: the coefficients of [`relative_radiance`] for the powers -2.5, -7 and -17 of
/// the distance in radii, then where it ends.
pub fn law() -> [f64; 6] {
    let [a, b, c] = BAUMBACH.map(|a| *SCALE * a);
    [a, b, c, OUTER_RADII, 0.0, 0.0]
}

fn baumbach(radii: f64) -> f64 {
    let [a, b, c] = BAUMBACH;
    a * radii.powf(-2.5) + b * radii.powi(-7) + c * radii.powi(-17)
}

/// The law over all rings in units of the area of the disc, each ring with its weight.
fn sum(weight: impl Fn(f64) -> f64) -> f64 {
    // In the inverse of the distance, in which the law is gentle.
    let width = (1.0 - OUTER_RADII.recip()) / RINGS as f64;
    let ring = |ring: usize| {
        let radii = (OUTER_RADII.recip() + (ring as f64 + 0.5) * width).recip();
        2.0 * baumbach(radii) * radii.powi(3) * width * weight(radii)
    };
    (0..RINGS).map(ring).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_sums_up_to_the_total() {
        // In closed form: 2 (a/0.5 (1 - R^-0.5) + b/5 + c/15), the last two to infinity.
        let exact =
            2.0 * (0.0532 / 0.5 * (1.0 - OUTER_RADII.powf(-0.5)) + 1.425 / 5.0 + 2.565 / 15.0);
        assert!((sum(|_| 1.0) / exact - 1.0).abs() < 1e-3, "{} {exact}", sum(|_| 1.0));
        // As quoted it is 1.3 millionths of the Sun, whose mean is 0.80 of its middle.
        assert!((1.1..1.4).contains(&(exact / 0.80)), "{exact}");
        let lx = irradiance(AU_KM).xyzv().y;
        assert!((lx / 0.1335 - 1.0).abs() < 1e-3, "{lx}");
    }

    #[test]
    fn it_fades_outwards_and_behind_the_moon() {
        for step in 0..80 {
            let radii = 1.0 + f64::from(step) * 0.1;
            assert!(relative_radiance(radii) > relative_radiance(radii + 0.1));
        }
        assert_eq!(relative_radiance(0.9), 0.0);
        assert_eq!(visible_share(1.0, 20.0), 1.0);
        let (just, larger) = (visible_share(1.0, 0.0), visible_share(1.08, 0.0));
        assert!((just - 1.0).abs() < 1e-9 && (0.5..0.9).contains(&larger), "{just} {larger}");
        // The law of the quoted formula: at 2 radii about a hundredth of what the limb has.
        let ratio = relative_radiance(2.0) / relative_radiance(1.0);
        assert!((0.003..0.01).contains(&ratio), "{ratio}");
    }
}

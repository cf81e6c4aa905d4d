//! Scintillation: how the flux of a point of light trembles in the air.
//!
//! Theory: turbulence at a height of some kilometres focuses starlight into flying shadows as large as a
//! Fresnel zone. The variance of the flux through a small opening is Rytov's, as the 11/6th power of the
//! air mass; near the horizon it saturates (Andrews & Phillips 2005, *Laser Beam Propagation through Random
//! Media*, plane waves: ch. 9). A larger opening averages over the shadows: `[1 + 1.062 k D^2 / 4 L]^(-7/6)`
//! (same book, ch. 10), and an exposure over those that the wind carries past. For openings beyond the
//! shadows and exposures of seconds that is the law of Young 1967 (*AJ* 72, 747) in the form of Osborn et
//! al. 2015 (*MNRAS* 452, 1707, eq. 7), `sigma^2 = 10e-6 C^2 D^(-4/3) t^(-1) X^3 exp(-2 h / 8 km)` in metres
//! and seconds; its median C = 1.5 sets the strength here. All of these are recalled. The flux is
//! log-normal, as Dravins et al. 1997-98 (*PASP* 109, 173; 109, 725; 110, 610) measured in small openings.
//!
//! A disc averages like an opening as wide as the disc is at the height of the shadows, `2 theta L X`:
//! Jupiter, 40 arcseconds, twinkles 16 times less than a star to the eye. In the zenith a star does so by
//! 12 % in the rms over a tenth of a second, by 48 % at 5 degrees.
//!
//! Omitted: colours, which part near the horizon (X, Y, Z and V take one factor); the strength of one
//! night against another, a factor of two either way; wandering of the image. Instants an exposure or more
//! apart are independent.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::time::Instant;
use crate::units::Angle;

/// Rytov variance of a point in the zenith of the sea, from Osborn's median for 1 m and 1 s.
const ZENITH_VARIANCE: f64 = 0.226;
/// Height of the turbulence that makes shadows, metres above the observer.
const TURBULENCE_M: f64 = 8000.0;
/// Height over which the strength falls to 1/e in the rms, metres.
const SCALE_HEIGHT_M: f64 = 8000.0;
/// Wind at the height of the turbulence, metres a second.
const WIND_M_S: f64 = 10.0;
/// Wavelength that the eye sees best, metres.
const WAVELENGTH_M: f64 = 555e-9;

/// What can be wrong with a request for scintillation.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ScintillationError {
    #[error("scintillation: {what} is {value}, outside {low} to {high}; choose a value inside")]
    Range { what: &'static str, value: f64, low: f64, high: f64 },
}

/// How points of light twinkle in one exposure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Scintillation {
    /// The same seed gives the same picture.
    pub seed: u64,
    /// Diameter of the opening, metres: 0 to 50.
    pub aperture_m: f64,
    /// Time over which light is gathered, seconds: 0 to 100 000.
    pub exposure_s: f64,
}

impl Default for Scintillation {
    /// A dark-adapted eye: a pupil of 6 mm that gathers light for a tenth of a second.
    fn default() -> Self {
        Scintillation { seed: 0, aperture_m: 0.006, exposure_s: 0.1 }
    }
}

impl Scintillation {
    /// Checks that the values can be.
    pub fn checked(self) -> Result<Scintillation, ScintillationError> {
        for (what, value, high) in
            [("aperture_m", self.aperture_m, 50.0), ("exposure_s", self.exposure_s, 1e5)]
        {
            if !(0.0..=high).contains(&value) {
                return Err(ScintillationError::Range { what, value, low: 0.0, high });
            }
        }
        Ok(self)
    }

    /// The exposure that an instant falls into, for [`Scintillation::factor`].
    pub fn key(&self, instant: &Instant) -> u64 {
        /// Shorter exposures than this count as this.
        const SHORTEST_S: f64 = 1e-3;
        let seconds = instant.tt.days_since_j2000() * 86_400.0;
        (seconds / self.exposure_s.max(SHORTEST_S)).floor() as i64 as u64
    }

    /// The flux of a star in one exposure over its mean: log-normal, with the mean 1.
    pub fn factor(&self, star_id: u64, instant_key: u64, altitude: Angle, height_m: f64) -> f64 {
        self.factor_of_disc(star_id, instant_key, altitude, height_m, Angle::ZERO)
    }

    /// The same for a disc of an angular diameter.
    pub fn factor_of_disc(
        &self,
        id: u64,
        instant_key: u64,
        altitude: Angle,
        height_m: f64,
        diameter: Angle,
    ) -> f64 {
        let spread = self.variance(altitude, height_m, diameter).ln_1p();
        let mut state = mixed(mixed(mixed(self.seed) ^ id) ^ instant_key);
        let mut uniform = || {
            state = mixed(state);
            ((state >> 11) as f64 + 0.5) / (1u64 << 53) as f64
        };
        // Box and Muller.
        let (radius, turn) = ((-2.0 * uniform().ln()).sqrt(), std::f64::consts::TAU * uniform());
        (spread.sqrt() * radius * turn.cos() - 0.5 * spread).exp()
    }

    /// Variance of the flux over the square of its mean, for a disc of an angular diameter.
    pub fn variance(&self, altitude: Angle, height_m: f64, diameter: Angle) -> f64 {
        let mass = air_mass(altitude);
        let thin = (-2.0 * height_m / SCALE_HEIGHT_M).exp();
        let rytov = ZENITH_VARIANCE * mass.powf(11.0 / 6.0) * thin;
        let distance_m = TURBULENCE_M * mass;
        let opening_m = self.aperture_m.hypot(diameter.rad() * distance_m);
        let wave_number = std::f64::consts::TAU / WAVELENGTH_M;
        let spread = 1.062 * wave_number * opening_m * opening_m / (4.0 * distance_m);
        let averaged = saturated(rytov) * (1.0 + spread).powf(-7.0 / 6.0);
        // A shadow, or the opening if it is larger, passes in this time.
        let passing_s = opening_m.hypot((WAVELENGTH_M * distance_m).sqrt()) / WIND_M_S;
        averaged * averaged_in_time(2.0 * self.exposure_s / passing_s)
    }
}

/// Variance of the flux at a point, given Rytov's: the same where it is small, about 1 beyond.
fn saturated(rytov: f64) -> f64 {
    let strong = rytov.powf(6.0 / 5.0);
    let large = 0.49 * rytov / (1.0 + 1.11 * strong).powf(7.0 / 6.0);
    let small = 0.51 * rytov / (1.0 + 0.69 * strong).powf(5.0 / 6.0);
    (large + small).exp_m1()
}

/// What averaging over so many times of correlation leaves of a variance, correlation being
/// exponential.
fn averaged_in_time(times: f64) -> f64 {
    if times < 1e-4 { 1.0 } else { 2.0 / times * (1.0 + (-times).exp_m1() / times) }
}

/// Kasten & Young 1989, *Applied Optics* 28, 4735: 1 in the zenith, 38 at the horizon and below.
fn air_mass(altitude: Angle) -> f64 {
    let deg = altitude.deg().clamp(0.0, 90.0);
    1.0 / (deg.to_radians().sin() + 0.505_72 * (deg + 6.079_95).powf(-1.6364))
}

/// The finalizer of SplitMix64 (Steele, Lea & Flood 2014): each bit in depends on each bit out.
fn mixed(number: u64) -> u64 {
    let z = number.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ZENITH: Angle = Angle::from_deg(90.0);

    fn through(aperture_m: f64, exposure_s: f64) -> Scintillation {
        Scintillation { seed: 7, aperture_m, exposure_s }
    }

    #[test]
    fn large_openings_and_long_exposures_follow_young() {
        // Osborn et al. 2015 with C = 1.5: 2.25e-5 for 1 m and 1 s.
        for (aperture_m, exposure_s, height_m, altitude_deg) in
            [(1.0, 1.0, 0.0, 90.0), (4.0, 30.0, 2400.0, 90.0), (1.0, 10.0, 0.0, 45.0)]
        {
            let telescope = through(aperture_m, exposure_s);
            let altitude = Angle::from_deg(altitude_deg);
            let variance = telescope.variance(altitude, height_m, Angle::ZERO);
            let young = 2.25e-5 * f64::powf(aperture_m, -4.0 / 3.0) / exposure_s
                * altitude.sin().powi(-3)
                * f64::exp(-2.0 * height_m / 8000.0);
            let ratio = variance / young;
            assert!((0.85..1.25).contains(&ratio), "{aperture_m} m, {exposure_s} s: {ratio}");
        }
    }

    #[test]
    fn the_mean_is_one_and_the_spread_is_that_of_the_law() {
        for altitude_deg in [90.0, 30.0, 5.0] {
            let eye = through(0.006, 0.01);
            let altitude = Angle::from_deg(altitude_deg);
            let draws: Vec<f64> =
                (0..200_000).map(|n| eye.factor(n % 1000, n / 1000, altitude, 0.0)).collect();
            let mean = draws.iter().sum::<f64>() / draws.len() as f64;
            let variance =
                draws.iter().map(|f| (f - mean).powi(2)).sum::<f64>() / draws.len() as f64;
            let expected = eye.variance(altitude, 0.0, Angle::ZERO);
            // Standard error of the mean: 0.002 at most; of the variance some per cent.
            assert!((mean - 1.0).abs() < 0.01, "{altitude_deg}: {mean}");
            assert!((variance / expected - 1.0).abs() < 0.15, "{altitude_deg}: {variance}");
        }
    }

    #[test]
    fn low_stars_twinkle_more_but_not_without_end_and_planets_less() {
        let eye = through(0.006, 0.0);
        let at = |deg| eye.variance(Angle::from_deg(deg), 0.0, Angle::ZERO);
        assert!(at(90.0) < at(45.0) && at(45.0) < at(20.0));
        assert!((0.15..0.3).contains(&at(90.0)), "{}", at(90.0));
        assert!((0.8..1.6).contains(&at(0.0)), "{}", at(0.0));
        assert!(at(-3.0) == at(0.0));
        let jupiter = eye.variance(ZENITH, 0.0, Angle::from_arcsec(40.0)).sqrt();
        let ratio = at(90.0).sqrt() / jupiter;
        assert!((15.0..60.0).contains(&ratio), "{ratio}");
        assert!(eye.variance(ZENITH, 4000.0, Angle::ZERO) < 0.5 * at(90.0));
    }

    #[test]
    fn one_seed_one_star_one_instant_one_factor() {
        let eye = Scintillation::default();
        let altitude = Angle::from_deg(20.0);
        let factor = |seed, id, key| Scintillation { seed, ..eye }.factor(id, key, altitude, 0.0);
        assert_eq!(factor(1, 2, 3), factor(1, 2, 3));
        for other in [factor(2, 2, 3), factor(1, 3, 3), factor(1, 2, 4)] {
            assert_ne!(other, factor(1, 2, 3));
        }
        assert!(through(-1.0, 0.1).checked().is_err());
        assert!(through(0.006, f64::NAN).checked().is_err());
        assert!(eye.checked().is_ok());
    }
}

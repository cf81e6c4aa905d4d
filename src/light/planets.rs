//! Planets as points of light: V magnitudes and colours.
//!
//! Magnitudes: Mallama & Hilton 2018, "Computing apparent planetary magnitudes for The Astronomical
//! Almanac", *Astronomy and Computing* 25, 10 (equation numbers below are theirs). Pluto: -1.00
//! (Meeus 1998, ch. 41) and 0.041 a degree, good to 0.1 mag.
//!
//! How we differ: the rotation and seasons of Mars, up to 0.06 mag, are left out; outside the ranges
//! of the paper the answer goes on as gracefully as it can and says so in
//! [`PlanetMagnitude::extrapolated`].
//!
//! From memory, not compared with the publication: some equation numbers, the source of the colours,
//! and the phase law of Pluto. The magnitudes are tested against the authors' own values and, over
//! the whole range of each formula, against Skyfield, which follows the authors' program.
//!
//! Colours: B-V of each planet (Cox 2000, *Allen's Astrophysical Quantities*, table 12.8); the
//! spectrum is sunlight tilted by a power of the wavelength until it has that B-V. Bands of methane
//! in Uranus and Neptune are not drawn.

use crate::light::point_light::PointLight;
use crate::light::spectrum::Spectrum;
use crate::light::sun;
use crate::units::{Angle, Magnitude};

/// A planet, or Pluto.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Planet {
    Mercury,
    Venus,
    Mars,
    Jupiter,
    Saturn,
    Uranus,
    Neptune,
    Pluto,
}

/// How a planet is lit and seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanetView {
    pub sun_distance_au: f64,
    pub observer_distance_au: f64,
    /// Angle at the planet between the Sun and the observer.
    pub phase: Angle,
    /// Latitude of the Sun seen from the planet: planetocentric for Saturn, where it is that above
    /// the rings, planetographic for Uranus. Not used for the others.
    pub sun_latitude: Angle,
    /// Latitude of the observer seen from the planet, likewise.
    pub observer_latitude: Angle,
    /// Year with fraction: Neptune has grown brighter from 1980 to 2000. Not used for the others.
    pub year: f64,
}

/// A magnitude and how far it may be trusted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanetMagnitude {
    pub magnitude: Magnitude,
    /// The view lies outside the range of phase angles, tilts or years that the formula was made for.
    pub extrapolated: bool,
}

/// Johnson V outside the air.
pub fn magnitude(planet: Planet, view: &PlanetView) -> PlanetMagnitude {
    debug_assert!(view.sun_distance_au > 0.0 && view.observer_distance_au > 0.0);
    let phase_deg = view.phase.signed().abs().deg();
    let (at_one_au, extrapolated) = match planet {
        Planet::Mercury => mercury(phase_deg),
        Planet::Venus => venus(phase_deg),
        Planet::Mars => mars(phase_deg),
        Planet::Jupiter => jupiter(phase_deg),
        Planet::Saturn => saturn(phase_deg, view.sun_latitude, view.observer_latitude),
        Planet::Uranus => uranus(phase_deg, view.sun_latitude, view.observer_latitude),
        Planet::Neptune => neptune(phase_deg, view.year),
        Planet::Pluto => (-1.00 + 0.041 * phase_deg, phase_deg > 2.0),
    };
    let distances = 5.0 * (view.sun_distance_au * view.observer_distance_au).log10();
    PlanetMagnitude { magnitude: Magnitude(at_one_au + distances), extrapolated }
}

/// The light of a planet outside the air.
pub fn light(planet: Planet, view: &PlanetView) -> PointLight {
    PointLight::from_shape(tilted_sunlight(b_v(planet)), magnitude(planet, view).magnitude)
}

/// Johnson B-V of the whole disc.
pub fn b_v(planet: Planet) -> f64 {
    match planet {
        Planet::Mercury => 0.93,
        Planet::Venus => 0.82,
        Planet::Mars => 1.36,
        Planet::Jupiter => 0.83,
        Planet::Saturn => 1.04,
        Planet::Uranus => 0.56,
        Planet::Neptune => 0.41,
        Planet::Pluto => 0.80,
    }
}

/// Sunlight, at one astronomical unit, reddened by a power of the wavelength to a given B-V.
pub(super) fn tilted_sunlight(b_v: f64) -> Spectrum {
    let power = tilt(b_v);
    sun::irradiance_1au().weighted(|nm| (nm / V_NM).powf(power))
}

/// Effective wavelengths of Johnson B and V for sunlight, nanometres (Bessell 2005, table 1, G2V).
const B_NM: f64 = 442.0;
const V_NM: f64 = 551.0;
/// B-V of the Sun (Ramirez et al. 2012).
const SUN_B_V: f64 = 0.653;

/// The power of the wavelength that adds `b_v - SUN_B_V` between the two effective wavelengths.
fn tilt(b_v: f64) -> f64 {
    (b_v - SUN_B_V) / (2.5 * (V_NM / B_NM).log10())
}

/// `c[0] + c[1] x + c[2] x^2 ...`
fn polynomial(x: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Eq. 2, 2 to 170 degrees.
fn mercury(phase_deg: f64) -> (f64, bool) {
    let c = [-0.613, 6.3280e-2, -1.6336e-3, 3.3644e-5, -3.4265e-7, 1.6893e-9, -3.0334e-12];
    (polynomial(phase_deg, &c), !(2.0..=170.0).contains(&phase_deg))
}

/// Eqs. 3 and 4, 2 to 179 degrees; beyond 163.7 the atmosphere scatters forwards.
fn venus(phase_deg: f64) -> (f64, bool) {
    let at_one_au = if phase_deg <= 163.7 {
        polynomial(phase_deg, &[-4.384, -1.044e-3, 3.687e-4, -2.814e-6, 8.938e-9])
    } else {
        polynomial(phase_deg, &[236.05828, -2.81914, 8.39034e-3])
    };
    (at_one_au, !(2.0..=179.0).contains(&phase_deg))
}

/// Eqs. 6 and 7 without the terms of rotation and season; to 120 degrees.
fn mars(phase_deg: f64) -> (f64, bool) {
    let at_one_au = if phase_deg <= 50.0 {
        polynomial(phase_deg, &[-1.601, 2.267e-2, -1.302e-4])
    } else {
        polynomial(phase_deg, &[-0.367, -0.02573, 3.445e-4])
    };
    (at_one_au, phase_deg > 120.0)
}

/// Eqs. 8 and 9; to 130 degrees.
fn jupiter(phase_deg: f64) -> (f64, bool) {
    let at_one_au = if phase_deg <= 12.0 {
        polynomial(phase_deg, &[-9.395, -3.7e-4, 6.16e-4])
    } else {
        // The polynomial falls to nothing near 180 degrees; a new Jupiter stays a finite magnitude.
        let law = polynomial(phase_deg / 180.0, &[1.0, -1.507, -0.363, -0.062, 2.809, -1.876]);
        -9.428 - 2.5 * law.max(1e-4).log10()
    };
    (at_one_au, phase_deg > 130.0)
}

/// Eq. 10 with the rings, to 6.5 degrees of phase and 27 of tilt, which is all that the Earth sees.
/// Beyond, tilt and rings stay at that limit and the globe darkens as eq. 12 has it.
fn saturn(phase_deg: f64, sun_latitude: Angle, observer_latitude: Angle) -> (f64, bool) {
    const LARGEST_PHASE_DEG: f64 = 6.5;
    const LARGEST_TILT_DEG: f64 = 27.0;
    // The rings count where the Sun lights the side that faces us.
    let product = sun_latitude.deg() * observer_latitude.deg();
    let tilt_deg = product.max(0.0).sqrt();
    let sin_tilt = Angle::from_deg(tilt_deg.min(LARGEST_TILT_DEG)).sin();
    let near_deg = phase_deg.min(LARGEST_PHASE_DEG);
    let with_rings =
        -8.914 - 1.825 * sin_tilt + 0.026 * near_deg - 0.378 * sin_tilt * (-2.25 * near_deg).exp();
    let globe = |deg: f64| polynomial(deg, &[-8.94, 2.446e-4, 2.672e-4, -1.506e-6, 4.767e-9]);
    let darkening = globe(phase_deg) - globe(near_deg);
    let extrapolated = phase_deg > LARGEST_PHASE_DEG || tilt_deg > LARGEST_TILT_DEG;
    (with_rings + darkening, extrapolated)
}

/// Eqs. 13 and 14; to 154 degrees.
fn uranus(phase_deg: f64, sun_latitude: Angle, observer_latitude: Angle) -> (f64, bool) {
    let latitude_deg = 0.5 * (sun_latitude.deg().abs() + observer_latitude.deg().abs());
    // The phase does not show from the Earth.
    let phase_term =
        if phase_deg > 3.1 { (1.045e-4 * phase_deg + 6.587e-3) * phase_deg } else { 0.0 };
    (-7.110 - 8.4e-4 * latitude_deg + phase_term, phase_deg > 154.0)
}

/// Eqs. 16 and 17; to 133 degrees. The phase term was measured after 2000 and is used for all years.
fn neptune(phase_deg: f64, year: f64) -> (f64, bool) {
    let base = (-6.89 - 0.0054 * (year - 1980.0)).clamp(-7.00, -6.89);
    let phase_term =
        if phase_deg > 1.9 { (9.617e-5 * phase_deg + 7.944e-3) * phase_deg } else { 0.0 };
    (base + phase_term, phase_deg > 133.0 || (phase_deg > 1.9 && year < 2000.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Planet; 8] = [
        Planet::Mercury,
        Planet::Venus,
        Planet::Mars,
        Planet::Jupiter,
        Planet::Saturn,
        Planet::Uranus,
        Planet::Neptune,
        Planet::Pluto,
    ];

    fn at_one_au(phase_deg: f64) -> PlanetView {
        PlanetView {
            sun_distance_au: 1.0,
            observer_distance_au: 1.0,
            phase: Angle::from_deg(phase_deg),
            sun_latitude: Angle::from_deg(20.0),
            observer_latitude: Angle::from_deg(20.0),
            year: 2030.0,
        }
    }

    #[test]
    fn every_view_has_a_magnitude_without_leaps() {
        for planet in ALL {
            for step in 0..1800 {
                let phase_deg = f64::from(step) / 10.0;
                let here = magnitude(planet, &at_one_au(phase_deg)).magnitude.0;
                let next = magnitude(planet, &at_one_au(phase_deg + 0.1)).magnitude.0;
                assert!(here.is_finite(), "{planet:?} {phase_deg}°");
                // The paper's own pieces join within 0.04 (Uranus at 3.1 degrees: 0.02); Jupiter
                // falls steeply near 180 degrees.
                let jump = if phase_deg > 160.0 { 1.0 } else { 0.06 };
                assert!((next - here).abs() < jump, "{planet:?} {phase_deg}°: {here} {next}");
            }
        }
    }

    #[test]
    fn distance_dims_by_the_square() {
        for planet in ALL {
            let far = PlanetView { sun_distance_au: 10.0, ..at_one_au(5.0) };
            let dimmed = magnitude(planet, &far).magnitude.0
                - magnitude(planet, &at_one_au(5.0)).magnitude.0;
            assert!((dimmed - 5.0).abs() < 1e-12, "{planet:?}");
        }
    }

    #[test]
    fn rings_count_when_their_lit_side_faces_us() {
        let tilted = |sun_deg: f64, observer_deg: f64| {
            let view = PlanetView {
                sun_latitude: Angle::from_deg(sun_deg),
                observer_latitude: Angle::from_deg(observer_deg),
                ..at_one_au(1.0)
            };
            magnitude(Planet::Saturn, &view)
        };
        assert_eq!(tilted(20.0, 20.0), tilted(-20.0, -20.0));
        assert_eq!(tilted(1.0, -1.0), tilted(0.0, 0.0));
        assert!(tilted(26.0, 26.0).magnitude < tilted(5.0, 5.0).magnitude);
        assert!(tilted(40.0, 40.0).extrapolated && !tilted(26.0, 26.0).extrapolated);
        assert_eq!(tilted(40.0, 40.0).magnitude, tilted(27.0, 27.0).magnitude);
    }

    #[test]
    fn colours_are_those_asked_for() {
        for planet in ALL {
            let spectrum = tilted_sunlight(b_v(planet));
            let sun = sun::irradiance_1au();
            let ratio = |spectrum: &Spectrum| spectrum.at_nm(440.0) / spectrum.at_nm(550.0);
            let reddened = -2.5 * (ratio(&spectrum) / ratio(&sun)).log10();
            // Nodes of the grid near the effective wavelengths: 440 and 550 nm.
            let expected = (b_v(planet) - SUN_B_V) * (550.0f64 / 440.0).ln() / (V_NM / B_NM).ln();
            assert!((reddened - expected).abs() < 1e-6, "{planet:?}");
        }
        let light = light(Planet::Mars, &at_one_au(0.0));
        assert!((light.xyzv.y / light.magnitude.illuminance().lx() - 1.0).abs() < 1e-12);
        assert_eq!(light.magnitude.0, -1.601);
    }
}

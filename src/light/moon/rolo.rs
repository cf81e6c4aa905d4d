//! How much light the whole Moon sends.
//!
//! Theory: the ROLO model, Kieffer & Stone 2005, *Astronomical Journal* 129, 2887, eq. 10 and table 4:
//! the disc's equivalent reflectance in 32 bands (19 of them here, 350 to 865 nm), straight between
//! bands, times the sunlight of [`crate::light::sun`].
//!
//! How we differ: ROLO was fitted at phase angles of 1.55 to 97 degrees. Below, its own exponentials
//! run on into the opposition surge (the Moon is then nearly eclipsed). Above, each band keeps its
//! value at 97 degrees and follows the V magnitudes of Allen 1976, `0.026 g + 4e-9 g^4`; beyond 150
//! degrees, where those end, it also shrinks with the lit fraction, to nothing at new Moon.
//!
//! Accuracy: 5 to 10 % absolute and 1 % relative (Kieffer & Stone 2005, section 5) within the fitted
//! range, some 20 % beyond. Earthshine and eclipses are not in it.

use std::f64::consts::PI;

use crate::light::spectrum::{Spectrum, interpolate};
use crate::light::sun;
use crate::units::{AU_KM, Angle, MOON_RADIUS_KM, Xyzv};

/// Distance of the Moon that ROLO refers to, kilometres.
const ROLO_DISTANCE_KM: f64 = 384_400.0;
/// Solid angle of the Moon at that distance that ROLO uses, steradians.
const ROLO_SOLID_ANGLE_SR: f64 = 6.4177e-5;
/// Phase angles of the fit, degrees.
const ROLO_LARGEST_PHASE_DEG: f64 = 97.0;
/// Largest phase angle of Allen's magnitudes, degrees.
const ALLEN_LARGEST_PHASE_DEG: f64 = 150.0;

/// How the Moon is lit and seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MoonView {
    /// Angle at the Moon between the Sun and the observer: 0 full, 180 degrees new.
    pub phase: Angle,
    /// Selenographic longitude of the Sun, if known: positive before full Moon. It tells the seas
    /// of the waxing Moon from those of the waning one, a matter of 5 %.
    pub sun_longitude: Option<Angle>,
    /// Selenographic longitude of the observer (libration), east positive.
    pub observer_longitude: Angle,
    /// Selenographic latitude of the observer (libration), north positive.
    pub observer_latitude: Angle,
    /// From the Moon's centre to the Sun's.
    pub sun_distance_km: f64,
    /// From the Moon's centre to the observer.
    pub observer_distance_km: f64,
}

impl MoonView {
    /// At mean distances, without libration, half-way between waxing and waning.
    pub fn at_phase(phase: Angle) -> Self {
        MoonView {
            phase,
            sun_longitude: None,
            observer_longitude: Angle::ZERO,
            observer_latitude: Angle::ZERO,
            sun_distance_km: AU_KM,
            observer_distance_km: ROLO_DISTANCE_KM,
        }
    }
}

/// Spectral irradiance of the moonlit disc outside the air, W m-2 nm-1, on a plane that faces it.
pub fn irradiance(view: &MoonView) -> Spectrum {
    debug_assert!(view.observer_distance_km > MOON_RADIUS_KM && view.sun_distance_km > 0.0);
    let reflectances = reflectances(view);
    let nearness = (ROLO_DISTANCE_KM / view.observer_distance_km).powi(2);
    sun::irradiance(view.sun_distance_km)
        .weighted(|nm| interpolate(&reflectances, nm) * ROLO_SOLID_ANGLE_SR / PI * nearness)
}

/// The disc's equivalent reflectance at a wavelength of 350 to 865 nm, no unit: pi times its mean
/// radiance over the irradiance of a plane that faces the Sun at the Moon.
pub fn disc_reflectance_at(view: &MoonView, wavelength_nm: f64) -> f64 {
    interpolate(&reflectances(view), wavelength_nm)
}

fn reflectances(view: &MoonView) -> Vec<(f64, f64)> {
    BANDS.iter().map(|band| (band.nm, disc_reflectance(band, view))).collect()
}

/// Luminance averaged over the whole disc, lit and dark, cd/m2: what a drawn disc has to average to.
pub fn disc_mean_luminance(view: &MoonView) -> Xyzv {
    let solid_angle_sr = sun::projected_solid_angle_sr(MOON_RADIUS_KM, view.observer_distance_km);
    irradiance(view).xyzv() * (1.0 / solid_angle_sr)
}

/// One band of ROLO: wavelength and coefficients as the paper names them.
struct Band {
    nm: f64,
    a: [f64; 4],
    b: [f64; 3],
    d: [f64; 3],
}

/// The disc's equivalent reflectance: that of a flat white Lambert disc facing Sun and observer is 1.
fn disc_reflectance(band: &Band, view: &MoonView) -> f64 {
    let phase = view.phase.abs();
    let fitted = Angle::from_deg(phase.deg().min(ROLO_LARGEST_PHASE_DEG));
    rolo(band, view, fitted).exp() * beyond_rolo(phase.deg())
}

/// Kieffer & Stone 2005, eq. 10: the natural logarithm of the disc's reflectance.
///
/// The paper prints `c1` to `c4` with latitude and longitude in the other order than the codes that
/// took part in its later comparisons; the choice here is longitude first. It matters by 1 %.
fn rolo(band: &Band, view: &MoonView, phase: Angle) -> f64 {
    const C: [f64; 4] = [0.000_341_15, -0.001_342_5, 0.000_959_06, 0.000_662_29];
    const P: [f64; 4] = [4.060_54, 12.8802, -30.5858, 16.7498];
    let (g, g_deg) = (phase.rad(), phase.deg());
    let sun = view.sun_longitude.unwrap_or(Angle::ZERO).signed().rad();
    // Beyond the fit the odd powers would run away.
    let largest = Angle::from_deg(ROLO_LARGEST_PHASE_DEG).rad();
    let sun = sun.clamp(-largest, largest);
    let (longitude_deg, latitude_deg) =
        (view.observer_longitude.signed().deg(), view.observer_latitude.deg());
    let [a0, a1, a2, a3] = band.a;
    let [b1, b2, b3] = band.b;
    let [d1, d2, d3] = band.d;
    a0 + g * (a1 + g * (a2 + g * a3))
        + sun * (b1 + sun * sun * (b2 + sun * sun * b3))
        + C[0] * longitude_deg
        + C[1] * latitude_deg
        + C[2] * sun * longitude_deg
        + C[3] * sun * latitude_deg
        + d1 * (-g_deg / P[0]).exp()
        + d2 * (-g_deg / P[1]).exp()
        + d3 * ((g_deg - P[2]) / P[3]).cos()
}

/// What remains of the light at 97 degrees; 1 within the range of the fit.
fn beyond_rolo(phase_deg: f64) -> f64 {
    if phase_deg <= ROLO_LARGEST_PHASE_DEG {
        return 1.0;
    }
    let allen = |deg: f64| 0.026 * deg + 4e-9 * deg.powi(4);
    let fainter = allen(phase_deg) - allen(ROLO_LARGEST_PHASE_DEG);
    let lit_fraction = |deg: f64| 0.5 * (1.0 + deg.to_radians().cos());
    let thinning = lit_fraction(phase_deg) / lit_fraction(phase_deg.min(ALLEN_LARGEST_PHASE_DEG));
    10f64.powf(-0.4 * fainter) * thinning
}

/// Kieffer & Stone 2005, table 4, bands up to 870 nm.
#[rustfmt::skip]
const BANDS: [Band; 19] = [
    Band { nm: 350.0, a: [-2.67511, -1.78539, 0.50612, -0.25578], b: [0.03744, 0.00981, -0.00322], d: [0.34185, 0.01441, -0.01602] },
    Band { nm: 355.1, a: [-2.71924, -1.74298, 0.44523, -0.23315], b: [0.03492, 0.01142, -0.00383], d: [0.33875, 0.01612, -0.00996] },
    Band { nm: 405.0, a: [-2.35754, -1.72134, 0.40337, -0.21105], b: [0.03505, 0.01043, -0.00341], d: [0.35235, -0.03818, -6e-05] },
    Band { nm: 412.3, a: [-2.34185, -1.74337, 0.42156, -0.21512], b: [0.03141, 0.01364, -0.00472], d: [0.36591, -0.05902, 0.0008] },
    Band { nm: 414.4, a: [-2.43367, -1.72184, 0.436, -0.22675], b: [0.03474, 0.01188, -0.00422], d: [0.35558, -0.03247, -0.00503] },
    Band { nm: 441.6, a: [-2.31964, -1.72114, 0.37286, -0.19304], b: [0.03736, 0.01545, -0.00559], d: [0.37935, -0.09562, 0.0097] },
    Band { nm: 465.8, a: [-2.35085, -1.66538, 0.41802, -0.22541], b: [0.04274, 0.01127, -0.00439], d: [0.3345, -0.02546, -0.00484] },
    Band { nm: 475.0, a: [-2.28999, -1.6318, 0.36193, -0.20381], b: [0.04007, 0.01216, -0.00437], d: [0.33024, -0.03131, 0.00222] },
    Band { nm: 486.9, a: [-2.23351, -1.68573, 0.37632, -0.19877], b: [0.03881, 0.01566, -0.00555], d: [0.3659, -0.08945, 0.00678] },
    Band { nm: 544.0, a: [-2.13864, -1.60613, 0.27886, -0.16426], b: [0.03833, 0.01189, -0.0039], d: [0.3719, -0.10629, 0.01428] },
    Band { nm: 549.1, a: [-2.10782, -1.66736, 0.41697, -0.22026], b: [0.03451, 0.01452, -0.00517], d: [0.36814, -0.09815, -0.0] },
    Band { nm: 553.8, a: [-2.12504, -1.6597, 0.38409, -0.20655], b: [0.04052, 0.01009, -0.00388], d: [0.37206, -0.10745, 0.00347] },
    Band { nm: 665.1, a: [-1.88914, -1.58096, 0.30477, -0.17908], b: [0.04415, 0.00983, -0.00389], d: [0.37141, -0.13514, 0.01248] },
    Band { nm: 693.1, a: [-1.8941, -1.58509, 0.2808, -0.16427], b: [0.04429, 0.00914, -0.00351], d: [0.39109, -0.17048, 0.01754] },
    Band { nm: 703.6, a: [-1.92103, -1.60151, 0.36924, -0.20567], b: [0.04494, 0.00987, -0.00386], d: [0.37155, -0.13989, 0.00412] },
    Band { nm: 745.3, a: [-1.86896, -1.57522, 0.33712, -0.19415], b: [0.03967, 0.01318, -0.00464], d: [0.36888, -0.14828, 0.00958] },
    Band { nm: 763.7, a: [-1.85258, -1.47181, 0.14377, -0.11589], b: [0.04435, 0.02, -0.00738], d: [0.39126, -0.16957, 0.03053] },
    Band { nm: 774.8, a: [-1.80271, -1.59357, 0.36351, -0.20326], b: [0.0471, 0.01196, -0.00476], d: [0.36908, -0.16182, 0.0083] },
    Band { nm: 865.3, a: [-1.74561, -1.58482, 0.35009, -0.19569], b: [0.04142, 0.01612, -0.0055], d: [0.392, -0.18837, 0.00978] },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moonlight_has_its_published_illuminance() {
        // Computed from the same coefficients by another program: lux, S/P.
        for (phase_deg, lx, s_p) in [
            (1.0, 0.3903, 2.130),
            (3.0, 0.3342, 2.127),
            (30.0, 0.1488, 2.084),
            (60.0, 0.0708, 2.064),
            (90.0, 0.0287, 2.055),
            (97.0, 0.0223, 2.053),
        ] {
            let light = irradiance(&MoonView::at_phase(Angle::from_deg(phase_deg))).xyzv();
            assert!((light.y / lx - 1.0).abs() < 5e-3, "{phase_deg}°: {} lx", light.y);
            assert!((light.v / light.y / s_p - 1.0).abs() < 5e-3, "{phase_deg}°");
        }
        // Magnitude at full Moon, within the spread of published values.
        let full = MoonView::at_phase(Angle::from_deg(2.0));
        let lx = crate::units::Illuminance::from_lx(irradiance(&full).xyzv().y);
        assert!((-12.95..-12.65).contains(&lx.magnitude().0), "{:?}", lx.magnitude());
    }

    #[test]
    fn the_crescent_runs_on_to_nothing() {
        let at = |deg: f64| irradiance(&MoonView::at_phase(Angle::from_deg(deg))).xyzv().y;
        for edge_deg in [97.0, 150.0] {
            assert!((at(edge_deg - 1e-6) / at(edge_deg + 1e-6) - 1.0).abs() < 1e-6);
        }
        for step in 0..180 {
            assert!(at(f64::from(step)) > at(f64::from(step + 1)), "{step}°");
        }
        assert_eq!(at(180.0), 0.0);
        // Allen's table (1963), magnitudes fainter than at 90 degrees: 1.30 at 120, 3.27 at 150 and
        // 4.87 at 160.
        for (deg, magnitudes) in [(120.0, 1.30), (150.0, 3.27), (160.0, 4.87)] {
            let fainter = 2.5 * (at(90.0) / at(deg)).log10();
            assert!((fainter - magnitudes).abs() < 0.2, "{deg}°: {fainter}");
        }
    }

    #[test]
    fn distances_and_librations_count() {
        let mean = MoonView::at_phase(Angle::from_deg(40.0));
        let near = MoonView { observer_distance_km: 0.5 * ROLO_DISTANCE_KM, ..mean };
        assert!((irradiance(&near).xyzv().y / irradiance(&mean).xyzv().y - 4.0).abs() < 1e-9);
        // The surface is as bright from near as from far.
        let (a, b) = (disc_mean_luminance(&near).y, disc_mean_luminance(&mean).y);
        assert!((a / b - 1.0).abs() < 1e-9);
        // Full Moon: 5000 cd/m2 or so.
        let full = disc_mean_luminance(&MoonView::at_phase(Angle::from_deg(3.0))).y;
        assert!((5000.0..5500.0).contains(&full), "{full}");
        // The waxing Moon shows fewer dark seas than the waning one.
        let sided = |deg| MoonView { sun_longitude: Some(Angle::from_deg(deg)), ..mean };
        let ratio = irradiance(&sided(40.0)).xyzv().y / irradiance(&sided(-40.0)).xyzv().y;
        assert!((1.03..1.10).contains(&ratio), "{ratio}");
        let turned = MoonView { observer_longitude: Angle::from_deg(7.0), ..mean };
        let ratio = irradiance(&turned).xyzv().y / irradiance(&mean).xyzv().y;
        assert!((ratio - (0.000_341_15f64 * 7.0).exp()).abs() < 1e-9, "{ratio}");
    }
}

//! Saturn's rings: where they lie, what they hide, how bright they are beside the globe.
//!
//! *Theory.* A flat, thick layer of particles that scatter once (Chandrasekhar 1960, *Radiative
//! Transfer*, section 44): with the cosines `mu0` of incidence and `mu` of emission and an optical depth
//! `tau`, the lit side has `I/F = 2 a mu0 / (mu + mu0) (1 - exp(-tau (1/mu + 1/mu0)))`, where `a` is what
//! an opaque ring has when `mu = mu0`. On the dark side what comes through is
//! `2 a mu0 / (mu - mu0) (exp(-tau/mu) - exp(-tau/mu0))`. Phase: the rings' own part of eq. 10 of
//! Mallama & Hilton 2018 (see [`crate::light::planets`]), a slope and a surge at opposition.
//!
//! *Data.* Radii: NASA's Saturnian Rings Fact Sheet (Williams, NSSDCA), Encke's gap Colwell et al.
//! 2009 in *Saturn from Cassini-Huygens*, chapter 13 (recalled). Optical depths: means of the ranges
//! in the same two. `a` is fitted, so that globe and rings together have the magnitudes of Mallama & Hilton.
//!
//! *Omitted.* Ringlets and spokes, light scattered more than once, light of the globe on the rings,
//! the D, F, G and E rings, wakes.
//!
//! *Accuracy.* Globe and rings together over the globe alone, against eqs. 10 and 11 of Mallama &
//! Hilton: within 8 % at tilts of 10 to 26 degrees and 13 % at 5 degrees, phases of 0 to 6 degrees
//! (tested). The dark side is right in kind only.

use crate::frame::{Dir, Pos};
use crate::units::Angle;

/// Radius of Saturn at its equator, kilometres, at one bar (Archinal et al. 2018, table 4).
pub const SATURN_EQUATORIAL_RADIUS_KM: f64 = 60_268.0;
/// Radius of Saturn at its poles, kilometres (same).
pub const SATURN_POLAR_RADIUS_KM: f64 = 54_364.0;
/// Mean I/F of the disc of the globe at full phase: its geometric albedo in V (Mallama et al. 2017,
/// *Icarus* 282, 19).
pub const GLOBE_ALBEDO: f64 = 0.499;

/// A ring of even make.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    pub name: &'static str,
    /// From the centre of Saturn.
    pub inner_km: f64,
    pub outer_km: f64,
    /// Straight through.
    pub optical_depth: f64,
    /// I/F if it were opaque, lit and seen at the same angle, some degrees from opposition.
    pub reflectance: f64,
}

const fn ring(
    name: &'static str,
    edges_km: [f64; 2],
    optical_depth: f64,
    reflectance: f64,
) -> Ring {
    Ring { name, inner_km: edges_km[0], outer_km: edges_km[1], optical_depth, reflectance }
}

/// From within. What lies between two of them is empty.
pub const RINGS: [Ring; 6] = [
    ring("C", [74_658.0, 91_975.0], 0.1, 0.10),
    ring("B, inner", [91_975.0, 104_500.0], 1.0, 0.47),
    ring("B, outer", [104_500.0, 117_507.0], 2.5, 0.53),
    ring("Cassini's division", [117_507.0, 122_340.0], 0.12, 0.21),
    ring("A, inside Encke's gap", [122_340.0, 133_423.0], 0.55, 0.425),
    ring("A, outside Encke's gap", [133_745.0, 136_780.0], 0.55, 0.425),
];

/// How far they reach, in radii of the equator.
pub const REACH: f64 = RINGS[RINGS.len() - 1].outer_km / SATURN_EQUATORIAL_RADIUS_KM;

/// How the rings are lit and seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingView {
    /// Height of the Sun over the plane of the rings, north positive.
    pub sun_latitude: Angle,
    /// Height of the observer over it, likewise.
    pub observer_latitude: Angle,
    /// Angle Sun, Saturn, observer.
    pub phase: Angle,
}

/// The ring at a distance from the centre of Saturn, if there is one.
pub fn ring_at(radius_km: f64) -> Option<&'static Ring> {
    RINGS.iter().find(|ring| (ring.inner_km..ring.outer_km).contains(&radius_km))
}

/// Part of the light that passes the rings at a distance from the centre of Saturn, on a way at this
/// height over their plane.
pub fn transmittance(radius_km: f64, latitude: Angle) -> f64 {
    let sin = latitude.sin().abs();
    match ring_at(radius_km) {
        Some(ring) if sin > 0.0 => (-ring.optical_depth / sin).exp(),
        Some(_) => 0.0,
        None => 1.0,
    }
}

/// I/F of the rings at a distance from the centre of Saturn, out of the shadow: pi times the radiance
/// over the irradiance of the Sun on a plane that faces it. The globe's disc has [`GLOBE_ALBEDO`].
pub fn ring_brightness(radius_km: f64, view: &RingView) -> f64 {
    let Some(ring) = ring_at(radius_km) else { return 0.0 };
    let (sun, observer) = (view.sun_latitude.sin(), view.observer_latitude.sin());
    let (mu0, mu) = (sun.abs(), observer.abs());
    if mu0 <= 0.0 || mu <= 0.0 {
        return 0.0;
    }
    let tau = ring.optical_depth;
    let scattered = if sun * observer > 0.0 {
        mu0 / (mu + mu0) * (1.0 - (-tau * (1.0 / mu + 1.0 / mu0)).exp())
    } else if (mu - mu0).abs() > 1e-6 * mu0 {
        mu0 / (mu - mu0) * ((-tau / mu).exp() - (-tau / mu0).exp())
    } else {
        // The limit where both are the same.
        tau / mu * (-tau / mu).exp()
    };
    2.0 * ring.reflectance * scattered * phase_factor(view.phase)
}

/// Fading with the phase, and the surge at opposition: 1.4 at zero.
fn phase_factor(phase: Angle) -> f64 {
    const SURGE: f64 = 0.4;
    let deg = phase.signed().abs().deg();
    (1.0 + SURGE * (-2.25 * deg).exp()) * 10f64.powf(-0.4 * 0.026 * deg)
}

/// Whether the globe shades a place in the rings, or anywhere else about Saturn; the Sun is taken as a
/// point far away.
pub fn globe_shades<F>(place: Pos<F>, to_sun: Dir<F>, pole: Dir<F>) -> bool {
    // Stretched along the axis the globe is a ball.
    let pole = pole.vector();
    let stretch = SATURN_EQUATORIAL_RADIUS_KM / SATURN_POLAR_RADIUS_KM - 1.0;
    let round = |vector: glam::DVec3| vector + pole * (vector.dot(pole) * stretch);
    let (place, to_sun) = (round(place.km()), round(to_sun.vector()).normalize());
    let along = place.dot(to_sun);
    along < 0.0 && (place - to_sun * along).length() < SATURN_EQUATORIAL_RADIUS_KM
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::frame::Icrs;

    fn view(tilt_deg: f64, phase_deg: f64) -> RingView {
        RingView {
            sun_latitude: Angle::from_deg(tilt_deg),
            observer_latitude: Angle::from_deg(tilt_deg),
            phase: Angle::from_deg(phase_deg),
        }
    }

    #[test]
    fn rings_lie_in_order_and_b_is_the_brightest() {
        for pair in RINGS.windows(2) {
            assert!(pair[0].outer_km <= pair[1].inner_km, "{} {}", pair[0].name, pair[1].name);
        }
        let at = |radius_km: f64| ring_brightness(radius_km, &view(20.0, 3.0));
        let [c, b, division, a] = [85e3, 110e3, 120e3, 130e3].map(at);
        assert!(
            b > a && a > 3.0 * division && division > 0.0 && c < 0.25 * b,
            "{c} {b} {division} {a}"
        );
        for empty in [70e3, 133.6e3, 137e3] {
            assert_eq!(at(empty), 0.0);
            assert_eq!(transmittance(empty, Angle::from_deg(1.0)), 1.0);
        }
        // The globe is seen through C, not through B.
        assert!(transmittance(85e3, Angle::from_deg(20.0)) > 0.7);
        assert!(transmittance(110e3, Angle::from_deg(20.0)) < 1e-3);
    }

    #[test]
    fn the_dark_side_shows_thin_rings_alone() {
        let dark = |radius_km: f64, tilt_deg: f64| {
            let view =
                RingView { sun_latitude: Angle::from_deg(-tilt_deg), ..view(tilt_deg + 1e-5, 3.0) };
            ring_brightness(radius_km, &view)
        };
        assert!(dark(110e3, 10.0) < 0.01 * dark(85e3, 10.0));
        let lit = ring_brightness(85e3, &view(10.0, 3.0));
        assert!(dark(85e3, 10.0) < lit && dark(85e3, 10.0) > 0.3 * lit);
        // The limit of equal angles is where its neighbours are.
        let same = RingView { sun_latitude: Angle::from_deg(-10.0), ..view(10.0, 3.0) };
        assert!((ring_brightness(85e3, &same) / dark(85e3, 10.0) - 1.0).abs() < 1e-4);
        assert_eq!(ring_brightness(85e3, &view(0.0, 3.0)), 0.0);
    }

    #[test]
    fn the_globe_shades_what_is_behind_it() {
        let (to_sun, pole) = (DVec3::X, DVec3::Z);
        let shaded = |place: DVec3| {
            let [to_sun, pole] = [to_sun, pole].map(Dir::<Icrs>::from_vector);
            globe_shades(Pos::from_km(place), to_sun, pole)
        };
        assert!(shaded(DVec3::new(-1e5, 6e4, 0.0)) && !shaded(DVec3::new(1e5, 6e4, 0.0)));
        assert!(!shaded(DVec3::new(-1e5, 6.1e4, 0.0)));
        assert!(shaded(DVec3::new(-1e5, 0.0, 5.4e4)) && !shaded(DVec3::new(-1e5, 0.0, 5.5e4)));
    }

    /// Light of globe and rings in units of the light of the bare globe, Sun and observer at one
    /// latitude: the globe as Lambert's, on a grid of `CELLS` a side.
    fn globe_and_rings(tilt_deg: f64, phase_deg: f64) -> f64 {
        const CELLS: i32 = 320;
        let view = view(tilt_deg, phase_deg);
        let (sin, cos) = view.sun_latitude.sin_cos();
        let (toward, pole) = (DVec3::new(cos, 0.0, sin), DVec3::Z);
        let (right, up) = (DVec3::Y, DVec3::new(-sin, 0.0, cos));
        let ratio = SATURN_EQUATORIAL_RADIUS_KM / SATURN_POLAR_RADIUS_KM;
        let round = |v: DVec3| DVec3::new(v.x, v.y, v.z * ratio);
        let (mut bare, mut both) = (0.0, 0.0);
        for (i, j) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j))) {
            let at = |k: i32| ((f64::from(k) + 0.5) / f64::from(CELLS) * 2.0 - 1.0) * 1.38e5;
            let start = right * at(i) + up * at(j);
            // Where the ray meets the globe and the plane of the rings, towards the observer.
            let (p, d) = (round(start), round(toward));
            let (a, b) = (d.dot(d), p.dot(d));
            let square = b * b - a * (p.dot(p) - SATURN_EQUATORIAL_RADIUS_KM.powi(2));
            let on_globe = (square > 0.0).then(|| (square.sqrt() - b) / a);
            let on_plane = -start.z / toward.z;
            let ring_place = start + toward * on_plane;
            let radius_km = DVec2::new(ring_place.x, ring_place.y).length();
            let is_before = on_globe.is_none_or(|globe| on_plane > globe);
            let [sun, axis] = [toward, pole].map(Dir::<Icrs>::from_vector);
            if is_before && !globe_shades(Pos::from_km(ring_place), sun, axis) {
                both += ring_brightness(radius_km, &view);
            }
            let Some(globe) = on_globe else { continue };
            let place = start + toward * globe;
            let normal = DVec3::new(place.x, place.y, place.z * ratio * ratio).normalize();
            // A Lambert ball has two thirds of its brightest point as a mean.
            let lambert = 1.5 * GLOBE_ALBEDO * normal.dot(toward).max(0.0);
            bare += lambert;
            // Sun and observer look along one line: what hides also shades.
            let free = if is_before { transmittance(radius_km, view.sun_latitude) } else { 1.0 };
            both += lambert * free * free;
        }
        both / bare
    }

    #[test]
    fn globe_and_rings_have_the_magnitudes_of_mallama_and_hilton() {
        for tilt_deg in [5.0f64, 10.0, 20.0, 26.0] {
            for phase_deg in [0.0f64, 1.0, 3.0, 6.0] {
                let sin = tilt_deg.to_radians().sin();
                let with_rings = -8.914 - 1.825 * sin + 0.026 * phase_deg
                    - 0.378 * sin * (-2.25 * phase_deg).exp();
                let globe = -8.95 - 3.7e-4 * phase_deg + 6.16e-4 * phase_deg * phase_deg;
                let published = 10f64.powf(-0.4 * (with_rings - globe));
                let ours = globe_and_rings(tilt_deg, phase_deg);
                let within = if tilt_deg < 10.0 { 0.13 } else { 0.08 };
                assert!(
                    (ours / published - 1.0).abs() < within,
                    "{tilt_deg}° {phase_deg}°: {ours} {published}"
                );
            }
        }
    }
}

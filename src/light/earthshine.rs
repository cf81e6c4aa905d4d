//! Earthshine: the light of the Earth on the Moon.
//!
//! *Brightness.* The level is that of Robinson 2025 (arXiv 2507.22258): a geometric albedo of 0.242 at
//! 400 to 700 nm, from spacecraft and earthshine together, and 30 to 40 % under what used to be quoted.
//! The shape is that of Mallama & Hilton 2018, *Astronomy and Computing* 25, 10, eq. 5: magnitudes
//! grow by `-1.060e-3 a + 2.054e-4 a^2`, `a` the phase angle in degrees up to 170; beyond, the light
//! shrinks with the lit crescent, to nothing. Their own level, an albedo of 0.434, is left: with this
//! shape the Earth would send back 57 % of all sunlight, where satellites find 30.
//!
//! Earthshine agrees. Spherical albedo: 0.30 in V within 10 % (Franklin 1967, *J. Geophys. Res.* 72,
//! 2963), 0.294 (Robinson 2025), 0.317 here. Apparent albedo, over a white sphere of Lambert at the same
//! phase: 0.297 on the mean (Qiu et al. 2003 and Pallé et al. 2003, *J. Geophys. Res.* 108, 4709 and
//! 4710), 0.294 here, 0.25 to 0.36 by phase.
//!
//! The full Earth of mean distance gives the Moon 8.9 lx (magnitude -16.4); Allen's albedo of 0.367 gives
//! 13 lx (-16.8), round numbers 20 lx (-17.7). Clouds change it by 10 % from night to night and 15 to 20 %
//! with the seasons (Goode et al. 2001, *Geophys. Res. Lett.* 28, 1671; Pallé et al. 2003): left out.
//!
//! *Colour.* The molecules of the air make it bluer than sunlight: geometric albedos of about 0.69,
//! 0.51, 0.43, 0.39 and 0.40 in U, B, V, R and I (Mallama, Krobusek & Pavlov 2017, *Icarus* 282, 19;
//! recalled), straight between the wavelengths of the bands and scaled to the brightness. The same at
//! every phase; what it does to the Moon is redder by the albedo of the Moon. Bluer than sunlight by 0.17
//! in B - V; Thejll et al. 2014, *Astronomy & Astrophysics* 563, A38, find 0.21, Franklin 0.20. Against
//! the bright side of the Moon the dark side is bluer by 0.27, as ROLO makes crescents redder than the
//! full Moon; Thejll et al. saw 0.15 in one night.
//!
//! *Measured.* Mean radiance of the dark side at phase angles of the Moon of 150, 120, 90 and 60
//! degrees: 13.8, 14.3, 15.2 and 16.4 mag/arcsec2 (12 to 17 seen: Montañés-Rodríguez, Pallé & Goode
//! 2007, *Astronomical Journal* 134, 1145), fainter than the bright side by 7.4, 8.5, 10.0 and 11.8
//! magnitudes: lost in the glare of the bright side from half Moon on.
//!
//! *Angles.* The Earth's phase angle seen from the Moon is 180 degrees less the Moon's seen from the
//! Earth's centre, but for the Sun's distance ([`EarthView`] takes the real angle). The Earth lights
//! the near side nearly along the line of sight: the surface has its opposition surge, no shadows, and no
//! limb darkening.

use crate::light::moon::{self, MoonView};
use crate::light::spectrum::{Spectrum, interpolate};
use crate::light::sun;
use crate::units::{AU_KM, Angle, Illuminance, Magnitude};

/// Largest phase angle of the formula, degrees.
const LARGEST_PHASE_DEG: f64 = 170.0;
/// Geometric albedo in photopic light.
const GEOMETRIC_ALBEDO: f64 = 0.242;
/// Mean radius of the Earth, kilometres.
const RADIUS_KM: f64 = 6371.0;
/// Illuminance of the Sun at one astronomical unit, lux.
const SUN_LX: f64 = 133_500.0;
/// Magnitude of the Sun that goes with the magnitudes of the planets (Mallama & Hilton 2018).
const SUN_MAGNITUDE: f64 = -26.76;

/// Wavelength in nanometres and geometric albedo, for the colour alone.
const ALBEDOS: [(f64, f64); 6] =
    [(300.0, 0.75), (366.0, 0.688), (440.0, 0.512), (553.0, 0.434), (669.0, 0.392), (871.0, 0.396)];

/// The phase angle of the Moon at which ROLO begins: the surge within it is not measured.
const LEAST_PHASE: Angle = Angle::from_deg(1.55);

/// How the Earth is seen from the Moon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EarthView {
    /// Angle at the Earth between the Sun and the Moon: 0 full Earth, 180 degrees new.
    pub phase: Angle,
    /// From the Earth's centre to the Moon's, kilometres.
    pub moon_distance_km: f64,
    /// From the Earth to the Sun, kilometres.
    pub sun_distance_km: f64,
}

/// Spectral irradiance at the Moon, W m-2 nm-1, on a plane that faces the Earth.
pub fn irradiance(view: &EarthView) -> Spectrum {
    let colour = sun::irradiance_1au().weighted(|nm| interpolate(&ALBEDOS, nm));
    let lx = SUN_LX
        * 10f64.powf(-0.4 * (unit_magnitude(view.phase).0 - SUN_MAGNITUDE))
        * (AU_KM / view.moon_distance_km).powi(2)
        * (AU_KM / view.sun_distance_km).powi(2);
    colour.scaled_to_photopic(lx)
}

/// Magnitude of the Earth in V at one astronomical unit from the Sun and from the observer; infinite
/// at 180 degrees.
pub fn unit_magnitude(phase: Angle) -> Magnitude {
    let deg = phase.abs().deg().min(180.0);
    let full = SUN_MAGNITUDE - 2.5 * (GEOMETRIC_ALBEDO * (RADIUS_KM / AU_KM).powi(2)).log10();
    let law = |deg: f64| full + deg * (-1.060e-3 + deg * 2.054e-4);
    let lit = |deg: f64| 0.5 * (1.0 + deg.to_radians().cos());
    let fitted = deg.min(LARGEST_PHASE_DEG);
    Magnitude(law(fitted) - 2.5 * (lit(deg) / lit(fitted)).log10())
}

/// Spectral irradiance at an observer on the Earth by the earthlit disc, W m-2 nm-1, outside the air.
///
/// The disc reflects as the full Moon does, at the smallest phase angle that is measured. The sunlit
/// part is outshone by sunlight; it is counted all the same.
pub fn disc_irradiance(view: &MoonView, earth: &EarthView) -> Spectrum {
    let full = MoonView { phase: LEAST_PHASE, sun_longitude: None, ..*view };
    let sunlight = sun::irradiance(view.sun_distance_km);
    let earthlight = irradiance(earth);
    moon::irradiance(&full).weighted(|nm| match sunlight.at_nm(nm) {
        sun if sun > 0.0 => earthlight.at_nm(nm) / sun,
        _ => 0.0,
    })
}

/// Illuminance at the Moon by the Earth, and its magnitude there.
pub fn illuminance(view: &EarthView) -> (Illuminance, Magnitude) {
    let light = Illuminance::from_lx(irradiance(view).xyzv().y);
    (light, light.magnitude())
}

//! Eclipses of the Sun as light: what the Moon leaves of it for one observer.
//!
//! *Theory.* Two circles in the sky. The Sun is darkened towards its limb by the law of
//! [`crate::light::sun`], so that a crescent has less light than its area and is redder than the whole
//! disc. The light of a ring of the Sun counts as far as it is not within the Moon; the rings are
//! crowded towards the limb by taking them in the cosine of emergence. When little is left the
//! [corona](crate::light::corona) is added.
//!
//! *The sky.* What is told here is the light at the observer. While more than 0.3 of it is left the sky
//! that is drawn is that of a Sun which is as faint everywhere: right to a few per cent, as the share
//! changes by 1 % over 35 km across the path. In deeper phases each part of the air has its own share
//! ([`crate::light::moon_shadow`]), and in totality the sky is lit from outside the shadow, a hundred
//! kilometres away: [`crate::air::scattering::shaded`].
//!
//! *Left out.* Mountains and valleys of the Moon's limb, and with them Baily's beads: the Moon is a
//! circle of its mean radius, [`crate::units::MOON_RADIUS_KM`], and totality some seconds longer or
//! shorter than [`crate::almanac::eclipse`] has it.
//!
//! *Accuracy.* 0.02 % of the Sun (tested against the area of two circles without limb darkening).

use std::f64::consts::PI;

use crate::light::corona;
use crate::light::earth_shadow::arc;
use crate::light::spectrum::{Spectrum, Transmittance, wavelength_nm};
use crate::light::sun::{self, LimbDarkening};
use crate::sky::SkyState;
use crate::units::Angle;

/// Rings of the Sun between those where the Moon's limb begins and ends.
const RINGS: usize = 96;

/// The Sun with the Moon before it, as one observer sees them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoveredSun {
    /// Between centre and limb.
    pub sun_radius: Angle,
    pub moon_radius: Angle,
    /// Between the centres.
    pub separation: Angle,
}

impl CoveredSun {
    pub fn of(sky: &SkyState) -> CoveredSun {
        let (sun, moon) = (&sky.sun, &sky.moon.state);
        CoveredSun {
            sun_radius: sun.angular_radius,
            moon_radius: moon.angular_radius,
            separation: sun.dir.separation(moon.dir),
        }
    }

    /// Whether the discs do not touch.
    pub fn is_whole(&self) -> bool {
        self.separation >= self.sun_radius + self.moon_radius
    }

    /// Whether nothing of the disc is seen.
    pub fn is_total(&self) -> bool {
        self.separation + self.sun_radius <= self.moon_radius
    }

    /// Part of the Sun's diameter that is covered, on the line through both centres: above 1 in a total
    /// eclipse, negative without any.
    pub fn magnitude(&self) -> f64 {
        (self.sun_radius + self.moon_radius - self.separation).rad() / (self.sun_radius * 2.0).rad()
    }

    /// Part of the area of the Sun that is covered, 0 to 1.
    pub fn obscuration(&self) -> f64 {
        (1.0 - self.open_powers()[0]).clamp(0.0, 1.0)
    }

    /// What is left of the light of the disc, by wavelength.
    pub fn visible(&self) -> Transmittance {
        if self.is_whole() {
            return Transmittance::CLEAR;
        }
        let open = self.open_powers();
        Transmittance::from_fractions(std::array::from_fn(|node: usize| {
            let law = LimbDarkening::at_nm(wavelength_nm(node));
            let left: f64 = law.coefficients().iter().zip(open).map(|(a, part)| a * part).sum();
            (left / law.disc_mean()).clamp(0.0, 1.0)
        }))
    }

    /// Spectral irradiance by the rest of the disc and by the corona, outside the air, W m-2 nm-1.
    pub fn irradiance(&self, sun_distance_km: f64) -> Spectrum {
        let disc = sun::irradiance(sun_distance_km) * self.visible();
        disc + corona::irradiance(sun_distance_km) * self.visible_corona()
    }

    /// Part of the light of the corona that is not behind the Moon, 0 to 1.
    pub fn visible_corona(&self) -> f64 {
        let sun = self.sun_radius.rad();
        corona::visible_share(self.moon_radius.rad() / sun, self.separation.rad() / sun)
    }

    /// Means over the disc of the powers 0 to 5 of the cosine of emergence, what is hidden counted as
    /// nothing.
    fn open_powers(&self) -> [f64; 6] {
        let sun = self.sun_radius.rad();
        let (moon, apart) = (self.moon_radius.rad() / sun, self.separation.rad() / sun);
        // Between the rings that touch the Moon's limb what is open is smooth.
        let mu_at = |radii: f64| (1.0 - radii * radii).max(0.0).sqrt();
        let ends = [0.0, mu_at(moon + apart), mu_at((moon - apart).abs()), 1.0];
        let mut sums = [0.0; 6];
        for piece in ends.windows(2).filter(|piece| piece[1] > piece[0]) {
            let (middle, half) = (0.5 * (piece[1] + piece[0]), 0.5 * (piece[1] - piece[0]));
            for ring in 0..RINGS {
                // Crowded towards the ends, where it goes as a root.
                let (sin, cos) = ((ring as f64 + 0.5) / RINGS as f64 * PI).sin_cos();
                let mu = middle - half * cos;
                let open = 1.0 - arc((1.0 - mu * mu).sqrt(), apart, moon) / PI;
                let mut part = 2.0 * mu * half * sin * PI / RINGS as f64 * open;
                for sum in &mut sums {
                    *sum += part;
                    part *= mu;
                }
            }
        }
        sums
    }
}

//! The altitudes at which things are said to rise, to set, and to leave the night dark.
//!
//! The conventions of almanacs: light near the horizon is raised by 34', the Sun has a radius of 16',
//! the Moon the one she has at that moment, planets and stars have none. Altitudes are airless and
//! topocentric, of the centre; the horizon is that of the sea, at the height of the eye.
//!
//! Where the horizon is told to stand at another apparent altitude `h`, the refraction there is that
//! of Bennett 1982, *Journal of Navigation* 35, 255, eq. B: `cot(h + 7.31 / (h + 4.4))` minutes of arc
//! with `h` in degrees, scaled to be 34' on the horizon: within 0.3' of tables.

use crate::almanac::event::Target;
use crate::ephemeris::Body;
use crate::units::{Angle, MOON_RADIUS_KM};

/// How far light at the horizon is raised.
pub const HORIZON_REFRACTION: Angle = Angle::from_arcmin(34.0);
/// The radius of the Sun in the definition of sunrise.
pub const SUN_SEMIDIAMETER: Angle = Angle::from_arcmin(16.0);
/// Apparent altitudes at which a skyline may stand, degrees: Bennett's formula ends below.
pub const SKYLINE_RANGE_DEG: std::ops::RangeInclusive<f64> = -3.5..=80.0;

/// Where the limits are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Apparent altitude of the horizon, the same all around; zero for the sea from its shore.
    pub skyline: Angle,
    /// The night is dark while the centre of the Sun is below this airless altitude.
    pub dark_sun_altitude: Angle,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits { skyline: Angle::ZERO, dark_sun_altitude: Angle::from_deg(-18.0) }
    }
}

impl Limits {
    /// Airless altitude of the centre of a target when it rises or sets.
    pub fn altitude(&self, target: &Target, distance_km: f64) -> Angle {
        let semidiameter = match target {
            Target::Body(Body::Sun) => SUN_SEMIDIAMETER,
            Target::Body(Body::Moon) => Angle::from_rad((MOON_RADIUS_KM / distance_km).asin()),
            _ => Angle::ZERO,
        };
        self.skyline - refraction(self.skyline) - semidiameter
    }
}

/// How far light is raised that is seen at an altitude.
fn refraction(apparent: Angle) -> Angle {
    if apparent == Angle::ZERO {
        return HORIZON_REFRACTION;
    }
    let bennett = |deg: f64| 1.0 / Angle::from_deg(deg + 7.31 / (deg + 4.4)).tan();
    HORIZON_REFRACTION * (bennett(apparent.deg()) / bennett(0.0))
}

/// Apparent altitude of the horizon of the sea from a height above it, refraction included: 1.76'
/// times the root of the height in metres (*The Nautical Almanac*, altitude correction tables).
pub fn sea_horizon(height_m: f64) -> Angle {
    -Angle::from_arcmin(1.76 * height_m.max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limits_are_those_of_almanacs() {
        let limits = Limits::default();
        let arcmin = |body, km| limits.altitude(&Target::Body(body), km).arcmin();
        assert!((arcmin(Body::Sun, 1.5e8) + 50.0).abs() < 1e-12);
        assert!((arcmin(Body::Mars, 1e8) + 34.0).abs() < 1e-12);
        // 1737.4 km at 380000 km: 15.718'.
        assert!((arcmin(Body::Moon, 380_000.0) + 49.718).abs() < 1e-3);
    }

    #[test]
    fn hills_and_heights_move_the_horizon() {
        // Refraction at 1 degree is 24', at 10 degrees 5.3' (The Nautical Almanac, table A2).
        assert!((refraction(Angle::from_deg(1.0)).arcmin() - 24.3).abs() < 0.5);
        assert!((refraction(Angle::from_deg(10.0)).arcmin() - 5.3).abs() < 0.1);
        assert!((refraction(Angle::from_arcsec(0.01)) - HORIZON_REFRACTION).abs().arcsec() < 0.1);
        assert!((sea_horizon(100.0).arcmin() + 17.6).abs() < 1e-12);
        assert_eq!(sea_horizon(-400.0).abs(), Angle::ZERO);
    }
}

//! Places on the Moon, as they stand in the sky.

use glam::DVec3;

use crate::frame::{Dir, Horizon, MoonFixed};
use crate::units::{Angle, MOON_RADIUS_KM};

use super::MoonState;

/// A place on the Moon as one observer sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Topocentric, with aberration, without air.
    pub dir: Dir<Horizon>,
    /// How high the observer stands over it: below zero it is on the far side.
    pub observer_altitude: Angle,
    /// How high the centre of the Sun stands over it.
    pub sun_altitude: Angle,
}

impl MoonState {
    /// A place on the sphere of 1737.4 km by selenographic longitude (east positive) and latitude,
    /// mean Earth and mean rotation. Elevation is left out: 0.1 degrees on the Moon at its most, on
    /// the limb.
    pub fn surface_point(&self, longitude: Angle, latitude: Angle) -> SurfacePoint {
        let normal: Dir<MoonFixed> = Dir::from_spherical(longitude, latitude);
        let up = (self.horizon_from_moon_fixed * normal).vector();
        let place: DVec3 = self.state.dir.vector() * self.state.distance_km + up * MOON_RADIUS_KM;
        let dir: Dir<Horizon> = Dir::from_vector(place);
        let to_sun: Dir<MoonFixed> =
            Dir::from_spherical(self.subsolar.longitude, self.subsolar.latitude);
        let altitude = |cos: f64| Angle::from_rad(cos.clamp(-1.0, 1.0).asin());
        SurfacePoint {
            dir,
            observer_altitude: altitude(-up.dot(dir.vector())),
            sun_altitude: altitude(normal.dot(to_sun)),
        }
    }
}

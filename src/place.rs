//! Places on the Earth: geodetic coordinates, their position and their local axes.

pub mod gazetteer;

use chrono_tz::Tz;
use glam::DVec3;
use thiserror::Error;

use crate::frame::{Horizon, Itrs, Pos, Rot, turn_axes_x, turn_axes_z};
use crate::units::{Angle, EARTH_EQUATORIAL_RADIUS_KM};

/// Flattening of the WGS84 ellipsoid (NIMA TR8350.2, table 3.1).
pub const WGS84_FLATTENING: f64 = 1.0 / 298.257_223_563;

/// Heights at which the air tables and the refraction formula hold.
pub const HEIGHT_RANGE_M: std::ops::RangeInclusive<f64> = -430.0..=100_000.0;

/// What can be wrong with a place.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlaceError {
    #[error("latitude {0}° is outside -90° to +90°; give degrees, north positive")]
    Latitude(f64),
    #[error("longitude {0}° is outside -180° to +360°; give degrees, east positive")]
    Longitude(f64),
    #[error(
        "height {0} m is outside {low} to {high} m; give metres above sea level",
        low = HEIGHT_RANGE_M.start(),
        high = HEIGHT_RANGE_M.end()
    )]
    Height(f64),
}

/// A place on the Earth: geodetic latitude and longitude on WGS84, and height above it.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// What people call it, if it has a name.
    pub name: Option<String>,
    /// North positive.
    pub latitude: Angle,
    /// East positive, in `[-180, 180)` degrees.
    pub longitude: Angle,
    pub height_m: f64,
    /// What the clocks on the wall follow there, if known.
    pub time_zone: Option<Tz>,
}

impl Place {
    /// A place without a name. Degrees, north and east positive; metres above the ellipsoid.
    pub fn new(latitude_deg: f64, longitude_deg: f64, height_m: f64) -> Result<Place, PlaceError> {
        // Written so that NaN, which is in no range, is refused too.
        if !(-90.0..=90.0).contains(&latitude_deg) {
            return Err(PlaceError::Latitude(latitude_deg));
        }
        if !(-180.0..=360.0).contains(&longitude_deg) {
            return Err(PlaceError::Longitude(longitude_deg));
        }
        if !HEIGHT_RANGE_M.contains(&height_m) {
            return Err(PlaceError::Height(height_m));
        }
        Ok(Place {
            name: None,
            latitude: Angle::from_deg(latitude_deg),
            longitude: Angle::from_deg(longitude_deg).signed(),
            height_m,
            time_zone: None,
        })
    }

    /// The position in axes that turn with the Earth.
    pub fn itrs(&self) -> Pos<Itrs> {
        let (sin_lat, cos_lat) = self.latitude.sin_cos();
        let (sin_lon, cos_lon) = self.longitude.sin_cos();
        let axis_ratio_squared = (1.0 - WGS84_FLATTENING).powi(2);
        // Radius of curvature in the prime vertical.
        let n_km = EARTH_EQUATORIAL_RADIUS_KM
            / (cos_lat * cos_lat + axis_ratio_squared * sin_lat * sin_lat).sqrt();
        let height_km = self.height_m / 1000.0;
        Pos::from_km(DVec3::new(
            (n_km + height_km) * cos_lat * cos_lon,
            (n_km + height_km) * cos_lat * sin_lon,
            (axis_ratio_squared * n_km + height_km) * sin_lat,
        ))
    }

    /// Local axes: x east, y north, z along the normal of the ellipsoid.
    pub fn horizon_from_itrs(&self) -> Rot<Horizon, Itrs> {
        let quarter = Angle::from_deg(90.0);
        // Turn x to the east, then tilt z from the pole to the zenith.
        Rot::claim(turn_axes_x(quarter - self.latitude) * turn_axes_z(self.longitude + quarter))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Dir;

    #[test]
    fn local_axes_are_east_north_up() {
        let place = Place::new(35.0, -111.0, 2100.0).unwrap();
        let up: Dir<Itrs> = Dir::from_spherical(place.longitude, place.latitude);
        let zenith = place.horizon_from_itrs() * up;
        assert!((zenith.altitude().deg() - 90.0).abs() < 1e-9);
        let pole: Dir<Itrs> = Dir::from_vector(DVec3::Z);
        let pole = place.horizon_from_itrs() * pole;
        assert!((pole.altitude().deg() - 35.0).abs() < 1e-9);
        assert!(pole.azimuth().signed().deg().abs() < 1e-9);
    }

    #[test]
    fn the_ellipsoid_has_its_axes() {
        let pole = Place::new(90.0, 0.0, 0.0).unwrap().itrs().distance_km();
        assert!((pole - 6_356.752_314_245).abs() < 1e-6);
        let equator = Place::new(0.0, 90.0, 1000.0).unwrap().itrs().distance_km();
        assert!((equator - 6379.137).abs() < 1e-9);
    }

    #[test]
    fn places_off_the_globe_are_refused() {
        assert!(matches!(Place::new(91.0, 0.0, 0.0), Err(PlaceError::Latitude(_))));
        assert!(matches!(Place::new(f64::NAN, 0.0, 0.0), Err(PlaceError::Latitude(_))));
        assert!(matches!(Place::new(0.0, f64::INFINITY, 0.0), Err(PlaceError::Longitude(_))));
        assert!(matches!(Place::new(0.0, 0.0, -1e4), Err(PlaceError::Height(_))));
    }
}

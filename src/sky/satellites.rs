//! The great moons of Jupiter as they stand in the sky: where, how lit, and whether Jupiter or its
//! shadow has them.
//!
//! Jupiter is a spheroid, as flat as it is measured to be; what it hides and shades is found in space
//! stretched along its axis until it is a ball. Its limb is taken as straight across the disc of a
//! moon, and the edge of its shadow as the fall of a straight limb over a disc that is as wide as the
//! moon and the half-shadow together. Left out: the bending of sunlight in its air, the moons hiding
//! and shading each other, and their shadows on Jupiter.

use std::f64::consts::PI;

use glam::DVec3;

use crate::ephemeris::{
    Body, EphemerisError, Galilean, JUPITER_EQUATORIAL_RADIUS_KM, JUPITER_POLAR_RADIUS_KM,
    Observation, jupiter_pole,
};
use crate::frame::{Dir, Horizon, Icrs};
use crate::units::{Angle, LIGHT_SPEED_KM_S, SUN_RADIUS_KM};

/// A moon of Jupiter as it stands in the sky.
#[derive(Debug, Clone, Copy)]
pub struct SatelliteState {
    pub satellite: Galilean,
    /// Bound of the error of `dir`.
    pub error_bound: Angle,
    /// Topocentric, with aberration, without air.
    pub dir: Dir<Horizon>,
    /// From the observer, along the way of the light.
    pub distance_km: f64,
    /// From the moon to the Sun.
    pub sun_distance_km: f64,
    /// Angle Sun, moon, observer.
    pub phase_angle: Angle,
    /// Angle between the centre and the limb.
    pub angular_radius: Angle,
    /// Part of its disc that Jupiter does not hide, 0 to 1.
    pub share_seen: f64,
    /// Part of the sunlight that the shadow of Jupiter leaves it, 0 to 1.
    pub share_sunlit: f64,
    /// Whether all of it stands in front of the disc of Jupiter.
    pub is_before_jupiter: bool,
}

/// All four, outwards.
pub(super) fn of_jupiter(
    observation: &mut Observation,
) -> Result<Vec<SatelliteState>, EphemerisError> {
    let jupiter = observation.seen(Body::Jupiter)?;
    let observer = *observation.observer();
    let to_jupiter = jupiter.place.from_observer.dir().vector();
    let light_time_s = jupiter.place.topocentric_distance_km / LIGHT_SPEED_KM_S;
    let left = observer.tdb.plus_seconds(-light_time_s);
    let pole = jupiter_pole(left);
    Galilean::ALL
        .into_iter()
        .map(|satellite| {
            // Light from before Jupiter has left later.
            let nearer_s = -satellite.from_jupiter(left).km().dot(to_jupiter) / LIGHT_SPEED_KM_S;
            let offset = satellite.from_jupiter(left.plus_seconds(nearer_s));
            let (dir, from_observer) = observation.beside(&jupiter, offset)?;
            let from_sun = jupiter.place.from_sun + offset;
            let distance_km = from_observer.distance_km();
            let radius_km = satellite.radius_km();
            let seen = Line { from: from_observer.dir(), at: offset.km(), pole };
            let lit = Line { from: from_sun.dir(), at: offset.km(), pole };
            // Half the width of the half-shadow.
            let half_shadow_km = lit.behind_km().max(0.0) * SUN_RADIUS_KM / from_sun.distance_km();
            let is_before_jupiter = seen.behind_km() < 0.0 && seen.beyond_limb_km() < -radius_km;
            Ok(SatelliteState {
                satellite,
                error_bound: jupiter.error_bound + Galilean::bound(observer.tdb),
                dir: observer.horizon_from_icrs * dir,
                distance_km,
                sun_distance_km: from_sun.distance_km(),
                phase_angle: from_sun.dir().separation(from_observer.dir()),
                angular_radius: Angle::from_rad((radius_km / distance_km).min(1.0).asin()),
                share_seen: seen.share_past(radius_km),
                share_sunlit: lit.share_past(radius_km + half_shadow_km),
                is_before_jupiter,
            })
        })
        .collect()
}

/// A ray of sight or of sunlight through a moon.
struct Line {
    /// Whither it runs.
    from: Dir<Icrs>,
    /// The moon from the centre of Jupiter, kilometres.
    at: DVec3,
    /// North pole of Jupiter.
    pole: Dir<Icrs>,
}

impl Line {
    /// How far behind the centre of Jupiter the moon is along the ray, kilometres.
    fn behind_km(&self) -> f64 {
        self.at.dot(self.from.vector())
    }

    /// How far outside the limb of Jupiter the ray passes, kilometres; negative inside.
    fn beyond_limb_km(&self) -> f64 {
        let pole = self.pole.vector();
        let stretch = JUPITER_EQUATORIAL_RADIUS_KM / JUPITER_POLAR_RADIUS_KM - 1.0;
        let round = |vector: DVec3| vector + pole * (vector.dot(pole) * stretch);
        let along = round(self.from.vector()).normalize();
        let at = round(self.at);
        (at - along * at.dot(along)).length() - JUPITER_EQUATORIAL_RADIUS_KM
    }

    /// Part of a disc of this radius about the ray that Jupiter leaves free.
    fn share_past(&self, radius_km: f64) -> f64 {
        if self.behind_km() <= 0.0 {
            return 1.0;
        }
        beyond_edge(self.beyond_limb_km() / radius_km)
    }
}

/// Part of the unit disc beyond a straight edge from which its centre stands so far off.
fn beyond_edge(centre: f64) -> f64 {
    let x = centre.clamp(-1.0, 1.0);
    1.0 - (x.acos() - x * (1.0 - x * x).sqrt()) / PI
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(at: DVec3) -> Line {
        Line { from: Dir::from_vector(DVec3::X), at, pole: Dir::from_vector(DVec3::Z) }
    }

    #[test]
    fn jupiter_hides_what_is_behind_it_and_is_flat() {
        let behind = |y: f64, z: f64| line(DVec3::new(4e5, y, z));
        assert_eq!(behind(0.0, 0.0).share_past(1800.0), 0.0);
        assert_eq!(line(DVec3::new(-4e5, 0.0, 0.0)).share_past(1800.0), 1.0);
        assert_eq!(behind(74_000.0, 0.0).share_past(1800.0), 1.0);
        assert!((behind(71_492.0, 0.0).share_past(1800.0) - 0.5).abs() < 1e-9);
        assert!((behind(0.0, 66_854.0).share_past(1800.0) - 0.5).abs() < 1e-9);
        assert!(line(DVec3::new(-4e5, 0.0, 0.0)).beyond_limb_km() < -7e4);
    }

    #[test]
    fn discs_are_cut_by_area() {
        assert_eq!((beyond_edge(-1.0), beyond_edge(1.0)), (0.0, 1.0));
        // A chord at half the radius cuts off 0.1955 of the disc.
        assert!((beyond_edge(-0.5) - 0.195_501).abs() < 1e-6);
        assert!((beyond_edge(0.5) + beyond_edge(-0.5) - 1.0).abs() < 1e-12);
    }
}

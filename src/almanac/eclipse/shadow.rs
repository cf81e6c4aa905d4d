//! The shadow that the Moon casts, and where it meets the Earth.
//!
//! *Theory.* Bessel's: the line from the Sun through the Moon is the axis of two cones, the
//! penumbra and the umbra (Explanatory Supplement 2013, section 11.3). Vectors are used directly,
//! in place of his elements x, y, d, l1, l2 in a plane through the centre of the Earth; the Earth
//! is the ellipsoid WGS84, not a sphere stretched afterwards.
//!
//! *Omitted.* Where a shadow touches the rim of the Earth the cone is taken for a cylinder: 70 m,
//! 0.2 s of the first and last contact of a solar eclipse with the Earth. Air and mountains.

use glam::DVec3;

use super::radii::{MOON_INNER_KM, MOON_OUTER_KM, SUN_KM};
use super::track::Positions;
use crate::frame::{Dir, Pos, TrueOfDate};
use crate::place::WGS84_FLATTENING;
use crate::units::EARTH_EQUATORIAL_RADIUS_KM;

/// The shadow at one moment; kilometres from the centre of the Earth, true axes of date.
#[derive(Debug, Clone, Copy)]
pub struct MoonShadow {
    moon: DVec3,
    /// Direction of the axis.
    to_sun: DVec3,
    penumbra: Cone,
    umbra: Cone,
}

/// Where a shadow comes nearest to the rim of the Earth, as seen along its axis.
#[derive(Debug, Clone, Copy)]
pub struct Rim {
    /// The point of the ellipsoid, where the Sun stands on the horizon.
    pub point: Pos<TrueOfDate>,
    /// How far the axis passes outside; negative where it meets the Earth.
    pub clearance_km: f64,
}

/// A cone about the axis.
#[derive(Debug, Clone, Copy)]
struct Cone {
    /// Radius at the height of the centre of the Moon, kilometres.
    radius_at_moon_km: f64,
    /// How fast the radius grows towards the Sun.
    slope: f64,
}

impl Cone {
    /// `radii_km` is what the Sun and the Moon contribute to the opening of the cone: their sum for
    /// the penumbra, their difference for the umbra.
    fn new(radii_km: f64, distance_km: f64, moon_km: f64, sense: f64) -> Cone {
        let sine = radii_km / distance_km;
        let cosine = (1.0 - sine * sine).sqrt();
        Cone { radius_at_moon_km: moon_km / cosine, slope: sense * sine / cosine }
    }
}

impl MoonShadow {
    pub fn of(positions: &Positions) -> MoonShadow {
        let (sun, moon) = (positions.sun.km(), positions.moon.km());
        let distance_km = (sun - moon).length();
        MoonShadow {
            moon,
            to_sun: (sun - moon) / distance_km,
            penumbra: Cone::new(SUN_KM + MOON_OUTER_KM, distance_km, MOON_OUTER_KM, -1.0),
            umbra: Cone::new(SUN_KM - MOON_INNER_KM, distance_km, MOON_INNER_KM, 1.0),
        }
    }

    /// From the centre of the Earth to the nearest point of the axis.
    pub fn foot(&self) -> Pos<TrueOfDate> {
        Pos::from_km(self.moon.reject_from_normalized(self.to_sun))
    }

    /// The distance of [`MoonShadow::foot`] in equatorial radii of the Earth, positive in the
    /// north.
    pub fn gamma(&self) -> f64 {
        let foot = self.foot().km();
        (foot.length() / EARTH_EQUATORIAL_RADIUS_KM).copysign(foot.z)
    }

    /// The direction to the Sun along the axis.
    pub fn sunward(&self) -> Dir<TrueOfDate> {
        Dir::from_vector(self.to_sun)
    }

    /// Radius of the penumbra at the height of a point, kilometres.
    pub fn penumbra_km(&self, point: Pos<TrueOfDate>) -> f64 {
        self.radius_km(self.penumbra, point)
    }

    /// Radius of the umbra at the height of a point, kilometres; negative behind its tip, where the
    /// eclipse is annular.
    pub fn umbra_km(&self, point: Pos<TrueOfDate>) -> f64 {
        self.radius_km(self.umbra, point)
    }

    fn radius_km(&self, cone: Cone, point: Pos<TrueOfDate>) -> f64 {
        cone.radius_at_moon_km + cone.slope * (point.km() - self.moon).dot(self.to_sun)
    }

    /// Where the axis meets the ground on the side of the Sun; `None` where it passes the Earth.
    pub fn ground(&self) -> Option<Pos<TrueOfDate>> {
        // Stretched along the axis of the Earth, the ellipsoid is a sphere.
        let stretch = DVec3::new(1.0, 1.0, 1.0 / (1.0 - WGS84_FLATTENING));
        let (moon, axis) = (self.moon * stretch, self.to_sun * stretch);
        let (a, b) = (axis.length_squared(), moon.dot(axis));
        let nearest = moon - axis * (b / a);
        let half_chord_squared = EARTH_EQUATORIAL_RADIUS_KM.powi(2) - nearest.length_squared();
        let along_km = (half_chord_squared >= 0.0).then(|| (half_chord_squared / a).sqrt() - b / a);
        along_km.map(|along_km| Pos::from_km(self.moon + self.to_sun * along_km))
    }

    /// Where the axis meets the ground, or the point of the rim nearest to it.
    pub fn nearest_ground(&self) -> Pos<TrueOfDate> {
        self.ground().unwrap_or_else(|| self.rim().point)
    }

    /// Between the penumbra and the Earth; negative while they touch.
    pub fn penumbra_gap_km(&self) -> f64 {
        let rim = self.rim();
        rim.clearance_km - self.penumbra_km(rim.point)
    }

    /// Between the umbra, or what lies behind its tip, and the Earth; negative while they touch.
    pub fn umbra_gap_km(&self) -> f64 {
        let rim = self.rim();
        rim.clearance_km - self.umbra_km(rim.point).abs()
    }

    /// The point of the Earth's rim nearest to the axis.
    pub fn rim(&self) -> Rim {
        let equator_km = EARTH_EQUATORIAL_RADIUS_KM;
        let pole_km = equator_km * (1.0 - WGS84_FLATTENING);
        let axes = DVec3::new(equator_km, equator_km, pole_km);
        let squares = axes * axes;
        let foot = self.foot().km();
        // Where the axis goes through the centre, every direction is as good.
        let mut normal =
            foot.try_normalize().unwrap_or_else(|| self.to_sun.any_orthonormal_vector());
        // The point with a given normal has its centre of curvature near the centre of the Earth:
        // each round gains a factor of 100.
        let mut point = DVec3::ZERO;
        for _ in 0..6 {
            point = squares * normal / (normal * squares).dot(normal).sqrt();
            let from_centre =
                (foot - point + equator_km * normal).reject_from_normalized(self.to_sun);
            normal = from_centre.try_normalize().unwrap_or(normal);
        }
        Rim { point: Pos::from_km(point), clearance_km: (foot - point).dot(normal) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Rot;
    use crate::units::AU_KM;
    use glam::DMat3;

    fn shadow(offset: DVec3) -> MoonShadow {
        let to_sun = DVec3::new(0.8, 0.0, 0.6);
        let positions = Positions {
            sun: Pos::from_km(to_sun * AU_KM + offset),
            moon: Pos::from_km(to_sun * 380_000.0 + offset),
            itrs_from_true: Rot::claim(DMat3::IDENTITY),
        };
        MoonShadow::of(&positions)
    }

    /// Zero on the ellipsoid.
    fn height(point: Pos<TrueOfDate>) -> f64 {
        let p = point.km();
        let polar = p.z / (1.0 - WGS84_FLATTENING);
        (p.x * p.x + p.y * p.y + polar * polar).sqrt() - EARTH_EQUATORIAL_RADIUS_KM
    }

    #[test]
    fn the_axis_meets_the_ground_on_the_side_of_the_sun() {
        for offset in [DVec3::ZERO, DVec3::new(-600.0, 5000.0, 800.0)] {
            let shadow = shadow(offset);
            let ground = shadow.ground().unwrap();
            assert!(height(ground).abs() < 1e-6);
            assert!(
                (ground.km() - offset).reject_from_normalized(shadow.sunward().vector()).length()
                    < 1e-4
            );
            assert!(ground.km().dot(shadow.sunward().vector()) > 0.0);
            assert!(shadow.rim().clearance_km < 0.0);
        }
        assert!(shadow(DVec3::Y * 6400.0).ground().is_none());
    }

    #[test]
    fn no_point_of_the_rim_is_nearer_than_the_one_found() {
        for offset in [DVec3::new(-4000.0, 3000.0, 5000.0), DVec3::new(-3.0, 6100.0, 4.0)] {
            let shadow = shadow(offset);
            let rim = shadow.rim();
            assert!(height(rim.point).abs() < 1e-6);
            let from_axis =
                |p: DVec3| (p - offset).reject_from_normalized(shadow.sunward().vector()).length();
            assert!((from_axis(rim.point.km()) - rim.clearance_km.abs()).abs() < 0.01);
            let outside = rim.clearance_km > 0.0;
            // Around the rim: points with a normal at right angles to the axis.
            for degree in 0..360 {
                let across = shadow.sunward().vector().cross(DVec3::Y);
                let (sin, cos) = f64::from(degree).to_radians().sin_cos();
                let normal = DVec3::Y * cos + across * sin;
                let (a, b) = (1.0f64, (1.0 - WGS84_FLATTENING).powi(2));
                let scaled = DVec3::new(a, a, b) * normal;
                let point = EARTH_EQUATORIAL_RADIUS_KM * scaled / scaled.dot(normal).sqrt();
                let clearance = (offset - point).dot(normal);
                assert!(clearance < rim.clearance_km + 1e-6 || !outside);
                assert!(from_axis(point) > rim.clearance_km.abs() - 1e-3);
            }
        }
    }

    #[test]
    fn the_umbra_ends_where_moon_and_sun_look_alike() {
        let shadow = shadow(DVec3::ZERO);
        let distance_km = AU_KM - 380_000.0;
        let tip_km = MOON_INNER_KM * distance_km / (SUN_KM - MOON_INNER_KM);
        let point = Pos::from_km(shadow.sunward().vector() * (380_000.0 - tip_km));
        assert!(shadow.umbra_km(point).abs() < 1e-6);
        let sun_km = (AU_KM - point.distance_km()).abs();
        assert!((MOON_INNER_KM / tip_km - SUN_KM / sun_km).abs() < 1e-9);
        // The penumbra is some 3500 km wide at the Earth.
        let wide = shadow.penumbra_km(Pos::ORIGIN);
        assert!((3400.0..3600.0).contains(&wide), "{wide}");
    }
}

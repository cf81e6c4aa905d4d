//! How a lit ball shows itself: phase, lit part of the disc, position angles, size.
//!
//! For any body whose place is known from the observer and from the Sun. Formulas: Meeus 1998,
//! *Astronomical Algorithms*, 2nd ed., chapters 41 and 48, here by vectors.

use crate::frame::{Dir, Icrs, Pos, Rot, TrueOfDate};
use crate::units::Angle;

/// The phase of a body as one observer sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phase {
    /// Angle Sun, body, observer: 0 when all of the disc is lit, 180 degrees when nothing is.
    pub angle: Angle,
    /// Lit part of the area of the disc, 0 to 1: `(1 + cos angle) / 2` (Meeus 1998, eq. 41.1).
    pub illuminated_fraction: f64,
    /// Position angle of the middle of the bright limb: from the true north of date through east,
    /// at the place of the body, in `[0, 2 pi)`.
    pub bright_limb: Angle,
}

impl Phase {
    /// Given where the body was when the light left it, from the observer and from the Sun, neither
    /// with aberration.
    pub fn seen(
        true_from_icrs: Rot<TrueOfDate, Icrs>,
        from_observer: Pos<Icrs>,
        from_sun: Pos<Icrs>,
    ) -> Phase {
        let (dir, to_sun) = (from_observer.dir(), -from_sun.dir());
        let angle = to_sun.separation(-dir);
        Phase {
            angle,
            illuminated_fraction: 0.5 * (1.0 + angle.cos()),
            bright_limb: position_angle(true_from_icrs * dir, true_from_icrs * to_sun),
        }
    }
}

/// Position angle, at a place in the sky, of the side to which a direction points: from the north
/// of the frame through east, in `[0, 2 pi)`; zero where both are the same.
pub fn position_angle<F>(place: Dir<F>, pointing: Dir<F>) -> Angle {
    let (place, pointing) = (place.vector(), pointing.vector());
    let east = glam::DVec3::new(-place.y, place.x, 0.0);
    let north = place.cross(east);
    Angle::from_rad(pointing.dot(east).atan2(pointing.dot(north))).positive()
}

/// The angle that a ball fills; half a turn for whoever stands on it.
pub fn angular_diameter(radius_km: f64, distance_km: f64) -> Angle {
    Angle::from_rad(2.0 * (radius_km / distance_km).min(1.0).asin())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec3};

    #[test]
    fn position_angles_run_from_north_through_east() {
        let dir = |lon_deg, lat_deg| -> Dir<TrueOfDate> {
            Dir::from_spherical(Angle::from_deg(lon_deg), Angle::from_deg(lat_deg))
        };
        for (lon_deg, lat_deg, wanted_deg) in
            [(80.0, 31.0, 0.0), (80.01, 30.0, 90.0), (80.0, 29.0, 180.0), (79.99, 30.0, 270.0)]
        {
            let got = position_angle(dir(80.0, 30.0), dir(lon_deg, lat_deg));
            let off = (got - Angle::from_deg(wanted_deg)).signed();
            assert!(off.abs().deg() < 0.01, "{wanted_deg}°: {}°", got.deg());
        }
    }

    #[test]
    fn a_half_moon_is_half_lit_on_the_side_of_the_sun() {
        // The Sun stands at right ascension zero, the body in quadrature, east of it.
        let from_sun = |km: DVec3| Pos::from_km(km - DVec3::X * 1.5e8);
        let body = DVec3::new(0.0, 4e5, 0.0);
        let phase = Phase::seen(Rot::claim(DMat3::IDENTITY), Pos::from_km(body), from_sun(body));
        assert!((phase.angle.deg() - 90.0).abs() < 0.2, "{phase:?}");
        assert!((phase.illuminated_fraction - 0.5).abs() < 2e-3, "{phase:?}");
        assert!((phase.bright_limb.deg() - 270.0).abs() < 1e-9, "{phase:?}");
        let behind = DVec3::new(-4e5, 0.0, 1.0);
        let full = Phase::seen(Rot::claim(DMat3::IDENTITY), Pos::from_km(behind), from_sun(behind));
        assert!(full.illuminated_fraction > 1.0 - 1e-9 && full.angle.deg() < 1e-3);
    }

    #[test]
    fn discs_have_the_size_of_their_balls() {
        assert!((angular_diameter(1.0, 2.0).deg() - 60.0).abs() < 1e-12);
        assert!((angular_diameter(2.0, 1.0).deg() - 180.0).abs() < 1e-12);
    }
}

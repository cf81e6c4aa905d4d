//! The outline of the globe: how far from the middle of the disc its mountains and valleys end it.
//!
//! *Theory.* In each direction from the middle of the disc the limb is the highest of all ground around 90
//! degrees from the point below the observer, as he sees it: some before the edge of the smooth globe, some
//! behind. The mesh that is drawn reaches over it; what is beyond is cut off, a pixel by the part of it
//! that is within.

use glam::DMat3;
use rayon::prelude::*;

use super::near_side::{EDGE, NearSide};
use super::turn::towards;
use crate::units::Angle;

/// The limb by direction from the middle of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Limb {
    /// Distance from the middle in radii of the Moon as the observer sees them, less one: a turn from the right
    /// through up, in even steps of [the quick turn](super::turn).
    pub over_mean: Vec<f64>,
}

impl Limb {
    /// As fine as the finest relief.
    const DIRECTIONS: usize = 3600;
    /// Where ground is looked for that may be the limb: the highest is seen from 6 degrees behind.
    const FIRST: Angle = Angle::from_deg(84.0);
    const LAST: Angle = Angle::from_deg(96.0);

    /// For an observer at a distance in radii of the Moon, given the axes of the picture in the Moon's own.
    pub fn of(relief: &NearSide<f32>, body_from_picture: DMat3, distance: f64) -> Limb {
        // Rings a cell of the map apart.
        let step_rad = 2.0 * EDGE / relief.size as f64;
        let rings = ((Limb::LAST - Limb::FIRST).rad() / step_rad).ceil() as usize;
        let rings: Vec<(f64, f64)> = (0..=rings)
            .map(|ring| {
                let share = ring as f64 / rings as f64;
                (Limb::FIRST + (Limb::LAST - Limb::FIRST) * share).sin_cos()
            })
            .collect();
        let at = |direction: usize| {
            let towards = towards(direction as f64 / Limb::DIRECTIONS as f64);
            let outwards = body_from_picture * towards.extend(0.0);
            let seen = |&(sin, cos): &(f64, f64)| {
                let normal = outwards * sin - body_from_picture.z_axis * cos;
                let radius = 1.0 + relief.at(normal).map_or(0.0, f64::from);
                let (across, before) = (radius * sin, distance - radius * cos);
                across * distance / across.hypot(before) - 1.0
            };
            rings.iter().map(seen).fold(f64::MIN, f64::max)
        };
        Limb { over_mean: (0..Limb::DIRECTIONS).into_par_iter().map(at).collect() }
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::super::turn;
    use super::*;

    const FACING: DMat3 = DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::NEG_X);

    #[test]
    fn the_limb_of_a_smooth_globe_is_its_radius() {
        let smooth = NearSide::of(&vec![0.0; 720 * 360], 720, 0);
        for distance in [60.0, 220.0, 1e5] {
            let limb = Limb::of(&smooth, FACING, distance);
            // As the mesh has it, seen from the middle: sin of the angle times the distance.
            assert!(limb.over_mean.iter().all(|over| over.abs() < 2e-5), "{:?}", limb.over_mean[0]);
        }
    }

    #[test]
    fn a_mountain_stands_where_it_is() {
        // 8 km at the eastern limb, 3 degrees behind it, 10 degrees north.
        let heights: Vec<f32> = (0..2880 * 1440)
            .map(|at| {
                let (longitude, latitude) =
                    ((at % 2880) as f64 / 8.0 - 180.0, 90.0 - (at / 2880) as f64 / 8.0);
                let off = (longitude - 93.0).hypot(latitude - 10.0);
                if off < 0.5 { 0.0046 } else { 0.0 }
            })
            .collect();
        let limb = Limb::of(&NearSide::of(&heights, 2880, 0), FACING, 220.0);
        let at = |deg: f64| {
            let share = turn::share(DVec2::from_angle(deg.to_radians()));
            limb.over_mean[(share * Limb::DIRECTIONS as f64).round() as usize]
        };
        // Its height, less what the bend of the globe hides.
        let expected = 1.0046 * 3f64.to_radians().cos() - 1.0;
        assert!((at(10.0) - expected).abs() < 3e-4, "{} {expected}", at(10.0));
        assert!(at(8.0).abs() < 2e-5 && at(190.0).abs() < 2e-5);
    }
}

//! Which part of the Sun is seen from the ground near the terminator.
//!
//! *Theory.* Sunlight is parallel but for the size of the Sun: a point is in shadow if anything between
//! it and the Sun stands higher over the axis from the Moon to the Sun than the point does. All that
//! can hide the Sun from a point lies on its meridian through the subsolar point, so each such meridian
//! is walked outwards once. Of the ridges that were passed only those on their convex hull, seen from
//! outside, can be the highest, and those that stand under the line from the new point to the highest
//! will never be again: the walk takes a few steps a point, and no ridge is too far. How much of the
//! Sun's disc is hidden follows from how high the highest ridge stands against its centre.
//!
//! *Left out.* Ridges beyond the edge of the map of the near side.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::near_side::NearSide;
use super::turn::towards;
use crate::units::Angle;

/// The part of the Sun's disc that is seen, on circles around the subsolar point.
#[derive(Debug, Clone, PartialEq)]
pub struct Shadows {
    /// The frame: two axes across, then towards the Sun, in the Moon's own axes, as columns.
    pub body_from_sun: DMat3,
    pub rows: usize,
    pub columns: usize,
    /// By the cosine of the angle from the subsolar point, that of [`Shadows::FIRST`] to that of
    /// [`Shadows::LAST`], then by [quick turn](super::turn) around it from the first axis to the second; 0 to 1.
    pub sunlit: Vec<f32>,
}

impl Shadows {
    pub const FIRST: Angle = Angle::from_deg(58.0);
    pub const LAST: Angle = Angle::from_deg(97.0);
    /// At their finest.
    const ROWS: usize = 321;
    const COLUMNS: usize = 3600;
    /// Where ridges are looked for first.
    const BEFORE: Angle = Angle::from_deg(40.0);

    /// For the Sun in a direction in the Moon's own axes, of a given angular radius, as fine as a picture
    /// of the disc with a radius of so many pixels needs them. Heights are in radii of the Moon.
    pub fn cast(
        relief: &NearSide<f32>,
        to_sun: DVec3,
        sun_radius: Angle,
        radius_px: f64,
    ) -> Shadows {
        let coarser = (Shadows::COLUMNS as f64 / std::f64::consts::TAU / radius_px).floor();
        let coarser = (coarser as usize).clamp(1, 40);
        let (rows, columns) = ((Shadows::ROWS - 1) / coarser + 1, Shadows::COLUMNS / coarser);
        let across = to_sun.any_orthonormal_vector();
        let body_from_sun = DMat3::from_cols(across, to_sun.cross(across), to_sun);
        let step = (Shadows::LAST.cos() - Shadows::FIRST.cos()) / (rows - 1) as f64;
        let before = ((Shadows::FIRST.cos() - Shadows::BEFORE.cos()) / step).ceil() as usize;
        let angles: Vec<(f64, f64)> = (0..rows + before)
            .map(|row| Shadows::FIRST.cos() + step * (row as f64 - before as f64))
            .map(|cos| ((1.0 - cos * cos).sqrt(), cos))
            .collect();
        let meridian = |column: usize| -> Vec<f32> {
            let towards = towards(column as f64 / columns as f64);
            let outwards = body_from_sun * towards.extend(0.0);
            let mut ridges = Ridges::default();
            let sunlit = angles.iter().map(|&(sin, cos)| {
                let Some(height) = relief.at(outwards * sin + to_sun * cos) else { return 1.0 };
                let radius = 1.0 + f64::from(height);
                let highest = ridges.pass([radius * sin, radius * cos]);
                share_above(highest / sun_radius.rad()) as f32
            });
            sunlit.skip(before).collect()
        };
        let meridians: Vec<Vec<f32>> = (0..columns).into_par_iter().map(meridian).collect();
        let sunlit =
            (0..rows).flat_map(|row| meridians.iter().map(move |column| column[row])).collect();
        Shadows { body_from_sun, rows, columns, sunlit }
    }
}

/// The ridges passed on the way away from the Sun that may still be the highest: how far each stands from
/// the axis to the Sun, and how far along it.
#[derive(Default)]
struct Ridges(Vec<[f64; 2]>);

impl Ridges {
    /// Passes a point, and tells how high the highest ridge stands from there over the Sun's centre, as a
    /// tangent: negative where nothing stands in the way.
    fn pass(&mut self, point: [f64; 2]) -> f64 {
        let slope = |ridge: &[f64; 2]| (ridge[0] - point[0]) / (ridge[1] - point[1]).max(1e-12);
        let Ridges(hull) = self;
        // A ridge stands behind the one before it if that is the higher of both.
        while let [.., before, last] = hull[..] {
            if slope(&before) < slope(&last) {
                break;
            }
            hull.pop();
        }
        let highest = hull.last().map_or(f64::MIN, slope);
        hull.push(point);
        highest
    }
}

/// The share of a disc above a level line, given how high the line stands over its middle, in radii.
fn share_above(line: f64) -> f64 {
    let line = line.clamp(-1.0, 1.0);
    if line.abs() == 1.0 {
        return 0.5 - 0.5 * line;
    }
    (line.acos() - line * (1.0 - line * line).sqrt()) / std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::MOON_RADIUS_KM;

    /// A smooth globe with something on it, metres by longitude and latitude in degrees.
    fn globe_with(mountain: impl Fn(f64, f64) -> f64) -> NearSide<f32> {
        let (width, height) = (2880, 1440);
        let radii: Vec<f32> = (0..height)
            .flat_map(|row| (0..width).map(move |column| (row, column)))
            .map(|(row, column)| {
                let longitude_deg = (column as f64 + 0.5) / 8.0 - 180.0;
                let metres = mountain(longitude_deg, 90.0 - (row as f64 + 0.5) / 8.0);
                (metres / (1000.0 * MOON_RADIUS_KM)) as f32
            })
            .collect();
        NearSide::of(&radii, width, 0)
    }

    fn sunlit(shadows: &Shadows, longitude_deg: f64) -> f32 {
        let normal =
            DVec3::new(longitude_deg.to_radians().cos(), longitude_deg.to_radians().sin(), 0.0);
        let in_sun = shadows.body_from_sun.transpose() * normal;
        let [first, last] = [Shadows::FIRST, Shadows::LAST].map(|angle| angle.cos());
        let row = (in_sun.z - first) / (last - first) * (shadows.rows - 1) as f64;
        let row = row.round() as usize;
        let turn = super::super::turn::share(in_sun.truncate());
        let column = (turn * shadows.columns as f64).round() as usize;
        shadows.sunlit[row * shadows.columns + column % shadows.columns]
    }

    const SUN_RADIUS: Angle = Angle::from_deg(0.267);

    #[test]
    fn half_of_the_sun_is_seen_from_the_terminator_of_a_smooth_globe() {
        let shadows = Shadows::cast(&globe_with(|_, _| 0.0), DVec3::X, SUN_RADIUS, 2000.0);
        assert!((sunlit(&shadows, 90.0) - 0.5).abs() < 0.2, "{}", sunlit(&shadows, 90.0));
        assert_eq!((sunlit(&shadows, 89.0), sunlit(&shadows, 91.0)), (1.0, 0.0));
    }

    #[test]
    fn a_mountain_throws_its_shadow_away_from_the_sun() {
        // A wall of 3 km at 80 degrees, where the Sun is 10 degrees high: 17 km of shadow, 0.56 degrees.
        let wall =
            |longitude: f64, _: f64| if (79.8..80.2).contains(&longitude) { 3000.0 } else { 0.0 };
        let shadows = Shadows::cast(&globe_with(wall), DVec3::X, SUN_RADIUS, 2000.0);
        assert!(sunlit(&shadows, 80.45) < 0.1, "{}", sunlit(&shadows, 80.45));
        assert!(sunlit(&shadows, 81.2) > 0.9 && sunlit(&shadows, 79.5) > 0.9);
        assert!(sunlit(&shadows, -80.45) > 0.9);
    }

    #[test]
    fn peaks_are_lit_beyond_the_terminator() {
        // 5 km see over the horizon by acos(1 / (1 + 5 / 1737)) = 4.3 degrees.
        let peak = |longitude: f64, latitude: f64| {
            let off = (longitude - 93.0).hypot(latitude);
            5000.0 * (1.0 - off / 0.5).max(0.0)
        };
        let shadows = Shadows::cast(&globe_with(peak), DVec3::X, SUN_RADIUS, 2000.0);
        assert!(sunlit(&shadows, 93.0) > 0.9, "{}", sunlit(&shadows, 93.0));
        assert!(sunlit(&shadows, 92.0) < 0.01 && sunlit(&shadows, 94.0) < 0.01);
    }

    #[test]
    fn the_highest_ridge_is_the_highest_of_all() {
        // Any walk outwards: heights that jump up and down.
        let mut state = 7u64;
        let mut noise = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1u64 << 31) as f64
        };
        let walk: Vec<[f64; 2]> = (0..400)
            .map(|step| {
                let (sin, cos) = (0.9 + 0.002 * f64::from(step)).sin_cos();
                let radius = 1.0 + 2e-3 * noise() * noise();
                [radius * sin, radius * cos]
            })
            .collect();
        let mut ridges = Ridges::default();
        for (at, point) in walk.iter().enumerate() {
            let slope = |ridge: &[f64; 2]| (ridge[0] - point[0]) / (ridge[1] - point[1]).max(1e-12);
            let highest = walk[..at].iter().map(slope).fold(f64::MIN, f64::max);
            assert_eq!(ridges.pass(*point), highest, "{at}");
        }
    }

    #[test]
    fn shares_of_a_disc() {
        assert_eq!((share_above(-2.0), share_above(0.0), share_above(2.0)), (1.0, 0.5, 0.0));
        // A line at half the radius leaves 1/3 - sqrt(3) / 4 pi.
        assert!((share_above(0.5) - 0.195_501).abs() < 1e-6);
    }
}

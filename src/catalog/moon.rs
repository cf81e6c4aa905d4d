//! Maps of the Moon: how bright, how high, and how the ground sends light back.
//!
//! All are equidistant cylindrical maps in selenographic coordinates (mean Earth and rotation axis,
//! as [`MoonFixed`](crate::frame::MoonFixed)): row 0 is the northernmost, longitude grows eastward
//! from -180° at the left edge to +180° at the right edge, and values belong to the centres of the
//! pixels.

pub mod albedo;
pub mod hapke;
pub mod relief;

pub use albedo::MoonMap;
pub use hapke::{HapkeCell, MoonHapke};
pub use relief::MoonRelief;

use crate::units::Angle;

/// Four pixels around a place, as places in a map of `width` times `height` pixels, and their
/// weights, which sum to 1.
///
/// Across the seam at ±180° the map goes on at its other edge; beyond the last row before a pole it
/// goes on down the opposite meridian, which an even width has.
pub fn around(
    (width, height): (usize, usize),
    longitude: Angle,
    latitude: Angle,
) -> [(usize, f64); 4] {
    let x = (longitude.deg() / 360.0 + 0.5) * width as f64 - 0.5;
    let y = (0.5 - latitude.deg() / 180.0) * height as f64 - 0.5;
    let (column, row) = (x.floor(), y.floor());
    let (right, down) = (x - column, y - row);
    let at = |down: i64, right: i64| {
        let row = (row as i64).clamp(-1, height as i64 - 1) + down;
        let over_pole = row < 0 || row >= height as i64;
        let across = if over_pole { width as i64 / 2 } else { 0 };
        let column = (column as i64 + right + across).rem_euclid(width as i64);
        row.clamp(0, height as i64 - 1) as usize * width + column as usize
    };
    [
        (at(0, 0), (1.0 - down) * (1.0 - right)),
        (at(0, 1), (1.0 - down) * right),
        (at(1, 0), down * (1.0 - right)),
        (at(1, 1), down * right),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(map: &[f64], size: (usize, usize), longitude_deg: f64, latitude_deg: f64) -> f64 {
        let place = around(size, Angle::from_deg(longitude_deg), Angle::from_deg(latitude_deg));
        assert!((place.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
        place.iter().map(|&(at, weight)| map[at] * weight).sum()
    }

    #[test]
    fn pixels_have_their_value_and_seam_and_poles_are_crossed() {
        let size = (8, 4);
        let map: Vec<f64> = (0..32).map(|at| f64::from(at * at)).collect();
        for row in 0..4 {
            for column in 0..8 {
                let longitude_deg = -157.5 + 45.0 * column as f64;
                let latitude_deg = 67.5 - 45.0 * row as f64;
                for turn_deg in [-360.0, 0.0, 360.0] {
                    let got = value(&map, size, longitude_deg + turn_deg, latitude_deg);
                    assert!((got - map[row * 8 + column]).abs() < 1e-9);
                }
            }
        }
        // The seam: half-way between the last column and the first.
        let seam = 0.5 * (map[8] + map[15]);
        assert!((value(&map, size, 180.0, 22.5) - seam).abs() < 1e-9);
        assert!((value(&map, size, -180.0, 22.5) - seam).abs() < 1e-9);
        // The poles: one value on opposite meridians.
        for pole_deg in [90.0, -90.0] {
            let (here, there) =
                (value(&map, size, -157.5, pole_deg), value(&map, size, 22.5, pole_deg));
            assert!((here - there).abs() < 1e-9);
            let near = value(&map, size, -157.5, pole_deg * (1.0 - 1e-9));
            assert!((here - near).abs() < 1e-6);
        }
        assert!((value(&map, size, -157.5, 90.0) - 0.5 * (map[0] + map[4])).abs() < 1e-9);
    }
}

//! The near side of the Moon on an equal-area map.
//!
//! *Theory.* Lambert's azimuthal projection around the place where longitude and latitude are zero: one with
//! the outward normal `n` lies at `s (n_y, n_z)`, `s = sqrt(2 k)`, `k = 1 / (1 + n_x)`: 0 in the middle,
//! 1.41 at 90 degrees from it. The map has no poles and no seam, and a direction becomes a place by one root.
//! Slopes are kept along unit vectors that turn with the ground as little as can be,
//! `(-n_y, 1 - k n_y^2, -k n_y n_z)` and `(-n_z, -k n_y n_z, 1 - k n_z^2)`; a step along them moves the place
//! by `s (1 - k n_y^2 / 2, -k n_y n_z / 2)` and `s (-k n_y n_z / 2, 1 - k n_z^2 / 2)`.
//!
//! It reaches to [`EDGE`]: libration and the height of mountains show no more than 107 degrees. In the
//! middle it is [`FINER`] than the map that it is made of; at 90 degrees, where all is seen aslant, 0.85 times as
//! fine outwards.

use glam::DVec3;
use rayon::prelude::*;

use crate::catalog::moon::around;
use crate::units::Angle;

/// Half of the map's edge: 2 sin(53.6 degrees), at 107 degrees.
pub const EDGE: f64 = 1.61;
/// Cells of the map for one of its source, in the middle.
const FINER: f64 = 1.2;

/// Values at the middles of square cells, row by row: along `n_y` to the right, along `n_z` up, the
/// highest first.
#[derive(Debug, Clone, PartialEq)]
pub struct NearSide<T> {
    /// Cells along an edge.
    pub size: usize,
    pub values: Vec<T>,
}

/// What lies between cells.
pub trait Mixed: Copy + Default + Send + Sync {
    fn mixed(four: [(Self, f32); 4]) -> Self;
}

impl Mixed for f32 {
    fn mixed(four: [(Self, f32); 4]) -> Self {
        four.iter().map(|(value, weight)| value * weight).sum()
    }
}

impl Mixed for [f32; 3] {
    fn mixed(four: [(Self, f32); 4]) -> Self {
        std::array::from_fn(|n| four.iter().map(|(value, weight)| value[n] * weight).sum())
    }
}

impl<T: Mixed> NearSide<T> {
    /// From a map of the whole Moon as [`crate::catalog::moon`] says, halved `level` times by means of
    /// four.
    pub fn of(map: &[T], width: usize, level: u32) -> NearSide<T> {
        let halved = (level > 0).then(|| halved(map, width, level));
        let (map, width) = halved.as_ref().map_or((map, width), |(map, width)| (map, *width));
        let cells_in_radian = FINER * width as f64 / std::f64::consts::TAU;
        let size = (2.0 * EDGE * cells_in_radian).ceil().max(2.0) as usize;
        let mut near = NearSide { size, values: vec![T::default(); size * size] };
        let places: Vec<f64> = (0..size).map(|cell| near.middle(cell)).collect();
        near.values.par_chunks_mut(size).zip(&places).for_each(|(values, y)| {
            for (value, x) in values.iter_mut().zip(&places) {
                let [longitude, latitude] = place(*x, -y);
                let four = around((width, width / 2), longitude, latitude);
                *value = T::mixed(four.map(|(at, weight)| (map[at], weight as f32)));
            }
        });
        near
    }

    /// Straight between cells, given the outward normal; none beyond the edge of the map.
    pub fn at(&self, normal: DVec3) -> Option<T> {
        let scale = (2.0 / (1.0 + normal.x)).sqrt();
        let (x, y) = (scale * normal.y, scale * normal.z);
        (x.abs() < EDGE && y.abs() < EDGE).then(|| self.on_plane(x, y))
    }

    /// The same for a point of the plane, to the right and up; beyond the edge what the edge has.
    pub fn on_plane(&self, x: f64, y: f64) -> T {
        let cell = |place: f64| {
            let last = (self.size - 1) as f64;
            let place = (0.5 * (self.size as f64 * (1.0 + place / EDGE) - 1.0)).clamp(0.0, last);
            let first = (place as usize).min(self.size - 2);
            (first, (place - first as f64) as f32)
        };
        let ((column, right), (row, down)) = (cell(x), cell(-y));
        let first = row * self.size + column;
        let below = first + self.size;
        T::mixed([
            (self.values[first], (1.0 - down) * (1.0 - right)),
            (self.values[first + 1], (1.0 - down) * right),
            (self.values[below], down * (1.0 - right)),
            (self.values[below + 1], down * right),
        ])
    }

    /// The middle of a cell along an axis of the plane: to the right for columns, down for rows.
    pub fn middle(&self, cell: usize) -> f64 {
        ((2 * cell + 1) as f64 / self.size as f64 - 1.0) * EDGE
    }
}

/// The outward normal at a point of the plane.
pub fn normal_at(x: f64, y: f64) -> DVec3 {
    // Beyond the antipode there is nothing; the corners of the map come near it.
    let quarter = (0.25 * (x * x + y * y)).min(1.0);
    let scale = (1.0 - quarter).sqrt();
    DVec3::new(1.0 - 2.0 * quarter, scale * x, scale * y)
}

/// Longitude and latitude of a point of the plane.
fn place(x: f64, y: f64) -> [Angle; 2] {
    let normal = normal_at(x, y);
    [normal.y.atan2(normal.x), normal.z.clamp(-1.0, 1.0).asin()].map(Angle::from_rad)
}

fn halved<T: Mixed>(map: &[T], width: usize, level: u32) -> (Vec<T>, usize) {
    let half = width / 2;
    let mean = |at: usize| {
        let first = at / half * 2 * width + at % half * 2;
        T::mixed([first, first + 1, first + width, first + width + 1].map(|at| (map[at], 0.25)))
    };
    let map: Vec<T> = (0..half / 2 * half).map(mean).collect();
    if level > 1 { halved(&map, half, level - 1) } else { (map, half) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn normal(longitude_deg: f64, latitude_deg: f64) -> DVec3 {
        let (sin, cos) = Angle::from_deg(longitude_deg).sin_cos();
        let (up, level) = Angle::from_deg(latitude_deg).sin_cos();
        DVec3::new(level * cos, level * sin, up)
    }

    /// A map whose values are smooth functions of the place.
    fn map(width: usize) -> Vec<[f32; 3]> {
        (0..width * width / 2)
            .map(|at| {
                let turn = 360.0 / width as f64;
                let longitude_deg = (at % width) as f64 * turn + 0.5 * turn - 180.0;
                let latitude_deg = 90.0 - (at / width) as f64 * turn - 0.5 * turn;
                let n = normal(longitude_deg, latitude_deg);
                [n.x as f32, n.y as f32, n.z as f32]
            })
            .collect()
    }

    #[test]
    fn places_keep_their_values() {
        for (level, tolerance) in [(0, 6e-4), (1, 2.5e-3)] {
            let near = NearSide::of(&map(360), 360, level);
            for [longitude, latitude] in [
                [0.0, 0.0],
                [30.0, 40.0],
                [-95.0, 10.0],
                [100.0, -5.0],
                [10.0, 89.0],
                [170.0, -88.0],
            ] {
                let n = normal(longitude, latitude);
                let got = near.at(n).unwrap();
                let off = (DVec3::from(got.map(f64::from)) - n).length();
                assert!(off < tolerance, "{level} {longitude} {latitude}: {off}");
            }
        }
    }

    #[test]
    fn beyond_its_edge_it_has_nothing() {
        let near = NearSide::of(&map(64), 64, 0);
        for longitude in [109.0, 180.0, -120.0] {
            assert_eq!(near.at(normal(longitude, 0.0)), None);
        }
    }
}

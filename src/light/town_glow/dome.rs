//! The artificial sky on a grid of altitudes and azimuths.

use std::f64::consts::PI;

use super::*;

/// Rows, from the horizon to the zenith, and columns, from north through east.
const ROWS: usize = 91;
pub(super) const COLUMNS: usize = 180;
/// Well below any light; what logarithms are taken of.
const DARK: f64 = 1e-300;
/// No direction is darker than this part of the zenith: away from a far town, low down, where light that
/// is scattered once leaves nothing.
const LEAST_OF_ZENITH: f64 = 1e-4;

/// Light at every degree of altitude and every second of azimuth, W m-2 sr-1 per watt of lamp light
/// at each of the nodes.
#[derive(Debug)]
pub(super) struct Dome {
    nodes: Vec<NodeLight>,
    /// One if all azimuths are alike.
    columns: usize,
}

/// Azimuth of a column.
pub(super) fn azimuth_of(column: usize) -> f64 {
    2.0 * PI * column as f64 / COLUMNS as f64
}

impl Dome {
    /// From the light at the altitudes of the tables, a row of columns for each, or one column.
    pub fn new(rows: &[Vec<NodeLight>]) -> Dome {
        let columns = rows[0].len();
        let zenith = &rows[rows.len() - 1];
        let log = |column: usize, nodes: &NodeLight| -> NodeLight {
            let least = zenith[column].map(|v| (LEAST_OF_ZENITH * v).max(DARK));
            std::array::from_fn(|k| nodes[k].max(least[k]).ln())
        };
        let logs: Vec<Vec<NodeLight>> = rows
            .iter()
            .map(|row| row.iter().enumerate().map(|(column, nodes)| log(column, nodes)).collect())
            .collect();
        let nodes = (0..ROWS * columns)
            .into_par_iter()
            .map(|i| cubic((i / columns) as f64, |row| &logs[row][i % columns]))
            .collect();
        Dome { nodes, columns }
    }

    pub fn nodes(&self) -> &[NodeLight] {
        &self.nodes
    }

    /// The four nodes around a direction, with their weights.
    #[inline]
    pub fn around(&self, altitude: Angle, azimuth: Angle) -> impl Iterator<Item = (usize, f64)> {
        // Written so that a direction that is no number is the north.
        let row = altitude.deg().max(0.0).min((ROWS - 1) as f64);
        let turn = azimuth.rad() / (2.0 * PI);
        let column = ((turn - turn.floor()) * self.columns as f64).max(0.0);
        let low = (row as usize).min(ROWS - 2);
        let (left, up, east) = (column as usize, row - low as f64, column.fract());
        let (left, right) = (left % self.columns, (left + 1) % self.columns);
        let (here, above) = (low * self.columns, (low + 1) * self.columns);
        [
            (here + left, (1.0 - up) * (1.0 - east)),
            (here + right, (1.0 - up) * east),
            (above + left, up * (1.0 - east)),
            (above + right, up * east),
        ]
        .into_iter()
    }

    /// The solid angle of each node as level ground sees it, steradians; their sum is pi.
    pub fn projected_solid_angles(&self) -> impl Iterator<Item = f64> {
        (0..ROWS).flat_map(|row| {
            // Light is straight between rows; the integral of sine times cosine under a hat.
            let hat = |other: f64| {
                (0..8)
                    .map(|k| {
                        let t = (f64::from(k) + 0.5) / 8.0;
                        let altitude = (row as f64 + other * t).to_radians();
                        (1.0 - t) * altitude.sin() * altitude.cos() / 8.0 * 1f64.to_radians()
                    })
                    .sum::<f64>()
            };
            let below = if row > 0 { hat(-1.0) } else { 0.0 };
            let above = if row + 1 < ROWS { hat(1.0) } else { 0.0 };
            std::iter::repeat_n((below + above) * 2.0 * PI / self.columns as f64, self.columns)
        })
    }
}

/// Between the altitudes of the tables by a cubic in logarithms that rises and falls with its nodes: the
/// slopes are the weighted harmonic means of those to both sides (Fritsch & Butland 1984, *SIAM J. Sci.
/// Stat. Comput.* 5, 300).
fn cubic<'a>(altitude_deg: f64, at: impl Fn(usize) -> &'a NodeLight) -> NodeLight {
    let x = &ALTITUDES_DEG;
    let last = x.len() - 1;
    let i = x.partition_point(|&a| a <= altitude_deg).clamp(1, last) - 1;
    let width = x[i + 1] - x[i];
    let t = (altitude_deg - x[i]) / width;
    let slope = |j: usize, k: usize| {
        let secant = |j: usize| (at(j + 1)[k] - at(j)[k]) / (x[j + 1] - x[j]);
        if j == 0 {
            return secant(0);
        }
        if j == last {
            // The zenith is level.
            return 0.0;
        }
        let (before, after) = (secant(j - 1), secant(j));
        if before * after <= 0.0 {
            return 0.0;
        }
        let (short, long) = (x[j] - x[j - 1], x[j + 1] - x[j]);
        let (a, b) = (2.0 * long + short, long + 2.0 * short);
        (a + b) / (a / before + b / after)
    };
    std::array::from_fn(|k| {
        let (a, b) = (at(i)[k], at(i + 1)[k]);
        let (from, to) = (slope(i, k) * width, slope(i + 1, k) * width);
        let (t2, t3) = (t * t, t * t * t);
        let log = (2.0 * t3 - 3.0 * t2 + 1.0) * a
            + (t3 - 2.0 * t2 + t) * from
            + (3.0 * t2 - 2.0 * t3) * b
            + (t3 - t2) * to;
        if log <= DARK.ln() * 0.99 { 0.0 } else { log.exp() }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_sky_lights_the_ground_with_pi_of_its_radiance() {
        for columns in [1, COLUMNS] {
            an_even_sky(columns);
        }
    }

    fn an_even_sky(columns: usize) {
        let even = vec![vec![[2.0; SKY_NODES_NM.len()]; columns]; ALTITUDES_DEG.len()];
        let dome = Dome::new(&even);
        let sum: f64 = dome.projected_solid_angles().sum();
        assert!((sum / PI - 1.0).abs() < 1e-3, "{sum}");
        assert!(dome.nodes().iter().flatten().all(|v| (v - 2.0).abs() < 1e-9));
        for (altitude, azimuth) in [(0.0, 0.0), (90.0, 359.99), (33.3, -77.0), (-5.0, 720.0)] {
            let around = dome.around(Angle::from_deg(altitude), Angle::from_deg(azimuth));
            assert!((around.map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }
}

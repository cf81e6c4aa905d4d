//! From a few wavelengths to a spectrum.
//!
//! `ln L(targets) = B ln L(nodes)`, with `B = C_f C^-1` the best linear estimate under a covariance
//! that knows a free level, a smooth shape and the Chappuis bands of ozone:
//! `C(a, b) = 100 + 9 exp(-(a-b)^2 / (2 90^2)) + 30 s(a) s(b)`, `s = sigma_O3 / 1e-25 m2`,
//! wavelengths in nm. Measured for clear skies from noon to 18 degrees of twilight, on the nodes
//! below: 0.3 % at most in X, Y, Z and V.

use super::lanes::{LANES, Lanes};
use crate::air::cross_section::ozone_cross_section_m2;

/// Eight wavelengths from which clear-sky spectra are rebuilt well, nm.
pub const SKY_NODES_NM: [f64; 8] = [385.0, 400.0, 450.0, 505.0, 545.0, 595.0, 635.0, 665.0];

/// Keeps the covariance of nodes invertible; far below any error of the estimate.
const RIDGE: f64 = 1e-6;

/// By how much, in natural logarithms, light between and beyond the nodes may exceed that of the
/// brightest: what holds for every sky that is seen, and ends the extrapolation of air that lets
/// through next to nothing.
const BEYOND_NODES: f64 = 3.0;

/// A matrix, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Matrix {
    pub fn rows(&self) -> usize {
        self.rows
    }
    pub fn columns(&self) -> usize {
        self.columns
    }
    pub fn row(&self, i: usize) -> &[f64] {
        &self.values[i * self.columns..][..self.columns]
    }
    /// The spectrum at the targets (rows) from radiances at the nodes (columns), all positive:
    /// the matrix acts on logarithms. No light at some node is no light at all.
    pub fn spectrum(&self, node_values: &[f64]) -> Vec<f64> {
        debug_assert_eq!(node_values.len(), self.columns);
        if node_values.iter().any(|&v| v <= 0.0) {
            return vec![0.0; self.rows];
        }
        let logs: Vec<f64> = node_values.iter().map(|v| v.ln()).collect();
        let most = logs.iter().copied().fold(f64::MIN, f64::max) + BEYOND_NODES;
        let log = |i: usize| self.row(i).iter().zip(&logs).map(|(b, l)| b * l).sum::<f64>();
        (0..self.rows).map(|i| log(i).min(most).exp()).collect()
    }
}

/// How many sums [`SpectralSums`] makes: X, Y, Z and V.
pub const SUMS: usize = 4;

/// Sums over the rebuilt spectrum, each wavelength weighed: [`Matrix::spectrum`] and what eyes make of
/// it in one step, in single precision, eight wavelengths at a time. Within 1e-5 of the long way.
#[derive(Debug, Clone)]
pub struct SpectralSums {
    nodes: usize,
    /// For eight targets: a row of the matrix for each node, then their weights for each sum.
    groups: Vec<(Vec<Lanes>, [Lanes; SUMS])>,
}

impl SpectralSums {
    /// The weights go with the rows of the matrix.
    pub fn new(matrix: &Matrix, weights: &[[f64; SUMS]]) -> SpectralSums {
        debug_assert_eq!(weights.len(), matrix.rows());
        let group = |first: usize| {
            let value = |i: usize, of: &dyn Fn(usize) -> f64| {
                if first + i < matrix.rows() { of(first + i) } else { 0.0 }
            };
            let rows = (0..matrix.columns())
                .map(|node| Lanes::from_fn(|i| value(i, &|target| matrix.row(target)[node])))
                .collect();
            let sums = std::array::from_fn(|sum| {
                Lanes::from_fn(|i| value(i, &|target| weights[target][sum]))
            });
            (rows, sums)
        };
        SpectralSums {
            nodes: matrix.columns(),
            groups: (0..matrix.rows()).step_by(LANES).map(group).collect(),
        }
    }

    /// The sums for light at the nodes; no light at some node is no light at all.
    pub fn apply(&self, nodes: &[f32]) -> [f32; SUMS] {
        /// Well below any light, and safe to take a logarithm of.
        const DARK: f32 = 1e-36;
        debug_assert_eq!(nodes.len(), self.nodes);
        if nodes.iter().any(|&value| value <= DARK) {
            return [0.0; SUMS];
        }
        let logs: Vec<f32> = nodes.iter().map(|value| value.ln()).collect();
        let most = logs.iter().copied().fold(f32::MIN, f32::max) + BEYOND_NODES as f32;
        let mut sums = [Lanes::ZERO; SUMS];
        for (rows, weights) in &self.groups {
            let mut ln = Lanes::ZERO;
            for (row, log) in rows.iter().zip(&logs) {
                ln += *row * *log;
            }
            let light = ln.map(|ln| ln.min(most)).exp();
            for (sum, weight) in sums.iter_mut().zip(weights) {
                *sum += light * *weight;
            }
        }
        sums.map(|lanes| lanes.0.iter().sum())
    }
}

fn covariance(a_nm: f64, b_nm: f64) -> f64 {
    let d = (a_nm - b_nm) / 90.0;
    let ozone = |nm| ozone_cross_section_m2(nm) / 1e-25;
    100.0 + 9.0 * (-0.5 * d * d).exp() + 30.0 * ozone(a_nm) * ozone(b_nm)
}

/// The matrix that takes logarithms at different `nodes_nm` to logarithms at `targets_nm`.
pub fn reconstruction_matrix(nodes_nm: &[f64], targets_nm: &[f64]) -> Matrix {
    let n = nodes_nm.len();
    // Cholesky: C = L L^T.
    let mut lower = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let ridge = if i == j { RIDGE } else { 0.0 };
            let rest: f64 = (0..j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
            let value = covariance(nodes_nm[i], nodes_nm[j]) + ridge - rest;
            lower[i * n + j] =
                if i == j { value.max(RIDGE * RIDGE).sqrt() } else { value / lower[j * n + j] };
        }
    }
    let mut values = Vec::with_capacity(targets_nm.len() * n);
    for &target in targets_nm {
        let mut b: Vec<f64> = nodes_nm.iter().map(|&node| covariance(target, node)).collect();
        for i in 0..n {
            let rest: f64 = (0..i).map(|k| lower[i * n + k] * b[k]).sum();
            b[i] = (b[i] - rest) / lower[i * n + i];
        }
        for i in (0..n).rev() {
            let rest: f64 = (i + 1..n).map(|k| lower[k * n + i] * b[k]).sum();
            b[i] = (b[i] - rest) / lower[i * n + i];
        }
        values.extend(b);
    }
    Matrix { rows: targets_nm.len(), columns: n, values }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::cross_section::rayleigh_cross_section_m2;

    #[test]
    fn nodes_are_kept() {
        let b = reconstruction_matrix(&SKY_NODES_NM, &SKY_NODES_NM);
        let spectrum = [0.07, 0.06, 0.04, 0.02, 0.015, 0.008, 0.006, 0.005];
        for (got, want) in b.spectrum(&spectrum).iter().zip(spectrum) {
            assert!((got / want - 1.0).abs() < 1e-3, "{got} {want}");
        }
    }

    #[test]
    fn light_through_ozone_and_air_is_rebuilt() {
        let light = |nm: f64| {
            let scattered = 3e29 * rayleigh_cross_section_m2(nm);
            (-(2e24 * ozone_cross_section_m2(nm)) - scattered).exp() * scattered
        };
        let targets: Vec<f64> = (0..29).map(|i| 390.0 + 10.0 * f64::from(i)).collect();
        let b = reconstruction_matrix(&SKY_NODES_NM, &targets);
        let spectrum = b.spectrum(&SKY_NODES_NM.map(light));
        for (nm, got) in targets.iter().zip(spectrum) {
            assert!((got / light(*nm) - 1.0).abs() < 0.01, "{nm} nm: {got} {}", light(*nm));
        }
    }

    #[test]
    fn the_short_way_gives_the_sums_of_the_long_one() {
        let targets: Vec<f64> = (0..95).map(|i| 360.0 + 5.0 * f64::from(i)).collect();
        let matrix = reconstruction_matrix(&SKY_NODES_NM, &targets);
        let weights: Vec<[f64; SUMS]> = targets
            .iter()
            .map(|nm| [600.0, 550.0, 450.0, 500.0].map(|c| (-((nm - c) / 40.0).powi(2)).exp()))
            .collect();
        let sums = SpectralSums::new(&matrix, &weights);
        for scale in [1.0f32, 1e-12] {
            let nodes = [0.07, 0.06, 0.04, 0.02, 0.015, 0.008, 0.006, 0.005].map(|v| v * scale);
            let spectrum = matrix.spectrum(&nodes.map(f64::from));
            for (i, got) in sums.apply(&nodes).into_iter().enumerate() {
                let want: f64 = spectrum.iter().zip(&weights).map(|(s, w)| s * w[i]).sum();
                assert!((f64::from(got) / want - 1.0).abs() < 1e-5, "{i}: {got} {want}");
            }
        }
        assert_eq!(sums.apply(&[0.0; 8]), [0.0; SUMS]);
    }

    #[test]
    fn darkness_stays_dark() {
        let b = reconstruction_matrix(&[450.0, 550.0], &[500.0]);
        assert_eq!(b.spectrum(&[0.0, 1.0]), [0.0]);
        assert_eq!((b.rows(), b.columns()), (1, 2));
    }
}

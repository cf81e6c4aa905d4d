//! Chebyshev polynomials: nodes, interpolation, evaluation, powers.

use std::f64::consts::PI;

use glam::DVec3;

/// Interpolation at the extrema of `T_n` (Lobatto nodes), which include both borders.
pub(super) struct Lobatto {
    /// `cos(pi j / n)` for j = 0..=n: from +1 to -1.
    pub nodes: Vec<f64>,
    /// Row k: what the values at the nodes give to the coefficient of `T_k`.
    weights: Vec<f64>,
}

impl Lobatto {
    pub fn new(degree: usize) -> Lobatto {
        let n = degree;
        let node = |j: usize| match 2 * j {
            // The middle exactly, and both halves alike.
            twice if twice == n => 0.0,
            twice if twice < n => (PI * j as f64 / n as f64).cos(),
            _ => -(PI * (n - j) as f64 / n as f64).cos(),
        };
        let nodes: Vec<f64> = (0..=n).map(node).collect();
        let end = |index: usize| if index == 0 || index == n { 0.5 } else { 1.0 };
        // cos(pi j k / n) is a node again, or the one across.
        let cosine = |product: usize| {
            let turn = product % (2 * n);
            nodes[if turn > n { 2 * n - turn } else { turn }]
        };
        let weight = |k: usize, j: usize| 2.0 / n as f64 * end(k) * end(j) * cosine(j * k);
        let weights = (0..=n).flat_map(|k| (0..=n).map(move |j| (k, j)));
        let weights = weights.map(|(k, j)| weight(k, j)).collect();
        Lobatto { nodes, weights }
    }

    /// Coefficients of `T_0` to `T_n` of the polynomial through these values at the nodes.
    pub fn coefficients(&self, values: &[DVec3]) -> Vec<DVec3> {
        let rows = self.weights.chunks_exact(self.nodes.len());
        rows.map(|row| row.iter().zip(values).map(|(&weight, &value)| value * weight).sum())
            .collect()
    }
}

/// The sum of `c_n T_n(x)` (Clenshaw).
pub(super) fn sum(coefficients: &[DVec3], x: f64) -> DVec3 {
    let (mut next, mut after) = (DVec3::ZERO, DVec3::ZERO);
    for &c in coefficients.iter().skip(1).rev() {
        (next, after) = (c + next * (2.0 * x) - after, next);
    }
    coefficients.first().copied().unwrap_or_default() + next * x - after
}

/// Row n: coefficients of the powers of x in `T_n`, up to a degree.
pub(super) fn power_table(degree: usize) -> Vec<Vec<f64>> {
    let mut table: Vec<Vec<f64>> = vec![vec![1.0], vec![0.0, 1.0]];
    for n in 2..=degree {
        let mut row = vec![0.0; n + 1];
        for (power, c) in table[n - 1].iter().enumerate() {
            row[power + 1] += 2.0 * c;
        }
        for (power, c) in table[n - 2].iter().enumerate() {
            row[power] -= c;
        }
        table.push(row);
    }
    table.truncate(degree + 1);
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    fn smooth(x: f64) -> DVec3 {
        DVec3::new((1.3 * x).sin(), (0.7 * x + 0.2).exp(), 1.0 / (x + 3.0))
    }

    #[test]
    fn interpolation_goes_through_its_nodes_and_between() {
        for degree in [1, 2, 7, 18] {
            let lobatto = Lobatto::new(degree);
            let values: Vec<DVec3> = lobatto.nodes.iter().map(|&x| smooth(x)).collect();
            let coefficients = lobatto.coefficients(&values);
            for (&x, value) in lobatto.nodes.iter().zip(values) {
                assert!((sum(&coefficients, x) - value).length() < 1e-14, "{degree}, {x}");
            }
        }
        let lobatto = Lobatto::new(18);
        let values: Vec<DVec3> = lobatto.nodes.iter().map(|&x| smooth(x)).collect();
        let coefficients = lobatto.coefficients(&values);
        for x in [-0.99, -0.5, 0.123, 0.77] {
            assert!((sum(&coefficients, x) - smooth(x)).length() < 1e-13, "{x}");
        }
    }

    #[test]
    fn powers_are_the_polynomials_of_chebyshev() {
        let table = power_table(9);
        assert_eq!(table[5], [0.0, 5.0, 0.0, -20.0, 0.0, 16.0]);
        for (n, row) in table.iter().enumerate() {
            let x: f64 = 0.37;
            let powers: f64 = row.iter().rev().fold(0.0, |sum, c| sum * x + c);
            assert!((powers - (n as f64 * x.acos()).cos()).abs() < 1e-13, "{n}");
        }
        assert_eq!(power_table(0), [[1.0]]);
    }
}

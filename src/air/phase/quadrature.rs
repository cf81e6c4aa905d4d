//! Gauss-Legendre quadrature and Legendre polynomials.

use std::f64::consts::PI;

/// Nodes and weights on `[0, 1]`, by Newton's method on the Legendre polynomial.
pub(crate) fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let mut nodes: Vec<(f64, f64)> = (0..n)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..50 {
                let (mut p, mut q) = (1.0, x); // P_0, P_1
                for k in 1..n {
                    (p, q) = (q, ((2 * k + 1) as f64 * x * q - k as f64 * p) / (k + 1) as f64);
                }
                slope = n as f64 * (x * q - p) / (x * x - 1.0);
                let step = q / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect();
    nodes.reverse();
    nodes
}

/// The Legendre polynomial of degree `l`.
pub(crate) fn legendre(l: usize, x: f64) -> f64 {
    let (mut p, mut q) = (1.0, x);
    for k in 1..=l {
        (p, q) = (q, ((2 * k + 1) as f64 * x * q - k as f64 * p) / (k + 1) as f64);
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_is_exact_for_polynomials() {
        for n in [1, 2, 5, 10, 24] {
            for power in 0..2 * n {
                let got: f64 =
                    gauss_legendre(n).iter().map(|&(t, w)| w * t.powi(power as i32)).sum();
                assert!((got - 1.0 / (power + 1) as f64).abs() < 1e-13, "{n} nodes, t^{power}");
            }
        }
    }

    #[test]
    fn polynomials_read_as_in_the_books() {
        let x: f64 = 0.3;
        assert_eq!((legendre(0, x), legendre(1, x)), (1.0, x));
        assert!((legendre(2, x) - 0.5 * (3.0 * x * x - 1.0)).abs() < 1e-15);
        assert!((legendre(3, x) - 0.5 * (5.0 * x.powi(3) - 3.0 * x)).abs() < 1e-15);
    }
}

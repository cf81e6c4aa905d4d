//! To whole numbers with an eye on the sum: what one coefficient loses, the next ones make good.
//!
//! Rounding every coefficient by itself adds errors as if they were strangers. But the terms
//! `T_n - T_(n mod 2)` overlap, so from the highest degree downwards each coefficient is rounded not
//! to its own value, but to the one that serves best with all that was rounded before it: borders,
//! higher degrees, and the degrees that are not stored at all. This is the nearest plane algorithm of
//! Babai 1986, *Combinatorica* 6, 1, in the mean square over the arc cosine of x: its errors are as
//! large near the borders as in the middle.

use std::f64::consts::FRAC_PI_2;

/// The geometry of the terms of one degree: made once for a channel.
pub(super) struct Rounding {
    /// `triangle[i][j]`, j >= i: how much of term j lies along what term i adds to those before it;
    /// from degree 2 on.
    triangle: Vec<Vec<f64>>,
    /// The same of the lines that fall from the first border, and rise to the last.
    borders: Vec<[f64; 2]>,
}

impl Rounding {
    /// For coefficients that are stored up to `degree` and known up to `known`.
    pub fn new(degree: usize, known: usize) -> Rounding {
        // Gauss points of Chebyshev's weight, enough to make every mean product exact.
        let points = known + 1;
        let angle = |i: usize| (2 * i + 1) as f64 / points as f64 * FRAC_PI_2;
        let xs: Vec<f64> = (0..points).map(|i| angle(i).cos()).collect();
        let term = |n: usize| -> Vec<f64> {
            let line = |x: f64| if n.is_multiple_of(2) { 1.0 } else { x };
            xs.iter().map(|&x| (n as f64 * x.acos()).cos() - line(x)).collect()
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut axes: Vec<Vec<f64>> = Vec::new();
        for n in 2..=degree {
            let mut axis = term(n);
            for other in &axes {
                let along = dot(&axis, other);
                axis.iter_mut().zip(other).for_each(|(value, other)| *value -= along * other);
            }
            let length = dot(&axis, &axis).sqrt();
            axis.iter_mut().for_each(|value| *value /= length);
            axes.push(axis);
        }
        let terms: Vec<Vec<f64>> = (2..=known).map(term).collect();
        let falling: Vec<f64> = xs.iter().map(|x| 0.5 * (1.0 - x)).collect();
        let rising: Vec<f64> = xs.iter().map(|x| 0.5 * (1.0 + x)).collect();
        Rounding {
            triangle: axes.iter().map(|a| terms.iter().map(|t| dot(a, t)).collect()).collect(),
            borders: axes.iter().map(|a| [dot(a, &falling), dot(a, &rising)]).collect(),
        }
    }

    /// The numbers to store of one component, from degree 2 on. `coefficients` begin there and go on
    /// to the highest degree that is known; `border_errors` are stored minus true. All in quanta.
    pub fn round(&self, coefficients: &[f64], border_errors: [f64; 2]) -> Vec<i64> {
        let stored = self.triangle.len();
        let mut errors: Vec<f64> = coefficients.iter().map(|c| -c).collect();
        let mut numbers = vec![0; stored];
        for i in (0..stored).rev() {
            let row = &self.triangle[i];
            let higher: f64 = (i + 1..coefficients.len()).map(|j| row[j] * errors[j]).sum();
            let [first, last] = self.borders[i];
            let so_far = higher + first * border_errors[0] + last * border_errors[1];
            let number = (coefficients[i] - so_far / row[i]).round();
            errors[i] = number - coefficients[i];
            numbers[i] = number as i64;
        }
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean square of what numbers miss, over the arc cosine.
    fn missed(coefficients: &[f64], numbers: &[i64], border_errors: [f64; 2]) -> f64 {
        let at = |x: f64| {
            let [first, last] = border_errors;
            let mut sum = 0.5 * (first * (1.0 - x) + last * (1.0 + x));
            for (index, c) in coefficients.iter().enumerate() {
                let n = index + 2;
                let line = if n % 2 == 0 { 1.0 } else { x };
                let number = numbers.get(index).map_or(0.0, |&number| number as f64);
                sum += (number - c) * ((n as f64 * x.acos()).cos() - line);
            }
            sum * sum
        };
        (0..1000).map(|i| at((FRAC_PI_2 * f64::from(2 * i + 1) / 1000.0).cos())).sum::<f64>() / 1e3
    }

    #[test]
    fn rounding_together_misses_less_than_rounding_alone() {
        let rounding = Rounding::new(18, 20);
        let (mut together, mut alone) = (0.0, 0.0);
        for case in 0..50 {
            let noise = |i: usize| {
                let seed = (case * 31 + i) as f64;
                ((seed * 12.9898).sin() * 43_758.545_3).fract()
            };
            let coefficients: Vec<f64> = (2..=20)
                .map(|n| if n > 18 { 0.2 * noise(n) } else { 1e4 * noise(n) / (n * n) as f64 })
                .collect();
            let borders = [0.5 * noise(0), 0.5 * noise(1)];
            let each: Vec<i64> = coefficients[..17].iter().map(|c| c.round() as i64).collect();
            alone += missed(&coefficients, &each, borders);
            together += missed(&coefficients, &rounding.round(&coefficients, borders), borders);
        }
        assert!(together < 0.7 * alone, "{together} {alone}");
    }

    #[test]
    fn whole_numbers_stay_as_they_are() {
        let coefficients = [1e9, -77.0, 3.0, 0.0, 1.0];
        let numbers = Rounding::new(6, 6).round(&coefficients, [0.0, 0.0]);
        assert_eq!(numbers, coefficients.map(|c| c as i64));
    }
}

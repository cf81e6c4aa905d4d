//! A smooth function on a span of time, as the polynomial through its values at Chebyshev points.
//!
//! *Theory.* The points are the extrema of a Chebyshev polynomial, both ends of the span among them
//! (Trefethen 2013, *Approximation Theory and Approximation Practice*, chapters 2 to 4): the
//! polynomial of degree `n` through them is off by little more than the coefficients that it lacks,
//! and those fall faster than any power. The last coefficients therefore tell whether the span was
//! short enough. Value and slope are summed by Clenshaw's recurrence.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Degree of every polynomial here.
pub const DEGREE: usize = 24;
/// Values that one takes.
pub const POINTS: usize = DEGREE + 1;

/// The last coefficients, from which the size of the noise is taken.
const NOISE_COEFFICIENTS: usize = 6;

type Coefficients = [f64; POINTS];

/// Where in `[-1, 1]` the values are taken, upwards.
pub static NODES: LazyLock<Coefficients> =
    LazyLock::new(|| std::array::from_fn(|k| -(PI * k as f64 / DEGREE as f64).cos()));

/// `T_j` at each node, with the weights of the discrete cosine transform.
static TRANSFORM: LazyLock<[Coefficients; POINTS]> = LazyLock::new(|| {
    let half_at_ends = |index: usize| if index == 0 || index == DEGREE { 0.5 } else { 1.0 };
    std::array::from_fn(|j| {
        let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
        let weight = |k: usize| 2.0 / DEGREE as f64 * half_at_ends(j) * half_at_ends(k) * sign;
        // The nodes run upwards, the cosine downwards: T_j changes its sign for odd j.
        std::array::from_fn(|k| {
            weight(k) * (PI * ((j * k) % (2 * DEGREE)) as f64 / DEGREE as f64).cos()
        })
    })
});

/// A polynomial on `[-1, 1]`, with its slope.
#[derive(Debug, Clone)]
pub struct Polynomial {
    value: Coefficients,
    slope: Coefficients,
}

impl Polynomial {
    /// Through values at [`NODES`].
    pub fn through(values: &Coefficients) -> Polynomial {
        let sum = |row: &Coefficients| row.iter().zip(values).map(|(a, b)| a * b).sum();
        let value: Coefficients = std::array::from_fn(|j| sum(&TRANSFORM[j]));
        Polynomial { slope: differentiated(&value), value }
    }

    /// The straight line between values at -1 and 1.
    pub fn between(first: f64, last: f64) -> Polynomial {
        Polynomial::through(&NODES.map(|x| 0.5 * (first * (1.0 - x) + last * (1.0 + x))))
    }

    /// Without the coefficients at the end that are noise of the values, a step of a table or rounding:
    /// slopes would magnify it by the square of their degree.
    pub fn without_noise(&self) -> Polynomial {
        let last = &self.value[POINTS - NOISE_COEFFICIENTS..];
        let noise = 2.0 * last.iter().fold(0.0f64, |most, c| most.max(c.abs()));
        let mut value = self.value;
        for c in value.iter_mut().rev().take_while(|c| c.abs() <= noise) {
            *c = 0.0;
        }
        Polynomial { slope: differentiated(&value), value }
    }

    /// Its derivative with respect to the variable in `[-1, 1]`.
    pub fn derivative(&self) -> Polynomial {
        Polynomial { value: self.slope, slope: differentiated(&self.slope) }
    }

    /// Value and slope at `x` in `[-1, 1]`.
    pub fn at(&self, x: f64) -> (f64, f64) {
        let (mut v1, mut v2, mut s1, mut s2) = (0.0, 0.0, 0.0, 0.0);
        for j in (1..POINTS).rev() {
            (v1, v2) = (2.0 * x * v1 - v2 + self.value[j], v1);
            (s1, s2) = (2.0 * x * s1 - s2 + self.slope[j], s1);
        }
        (x * v1 - v2 + self.value[0], x * s1 - s2 + self.slope[0])
    }

    /// Size of the last coefficients: how far the polynomial may be from the function.
    pub fn tail(&self) -> f64 {
        self.value[POINTS - 3..].iter().map(|c| c.abs()).sum()
    }

    /// Whether the value stays on one side of zero all over `[-1, 1]`, as far as sizes can tell.
    pub fn is_far_from_zero(&self) -> bool {
        self.value[0].abs() > sizes(&self.value[1..])
    }

    /// No second derivative in `[-1, 1]` is larger.
    pub fn bend_bound(&self) -> f64 {
        sizes(&differentiated(&self.slope))
    }
}

/// A bound of a sum of Chebyshev polynomials, each of which stays within 1.
fn sizes(coefficients: &[f64]) -> f64 {
    coefficients.iter().map(|c| c.abs()).sum()
}

/// Coefficients of the derivative: `d_(j-1) = d_(j+1) + 2 j c_j`, the first one halved.
fn differentiated(c: &Coefficients) -> Coefficients {
    let mut d = [0.0; POINTS];
    for j in (1..POINTS).rev() {
        let beyond = if j + 1 < POINTS { d[j + 1] } else { 0.0 };
        d[j - 1] = beyond + 2.0 * j as f64 * c[j];
    }
    d[0] *= 0.5;
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(function: impl Fn(f64) -> f64) -> Polynomial {
        Polynomial::through(&std::array::from_fn(|k| function(NODES[k])))
    }

    #[test]
    fn a_sine_and_its_derivatives_are_followed() {
        let p = of(|x| (6.0 * x + 0.3).sin());
        for step in 0..=100 {
            let x = step as f64 / 50.0 - 1.0;
            let (sin, cos) = (6.0 * x + 0.3).sin_cos();
            let ((value, slope), (same, bend)) = (p.at(x), p.derivative().at(x));
            assert!((value - sin).abs() < 1e-11, "{x}");
            assert!((slope - 6.0 * cos).abs() < 1e-9 && same == slope, "{x}");
            assert!((bend + 36.0 * sin).abs() < 1e-6 && bend.abs() <= p.bend_bound(), "{x}");
        }
    }

    #[test]
    fn slopes_do_not_follow_noise() {
        let noise = |x: f64| 1e-6 * (1e5 * x * x).sin();
        let noisy = of(|x| x.cos() + noise(x));
        let worst = |p: &Polynomial| {
            let error = |k: i32| {
                let x = f64::from(k) / 100.0;
                (p.at(x).1 + x.sin()).abs()
            };
            (-100..=100).map(error).fold(0.0, f64::max)
        };
        assert!(worst(&noisy.without_noise()) < 0.2 * worst(&noisy));
        let smooth = of(f64::cos);
        assert!(worst(&smooth.without_noise()) < 1e-10);
    }

    #[test]
    fn the_tail_tells_what_is_not_smooth_enough() {
        assert!(of(|x| (6.0 * x).sin()).tail() < 1e-11);
        assert!(of(|x| (20.0 * x).sin()).tail() > 1e-3);
        assert!(of(|x| (x - 0.1).signum()).tail() > 1e-2);
    }

    #[test]
    fn what_stays_away_from_zero_is_known_to() {
        assert!(of(|x| 2.0 + x.sin()).is_far_from_zero());
        assert!(!of(|x| 0.5 + x.sin()).is_far_from_zero());
    }
}

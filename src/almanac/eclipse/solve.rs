//! Where a function of time is zero, and where it is smallest.

/// Seconds to which an instant is found.
const PRECISION_S: f64 = 1e-3;

/// Half the step of the differences that stand for a slope, seconds.
///
/// The third derivative shifts a minimum by a sixth of its square over the hours in which the
/// motion changes: below 0.001 s.
const SLOPE_STEP_S: f64 = 4.0;

/// The zero of `f` between `a` and `b`, seconds; `None` if both ends have the same sign.
///
/// The ITP method: Oliveira & Takahashi 2020, *ACM Trans. Math. Softw.* 47, 5, algorithm 1, with
/// their constants `k1 = 0.2 / (b - a)`, `k2 = 2`, `n0 = 1`. Never slower than bisection by more
/// than one step.
pub fn root(f: impl Fn(f64) -> f64, a: f64, b: f64) -> Option<f64> {
    let (fa, fb) = (f(a), f(b));
    if fa == 0.0 || fb == 0.0 {
        return Some(if fa == 0.0 { a } else { b });
    }
    if fa.signum() == fb.signum() {
        return None;
    }
    let sign = fb.signum();
    let (mut a, mut b, mut ya, mut yb) = (a, b, fa * sign, fb * sign);
    let k1 = 0.2 / (b - a);
    let bisections = ((b - a) / (2.0 * PRECISION_S)).log2().ceil().max(0.0) as i32;
    for step in 0..=bisections + 1 {
        if b - a <= 2.0 * PRECISION_S {
            break;
        }
        let middle = 0.5 * (a + b);
        let reach = PRECISION_S * 2f64.powi(bisections + 1 - step) - 0.5 * (b - a);
        // Interpolate, truncate towards the middle, project into reach of it.
        let secant = (yb * a - ya * b) / (yb - ya);
        let towards = (middle - secant).signum();
        let shift = k1 * (b - a) * (b - a);
        let truncated =
            if shift <= (middle - secant).abs() { secant + towards * shift } else { middle };
        let x =
            if (truncated - middle).abs() <= reach { truncated } else { middle - towards * reach };
        let y = f(x) * sign;
        if y > 0.0 {
            (b, yb) = (x, y);
        } else if y < 0.0 {
            (a, ya) = (x, y);
        } else {
            return Some(x);
        }
    }
    Some(0.5 * (a + b))
}

/// Where `f`, which falls from `a` to its only minimum and rises from there to `b`, is smallest.
///
/// `None` if the minimum does not lie between. `f` is asked a few seconds outside too.
pub fn minimum(f: impl Fn(f64) -> f64, a: f64, b: f64) -> Option<f64> {
    root(|t| f(t + SLOPE_STEP_S) - f(t - SLOPE_STEP_S), a, b)
}

/// Where `gap`, negative at `inside`, becomes positive on the way to `end`; `end` if it does not.
pub fn crossing(gap: impl Fn(f64) -> f64, inside: f64, end: f64) -> f64 {
    root(gap, inside.min(end), inside.max(end)).unwrap_or(end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_found_whatever_the_slope() {
        let zero = 1234.567;
        let functions: [fn(f64) -> f64; 4] = [
            |t| t - 1234.567,
            |t| (t - 1234.567).powi(3),
            |t| (1234.567 - t).signum() * (1234.567 - t).abs().sqrt(),
            |t| ((t - 1234.567) / 3000.0).exp_m1(),
        ];
        for f in functions {
            let found = root(f, -14_400.0, 14_400.0).unwrap();
            assert!((found - zero).abs() <= PRECISION_S, "{found}");
        }
        assert_eq!(root(|t| t * t + 1.0, -1.0, 1.0), None);
        assert_eq!(root(|t| t, 0.0, 5.0), Some(0.0));
    }

    #[test]
    fn a_minimum_is_found_smooth_or_sharp() {
        let smooth = minimum(|t| (t - 77.7).powi(2) + 1e-9 * t.powi(3), -9000.0, 9000.0).unwrap();
        // 2 (t - 77.7) + 3e-9 t^2 = 0
        assert!((smooth - 77.7 + 0.5 * 3e-9 * 77.7 * 77.7).abs() < 2e-3, "{smooth}");
        let sharp = minimum(|t| (t - 77.7).abs(), -9000.0, 9000.0).unwrap();
        assert!((sharp - 77.7).abs() < 2e-3, "{sharp}");
        assert_eq!(minimum(|t| t, -9000.0, 9000.0), None);
    }
}

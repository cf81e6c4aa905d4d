//! All zeros of a polynomial within a span, none missed and none twice.
//!
//! *Theory.* With a bound of the second derivative, value and slope at the middle of an interval
//! tell of the whole interval: far enough from zero there is none in it; steep enough, at most one,
//! and the signs at the ends tell whether. What cannot be told is cut in two. A grazing pair of zeros
//! closer than the narrowest interval, where the function changes by less than the noise of any
//! theory, counts as none; the number of crossings always agrees with the signs at the ends.
//!
//! The values at the ends are given, not taken from the polynomial: neighbouring spans share them, so
//! that a zero at their border belongs to exactly one of them. Zero counts as positive.

use super::chebyshev::Polynomial;

/// Intervals narrower than this (in units of half a span) are not cut.
const NARROWEST: f64 = 1e-7;
/// A zero is known when it moves by less.
const RESOLUTION: f64 = 1e-13;

/// A passage through zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// In `[-1, 1]`.
    pub at: f64,
    /// From below zero to above.
    pub is_rising: bool,
}

/// All crossings in the order of time; `ends` are the values at -1 and 1.
pub fn crossings(polynomial: &Polynomial, ends: [f64; 2]) -> Vec<Crossing> {
    let mut found = Vec::new();
    let [low, high] = ends.map(is_positive);
    if low != high || !polynomial.is_far_from_zero() {
        let search = Search { polynomial, bend: polynomial.bend_bound() };
        search.within((-1.0, low), (1.0, high), &mut found);
    }
    found
}

fn is_positive(value: f64) -> bool {
    value >= 0.0
}

/// A point and whether the function is positive there.
type Edge = (f64, bool);

struct Search<'a> {
    polynomial: &'a Polynomial,
    bend: f64,
}

impl Search<'_> {
    fn within(&self, low: Edge, high: Edge, found: &mut Vec<Crossing>) {
        let (middle, half) = (0.5 * (low.0 + high.0), 0.5 * (high.0 - low.0));
        let (value, slope) = self.polynomial.at(middle);
        let changes = low.1 != high.1;
        let is_clear = value.abs() > half * (slope.abs() + 0.5 * self.bend * half);
        let is_steep = slope.abs() > self.bend * half;
        if is_clear || is_steep || half < NARROWEST {
            if changes {
                found.push(Crossing { at: self.zero(low, high), is_rising: high.1 });
            }
            return;
        }
        let middle = (middle, is_positive(value));
        self.within(low, middle, found);
        self.within(middle, high, found);
    }

    /// The zero between two edges of different sign: Newton's steps, held between them.
    fn zero(&self, (mut low, is_positive_low): Edge, (mut high, _): Edge) -> f64 {
        let mut x = 0.5 * (low + high);
        // Halving alone takes 44 rounds from the whole span.
        for _ in 0..64 {
            let (value, slope) = self.polynomial.at(x);
            if is_positive(value) == is_positive_low {
                low = x
            } else {
                high = x
            }
            let newton = x - value / slope;
            let next = if (low..=high).contains(&newton) { newton } else { 0.5 * (low + high) };
            let step = (next - x).abs();
            x = next;
            if step < RESOLUTION {
                break;
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::almanac::chebyshev::NODES;
    use proptest::prelude::*;

    fn found(function: impl Fn(f64) -> f64) -> Vec<Crossing> {
        let values = std::array::from_fn(|k| function(NODES[k]));
        crossings(&Polynomial::through(&values), [function(-1.0), function(1.0)])
    }

    #[test]
    fn every_zero_of_a_wave_is_found_once() {
        let zeros = found(|x| (9.0 * x + 0.2).sin());
        assert_eq!(zeros.len(), 5);
        for (n, zero) in (-2..).zip(&zeros) {
            let expected = (std::f64::consts::PI * f64::from(n) - 0.2) / 9.0;
            assert!((zero.at - expected).abs() < 1e-9, "{n}: {zero:?}");
            assert_eq!(zero.is_rising, n % 2 == 0);
        }
    }

    #[test]
    fn grazing_zeros_are_told_from_none() {
        for gap in [1e-3, 1e-6, 1e-9] {
            let pair = found(|x| (x - 0.3) * (x - 0.3) - gap * gap);
            let is_told = gap > NARROWEST;
            assert_eq!(pair.len(), if is_told { 2 } else { 0 }, "{gap}: {pair:?}");
            assert!(found(|x| (x - 0.3) * (x - 0.3) + gap * gap + 1e-15).is_empty());
        }
    }

    #[test]
    fn the_given_signs_at_the_ends_decide() {
        let line = Polynomial::through(&std::array::from_fn(|k| NODES[k] + 1.0 + 1e-12));
        assert!(crossings(&line, [0.0, 2.0]).is_empty());
        let at_the_end = crossings(&line, [-1e-12, 2.0]);
        assert_eq!(at_the_end.len(), 1);
        assert!((at_the_end[0].at + 1.0).abs() < 1e-9 && at_the_end[0].is_rising);
    }

    proptest! {
        #[test]
        fn crossings_alternate_and_their_values_vanish(
            wave in 0.5f64..8.0, phase in -3.2f64..3.2, tilt in -2.0f64..2.0, level in -1.5f64..1.5,
        ) {
            let function = |x: f64| (wave * x + phase).sin() + tilt * x - level;
            let zeros = found(function);
            for pair in zeros.windows(2) {
                prop_assert!(pair[0].at < pair[1].at && pair[0].is_rising != pair[1].is_rising);
            }
            for zero in &zeros {
                prop_assert!(function(zero.at).abs() < 1e-8);
            }
            // As many as a fine comb catches, which may miss grazing pairs.
            let comb = |k: u32| function(f64::from(k) / 1000.0 - 1.0) >= 0.0;
            let caught = (0..2000).filter(|&k| comb(k) != comb(k + 1)).count();
            prop_assert!(zeros.len() >= caught && (zeros.len() - caught).is_multiple_of(2));
        }
    }
}

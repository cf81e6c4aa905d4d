//! Segments unfolded for use: plain polynomials in powers of time, made on the first touch.
//!
//! A piece of a segment holds its polynomial by pairs of powers: `x^0` of three components, `x^1` of
//! three components, and so on. Even and odd powers are two Horner chains in `x^2` that a processor
//! runs side by side. Powers instead of Chebyshev polynomials cost no digits here: a piece is short,
//! so that its higher terms are small.

use std::sync::OnceLock;

use glam::DVec3;

use super::COMPONENTS;
use super::chebyshev::{self, Lobatto};
use super::header::Folding;
use crate::time::{JulianDate, Tdb};

/// Numbers that belong to a pair of powers.
const PAIR: usize = 2 * COMPONENTS;

/// All segments of a channel at one depth, empty until they are touched.
pub(super) struct Folded {
    start_jd: f64,
    piece_days: f64,
    pieces_per_day: f64,
    last_piece: u32,
    log2_pieces: u32,
    pairs: usize,
    segments: Box<[OnceLock<Box<[f64]>>]>,
    lobatto: Lobatto,
    power_table: Vec<Vec<f64>>,
}

/// A moment within a piece.
struct Spot {
    piece: u32,
    /// From -1 at the begin of the piece to +1 at its end.
    x: f64,
}

impl Folded {
    pub fn new(start_jd: f64, segment_days: f64, segments: u32, folding: Folding) -> Folded {
        let piece_days = segment_days / folding.pieces as f64;
        Folded {
            start_jd,
            piece_days,
            pieces_per_day: 1.0 / piece_days,
            last_piece: segments * folding.pieces as u32 - 1,
            log2_pieces: folding.pieces.ilog2(),
            pairs: folding.degree.div_ceil(2),
            segments: (0..segments).map(|_| OnceLock::new()).collect(),
            lobatto: Lobatto::new(folding.degree),
            power_table: chebyshev::power_table(folding.degree),
        }
    }

    /// The value; `unfold` gives a segment that has not been folded yet as a function of x, from -1
    /// at its begin to +1 at its end.
    #[inline]
    pub fn value<F: Fn(f64) -> DVec3>(
        &self,
        tdb: JulianDate<Tdb>,
        unfold: impl FnOnce(usize) -> F,
    ) -> DVec3 {
        let spot = self.spot(tdb);
        let square = spot.x * spot.x;
        let mut sum = [0.0; PAIR];
        for pair in self.pairs(spot.piece, unfold).iter().rev() {
            for (sum, c) in sum.iter_mut().zip(pair) {
                *sum = *sum * square + c;
            }
        }
        joined(&sum, spot.x)
    }

    /// The value and its rate per day, the exact derivative of the same polynomial.
    #[inline]
    pub fn value_and_rate<F: Fn(f64) -> DVec3>(
        &self,
        tdb: JulianDate<Tdb>,
        unfold: impl FnOnce(usize) -> F,
    ) -> (DVec3, DVec3) {
        let spot = self.spot(tdb);
        let square = spot.x * spot.x;
        let (mut sum, mut slope) = ([0.0; PAIR], [0.0; PAIR]);
        for pair in self.pairs(spot.piece, unfold).iter().rev() {
            for ((sum, slope), c) in sum.iter_mut().zip(&mut slope).zip(pair) {
                *slope = *slope * square + *sum;
                *sum = *sum * square + c;
            }
        }
        // (E(x^2) + x O(x^2))' = O + 2 x (E' + x O').
        let odd = DVec3::new(sum[3], sum[4], sum[5]);
        let rate = odd + joined(&slope, spot.x) * (2.0 * spot.x);
        (joined(&sum, spot.x), rate * (2.0 * self.pieces_per_day))
    }

    /// Which piece holds a moment. What lies outside by rounding belongs to the piece at the border.
    #[inline]
    fn spot(&self, tdb: JulianDate<Tdb>) -> Spot {
        let days = tdb.day() - self.start_jd;
        // Casting cuts off: the piece that has begun.
        let piece = (((days + tdb.fraction()) * self.pieces_per_day) as u32).min(self.last_piece);
        // Exact up to the last sum: days and lengths of pieces have few digits.
        let within = (days - f64::from(piece) * self.piece_days) + tdb.fraction();
        Spot { piece, x: within * (2.0 * self.pieces_per_day) - 1.0 }
    }

    #[inline]
    fn pairs<F: Fn(f64) -> DVec3>(
        &self,
        piece: u32,
        unfold: impl FnOnce(usize) -> F,
    ) -> &[[f64; PAIR]] {
        let segment = (piece >> self.log2_pieces) as usize;
        let within = piece as usize & ((1 << self.log2_pieces) - 1);
        let folded = match self.segments[segment].get() {
            Some(folded) => folded,
            None => self.fold(segment, unfold),
        };
        let length = self.pairs * PAIR;
        folded[within * length..(within + 1) * length].as_chunks().0
    }

    #[cold]
    #[inline(never)]
    fn fold<F: Fn(f64) -> DVec3>(&self, segment: usize, unfold: impl FnOnce(usize) -> F) -> &[f64] {
        self.segments[segment].get_or_init(|| {
            let unfolded = unfold(segment);
            let pieces = 1usize << self.log2_pieces;
            let mut folded = Vec::with_capacity(pieces * self.pairs * PAIR);
            for piece in 0..pieces {
                let x_in_segment =
                    |node: f64| ((2 * piece + 1) as f64 + node) / pieces as f64 - 1.0;
                let values: Vec<DVec3> =
                    self.lobatto.nodes.iter().map(|&x| unfolded(x_in_segment(x))).collect();
                folded.extend(self.powers(&self.lobatto.coefficients(&values)));
            }
            folded.into_boxed_slice()
        })
    }

    /// From coefficients of Chebyshev polynomials to those of powers.
    fn powers(&self, chebyshev: &[DVec3]) -> Vec<f64> {
        let mut powers = vec![0.0; self.pairs * PAIR];
        // The highest first, the smallest: their sums keep the digits.
        for (row, c) in self.power_table.iter().zip(chebyshev).rev() {
            for (factor, power) in row.iter().zip(powers.chunks_exact_mut(COMPONENTS)) {
                power[0] += factor * c.x;
                power[1] += factor * c.y;
                power[2] += factor * c.z;
            }
        }
        powers
    }
}

/// Even powers, and odd ones times x.
#[inline]
fn joined(sum: &[f64; PAIR], x: f64) -> DVec3 {
    DVec3::new(sum[0] + x * sum[3], sum[1] + x * sum[4], sum[2] + x * sum[5])
}

//! Looking through a stretch of time for the events of many functions at once.
//!
//! The stretch is cut into spans. On each of them every function is sampled at the same instants and
//! replaced by a polynomial (`chebyshev`), all of whose zeros are found (`crossing`).
//! Where a polynomial does not follow its function the span is halved. Sampling is the whole cost,
//! and one sample serves all functions.

use super::AlmanacError;
use super::chebyshev::{NODES, POINTS, Polynomial};
use super::crossing::crossings;
use crate::time::Instant;
use crate::units::DAY_S;

/// How far a polynomial may be from its function, which is of order one: 0.01" of an angle. Below
/// this lie the steps and kinks of tables of positions and of Delta-T.
const MISFIT: f64 = 5e-8;
/// Spans shorter than this are not halved: there is a step in them.
const SHORTEST_DAYS: f64 = 1.0 / 720.0;
/// Step of the differences that give the slope at a border, days.
const BORDER_STEP_DAYS: f64 = 0.25;

/// What is sought of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sought {
    /// Where it is zero.
    Zero,
    /// Where it is greatest or least.
    Extremum,
}

/// Something found.
#[derive(Debug, Clone, Copy)]
pub struct Found {
    /// Index of the function.
    pub function: usize,
    pub instant: Instant,
    /// A zero that is passed upwards; of extrema, a minimum.
    pub is_rising: bool,
    /// Change per day of the function at its zero; nothing of use at an extremum.
    pub slope_per_day: f64,
}

/// A stretch of time between two instants, which itself belongs to it at the beginning alone.
#[derive(Debug, Clone, Copy)]
pub struct Stretch {
    pub start: Instant,
    pub end: Instant,
}

impl Stretch {
    pub fn days(&self) -> f64 {
        self.end.tt - self.start.tt
    }

    pub fn contains(&self, instant: &Instant) -> bool {
        instant.tt >= self.start.tt && instant.tt < self.end.tt
    }

    fn at(&self, days: f64) -> Result<Instant, AlmanacError> {
        // Neighbouring stretches share their border to the last digit.
        if days == 0.0 {
            Ok(self.start)
        } else if days == self.days() {
            Ok(self.end)
        } else {
            Ok(self.start.plus_seconds(days * DAY_S)?)
        }
    }
}

/// Finds what is sought of each function; `sample` gives the values of all at an instant.
pub fn search<S>(
    stretch: &Stretch,
    span_days: f64,
    sought: &[Sought],
    sample: S,
) -> Result<Vec<Found>, AlmanacError>
where
    S: Fn(&Instant) -> Result<Vec<f64>, AlmanacError>,
{
    let mut found = Vec::new();
    if sought.is_empty() {
        return Ok(found);
    }
    let search = Search { stretch, sought, sample };
    let spans = (stretch.days() / span_days).ceil().max(1.0);
    let border = |index: f64| {
        if index == spans { stretch.days() } else { stretch.days() * (index / spans) }
    };
    let mut index = 0.0;
    while index < spans {
        search.span(border(index), border(index + 1.0), &mut found)?;
        index += 1.0;
    }
    Ok(found)
}

struct Search<'a, S> {
    stretch: &'a Stretch,
    sought: &'a [Sought],
    sample: S,
}

impl<S: Fn(&Instant) -> Result<Vec<f64>, AlmanacError>> Search<'_, S> {
    /// Looks through the days from `a` to `b`.
    fn span(&self, a: f64, b: f64, found: &mut Vec<Found>) -> Result<(), AlmanacError> {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let days = |x: f64| match x {
            -1.0 => a,
            1.0 => b,
            x => middle + half * x,
        };
        let mut values = vec![[0.0; POINTS]; self.sought.len()];
        for (k, &x) in NODES.iter().enumerate() {
            let sample = (self.sample)(&self.stretch.at(days(x))?)?;
            for (values, value) in values.iter_mut().zip(sample) {
                values[k] = value;
            }
        }
        let mut polynomials: Vec<Polynomial> = values.iter().map(Polynomial::through).collect();
        let is_close = |polynomial: &Polynomial| polynomial.tail() < MISFIT;
        if !polynomials.iter().all(is_close) {
            if 2.0 * half > SHORTEST_DAYS {
                self.span(a, middle, found)?;
                return self.span(middle, b, found);
            }
            // A polynomial would swing about the step: a straight line crosses once or not at all.
            for (polynomial, values) in polynomials.iter_mut().zip(&values) {
                *polynomial = Polynomial::between(values[0], values[POINTS - 1]);
            }
        }
        let mut slopes = None;
        for (function, polynomial) in polynomials.iter().enumerate() {
            let derivative;
            let (curve, ends) = match self.sought[function] {
                Sought::Zero => (polynomial, [values[function][0], values[function][POINTS - 1]]),
                Sought::Extremum => {
                    derivative = polynomial.without_noise().derivative();
                    if slopes.is_none() {
                        slopes = Some([self.slopes_at(a), self.slopes_at(b)]);
                    }
                    let at = |end: usize, x: f64| match slopes.as_ref().map(|s| &s[end]) {
                        Some(Ok(slopes)) => slopes[function],
                        // At the ends of all time there is nothing beyond.
                        _ => derivative.at(x).0,
                    };
                    let ends = [at(0, -1.0), at(1, 1.0)];
                    (&derivative, ends)
                }
            };
            for crossing in crossings(curve, ends) {
                found.push(Found {
                    function,
                    instant: self.stretch.at(days(crossing.at))?,
                    is_rising: crossing.is_rising,
                    slope_per_day: curve.at(crossing.at).1 / half,
                });
            }
        }
        Ok(())
    }

    /// Slopes of all functions at a border, the same for the spans on both of its sides.
    fn slopes_at(&self, days: f64) -> Result<Vec<f64>, AlmanacError> {
        let border = self.stretch.at(days)?;
        let beside =
            |steps: f64| (self.sample)(&border.plus_seconds(steps * BORDER_STEP_DAYS * DAY_S)?);
        let [far_before, before, after, far_after] =
            [beside(-2.0)?, beside(-1.0)?, beside(1.0)?, beside(2.0)?];
        // Abramowitz & Stegun 1964, eq. 25.3.21 with five points; the scale does not matter.
        let slope = |k: usize| 8.0 * (after[k] - before[k]) - (far_after[k] - far_before[k]);
        Ok((0..self.sought.len()).map(slope).collect())
    }
}

//! A phase function given by its values at angles.
//!
//! Between angles the logarithm is linear in the angle. The values may have any scale: the table is
//! normalised to 1 over the sphere. The law between the nodes, not the data, is integrated: within
//! 1e-9, by Gauss-Legendre quadrature of each interval.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::quadrature::{gauss_legendre, legendre};

/// Nodes of quadrature within an interval of angles, and one more for each of so many degrees of
/// the polynomial and so many radians.
const NODES: usize = 8;
/// Moments that are kept; the solver asks for those up to 8.
const KEPT_MOMENTS: usize = 17;

/// Why a table is none.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TabulatedError {
    #[error("a phase table has {degrees} degrees but {values} values; give one value for each")]
    Lengths { degrees: usize, values: usize },
    #[error("a phase table goes from 0 to 180 degrees; start with 0 and end with 180")]
    Ends,
    #[error("a phase table has {0} degrees out of order; let them ascend")]
    Order(f64),
    #[error("a phase table has the value {value} at {degrees} degrees; give numbers above 0")]
    Value { degrees: f64, value: f64 },
}

/// Values at angles, as they were given and as they are used.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Tabulated {
    written: Written,
    angles_rad: Vec<f64>,
    /// Natural logarithms of the normalised values.
    logarithms: Vec<f64>,
    moments: Vec<f64>,
}

/// A table as it stands in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    degrees: Vec<f64>,
    values: Vec<f64>,
}

impl TryFrom<Written> for Tabulated {
    type Error = TabulatedError;
    fn try_from(written: Written) -> Result<Tabulated, TabulatedError> {
        Tabulated::new(written.degrees, written.values)
    }
}

impl From<Tabulated> for Written {
    fn from(table: Tabulated) -> Written {
        table.written
    }
}

impl Tabulated {
    /// From angles of turn, degrees, ascending from 0 to 180, and values above 0 in any unit.
    pub fn new(degrees: Vec<f64>, values: Vec<f64>) -> Result<Tabulated, TabulatedError> {
        if degrees.len() != values.len() {
            let (degrees, values) = (degrees.len(), values.len());
            return Err(TabulatedError::Lengths { degrees, values });
        }
        if degrees.len() < 2 || degrees[0] != 0.0 || degrees[degrees.len() - 1] != 180.0 {
            return Err(TabulatedError::Ends);
        }
        // Written so that NaN, which is in no order, is refused too.
        if let Some(pair) = degrees.windows(2).find(|pair| !matches!(pair, [a, b] if a < b)) {
            return Err(TabulatedError::Order(pair[1]));
        }
        let is_wrong = |&(_, &value): &(&f64, &f64)| !(value > 0.0 && value.is_finite());
        if let Some((&degrees, &value)) = degrees.iter().zip(&values).find(is_wrong) {
            return Err(TabulatedError::Value { degrees, value });
        }
        let angles_rad = degrees.iter().map(|d| d.to_radians()).collect();
        // Scaled by the largest: sums of huge values stay finite.
        let most = values.iter().copied().fold(0.0, f64::max);
        let logarithms = values.iter().map(|v| v.ln() - most.ln()).collect();
        let written = Written { degrees, values };
        let mut table = Tabulated { written, angles_rad, logarithms, moments: Vec::new() };
        let norm = table.integral(0);
        table.logarithms.iter_mut().for_each(|v| *v -= norm.ln());
        table.moments = (0..KEPT_MOMENTS).map(|l| table.integral(l)).collect();
        Ok(table)
    }

    /// Per steradian, at a cosine of the angle of turn.
    pub fn value(&self, cosine: f64) -> f64 {
        self.at_angle(cosine.clamp(-1.0, 1.0).acos())
    }

    fn at_angle(&self, angle_rad: f64) -> f64 {
        let last = self.angles_rad.len() - 1;
        let i = self.angles_rad.partition_point(|&a| a <= angle_rad).clamp(1, last);
        let (low, high) = (self.angles_rad[i - 1], self.angles_rad[i]);
        let t = ((angle_rad - low) / (high - low)).clamp(0.0, 1.0);
        (self.logarithms[i - 1] + (self.logarithms[i] - self.logarithms[i - 1]) * t).exp()
    }

    /// Legendre moment of degree `l`.
    pub fn moment(&self, l: usize) -> f64 {
        self.moments.get(l).copied().unwrap_or_else(|| self.integral(l))
    }

    /// The integral over the sphere of the function and a Legendre polynomial.
    fn integral(&self, l: usize) -> f64 {
        let intervals = self.angles_rad.windows(2).zip(self.logarithms.windows(2));
        intervals
            .map(|(angles, logarithms)| {
                let (width, rise) = (angles[1] - angles[0], logarithms[1] - logarithms[0]);
                let more = ((l as f64 + 4.0) * width + rise.abs()).ceil() as usize;
                let nodes = gauss_legendre(NODES + more.min(200));
                let sum: f64 = nodes
                    .iter()
                    .map(|&(t, w)| {
                        let angle = angles[0] + width * t;
                        let value = (logarithms[0] + rise * t).exp();
                        w * value * angle.sin() * legendre(l, angle.cos())
                    })
                    .sum();
                2.0 * PI * width * sum
            })
            .sum()
    }
}

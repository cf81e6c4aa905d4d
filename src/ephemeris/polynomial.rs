//! Polynomials in time, as the theories print them.

/// `c0 + c1 t + c2 t^2 + ...`
pub fn polynomial(coefficients: &[f64], t: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * t + c)
}

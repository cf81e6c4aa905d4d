//! Light scattered by a homogeneous sphere: Lorenz-Mie theory.
//!
//! Theory: Bohren & Huffman 1983, *Absorption and Scattering of Light by Small Particles*, sections
//! 4.4 and 4.8. Logarithmic derivatives of `psi` run downwards, `psi` and `chi` upwards; series end at
//! `x + 4.05 x^(1/3) + 2` (Wiscombe 1980, *Appl. Opt.* 19, 1505). The imaginary part of the
//! refractive index is positive where the sphere absorbs.
//!
//! Accuracy: efficiencies and phase functions within 1e-6 of the Python package miepython, size
//! parameters 0.1 to 1000 (`tests/truth/mie_spheres.csv`).

use std::ops::{Add, Div, Mul, Sub};

/// A complex number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Complex {
    pub re: f64,
    pub im: f64,
}

const ZERO: Complex = Complex { re: 0.0, im: 0.0 };

impl Complex {
    pub fn new(re: f64, im: f64) -> Complex {
        Complex { re, im }
    }
    pub fn norm_squared(self) -> f64 {
        self.re * self.re + self.im * self.im
    }
    /// Real part of the product with the conjugate of the other.
    #[cfg(test)]
    fn dot(self, other: Complex) -> f64 {
        self.re * other.re + self.im * other.im
    }
    fn times(self, factor: f64) -> Complex {
        Complex::new(self.re * factor, self.im * factor)
    }
}

impl Add for Complex {
    type Output = Complex;
    fn add(self, b: Complex) -> Complex {
        Complex::new(self.re + b.re, self.im + b.im)
    }
}
impl Sub for Complex {
    type Output = Complex;
    fn sub(self, b: Complex) -> Complex {
        Complex::new(self.re - b.re, self.im - b.im)
    }
}
impl Mul for Complex {
    type Output = Complex;
    fn mul(self, b: Complex) -> Complex {
        Complex::new(self.re * b.re - self.im * b.im, self.re * b.im + self.im * b.re)
    }
}
impl Div for Complex {
    type Output = Complex;
    fn div(self, b: Complex) -> Complex {
        let conjugate = Complex::new(b.re, -b.im);
        (self * conjugate).times(1.0 / b.norm_squared())
    }
}

/// A sphere, by the coefficients of its scattered field.
pub struct Sphere {
    size: f64,
    /// `a_n` and `b_n`, from `n = 1`.
    coefficients: Vec<(Complex, Complex)>,
}

impl Sphere {
    /// Size parameter `x = 2 pi r / wavelength`, above 0; refractive index relative to the air.
    pub fn new(index: Complex, size: f64) -> Sphere {
        let terms = (size + 4.05 * size.cbrt() + 2.0).ceil() as usize;
        let inner = index.times(size);
        // Downwards from so far above `|m x|` that the wrong beginning is forgotten.
        let inner_size = inner.norm_squared().sqrt();
        let start = (terms as f64).max(inner_size + 8.0 * inner_size.cbrt()) as usize + 16;
        let mut derivatives = vec![ZERO; start + 1];
        for n in (1..=start).rev() {
            let ratio = Complex::new(n as f64, 0.0) / inner;
            derivatives[n - 1] = ratio - Complex::new(1.0, 0.0) / (derivatives[n] + ratio);
        }
        let (mut psi_below, mut psi) = (size.cos(), size.sin());
        let (mut chi_below, mut chi) = (-size.sin(), size.cos());
        let coefficients = (1..=terms)
            .map(|n| {
                let step = (2 * n - 1) as f64 / size;
                (psi_below, psi) = (psi, step * psi - psi_below);
                (chi_below, chi) = (chi, step * chi - chi_below);
                let (xi, xi_below) = (Complex::new(psi, -chi), Complex::new(psi_below, -chi_below));
                let order = Complex::new(n as f64 / size, 0.0);
                let field = |slope: Complex| {
                    let above = slope.times(psi) - Complex::new(psi_below, 0.0);
                    above / (slope * xi - xi_below)
                };
                (field(derivatives[n] / index + order), field(derivatives[n] * index + order))
            })
            .collect();
        Sphere { size, coefficients }
    }

    /// Efficiencies of extinction and scattering; eqs. 4.61 and 4.62.
    pub fn efficiencies(&self) -> (f64, f64) {
        let mut sums = (0.0, 0.0);
        for (i, (a, b)) in self.coefficients.iter().enumerate() {
            let weight = (2 * i + 3) as f64;
            sums.0 += weight * (a.re + b.re);
            sums.1 += weight * (a.norm_squared() + b.norm_squared());
        }
        let factor = 2.0 / (self.size * self.size);
        (factor * sums.0, factor * sums.1)
    }

    /// Mean cosine of the angle of turn; section 4.5.
    #[cfg(test)]
    pub fn mean_cosine(&self) -> f64 {
        let mut sum = 0.0;
        for (i, (a, b)) in self.coefficients.iter().enumerate() {
            let n = (i + 1) as f64;
            sum += (2.0 * n + 1.0) / (n * (n + 1.0)) * a.dot(*b);
            if let Some((a_next, b_next)) = self.coefficients.get(i + 1) {
                sum += n * (n + 2.0) / (n + 1.0) * (a.dot(*a_next) + b.dot(*b_next));
            }
        }
        4.0 / (self.size * self.size) * sum / self.efficiencies().1
    }

    /// Scattering of unpolarised light, `(|S1|^2 + |S2|^2)/2`, at cosines of the angle of turn;
    /// eq. 4.74. Over `pi x^2 Q_sca` it is the phase function per steradian.
    pub fn intensities(&self, cosines: &[f64]) -> Vec<f64> {
        let intensity = |&cosine: &f64| {
            let (mut pi_below, mut pi) = (0.0, 1.0);
            let (mut s1, mut s2) = (ZERO, ZERO);
            for (i, (a, b)) in self.coefficients.iter().enumerate() {
                let n = (i + 1) as f64;
                let tau = n * cosine * pi - (n + 1.0) * pi_below;
                let weight = (2.0 * n + 1.0) / (n * (n + 1.0));
                s1 = s1 + a.times(weight * pi) + b.times(weight * tau);
                s2 = s2 + a.times(weight * tau) + b.times(weight * pi);
                let next = ((2.0 * n + 1.0) * cosine * pi - (n + 1.0) * pi_below) / n;
                (pi_below, pi) = (pi, next);
            }
            0.5 * (s1.norm_squared() + s2.norm_squared())
        };
        cosines.iter().map(intensity).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Rows of the truth: index, size, efficiencies, mean cosine, phase at 0, 30, 90, 150 degrees
    /// and 180.
    const TRUTH: &str = include_str!("../../../tests/truth/mie_spheres.csv");

    #[test]
    fn spheres_are_those_of_another_program() {
        let numbers = |line: &str| -> Option<Vec<f64>> {
            line.split(',').map(|cell| cell.parse().ok()).collect()
        };
        let rows: Vec<Vec<f64>> = TRUTH.lines().filter_map(numbers).collect();
        assert!(rows.len() >= 12, "{} rows", rows.len());
        for row in rows {
            let sphere = Sphere::new(Complex::new(row[0], row[1]), row[2]);
            let (extinction, scattering) = sphere.efficiencies();
            let cosines: Vec<f64> =
                [0.0f64, 30.0, 90.0, 150.0, 180.0].iter().map(|d| d.to_radians().cos()).collect();
            let scale = PI * row[2] * row[2] * scattering;
            let mut got = vec![extinction, scattering, sphere.mean_cosine()];
            got.extend(sphere.intensities(&cosines).iter().map(|i| i / scale));
            for (got, want) in got.iter().zip(&row[3..]) {
                assert!((got / want - 1.0).abs() < 1e-6, "{row:?}: {got}, not {want}");
            }
        }
    }

    #[test]
    fn the_sphere_of_the_book_has_its_efficiency() {
        // Bohren & Huffman 1983, appendix A: a sphere of 0.525 micrometres, index 1.55, at 632.8 nm.
        let size = 2.0 * PI * 0.525 / 0.6328;
        let sphere = Sphere::new(Complex::new(1.55, 0.0), size);
        let (extinction, scattering) = sphere.efficiencies();
        assert!((extinction - 3.10543).abs() < 5e-6, "{extinction}");
        assert!((scattering - 3.10543).abs() < 5e-6, "{scattering}");
        assert!((sphere.mean_cosine() - 0.63314).abs() < 5e-6);
    }

    #[test]
    fn small_spheres_scatter_as_rayleigh_says() {
        let index = Complex::new(1.4, 0.0);
        let size: f64 = 1e-2;
        let m2 = 1.4f64 * 1.4;
        let want = 8.0 / 3.0 * size.powi(4) * ((m2 - 1.0) / (m2 + 2.0)).powi(2);
        let got = Sphere::new(index, size).efficiencies().1;
        assert!((got / want - 1.0).abs() < 1e-4, "{got}, not {want}");
    }
}

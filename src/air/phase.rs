//! Phase functions: how light that is scattered spreads over directions.
//!
//! All are per steradian and 1 over the sphere: the integral of `P(nu)` over solid angle is 1, with
//! `nu` the cosine of the angle by which light turns (1 straight on, -1 straight back). Legendre
//! moments: `P(nu) = sum (2l+1)/(4 pi) chi_l P_l(nu)`, so that `chi_0 = 1` and `chi_1` is the mean
//! cosine.
//!
//! Sources differ in normalisation, and some mix theirs: of the laws collected by Premože (*Light
//! scattering*, SIGGRAPH course notes 2003, eqs. 1 to 6) only the isotropic one carries its
//! `1/(4 pi)`, and the one of Rayleigh (eq. 5) also holds the `1/wavelength^4` of the
//! cross-section. Here none of them does.
//!
//! Accuracy: integrals over the sphere within 1e-9, moments in closed form where there is one, else
//! by quadrature within 1e-9 (`tests/phase.rs`).

mod laws;
pub(crate) mod quadrature;
mod tabulated;

use std::f64::consts::PI;

pub use laws::{
    cornette_shanks, cornette_shanks_moment, double_henyey_greenstein,
    double_henyey_greenstein_moment, henyey_greenstein, henyey_greenstein_moment, king_factor,
    rayleigh, rayleigh_depolarised, rayleigh_depolarised_moment, rayleigh_moment, schlick,
    schlick_moment,
};
pub use tabulated::{Tabulated, TabulatedError};

/// A phase function, with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum PhaseFunction {
    /// The same everywhere: `1/(4 pi)`.
    Isotropic,
    /// Particles much smaller than the wavelength; the depolarisation of natural light scattered at
    /// a right angle, 0 to 0.5: about 0.028 for air, 0 for what the solver takes.
    Rayleigh { depolarisation: f64 },
    /// Henyey & Greenstein 1941; the mean cosine, -1 to 1 without the ends.
    HenyeyGreenstein { g: f64 },
    /// Two of them, one of which may look back (Kattawar 1975).
    DoubleHenyeyGreenstein { forward_g: f64, backward_g: f64, forward_share: f64 },
    /// Blasi, Le Saëc & Schlick 1993, here with light going forward for positive `k`.
    Schlick { k: f64 },
    /// Cornette & Shanks 1992.
    CornetteShanks { g: f64 },
    /// Given by its values.
    Tabulated(Tabulated),
}

impl PhaseFunction {
    /// Per steradian, at a cosine of the angle of turn from -1 to 1.
    pub fn value(&self, cosine: f64) -> f64 {
        match *self {
            PhaseFunction::Isotropic => 1.0 / (4.0 * PI),
            PhaseFunction::Rayleigh { depolarisation } => {
                rayleigh_depolarised(depolarisation, cosine)
            }
            PhaseFunction::HenyeyGreenstein { g } => henyey_greenstein(g, cosine),
            PhaseFunction::DoubleHenyeyGreenstein { forward_g, backward_g, forward_share } => {
                double_henyey_greenstein(forward_g, backward_g, forward_share, cosine)
            }
            PhaseFunction::Schlick { k } => schlick(k, cosine),
            PhaseFunction::CornetteShanks { g } => cornette_shanks(g, cosine),
            PhaseFunction::Tabulated(ref table) => table.value(cosine),
        }
    }

    /// Legendre moment of degree `l`: 1 for 0, the mean cosine for 1.
    pub fn moment(&self, l: usize) -> f64 {
        match *self {
            PhaseFunction::Isotropic => f64::from(u8::from(l == 0)),
            PhaseFunction::Rayleigh { depolarisation } => {
                rayleigh_depolarised_moment(depolarisation, l)
            }
            PhaseFunction::HenyeyGreenstein { g } => henyey_greenstein_moment(g, l),
            PhaseFunction::DoubleHenyeyGreenstein { forward_g, backward_g, forward_share } => {
                double_henyey_greenstein_moment(forward_g, backward_g, forward_share, l)
            }
            PhaseFunction::Schlick { k } => schlick_moment(k, l),
            PhaseFunction::CornetteShanks { g } => cornette_shanks_moment(g, l),
            PhaseFunction::Tabulated(ref table) => table.moment(l),
        }
    }

    /// Mean cosine of the angle of turn: 1 straight on, 0 as much forth as back.
    pub fn mean_cosine(&self) -> f64 {
        self.moment(1)
    }
}

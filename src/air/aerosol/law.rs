//! How an aerosol scatters: the phase functions that a file may name.

use serde::{Deserialize, Serialize};

use super::Checked;
use crate::air::phase::{PhaseFunction, Tabulated};

/// The harmonics of the scattering solver do not follow sharper peaks.
const MOST_ASYMMETRIC: f64 = 0.9;

/// A phase function, as a file tells it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case", deny_unknown_fields)]
pub enum PhaseLaw {
    /// Henyey & Greenstein 1941; the mean cosine, -0.9 to 0.9.
    HenyeyGreenstein { g: f64 },
    /// Two of them: forward, 0 to 0.9; backward, -0.9 to 0; the share of the first, 0 to 1.
    DoubleHenyeyGreenstein { forward_g: f64, backward_g: f64, forward_share: f64 },
    /// Cornette & Shanks 1992; -0.9 to 0.9.
    CornetteShanks { g: f64 },
    /// Schlick's stand-in for Henyey and Greenstein; -0.95 to 0.95.
    Schlick { k: f64 },
    /// `degrees` of turn, ascending from 0 to 180, and `values` above 0 in any unit, the same at
    /// all wavelengths.
    Table(Tabulated),
}

impl PhaseLaw {
    pub(super) fn ranges(&self, path: &str) -> Vec<Checked> {
        let field = |name: &str, value, low, high| (format!("{path}.{name}"), value, low, high);
        let most = MOST_ASYMMETRIC;
        match *self {
            PhaseLaw::HenyeyGreenstein { g } | PhaseLaw::CornetteShanks { g } => {
                vec![field("g", g, -most, most)]
            }
            PhaseLaw::DoubleHenyeyGreenstein { forward_g, backward_g, forward_share } => vec![
                field("forward_g", forward_g, 0.0, most),
                field("backward_g", backward_g, -most, 0.0),
                field("forward_share", forward_share, 0.0, 1.0),
            ],
            PhaseLaw::Schlick { k } => vec![field("k", k, -0.95, 0.95)],
            PhaseLaw::Table(_) => Vec::new(),
        }
    }

    /// The phase function at a wavelength.
    pub fn at(&self, _wavelength_nm: f64) -> PhaseFunction {
        match *self {
            PhaseLaw::HenyeyGreenstein { g } => PhaseFunction::HenyeyGreenstein { g },
            PhaseLaw::CornetteShanks { g } => PhaseFunction::CornetteShanks { g },
            PhaseLaw::DoubleHenyeyGreenstein { forward_g, backward_g, forward_share } => {
                PhaseFunction::DoubleHenyeyGreenstein { forward_g, backward_g, forward_share }
            }
            PhaseLaw::Schlick { k } => PhaseFunction::Schlick { k },
            PhaseLaw::Table(ref table) => PhaseFunction::Tabulated(table.clone()),
        }
    }

    /// Per steradian, 1 over the sphere, at a cosine of the angle of turn.
    pub fn value(&self, wavelength_nm: f64, cosine: f64) -> f64 {
        match self {
            PhaseLaw::Table(table) => table.value(cosine),
            _ => self.at(wavelength_nm).value(cosine),
        }
    }

    /// Legendre moment of degree `l`.
    pub fn moment(&self, wavelength_nm: f64, l: usize) -> f64 {
        match self {
            PhaseLaw::Table(table) => table.moment(l),
            _ => self.at(wavelength_nm).moment(l),
        }
    }
}

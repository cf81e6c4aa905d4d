//! How an aerosol scatters: the phase functions that a file may name.

use serde::{Deserialize, Serialize};

use super::{Checked, MieKind};
use crate::air::phase::{self, Tabulated};

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
    /// all wavelengths; the mean cosine -0.9 to 0.9.
    Table(Tabulated),
    /// A shipped kind, which has its own extinction and albedo by wavelength.
    Mie { kind: MieKind },
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
            PhaseLaw::Table(ref table) => {
                vec![(format!("the mean cosine of {path}"), table.moment(1), -most, most)]
            }
            PhaseLaw::Mie { .. } => Vec::new(),
        }
    }

    /// Per steradian, 1 over the sphere, at a cosine of the angle of turn.
    pub fn value(&self, wavelength_nm: f64, cosine: f64) -> f64 {
        match *self {
            PhaseLaw::HenyeyGreenstein { g } => phase::henyey_greenstein(g, cosine),
            PhaseLaw::DoubleHenyeyGreenstein { forward_g, backward_g, forward_share } => {
                phase::double_henyey_greenstein(forward_g, backward_g, forward_share, cosine)
            }
            PhaseLaw::CornetteShanks { g } => phase::cornette_shanks(g, cosine),
            PhaseLaw::Schlick { k } => phase::schlick(k, cosine),
            PhaseLaw::Table(ref table) => table.value(cosine),
            PhaseLaw::Mie { kind } => kind.table().phase(wavelength_nm, cosine),
        }
    }

    /// Legendre moment of degree `l`: 1 for 0, the mean cosine for 1.
    pub fn moment(&self, wavelength_nm: f64, l: usize) -> f64 {
        match *self {
            PhaseLaw::HenyeyGreenstein { g } => phase::henyey_greenstein_moment(g, l),
            PhaseLaw::DoubleHenyeyGreenstein { forward_g, backward_g, forward_share } => {
                phase::double_henyey_greenstein_moment(forward_g, backward_g, forward_share, l)
            }
            PhaseLaw::CornetteShanks { g } => phase::cornette_shanks_moment(g, l),
            PhaseLaw::Schlick { k } => phase::schlick_moment(k, l),
            PhaseLaw::Table(ref table) => table.moment(l),
            PhaseLaw::Mie { kind } => kind.table().moment(wavelength_nm, l),
        }
    }

    /// Whether its values are looked up, not computed: some 100 ns instead of some 5.
    pub(crate) fn is_tabulated(&self) -> bool {
        matches!(self, PhaseLaw::Table(_) | PhaseLaw::Mie { .. })
    }
}

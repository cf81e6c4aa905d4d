//! The Moon: how much light it sends, and how that light is spread over its disc.
//!
//! [`rolo`] is the truth for the light of the whole disc, at every wavelength and phase. How it is
//! spread comes from maps and a law of reflection: the plain [`jensen`], or [`hapke`] with the
//! parameters of each piece of ground. [`surface`] puts maps and law together, sums them over the
//! disc, and scales the sum to ROLO in each of three bands; [`bands`] goes from three bands to
//! spectra.

pub mod bands;
pub mod hapke;
pub mod jensen;
pub mod rolo;
pub mod surface;

pub use jensen::lunar_brdf;
pub use rolo::{MoonView, disc_mean_luminance, disc_reflectance_at, irradiance};
pub use surface::{DiscLight, MoonSurface, Reflectance};

//! Light of sources without a disc.

use crate::light::spectrum::Spectrum;
use crate::units::{Illuminance, Magnitude, Xyzv};

/// A source too small to show a disc, as it shines outside the air.
#[derive(Debug, Clone, PartialEq)]
pub struct PointLight {
    /// Spectral irradiance on a plane that faces the source, W m-2 nm-1.
    pub spectrum: Spectrum,
    /// The same light as the four observers see it, lux.
    pub xyzv: Xyzv,
    /// Johnson V.
    pub magnitude: Magnitude,
}

impl PointLight {
    /// The light of a spectral irradiance, W m-2 nm-1.
    pub fn from_spectrum(spectrum: Spectrum) -> Self {
        let xyzv = spectrum.xyzv();
        PointLight { spectrum, xyzv, magnitude: Illuminance::from_lx(xyzv.y).magnitude() }
    }

    /// The light with the shape of a spectrum and the photopic illuminance of a magnitude.
    ///
    /// The shape may carry any positive scale.
    pub fn from_shape(shape: Spectrum, magnitude: Magnitude) -> Self {
        let spectrum = shape.scaled_to_photopic(magnitude.illuminance().lx());
        PointLight { xyzv: spectrum.xyzv(), spectrum, magnitude }
    }
}

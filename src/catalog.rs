//! The data that the project ships: found, checked and read here and nowhere else.

use crate::frame::{Dir, Icrs};
use crate::units::Magnitude;

/// A star of the Yale Bright Star Catalogue, 5th edition (Hoffleit & Warren 1991).
#[derive(Debug, Clone, PartialEq)]
pub struct Star {
    /// Number in the Harvard Revised catalogue: `HR 2491` is Sirius.
    pub hr: u16,
    /// Number in the Hipparcos catalogue, if it has one.
    pub hip: Option<u32>,
    /// Bayer or Flamsteed designation as people write it, such as `α CMa` or `61 Cyg`.
    pub designation: Option<String>,
    /// Name approved by the IAU, such as `Sirius`.
    pub name: Option<String>,
    /// Direction at epoch and equinox J2000.0 (FK5, which is ICRS within 0.1 arcsecond).
    pub dir_j2000: Dir<Icrs>,
    /// Proper motion in right ascension times the cosine of declination, arcseconds a year.
    pub proper_motion_ra_arcsec_yr: f64,
    /// Proper motion in declination, arcseconds a year.
    pub proper_motion_dec_arcsec_yr: f64,
    /// Annual parallax, arcseconds; zero when the catalogue has none.
    pub parallax_arcsec: f64,
    /// Radial velocity, kilometres per second, positive away from us; zero when unknown.
    pub radial_velocity_km_s: f64,
    /// Johnson V.
    pub magnitude: Magnitude,
    /// Johnson B-V, measured or estimated from the spectral type.
    pub b_v: f64,
    /// Spectral type as the catalogue writes it.
    pub spectral_type: String,
}

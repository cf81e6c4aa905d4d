//! From the reflectance in three bands to a spectrum.
//!
//! Theory: the spectra of pieces of lunar ground differ from that of the whole disc by a few per
//! cent, and smoothly (no bands in the visible). So a piece whose reflectance is `r` where the mean of
//! the disc is `R` has the spectrum of the disc times `r / R`, straight between 415, 566 and 643 nm and
//! the same beyond. Written with three weights that sum to 1 at every wavelength, the mean of all
//! pieces has the disc's own spectrum, whatever the pieces are.
//!
//! Omitted: the differences of slope beyond 643 nm, where iron and titanium part seas from highlands
//! by a few per cent more, and below 415 nm. Straight lines are kept: a rounder weight would bend the
//! ratio of two spectra that have none.

use crate::catalog::moon::hapke::BANDS_NM;
use crate::light::moon::rolo::{self, MoonView};
use crate::light::spectrum::Spectrum;

/// How much each of the bands at 415, 566 and 643 nm tells of a wavelength: 0 to 1, the sum is 1.
pub fn weights(wavelength_nm: f64) -> [f64; 3] {
    let [blue, green, red] = BANDS_NM;
    let share = |from: f64, to: f64| ((wavelength_nm - from) / (to - from)).clamp(0.0, 1.0);
    let (to_green, to_red) = (share(blue, green), share(green, red));
    [1.0 - to_green, to_green - to_red, to_red]
}

/// The irradiance of moonlight in three parts, W m-2 nm-1, that sum to [`rolo::irradiance`]: what
/// each band tells of it.
///
/// Ground whose reflectance in the bands is `r[k]` times the mean of the disc sends
/// `r[0] parts[0] + r[1] parts[1] + r[2] parts[2]`.
pub fn irradiance_by_band(view: &MoonView) -> [Spectrum; 3] {
    let whole = rolo::irradiance(view);
    std::array::from_fn(|band| whole.weighted(|nm| weights(nm)[band]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::spectrum::{LEN, wavelength_nm};
    use crate::units::Angle;

    #[test]
    fn weights_are_shares_and_each_band_tells_of_itself() {
        for node in 0..LEN {
            let weights = weights(wavelength_nm(node));
            assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            assert!(weights.iter().all(|weight| (0.0..=1.0).contains(weight)));
        }
        for (band, nm) in BANDS_NM.into_iter().enumerate() {
            assert_eq!(weights(nm)[band], 1.0);
        }
        assert_eq!(weights(360.0), [1.0, 0.0, 0.0]);
        assert_eq!(weights(830.0), [0.0, 0.0, 1.0]);
        assert!((weights(490.5)[0] - 0.5).abs() < 1e-12);
    }

    #[test]
    fn the_parts_sum_to_the_whole() {
        let view = MoonView::at_phase(Angle::from_deg(50.0));
        let whole = rolo::irradiance(&view);
        let parts = irradiance_by_band(&view);
        for node in 0..LEN {
            let sum: f64 = parts.iter().map(|part| part.values()[node]).sum();
            assert!((sum / whole.values()[node] - 1.0).abs() < 1e-12);
        }
    }
}

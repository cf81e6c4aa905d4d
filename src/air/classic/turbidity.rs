//! Turbidity: the one number in which the models hold the haze, from the aerosol of the air.
//!
//! **Linke's** is the number of clean dry atmospheres that would dim the Sun as much, over its whole
//! spectrum. From the aerosol optical depth `t` at 550 nm and the precipitable water `w` (cm), with
//! `r = p0 / p`: `TL = 3.91 exp(0.689 r) t + 0.376 ln w + 2 + 0.54 r - 0.5 r^2 + 0.16 r^3`,
//! Ineichen 2008, *Solar Energy* 82, 1095. The air here holds no water; 2 cm are taken, a moderate
//! summer day: half or twice that is 0.26 of turbidity.
//!
//! **Preetham's** is the optical depth of haze and molecules over that of molecules, in visible light.
//! His haze has `beta = 0.04608 T - 0.04586` in Angstrom's law `beta l^-1.3`, `l` in micrometres
//! (Preetham et al. 1999, appendix 1). Solved for `T` with the optical depth at 550 nm, where light is
//! brightest; other exponents are not heard.

use crate::air::Atmosphere;
use crate::air::standard::SEA_LEVEL_PRESSURE_MBAR;

/// Precipitable water, centimetres.
pub const WATER_CM: f64 = 2.0;

/// Linke's turbidities for which the zenith of the clear sky stays above zero, and those of smoke.
pub(super) const LINKE_TURBIDITIES: (f64, f64) = (1.5, 10.0);

/// Linke's turbidity of the air over an observer.
pub fn linke(air: &Atmosphere, height_m: f64) -> f64 {
    let ratio = SEA_LEVEL_PRESSURE_MBAR / air.pressure_mbar_at(height_m);
    3.91 * (0.689 * ratio).exp() * optical_depth_550(air)
        + 0.376 * WATER_CM.ln()
        + 2.0
        + 0.54 * ratio
        - 0.5 * ratio.powi(2)
        + 0.16 * ratio.powi(3)
}

/// Preetham's turbidity of the air.
pub fn preetham(air: &Atmosphere) -> f64 {
    let beta = optical_depth_550(air) * 0.55f64.powf(1.3);
    (beta + 0.045_86) / 0.046_08
}

/// Of the aerosols of the whole column above sea level.
fn optical_depth_550(air: &Atmosphere) -> f64 {
    air.aerosols().into_iter().flatten().map(|aerosol| aerosol.optical_depth(550.0)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clear_air_is_two_and_three() {
        let air = Atmosphere::default();
        assert!((preetham(&air) - 1.99).abs() < 0.01, "{}", preetham(&air));
        assert!((linke(&air, 0.0) - 3.24).abs() < 0.01, "{}", linke(&air, 0.0));
        // Without haze: molecules alone, and molecules with water.
        let clean = Atmosphere::molecular();
        assert!((preetham(&clean) - 1.0).abs() < 0.01);
        assert!((linke(&clean, 0.0) - 2.46).abs() < 0.01);
    }
}

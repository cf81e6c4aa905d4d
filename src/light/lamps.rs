//! Lamps of streets: what spectra towns send up.
//!
//! Models, not measurements. White light-emitting diodes: a blue peak and the broad band of the
//! phosphor, as Gaussian curves whose widths and shares give the colour temperature of the name and
//! the scotopic-to-photopic ratio that makers state. Sodium at high pressure: the D lines, widened and
//! reversed in their middle, a weak continuum and the other lines of sodium; at low pressure the D
//! lines alone. Wavelengths and ratios (low pressure 0.25, high pressure 0.6, 3000 K 1.2 to 1.35,
//! 4000 K 1.5 to 1.6) are recalled.
//!
//! Omitted: fluorescent and metal halide lamps, windows, signs and cars; what stone and asphalt take
//! from the blue.

use serde::{Deserialize, Serialize};

use crate::light::spectrum::Spectrum;

/// What kind of lamps light a town.
#[derive(Serialize, Deserialize, Clone, Copy, PartialEq, Eq, Debug, Default)]
#[serde(rename_all = "kebab-case")]
pub enum Lamps {
    /// By lumens half sodium at high pressure, half diodes, as in towns that change over.
    #[default]
    Mixed,
    /// Warm white diodes, 3000 K.
    Led3000,
    /// Neutral white diodes, 4000 K.
    Led4000,
    /// Sodium at high pressure.
    Sodium,
    /// Sodium at low pressure.
    LowPressureSodium,
}

/// A Gaussian curve of unit height by its full width at half height.
fn bell(nm: f64, centre_nm: f64, width_nm: f64) -> f64 {
    (-4.0 * std::f64::consts::LN_2 * ((nm - centre_nm) / width_nm).powi(2)).exp()
}

/// A diode: the height of the blue peak over that of the phosphor, and the phosphor's band, which
/// falls more slowly to the red.
fn diode(blue: f64, centre_nm: f64, widths_nm: [f64; 2]) -> Spectrum {
    Spectrum::from_fn(|nm| {
        let width_nm = if nm < centre_nm { widths_nm[0] } else { widths_nm[1] };
        blue * bell(nm, 450.0, 22.0) + bell(nm, centre_nm, width_nm)
    })
}

/// Sodium at high pressure: wavelength, power relative to the rest, full width at half height, nm.
const HIGH_PRESSURE: [(f64, f64, f64); 12] = [
    (440.0, 3.3, 90.0),
    (449.8, 1.0, 6.0),
    (466.7, 1.7, 6.0),
    (475.1, 0.7, 6.0),
    (498.1, 5.0, 6.0),
    (515.2, 1.5, 6.0),
    (568.6, 14.0, 9.0),
    (581.5, 22.0, 12.0),
    (599.0, 40.0, 22.0),
    (615.8, 7.0, 8.0),
    (630.0, 17.0, 90.0),
    (768.0, 8.0, 14.0),
];

fn high_pressure_sodium() -> Spectrum {
    Spectrum::from_fn(|nm| {
        HIGH_PRESSURE.iter().map(|&(at, power, width)| power / width * bell(nm, at, width)).sum()
    })
}

impl Lamps {
    /// All kinds.
    pub const ALL: [Lamps; 5] =
        [Lamps::Mixed, Lamps::Led3000, Lamps::Led4000, Lamps::Sodium, Lamps::LowPressureSodium];

    /// Spectral power of a lumen, W nm-1.
    pub fn spectrum(self) -> Spectrum {
        let spectrum = match self {
            Lamps::Mixed => {
                let [sodium, warm, neutral] =
                    [Lamps::Sodium, Lamps::Led3000, Lamps::Led4000].map(Lamps::spectrum);
                sodium * 0.5 + warm * 0.2 + neutral * 0.3
            }
            Lamps::Led3000 => diode(0.63, 591.0, [127.0, 158.0]),
            Lamps::Led4000 => diode(1.08, 578.0, [125.0, 140.0]),
            Lamps::Sodium => high_pressure_sodium(),
            Lamps::LowPressureSodium => Spectrum::line(589.0, 2.0) + Spectrum::line(589.6, 1.0),
        };
        spectrum.scaled_to_photopic(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::spectrum::chromaticity_xy;

    /// Colour temperature after McCamy 1992 (recalled): within 10 K for white light, see the test.
    fn temperature_k([x, y]: [f64; 2]) -> f64 {
        let n = (x - 0.3320) / (0.1858 - y);
        ((449.0 * n + 3525.0) * n + 6823.3) * n + 5520.33
    }

    #[test]
    fn rods_and_cones_see_the_lamps_as_stated() {
        for (lamps, low, high) in [
            (Lamps::LowPressureSodium, 0.2, 0.3),
            (Lamps::Sodium, 0.55, 0.68),
            (Lamps::Led3000, 1.2, 1.35),
            (Lamps::Led4000, 1.5, 1.6),
            (Lamps::Mixed, 0.9, 1.2),
        ] {
            let light = lamps.spectrum().xyzv();
            println!("{lamps:?} S/P {:.3} xy {:?}", light.v, chromaticity_xy(light));
            assert!((light.y - 1.0).abs() < 1e-9);
            assert!((low..=high).contains(&light.v), "{lamps:?}: {}", light.v);
        }
    }

    #[test]
    fn white_diodes_have_the_colour_of_their_name() {
        for (lamps, kelvin) in
            [(Lamps::Led3000, 3000.0), (Lamps::Led4000, 4000.0), (Lamps::Sodium, 2050.0)]
        {
            let (x, y) = chromaticity_xy(lamps.spectrum().xyzv()).unwrap();
            let got = temperature_k([x, y]);
            println!("{lamps:?} {got:.0} K");
            assert!((got / kelvin - 1.0).abs() < 0.06, "{lamps:?}: {got} K at {x} {y}");
        }
        // On the locus, not green or pink: y of the black body at 3000 K 0.404, at 4000 K 0.377.
        let y = |lamps: Lamps| chromaticity_xy(lamps.spectrum().xyzv()).unwrap().1;
        assert!((y(Lamps::Led3000) - 0.404).abs() < 0.02, "{}", y(Lamps::Led3000));
        assert!((y(Lamps::Led4000) - 0.377).abs() < 0.02, "{}", y(Lamps::Led4000));
    }
}

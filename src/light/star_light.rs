//! Starlight at the eye, from a table: colour and apparent altitude to what the observers see.
//!
//! A frame holds thousands of stars; integrating a spectrum for each would cost more than drawing it.
//! The table holds, for one place and one air, the logarithm of X, Y, Z and V at the eye for an
//! illuminance of one lux outside the air, and is read by linear interpolation.
//!
//! Accuracy: within 0.2 % of the integration of each spectrum, at every altitude down to the horizon
//! (tested for clear and for hazy air).

use rayon::prelude::*;

use crate::air::Atmosphere;
use crate::air::extinction::SightLines;
use crate::light::star_colour::{B_V_RANGE, black_body};
use crate::units::{Angle, Illuminance, Xyzv};

/// Colours in the table: B-V in steps of 0.075.
const COLOURS: usize = 33;
/// Altitudes in the table, crowded towards the horizon.
const ALTITUDES: usize = 1025;
const LAST_ROW: f64 = (ALTITUDES - 1) as f64;

/// What arrives of the light of stars, for one place and one air.
#[derive(Debug, Clone)]
pub struct StarLight {
    /// Natural logarithms, `COLOURS` for each altitude.
    logarithms: Vec<[f64; 4]>,
    horizon: Angle,
}

impl StarLight {
    /// For the air over an observer, whose height above sea level is in metres.
    pub fn new(air: &Atmosphere, height_m: f64) -> Self {
        let sight = SightLines::over(air, height_m);
        let horizon = sight.horizon();
        let bodies: Vec<_> =
            (0..COLOURS).map(|k| black_body(b_v_of_node(k)).scaled_to_photopic(1.0)).collect();
        let logarithms = (0..ALTITUDES)
            .into_par_iter()
            .flat_map_iter(|row| {
                let altitude = horizon + (Angle::from_deg(90.0) - horizon) * share_of_row(row);
                let through = sight.transmittance(altitude);
                bodies.iter().map(move |body| {
                    let light = (*body * through).xyzv();
                    // Light may vanish in thick haze, where its logarithm must not.
                    [light.x, light.y, light.z, light.v]
                        .map(|channel| channel.max(f64::MIN_POSITIVE).ln())
                })
            })
            .collect();
        StarLight { logarithms, horizon }
    }

    /// The light at the eye, lux, of a star with the given B-V and illuminance outside the air.
    ///
    /// Below the horizon the answer is that of the horizon: the caller drops what has set.
    pub fn at_eye(&self, b_v: f64, apparent_altitude: Angle, outside: Illuminance) -> Xyzv {
        let shares = share_of_altitude(apparent_altitude, self.horizon);
        let low_row = ((shares.sqrt() * LAST_ROW) as usize).min(ALTITUDES - 2);
        // Rows lie at squares; between them the logarithm is straight in the altitude.
        let (low, high) = (share_of_row(low_row), share_of_row(low_row + 1));
        let up = (shares - low) / (high - low);
        let column = node_of_b_v(b_v);
        let low_column = (column as usize).min(COLOURS - 2);
        let right = column - low_column as f64;
        let corner = |row: usize, column: usize| &self.logarithms[row * COLOURS + column];
        let (a, b) = (corner(low_row, low_column), corner(low_row, low_column + 1));
        let (c, d) = (corner(low_row + 1, low_column), corner(low_row + 1, low_column + 1));
        let [x, y, z, v] = std::array::from_fn(|k| {
            let low = a[k] + (b[k] - a[k]) * right;
            let high = c[k] + (d[k] - c[k]) * right;
            (low + (high - low) * up).exp()
        });
        Xyzv::new(x, y, z, v) * outside.lx()
    }
}

fn b_v_of_node(node: usize) -> f64 {
    let (low, high) = (B_V_RANGE.start(), B_V_RANGE.end());
    low + (high - low) * node as f64 / (COLOURS - 1) as f64
}

fn node_of_b_v(b_v: f64) -> f64 {
    let (low, high) = (B_V_RANGE.start(), B_V_RANGE.end());
    let b_v = if b_v.is_nan() { 0.65 } else { b_v };
    (b_v.clamp(*low, *high) - low) / (high - low) * (COLOURS - 1) as f64
}

/// The altitude of a row, as a share of the way from the horizon to the zenith.
fn share_of_row(row: usize) -> f64 {
    (row as f64 / LAST_ROW).powi(2)
}

/// The same for any altitude; what lies outside is brought to the nearer end.
fn share_of_altitude(altitude: Angle, horizon: Angle) -> f64 {
    let share = (altitude - horizon).rad() / (Angle::from_deg(90.0) - horizon).rad();
    share.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::extinction::transmittance;
    use crate::light::star_colour;
    use crate::units::Magnitude;

    #[test]
    fn colours_and_rows_find_their_places() {
        for node in [0, 17, COLOURS - 1] {
            assert!((node_of_b_v(b_v_of_node(node)) - node as f64).abs() < 1e-9);
        }
        let horizon = Angle::from_deg(-1.7);
        let altitude = horizon + Angle::from_deg(91.7) * share_of_row(100);
        assert!((share_of_altitude(altitude, horizon) - share_of_row(100)).abs() < 1e-14);
    }

    #[test]
    fn the_table_agrees_with_the_integration() {
        let mut hazy = Atmosphere::default();
        hazy.aerosol.optical_depth_550 = 0.4;
        let mut worst: f64 = 0.0;
        for (air, height_m) in
            [(Atmosphere::default(), 0.0), (hazy, 0.0), (Atmosphere::default(), 4200.0)]
        {
            let table = StarLight::new(&air, height_m);
            for step in 0..90 {
                // Odd steps, fine near the horizon.
                let altitude = table.horizon + Angle::from_deg(0.0107 * f64::from(step * step));
                let through = transmittance(&air, height_m, altitude);
                for b_v in [-0.4, -0.375, -0.013, 0.31, 0.777, 1.524, 1.99] {
                    let star = star_colour::star(Magnitude(0.0), b_v);
                    let exact = (star.spectrum * through).xyzv();
                    let quick = table.at_eye(b_v, altitude, Magnitude(0.0).illuminance());
                    for (a, b) in [
                        (quick.x, exact.x),
                        (quick.y, exact.y),
                        (quick.z, exact.z),
                        (quick.v, exact.v),
                    ] {
                        let error = (a / b - 1.0).abs();
                        if error > 1.5e-3 {
                            println!("{height_m} {step} {} {b_v} {error}", altitude.deg());
                        }
                        worst = worst.max(error);
                    }
                }
            }
        }
        assert!(worst < 2e-3, "{worst}");
    }

    #[test]
    fn haze_without_end_leaves_no_light_but_no_nonsense() {
        let mut fog = Atmosphere::default();
        fog.aerosol.optical_depth_550 = 5.0;
        let light = StarLight::new(&fog, 0.0).at_eye(0.6, Angle::ZERO, Illuminance::from_lx(1.0));
        assert!(light.y >= 0.0 && light.y < 1e-100, "{light:?}");
        let odd = StarLight::new(&Atmosphere::default(), 0.0);
        let light = odd.at_eye(f64::NAN, Angle::from_deg(-50.0), Illuminance::from_lx(1.0));
        assert!(light.y > 0.0 && light.y < 0.01, "{light:?}");
    }
}

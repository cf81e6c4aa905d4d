//! How an aerosol lies over height.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::Checked;

/// Above this, the exponential profile holds no aerosol, kilometres.
const EXPONENTIAL_TOP_KM: f64 = 30.0;
/// The solver samples profiles each kilometre up to here, and each two above.
const FINE_TOP_KM: f64 = 30.0;
/// No layer reaches higher, kilometres.
const LAYER_TOP_KM: f64 = 60.0;

/// Shares of the whole column above sea level by height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "shape", rename_all = "kebab-case", deny_unknown_fields)]
pub enum AerosolProfile {
    /// Falls by a factor e over a height of 0.5 to 10 km; nothing above 30 km.
    Exponential { scale_height_km: f64 },
    /// A smooth bump between two heights, half a wave of a cosine raised to touch zero: at least
    /// 2 km thick, 4 km if it reaches above 30 km; 0 to 60 km.
    Layer { bottom_km: f64, top_km: f64 },
}

impl AerosolProfile {
    pub(super) fn ranges(&self, path: &str) -> Vec<Checked> {
        match *self {
            AerosolProfile::Exponential { scale_height_km } => {
                vec![(format!("{path}.scale_height_km"), scale_height_km, 0.5, 10.0)]
            }
            AerosolProfile::Layer { bottom_km, top_km } => {
                // Thinner layers would fall between the nodes of the solver.
                let thinnest = if top_km > FINE_TOP_KM { 4.0 } else { 2.0 };
                vec![
                    (format!("{path}.bottom_km"), bottom_km, 0.0, LAYER_TOP_KM - 4.0),
                    (format!("{path}.top_km"), top_km, bottom_km + thinnest, LAYER_TOP_KM),
                ]
            }
        }
    }

    /// Share of the whole column in a kilometre at a height above sea level.
    pub fn density_per_km(&self, height_km: f64) -> f64 {
        match *self {
            AerosolProfile::Exponential { .. } if height_km > EXPONENTIAL_TOP_KM => 0.0,
            AerosolProfile::Exponential { scale_height_km } => {
                (-height_km / scale_height_km).exp() / scale_height_km
            }
            AerosolProfile::Layer { bottom_km, top_km } => {
                let t = (height_km - bottom_km) / (top_km - bottom_km);
                if !(0.0..=1.0).contains(&t) {
                    return 0.0;
                }
                (1.0 - (2.0 * PI * t).cos()) / (top_km - bottom_km)
            }
        }
    }
}

//! What a camera records of the frame: lens, shutter, sensor, and the colours made of it.
//!
//! Nothing of human vision is in it: no rods, no glare of an eye, no adaptation. Stars keep their colours.
//!
//! *Lens.* The luminance L, cd/m2, before a lens of aperture number N and transmission T gives the
//! illuminance `pi/4 L T / N^2` on the sensor (ISO 12232; of far objects), less beside the axis
//! ([`lens`]). *Sensor.* Illuminance, time and area make electrons, with the noise of counting
//! and of reading ([`sensor`]). *Gain.* What saturates the picture is an exposure of 78/ISO lx s,
//! the saturation-based speed of ISO 12232, or the full well, whichever comes first. *Metering* lays the mean of
//! a scene at 10/ISO lx s, an eighth of it: so that the 18 % of a grey card lie half a stop below where
//! a perfect white would saturate. *Colour.* The three channels of a camera that exists, balanced to a
//! white, and back to X, Y and Z ([`colour`]); what saturates becomes white.
//!
//! Left out: the mosaic of the colour filters and what is interpolated between them, dark current and hot
//! pixels, trails of stars in long exposures, aberrations and flare of the lens, and that shutters are
//! slow to open.
//!
//! [`Photo`] is what the photographer sets, [`exposure::Exposure`] what comes of it for a picture:
//! plain numbers, for `shaders/photo.wgsl` and its twin here.

pub mod colour;
pub mod exposure;
pub mod lens;
pub mod sensor;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use colour::WhiteBalance;
use lens::Lens;
use sensor::Body;

/// What can be wrong with a camera's settings.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PhotoError {
    #[error("photo.{what} is {value}, outside {low} to {high}; choose a value inside")]
    Range { what: &'static str, value: f64, low: f64, high: f64 },
    #[error(
        "photo.iso is {iso}, below the base ISO {base_iso} of the sensor; choose a higher one, or a shorter shutter_s"
    )]
    BelowBase { iso: f64, base_iso: f64 },
    #[error(
        "photo.lens.blades is {0}; choose 0 for an aperture without spikes, or 3 to 32 straight blades"
    )]
    Blades(u32),
}

/// How balanced light is brought to the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Curve {
    /// `x (3 - x^2) / 2`: half as steep again in the dark, level where the sensor saturates. It shows what is
    /// metered, 0.128, as 0.191 of white: a grey card as a grey card.
    #[default]
    Film,
    /// As recorded: the saturated sensor is the white of the screen.
    Linear,
}

impl Curve {
    /// The share of the screen's white that is shown, of a share of saturation from 0 to 1.
    pub fn shown(self, share: f64) -> f64 {
        match self {
            Curve::Film => share * (3.0 - share * share) / 2.0,
            Curve::Linear => share,
        }
    }
}

/// What the photographer sets. Table `[photo]` of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Photo {
    /// Time that the shutter is open, seconds; by the meter when left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shutter_s: Option<f64>,
    /// Speed that the sensor is set to; by the meter when left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iso: Option<f64>,
    /// Brighter or darker than metered, factors of two.
    pub compensation_stops: f64,
    pub curve: Curve,
    /// Whether electrons are counted and read with noise.
    pub noise: bool,
    /// Of the noise: the same seed gives the same picture.
    pub seed: u32,
    pub white_balance: WhiteBalance,
    pub body: Body,
    pub lens: Lens,
}

impl Default for Photo {
    fn default() -> Self {
        Photo {
            shutter_s: None,
            iso: None,
            compensation_stops: 0.0,
            curve: Curve::Film,
            noise: true,
            seed: 0,
            white_balance: WhiteBalance::Daylight,
            body: Body::default(),
            lens: Lens::default(),
        }
    }
}

impl Photo {
    /// Checks every value.
    pub fn validate(&self) -> Result<(), PhotoError> {
        let sensor = self.body.sensor();
        let kelvin = match self.white_balance {
            WhiteBalance::Kelvin(kelvin) => Some(kelvin),
            _ => None,
        };
        within("shutter_s", self.shutter_s, 1e-6, 1e6)?;
        within("iso", self.iso, 1.0, 1e7)?;
        within("compensation_stops", Some(self.compensation_stops), -30.0, 30.0)?;
        within("white_balance", kelvin, colour::COLDEST_K, colour::HOTTEST_K)?;
        sensor.validate()?;
        self.lens.validate()?;
        match self.iso {
            Some(iso) if iso < sensor.base_iso => {
                Err(PhotoError::BelowBase { iso, base_iso: sensor.base_iso })
            }
            _ => Ok(()),
        }
    }
}

/// Refuses what is outside, and what is no number.
fn within(what: &'static str, value: Option<f64>, low: f64, high: f64) -> Result<(), PhotoError> {
    match value {
        Some(value) if !(low..=high).contains(&value) => {
            Err(PhotoError::Range { what, value, low, high })
        }
        _ => Ok(()),
    }
}

//! The sky models that people know: for comparison, never for truth.
//!
//! Four skies in closed form, each from its publication and each labelled with where it fails. All
//! hold for a Sun above the horizon and for an observer on the ground; below the horizon they are
//! black. They give the luminance of a direction; what they leave open is filled by stated rules:
//!
//! - **Level.** [`ClassicModel::CieOvercast`] and [`ClassicModel::CieClear`] are scaled by published
//!   zenith luminances, [`ClassicModel::Perez`] to its diffuse illuminance;
//!   [`ClassicModel::Preetham`] has a level of its own.
//! - **Colour.** Only Preetham has any. The others are drawn in the light of D65.
//! - **Scotopic light.** That of CIE daylight of the same chromaticity ([`daylight`]).
//! - **Turbidity.** From the aerosol of the air, unless given ([`turbidity`]).
//!
//! The distance of the Sun, the ozone, the ground albedo and the refraction of the air are not asked.
//!
//! ```
//! use nocturne::air::Atmosphere;
//! use nocturne::air::classic::{ClassicModel, ClassicSky};
//! use nocturne::units::Angle;
//!
//! let sky = ClassicSky::new(ClassicModel::Preetham);
//! let sky = sky.under(&Atmosphere::default(), 0.0, Angle::from_deg(30.0))?;
//! let zenith = sky.luminance(Angle::from_deg(90.0), Angle::ZERO);
//! assert!((2000.0..4000.0).contains(&zenith.y));
//! # Ok::<(), nocturne::air::classic::ClassicSkyError>(())
//! ```

use std::f64::consts::{PI, TAU};
use std::iter::Sum;
use std::ops::Mul;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::air::Atmosphere;
use crate::units::{Angle, Xyzv};

pub mod aerial;
pub mod cie;
pub mod daylight;
pub mod gradation;
pub mod perez;
pub mod preetham;
pub mod turbidity;

use daylight::D65_XY;
use gradation::Direction;

/// Nodes across the sky, in the square of the sine of the zenith distance and in azimuth, of the
/// integral for the illuminance: within 0.1 % for each model.
const ILLUMINANCE_NODES: (usize, usize) = (96, 96);

/// One of the models.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ClassicModel {
    /// The overcast sky of Moon & Spencer 1942.
    CieOvercast,
    /// The clear sky of Kittler 1967, CIE 1973.
    CieClear,
    /// All weathers after Perez, Seals & Michalsky 1993.
    Perez,
    /// Daylight after Preetham, Shirley & Smits 1999.
    Preetham,
}

impl ClassicModel {
    /// All of them, from the oldest on.
    pub const ALL: [ClassicModel; 4] = [
        ClassicModel::CieOvercast,
        ClassicModel::CieClear,
        ClassicModel::Perez,
        ClassicModel::Preetham,
    ];

    /// As in scenes and on the command line.
    pub const fn key(self) -> &'static str {
        match self {
            ClassicModel::CieOvercast => "cie-overcast",
            ClassicModel::CieClear => "cie-clear",
            ClassicModel::Perez => "perez",
            ClassicModel::Preetham => "preetham",
        }
    }

    /// Name and publication.
    pub const fn name(self) -> &'static str {
        match self {
            ClassicModel::CieOvercast => "CIE overcast sky (Moon & Spencer 1942)",
            ClassicModel::CieClear => "CIE clear sky (Kittler 1967, CIE 1973)",
            ClassicModel::Perez => "Perez all-weather sky (Perez, Seals & Michalsky 1993)",
            ClassicModel::Preetham => "Preetham daylight (Preetham, Shirley & Smits 1999)",
        }
    }

    /// Where it fails, in one sentence.
    pub const fn fails(self) -> &'static str {
        match self {
            ClassicModel::CieOvercast => {
                "It is one even, thick cloud: it knows no Sun in it, no colour and no breaks, and its \
                 level is a mean, which single days miss widely."
            }
            ClassicModel::CieClear => {
                "It has no colour, its zenith has no bound as the Sun climbs (it is held from 75 degrees \
                 on), its aureole is the same in any haze, and with the Sun at 2 degrees it is half as \
                 bright again as the solved sky."
            }
            ClassicModel::Perez => {
                "It has no colour, its eight classes of weather join with jumps, its coefficients come \
                 from the measurements of one site, and a negative luminance has to be cut off."
            }
            ClassicModel::Preetham => {
                "It was fitted to turbidities from 2 to 6 and turns over below 1.7, it is twice as bright \
                 as the solved sky by day and eight times with the Sun at 2 degrees, its aureole is weak, \
                 and without ozone its zenith pales as the Sun sets."
            }
        }
    }

    /// Turbidities that its formulas hold for, in its own scale: Linke's, or for Preetham the ratio of
    /// haze and molecules to molecules.
    pub const fn turbidities(self) -> (f64, f64) {
        match self {
            ClassicModel::Preetham => preetham::TURBIDITIES,
            _ => turbidity::LINKE_TURBIDITIES,
        }
    }

    /// Whether the Sun shines through: under the overcast sky no direct light reaches the ground.
    pub const fn lets_sun_through(self) -> bool {
        !matches!(self, ClassicModel::CieOvercast)
    }
}

/// A classic sky as a document: a model, and what it asks for beyond the Sun and the air.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClassicSky {
    pub model: ClassicModel,
    /// Turbidity in the scale of the model; from the aerosol of the air when left out. 1.5 to 10 for
    /// Linke's (`cie-clear`, `perez`), 1.7 to 10 for `preetham`; `cie-overcast` has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turbidity: Option<f64>,
    /// Clearness of `perez`, 1 (overcast) to 12; that of a cloudless sky when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clearness: Option<f64>,
    /// Brightness of `perez`, 0.01 to 0.6; that of a cloudless sky when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub brightness: Option<f64>,
}

/// Why a model gives no sky.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ClassicSkyError {
    #[error(
        "sky: {} knows only a Sun above the horizon, and it stands at {altitude_deg:.1}°; choose \
         another time, or leave the model out", .model.key()
    )]
    SunDown { model: ClassicModel, altitude_deg: f64 },
    #[error(
        "sky: {what} is {value:.2}, and {} holds from {low} to {high}; give one inside", .model.key()
    )]
    Range { model: ClassicModel, what: &'static str, value: f64, low: f64, high: f64 },
    #[error("sky: {} has no {what}; leave it out", .model.key())]
    Unknown { model: ClassicModel, what: &'static str },
}

impl ClassicSky {
    /// A model with all that it asks for taken from the air.
    pub const fn new(model: ClassicModel) -> ClassicSky {
        ClassicSky { model, turbidity: None, clearness: None, brightness: None }
    }

    /// Refuses numbers that the model does not have or does not hold for.
    pub fn validate(&self) -> Result<(), ClassicSkyError> {
        let model = self.model;
        let (is_perez, has_turbidity) =
            (model == ClassicModel::Perez, model != ClassicModel::CieOvercast);
        for (what, value, known, (low, high)) in [
            ("turbidity", self.turbidity, has_turbidity, model.turbidities()),
            ("clearness", self.clearness, is_perez, perez::CLEARNESSES),
            ("brightness", self.brightness, is_perez, perez::BRIGHTNESSES),
        ] {
            match value {
                Some(_) if !known => return Err(ClassicSkyError::Unknown { model, what }),
                // Written so that NaN, which is in no range, is refused too.
                Some(value) if !(low..=high).contains(&value) => {
                    return Err(ClassicSkyError::Range { model, what, value, low, high });
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The sky under a Sun of the given apparent altitude, for an observer of the given height.
    pub fn under(
        &self,
        air: &Atmosphere,
        height_m: f64,
        sun_altitude: Angle,
    ) -> Result<SkyUnderSun, ClassicSkyError> {
        self.validate()?;
        let model = self.model;
        if sun_altitude <= Angle::ZERO || sun_altitude.rad().is_nan() {
            return Err(ClassicSkyError::SunDown { model, altitude_deg: sun_altitude.deg() });
        }
        let turbidity = match model {
            ClassicModel::CieOvercast => None,
            ClassicModel::Preetham => Some(turbidity::preetham(air)),
            ClassicModel::CieClear | ClassicModel::Perez => Some(turbidity::linke(air, height_m)),
        };
        let turbidity = self.turbidity.or(turbidity);
        let (low, high) = model.turbidities();
        if let Some(value) = turbidity.filter(|value| !(low..=high).contains(value)) {
            let what = "turbidity of the air";
            return Err(ClassicSkyError::Range { model, what, value, low, high });
        }
        // The overcast sky does not ask.
        let haze = turbidity.unwrap_or(low);
        let distribution = match model {
            ClassicModel::CieOvercast => Distribution::Overcast(cie::Overcast::under(sun_altitude)),
            ClassicModel::CieClear => Distribution::Clear(cie::Clear::under(haze, sun_altitude)),
            ClassicModel::Perez => {
                let cloudless = perez::Weather::cloudless(haze, sun_altitude);
                let weather = perez::Weather {
                    clearness: self.clearness.unwrap_or(cloudless.clearness),
                    brightness: self.brightness.unwrap_or(cloudless.brightness),
                };
                Distribution::Perez(perez::AllWeather::under(weather, sun_altitude))
            }
            ClassicModel::Preetham => {
                Distribution::Preetham(preetham::Daylight::under(haze, sun_altitude))
            }
        };
        Ok(SkyUnderSun { model, sun_altitude, turbidity, distribution })
    }
}

/// A classic sky with its Sun in place.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyUnderSun {
    pub model: ClassicModel,
    /// Apparent.
    pub sun_altitude: Angle,
    /// In the scale of the model; `None` for the overcast sky.
    pub turbidity: Option<f64>,
    distribution: Distribution,
}

#[derive(Debug, Clone, PartialEq)]
enum Distribution {
    Overcast(cie::Overcast),
    Clear(cie::Clear),
    Perez(perez::AllWeather),
    Preetham(preetham::Daylight),
}

impl SkyUnderSun {
    /// Luminance of an apparent direction, cd/m2; black below the horizon.
    pub fn luminance(&self, altitude: Angle, azimuth_from_sun: Angle) -> Xyzv {
        if altitude < Angle::ZERO {
            return Xyzv::BLACK;
        }
        let direction = Direction::of(altitude, azimuth_from_sun, self.sun_altitude);
        let (cd_m2, xy) = match &self.distribution {
            Distribution::Overcast(sky) => (sky.cd_m2(&direction), D65_XY),
            Distribution::Clear(sky) => (sky.cd_m2(&direction), D65_XY),
            Distribution::Perez(sky) => (sky.cd_m2(&direction), D65_XY),
            Distribution::Preetham(sky) => (sky.cd_m2(&direction), sky.xy(&direction)),
        };
        daylight::light(xy, cd_m2)
    }

    /// Illuminance of level ground by the sky, without the Sun itself, lux.
    pub fn illuminance(&self) -> Xyzv {
        over_the_sky(|altitude, azimuth| self.luminance(altitude, azimuth))
    }

    /// Model and what it was given, for people.
    pub fn label(&self) -> String {
        let name = self.model.name();
        match (&self.distribution, self.turbidity) {
            (Distribution::Perez(sky), _) => format!(
                "{name}, clearness {:.2}, brightness {:.3}",
                sky.weather.clearness, sky.weather.brightness
            ),
            (_, Some(turbidity)) => format!("{name}, turbidity {turbidity:.2}"),
            (_, None) => name.to_owned(),
        }
    }
}

/// What a luminance, by altitude and azimuth, lays on level ground.
fn over_the_sky<L: Mul<f64, Output = L> + Sum>(luminance: impl Fn(Angle, Angle) -> L) -> L {
    let (rows, columns) = ILLUMINANCE_NODES;
    let share = PI / (rows * columns) as f64;
    let nodes = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    // With the square of the sine of the zenith distance as the variable, its cosine is in it.
    nodes
        .map(|(row, column)| {
            let sine = ((row as f64 + 0.5) / rows as f64).sqrt();
            let altitude = Angle::from_rad(sine.acos());
            let azimuth = Angle::from_rad(TAU * (column as f64 + 0.5) / columns as f64);
            luminance(altitude, azimuth) * share
        })
        .sum()
}

//! Sensors: how large they are, and how light becomes electrons.
//!
//! A lumen at 555 nm is [`PHOTONS_PER_LM_S`] photons a second. Daylight has 1.11e16 between 400 and 700 nm for
//! each lumen (54 lux for a micromole per m2 and s of sunlight; Thimijan & Heins 1983), of which a filter of
//! one of three colours passes about a third: 3.7e15. We therefore take the number at 555 nm for each
//! channel when the light is white, with the quantum efficiency at the peak of a channel,
//! filter included. It is good to some 10 %, as sensors of one kind differ.
//!
//! Numbers of the named sensors are typical of cameras made about 2020, rounded, none of a maker: the full wells
//! are 1600 electrons on a square micrometre, which is what 78/ISO lx s fill at ISO 100 with an efficiency of
//! one half.
//!
//! A pixel of a picture is as many photosites as fit in it: their wells and noise add. A picture
//! finer than the sensor has photosites of its own size, each with the read noise of one.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::{PhotoError, within};

/// Photons of 540 THz (555 nm) per lumen and second: `1 / (683 lm/W h 540 THz)`, SI 2019.
pub const PHOTONS_PER_LM_S: f64 = 1.0 / (683.0 * 6.626_070_15e-34 * 540e12);

/// Sensors that people know by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SensorKind {
    MediumFormat,
    #[default]
    FullFrame,
    ApsC,
    MicroFourThirds,
    Phone,
}

/// What a sensor is and does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    pub width_mm: f64,
    pub height_mm: f64,
    /// Edge of a photosite, micrometres.
    pub photosite_um: f64,
    /// Electrons for each photon, at the peak of a channel.
    pub quantum_efficiency: f64,
    /// Of a photosite, one standard deviation, electrons.
    pub read_noise_e: f64,
    /// Of a photosite, electrons.
    pub full_well_e: f64,
    pub adc_bits: f64,
    /// The lowest speed: at it, the full well saturates the picture.
    pub base_iso: f64,
}

impl SensorKind {
    pub const ALL: [SensorKind; 5] = [
        SensorKind::MediumFormat,
        SensorKind::FullFrame,
        SensorKind::ApsC,
        SensorKind::MicroFourThirds,
        SensorKind::Phone,
    ];

    /// Its numbers.
    pub const fn sensor(self) -> Sensor {
        match self {
            SensorKind::MediumFormat => typical(43.8, 32.9, 3.76, 2.0, 16.0),
            SensorKind::FullFrame => typical(36.0, 24.0, 5.95, 3.0, 14.0),
            SensorKind::ApsC => typical(23.5, 15.6, 3.9, 2.5, 14.0),
            SensorKind::MicroFourThirds => typical(17.3, 13.0, 3.3, 2.5, 12.0),
            SensorKind::Phone => typical(9.8, 7.3, 1.22, 1.5, 10.0),
        }
    }
}

const fn typical(
    width_mm: f64,
    height_mm: f64,
    photosite_um: f64,
    read_noise_e: f64,
    adc_bits: f64,
) -> Sensor {
    Sensor {
        width_mm,
        height_mm,
        photosite_um,
        quantum_efficiency: 0.5,
        read_noise_e,
        full_well_e: 1600.0 * photosite_um * photosite_um,
        adc_bits,
        base_iso: 100.0,
    }
}

/// A camera without its lens: a sensor by name, and what differs.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Body {
    pub sensor: SensorKind,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub photosite_um: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quantum_efficiency: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub read_noise_e: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub full_well_e: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adc_bits: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_iso: Option<f64>,
}

impl Body {
    /// The sensor with what differs.
    pub fn sensor(&self) -> Sensor {
        let named = self.sensor.sensor();
        Sensor {
            width_mm: self.width_mm.unwrap_or(named.width_mm),
            height_mm: self.height_mm.unwrap_or(named.height_mm),
            photosite_um: self.photosite_um.unwrap_or(named.photosite_um),
            quantum_efficiency: self.quantum_efficiency.unwrap_or(named.quantum_efficiency),
            read_noise_e: self.read_noise_e.unwrap_or(named.read_noise_e),
            full_well_e: self.full_well_e.unwrap_or(named.full_well_e),
            adc_bits: self.adc_bits.unwrap_or(named.adc_bits),
            base_iso: self.base_iso.unwrap_or(named.base_iso),
        }
    }
}

/// A pixel of a picture that spans a sensor, set to a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PicturePixel {
    /// Electrons of a channel for each lux second of white light.
    pub electrons_per_lx_s: f64,
    /// Electrons at which it saturates.
    pub saturation_e: f64,
    /// Of reading and digitizing, one standard deviation, electrons.
    pub read_noise_e: f64,
}

impl PicturePixel {
    /// The exposure at which it saturates, lux seconds.
    pub fn saturation_lx_s(&self) -> f64 {
        self.saturation_e / self.electrons_per_lx_s
    }
}

impl Sensor {
    /// Checks every value.
    pub fn validate(&self) -> Result<(), PhotoError> {
        within("body.width_mm", Some(self.width_mm), 0.1, 1000.0)?;
        within("body.height_mm", Some(self.height_mm), 0.1, 1000.0)?;
        within("body.photosite_um", Some(self.photosite_um), 0.1, 1000.0)?;
        within("body.quantum_efficiency", Some(self.quantum_efficiency), 0.001, 1.0)?;
        within("body.read_noise_e", Some(self.read_noise_e), 0.0, 10_000.0)?;
        within("body.full_well_e", Some(self.full_well_e), 10.0, 1e9)?;
        within("body.adc_bits", Some(self.adc_bits), 1.0, 32.0)?;
        within("body.base_iso", Some(self.base_iso), 1.0, 1e6)
    }

    /// A pixel of a picture of so many across.
    pub fn picture_pixel(&self, width_px: u32, iso: f64) -> PicturePixel {
        let pitch_um = 1e3 * self.width_mm / f64::from(width_px);
        let photosites = (pitch_um / self.photosite_um).powi(2);
        let area_m2 = (pitch_um * 1e-6).powi(2);
        let electrons_per_lx_s = area_m2 * PHOTONS_PER_LM_S * self.quantum_efficiency;
        let well_e = photosites * self.full_well_e;
        let saturation_e = (electrons_per_lx_s * saturation_lx_s(iso)).min(well_e);
        // A step of the converter has the variance of an even spread, a twelfth of its square.
        let step_e = saturation_e / photosites / (self.adc_bits.exp2() - 1.0);
        let variance = self.read_noise_e.powi(2) + step_e * step_e / 12.0;
        let read_noise_e = (photosites.max(1.0) * variance).sqrt();
        PicturePixel { electrons_per_lx_s, saturation_e, read_noise_e }
    }
}

/// The exposure that saturates a picture, lux seconds: ISO 12232, saturation-based speed.
pub fn saturation_lx_s(iso: f64) -> f64 {
    78.0 / iso
}

/// The exposure that the mean of a scene is given, lux seconds: ISO 12232, the focal plane exposure of
/// meters.
pub fn metered_lx_s(iso: f64) -> f64 {
    10.0 / iso
}

/// Illuminance on the sensor, on the axis, lux.
pub fn illuminance_lx(luminance_cd_m2: f64, transmission: f64, f_number: f64) -> f64 {
    PI / 4.0 * luminance_cd_m2 * transmission / (f_number * f_number)
}

//! Directions as people say them: a wind, degrees, the zenith, or an object.

use crate::frame::{Apparent, Dir, WINDS};
use crate::light::night::Night;
use crate::units::Angle;

use super::error::CliError;

/// The wind nearest to an azimuth.
pub fn wind(azimuth: Angle) -> &'static str {
    let index = (azimuth.positive().deg() / 22.5).round() as usize % WINDS.len();
    WINDS[index]
}

/// Where `--look` points.
#[derive(Debug, Clone, PartialEq)]
pub enum Look {
    Azimuth(Angle),
    Zenith,
    /// Something that stands in the sky, by name.
    Object(String),
}

impl Look {
    /// The azimuth that is meant, degrees; none for an object.
    pub fn azimuth_deg(&self) -> Option<f64> {
        match self {
            Look::Azimuth(azimuth) => Some(azimuth.deg()),
            Look::Zenith => Some(0.0),
            Look::Object(_) => None,
        }
    }

    /// The altitude that is meant, degrees, if it is.
    pub fn altitude_deg(&self) -> Option<f64> {
        (*self == Look::Zenith).then_some(90.0)
    }
}

impl std::str::FromStr for Look {
    type Err = String;

    fn from_str(text: &str) -> Result<Look, String> {
        let text = text.trim();
        if let Some(index) = WINDS.iter().position(|name| name.eq_ignore_ascii_case(text)) {
            return Ok(Look::Azimuth(Angle::from_deg(22.5 * index as f64)));
        }
        if text.eq_ignore_ascii_case("zenith") {
            return Ok(Look::Zenith);
        }
        match text.trim_end_matches('°').parse::<f64>() {
            Ok(deg) if (-360.0..=360.0).contains(&deg) => {
                Ok(Look::Azimuth(Angle::from_deg(deg).positive()))
            }
            Ok(_) => Err("an azimuth lies between -360 and 360 degrees".to_owned()),
            Err(_) if text.is_empty() => Err("it names nothing".to_owned()),
            Err(_) => Ok(Look::Object(text.to_owned())),
        }
    }
}

/// The direction of an object that stands above the horizon.
pub fn towards(name: &str, night: &Night) -> Result<Dir<Apparent>, CliError> {
    let (apparent, label) = match (night.find(name), night.moon_feature(name)) {
        (Some(object), _) => (object.apparent, night.label(&object)),
        (None, Some(feature)) => (night.on_moon(feature).1, feature.name.clone()),
        (None, None) => {
            return Err(CliError::Usage(format!(
                "--look: '{name}' is neither a direction (N, SSW, 212, zenith) nor the Sun, the Moon, a place on it, a planet or a star of the catalogue; `nocturne objects` lists them"
            )));
        }
    };
    let altitude_deg = apparent.altitude().deg();
    if altitude_deg < 0.0 {
        return Err(CliError::Usage(format!(
            "--look: {} is below the horizon then and there, at altitude {altitude_deg:.1}°; choose another instant or direction",
            label
        )));
    }
    Ok(apparent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn winds_degrees_and_names_are_understood() {
        let azimuth = |text: &str| match text.parse() {
            Ok(Look::Azimuth(angle)) => angle.deg(),
            other => panic!("{text}: {other:?}"),
        };
        assert_eq!(azimuth("s"), 180.0);
        assert!((azimuth("WNW") - 292.5).abs() < 1e-9);
        assert!((azimuth("-90") - 270.0).abs() < 1e-9);
        assert_eq!("Zenith".parse(), Ok(Look::Zenith));
        assert_eq!("Mars".parse(), Ok(Look::Object("Mars".to_owned())));
        assert!("400".parse::<Look>().is_err());
        assert!("NaN".parse::<Look>().is_err());
    }

    #[test]
    fn winds_are_named_from_azimuths() {
        assert_eq!(wind(Angle::from_deg(359.0)), "N");
        assert_eq!(wind(Angle::from_deg(202.0)), "SSW");
    }
}

//! Everything that a picture depends on, in one file that people can read and edit.
//!
//! The same scene file gives the same picture, byte for byte, on the same machine.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::air::classic::{ClassicSky, ClassicSkyError};
use crate::air::{AirError, Atmosphere};
use crate::camera::{Camera, CameraError, Projection};
use crate::display::{Display, DisplayError};
use crate::eye::Eye;
use crate::light::earth_shadow::Danjon;
use crate::light::moon::Reflectance;
use crate::light::night_lights::{NightGlow, NightGlowError};
use crate::light::scintillation::{Scintillation, ScintillationError};
use crate::photo::{Photo, PhotoError};
use crate::place::{Place, PlaceError};
use crate::time::{self, Instant, TimeError};
use crate::units::Angle;

/// Version of the scene file.
pub const FORMAT: u32 = 2;

/// The share of a pixel that a position may be off by when no tolerance is asked for.
const TOLERANCE_IN_PIXELS: f64 = 0.1;

/// What can be wrong with a scene.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SceneError {
    #[error("line {line}: {message}")]
    Syntax { line: usize, message: String },
    #[error(
        "nocturne_scene is {0}, and this program reads version {FORMAT}; use the program that wrote it, or edit it"
    )]
    Format(u32),
    #[error("{what} is {value}, outside {low} to {high}; choose a value inside")]
    Range { what: &'static str, value: f64, low: f64, high: f64 },
    #[error(transparent)]
    Time(#[from] TimeError),
    #[error("time zone '{0}' is not known; use a name like America/Phoenix, or leave it out")]
    TimeZone(String),
    #[error(transparent)]
    Place(#[from] PlaceError),
    #[error(transparent)]
    Camera(#[from] CameraError),
    #[error(transparent)]
    Air(#[from] AirError),
    #[error(transparent)]
    Sky(#[from] ClassicSkyError),
    #[error(transparent)]
    Night(#[from] NightGlowError),
    #[error(transparent)]
    Display(#[from] DisplayError),
    #[error(transparent)]
    Photo(#[from] PhotoError),
    #[error(transparent)]
    Scintillation(#[from] ScintillationError),
}

/// A picture, described.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of this file.
    pub nocturne_scene: u32,
    /// The instant, UTC.
    pub utc: String,
    /// How far off positions may be, arcseconds; a tenth of a pixel when left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance_arcsec: Option<f64>,
    pub place: ScenePlace,
    pub camera: SceneCamera,
    #[serde(default)]
    pub layers: Layers,
    /// A classic model of the sky in place of the air solved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sky: Option<ClassicSky>,
    /// How points of light twinkle; not at all when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scintillation: Option<Scintillation>,
    /// How the dark sky glows.
    #[serde(default)]
    pub night: NightGlow,
    #[serde(default)]
    pub moon: SceneMoon,
    #[serde(default)]
    pub air: Atmosphere,
    #[serde(default)]
    pub eye: Eye,
    /// A camera in place of the eye.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photo: Option<Photo>,
    /// The screen that the picture is for.
    #[serde(default)]
    pub display: Display,
    #[serde(default)]
    pub marks: Marks,
}

/// Where the observer stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScenePlace {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// North positive.
    pub latitude_deg: f64,
    /// East positive.
    pub longitude_deg: f64,
    #[serde(default)]
    pub height_m: f64,
    /// Name in the IANA data base, for printing local times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_zone: Option<String>,
}

/// Where the camera looks, and how it sees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneCamera {
    /// Azimuth of the centre of the picture, from north through east.
    pub azimuth_deg: f64,
    /// Apparent altitude of the centre of the picture.
    pub altitude_deg: f64,
    #[serde(default)]
    pub roll_deg: f64,
    /// Angle that the width of the picture spans.
    pub field_of_view_deg: f64,
    pub projection: Projection,
    pub width_px: u32,
    pub height_px: u32,
}

/// How the Moon is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SceneMoon {
    /// How its ground sends light back.
    pub reflectance: Reflectance,
    /// How dark its eclipses are: Danjon's number, 0 (very dark) to 4 (bright orange).
    pub danjon: Danjon,
}

/// What is drawn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Layers {
    pub sun: bool,
    pub moon: bool,
    pub planets: bool,
    pub stars: bool,
    /// Light of the sky itself: scattered sunlight and moonlight, and the dark sky.
    pub skylight: bool,
    pub ground: bool,
    /// Lights of the dark sky: each shines only with `skylight`.
    pub airglow: bool,
    pub zodiacal_light: bool,
    /// All stars that are not drawn one by one, and the dust that they light.
    pub milky_way: bool,
    /// Shines only where [`NightGlow`] asks for it.
    pub town_glow: bool,
    /// Stars and planets fainter than this are left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub magnitude_limit: Option<f64>,
}

impl Default for Layers {
    fn default() -> Self {
        Layers {
            sun: true,
            moon: true,
            planets: true,
            stars: true,
            skylight: true,
            ground: true,
            airglow: true,
            zodiacal_light: true,
            milky_way: true,
            town_glow: true,
            magnitude_limit: None,
        }
    }
}

/// Marks drawn on the finished picture, never into the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Marks {
    pub horizon: bool,
    pub cardinal_points: bool,
}

impl Default for Marks {
    fn default() -> Self {
        Marks { horizon: true, cardinal_points: true }
    }
}

/// A scene that has been checked: its words turned into instants, places and cameras.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    pub instant: Instant,
    pub place: Place,
    pub camera: Camera,
    /// How far off a position may be.
    pub tolerance: Angle,
    /// A classic model of the sky in place of the air solved.
    pub sky: Option<ClassicSky>,
    /// How the dark sky glows.
    pub night: NightGlow,
    /// How the ground of the Moon sends light back.
    pub reflectance: Reflectance,
    /// How points of light twinkle.
    pub scintillation: Option<Scintillation>,
}

impl Scene {
    /// Reads a scene file.
    pub fn parse(text: &str) -> Result<Scene, SceneError> {
        let scene: Scene = toml::from_str(text).map_err(|error| {
            let before = error.span().map_or(0, |span| span.start.min(text.len()));
            let line = text.as_bytes()[..before].iter().filter(|&&b| b == b'\n').count() + 1;
            let message = error.message().lines().collect::<Vec<_>>().join("; ");
            SceneError::Syntax { line, message }
        })?;
        if scene.nocturne_scene != FORMAT {
            return Err(SceneError::Format(scene.nocturne_scene));
        }
        Ok(scene)
    }

    /// The scene as a file that [`Scene::parse`] reads back unchanged.
    pub fn to_toml(&self) -> String {
        // Plain structs of numbers, strings and tables have no value that TOML cannot hold.
        let body = toml::to_string(self).expect("a scene is plain data");
        format!(
            "# A scene of Nocturne: `nocturne render --scene FILE -o sky.png` draws it.\n\n{body}"
        )
    }

    /// Checks every value and turns it into what it means.
    pub fn setting(&self) -> Result<Setting, SceneError> {
        let instant = time::to_instant(&time::parse(&self.utc)?, None)?;
        let at = &self.place;
        let mut place = Place::new(at.latitude_deg, at.longitude_deg, at.height_m)?;
        place.name.clone_from(&at.name);
        if let Some(zone) = &at.time_zone {
            let known = zone.parse().map_err(|_| SceneError::TimeZone(zone.clone()))?;
            place.time_zone = Some(known);
        }
        let view = &self.camera;
        let camera = Camera {
            projection: view.projection,
            field_of_view: Angle::from_deg(view.field_of_view_deg),
            azimuth: Angle::from_deg(view.azimuth_deg),
            altitude: Angle::from_deg(view.altitude_deg),
            roll: Angle::from_deg(view.roll_deg),
            width_px: view.width_px,
            height_px: view.height_px,
        }
        .checked()?;
        self.air.validate_at(at.height_m)?;
        self.sky.as_ref().map_or(Ok(()), ClassicSky::validate)?;
        self.night.validate()?;
        self.display.validate()?;
        self.photo.as_ref().map_or(Ok(()), Photo::validate)?;
        self.check_numbers()?;
        let tolerance = match self.tolerance_arcsec {
            Some(arcsec) => Angle::from_arcsec(arcsec),
            None => camera.pixel_angle() * TOLERANCE_IN_PIXELS,
        };
        let reflectance = self.moon.reflectance;
        let scintillation = self.scintillation.map(Scintillation::checked).transpose()?;
        Ok(Setting {
            instant,
            place,
            camera,
            tolerance,
            sky: self.sky,
            night: self.night,
            reflectance,
            scintillation,
        })
    }

    fn check_numbers(&self) -> Result<(), SceneError> {
        let eye = &self.eye;
        let checks = [
            ("tolerance_arcsec", self.tolerance_arcsec, 0.0, 360_000.0),
            ("layers.magnitude_limit", self.layers.magnitude_limit, -30.0, 100.0),
            ("eye.exposure_stops", Some(eye.exposure_stops), -40.0, 40.0),
            ("eye.adaptation_cd_m2", eye.adaptation_cd_m2, 1e-7, 1e10),
            ("eye.field_factor", Some(eye.field_factor), 1.0, 10.0),
            ("eye.coming_from_cd_m2", eye.coming_from_cd_m2, 1e-7, 1e10),
            ("eye.since_s", Some(eye.since_s), 0.0, 1e9),
            ("eye.optics.age_years", Some(eye.optics.age_years), 0.0, 100.0),
            ("eye.optics.pigment", Some(eye.optics.pigment), 0.0, 1.2),
        ];
        for (what, value, low, high) in checks {
            if let Some(value) = value.filter(|value| !(low..=high).contains(value)) {
                return Err(SceneError::Range { what, value, low, high });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::classic::ClassicModel;

    fn scene() -> Scene {
        Scene {
            nocturne_scene: FORMAT,
            utc: "2026-08-13T04:30:00Z".to_owned(),
            tolerance_arcsec: None,
            place: ScenePlace {
                name: Some("Flagstaff".to_owned()),
                latitude_deg: 35.19807,
                longitude_deg: -111.65127,
                height_m: 2106.0,
                time_zone: Some("America/Phoenix".to_owned()),
            },
            camera: SceneCamera {
                azimuth_deg: 180.0,
                altitude_deg: 30.0,
                roll_deg: 0.0,
                field_of_view_deg: 90.1,
                projection: Projection::EqualArea,
                width_px: 640,
                height_px: 360,
            },
            layers: Layers::default(),
            sky: None,
            scintillation: None,
            night: NightGlow::default(),
            moon: SceneMoon::default(),
            air: Atmosphere::default(),
            eye: Eye::default(),
            photo: None,
            display: Display::default(),
            marks: Marks::default(),
        }
    }

    #[test]
    fn a_scene_survives_its_file() {
        let mut scene = scene();
        scene.layers.magnitude_limit = Some(0.1 + 0.2);
        scene.eye.adaptation_cd_m2 = Some(1e-3);
        scene.sky = Some(ClassicSky::new(ClassicModel::Preetham));
        scene.scintillation = Some(Scintillation { seed: 3, ..Scintillation::default() });
        assert_eq!(Scene::parse(&scene.to_toml()).unwrap(), scene);
        assert!(scene.setting().is_ok());
    }

    #[test]
    fn errors_name_the_line_and_the_value() {
        let text = scene().to_toml().replace("latitude_deg", "lattitude_deg");
        let message = Scene::parse(&text).unwrap_err().to_string();
        assert!(message.starts_with("line ") && message.contains("lattitude_deg"), "{message}");
        assert!(!message.contains('\n'));

        let text = scene().to_toml().replace("nocturne_scene = 2", "nocturne_scene = 7");
        assert_eq!(Scene::parse(&text), Err(SceneError::Format(7)));

        let mut bad = scene();
        bad.place.latitude_deg = 91.0;
        assert!(bad.setting().unwrap_err().to_string().contains("91"));
        let mut bad = scene();
        bad.eye.exposure_stops = f64::NAN;
        assert!(matches!(bad.setting(), Err(SceneError::Range { .. })));
        let mut bad = scene();
        bad.scintillation = Some(Scintillation { aperture_m: -1.0, ..Scintillation::default() });
        assert!(matches!(bad.setting(), Err(SceneError::Scintillation(_))));
        let mut bad = scene();
        bad.place.time_zone = Some("Mars/Olympus".to_owned());
        assert!(matches!(bad.setting(), Err(SceneError::TimeZone(_))));
    }
}

//! All that the user of the window can set. It edits a [`Scene`], the same that files hold.

use serde::{Deserialize, Serialize};

use crate::air::Atmosphere;
use crate::air::classic::ClassicSky;
use crate::display::Display;
use crate::eye::Eye;
use crate::light::night_lights::NightGlow;
use crate::light::scintillation::Scintillation;
use crate::photo::Photo;
use crate::scene::{FORMAT, Layers, Marks, Scene, SceneCamera, SceneMoon, ScenePlace};
use crate::sky::Target;
use crate::units::Angle;

use super::clock::Clock;
use super::sky::SkyRequest;
use super::view::View;

/// What the window shows, and how.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Model {
    pub clock: Clock,
    pub place: ScenePlace,
    /// Places that are kept.
    pub favourites: Vec<ScenePlace>,
    pub view: View,
    /// Light that is drawn.
    pub layers: Layers,
    /// Lines and words over it.
    pub overlays: Overlays,
    pub sky: Option<ClassicSky>,
    pub scintillation: Option<Scintillation>,
    pub night: NightGlow,
    pub moon: SceneMoon,
    pub air: Atmosphere,
    pub eye: Eye,
    /// The settings of the camera, also while the eye looks.
    pub photo: Photo,
    pub uses_camera: bool,
    pub display: Display,
    pub selected: Option<Target>,
    pub panels: Panels,
    /// Size of text and buttons, 1 as the system has it.
    pub zoom: f32,
}

/// Lines and words over the sky.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Overlays {
    pub constellation_lines: bool,
    pub constellation_boundaries: bool,
    pub constellation_names: bool,
    pub star_names: bool,
    pub planet_names: bool,
    pub deep_sky: bool,
    pub moon_features: bool,
    pub azimuthal_grid: bool,
    pub equatorial_grid: bool,
    pub j2000_grid: bool,
    pub ecliptic_grid: bool,
    pub galactic_grid: bool,
    pub ecliptic: bool,
    pub celestial_equator: bool,
    pub meridian: bool,
    pub horizon: bool,
    pub cardinal_points: bool,
    pub planet_trails: bool,
}

impl Default for Overlays {
    fn default() -> Overlays {
        Overlays {
            constellation_lines: false,
            constellation_boundaries: false,
            constellation_names: false,
            star_names: true,
            planet_names: true,
            deep_sky: false,
            moon_features: false,
            azimuthal_grid: false,
            equatorial_grid: false,
            j2000_grid: false,
            ecliptic_grid: false,
            galactic_grid: false,
            ecliptic: false,
            celestial_equator: false,
            meridian: false,
            horizon: true,
            cardinal_points: true,
            planet_trails: false,
        }
    }
}

/// A window within the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Panel {
    Time,
    Place,
    Search,
    Layers,
    /// Air and glow of the night.
    Air,
    /// Eye, camera and screen.
    Viewer,
    Export,
    Inspector,
    Help,
}

impl Panel {
    pub const ALL: [Panel; 9] = [
        Panel::Time,
        Panel::Place,
        Panel::Search,
        Panel::Layers,
        Panel::Air,
        Panel::Viewer,
        Panel::Export,
        Panel::Inspector,
        Panel::Help,
    ];

    pub fn title(self) -> &'static str {
        match self {
            Panel::Time => "Date and time",
            Panel::Place => "Place",
            Panel::Search => "Search",
            Panel::Layers => "Layers",
            Panel::Air => "Air",
            Panel::Viewer => "Eye and camera",
            Panel::Export => "Export",
            Panel::Inspector => "Inspector",
            Panel::Help => "Keys",
        }
    }
}

/// Which panels are open.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Panels {
    open: Vec<Panel>,
}

impl Panels {
    pub fn is_open(&self, panel: Panel) -> bool {
        self.open.contains(&panel)
    }

    pub fn set(&mut self, panel: Panel, is_open: bool) {
        self.open.retain(|other| *other != panel);
        if is_open {
            self.open.push(panel);
        }
    }

    pub fn toggle(&mut self, panel: Panel) {
        self.set(panel, !self.is_open(panel));
    }

    pub fn are_closed(&self) -> bool {
        self.open.is_empty()
    }

    /// Closes what was opened last. False when nothing is open.
    pub fn close_last(&mut self) -> bool {
        self.open.pop().is_some()
    }
}

impl Default for Model {
    fn default() -> Model {
        Model {
            clock: Clock::live(),
            place: ScenePlace {
                name: Some("Greenwich".to_owned()),
                latitude_deg: 51.4769,
                longitude_deg: 0.0,
                height_m: 46.0,
                time_zone: Some("Europe/London".to_owned()),
            },
            favourites: Vec::new(),
            view: View::default(),
            layers: Layers::default(),
            overlays: Overlays::default(),
            sky: None,
            scintillation: None,
            night: NightGlow::default(),
            moon: SceneMoon::default(),
            air: Atmosphere::default(),
            eye: Eye::default(),
            photo: Photo::default(),
            uses_camera: false,
            display: Display::default(),
            selected: None,
            panels: Panels::default(),
            zoom: 1.0,
        }
    }
}

impl Model {
    /// A window on a scene: it stands at its instant.
    pub fn of_scene(scene: &Scene) -> Result<Model, crate::scene::SceneError> {
        let setting = scene.setting()?;
        let camera = &setting.camera;
        let mut view = View::default();
        view.set_projection(camera.projection);
        view.set_field(camera.field_of_view.deg());
        let dir = crate::frame::Dir::from_azimuth_altitude(camera.azimuth, camera.altitude);
        view.look(dir, setting.place.latitude);
        Ok(Model {
            clock: Clock::at(setting.instant),
            place: scene.place.clone(),
            view,
            layers: scene.layers.clone(),
            overlays: Overlays {
                horizon: scene.marks.horizon,
                cardinal_points: scene.marks.cardinal_points,
                ..Overlays::default()
            },
            sky: scene.sky,
            scintillation: scene.scintillation,
            night: scene.night,
            moon: scene.moon,
            air: scene.air.clone(),
            eye: scene.eye.clone(),
            photo: scene.photo.unwrap_or_default(),
            uses_camera: scene.photo.is_some(),
            display: scene.display,
            ..Model::default()
        })
    }

    pub fn latitude(&self) -> Angle {
        Angle::from_deg(self.place.latitude_deg)
    }

    /// What is to be drawn on a picture of a size: the scene of the window as a file would hold it.
    pub fn scene(&self, [width_px, height_px]: [u32; 2]) -> Scene {
        let pose = self.view.pose(self.latitude());
        Scene {
            nocturne_scene: FORMAT,
            utc: self.clock.instant.to_string(),
            tolerance_arcsec: None,
            place: self.place.clone(),
            camera: SceneCamera {
                azimuth_deg: pose.azimuth.deg(),
                altitude_deg: pose.altitude.deg(),
                roll_deg: pose.roll.deg(),
                field_of_view_deg: self.view.field_deg,
                projection: self.view.projection,
                width_px,
                height_px,
            },
            layers: self.layers.clone(),
            sky: self.sky,
            scintillation: self.scintillation,
            night: self.night,
            moon: self.moon,
            air: self.air.clone(),
            eye: self.eye.clone(),
            photo: self.uses_camera.then_some(self.photo),
            display: self.display,
            marks: Marks {
                horizon: self.overlays.horizon,
                cardinal_points: self.overlays.cardinal_points,
            },
        }
    }

    /// What the sky is asked for.
    pub fn request(&self, size_px: [u32; 2]) -> SkyRequest {
        SkyRequest {
            scene: self.scene(size_px),
            follow: self.view.follow.clone(),
            mount: self.view.mount,
        }
    }

    /// Lets time of the viewer pass; the sky and the view go on.
    pub fn advance(&mut self, passed_s: f64) {
        let before = self.clock.instant;
        self.clock.advance(passed_s);
        self.follow_sky(before);
        self.view.advance(passed_s);
    }

    /// Changes the clock; a view on an equatorial mount goes with the stars.
    pub fn change_clock(&mut self, change: impl FnOnce(&mut Clock)) {
        let before = self.clock.instant;
        change(&mut self.clock);
        self.follow_sky(before);
    }

    fn follow_sky(&mut self, before: crate::time::Instant) {
        let days = self.clock.instant.ut1.jd() - before.ut1.jd();
        if days != 0.0 {
            self.view.turn_with_sky(days * crate::units::DAY_S);
        }
    }

    /// Moves to another place; on an equatorial mount the celestial pole stays upright.
    pub fn go_to(&mut self, place: ScenePlace) {
        self.place = place;
    }
}

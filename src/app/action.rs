//! What keys, buttons and menus do, each by one name.

use crate::camera::Projection;
use crate::frame::{Apparent, Dir};
use crate::scene::ScenePlace;
use crate::sky::Target;
use crate::time::Instant;
use crate::units::Angle;

use super::clock::Step;
use super::model::{Model, Panel};
use super::view::Mount;

/// Something that a user can have done.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    PlayOrPause,
    Faster,
    Slower,
    RealTime,
    Now,
    Step(Step, i32),
    SetInstant(Instant),
    /// To the next event, or with a negative direction to the one before.
    Jump(Jump, i32),
    GoTo(ScenePlace),
    /// Towards a direction.
    Look(Dir<Apparent>),
    /// By shares of the field: to the right, and up.
    Turn([f64; 2]),
    /// By powers of e of the field, gliding.
    Zoom(f64),
    SetField(f64),
    SetProjection(Projection),
    NextProjection,
    ToggleMount,
    Select(Option<Target>),
    /// Tells how bright the sky is in a direction.
    Measure(Dir<Apparent>),
    /// Brings what is selected to the middle, and keeps it there.
    FollowSelected,
    StopFollowing,
    Toggle(Layer),
    TogglePanel(Panel),
    /// The eye, or the camera.
    ToggleCamera,
    ToggleRedMode,
    /// Larger or smaller text.
    ScaleText(f32),
    ToggleFullScreen,
    /// A picture of what is seen, into the user's folder of pictures.
    Screenshot,
    /// A picture of what is seen, drawn anew while the window goes on.
    Export(Export),
    CancelExport,
    /// The scene as text, to the clipboard.
    CopyScene,
    /// Closes the panel that was opened last, else lets the selection go.
    Escape,
    /// Takes away what was said last.
    Dismiss,
    Quit,
}

/// A picture that is to be drawn for a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Export {
    /// Edges of the picture; as the window when left out.
    pub size_px: Option<[u32; 2]>,
    pub file: PictureFile,
}

/// The kind of a picture file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureFile {
    Png,
    Exr,
}

impl PictureFile {
    pub const fn extension(self) -> &'static str {
        match self {
            PictureFile::Png => "png",
            PictureFile::Exr => "exr",
        }
    }
}

/// What time can jump to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Jump {
    Sunrise,
    Sunset,
    Moonrise,
    Moonset,
    NewMoon,
    FullMoon,
    SolarEclipse,
    LunarEclipse,
    /// Of which something is seen at the place.
    SolarEclipseHere,
    LunarEclipseHere,
    /// Rise of what is selected.
    Rise,
    Transit,
    Set,
}

/// What can be switched on and off by a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layer {
    Atmosphere,
    Ground,
    Stars,
    Planets,
    MilkyWay,
    ZodiacalLight,
    Airglow,
    TownGlow,
    ConstellationLines,
    ConstellationBoundaries,
    ConstellationNames,
    StarNames,
    PlanetNames,
    DeepSky,
    MoonFeatures,
    AzimuthalGrid,
    EquatorialGrid,
    J2000Grid,
    EclipticGrid,
    GalacticGrid,
    Ecliptic,
    CelestialEquator,
    Meridian,
    Horizon,
    CardinalPoints,
    PlanetTrails,
}

impl Layer {
    pub const ALL: [Layer; 26] = [
        Layer::Atmosphere,
        Layer::Ground,
        Layer::Stars,
        Layer::Planets,
        Layer::MilkyWay,
        Layer::ZodiacalLight,
        Layer::Airglow,
        Layer::TownGlow,
        Layer::ConstellationLines,
        Layer::ConstellationBoundaries,
        Layer::ConstellationNames,
        Layer::StarNames,
        Layer::PlanetNames,
        Layer::DeepSky,
        Layer::MoonFeatures,
        Layer::AzimuthalGrid,
        Layer::EquatorialGrid,
        Layer::J2000Grid,
        Layer::EclipticGrid,
        Layer::GalacticGrid,
        Layer::Ecliptic,
        Layer::CelestialEquator,
        Layer::Meridian,
        Layer::Horizon,
        Layer::CardinalPoints,
        Layer::PlanetTrails,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Layer::Atmosphere => "Atmosphere",
            Layer::Ground => "Ground",
            Layer::Stars => "Stars",
            Layer::Planets => "Planets",
            Layer::MilkyWay => "Milky Way",
            Layer::ZodiacalLight => "Zodiacal light",
            Layer::Airglow => "Airglow",
            Layer::TownGlow => "Glow of towns",
            Layer::ConstellationLines => "Constellation lines",
            Layer::ConstellationBoundaries => "Constellation boundaries",
            Layer::ConstellationNames => "Constellation names",
            Layer::StarNames => "Star names",
            Layer::PlanetNames => "Planet names",
            Layer::DeepSky => "Messier objects",
            Layer::MoonFeatures => "Places on the Moon",
            Layer::AzimuthalGrid => "Azimuthal grid",
            Layer::EquatorialGrid => "Equatorial grid of date",
            Layer::J2000Grid => "Equatorial grid J2000",
            Layer::EclipticGrid => "Ecliptic grid",
            Layer::GalacticGrid => "Galactic grid",
            Layer::Ecliptic => "Ecliptic",
            Layer::CelestialEquator => "Celestial equator",
            Layer::Meridian => "Meridian",
            Layer::Horizon => "Horizon",
            Layer::CardinalPoints => "Cardinal points",
            Layer::PlanetTrails => "Trails of planets",
        }
    }

    /// Its switch.
    pub fn switch(self, model: &mut Model) -> &mut bool {
        let Model { layers, overlays, .. } = model;
        match self {
            Layer::Atmosphere => &mut layers.skylight,
            Layer::Ground => &mut layers.ground,
            Layer::Stars => &mut layers.stars,
            Layer::Planets => &mut layers.planets,
            Layer::MilkyWay => &mut layers.milky_way,
            Layer::ZodiacalLight => &mut layers.zodiacal_light,
            Layer::Airglow => &mut layers.airglow,
            Layer::TownGlow => &mut layers.town_glow,
            Layer::ConstellationLines => &mut overlays.constellation_lines,
            Layer::ConstellationBoundaries => &mut overlays.constellation_boundaries,
            Layer::ConstellationNames => &mut overlays.constellation_names,
            Layer::StarNames => &mut overlays.star_names,
            Layer::PlanetNames => &mut overlays.planet_names,
            Layer::DeepSky => &mut overlays.deep_sky,
            Layer::MoonFeatures => &mut overlays.moon_features,
            Layer::AzimuthalGrid => &mut overlays.azimuthal_grid,
            Layer::EquatorialGrid => &mut overlays.equatorial_grid,
            Layer::J2000Grid => &mut overlays.j2000_grid,
            Layer::EclipticGrid => &mut overlays.ecliptic_grid,
            Layer::GalacticGrid => &mut overlays.galactic_grid,
            Layer::Ecliptic => &mut overlays.ecliptic,
            Layer::CelestialEquator => &mut overlays.celestial_equator,
            Layer::Meridian => &mut overlays.meridian,
            Layer::Horizon => &mut overlays.horizon,
            Layer::CardinalPoints => &mut overlays.cardinal_points,
            Layer::PlanetTrails => &mut overlays.planet_trails,
        }
    }
}

/// What is left to do outside the model.
#[derive(Debug, Clone, PartialEq)]
pub enum Errand {
    Jump(Jump, i32),
    Measure(Dir<Apparent>),
    ToggleFullScreen,
    Screenshot,
    Export(Export),
    CancelExport,
    CopyScene,
    Dismiss,
    Quit,
}

const PROJECTIONS: [Projection; 5] = [
    Projection::Stereographic,
    Projection::Perspective,
    Projection::Equidistant,
    Projection::EqualArea,
    Projection::Equirectangular,
];
/// Text may be so small and so large.
const TEXT_SCALES: std::ops::RangeInclusive<f32> = 0.6..=3.0;

impl Model {
    /// Does what only changes the model; gives back what is left to do.
    pub fn apply(&mut self, action: Action) -> Option<Errand> {
        let latitude = self.latitude();
        match action {
            Action::PlayOrPause => self.change_clock(|clock| clock.toggle()),
            Action::Faster => self.change_clock(|clock| clock.change_rate(1)),
            Action::Slower => self.change_clock(|clock| clock.change_rate(-1)),
            Action::RealTime => self.change_clock(|clock| clock.real_time()),
            Action::Now => self.change_clock(|clock| clock.to_now()),
            Action::Step(step, many) => self.change_clock(|clock| clock.step(step, many)),
            Action::SetInstant(instant) => self.change_clock(|clock| clock.set(instant)),
            Action::Jump(jump, direction) => return Some(Errand::Jump(jump, direction)),
            Action::GoTo(place) => self.go_to(place),
            Action::Look(dir) => self.view.look(dir, latitude),
            Action::Turn([right, up]) => {
                let field_deg = self.view.field_deg;
                self.view.turn(right * field_deg, up * field_deg);
            }
            Action::Zoom(powers) => self.view.push_zoom(powers),
            Action::SetField(field_deg) => self.view.set_field(field_deg),
            Action::SetProjection(projection) => self.view.set_projection(projection),
            Action::NextProjection => {
                let here = PROJECTIONS.iter().position(|p| *p == self.view.projection);
                let next = here.map_or(0, |here| (here + 1) % PROJECTIONS.len());
                self.view.set_projection(PROJECTIONS[next]);
            }
            Action::ToggleMount => {
                let other = match self.view.mount {
                    Mount::Altazimuth => Mount::Equatorial,
                    Mount::Equatorial => Mount::Altazimuth,
                };
                self.view.set_mount(other, latitude);
            }
            Action::Select(target) => self.selected = target,
            Action::Measure(dir) => return Some(Errand::Measure(dir)),
            Action::FollowSelected => {
                if self.selected.is_some() {
                    self.view.stop();
                    self.view.follow.clone_from(&self.selected);
                }
            }
            Action::StopFollowing => self.view.follow = None,
            Action::Toggle(layer) => {
                let switch = layer.switch(self);
                *switch = !*switch;
            }
            Action::TogglePanel(panel) => self.panels.toggle(panel),
            Action::ToggleCamera => self.uses_camera = !self.uses_camera,
            Action::ToggleRedMode => self.display.red = !self.display.red,
            Action::ScaleText(factor) => {
                let scale = self.zoom * factor;
                self.zoom = scale.clamp(*TEXT_SCALES.start(), *TEXT_SCALES.end());
            }
            Action::Escape => {
                if !self.panels.close_last() {
                    self.selected = None;
                }
            }
            Action::ToggleFullScreen => return Some(Errand::ToggleFullScreen),
            Action::Screenshot => return Some(Errand::Screenshot),
            Action::Export(export) => return Some(Errand::Export(export)),
            Action::CancelExport => return Some(Errand::CancelExport),
            Action::CopyScene => return Some(Errand::CopyScene),
            Action::Dismiss => return Some(Errand::Dismiss),
            Action::Quit => return Some(Errand::Quit),
        }
        None
    }
}

/// Directions that have a key.
pub fn cardinal(azimuth_deg: f64) -> Action {
    Action::Look(Dir::from_azimuth_altitude(Angle::from_deg(azimuth_deg), Angle::from_deg(20.0)))
}

pub fn zenith() -> Action {
    Action::Look(Dir::from_azimuth_altitude(Angle::from_deg(180.0), Angle::from_deg(89.9)))
}

//! What a frame shows, laid on the plane of the picture: plain data between light and GPU.
//!
//! The plan is made in f64 and holds only what the picture needs: a star that is out of view or
//! below the horizon is not in it, and a table whose source does not shine is empty.

pub mod body;
pub mod brightness;
pub mod classic;
pub mod corona;
pub mod dark_sky;
pub mod data;
pub mod disc;
pub mod globe;
mod kept_dark;
mod kept_source;
pub mod lay;
pub mod ledger;
pub mod milky_way;
pub mod near;
pub mod planet;
pub mod skylight;

use thiserror::Error;

use crate::air::classic::ClassicSkyError;
use crate::air::scattering::{ScatteringError, SkyShape, SkyView};
use crate::camera::Camera;
use crate::catalog::CatalogError;
use crate::frame::{Apparent, Dir};
use crate::units::{Angle, Xyzv};

use crate::place::gazetteer::GazetteerError;

use disc::Disc;
use milky_way::MilkyWayPlan;

/// Why there is no plan.
#[derive(Debug, Error)]
pub enum PlanError {
    #[error(transparent)]
    Air(#[from] ScatteringError),
    #[error(transparent)]
    Sky(#[from] ClassicSkyError),
    #[error(transparent)]
    Catalog(#[from] CatalogError),
    #[error(transparent)]
    Places(#[from] GazetteerError),
}

/// Everything that the GPU is asked to draw.
#[derive(Debug, Clone)]
pub struct FramePlan {
    pub camera: Camera,
    pub sky: SkyPlan,
    /// The light of stars that are not drawn one by one; none when it does not shine.
    pub milky_way: Option<MilkyWayPlan>,
    pub discs: Vec<Disc>,
    pub splats: Vec<Splat>,
}

/// A point of light on the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Splat {
    /// Where it falls, pixels from the top left.
    pub centre_px: [f64; 2],
    /// Illuminance at the ground, through the air, on a plane that faces it, lux.
    pub illuminance: Xyzv,
    /// Whether it is the Sun or the Moon, or a part of them, which are no stars to any eye.
    pub is_of_disc: bool,
}

impl Splat {
    /// A star, or what looks like one.
    pub fn star(centre_px: [f64; 2], illuminance: Xyzv) -> Splat {
        Splat { centre_px, illuminance, is_of_disc: false }
    }
}

/// The nodes of the tables of a [`SkyPlan`]: read with straight lines, see [`SkyView`].
pub const SKY_SHAPE: SkyShape = SkyShape { above: 121, below: 49, azimuths: 73 };

/// Azimuths of the table of the dark sky, from north through east, in equal steps.
pub const DARK_AZIMUTHS: usize = 180;

/// The light of the sky, and of the ground seen through the air before it, as tables.
#[derive(Debug, Clone)]
pub struct SkyPlan {
    /// Apparent elevation at which the ground begins.
    pub horizon: Angle,
    /// Sunlight scattered by the air and the ground; none when the Sun is too far below the horizon.
    pub sun: Option<SourceSky>,
    /// The same on the other side of the Sun, against the clock, where the shadow of the Moon makes the
    /// two sides differ; `sun` is then the side clockwise from it.
    pub sun_left: Option<SourceSky>,
    /// Moonlight scattered by the air and the ground; none when the Moon is down.
    pub moon: Option<SourceSky>,
    /// What there is without Sun and Moon, but for the Milky Way, by the rows of [`SKY_SHAPE`] and, in
    /// a row, by [`DARK_AZIMUTHS`], cd/m2.
    pub dark: Vec<Xyzv>,
}

/// The light of one source scattered by the air and the ground.
#[derive(Debug, Clone)]
pub struct SourceSky {
    pub azimuth: Angle,
    /// X, Y, Z and V, cd/m2, in [`SKY_SHAPE`].
    pub view: SkyView,
}

/// The part of the sky that a table of a source is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    Both,
    /// From the source clockwise, seen from above.
    Clockwise,
    Other,
}

impl Side {
    /// Whether an azimuth from the source, -180 to 180 degrees, is on this side.
    fn holds(self, from_source: Angle) -> bool {
        match self {
            Side::Both => true,
            Side::Clockwise => from_source >= Angle::ZERO,
            Side::Other => from_source < Angle::ZERO,
        }
    }
}

impl SourceSky {
    /// The light of all nodes, azimuths from the source innermost, rows as in [`SKY_SHAPE`], cd/m2.
    pub fn luminance(&self) -> Vec<Xyzv> {
        let shape = self.view.shape;
        let nodes = (0..shape.nodes()).map(|node| (node / shape.azimuths, node % shape.azimuths));
        nodes.map(|(row, column)| xyzv(&self.view.light(row, column))).collect()
    }
}

/// Four channels as one light; what is missing is black.
fn xyzv(channels: &[f64]) -> Xyzv {
    match *channels {
        [x, y, z, v] => Xyzv::new(x, y, z, v),
        _ => Xyzv::BLACK,
    }
}

impl SkyPlan {
    /// No light at all.
    pub fn black(horizon: Angle) -> SkyPlan {
        SkyPlan { horizon, sun: None, sun_left: None, moon: None, dark: dark_sky::no_light() }
    }

    /// The sources and the sides of them that they light. A Moon that shadows the air sends no light.
    pub fn sources(&self) -> [Option<(&SourceSky, Side)>; 2] {
        let [sun, left, moon] = [&self.sun, &self.sun_left, &self.moon].map(Option::as_ref);
        match left {
            Some(left) => [sun.map(|sun| (sun, Side::Clockwise)), Some((left, Side::Other))],
            None => [sun, moon].map(|source| source.map(|source| (source, Side::Both))),
        }
    }

    /// The light of the sky, or of the ground below the horizon, from an apparent direction, cd/m2:
    /// the twin of `skylight` in `shaders/skylight.wgsl`.
    pub fn luminance(&self, dir: Dir<Apparent>) -> Xyzv {
        let altitude = dir.altitude();
        let above = altitude >= self.horizon;
        let (row, up) = SKY_SHAPE.row_at(altitude, self.horizon, above);
        let azimuth = dir.azimuth();
        let mut light = self.dark_light(row, up, azimuth);
        for (source, side) in self.sources().into_iter().flatten() {
            let mut channels = [0.0; 4];
            let from_source = (azimuth - source.azimuth).signed();
            if !side.holds(from_source) {
                continue;
            }
            source.view.sample_side(altitude, from_source, above, &mut channels);
            light += xyzv(&channels);
        }
        light
    }

    /// The dark sky, a share of the way from a row to the next.
    fn dark_light(&self, row: usize, up: f64, azimuth: Angle) -> Xyzv {
        let place = azimuth.rad() / std::f64::consts::TAU * DARK_AZIMUTHS as f64;
        let column = (place as usize).min(DARK_AZIMUTHS - 1);
        let along = place - column as f64;
        let beside = (column + 1) % DARK_AZIMUTHS;
        let in_row = |row: usize| {
            let row = &self.dark[row * DARK_AZIMUTHS..][..DARK_AZIMUTHS];
            row[column] * (1.0 - along) + row[beside] * along
        };
        in_row(row) * (1.0 - up) + in_row(row + 1) * up
    }
}

//! What a frame shows, laid on the plane of the picture: plain data between light and GPU.
//!
//! The plan is made in f64 and holds only what the picture needs: a star that is out of view or
//! below the horizon is not in it, and a table whose source does not shine is empty.

pub mod body;
pub mod disc;
pub mod lay;
pub mod ledger;
pub mod skylight;

use thiserror::Error;

use crate::air::scattering::{ScatteringError, SkyView};
use crate::camera::Camera;
use crate::catalog::CatalogError;
use crate::frame::{Apparent, Dir};
use crate::units::{Angle, Xyzv};

use disc::Disc;

/// Why there is no plan.
#[derive(Debug, Error)]
pub enum PlanError {
    #[error(transparent)]
    Air(#[from] ScatteringError),
    #[error(transparent)]
    Catalog(#[from] CatalogError),
}

/// Everything that the GPU is asked to draw.
#[derive(Debug, Clone)]
pub struct FramePlan {
    pub camera: Camera,
    pub sky: SkyPlan,
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
}

/// Number of relative azimuths in a sky table, from the source (0) to opposite it (180 degrees).
pub const SKY_AZIMUTHS: usize = 49;
/// Number of apparent altitudes in a sky table: 90 degrees times t squared, t from 0 to 1.
pub const SKY_ALTITUDES: usize = 64;

/// The light of the sky as tables, and of the ground.
#[derive(Debug, Clone)]
pub struct SkyPlan {
    /// Sunlight scattered by the air; none when the Sun is too far below the horizon.
    pub sun: Option<SourceSky>,
    /// Moonlight scattered by the air; none when the Moon is down.
    pub moon: Option<SourceSky>,
    /// The sky without Sun and Moon, by apparent altitude, cd/m2.
    pub dark: Vec<Xyzv>,
    /// Luminance of the ground, cd/m2.
    pub ground: Xyzv,
}

/// The light of one source scattered by the air.
#[derive(Debug, Clone)]
pub struct SourceSky {
    pub azimuth: Angle,
    /// Azimuths from the source innermost, by apparent altitude, cd/m2.
    pub luminance: Vec<Xyzv>,
}

/// The altitude of row `row` of a sky table.
pub fn sky_table_altitude(row: usize) -> Angle {
    SkyView::elevation_of(row as f64 / (SKY_ALTITUDES - 1) as f64)
}

/// The azimuth from the source of column `column` of a sky table.
pub fn sky_table_azimuth(column: usize) -> Angle {
    Angle::from_deg(180.0 * column as f64 / (SKY_AZIMUTHS - 1) as f64)
}

impl SkyPlan {
    /// The light of the sky in an apparent direction at or above the horizon, cd/m2: the twin of
    /// `skylight` in `shaders/sky.wgsl`.
    pub fn luminance(&self, dir: Dir<Apparent>) -> Xyzv {
        let row = SkyView::row_of(dir.altitude()) * (SKY_ALTITUDES - 1) as f64;
        let r0 = (row as usize).min(SKY_ALTITUDES - 2);
        let up = row - r0 as f64;
        let mix = |a: Xyzv, b: Xyzv, t: f64| a * (1.0 - t) + b * t;
        let mut light = mix(self.dark[r0], self.dark[r0 + 1], up);
        for source in [&self.sun, &self.moon].into_iter().flatten() {
            let from_source = (dir.azimuth() - source.azimuth).signed().abs();
            let column = from_source.deg() / 180.0 * (SKY_AZIMUTHS - 1) as f64;
            let c0 = (column as usize).min(SKY_AZIMUTHS - 2);
            let along = column - c0 as f64;
            let texel = |row: usize, column: usize| source.luminance[row * SKY_AZIMUTHS + column];
            let lower = mix(texel(r0, c0), texel(r0, c0 + 1), along);
            let upper = mix(texel(r0 + 1, c0), texel(r0 + 1, c0 + 1), along);
            light += mix(lower, upper, up);
        }
        light
    }
}

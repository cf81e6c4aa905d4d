//! Jobs: a scene becomes files, for the command line and the window alike.
//!
//! A job takes its sky from [`skies::Skies`], says how far it is through [`steps::Steps`], through
//! which it is also stopped, and gives back what it has [`Written`]. Its files are opened before the
//! work begins and are each whole or not there at all. [`runner::Runner`] does a job beside a window.

pub mod outputs;
pub mod picture;
pub mod runner;
pub mod skies;
pub mod steps;
#[cfg(feature = "gpu")]
pub mod still;

use std::path::PathBuf;
use std::time::Duration;

use thiserror::Error;

use crate::catalog::CatalogError;
use crate::ephemeris::EphemerisError;
use crate::export::ExportError;
use crate::light::night::Night;
use crate::plan::PlanError;
use crate::scene::{Scene, SceneError, Setting};
use crate::studio::StudioError;

/// Why a job did not do what it was asked.
#[derive(Debug, Error)]
pub enum JobError {
    #[error("{path}: the name must end in .png or .exr")]
    Extension { path: String },
    #[error("{path} is given for two outputs; give each a file of its own")]
    Twice { path: String },
    #[error("nothing to write: name a file that ends in .png or .exr")]
    NoOutput,
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Ephemeris(#[from] EphemerisError),
    #[error(transparent)]
    Catalog(#[from] CatalogError),
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[cfg(feature = "gpu")]
    #[error(transparent)]
    Gpu(#[from] crate::render::gpu::GpuError),
    #[error(transparent)]
    Export(#[from] ExportError),
    /// Somebody asked for it.
    #[error("stopped before it was done; files that were begun are gone")]
    Interrupted,
    #[error("another job is under way; wait for it, or cancel it")]
    Busy,
    #[error("the system gave no thread for the work: {0}; close other programs and try again")]
    NoThread(std::io::Error),
    /// A panic.
    #[error("a fault of the program ended the work: {0}; please report it with the scene file")]
    Fault(String),
}

impl From<StudioError> for JobError {
    fn from(error: StudioError) -> JobError {
        match error {
            StudioError::Catalog(error) => JobError::Catalog(error),
            StudioError::Ephemeris(error) => JobError::Ephemeris(error),
            StudioError::Places(error) => JobError::Plan(error.into()),
            StudioError::Plan(error) => JobError::Plan(error),
        }
    }
}

/// How finely a PNG tells its colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Bits {
    #[default]
    Eight,
    Sixteen,
}

/// What a picture shows: a scene, what its values mean, and the sky that they lead to.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    pub scene: &'a Scene,
    pub setting: &'a Setting,
    pub night: &'a Night,
}

/// What a job has done.
#[derive(Debug, Default)]
pub struct Written {
    /// The files, in the order in which they were written, as they were named.
    pub paths: Vec<PathBuf>,
    /// What was drawn last; none where there was nothing to draw.
    pub drawn: Option<picture::Drawn>,
    /// The steps done, in order.
    pub times: Vec<(&'static str, Duration)>,
}

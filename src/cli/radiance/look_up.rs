//! Looks light up in the tables of pictures: with the shaders of pictures where there is an adapter,
//! with their twin on the processor where there is none.

use crate::cli::error::CliError;
use crate::frame::{Apparent, Dir};
use crate::plan::SkyPlan;
use crate::units::Xyzv;

/// What looks up; by default the processor.
#[derive(Default)]
pub struct LookUp {
    #[cfg(feature = "gpu")]
    renderer: Option<crate::render::Renderer>,
}

impl LookUp {
    /// With an adapter if there is one; else the second says why not.
    #[cfg(feature = "gpu")]
    pub fn new() -> (LookUp, Option<String>) {
        match crate::render::Renderer::new() {
            Ok(renderer) => (LookUp { renderer: Some(renderer) }, None),
            Err(error) => (LookUp { renderer: None }, Some(error.to_string())),
        }
    }

    #[cfg(not(feature = "gpu"))]
    pub fn new() -> (LookUp, Option<String>) {
        (LookUp {}, Some("this program was built without its renderer".to_owned()))
    }

    /// The light of the sky and the ground in apparent directions.
    pub fn sky(&self, plan: &SkyPlan, dirs: &[Dir<Apparent>]) -> Result<Vec<Xyzv>, CliError> {
        #[cfg(feature = "gpu")]
        if let Some(renderer) = &self.renderer {
            return Ok(renderer.sky_in(plan, dirs)?);
        }
        Ok(dirs.iter().map(|dir| plan.luminance(*dir)).collect())
    }
}

//! Draws a [`FramePlan`] into an [`HdrFrame`]: the passes in order, on one screen.
//!
//! The frame is linear, in cd/m2, 32 bits a channel, from the dark between the stars to the disc
//! of the Sun without a scale in between.

pub mod gpu;
pub mod picture;
pub mod shaders;
pub mod uniforms;

mod discs;
mod eye;
mod eye_tiles;
mod globe;
mod globe_maps;
mod milky_way;
mod pyramid;
mod sky;
pub mod sky_tiles;
mod splats;
mod target;

use std::sync::OnceLock;

use crate::display::Display;
use crate::eye::Eye;
use crate::eye::seeing::Seeing;
use crate::frame::{Apparent, Dir};
use crate::image::HdrFrame;
use crate::plan::{FramePlan, SkyPlan};
use crate::units::Xyzv;

use gpu::{Gpu, GpuError, PassTime};
use picture::{Depth, Picture, PictureTarget};
use sky_tiles::SkyDetail;

/// The pipelines, made once; what a frame needs is made with the frame.
pub struct Renderer {
    gpu: Gpu,
    sky: sky::SkyPass,
    /// Made when it first shines.
    milky_way: OnceLock<milky_way::MilkyWayPass>,
    discs: discs::DiscPass,
    splats: splats::SplatPass,
    /// Made when somebody first looks.
    eye: OnceLock<eye::EyePass>,
}

/// A drawn frame and what it cost.
pub struct Rendered {
    pub frame: HdrFrame,
    /// By pass; empty when the adapter keeps no time.
    pub times: Vec<PassTime>,
}

/// A picture, what the eye made of the frame, and what it cost.
pub struct Looked {
    pub picture: Picture,
    pub seeing: Seeing,
    /// By pass; empty when the adapter keeps no time.
    pub times: Vec<PassTime>,
}

impl Renderer {
    /// Finds an adapter and makes the pipelines.
    pub fn new() -> Result<Renderer, GpuError> {
        let gpu = Gpu::new()?;
        let sky = sky::SkyPass::new(&gpu);
        let discs = discs::DiscPass::new(&gpu);
        let splats = splats::SplatPass::new(&gpu);
        Ok(Renderer { gpu, sky, milky_way: OnceLock::new(), discs, splats, eye: OnceLock::new() })
    }

    /// What draws: the adapter's name and driver.
    pub fn adapter(&self) -> String {
        self.gpu.describe()
    }

    /// Draws the frame and brings it back.
    pub fn frame(&self, plan: &FramePlan) -> Result<Rendered, GpuError> {
        self.frame_with(plan, SkyDetail::Tiles)
    }

    /// The same, the sky drawn in a way that is given.
    pub fn frame_with(&self, plan: &FramePlan, detail: SkyDetail) -> Result<Rendered, GpuError> {
        let mut frame = target::Target::new(&self.gpu, &plan.camera)?;
        self.extended(&mut frame, plan, detail);
        self.splats.draw(&mut frame, &plan.splats, &plan.camera);
        let finished = frame.finish()?;
        let frame = target::read_back(&self.gpu, &finished.frame)?;
        Ok(Rendered { frame, times: finished.times })
    }

    /// Draws the frame and the picture of it that an eye sees.
    pub fn seen(
        &self,
        plan: &FramePlan,
        eye: &Eye,
        display: &Display,
        depth: Depth,
    ) -> Result<Looked, GpuError> {
        let camera = &plan.camera;
        let mut frame = target::Target::new(&self.gpu, camera)?;
        self.extended(&mut frame, plan, SkyDetail::Tiles);
        let size_px = [camera.width_px, camera.height_px];
        let picture = PictureTarget::new(&self.gpu, size_px, depth, display.space);
        let pass = self.eye.get_or_init(|| eye::EyePass::new(&self.gpu));
        let scene = eye::Scene { eye, display, camera, points: &plan.splats };
        let seeing = pass.picture(&mut frame, &scene, &picture)?;
        let finished = frame.finish()?;
        Ok(Looked { picture: picture.read(&self.gpu)?, seeing, times: finished.times })
    }

    /// The light of all that is no point.
    fn extended(&self, frame: &mut target::Target, plan: &FramePlan, detail: SkyDetail) {
        let camera = &plan.camera;
        self.sky.draw(frame, &plan.sky, camera, detail);
        if let Some(milky_way) = &plan.milky_way {
            let pass = self.milky_way.get_or_init(|| milky_way::MilkyWayPass::new(&self.gpu));
            pass.draw(frame, milky_way, camera);
        }
        for disc in &plan.discs {
            self.discs.draw(frame, disc);
        }
    }

    /// The light of the sky and the ground in apparent directions, cd/m2, looked up as pictures do.
    pub fn sky_in(&self, sky: &SkyPlan, dirs: &[Dir<Apparent>]) -> Result<Vec<Xyzv>, GpuError> {
        self.sky.look_up(&self.gpu, sky, dirs)
    }
}

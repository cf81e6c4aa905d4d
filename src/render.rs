//! Draws a [`FramePlan`] into an [`HdrFrame`]: the passes in order, on one screen.
//!
//! The frame is linear, in cd/m2, 32 bits a channel, from the dark between the stars to the disc
//! of the Sun without a scale in between.

pub mod gpu;
pub mod shaders;
pub mod uniforms;

mod discs;
mod globe;
mod globe_maps;
mod milky_way;
pub mod photo;
mod sky;
pub mod sky_tiles;
mod spikes;
mod splats;
mod target;

use std::sync::OnceLock;

use crate::frame::{Apparent, Dir};
use crate::image::HdrFrame;
use crate::photo::lens::Spike;
use crate::plan::{FramePlan, SkyPlan};
use crate::units::Xyzv;

use gpu::{Gpu, GpuError, PassTime};
use sky_tiles::SkyDetail;

/// The pipelines, made once; what a frame needs is made with the frame.
pub struct Renderer {
    gpu: Gpu,
    sky: sky::SkyPass,
    /// Made when it first shines.
    milky_way: OnceLock<milky_way::MilkyWayPass>,
    discs: discs::DiscPass,
    splats: splats::SplatPass,
    /// Made when a lens first has them.
    spikes: OnceLock<spikes::SpikePass>,
}

/// A drawn frame and what it cost.
pub struct Rendered {
    pub frame: HdrFrame,
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
        let (milky_way, spikes) = (OnceLock::new(), OnceLock::new());
        Ok(Renderer { gpu, sky, milky_way, discs, splats, spikes })
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
        self.draw(plan, detail, &[])
    }

    /// The frame as it lies on the sensor of a camera, with the spikes of its aperture.
    pub fn frame_with_spikes(
        &self,
        plan: &FramePlan,
        spikes: &[Spike],
    ) -> Result<Rendered, GpuError> {
        self.draw(plan, SkyDetail::Tiles, spikes)
    }

    /// The device that draws.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    fn draw(
        &self,
        plan: &FramePlan,
        detail: SkyDetail,
        spikes: &[Spike],
    ) -> Result<Rendered, GpuError> {
        let camera = &plan.camera;
        let mut frame = target::Target::new(&self.gpu, camera)?;

        self.sky.draw(&mut frame, &plan.sky, camera, detail);
        if let Some(milky_way) = &plan.milky_way {
            let pass = self.milky_way.get_or_init(|| milky_way::MilkyWayPass::new(&self.gpu));
            pass.draw(&mut frame, milky_way, camera);
        }
        for disc in &plan.discs {
            self.discs.draw(&mut frame, disc);
        }
        self.splats.draw(&mut frame, &plan.splats, camera);
        if !spikes.is_empty() {
            let pass = self.spikes.get_or_init(|| spikes::SpikePass::new(&self.gpu));
            pass.draw(&mut frame, spikes);
        }
        frame.finish()
    }

    /// The light of the sky and the ground in apparent directions, cd/m2, looked up as pictures do.
    pub fn sky_in(&self, sky: &SkyPlan, dirs: &[Dir<Apparent>]) -> Result<Vec<Xyzv>, GpuError> {
        self.sky.look_up(&self.gpu, sky, dirs)
    }
}

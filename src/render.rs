//! Draws a [`FramePlan`] into an [`HdrFrame`], the passes in order, on one screen; and makes the picture of
//! it that an eye sees or a camera records.
//!
//! The frame is linear, in cd/m2, 32 bits a channel, from the dark between the stars to the disc
//! of the Sun without a scale in between.

pub mod gpu;
pub mod picture;
pub mod shaders;
pub mod uniforms;
pub mod window;

mod discs;
mod eye;
mod eye_tiles;
mod globe;
mod globe_maps;
mod milky_way;
mod photo;
mod pyramid;
mod sky;
pub mod sky_tiles;
mod spikes;
mod splats;
mod target;

use std::sync::{Mutex, OnceLock, PoisonError};

use crate::camera::Camera;
use crate::display::Display;
use crate::eye::Eye;
use crate::eye::seeing::Seeing;
use crate::frame::{Apparent, Dir};
use crate::image::HdrFrame;
use crate::photo::Photo;
use crate::photo::exposure::Exposure;
use crate::photo::lens::Spike;
use crate::plan::{FramePlan, SkyPlan, Splat};
use crate::units::Xyzv;

use gpu::{Gpu, GpuError, PassTime};
use picture::{Depth, Picture, PictureTarget};
use sky_tiles::SkyDetail;
use target::Target;

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
    photo: OnceLock<photo::PhotoPass>,
    /// The texture of the last frame of a window.
    frame: Mutex<Option<wgpu::Texture>>,
}

/// A drawn frame and what it cost.
pub struct Rendered {
    pub frame: HdrFrame,
    /// By pass; empty when the adapter keeps no time.
    pub times: Vec<PassTime>,
}

/// Who makes a picture of the frame.
#[derive(Debug, Clone, Copy)]
pub enum Viewer<'a> {
    Eye(&'a Eye),
    /// A camera that meters for itself.
    Photo(&'a Photo),
    /// A camera as it is set, without spikes.
    Exposure(&'a Exposure),
}

/// How a picture is made of the frame.
#[derive(Debug, Clone, Copy)]
pub struct Look<'a> {
    pub viewer: Viewer<'a>,
    pub display: &'a Display,
    pub depth: Depth,
}

/// What the viewer made of the frame.
#[derive(Debug, Clone)]
pub enum Made {
    Seen(Box<Seeing>),
    Exposed(Box<Exposure>),
}

/// A picture, how it was made, and what it cost.
pub struct Looked {
    pub picture: Picture,
    pub made: Made,
    /// The frame, if it was asked for.
    pub frame: Option<HdrFrame>,
    /// By pass, those of the frame first; empty when the adapter keeps no time.
    pub times: Vec<PassTime>,
}

/// A picture that stays on the device, for a window.
pub struct OnDevice {
    /// Codes of red, green and blue for the display of the look, 8 bits each.
    pub codes: wgpu::TextureView,
    pub made: Made,
    /// By pass, those of the frame first; empty when the adapter keeps no time.
    pub times: Vec<PassTime>,
}

impl Renderer {
    /// Finds an adapter and makes the pipelines.
    pub fn new() -> Result<Renderer, GpuError> {
        let gpu = Gpu::new()?;
        let sky = sky::SkyPass::new(&gpu);
        let discs = discs::DiscPass::new(&gpu);
        let splats = splats::SplatPass::new(&gpu);
        Ok(Renderer {
            gpu,
            sky,
            milky_way: OnceLock::new(),
            discs,
            splats,
            eye: OnceLock::new(),
            photo: OnceLock::new(),
            frame: Mutex::new(None),
        })
    }

    /// The device that it draws on, for a window that shares it.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
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
        self.rendered(plan, detail, &[])
    }

    /// The frame as it lies on the sensor of a camera, with spikes of its aperture.
    pub fn frame_with_spikes(
        &self,
        plan: &FramePlan,
        spikes: &[Spike],
    ) -> Result<Rendered, GpuError> {
        self.rendered(plan, SkyDetail::Tiles, spikes)
    }

    fn rendered(
        &self,
        plan: &FramePlan,
        detail: SkyDetail,
        spikes: &[Spike],
    ) -> Result<Rendered, GpuError> {
        let mut frame = Target::new(&self.gpu, &plan.camera)?;
        self.extended(&mut frame, plan, detail);
        self.splats.draw(&mut frame, &plan.splats, &plan.camera);
        if !spikes.is_empty() {
            self.photo_pass().spikes(&mut frame, spikes);
        }
        let finished = frame.finish()?;
        let frame = target::read_back(&self.gpu, &finished.frame)?;
        Ok(Rendered { frame, times: finished.times })
    }

    /// Draws the frame and makes a picture of it; brings the frame back too if that is wanted.
    pub fn look(
        &self,
        plan: &FramePlan,
        look: &Look,
        wants_frame: bool,
    ) -> Result<Looked, GpuError> {
        let mut frame = Target::new(&self.gpu, &plan.camera)?;
        self.extended(&mut frame, plan, SkyDetail::Tiles);
        self.developed(frame, &plan.camera, &plan.splats, look, wants_frame)
    }

    /// Draws the frame and makes a picture of it in codes, which stays on the device.
    pub fn show(&self, plan: &FramePlan, look: &Look) -> Result<OnDevice, GpuError> {
        // A poisoned lock holds a whole texture or none.
        let mut kept = self.frame.lock().unwrap_or_else(PoisonError::into_inner);
        let mut frame = Target::on(&self.gpu, &plan.camera, kept.take())?;
        self.extended(&mut frame, plan, SkyDetail::Tiles);
        let look = Look { depth: Depth::Codes, ..*look };
        let (made, _, picture) = self.made(&mut frame, &plan.camera, &plan.splats, &look, false)?;
        let finished = frame.finish()?;
        *kept = Some(finished.frame);
        Ok(OnDevice { codes: picture.into_codes(), made, times: finished.times })
    }

    /// Makes a picture of a frame without points of light, and of points of light.
    pub fn look_at(
        &self,
        frame: &HdrFrame,
        camera: &Camera,
        points: &[Splat],
        look: &Look,
    ) -> Result<Looked, GpuError> {
        let frame = Target::of_frame(&self.gpu, camera, frame)?;
        self.developed(frame, camera, points, look, false)
    }

    /// The light of a frame without points of light as it falls on the retina of an eye, cd/m2: for
    /// measurements of its glare, which pictures leave out where nobody would see it.
    pub fn retina(
        &self,
        frame: &HdrFrame,
        camera: &Camera,
        eye: &Eye,
    ) -> Result<HdrFrame, GpuError> {
        let mut target = Target::of_frame(&self.gpu, camera, frame)?;
        self.eye_pass().retina(&mut target, eye, camera)
    }

    fn eye_pass(&self) -> &eye::EyePass {
        self.eye.get_or_init(|| eye::EyePass::new(&self.gpu))
    }

    fn photo_pass(&self) -> &photo::PhotoPass {
        self.photo.get_or_init(|| photo::PhotoPass::new(&self.gpu))
    }

    fn developed(
        &self,
        mut frame: Target,
        camera: &Camera,
        points: &[Splat],
        look: &Look,
        wants_frame: bool,
    ) -> Result<Looked, GpuError> {
        let (made, mut absolute, picture) =
            self.made(&mut frame, camera, points, look, wants_frame)?;
        let finished = frame.finish()?;
        if wants_frame && absolute.is_none() {
            absolute = Some(target::read_back(&self.gpu, &finished.frame)?);
        }
        let picture = picture.read(&self.gpu)?;
        Ok(Looked { picture, made, frame: absolute, times: finished.times })
    }

    /// Makes the picture on the device; the frame comes back where the viewer adds to it.
    fn made(
        &self,
        frame: &mut Target,
        camera: &Camera,
        points: &[Splat],
        look: &Look,
        wants_frame: bool,
    ) -> Result<(Made, Option<HdrFrame>, PictureTarget), GpuError> {
        let size_px = [camera.width_px, camera.height_px];
        let picture = PictureTarget::new(&self.gpu, size_px, look.depth, look.display.space);
        let splats = |frame: &mut Target| self.splats.draw(frame, points, camera);
        let mut absolute = None;
        let made = match look.viewer {
            Viewer::Eye(eye) => {
                let (in_frame, apart): (Vec<Splat>, Vec<Splat>) =
                    points.iter().partition(|point| point.is_of_disc || eye.sees_stars_in_frame());
                self.splats.draw(frame, &in_frame, camera);
                let scene = eye::Scene { eye, display: look.display, camera, points: &apart };
                let seeing = self.eye_pass().picture(frame, &scene, &picture)?;
                if wants_frame {
                    self.splats.draw(frame, &apart, camera);
                }
                Made::Seen(Box::new(seeing))
            }
            Viewer::Photo(photo) => {
                let pass = self.photo_pass();
                splats(frame);
                if wants_frame {
                    // What the lens adds is no light of the sky.
                    absolute = Some(frame.read()?);
                }
                let exposure = pass.expose(frame, photo, camera)?;
                let spikes = photo::spikes(photo, &exposure, camera, points);
                if !spikes.lines.is_empty() {
                    self.splats.draw(frame, &spikes.taken, camera);
                    pass.spikes(frame, &spikes.lines);
                }
                pass.picture(frame, &exposure, look.display, &picture);
                Made::Exposed(Box::new(exposure))
            }
            Viewer::Exposure(exposure) => {
                let pass = self.photo_pass();
                splats(frame);
                pass.picture(frame, exposure, look.display, &picture);
                Made::Exposed(Box::new(*exposure))
            }
        };
        Ok((made, absolute, picture))
    }

    /// The light of all that is no point.
    fn extended(&self, frame: &mut Target, plan: &FramePlan, detail: SkyDetail) {
        let camera = &plan.camera;
        self.sky.draw(frame, &plan.sky, camera, detail);
        if let Some(milky_way) = &plan.milky_way {
            let pass = self.milky_way.get_or_init(|| milky_way::MilkyWayPass::new(&self.gpu));
            pass.draw(frame, milky_way, camera);
        }
        for disc in &plan.discs {
            self.discs.draw(frame, disc, camera);
        }
    }

    /// The light of the sky and the ground in apparent directions, cd/m2, looked up as pictures do.
    pub fn sky_in(&self, sky: &SkyPlan, dirs: &[Dir<Apparent>]) -> Result<Vec<Xyzv>, GpuError> {
        self.sky.look_up(&self.gpu, sky, dirs)
    }
}

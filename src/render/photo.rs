//! The picture of a camera: one pass over the finished frame, after the meter has looked at it.

use std::sync::{Mutex, OnceLock, PoisonError};

use crate::camera::Camera;
use crate::display::Display;
use crate::photo::exposure::{Exposure, metered};
use crate::photo::lens::Spike;
use crate::photo::{Curve, Photo};
use crate::plan::Splat;
use crate::units::Xyzv;

use super::gpu::{FRAME_FORMAT, Gpu, GpuError, Stage};
use super::picture::{Depth, PictureTarget};
use super::pyramid::fill;
use super::shaders;
use super::spikes::SpikePass;
use super::target::{Target, read_back};
use super::uniforms::{PhotoUniform, picture_constants};

/// The meter looks at one pixel of so many along each axis; `shaders/meter.wgsl` knows it too.
const METERED_PX: u32 = 16;
/// Spikes end where they change the picture by less than this share of white.
const FAINTEST: f64 = 0.5 / 255.0;

/// What a pipeline is made for; another needs another one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Kind {
    depth: Depth,
    constants: [(&'static str, f64); 5],
}

impl Kind {
    fn of(depth: Depth, exposure: &Exposure, display: &Display) -> Kind {
        let is = |truth: bool| f64::from(u8::from(truth));
        let [encoded, steps] = picture_constants(display, depth);
        let noisy = ("IS_NOISY", is(exposure.noise));
        let film = ("IS_FILM", is(exposure.curve == Curve::Film));
        let red = ("IS_RED", is(display.red));
        Kind { depth, constants: [encoded, steps, noisy, film, red] }
    }
}

/// The pipelines.
pub struct PhotoPass {
    meter: wgpu::RenderPipeline,
    nearest: wgpu::Sampler,
    /// Made when first asked for.
    pipelines: Mutex<Vec<(Kind, wgpu::RenderPipeline)>>,
    spikes: OnceLock<SpikePass>,
}

/// The spikes of points, and what they take from them.
pub struct PointSpikes {
    pub lines: Vec<Spike>,
    /// The same light, negative.
    pub taken: Vec<Splat>,
}

/// The spikes that can be seen around points.
pub fn spikes(
    photo: &Photo,
    exposure: &Exposure,
    camera: &Camera,
    points: &[Splat],
) -> PointSpikes {
    let mut spikes = PointSpikes { lines: Vec::new(), taken: Vec::new() };
    let Some(of_lens) = photo.lens.spikes(&photo.body.sensor(), camera.width_px) else {
        return spikes;
    };
    let white = Xyzv::new(0.95, 1.0, 1.09, 0.0);
    let share_per_cd_m2 = (exposure.raw_from_xyz * glam::DVec3::new(white.x, white.y, white.z)).y;
    let longest_px = f64::from(camera.width_px.max(camera.height_px));
    for point in points {
        let faintest_lx = FAINTEST / share_per_cd_m2 * camera.pixel_solid_angle_sr(point.centre_px);
        let (left, lines) =
            of_lens.of(point.centre_px, point.illuminance, 0.0, faintest_lx, longest_px);
        if !lines.is_empty() {
            spikes.lines.extend(lines);
            let illuminance = left + point.illuminance * -1.0;
            spikes.taken.push(Splat { illuminance, ..*point });
        }
    }
    spikes
}

impl PhotoPass {
    pub fn new(gpu: &Gpu) -> PhotoPass {
        PhotoPass {
            meter: gpu.chain_pipeline(&Stage {
                label: "meter",
                source: shaders::assembled("meter"),
                entries: ["vertex", "fragment"],
                constants: &[],
                targets: &[FRAME_FORMAT],
                buffers: &[],
                adds: false,
            }),
            nearest: gpu.nearest_sampler(),
            pipelines: Mutex::default(),
            spikes: OnceLock::new(),
        }
    }

    /// What the settings come to for a frame.
    pub fn expose(
        &self,
        frame: &mut Target,
        photo: &Photo,
        camera: &Camera,
    ) -> Result<Exposure, GpuError> {
        let gpu = frame.gpu;
        let [width, height] =
            [camera.width_px, camera.height_px].map(|edge| edge.div_ceil(METERED_PX));
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let samples = gpu.texture("meter", size, FRAME_FORMAT, usage);
        let view = samples.create_view(&Default::default());
        let light = frame.view();
        let group = gpu.bind_mixed(
            &self.meter.get_bind_group_layout(0),
            &[(0, wgpu::BindingResource::TextureView(&light))],
        );
        frame.picture_pass("meter", &[&view], |pass| fill(pass, &self.meter, &group));
        frame.submit();
        let samples = read_back(gpu, &samples)?;
        let xyzv = |&[x, y, z, v]: &[f32; 4]| Xyzv::new(x.into(), y.into(), z.into(), v.into());
        let samples: Vec<Xyzv> = samples.pixels().iter().map(xyzv).collect();
        Ok(photo.exposed(&metered(&samples), camera))
    }

    /// Adds spikes to the frame.
    pub fn spikes(&self, frame: &mut Target, spikes: &[Spike]) {
        self.spikes.get_or_init(|| SpikePass::new(frame.gpu)).draw(frame, spikes);
    }

    /// The picture of a frame.
    pub fn picture(
        &self,
        frame: &mut Target,
        exposure: &Exposure,
        display: &Display,
        picture: &PictureTarget,
    ) {
        let gpu = frame.gpu;
        let pipeline = self.pipeline(gpu, Kind::of(picture.depth(), exposure, display));
        let uniform = PhotoUniform::of(exposure, display);
        let setting =
            gpu.buffer("photo", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let light = frame.view();
        let group = gpu.bind_mixed(
            &pipeline.get_bind_group_layout(0),
            &[
                (0, setting.as_entire_binding()),
                (1, wgpu::BindingResource::TextureView(&light)),
                (2, wgpu::BindingResource::Sampler(&self.nearest)),
            ],
        );
        frame.picture_pass("photo", &[picture.codes()], |pass| fill(pass, &pipeline, &group));
    }

    fn pipeline(&self, gpu: &Gpu, kind: Kind) -> wgpu::RenderPipeline {
        // A poisoned lock holds whole pipelines or none.
        let mut made = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, pipeline)) = made.iter().find(|(known, _)| *known == kind) {
            return pipeline.clone();
        }
        let pipeline = gpu.chain_pipeline(&Stage {
            label: "photo",
            source: shaders::assembled("photo"),
            entries: ["vertex", "fragment"],
            constants: &kind.constants,
            targets: &[kind.depth.codes_format()],
            buffers: &[],
            adds: false,
        });
        made.push((kind, pipeline.clone()));
        pipeline
    }
}

//! The frame at half its resolution, and half of that: what the eye adapts to, what it scatters, and
//! what it does not resolve.
//!
//! The steps down and up keep the sum of the light whatever the size of the picture, and keep an even
//! picture even: `shaders/pyramid.wgsl`. Their twin on the CPU is `eye::glare`.

use crate::image::HdrFrame;

use super::gpu::{FRAME_FORMAT, Gpu, GpuError, Stage};
use super::shaders;
use super::target::{self, Target};
use super::uniforms::PyramidStepUniform;

/// Pixels of the longer edge of the coarsest level, at most.
const COARSEST_PX: u32 = 3;

/// The pipelines of the steps.
pub struct PyramidPass {
    first: wgpu::RenderPipeline,
    halved: wgpu::RenderPipeline,
    spread: wgpu::RenderPipeline,
    spread_and_blurred: wgpu::RenderPipeline,
    pub between: wgpu::Sampler,
}

/// A level of the pyramid.
struct Level {
    texture: wgpu::Texture,
    /// The light of the frame.
    light: wgpu::TextureView,
    /// What this level and the coarser ones spread; none on the coarsest.
    spread: Option<wgpu::TextureView>,
    /// The light as fine as the eye resolves it; none on the coarsest.
    blurred: Option<wgpu::TextureView>,
}

/// A pyramid over a frame of a size; level 1 is half as fine as the frame.
pub struct Pyramid {
    size_px: [u32; 2],
    levels: Vec<Level>,
}

/// The upper half of the way: what the final pass reads, at half the resolution of the frame.
pub struct Retina<'a> {
    pub spread: &'a wgpu::TextureView,
    /// What it is counted as.
    pub spread_share: f64,
    /// None when all that the frame holds is resolved.
    pub blurred: Option<&'a wgpu::TextureView>,
}

impl Pyramid {
    /// Textures for frames of a size.
    pub fn new(gpu: &Gpu, size_px: [u32; 2]) -> Pyramid {
        let mut sizes = Vec::new();
        let mut size = size_px;
        while sizes.is_empty() || size[0].max(size[1]) > COARSEST_PX {
            size = size.map(|edge| edge.div_ceil(2));
            sizes.push(size);
        }
        let last = sizes.len() - 1;
        let level = |(number, [width, height]): (usize, [u32; 2])| {
            let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC;
            let made = |label| gpu.texture(label, size, FRAME_FORMAT, usage);
            let on_the_way_up = |label| (number < last).then(|| view(&made(label)));
            let texture = made("light");
            Level {
                light: view(&texture),
                texture,
                spread: on_the_way_up("spread"),
                blurred: on_the_way_up("blurred"),
            }
        };
        Pyramid { size_px, levels: sizes.into_iter().enumerate().map(level).collect() }
    }

    /// The size of the frames that it is for.
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// How many levels there are.
    pub fn len(&self) -> usize {
        self.levels.len()
    }

    /// The light of a level, 1 to [`Pyramid::len`].
    pub fn light(&self, level: usize) -> &wgpu::TextureView {
        &self.levels[level - 1].light
    }

    /// Size of a level, texels.
    pub fn level_px(&self, level: usize) -> [u32; 2] {
        let texture = &self.levels[level - 1].texture;
        [texture.width(), texture.height()]
    }

    /// Has the passes recorded so far done, and brings the light of a level back.
    pub fn read(&self, frame: &mut Target, level: usize) -> Result<HdrFrame, GpuError> {
        frame.submit();
        target::read_back(frame.gpu, &self.levels[level - 1].texture)
    }
}

fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&Default::default())
}

impl PyramidPass {
    pub fn new(gpu: &Gpu) -> PyramidPass {
        let pipeline = |fragment, targets| {
            gpu.chain_pipeline(&Stage {
                label: "pyramid",
                source: shaders::assembled("pyramid"),
                entries: ["vertex", fragment],
                constants: &[],
                targets,
                buffers: &[],
            })
        };
        PyramidPass {
            first: pipeline("first", &[FRAME_FORMAT]),
            halved: pipeline("halved", &[FRAME_FORMAT]),
            spread: pipeline("spread", &[FRAME_FORMAT]),
            spread_and_blurred: pipeline("spread_and_blurred", &[FRAME_FORMAT; 2]),
            between: gpu.linear_sampler(wgpu::AddressMode::ClampToEdge),
        }
    }

    /// Makes all levels of the frame.
    pub fn down(&self, frame: &mut Target, pyramid: &Pyramid) {
        let mut finer = frame.view();
        for (number, level) in pyramid.levels.iter().enumerate() {
            let (label, pipeline) = match number {
                0 => ("half", &self.first),
                _ => ("coarser", &self.halved),
            };
            let group = frame.gpu.bind_mixed(
                &pipeline.get_bind_group_layout(0),
                &[(0, self.sampler()), (1, wgpu::BindingResource::TextureView(&finer))],
            );
            frame.picture_pass(label, &[&level.light], |pass| fill(pass, pipeline, &group));
            finer = level.light.clone();
        }
    }

    /// Spreads the shares of each level, finest first, over the picture, and blurs it to what
    /// `levels_resolved` says, if given.
    pub fn up<'p>(
        &self,
        frame: &mut Target,
        pyramid: &'p Pyramid,
        shares: &[f64],
        levels_resolved: Option<&wgpu::TextureView>,
    ) -> Retina<'p> {
        let share = |level: usize| shares.get(level - 1).copied().unwrap_or(0.0);
        let coarsest = &pyramid.levels[pyramid.levels.len() - 1];
        let (mut spread, mut blurred) = (&coarsest.light, &coarsest.light);
        // The coarsest spreads its light itself.
        let mut coarser = share(pyramid.len());
        for number in (1..pyramid.levels.len()).rev() {
            let level = &pyramid.levels[number - 1];
            let (Some(own_spread), Some(own_blurred)) = (&level.spread, &level.blurred) else {
                continue;
            };
            let step = PyramidStepUniform {
                share: share(number) as f32,
                coarser: coarser as f32,
                level: number as f32,
                pad: 0.0,
            };
            let step =
                frame.gpu.buffer("step", bytemuck::bytes_of(&step), wgpu::BufferUsages::UNIFORM);
            let mut bound = vec![
                (0, self.sampler()),
                (1, wgpu::BindingResource::TextureView(&level.light)),
                (2, wgpu::BindingResource::TextureView(spread)),
                (3, step.as_entire_binding()),
            ];
            let label = if number == 1 { "retina" } else { "glare" };
            match levels_resolved {
                None => {
                    let pipeline = &self.spread;
                    let group = frame.gpu.bind_mixed(&pipeline.get_bind_group_layout(0), &bound);
                    frame.picture_pass(label, &[own_spread], |pass| fill(pass, pipeline, &group));
                }
                Some(resolved) => {
                    let pipeline = &self.spread_and_blurred;
                    bound.push((4, wgpu::BindingResource::TextureView(blurred)));
                    bound.push((5, wgpu::BindingResource::TextureView(resolved)));
                    let group = frame.gpu.bind_mixed(&pipeline.get_bind_group_layout(0), &bound);
                    let pictures = [own_spread, own_blurred];
                    frame.picture_pass(label, &pictures, |pass| fill(pass, pipeline, &group));
                }
            }
            (spread, blurred, coarser) = (own_spread, own_blurred, 1.0);
        }
        Retina { spread, spread_share: coarser, blurred: levels_resolved.map(|_| blurred) }
    }

    fn sampler(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Sampler(&self.between)
    }
}

/// Draws over all of a picture.
pub fn fill(pass: &mut wgpu::RenderPass, pipeline: &wgpu::RenderPipeline, group: &wgpu::BindGroup) {
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    pass.draw(0..3, 0..1);
}

//! The frame at half its resolution, and half of that: what the eye adapts to, what it scatters, and
//! what it does not resolve.
//!
//! The steps down and up keep the sum of the light whatever the size of the picture, and keep an even
//! picture even. Their twin on the CPU is [`scattered_by`](crate::eye::glare::scattered_by).

use crate::eye::glare::pyramid::{level_count, places_within};
use crate::image::HdrFrame;

use super::eye_tiles::{FINISHED_LEVELS, Tile};
use super::gpu::{FRAME_FORMAT, Gpu, GpuError, Stage};
use super::shaders;
use super::target::{self, Target};
use super::uniforms::PyramidStepUniform;

/// The pipelines of the steps.
pub struct PyramidPass {
    first: wgpu::RenderPipeline,
    halved: wgpu::RenderPipeline,
    spread: wgpu::RenderPipeline,
    spread_and_blurred: wgpu::RenderPipeline,
    /// For screens of all colours and of red alone, each of a picture that is not blurred and of one that is.
    seen: [[wgpu::RenderPipeline; 2]; 2],
    retina: wgpu::RenderPipeline,
    pub between: wgpu::Sampler,
    pub nearest: wgpu::Sampler,
}

/// A level of the pyramid.
struct Level {
    texture: wgpu::Texture,
    /// The light of the frame, as much of it as there is in the place of a texel.
    light: wgpu::TextureView,
    /// What this level and the coarser ones spread, cd/m2.
    spread: wgpu::TextureView,
    /// The light as fine as the eye resolves it, cd/m2.
    blurred: wgpu::TextureView,
    /// What is shown where no more is resolved; of the finest levels alone.
    seen: Option<wgpu::TextureView>,
    /// How much of the last three texels of each axis lies in the picture.
    within: [[f32; 4]; 2],
}

/// A pyramid over a frame of a size; level 1 is half as fine as the frame.
pub struct Pyramid {
    size_px: [u32; 2],
    levels: Vec<Level>,
}

/// How the light of a pyramid goes up again.
pub struct Up<'a> {
    /// Of the light that each level spreads, finest first.
    pub shares: &'a [f64],
    /// What the eye resolves, over the columns of light.
    pub levels_resolved: &'a wgpu::TextureView,
    /// Whether that matters.
    pub blurs: bool,
}

/// What the light is shown on.
pub struct Screen {
    /// What cones and rods give.
    pub shown: wgpu::TextureView,
    /// The rows of its matrix.
    pub display: wgpu::Buffer,
    pub is_red: bool,
}

/// Tiles as instances.
pub fn tile_layout() -> wgpu::VertexBufferLayout<'static> {
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Tile>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &wgpu::vertex_attr_array![0 => Uint32x4],
    }
}

impl Pyramid {
    /// Textures for frames of a size.
    pub fn new(gpu: &Gpu, size_px: [u32; 2]) -> Pyramid {
        let count = level_count(size_px[0], size_px[1]).max(1);
        let within = size_px.map(|edge| places_within(edge as usize, count));
        let level = |number: usize| {
            let [width, height] = size_px.map(|edge| edge.div_ceil(1 << number));
            let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC;
            let made = |label| gpu.texture(label, size, FRAME_FORMAT, usage);
            let texture = made("light");
            Level {
                light: view(&texture),
                texture,
                spread: view(&made("spread")),
                blurred: view(&made("blurred")),
                seen: (number <= FINISHED_LEVELS).then(|| view(&made("seen"))),
                within: [0, 1].map(|axis: usize| last_three(&within[axis][number - 1])),
            }
        };
        Pyramid { size_px, levels: (1..=count).map(level).collect() }
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

    /// What a level and all coarser ones spread, once it went up.
    pub fn spread(&self, level: usize) -> &wgpu::TextureView {
        &self.levels[level - 1].spread
    }

    /// Size of a level, texels.
    pub fn level_px(&self, level: usize) -> [u32; 2] {
        let texture = &self.levels[level - 1].texture;
        [texture.width(), texture.height()]
    }

    /// A pixel of the frame on a level, from 0 to 1 across it.
    pub fn pixel_on(&self, level: usize) -> [f32; 2] {
        self.level_px(level).map(|texels| 0.5f32.powi(level as i32) / texels as f32)
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

/// What the shader knows of the parts of texels, all before the last three being whole, and their number.
fn last_three(within: &[f64]) -> [f32; 4] {
    let from_end = |back: usize| within.len().checked_sub(back).map_or(1.0, |n| within[n] as f32);
    [from_end(3), from_end(2), from_end(1), within.len() as f32]
}

impl PyramidPass {
    pub fn new(gpu: &Gpu) -> PyramidPass {
        let stage = Stage {
            label: "pyramid",
            source: shaders::assembled("pyramid"),
            entries: ["vertex", "first"],
            constants: &[],
            targets: &[FRAME_FORMAT],
            buffers: &[],
            adds: false,
        };
        let pipeline = |vertex, fragment, targets| {
            gpu.chain_pipeline(&Stage { entries: [vertex, fragment], targets, ..stage.clone() })
        };
        let tile = [Some(tile_layout())];
        let seen = |is_red: bool| {
            ["seen", "seen_blurred"].map(|fragment| {
                gpu.chain_pipeline(&Stage {
                    entries: ["tile", fragment],
                    constants: &[("IS_RED", f64::from(u8::from(is_red)))],
                    buffers: &tile,
                    ..stage.clone()
                })
            })
        };
        PyramidPass {
            first: pipeline("vertex", "first", &[FRAME_FORMAT]),
            halved: pipeline("vertex", "halved", &[FRAME_FORMAT]),
            spread: pipeline("upward", "spread", &[FRAME_FORMAT]),
            spread_and_blurred: pipeline("upward", "spread_and_blurred", &[FRAME_FORMAT; 2]),
            seen: [seen(false), seen(true)],
            retina: pipeline("upward", "retina", &[FRAME_FORMAT]),
            between: gpu.linear_sampler(wgpu::AddressMode::ClampToEdge),
            nearest: gpu.nearest_sampler(),
        }
    }

    /// Makes levels from the one before each of them; level 1 from the frame.
    pub fn down(
        &self,
        frame: &mut Target,
        pyramid: &Pyramid,
        levels: impl IntoIterator<Item = usize>,
    ) {
        for number in levels {
            let (label, pipeline, finer) = match number {
                1 => ("half", &self.first, frame.view()),
                _ => ("coarser", &self.halved, pyramid.light(number - 1).clone()),
            };
            let group = frame.gpu.bind_mixed(
                &pipeline.get_bind_group_layout(0),
                &[(0, self.sampler()), (1, wgpu::BindingResource::TextureView(&finer))],
            );
            let light = pyramid.light(number).clone();
            frame.picture_pass(label, &[&light], |pass| fill(pass, pipeline, &group));
        }
    }

    /// Goes up to a level, from the coarsest or from the one below it.
    pub fn up(
        &self,
        frame: &mut Target,
        pyramid: &Pyramid,
        up: &Up,
        levels: impl IntoIterator<Item = usize>,
    ) {
        for number in levels {
            let level = &pyramid.levels[number - 1];
            let pipeline = if up.blurs { &self.spread_and_blurred } else { &self.spread };
            let group = self.step_up(frame, pyramid, up, number, pipeline, None);
            let pictures = [&level.spread, &level.blurred];
            let pictures = if up.blurs { &pictures[..] } else { &pictures[..1] };
            frame.picture_pass("glare", pictures, |pass| fill(pass, pipeline, &group));
        }
    }

    /// Makes a picture of what is shown in some tiles, at the resolution of one of the
    /// [`FINISHED_LEVELS`].
    pub fn seen<'p>(
        &self,
        frame: &mut Target,
        pyramid: &'p Pyramid,
        up: &Up,
        level: usize,
        tiles: &[Tile],
        screen: &Screen,
    ) -> Option<&'p wgpu::TextureView> {
        let picture = pyramid.levels[level - 1].seen.as_ref()?;
        let pipeline = &self.seen[usize::from(screen.is_red)][usize::from(up.blurs)];
        let group = self.step_up(frame, pyramid, up, level, pipeline, Some(screen));
        let bytes = bytemuck::cast_slice(tiles);
        let instances = frame.gpu.buffer("tiles", bytes, wgpu::BufferUsages::VERTEX);
        frame.picture_pass("seen", &[picture], |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, instances.slice(..));
            pass.draw(0..4, 0..tiles.len() as u32);
        });
        Some(picture)
    }

    /// The light on the retina, from the frame and from what a level spreads after [`PyramidPass::up`]:
    /// what measurements use, the pictures put both together on the way.
    pub fn retina(
        &self,
        frame: &mut Target,
        pyramid: &Pyramid,
        level: usize,
        in_place: f64,
    ) -> Result<HdrFrame, GpuError> {
        let [width, height] = pyramid.size_px;
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let texture = frame.gpu.texture("retina", size, FRAME_FORMAT, usage);
        let step = PyramidStepUniform {
            share: 0.0,
            coarser: 1.0,
            level: 0.5f32.powi(level as i32),
            in_place: in_place as f32,
            within: [[1.0; 4]; 2],
        };
        let step = frame.gpu.buffer("step", bytemuck::bytes_of(&step), wgpu::BufferUsages::UNIFORM);
        let layout = self.retina.get_bind_group_layout(0);
        let here = frame.view();
        let bound = [
            (0, self.sampler()),
            (1, wgpu::BindingResource::TextureView(&here)),
            (2, wgpu::BindingResource::TextureView(pyramid.spread(level))),
            (3, step.as_entire_binding()),
            (7, wgpu::BindingResource::Sampler(&self.nearest)),
        ];
        let group = frame.gpu.bind_mixed(&layout, &bound);
        frame.picture_pass("retina", &[&view(&texture)], |pass| fill(pass, &self.retina, &group));
        frame.submit();
        target::read_back(frame.gpu, &texture)
    }

    fn step_up(
        &self,
        frame: &Target,
        pyramid: &Pyramid,
        up: &Up,
        number: usize,
        pipeline: &wgpu::RenderPipeline,
        screen: Option<&Screen>,
    ) -> wgpu::BindGroup {
        let level = &pyramid.levels[number - 1];
        let coarser = pyramid.levels.get(number);
        // What finer levels would spread is not worth a pass over them: it stays in place.
        let finest = if screen.is_some() { number } else { 1 };
        let spread_from =
            |level: usize| up.shares.iter().skip(level - 1).fold(0.0, |sum, share| sum + share);
        let share = up.shares.get(number - 1).copied().unwrap_or(0.0);
        let step = PyramidStepUniform {
            // What is shown without a blur has all that is not spread on the level itself.
            share: match screen.is_some() && !up.blurs {
                true => 1.0 - spread_from(number + 1),
                false => share,
            } as f32,
            // Nothing is coarser than the coarsest, and without glare nothing is spread.
            coarser: if coarser.is_some() && !up.shares.is_empty() { 1.0 } else { 0.0 },
            level: number as f32,
            in_place: (1.0 - spread_from(finest)) as f32,
            within: level.within,
        };
        let step = frame.gpu.buffer("step", bytemuck::bytes_of(&step), wgpu::BufferUsages::UNIFORM);
        let view = wgpu::BindingResource::TextureView;
        let (spread, blurred) = match coarser {
            Some(coarser) => (&coarser.spread, &coarser.blurred),
            None => (&level.light, &level.light),
        };
        let mut bound = vec![
            (0, self.sampler()),
            (1, view(&level.light)),
            (2, view(spread)),
            (3, step.as_entire_binding()),
            (7, wgpu::BindingResource::Sampler(&self.nearest)),
        ];
        if up.blurs {
            bound.extend([(4, view(blurred)), (5, view(up.levels_resolved))]);
        }
        if let Some(Screen { shown, display, .. }) = screen {
            bound.extend([(6, view(shown)), (8, display.as_entire_binding())]);
        }
        frame.gpu.bind_mixed(&pipeline.get_bind_group_layout(0), &bound)
    }

    pub fn sampler(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Sampler(&self.between)
    }
}

/// Draws over all of a picture.
pub fn fill(pass: &mut wgpu::RenderPass, pipeline: &wgpu::RenderPipeline, group: &wgpu::BindGroup) {
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    pass.draw(0..3, 0..1);
}

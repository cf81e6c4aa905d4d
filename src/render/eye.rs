//! The picture that an eye sees: what the retina gets of the frame, through the tables of
//! [`Seeing`](crate::eye::Seeing), and the points of light that are not in it.

use std::sync::{Mutex, PoisonError};

use crate::camera::Camera;
use crate::display::Display;
use crate::eye::{Eye, Seeing, light_table};
use crate::plan::Splat;

use super::gpu::{FRAME_FORMAT, Gpu, GpuError, Stage};
use super::picture::{Depth, PictureTarget};
use super::pyramid::{Pyramid, PyramidPass, Retina, fill};
use super::shaders;
use super::target::Target;
use super::uniforms::{DisplayUniform, PointInstance, RetinaUniform, picture_constants};

pub struct EyePass {
    pyramid: PyramidPass,
    /// Made when first asked for, by what the picture is made of.
    pipelines: Mutex<Vec<(Kind, Pipelines)>>,
    /// The textures of the last size.
    kept: Mutex<Option<Pyramid>>,
}

/// What the shaders are made for.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Kind {
    display: Display,
    depth: Depth,
}

#[derive(Clone)]
struct Pipelines {
    sharp: wgpu::RenderPipeline,
    soft: wgpu::RenderPipeline,
    points: wgpu::RenderPipeline,
}

impl EyePass {
    pub fn new(gpu: &Gpu) -> EyePass {
        EyePass {
            pyramid: PyramidPass::new(gpu),
            pipelines: Mutex::default(),
            kept: Mutex::default(),
        }
    }

    /// Makes the picture of a frame in which the points are not.
    pub fn picture(
        &self,
        frame: &mut Target,
        points: &[Splat],
        eye: &Eye,
        display: &Display,
        camera: &Camera,
        picture: &PictureTarget,
    ) -> Result<Seeing, GpuError> {
        let size_px = [camera.width_px, camera.height_px];
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let pyramid = match kept.take() {
            Some(pyramid) if pyramid.size_px() == size_px => kept.insert(pyramid),
            _ => kept.insert(Pyramid::new(frame.gpu, size_px)),
        };
        self.pyramid.down(frame, pyramid);
        let level = eye.foveal_level(camera.pixel_angle()).min(pyramid.len());
        let foveal = pyramid.read(frame, level)?;
        let seeing = eye.seeing(&foveal, level, size_px, camera.pixel_angle(), display);

        let gpu = frame.gpu;
        let levels_resolved =
            seeing.levels_resolved.as_ref().map(|levels| row_texture(gpu, levels));
        let retina =
            self.pyramid.up(frame, pyramid, &seeing.glare_shares, levels_resolved.as_ref());
        let uniform = RetinaUniform {
            in_place: (1.0 - seeing.glare_shares.iter().sum::<f64>()) as f32,
            spread: retina.spread_share as f32,
            size_px: size_px.map(|edge| edge as f32),
        };
        let uniform = bytemuck::bytes_of(&uniform);
        let uniform = gpu.buffer("retina", uniform, wgpu::BufferUsages::UNIFORM);
        let pipelines = self.pipelines(gpu, Kind { display: *display, depth: picture.depth() });
        self.all(frame, &retina, &seeing, levels_resolved.as_ref(), &uniform, display, &pipelines, picture);
        self.points(frame, points, &seeing, display, &retina, pyramid.light(1), &uniform, &pipelines, picture);
        Ok(seeing)
    }

    /// All pixels.
    #[expect(clippy::too_many_arguments)]
    fn all(
        &self,
        frame: &mut Target,
        retina: &Retina,
        seeing: &Seeing,
        levels_resolved: Option<&wgpu::TextureView>,
        uniform: &wgpu::Buffer,
        display: &Display,
        pipelines: &Pipelines,
        picture: &PictureTarget,
    ) {
        let gpu = frame.gpu;
        let view = wgpu::BindingResource::TextureView;
        let display = DisplayUniform::of(display);
        let display = bytemuck::bytes_of(&display);
        let display = gpu.buffer("display", display, wgpu::BufferUsages::UNIFORM);
        let shown = table_texture(gpu, "shown", &seeing.shown);
        let frame_view = frame.view();
        let mut bound = vec![
            (0, self.sampler()),
            (1, uniform.as_entire_binding()),
            (2, display.as_entire_binding()),
            (3, view(&shown)),
            (4, view(&frame_view)),
            (5, view(retina.spread)),
        ];
        let pipeline = match (retina.blurred, levels_resolved) {
            (Some(blurred), Some(levels)) => {
                bound.extend([(6, view(blurred)), (7, view(levels))]);
                &pipelines.soft
            }
            _ => &pipelines.sharp,
        };
        let group = gpu.bind_mixed(&pipeline.get_bind_group_layout(0), &bound);
        frame.picture_pass("seeing", &[picture.codes()], |pass| fill(pass, pipeline, &group));
    }

    /// Points of light, those that are seen.
    #[expect(clippy::too_many_arguments)]
    fn points(
        &self,
        frame: &mut Target,
        points: &[Splat],
        seeing: &Seeing,
        display: &Display,
        retina: &Retina,
        half_frame: &wgpu::TextureView,
        uniform: &wgpu::Buffer,
        pipelines: &Pipelines,
        picture: &PictureTarget,
    ) {
        if points.is_empty() {
            return;
        }
        let gpu = frame.gpu;
        let view = wgpu::BindingResource::TextureView;
        let instance = |point: &Splat| {
            let seen = seeing.point(point.illuminance, display);
            PointInstance {
                centre_px: point.centre_px.map(|v| v as f32),
                colour: seen.colour.map(|v| v as f32),
                illuminance: seen.illuminance_lx as f32,
            }
        };
        let instances: Vec<PointInstance> = points.iter().map(instance).collect();
        let bytes = bytemuck::cast_slice(&instances);
        let instances = gpu.buffer("points", bytes, wgpu::BufferUsages::VERTEX);
        let visible = table_texture(gpu, "visible", &seeing.visible);
        let pipeline = &pipelines.points;
        let group = gpu.bind_mixed(
            &pipeline.get_bind_group_layout(0),
            &[
                (0, self.sampler()),
                (1, uniform.as_entire_binding()),
                (2, view(&visible)),
                (3, view(retina.spread)),
                (4, view(half_frame)),
            ],
        );
        frame.adding_pass("points", picture.light(), |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, instances.slice(..));
            pass.draw(0..4, 0..points.len() as u32);
        });
    }

    fn sampler(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Sampler(&self.pyramid.between)
    }

    fn pipelines(&self, gpu: &Gpu, kind: Kind) -> Pipelines {
        // A poisoned lock holds whole pipelines or none.
        let mut made = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, pipelines)) = made.iter().find(|(known, _)| *known == kind) {
            return pipelines.clone();
        }
        let constants = picture_constants(&kind.display, kind.depth);
        let all = |entry| {
            gpu.chain_pipeline(&Stage {
                label: "seeing",
                source: shaders::assembled("eye"),
                entries: ["vertex", entry],
                constants: &constants,
                targets: &[kind.depth.codes_format()],
                buffers: &[],
            })
        };
        let instance = wgpu::VertexBufferLayout {
            array_stride: size_of::<PointInstance>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x3, 2 => Float32],
        };
        let points = gpu.chain_pipeline(&Stage {
            label: "points",
            source: shaders::assembled("points"),
            entries: ["vertex", "fragment"],
            constants: &[],
            targets: &[kind.depth.light_format(kind.display.space)],
            buffers: &[Some(instance)],
        });
        let pipelines = Pipelines { sharp: all("sharp"), soft: all("soft"), points };
        made.push((kind, pipelines.clone()));
        pipelines
    }
}

/// A table over light.
fn table_texture(gpu: &Gpu, label: &str, table: &[[f32; 4]]) -> wgpu::TextureView {
    let size = wgpu::Extent3d {
        width: light_table::COLUMNS as u32,
        height: light_table::ROWS as u32,
        depth_or_array_layers: 1,
    };
    let texture = gpu.texture_of(label, size, FRAME_FORMAT, bytemuck::cast_slice(table));
    texture.create_view(&Default::default())
}

/// A table over the luminance of light.
fn row_texture(gpu: &Gpu, row: &[f32]) -> wgpu::TextureView {
    let size = wgpu::Extent3d { width: row.len() as u32, height: 1, depth_or_array_layers: 1 };
    let format = wgpu::TextureFormat::R32Float;
    let texture = gpu.texture_of("levels resolved", size, format, bytemuck::cast_slice(row));
    texture.create_view(&Default::default())
}

//! Points of light: stars, planets, and discs too small to show their shape.

use crate::camera::{Camera, Projection};
use crate::plan::Splat;
use crate::units::Angle;

use super::gpu::Gpu;
use super::shaders;
use super::target::Target;
use super::uniforms::SplatInstance;

/// Pixels up to this size differ so little in solid angle across a splat that its light errs by less
/// than 1e-4: the spread of a splat is a third of a pixel on each axis, squared, and no projection but
/// the panorama, near its poles, has solid angles that bend by more than three by a focal length squared.
const EVEN: Angle = Angle::from_deg(0.5);

pub struct SplatPass {
    /// For pixels that differ in solid angle.
    uneven: wgpu::RenderPipeline,
    even: wgpu::RenderPipeline,
}

impl SplatPass {
    pub fn new(gpu: &Gpu) -> SplatPass {
        let source = shaders::assembled("splats");
        let pipeline = |fragment| {
            let instance = wgpu::VertexBufferLayout {
                array_stride: size_of::<SplatInstance>() as u64,
                step_mode: wgpu::VertexStepMode::Instance,
                attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x4],
            };
            let topology = wgpu::PrimitiveTopology::TriangleStrip;
            gpu.pipeline("splats", &source, ["vertex", fragment], topology, &[Some(instance)])
        };
        SplatPass { uneven: pipeline("fragment"), even: pipeline("fragment_of_even_pixels") }
    }

    pub fn draw(&self, frame: &mut Target, splats: &[Splat], camera: &Camera) {
        if splats.is_empty() {
            return;
        }
        let is_even =
            camera.projection != Projection::Equirectangular && camera.pixel_angle() < EVEN;
        let instance = |splat: &Splat| {
            let over_sr = match camera.pixel_solid_angle_sr(splat.centre_px) {
                solid_angle_sr if is_even && solid_angle_sr > 0.0 => solid_angle_sr.recip(),
                _ if is_even => 0.0,
                _ => 1.0,
            };
            SplatInstance {
                centre_px: splat.centre_px.map(|v| v as f32),
                illuminance: (splat.illuminance * over_sr).to_f32(),
            }
        };
        let instances: Vec<SplatInstance> = splats.iter().map(instance).collect();
        let bytes = bytemuck::cast_slice(&instances);
        let instances = frame.gpu.buffer("splats", bytes, wgpu::BufferUsages::VERTEX);
        let pipeline = if is_even { &self.even } else { &self.uneven };
        let group = frame.bind(pipeline, &[]);
        frame.pass("splats", |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, instances.slice(..));
            pass.draw(0..4, 0..splats.len() as u32);
        });
    }
}

//! Bodies that show a disc: a lit sphere seen through the air.

use crate::plan::disc::{Disc, SurfaceLaw};

use super::gpu::Gpu;
use super::shaders;
use super::target::Target;
use super::uniforms::{DiscBandUniform, DiscUniform};

pub struct DiscPass {
    pipeline: wgpu::RenderPipeline,
}

impl DiscPass {
    pub fn new(gpu: &Gpu) -> DiscPass {
        let topology = wgpu::PrimitiveTopology::TriangleStrip;
        DiscPass { pipeline: gpu.pipeline("discs", &shaders::assembled("discs"), topology, &[]) }
    }

    pub fn draw(&self, frame: &mut Target, disc: &Disc) {
        let gpu = frame.gpu;
        let uniform = DiscUniform::of(disc);
        let uniform =
            gpu.buffer(disc.label, bytemuck::bytes_of(&uniform), wgpu::BufferUsages::STORAGE);
        let albedo: &[f32] = match &disc.shape.law {
            SurfaceLaw::Moon { map } => &map.albedo,
            // A binding cannot be empty; the law does not read it.
            _ => &[1.0],
        };
        let albedo =
            gpu.buffer("albedo", bytemuck::cast_slice(albedo), wgpu::BufferUsages::STORAGE);
        let bands: Vec<DiscBandUniform> = disc.bands.iter().map(DiscBandUniform::of).collect();
        let bands = gpu.buffer("bands", bytemuck::cast_slice(&bands), wgpu::BufferUsages::STORAGE);
        let group = frame.bind(&self.pipeline, &[&uniform, &albedo, &bands]);
        frame.pass(disc.label, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..4, 0..1);
        });
    }
}

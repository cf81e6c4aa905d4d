//! The sky and the ground: one full-screen look-up in the tables of the plan.

use crate::camera::Camera;
use crate::plan::{SKY_ALTITUDES, SKY_AZIMUTHS, SkyPlan};
use crate::units::Xyzv;

use super::gpu::Gpu;
use super::shaders;
use super::target::Target;
use super::uniforms::SkyUniform;

pub struct SkyPass {
    pipeline: wgpu::RenderPipeline,
}

impl SkyPass {
    pub fn new(gpu: &Gpu) -> SkyPass {
        let topology = wgpu::PrimitiveTopology::TriangleList;
        SkyPass { pipeline: gpu.pipeline("sky", &shaders::assembled("sky"), topology, &[]) }
    }

    pub fn draw(&self, frame: &mut Target, sky: &SkyPlan, camera: &Camera) {
        let uniform = SkyUniform::of(sky, camera);
        let gpu = frame.gpu;
        let uniform = gpu.buffer("sky", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let table = table(sky);
        let table =
            gpu.buffer("sky table", bytemuck::cast_slice(&table), wgpu::BufferUsages::STORAGE);
        let group = frame.bind(&self.pipeline, &[&uniform, &table]);
        frame.pass("sky", |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}

/// The tables one after the other, as `shaders/sky.wgsl` expects them.
fn table(sky: &SkyPlan) -> Vec<[f32; 4]> {
    let of_source = SKY_AZIMUTHS * SKY_ALTITUDES;
    let mut table = vec![[0.0; 4]; 2 * of_source + SKY_ALTITUDES];
    let mut fill = |start: usize, lights: &[Xyzv]| {
        for (texel, light) in table[start..].iter_mut().zip(lights) {
            *texel = light.to_f32();
        }
    };
    for (number, source) in [&sky.sun, &sky.moon].into_iter().enumerate() {
        if let Some(source) = source {
            fill(number * of_source, &source.luminance);
        }
    }
    fill(2 * of_source, &sky.dark);
    table
}

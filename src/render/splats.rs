//! Points of light: stars, planets, and discs too small to show their shape.

use crate::plan::Splat;

use super::gpu::Gpu;
use super::shaders;
use super::target::Target;
use super::uniforms::SplatInstance;

pub struct SplatPass {
    pipeline: wgpu::RenderPipeline,
}

impl SplatPass {
    pub fn new(gpu: &Gpu) -> SplatPass {
        let instance = wgpu::VertexBufferLayout {
            array_stride: size_of::<SplatInstance>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x4],
        };
        let topology = wgpu::PrimitiveTopology::TriangleStrip;
        let source = shaders::assembled("splats");
        SplatPass {
            pipeline: gpu.pipeline(
                "splats",
                &source,
                ["vertex", "fragment"],
                topology,
                &[Some(instance)],
            ),
        }
    }

    pub fn draw(&self, frame: &mut Target, splats: &[Splat]) {
        if splats.is_empty() {
            return;
        }
        let instances: Vec<SplatInstance> = splats
            .iter()
            .map(|splat| SplatInstance {
                centre_px: splat.centre_px.map(|v| v as f32),
                illuminance: splat.illuminance.to_f32(),
            })
            .collect();
        let instances = frame.gpu.buffer(
            "splats",
            bytemuck::cast_slice(&instances),
            wgpu::BufferUsages::VERTEX,
        );
        let group = frame.bind(&self.pipeline, &[]);
        frame.pass("splats", |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, instances.slice(..));
            pass.draw(0..4, 0..splats.len() as u32);
        });
    }
}

//! Diffraction spikes of the aperture, added to the frame after its points.

use crate::photo::lens::Spike;

use super::gpu::Gpu;
use super::shaders;
use super::target::Target;
use super::uniforms::SpikeInstance;

pub struct SpikePass {
    pipeline: wgpu::RenderPipeline,
}

impl SpikePass {
    pub fn new(gpu: &Gpu) -> SpikePass {
        let instance = wgpu::VertexBufferLayout {
            array_stride: size_of::<SpikeInstance>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![
                0 => Float32x2, 1 => Float32x2, 2 => Float32x2, 3 => Float32x4
            ],
        };
        let source = shaders::assembled("spikes");
        let topology = wgpu::PrimitiveTopology::TriangleStrip;
        let entries = ["vertex", "fragment"];
        SpikePass {
            pipeline: gpu.pipeline("spikes", &source, entries, topology, &[Some(instance)]),
        }
    }

    pub fn draw(&self, frame: &mut Target, spikes: &[Spike]) {
        let instances: Vec<SpikeInstance> = spikes.iter().map(SpikeInstance::of).collect();
        let bytes = bytemuck::cast_slice(&instances);
        let instances = frame.gpu.buffer("spikes", bytes, wgpu::BufferUsages::VERTEX);
        let group = frame.bind(&self.pipeline, &[]);
        frame.pass("spikes", |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, instances.slice(..));
            pass.draw(0..4, 0..spikes.len() as u32);
        });
    }
}

//! The sky and the ground: looked up in the tables of the plan, for the tiles of a picture or for
//! directions that are given.

use crate::camera::Camera;
use crate::frame::{Apparent, Dir};
use crate::plan::{SKY_SHAPE, SkyPlan};
use crate::units::Xyzv;

use super::gpu::{Gpu, GpuError};
use super::shaders;
use super::sky_tiles::{SkyDetail, tiles};
use super::target::{Target, read_buffer};
use super::uniforms::{SkyUniform, direction};

pub struct SkyPass {
    smooth: wgpu::RenderPipeline,
    exact: wgpu::RenderPipeline,
    look_up: wgpu::ComputePipeline,
}

/// The plan as the shaders want it.
struct Tables {
    uniform: wgpu::Buffer,
    table: wgpu::Buffer,
    phase: wgpu::Buffer,
}

impl SkyPass {
    pub fn new(gpu: &Gpu) -> SkyPass {
        let source = shaders::assembled("sky");
        let corner = wgpu::VertexBufferLayout {
            array_stride: size_of::<[u32; 2]>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![0 => Uint32x2],
        };
        let tile = wgpu::VertexBufferLayout {
            array_stride: size_of::<[u32; 4]>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![0 => Uint32x4],
        };
        let writing = |stage, topology, layout| {
            gpu.writing_pipeline("sky", stage, &source, topology, &[Some(layout)])
        };
        SkyPass {
            smooth: writing("smooth", wgpu::PrimitiveTopology::TriangleList, corner),
            exact: writing("exact", wgpu::PrimitiveTopology::TriangleStrip, tile),
            look_up: gpu.compute_pipeline("sky_in", &shaders::assembled("sky-in")),
        }
    }

    /// Draws over the whole frame.
    pub fn draw(&self, frame: &mut Target, sky: &SkyPlan, camera: &Camera, detail: SkyDetail) {
        let gpu = frame.gpu;
        let tables = Tables::new(gpu, sky, Some(camera));
        let tiles = tiles(sky, camera, detail);
        let buffers = [&frame.camera, &tables.uniform, &tables.table, &tables.phase];
        let bound = |pipeline: &wgpu::RenderPipeline| {
            gpu.bind(&pipeline.get_bind_group_layout(0), &(0..).zip(buffers).collect::<Vec<_>>())
        };
        let smooth = (!tiles.smooth.is_empty()).then(|| {
            let (corners, indices) = tiles.shared_corners(camera);
            let (vertex, index) = (wgpu::BufferUsages::VERTEX, wgpu::BufferUsages::INDEX);
            let corners = gpu.buffer("sky corners", bytemuck::cast_slice(&corners), vertex);
            let buffer = gpu.buffer("sky tiles", bytemuck::cast_slice(&indices), index);
            (bound(&self.smooth), corners, buffer, indices.len() as u32)
        });
        let exact = (!tiles.exact.is_empty()).then(|| {
            let corners = bytemuck::cast_slice(&tiles.exact);
            let corners = gpu.buffer("exact sky tiles", corners, wgpu::BufferUsages::VERTEX);
            (bound(&self.exact), corners, tiles.exact.len() as u32)
        });
        frame.pass("sky", |pass| {
            if let Some((group, corners, indices, count)) = &smooth {
                pass.set_pipeline(&self.smooth);
                pass.set_bind_group(0, group, &[]);
                pass.set_vertex_buffer(0, corners.slice(..));
                pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..*count, 0, 0..1);
            }
            if let Some((group, corners, count)) = &exact {
                pass.set_pipeline(&self.exact);
                pass.set_bind_group(0, group, &[]);
                pass.set_vertex_buffer(0, corners.slice(..));
                pass.draw(0..4, 0..*count);
            }
        });
    }

    /// Looks up the light in directions.
    pub fn look_up(
        &self,
        gpu: &Gpu,
        sky: &SkyPlan,
        dirs: &[Dir<Apparent>],
    ) -> Result<Vec<Xyzv>, GpuError> {
        /// Directions of one dispatch: as many work groups as every adapter takes.
        const AT_ONCE: usize = 64 * 65_535;
        let tables = Tables::new(gpu, sky, None);
        let mut lights = Vec::with_capacity(dirs.len());
        for dirs in dirs.chunks(AT_ONCE) {
            let dirs: Vec<[f32; 4]> = dirs.iter().map(|dir| direction(*dir, 0.0)).collect();
            let bytes: &[u8] = bytemuck::cast_slice(&dirs);
            let dirs_buffer = gpu.buffer("directions", bytes, wgpu::BufferUsages::STORAGE);
            let out = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("light"),
                size: bytes.len() as u64,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            });
            let buffers = [
                (1, &tables.uniform),
                (2, &tables.table),
                (3, &tables.phase),
                (4, &dirs_buffer),
                (5, &out),
            ];
            let group = gpu.bind(&self.look_up.get_bind_group_layout(0), &buffers);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.look_up);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups((dirs.len() as u32).div_ceil(64), 1, 1);
            drop(pass);
            let bytes = read_buffer(gpu, encoder, &out)?;
            let found: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
            lights.extend(found.iter().map(|l| {
                let [x, y, z, v] = l.map(f64::from);
                Xyzv::new(x, y, z, v)
            }));
        }
        Ok(lights)
    }
}

impl Tables {
    fn new(gpu: &Gpu, sky: &SkyPlan, camera: Option<&Camera>) -> Tables {
        let uniform = SkyUniform::of(sky, camera);
        let phase = sky.sources().into_iter().flatten().find_map(|(s, _)| s.view.phase.as_ref());
        // A binding cannot be empty; without haze nothing reads it.
        let phase = phase.map_or(&[0.0f32; 2][..], |phase| phase.values());
        let storage = |label, bytes| gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE);
        Tables {
            uniform: gpu.buffer("sky", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::STORAGE),
            table: storage("sky table", bytemuck::cast_slice(&table(sky))),
            phase: storage("phase function", bytemuck::cast_slice(phase)),
        }
    }
}

/// The tables one after the other, as `shaders/skylight.wgsl` expects them.
fn table(sky: &SkyPlan) -> Vec<[f32; 4]> {
    let of_source = 2 * SKY_SHAPE.nodes();
    let mut table = vec![[0.0; 4]; 2 * of_source + sky.dark.len()];
    for (number, source) in sky.sources().into_iter().enumerate() {
        let Some((source, _)) = source else { continue };
        let texels = &mut table[number * of_source..][..of_source];
        let smooth = source.view.smooth.chunks_exact(4);
        for (texel, light) in texels.iter_mut().step_by(2).zip(smooth) {
            texel.copy_from_slice(light);
        }
        let haze = source.view.haze.chunks_exact(4);
        for (texel, light) in texels.iter_mut().skip(1).step_by(2).zip(haze) {
            texel.copy_from_slice(light);
        }
    }
    for (texel, light) in table[2 * of_source..].iter_mut().zip(&sky.dark) {
        *texel = light.to_f32();
    }
    table
}

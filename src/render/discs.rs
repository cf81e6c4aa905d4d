//! Bodies that show a disc: a lit sphere seen through the air.

use std::sync::OnceLock;

use crate::plan::disc::{Disc, SurfaceLaw};
use crate::plan::globe::SeenGlobe;

use super::globe::GlobePass;
use super::gpu::Gpu;
use super::shaders;
use super::target::Target;
use super::uniforms::{DiscBandUniform, DiscUniform, GlobeTiles, PlanetUniform};

pub struct DiscPass {
    shapes: wgpu::RenderPipeline,
    /// Where a pixel of the frame has about one of the picture, and where it has more.
    globes: [wgpu::RenderPipeline; 2],
    /// Made when the first planet shows a disc.
    planets: OnceLock<wgpu::RenderPipeline>,
    globe: GlobePass,
    across_picture: wgpu::Sampler,
}

impl DiscPass {
    pub fn new(gpu: &Gpu) -> DiscPass {
        let (strip, list) =
            (wgpu::PrimitiveTopology::TriangleStrip, wgpu::PrimitiveTopology::TriangleList);
        let source = shaders::assembled("discs");
        let pipeline = |entries, topology| gpu.pipeline("discs", &source, entries, topology, &[]);
        DiscPass {
            shapes: pipeline(["vertex", "fragment"], strip),
            globes: ["globe_fragment", "small_globe_fragment"]
                .map(|fragment| pipeline(["globe_vertex", fragment], list)),
            planets: OnceLock::new(),
            globe: GlobePass::new(gpu),
            across_picture: gpu.linear_sampler(wgpu::AddressMode::ClampToEdge),
        }
    }

    pub fn draw(&self, frame: &mut Target, disc: &Disc) {
        let gpu = frame.gpu;
        let uniform = DiscUniform::of(disc);
        let uniform =
            gpu.buffer(disc.label, bytemuck::bytes_of(&uniform), wgpu::BufferUsages::STORAGE);
        let bands: Vec<DiscBandUniform> = disc.bands.iter().map(DiscBandUniform::of).collect();
        let bands = gpu.buffer("bands", bytemuck::cast_slice(&bands), wgpu::BufferUsages::STORAGE);
        match &disc.globe {
            Some(globe) => self.draw_globe(frame, disc, globe, [&uniform, &bands]),
            None if matches!(disc.shape.law, SurfaceLaw::Planet(_)) => {
                self.draw_planet(frame, disc, [&uniform, &bands]);
            }
            None => self.draw_shape(frame, disc, [&uniform, &bands]),
        }
    }

    fn draw_shape(&self, frame: &mut Target, disc: &Disc, [uniform, bands]: [&wgpu::Buffer; 2]) {
        let group = frame.bind(&self.shapes, &[uniform, bands]);
        frame.pass(disc.label, |pass| {
            pass.set_pipeline(&self.shapes);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..4, 0..1);
        });
    }

    fn draw_planet(&self, frame: &mut Target, disc: &Disc, [uniform, bands]: [&wgpu::Buffer; 2]) {
        let SurfaceLaw::Planet(planet) = &disc.shape.law else { return };
        let gpu = frame.gpu;
        let pipeline = self.planets.get_or_init(|| {
            let strip = wgpu::PrimitiveTopology::TriangleStrip;
            let source = shaders::assembled("planets");
            gpu.pipeline("planets", &source, ["vertex", "planet_fragment"], strip, &[])
        });
        let planet = PlanetUniform::of(planet);
        let planet = gpu.buffer("planet", bytemuck::bytes_of(&planet), wgpu::BufferUsages::STORAGE);
        let group = gpu.bind(
            &pipeline.get_bind_group_layout(0),
            &[(0, &frame.camera), (1, uniform), (2, bands), (8, &planet)],
        );
        frame.pass(disc.label, |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..4, 0..1);
        });
    }

    fn draw_globe(
        &self,
        frame: &mut Target,
        disc: &Disc,
        seen: &SeenGlobe,
        [uniform, bands]: [&wgpu::Buffer; 2],
    ) {
        let globes = &self.globes[usize::from(seen.fineness() > 1)];
        let picture = self.globe.picture(frame, &seen.globe);
        let group = frame.gpu.bind_mixed(
            &globes.get_bind_group_layout(0),
            &[
                (0, frame.camera.as_entire_binding()),
                (1, uniform.as_entire_binding()),
                (2, bands.as_entire_binding()),
                (3, wgpu::BindingResource::TextureView(&picture.view)),
                (4, wgpu::BindingResource::Sampler(&self.across_picture)),
                (5, picture.mean.as_entire_binding()),
                (6, wgpu::BindingResource::TextureView(&picture.outline)),
                (7, wgpu::BindingResource::Sampler(&self.globe.around)),
            ],
        );
        let GlobeTiles { columns, rows, .. } = GlobeTiles::of(disc);
        let indices = lattice_indices(columns, rows);
        let (count, usage) = (indices.len() as u32, wgpu::BufferUsages::INDEX);
        let tiles = frame.gpu.buffer("tiles", bytemuck::cast_slice(&indices), usage);
        let bands = (disc.bands.len() / disc.channels()) as u32;
        frame.pass(disc.label, |pass| {
            pass.set_pipeline(globes);
            pass.set_bind_group(0, &group, &[]);
            pass.set_index_buffer(tiles.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..count, 0, 0..bands);
        });
    }
}

/// Two triangles for each square of a lattice of corners, which are numbered row by row.
fn lattice_indices(columns: u32, rows: u32) -> Vec<u32> {
    let corner = |column: u32, row: u32| row * (columns + 1) + column;
    let mut indices = Vec::with_capacity(6 * (columns * rows) as usize);
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [corner(column, row), corner(column + 1, row)];
            let [c, d] = [corner(column, row + 1), corner(column + 1, row + 1)];
            indices.extend([a, b, c, c, b, d]);
        }
    }
    indices
}

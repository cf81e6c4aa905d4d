//! Bodies that show a disc: a lit sphere seen through the air.

use std::sync::OnceLock;

use crate::camera::Camera;
use crate::plan::disc::{Disc, SurfaceLaw};
use crate::plan::globe::SeenGlobe;
use crate::plan::near::Near;

use super::globe::GlobePass;
use super::gpu::Gpu;
use super::shaders;
use super::target::Target;
use super::uniforms::{
    DiscBandUniform, DiscUniform, GlobeTiles, NearBandUniform, NearUniform, PlanetUniform,
};

pub struct DiscPass {
    shapes: wgpu::RenderPipeline,
    /// Where a pixel of the frame has about one of the picture, and where it has more.
    globes: [wgpu::RenderPipeline; 2],
    /// Made when the first planet shows a disc.
    planets: OnceLock<wgpu::RenderPipeline>,
    /// Shapes, globes and planets on narrow pictures, each made when the first is drawn.
    near: [OnceLock<wgpu::RenderPipeline>; 3],
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
            near: Default::default(),
            globe: GlobePass::new(gpu),
            across_picture: gpu.linear_sampler(wgpu::AddressMode::ClampToEdge),
        }
    }

    pub fn draw(&self, frame: &mut Target, disc: &Disc, camera: &Camera) {
        let gpu = frame.gpu;
        let uniform = DiscUniform::of(disc);
        let uniform =
            gpu.buffer(disc.label, bytemuck::bytes_of(&uniform), wgpu::BufferUsages::STORAGE);
        let bands: Vec<DiscBandUniform> = disc.bands.iter().map(DiscBandUniform::of).collect();
        let bands = gpu.buffer("bands", bytemuck::cast_slice(&bands), wgpu::BufferUsages::STORAGE);
        if let Some(near) = Near::of(disc, camera) {
            return self.draw_near(frame, disc, &near, [&uniform, &bands]);
        }
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
        draw_tiles(frame, disc, globes, &group);
    }

    /// The same kinds of discs on a narrow picture.
    fn draw_near(
        &self,
        frame: &mut Target,
        disc: &Disc,
        near: &Near,
        [uniform, bands]: [&wgpu::Buffer; 2],
    ) {
        let gpu = frame.gpu;
        let storage =
            |label: &str, bytes: &[u8]| gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE);
        let near_uniform = storage("near", bytemuck::bytes_of(&NearUniform::of(near)));
        let near_bands = NearBandUniform::all(near);
        let near_bands = storage("near bands", bytemuck::cast_slice(&near_bands));
        let planet = match &disc.shape.law {
            SurfaceLaw::Planet(planet) => {
                Some(storage("planet", bytemuck::bytes_of(&PlanetUniform::of(planet))))
            }
            _ => None,
        };
        let picture = disc.globe.as_ref().map(|seen| self.globe.picture(frame, &seen.globe));
        let mut resources = vec![
            (0, frame.camera.as_entire_binding()),
            (1, uniform.as_entire_binding()),
            (2, bands.as_entire_binding()),
            (9, near_uniform.as_entire_binding()),
            (10, near_bands.as_entire_binding()),
        ];
        if let Some(picture) = &picture {
            resources.push((3, wgpu::BindingResource::TextureView(&picture.view)));
            resources.push((5, picture.mean.as_entire_binding()));
            let pipeline = self.near_pipeline(gpu, NearKind::Globe);
            let group = gpu.bind_mixed(&pipeline.get_bind_group_layout(0), &resources);
            return draw_tiles(frame, disc, pipeline, &group);
        }
        let pipeline = match &planet {
            Some(planet) => {
                resources.push((8, planet.as_entire_binding()));
                self.near_pipeline(gpu, NearKind::Planet)
            }
            None => self.near_pipeline(gpu, NearKind::Shape),
        };
        let group = gpu.bind_mixed(&pipeline.get_bind_group_layout(0), &resources);
        frame.pass(disc.label, |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..4, 0..1);
        });
    }

    fn near_pipeline(&self, gpu: &Gpu, kind: NearKind) -> &wgpu::RenderPipeline {
        self.near[kind as usize].get_or_init(|| {
            let (strip, list) =
                (wgpu::PrimitiveTopology::TriangleStrip, wgpu::PrimitiveTopology::TriangleList);
            let (name, entries, topology) = match kind {
                NearKind::Shape => ("near-discs", ["vertex", "fragment"], strip),
                NearKind::Globe => {
                    ("near-discs", ["near_globe_vertex", "near_globe_fragment"], list)
                }
                NearKind::Planet => ("near-planets", ["vertex", "planet_fragment"], strip),
            };
            gpu.pipeline(name, &shaders::assembled(name), entries, topology, &[])
        })
    }
}

/// What is drawn on a narrow picture.
#[derive(Debug, Clone, Copy)]
enum NearKind {
    Shape,
    Globe,
    Planet,
}

/// Draws the globe of a disc in its tiles, each band of colour.
fn draw_tiles(
    frame: &mut Target,
    disc: &Disc,
    pipeline: &wgpu::RenderPipeline,
    group: &wgpu::BindGroup,
) {
    let GlobeTiles { columns, rows, .. } = GlobeTiles::of(disc);
    let indices = lattice_indices(columns, rows);
    let (count, usage) = (indices.len() as u32, wgpu::BufferUsages::INDEX);
    let tiles = frame.gpu.buffer("tiles", bytemuck::cast_slice(&indices), usage);
    let bands = (disc.bands.len() / disc.channels()) as u32;
    frame.pass(disc.label, |pass| {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.set_index_buffer(tiles.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..count, 0, 0..bands);
    });
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

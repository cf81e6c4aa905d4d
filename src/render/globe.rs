//! The Moon's globe on a picture of its own: maps kept on the GPU, a mesh, its mean light.

use std::sync::{Arc, Mutex, PoisonError};

use half::f16;

use crate::catalog::{MoonMap, MoonRelief};
use crate::light::moon::surface::PhaseCell;
use crate::plan::globe::{EXTENT, Globe, Ground, Shadows, UmbraTable};
use crate::units::MOON_RADIUS_KM;

use super::gpu::Gpu;
use super::shaders;
use super::target::Target;
use super::uniforms::{GlobeUniform, MeanUniform, MeshBandUniform};

const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Pixels that a group sums along each axis.
const TILE_PX: u32 = 64;

pub struct GlobePass {
    mesh: wgpu::RenderPipeline,
    sum_tile: wgpu::ComputePipeline,
    sum_all: wgpu::ComputePipeline,
    across_maps: wgpu::Sampler,
    across_facets: wgpu::Sampler,
    maps: Mutex<Option<Maps>>,
}

/// The maps of the last globe, as it was drawn.
#[derive(Clone)]
struct Maps {
    relief: (Arc<MoonRelief>, u32, wgpu::TextureView),
    albedo: (Arc<MoonMap>, u32, wgpu::TextureView),
    shadows: (Arc<Shadows>, wgpu::TextureView),
}

/// A globe that was drawn.
pub struct GlobePicture {
    pub view: wgpu::TextureView,
    /// The mean of its light over a disc of radius one.
    pub mean: wgpu::Buffer,
}

impl GlobePass {
    pub fn new(gpu: &Gpu) -> GlobePass {
        let mean = shaders::assembled("globe-mean");
        GlobePass {
            mesh: gpu.picture_pipeline(
                "globe",
                &shaders::assembled("globe"),
                PICTURE_FORMAT,
                DEPTH_FORMAT,
            ),
            sum_tile: gpu.compute_pipeline("sum_tile", &mean),
            sum_all: gpu.compute_pipeline("sum_all", &mean),
            across_maps: gpu.linear_sampler(wgpu::AddressMode::Repeat),
            across_facets: gpu.linear_sampler(wgpu::AddressMode::ClampToEdge),
            maps: Mutex::new(None),
        }
    }

    pub fn draw(&self, frame: &mut Target, globe: &Globe) -> GlobePicture {
        let gpu = frame.gpu;
        let maps = self.maps(gpu, globe);
        let px = globe.picture_px;
        let texture = |label, format, usage| {
            let size = wgpu::Extent3d { width: px, height: px, depth_or_array_layers: 1 };
            gpu.texture(label, size, format, usage | wgpu::TextureUsages::RENDER_ATTACHMENT)
        };
        let binding = wgpu::TextureUsages::TEXTURE_BINDING;
        let picture = texture("globe", PICTURE_FORMAT, binding).create_view(&Default::default());
        let depth = texture("depth of the globe", DEPTH_FORMAT, wgpu::TextureUsages::empty());
        let uniform = storage(gpu, "globe", bytemuck::bytes_of(&GlobeUniform::of(globe)));
        let [once, often, facets] = ground_textures(gpu, &globe.ground);
        let umbra = umbra_texture(gpu, globe.shadow.as_ref());
        let bands = globe.mesh().map(|band| {
            let buffer = storage(gpu, "band", bytemuck::bytes_of(&MeshBandUniform::of(&band)));
            let group = bind(
                gpu,
                &self.mesh.get_bind_group_layout(0),
                &[
                    uniform.as_entire_binding(),
                    buffer.as_entire_binding(),
                    wgpu::BindingResource::TextureView(&maps.relief.2),
                    wgpu::BindingResource::TextureView(&maps.albedo.2),
                    wgpu::BindingResource::TextureView(&maps.shadows.1),
                    wgpu::BindingResource::Sampler(&self.across_maps),
                    wgpu::BindingResource::TextureView(&once),
                    wgpu::BindingResource::TextureView(&often),
                    wgpu::BindingResource::TextureView(&facets),
                    wgpu::BindingResource::Sampler(&self.across_facets),
                    wgpu::BindingResource::TextureView(&umbra),
                ],
            );
            let indices = lattice_indices(band.sectors, band.rings);
            let count = indices.len() as u32;
            let usage = wgpu::BufferUsages::INDEX;
            (group, gpu.buffer("mesh", bytemuck::cast_slice(&indices), usage), count)
        });
        let depth = depth.create_view(&Default::default());
        frame.picture_pass("globe", &picture, &depth, |pass| {
            pass.set_pipeline(&self.mesh);
            for (group, mesh, count) in &bands {
                pass.set_bind_group(0, group, &[]);
                pass.set_index_buffer(mesh.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..*count, 0, 0..1);
            }
        });
        let mean = self.mean(frame, globe, &picture);
        GlobePicture { view: picture, mean }
    }

    fn mean(&self, frame: &mut Target, globe: &Globe, picture: &wgpu::TextureView) -> wgpu::Buffer {
        let gpu = frame.gpu;
        let tiles = globe.picture_px.div_ceil(TILE_PX);
        let pixel = 2.0 * EXTENT / f64::from(globe.picture_px);
        let share = pixel * pixel / std::f64::consts::PI;
        let uniform = MeanUniform { pixel_share: share as f32, tiles: tiles * tiles };
        let uniform = storage(gpu, "mean", bytemuck::bytes_of(&uniform));
        let sums = vec![[0.0f32; 4]; (tiles * tiles) as usize];
        let sums = storage(gpu, "sums of tiles", bytemuck::cast_slice(&sums));
        let result = storage(gpu, "mean light of the globe", bytemuck::bytes_of(&[0.0f32; 4]));
        let tile = gpu.bind_mixed(
            &self.sum_tile.get_bind_group_layout(0),
            &[(0, wgpu::BindingResource::TextureView(picture)), (2, sums.as_entire_binding())],
        );
        let all = gpu.bind(
            &self.sum_all.get_bind_group_layout(0),
            &[(1, &uniform), (2, &sums), (3, &result)],
        );
        frame.compute("mean of the globe", |pass| {
            pass.set_pipeline(&self.sum_tile);
            pass.set_bind_group(0, &tile, &[]);
            pass.dispatch_workgroups(tiles, tiles, 1);
            pass.set_pipeline(&self.sum_all);
            pass.set_bind_group(0, &all, &[]);
            pass.dispatch_workgroups(1, 1, 1);
        });
        result
    }

    /// The maps of a globe; those that the last one had are not sent again.
    fn maps(&self, gpu: &Gpu, globe: &Globe) -> Maps {
        let mut kept = self.maps.lock().unwrap_or_else(PoisonError::into_inner);
        let last = kept.take();
        let (relief_level, albedo_level) = (globe.relief_level(), globe.albedo_level());
        let relief = last.as_ref().map(|maps| &maps.relief).filter(|(relief, level, _)| {
            Arc::ptr_eq(relief, &globe.relief) && *level == relief_level
        });
        let albedo = last.as_ref().map(|maps| &maps.albedo).filter(|(albedo, level, _)| {
            Arc::ptr_eq(albedo, &globe.albedo) && *level == albedo_level
        });
        let shadows = last
            .as_ref()
            .map(|maps| &maps.shadows)
            .filter(|(shadows, _)| Arc::ptr_eq(shadows, &globe.shadows));
        let maps = Maps {
            relief: relief.cloned().unwrap_or_else(|| {
                let view = relief_texture(gpu, &globe.relief, relief_level);
                (Arc::clone(&globe.relief), relief_level, view)
            }),
            albedo: albedo.cloned().unwrap_or_else(|| {
                let view = albedo_texture(gpu, &globe.albedo, albedo_level);
                (Arc::clone(&globe.albedo), albedo_level, view)
            }),
            shadows: shadows.cloned().unwrap_or_else(|| {
                let texels = globe.shadows.sunlit.iter().map(|share| (255.0 * share).round() as u8);
                let size = [globe.shadows.columns, globe.shadows.rows].map(|n| n as u32);
                let format = wgpu::TextureFormat::R8Unorm;
                let view = map_texture(gpu, "shadows", size, format, &texels.collect::<Vec<u8>>());
                (Arc::clone(&globe.shadows), view)
            }),
        };
        *kept = Some(maps.clone());
        maps
    }
}

/// Two triangles for each square of a lattice of corners, which are numbered row by row.
pub fn lattice_indices(columns: u32, rows: u32) -> Vec<u32> {
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

fn storage(gpu: &Gpu, label: &str, bytes: &[u8]) -> wgpu::Buffer {
    gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE)
}

fn bind(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource],
) -> wgpu::BindGroup {
    gpu.bind_mixed(layout, &(0..).zip(resources.iter().cloned()).collect::<Vec<_>>())
}

fn map_texture(
    gpu: &Gpu,
    label: &str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    bytes: &[u8],
) -> wgpu::TextureView {
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    gpu.texture_of(label, size, format, bytes).create_view(&Default::default())
}

/// A map halved some times, each time by the mean of four.
fn halved<const N: usize>(
    mut map: Vec<[f32; N]>,
    mut width: usize,
    level: u32,
) -> (Vec<[f32; N]>, usize) {
    for _ in 0..level {
        let half = width / 2;
        map = (0..half / 2 * half)
            .map(|at| {
                let first = at / half * 2 * width + at % half * 2;
                let four = [first, first + 1, first + width, first + width + 1];
                std::array::from_fn(|n| four.iter().map(|&i| map[i][n]).sum::<f32>() / 4.0)
            })
            .collect();
        width = half;
    }
    (map, width)
}

fn relief_texture(gpu: &Gpu, relief: &MoonRelief, level: u32) -> wgpu::TextureView {
    let radii = relief.elevation_m.iter().map(|&m| [m as f32 / (1000.0 * MOON_RADIUS_KM) as f32]);
    let (radii, width) = halved(radii.collect(), relief.width, level);
    let height = width / 2;
    let step = std::f32::consts::TAU / width as f32;
    let mut texels = Vec::with_capacity(4 * radii.len());
    for row in 0..height {
        let cos_latitude = (std::f32::consts::PI * (row as f32 + 0.5) / height as f32).sin();
        let (above, below) = (row.saturating_sub(1), (row + 1).min(height - 1));
        for column in 0..width {
            let at = |row: usize, column: usize| radii[row * width + column % width][0];
            let east = (at(row, column + 1) - at(row, column + width - 1)) / (2.0 * step);
            let north = (at(above, column) - at(below, column)) / ((below - above) as f32 * step);
            let elevation = at(row, column);
            let slope = [east / cos_latitude, north].map(|slope| slope / (1.0 + elevation));
            texels.extend([slope[0], slope[1], elevation, 0.0].map(|v| f16::from_f32(v).to_bits()));
        }
    }
    let format = wgpu::TextureFormat::Rgba16Float;
    let size = [width as u32, height as u32];
    map_texture(gpu, "relief", size, format, bytemuck::cast_slice(&texels))
}

/// What is scattered once and often, and what roughness makes of directions.
fn ground_textures(gpu: &Gpu, ground: &Ground) -> [wgpu::TextureView; 3] {
    let texture = |label, (width, height): (usize, usize), texels: Vec<[f64; 4]>| {
        let texels: Vec<u16> =
            texels.iter().flatten().map(|&v| f16::from_f64(v).to_bits()).collect();
        let format = wgpu::TextureFormat::Rgba16Float;
        let size = [width as u32, height as u32];
        map_texture(gpu, label, size, format, bytemuck::cast_slice(&texels))
    };
    // Cells run from 415 to 643 nm, colours from red to blue.
    let cells = |of: fn(&[PhaseCell; 3]) -> [f64; 4]| ground.cells.iter().map(of).collect();
    let once = cells(|[b, g, r]| [r.single, g.single, b.single, g.w]);
    let often = cells(|[b, g, r]| [r.multiple, g.multiple, b.multiple, 0.0]);
    let facets = ground.facets.iter();
    let facets = facets.map(|f| [f.cos_incidence, f.cos_emission, f.shadowing, 0.0]).collect();
    [
        texture("scattered once", ground.size, once),
        texture("scattered often", ground.size, often),
        texture("facets", (Ground::NODES, Ground::NODES), facets),
    ]
}

fn umbra_texture(gpu: &Gpu, shadow: Option<&UmbraTable>) -> wgpu::TextureView {
    let texels: Vec<u16> = match shadow {
        Some(table) => {
            let texel = |&[r, g, b]: &[f64; 3]| [r, g, b, 0.0].map(|v| f16::from_f64(v).to_bits());
            table.shares.iter().flat_map(texel).collect()
        }
        // A binding cannot be empty; without an eclipse nothing reads it.
        None => vec![0; 4],
    };
    let size = [texels.len() as u32 / 4, 1];
    let format = wgpu::TextureFormat::Rgba16Float;
    map_texture(gpu, "shadow of the Earth", size, format, bytemuck::cast_slice(&texels))
}

fn albedo_texture(gpu: &Gpu, albedo: &MoonMap, level: u32) -> wgpu::TextureView {
    let (reff, width) = halved(albedo.reff.clone(), albedo.width, level);
    let texels: Vec<u16> = reff
        .iter()
        .flat_map(|[red, green, blue]| {
            [*red, *green, *blue, 0.0].map(|v| f16::from_f32(v).to_bits())
        })
        .collect();
    let format = wgpu::TextureFormat::Rgba16Float;
    let size = [width as u32, width as u32 / 2];
    map_texture(gpu, "reflectances", size, format, bytemuck::cast_slice(&texels))
}

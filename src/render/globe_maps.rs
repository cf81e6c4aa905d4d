//! What the globe is made of as textures.

use half::f16;
use rayon::prelude::*;

use crate::plan::globe::ground::Ground;
use crate::plan::globe::limb::Limb;
use crate::plan::globe::near_side::{EDGE, NearSide, normal_at};
use crate::plan::globe::shadows::Shadows;
use crate::plan::globe::umbra::UmbraTable;

use super::gpu::Gpu;

/// Least ratios of reflectances that a texel of colours holds, and the unit of the outline: as in
/// `shaders/lib/globe.wgsl`.
const LEAST_RATIO: [f32; 2] = [0.6, 0.3];
const OUTLINE_UNIT: f64 = 0.01;

/// The maps of the near side.
#[derive(Clone)]
pub struct NearSideMaps {
    /// Slopes along the axes of the map, elevation, reflectance at 566 nm.
    pub relief: wgpu::TextureView,
    /// Reflectances at 643 and 415 nm over that at 566 nm.
    pub colours: wgpu::TextureView,
}

impl NearSideMaps {
    pub fn new(gpu: &Gpu, relief: &NearSide<f32>, albedo: &NearSide<[f32; 3]>) -> NearSideMaps {
        NearSideMaps {
            relief: relief_texture(gpu, relief, albedo),
            colours: colours_texture(gpu, albedo),
        }
    }
}

fn relief_texture(
    gpu: &Gpu,
    relief: &NearSide<f32>,
    albedo: &NearSide<[f32; 3]>,
) -> wgpu::TextureView {
    let size = relief.size;
    let cell = 2.0 * EDGE / size as f64;
    let mut texels = vec![[0u16; 4]; size * size];
    texels.par_chunks_mut(size).enumerate().for_each(|(row, texels)| {
        let height = |row: usize, column: usize| relief.values[row * size + column];
        let (above, below) = (row.saturating_sub(1), (row + 1).min(size - 1));
        let y = -relief.middle(row);
        for (column, texel) in texels.iter_mut().enumerate() {
            let (left, right) = (column.saturating_sub(1), (column + 1).min(size - 1));
            let x = relief.middle(column);
            let elevation = height(row, column);
            let along = (height(row, right) - height(row, left)) / (right - left) as f32;
            let up = (height(above, column) - height(below, column)) / (below - above) as f32;
            // How the place on the map moves with a step along the axes: see `NearSide`.
            let n = normal_at(x, y);
            let k = (1.0 + n.x).recip();
            let scale = (2.0 * k).sqrt() / (cell * (1.0 + f64::from(elevation)));
            let aslant = (-0.5 * scale * k * n.y * n.z) as f32;
            let ahead = [n.y, n.z].map(|n| (scale * (1.0 - 0.5 * k * n * n)) as f32);
            let slopes = [along * ahead[0] + up * aslant, along * aslant + up * ahead[1]];
            let [_, reflectance, _] = albedo.on_plane(x, y);
            let values = [slopes[0], slopes[1], elevation, reflectance];
            *texel = values.map(|value| f16::from_f32(value).to_bits());
        }
    });
    let format = wgpu::TextureFormat::Rgba16Float;
    texture(gpu, "relief", [size, size], format, bytemuck::cast_slice(&texels))
}

fn colours_texture(gpu: &Gpu, albedo: &NearSide<[f32; 3]>) -> wgpu::TextureView {
    let texel = |&[red, green, blue]: &[f32; 3]| {
        let ratio = |colour: f32, least: f32| {
            let ratio = if green > 0.0 { colour / green } else { 1.0 };
            (255.0 * (ratio - least)).round().clamp(0.0, 255.0) as u8
        };
        [ratio(red, LEAST_RATIO[0]), ratio(blue, LEAST_RATIO[1]), 0, 255]
    };
    let texels: Vec<[u8; 4]> = albedo.values.par_iter().map(texel).collect();
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let size = [albedo.size, albedo.size];
    texture(gpu, "colours of the ground", size, format, bytemuck::cast_slice(&texels))
}

/// What is scattered once and often, and what directions make of them.
pub fn ground_textures(gpu: &Gpu, ground: &Ground) -> [wgpu::TextureView; 3] {
    let half = |value: f64| f16::from_f64(value).to_bits();
    let cells = |label, cells: &[[f64; 3]]| {
        let texels: Vec<u16> =
            cells.iter().flat_map(|&[r, g, b]| [r, g, b, 0.0].map(half)).collect();
        let (width, height) = ground.size;
        let format = wgpu::TextureFormat::Rgba16Float;
        texture(gpu, label, [width, height], format, bytemuck::cast_slice(&texels))
    };
    let by_directions: Vec<u16> = ground.by_directions.iter().flatten().map(|&v| half(v)).collect();
    let size = [Ground::NODES, Ground::NODES];
    let format = wgpu::TextureFormat::Rg16Float;
    [
        cells("scattered once", &ground.once),
        cells("scattered often", &ground.often),
        texture(gpu, "by directions", size, format, bytemuck::cast_slice(&by_directions)),
    ]
}

pub fn shadows_texture(gpu: &Gpu, shadows: &Shadows) -> wgpu::TextureView {
    let texels: Vec<u8> =
        shadows.sunlit.iter().map(|share| (255.0 * share).round() as u8).collect();
    let size = [shadows.columns, shadows.rows];
    texture(gpu, "shadows", size, wgpu::TextureFormat::R8Unorm, &texels)
}

pub fn umbra_texture(gpu: &Gpu, shadow: Option<&UmbraTable>) -> wgpu::TextureView {
    let texels: Vec<u16> = match shadow {
        Some(table) => {
            let texel = |&[r, g, b]: &[f64; 3]| [r, g, b, 0.0].map(|v| f16::from_f64(v).to_bits());
            table.shares.iter().flat_map(texel).collect()
        }
        // A binding cannot be empty; without an eclipse nothing reads it.
        None => vec![0; 4],
    };
    let format = wgpu::TextureFormat::Rgba16Float;
    let size = [texels.len() / 4, 1];
    texture(gpu, "shadow of the Earth", size, format, bytemuck::cast_slice(&texels))
}

/// The limb, in units of `OUTLINE_UNIT` of `shaders/lib/globe.wgsl` over the mean radius.
pub fn outline_texture(gpu: &Gpu, limb: &Limb) -> wgpu::TextureView {
    let texel = |over: &f64| f16::from_f64(over / OUTLINE_UNIT).to_bits();
    let texels: Vec<u16> = limb.over_mean.iter().map(texel).collect();
    let format = wgpu::TextureFormat::R16Float;
    texture(gpu, "outline", [texels.len(), 1], format, bytemuck::cast_slice(&texels))
}

fn texture(
    gpu: &Gpu,
    label: &str,
    [width, height]: [usize; 2],
    format: wgpu::TextureFormat,
    bytes: &[u8],
) -> wgpu::TextureView {
    let [width, height] = [width as u32, height as u32];
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    gpu.texture_of(label, size, format, bytes).create_view(&Default::default())
}

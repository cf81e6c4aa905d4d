//! The light of stars that are not drawn one by one, over the sky.
//!
//! The picture is cut into tiles. Their corners know where they look in the galaxy and what the air
//! lets through; between them both are straight, and each pixel reads the map for itself. Tiles are
//! small where the air dims fast, near the horizon, and where the projection bends.

use std::sync::{Arc, Mutex};

use half::f16;
use rayon::prelude::*;

use crate::camera::Camera;
use crate::catalog::milky_way::MilkyWay;
use crate::frame::{Apparent, Rot, View};
use crate::plan::milky_way::{MilkyWayPlan, MilkyWaySight};
use crate::units::Angle;

use super::gpu::Gpu;
use super::shaders;
use super::sky_tiles::{LARGEST_PX, SMALLEST_PX, SkyTiles};
use super::target::Target;
use super::uniforms::MilkyWayCorner;

/// A tile spans no more than this.
const WIDEST: Angle = Angle::from_deg(5.0);
/// A tile spans no more than this share of its height over the horizon.
const OF_HEIGHT: f64 = 0.4;

pub struct MilkyWayPass {
    pipeline: wgpu::RenderPipeline,
    across_map: wgpu::Sampler,
    /// The map that was drawn last, by where its texels are.
    kept: Mutex<Option<(Arc<MilkyWay>, wgpu::TextureView)>>,
}

impl MilkyWayPass {
    pub fn new(gpu: &Gpu) -> MilkyWayPass {
        let corner = wgpu::VertexBufferLayout {
            array_stride: size_of::<MilkyWayCorner>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![
                0 => Float32x2, 1 => Float32x3, 2 => Float32x4, 3 => Float32x4, 4 => Float32
            ],
        };
        MilkyWayPass {
            pipeline: gpu.pipeline(
                "Milky Way",
                &shaders::assembled("milky-way"),
                ["vertex", "fragment"],
                wgpu::PrimitiveTopology::TriangleList,
                &[Some(corner)],
            ),
            across_map: gpu.linear_sampler(wgpu::AddressMode::ClampToEdge),
            kept: Mutex::new(None),
        }
    }

    /// Adds its light to the frame.
    pub fn draw(&self, frame: &mut Target, plan: &MilkyWayPlan, camera: &Camera) {
        let gpu = frame.gpu;
        let cutter =
            Cutter { plan, camera, apparent_from_view: camera.view_from_apparent().inverse() };
        let (corners, indices) = cutter.tiles().shared_corners(camera);
        if indices.is_empty() {
            return;
        }
        let corners: Vec<MilkyWayCorner> =
            corners.par_iter().map(|corner| cutter.corner(*corner)).collect();
        let (vertex, index) = (wgpu::BufferUsages::VERTEX, wgpu::BufferUsages::INDEX);
        let corners = gpu.buffer("corners", bytemuck::cast_slice(&corners), vertex);
        let tiles = gpu.buffer("tiles", bytemuck::cast_slice(&indices), index);
        let map = self.map(gpu, plan.starlight.map());
        let group = gpu.bind_mixed(
            &self.pipeline.get_bind_group_layout(0),
            &[
                (0, frame.camera.as_entire_binding()),
                (1, wgpu::BindingResource::TextureView(&map)),
                (2, wgpu::BindingResource::Sampler(&self.across_map)),
            ],
        );
        frame.pass("Milky Way", |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, corners.slice(..));
            pass.set_index_buffer(tiles.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..indices.len() as u32, 0, 0..1);
        });
    }

    /// The map as a texture, made once.
    fn map(&self, gpu: &Gpu, map: &Arc<MilkyWay>) -> wgpu::TextureView {
        // A poisoned lock holds a whole map or none.
        let mut kept = self.kept.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        match &*kept {
            Some((known, view)) if Arc::ptr_eq(known, map) => view.clone(),
            _ => {
                let view = texture(gpu, map);
                *kept = Some((map.clone(), view.clone()));
                view
            }
        }
    }
}

/// The map with its border.
fn texture(gpu: &Gpu, map: &MilkyWay) -> wgpu::TextureView {
    let inside = map.size();
    let size = inside + 2;
    let mut texels = vec![[0u16; 2]; size * size];
    texels.par_chunks_mut(size).enumerate().for_each(|(row, texels)| {
        for (column, texel) in texels.iter_mut().enumerate() {
            let [s10, colour] = map.texels()[place(row, column, inside)];
            let parts = [s10 * (1.0 - colour), s10 * colour];
            *texel = parts.map(|part| f16::from_f32(part).to_bits());
        }
    });
    let extent =
        wgpu::Extent3d { width: size as u32, height: size as u32, depth_or_array_layers: 1 };
    let format = wgpu::TextureFormat::Rg16Float;
    let texture = gpu.texture_of("Milky Way", extent, format, bytemuck::cast_slice(&texels));
    texture.create_view(&Default::default())
}

/// The texel of the map for a place in the texture: across an edge of the octahedron, that edge goes on
/// the other way round.
fn place(row: usize, column: usize, size: usize) -> usize {
    let last = size - 1;
    let (mut y, mut x) = (row.saturating_sub(1).min(last), column.saturating_sub(1).min(last));
    if row == 0 || row == size + 1 {
        x = last - x;
    }
    if column == 0 || column == size + 1 {
        y = last - y;
    }
    y * size + x
}

struct Cutter<'a> {
    plan: &'a MilkyWayPlan,
    camera: &'a Camera,
    apparent_from_view: Rot<Apparent, View>,
}

impl Cutter<'_> {
    fn tiles(&self) -> SkyTiles {
        let (columns, rows) =
            (self.camera.width_px.div_ceil(LARGEST_PX), self.camera.height_px.div_ceil(LARGEST_PX));
        let blocks: Vec<Vec<[u32; 4]>> = (0..columns * rows)
            .into_par_iter()
            .map(|block| {
                let mut tiles = Vec::new();
                let first = [block % columns, block / columns].map(|place| place * LARGEST_PX);
                self.cut(first, LARGEST_PX, &mut tiles);
                tiles
            })
            .collect();
        SkyTiles { smooth: blocks.concat(), exact: Vec::new() }
    }

    fn cut(&self, [x, y]: [u32; 2], edge: u32, tiles: &mut Vec<[u32; 4]>) {
        if x >= self.camera.width_px || y >= self.camera.height_px {
            return;
        }
        let half = edge / 2;
        let corners = [[x, y], [x + edge, y], [x, y + edge], [x + edge, y + edge]];
        let seen = corners.map(|[x, y]| self.see([f64::from(x), f64::from(y)]));
        let middle = self.see([f64::from(x + half), f64::from(y + half)]);
        let is_coarse = match (middle, seen) {
            (Some(middle), [Some(a), Some(b), Some(c), Some(d)]) => {
                let reach = [a, b, c, d].map(|corner| middle.separation(corner).rad());
                let reach = Angle::from_rad(reach.into_iter().fold(0.0, f64::max));
                let over = middle.altitude() - self.plan.horizon();
                if over < -reach {
                    return;
                }
                reach * 2.0 > WIDEST || reach * 2.0 > over.abs() * OF_HEIGHT
            }
            // At the edge of the sky.
            _ => true,
        };
        if is_coarse && edge > SMALLEST_PX {
            for part in [[x, y], [x + half, y], [x, y + half], [x + half, y + half]] {
                self.cut(part, half, tiles);
            }
        } else if middle.is_some() || seen.iter().any(Option::is_some) {
            tiles.push([x, y, x + edge, y + edge]);
        }
    }

    fn see(&self, pixel: [f64; 2]) -> Option<crate::frame::Dir<Apparent>> {
        Some(self.apparent_from_view * self.camera.view_from_pixel(pixel)?)
    }

    /// A corner; black where there is no sky.
    fn corner(&self, corner: [u32; 2]) -> MilkyWayCorner {
        let pixel = corner.map(f64::from);
        let sight = self.see(pixel).and_then(|dir| Some((dir, self.plan.sight(dir)?)));
        let Some((dir, MilkyWaySight { dir: galactic, of_one_s10: [blue, red] })) = sight else {
            return MilkyWayCorner::black(pixel);
        };
        let over = (dir.altitude() - self.plan.horizon()) / self.camera.pixel_angle().rad();
        MilkyWayCorner {
            pixel: pixel.map(|v| v as f32),
            dir: galactic.vector().as_vec3().to_array(),
            blue: blue.to_f32(),
            red: red.to_f32(),
            over: over.rad() as f32,
        }
    }
}

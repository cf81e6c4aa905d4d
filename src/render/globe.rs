//! The Moon's globe on a picture of its own: maps kept on the GPU, a mesh, its mean light.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::plan::globe::{EXTENT, Globe};

use super::globe_maps::{
    NearSideMaps, ground_textures, outline_texture, shadows_texture, umbra_texture,
};
use super::gpu::{Binding, Gpu};
use super::shaders;
use super::target::Target;
use super::uniforms::{GlobeUniform, MeanUniform, MeshBandUniform};

const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Pixels that a group sums along each axis.
const TILE_PX: u32 = 64;

/// What lights a part of the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Light {
    Earth,
    LowSun,
    HighSun,
    /// The Sun beside the Earth.
    Eclipsed,
}

/// What `shaders/globe.wgsl` binds.
const BINDINGS: [Binding; 11] = [
    Binding::Uniform,
    Binding::Storage,
    Binding::Texture,
    Binding::Texture,
    Binding::Sampler,
    Binding::Texture,
    Binding::Texture,
    Binding::Texture,
    Binding::Sampler,
    Binding::Texture,
    Binding::Texture,
];

pub struct GlobePass {
    layout: wgpu::BindGroupLayout,
    /// By what lights the ground, each made when it is first drawn.
    pipelines: [OnceLock<wgpu::RenderPipeline>; 4],
    sum_tile: wgpu::ComputePipeline,
    sum_all: wgpu::ComputePipeline,
    across: wgpu::Sampler,
    pub around: wgpu::Sampler,
    last: Mutex<Option<Last>>,
}

/// The last globe that was drawn, and its maps.
struct Last {
    globe: Arc<Globe>,
    maps: NearSideMaps,
    picture: GlobePicture,
}

/// A globe that was drawn.
#[derive(Clone)]
pub struct GlobePicture {
    pub view: wgpu::TextureView,
    /// The mean of its light over a disc of radius one.
    pub mean: wgpu::Buffer,
    pub outline: wgpu::TextureView,
}

impl GlobePass {
    pub fn new(gpu: &Gpu) -> GlobePass {
        let mean = shaders::assembled("globe-mean");
        GlobePass {
            layout: gpu.layout(&BINDINGS),
            pipelines: Default::default(),
            sum_tile: gpu.compute_pipeline("sum_tile", &mean),
            sum_all: gpu.compute_pipeline("sum_all", &mean),
            across: gpu.linear_sampler(wgpu::AddressMode::ClampToEdge),
            around: gpu.linear_sampler(wgpu::AddressMode::Repeat),
            last: Mutex::new(None),
        }
    }

    fn pipeline(&self, gpu: &Gpu, light: Light) -> &wgpu::RenderPipeline {
        self.pipelines[light as usize].get_or_init(|| {
            let source = shaders::assembled("globe");
            let has = |name, yes| (name, f64::from(u8::from(yes)));
            let constants = [
                has("SUN", light != Light::Earth),
                has("SHADOWS", matches!(light, Light::LowSun | Light::Eclipsed)),
                has("ECLIPSE", light == Light::Eclipsed),
            ];
            gpu.picture_pipeline("globe", &source, &self.layout, &constants, PICTURE_FORMAT)
        })
    }

    /// The picture of a globe; drawn unless it was the last one.
    pub fn picture(&self, frame: &mut Target, globe: &Arc<Globe>) -> GlobePicture {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(last) = last.as_ref().filter(|last| Arc::ptr_eq(&last.globe, globe)) {
            return last.picture.clone();
        }
        let are_same = |last: &&Last| {
            Arc::ptr_eq(&last.globe.relief, &globe.relief)
                && Arc::ptr_eq(&last.globe.albedo, &globe.albedo)
        };
        let maps = match last.as_ref().filter(are_same) {
            Some(last) => last.maps.clone(),
            None => NearSideMaps::new(frame.gpu, &globe.relief, &globe.albedo),
        };
        let picture = self.draw(frame, globe, &maps);
        let drawn = Last { globe: Arc::clone(globe), maps, picture: picture.clone() };
        *last = Some(drawn);
        picture
    }

    fn draw(&self, frame: &mut Target, globe: &Globe, maps: &NearSideMaps) -> GlobePicture {
        let gpu = frame.gpu;
        let px = globe.view.picture_px;
        let size = wgpu::Extent3d { width: px, height: px, depth_or_array_layers: 1 };
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT;
        let picture = gpu.texture("globe", size, PICTURE_FORMAT, usage);
        let picture = picture.create_view(&Default::default());
        let uniform = GlobeUniform::of(globe);
        let usage = wgpu::BufferUsages::UNIFORM;
        let uniform = gpu.buffer("globe", bytemuck::bytes_of(&uniform), usage);
        let [once, often, by_directions] = ground_textures(gpu, &globe.ground);
        let shadows = shadows_texture(gpu, &globe.shadows);
        let umbra = umbra_texture(gpu, globe.view.shadow.as_ref());
        let mut draws = Vec::new();
        for (band, parts) in globe.parted_mesh() {
            let buffer = storage(gpu, "band", bytemuck::bytes_of(&MeshBandUniform::of(&band)));
            let resources = [
                uniform.as_entire_binding(),
                buffer.as_entire_binding(),
                wgpu::BindingResource::TextureView(&maps.relief),
                wgpu::BindingResource::TextureView(&maps.colours),
                wgpu::BindingResource::Sampler(&self.across),
                wgpu::BindingResource::TextureView(&shadows),
                wgpu::BindingResource::TextureView(&once),
                wgpu::BindingResource::TextureView(&often),
                wgpu::BindingResource::Sampler(&self.around),
                wgpu::BindingResource::TextureView(&by_directions),
                wgpu::BindingResource::TextureView(&umbra),
            ];
            let resources: Vec<_> = (0..).zip(resources).collect();
            let group = gpu.bind_mixed(&self.layout, &resources);
            let sun =
                |light: Light| if globe.view.shadow.is_some() { Light::Eclipsed } else { light };
            for (light, part) in [
                (Light::Earth, parts.dark),
                (sun(Light::LowSun), parts.low_sun),
                (sun(Light::HighSun), parts.high_sun),
            ] {
                if !part.is_empty() {
                    let usage = wgpu::BufferUsages::INDEX;
                    let corners = gpu.buffer("mesh", bytemuck::cast_slice(&part), usage);
                    draws.push((self.pipeline(gpu, light), group.clone(), corners, part.len()));
                }
            }
        }
        frame.picture_pass("globe", &[&picture], |pass| {
            for (pipeline, group, corners, count) in &draws {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, group, &[]);
                pass.set_index_buffer(corners.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..*count as u32, 0, 0..1);
            }
        });
        let outline = outline_texture(gpu, &globe.limb);
        let mean = self.mean(frame, globe, &picture, &outline);
        GlobePicture { view: picture, mean, outline }
    }

    fn mean(
        &self,
        frame: &mut Target,
        globe: &Globe,
        picture: &wgpu::TextureView,
        outline: &wgpu::TextureView,
    ) -> wgpu::Buffer {
        let gpu = frame.gpu;
        let tiles = globe.view.picture_px.div_ceil(TILE_PX);
        let pixel = 2.0 * EXTENT / f64::from(globe.view.picture_px);
        let share = pixel * pixel / std::f64::consts::PI;
        let uniform = MeanUniform { pixel_share: share as f32, tiles: tiles * tiles };
        let uniform = storage(gpu, "mean", bytemuck::bytes_of(&uniform));
        let sums = vec![[0.0f32; 4]; (tiles * tiles) as usize];
        let sums = storage(gpu, "sums of tiles", bytemuck::cast_slice(&sums));
        let result = storage(gpu, "mean light of the globe", bytemuck::bytes_of(&[0.0f32; 4]));
        let tile = gpu.bind_mixed(
            &self.sum_tile.get_bind_group_layout(0),
            &[
                (0, wgpu::BindingResource::TextureView(picture)),
                (2, sums.as_entire_binding()),
                (4, wgpu::BindingResource::TextureView(outline)),
                (5, wgpu::BindingResource::Sampler(&self.around)),
            ],
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
}

fn storage(gpu: &Gpu, label: &str, bytes: &[u8]) -> wgpu::Buffer {
    gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE)
}

//! Pictures that stay on the device, with lines on them, laid on a window.

use bytemuck::{Pod, Zeroable};

use super::gpu::{Gpu, Stage};
use super::shaders;

/// Codes, 8 bits each.
const CODES: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Lays pictures on windows of one format.
pub struct WindowPass {
    pipeline: wgpu::RenderPipeline,
    /// Pixel by pixel.
    nearest: wgpu::Sampler,
    /// Smoothly, for pictures of another size.
    smooth: wgpu::Sampler,
}

/// Puts lines on pictures: once for a picture, not in each frame of the window.
pub struct LinePass {
    under: WindowPass,
    pipeline: wgpu::RenderPipeline,
    /// The picture with lines, of the last size.
    kept: Option<wgpu::Texture>,
}

/// A corner of a triangle of lines, as windows have them.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct LineCorner {
    /// Where it is, points of the window.
    pub point: [f32; 2],
    /// Not used: lines have no texture.
    pub texture: [f32; 2],
    /// Codes of red, green and blue, multiplied with the opacity, and the opacity.
    pub colour: [u8; 4],
}

/// Lines, and how they lie on a picture.
#[derive(Debug, Clone, Copy)]
pub struct Lines<'a> {
    pub corners: &'a [LineCorner],
    /// Three for a triangle.
    pub indices: &'a [u32],
    /// Where the picture lies on the window: its left and top edge, its width and height, points.
    pub place: [f32; 4],
}

impl LinePass {
    pub fn new(gpu: &Gpu) -> LinePass {
        let module = gpu.module("lines", &shaders::assembled("lines"));
        let buffer = wgpu::VertexBufferLayout {
            array_stride: size_of::<LineCorner>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &[
                wgpu::VertexAttribute {
                    format: wgpu::VertexFormat::Float32x2,
                    offset: 0,
                    shader_location: 0,
                },
                wgpu::VertexAttribute {
                    format: wgpu::VertexFormat::Unorm8x4,
                    offset: 16,
                    shader_location: 1,
                },
            ],
        };
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("lines"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(buffer)],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: CODES,
                    blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        LinePass { under: WindowPass::new(gpu, CODES), pipeline, kept: None }
    }

    /// A picture in codes with lines on it. It is drawn over by the next.
    pub fn picture(
        &mut self,
        gpu: &Gpu,
        codes: &wgpu::TextureView,
        [width, height]: [u32; 2],
        lines: &Lines,
    ) -> wgpu::TextureView {
        let fits = |texture: &wgpu::Texture| [texture.width(), texture.height()] == [width, height];
        let texture = self.kept.take().filter(fits).unwrap_or_else(|| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("picture with lines"),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: CODES,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                    | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            })
        });
        let view = texture.create_view(&Default::default());
        self.kept = Some(texture);
        let [left, top, points_wide, points_high] = lines.place;
        let place = [left, top, 2.0 / points_wide.max(1e-3), 2.0 / points_high.max(1e-3)];
        let place = gpu.buffer("place", bytemuck::bytes_of(&place), wgpu::BufferUsages::UNIFORM);
        let corners =
            gpu.buffer("lines", bytemuck::cast_slice(lines.corners), wgpu::BufferUsages::VERTEX);
        let indices =
            gpu.buffer("lines", bytemuck::cast_slice(lines.indices), wgpu::BufferUsages::INDEX);
        let group = gpu.bind(&self.pipeline.get_bind_group_layout(0), &[(0, &place)]);
        let under = self.under.picture(gpu, codes, true);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("lines"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        under.draw(&mut pass);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.set_vertex_buffer(0, corners.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..lines.indices.len() as u32, 0, 0..1);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
        view
    }
}

/// A picture, ready to be laid on a window.
pub struct OnWindow {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
}

impl WindowPass {
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> WindowPass {
        let sampler = |filter| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: filter,
                min_filter: filter,
                ..Default::default()
            })
        };
        let takes_light = f64::from(u8::from(format.is_srgb()));
        WindowPass {
            pipeline: gpu.chain_pipeline(&Stage {
                label: "window",
                source: shaders::assembled("window"),
                entries: ["vertex", "fragment"],
                constants: &[("TAKES_LIGHT", takes_light)],
                targets: &[format],
                buffers: &[],
                adds: false,
            }),
            nearest: sampler(wgpu::FilterMode::Nearest),
            smooth: sampler(wgpu::FilterMode::Linear),
        }
    }

    /// Binds a picture in codes; `fits` if it has the size of its place.
    pub fn picture(&self, gpu: &Gpu, codes: &wgpu::TextureView, fits: bool) -> OnWindow {
        let sampler = if fits { &self.nearest } else { &self.smooth };
        let resources = [
            (0, wgpu::BindingResource::TextureView(codes)),
            (1, wgpu::BindingResource::Sampler(sampler)),
        ];
        let layout = self.pipeline.get_bind_group_layout(0);
        OnWindow { pipeline: self.pipeline.clone(), group: gpu.bind_mixed(&layout, &resources) }
    }
}

impl OnWindow {
    /// Fills the viewport of a pass.
    pub fn draw(&self, pass: &mut wgpu::RenderPass) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }
}

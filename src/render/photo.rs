//! The picture of a camera: one pass over the finished frame.

use crate::display::Display;
use crate::image::{HdrFrame, Image};
use crate::photo::Curve;
use crate::photo::exposure::Exposure;

use super::gpu::{FRAME_FORMAT, Gpu, GpuError};
use super::shaders;
use super::target::read_buffer;
use super::uniforms::{PhotoUniform, display_constants};

/// Codes of 8 bits.
pub const CODE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// What a pipeline is made for; another needs another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhotoKind {
    format: wgpu::TextureFormat,
    constants: [(&'static str, f64); 5],
}

impl PhotoKind {
    /// For a target of [`CODE_FORMAT`], rounded and dithered, or of 32-bit floats, neither.
    pub fn of(format: wgpu::TextureFormat, exposure: &Exposure, display: &Display) -> PhotoKind {
        let is = |truth: bool| f64::from(u8::from(truth));
        let [encoded, steps] = display_constants(display, format != CODE_FORMAT);
        let noisy = ("IS_NOISY", is(exposure.noise));
        let film = ("IS_FILM", is(exposure.curve == Curve::Film));
        let red = ("IS_RED", is(display.red));
        PhotoKind { format, constants: [encoded, steps, noisy, film, red] }
    }
}

/// The pipeline.
pub struct PhotoPass {
    kind: PhotoKind,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    nearest: wgpu::Sampler,
}

impl PhotoPass {
    pub fn new(gpu: &Gpu, kind: PhotoKind) -> PhotoPass {
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty,
            count: None,
        };
        let uniform = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let frame = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let nearest = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering);
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("photo"),
            entries: &[entry(0, uniform), entry(1, frame), entry(2, nearest)],
        });
        let source = shaders::assembled("photo");
        let pipeline =
            gpu.picture_pipeline("photo", &source, &layout, &kind.constants, kind.format);
        let nearest = gpu.device.create_sampler(&wgpu::SamplerDescriptor::default());
        PhotoPass { kind, layout, pipeline, nearest }
    }

    /// What it was made for.
    pub fn kind(&self) -> PhotoKind {
        self.kind
    }

    /// Records the pass: from a view of the frame to a view of a target of its size.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        frame: &wgpu::TextureView,
        (exposure, display): (&Exposure, &Display),
        times: Option<wgpu::RenderPassTimestampWrites>,
    ) {
        let uniform = PhotoUniform::of(exposure, display);
        let setting =
            gpu.buffer("photo", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let group = gpu.bind_mixed(
            &self.layout,
            &[
                (0, setting.as_entire_binding()),
                (1, wgpu::BindingResource::TextureView(frame)),
                (2, wgpu::BindingResource::Sampler(&self.nearest)),
            ],
        );
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("photo"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            timestamp_writes: times,
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// The picture of a frame in memory, 8 bits a channel.
pub fn coded(
    gpu: &Gpu,
    frame: &HdrFrame,
    exposure: &Exposure,
    display: &Display,
) -> Result<Image<[u8; 3]>, GpuError> {
    let codes: Image<[u8; 4]> = recorded(gpu, frame, CODE_FORMAT, exposure, display)?;
    Ok(codes.map(|[r, g, b, _]| [r, g, b]))
}

/// The same in 32-bit floats, 0 to 1, for deep pictures.
pub fn deep(
    gpu: &Gpu,
    frame: &HdrFrame,
    exposure: &Exposure,
    display: &Display,
) -> Result<Image<[f32; 4]>, GpuError> {
    recorded(gpu, frame, FRAME_FORMAT, exposure, display)
}

/// Takes a frame to the GPU and the picture back.
fn recorded<P: Copy + Default + bytemuck::Pod>(
    gpu: &Gpu,
    frame: &HdrFrame,
    format: wgpu::TextureFormat,
    exposure: &Exposure,
    display: &Display,
) -> Result<Image<P>, GpuError> {
    let (width_px, height_px) = (frame.width_px(), frame.height_px());
    let limit = gpu.device.limits().max_texture_dimension_2d;
    if width_px.max(height_px) > limit {
        return Err(GpuError::TooLarge { width_px, height_px, limit });
    }
    let size = wgpu::Extent3d { width: width_px, height: height_px, depth_or_array_layers: 1 };
    let light = gpu.texture_of("frame", size, FRAME_FORMAT, bytemuck::cast_slice(frame.pixels()));
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
    let target = gpu.texture("photo", size, format, usage);
    let row =
        (width_px * size_of::<P>() as u32).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("photo"),
        size: u64::from(row) * u64::from(height_px),
        usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let [to, from] = [&target, &light].map(|texture| texture.create_view(&Default::default()));
    let pass = PhotoPass::new(gpu, PhotoKind::of(format, exposure, display));
    pass.draw(gpu, &mut encoder, &to, &from, (exposure, display), None);
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    let into = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(target.as_image_copy(), into, size);
    let bytes = read_buffer(gpu, encoder, &buffer)?;
    let mut picture = Image::filled(width_px, height_px, P::default());
    let lines = picture.pixels_mut().chunks_exact_mut(width_px as usize);
    for (pixels, line) in lines.zip(bytes.chunks(row as usize)) {
        let line = &line[..size_of_val(pixels)];
        bytemuck::cast_slice_mut::<P, u8>(pixels).copy_from_slice(line);
    }
    Ok(picture)
}

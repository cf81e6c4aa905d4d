//! The frame while it is drawn: its texture, its passes in order, and the way back to memory.

use crate::camera::Camera;
use crate::image::{HdrFrame, Image};

use super::gpu::{FRAME_FORMAT, Gpu, GpuError, PassTime};
use super::uniforms::CameraUniform;

/// The frame comes back in bands of at most this size.
const BAND_BYTES: u64 = 64 << 20;
/// Passes that can be timed in one frame.
const TIMED_PASSES: u32 = 64;

/// A frame being drawn.
pub struct Target<'g> {
    pub gpu: &'g Gpu,
    pub camera: wgpu::Buffer,
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    encoder: wgpu::CommandEncoder,
    stamps: Option<wgpu::QuerySet>,
    passes: Vec<String>,
    /// Whether anything was drawn on the frame.
    is_lit: bool,
}

/// A frame that is drawn, still on the device.
pub struct Finished {
    pub frame: wgpu::Texture,
    /// By pass; empty when the adapter keeps no time.
    pub times: Vec<PassTime>,
}

impl<'g> Target<'g> {
    /// A black frame.
    pub fn new(gpu: &'g Gpu, camera: &Camera) -> Result<Target<'g>, GpuError> {
        Target::on(gpu, camera, None)
    }

    /// A black frame on the texture of one before, if it has the same size.
    pub fn on(
        gpu: &'g Gpu,
        camera: &Camera,
        before: Option<wgpu::Texture>,
    ) -> Result<Target<'g>, GpuError> {
        let (width_px, height_px) = (camera.width_px, camera.height_px);
        let limit = gpu.device.limits().max_texture_dimension_2d;
        if width_px.max(height_px) > limit {
            return Err(GpuError::TooLarge { width_px, height_px, limit });
        }
        let fits =
            |texture: &wgpu::Texture| [texture.width(), texture.height()] == [width_px, height_px];
        let texture = before.filter(fits).unwrap_or_else(|| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("frame"),
                size: wgpu::Extent3d {
                    width: width_px,
                    height: height_px,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: FRAME_FORMAT,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                    | wgpu::TextureUsages::COPY_SRC
                    | wgpu::TextureUsages::COPY_DST
                    | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            })
        });
        let stamps = gpu.keeps_time().then(|| {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("pass times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * TIMED_PASSES,
            })
        });
        let uniform = CameraUniform::of(camera);
        Ok(Target {
            camera: gpu.buffer("camera", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::STORAGE),
            view: texture.create_view(&Default::default()),
            texture,
            encoder: gpu.device.create_command_encoder(&Default::default()),
            stamps,
            passes: Vec::new(),
            is_lit: false,
            gpu,
        })
    }

    /// A frame that is there already.
    pub fn of_frame(
        gpu: &'g Gpu,
        camera: &Camera,
        frame: &HdrFrame,
    ) -> Result<Target<'g>, GpuError> {
        let (width_px, height_px) = (frame.width_px(), frame.height_px());
        let mut target = Target::new(gpu, &Camera { width_px, height_px, ..*camera })?;
        target.is_lit = true;
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width_px * size_of::<[f32; 4]>() as u32),
            rows_per_image: None,
        };
        let texels = bytemuck::cast_slice(frame.pixels());
        let place = target.texture.as_image_copy();
        gpu.queue.write_texture(place, texels, layout, target.texture.size());
        Ok(target)
    }

    /// Records one pass over the frame. The first one finds it black.
    pub fn pass(&mut self, label: &str, draw: impl FnOnce(&mut wgpu::RenderPass)) {
        let load = match std::mem::replace(&mut self.is_lit, true) {
            false => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
            true => wgpu::LoadOp::Load,
        };
        let view = self.view.clone();
        self.record(label, &[&view], load, draw);
    }

    /// Records a pass over pictures beside the frame, black and empty at first.
    pub fn picture_pass(
        &mut self,
        label: &str,
        pictures: &[&wgpu::TextureView],
        draw: impl FnOnce(&mut wgpu::RenderPass),
    ) {
        self.record(label, pictures, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), draw);
    }

    /// Records a pass that adds to a picture beside the frame.
    pub fn adding_pass(
        &mut self,
        label: &str,
        picture: &wgpu::TextureView,
        draw: impl FnOnce(&mut wgpu::RenderPass),
    ) {
        self.record(label, &[picture], wgpu::LoadOp::Load, draw);
    }

    fn record(
        &mut self,
        label: &str,
        pictures: &[&wgpu::TextureView],
        load: wgpu::LoadOp<wgpu::Color>,
        draw: impl FnOnce(&mut wgpu::RenderPass),
    ) {
        let number = self.passes.len() as u32;
        let attachment = |&view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })
        };
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: &pictures.iter().map(attachment).collect::<Vec<_>>(),
            timestamp_writes: stamps(self.stamps.as_ref(), number),
            ..Default::default()
        });
        draw(&mut pass);
        drop(pass);
        self.passes.push(label.to_owned());
    }

    /// Records computations between passes.
    pub fn compute(&mut self, label: &str, dispatch: impl FnOnce(&mut wgpu::ComputePass)) {
        let number = self.passes.len() as u32;
        let mut pass = self.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(label),
            timestamp_writes: stamps(self.stamps.as_ref(), number).map(|stamps| {
                wgpu::ComputePassTimestampWrites {
                    query_set: stamps.query_set,
                    beginning_of_pass_write_index: stamps.beginning_of_pass_write_index,
                    end_of_pass_write_index: stamps.end_of_pass_write_index,
                }
            }),
        });
        dispatch(&mut pass);
        drop(pass);
        self.passes.push(label.to_owned());
    }

    /// A bind group of pass resources, the camera first.
    pub fn bind(
        &self,
        pipeline: &wgpu::RenderPipeline,
        buffers: &[&wgpu::Buffer],
    ) -> wgpu::BindGroup {
        let buffers = std::iter::once(&self.camera).chain(buffers.iter().copied());
        let buffers: Vec<_> = (0..).zip(buffers).collect();
        self.gpu.bind(&pipeline.get_bind_group_layout(0), &buffers)
    }

    /// The frame, to be read by passes beside it.
    pub fn view(&self) -> wgpu::TextureView {
        self.view.clone()
    }

    /// Has what is recorded so far begun.
    pub fn submit(&mut self) {
        let next = self.gpu.device.create_command_encoder(&Default::default());
        let recorded = std::mem::replace(&mut self.encoder, next);
        self.gpu.queue.submit([recorded.finish()]);
    }

    /// Draws everything recorded so far and brings the frame back.
    pub fn read(&mut self) -> Result<HdrFrame, GpuError> {
        self.submit();
        read_back(self.gpu, &self.texture)
    }

    /// Draws everything recorded and says what it cost.
    pub fn finish(mut self) -> Result<Finished, GpuError> {
        let stamps = self.resolve_stamps();
        self.gpu.queue.submit([self.encoder.finish()]);
        let times = match stamps {
            Some(buffer) => pass_times(self.gpu, &buffer, &self.passes)?,
            None => Vec::new(),
        };
        Ok(Finished { frame: self.texture, times })
    }

    /// Has the time stamps of the passes copied to a buffer that can be read.
    fn resolve_stamps(&mut self) -> Option<wgpu::Buffer> {
        let stamps = self.stamps.as_ref()?;
        let count = 2 * (self.passes.len() as u32).min(TIMED_PASSES);
        let size = u64::from(count) * 8;
        let resolved = self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("pass times"),
            size,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        self.encoder.resolve_query_set(stamps, 0..count, &resolved, 0);
        let readable = readable_buffer(self.gpu, size);
        self.encoder.copy_buffer_to_buffer(&resolved, 0, &readable, 0, size);
        Some(readable)
    }
}

/// Where the times of a pass go.
fn stamps(
    query_set: Option<&wgpu::QuerySet>,
    number: u32,
) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
    query_set.filter(|_| number < TIMED_PASSES).map(|query_set| wgpu::RenderPassTimestampWrites {
        query_set,
        beginning_of_pass_write_index: Some(2 * number),
        end_of_pass_write_index: Some(2 * number + 1),
    })
}

fn readable_buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read-back"),
        size,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Has the commands done and hands over the bytes of a buffer that they filled.
pub fn read_buffer(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    buffer: &wgpu::Buffer,
) -> Result<Vec<u8>, GpuError> {
    let readable = readable_buffer(gpu, buffer.size());
    encoder.copy_buffer_to_buffer(buffer, 0, &readable, 0, buffer.size());
    gpu.queue.submit([encoder.finish()]);
    with_bytes(gpu, &readable, |bytes| bytes.to_vec())
}

/// Waits for a buffer and hands its bytes over.
fn with_bytes<T>(
    gpu: &Gpu,
    buffer: &wgpu::Buffer,
    use_bytes: impl FnOnce(&[u8]) -> T,
) -> Result<T, GpuError> {
    let lost = |error: &dyn std::fmt::Display| GpuError::Lost(error.to_string());
    let (sender, receiver) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver waits below; if it is gone, nobody wants the answer.
        let _ = sender.send(result);
    });
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| lost(&e))?;
    receiver.recv().map_err(|e| lost(&e))?.map_err(|e| lost(&e))?;
    let view = buffer.get_mapped_range(..).map_err(|e| lost(&e))?;
    let result = use_bytes(&view);
    drop(view);
    buffer.unmap();
    Ok(result)
}

fn pass_times(
    gpu: &Gpu,
    buffer: &wgpu::Buffer,
    passes: &[String],
) -> Result<Vec<PassTime>, GpuError> {
    let nanoseconds_per_tick = f64::from(gpu.queue.get_timestamp_period());
    with_bytes(gpu, buffer, |bytes| {
        let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(bytes);
        stamps
            .chunks_exact(2)
            .zip(passes)
            .map(|(pair, pass)| PassTime {
                pass: pass.clone(),
                milliseconds: pair[1].saturating_sub(pair[0]) as f64 * nanoseconds_per_tick / 1e6,
            })
            .collect()
    })
}

/// Copies a frame to memory.
pub fn read_back(gpu: &Gpu, texture: &wgpu::Texture) -> Result<HdrFrame, GpuError> {
    read_pixels(gpu, texture, [0.0f32; 4])
}

/// Copies a texture to memory, band by band so that its size is bounded by the picture alone. Texels are
/// of the type of `black`.
pub fn read_pixels<P: bytemuck::Pod>(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    black: P,
) -> Result<Image<P>, GpuError> {
    let (width, height) = (texture.width(), texture.height());
    let line_bytes = width as usize * size_of::<P>();
    let row = (line_bytes as u64).next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT));
    let band_rows = (BAND_BYTES / row).clamp(1, u64::from(height)) as u32;
    let buffer = readable_buffer(gpu, row * u64::from(band_rows));
    let mut picture = Image::filled(width, height, black);
    let mut first = 0;
    while first < height {
        let rows = band_rows.min(height - first);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: 0,
                origin: wgpu::Origin3d { x: 0, y: first, z: 0 },
                aspect: wgpu::TextureAspect::All,
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row as u32),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width, height: rows, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        let start = (first * width) as usize;
        let into = &mut picture.pixels_mut()[start..start + (rows * width) as usize];
        with_bytes(gpu, &buffer, |bytes| {
            for (pixels, line) in
                into.chunks_exact_mut(width as usize).zip(bytes.chunks(row as usize))
            {
                bytemuck::cast_slice_mut::<P, u8>(pixels).copy_from_slice(&line[..line_bytes]);
            }
        })?;
        first += rows;
    }
    Ok(picture)
}

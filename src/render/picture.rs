//! The picture on the device, before it is a file or a window.

use crate::display::{ColourSpace, Display};
use crate::image::{Codes, Image};

use super::gpu::{Gpu, GpuError};
use super::target::read_pixels;

/// How fine the steps of a picture are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Codes of 8 bits, dithered.
    Codes,
    /// Linear shares of the screen's white in 32-bit floats.
    Linear,
}

impl Depth {
    /// What passes write that make codes themselves.
    pub fn codes_format(self) -> wgpu::TextureFormat {
        match self {
            Depth::Codes => wgpu::TextureFormat::Rgba8Unorm,
            Depth::Linear => wgpu::TextureFormat::Rgba32Float,
        }
    }

    /// What passes write that add light to it.
    pub fn light_format(self, space: ColourSpace) -> wgpu::TextureFormat {
        match self {
            Depth::Codes if space.is_encoded() => wgpu::TextureFormat::Rgba8UnormSrgb,
            _ => self.codes_format(),
        }
    }
}

/// A picture as it was made.
#[derive(Debug, Clone, PartialEq)]
pub enum Picture {
    /// Codes of red, green and blue.
    Codes(Image<[u8; 3]>),
    /// Linear shares of white of red, green and blue.
    Linear(Image<[f32; 3]>),
}

impl Picture {
    /// The codes that are sent to the display that it was made for.
    pub fn into_codes(self, display: &Display) -> Codes {
        match self {
            Picture::Codes(codes) => Codes::Eight(codes),
            Picture::Linear(light) => Codes::Sixteen(display.sixteen_bits(&light)),
        }
    }
}

/// The texture of a picture, as codes and as light.
pub struct PictureTarget {
    depth: Depth,
    texture: wgpu::Texture,
    codes: wgpu::TextureView,
    light: wgpu::TextureView,
}

impl PictureTarget {
    pub fn new(gpu: &Gpu, [width, height]: [u32; 2], depth: Depth, space: ColourSpace) -> Self {
        let (codes, light) = (depth.codes_format(), depth.light_format(space));
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: codes,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[light],
        });
        let view = |format| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                format: Some(format),
                ..Default::default()
            })
        };
        PictureTarget { depth, codes: view(codes), light: view(light), texture }
    }

    pub fn depth(&self) -> Depth {
        self.depth
    }
    /// To write codes.
    pub fn codes(&self) -> &wgpu::TextureView {
        &self.codes
    }
    /// To add light.
    pub fn light(&self) -> &wgpu::TextureView {
        &self.light
    }

    /// The codes, to be read by whoever shows them.
    pub fn into_codes(self) -> wgpu::TextureView {
        self.codes
    }

    /// Brings it to memory.
    pub fn read(&self, gpu: &Gpu) -> Result<Picture, GpuError> {
        Ok(match self.depth {
            Depth::Codes => {
                let codes = read_pixels(gpu, &self.texture, [0u8; 4])?;
                Picture::Codes(codes.map(|[red, green, blue, _]| [red, green, blue]))
            }
            Depth::Linear => {
                let light = read_pixels(gpu, &self.texture, [0.0f32; 4])?;
                // Points are added to what may be white already.
                let share = |share: f32| if share > 0.0 { share.min(1.0) } else { 0.0 };
                Picture::Linear(light.map(|[red, green, blue, _]| [red, green, blue].map(share)))
            }
        })
    }
}

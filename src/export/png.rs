//! PNG: the picture as the eye has it, 8-bit sRGB.

use std::io;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

use crate::image::Image;

use super::{ExportError, OutputFile};

/// Writes a picture.
pub fn write(file: OutputFile, picture: &Image<[u8; 3]>) -> Result<(), ExportError> {
    let (width, height) = (picture.width_px(), picture.height_px());
    file.write(|writer| {
        PngEncoder::new_with_quality(writer, CompressionType::Default, FilterType::Adaptive)
            .write_image(picture.pixels().as_flattened(), width, height, ExtendedColorType::Rgb8)
            .map_err(io::Error::other)
    })
}

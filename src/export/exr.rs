//! OpenEXR: the frame itself, linear and absolute, for those who make their own picture of it.
//!
//! Channels `X`, `Y`, `Z` and `V` hold cd/m2 in 32-bit floats: CIE 1931 tristimulus values with
//! 683 lm/W and CIE 1951 scotopic luminance with 1700 lm/W.

use std::io;

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image as ExrImage, Layer,
    LayerAttributes, Text, WritableImage,
};

use crate::image::HdrFrame;
use crate::photo::exposure::Exposure;

use super::{ExportError, OutputFile};

/// What the file says about itself.
#[derive(Debug, Clone, PartialEq)]
pub enum Attribute {
    Text(String),
    Number(f64),
}

/// What the settings of a camera come to, for a frame that it is to take.
pub fn of_exposure(exposure: &Exposure) -> [(&'static str, Attribute); 5] {
    [
        ("shutter_s", exposure.shutter_s),
        ("iso", exposure.iso),
        ("f_number", exposure.f_number),
        ("focal_mm", exposure.focal_mm),
        ("sensor_width_mm", exposure.sensor_width_mm),
    ]
    .map(|(name, value)| (name, Attribute::Number(value)))
}

/// Names of the channels, in the order of a pixel of the frame.
const CHANNELS: [&str; 4] = ["X", "Y", "Z", "V"];

/// Bytes of an EXR file before its attributes: the magic number and the version.
const FIRST_ATTRIBUTE: usize = 8;

/// Writes a frame with named attributes.
pub fn write(
    file: OutputFile,
    frame: &HdrFrame,
    attributes: &[(&str, Attribute)],
) -> Result<(), ExportError> {
    let channels = CHANNELS.iter().enumerate().map(|(index, name)| {
        let samples = frame.pixels().iter().map(|pixel| pixel[index]).collect();
        AnyChannel::new(*name, FlatSamples::F32(samples))
    });
    let mut about = LayerAttributes::named("sky");
    about.software_name = Some(Text::from("Nocturne"));
    for (name, value) in attributes {
        let value = match value {
            Attribute::Text(text) => AttributeValue::Text(Text::from(text.as_str())),
            Attribute::Number(number) => AttributeValue::F64(*number),
        };
        about.other.insert(Text::from(*name), value);
    }
    let size = (frame.width_px() as usize, frame.height_px() as usize);
    let layer =
        Layer::new(size, about, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels.collect()));
    let image = ExrImage::from_layer(layer);
    file.write(|writer| {
        // The format wants to seek, which it does less in memory than on a disk.
        let mut bytes = io::Cursor::new(Vec::new());
        image.write().to_buffered(&mut bytes).map_err(io::Error::other)?;
        let mut bytes = bytes.into_inner();
        sort_attributes(&mut bytes);
        io::Write::write_all(writer, &bytes)
    })
}

/// Puts the attributes of a file in the order of their names, so that the same frame gives the same
/// bytes: the library takes them from a hash map, in another order each time.
///
/// An attribute is its name and its type, each with a zero after it, its size in four bytes, and
/// its value; a zero ends the list (OpenEXR file layout, "Header").
fn sort_attributes(file: &mut [u8]) {
    let mut attributes = Vec::new();
    let mut rest = &file[FIRST_ATTRIBUTE..];
    while let Some((attribute, after)) = split_attribute(rest) {
        attributes.push(attribute);
        rest = after;
    }
    attributes.sort_unstable();
    let sorted = attributes.concat();
    file[FIRST_ATTRIBUTE..FIRST_ATTRIBUTE + sorted.len()].copy_from_slice(&sorted);
}

/// The first attribute and what follows it; none at the end of the list.
fn split_attribute(list: &[u8]) -> Option<(&[u8], &[u8])> {
    let name = list.iter().position(|&byte| byte == 0).filter(|&length| length > 0)?;
    let kind = list[name + 1..].iter().position(|&byte| byte == 0)?;
    let (head, value) = list.split_at_checked(name + 1 + kind + 1 + 4)?;
    let size = u32::from_le_bytes(*head.last_chunk()?);
    value.get(size as usize..).map(|after| list.split_at(list.len() - after.len()))
}

/// Reads a frame back, with its text attributes: for tests and for tools that compare frames.
pub fn read(path: &std::path::Path) -> Result<(HdrFrame, Vec<(String, String)>), ExportError> {
    let fail = |source| ExportError::Read { path: path.display().to_string(), source };
    let other = |error: exr::error::Error| fail(io::Error::other(error.to_string()));
    let image = exr::prelude::read_first_flat_layer_from_file(path).map_err(other)?;
    let layer = image.layer_data;
    let mut frame = crate::image::Image::filled(
        layer.size.width() as u32,
        layer.size.height() as u32,
        [0.0f32; 4],
    );
    for (index, name) in CHANNELS.iter().enumerate() {
        let channel = layer.channel_data.list.iter().find(|channel| channel.name.eq(name));
        let channel =
            channel.ok_or_else(|| fail(io::Error::other(format!("no channel {name}"))))?;
        for (pixel, value) in frame.pixels_mut().iter_mut().zip(channel.sample_data.values_as_f32())
        {
            pixel[index] = value;
        }
    }
    let texts = layer.attributes.other.iter().map(|(name, value)| {
        let value = match value {
            AttributeValue::Text(text) => text.to_string(),
            AttributeValue::F64(number) => number.to_string(),
            other => format!("{other:?}"),
        };
        (name.to_string(), value)
    });
    Ok((frame, texts.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Image;

    #[test]
    fn the_same_frame_gives_the_same_file_and_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        let frame = Image::filled(3, 2, [1e-6f32, 2.0, 3e9, 0.5]);
        let names = ["units", "place", "jd_tt", "azimuth_deg", "altitude_deg", "roll_deg"];
        let attributes = names.map(|name| (name, Attribute::Text(format!("of {name}"))));
        let files = ["first.exr", "second.exr"].map(|name| {
            let path = folder.path().join(name);
            write(OutputFile::create(&path).unwrap(), &frame, &attributes).unwrap();
            path
        });
        let [first, second] = [&files[0], &files[1]].map(|path| std::fs::read(path).unwrap());
        assert_eq!(first, second);
        let (back, said) = read(&files[0]).unwrap();
        assert_eq!(back, frame);
        for name in names {
            assert!(said.contains(&(name.to_owned(), format!("of {name}"))), "{said:?}");
        }
    }
}

//! The Milky Way out of Gaia's picture.

use std::fs;
use std::path::Path;

use nocturne::catalog::pack::{self, Packed};

/// Packs the map.
pub fn pack(picture: &Path) -> Result<Packed, String> {
    let rgb = open(picture)?;
    pack::milky_way(rgb.as_raw(), size(&rgb)).map_err(|error| error.to_string())
}

/// A table of places with the starlight of the picture.
pub fn table(picture: &Path, places: &Path) -> Result<String, String> {
    let text = fs::read_to_string(places)
        .map_err(|error| format!("{}: {error}; give a CSV file", places.display()))?;
    let rgb = open(picture)?;
    pack::starlight_table(rgb.as_raw(), size(&rgb), &text).map_err(|error| error.to_string())
}

fn open(picture: &Path) -> Result<image::RgbImage, String> {
    let picture = image::open(picture)
        .map_err(|error| format!("{}: {error}; give a JPEG or PNG", picture.display()))?;
    Ok(picture.into_rgb8())
}

fn size(rgb: &image::RgbImage) -> (usize, usize) {
    (rgb.width() as usize, rgb.height() as usize)
}

//! The Milky Way out of Gaia's picture.

use std::path::Path;

use nocturne::catalog::pack::{self, Packed};

/// Packs the map.
pub fn pack(picture: &Path) -> Result<Packed, String> {
    let rgb = image::open(picture)
        .map_err(|error| format!("{}: {error}; give a JPEG or PNG", picture.display()))?
        .into_rgb8();
    let size = (rgb.width() as usize, rgb.height() as usize);
    pack::milky_way(rgb.as_raw(), size).map_err(|error| error.to_string())
}

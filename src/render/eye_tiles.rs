//! What each part of a picture needs of the eye: not every pixel is worth all of it.
//!
//! Where it is so dark that the eye resolves no more than every second or fourth pixel, the picture is
//! made at that resolution; where it resolves all and nothing bright is near, the frame is shown as it is.
//! Only what remains goes the whole way.

use crate::eye::Foveal;

/// Edge of a tile, pixels.
const TILE_PX: u32 = 64;
/// Glare that changes the light by less than this is left out.
const UNSEEN_GLARE: f64 = 0.004;
/// The coarsest level that a dark picture is made at.
const SOFTEST: usize = 2;

/// Tiles of a picture: left, top, right and bottom, pixels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EyeTiles {
    /// Resolved no finer than the picture at `soft_level`.
    pub soft: Vec<[u32; 4]>,
    /// 1 or 2.
    pub soft_level: usize,
    /// All that the frame holds is resolved, and glare adds nothing.
    pub plain: Vec<[u32; 4]>,
    /// Everything else.
    pub full: Vec<[u32; 4]>,
}

impl EyeTiles {
    /// Tiles of a picture, from what falls on the fovea as it looks around.
    pub fn of(size_px: [u32; 2], foveal: &Foveal, loses_detail: bool) -> EyeTiles {
        let mut tiles = EyeTiles { soft_level: SOFTEST.min(foveal.level), ..EyeTiles::default() };
        let mut soft = Vec::new();
        for y in (0..size_px[1]).step_by(TILE_PX as usize) {
            for x in (0..size_px[0]).step_by(TILE_PX as usize) {
                let tile =
                    [x, y, (x + TILE_PX).min(size_px[0]), (y + TILE_PX).min(size_px[1])];
                let [mut finest, mut coarsest, mut glare] = [f64::INFINITY, 0.0f64, 0.0f64];
                for cell in foveal.cells_around(tile) {
                    finest = finest.min(cell.level_resolved);
                    coarsest = coarsest.max(cell.level_resolved);
                    glare = glare.max(cell.glare);
                }
                if loses_detail && finest >= 1.0 {
                    soft.push((tile, finest));
                } else if glare < UNSEEN_GLARE && (!loses_detail || coarsest <= 0.0) {
                    tiles.plain.push(tile);
                } else {
                    tiles.full.push(tile);
                }
            }
        }
        if soft.iter().any(|(_, finest)| *finest < tiles.soft_level as f64) {
            tiles.soft_level = 1;
        }
        tiles.soft = soft.into_iter().map(|(tile, _)| tile).collect();
        tiles
    }
}

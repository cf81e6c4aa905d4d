//! What each part of a picture needs of the eye: not every pixel is worth all of it.
//!
//! Where it is so dark that the eye resolves no more than every second or fourth pixel, and where the
//! light is so smooth that there is no more to resolve, the picture is made at that resolution; where
//! glare adds nothing, the frame is shown as it is. Only what remains goes the whole way.

use crate::eye::foveal::Foveal;
use crate::eye::light_table;

/// Edge of a tile, pixels.
const TILE_PX: u32 = 64;
/// Glare that changes no light of the picture by more than this is left out.
const UNSEEN_GLARE: f64 = 0.01;
/// Glare that changes the light of a tile by less than this is left out there.
const UNSEEN_IN_TILE: f64 = 0.004;
/// Light that bends by less than this share of it, from a foveal cell to the next, is smooth. Read with
/// straight lines between every fourth pixel it errs by a thirtieth of that.
const SMOOTH: f64 = 0.006;
/// Cells of the foveal picture tell what is smooth if they are no larger than this, pixels.
const TELLING_PX: u32 = 16;

/// A level that is nearly lost is taken for lost: moonlit skies at the usual field are.
const ROUND_UP: f64 = 0.65;

/// A tile of a picture: left, top, right and bottom, pixels.
pub type Tile = [u32; 4];

/// The levels of the pyramid at which a picture can be finished: 1 and 2.
pub const FINISHED_LEVELS: usize = 2;

/// The tiles of a picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EyeTiles {
    /// Resolved no finer than the picture at level 1 and 2, to two thirds of a level.
    pub soft: [Vec<Tile>; FINISHED_LEVELS],
    /// Whether less than that level is resolved somewhere in them.
    pub blurs: bool,
    /// Resolved, and glare adds nothing.
    pub plain: Vec<Tile>,
    /// Resolved.
    pub sharp: Vec<Tile>,
    /// Whether there is any glare that is seen.
    pub scatters: bool,
}

impl EyeTiles {
    /// Tiles of a picture with so many levels, from what falls on the fovea and from what is resolved
    /// by its light.
    pub fn of(
        size_px: [u32; 2],
        levels: usize,
        foveal: &Foveal,
        levels_resolved: Option<&[f32]>,
        scatters: bool,
    ) -> EyeTiles {
        let resolved = |photopic_cd_m2: f64| {
            let column = light_table::column(photopic_cd_m2);
            levels_resolved.map_or(0.0, |levels| f64::from(levels[column]))
        };
        let strongest = foveal.cells.iter().map(|cell| cell.glare).fold(0.0, f64::max);
        let scatters = scatters && strongest >= UNSEEN_GLARE;
        let mut tiles = EyeTiles { scatters, ..EyeTiles::default() };
        let coarsest = FINISHED_LEVELS.min(levels);
        let tells = 1u32 << foveal.level <= TELLING_PX;
        for y in (0..size_px[1]).step_by(TILE_PX as usize) {
            for x in (0..size_px[0]).step_by(TILE_PX as usize) {
                let tile = [x, y, (x + TILE_PX).min(size_px[0]), (y + TILE_PX).min(size_px[1])];
                let [mut darkest, mut brightest, mut glare] = [f64::INFINITY, 0.0f64, 0.0f64];
                let mut bend = if tells { 0.0f64 } else { f64::INFINITY };
                for cell in foveal.around(tile) {
                    darkest = darkest.min(cell.light[1]);
                    brightest = brightest.max(cell.light[1]);
                    glare = glare.max(cell.glare);
                    bend = bend.max(cell.bend);
                }
                let finest = resolved(brightest);
                let level = if bend < SMOOTH { coarsest } else { (finest + ROUND_UP) as usize };
                if let Some(level) = level.min(coarsest).checked_sub(1) {
                    tiles.blurs |= bend >= SMOOTH && resolved(darkest) >= level as f64 + 1.5;
                    tiles.soft[level].push(tile);
                } else if scatters && glare >= UNSEEN_IN_TILE {
                    tiles.sharp.push(tile);
                } else {
                    tiles.plain.push(tile);
                }
            }
        }
        tiles
    }
}

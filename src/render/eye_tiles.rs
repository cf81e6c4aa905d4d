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
/// Light that bends by less than this share of it, from a foveal cell of eight pixels to the next, is smooth
/// to level 1 and 2. Read with straight lines between every second pixel it errs by 1/128 of that, between every
/// fourth by 1/32: by 0.04 %, a fiftieth of a code.
const SMOOTH: [f64; FINISHED_LEVELS] = [0.048, 0.012];
/// Light at an edge of the picture is level if over a tile and what is next to it it changes by less than this
/// share: some 80 pixels, of which the outermost two are shown alike.
const LEVEL: f64 = 0.1;
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
    /// Tiles of a picture with so many levels, from what falls on the fovea, from the same of what is finished
    /// here, and from what is resolved by the light.
    pub fn of(
        size_px: [u32; 2],
        levels: usize,
        foveal: &Foveal,
        finished: &Foveal,
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
                }
                for cell in finished.around(tile) {
                    bend = bend.max(cell.bend);
                }
                // Beyond the outermost texel of a coarse level its light goes on level: at the edges of the
                // picture nothing may slope.
                let is_at_edge = x == 0 || y == 0 || tile[2] == size_px[0] || tile[3] == size_px[1];
                if is_at_edge && brightest > darkest * (1.0 + LEVEL) {
                    bend = f64::INFINITY;
                }
                let finest = resolved(brightest);
                let smooth_to = SMOOTH.iter().filter(|most| bend < **most).count();
                let level = smooth_to.max((finest + ROUND_UP) as usize);
                if let Some(level) = level.min(coarsest).checked_sub(1) {
                    tiles.blurs |= smooth_to <= level && resolved(darkest) >= level as f64 + 1.5;
                    extend(&mut tiles.soft[level], tile);
                } else if scatters && glare >= UNSEEN_IN_TILE {
                    extend(&mut tiles.sharp, tile);
                } else {
                    extend(&mut tiles.plain, tile);
                }
            }
        }
        let EyeTiles { soft: [one, two], plain, sharp, .. } = &mut tiles;
        for kind in [one, two, plain, sharp] {
            *kind = stacked(kind);
        }
        tiles
    }
}

/// Adds a tile to the one on its left, if that is the last: fewer edges, around which texels are made twice.
fn extend(tiles: &mut Vec<Tile>, tile: Tile) {
    match tiles.last_mut() {
        Some(last) if last[1] == tile[1] && last[2] == tile[0] => last[2] = tile[2],
        _ => tiles.push(tile),
    }
}

/// Tiles from the top downwards, joined with those below them that are as wide.
fn stacked(tiles: &[Tile]) -> Vec<Tile> {
    let mut stacks: Vec<Tile> = Vec::new();
    for &[left, top, right, bottom] in tiles {
        let above = |stack: &&mut Tile| [stack[0], stack[2], stack[3]] == [left, right, top];
        match stacks.iter_mut().find(above) {
            Some(stack) => stack[3] = bottom,
            None => stacks.push([left, top, right, bottom]),
        }
    }
    stacks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_tiles_cover_what_they_covered() {
        // A row of three, two below it, and one apart.
        let all = [[0, 0, 64, 64], [64, 0, 128, 64], [128, 0, 150, 64]];
        let all = all.into_iter().chain([[0, 64, 64, 128], [64, 64, 128, 128], [0, 128, 64, 140]]);
        let mut rows = Vec::new();
        all.clone().for_each(|tile| extend(&mut rows, tile));
        assert_eq!(rows, [[0, 0, 150, 64], [0, 64, 128, 128], [0, 128, 64, 140]]);
        let even = [[0, 0, 128, 64], [192, 0, 256, 64], [0, 64, 128, 128], [64, 128, 192, 192]];
        let joined = [[0, 0, 128, 128], [192, 0, 256, 64], [64, 128, 192, 192]];
        assert_eq!(stacked(&even), joined);
        let area = |tiles: &[Tile]| -> u32 {
            tiles.iter().map(|[x0, y0, x1, y1]| (x1 - x0) * (y1 - y0)).sum()
        };
        assert_eq!(area(&stacked(&rows)), area(&all.collect::<Vec<_>>()));
    }
}

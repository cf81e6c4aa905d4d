//! What falls on the fovea as the eye looks around: the picture, half a degree at a time.

use crate::image::HdrFrame;
use crate::units::Angle;

use super::glare::pyramid;

/// A picture finer than this, about what an eye resolves, is seen magnified, as through a telescope or on
/// a nearby screen. Otherwise a close-up of the Moon would be no sharper than the naked eye sees her.
pub const FINEST_PIXEL: Angle = Angle::from_arcmin(1.0);
/// What one looks at.
const FOVEA: Angle = Angle::from_deg(0.5);

/// The size of a picture, and how it is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    pub size_px: [u32; 2],
    /// Between neighbouring pixels in the middle of the picture, as they appear.
    pub pixel: Angle,
    /// How many times larger things appear than to the naked eye; 1 or more.
    pub magnification: f64,
}

impl View {
    /// A picture whose pixels are `pixel` apart in its middle.
    pub fn new(size_px: [u32; 2], pixel: Angle) -> View {
        let apparent = pixel.max(FINEST_PIXEL);
        View { size_px, pixel: apparent, magnification: apparent.rad() / pixel.rad() }
    }

    /// Levels of its pyramid.
    pub fn levels(&self) -> usize {
        pyramid::level_count(self.size_px[0], self.size_px[1])
    }

    /// The level whose texels are about as large as what one looks at.
    pub fn foveal_level(&self) -> usize {
        let level = (FOVEA.rad() / self.pixel.rad()).log2().round().max(1.0) as usize;
        level.min(self.levels()).max(1)
    }
}

/// A texel of the foveal picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// X, Y, Z and V on the retina, cd/m2.
    pub light: [f64; 4],
    /// By how much glare has changed it, as a share of it.
    pub glare: f64,
    /// By how much it differs from the mean of its neighbours, as a share of it, along either axis.
    pub bend: f64,
}

/// The foveal picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Foveal {
    pub level: usize,
    pub width: usize,
    pub cells: Vec<Cell>,
}

impl Foveal {
    /// From the light of a level of the pyramid as the steps down leave it, and the shares of all levels.
    pub fn of(gathered: &HdrFrame, view: &View, level: usize, shares: &[f64]) -> Foveal {
        let width = gathered.width_px() as usize;
        let [columns, rows] = view
            .size_px
            .map(|edge| pyramid::places_within(edge as usize, level).pop().unwrap_or_default());
        let mut light = gathered.clone();
        for (row, within) in light.pixels_mut().chunks_mut(width).zip(&rows) {
            for (pixel, across) in row.iter_mut().zip(&columns) {
                let place = (within * across) as f32;
                *pixel = pixel.map(|channel| channel / place);
            }
        }
        let wider = shares.get(level..).unwrap_or_default();
        let retina = match wider.iter().any(|share| *share > 0.0) {
            true => pyramid::scattered_by(&light, wider),
            false => light.clone(),
        };
        let cell = |(before, after): (&[f32; 4], &[f32; 4])| {
            let light = after.map(|channel| f64::from(channel).max(0.0));
            let before = f64::from(before[1]).max(f64::MIN_POSITIVE);
            Cell { light, glare: (light[1] / before - 1.0).abs(), bend: f64::INFINITY }
        };
        let mut cells: Vec<Cell> = light.pixels().iter().zip(retina.pixels()).map(cell).collect();
        let height = cells.len() / width.max(1);
        for at in 0..cells.len() {
            let across = bend_along(&cells, at, [at % width, width], 1);
            let down = bend_along(&cells, at, [at / width, height], width);
            cells[at].bend = across.max(down);
        }
        Foveal { level, width, cells }
    }

    /// The cells that lie in a tile of the picture or next to it: left, top, right and bottom in pixels.
    pub fn around(&self, [x0, y0, x1, y1]: [u32; 4]) -> impl Iterator<Item = &Cell> {
        let height = self.cells.len() / self.width.max(1);
        let span = |first: u32, last: u32, cells: usize| {
            let first = ((first >> self.level) as usize).saturating_sub(1);
            first..((last >> self.level) as usize + 2).min(cells)
        };
        let columns = span(x0, x1, self.width);
        span(y0, y1, height).flat_map(move |row| {
            columns.clone().map(move |column| &self.cells[row * self.width + column])
        })
    }
}

/// The bend of a cell along an axis of which it is one of so many, each a step from the next; at an edge
/// that of its neighbour.
fn bend_along(cells: &[Cell], at: usize, [place, len]: [usize; 2], step: usize) -> f64 {
    if len < 3 {
        return f64::INFINITY;
    }
    let middle = match place {
        0 => at + step,
        last if last + 1 == len => at - step,
        _ => at,
    };
    let [before, here, after] = [middle - step, middle, middle + step].map(|at| cells[at].light);
    // Y, and Z for the colour.
    let bends = [1, 2].map(|part: usize| {
        let bend = before[part] - 2.0 * here[part] + after[part];
        bend.abs() / here[part].max(f64::MIN_POSITIVE)
    });
    bends.into_iter().fold(0.0, f64::max)
}

//! How a picture of the sky is cut into tiles.
//!
//! A square tile in which the light is nearly straight between its corners is drawn as two triangles
//! with the light of the corners; a tile that is not is cut in four, down to 16 pixels, and the rest
//! is looked up pixel by pixel. Whether it is straight is tried in the middle and on the edges, with
//! the CPU's twin of the shader, in all of X, Y, Z and V. Around a source, whose aureole could hide
//! between these points, tiles must be small against their distance from it. Tiles that the horizon
//! or the edge of the sky crosses are never straight.
//!
//! Accuracy: a function that is curved evenly differs from the triangles by 4/3 of what is tried at
//! most: 0.16 %. Measured in `tests/gpu.rs` against the picture that is looked up pixel by pixel.

use rayon::prelude::*;

use crate::camera::Camera;
use crate::frame::{Apparent, Dir};
use crate::plan::SkyPlan;
use crate::units::{Angle, Xyzv};

/// How the sky is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SkyDetail {
    /// Within 0.2 % of every pixel.
    #[default]
    Tiles,
    /// Every pixel looked up for itself: what the tiles are measured against.
    EveryPixel,
}

/// Tiles by first and last corner, pixels.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SkyTiles {
    /// Straight between their corners.
    pub smooth: Vec<[u32; 4]>,
    /// To be looked up pixel by pixel.
    pub exact: Vec<[u32; 4]>,
}

/// Edge of the largest tiles, pixels, and how often one may be cut in four.
const LARGEST_PX: u32 = 64;
const CUTS: u32 = 2;
/// Most that the light half-way between corners may differ from straight, relative.
const STRAIGHT: f64 = 1.2e-3;
/// A straight tile reaches over this share of its distance from a source, at most.
const REACH_TO_SOURCE: f64 = 0.5;
/// The horizon stays at least this share of a tile's reach away from the points that are tried.
const REACH_TO_HORIZON: f64 = 0.1;

/// Cuts a picture. Where there is no sky there are no tiles.
pub fn tiles(sky: &SkyPlan, camera: &Camera, detail: SkyDetail) -> SkyTiles {
    let (width, height) = (camera.width_px, camera.height_px);
    if detail == SkyDetail::EveryPixel {
        return SkyTiles { smooth: Vec::new(), exact: vec![[0, 0, width, height]] };
    }
    let cutter = Cutter::new(sky, camera);
    (0..height.div_ceil(LARGEST_PX))
        .into_par_iter()
        .map(|row| {
            let mut tiles = SkyTiles::default();
            for column in 0..width.div_ceil(LARGEST_PX) {
                let first = [column * LARGEST_PX, row * LARGEST_PX];
                let tile = [
                    first[0],
                    first[1],
                    width.min(first[0] + LARGEST_PX),
                    height.min(first[1] + LARGEST_PX),
                ];
                cutter.cut(tile, CUTS, &mut tiles);
            }
            tiles
        })
        .reduce(SkyTiles::default, |mut all, mut row| {
            all.smooth.append(&mut row.smooth);
            all.exact.append(&mut row.exact);
            all
        })
}

/// What a point of the picture sees.
#[derive(Clone, Copy)]
struct Seen {
    dir: Dir<Apparent>,
    over_horizon: Angle,
    light: Xyzv,
}

struct Cutter<'a> {
    sky: &'a SkyPlan,
    camera: &'a Camera,
    sources: Vec<Dir<Apparent>>,
}

impl Cutter<'_> {
    fn new<'a>(sky: &'a SkyPlan, camera: &'a Camera) -> Cutter<'a> {
        let sources = [&sky.sun, &sky.moon]
            .into_iter()
            .flatten()
            .map(|s| Dir::from_azimuth_altitude(s.azimuth, s.view.source_elevation))
            .collect();
        Cutter { sky, camera, sources }
    }

    fn see(&self, x: f64, y: f64) -> Option<Seen> {
        let dir =
            self.camera.view_from_apparent().inverse() * self.camera.view_from_pixel([x, y])?;
        let over_horizon = dir.altitude() - self.sky.horizon;
        Some(Seen { dir, over_horizon, light: self.sky.luminance(dir) })
    }

    fn cut(&self, tile: [u32; 4], cuts: u32, tiles: &mut SkyTiles) {
        if !self.has_sky(tile) {
            return;
        }
        let [x0, y0, x1, y1] = tile;
        if self.is_straight(tile) {
            tiles.smooth.push(tile);
        } else if cuts == 0 {
            tiles.exact.push(tile);
        } else {
            let half = LARGEST_PX >> (CUTS - cuts + 1);
            for [x, y] in [[x0, y0], [x0 + half, y0], [x0, y0 + half], [x0 + half, y0 + half]] {
                if x < x1 && y < y1 {
                    self.cut([x, y, x1.min(x + half), y1.min(y + half)], cuts - 1, tiles);
                }
            }
        }
    }

    /// Whether any of a tile sees sky: the plane of every projection has sky at the point that is
    /// nearest to the centre, if anywhere.
    fn has_sky(&self, [x0, y0, x1, y1]: [u32; 4]) -> bool {
        let nearest = |low: u32, high: u32, edge: u32| {
            (f64::from(edge) / 2.0).clamp(f64::from(low), f64::from(high))
        };
        let (camera, x) = (self.camera, nearest(x0, x1, self.camera.width_px));
        camera.view_from_pixel([x, nearest(y0, y1, camera.height_px)]).is_some()
    }

    fn is_straight(&self, tile: [u32; 4]) -> bool {
        let [x0, y0, x1, y1] = tile.map(f64::from);
        let (xm, ym) = (0.5 * (x0 + x1), 0.5 * (y0 + y1));
        let Some(centre) = self.see(xm, ym) else { return false };
        let mut corners = [centre; 4];
        for (corner, [x, y]) in corners.iter_mut().zip([[x0, y0], [x1, y0], [x0, y1], [x1, y1]]) {
            let Some(seen) = self.see(x, y) else { return false };
            *corner = seen;
        }
        let reach =
            corners.iter().map(|c| c.dir.separation(centre.dir)).fold(Angle::ZERO, Angle::max);
        let margin = reach * REACH_TO_HORIZON + self.camera.pixel_angle();
        let above = centre.over_horizon > Angle::ZERO;
        let clear = |seen: &Seen| {
            if above { seen.over_horizon > margin } else { seen.over_horizon < -margin }
        };
        let far = |source: &Dir<Apparent>| centre.dir.separation(*source) * REACH_TO_SOURCE > reach;
        // Far below the horizon no aureole is seen, but the rule costs nothing.
        if !corners.iter().all(clear) || !clear(&centre) || !self.sources.iter().all(far) {
            return false;
        }
        // The triangles meet along the edge from the second corner to the third.
        let [a, b, c, d] = corners.map(|corner| corner.light);
        if !is_half_way(centre.light, b, c) {
            return false;
        }
        let edges = [(xm, y0, a, b), (x0, ym, a, c), (x1, ym, b, d), (xm, y1, c, d)];
        edges.into_iter().all(|(x, y, one, other)| {
            self.see(x, y).is_some_and(|seen| clear(&seen) && is_half_way(seen.light, one, other))
        })
    }
}

/// Whether a light is the mean of two others, nearly.
fn is_half_way(light: Xyzv, one: Xyzv, other: Xyzv) -> bool {
    let near = |light: f64, one: f64, other: f64| {
        (0.5 * (one + other) - light).abs() <= STRAIGHT * light.abs()
    };
    near(light.x, one.x, other.x)
        && near(light.y, one.y, other.y)
        && near(light.z, one.z, other.z)
        && near(light.v, one.v, other.v)
}

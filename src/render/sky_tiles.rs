//! How a picture of the sky is cut into tiles.
//!
//! A square tile in which the light is nearly straight between its corners is drawn as two triangles
//! with the light of the corners; a tile that is not is cut in four, down to 8 pixels, and the rest
//! is looked up pixel by pixel. Whether it is straight is tried in the middle and on the edges, with
//! the CPU's twin of the shader, in all of X, Y, Z and V. Around a source, whose aureole could hide
//! between these points, tiles must be small against their distance from it. Tiles that the horizon
//! or the edge of the sky crosses are never straight.
//!
//! Accuracy: a function that is curved evenly differs from the triangles by 4/3 of what is tried at
//! most: 0.16 %. Measured in `tests/gpu.rs` against the picture that is looked up pixel by pixel.

use rayon::prelude::*;

use crate::camera::Camera;
use crate::frame::{Apparent, Dir, Rot, View};
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

impl SkyTiles {
    /// The corners of the smooth tiles, each once, pixels; and by tile two triangles of corners, which
    /// meet along the edge from the second corner to the third.
    pub fn shared_corners(&self, camera: &Camera) -> (Vec<[u32; 2]>, Vec<u32>) {
        const UNKNOWN: u32 = u32::MAX;
        let columns = camera.width_px.next_multiple_of(LARGEST_PX) / SMALLEST_PX + 1;
        let rows = camera.height_px.next_multiple_of(LARGEST_PX) / SMALLEST_PX + 1;
        let mut places = vec![UNKNOWN; (columns * rows) as usize];
        let (mut corners, mut indices) = (Vec::new(), Vec::with_capacity(6 * self.smooth.len()));
        for &[x0, y0, x1, y1] in &self.smooth {
            let [a, b, c, d] = [[x0, y0], [x1, y0], [x0, y1], [x1, y1]].map(|corner| {
                let [x, y] = corner.map(|px| px / SMALLEST_PX);
                let place = &mut places[(y * columns + x) as usize];
                if *place == UNKNOWN {
                    *place = corners.len() as u32;
                    corners.push(corner);
                }
                *place
            });
            indices.extend([a, b, c, c, b, d]);
        }
        (corners, indices)
    }
}

/// Edges of the largest and of the smallest tiles, pixels.
pub(super) const LARGEST_PX: u32 = 64;
pub(super) const SMALLEST_PX: u32 = 8;
/// Apart so far stand the points that are looked at, pixels; and how many along an edge of a block.
const POINT_PX: u32 = SMALLEST_PX / 2;
const POINTS: usize = (LARGEST_PX / POINT_PX) as usize + 1;
/// Most that the light half-way between corners may differ from straight, relative.
const STRAIGHT: f64 = 1.2e-3;
/// A straight tile reaches over this share of its distance from a source, at most.
const REACH_TO_SOURCE: f64 = 0.5;
/// The horizon stays at least this share of a tile's reach away from the points that are tried.
const REACH_TO_HORIZON: f64 = 0.1;

/// Cuts a picture. Where there is no sky there are no tiles; those at the edge reach over it.
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
                let block = [column * LARGEST_PX, row * LARGEST_PX];
                Block { cutter: &cutter, first_px: block, seen: [[None; POINTS]; POINTS] }.cut(
                    [0, 0],
                    LARGEST_PX,
                    &mut tiles,
                );
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
    apparent_from_view: Rot<Apparent, View>,
    sources: Vec<Dir<Apparent>>,
}

impl Cutter<'_> {
    fn new<'a>(sky: &'a SkyPlan, camera: &'a Camera) -> Cutter<'a> {
        let sources = sky
            .sources()
            .into_iter()
            .flatten()
            .map(|(s, _)| Dir::from_azimuth_altitude(s.azimuth, s.view.source_elevation))
            .collect();
        Cutter { sky, camera, apparent_from_view: camera.view_from_apparent().inverse(), sources }
    }

    fn see(&self, pixel: [f64; 2]) -> Option<Seen> {
        let dir = self.apparent_from_view * self.camera.view_from_pixel(pixel)?;
        let over_horizon = dir.altitude() - self.sky.horizon;
        Some(Seen { dir, over_horizon, light: self.sky.luminance(dir) })
    }
}

/// One of the largest tiles while it is cut: its points are seen once, and by all its parts.
struct Block<'a> {
    cutter: &'a Cutter<'a>,
    first_px: [u32; 2],
    /// By row and column, every [`POINT_PX`] pixels: not looked at yet, or what is seen, if anything.
    seen: [[Option<Option<Seen>>; POINTS]; POINTS],
}

impl Block<'_> {
    /// Given the place of a part in the block and its edge, pixels.
    fn cut(&mut self, [x, y]: [u32; 2], edge: u32, tiles: &mut SkyTiles) {
        let (camera, [x0, y0]) = (self.cutter.camera, self.first_px);
        let tile = [x0 + x, y0 + y, x0 + x + edge, y0 + y + edge];
        let is_outside = tile[0] >= camera.width_px || tile[1] >= camera.height_px;
        if is_outside || !self.has_sky(tile) {
            return;
        }
        if self.is_straight([x, y], edge) {
            tiles.smooth.push(tile);
        } else if edge == SMALLEST_PX {
            let last = [tile[2].min(camera.width_px), tile[3].min(camera.height_px)];
            tiles.exact.push([tile[0], tile[1], last[0], last[1]]);
        } else {
            let half = edge / 2;
            for part in [[x, y], [x + half, y], [x, y + half], [x + half, y + half]] {
                self.cut(part, half, tiles);
            }
        }
    }

    /// Whether any of a tile sees sky: the plane of every projection has sky at the point that is
    /// nearest to the centre, if anywhere.
    fn has_sky(&self, [x0, y0, x1, y1]: [u32; 4]) -> bool {
        let camera = self.cutter.camera;
        let nearest = |low: u32, high: u32, edge: u32| {
            (f64::from(edge) / 2.0).clamp(f64::from(low), f64::from(high.min(edge)))
        };
        let x = nearest(x0, x1, camera.width_px);
        camera.view_from_pixel([x, nearest(y0, y1, camera.height_px)]).is_some()
    }

    /// What is seen at a place in the block, pixels.
    fn see(&mut self, x: u32, y: u32) -> Option<Seen> {
        let point = &mut self.seen[(y / POINT_PX) as usize][(x / POINT_PX) as usize];
        let [x0, y0] = self.first_px;
        *point.get_or_insert_with(|| self.cutter.see([f64::from(x0 + x), f64::from(y0 + y)]))
    }

    fn is_straight(&mut self, [x0, y0]: [u32; 2], edge: u32) -> bool {
        let (xm, ym) = (x0 + edge / 2, y0 + edge / 2);
        let (x1, y1) = (x0 + edge, y0 + edge);
        let Some(centre) = self.see(xm, ym) else { return false };
        let mut corners = [centre; 4];
        for (corner, [x, y]) in corners.iter_mut().zip([[x0, y0], [x1, y0], [x0, y1], [x1, y1]]) {
            let Some(seen) = self.see(x, y) else { return false };
            *corner = seen;
        }
        let reach =
            corners.iter().map(|c| c.dir.separation(centre.dir)).fold(Angle::ZERO, Angle::max);
        let margin = reach * REACH_TO_HORIZON + self.cutter.camera.pixel_angle();
        let above = centre.over_horizon > Angle::ZERO;
        let clear = |seen: &Seen| {
            if above { seen.over_horizon > margin } else { seen.over_horizon < -margin }
        };
        let far = |source: &Dir<Apparent>| centre.dir.separation(*source) * REACH_TO_SOURCE > reach;
        // Far below the horizon no aureole is seen, but the rule costs nothing.
        let mut points = corners.iter().chain([&centre]);
        if !points.all(clear) || !self.cutter.sources.iter().all(far) {
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

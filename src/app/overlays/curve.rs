//! Curves on the sphere, laid on the picture as lines of straight pieces.
//!
//! A curve is halved until its pieces are straight to a part of a pixel. What falls beside the picture or
//! below the ground is left out early, and where the projection tears it is torn too: a circle around the
//! whole sky costs little more than its part on a picture of one arcsecond.

use crate::camera::Camera;
use crate::frame::{Apparent, Dir, Rot, View};
use crate::units::Angle;

/// How far a piece may lie from its curve, pixels, where it is measured: at its quarters.
const ERROR_PX: f64 = 0.25;
/// Lines go on beside the picture for so long, pixels.
const MARGIN_PX: f64 = 8.0;
/// Pieces are no longer than this, so that none hides a bend.
const LONGEST_RAD: f64 = 0.1;
/// A curve is cut at the horizon, or torn, to this part of a pixel of the middle.
const FINEST_PX: f64 = 0.02;

/// A line on the picture, pixels.
pub type Line = Vec<[f64; 2]>;

/// The picture that curves are laid on.
pub struct Picture {
    pub camera: Camera,
    view_from_apparent: Rot<View, Apparent>,
    axis: Dir<Apparent>,
    /// Angle from the middle to the farthest corner, with the margin.
    reach_rad: f64,
    pixel_rad: f64,
    /// Nothing is drawn below this apparent altitude.
    pub ground: Option<Angle>,
}

/// A curve by a parameter.
pub struct Curve<F> {
    /// Where it is seen.
    pub at: F,
    /// The ends of the parameter.
    pub from: f64,
    pub to: f64,
    /// Greatest angle that it goes in a unit of the parameter, radians.
    pub rate_rad: f64,
}

#[derive(Clone, Copy)]
struct Point {
    parameter: f64,
    dir: Dir<Apparent>,
    /// None below the ground, and where the plane has no place for it.
    pixel: Option<[f64; 2]>,
}

impl Picture {
    /// A picture whose ground hides what is lower than an apparent altitude.
    pub fn new(camera: Camera, ground: Option<Angle>) -> Picture {
        let axis = Dir::from_azimuth_altitude(camera.azimuth, camera.altitude);
        Picture {
            camera,
            view_from_apparent: camera.view_from_apparent(),
            axis,
            reach_rad: camera.reach(MARGIN_PX).rad(),
            pixel_rad: camera.pixel_angle().rad(),
            ground,
        }
    }

    /// Where the camera looks.
    pub fn axis(&self) -> Dir<Apparent> {
        self.axis
    }

    /// The largest angle from there of what is on the picture.
    pub fn reach(&self) -> Angle {
        Angle::from_rad(self.reach_rad)
    }

    /// Whether the ground leaves a direction free.
    pub fn is_above_ground(&self, dir: Dir<Apparent>) -> bool {
        self.ground.is_none_or(|ground| dir.altitude() >= ground)
    }

    /// Where a direction falls on the picture, pixels, if it does and is seen.
    pub fn pixel(&self, dir: Dir<Apparent>) -> Option<[f64; 2]> {
        if !self.may_hold(dir, 0.0) || !self.is_above_ground(dir) {
            return None;
        }
        let pixel = self.camera.pixel_from_view(self.view_from_apparent * dir)?;
        self.camera.contains(pixel).then_some(pixel)
    }

    /// Whether something within an angle of a direction may fall on the picture.
    pub fn may_hold(&self, dir: Dir<Apparent>, within_rad: f64) -> bool {
        let reach = self.reach_rad + within_rad;
        reach >= std::f64::consts::PI || dir.dot(self.axis) >= reach.cos()
    }

    /// The lines of a curve on the picture, each cut a little beside it.
    pub fn trace<F: Fn(f64) -> Dir<Apparent>>(&self, curve: &Curve<F>) -> Vec<Line> {
        let mut lines = Lines { lines: Vec::new(), end: f64::NAN };
        let a = self.point(curve, curve.from);
        let b = self.point(curve, curve.to);
        self.piece(curve, a, b, &mut lines);
        lines.lines
    }

    fn point<F: Fn(f64) -> Dir<Apparent>>(&self, curve: &Curve<F>, parameter: f64) -> Point {
        let dir = (curve.at)(parameter);
        let pixel = match self.is_above_ground(dir) {
            true => self.camera.pixel_from_view(self.view_from_apparent * dir),
            false => None,
        };
        Point { parameter, dir, pixel }
    }

    fn piece<F: Fn(f64) -> Dir<Apparent>>(
        &self,
        curve: &Curve<F>,
        a: Point,
        b: Point,
        lines: &mut Lines,
    ) {
        let span_rad = (b.parameter - a.parameter).abs() * curve.rate_rad;
        let middle = self.point(curve, 0.5 * (a.parameter + b.parameter));
        if !self.may_hold(middle.dir, 0.5 * span_rad) || self.is_buried(middle.dir, span_rad) {
            return;
        }
        if span_rad <= LONGEST_RAD {
            if let (Some(from), Some(half), Some(to)) = (a.pixel, middle.pixel, b.pixel) {
                if self.is_beside(from, half, to) {
                    return;
                }
                let is_straight = is_midway(from, half, to) && {
                    let quarter = |x: Point, y: Point| {
                        self.point(curve, 0.5 * (x.parameter + y.parameter)).pixel
                    };
                    let near = |from, quarter: Option<[f64; 2]>, to| {
                        quarter.is_some_and(|quarter| is_midway(from, quarter, to))
                    };
                    near(from, quarter(a, middle), half) && near(half, quarter(middle, b), to)
                };
                if is_straight {
                    lines.push(a.parameter, b.parameter, [from, to], &self.camera);
                    return;
                }
            }
            if span_rad < FINEST_PX * self.pixel_rad {
                return;
            }
        }
        self.piece(curve, a, middle, lines);
        self.piece(curve, middle, b, lines);
    }

    /// Whether all within half a span of a direction is below the ground.
    fn is_buried(&self, dir: Dir<Apparent>, span_rad: f64) -> bool {
        self.ground.is_some_and(|ground| dir.altitude().rad() + 0.5 * span_rad < ground.rad())
    }

    /// Whether three points all lie beyond one edge.
    fn is_beside(&self, a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
        let size = [self.camera.width_px, self.camera.height_px].map(f64::from);
        (0..2).any(|axis| {
            let all = [a[axis], b[axis], c[axis]];
            all.iter().all(|&x| x < -MARGIN_PX) || all.iter().all(|&x| x > size[axis] + MARGIN_PX)
        })
    }
}

/// Whether a point lies in the middle of a piece, and on it.
fn is_midway(a: [f64; 2], middle: [f64; 2], b: [f64; 2]) -> bool {
    let along = [b[0] - a[0], b[1] - a[1]];
    let off = [middle[0] - 0.5 * (a[0] + b[0]), middle[1] - 0.5 * (a[1] + b[1])];
    let length = along[0].hypot(along[1]);
    if length < ERROR_PX {
        return off[0].hypot(off[1]) < ERROR_PX;
    }
    let across = (along[0] * off[1] - along[1] * off[0]).abs() / length;
    // Where the projection tears, the middle lies with one of the ends.
    across < ERROR_PX && off[0].hypot(off[1]) < 0.25 * length + ERROR_PX
}

/// Pieces strung together.
struct Lines {
    lines: Vec<Line>,
    /// The parameter at which the last piece ended, if it was not cut.
    end: f64,
}

impl Lines {
    fn push(&mut self, from: f64, to: f64, piece: [[f64; 2]; 2], camera: &Camera) {
        let far = [camera.width_px, camera.height_px].map(|edge| f64::from(edge) + MARGIN_PX);
        let Some([a, b]) = cut(piece, [-MARGIN_PX; 2], far) else {
            self.end = f64::NAN;
            return;
        };
        match self.lines.last_mut() {
            Some(line) if self.end == from && a == piece[0] => line.push(b),
            _ => self.lines.push(vec![a, b]),
        }
        self.end = if b == piece[1] { to } else { f64::NAN };
    }
}

/// What of a piece lies within a box (Liang & Barsky 1984).
pub fn cut([a, b]: [[f64; 2]; 2], low: [f64; 2], high: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        let d = b[axis] - a[axis];
        let (to_low, to_high) = (low[axis] - a[axis], high[axis] - a[axis]);
        if d == 0.0 {
            if to_low > 0.0 || to_high < 0.0 {
                return None;
            }
            continue;
        }
        let (first, last) =
            if d > 0.0 { (to_low / d, to_high / d) } else { (to_high / d, to_low / d) };
        enter = enter.max(first);
        leave = leave.min(last);
    }
    if enter >= leave {
        return None;
    }
    let at = |t: f64, end: [f64; 2]| match t {
        0.0 | 1.0 => end,
        t => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])],
    };
    Some([at(enter, a), at(leave, b)])
}

/// Where a line crosses the edge of a box from the inside or to it: at most one place for each edge.
pub fn crossings(line: &Line, low: [f64; 2], high: [f64; 2]) -> Vec<[f64; 2]> {
    let is_in = |p: &[f64; 2]| (0..2).all(|axis| (low[axis]..=high[axis]).contains(&p[axis]));
    let mut found = Vec::new();
    for pair in line.windows(2) {
        if is_in(&pair[0]) && is_in(&pair[1]) {
            continue;
        }
        let Some([a, b]) = cut([pair[0], pair[1]], low, high) else { continue };
        found.extend([(a, pair[0]), (b, pair[1])].iter().filter(|(x, end)| x != end).map(|x| x.0));
    }
    found
}

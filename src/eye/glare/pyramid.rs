//! Glare of extended light: every pixel gives shares of its light to ever wider surroundings.
//!
//! Theory: D1 holds means of 2 by 2 pixels, each further level D(l) is made from the one before by
//! the taps `[1 3 3 1]/8` along both axes at half the resolution, and each level is brought up again
//! by bilinear interpolation U:
//!
//! `S(l) = s(l) D(l) + U S(l+1)`, `retina = (1 - sum of s) E + U S(1)`.
//!
//! Down and up, averaged over where a pixel stands between the texels, level l convolves with the
//! autocorrelation of a quadratic B-spline, a quintic one: nearly a Gaussian of standard deviation
//! `sqrt(4^l / 2 - 1)` pixels. A mixture of them follows a spread function that falls like a
//! power; the shares are fitted to it by least squares of relative errors, none below zero.
//!
//! Light is conserved and an even picture stays even at any size. Where a level has an odd number
//! of texels, the last of the next covers only part of a texel's place. So each level carries its
//! light, `G`, and the part of a texel's place that lies in the picture, `w`, which is 1 but for the
//! last three texels of an axis: going down is the transpose of going up, for both, and `D = G/w`.
//! Along an axis of n texels this means: on both sides the taps that fall outside are folded onto the
//! edge, but at the end of an odd n they are dropped.
//!
//! What belongs into the pixel itself stays, and so does what would go farther than the picture
//! is wide: as much would come in from surroundings like it.
//!
//! How we differ: the angle between pixels is everywhere what it is in the middle of the picture, and
//! opposite edges of a whole turn are not joined. Light that meets an edge is turned back.
//!
//! Accuracy: see [`shares`].

use std::sync::LazyLock;

use rayon::prelude::*;

use crate::image::{HdrFrame, Image};
use crate::units::Angle;

use super::spread::Spread;

/// The widest level has no more texels than this on the longer edge.
const WIDEST_TEXELS: usize = 4;
/// The fit goes from the next pixel but one to this angle, or from the middle of the picture to its
/// edge.
const FARTHEST_DEG: f64 = 60.0;

/// Taps of the step from the picture to the first level, and of those between levels.
///
/// With the taps of the other steps the first would be better: the dip of [`shares`] between 2 and 4
/// pixels would be gone and its scatter halved, for four times the reads of the whole picture.
const FIRST_TAPS: [f64; 4] = [0.0, 0.5, 0.5, 0.0];
const TAPS: [f64; 4] = [0.125, 0.375, 0.375, 0.125];

/// Number of levels of a picture.
pub fn level_count(width_px: u32, height_px: u32) -> usize {
    let mut longest = width_px.max(height_px) as usize;
    let mut levels = 0;
    while longest > WIDEST_TEXELS || levels == 0 && longest > 1 {
        longest = longest.div_ceil(2);
        levels += 1;
    }
    levels
}

/// The finest level whose light a picture spreads: going up from the second level at once is cheaper, and
/// keeps the light where that has no part of a texel outside. What finer levels would spread stays in place.
pub fn finest_spread(width_px: u32, height_px: u32) -> usize {
    let is_whole = width_px.is_multiple_of(4) && height_px.is_multiple_of(4);
    if is_whole && level_count(width_px, height_px) > 1 { 2 } else { 1 }
}

/// Kernels of the first levels along an axis, at whole pixels from the centre; the others are
/// splines.
static KERNELS: LazyLock<Vec<Vec<f64>>> = LazyLock::new(|| (1..=5).map(exact_kernel).collect());

/// What level l >= 1 makes of the light of a pixel along an axis, `away` pixels from it, averaged
/// over where the pixel stands between the texels. The sum over all pixels is 1.
pub(super) fn kernel(level: usize, away: usize) -> f64 {
    match KERNELS.get(level - 1) {
        Some(kernel) => kernel.get(away).copied().unwrap_or(0.0),
        None => smooth_kernel(level, away as f64),
    }
}

/// The same for any place, for the limit of high levels: good to 1 % from level 4.
pub(super) fn smooth_kernel(level: usize, away_px: f64) -> f64 {
    let texel_px = (1u64 << level) as f64;
    quintic(away_px / texel_px) / texel_px
}

/// The B-spline of degree 5 with knots at whole numbers: 1 in all, variance 1/2.
fn quintic(x: f64) -> f64 {
    let x = x.abs();
    let power = |from: f64| (from - x).max(0.0).powi(5);
    (power(3.0) - 6.0 * power(2.0) + 15.0 * power(1.0)) / 120.0
}

fn exact_kernel(level: usize) -> Vec<f64> {
    // What pixels give to a texel, and what a texel gives to pixels, around the same place.
    let texel = vec![1.0];
    let given =
        (1..=level).fold(texel.clone(), |line, _| refined(&line, &[0.25, 0.75, 0.75, 0.25]));
    let taken = (1..level).fold(texel, |line, _| refined(&line, &TAPS));
    let taken = refined(&taken, &FIRST_TAPS);
    let offset = (given.len() - taken.len()) / 2;
    let texel_px = (1u64 << level) as f64;
    let reach = offset + taken.len();
    (0..reach)
        .map(|away| {
            let products = taken
                .iter()
                .enumerate()
                .filter_map(|(n, taken)| given.get(n + offset + away).map(|given| taken * given));
            products.sum::<f64>() / texel_px
        })
        .collect()
}

/// A line of texels on twice as many: number n goes to 2n and around it.
fn refined(line: &[f64], taps: &[f64]) -> Vec<f64> {
    let mut fine = vec![0.0; 2 * line.len() + taps.len() - 2];
    for (n, value) in line.iter().enumerate() {
        for (fine, tap) in fine[2 * n..].iter_mut().zip(taps) {
            *fine += value * tap;
        }
    }
    fine
}

/// Shares of the light that go to level 1, 2, ... of a picture; the sum is at most 1.
///
/// `pixel` is between neighbouring pixels in the middle of the picture and above zero.
///
/// Accuracy, at 1920 by 1080 pixels of 0.3 to 10 minutes, of the mean of all pixels within an octave of
/// the distance, over places of the source between the texels: 5 % from 4 pixels to 40 degrees or
/// 320 pixels, where light that the edges turn back begins to show; between 2 and 4 pixels 5 % for
/// pixels up to one minute and 14 % too little for larger ones. From one pixel to a single other
/// one it differs with their places: a factor of 2 either way next to the source (once 5, to the
/// corner of a block of 2 by 2), 1.4 farther out. A tenth of a millisecond.
pub fn shares(spread: &Spread, pixel: Angle, width_px: u32, height_px: u32) -> Vec<f64> {
    let levels = level_count(width_px, height_px);
    let pixel_deg = pixel.deg();
    let farthest_px = (f64::from(width_px.max(height_px)) / 2.0).min(FARTHEST_DEG / pixel_deg);
    let rows: Vec<Vec<f64>> = places(farthest_px)
        .map(|[x, y]| {
            let share = over_pixel(spread, [x, y], pixel_deg);
            (1..=levels).map(|level| kernel(level, x) * kernel(level, y) / share).collect()
        })
        .collect();
    let mut shares = non_negative_fit(&rows, levels);
    let sum: f64 = shares.iter().sum();
    if sum > 1.0 {
        shares.iter_mut().for_each(|share| *share /= sum);
    }
    shares
}

/// Pixels for the fit, by their distance along both axes: all close ones, then three directions.
fn places(farthest_px: f64) -> impl Iterator<Item = [usize; 2]> {
    let close = [[2, 0], [2, 1], [2, 2], [3, 0], [3, 1], [3, 3], [4, 0], [4, 2], [5, 0], [4, 4]];
    let far = (0..).map(|n| 6.0 * (f64::from(n) / 3.0).exp2());
    let far = far.take_while(move |&r| r < farthest_px).flat_map(|r| {
        [[1.0, 0.0], [0.924, 0.383], [0.707, 0.707]].map(|at| at.map(|c| (r * c).round() as usize))
    });
    close.into_iter().chain(far).filter(move |[x, y]| (*x as f64).hypot(*y as f64) < farthest_px)
}

/// The share of a pixel's light that belongs into another.
fn over_pixel(spread: &Spread, [x, y]: [usize; 2], pixel_deg: f64) -> f64 {
    let [x, y] = [x as f64, y as f64];
    let pixel_sr = pixel_deg.to_radians().powi(2);
    let at = |x: f64, y: f64| spread.at_deg(x.hypot(y) * pixel_deg);
    if x.hypot(y) > 6.0 {
        return at(x, y) * pixel_sr;
    }
    // Gauss and Legendre, three places along each axis.
    const NODES: [(f64, f64); 3] =
        [(-0.387_298_335, 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.387_298_335, 5.0 / 18.0)];
    let along = |(dy, wy): (f64, f64)| {
        NODES.iter().map(|(dx, wx)| wx * at(x + dx, y + dy)).sum::<f64>() * wy
    };
    NODES.into_iter().map(along).sum::<f64>() * pixel_sr
}

/// The factors, none below zero, with which the columns of `rows` come nearest to 1 in every row.
fn non_negative_fit(rows: &[Vec<f64>], columns: usize) -> Vec<f64> {
    const SWEEPS: usize = 300;
    let mut squares = vec![vec![0.0; columns]; columns];
    let mut sums = vec![0.0; columns];
    for row in rows {
        for (a, value) in row.iter().enumerate() {
            sums[a] += value;
            for (square, other) in squares[a].iter_mut().zip(row) {
                *square += value * other;
            }
        }
    }
    let mut factors = vec![0.0; columns];
    for _ in 0..SWEEPS {
        for a in 0..columns {
            if squares[a][a] > 0.0 {
                let product: f64 = squares[a].iter().zip(&factors).map(|(s, f)| s * f).sum();
                let step = (sums[a] - product) / squares[a][a];
                factors[a] = f64::max(factors[a] + step, 0.0);
            }
        }
    }
    factors
}

/// The part of every texel's place along an axis that lies in the picture, for level 1, 2, ...
pub fn places_within(pixels: usize, levels: usize) -> Vec<Vec<f64>> {
    let mut line = vec![1.0; pixels];
    let mut all = Vec::new();
    for level in 1..=levels {
        line = (0..line.len().div_ceil(2))
            .map(|n| taps(line.len(), n, level).map(|(at, tap)| line[at] * tap).sum())
            .collect();
        all.push(line.clone());
    }
    all
}

/// Texels of a line of `len` that give their light to number `n` of the next level, and how much.
fn taps(len: usize, n: usize, level: usize) -> impl Iterator<Item = (usize, f64)> {
    let taps = if level == 1 { FIRST_TAPS } else { TAPS };
    let even = len.is_multiple_of(2);
    (0..4).filter_map(move |k| {
        let at = (2 * n + k).saturating_sub(1);
        match at {
            at if at < len => Some((at, taps[k])),
            _ if even => Some((len - 1, taps[k])),
            _ => None,
        }
    })
}

/// Where the light of a point at `place` of an axis goes among the texels of a level: the first of
/// three texels and their weights. Texels stand at whole numbers; those beyond an edge give their
/// part to the last one within.
///
/// They are the mean of what the steps down would make of it, a quadratic B-spline.
pub fn texel_weights(place: f64) -> (i64, [f64; 3]) {
    let nearest = place.round();
    let off = place - nearest;
    let weights = [0.5 * (0.5 - off).powi(2), 0.75 - off * off, 0.5 * (0.5 + off).powi(2)];
    (nearest as i64 - 1, weights)
}

/// A level of light, row by row.
#[derive(Clone)]
struct Level {
    width: usize,
    pixels: Vec<[f64; 4]>,
}

impl Level {
    fn height(&self) -> usize {
        self.pixels.len() / self.width
    }

    fn make(width: usize, height: usize, at: impl Fn(usize, usize) -> [f64; 4] + Sync) -> Level {
        let mut pixels = vec![[0.0; 4]; width * height];
        pixels.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            row.iter_mut().enumerate().for_each(|(x, pixel)| *pixel = at(x, y));
        });
        Level { width, pixels }
    }

    /// The light of the next level.
    fn gathered(&self, level: usize) -> Level {
        let (width, height) = (self.width, self.height());
        Level::make(width.div_ceil(2), height.div_ceil(2), |x, y| {
            let mut sum = [0.0; 4];
            for (row, by_row) in taps(height, y, level) {
                for (column, by_column) in taps(width, x, level) {
                    add(&mut sum, self.pixels[row * width + column], by_row * by_column);
                }
            }
            sum
        })
    }

    /// Adds the light of a point.
    fn join(&mut self, level: usize, point: &Point) {
        let texel_px = (1u64 << level) as f64;
        let ends = [self.width, self.height()].map(|texels| texels as i64 - 1);
        let [columns, rows] = [0, 1].map(|axis| {
            let (first, weights) = texel_weights((point.place_px[axis] + 0.5) / texel_px - 0.5);
            let texel = move |n: usize| (first + n as i64).clamp(0, ends[axis]) as usize;
            [0, 1, 2].map(|n| (texel(n), weights[n] / texel_px))
        });
        for (row, by_row) in rows {
            for (column, by_column) in columns {
                add(&mut self.pixels[row * self.width + column], point.light, by_row * by_column);
            }
        }
    }

    /// Bilinear between the texels, at twice the resolution.
    fn raised(&self, x: usize, y: usize) -> [f64; 4] {
        let beside = |at: usize, len: usize| {
            let other = if at.is_multiple_of(2) { (at / 2).saturating_sub(1) } else { at / 2 + 1 };
            [(at / 2, 0.75), (other.min(len - 1), 0.25)]
        };
        let mut sum = [0.0; 4];
        for (row, by_row) in beside(y, self.height()) {
            for (column, by_column) in beside(x, self.width) {
                add(&mut sum, self.pixels[row * self.width + column], by_row * by_column);
            }
        }
        sum
    }
}

fn add(sum: &mut [f64; 4], light: [f64; 4], factor: f64) {
    sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += factor * light);
}

/// A point whose light joins the pyramid at one of its levels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Place in the picture; the middle of the first pixel is [0, 0].
    pub place_px: [f64; 2],
    /// All of its light, as the luminance of a single pixel that holds it, cd/m2.
    pub light: [f64; 4],
}

/// Standard deviation of what a level does to a pixel, along an axis, pixels: that of its quintic B-spline.
pub fn level_sigma_px(level: i32) -> f64 {
    (4f64.powi(level) / 2.0 - 1.0).sqrt()
}

/// The light of a level, from 1, as the steps down leave it: what lies in the place of each texel.
pub fn gathered(frame: &HdrFrame, level: usize) -> HdrFrame {
    let pixels = frame.pixels().iter().map(|pixel| pixel.map(f64::from)).collect();
    let mut light = Level { width: frame.width_px() as usize, pixels };
    for level in 1..=level {
        light = light.gathered(level);
    }
    let (width, height) = (light.width as u32, light.height() as u32);
    let pixels = light.pixels.iter().map(|pixel| pixel.map(|light| light as f32)).collect();
    Image::from_pixels(width, height, pixels).expect("as many pixels")
}

/// A frame as it reaches the retina when level 1, 2, ... get these shares: the slow twin, in f64,
/// of what the renderer does.
pub fn scattered_by(frame: &HdrFrame, shares: &[f64]) -> HdrFrame {
    scattered_with(frame, shares, 0, &[])
}

/// The same with points that join at a level, 1 or more: what wider levels make of them is added.
pub fn scattered_with(
    frame: &HdrFrame,
    shares: &[f64],
    joins_at: usize,
    points: &[Point],
) -> HdrFrame {
    let (width, height) = (frame.width_px() as usize, frame.height_px() as usize);
    let within = [width, height].map(|pixels| places_within(pixels, shares.len()));
    let pixels = frame.pixels().iter().map(|pixel| pixel.map(f64::from)).collect();
    let mut light = vec![Level { width, pixels }];
    for level in 1..=shares.len() {
        let mut gathered = light[level - 1].gathered(level);
        if level == joins_at {
            points.iter().for_each(|point| gathered.join(level, point));
        }
        light.push(gathered);
    }
    let mut wider: Option<Level> = None;
    for (level, share) in shares.iter().enumerate().map(|(n, share)| (n + 1, share)).rev() {
        let own = &light[level];
        wider = Some(Level::make(own.width, own.height(), |x, y| {
            let place = within[0][level - 1][x] * within[1][level - 1][y];
            let mut sum = wider.as_ref().map_or([0.0; 4], |wider| wider.raised(x, y));
            add(&mut sum, own.pixels[y * own.width + x], share / place);
            sum
        }));
    }
    let stays = 1.0 - shares.iter().sum::<f64>();
    let mut retina = frame.clone();
    retina.pixels_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, pixel) in row.iter_mut().enumerate() {
            let mut sum = wider.as_ref().map_or([0.0; 4], |wider| wider.raised(x, y));
            add(&mut sum, light[0].pixels[y * width + x], stays);
            *pixel = sum.map(|light| light as f32);
        }
    });
    retina
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eye::glare::{Glare, Optics};

    fn day_shares(pixel_deg: f64, width_px: u32, height_px: u32) -> Vec<f64> {
        let spread = Glare::Cie.spread(&Optics::default(), 3.0).unwrap();
        shares(&spread, Angle::from_deg(pixel_deg), width_px, height_px)
    }

    fn sums(frame: &HdrFrame) -> [f64; 4] {
        frame.pixels().iter().fold([0.0; 4], |sum, pixel| {
            [0, 1, 2, 3].map(|channel| sum[channel] + f64::from(pixel[channel]))
        })
    }

    #[test]
    fn kernels_hold_one_unit_and_are_as_wide_as_said() {
        for level in 1..=8usize {
            let line: Vec<f64> = (0..2000).map(|away| kernel(level, away)).collect();
            let both = |value: &dyn Fn(usize) -> f64| -> f64 {
                line.iter()
                    .enumerate()
                    .map(|(n, k)| k * value(n) * if n > 0 { 2.0 } else { 1.0 })
                    .sum()
            };
            let [sum, variance] = [both(&|_| 1.0), both(&|n| (n * n) as f64)];
            assert!((sum - 1.0).abs() < 1e-9, "{level}: {sum}");
            let expected = 4f64.powi(level as i32) / 2.0 - if level <= 5 { 1.0 } else { 0.0 };
            assert!((variance / expected - 1.0).abs() < 1e-9, "{level}: {variance}");
        }
    }

    #[test]
    fn light_is_conserved_at_every_size() {
        for (width, height) in [(64, 64), (61, 45), (135, 77), (1, 33), (97, 2)] {
            // Shares as large as they come, so that errors show.
            let levels = level_count(width, height);
            let shares = vec![0.9 / levels as f64; levels];
            for at in [[0, 0], [width - 1, height - 1], [width - 1, 0], [width / 2, height / 3]] {
                let mut frame = Image::filled(width, height, [0.0; 4]);
                frame.pixels_mut()[(at[1] * width + at[0]) as usize] = [1.0, 2.0, 3.0, 4.0];
                let after = sums(&scattered_by(&frame, &shares));
                for (before, after) in sums(&frame).iter().zip(after) {
                    assert!(
                        (after / before - 1.0).abs() < 1e-6,
                        "{width} {height} {at:?}: {after}"
                    );
                }
            }
        }
    }

    #[test]
    fn an_even_frame_stays_even() {
        for (width, height) in [(1, 1), (3, 200), (333, 97), (135, 135)] {
            let frame = Image::filled(width, height, [1.0, 10.0, 1e5, 1e-4]);
            for pixel_deg in [0.005, 0.3, 5.0] {
                let retina = scattered_by(&frame, &day_shares(pixel_deg, width, height));
                for (before, after) in frame.pixels().iter().zip(retina.pixels()) {
                    for (before, after) in before.iter().zip(after) {
                        assert!((after / before - 1.0).abs() < 1e-6, "{before} {after}");
                    }
                }
            }
        }
    }

    /// Texels that lie in the picture as a whole have their place: only the last three may not.
    #[test]
    fn only_the_last_texels_lie_partly_outside() {
        for pixels in [1080usize, 1920, 135, 1001, 7] {
            for (level, line) in (1..).zip(places_within(pixels, 8)) {
                let inner = &line[..line.len().saturating_sub(3)];
                assert!(inner.iter().all(|place| (place - 1.0).abs() < 1e-12), "{pixels} {level}");
                let sum: f64 = line.iter().sum();
                let places = pixels as f64 / f64::from(1 << level);
                assert!((sum / places - 1.0).abs() < 1e-12, "{pixels} {level}: {sum}");
            }
        }
    }

    #[test]
    fn shares_are_those_of_light_that_is_there() {
        for pixel_deg in [0.0005, 0.005, 0.05, 0.3, 2.0] {
            for (width, height) in [(1920, 1080), (100, 700), (2, 1), (1, 1)] {
                let shares = day_shares(pixel_deg, width, height);
                assert_eq!(shares.len(), level_count(width, height));
                assert!(shares.iter().all(|share| *share >= 0.0 && share.is_finite()));
                assert!(shares.iter().sum::<f64>() <= 1.0 + 1e-12);
            }
        }
    }

    #[test]
    fn texels_share_a_point_without_moving_it() {
        for place in [0.0, 0.3, 0.5, 7.49, 12.9] {
            let (first, weights) = texel_weights(place);
            let sum: f64 = weights.iter().sum();
            let mean: f64 = (first..).zip(weights).map(|(at, weight)| at as f64 * weight).sum();
            assert!((sum - 1.0).abs() < 1e-12 && (mean - place).abs() < 1e-12, "{place}");
        }
    }

    /// Points that join at a level give what its share and those of the wider ones say, and give it
    /// as a pixel of the frame would.
    #[test]
    fn points_join_the_wider_levels() {
        let (width, height) = (517, 333);
        let shares = day_shares(0.05, width, height);
        let dark = Image::filled(width, height, [0.0; 4]);
        let wide: f64 = shares[2..].iter().sum();
        for place in [[0u32, 0], [516, 332], [300, 150], [201, 332]] {
            let place_px = place.map(f64::from);
            let points = [Point { place_px, light: [1.0, 2.0, 3.0, 4.0] }];
            let joined = scattered_with(&dark, &shares, 3, &points);
            for (sum, light) in sums(&joined).iter().zip([1.0, 2.0, 3.0, 4.0]) {
                assert!((sum / (wide * light) - 1.0).abs() < 1e-5, "{place:?}: {sum}");
            }
            let mut frame = dark.clone();
            frame.pixels_mut()[(place[1] * width + place[0]) as usize] = [1.0, 2.0, 3.0, 4.0];
            let only_wide = shares.iter().enumerate().map(|(n, s)| if n < 2 { 0.0 } else { *s });
            let drawn = scattered_by(&frame, &only_wide.collect::<Vec<_>>());
            for away in [[9u32, 0], [40, 0], [40, 40], [0, 100]] {
                let [x, y] = [0, 1].map(|axis| {
                    let (at, end) = (place[axis], [width, height][axis]);
                    if at + away[axis] < end { at + away[axis] } else { at - away[axis] }
                });
                let ratio = joined.at(x, y)[1] / drawn.at(x, y)[1];
                assert!((0.85..1.15).contains(&ratio), "{place:?} {away:?}: {ratio}");
            }
        }
    }
}

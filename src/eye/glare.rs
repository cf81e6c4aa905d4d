//! Glare: light that the eye scatters on its way to the retina, so that a bright star looks larger
//! than a faint one and the Moon wears a veil.
//!
//! Theory: the CIE total glare equation (Vos & van den Berg 1999, CIE Collection 135/1): a sum of
//! bells `c / (1 + (t/a)^2)^p` in the angle t, normalised over the hemisphere in front of the eye.
//! Each bell is a mixture of Gaussians of every width in closed form, `(1 + x)^-p` being the mean
//! of `exp(-v x)` over v of a gamma distribution. We sum the mixture at widths a factor of two
//! apart, each on a picture half as fine as the one before: a pyramid whose steps down and up
//! are each other's transpose, so that what leaves one pixel for another is what comes back for
//! as much light there.
//!
//! Light that would leave the picture, or reach directions more than a hemisphere away, stays
//! where it came from: as much would come in from surroundings like it. So the light of the
//! whole picture is conserved, and an even picture stays even.
//!
//! How we differ: the angle between neighbouring pixels is taken to be everywhere what it is in
//! the middle of the picture, and opposite edges of a whole turn are not joined. The spread is that
//! of daylight also by night, for all colours alike (no lenticular halo, no wider pupil). Beyond
//! 90 degrees it goes on where it should end, and its term in t^2 is left out: 1 % of it at 40
//! degrees, 10 % at 90. Pixels without sky receive light like any other.
//!
//! Accuracy: the spread from one pixel to another within 5 % of the equation averaged over the
//! pixel, from one pixel to 60 degrees.

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::image::{HdrFrame, Image};
use crate::units::Angle;

/// Age of the observer, years, and pigment of the eyes: 0 very dark, 0.5 brown, 1.2 light blue.
const AGE_YEARS: f64 = 30.0;
const PIGMENT: f64 = 0.5;

/// A bell of the equation, `peak_per_sr / (1 + (t / width_deg)^2)^power`.
struct Bell {
    peak_per_sr: f64,
    width_deg: f64,
    power: f64,
    /// The gamma function of the power.
    gamma: f64,
}

/// The CIE total glare equation: its bells, and a constant per steradian.
fn equation() -> ([Bell; 5], f64) {
    let root_pi = PI.sqrt();
    let aged = (AGE_YEARS / 70.0).powi(4);
    let (sharp, veil) = (1.0 - 0.08 * aged, 1.0 + 1.6 * aged);
    let whole = 1.0 + PIGMENT * (0.0417 + 0.055 * aged);
    let bell = |peak: f64, width_deg: f64, power: f64, gamma: f64| Bell {
        peak_per_sr: peak / whole / HEMISPHERE,
        width_deg,
        power,
        gamma,
    };
    let bells = [
        bell(sharp * 9.2e6, 0.0046, 1.5, root_pi / 2.0),
        bell(sharp * 1.5e5, 0.045, 1.5, root_pi / 2.0),
        bell(veil * 400.0, 0.1, 1.0, 1.0),
        bell(veil * PIGMENT * 1300.0, 0.1, 1.5, root_pi / 2.0),
        bell(veil * PIGMENT * 0.8, 0.1, 0.5, root_pi),
    ];
    (bells, 2.5e-3 * PIGMENT / whole / HEMISPHERE)
}

/// Integral of the equation, as it is written and without its term in t^2, over the hemisphere.
const HEMISPHERE: f64 = 1.009_575_9;

/// Taps of a step between levels, along one axis.
const STEP: [f32; 5] = [0.0625, 0.25, 0.375, 0.25, 0.0625];
/// Standard deviation of the Gaussian of a level, in its own pixels, and its reach.
const LEVEL_SIGMA_PX: f64 = 1.2;
const LEVEL_REACH_PX: usize = 5;
/// Gaussians on the picture itself.
const NEAR: usize = 3;
/// A spread wider than this many times the picture, or than half a turn, is even all over it.
const WIDEST_PICTURES: f64 = 4.0;
const WIDEST_DEG: f64 = 180.0;

/// Standard deviation of what level n >= 1 does, in pixels of the picture: the Gaussian and,
/// twice, the steps, whose variance is 1 in pixels of the finer level.
fn level_sigma_px(level: i32) -> f64 {
    let steps = 2.0 / 3.0 * (1.0 - 0.25f64.powi(level));
    2f64.powi(level) * (LEVEL_SIGMA_PX.powi(2) + steps).sqrt()
}

/// Standard deviation of Gaussian number `index`, pixels: first those on the picture itself.
fn sigma_px(index: usize) -> f64 {
    let level = index as i32 - NEAR as i32 + 1;
    if level > 0 { level_sigma_px(level) } else { level_sigma_px(1) * 2f64.powi(level - 1) }
}

/// Share of the light that goes to each Gaussian, narrowest first; the rest stays in place.
fn shares(longest_edge_px: f64, pixel_deg: f64) -> Vec<f64> {
    let (bells, constant_per_sr) = equation();
    // Height of a Gaussian at its centre, per steradian.
    let height = |index: usize, spacing: f64| -> f64 {
        let sigma_deg = sigma_px(index) * pixel_deg;
        let at = |bell: &Bell| {
            let v = (bell.width_deg / sigma_deg).powi(2) / 2.0;
            bell.peak_per_sr * 2.0 * v.powf(bell.power) * (-v).exp() / bell.gamma
        };
        bells.iter().map(at).sum::<f64>() * spacing
    };
    let spacing = |index: usize| {
        let narrower = if index == 0 { sigma_px(0) / 2.0 } else { sigma_px(index - 1) };
        (sigma_px(index + 1) / narrower).ln() / 2.0
    };
    let widest_px = (WIDEST_PICTURES * longest_edge_px).min(WIDEST_DEG / pixel_deg);
    let mut shares = Vec::new();
    loop {
        let index = shares.len();
        let last = index >= NEAR && sigma_px(index) >= widest_px;
        let mut per_sr = height(index, spacing(index));
        if last {
            // All wider ones, as high and as even within the picture.
            per_sr +=
                (index + 1..index + 40).map(|wider| height(wider, spacing(wider))).sum::<f64>();
            per_sr += constant_per_sr;
        }
        let sigma_rad = (sigma_px(index) * pixel_deg).to_radians();
        shares.push(per_sr * 2.0 * PI * sigma_rad * sigma_rad);
        if last {
            return shares;
        }
    }
}

/// Taps of a Gaussian averaged over each pixel, from the centre outwards on both sides.
fn near_taps(sigma_px: f64) -> Vec<f32> {
    let reach = (4.0 * sigma_px).ceil() as i32;
    let parts = 64;
    let over_pixel = |offset: i32| -> f64 {
        let at = |part: i32| f64::from(offset) + (f64::from(part) + 0.5) / f64::from(parts) - 0.5;
        (0..parts).map(|part| (-(at(part) / sigma_px).powi(2) / 2.0).exp()).sum()
    };
    normalised((-reach..=reach).map(over_pixel).collect())
}

/// Taps of the Gaussian of a level.
fn level_taps() -> Vec<f32> {
    let reach = LEVEL_REACH_PX as i32;
    let at = |offset: i32| (-(f64::from(offset) / LEVEL_SIGMA_PX).powi(2) / 2.0).exp();
    normalised((-reach..=reach).map(at).collect())
}

fn normalised(taps: Vec<f64>) -> Vec<f32> {
    let sum: f64 = taps.iter().sum();
    taps.iter().map(|tap| (tap / sum) as f32).collect()
}

/// A Gaussian on the picture itself.
struct Near {
    share: f32,
    taps: Vec<f32>,
}

/// The frame as it reaches the retina; its pixels are `pixel_angle` apart in its middle, which is
/// more than zero.
pub fn scattered(frame: &HdrFrame, pixel_angle: Angle) -> HdrFrame {
    let glare = Glare::of(frame, pixel_angle);
    in_rows(frame.width_px(), frame.height_px(), |y, padded, row| glare.fill(y, padded, row))
}

/// The light that the pixels of a frame give to one another.
struct Glare<'a> {
    frame: &'a HdrFrame,
    near: Vec<Near>,
    /// All levels, gathered on the first.
    wide: HdrFrame,
    /// What each Gaussian leaves within the columns and, times its share, within the rows.
    within: Vec<[Vec<f32>; 2]>,
}

impl<'a> Glare<'a> {
    fn of(frame: &'a HdrFrame, pixel_angle: Angle) -> Glare<'a> {
        let (width, height) = (frame.width_px() as usize, frame.height_px() as usize);
        let mut shares = shares(width.max(height) as f64, pixel_angle.deg());
        let mut within: Vec<[Vec<f32>; 2]> = (0..shares.len())
            .map(|index| [width, height].map(|pixels| within_line(pixels, index)))
            .collect();
        // The middle gives away most; not even there may it be more than there is.
        let given: f64 = shares
            .iter()
            .zip(&within)
            .map(|(share, [x, y])| share * f64::from(x[width / 2] * y[height / 2]))
            .sum();
        shares.iter_mut().for_each(|share| *share /= given.max(1.0));

        for (share, [_, rows]) in shares.iter().zip(&mut within) {
            rows.iter_mut().for_each(|row| *row *= *share as f32);
        }
        let near = (0..NEAR)
            .map(|index| Near { share: shares[index] as f32, taps: near_taps(sigma_px(index)) })
            .collect();
        Glare { frame, near, wide: wide(frame, &shares[NEAR..]), within }
    }

    /// A row of the frame as it reaches the retina.
    fn fill(&self, y: usize, padded: &mut Vec<f32>, row: &mut [[f32; 4]]) {
        let given = padded;
        given.clear();
        given.resize(row.len(), 0.0);
        for [columns, rows] in &self.within {
            add_scaled(given, columns, rows[y]);
        }
        for ((row, light), given) in row.iter_mut().zip(row_of(self.frame, y)).zip(&*given) {
            *row = light.map(|channel| channel * (1.0 - given));
        }
        let padded = given;
        for Near { share, taps } in &self.near {
            add_blurred(self.frame, y, taps, *share, padded, row);
        }
        add_doubled(&self.wide, y, padded, row);
    }
}

/// The sum of all levels, on the first of them.
fn wide(frame: &HdrFrame, shares: &[f64]) -> HdrFrame {
    let mut levels = vec![halved(frame)];
    while levels.len() < shares.len() {
        levels.push(halved(&levels[levels.len() - 1]));
    }
    let taps = level_taps();
    let mut wider: Option<HdrFrame> = None;
    while let (Some(level), Some(share)) = (levels.pop(), shares.get(levels.len())) {
        let (width, height) = (level.width_px(), level.height_px());
        wider = Some(in_rows(width, height, |y, padded, row| {
            row.fill([0.0; 4]);
            add_blurred(&level, y, &taps, *share as f32, padded, row);
            if let Some(wider) = &wider {
                add_doubled(wider, y, padded, row);
            }
        }));
    }
    wider.unwrap_or_else(|| Image::filled(1, 1, [0.0; 4]))
}

/// A frame made row by row, with room for one padded row.
fn in_rows(
    width_px: u32,
    height_px: u32,
    make: impl Fn(usize, &mut Vec<f32>, &mut [[f32; 4]]) + Sync,
) -> HdrFrame {
    let mut frame = Image::filled(width_px, height_px, [0.0; 4]);
    frame
        .pixels_mut()
        .par_chunks_mut(width_px as usize)
        .enumerate()
        .for_each_init(Vec::new, |padded, (y, row)| make(y, padded, row));
    frame
}

/// Pixels of the coarser line that light of a line of `pixels` comes to: one more on each side.
/// Number n of them lies on number 2 (n - 1) of the finer.
fn halved_len(pixels: usize) -> usize {
    (pixels - 1) / 2 + 3
}

/// The frame at half its resolution.
fn halved(fine: &HdrFrame) -> HdrFrame {
    let [width, height] =
        [fine.width_px(), fine.height_px()].map(|pixels| halved_len(pixels as usize));
    in_rows(width as u32, height as u32, |y, padded, row| {
        gather_rows(fine, 2 * y as isize - 2, &STEP, 4, padded);
        let (fine, _) = padded.as_chunks::<4>();
        for (coarse, fine) in row.iter_mut().zip(fine.windows(STEP.len()).step_by(2)) {
            *coarse = [0, 1, 2, 3].map(|channel| {
                STEP.iter().zip(fine).map(|(tap, pixel)| tap * pixel[channel]).sum()
            });
        }
    })
}

/// Adds row `y` of twice the resolution of a frame: the transpose of [`halved`].
fn add_doubled(coarse: &HdrFrame, y: usize, padded: &mut Vec<f32>, row: &mut [[f32; 4]]) {
    let [far, half, near, ..] = STEP.map(|tap| 2.0 * tap);
    let taps = if y.is_multiple_of(2) { [far, near, far] } else { [0.0, half, half] };
    gather_rows(coarse, y as isize / 2 + 1, &taps, 0, padded);
    let (coarse, _) = padded.as_chunks::<4>();
    for (fine, [left, on, right]) in row.chunks_mut(2).zip(coarse.array_windows()) {
        for (channel, fine) in fine[0].iter_mut().enumerate() {
            *fine += far * (left[channel] + right[channel]) + near * on[channel];
        }
        if let Some(fine) = fine.get_mut(1) {
            for (channel, fine) in fine.iter_mut().enumerate() {
                *fine += half * (on[channel] + right[channel]);
            }
        }
    }
}

/// Adds a share of row `y` of a frame blurred by a separable kernel.
fn add_blurred(
    frame: &HdrFrame,
    y: usize,
    taps: &[f32],
    share: f32,
    padded: &mut Vec<f32>,
    row: &mut [[f32; 4]],
) {
    let reach = taps.len() / 2;
    gather_rows(frame, y as isize, taps, reach, padded);
    let row = row.as_flattened_mut();
    for (shift, tap) in taps.iter().enumerate() {
        add_scaled(row, &padded[4 * shift..], share * tap);
    }
}

/// The sum of the rows around `centre`, each times its tap, with dark pixels added on both sides.
/// It is dark beyond the frame.
fn gather_rows(
    frame: &HdrFrame,
    centre: isize,
    taps: &[f32],
    padding_px: usize,
    padded: &mut Vec<f32>,
) {
    let floats = 4 * frame.width_px() as usize;
    padded.clear();
    padded.resize(floats + 8 * padding_px, 0.0);
    let sum = &mut padded[4 * padding_px..][..floats];
    for (row, tap) in (centre - taps.len() as isize / 2..).zip(taps) {
        if (0..frame.height_px() as isize).contains(&row) {
            add_scaled(sum, row_of(frame, row as usize).as_flattened(), *tap);
        }
    }
}

fn row_of(frame: &HdrFrame, y: usize) -> &[[f32; 4]] {
    let width = frame.width_px() as usize;
    &frame.pixels()[y * width..][..width]
}

fn add_scaled(sum: &mut [f32], addend: &[f32], factor: f32) {
    for (sum, addend) in sum.iter_mut().zip(addend) {
        *sum += factor * addend;
    }
}

/// What Gaussian number `index` makes of a line of ones: the share of a pixel's light that it
/// leaves within the line. The same steps as on frames, along one axis.
fn within_line(pixels: usize, index: usize) -> Vec<f32> {
    let mut line = vec![1.0; pixels];
    if index < NEAR {
        return blurred_line(&line, &near_taps(sigma_px(index)));
    }
    let mut lengths = vec![];
    for _ in NEAR..=index {
        lengths.push(line.len());
        line =
            (0..halved_len(line.len()) as isize).map(|n| tapped(&line, 2 * n - 2, &STEP)).collect();
    }
    line = blurred_line(&line, &level_taps());
    for length in lengths.into_iter().rev() {
        let mut fine = vec![0.0; length];
        for (n, coarse) in (0..).zip(&line) {
            for (at, tap) in (2 * n - 4..).zip(STEP) {
                if (0..length as isize).contains(&at) {
                    fine[at as usize] += 2.0 * tap * coarse;
                }
            }
        }
        line = fine;
    }
    line
}

fn blurred_line(line: &[f32], taps: &[f32]) -> Vec<f32> {
    (0..line.len() as isize).map(|centre| tapped(line, centre, taps)).collect()
}

fn tapped(line: &[f32], centre: isize, taps: &[f32]) -> f32 {
    let around = (centre - taps.len() as isize / 2..).zip(taps);
    around
        .map(|(at, tap)| usize::try_from(at).ok().and_then(|at| line.get(at)).unwrap_or(&0.0) * tap)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The equation, per steradian, `t` degrees from the source; normalised.
    fn spread_per_sr(t_deg: f64) -> f64 {
        let (bells, constant) = equation();
        let at = |b: &Bell| b.peak_per_sr / (1.0 + (t_deg / b.width_deg).powi(2)).powf(b.power);
        bells.iter().map(at).sum::<f64>() + constant
    }

    /// The share of a pixel's light that belongs into another, `[x, y]` pixels away.
    fn expected(away_px: [f64; 2], pixel_deg: f64) -> f64 {
        let parts = if away_px[0].hypot(away_px[1]) < 8.0 { 32 } else { 4 };
        let part = |n: i32| (f64::from(n) + 0.5) / f64::from(parts) - 0.5;
        let mut sum = 0.0;
        for y in 0..parts {
            for x in 0..parts {
                let t_px = (away_px[0] + part(x)).hypot(away_px[1] + part(y));
                sum += spread_per_sr(t_px * pixel_deg);
            }
        }
        sum / f64::from(parts * parts) * pixel_deg.to_radians().powi(2)
    }

    fn black(width_px: u32, height_px: u32) -> HdrFrame {
        Image::filled(width_px, height_px, [0.0; 4])
    }

    /// Light of a pixel in all channels.
    fn point(width_px: u32, height_px: u32, [x, y]: [u32; 2]) -> HdrFrame {
        let mut frame = black(width_px, height_px);
        frame.pixels_mut()[(y * width_px + x) as usize] = [1.0, 2.0, 3.0, 4.0];
        frame
    }

    fn sum(frame: &HdrFrame) -> [f64; 4] {
        frame.pixels().iter().fold([0.0; 4], |sum, pixel| {
            [0, 1, 2, 3].map(|channel| sum[channel] + f64::from(pixel[channel]))
        })
    }

    #[test]
    fn the_spread_is_normalised_over_the_hemisphere() {
        let steps = 200_000;
        let [low, high] = [1e-6f64, 90.0].map(f64::ln);
        let step = (high - low) / f64::from(steps);
        let integral: f64 = (0..steps)
            .map(|n| {
                let t_deg = (low + (f64::from(n) + 0.5) * step).exp();
                let ring_sr = 2.0 * PI * t_deg.to_radians().sin() * t_deg.to_radians() * step;
                spread_per_sr(t_deg) * ring_sr
            })
            .sum();
        assert!((integral - 1.0).abs() < 1e-5, "{integral}");
    }

    /// The CIE General Disability Glare equation (Vos 2003, *Clin Exp Optom* 86, 363), which is
    /// simpler and fitted to the same measurements.
    #[test]
    fn the_spread_agrees_with_the_general_equation() {
        for t in [0.1f64, 0.3, 1.0, 3.0, 10.0, 30.0] {
            let aged = 1.0 + (AGE_YEARS / 62.5).powi(4);
            let general =
                10.0 / t.powi(3) + (5.0 / t.powi(2) + 0.1 * PIGMENT / t) * aged + 2.5e-3 * PIGMENT;
            let ratio = spread_per_sr(t) * HEMISPHERE / general;
            assert!((1.0 / 1.35..1.35).contains(&ratio), "{t}: {ratio}");
        }
    }

    #[test]
    fn light_is_conserved() {
        for at in [[300, 300], [0, 0], [17, 598]] {
            for pixel_deg in [0.005, 0.05, 0.3] {
                let frame = point(600, 599, at);
                let [before, after] =
                    [sum(&frame), sum(&scattered(&frame, Angle::from_deg(pixel_deg)))];
                for (before, after) in before.iter().zip(after) {
                    assert!((after / before - 1.0).abs() < 1e-5, "{at:?}: {before} {after}");
                }
            }
        }
    }

    #[test]
    fn the_profile_is_that_of_the_equation() {
        let (width, height, at) = (1920u32, 400u32, [6u32, 10u32]);
        for pixel_deg in [0.005, 0.05, 0.3] {
            let retina = scattered(&point(width, height, at), Angle::from_deg(pixel_deg));
            let reach = (60.0 / pixel_deg) as u32;
            for away in (1..12).chain((12..).step_by(7)).take_while(|&n| n < reach.min(width - 6)) {
                for away in [[away, 0], [away, away / 2], [away, away], [0, away]] {
                    if at[0] + away[0] >= width || at[1] + away[1] >= height {
                        continue;
                    }
                    let [_, share, ..] = retina.at(at[0] + away[0], at[1] + away[1]);
                    let ratio = f64::from(share) / 2.0 / expected(away.map(f64::from), pixel_deg);
                    assert!((ratio - 1.0).abs() < 0.05, "{pixel_deg}, {away:?}: {ratio}");
                }
            }
        }
    }

    /// The star is splatted as the renderer does it, by cubic B-splines.
    #[test]
    fn a_halo_does_not_know_the_pixels() {
        let spline = |t: f64| match t.abs() {
            t if t < 1.0 => 2.0 / 3.0 - t * t + t.powi(3) / 2.0,
            t if t < 2.0 => (2.0 - t).powi(3) / 6.0,
            _ => 0.0,
        };
        let pixel_at = |n: u32| [n % 301, n / 301].map(f64::from);
        let mut first: Option<[f64; 5]> = None;
        for off in [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [1.3, 2.7], [3.2, 6.9], [9.0, 14.4]] {
            let centre = off.map(|off| 150.0 + off);
            let mut frame = black(301, 301);
            for (n, pixel) in (0..).zip(frame.pixels_mut()) {
                let [x, y] = pixel_at(n);
                *pixel = [(spline(x - centre[0]) * spline(y - centre[1])) as f32; 4];
            }
            let star: Vec<(u32, f64)> = (0..)
                .zip(frame.pixels())
                .filter(|(_, light)| light[1] > 0.0)
                .map(|(n, light)| (n, f64::from(light[1])))
                .collect();
            let retina = scattered(&frame, Angle::from_deg(0.05));

            let mut moment = [0.0; 2];
            let mut worst = 0.0f64;
            let mut rings = [(0.0, 0); 5];
            for (n, light) in (0..).zip(retina.pixels()) {
                let [x, y] = pixel_at(n);
                let away = (x - centre[0]).hypot(y - centre[1]);
                let light = f64::from(light[1]);
                if away < 100.0 {
                    moment[0] += light * (x - centre[0]);
                    moment[1] += light * (y - centre[1]);
                }
                // Beyond the star's own pixels; all of the inner ones and some of the many outer.
                if away < 128.0 && away > 4.0 && (away < 16.0 || n % 29 == 0) {
                    let part = |&(from, share): &(u32, f64)| {
                        let [from_x, from_y] = pixel_at(from);
                        share * expected([x - from_x, y - from_y], 0.05)
                    };
                    let error = light / star.iter().map(part).sum::<f64>() - 1.0;
                    worst = worst.max(error.abs());
                    let ring = &mut rings[away.log2() as usize - 2];
                    *ring = (ring.0 + error, ring.1 + 1);
                }
            }
            // The light stays centred on the star.
            assert!(moment[0].hypot(moment[1]) < 0.001, "{off:?}: {moment:?}");
            assert!(worst < 0.05, "{off:?}: {worst}");
            // Around it, in rings, the halo is as bright wherever the star stands in its pixel.
            let rings = rings.map(|(sum, count)| sum / f64::from(count));
            let first = *first.get_or_insert(rings);
            for (ring, first) in rings.iter().zip(first) {
                assert!((ring - first).abs() < 0.005, "{off:?}: {rings:?}");
            }
        }
    }

    #[test]
    fn an_even_frame_stays_even() {
        for (width, height) in [(1, 1), (3, 200), (333, 97)] {
            for pixel_deg in [0.005, 0.05, 0.3, 5.0] {
                let frame = Image::filled(width, height, [1.0, 10.0, 1e5, 1e-4]);
                let retina = scattered(&frame, Angle::from_deg(pixel_deg));
                for (before, after) in frame.pixels().iter().zip(retina.pixels()) {
                    for (before, after) in before.iter().zip(after) {
                        assert!((after / before - 1.0).abs() < 1e-5, "{before} {after}");
                    }
                }
            }
        }
    }

    #[test]
    fn more_light_makes_nothing_darker() {
        let [mut frame, _] = [point(90, 70, [40, 30]), black(90, 70)];
        frame.pixels_mut()[0] = [1e9; 4];
        let before = scattered(&frame, Angle::from_deg(0.05));
        frame.pixels_mut()[20 * 90 + 75] = [7.0; 4];
        let after = scattered(&frame, Angle::from_deg(0.05));
        for (before, after) in before.pixels().iter().zip(after.pixels()) {
            assert!(before.iter().zip(after).all(|(before, after)| after >= before));
        }
    }

    #[test]
    fn threads_do_not_change_the_bits() {
        let frame = Image::from_pixels(
            257,
            130,
            (0..257 * 130)
                .map(|n| [(n * n % 1009) as f32, n as f32, 1e9 / (n + 1) as f32, 1.0])
                .collect(),
        );
        let frame = frame.unwrap();
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| scattered(&frame, Angle::from_deg(0.05)))
        };
        assert!(with(1) == with(3));
    }
}

//! Glare of points: how the light of a star is drawn.
//!
//! A star is no pixel of the extended light. Its light has four parts, which sum to 1:
//!
//! - the *core*, drawn as sharp as the picture allows (a cubic B-spline over the pixels);
//! - the *near* halo, drawn as a round sprite of up to about half a degree;
//! - the *wide* rest, which joins the pyramid of the extended light at the level whose texels are
//!   about half a degree, and shares its way from there;
//! - the *flare* of wide pupils ([`super::flare`]), for the few points for which it can be seen.
//!
//! Theory: what the pyramid makes of all of a point's light from that level on is known: the sum
//! of the shares of these levels, each over its kernel. So all of it is put in there
//! ([`super::pyramid::Point`]), and only these shares come out. The near halo is what the spread
//! function has beyond that. Closer than a pixel the halo is held at its value there, and the rest is
//! the core. Core and halo are so soft that their sums over the pixels do not depend on where among
//! them the star stands.
//!
//! Where the flare is drawn, the needles of the corona take light that near and wide parts would
//! have had, in proportion to both; the ring takes its own from the core.
//!
//! How we differ: the halo is round and ends where the wide part has taken over.
//!
//! Accuracy: core, sprite as summed over the pixels, wide part and flare hold all of the light to
//! 1e-4, for pixels of 0.5 to 15 minutes. Near and wide part together follow the spread function
//! within 22 % from 4 pixels to 10 degrees or 500 pixels: softness makes the halo too bright by 15 %
//! at 4 pixels, the rest is the pyramid's.

use std::f64::consts::PI;

use crate::units::Angle;

use super::flare::Flare;
use super::pyramid::{level_count, smooth_kernel};
use super::spread::Spread;

/// Texels of the level that takes the wide part are about this large.
const WIDE_TEXEL_ARCMIN: f64 = 30.0;
/// The first level is too fine to take over from a sprite, and the picture is finished at the first two:
/// what points put into them would be seen in place.
const LEAST_LEVEL: f64 = 3.0;
/// The sprite ends so many of these texels from its star, and begins to fade at the other.
const REACH_TEXELS: f64 = 1.3;
const FADES_TEXELS: f64 = 0.7;
/// Closer to the star than this many pixels the halo rises no more.
const FLAT_PX: f64 = 1.0;
/// Variance of the Gaussian that softens the halo, along an axis, square pixels: somewhat more than
/// the 1/3 of a cubic B-spline, so that sums over pixels are steady.
const SOFT_VARIANCE_PX2: f64 = 0.5;
/// Rows of the table per factor of two in the radius, and its first radius.
pub const PER_OCTAVE: usize = 20;
pub const FIRST_PX: f64 = 0.0625;

/// The level of a pyramid of so many, from 1, that takes the light of points; 0 if there is none.
pub fn wide_level(pixel: Angle, levels: usize) -> usize {
    let level = (WIDE_TEXEL_ARCMIN / pixel.arcmin()).log2().round();
    (level.max(LEAST_LEVEL) as usize).min(levels)
}

/// How the light of a point is parted. The sum of all is 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parts {
    pub core: f64,
    /// Of the sprite, over all its pixels.
    pub near: f64,
    /// Of what comes out of the pyramid.
    pub wide: f64,
    /// Of the flare, over its whole texture.
    pub flare: f64,
    /// Factor for [`Halo::per_px`] and for the light that is put into the pyramid.
    pub smooth: f64,
}

/// The halo of points in a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Halo {
    /// The level of the pyramid, from 1, that takes the light of points; 0 if there is none.
    pub level: usize,
    /// Half the width of the sprite, pixels.
    pub reach_px: f64,
    /// Shares per square pixel at radii of `FIRST_PX * 2^(n/20)` pixels, zero at the last.
    table: Vec<f64>,
    near: f64,
    wide: f64,
}

impl Halo {
    /// For a picture with its pixels `pixel` apart; the shares are those of its pyramid.
    pub fn new(
        spread: &Spread,
        shares: &[f64],
        pixel: Angle,
        width_px: u32,
        height_px: u32,
    ) -> Halo {
        let levels = level_count(width_px, height_px).min(shares.len());
        let level = wide_level(pixel, levels);
        let texel_px = (level as f64).exp2();
        let reach_px = REACH_TEXELS * texel_px;
        let wide_shares = || (1..).zip(shares).skip(level.saturating_sub(1));
        let pixel_sr = pixel.rad().powi(2);
        let sharp = |r_px: f64| {
            let wide: f64 =
                wide_shares().map(|(level, share)| share * round_kernel(level, r_px)).sum();
            let all =
                spread.at_deg((r_px.powi(4) + FLAT_PX.powi(4)).powf(0.25) * pixel.deg()) * pixel_sr;
            (all - wide).max(0.0) * fade(r_px / texel_px)
        };
        let rows = (reach_px / FIRST_PX).log2() * PER_OCTAVE as f64;
        let rows = rows.max(0.0).ceil() as usize + 1;
        let mut sharp: Vec<f64> = (0..rows).map(|row| sharp(radius_px(row))).collect();
        sharp[rows - 1] = 0.0;
        let mut table: Vec<f64> = (0..rows).map(|row| softened(&sharp, radius_px(row))).collect();
        table[rows - 1] = 0.0;
        let reach_px = radius_px(rows - 1);
        let mut halo = Halo {
            level,
            reach_px,
            table,
            near: 0.0,
            wide: wide_shares().map(|(_, share)| share).sum(),
        };
        halo.near = halo.integral(usize::MAX);
        // A halo larger than all the light there is would take more than the star gives.
        let room = (1.0 - halo.wide - spread.halo()).max(0.0);
        if halo.near > room {
            halo.table.iter_mut().for_each(|value| *value *= room / halo.near);
            halo.near = room;
        }
        halo
    }

    /// The parts of a point's light, with or without the flare.
    pub fn parts(&self, flare: Option<&Flare>) -> Parts {
        let smooth_light = self.near + self.wide;
        let Some(flare) = flare.filter(|_| smooth_light > 0.0) else {
            let core = 1.0 - smooth_light;
            return Parts { core, near: self.near, wide: self.wide, flare: 0.0, smooth: 1.0 };
        };
        let smooth = 1.0 - flare.needles().min(smooth_light) / smooth_light;
        let (near, wide) = (self.near * smooth, self.wide * smooth);
        let flare = flare.share();
        Parts { core: 1.0 - near - wide - flare, near, wide, flare, smooth }
    }

    /// The near halo at a distance from its star, shares of the light per square pixel: straight
    /// between the rows of [`Halo::table`] in the logarithm of the radius.
    pub fn per_px(&self, r_px: f64) -> f64 {
        looked_up(&self.table, r_px)
    }

    /// The table for [`Halo::per_px`]: row n is for `0.0625 * 2^(n/20)` pixels.
    pub fn table(&self) -> &[f64] {
        &self.table
    }

    /// The share of the light that is drawn within so many pixels of the point: core and halo.
    pub fn within_px(&self, reach_px: f64) -> f64 {
        let rows = ((reach_px / FIRST_PX).log2() * PER_OCTAVE as f64).round().max(0.0) as usize;
        self.parts(None).core + self.integral(rows)
    }

    /// Integral of [`Halo::per_px`] over so many rows of the table: Simpson's rule between any two.
    fn integral(&self, rows: usize) -> f64 {
        let disc = PI * FIRST_PX.powi(2) * self.per_px(0.0);
        let ring = |u: f64| {
            let r_px = FIRST_PX * (u / PER_OCTAVE as f64).exp2();
            2.0 * PI * r_px * r_px * self.per_px(r_px)
        };
        let step = std::f64::consts::LN_2 / PER_OCTAVE as f64;
        let rings: f64 = (0..rows.min(self.table.len() - 1))
            .map(|n| n as f64)
            .map(|u| (ring(u) + 4.0 * ring(u + 0.5) + ring(u + 1.0)) / 6.0)
            .sum();
        disc + rings * step
    }
}

fn radius_px(row: usize) -> f64 {
    FIRST_PX * (row as f64 / PER_OCTAVE as f64).exp2()
}

/// From 1 to 0 where the wide part takes over, without a corner.
fn fade(r_texels: f64) -> f64 {
    let x = ((r_texels - FADES_TEXELS) / (REACH_TEXELS - FADES_TEXELS)).clamp(0.0, 1.0);
    1.0 - x * x * (3.0 - 2.0 * x)
}

/// The kernel of a level in the mean of its directions, per square pixel.
fn round_kernel(level: usize, r_px: f64) -> f64 {
    let along = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        smooth_kernel(level, r_px * cos) * smooth_kernel(level, r_px * sin)
    };
    // Four of the eight directions between an axis and a diagonal, for all.
    (0..4).map(|n| along((f64::from(n) + 0.5) * PI / 16.0)).sum::<f64>() / 4.0
}

/// Straight between the rows of a table in the logarithm of the radius, zero beyond.
fn looked_up(table: &[f64], r_px: f64) -> f64 {
    let place = ((r_px / FIRST_PX).log2() * PER_OCTAVE as f64).max(0.0);
    let at = |n: usize| table.get(n).copied().unwrap_or(0.0);
    let (low, part) = (place as usize, place.fract());
    at(low) + (at(low + 1) - at(low)) * part
}

/// A round function made softer than the pixels, by a Gaussian.
fn softened(sharp: &[f64], r_px: f64) -> f64 {
    const STEP_PX: f64 = 0.3;
    const STEPS: i32 = 10;
    // Far out it changes little over a pixel.
    if r_px > 16.0 {
        return looked_up(sharp, r_px);
    }
    let (mut sum, mut weights) = (0.0, 0.0);
    for y in 0..=STEPS {
        let sides = if y > 0 { 2.0 } else { 1.0 };
        for x in -STEPS..=STEPS {
            let [dx, dy] = [x, y].map(|n| f64::from(n) * STEP_PX);
            let weight = sides * (-(dx * dx + dy * dy) / 2.0 / SOFT_VARIANCE_PX2).exp();
            sum += weight * looked_up(sharp, (r_px + dx).hypot(dy));
            weights += weight;
        }
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eye::glare::{Glare, Optics, pyramid};

    const PIXELS_ARCMIN: [f64; 6] = [0.5, 1.0, 2.8, 5.0, 10.0, 15.0];

    fn halo(arcmin: f64, pupil_mm: f64) -> (Spread, Vec<f64>, Halo) {
        let spread = Glare::Cie.spread(&Optics::default(), pupil_mm).unwrap();
        let pixel = Angle::from_arcmin(arcmin);
        let shares = pyramid::shares(&spread, pixel, 1920, 1080);
        let halo = Halo::new(&spread, &shares, pixel, 1920, 1080);
        (spread, shares, halo)
    }

    /// The sprite summed over the pixels around a star that stands off a pixel's centre.
    fn drawn(halo: &Halo, off: [f64; 2]) -> f64 {
        let reach = halo.reach_px.ceil() as i32 + 1;
        let line = |y: i32| {
            let dy = f64::from(y) - off[1];
            (-reach..=reach).map(|x| halo.per_px((f64::from(x) - off[0]).hypot(dy))).sum::<f64>()
        };
        (-reach..=reach).map(line).sum()
    }

    #[test]
    fn what_is_drawn_is_all_of_the_light() {
        for arcmin in PIXELS_ARCMIN {
            for pupil_mm in [3.0, 5.0, 7.0] {
                let (spread, _, halo) = halo(arcmin, pupil_mm);
                let flare = Flare::new(&spread, Angle::from_arcmin(arcmin));
                for flare in [None, flare.as_ref()] {
                    let parts = halo.parts(flare);
                    for off in [[0.0, 0.0], [0.5, 0.5], [0.2, 0.4], [0.5, 0.0]] {
                        let near = drawn(&halo, off) * parts.smooth;
                        let sum = parts.core + near + parts.wide + parts.flare;
                        assert!((sum - 1.0).abs() < 1e-4, "{arcmin} {pupil_mm} {off:?}: {sum}");
                    }
                    let all = [parts.core, parts.near, parts.wide, parts.flare];
                    assert!(all.iter().all(|part| *part >= 0.0), "{arcmin} {parts:?}");
                }
            }
        }
    }

    #[test]
    fn near_and_wide_together_follow_the_spread() {
        for arcmin in PIXELS_ARCMIN {
            let (spread, shares, halo) = halo(arcmin, 3.0);
            let pixel = Angle::from_arcmin(arcmin);
            let mut r_px = 4.0;
            while r_px * pixel.deg() < 10.0 && r_px < 500.0 {
                let wide: f64 = (1..)
                    .zip(&shares)
                    .skip(halo.level - 1)
                    .map(|(level, share)| share * round_kernel(level, r_px))
                    .sum();
                let expected = spread.at_deg(r_px * pixel.deg()) * pixel.rad().powi(2);
                let ratio = (wide + halo.per_px(r_px)) / expected;
                assert!((0.78..1.22).contains(&ratio), "{arcmin} {r_px}: {ratio}");
                r_px *= 1.1;
            }
        }
    }
}

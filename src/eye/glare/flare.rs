//! The flare of wide pupils: needles of light around a bright point, and a coloured ring.
//!
//! Theory: grains in the lens and the edge of the pupil scatter light into fine needles that all
//! point to the source, the *ciliary corona*; the fibres of the outer lens, a grating of rays,
//! throw a ring whose radius grows with the wavelength, the *lenticular halo*: 2.4 degrees in blue
//! light, 3.3 in red. Spencer et al. 1995 draw the corona as a few hundred needles of random
//! brightness, the halo as a ring combed in the same way. The pattern belongs to the eye: it is the
//! same around every source, turns with the head and not with the sky, and here comes from a fixed
//! seed.
//!
//! The light: the ring has the share [`Spread::halo`], for a white light of equal energy at each
//! wavelength. The needles have what Spencer's corona gains by night ([`Spread::corona`]), as far
//! as the texture reaches; those of day stay in the smooth spread.
//!
//! The texture is made for the pixels of a picture: nothing in it is finer than they are. Closer to the
//! source than a pixel the needles rise no more, and where several stand in one pixel they blend;
//! what they would have had there stays in the core of the point.
//!
//! How we differ: needles are straight, of one width and without colour; nothing moves.
//!
//! Accuracy: the sum over the pixels of a picture is the share of the light within 1e-4 of the light
//! of the source in each channel, for pixels of 0.5 to 15 minutes.

use std::f64::consts::PI;

use crate::eye::threshold::combined_cd_m2 as threshold_cd_m2;
use crate::light::spectrum::Spectrum;
use crate::units::Angle;

use super::spencer;
use super::spread::{HEMISPHERE_DEG, Shape, Spread};

/// Texels around and along a radius.
pub const AZIMUTHS: usize = 512;
pub const RADII: usize = 64;
/// How far the texture reaches.
const RADIUS: Angle = Angle::from_deg(4.5);
/// The needles end within this angle.
const NEEDLES_DEG: f64 = 3.0;
const NEEDLES: usize = 400;
/// Half width of a needle at its foot, in texels around: some 0.8 degrees of azimuth.
const NEEDLE_TEXELS: f64 = 1.2;
/// Closer to the source than this many pixels the needles rise no more.
const FLAT_PX: f64 = 1.3;
const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

/// Light of the flare around a point of white light, per steradian, for one unit of its light.
///
/// A small disc flares like a point of its illuminance; what the flare holds is then taken from the
/// pixels of the disc.
#[derive(Debug, Clone, PartialEq)]
pub struct Flare {
    /// X, Y, Z and V in rows of [`AZIMUTHS`], from the centre outwards. Row `n` lies at a radius of
    /// `((n + 0.5) / RADII)^2` of [`Flare::radius`], column `m` at `(m + 0.5) / AZIMUTHS` of a turn.
    texels: Vec<[f64; 4]>,
    needles: f64,
    ring: f64,
}

impl Flare {
    /// The flare of an eye in a picture with its pixels `pixel` apart; `None` while the pupil is so
    /// narrow that there is none.
    pub fn new(spread: &Spread, pixel: Angle) -> Option<Flare> {
        if spread.halo() <= 0.0 {
            return None;
        }
        let height = spread.corona() / CORONA.within(HEMISPHERE_DEG);
        let corona_rows: [f64; RADII] = std::array::from_fn(|row| {
            let t_deg = row_radius(row as f64 + 0.5).deg();
            let flat_deg = (t_deg.powi(4) + (FLAT_PX * pixel.deg()).powi(4)).powf(0.25);
            height * CORONA.at(flat_deg) * (1.0 - (t_deg / NEEDLES_DEG).powi(2)).max(0.0)
        });
        let white = Spectrum::from_fn(|_| 1.0).xyzv();
        let ring_rows: [[f64; 4]; RADII] = std::array::from_fn(|row| {
            let t = row_radius(row as f64 + 0.5);
            let light = Spectrum::from_fn(|nm| spencer::halo_per_sr(t, nm)).xyzv();
            [light.x / white.x, light.y / white.y, light.z / white.z, light.v / white.v]
        });
        let needles = integral(|row| corona_rows[row]);
        let ring_sums: [f64; 4] =
            std::array::from_fn(|channel| integral(|row| ring_rows[row][channel]));

        // The comb has a mean of 1 around each radius.
        let comb = comb();
        let mut texels = Vec::with_capacity(RADII * AZIMUTHS);
        for row in 0..RADII {
            // A pixel as a part of a turn, in texels.
            let turn = 2.0 * PI * row_radius(row as f64 + 0.5).rad();
            let pixel_texels = pixel.rad() / turn * AZIMUTHS as f64;
            let needles = blended(&comb[row * AZIMUTHS..][..AZIMUTHS], pixel_texels);
            // The ring is combed less, fibres stand closer than grains; all needles reach it.
            let fibres = blended(&comb[..AZIMUTHS], pixel_texels);
            for (needle, fibre) in needles.into_iter().zip(fibres) {
                texels.push(std::array::from_fn(|channel| {
                    let ring = ring_rows[row][channel] / ring_sums[channel] * spread.halo();
                    needle * corona_rows[row] + (0.5 + 0.5 * fibre) * ring
                }));
            }
        }
        Some(Flare { texels, needles, ring: spread.halo() })
    }

    /// Light per steradian for one unit of X, Y, Z and V of the source, at an angle from it and at
    /// a part of a turn: bilinear between the texels, none beyond the last.
    pub fn per_sr(&self, from_source: Angle, turn: f64) -> [f64; 4] {
        let place = row_place(from_source);
        let around = turn.rem_euclid(1.0) * AZIMUTHS as f64 - 0.5;
        let column = |off: i64| (around.floor() as i64 + off).rem_euclid(AZIMUTHS as i64) as usize;
        let [outer, right] = [place.fract(), around - around.floor()];
        let mut sum = [0.0; 4];
        for (row, by_row) in [(place as usize, 1.0 - outer), (place as usize + 1, outer)] {
            for (column, by_column) in [(column(0), 1.0 - right), (column(1), right)] {
                let texel = self.texels.get(row * AZIMUTHS + column);
                for (sum, light) in sum.iter_mut().zip(texel.into_iter().flatten()) {
                    *sum += by_row * by_column * light;
                }
            }
        }
        sum
    }

    /// How far the flare reaches from its source.
    pub fn radius(&self) -> Angle {
        RADIUS
    }

    /// Light per steradian for one unit of X, Y, Z and V of the source, rows of [`AZIMUTHS`].
    pub fn texels(&self) -> &[[f64; 4]] {
        &self.texels
    }

    /// The share of the light in the needles.
    pub fn needles(&self) -> f64 {
        self.needles
    }

    /// The share of the light in the flare, over the whole texture.
    pub fn share(&self) -> f64 {
        self.needles + self.ring
    }

    /// How far from a point of an illuminance in lux the flare is seen against a background in
    /// cd/m2, or `None` if it is not, or nowhere outside the 6 minutes that a star seems to fill.
    ///
    /// For a disc as well as for a star: the Moon by the illuminance of all of it.
    ///
    /// Seen is what is brighter than the smallest difference of luminance that an eye adapted to the
    /// background tells apart (t.v.i.), in the mean around the circle.
    pub fn visible_radius(&self, illuminance_lx: f64, background_cd_m2: f64) -> Option<Angle> {
        let threshold = threshold_cd_m2(background_cd_m2);
        let mean = |row: usize| {
            let row = &self.texels[row * AZIMUTHS..][..AZIMUTHS];
            row.iter().map(|texel| texel[1]).sum::<f64>() / AZIMUTHS as f64
        };
        let seen = |row: &usize| mean(*row) * illuminance_lx > threshold;
        let outermost = (0..RADII).rev().find(seen)?;
        let radius = row_radius(outermost as f64 + 1.0);
        (radius.arcmin() > LEAST_ARCMIN).then_some(radius)
    }
}

/// The shape of the ciliary corona (Spencer's f2).
const CORONA: Shape = spencer::SHAPES[2];

/// A flare no larger than this is lost in the halo of its star.
const LEAST_ARCMIN: f64 = 6.0;

/// The radius of a place between the rows, 0 to [`RADII`].
fn row_radius(place: f64) -> Angle {
    Angle::from_rad(RADIUS.rad() * (place / RADII as f64).powi(2))
}

/// Between which rows an angle lies: 0 is the middle of the first, and all within it.
fn row_place(from_source: Angle) -> f64 {
    ((from_source.rad() / RADIUS.rad()).sqrt() * RADII as f64 - 0.5).max(0.0)
}

/// Integral of a round function, straight between the rows, over the plane of the picture.
fn integral(at_row: impl Fn(usize) -> f64) -> f64 {
    const STEPS: usize = 32;
    let at = |row: usize| if row < RADII { at_row(row) } else { 0.0 };
    let part = |n: usize| {
        let edge = |n: usize| row_radius(n as f64 / STEPS as f64);
        let [inner, outer] = [edge(n), edge(n + 1)];
        let place = row_place(Angle::from_rad((inner.rad() + outer.rad()) / 2.0));
        let (low, part) = (place as usize, place.fract());
        let mean = at(low) * (1.0 - part) + at(low + 1) * part;
        mean * PI * (outer.rad().powi(2) - inner.rad().powi(2))
    };
    (0..(RADII + 1) * STEPS).map(part).sum()
}

/// A circle of texels with each replaced by a mean of a width around it, twice over.
fn blended(circle: &[f64], width_texels: f64) -> Vec<f64> {
    let len = circle.len();
    let half = ((width_texels / 2.0).round() as usize).min(len / 2);
    let once = |circle: &[f64]| -> Vec<f64> {
        let mut sum: f64 = (len - half..=len + half).map(|k| circle[k % len]).sum();
        (0..len)
            .map(|n| {
                let mean = sum / (2 * half + 1) as f64;
                sum += circle[(n + half + 1) % len] - circle[(n + len - half) % len];
                mean.max(0.0)
            })
            .collect()
    };
    once(&once(circle))
}

/// Needles around the source: brightness relative to the mean of each row.
fn comb() -> Vec<f64> {
    let mut state = SEED;
    // Evenly random, 0 to 1 (SplitMix64).
    let mut random = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut comb = vec![0.0; RADII * AZIMUTHS];
    for needle in 0..NEEDLES {
        // One in each sector of the circle; few are bright.
        let azimuth = (needle as f64 + random()) / NEEDLES as f64 * AZIMUTHS as f64;
        let brightness = -(1.0 - random()).ln();
        let length = 0.3 + 0.7 * random();
        let reach = (3.0 * NEEDLE_TEXELS).ceil() as i64;
        for row in 0..RADII {
            // All needles begin at the source; each fades towards its end.
            let along = (row as f64 + 0.5) / RADII as f64 / length;
            let fading = (1.0 - along * along).max(0.0) * brightness;
            for off in -reach..=reach {
                let column = azimuth.floor() as i64 + off;
                let away = (column as f64 + 0.5 - azimuth) / NEEDLE_TEXELS;
                let column = column.rem_euclid(AZIMUTHS as i64) as usize;
                comb[row * AZIMUTHS + column] += fading * (-away * away).exp();
            }
        }
    }
    for row in comb.chunks_mut(AZIMUTHS) {
        let mean = row.iter().sum::<f64>() / AZIMUTHS as f64;
        row.iter_mut().for_each(|value| *value = if mean > 0.0 { *value / mean } else { 1.0 });
    }
    comb
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eye::glare::{Glare, Optics};

    fn night() -> (Spread, Flare) {
        let spread = Glare::Cie.spread(&Optics::default(), 7.0).unwrap();
        let flare = Flare::new(&spread, Angle::from_arcmin(1.0)).unwrap();
        (spread, flare)
    }

    #[test]
    fn the_pixels_hold_the_share_in_every_channel() {
        let spread = Glare::Cie.spread(&Optics::default(), 7.0).unwrap();
        for arcmin in [0.5, 1.0, 2.8, 10.0, 15.0] {
            let pixel = Angle::from_arcmin(arcmin);
            let flare = Flare::new(&spread, pixel).unwrap();
            assert!((flare.share() - flare.needles() - spread.halo()).abs() < 1e-12);
            assert!(flare.needles() < spread.corona());
            assert!(flare.texels.iter().flatten().all(|value| value.is_finite() && *value >= 0.0));
            for off in [[0.0, 0.0], [0.5, 0.5], [0.2, 0.4]] {
                let reach = (RADIUS.rad() / pixel.rad()).ceil() as i32 + 2;
                let mut sums = [0.0; 4];
                for y in -reach..=reach {
                    for x in -reach..=reach {
                        let [x, y] = [f64::from(x) - off[0], f64::from(y) - off[1]];
                        let t = Angle::from_rad(x.hypot(y) * pixel.rad());
                        let light = flare.per_sr(t, y.atan2(x) / (2.0 * PI));
                        for (sum, light) in sums.iter_mut().zip(light) {
                            *sum += light * pixel.rad().powi(2);
                        }
                    }
                }
                for sum in sums {
                    let error = sum - flare.share();
                    println!("{arcmin} {off:?} {:.4}: {error:.1e}", flare.share());
                    assert!(error.abs() < 1e-4, "{arcmin} {off:?}: {error}");
                }
            }
        }
    }

    #[test]
    fn the_ring_is_red_outside() {
        let (_, flare) = night();
        let mean = |t_deg: f64, channel: usize| {
            let row = ((t_deg / RADIUS.deg()).sqrt() * RADII as f64) as usize;
            flare.texels[row * AZIMUTHS..][..AZIMUTHS].iter().map(|t| t[channel]).sum::<f64>()
        };
        // Spencer's ring stands at 3 degrees in 568 nm.
        let peak = |channel: usize| {
            (10..42)
                .map(|tenth| f64::from(tenth) / 10.0)
                .max_by(|a, b| mean(*a, channel).total_cmp(&mean(*b, channel)))
        };
        let [x, y, z, v] = [0, 1, 2, 3].map(|channel| peak(channel).unwrap());
        assert!((y - 2.95).abs() < 0.15 && (z - 2.37).abs() < 0.15, "{y} {z}");
        assert!(x > y && y > v && v > z, "{x} {y} {z} {v}");
        assert!(mean(3.4, 0) > 2.0 * mean(3.4, 2));
    }

    #[test]
    fn only_bright_points_flare() {
        let (_, flare) = night();
        let dark_cd_m2 = 3e-4;
        let radius = |magnitude: f64, background_cd_m2: f64| {
            let lx = crate::units::Magnitude(magnitude).illuminance().lx();
            flare.visible_radius(lx, background_cd_m2).map(Angle::deg)
        };
        // Faint stars have none, Venus some needles, the full Moon all of it and the ring.
        assert_eq!(radius(2.0, dark_cd_m2), None);
        let venus = radius(-4.5, dark_cd_m2).unwrap();
        assert!((0.2..3.3).contains(&venus), "{venus}");
        let moon = radius(-12.7, 0.02).unwrap();
        assert!((3.2..4.5).contains(&moon), "{moon}");
        assert_eq!(radius(-4.5, 1000.0), None);
        let narrow = Glare::Cie.spread(&Optics::default(), 3.0).unwrap();
        assert_eq!(Flare::new(&narrow, Angle::from_arcmin(1.0)), None);
    }
}

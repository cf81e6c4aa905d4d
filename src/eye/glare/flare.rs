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
//! How we differ: needles are straight, of one width and without colour; nothing moves.
//!
//! Accuracy: the sum over the texture is the share of the light, 1e-9 in each channel.

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
const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

/// Light of the flare around a point of white light, per steradian, for one unit of its light.
#[derive(Debug, Clone, PartialEq)]
pub struct Flare {
    /// X, Y, Z and V in rows of [`AZIMUTHS`], from the centre outwards. Row `n` lies at a radius of
    /// `((n + 0.5) / RADII)^2` of [`Flare::radius`], column `m` at `(m + 0.5) / AZIMUTHS` of a turn.
    texels: Vec<[f64; 4]>,
    needles: f64,
    ring: f64,
}

impl Flare {
    /// The flare of an eye; `None` while its pupil is so narrow that there is none.
    pub fn new(spread: &Spread) -> Option<Flare> {
        if spread.halo() <= 0.0 {
            return None;
        }
        let combed = comb();
        let needles = spread.corona() * needles_beyond(Angle::ZERO);
        let corona_rows: Vec<f64> = (0..RADII)
            .map(|row| {
                let t_deg = row_radius(row as f64 + 0.5).deg();
                CORONA.at(t_deg) * (1.0 - (t_deg / NEEDLES_DEG).powi(2)).max(0.0)
            })
            .collect();
        let white = Spectrum::from_fn(|_| 1.0).xyzv();
        let ring_rows: Vec<[f64; 4]> = (0..RADII)
            .map(|row| {
                let t = row_radius(row as f64 + 0.5);
                let light = Spectrum::from_fn(|nm| spencer::halo_per_sr(t, nm)).xyzv();
                [light.x / white.x, light.y / white.y, light.z / white.z, light.v / white.v]
            })
            .collect();
        // The comb has a mean of 1 around each radius.
        let corona_sum: f64 =
            corona_rows.iter().enumerate().map(|(row, value)| value * row_sr(row)).sum();
        let ring_sums: [f64; 4] = std::array::from_fn(|channel| {
            ring_rows.iter().enumerate().map(|(row, value)| value[channel] * row_sr(row)).sum()
        });

        let mut texels = Vec::with_capacity(RADII * AZIMUTHS);
        for row in 0..RADII {
            for azimuth in 0..AZIMUTHS {
                let comb = combed[row * AZIMUTHS + azimuth];
                let corona = comb * corona_rows[row] * needles / corona_sum;
                // The ring is combed less, fibres stand closer than grains; all needles reach it.
                let fibres = 0.5 + 0.5 * combed[azimuth];
                let ring = ring_rows[row];
                texels.push(std::array::from_fn(|channel| {
                    corona + fibres * ring[channel] * spread.halo() / ring_sums[channel]
                }));
            }
        }
        Some(Flare { texels, needles, ring: spread.halo() })
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

/// The part of the ciliary corona that the needles hold beyond an angle from the source.
pub(super) fn needles_beyond(from_source: Angle) -> f64 {
    let within = |t_deg: f64| CORONA.within(t_deg) / CORONA.within(HEMISPHERE_DEG);
    (within(NEEDLES_DEG) - within(from_source.deg())).max(0.0)
}

/// A flare no larger than this is lost in the halo of its star.
const LEAST_ARCMIN: f64 = 6.0;

/// The radius of a place between the rows, 0 to [`RADII`].
fn row_radius(place: f64) -> Angle {
    Angle::from_rad(RADIUS.rad() * (place / RADII as f64).powi(2))
}

/// Solid angle of a row of texels, all around.
pub fn row_sr(row: usize) -> f64 {
    let [inner, outer] = [row, row + 1].map(|row| row_radius(row as f64).cos());
    2.0 * PI * (inner - outer)
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
        let flare = Flare::new(&spread).unwrap();
        (spread, flare)
    }

    #[test]
    fn the_texture_holds_its_share_in_every_channel() {
        let (spread, flare) = night();
        for channel in 0..4 {
            let sum: f64 = (0..RADII * AZIMUTHS)
                .map(|n| flare.texels[n][channel] * row_sr(n / AZIMUTHS) / AZIMUTHS as f64)
                .sum();
            assert!((sum / flare.share() - 1.0).abs() < 1e-9, "{channel}: {sum}");
        }
        assert!((flare.share() - flare.needles() - spread.halo()).abs() < 1e-12);
        assert!(flare.needles() > 0.3 * spread.corona() && flare.needles() < spread.corona());
        assert!(flare.texels.iter().flatten().all(|value| value.is_finite() && *value >= 0.0));
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
        assert_eq!(Flare::new(&narrow), None);
    }
}

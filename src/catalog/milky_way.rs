//! `milky_way.bin`: the light of all stars that are not in the Bright Star Catalogue, over the whole
//! sky.
//!
//! Counts in the header: edge length in texels, twice (the map is square), channels (2). Then two
//! maps of whole numbers coded as [`super::rice`] says, row by row: brightness and colour. A number
//! `n` of the first stands for `exp(n / 400)` S10(V), steps of 0.25 %; of the second for `n / 250` of
//! the way from the bluest to the reddest mix of stars (`light::starlight` has their spectra).
//!
//! **Where a texel lies.** Octahedral map in galactic axes ([`Galactic`](crate::frame::Galactic)): a
//! direction is brought to the octahedron `|x| + |y| + |z| = 1`, whose upper half is seen from above
//! and whose lower half is folded out over the corners of the square ([`octahedral`]; Engelhardt &
//! Dachsbacher 2008, *VMV*, 383). The north galactic pole is the middle of the square, the south pole
//! its four corners. Texels have 0.11 degrees (on the axes) to 0.25 degrees (between them), and values
//! belong to their centres; beyond an edge the map goes on at the same edge, mirrored ([`around`]).
//!
//! **From picture to light** ([`Picture`]). The source is the sky in colour of Gaia's early data
//! release 3: plate carrée in galactic coordinates, 0.1 degrees a pixel, `l = 0` in the middle and `l`
//! growing to the left (47 Tucanae stands within 0.05 degrees of its place). It is
//! tone-mapped by an unknown law. With the display's luminance `D` from 0 to 1 (sRGB primaries,
//! exponent 2.2) the light is taken to be
//!
//! ```text
//! S10(V) = 2.8 + 527 D^1.5
//! ```
//!
//! The exponent and the factors were fitted so that map and catalogue together have the latitude
//! profile `25 + 250 exp(-|b| / 20°)` S10(V) after Benn & Ellison 1998, *New Astronomy Reviews* 42, 503
//! (all-sky mean 103): the law's mean over longitude, in bands of 10 degrees, was fitted to the profile
//! less the light of the catalogue's stars, `12 + 40 exp(-|b| / 18°)` S10(V), a smooth law that has
//! their sum (mean 23.3). The law is the same everywhere, so clouds and dark lanes keep their contrast.
//!
//! Then:
//! - Bright dots, 1.5 times brighter on the display than the median of their surroundings (0.5
//!   degrees), are replaced by it: the catalogue's stars are drawn one by one.
//! - From 10 degrees of latitude on the picture is smoothed, up to 2 degrees wide beyond 42: what is
//!   there is grain and the stripes of Gaia's scans. The Magellanic Clouds (and 47 Tucanae beside the
//!   smaller) stay as they are.
//! - Each texel is an average over two texels' width under a pyramid, by area on the sphere, so that
//!   reading between texels neither aliases nor loses light.
//! - The colour comes from red over blue of the picture, smoothed over a degree, and is brought to that
//!   of B-V 0.72 towards the poles, where the picture's coding leaves no more than steps of colour.
//!
//! Accuracy (`tests/starlight.rs`): packing changes the light within half a degree by 2 % at most. Map
//! and catalogue together: 103.4 S10(V) over the sky, bands of 10 degrees within 5 % of the profile to
//! 50 degrees of latitude, 12 and 18 % above it to 60 and 70, where bright stars happen to stand.
//! The profile itself is known to some 15 %; single places to some 30 %, as the
//! picture's tones are not told. Checks that nothing was fitted to: the great cloud in Sagittarius has
//! 520 S10(V) and that in Scutum 410 (some 300 to 500 are told), the galactic poles with the
//! catalogue's stars 26 (20 to 30); the Magellanic Clouds stand out from the sky with the light of V
//! 0.8 and 2.6 (0.4 and 2.2 are told, their brighter stars included). The picture knows stars alone:
//! bright nebulae (the Great Nebula of Orion, Carina) and galaxies are not in it.

use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use super::rice;
use super::seal::{self, Kind};

mod picture;

pub use picture::Picture;

const KIND: Kind = Kind { magic: b"NOCTMILK", version: 1 };
/// Edge length of the packed map.
pub const PACKED_SIZE: usize = 1024;
const LARGEST_SIZE: u32 = 8192;
/// Numbers to a factor of e in brightness.
const STEPS_PER_E: f64 = 400.0;
/// Numbers from the bluest to the reddest mix.
const COLOUR_STEPS: i16 = 250;
/// Faintest and brightest texel, S10(V): beyond what the sky has.
const S10_RANGE: (f64, f64) = (1.0, 20_000.0);

/// The light of the stars outside the Bright Star Catalogue; see the [module](self) for how it lies.
#[derive(Debug, Clone, PartialEq)]
pub struct MilkyWay {
    size: usize,
    /// Brightness in S10(V), and colour from 0 (bluest) to 1 (reddest).
    texels: Vec<[f32; 2]>,
}

impl MilkyWay {
    /// Edge length in texels.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Row by row, `size * size` of them: brightness in S10(V), and colour, 0 for the bluest mix of
    /// stars to 1 for the reddest.
    pub fn texels(&self) -> &[[f32; 2]] {
        &self.texels
    }

    /// Brightness in S10(V) in a direction in galactic axes, straight between texels.
    pub fn s10(&self, dir: DVec3) -> f64 {
        self.read(dir, 0)
    }

    /// Colour in a direction, 0 to 1, straight between texels.
    pub fn colour(&self, dir: DVec3) -> f64 {
        self.read(dir, 1)
    }

    fn read(&self, dir: DVec3, channel: usize) -> f64 {
        let around = around(self.size, dir);
        around.iter().map(|&(at, weight)| f64::from(self.texels[at][channel]) * weight).sum()
    }
}

/// Where a direction, of any length but zero, lies on the square: column and row as shares of the
/// edge, 0 to 1. Texel coordinates are that times the edge length, centres at halves.
pub fn octahedral(dir: DVec3) -> [f64; 2] {
    let length = dir.x.abs() + dir.y.abs() + dir.z.abs();
    let (mut x, mut y) = (dir.x / length, dir.y / length);
    if dir.z < 0.0 {
        (x, y) = ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y));
    }
    [0.5 * x + 0.5, 0.5 * y + 0.5]
}

/// The unit direction of a place on the square: the inverse of [`octahedral`]. Places a little beyond
/// an edge are those that the map goes on with.
pub fn direction([column, row]: [f64; 2]) -> DVec3 {
    on_octahedron([column, row]).normalize()
}

fn on_octahedron([column, row]: [f64; 2]) -> DVec3 {
    let (mut x, mut y) = (2.0 * column - 1.0, 2.0 * row - 1.0);
    if x.abs() > 1.0 {
        (x, y) = (2f64.copysign(x) - x, -y);
    }
    if y.abs() > 1.0 {
        (x, y) = (-x, 2f64.copysign(y) - y);
    }
    let z = 1.0 - x.abs() - y.abs();
    if z < 0.0 {
        (x, y) = ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y));
    }
    DVec3::new(x, y, z)
}

/// Solid angle over area of the square (edge 1) at a place on it, sr.
pub fn solid_angle_density(place: [f64; 2]) -> f64 {
    // A face lies 1/sqrt(3) from the middle and is sqrt(3) times its shadow on the square, whose
    // edge is 2.
    4.0 / on_octahedron(place).length().powi(3)
}

/// Solid angle of each texel of a map with some edge length, sr, row by row; 4 pi in all.
pub fn solid_angles(size: usize) -> Vec<f64> {
    let texel = |at: usize| {
        let place = |index: usize| (index as f64 + 0.5) / size as f64;
        solid_angle_density([place(at % size), place(at / size)])
    };
    let density: Vec<f64> = (0..size * size).map(texel).collect();
    let total: f64 = density.iter().sum();
    density.into_iter().map(|density| density * 4.0 * PI / total).collect()
}

/// Four texels around a direction of a map with some edge length, as places in it row by row, and
/// their weights, which sum to 1.
pub fn around(size: usize, dir: DVec3) -> [(usize, f64); 4] {
    let [x, y] = octahedral(dir).map(|share| share * size as f64 - 0.5);
    let (column, row) = (x.floor(), y.floor());
    let (right, down) = (x - column, y - row);
    let (column, row) = (column as i64, row as i64);
    [
        (beside(size, column, row), (1.0 - down) * (1.0 - right)),
        (beside(size, column + 1, row), (1.0 - down) * right),
        (beside(size, column, row + 1), down * (1.0 - right)),
        (beside(size, column + 1, row + 1), down * right),
    ]
}

/// The texel at a column and row that may lie one beyond an edge.
fn beside(size: usize, mut column: i64, mut row: i64) -> usize {
    let last = size as i64 - 1;
    if !(0..=last).contains(&column) {
        (column, row) = (column.clamp(0, last), last - row);
    }
    if !(0..=last).contains(&row) {
        (column, row) = (last - column, row.clamp(0, last));
    }
    (row * size as i64 + column) as usize
}

/// The packed map of a picture.
pub fn encode(picture: &Picture) -> Result<Vec<u8>, String> {
    /// Samples along the width of two texels.
    const SAMPLES: usize = 6;
    let size = PACKED_SIZE;
    let offsets: [(f64, f64); SAMPLES] = std::array::from_fn(|k| {
        let offset = 2.0 * (k as f64 + 0.5) / SAMPLES as f64 - 1.0;
        (offset, 1.0 - offset.abs())
    });
    let texel = |at: usize| {
        let (mut light, mut red, mut area) = (0.0, 0.0, 0.0);
        for (down, row_weight) in offsets {
            for (right, column_weight) in offsets {
                let place = [(at % size, right), (at / size, down)]
                    .map(|(index, offset)| (index as f64 + 0.5 + offset) / size as f64);
                let (s10, colour) = picture.at(direction(place));
                let weight = row_weight * column_weight * solid_angle_density(place);
                area += weight;
                light += weight * s10;
                red += weight * s10 * colour;
            }
        }
        (light / area, red / light)
    };
    let texels: Vec<(f64, f64)> = (0..size * size).into_par_iter().map(texel).collect();
    let (low, high) = S10_RANGE;
    if let Some((s10, _)) = texels.iter().find(|(s10, _)| !(low..=high).contains(s10)) {
        return Err(format!("has a place of {s10} S10, outside {low} to {high}"));
    }
    let brightness: Vec<i16> =
        texels.iter().map(|(s10, _)| (STEPS_PER_E * s10.ln()).round() as i16).collect();
    let colour: Vec<i16> = texels
        .iter()
        .map(|(_, colour)| (f64::from(COLOUR_STEPS) * colour.clamp(0.0, 1.0)).round() as i16)
        .collect();
    let mut payload = rice::encode(&brightness, size);
    payload.extend(rice::encode(&colour, size));
    Ok(seal::seal(KIND, [size as u32, size as u32, 2], &payload))
}

/// The map in `milky_way.bin`; an error says what is wrong with the file.
pub fn decode(bytes: &[u8]) -> Result<MilkyWay, String> {
    let ([width, height, channels], payload) = seal::open(KIND, bytes)?;
    if channels != 2 || width != height || !(2..=LARGEST_SIZE).contains(&width) {
        return Err(format!("is a map of {width} x {height} texels in {channels} channels"));
    }
    let size = width as usize;
    let (brightness, rest) = rice::decode(payload, size, size)?;
    let (colour, rest) = rice::decode(rest, size, size)?;
    if !rest.is_empty() {
        return Err(format!("holds {} bytes too many", rest.len()));
    }
    let (low, high) = S10_RANGE;
    let brightest = (STEPS_PER_E * high.ln()).round() as i16;
    let darkest = (STEPS_PER_E * low.ln()).round() as i16;
    let s10_from_number: Vec<f32> =
        (0..=brightest).map(|n| (f64::from(n) / STEPS_PER_E).exp() as f32).collect();
    let texel = |(&s10, &colour): (&i16, &i16)| {
        if !(darkest..=brightest).contains(&s10) || !(0..=COLOUR_STEPS).contains(&colour) {
            return Err(format!("has a texel of {s10} and {colour} steps"));
        }
        Ok([s10_from_number[s10 as usize], f32::from(colour) / f32::from(COLOUR_STEPS)])
    };
    let texels: Result<_, String> = brightness.iter().zip(&colour).map(texel).collect();
    Ok(MilkyWay { size, texels: texels? })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions spread evenly over the sphere.
    fn sphere(count: usize) -> impl Iterator<Item = DVec3> {
        (0..count).map(move |k| {
            let z = 1.0 - 2.0 * (k as f64 + 0.5) / count as f64;
            let turn = PI * (3.0 - 5f64.sqrt()) * k as f64;
            DVec3::new((1.0 - z * z).sqrt() * turn.cos(), (1.0 - z * z).sqrt() * turn.sin(), z)
        })
    }

    #[test]
    fn directions_and_places_are_inverse() {
        for dir in sphere(1000).chain([DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]) {
            let place = octahedral(3.0 * dir);
            assert!(place.iter().all(|share| (0.0..=1.0).contains(share)), "{dir} {place:?}");
            assert!(direction(place).abs_diff_eq(dir, 1e-12), "{dir} {place:?}");
        }
        assert_eq!(octahedral(DVec3::Z), [0.5, 0.5]);
        assert_eq!(octahedral(DVec3::X), [1.0, 0.5]);
        assert_eq!(octahedral(DVec3::Y), [0.5, 1.0]);
        // Below the plane, folded out: between +x and +y near the corner.
        let [column, row] = octahedral(DVec3::new(0.1, 0.1, -1.0));
        assert!(column > 0.9 && row > 0.9, "{column} {row}");
    }

    #[test]
    fn reading_is_continuous_over_every_fold_and_edge() {
        let size = 32;
        // A smooth light in space, written at the centres of the texels.
        let light = |dir: DVec3| 2.0 + dir.x + 0.5 * dir.y * dir.z - 0.3 * dir.z;
        let place = |index: usize| (index as f64 + 0.5) / size as f64;
        let map: Vec<f64> = (0..size * size)
            .map(|at| light(direction([place(at % size), place(at / size)])))
            .collect();
        for dir in sphere(20_000) {
            let around = around(size, dir);
            let total: f64 = around.iter().map(|(_, weight)| weight).sum();
            assert!((total - 1.0).abs() < 1e-12);
            let read: f64 = around.iter().map(|&(at, weight)| map[at] * weight).sum();
            // Texels are up to 8 degrees wide; a texel from elsewhere would be off by much more.
            assert!((read - light(dir)).abs() < 0.05, "{dir}: {read} {}", light(dir));
        }
    }

    #[test]
    fn solid_angles_fill_the_sphere() {
        let size = 64;
        let bare: f64 = (0..size * size)
            .map(|at| {
                let place = |index: usize| (index as f64 + 0.5) / size as f64;
                solid_angle_density([place(at % size), place(at / size)])
            })
            .sum::<f64>()
            / (size * size) as f64;
        assert!((bare / (4.0 * PI) - 1.0).abs() < 1e-3, "{bare}");
        let angles = solid_angles(size);
        let up: f64 = angles.iter().sum();
        assert!((up / (4.0 * PI) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn foreign_maps_are_refused() {
        let flat = |number: i16| rice::encode(&[number; 4], 2);
        let file = |s10, colour| seal::seal(KIND, [2, 2, 2], &[flat(s10), flat(colour)].concat());
        let map = decode(&file(400, 125)).unwrap();
        assert!((map.s10(DVec3::X) - std::f64::consts::E).abs() < 1e-6);
        assert!((map.colour(DVec3::X) - 0.5).abs() < 1e-6);
        assert!(decode(&file(-1, 0)).is_err() && decode(&file(0, 251)).is_err());
        assert!(decode(&file(30_000, 0)).is_err());
        let longer = [flat(1), flat(1), vec![0]].concat();
        assert!(decode(&seal::seal(KIND, [2, 2, 2], &longer)).unwrap_err().contains("too many"));
        assert!(decode(&seal::seal(KIND, [2, 3, 2], &[])).is_err());
        assert!(decode(b"NOCTMILK").is_err());
    }
}

//! The picture that the map is made of, brought to light: see [`super`] for the laws.

use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use crate::units::Angle;

/// S10(V) of a display luminance D: `FLOOR + FACTOR * D^EXPONENT`.
const FLOOR_S10: f64 = 2.8;
const FACTOR_S10: f64 = 527.0;
const EXPONENT: f64 = 1.5;
/// Exponent of the display.
const DISPLAY_GAMMA: f64 = 2.2;
/// What red, green and blue of sRGB have of its luminance.
const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];
/// How much brighter on the display than its surroundings a dot is.
const DOT: f64 = 1.5;
/// Colour of equal red and blue, and its change with the logarithm of their ratio (linear light).
const COLOUR_OF_WHITE: f64 = 0.46;
const COLOUR_PER_E: f64 = 0.55;
/// Colour far from the plane, where the picture's is lost in its coding.
const COLOUR_OF_POLES: f64 = 0.38;
/// Latitudes between which the picture's colour gives way to that, degrees.
const COLOUR_TO_POLES_DEG: (f64, f64) = (12.0, 40.0);
/// Widths of the smoothing (standard deviation), degrees, from near the plane to the poles.
const MIDDLE_DEG: f64 = 0.35;
const WIDE_DEG: f64 = 2.0;
/// That of the colour, degrees.
const COLOUR_DEG: f64 = 0.6;
/// Latitudes between which one width passes into the next, degrees.
const FINE_TO_MIDDLE_DEG: (f64, f64) = (10.0, 25.0);
const MIDDLE_TO_WIDE_DEG: (f64, f64) = (22.0, 42.0);
/// What keeps its detail at any latitude: galactic longitude, latitude, radius and width of the rim,
/// degrees. The Magellanic Clouds; 47 Tucanae stands in the smaller one's circle.
const KEPT_DEG: [(f64, f64, f64, f64); 2] = [(279.5, -33.2, 6.5, 2.0), (303.5, -44.3, 3.5, 1.5)];

/// A map in plate carrée: `l = 0` in the middle, growing to the left; north above.
#[derive(Debug)]
struct Grid {
    width: usize,
    height: usize,
    values: Vec<f64>,
}

/// The light and the colour of the picture in any direction.
#[derive(Debug)]
pub struct Picture {
    /// S10(V), without dots: as fine as the picture, and smoothed twice, from a map of half the size.
    fine: Grid,
    middle: Grid,
    wide: Grid,
    /// Colour, a little smoothed.
    colour: Grid,
}

impl Picture {
    /// From display values (red, green, blue, a byte each). The picture is twice as wide as high and
    /// both are even.
    pub fn new(rgb: &[u8], (width, height): (usize, usize)) -> Result<Picture, String> {
        if height < 180 || width != 2 * height || height % 2 != 0 {
            return Err(format!(
                "is {width} x {height} pixels, not twice as wide as high, even, and 180 high or more"
            ));
        }
        if rgb.len() != width * height * 3 {
            return Err(format!("holds {} bytes for {width} x {height} pixels", rgb.len()));
        }
        let linear: Vec<f64> =
            (0..=u8::MAX).map(|byte| (f64::from(byte) / 255.0).powf(DISPLAY_GAMMA)).collect();
        let channel = |pixel: &[u8], channel: usize| linear[usize::from(pixel[channel])];
        let luminance = rgb
            .chunks_exact(3)
            .map(|pixel| (0..3).map(|c| LUMINANCE[c] * channel(pixel, c)).sum())
            .collect();
        let luminance = Grid { width, height, values: luminance }.without_dots();
        let light = |y: &f64| FLOOR_S10 + FACTOR_S10 * y.powf(EXPONENT / DISPLAY_GAMMA);
        let fine = Grid { width, height, values: luminance.values.par_iter().map(light).collect() };
        let [red, blue] = [0, 2].map(|c| {
            let values = rgb.chunks_exact(3).map(|pixel| channel(pixel, c)).collect();
            Grid { width, height, values }.halved()
        });
        let half = fine.halved();
        // What is kept does not spread into what is smoothed.
        let open = half.like(|_, dir| 1.0 - kept(dir));
        let (red, blue) = (red.blurred(COLOUR_DEG), blue.blurred(COLOUR_DEG));
        let colour = red.like(|at, _| {
            let ratio = (red.values[at].max(1e-6) / blue.values[at].max(1e-6)).ln();
            (COLOUR_OF_WHITE + COLOUR_PER_E * ratio).clamp(0.0, 1.0)
        });
        let masked = half.like(|at, _| half.values[at] * open.values[at]);
        let [middle, wide] = [MIDDLE_DEG, WIDE_DEG].map(|width_deg| {
            let (light, share) = (masked.blurred(width_deg), open.blurred(width_deg));
            half.like(|at, _| {
                // In the middle of what is kept there is nothing else, and nobody looks.
                if share.values[at] > 1e-3 {
                    light.values[at] / share.values[at]
                } else {
                    FLOOR_S10
                }
            })
        });
        Ok(Picture { fine, middle, wide, colour })
    }

    /// S10(V) and colour in a direction in galactic axes.
    pub fn at(&self, dir: DVec3) -> (f64, f64) {
        let latitude_deg = dir.z.clamp(-1.0, 1.0).asin().to_degrees().abs();
        let kept = kept(dir);
        let to_middle = (1.0 - kept) * step(FINE_TO_MIDDLE_DEG, latitude_deg);
        let to_wide = (1.0 - kept) * step(MIDDLE_TO_WIDE_DEG, latitude_deg);
        let mut s10 = 0.0;
        let parts = [
            (&self.fine, (1.0 - to_middle) * (1.0 - to_wide)),
            (&self.middle, to_middle * (1.0 - to_wide)),
            (&self.wide, to_wide),
        ];
        for (grid, weight) in parts {
            if weight > 0.0 {
                s10 += weight * grid.at(dir);
            }
        }
        let to_poles = (1.0 - kept) * step(COLOUR_TO_POLES_DEG, latitude_deg);
        (s10, self.colour.at(dir) * (1.0 - to_poles) + COLOUR_OF_POLES * to_poles)
    }

    /// The mean S10(V) and the colour of its light within a radius around a direction.
    pub fn mean_within(&self, dir: DVec3, radius: Angle) -> (f64, f64) {
        let (mut light, mut red) = (0.0, 0.0);
        let places: Vec<DVec3> = disc(dir, radius).collect();
        for &place in &places {
            let (s10, colour) = self.at(place);
            light += s10;
            red += s10 * colour;
        }
        (light / places.len() as f64, red / light)
    }
}

/// Directions spread evenly over a small disc around one.
fn disc(dir: DVec3, radius: Angle) -> impl Iterator<Item = DVec3> {
    const COUNT: usize = 400;
    let side = dir.any_orthonormal_vector();
    let up = dir.cross(side);
    (0..COUNT).map(move |k| {
        let distance = radius.rad() * ((k as f64 + 0.5) / COUNT as f64).sqrt();
        let turn = PI * (3.0 - 5f64.sqrt()) * k as f64;
        let off = side * turn.cos() + up * turn.sin();
        dir * distance.cos() + off * distance.sin()
    })
}

/// 1 where the detail is kept, 0 outside.
fn kept(dir: DVec3) -> f64 {
    let share = |&(l, b, radius_deg, rim_deg): &(f64, f64, f64, f64)| {
        let (sin_l, cos_l) = l.to_radians().sin_cos();
        let (sin_b, cos_b) = b.to_radians().sin_cos();
        let cosine = dir.dot(DVec3::new(cos_b * cos_l, cos_b * sin_l, sin_b));
        let distance_deg = cosine.clamp(-1.0, 1.0).acos().to_degrees();
        1.0 - step((radius_deg, radius_deg + rim_deg), distance_deg)
    };
    KEPT_DEG.iter().map(share).fold(0.0, f64::max)
}

/// From 0 to 1 between two values, smoothly.
fn step((from, to): (f64, f64), value: f64) -> f64 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl Grid {
    /// A grid of the same size, by place in it and direction.
    fn like(&self, value: impl Fn(usize, DVec3) -> f64 + Sync) -> Grid {
        let (width, height) = (self.width, self.height);
        let values = (0..width * height).into_par_iter().map(|at| {
            let l = PI - 2.0 * PI * ((at % width) as f64 + 0.5) / width as f64;
            let b = 0.5 * PI - PI * ((at / width) as f64 + 0.5) / height as f64;
            let dir = DVec3::new(b.cos() * l.cos(), b.cos() * l.sin(), b.sin());
            value(at, dir)
        });
        Grid { width, height, values: values.collect() }
    }

    /// The pixel at a column and row that may lie outside: around the sky, and over the poles.
    fn index(&self, column: i64, row: i64) -> usize {
        let (width, height) = (self.width as i64, self.height as i64);
        let (row, over) = match row {
            row if row < 0 => (-1 - row, width / 2),
            row if row >= height => (2 * height - 1 - row, width / 2),
            row => (row, 0),
        };
        (row * width + (column + over).rem_euclid(width)) as usize
    }

    /// How much a row is drawn out along its circle, at most as much as there are 64 pixels in it.
    fn stretch(&self, row: usize) -> f64 {
        let sine = (PI * (row as f64 + 0.5) / self.height as f64).sin();
        (1.0 / sine).min(self.width as f64 / 64.0)
    }

    /// The value in a direction, straight between pixels.
    fn at(&self, dir: DVec3) -> f64 {
        let l = dir.y.atan2(dir.x);
        let b = dir.z.atan2(dir.x.hypot(dir.y));
        let x = (0.5 - l / (2.0 * PI)) * self.width as f64 - 0.5;
        let y = (0.5 - b / PI) * self.height as f64 - 0.5;
        let (column, row) = (x.floor(), y.floor());
        let (right, down) = (x - column, y - row);
        let (column, row) = (column as i64, row as i64);
        let value = |column, row| self.values[self.index(column, row)];
        (1.0 - down) * ((1.0 - right) * value(column, row) + right * value(column + 1, row))
            + down * ((1.0 - right) * value(column, row + 1) + right * value(column + 1, row + 1))
    }

    /// Dots of luminance replaced by the median of 5 x 5 pixels around them.
    fn without_dots(&self) -> Grid {
        let brighter = DOT.powf(DISPLAY_GAMMA);
        let pixel = |at: usize| {
            let (column, row) = ((at % self.width) as i64, (at / self.width) as i64);
            let apart = self.stretch(at / self.width).round() as i64;
            let mut around = [0.0; 25];
            for (k, value) in around.iter_mut().enumerate() {
                let (right, down) = (k as i64 % 5 - 2, k as i64 / 5 - 2);
                *value = self.values[self.index(column + right * apart, row + down)];
            }
            let (_, median, _) = around.select_nth_unstable_by(12, f64::total_cmp);
            let own = self.values[at];
            if own > brighter * *median { *median } else { own }
        };
        let values = (0..self.values.len()).into_par_iter().map(pixel).collect();
        Grid { width: self.width, height: self.height, values }
    }

    /// Means of two by two pixels.
    fn halved(&self) -> Grid {
        let (width, height) = (self.width / 2, self.height / 2);
        let value = |at: usize| {
            let first = at / width * 2 * self.width + at % width * 2;
            let places = [first, first + 1, first + self.width, first + self.width + 1];
            0.25 * places.iter().map(|&place| self.values[place]).sum::<f64>()
        };
        Grid { width, height, values: (0..width * height).map(value).collect() }
    }

    /// Smoothed by three running means each way, which is nearly Gauss's bell of that width. An even
    /// light stays even; the light of a spot is kept to 2 % up to 80 degrees of latitude, less well
    /// next to a pole, where the picture has no spots.
    fn blurred(&self, width_deg: f64) -> Grid {
        let (width, height) = (self.width, self.height);
        // Three means over 2 r + 1 pixels have the variance r (r + 1).
        let radius = |pixels: f64| ((pixels * pixels + 0.25).sqrt() - 0.5).round() as i64;
        let pixels = width_deg * height as f64 / 180.0;
        let mut values = self.values.clone();
        values.par_chunks_exact_mut(width).enumerate().for_each(|(row, line)| {
            let radius = radius(pixels * self.stretch(row)).min(width as i64 / 2 - 1);
            for _ in 0..3 {
                let before = line.to_vec();
                running_mean(radius, |at| before[at.rem_euclid(width as i64) as usize], line);
            }
        });
        let radius = radius(pixels);
        for _ in 0..3 {
            let before = Grid { width, height, values };
            // Rows of this are the columns, one after the other.
            let mut turned = vec![0.0; width * height];
            turned.par_chunks_exact_mut(height).enumerate().for_each(|(column, line)| {
                let weight = |row: i64| {
                    let row = if row < 0 { -1 - row } else { row.min(2 * height as i64 - 1 - row) };
                    (PI * (row as f64 + 0.5) / height as f64).sin()
                };
                let light = |row| before.values[before.index(column as i64, row)] * weight(row);
                let mut area = vec![0.0; height];
                running_mean(radius, weight, &mut area);
                running_mean(radius, light, line);
                line.iter_mut().zip(&area).for_each(|(value, area)| *value /= area);
            });
            values = vec![0.0; width * height];
            values.par_chunks_exact_mut(width).enumerate().for_each(|(row, line)| {
                for (column, value) in line.iter_mut().enumerate() {
                    *value = turned[column * height + row];
                }
            });
        }
        Grid { width, height, values }
    }
}

/// Means over a radius on both sides of each place of a line.
fn running_mean(radius: i64, value: impl Fn(i64) -> f64, line: &mut [f64]) {
    let mut sum: f64 = (-radius..=radius).map(&value).sum();
    let count = (2 * radius + 1) as f64;
    for (at, mean) in line.iter_mut().enumerate() {
        *mean = sum / count;
        sum += value(at as i64 + radius + 1) - value(at as i64 - radius);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: (usize, usize) = (720, 360);

    fn towards(l_deg: f64, b_deg: f64) -> DVec3 {
        let (l, b) = (l_deg.to_radians(), b_deg.to_radians());
        DVec3::new(b.cos() * l.cos(), b.cos() * l.sin(), b.sin())
    }

    fn light(display: u8) -> f64 {
        FLOOR_S10 + FACTOR_S10 * (f64::from(display) / 255.0).powf(EXPONENT)
    }

    #[test]
    fn a_flat_picture_is_flat_everywhere() {
        let picture = Picture::new(&[80; 720 * 360 * 3], SIZE).unwrap();
        for (l, b) in [(0.0, 0.0), (90.0, 25.0), (279.5, -33.2), (10.0, 90.0), (180.0, -60.0)] {
            let (s10, colour) = picture.at(towards(l, b));
            assert!((s10 / light(80) - 1.0).abs() < 1e-9, "{l} {b}: {s10}");
            let wanted = if b.abs() > 50.0 { COLOUR_OF_POLES } else { COLOUR_OF_WHITE };
            let both = COLOUR_OF_POLES.min(wanted)..=COLOUR_OF_WHITE + 1e-9;
            assert!((colour - wanted).abs() < 1e-9 || b == 25.0 && both.contains(&colour));
        }
    }

    #[test]
    fn longitude_grows_to_the_left_and_dots_vanish() {
        let (width, height) = SIZE;
        let mut rgb = vec![60; width * height * 3];
        // Left of the middle, above it: l = 80, b = 10. A square of 10 degrees, and a dot elsewhere.
        for row in 150..170 {
            for column in 190..210 {
                rgb[(row * width + column) * 3..][..3].fill(200);
            }
        }
        rgb[(200 * width + 500) * 3..][..3].fill(255);
        let picture = Picture::new(&rgb, SIZE).unwrap();
        assert!((picture.at(towards(80.0, 10.0)).0 / light(200) - 1.0).abs() < 1e-9);
        assert!((picture.at(towards(280.0, 10.0)).0 / light(60) - 1.0).abs() < 1e-9);
        let dot = towards(180.0 - 500.5 / 2.0, 90.0 - 200.5 / 2.0);
        assert!((picture.at(dot).0 / light(60) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn smoothing_keeps_the_light() {
        let (width, height) = SIZE;
        let grid = Grid { width, height, values: vec![0.0; width * height] };
        for b in [0.0, 50.0, 80.0] {
            let spot = towards(30.0, b);
            let lit = grid.like(|_, dir| f64::from(u8::from(dir.dot(spot) > 0.9995)));
            let area = |grid: &Grid| {
                let row = |at: usize| (PI * ((at / width) as f64 + 0.5) / height as f64).sin();
                grid.values.iter().enumerate().map(|(at, v)| v * row(at)).sum::<f64>()
            };
            let ratio = area(&lit.blurred(2.0)) / area(&lit);
            assert!((ratio - 1.0).abs() < 0.02, "{b}: {ratio}");
        }
    }

    #[test]
    fn other_shapes_are_refused() {
        assert!(Picture::new(&[0; 27], (3, 3)).is_err());
        assert!(Picture::new(&[0; 27], SIZE).unwrap_err().contains("bytes"));
    }
}

//! How much of each species lies along a straight path through spherical air.
//!
//! Columns instead of optical depths: they know no wavelength, so one table serves them all. In a
//! layer with density `c + b r`, along a line whose closest approach to the centre is `p`, with `s`
//! counted from there: `Int (c + b r) ds = c s + b/2 (s r + p^2 ln(s + r))`.

use rayon::prelude::*;

use super::profile::{EARTH_RADIUS_KM, Profile, SPECIES, TOP_KM};

const TOP_RADIUS_KM: f64 = EARTH_RADIUS_KM + TOP_KM;

/// Columns between two radii on the outgoing half of a line, `p2 = p^2 <= near^2 <= far^2`.
///
/// In km of relative density. Exact for densities that are linear in height.
pub(crate) fn between(profile: &Profile, p2: f64, near_km: f64, far_km: f64) -> [f64; SPECIES] {
    let mut sum = [0.0; SPECIES];
    let (heights, densities) = (profile.heights_km(), profile.densities());
    let antiderivative = |r: f64| {
        let s = (r * r - p2).max(0.0).sqrt();
        (s, 0.5 * (s * r + if p2 > 0.0 { p2 * (s + r).ln() } else { 0.0 }))
    };
    let mut low = antiderivative(near_km);
    let mut layer = profile.layer(near_km - EARTH_RADIUS_KM);
    loop {
        let is_last = layer + 2 >= heights.len();
        let layer_top = EARTH_RADIUS_KM + heights[layer + 1];
        let ends = is_last || far_km <= layer_top;
        let high = antiderivative(if ends { far_km } else { layer_top });
        let (ds, dq) = (high.0 - low.0, high.1 - low.1);
        let bottom = EARTH_RADIUS_KM + heights[layer];
        for (k, sum) in sum.iter_mut().enumerate() {
            let (a, b) = (densities[layer][k], densities[layer + 1][k]);
            let slope = (b - a) / (layer_top - bottom);
            *sum += (a - slope * bottom) * ds + slope * dq;
        }
        if ends {
            return sum;
        }
        low = high;
        layer += 1;
    }
}

/// Columns from a height to the end of the air; `None` if the ground is in between.
///
/// Exact, no table.
pub(crate) fn to_space(
    profile: &Profile,
    height_km: f64,
    cos_zenith: f64,
) -> Option<[f64; SPECIES]> {
    let r = EARTH_RADIUS_KM + height_km;
    let p2 = r * r * (1.0 - cos_zenith * cos_zenith);
    if cos_zenith >= 0.0 {
        return Some(between(profile, p2, r, TOP_RADIUS_KM));
    }
    let tangent = p2.sqrt();
    if tangent < EARTH_RADIUS_KM {
        return None;
    }
    let down = between(profile, p2, tangent, r);
    let up = between(profile, p2, tangent, TOP_RADIUS_KM);
    Some(std::array::from_fn(|k| down[k] + up[k]))
}

/// Steps in distance, from the shortest way out (the zenith) to the longest (level).
const DISTANCES: usize = 129;
/// Step of the table of grazing rays, km.
const GRAZING_STEP_KM: f64 = 0.05;

/// Columns from anywhere in the air towards a distant source, tabulated.
#[derive(Debug, Clone)]
pub(crate) struct SourceColumns {
    heights_km: Vec<f64>,
    /// `[height][distance]`, sources above the horizontal.
    above: Vec<[f32; SPECIES]>,
    /// From the closest point of a line to the end of the air, by its height.
    grazing: Vec<[f32; SPECIES]>,
}

/// A height, prepared for many look-ups.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SourceRow {
    index: usize,
    weight: f32,
    r_km: f64,
    height_km: f64,
    /// Square of the distance to the end of the air on a level line.
    level2: f64,
    shortest_km: f64,
    per_km: f64,
}

impl SourceColumns {
    pub fn new(profile: &Profile) -> SourceColumns {
        // 0.2 km below 12 km, 0.5 km below 40 km, 1 km above.
        let heights_km: Vec<f64> = (0..60)
            .map(|i| 0.2 * f64::from(i))
            .chain((0..56).map(|i| 12.0 + 0.5 * f64::from(i)))
            .chain((40..=120).map(f64::from))
            .collect();
        let above = heights_km
            .par_iter()
            .flat_map_iter(|&h| {
                let r = EARTH_RADIUS_KM + h;
                let level2 = (TOP_RADIUS_KM - r) * (TOP_RADIUS_KM + r);
                let (shortest, longest) = (TOP_RADIUS_KM - r, level2.sqrt());
                (0..DISTANCES).map(move |i| {
                    let x = i as f64 / (DISTANCES - 1) as f64;
                    let d = shortest + (longest - shortest) * x;
                    if d <= 0.0 {
                        return [0.0; SPECIES];
                    }
                    let mu = ((level2 - d * d) / (2.0 * r * d)).clamp(0.0, 1.0);
                    between(profile, r * r * (1.0 - mu * mu), r, TOP_RADIUS_KM).map(|n| n as f32)
                })
            })
            .collect();
        let grazing = (0..=(TOP_KM / GRAZING_STEP_KM).round() as usize)
            .map(|i| {
                let r = (EARTH_RADIUS_KM + i as f64 * GRAZING_STEP_KM).min(TOP_RADIUS_KM);
                between(profile, r * r, r, TOP_RADIUS_KM).map(|n| n as f32)
            })
            .collect();
        SourceColumns { heights_km, above, grazing }
    }

    pub fn row(&self, height_km: f64) -> SourceRow {
        let height_km = height_km.clamp(0.0, TOP_KM);
        let last = self.heights_km.len() - 1;
        let index = self.heights_km.partition_point(|&h| h <= height_km).clamp(1, last) - 1;
        let (low, high) = (self.heights_km[index], self.heights_km[index + 1]);
        let r_km = EARTH_RADIUS_KM + height_km;
        let level2 = (TOP_RADIUS_KM - r_km) * (TOP_RADIUS_KM + r_km);
        let shortest_km = TOP_RADIUS_KM - r_km;
        SourceRow {
            index,
            weight: ((height_km - low) / (high - low)) as f32,
            r_km,
            height_km,
            level2,
            shortest_km,
            per_km: (DISTANCES - 1) as f64 / (level2.sqrt() - shortest_km).max(1e-9),
        }
    }

    /// Columns towards a source whose zenith distance there has the cosine `mu`; `None` in the
    /// shadow of the Earth.
    #[inline]
    pub fn columns(&self, row: &SourceRow, mu: f64) -> Option<[f32; SPECIES]> {
        if mu >= 0.0 {
            return Some(self.above(row, mu));
        }
        // Height of the closest point, without the difference of two radii.
        let closest_km =
            row.height_km - row.r_km * mu * mu / (1.0 + (1.0 - mu * mu).max(0.0).sqrt());
        if closest_km < 0.0 {
            return None;
        }
        let t = closest_km / GRAZING_STEP_KM;
        let i = (t as usize).min(self.grazing.len() - 2);
        let t = (t - i as f64) as f32;
        let (a, b) = (&self.grazing[i], &self.grazing[i + 1]);
        let up = self.above(row, -mu);
        Some(std::array::from_fn(|k| (2.0 * (a[k] + (b[k] - a[k]) * t) - up[k]).max(0.0)))
    }

    #[inline]
    fn above(&self, row: &SourceRow, mu: f64) -> [f32; SPECIES] {
        let climb = row.r_km * mu;
        let distance = row.level2 / (climb + (climb * climb + row.level2).sqrt()).max(1e-9);
        let t = ((distance - row.shortest_km) * row.per_km).clamp(0.0, (DISTANCES - 1) as f64);
        let i = (t as usize).min(DISTANCES - 2);
        let t = (t - i as f64) as f32;
        let low = &self.above[row.index * DISTANCES + i..];
        let high = &self.above[(row.index + 1) * DISTANCES + i..];
        std::array::from_fn(|k| {
            let a = low[0][k] + (low[1][k] - low[0][k]) * t;
            let b = high[0][k] + (high[1][k] - high[0][k]) * t;
            a + (b - a) * row.weight
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_uniform_column_is_its_length() {
        let uniform =
            Profile::from_nodes(vec![0.0, 7.0, 60.0, TOP_KM], vec![[1.0, 2.0, 0.0, 0.0]; 4]);
        for (height, mu) in [(0.0, 1.0), (0.0, 0.3), (5.0, 0.0), (30.0, -0.05), (119.0, 0.7)] {
            let r = EARTH_RADIUS_KM + height;
            let length = -r * mu + (r * r * (mu * mu - 1.0) + TOP_RADIUS_KM.powi(2)).sqrt();
            let [one, two, none, _] = to_space(&uniform, height, mu).unwrap();
            assert!((one - length).abs() < 1e-8 * length, "{height} km, {mu}: {one} {length}");
            assert!((two - 2.0 * length).abs() < 1e-8 * length && none == 0.0);
        }
        assert_eq!(to_space(&uniform, 1.0, -0.5), None);
    }

    #[test]
    fn a_linear_column_is_its_integral() {
        let linear = Profile::from_nodes(
            vec![0.0, TOP_KM],
            vec![[1.0, 0.0, 0.0, 0.0], [0.25, 0.0, 0.0, 0.0]],
        );
        let (height, mu) = (10.0, 0.02);
        let r = EARTH_RADIUS_KM + height;
        let length = -r * mu + (r * r * (mu * mu - 1.0) + TOP_RADIUS_KM.powi(2)).sqrt();
        let n = 20_000;
        let sum: f64 = (0..n)
            .map(|i| {
                let s = length * (i as f64 + 0.5) / n as f64;
                let h = (r * r + s * s + 2.0 * r * mu * s).sqrt() - EARTH_RADIUS_KM;
                (1.0 - 0.75 * h / TOP_KM) * length / n as f64
            })
            .sum();
        let got = to_space(&linear, height, mu).unwrap()[0];
        assert!((got / sum - 1.0).abs() < 1e-8, "{got} {sum}");
    }

    #[test]
    fn the_table_follows_the_formula() {
        let profile = Profile::new(&crate::air::Atmosphere::default());
        let table = SourceColumns::new(&profile);
        // Optical depths at 450 nm: per km for molecules, aerosol as it is.
        let depth = |n: [f64; SPECIES]| 0.026 * n[0] + 0.0001 * n[1] + 0.13 * n[2];
        for height in [0.001, 0.37, 1.9, 8.05, 14.2, 33.3, 77.7, 119.5] {
            for zenith_deg in [0.0f64, 30.0, 60.0, 80.0, 85.0, 88.0, 89.7, 90.0, 91.0, 94.0, 97.0] {
                let mu = zenith_deg.to_radians().cos();
                let exact = to_space(&profile, height, mu).map(|n| (-depth(n)).exp());
                let fast = table.columns(&table.row(height), mu);
                let fast = fast.map(|n| (-depth(n.map(f64::from))).exp());
                let difference = (exact.unwrap_or(0.0) - fast.unwrap_or(0.0)).abs();
                assert!(difference < 2e-3, "{height} km, {zenith_deg}: {exact:?} {fast:?}");
            }
        }
    }
}

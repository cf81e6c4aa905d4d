//! Shells of air with densities linear in height, and straight paths through them.
//!
//! On a line whose closest approach to the centre of the Earth is `p`, with `t` the distance from
//! there, a density `c + b r` has the antiderivative `c t + b/2 (t r + p^2 ln((t + r) / p))`, odd in `t`. It
//! is taken at every shell that the path crosses: columns are exact, no table is read.

use crate::air::scattering::profile::{EARTH_RADIUS_KM, Profile, SPECIES, TOP_KM};

/// How much of each species lies along a path, in km of relative density.
pub(super) type Columns = [f64; SPECIES];

/// The air between the ground and space.
#[derive(Debug, Clone)]
pub(super) struct Shells {
    /// Of the ground, the nodes of the profile above it, and the end of the air; ascending.
    radii_km: Vec<f64>,
    /// Density `offset + slope r` between each two of them.
    layers: Vec<Layer>,
}

#[derive(Debug, Clone, Copy)]
struct Layer {
    offset: Columns,
    slope: Columns,
}

/// A point of a path, seen from its closest approach to the centre of the Earth.
#[derive(Debug, Clone, Copy, Default)]
struct Mark {
    /// Signed distance from the closest approach.
    t_km: f64,
    /// `1/2 (t r + p^2 ln((t + r) / p))`, odd in `t`.
    q: f64,
}

/// A straight line.
#[derive(Debug, Clone, Copy, Default)]
struct Line {
    /// Square of its closest approach.
    p2: f64,
    per_p: f64,
}

impl Line {
    fn through(r_km: f64, cos_zenith: f64) -> Line {
        // A line through the centre itself has no logarithm; 30 mm beside it has.
        let p2 = (r_km * r_km * (1.0 - cos_zenith * cos_zenith)).max(1e-9);
        Line { p2, per_p: 1.0 / p2.sqrt() }
    }

    #[inline]
    fn mark(&self, t_km: f64, r_km: f64) -> Mark {
        let t = t_km.abs();
        let q = 0.5 * (t * r_km + self.p2 * ((t + r_km) * self.per_p).ln());
        Mark { t_km, q: q.copysign(t_km) }
    }

    /// Where it leaves a shell.
    #[inline]
    fn leaves(&self, r_km: f64) -> Mark {
        self.mark((r_km * r_km - self.p2).max(0.0).sqrt(), r_km)
    }

    /// Where it enters a shell.
    #[inline]
    fn enters(&self, r_km: f64) -> Mark {
        self.mark(-(r_km * r_km - self.p2).max(0.0).sqrt(), r_km)
    }
}

impl Layer {
    fn column(&self, from: Mark, to: Mark) -> Columns {
        let (dt, dq) = (to.t_km - from.t_km, to.q - from.q);
        std::array::from_fn(|k| self.offset[k] * dt + self.slope[k] * dq)
    }
}

/// A straight path from a point to the ground or to space, cut where it crosses shells.
#[derive(Debug, Clone, Default)]
pub(super) struct Path {
    line: Line,
    hits_ground: bool,
    marks: Vec<Mark>,
    /// From the start to each mark.
    columns: Vec<Columns>,
    /// The layer that follows each mark but the last.
    layers: Vec<usize>,
}

impl Shells {
    /// The air of a profile above ground of a height.
    pub fn new(profile: &Profile, ground_km: f64) -> Shells {
        let ground_km = ground_km.clamp(0.0, TOP_KM - 1.0);
        let above = profile.heights_km().iter().filter(|&&h| h > ground_km + 1e-9);
        let heights: Vec<f64> = std::iter::once(ground_km).chain(above.copied()).collect();
        let layer = |pair: &[f64]| {
            let (low, high) = (profile.density(pair[0]), profile.density(pair[1]));
            let slope = std::array::from_fn(|k| (high[k] - low[k]) / (pair[1] - pair[0]));
            let bottom = EARTH_RADIUS_KM + pair[0];
            let offset = std::array::from_fn(|k: usize| low[k] - slope[k] * bottom);
            Layer { offset, slope }
        };
        Shells {
            layers: heights.windows(2).map(layer).collect(),
            radii_km: heights.iter().map(|h| EARTH_RADIUS_KM + h).collect(),
        }
    }

    pub fn ground_km(&self) -> f64 {
        self.radii_km[0]
    }

    pub fn top_km(&self) -> f64 {
        self.radii_km[self.layers.len()]
    }

    pub fn layer_count(&self) -> usize {
        self.layers.len()
    }

    /// Radius of the middle of a layer.
    pub fn middle_km(&self, layer: usize) -> f64 {
        0.5 * (self.radii_km[layer] + self.radii_km[layer + 1])
    }

    /// The layer at a radius, the nearest outside the air.
    pub fn layer(&self, r_km: f64) -> usize {
        let last = self.layers.len();
        self.radii_km.partition_point(|&r| r <= r_km).clamp(1, last) - 1
    }

    /// Relative densities at a radius of a layer.
    #[inline]
    pub fn density(&self, layer: usize, r_km: f64) -> Columns {
        let Layer { offset, slope } = &self.layers[layer];
        std::array::from_fn(|k| (offset[k] + slope[k] * r_km).max(0.0))
    }

    /// Columns from a radius to space; `None` if the ground is in between.
    pub fn to_space(&self, r_km: f64, cos_zenith: f64) -> Option<Columns> {
        let r = r_km.clamp(self.ground_km(), self.top_km());
        let line = Line::through(r, cos_zenith);
        if cos_zenith >= 0.0 {
            return Some(self.outwards(line, line.mark(r * cos_zenith, r), self.layer(r)));
        }
        let p = line.p2.sqrt();
        if p < self.ground_km() {
            return None;
        }
        // Twice the way from the closest approach, less the part behind the start.
        let out = self.outwards(line, Mark::default(), self.layer(p));
        let behind = self.outwards(line, line.mark(-r * cos_zenith, r), self.layer(r));
        Some(std::array::from_fn(|k| 2.0 * out[k] - behind[k]))
    }

    fn outwards(&self, line: Line, mut from: Mark, layer: usize) -> Columns {
        let mut sum = [0.0; SPECIES];
        for (layer, &r) in self.layers.iter().zip(&self.radii_km[1..]).skip(layer) {
            let to = line.leaves(r);
            let column = layer.column(from, to);
            sum = std::array::from_fn(|k| sum[k] + column[k]);
            from = to;
        }
        sum
    }

    /// Cuts the path from a radius in a direction, given by the cosine of its zenith distance.
    pub fn cut(&self, r_km: f64, cos_zenith: f64, path: &mut Path) {
        let r = r_km.clamp(self.ground_km(), self.top_km());
        let line = Line::through(r, cos_zenith);
        path.line = line;
        path.marks.clear();
        path.columns.clear();
        path.layers.clear();
        path.marks.push(line.mark(r * cos_zenith, r));
        path.columns.push([0.0; SPECIES]);
        let ground2 = self.ground_km() * self.ground_km();
        path.hits_ground = cos_zenith < 0.0 && line.p2 < ground2;
        let start = self.layer(r);
        let mut upwards_from = start;
        if cos_zenith < 0.0 {
            let lowest = if path.hits_ground { 0 } else { self.layer(line.p2.sqrt()) };
            let is_below_start = |layer: &usize| self.radii_km[*layer] < r;
            let first = if path.hits_ground { 0 } else { lowest + 1 };
            for layer in (first..=start).rev().filter(is_below_start) {
                self.extend(path, layer, line.enters(self.radii_km[layer]));
            }
            if path.hits_ground {
                return;
            }
            upwards_from = lowest;
        }
        for layer in upwards_from..self.layers.len() {
            self.extend(path, layer, line.leaves(self.radii_km[layer + 1]));
        }
    }

    fn extend(&self, path: &mut Path, layer: usize, to: Mark) {
        let last = path.marks.len() - 1;
        let column = self.layers[layer].column(path.marks[last], to);
        let sum = path.columns[last];
        path.columns.push(std::array::from_fn(|k| sum[k] + column[k].max(0.0)));
        path.marks.push(to);
        path.layers.push(layer);
    }
}

impl Path {
    pub fn hits_ground(&self) -> bool {
        self.hits_ground
    }

    /// How many pieces it has.
    pub fn pieces(&self) -> usize {
        self.layers.len()
    }

    pub fn layer(&self, piece: usize) -> usize {
        self.layers[piece]
    }

    /// From the start to where a piece begins, or the last ends.
    #[inline]
    pub fn distance_km(&self, mark: usize) -> f64 {
        self.marks[mark].t_km - self.marks[0].t_km
    }

    pub fn length_km(&self) -> f64 {
        self.distance_km(self.pieces())
    }

    /// From the start to where a piece begins, or the last ends.
    #[inline]
    pub fn columns(&self, mark: usize) -> &Columns {
        &self.columns[mark]
    }

    pub fn all_columns(&self) -> &Columns {
        &self.columns[self.pieces()]
    }

    /// The piece at a distance.
    pub fn piece_at(&self, distance_km: f64) -> usize {
        let t = self.marks[0].t_km + distance_km;
        self.marks.partition_point(|mark| mark.t_km <= t).clamp(1, self.pieces().max(1)) - 1
    }

    /// Radius at a distance from the start.
    #[inline]
    pub fn radius_km(&self, distance_km: f64) -> f64 {
        let t = self.marks[0].t_km + distance_km;
        (self.line.p2 + t * t).sqrt()
    }

    /// Columns from the start to a distance that lies in a piece.
    pub fn columns_at(&self, shells: &Shells, piece: usize, distance_km: f64) -> Columns {
        let t = self.marks[0].t_km + distance_km;
        let to = self.line.mark(t, (self.line.p2 + t * t).sqrt());
        let column = shells.layers[self.layers[piece]].column(self.marks[piece], to);
        std::array::from_fn(|k| self.columns[piece][k] + column[k].max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::Atmosphere;
    use crate::air::scattering::columns;

    #[test]
    fn columns_are_those_of_the_other_formula() {
        let profile = Profile::new(&Atmosphere::default(), 0.0);
        let shells = Shells::new(&profile, 0.0);
        for height in [0.0, 0.3, 8.0, 33.0, 119.0] {
            for cos_zenith in [1.0, 0.4, 0.01, 0.0, -0.002, -0.03, -0.15, -0.9] {
                let want = columns::to_space(&profile, height, cos_zenith);
                let got = shells.to_space(EARTH_RADIUS_KM + height, cos_zenith);
                assert_eq!(want.is_some(), got.is_some(), "{height} {cos_zenith}");
                for (want, got) in want.iter().flatten().zip(got.iter().flatten()) {
                    assert!((want - got).abs() < 1e-6 * want + 1e-6, "{height} {cos_zenith}");
                }
                // A path to space holds the same, and its middle is half of it where it is told twice.
                let mut path = Path::default();
                shells.cut(EARTH_RADIUS_KM + height, cos_zenith, &mut path);
                assert_eq!(path.hits_ground(), got.is_none());
                for (sum, got) in path.all_columns().iter().zip(got.iter().flatten()) {
                    assert!((sum - got).abs() < 1e-6 * got + 1e-6, "{height} {cos_zenith}");
                }
            }
        }
    }

    #[test]
    fn a_path_ends_on_the_ground_or_in_space_and_grows_steadily() {
        let shells = Shells::new(&Profile::new(&Atmosphere::default(), 0.0), 2.3);
        let mut path = Path::default();
        for (r, cos_zenith) in [(6374.0, -0.5), (6373.3, 0.2), (6400.0, -0.06), (6490.0, -1e-3)] {
            shells.cut(r, cos_zenith, &mut path);
            let end = path.radius_km(path.length_km());
            let wanted = if path.hits_ground() { shells.ground_km() } else { shells.top_km() };
            assert!((end - wanted).abs() < 1e-6, "{r} {cos_zenith}: {end}");
            let n = 500;
            let mut before = 0.0;
            for i in 0..=n {
                let s = path.length_km() * f64::from(i) / f64::from(n);
                let piece = path.piece_at(s);
                let here = path.columns_at(&shells, piece, s)[0];
                assert!(here >= before - 1e-9, "{here} {before}");
                let layer = shells.layer(path.radius_km(s).clamp(shells.ground_km(), end));
                let apart = layer.abs_diff(path.layer(piece));
                assert!(apart <= 1, "{layer} {}", path.layer(piece));
                before = here;
            }
            assert!((before / path.all_columns()[0] - 1.0).abs() < 1e-9);
        }
    }
}

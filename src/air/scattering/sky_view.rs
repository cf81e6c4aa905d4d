//! The diffuse light all around an observer, under one source, as a table.
//!
//! Rows of elevation are dense at the horizon, on both sides of it. Above, `el = h + (90 - h) t^2`;
//! below, where the ground is seen through the air before it, `el = h - (90 + h) t^4`, `t` from 0 to
//! 1 in equal steps and `h` the elevation of the horizon. Both have a row of their own at the
//! horizon. Columns of azimuth count from the source, 0 to 180 degrees in equal steps.
//!
//! Each node holds two parts. The smooth one is light that molecules or the ground scattered, and all
//! that was scattered more than once. The other is light that haze scattered once, divided by the
//! haze's phase function at 550 nm for the angle that the light turns: the sharp aureole is in that
//! function alone, which [`Phase`] keeps finely, and is multiplied back for each direction. No row
//! or column needs to resolve it.
//!
//! Few nodes are computed; [`SkyView::refined`] draws cubics through them (Lagrange, four points,
//! in the logarithm of the smooth part and in the ratio of the other to it) so that a finer table can
//! be read with straight lines. That reading, [`SkyView::sample`], is the twin of
//! `shaders/skylight.wgsl`.
//!
//! Accuracy against rays cut for their own direction: see the tests.
//!
//! Omitted: the change of the haze's phase function with wavelength is interpolated between nodes
//! as everything else is, not followed within an aureole.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::lanes::LANES;
use super::reconstruction::{SUMS, SpectralSums};
use super::{ScatteringTables, ViewRays};
use crate::air::Atmosphere;
use crate::units::Angle;

/// How many nodes a table has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SkyShape {
    /// Rows from the horizon to the zenith, 4 or more.
    pub above: usize,
    /// Rows from the horizon to the nadir, 4 or more.
    pub below: usize,
    /// Columns from the source to opposite it, 4 or more.
    pub azimuths: usize,
}

impl SkyShape {
    /// All rows: those above the horizon, from it to the zenith, then those below, from it down.
    pub const fn rows(self) -> usize {
        self.above + self.below
    }
    pub const fn nodes(self) -> usize {
        self.rows() * self.azimuths
    }
    /// Whether a row is seen above the horizon.
    pub const fn is_above(self, row: usize) -> bool {
        row < self.above
    }
    /// The elevation of a row over a horizon.
    pub fn elevation(self, row: usize, horizon: Angle) -> Angle {
        let step = |row: usize, rows: usize| row as f64 / (rows - 1) as f64;
        if self.is_above(row) {
            let t = step(row, self.above);
            horizon + (Angle::from_deg(90.0) - horizon) * (t * t)
        } else {
            let t = step(row - self.above, self.below);
            horizon - (Angle::from_deg(90.0) + horizon) * (t * t * t * t)
        }
    }
    /// The same, but the rows at the horizon look a little to their side of it.
    pub fn elevation_beside(self, row: usize, horizon: Angle) -> Angle {
        let beside = match row {
            0 => BESIDE_HORIZON,
            row if row == self.above => -BESIDE_HORIZON,
            _ => Angle::ZERO,
        };
        self.elevation(row, horizon) + beside
    }
    /// The azimuth from the source of a column.
    pub fn azimuth(self, column: usize) -> Angle {
        Angle::from_deg(180.0 * column as f64 / (self.azimuths - 1) as f64)
    }
    /// The row at or before an elevation on a side of the horizon, and the share of the next one.
    pub fn row_at(self, elevation: Angle, horizon: Angle, above: bool) -> (usize, f64) {
        let half_turn = PI / 2.0;
        let (t, rows, first) = if above {
            let share = (elevation - horizon).rad() / (half_turn - horizon.rad());
            (share.clamp(0.0, 1.0).sqrt(), self.above, 0)
        } else {
            let share = (horizon - elevation).rad() / (half_turn + horizon.rad());
            (share.clamp(0.0, 1.0).sqrt().sqrt(), self.below, self.above)
        };
        let (row, share) = between(t, rows);
        (first + row, share)
    }
    /// The column at or before an azimuth from the source, and the share of the next one.
    fn column_at(self, azimuth: Angle) -> (usize, f64) {
        between(azimuth.signed().abs().rad() / PI, self.azimuths)
    }
}

/// Where `t`, 0 to 1, falls among equal steps: the node before and the share of the next.
fn between(t: f64, nodes: usize) -> (usize, f64) {
    let place = t * (nodes - 1) as f64;
    let node = (place as usize).min(nodes - 2);
    (node, place - node as f64)
}

/// The phase function of all aerosol at 550 nm, weighed by what each scatters; per steradian.
///
/// In equal steps of the square root of the angle that light turns, straight between: 0.0002 degrees
/// wide at the source, 0.4 degrees opposite it.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    values: Vec<f32>,
}

/// Values that a [`Phase`] keeps.
pub const PHASE_VALUES: usize = 1024;

impl Phase {
    /// None if the air holds no aerosol.
    pub fn of(air: &Atmosphere) -> Option<Phase> {
        let parts: Vec<_> = air
            .aerosols()
            .into_iter()
            .flatten()
            .map(|a| (a, a.optical_depth(550.0) * a.albedo(550.0)))
            .filter(|(_, scattering)| *scattering > 0.0)
            .collect();
        let total: f64 = parts.iter().map(|(_, scattering)| scattering).sum();
        let value = |node: usize| {
            let t = node as f64 / (PHASE_VALUES - 1) as f64;
            let cosine = (PI * t * t).cos();
            let sum: f64 = parts.iter().map(|(a, s)| s * a.phase(550.0, cosine)).sum();
            (sum / total) as f32
        };
        (total > 0.0).then(|| Phase { values: (0..PHASE_VALUES).map(value).collect() })
    }

    /// The values, from light that goes straight on to light that turns back.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// For light that turns by an angle, 0 to 180 degrees.
    pub fn at(&self, turn: Angle) -> f64 {
        let (node, share) = between((turn.rad() / PI).clamp(0.0, 1.0).sqrt(), self.values.len());
        let (low, high) = (f64::from(self.values[node]), f64::from(self.values[node + 1]));
        low + (high - low) * share
    }
}

/// The angle between a direction and a source, azimuth counted from the source; exact for small
/// angles too.
pub fn turn(elevation: Angle, azimuth_from_source: Angle, source_elevation: Angle) -> Angle {
    let (sin, cos) = elevation.sin_cos();
    let (sin_source, cos_source) = source_elevation.sin_cos();
    let (sin_az, cos_az) = azimuth_from_source.sin_cos();
    let across = (cos * sin_az).hypot(sin * cos_source - cos * sin_source * cos_az);
    Angle::from_rad(across.atan2(sin * sin_source + cos * cos_source * cos_az))
}

/// The diffuse light all around an observer, under one source.
///
/// Channels are wavelengths, radiance per unit irradiance of the source outside the air, sr^-1; or
/// what [`SkyView::seen_by`] made of them.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyView {
    pub shape: SkyShape,
    /// Elevation at which the ground begins.
    pub horizon: Angle,
    /// Elevation of the source, from which the turn of light is counted.
    pub source_elevation: Angle,
    pub channels: usize,
    /// Rows outermost, channels innermost.
    pub smooth: Vec<f32>,
    /// The same for haze over [`SkyView::phase`]; empty without haze.
    pub haze: Vec<f32>,
    pub phase: Option<Phase>,
}

/// The rays of an observer that a [`SkyView`] of some shape asks for, cut once for all sources.
#[derive(Debug, Clone)]
pub struct SkyRays {
    shape: SkyShape,
    horizon: Angle,
    height_km: f64,
    rays: ViewRays,
}

/// The rows at the horizon look this far to their side of it.
const BESIDE_HORIZON: Angle = Angle::from_arcsec(0.5);

impl ScatteringTables {
    /// Cuts the rays of an observer, who stands at a height above sea level, kilometres.
    pub fn sky_rays(&self, height_km: f64, shape: SkyShape) -> SkyRays {
        let horizon = self.horizon(height_km);
        let elevations: Vec<Angle> =
            (0..shape.rows()).map(|row| shape.elevation_beside(row, horizon)).collect();
        SkyRays { shape, horizon, height_km, rays: self.view_rays(height_km, &elevations) }
    }

    /// The elevation in which a source of the given true zenith distance is seen from where rays were cut.
    pub fn source_elevation(&self, from: &SkyRays, cos_source_zenith: f64) -> Angle {
        let cos_source = cos_source_zenith.clamp(-1.0, 1.0);
        let raised = self.beams.refraction(from.height_km.max(self.ground_km()), cos_source);
        Angle::from_rad(cos_source.asin()) + raised
    }

    /// The light all around, under a source of the given true zenith distance.
    pub fn sky_view(&self, from: &SkyRays, cos_source_zenith: f64) -> SkyView {
        let SkyRays { shape, horizon, ref rays, .. } = *from;
        let n = self.wavelengths_nm.len();
        let cos_source = cos_source_zenith.clamp(-1.0, 1.0);
        let source_elevation = self.source_elevation(from, cos_source_zenith);
        let cos_azimuths: Vec<f64> = (0..shape.azimuths).map(|i| shape.azimuth(i).cos()).collect();
        let rows: Vec<(Vec<f32>, Vec<f32>)> = (0..shape.rows())
            .into_par_iter()
            .map(|row| {
                let elevation = shape.elevation(row, horizon);
                let per_phase: Vec<f32> = match &self.phase {
                    Some(phase) => (0..shape.azimuths)
                        .map(|column| turn(elevation, shape.azimuth(column), source_elevation))
                        .map(|turn| 1.0 / phase.at(turn) as f32)
                        .collect(),
                    None => Vec::new(),
                };
                let mut smooth = vec![0.0; shape.azimuths * n];
                let mut haze = vec![0.0; per_phase.len() * n];
                for band in 0..self.bands.len() {
                    let along = self.along(rays, row, band, cos_source, &cos_azimuths);
                    for (out, light) in smooth.chunks_exact_mut(n).zip(&along) {
                        let of_band = out.iter_mut().skip(band * LANES);
                        of_band.zip(light.smooth.0).for_each(|(out, value)| *out = value);
                    }
                    for ((out, light), by) in haze.chunks_exact_mut(n).zip(&along).zip(&per_phase) {
                        let of_band = out.iter_mut().skip(band * LANES);
                        of_band.zip(light.haze.0).for_each(|(out, value)| *out = value * by);
                    }
                }
                (smooth, haze)
            })
            .collect();
        let (smooth, haze): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
        SkyView {
            shape,
            horizon,
            source_elevation,
            channels: n,
            smooth: smooth.concat(),
            haze: haze.concat(),
            phase: self.phase.clone(),
        }
    }
}

/// Less light than this is none.
const DARK: f32 = 1e-30;

impl SkyView {
    fn node(&self, row: usize, column: usize) -> std::ops::Range<usize> {
        let start = (row * self.shape.azimuths + column) * self.channels;
        start..start + self.channels
    }

    /// The smooth part of a node, and that of the haze, which may be empty.
    pub fn parts(&self, row: usize, column: usize) -> (&[f32], &[f32]) {
        let node = self.node(row, column);
        (&self.smooth[node.clone()], self.haze.get(node).unwrap_or_default())
    }

    /// The phase function in a direction; 0 without haze.
    fn phase_in(&self, elevation: Angle, azimuth_from_source: Angle) -> f64 {
        self.phase.as_ref().map_or(0.0, |phase| {
            phase.at(turn(elevation, azimuth_from_source, self.source_elevation))
        })
    }

    /// All light of a node.
    pub fn light(&self, row: usize, column: usize) -> Vec<f64> {
        let elevation = self.shape.elevation(row, self.horizon);
        let phase = self.phase_in(elevation, self.shape.azimuth(column));
        let (smooth, haze) = self.parts(row, column);
        let haze = |channel: usize| haze.get(channel).map_or(0.0, |&h| f64::from(h) * phase);
        smooth.iter().enumerate().map(|(i, &s)| f64::from(s) + haze(i)).collect()
    }

    /// The light from a direction: sky at or above the horizon, ground below it.
    pub fn sample(&self, elevation: Angle, azimuth_from_source: Angle, out: &mut [f64]) {
        self.sample_side(elevation, azimuth_from_source, elevation >= self.horizon, out);
    }

    /// The same, from a side of the horizon that is given.
    pub fn sample_side(
        &self,
        elevation: Angle,
        azimuth_from_source: Angle,
        above: bool,
        out: &mut [f64],
    ) {
        let (row, up) = self.shape.row_at(elevation, self.horizon, above);
        let (column, along) = self.shape.column_at(azimuth_from_source);
        let low = self.node(row, column).start;
        let high = self.node(row + 1, column).start;
        let next = self.channels;
        let mixed = |part: &[f32], channel: usize| {
            let at = |start: usize| f64::from(part[start + channel]);
            let lower = at(low) + (at(low + next) - at(low)) * along;
            let upper = at(high) + (at(high + next) - at(high)) * along;
            lower + (upper - lower) * up
        };
        let phase = self.phase_in(elevation, azimuth_from_source);
        for (channel, out) in out.iter_mut().enumerate().take(self.channels) {
            *out = mixed(&self.smooth, channel);
            if !self.haze.is_empty() {
                *out += phase * mixed(&self.haze, channel);
            }
        }
    }

    /// The same view through other eyes: the wavelengths of each node made into sums over a spectrum.
    pub fn seen_by(&self, sums: &SpectralSums) -> SkyView {
        let converted = |part: &[f32]| {
            part.par_chunks_exact(self.channels * self.shape.azimuths)
                .flat_map_iter(|row| {
                    row.chunks_exact(self.channels).flat_map(|node| sums.apply(node))
                })
                .collect::<Vec<f32>>()
        };
        SkyView {
            channels: SUMS,
            smooth: converted(&self.smooth),
            haze: converted(&self.haze),
            phase: self.phase.clone(),
            ..*self
        }
    }

    /// Takes away what is seen below the horizon.
    pub fn blacken_ground(&mut self) {
        let first = self.node(self.shape.above, 0).start;
        self.smooth[first..].fill(0.0);
        self.haze.iter_mut().skip(first).for_each(|value| *value = 0.0);
    }

    /// The same view on more nodes, by cubics.
    pub fn refined(&self, shape: SkyShape) -> SkyView {
        let n = self.channels;
        let hazy = !self.haze.is_empty();
        let width = if hazy { 2 * n } else { n };
        // What is smooth: logarithms, then the ratios of haze to what they belong to.
        let node = |row: usize, column: usize| {
            let (smooth, haze) = self.parts(row, column);
            let logs = smooth.iter().map(|value| value.max(DARK).ln());
            let ratios = haze.iter().zip(smooth).map(|(haze, value)| haze / value.max(DARK));
            logs.chain(ratios).collect::<Vec<f32>>()
        };
        let columns: Vec<Stencil> = (0..shape.azimuths)
            .map(|i| Stencil::mirrored(i, shape.azimuths, self.shape.azimuths))
            .collect();
        // First along the azimuth.
        let wide: Vec<Vec<f32>> = (0..self.shape.rows())
            .into_par_iter()
            .map(|row| {
                let nodes: Vec<Vec<f32>> =
                    (0..self.shape.azimuths).map(|column| node(row, column)).collect();
                let mut out = vec![0.0; shape.azimuths * width];
                for (stencil, out) in columns.iter().zip(out.chunks_exact_mut(width)) {
                    for (index, weight) in stencil.taps() {
                        out.iter_mut().zip(&nodes[index]).for_each(|(o, v)| *o += weight * v);
                    }
                }
                out
            })
            .collect();
        // Then along the elevation, each side of the horizon for itself.
        let parts: Vec<(Vec<f32>, Vec<f32>)> = (0..shape.rows())
            .into_par_iter()
            .map(|row| {
                let (stencil, first) = if shape.is_above(row) {
                    (Stencil::bounded(row, shape.above, self.shape.above), 0)
                } else {
                    let row = row - shape.above;
                    (Stencil::bounded(row, shape.below, self.shape.below), self.shape.above)
                };
                let mut fine = vec![0.0; shape.azimuths * width];
                for (index, weight) in stencil.taps() {
                    let from = &wide[first + index];
                    fine.iter_mut().zip(from).for_each(|(o, v)| *o += weight * v);
                }
                let mut smooth = Vec::with_capacity(shape.azimuths * n);
                let mut haze = Vec::with_capacity(if hazy { shape.azimuths * n } else { 0 });
                for node in fine.chunks_exact(width) {
                    let (logs, ratios) = node.split_at(n);
                    let start = smooth.len();
                    smooth.extend(logs.iter().map(|ln| match ln.exp() {
                        light if light > 10.0 * DARK => light,
                        _ => 0.0,
                    }));
                    // A cubic can dip below zero where haze falls into shadow.
                    let lit = ratios.iter().zip(&smooth[start..]);
                    haze.extend(lit.map(|(ratio, light)| ratio.max(0.0) * light));
                }
                (smooth, haze)
            })
            .collect();
        let (smooth, haze): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
        SkyView {
            shape,
            smooth: smooth.concat(),
            haze: haze.concat(),
            phase: self.phase.clone(),
            ..*self
        }
    }
}

/// Four nodes and what each counts for.
#[derive(Debug, Clone, Copy)]
struct Stencil {
    nodes: [usize; 4],
    weights: [f32; 4],
}

impl Stencil {
    /// Lagrange's cubic through nodes -1, 0, 1, 2 at `x`.
    fn cubic(x: f64) -> [f32; 4] {
        let (a, b, c, d) = (x + 1.0, x, x - 1.0, x - 2.0);
        [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0].map(|w| w as f32)
    }

    /// Node `i` of `n` fine ones among coarse ones that end.
    fn bounded(i: usize, n: usize, coarse: usize) -> Stencil {
        let place = i as f64 / (n - 1) as f64 * (coarse - 1) as f64;
        let first = (place as usize).clamp(1, coarse - 3) - 1;
        Stencil {
            nodes: std::array::from_fn(|k| first + k),
            weights: Stencil::cubic(place - (first + 1) as f64),
        }
    }

    /// The same among coarse ones that go on as in a mirror.
    fn mirrored(i: usize, n: usize, coarse: usize) -> Stencil {
        let (node, share) = between(i as f64 / (n - 1) as f64, coarse);
        let last = coarse - 1;
        let fold = |k: usize| {
            // One node before the first is one too few to count from 0.
            let at = (node + k).abs_diff(1);
            if at > last { 2 * last - at } else { at }
        };
        Stencil { nodes: std::array::from_fn(fold), weights: Stencil::cubic(share) }
    }

    fn taps(&self) -> impl Iterator<Item = (usize, f32)> {
        self.nodes.into_iter().zip(self.weights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::scattering::Quality;

    /// Directions evenly over the sphere (Fibonacci's spiral): elevation and azimuth.
    fn spiral(n: usize) -> impl Iterator<Item = (Angle, Angle)> {
        (0..n).map(move |i| {
            let sine = 1.0 - (2.0 * i as f64 + 1.0) / n as f64;
            let azimuth = Angle::from_deg(137.507_764 * i as f64).signed();
            (Angle::from_rad(sine.asin()), azimuth)
        })
    }

    #[test]
    #[ignore]
    fn zz_measure() {
        for air in [Atmosphere::default(), Atmosphere::molecular()] {
            for (h, eye) in [(0.0, 0.002), (2500.0, 2.5)] {
                let mut air = air.clone();
                if h > 0.0 {
                    air.ground.height_m = Some(0.0);
                }
                let tables = ScatteringTables::for_observer(
                    &air,
                    h,
                    &[450.0, 550.0, 650.0],
                    Quality::RENDER,
                )
                .unwrap();
                for (ca, cb, cz) in [(25, 9, 19), (31, 11, 25), (41, 11, 25), (31, 11, 37)] {
                    let shape = SkyShape { above: ca, below: cb, azimuths: cz };
                    let rays = tables.sky_rays(eye, shape);
                    for fine in [
                        SkyShape { above: 121, below: 41, azimuths: 73 },
                        SkyShape { above: 161, below: 61, azimuths: 97 },
                    ] {
                        for sun in [40.0f64, 3.0, -3.0, -6.0, -10.0] {
                            let t = std::time::Instant::now();
                            let view = tables.sky_view(&rays, sun.to_radians().sin());
                            let t1 = t.elapsed();
                            let t = std::time::Instant::now();
                            let view = view.refined(fine);
                            let t2 = t.elapsed();
                            let mut errors = [vec![], vec![], vec![]];
                            for (elevation, azimuth) in spiral(1500) {
                                let (mut want, mut got) = ([0.0; 3], [0.0; 3]);
                                tables.radiance(
                                    eye,
                                    sun.to_radians().sin(),
                                    elevation,
                                    azimuth,
                                    &mut want,
                                );
                                view.sample(elevation, azimuth, &mut got);
                                let class = if elevation < view.horizon {
                                    2
                                } else if elevation.deg() < 3.0 {
                                    1
                                } else {
                                    0
                                };
                                for i in 0..3 {
                                    errors[class].push((
                                        (got[i] / want[i] - 1.0).abs() * 100.0,
                                        elevation.deg(),
                                        azimuth.deg(),
                                        i,
                                    ));
                                }
                            }
                            print!(
                                "{:?} {h} {ca}x{cb}x{cz} -> {}x{}x{} sun {sun}: ",
                                air.aerosol.optical_depth_550,
                                fine.above,
                                fine.below,
                                fine.azimuths
                            );
                            for e in &mut errors {
                                e.sort_by(|a, b| a.0.total_cmp(&b.0));
                                let m = e[e.len() - 1];
                                print!(
                                    "{:.3} {:.2} {:.2}({:.1},{:.0},{})  ",
                                    e[e.len() / 2].0,
                                    e[e.len() * 99 / 100].0,
                                    m.0,
                                    m.1,
                                    m.2,
                                    m.3
                                );
                            }
                            println!("{t1:?} {t2:?}");
                        }
                    }
                }
            }
        }
    }
}

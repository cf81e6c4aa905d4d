//! The diffuse field: moments of the radiance that has been scattered, everywhere in the air.
//!
//! `M_lm(h, mu_s) = Int L(h, mu_s, w) Y_lm(w) dw`, with the local vertical as axis, azimuth from the
//! source, and `w` the direction one looks in. Moments of the *field* are kept, not of the source
//! function: densities and phase functions come in after interpolation, species by species.
//! Kept as `ln M_00` and ratios `M_lm / M_00`, linear in height and `mu_s` in between, because the
//! field falls tenfold each three degrees of twilight.

use std::ops::Range;

use super::harmonics::{azimuthal_part, coefficient_count, index};
use super::lanes::{LANES, Lanes};
use super::profile::TOP_KM;
use super::rays::{Bracket, FieldStep, Source};

/// Below this, a moment counts as dark: far under starlight, and safe in single precision.
const DARK: f32 = 1e-34;
/// Cosine of 109 degrees, just past the end of astronomical twilight. Nodes beyond help those before,
/// but nobody waits for them to converge.
const DEEPEST: f64 = -0.3256;
/// `Y_00`.
const Y00: f32 = 0.282_094_8;

/// Zenith distances of the source at which the field is known, degrees, descending.
fn source_zenith_distances_deg() -> Vec<f64> {
    let steps = |from: f64, by: f64, n: usize| (0..n).map(move |i| from + by * i as f64);
    let mut z: Vec<f64> =
        [0.0, 15.0, 30.0, 42.0, 52.0, 60.0, 66.0, 71.0, 75.0, 78.0, 80.0].to_vec();
    z.extend(steps(82.0, 1.0, 6));
    // Twilight, where the shadow of the Earth climbs through the air.
    z.extend(steps(88.0, 0.5, 16));
    z.extend(steps(96.0, 1.0, 7));
    z.extend(steps(103.5, 1.5, 11));
    z.reverse();
    z
}

/// The cosines of [`source_zenith_distances_deg`], ascending, and a quick way into them.
#[derive(Debug, Clone)]
pub(crate) struct SourceGrid {
    pub cosines: Vec<f64>,
    inverse_widths: Vec<f64>,
    /// For equal bins over `[-1, 1]`: the interval that holds the lower edge of the bin.
    first: Vec<u8>,
}

/// Narrower than the narrowest interval of the grid.
const BINS: usize = 512;

impl SourceGrid {
    pub fn new() -> SourceGrid {
        let cosines: Vec<f64> =
            source_zenith_distances_deg().iter().map(|z| z.to_radians().cos()).collect();
        let first = (0..=BINS)
            .map(|i| {
                let edge = -1.0 + 2.0 * i as f64 / BINS as f64;
                Bracket::of(&cosines, edge).index as u8
            })
            .collect();
        let inverse_widths = cosines.windows(2).map(|w| 1.0 / (w[1] - w[0])).collect();
        SourceGrid { cosines, inverse_widths, first }
    }
    pub fn len(&self) -> usize {
        self.cosines.len()
    }
    /// Clamped to the ends of the grid.
    #[inline(always)]
    pub fn bracket(&self, cosine: f64) -> Bracket {
        let bin = ((cosine + 1.0) * (BINS as f64 / 2.0)) as usize;
        let mut index = usize::from(self.first[bin.min(BINS)]);
        if index + 2 < self.cosines.len() && cosine >= self.cosines[index + 1] {
            index += 1;
        }
        let weight = (cosine - self.cosines[index]) * self.inverse_widths[index];
        Bracket { index, weight: weight.clamp(0.0, 1.0) as f32 }
    }
}

/// `0.04 t + 0.96 t^2.6` of the way from the ground to the top for equal steps of `t`: half of the nodes
/// below 20 km.
pub(crate) fn altitude_grid_km(ground_km: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| {
            let t = i as f64 / (count - 1) as f64;
            ground_km + (TOP_KM - ground_km) * (0.04 * t + 0.96 * t.powf(2.6))
        })
        .collect()
}

/// The field for one band of wavelengths.
#[derive(Debug, Clone)]
pub(crate) struct Field {
    /// Highest degree `l` kept.
    pub degree: usize,
    pub altitudes_km: Vec<f64>,
    pub sources: SourceGrid,
    /// `[altitude][source][coefficient]`: the first is `ln M_00`, the others ratios to `M_00`.
    moments: Vec<Lanes>,
    /// Logarithm of the diffuse irradiance of the ground, `[source]`.
    ln_ground: Vec<Lanes>,
}

impl Field {
    /// A dark field.
    pub fn new(degree: usize, ground_km: f64, altitudes: usize) -> Field {
        let sources = SourceGrid::new();
        let mut field = Field {
            degree,
            altitudes_km: altitude_grid_km(ground_km, altitudes),
            moments: vec![Lanes::ZERO; altitudes * sources.len() * coefficient_count(degree)],
            ln_ground: vec![Lanes::ZERO; sources.len()],
            sources,
        };
        let (moments, ground) = (field.moments.clone(), field.ln_ground.clone());
        field.set(&moments, &ground);
        field
    }

    /// Coefficients per node.
    pub fn stride(&self) -> usize {
        coefficient_count(self.degree)
    }

    /// Coefficients of a node of a [`StepField`].
    fn step_stride(&self) -> usize {
        self.degree + 3
    }

    /// Scratch for [`Field::at_step`].
    pub fn step_field(&self) -> StepField {
        StepField(vec![Lanes::ZERO; self.sources.len() * self.step_stride()])
    }

    /// All numbers that were solved for, in order.
    pub fn solved(&self) -> impl Iterator<Item = f32> + '_ {
        self.moments.iter().chain(&self.ln_ground).flat_map(|lanes| lanes.0)
    }

    /// How many numbers [`Field::solved`] gives.
    pub fn solved_len(&self) -> usize {
        (self.moments.len() + self.ln_ground.len()) * LANES
    }

    /// Takes the numbers of [`Field::solved`] back.
    pub fn restore(&mut self, mut solved: impl Iterator<Item = f32>) {
        for lanes in self.moments.iter_mut().chain(&mut self.ln_ground) {
            lanes.0.fill_with(|| solved.next().unwrap_or(0.0));
        }
    }

    /// Takes moments `[altitude][source][coefficient]` and irradiances of the ground `[source]`.
    ///
    /// Returns the greatest change of `ln M_00` under sources down to [`DEEPEST`].
    pub fn set(&mut self, moments: &[Lanes], ground: &[Lanes]) -> f32 {
        let mut change = 0.0f32;
        let stride = self.stride();
        let nodes = self.moments.chunks_exact_mut(stride).zip(moments.chunks_exact(stride));
        for ((old, new), cosine) in nodes.zip(self.sources.cosines.iter().cycle()) {
            let ln = new[0].ln_above(DARK);
            if *cosine > DEEPEST {
                change = (ln - old[0]).0.iter().fold(change, |c, d| c.max(d.abs()));
            }
            old[0] = ln;
            for (old, new) in old[1..].iter_mut().zip(&new[1..]) {
                for i in 0..new.0.len() {
                    old.0[i] = if ln.0[i] > DARK.ln() { new.0[i] * (-ln.0[i]).exp() } else { 0.0 };
                }
            }
        }
        for (old, new) in self.ln_ground.iter_mut().zip(ground) {
            *old = new.ln_above(DARK);
        }
        change
    }

    /// Diffuse irradiance of the ground under a source.
    pub fn ground_irradiance(&self, cos_source: f64) -> Lanes {
        let at = self.sources.bracket(cos_source);
        self.ln_ground[at.index].lerp(self.ln_ground[at.index + 1], at.weight).exp()
    }

    /// What the field scatters along its ray in a step, for the sources of `range`.
    ///
    /// Where there is no haze, only the degrees 0 and 2 count.
    #[inline(always)]
    pub fn at_step(&self, step: &FieldStep, range: Range<usize>, out: &mut StepField) {
        let stride = self.stride();
        let at = step.altitude;
        let sources = self.sources.len();
        let orders = self.orders_at(step);
        for source in range {
            let low = &self.moments[(at.index * sources + source) * stride..][..stride];
            let high = &self.moments[((at.index + 1) * sources + source) * stride..][..stride];
            let out = &mut out.0[source * self.step_stride()..][..self.step_stride()];
            let ln = low[0].lerp(high[0], at.weight);
            let (head, parts) = out.split_at_mut(2);
            head[0] = ln;
            head[1] = (ln * 0.5).exp();
            parts[0] = step.by_degree[0] * Y00;
            parts[1..orders].fill(Lanes::ZERO);
            let degrees = if step.is_hazy { 1..=self.degree } else { 2..=2 };
            for l in degrees {
                for (m, part) in parts[..=l].iter_mut().enumerate() {
                    let k = index(l, m);
                    let ratio = low[k].lerp(high[k], at.weight);
                    *part += ratio * step.by_degree[l] * step.zonal[k];
                }
            }
        }
    }

    /// How many orders of azimuth a step has.
    fn orders_at(&self, step: &FieldStep) -> usize {
        if step.is_hazy { self.degree + 1 } else { 3 }
    }

    /// Light of the field that a step scatters along its ray, from [`Field::at_step`].
    #[inline(always)]
    pub fn scattered(&self, step: &FieldStep, field: &StepField, source: &Source) -> Lanes {
        let stride = self.step_stride();
        let mu_s = source.local_cosine(step.turn);
        let at = self.sources.bracket(mu_s);
        let low = &field.0[at.index * stride..][..stride];
        let high = &field.0[(at.index + 1) * stride..][..stride];
        let sin2 = (step.sin_view * step.sin_view) as f32;
        let sin_s = (1.0 - mu_s * mu_s).max(1e-12).sqrt();
        let x = step.sin_view * (source.local_level(step.turn) / sin_s).clamp(-1.0, 1.0);
        // The mean between the nodes, geometric, is the product of their roots; the way from it is a
        // short power series.
        let apart = (high[0] - low[0]) * (at.weight - 0.5);
        let m00 = low[1] * high[1] * apart.exp_near_zero();
        let c = azimuthal_part(self.degree, x as f32, sin2);
        let (mut below, mut above) = (low[2], high[2]);
        for m in 1..self.orders_at(step) {
            below += low[m + 2] * c[m];
            above += high[m + 2] * c[m];
        }
        // A cut-off series can dip below zero where little light comes from.
        (below.lerp(above, at.weight) * m00).map(|v| if v > 0.0 { v } else { 0.0 })
    }
}

/// The field as one step of a ray scatters it: for each source the logarithm of the mean radiance, its
/// square root, and what each order of azimuth adds.
#[derive(Debug, Clone)]
pub(crate) struct StepField(Vec<Lanes>);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quick_bracket_is_the_slow_one() {
        let grid = SourceGrid::new();
        assert_eq!(grid.len(), 51);
        assert!(grid.cosines.windows(2).all(|w| w[1] - w[0] > 2.0 / BINS as f64));
        for i in 0..=4000 {
            let cosine = -1.0 + f64::from(i) / 2000.0;
            let (quick, slow) = (grid.bracket(cosine), Bracket::of(&grid.cosines, cosine));
            assert_eq!(quick.index, slow.index, "{cosine}");
            assert!((quick.weight - slow.weight).abs() < 1e-5, "{cosine}");
        }
    }
}

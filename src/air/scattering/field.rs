//! The diffuse field: moments of the radiance that has been scattered, everywhere in the air.
//!
//! `M_lm(h, mu_s) = Int L(h, mu_s, w) Y_lm(w) dw`, with the local vertical as axis, azimuth from the
//! source, and `w` the direction one looks in. Moments of the *field* are kept, not of the source
//! function: densities and phase functions come in after interpolation, species by species.
//! Kept as `ln M_00` and ratios `M_lm / M_00`, linear in height and `mu_s` in between, because the
//! field falls tenfold each three degrees of twilight.

use std::ops::Range;

use super::harmonics::{azimuthal_part, coefficient_count, index};
use super::lanes::Lanes;
use super::profile::{Optics, TOP_KM};
use super::rays::{Bracket, Ray, Step};

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

/// `120 (0.04 t + 0.96 t^2.6)` km for equal steps of `t`: half of the nodes below 20 km.
pub(crate) fn altitude_grid_km(count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| {
            let t = i as f64 / (count - 1) as f64;
            TOP_KM * (0.04 * t + 0.96 * t.powf(2.6))
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
    pub fn new(degree: usize, altitudes: usize) -> Field {
        let sources = SourceGrid::new();
        let mut field = Field {
            degree,
            altitudes_km: altitude_grid_km(altitudes),
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

    /// Size of the scratch of [`Field::at_height`].
    pub fn row_len(&self) -> usize {
        self.sources.len() * self.stride()
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

    /// The field at the height of a step, for the sources of `range`: `row[source][coefficient]`.
    ///
    /// Where there is no haze, only the degrees 0 and 2.
    pub fn at_height(&self, step: &Step, range: Range<usize>, row: &mut [Lanes]) {
        let stride = self.stride();
        let at = step.altitude;
        let sources = self.sources.len();
        for source in range {
            let low = &self.moments[(at.index * sources + source) * stride..][..stride];
            let high = &self.moments[((at.index + 1) * sources + source) * stride..][..stride];
            let out = &mut row[source * stride..][..stride];
            if step.is_hazy {
                for c in 0..stride {
                    out[c] = low[c].lerp(high[c], at.weight);
                }
            } else {
                for c in [0, 3, 4, 5] {
                    out[c] = low[c].lerp(high[c], at.weight);
                }
            }
        }
    }

    /// Light of the field that a step scatters along its ray.
    ///
    /// `row` from [`Field::at_height`]; `mu_s` the local cosine of the source's zenith distance, `nu`
    /// that between ray and source.
    #[inline(always)]
    pub fn scattered(&self, step: &Step, row: &[Lanes], mu_s: f64, nu: f64) -> Lanes {
        let stride = self.stride();
        let at = self.sources.bracket(mu_s);
        let low = &row[at.index * stride..][..stride];
        let high = &row[(at.index + 1) * stride..][..stride];
        let z = step.cos_view;
        let sin2 = (1.0 - z * z).max(0.0);
        let sin = sin2.sqrt();
        let x = (nu - z * mu_s) / (1.0 - mu_s * mu_s).max(1e-12).sqrt();
        let x = x.clamp(-sin, sin) as f32;
        let m00 = low[0].lerp(high[0], at.weight).exp();
        if step.is_hazy {
            let c = azimuthal_part(self.degree, x, sin2 as f32);
            let mut sum = step.by_degree[0] * Y00;
            for l in 1..=self.degree {
                let (mut below, mut above) = (Lanes::ZERO, Lanes::ZERO);
                for (m, c) in c[..=l].iter().enumerate() {
                    let k = index(l, m);
                    let y = step.zonal[k] * c;
                    below += low[k] * y;
                    above += high[k] * y;
                }
                sum += step.by_degree[l] * below.lerp(above, at.weight);
            }
            // A cut-off series can dip below zero where little light comes from.
            (sum * m00).map(|v| v.max(0.0))
        } else {
            let c = [1.0, x, 2.0 * x * x - sin2 as f32];
            let mut part = Lanes::ZERO;
            for (m, c) in c.iter().enumerate() {
                let k = index(2, m);
                part += low[k].lerp(high[k], at.weight) * (step.zonal[k] * c);
            }
            (step.by_degree[2] * part + step.by_degree[0] * Y00) * m00
        }
    }

    /// Light of the field, reflected by the ground at the end of a ray.
    pub fn reflected(&self, optics: &Optics, ray: &Ray, cos_source: f64, nu: f64) -> Lanes {
        match ray.ground_km {
            Some(length) => {
                let mu_s = ray.cos_source_on_ground(length, cos_source, nu);
                ray.transmittance
                    * self.ground_irradiance(mu_s)
                    * (optics.ground_albedo / std::f64::consts::PI) as f32
            }
            None => Lanes::ZERO,
        }
    }
}

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

//! What a stretch of air does to light of several wavelengths, and where it sends it.

use std::f64::consts::PI;

use crate::air::scattering::lanes::LANES;
use crate::air::scattering::profile::{Optics, SCATTERERS, SPECIES, SPECIES_OF_SCATTERER};

use super::random::Random;
use super::shells::Columns;

/// A value for each wavelength; those beyond the number in use repeat the last.
pub(super) type Light = [f64; LANES];

/// Angles at which phase functions are tabulated, `pi u^2` for equal steps of `u`.
const ANGLES: usize = 2048;

/// Optical properties at up to [`LANES`] wavelengths.
#[derive(Debug, Clone)]
pub(super) struct Matter {
    /// How many wavelengths are in use.
    pub count: usize,
    extinction: [Light; SPECIES],
    /// Of each scatterer at density 1, km^-1.
    scattering: [Light; SCATTERERS],
    pub ground_albedo: f64,
    /// Phase functions, per steradian, `[angle][scatterer]`.
    phases: Vec<[Light; SCATTERERS]>,
    /// For each scatterer that there is, how its directions are drawn.
    draws: [Option<Draws>; SCATTERERS],
}

/// A phase function as steps in the cosine of the turn.
#[derive(Debug, Clone)]
struct Draws {
    /// Probability up to each angle of the table.
    up_to: Vec<f64>,
    /// Per steradian between each angle and the next.
    density: Vec<f64>,
}

/// Scattering coefficients at a point, km^-1.
pub(super) type Scatter = [Light; SCATTERERS];

impl Matter {
    pub fn new(optics: &Optics, count: usize) -> Matter {
        let scattering: [Light; SCATTERERS] = std::array::from_fn(|k| {
            let extinction = &optics.extinction[SPECIES_OF_SCATTERER[k]];
            std::array::from_fn(|i| extinction[i] * optics.albedo[k][i])
        });
        let phases: Vec<[Light; SCATTERERS]> = (0..=ANGLES)
            .map(|node| {
                let angle = PI * (node as f64 / ANGLES as f64).powi(2);
                optics.phases(angle.cos()).map(|lanes| lanes.0.map(f64::from))
            })
            .collect();
        let draws = std::array::from_fn(|k| {
            let is_there = scattering[k].iter().any(|&s| s > 0.0);
            is_there.then(|| Draws::of(|node| phases[node][k].iter().sum::<f64>()))
        });
        let ground_albedo = optics.ground_albedo;
        Matter { count, extinction: optics.extinction, scattering, ground_albedo, phases, draws }
    }

    /// Optical depth of columns at one wavelength.
    #[inline]
    pub fn depth_of(&self, lane: usize, columns: &Columns) -> f64 {
        (0..SPECIES).map(|k| self.extinction[k][lane] * columns[k]).sum()
    }

    /// Optical depths of columns.
    #[inline]
    pub fn depth(&self, columns: &Columns) -> Light {
        let mut depth = [0.0; LANES];
        for (extinction, column) in self.extinction.iter().zip(columns) {
            for (depth, extinction) in depth.iter_mut().zip(extinction) {
                *depth += extinction * column;
            }
        }
        depth
    }

    /// What columns let through.
    #[inline]
    pub fn transmittance(&self, columns: &Columns) -> Light {
        let mut light = self.depth(columns);
        light[..self.count].iter_mut().for_each(|depth| *depth = (-*depth).exp());
        light
    }

    /// Scattering coefficients where the densities are these.
    #[inline]
    pub fn scatter(&self, density: &Columns) -> Scatter {
        std::array::from_fn(|k| {
            let density = density[SPECIES_OF_SCATTERER[k]];
            self.scattering[k].map(|s| s * density)
        })
    }

    /// Scattered light per steradian and kilometre at a turn of cosine `nu`.
    #[inline]
    pub fn scattered(&self, scatter: &Scatter, nu: f64) -> Light {
        let (node, share) = place(nu);
        let (low, high) = (&self.phases[node], &self.phases[node + 1]);
        let mut light = [0.0; LANES];
        for k in (0..SCATTERERS).filter(|&k| self.draws[k].is_some()) {
            for i in 0..LANES {
                let phase = low[k][i] + (high[k][i] - low[k][i]) * share;
                light[i] += scatter[k][i] * phase;
            }
        }
        light
    }

    /// What part of the scattering each scatterer does, the mean over the wavelengths.
    pub fn shares(&self, scatter: &Scatter) -> [f64; SCATTERERS] {
        let sums = scatter.map(|light| light[..self.count].iter().sum::<f64>());
        let all: f64 = sums.iter().sum();
        sums.map(|sum| if all > 0.0 { sum / all } else { 0.0 })
    }

    /// Draws the cosine of a turn.
    pub fn draw(&self, shares: &[f64; SCATTERERS], random: &mut Random) -> f64 {
        let mut left = random.unit();
        let mut chosen = 0;
        for (k, share) in shares.iter().enumerate().filter(|&(_, share)| *share > 0.0) {
            chosen = k;
            if left < *share {
                break;
            }
            left -= share;
        }
        self.draws[chosen].as_ref().map_or(0.0, |draws| draws.draw(random.unit()))
    }

    /// Probability of a turn per steradian, as [`Matter::draw`] draws it.
    pub fn probability(&self, shares: &[f64; SCATTERERS], nu: f64) -> f64 {
        let (node, _) = place(nu);
        let of = |(share, draws): (&f64, &Option<Draws>)| {
            draws.as_ref().map_or(0.0, |draws| share * draws.density[node])
        };
        shares.iter().zip(&self.draws).map(of).sum()
    }
}

/// The angle of the table below a cosine, and how far it is to the next.
#[inline]
fn place(nu: f64) -> (usize, f64) {
    let u = (nu.clamp(-1.0, 1.0).acos() / PI).sqrt() * ANGLES as f64;
    let node = (u as usize).min(ANGLES - 1);
    (node, u - node as f64)
}

/// One minus the cosine of an angle of the table, without loss of digits.
fn versine(node: usize) -> f64 {
    2.0 * (0.5 * PI * (node as f64 / ANGLES as f64).powi(2)).sin().powi(2)
}

impl Draws {
    fn of(phase: impl Fn(usize) -> f64) -> Draws {
        let solid = |node: usize| 2.0 * PI * (versine(node + 1) - versine(node));
        let parts: Vec<f64> =
            (0..ANGLES).map(|node| 0.5 * (phase(node) + phase(node + 1)) * solid(node)).collect();
        let all: f64 = parts.iter().sum();
        let mut sum = 0.0;
        let mut up_to = vec![0.0];
        up_to.extend(parts.iter().map(|part| {
            sum += part / all;
            sum
        }));
        let density = (0..ANGLES).map(|node| parts[node] / all / solid(node)).collect();
        Draws { up_to, density }
    }

    fn draw(&self, at: f64) -> f64 {
        let node = self.up_to.partition_point(|&p| p <= at).clamp(1, ANGLES) - 1;
        let (low, high) = (self.up_to[node], self.up_to[node + 1]);
        let share = if high > low { ((at - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 };
        1.0 - (versine(node) + (versine(node + 1) - versine(node)) * share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::Atmosphere;

    #[test]
    fn turns_are_drawn_as_often_as_stated() {
        let air = Atmosphere::default();
        let matter = Matter::new(&Optics::new(&air, 1.0, &[450.0, 650.0]), 2);
        let scatter = matter.scatter(&[1.0, 0.0, 0.7, 0.0]);
        let shares = matter.shares(&scatter);
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12 && shares[2] == 0.0);
        let mut random = Random::stream(1, 1);
        let n = 200_000;
        let mut counts = [0.0; 8];
        for _ in 0..n {
            let nu = matter.draw(&shares, &mut random);
            counts[((nu + 1.0) * 4.0).min(7.0) as usize] += 1.0 / f64::from(n);
        }
        for (bin, count) in counts.iter().enumerate() {
            let steps = 2000;
            let sum: f64 = (0..steps)
                .map(|i| (bin as f64 + (f64::from(i) + 0.5) / f64::from(steps)) / 4.0 - 1.0)
                .map(|nu| matter.probability(&shares, nu) * 2.0 * PI / 4.0 / f64::from(steps))
                .sum();
            // Four standard errors of a count.
            let error = 4.0 * (sum * (1.0 - sum) / f64::from(n)).sqrt();
            assert!((count - sum).abs() < error + 1e-4, "{bin}: {count} {sum}");
            // The mean phase function itself is drawn nearly.
            let nu = (bin as f64 + 0.5) / 4.0 - 1.0;
            let exact = matter.scattered(&scatter, nu);
            let all: f64 = (0..2).map(|i| scatter.iter().map(|s| s[i]).sum::<f64>()).sum();
            let ratio = (exact[0] + exact[1]) / all / matter.probability(&shares, nu);
            assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
        }
    }
}

//! The tier that follows random paths: slow, and without the tables of the others.

use crate::air::Atmosphere;
use crate::air::monte_carlo::{Effort, Estimate, MonteCarlo};
use crate::air::scattering::SKY_NODES_NM;
use crate::cli::error::CliError;

use super::answer::{Answer, Eyes};
use super::eye_km;
use super::groups::distinct;
use super::rows::{Asked, View};

/// Airs made ready, by what they were made for.
#[derive(Default)]
pub struct Airs {
    made: Vec<(usize, f64, Vec<f64>, MonteCarlo)>,
}

impl Airs {
    fn ready(
        &mut self,
        air: &Atmosphere,
        (index, height_m): (usize, f64),
        wavelengths_nm: &[f64],
    ) -> Result<&MonteCarlo, CliError> {
        let is_same = |made: &(usize, f64, Vec<f64>, MonteCarlo)| {
            (made.0, made.1) == (index, height_m) && made.2 == wavelengths_nm
        };
        let at = match self.made.iter().position(is_same) {
            Some(at) => at,
            None => {
                let made = MonteCarlo::new(air, height_m, wavelengths_nm)
                    .map_err(|error| CliError::Usage(error.to_string()))?;
                self.made.push((index, height_m, wavelengths_nm.to_vec(), made));
                self.made.len() - 1
            }
        };
        Ok(&self.made[at].3)
    }

    /// Answers rows that share all but their wavelengths.
    pub fn answer(
        &mut self,
        air: &Atmosphere,
        rows: &[(usize, Asked)],
        effort: &Effort,
        eyes: &Eyes,
    ) -> Result<Vec<(usize, Answer)>, CliError> {
        let Some((_, first)) = rows.first() else { return Ok(Vec::new()) };
        let Asked { air: index, height_m, sun, view, .. } = *first;
        let light = |solver: &MonteCarlo| match view {
            Some(View { elevation, azimuth_from_sun }) => {
                let eye_km = eye_km(air, height_m);
                let sky = solver.radiance(eye_km, sun.sin(), elevation, azimuth_from_sun, effort);
                (sky, Vec::new())
            }
            None => solver.ground_irradiance(sun.sin(), effort),
        };
        let (nodes, direct) = light(self.ready(air, (index, height_m), &SKY_NODES_NM)?);
        let seen =
            |of: &dyn Fn(&Estimate) -> f64| eyes.see(&nodes.iter().map(of).collect::<Vec<f64>>()).y;
        let diffuse_light = seen(&Estimate::total);
        let whole = Answer {
            diffuse_light,
            direct_light: if direct.is_empty() { 0.0 } else { eyes.see(&direct).y },
            // All wavelengths share their paths: their errors go together.
            light_error: seen(&|e| e.total() + e.standard_error) - diffuse_light,
            paths: nodes.first().map_or(0, |estimate| estimate.paths),
            ..Answer::default()
        };
        let wavelengths = distinct(rows.iter().filter_map(|(_, asked)| asked.wavelength_nm));
        if wavelengths.is_empty() {
            return Ok(rows.iter().map(|(row, _)| (*row, whole)).collect());
        }
        let (lines, direct) = light(self.ready(air, (index, height_m), &wavelengths)?);
        let answer = |asked: &Asked| {
            let at = wavelengths.iter().position(|nm| Some(*nm) == asked.wavelength_nm);
            let line = at.map(|at| lines[at]);
            Answer {
                diffuse: line.map(|line| line.total()),
                direct: at.and_then(|at| direct.get(at).copied()),
                error: line.map(|line| line.standard_error),
                paths: line.map_or(whole.paths, |line| line.paths),
                ..whole
            }
        };
        Ok(rows.iter().map(|(row, asked)| (*row, answer(asked))).collect())
    }
}

//! The tiers that solve the air: `fast`, each direction by itself, and `render`, out of the very
//! tables that pictures are drawn from, looked up as pictures look them up.

use rayon::prelude::*;

use crate::air::Atmosphere;
use crate::air::scattering::{
    Quality, SKY_NODES_NM, SUMS, ScatteringError, ScatteringTables, SpectralSums,
    reconstruction_matrix,
};
use crate::cli::error::CliError;
use crate::frame::{Apparent, Dir};
use crate::light::sun;
use crate::plan::skylight::{COMPUTED_SHAPE, KeptAir};
use crate::plan::{SKY_SHAPE, SkyPlan, SourceSky};
use crate::store::Store;
use crate::units::Angle;

use super::answer::{Answer, Eyes};
use super::eye_km;
use super::groups::{distinct, grouped};
use super::look_up::LookUp;
use super::rows::{Asked, View};

/// The air of one observer.
pub struct Group<'a> {
    pub air: &'a Atmosphere,
    pub height_m: f64,
    /// With their places in the file.
    pub rows: Vec<(usize, Asked)>,
}

impl Group<'_> {
    fn wavelengths_nm(&self) -> Vec<f64> {
        distinct(self.rows.iter().filter_map(|(_, asked)| asked.wavelength_nm))
    }

    fn eye_km(&self) -> f64 {
        eye_km(self.air, self.height_m)
    }
}

fn refused(error: ScatteringError) -> CliError {
    CliError::Usage(error.to_string())
}

fn coarse(group: &Group, wavelengths_nm: &[f64]) -> Result<ScatteringTables, CliError> {
    ScatteringTables::for_observer(group.air, group.height_m, wavelengths_nm, Quality::PREVIEW)
        .map_err(refused)
}

fn place_of(nm: f64, wavelengths_nm: &[f64]) -> Option<usize> {
    wavelengths_nm.iter().position(|other| *other == nm)
}

/// Answers by coarse tables, solved for the wavelengths asked for and for the nodes of the spectrum.
pub fn fast(group: &Group, eyes: &Eyes) -> Result<Vec<(usize, Answer)>, CliError> {
    let wavelengths = group.wavelengths_nm();
    let nodes = coarse(group, &SKY_NODES_NM)?;
    let lines = if wavelengths.is_empty() { None } else { Some(coarse(group, &wavelengths)?) };
    let place = |asked: &Asked| place_of(asked.wavelength_nm?, &wavelengths);
    let eye_km = group.eye_km();
    let of_geometry = |rows: &Vec<(usize, Asked)>| -> Vec<(usize, Answer)> {
        let Some((_, Asked { sun, view, .. })) = rows.first() else { return Vec::new() };
        let cos_sun = sun.sin();
        let light = |tables: &ScatteringTables| match view {
            Some(View { elevation, azimuth_from_sun }) => {
                let mut out = vec![0.0; tables.wavelengths_nm().len()];
                tables.radiance(eye_km, cos_sun, *elevation, *azimuth_from_sun, &mut out);
                (out, None)
            }
            None => {
                let (diffuse, direct) = tables.ground_irradiance(cos_sun);
                (diffuse, Some(direct))
            }
        };
        let (diffuse, direct) = light(&nodes);
        let diffuse_light = eyes.see(&diffuse).y;
        let direct_light = direct.map_or(0.0, |direct| eyes.see(&direct).y);
        let lines = lines.as_ref().map(light);
        let answer = |asked: &Asked| {
            let at = place(asked).zip(lines.as_ref());
            Answer {
                diffuse: at.map(|(i, (diffuse, _))| diffuse[i]),
                direct: at.and_then(|(i, (_, direct))| direct.as_ref().map(|direct| direct[i])),
                diffuse_light,
                direct_light,
                ..Answer::default()
            }
        };
        rows.iter().map(|(row, asked)| (*row, answer(asked))).collect()
    };
    let geometries = grouped(&group.rows, |(_, asked)| (asked.sun, asked.view));
    Ok(geometries.par_iter().flat_map_iter(of_geometry).collect())
}

/// Answers by the tables of pictures.
pub fn render(
    group: &Group,
    eyes: &Eyes,
    look_up: &LookUp,
) -> Result<Vec<(usize, Answer)>, CliError> {
    let mut kept = KeptAir::new(Store::of_user());
    let (solved, _) = kept.of(group.air, group.height_m).map_err(refused)?;
    let tables = solved.tables();
    let rays = tables.sky_rays(group.eye_km(), COMPUTED_SHAPE);
    let of_eyes = solved.sums(&sun::irradiance_1au());
    let wavelengths = group.wavelengths_nm();
    // What is not scattered is not made of the nodes: pictures take each wavelength through the air.
    let asks_of_ground =
        group.rows.iter().any(|(_, a)| a.view.is_none() && a.wavelength_nm.is_some());
    let unscattered = asks_of_ground.then(|| coarse(group, &wavelengths)).transpose()?;
    // Four wavelengths ride where X, Y, Z and V do.
    let of_lines: Vec<(&[f64], SpectralSums)> =
        wavelengths.chunks(SUMS).map(|lines| (lines, channels(lines))).collect();
    let mut answers = Vec::with_capacity(group.rows.len());
    for rows in grouped(&group.rows, |(_, asked)| asked.sun) {
        let Some((_, Asked { sun, view, .. })) = rows.first() else { continue };
        let cos_sun = sun.sin();
        if view.is_none() {
            answers.extend(on_ground(tables, unscattered.as_ref(), cos_sun, &rows, eyes));
            continue;
        }
        let view = tables.sky_view(&rays, cos_sun);
        let plan = |sums: &SpectralSums| {
            let mut plan = SkyPlan::black(view.horizon);
            let view = view.seen_by(sums).refined(SKY_SHAPE);
            plan.sun = Some(SourceSky { azimuth: Angle::ZERO, view });
            plan
        };
        let dirs = |rows: &[(usize, Asked)]| -> Vec<Dir<Apparent>> {
            let views = rows.iter().filter_map(|(_, asked)| asked.view);
            views.map(|v| Dir::from_azimuth_altitude(v.azimuth_from_sun, v.elevation)).collect()
        };
        let first = answers.len();
        let seen = look_up.sky(&plan(&of_eyes), &dirs(&rows))?;
        answers.extend(rows.iter().zip(seen).map(|((row, _), light)| {
            (*row, Answer { diffuse_light: light.y, ..Answer::default() })
        }));
        for (lines, sums) in &of_lines {
            let channel = |asked: &Asked| place_of(asked.wavelength_nm?, lines);
            let places: Vec<(usize, usize)> = (0..rows.len())
                .filter_map(|place| Some((place, channel(&rows[place].1)?)))
                .collect();
            if places.is_empty() {
                continue;
            }
            let asked: Vec<(usize, Asked)> = places.iter().map(|(place, _)| rows[*place]).collect();
            let seen = look_up.sky(&plan(sums), &dirs(&asked))?;
            for ((place, channel), light) in places.into_iter().zip(seen) {
                let channels = [light.x, light.y, light.z, light.v];
                answers[first + place].1.diffuse = Some(channels[channel]);
            }
        }
    }
    Ok(answers)
}

/// Makes up to four wavelengths of the nodes, each a channel.
fn channels(lines: &[f64]) -> SpectralSums {
    let weights: Vec<[f64; SUMS]> = (0..lines.len())
        .map(|line| std::array::from_fn(|channel| f64::from(u8::from(channel == line))))
        .collect();
    SpectralSums::new(&reconstruction_matrix(&SKY_NODES_NM, lines), &weights)
}

/// Irradiance of the ground: by the sky, other wavelengths out of the nodes, and by the Sun itself, out
/// of the tables of what is not scattered.
fn on_ground(
    tables: &ScatteringTables,
    unscattered: Option<&ScatteringTables>,
    cos_sun: f64,
    rows: &[(usize, Asked)],
    eyes: &Eyes,
) -> Vec<(usize, Answer)> {
    let (diffuse, direct) = tables.ground_irradiance(cos_sun);
    let [diffuse_light, direct_light] = [&diffuse, &direct].map(|nodes| eyes.see(nodes).y);
    let unscattered = unscattered.map(|lines| (lines, lines.ground_irradiance(cos_sun).1));
    let answer = |asked: &Asked| {
        let from_nodes = |nm| reconstruction_matrix(&SKY_NODES_NM, &[nm]).spectrum(&diffuse);
        let diffuse = asked.wavelength_nm.and_then(|nm| from_nodes(nm).first().copied());
        let direct =
            asked.wavelength_nm.zip(unscattered.as_ref()).and_then(|(nm, (lines, light))| {
                place_of(nm, lines.wavelengths_nm()).map(|place| light[place])
            });
        Answer { diffuse, direct, diffuse_light, direct_light, ..Answer::default() }
    };
    rows.iter().map(|(row, asked)| (*row, answer(asked))).collect()
}

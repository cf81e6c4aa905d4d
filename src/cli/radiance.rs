//! `nocturne radiance`: how bright the sky is, for each row of a file.
//!
//! Three tiers answer the same rows: coarse tables, the tables and shaders of pictures, and random
//! paths that share nothing with either but the air. With a scene, the rows are directions in its sky.

mod answer;
mod groups;
mod look_up;
mod paths;
mod rows;
mod tables;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::air::Atmosphere;
use crate::air::monte_carlo::Effort;
use crate::catalog::Catalogs;
use crate::export::OutputFile;
use crate::export::table::{Cell, Column, Format, Kind, Sheet as Table, TableWriter};
use crate::frame::Dir;
use crate::plan::lay::{Kept, lay_in};
use crate::scene::Layers;
use crate::store::Store;

use super::ephemeris::Source;
use super::error::CliError;
use super::progress::Progress;
use super::{atmosphere, render, stage};

use answer::{Answer, Eyes, cell, columns, figures};
use groups::grouped;
use look_up::LookUp;
use paths::Airs;
use rows::{Asked, SCENE_KEYS, SKY_KEYS, Sheet, SkyRows, directions};
use tables::Group;

/// An eye is at least this far above the ground, kilometres: that of the reference.
const LEAST_EYE_KM: f64 = 0.001;

#[derive(Debug, Args)]
#[command(after_help = "\
Rows about the sky have the columns case, wavelength_nm, sun_elevation_deg, view_elevation_deg, \
rel_azimuth_deg and, if you like, observer_height_m, in any order. The Sun's elevation is the true \
one, that of the view the apparent one; azimuth counts from the Sun. A case that begins with A or B is \
the reference air: molecules and ozone, or haze too, straight rays, parallel light, an observer 1 m \
above the sea. Without view_elevation_deg and rel_azimuth_deg rows ask for the irradiance of level \
ground; without wavelength_nm for luminance alone.

With --scene the columns are altitude_deg and azimuth_deg, and the answers X, Y, Z and V in cd/m2.")]
pub struct RadianceArgs {
    /// CSV file of what is asked; - for standard input
    #[arg(long, value_name = "FILE")]
    rows: PathBuf,
    /// CSV file to write; - or nothing for standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The air of every row, whatever its case: a name that `nocturne atmosphere` lists, or a file
    #[arg(long, value_name = "NAME|FILE")]
    atmosphere: Option<String>,
    /// How the light is found [default: render]
    #[arg(long, value_enum)]
    tier: Option<Tier>,
    /// Directions in the sky of a scene, as `nocturne render --scene` draws it, without stars and
    /// discs
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Standard error at which the reference tier stops, such as 1% [default: 1%]
    #[arg(long, value_name = "PERCENT", value_parser = parse_percent)]
    error: Option<f64>,
    /// Paths after which the reference tier stops [default: 10000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    paths: Option<u64>,
    /// Other numbers draw other paths in the reference tier [default: 1]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Tier {
    /// Coarse tables
    Fast,
    /// The tables and shaders that draw pictures
    Render,
    /// Random paths, with their standard error: straight rays and parallel light, whatever the air
    Reference,
}

/// From per cent to a share.
fn parse_percent(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('%').trim_end().parse::<f64>();
    match number {
        Ok(percent) if (0.001..=100.0).contains(&percent) => Ok(percent / 100.0),
        _ => Err("give per cent from 0.001 to 100, such as 1%".to_owned()),
    }
}

/// Height above sea level of the eye of an observer, kilometres.
fn eye_km(air: &Atmosphere, height_m: f64) -> f64 {
    (height_m / 1000.0).max(air.ground_km(height_m) + LEAST_EYE_KM)
}

pub fn run(args: &RadianceArgs, catalogs: &Catalogs, out: &mut impl Write) -> Result<(), CliError> {
    let tier = args.tier.unwrap_or(Tier::Render);
    let by_chance = [
        ("--error", args.error.is_some()),
        ("--paths", args.paths.is_some()),
        ("--seed", args.seed.is_some()),
    ];
    if let Some((option, _)) = by_chance.iter().find(|(_, given)| *given && tier != Tier::Reference)
    {
        let message = format!("{option} is for random paths; give --tier reference with it");
        return Err(CliError::Usage(message));
    }
    if args.scene.is_some() && tier != Tier::Render {
        let message = "--scene is answered as it is drawn; leave --tier out";
        return Err(CliError::Usage(message.to_owned()));
    }
    let air = args.atmosphere.as_deref().map(atmosphere::find).transpose()?;
    let source = Source::open(&args.rows)?;
    let output = args.output.as_deref().filter(|path| *path != Path::new("-"));
    match &args.scene {
        Some(scene) => {
            let sheet = Sheet::read(source, &SCENE_KEYS, &[0, 1])?;
            let output = output.map(OutputFile::create).transpose()?;
            let answers = of_scene(args, scene, air, &sheet, catalogs)?;
            write(&sheet, &SCENE_KEYS, scene_columns(), &answers, output, out)
        }
        None => {
            let rows = SkyRows::read(source, air)?;
            let output = output.map(OutputFile::create).transpose()?;
            let answers = of_skies(args, tier, &rows)?;
            let by_chance = tier == Tier::Reference;
            let figures = figures(rows.has_views(), rows.has_wavelengths(), by_chance);
            let numbers = |answer: &Answer| figures.iter().map(|(_, of)| of(answer)).collect();
            let answers: Vec<Vec<Option<f64>>> = answers.iter().map(numbers).collect();
            let columns = columns(&figures).collect();
            write(&rows.sheet, &SKY_KEYS, columns, &answers, output, out)
        }
    }
}

/// The answers to rows about skies, in their order.
fn of_skies(args: &RadianceArgs, tier: Tier, rows: &SkyRows) -> Result<Vec<Answer>, CliError> {
    let eyes = Eyes::new();
    let asked: Vec<(usize, Asked)> = rows.asked.iter().copied().enumerate().collect();
    let look_up = match tier == Tier::Render && rows.has_views() {
        true => looking_up(args.quiet),
        false => LookUp::default(),
    };
    let is_bent = |air: &Atmosphere| air.paths.refracted || air.paths.source_disc;
    if tier == Tier::Reference && !args.quiet && rows.airs.iter().any(is_bent) {
        eprintln!(
            "nocturne: the reference tier follows straight rays and parallel light; refraction and the \
             disc of the Sun, which this air asks for, are left out"
        );
    }
    let progress = Progress::counting(args.quiet, asked.len() as u64, "rows");
    let mut answers = vec![Answer::default(); asked.len()];
    let mut put = |found: Vec<(usize, Answer)>| {
        progress.advance(found.len() as u64);
        found.into_iter().for_each(|(row, answer)| answers[row] = answer);
    };
    if tier == Tier::Reference {
        let effort = Effort::default();
        let effort = Effort {
            relative_error: args.error.unwrap_or(effort.relative_error),
            most_paths: args.paths.unwrap_or(effort.most_paths),
            seed: args.seed.unwrap_or(effort.seed),
        };
        let mut airs = Airs::default();
        let geometry = |(_, a): &(usize, Asked)| (a.air, a.height_m, a.sun, a.view);
        for group in grouped(&asked, geometry) {
            let air = &rows.airs[group[0].1.air];
            put(airs.answer(air, &group, &effort, &eyes)?);
        }
    } else {
        for group in grouped(&asked, |(_, asked)| (asked.air, asked.height_m)) {
            let Asked { air, height_m, .. } = group[0].1;
            let group = Group { air: &rows.airs[air], height_m, rows: group };
            put(match tier {
                Tier::Fast => tables::fast(&group, &eyes)?,
                _ => tables::render(&group, &eyes, &look_up)?,
            });
        }
    }
    progress.finish();
    Ok(answers)
}

/// The look-up of pictures; says if it is not theirs but its twin.
fn looking_up(quiet: bool) -> LookUp {
    let (look_up, why_not) = LookUp::new();
    if let Some(why_not) = why_not.filter(|_| !quiet) {
        eprintln!("nocturne: tables are looked up on the processor: {why_not}");
    }
    look_up
}

/// X, Y, Z and V of the directions in a scene.
fn of_scene(
    args: &RadianceArgs,
    path: &Path,
    air: Option<Atmosphere>,
    sheet: &Sheet,
    catalogs: &Catalogs,
) -> Result<Vec<Vec<Option<f64>>>, CliError> {
    let directions = directions(sheet)?;
    let mut scene = render::read_scene(path)?;
    scene.air = air.unwrap_or(scene.air);
    let setting = scene.setting()?;
    let night = stage::night_of(&scene, &setting, catalogs)?;
    let layers = Layers { sun: false, moon: false, planets: false, stars: false, ..scene.layers };
    let mut kept = Kept::new(Store::of_user());
    let (plan, _) = lay_in(&setting, &layers, &night, catalogs, &mut kept)?;
    let dirs: Vec<_> = directions
        .into_iter()
        .map(|[altitude, azimuth]| Dir::from_azimuth_altitude(azimuth, altitude))
        .collect();
    let mut lights = looking_up(args.quiet).sky(&plan.sky, &dirs)?;
    if let Some(milky_way) = &plan.milky_way {
        lights.iter_mut().zip(&dirs).for_each(|(light, dir)| *light += milky_way.luminance(*dir));
    }
    Ok(lights.iter().map(|light| [light.x, light.y, light.z, light.v].map(Some).to_vec()).collect())
}

fn scene_columns() -> Vec<Column> {
    let names = ["X_cd_m2", "Y_cd_m2", "Z_cd_m2", "V_cd_m2"];
    names.map(|name| Column { name, kind: Kind::Exact }).to_vec()
}

/// Writes what was asked and what was found, whole or not at all.
fn write(
    asked: &Sheet,
    keys: &[&'static str],
    results: Vec<Column>,
    answers: &[Vec<Option<f64>>],
    output: Option<OutputFile>,
    out: &mut impl Write,
) -> Result<(), CliError> {
    let keys = asked.columns.iter().map(|key| Column { name: keys[*key], kind: Kind::Text(12) });
    let table = Table { columns: keys.chain(results).collect(), format: Format::Csv };
    let mut part = table.part();
    for ((_, written), numbers) in asked.rows.iter().zip(answers) {
        let written = written.iter().map(|text| Cell::Text(text));
        let cells: Vec<Cell> = written.chain(numbers.iter().map(|n| cell(*n))).collect();
        table.add(&mut part, &cells);
    }
    let fill = |out: &mut dyn Write| {
        let mut writer = TableWriter::begin(&table, out)?;
        writer.put(&[part])?;
        writer.end()
    };
    match output {
        Some(file) => file.write(|out| fill(out))?,
        None => fill(out)?,
    }
    Ok(())
}

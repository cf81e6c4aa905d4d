//! `nocturne almanac`: what happens in the sky, and when.

mod csv;
mod ics;
mod json;
mod sheet;
mod table;

use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use crate::almanac::limits::sea_horizon;
use crate::almanac::{Almanac, AlmanacError, Class, ECLIPTIC_STARS_HR, Limits, Request, Target};
use crate::catalog::{Catalogs, Star};
use crate::ephemeris::{Body, Ephemeris};
use crate::export::OutputFile;
use crate::place::Place;
use crate::time::{self, Instant};
use crate::units::{Angle, DAY_S};

use super::WhereArgs;
use super::error::CliError;
use super::stage;
use sheet::{Heading, Sheet};

/// What is listed where no end is given.
const DEFAULT_DAYS: f64 = 30.0;

#[derive(Debug, Args)]
pub struct AlmanacArgs {
    #[command(flatten)]
    location: WhereArgs,
    /// Beginning: a date and time; without an offset, the time of clocks at the place
    #[arg(long, default_value = "now", value_name = "TIME", allow_hyphen_values = true)]
    from: String,
    /// End, which does not belong to the time listed; 30 days after the beginning if it is not given
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    to: Option<String>,
    /// Kinds of events, with commas between: rise, set, transit, lower-transit, twilight, phases,
    /// seasons, apsides, conjunctions, longitude-conjunctions, oppositions, elongations, appulses,
    /// eclipses, dark; or all. Without it, all but lower transits and conjunctions in longitude
    #[arg(long, value_name = "LIST")]
    events: Option<String>,
    /// Sun, Moon, planets and stars by name, with commas between, that rise, set, pass the meridian
    /// and meet; the Sun, the Moon and all planets if it is not given
    #[arg(long, value_name = "LIST")]
    bodies: Option<String>,
    /// Apparent altitude of the horizon all around, degrees above the level
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, conflicts_with = "dip")]
    horizon: Option<f64>,
    /// The horizon is that of a sea below, as seen from the height of the place
    #[arg(long)]
    dip: bool,
    /// It is dark while the centre of the Sun is lower than this, degrees
    #[arg(long, value_name = "DEG", default_value_t = -18.0, allow_hyphen_values = true)]
    dark_below: f64,
    /// Nearest approaches closer than this, degrees
    #[arg(long, value_name = "DEG", default_value_t = 5.0, allow_hyphen_values = true)]
    within: f64,
    /// How to write it: `table` to be read, `csv`, `json` (one object with an array of events), or
    /// `ics` for calendars (RFC 5545)
    #[arg(long, value_enum, default_value = "table")]
    format: Format,
    /// File to write, instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Say nothing of the progress
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Table,
    Csv,
    Json,
    Ics,
}

pub fn run(args: &AlmanacArgs, catalogs: &Catalogs, out: &mut impl Write) -> Result<(), CliError> {
    let place = args.location.find(catalogs)?;
    let (from, to) = args.times(place.as_ref())?;
    let request = args.request(place.as_ref(), catalogs)?;
    let ephemeris = Ephemeris::load(catalogs, request.tolerance)?;
    let almanac = Almanac::new(&ephemeris, place.as_ref(), request).map_err(name_option)?;
    let heading = Heading::of(&almanac, place, from, to)?;
    let sheet: Box<dyn Sheet> = match args.format {
        Format::Table => Box::new(table::Table),
        Format::Csv => Box::new(csv::Csv),
        Format::Json => Box::new(json::Json::default()),
        Format::Ics => Box::new(ics::Ics::new(&heading, now()?)?),
    };
    let Some(path) = &args.output else {
        let is_quiet = args.quiet || io::stdout().is_terminal();
        return Ok(write(&almanac, &heading, sheet, &bar(is_quiet), out)?);
    };
    let file = OutputFile::create(path)?;
    let mut unfinished = None;
    let written = file.write(|file| {
        write(&almanac, &heading, sheet, &bar(args.quiet), file).map_err(|stop| match stop {
            Stop::Writing(error) => error,
            Stop::Almanac(error) => {
                unfinished = Some(error);
                io::Error::other("the almanac is not complete")
            }
        })
    });
    unfinished.map_or_else(|| written.map_err(CliError::from), |error| Err(name_option(error)))
}

/// Why an almanac was not written to its end.
enum Stop {
    Almanac(AlmanacError),
    Writing(io::Error),
}

impl From<AlmanacError> for Stop {
    fn from(error: AlmanacError) -> Stop {
        Stop::Almanac(error)
    }
}

impl From<io::Error> for Stop {
    fn from(error: io::Error) -> Stop {
        Stop::Writing(error)
    }
}

/// To standard output.
impl From<Stop> for CliError {
    fn from(stop: Stop) -> CliError {
        match stop {
            Stop::Almanac(error) => name_option(error),
            Stop::Writing(error) => error.into(),
        }
    }
}

/// Writes events as they are found.
fn write(
    almanac: &Almanac,
    heading: &Heading,
    mut sheet: Box<dyn Sheet>,
    bar: &ProgressBar,
    out: &mut dyn Write,
) -> Result<(), Stop> {
    let mut events = almanac.events(&heading.from, &heading.to)?;
    sheet.begin(heading, out)?;
    while let Some(event) = events.next() {
        sheet.event(heading, &event?, out)?;
        bar.set_position((events.progress() * 1000.0) as u64);
    }
    bar.finish_and_clear();
    Ok(sheet.end(heading, out)?)
}

/// A line on standard error that says how far the work is, if somebody looks at it.
fn bar(is_quiet: bool) -> ProgressBar {
    let bar = if is_quiet { ProgressBar::hidden() } else { ProgressBar::new(1000) };
    let style = ProgressStyle::with_template("{bar:30} {percent} % {elapsed}, {eta} to go");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}

fn now() -> Result<Instant, CliError> {
    Ok(time::to_instant(&time::parse("now")?, None)?)
}

/// What the library says, with the option that mends it.
fn name_option(error: AlmanacError) -> CliError {
    let option = match &error {
        AlmanacError::NoPlace { .. } => "--place NAME, or --lat and --lon; --events phases,seasons",
        AlmanacError::Order { .. } => "--to",
        AlmanacError::Skyline { .. } => "--horizon",
        AlmanacError::DarkLimit { .. } => "--dark-below",
        _ => return error.into(),
    };
    CliError::Usage(format!("{error} ({option})"))
}

impl AlmanacArgs {
    fn times(&self, place: Option<&Place>) -> Result<(Instant, Instant), CliError> {
        let instant = |text: &str| match place {
            Some(place) => stage::instant(text, place),
            None => Ok(time::to_instant(&time::parse(text)?, None)?),
        };
        let from = instant(&self.from)?;
        let to = match &self.to {
            Some(to) => instant(to)?,
            None => from.plus_seconds(DEFAULT_DAYS * DAY_S)?,
        };
        Ok((from, to))
    }

    fn request(&self, place: Option<&Place>, catalogs: &Catalogs) -> Result<Request, CliError> {
        if !(0.0..=180.0).contains(&self.within) {
            let within = self.within;
            return Err(CliError::Usage(format!(
                "--within {within}: two directions are 0 to 180 degrees apart"
            )));
        }
        let skyline = match (self.horizon, place) {
            (Some(deg), _) => Angle::from_deg(deg),
            (None, Some(place)) if self.dip => sea_horizon(place.height_m),
            _ => Angle::ZERO,
        };
        let dark_sun_altitude = Angle::from_deg(self.dark_below);
        let mut request = Request {
            limits: Limits { skyline, dark_sun_altitude },
            nearer_than: Angle::from_deg(self.within),
            ..Request::default()
        };
        match self.events.as_deref().map(str::trim) {
            Some(all) if all.eq_ignore_ascii_case("all") => request.classes = Class::ALL.to_vec(),
            Some(list) => {
                request.classes = list
                    .split(',')
                    .map(|name| name.parse())
                    .collect::<Result<_, _>>()
                    .map_err(|error| CliError::Usage(format!("--events: {error}")))?;
            }
            None => {}
        }
        let stars = catalogs.stars()?;
        let target = |star: &Star| Target::Star(Arc::new(star.clone()));
        if let Some(list) = &self.bodies {
            request.bodies.clear();
            for name in list.split(',').map(str::trim) {
                match name.parse::<Body>() {
                    Ok(body) => request.bodies.push(body),
                    Err(_) => request.stars.push(target(star(&stars, name)?)),
                }
            }
            request.met_stars = request.stars.clone();
        } else {
            let is_met = |star: &&Star| ECLIPTIC_STARS_HR.contains(&star.hr);
            request.met_stars = stars.iter().filter(is_met).map(target).collect();
        }
        Ok(request)
    }
}

/// A star by its name, its designation or its number, `HR 2491`.
fn star<'a>(stars: &'a [Star], called: &str) -> Result<&'a Star, CliError> {
    let is = |name: &Option<String>| {
        name.as_ref().is_some_and(|name| name.to_lowercase() == called.to_lowercase())
    };
    let number = format!("hr{}", called.to_lowercase().trim_start_matches("hr").trim());
    stars
        .iter()
        .find(|star| is(&star.name) || is(&star.designation) || format!("hr{}", star.hr) == number)
        .ok_or_else(|| {
            CliError::Usage(format!(
                "--bodies: nothing called '{called}'; `nocturne objects` lists what is known"
            ))
        })
}

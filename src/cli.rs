//! The command line: words become a checked scene, and a scene becomes files and a report.
//!
//! Exit codes: 0 when everything asked for was done, 2 when what was asked for makes no sense,
//! 1 when it does but could not be done. Every error is one sentence on standard error. Results
//! go to standard output, progress to standard error.

mod almanac;
mod atmosphere;
mod brightness;
pub mod display;
mod draw;
mod ephemeris;
mod error;
pub mod eye;
mod look;
mod night_glow;
mod objects;
pub mod photo;
mod place;
mod progress;
mod radiance;
mod render;
mod stage;
mod stats;
mod summary;
#[cfg(feature = "app")]
mod window;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Args, Parser, Subcommand};

use crate::catalog::Catalogs;
use crate::place::Place;
use crate::place::gazetteer::Gazetteer;

use error::CliError;

/// The night sky as it would really look: where everything is, and how bright.
#[derive(Debug, Parser)]
#[command(name = "nocturne", version, about, arg_required_else_help = cfg!(not(feature = "app")))]
#[command(args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[cfg(feature = "app")]
    #[command(flatten)]
    window: window::WindowArgs,
    /// Folder of the catalogues, if it is not where the program looks by itself
    #[arg(long, global = true, value_name = "DIR")]
    catalogs: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Draw the sky of an instant and a place
    Render(Box<render::RenderArgs>),
    /// List places that are known, with coordinates and time zone
    Place(place::PlaceArgs),
    /// List the Sun, the Moon, planets and stars: where they stand and how bright they are
    Objects(objects::ObjectsArgs),
    /// List what happens in the sky: rise and set, twilight, phases, meetings, dark nights
    Almanac(almanac::AlmanacArgs),
    /// Write tables of where bodies and stars are seen, of any length
    Ephemeris(ephemeris::EphemerisArgs),
    /// List airs that are known by name, or print the file of one, to copy and change
    Atmosphere(atmosphere::AtmosphereArgs),
    /// Say how bright the sky is, for rows of a file: radiance, luminance, irradiance of the ground
    Radiance(radiance::RadianceArgs),
    /// Measure the sky: how bright it is in a direction, and what makes it so
    Brightness(brightness::BrightnessArgs),
    /// Say which graphics adapter draws the pictures
    #[cfg(feature = "gpu")]
    Adapter,
}

/// Where the observer stands.
#[derive(Debug, Clone, Args)]
struct WhereArgs {
    /// A city, such as Flagstaff or "Paris, France"
    #[arg(long, value_name = "NAME", conflicts_with_all = ["lat", "lon"])]
    place: Option<String>,
    /// Latitude in degrees, north positive
    #[arg(long, value_name = "DEG", requires = "lon", allow_hyphen_values = true)]
    lat: Option<f64>,
    /// Longitude in degrees, east positive
    #[arg(long, value_name = "DEG", requires = "lat", allow_hyphen_values = true)]
    lon: Option<f64>,
    /// Height above sea level in metres
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    height: Option<f64>,
}

impl WhereArgs {
    /// The place asked for, if any was.
    fn find(&self, catalogs: &Catalogs) -> Result<Option<Place>, CliError> {
        let mut place = match (&self.place, self.lat, self.lon) {
            (Some(name), _, _) if name.trim().is_empty() => {
                return Err(CliError::Usage(
                    "--place names nothing; give a city such as Flagstaff, or --lat and --lon"
                        .to_owned(),
                ));
            }
            (Some(name), _, _) => Gazetteer::parse(&catalogs.places_text()?)?.find(name)?,
            (None, Some(lat), Some(lon)) => Place::new(lat, lon, 0.0)?,
            _ => return Ok(None),
        };
        if let Some(height_m) = self.height {
            // Checked by making the place anew; its name and clocks stay.
            let Place { latitude, longitude, .. } = place;
            place.height_m = Place::new(latitude.deg(), longitude.deg(), height_m)?.height_m;
        }
        Ok(Some(place))
    }
}

/// Runs the program: the arguments of the process in, its exit code out.
pub fn run() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if is_help(&error) => {
            let code = u8::try_from(error.exit_code()).unwrap_or(2);
            return error.print().map_or_else(|error| fail(&error.into()), |()| code.into());
        }
        Err(error) => return fail(&error.into()),
    };
    let mut out = io::stdout().lock();
    let result = dispatch(&cli, &mut out).and_then(|()| out.flush().map_err(CliError::from));
    result.map_or_else(|error| fail(&error), |()| ExitCode::SUCCESS)
}

/// Help, also where no command was given, and the version: more than a sentence.
fn is_help(error: &clap::Error) -> bool {
    let is_short_of_a_command = ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    !error.use_stderr() || error.kind() == is_short_of_a_command
}

/// Says what went wrong.
fn fail(error: &CliError) -> ExitCode {
    if let Some(message) = error.message() {
        // Where nobody can be told, the exit code still tells.
        let _ = writeln!(io::stderr(), "nocturne: {message}");
    }
    error.exit_code()
}

fn dispatch(cli: &Cli, out: &mut impl Write) -> Result<(), CliError> {
    let Some(command) = &cli.command else {
        #[cfg(feature = "app")]
        return window::run(&cli.window, cli.catalogs.as_deref());
        #[cfg(not(feature = "app"))]
        return Ok(());
    };
    #[cfg(feature = "gpu")]
    if let Command::Adapter = command {
        writeln!(out, "{}", crate::render::Renderer::new()?.adapter())?;
        return Ok(());
    }
    if let Command::Atmosphere(args) = command {
        return atmosphere::run(args, out);
    }
    let catalogs = Catalogs::locate(cli.catalogs.as_deref())?;
    match command {
        Command::Render(args) => render::run(args, &catalogs, out),
        Command::Place(args) => place::run(args, &catalogs, out),
        Command::Objects(args) => objects::run(args, &catalogs, out),
        Command::Almanac(args) => almanac::run(args, &catalogs, out),
        Command::Ephemeris(args) => ephemeris::run(args, &catalogs, out),
        Command::Radiance(args) => radiance::run(args, &catalogs, out),
        Command::Brightness(args) => brightness::run(args, &catalogs, out),
        // Done above: no catalogue is needed.
        Command::Atmosphere(_) => Ok(()),
        #[cfg(feature = "gpu")]
        Command::Adapter => Ok(()),
    }
}

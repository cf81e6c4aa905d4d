//! `nocturne objects`: what is known, and with a place, where it stands and how bright it is.

use std::io::Write;

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::air::Atmosphere;
use crate::catalog::{Catalogs, MoonFeature};
use crate::ephemeris::Body;
use crate::frame::{Apparent, Dir, Horizon};
use crate::light::earth_shadow::Danjon;
use crate::light::night::{Kind, LitObject, Night};
use crate::place::Place;
use crate::units::{Angle, Magnitude};

use super::WhereArgs;
use super::error::CliError;
use super::look::wind;
use super::stage;

/// The best that the present theories give.
const TOLERANCE: Angle = Angle::from_arcsec(1.0);

#[derive(Debug, Args)]
pub struct ObjectsArgs {
    /// Part of a name, a designation or a catalogue number
    #[arg(default_value = "")]
    query: String,
    /// Only objects of this kind
    #[arg(long, value_enum)]
    kind: Option<KindArg>,
    /// Only objects above the horizon, which from a height lies a little below the level
    #[arg(long)]
    up: bool,
    /// Only objects at least this bright
    #[arg(long, value_name = "V", allow_hyphen_values = true)]
    magnitude_limit: Option<f64>,
    /// Write one JSON array, with spectral types, variables and companions of stars
    #[arg(long)]
    json: bool,
    /// Instant: a date and time, `now` or `tonight`
    #[arg(long, default_value = "now", value_name = "TIME", allow_hyphen_values = true)]
    at: String,
    #[command(flatten)]
    location: WhereArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum KindArg {
    Sun,
    Moon,
    Planet,
    Satellite,
    Star,
    /// Places on the Moon; name one
    MoonFeature,
}

impl KindArg {
    fn is(self, object: &LitObject) -> bool {
        let kind = match object.kind {
            Kind::Body(Body::Sun) => KindArg::Sun,
            Kind::Body(Body::Moon) => KindArg::Moon,
            Kind::Body(_) => KindArg::Planet,
            Kind::Satellite(_) => KindArg::Satellite,
            Kind::Star(_) => KindArg::Star,
        };
        self == kind
    }
}

pub fn run(args: &ObjectsArgs, catalogs: &Catalogs, out: &mut impl Write) -> Result<(), CliError> {
    if args.magnitude_limit.is_some_and(f64::is_nan) {
        return Err(CliError::Usage("--magnitude-limit is no number; give a magnitude".to_owned()));
    }
    let found = args.location.find(catalogs)?;
    let is_somewhere = found.is_some();
    if args.up && !is_somewhere {
        let message = "--up asks for a horizon: give --place NAME, or --lat and --lon";
        return Err(CliError::Usage(message.to_owned()));
    }
    // Magnitudes are those of now wherever one stands.
    let place = found.map_or_else(|| Place::new(0.0, 0.0, 0.0), Ok)?;
    let instant = stage::instant(&args.at, &place)?;
    let night = stage::night(
        &instant,
        &place,
        TOLERANCE,
        &Atmosphere::clear_over(place.height_m),
        Danjon::default(),
        catalogs,
    )?;
    let query = args.query.to_lowercase();
    let features: Vec<&MoonFeature> = match query.is_empty() {
        true => Vec::new(),
        false => {
            let is_named = |feature: &&MoonFeature| feature.name.to_lowercase().contains(&query);
            night.moon_features.iter().filter(is_named).collect()
        }
    };
    let found = called(&query, &night);
    if features.is_empty() && found.is_empty() {
        return Err(CliError::Usage(format!(
            "nothing called '{}'; `nocturne objects` without a name lists all",
            args.query
        )));
    }
    if args.json {
        return write_json(args, &night, found, is_somewhere, out);
    }
    write!(out, "{:<26} {:<8} {:<8} {:>6} {:>6}", "name", "number", "known as", "V", "B-V")?;
    match is_somewhere {
        true => writeln!(out, " {:>9} {:>9} {:>9} wind", "azimuth", "altitude", "seen at")?,
        false => writeln!(out)?,
    }
    for called in found {
        let Some(object) = wanted(args, &night, called) else { continue };
        let object = &object;
        let b_v = match object.kind {
            Kind::Star(index) => format!("{:.2}", night.stars[index].b_v),
            Kind::Body(_) | Kind::Satellite(_) => String::new(),
        };
        let (name, number) = (night.label(object), number(object, &night));
        let (known_as, v) = (designation(object, &night), object.magnitude.0);
        write!(out, "{name:<26} {number:<8} {known_as:<8} {v:>6.2} {b_v:>6}")?;
        if is_somewhere {
            write_where(out, object.dir, object.apparent)?;
        }
        writeln!(out)?;
    }
    if args.kind.is_some_and(|kind| kind != KindArg::MoonFeature) || args.magnitude_limit.is_some()
    {
        return Ok(());
    }
    for feature in features {
        let (point, apparent) = night.on_moon(feature);
        if args.up && apparent.altitude() < night.horizon {
            continue;
        }
        let (longitude_deg, latitude_deg) = (feature.longitude.deg(), feature.latitude.deg());
        let on_moon = format!(
            "{:.1}{} {:.1}{}",
            longitude_deg.abs(),
            if longitude_deg < 0.0 { 'W' } else { 'E' },
            latitude_deg.abs(),
            if latitude_deg < 0.0 { 'S' } else { 'N' }
        );
        write!(out, "{:<26} {:<17} {:>13}", feature.name, on_moon, feature.kind)?;
        if is_somewhere {
            write_where(out, point.dir, apparent)?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// The object, if it is of the kind that is asked for, bright enough and up. A star is lit only if its
/// magnitude and its kind are.
fn wanted(args: &ObjectsArgs, night: &Night, called: Called) -> Option<LitObject> {
    let is_bright =
        |magnitude: Magnitude| args.magnitude_limit.is_none_or(|limit| magnitude.0 <= limit);
    let object = match called {
        Called::Near(object) => object.clone(),
        Called::Star(index) => {
            let is_kind = args.kind.is_none_or(|kind| kind == KindArg::Star);
            if !is_kind || !is_bright(night.stars[index].magnitude) {
                return None;
            }
            night.star(index)
        }
    };
    let is_wanted = args.kind.is_none_or(|kind| kind.is(&object))
        && is_bright(object.magnitude)
        && (!args.up || object.apparent.altitude() >= night.horizon);
    is_wanted.then_some(object)
}

/// An object as a catalogue has it, and where it stands. The keys are added to, never renamed.
#[derive(Debug, Serialize)]
struct ListedObject {
    name: String,
    catalogue: Option<String>,
    known_as: Option<String>,
    magnitude_v: f64,
    /// Of a star, as what follows.
    #[serde(skip_serializing_if = "Option::is_none")]
    b_v: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spectral_type: Option<String>,
    /// What it is called as a variable star.
    #[serde(skip_serializing_if = "Option::is_none")]
    variable: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    companion_separation_arcsec: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    companion_magnitude_difference: Option<f64>,
    /// If a place was given, as what follows.
    #[serde(skip_serializing_if = "Option::is_none")]
    azimuth_deg: Option<f64>,
    /// Without air.
    #[serde(skip_serializing_if = "Option::is_none")]
    altitude_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    apparent_altitude_deg: Option<f64>,
}

fn write_json(
    args: &ObjectsArgs,
    night: &Night,
    found: Vec<Called>,
    is_somewhere: bool,
    out: &mut impl Write,
) -> Result<(), CliError> {
    let listed: Vec<ListedObject> = found
        .into_iter()
        .filter_map(|called| wanted(args, night, called))
        .map(|object| {
            let star = match object.kind {
                Kind::Star(index) => Some(&night.stars[index]),
                Kind::Body(_) | Kind::Satellite(_) => None,
            };
            let companion = star.and_then(|star| star.companion);
            let here = |angle: Angle| is_somewhere.then(|| angle.deg());
            ListedObject {
                name: night.label(&object),
                catalogue: star.map(|star| format!("HR {}", star.hr)),
                known_as: star.and_then(|star| star.designation.clone()),
                magnitude_v: object.magnitude.0,
                b_v: star.map(|star| star.b_v),
                spectral_type: star.map(|star| star.spectral_type.clone()),
                variable: star.and_then(|star| star.variable.clone()),
                companion_separation_arcsec: companion.map(|c| c.separation_arcsec),
                companion_magnitude_difference: companion.and_then(|c| c.magnitude_difference),
                azimuth_deg: here(object.dir.azimuth()),
                altitude_deg: here(object.dir.altitude()),
                apparent_altitude_deg: here(object.apparent.altitude()),
            }
        })
        .collect();
    serde_json::to_writer_pretty(&mut *out, &listed).map_err(std::io::Error::from)?;
    writeln!(out)?;
    Ok(())
}

/// What goes by a part of a name.
enum Called<'n> {
    Near(&'n LitObject),
    /// Not lit yet.
    Star(usize),
}

/// Everything whose name, number or designation has the query in it; the stars are not lit for it.
fn called<'n>(query: &str, night: &'n Night) -> Vec<Called<'n>> {
    let matches = |name: &str| name.to_lowercase().contains(query);
    let near = night.objects.iter().filter(|object| matches(&night.label(object)));
    let stars = night.stars.iter().enumerate().filter(|(_, star)| {
        star.name.iter().chain(&star.designation).any(|name| matches(name))
            || matches(&format!("HR {}", star.hr))
    });
    near.map(Called::Near).chain(stars.map(|(index, _)| Called::Star(index))).collect()
}

fn number(object: &LitObject, night: &Night) -> String {
    match object.kind {
        Kind::Star(index) => format!("HR {}", night.stars[index].hr),
        Kind::Body(_) | Kind::Satellite(_) => String::new(),
    }
}

fn designation(object: &LitObject, night: &Night) -> String {
    match object.kind {
        Kind::Star(index) => night.stars[index].designation.clone().unwrap_or_default(),
        Kind::Body(_) | Kind::Satellite(_) => String::new(),
    }
}

/// Azimuth and altitude without air, the altitude at which it is seen, and the wind, in columns.
fn write_where(
    out: &mut impl Write,
    dir: Dir<Horizon>,
    apparent: Dir<Apparent>,
) -> std::io::Result<()> {
    let azimuth = dir.azimuth();
    write!(
        out,
        " {:>9.4} {:>+9.4} {:>+9.4} {}",
        azimuth.deg(),
        dir.altitude().deg(),
        apparent.altitude().deg(),
        wind(azimuth)
    )
}

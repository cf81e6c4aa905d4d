//! `nocturne brightness`: how bright the sky is, and what makes it so.

mod map;

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::{Map, Value, json};

use crate::air::Atmosphere;
use crate::catalog::Catalogs;
use crate::frame::Dir;
use crate::light::earth_shadow::Danjon;
use crate::light::night::Night;
use crate::light::night_lights::NightGlow;
use crate::light::photometry::Band;
use crate::place::Place;
use crate::plan::brightness::{MeasuredSky, SkyBrightness, Source};
use crate::plan::lay::Kept;
use crate::scene::Layers;
use crate::store::Store;
use crate::units::Angle;

use super::WhereArgs;
use super::error::CliError;
use super::look::{self, Look};
use super::night_glow::NightGlowArgs;
use super::{atmosphere, stage};

/// Nothing in the sky changes faster.
const TOLERANCE: Angle = Angle::from_arcsec(10.0);

#[derive(Debug, Args)]
#[command(after_help = "\
The sky is what lies between the stars: discs of Sun, Moon and planets and the 9096 stars that pictures \
draw one by one are not in it, but a Sky Quality Meter, whose field is wide, sees those stars. \
Luminances are photopic; mag_arcsec2 is in Johnson V from the spectrum. The limiting magnitude is that \
of a usual observer (Crumey 2014, field factor 2), for the light of a star as it arrives.")]
pub struct BrightnessArgs {
    /// Instant: 2026-08-12T21:30-07:00, 2026-08-12 21:30 (local time there), now, or tonight
    #[arg(long, value_name = "TIME", default_value = "now", allow_hyphen_values = true)]
    at: String,
    #[command(flatten)]
    location: WhereArgs,
    /// Apparent altitude, degrees [default: 90, the zenith]
    #[arg(long, visible_alias = "altitude", value_name = "DEG", allow_hyphen_values = true)]
    alt: Option<f64>,
    /// Azimuth, degrees from north through east [default: 0]
    #[arg(long, visible_alias = "azimuth", value_name = "DEG", allow_hyphen_values = true)]
    az: Option<f64>,
    /// Towards: N, SSW, an azimuth, zenith, or an object such as Moon or Sirius
    #[arg(long, value_name = "WHERE", allow_hyphen_values = true, conflicts_with = "az")]
    look: Option<Look>,
    /// A map of the whole sky too: .exr (cd/m2, channels X, Y, Z, V) or .png (false colours); north is
    /// up, east left; may be repeated
    #[arg(long, value_name = "FILE")]
    map: Vec<PathBuf>,
    /// Width and height of the map in pixels
    #[arg(long, value_name = "PX", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=8192))]
    map_size: u32,
    /// The air: a name that `nocturne atmosphere` lists, or a file [default: clear, with less haze on heights]
    #[arg(long, value_name = "NAME|FILE")]
    atmosphere: Option<String>,
    #[command(flatten)]
    glow: NightGlowArgs,
    /// For programs
    #[arg(long)]
    json: bool,
}

pub fn run(
    args: &BrightnessArgs,
    catalogs: &Catalogs,
    out: &mut impl Write,
) -> Result<(), CliError> {
    let place = args
        .location
        .find(catalogs)?
        .ok_or_else(|| CliError::Usage("say where: --place NAME, or --lat and --lon".to_owned()))?;
    let given = args.atmosphere.as_deref().map(atmosphere::find).transpose()?;
    let air = given.unwrap_or_else(|| Atmosphere::clear_over(place.height_m));
    air.validate_at(place.height_m).map_err(|error| CliError::Usage(error.to_string()))?;
    let glow = args.glow.change(NightGlow::default())?;
    let maps = map::open(&args.map)?;
    let night = night(args, &place, &air, catalogs)?;
    let dir = match &args.look {
        Some(Look::Object(name)) => look::towards(name, &night)?,
        Some(look) => direction(args.alt.or(look.altitude_deg()), look.azimuth_deg())?,
        None => direction(args.alt, args.az)?,
    };
    let mut kept = Kept::new(Store::of_user());
    let layers = Layers::default();
    let sky = MeasuredSky::of(&night, &glow, &layers, catalogs, &mut kept)?;
    let seen = sky.at(dir, &mut kept)?;
    if args.json {
        writeln!(out, "{:#}", described(&seen))?;
    } else {
        print(&seen, &night, &glow, dir, out)?;
    }
    let drawn = map::write(maps, args.map_size, &night, &glow, catalogs, &mut kept)?;
    if let (Some(scale), false) = (drawn, args.json) {
        writeln!(out, "{scale}")?;
    }
    Ok(())
}

fn night(
    args: &BrightnessArgs,
    place: &Place,
    air: &Atmosphere,
    catalogs: &Catalogs,
) -> Result<Night, CliError> {
    let instant = stage::instant(&args.at, place)?;
    stage::night(&instant, place, TOLERANCE, air, Danjon::default(), catalogs)
}

/// An apparent direction from degrees.
fn direction(
    altitude_deg: Option<f64>,
    azimuth_deg: Option<f64>,
) -> Result<Dir<crate::frame::Apparent>, CliError> {
    let (altitude_deg, azimuth_deg) = (altitude_deg.unwrap_or(90.0), azimuth_deg.unwrap_or(0.0));
    if !(-90.0..=90.0).contains(&altitude_deg) {
        let message = format!("--alt {altitude_deg} is outside -90 to 90; give degrees");
        return Err(CliError::Usage(message));
    }
    if !(-360.0..=360.0).contains(&azimuth_deg) {
        let message = format!("--az {azimuth_deg} is outside -360 to 360; give degrees");
        return Err(CliError::Usage(message));
    }
    let [azimuth, altitude] = [azimuth_deg, altitude_deg].map(Angle::from_deg);
    Ok(Dir::from_azimuth_altitude(azimuth, altitude))
}

/// A number that is one, for JSON.
fn number(value: Option<f64>) -> Value {
    value.filter(|v| v.is_finite()).map_or(Value::Null, |v| json!(v))
}

fn described(seen: &SkyBrightness) -> Value {
    let light = seen.luminance();
    let components: Map<String, Value> = seen
        .sources
        .iter()
        .map(|(source, light)| (source.name().to_owned(), json!(light.xyzv().y)))
        .collect();
    let ratio = (light.y > 0.0).then(|| light.v / light.y);
    json!({
        "luminance_cd_m2": light.y,
        "scotopic_luminance_cd_m2": light.v,
        "mag_arcsec2_v": number(seen.mag_per_arcsec2(Band::V)),
        "mag_arcsec2_b": number(seen.mag_per_arcsec2(Band::B)),
        "mag_arcsec2_r": number(seen.mag_per_arcsec2(Band::R)),
        "sp_ratio": number(ratio),
        "limiting_magnitude": number(Some(seen.limiting_magnitude().0)),
        "sqm_mag_arcsec2": number(seen.sqm_mag_per_arcsec2()),
        "components": components,
    })
}

/// What each source is called where people read it.
fn title(source: Source) -> &'static str {
    use crate::light::dark_sky::Component;
    match source {
        Source::Sun => "sunlight in the air",
        Source::Moon => "moonlight in the air",
        Source::Dark(Component::Airglow) => "airglow",
        Source::Dark(Component::Zodiacal) => "zodiacal light",
        Source::Dark(Component::Starlight) => "starlight",
        Source::Dark(Component::Galactic) => "dust of the Galaxy",
        Source::Dark(Component::Cosmic) => "far galaxies",
        Source::Dark(Component::Town) => "towns",
    }
}

fn print(
    seen: &SkyBrightness,
    night: &Night,
    glow: &NightGlow,
    dir: Dir<crate::frame::Apparent>,
    out: &mut impl Write,
) -> Result<(), CliError> {
    let light = seen.luminance();
    let mag = |mag: Option<f64>| mag.map_or("none".to_owned(), |mag| format!("{mag:.2}"));
    let (altitude, azimuth) = (dir.altitude().deg(), dir.azimuth().deg());
    writeln!(out, "The sky at altitude {altitude:.2}°, azimuth {azimuth:.2}°")?;
    writeln!(out, "  luminance           {:>12.4e} cd/m2", light.y)?;
    writeln!(out, "  scotopic luminance  {:>12.4e} cd/m2", light.v)?;
    if light.y > 0.0 {
        writeln!(out, "  S/P ratio           {:>12.3}", light.v / light.y)?;
    }
    for (band, name) in [(Band::B, "B"), (Band::V, "V"), (Band::R, "R")] {
        let mag = mag(seen.mag_per_arcsec2(band));
        writeln!(out, "  {name}                   {mag:>12} mag/arcsec2")?;
    }
    writeln!(out, "  Sky Quality Meter   {:>12} mag/arcsec2", mag(seen.sqm_mag_per_arcsec2()))?;
    writeln!(out, "  faintest star       {:>12.2} mag", seen.limiting_magnitude().0)?;
    writeln!(out, "What it is made of")?;
    for (source, part) in &seen.sources {
        let part = part.xyzv().y;
        if part > 0.0 {
            let share = 100.0 * part / light.y;
            writeln!(out, "  {:<21}{part:>11.4e} cd/m2 {share:>6.1} %", title(*source))?;
        }
    }
    let flux = glow.solar_flux_sfu(&night.sky);
    writeln!(out, "Airglow by a solar flux of {flux:.0} sfu")?;
    Ok(())
}

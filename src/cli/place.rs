//! `nocturne place`: places that are known.

use std::io::Write;

use clap::Args;

use crate::catalog::Catalogs;
use crate::place::gazetteer::Gazetteer;

use super::error::CliError;

#[derive(Debug, Args)]
pub struct PlaceArgs {
    /// Part of a name; the largest places first
    #[arg(default_value = "")]
    query: String,
    /// How many to list
    #[arg(long, default_value_t = 20, value_name = "N", allow_hyphen_values = true)]
    limit: usize,
}

pub fn run(args: &PlaceArgs, catalogs: &Catalogs, out: &mut impl Write) -> Result<(), CliError> {
    let text = catalogs.places_text()?;
    let gazetteer = Gazetteer::parse(&text)?;
    let found = gazetteer.search(&args.query, args.limit);
    if found.is_empty() && args.limit > 0 {
        // The look-up by name knows what is near it.
        gazetteer.find(&args.query)?;
    }
    for city in found {
        let height = city.elevation_m.map_or_else(String::new, |m| format!("{m:.0} m"));
        let zone = city.time_zone.map_or("", |zone| zone.name());
        writeln!(
            out,
            "{:<28} {:<28} {:>9.4} {:>10.4} {height:>7}  {zone}",
            city.name, city.admin1, city.latitude_deg, city.longitude_deg
        )?;
    }
    Ok(())
}

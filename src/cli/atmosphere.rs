//! `nocturne atmosphere`, and the air that `--atmosphere` means.

use std::io::Write;
use std::path::Path;

use clap::Args;

use crate::air::Atmosphere;

use super::error::CliError;

#[derive(Debug, Args)]
pub struct AtmosphereArgs {
    /// The air whose file is printed; without it all are listed
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

/// Prints the file of an air, or what airs there are.
pub fn run(args: &AtmosphereArgs, out: &mut impl Write) -> Result<(), CliError> {
    if let Some(name) = &args.name {
        out.write_all(Atmosphere::file_of(name)?.as_bytes())?;
        return Ok(());
    }
    for name in Atmosphere::names() {
        let first = Atmosphere::file_of(name)?.lines().next().unwrap_or_default();
        writeln!(out, "{name:<12} {}", first.trim_start_matches(['#', ' ']))?;
    }
    Ok(())
}

/// The air that `--atmosphere` names: a known one, or a file that ends in .toml or lies in a folder
/// that is told.
pub fn find(words: &str) -> Result<Atmosphere, CliError> {
    let path = Path::new(words);
    let is_file = path.extension().is_some() || path.components().count() > 1 || path.is_file();
    let about = |error: &dyn std::fmt::Display| format!("--atmosphere {words}: {error}");
    if words.trim().is_empty() {
        let message =
            "--atmosphere names nothing; give one that `nocturne atmosphere` lists, or a file";
        return Err(CliError::Usage(message.to_owned()));
    }
    if !is_file {
        return Atmosphere::named(words).map_err(|error| {
            CliError::Usage(about(&format!("{error}; or give a file that ends in .toml")))
        });
    }
    let text = std::fs::read_to_string(path).map_err(|error| {
        let way_out = "`nocturne atmosphere clear` prints such a file";
        CliError::Failure(about(&format!("cannot be read: {error}; {way_out}")))
    })?;
    Atmosphere::from_toml(&text).map_err(|error| CliError::Usage(about(&error)))
}

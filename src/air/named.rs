//! Airs that are known by name, and airs from files.
//!
//! Each name is a file in `catalogs/air/` that is compiled in: every number stands there with its
//! source, for a user to copy and change.

use super::{AirError, Atmosphere};

/// Names and files, in the order in which they are listed.
const FILES: [(&str, &str); 7] = [
    ("clear", include_str!("../../catalogs/air/clear.toml")),
    ("continental", include_str!("../../catalogs/air/continental.toml")),
    ("maritime", include_str!("../../catalogs/air/maritime.toml")),
    ("desert", include_str!("../../catalogs/air/desert.toml")),
    ("volcanic", include_str!("../../catalogs/air/volcanic.toml")),
    ("reference-a", include_str!("../../catalogs/air/reference-a.toml")),
    ("reference-b", include_str!("../../catalogs/air/reference-b.toml")),
];

/// Names this far from what was written, from 0 for nothing alike to 1, are suggested.
const ALIKE: f64 = 0.75;

impl Atmosphere {
    /// The names of the airs that are known.
    pub fn names() -> impl Iterator<Item = &'static str> {
        FILES.iter().map(|&(name, _)| name)
    }

    /// The file of an air: its first line says what it is.
    pub fn file_of(name: &str) -> Result<&'static str, AirError> {
        let asked = name.trim().to_lowercase();
        let found = FILES.iter().find(|(known, _)| *known == asked);
        found.map(|&(_, text)| text).ok_or_else(|| {
            let known = Atmosphere::names().collect::<Vec<_>>().join(", ");
            let nearest = Atmosphere::names()
                .map(|known| (known, strsim::jaro_winkler(&asked, known)))
                .filter(|&(_, alike)| alike >= ALIKE)
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let way_out = match nearest {
                Some((near, _)) => format!("did you mean {near}? Known are {known}"),
                None => format!("known are {known}"),
            };
            AirError::Unknown { name: name.to_owned(), way_out }
        })
    }

    /// An air by its name.
    pub fn named(name: &str) -> Result<Atmosphere, AirError> {
        Atmosphere::from_toml(Atmosphere::file_of(name)?)
    }

    /// An air from the text of a file, checked.
    pub fn from_toml(text: &str) -> Result<Atmosphere, AirError> {
        let air: Atmosphere = toml::from_str(text).map_err(|error| {
            let before = error.span().map_or(0, |span| span.start.min(text.len()));
            let line = text.as_bytes()[..before].iter().filter(|&&b| b == b'\n').count() + 1;
            let message = error.message().lines().collect::<Vec<_>>().join("; ");
            AirError::Syntax { line, message }
        })?;
        air.validate()?;
        Ok(air)
    }
}

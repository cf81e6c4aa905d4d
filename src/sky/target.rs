//! What a person can mean in the sky: anything that has a name.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::catalog::{ConstellationId, messier};
use crate::ephemeris::{Body, Galilean};

/// Something in the sky. Its text form is stable and fit for files: `Moon`, `Jupiter/Io`, `HR 2491`,
/// `Moon/Tycho`, `Constellation/Ori`, `M 31`.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Target {
    /// The Sun, the Moon or a planet.
    Body(Body),
    /// A moon of Jupiter.
    Satellite(Galilean),
    /// A star of the Bright Star Catalogue by its number there.
    Star { hr: u16 },
    /// A place on the Moon by the name that the IAU gives it.
    MoonFeature(String),
    /// A constellation.
    Constellation(ConstellationId),
    /// An object of Messier's, 1 to 110.
    Messier(u8),
}

/// Nothing is written so.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "target {0:?} is unknown; write it like Moon, Jupiter/Io, HR 2491, Moon/Tycho, Constellation/Ori or M 31"
)]
pub struct UnknownTarget(pub String);

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Target::Body(body) => write!(f, "{body}"),
            Target::Satellite(satellite) => write!(f, "Jupiter/{}", satellite.name()),
            Target::Star { hr } => write!(f, "HR {hr}"),
            Target::MoonFeature(name) => write!(f, "Moon/{name}"),
            Target::Constellation(id) => write!(f, "Constellation/{}", id.get().abbreviation),
            Target::Messier(number) => write!(f, "M {number}"),
        }
    }
}

impl FromStr for Target {
    type Err = UnknownTarget;
    /// Capitals do not count, but in names of places on the Moon; whether there is such a place or such a
    /// star is not looked up.
    fn from_str(text: &str) -> Result<Target, UnknownTarget> {
        let text = text.trim();
        parse(text).ok_or_else(|| UnknownTarget(text.to_owned()))
    }
}

fn parse(text: &str) -> Option<Target> {
    if let Some((group, name)) = text.split_once('/') {
        let name = name.trim();
        return match group.trim().to_ascii_lowercase().as_str() {
            "jupiter" => {
                let is_it = |moon: &Galilean| moon.name().eq_ignore_ascii_case(name);
                Galilean::ALL.into_iter().find(is_it).map(Target::Satellite)
            }
            "moon" => (!name.is_empty()).then(|| Target::MoonFeature(name.to_owned())),
            "constellation" => ConstellationId::from_abbreviation(name).map(Target::Constellation),
            _ => None,
        };
    }
    if let Ok(body) = text.parse() {
        return Some(Target::Body(body));
    }
    let (list, number) = text.split_once(' ')?;
    match list.to_ascii_lowercase().as_str() {
        "hr" => number.trim().parse().ok().filter(|&hr| hr > 0).map(|hr| Target::Star { hr }),
        "m" => {
            let number = number.trim().parse().ok()?;
            messier(number).map(|_| Target::Messier(number))
        }
        _ => None,
    }
}

impl TryFrom<String> for Target {
    type Error = UnknownTarget;
    fn try_from(text: String) -> Result<Target, UnknownTarget> {
        text.parse()
    }
}

impl From<Target> for String {
    fn from(target: Target) -> String {
        target.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_come_back_as_they_were_written() {
        let orion = ConstellationId::from_abbreviation("Ori").unwrap();
        for (target, written) in [
            (Target::Body(Body::Moon), "Moon"),
            (Target::Body(Body::Jupiter), "Jupiter"),
            (Target::Satellite(Galilean::Io), "Jupiter/Io"),
            (Target::Star { hr: 2491 }, "HR 2491"),
            (Target::MoonFeature("Mare Crisium".into()), "Moon/Mare Crisium"),
            (Target::Constellation(orion), "Constellation/Ori"),
            (Target::Messier(31), "M 31"),
        ] {
            assert_eq!(target.to_string(), written);
            assert_eq!(written.parse(), Ok(target.clone()));
            let json = serde_json::to_string(&target).unwrap();
            assert_eq!(json, format!("{written:?}"));
            assert_eq!(serde_json::from_str::<Target>(&json).unwrap(), target);
        }
        assert_eq!(" jupiter/IO ".parse(), Ok(Target::Satellite(Galilean::Io)));
    }

    #[test]
    fn what_is_nothing_is_refused() {
        for wrong in
            ["", "Vulcan", "HR", "HR x", "HR 0", "M 0", "M 111", "M 300", "Moon/", "Mars/Phobos"]
        {
            let message = wrong.parse::<Target>().unwrap_err().to_string();
            assert!(message.contains(&format!("{wrong:?}")), "{message}");
        }
        assert!("Constellation/Xyz".parse::<Target>().is_err());
    }
}

//! The bodies that have a theory of motion.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::units::{MOON_RADIUS_KM, SUN_RADIUS_KM};

/// A body of the solar system as seen from the Earth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Body {
    Sun,
    Moon,
    Mercury,
    Venus,
    Mars,
    Jupiter,
    Saturn,
    Uranus,
    Neptune,
    Pluto,
}

/// No body has this name.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "body {0:?} is unknown; give Sun, Moon, Mercury, Venus, Mars, Jupiter, Saturn, Uranus, \
     Neptune or Pluto"
)]
pub struct UnknownBody(pub String);

impl Body {
    /// All bodies: the Sun, the Moon, then the planets outwards.
    pub const ALL: [Body; 10] = [
        Body::Sun,
        Body::Moon,
        Body::Mercury,
        Body::Venus,
        Body::Mars,
        Body::Jupiter,
        Body::Saturn,
        Body::Uranus,
        Body::Neptune,
        Body::Pluto,
    ];

    /// The planets, outwards, Pluto last.
    pub const PLANETS: [Body; 8] = [
        Body::Mercury,
        Body::Venus,
        Body::Mars,
        Body::Jupiter,
        Body::Saturn,
        Body::Uranus,
        Body::Neptune,
        Body::Pluto,
    ];

    /// The English name.
    pub const fn name(self) -> &'static str {
        match self {
            Body::Sun => "Sun",
            Body::Moon => "Moon",
            Body::Mercury => "Mercury",
            Body::Venus => "Venus",
            Body::Mars => "Mars",
            Body::Jupiter => "Jupiter",
            Body::Saturn => "Saturn",
            Body::Uranus => "Uranus",
            Body::Neptune => "Neptune",
            Body::Pluto => "Pluto",
        }
    }

    /// Equatorial radius, kilometres; the mean radius of the Moon and of Pluto.
    ///
    /// Sun: IAU 2015 Resolution B3. Moon: LOLA sphere. Others: Archinal et al. 2018, *Celest. Mech.
    /// Dyn. Astron.* 130, 22, table 4 (WGCCRE 2015).
    pub const fn radius_km(self) -> f64 {
        match self {
            Body::Sun => SUN_RADIUS_KM,
            Body::Moon => MOON_RADIUS_KM,
            Body::Mercury => 2_440.53,
            Body::Venus => 6_051.8,
            Body::Mars => 3_396.19,
            Body::Jupiter => 71_492.0,
            Body::Saturn => 60_268.0,
            Body::Uranus => 25_559.0,
            Body::Neptune => 24_764.0,
            Body::Pluto => 1_188.3,
        }
    }

    /// Mean radius at the poles over that at the equator: 1 for balls. Same source.
    pub const fn polar_ratio(self) -> f64 {
        let polar_km = match self {
            Body::Mars => 3_376.20,
            Body::Jupiter => 66_854.0,
            Body::Saturn => 54_364.0,
            Body::Uranus => 24_973.0,
            Body::Neptune => 24_341.0,
            _ => return 1.0,
        };
        polar_km / self.radius_km()
    }
}

impl fmt::Display for Body {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Body {
    type Err = UnknownBody;
    /// The English name, in any case.
    fn from_str(name: &str) -> Result<Body, UnknownBody> {
        Body::ALL
            .into_iter()
            .find(|body| body.name().eq_ignore_ascii_case(name.trim()))
            .ok_or_else(|| UnknownBody(name.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back_in_any_case() {
        for body in Body::ALL {
            assert_eq!(body.name().to_uppercase().parse(), Ok(body));
        }
        assert_eq!("Vulcan".parse::<Body>(), Err(UnknownBody("Vulcan".into())));
    }
}

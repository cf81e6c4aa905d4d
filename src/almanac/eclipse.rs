//! Eclipses of the Moon and of the Sun: when they come, how large they are, and what a place sees.
//!
//! ```
//! use nocturne::almanac::eclipse::{SolarKind, solar_eclipses};
//! use nocturne::ephemeris::Ephemeris;
//! use nocturne::place::Place;
//! use nocturne::time;
//! use nocturne::units::Angle;
//!
//! let instant = |text| time::to_instant(&time::parse(text).unwrap(), None).unwrap();
//! let (from, to) = (instant("2026-01-01T00:00Z"), instant("2027-01-01T00:00Z"));
//! let ephemeris = Ephemeris::analytic();
//! let best = Angle::from_arcsec(0.001);
//! let eclipses = solar_eclipses(&ephemeris, from, to, best).collect::<Result<Vec<_>, _>>()?;
//! assert_eq!(eclipses.len(), 2);
//! let august = &eclipses[1];
//! assert_eq!(august.kind, SolarKind::Total);
//! let burgos = august.at(&Place::new(42.341, -3.702, 860.0)?)?.expect("it is on the path");
//! let [second, third] = burgos.central.expect("it is total");
//! assert!((60.0..130.0).contains(&((third.moment.instant.tt - second.moment.instant.tt) * 86_400.0)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! *Theory.* [`lunar_eclipses`] and [`solar_eclipses`] go from new moon to new moon (or full to full),
//! leave out those far from the node, and follow Sun and Moon over eight hours about the others.
//! Apparent places are used: light time and aberration are in them. Radii and the enlargement
//! of the shadow of the Earth are those of the canons of Espenak & Meeus.
//!
//! *Accuracy.* Instants are found to 0.01 s on the clock TT; how good they are depends on the theory of
//! the Moon, 2 s for each arcsecond, and [`LunarEclipse::uncertainty_s`] tells. By the tables of DE440
//! times agree within 0.1 s with independent computation from DE440, within 5 s with the Swiss
//! Ephemeris (which seeks the least angle, or works with another shape of the Earth). Real contacts
//! differ by seconds: the rim of the Moon has mountains (solar), the rim of the shadow is blurred
//! (lunar, 10 s and more).

mod discs;
mod local;
mod lunar;
mod lunation;
mod radii;
mod search;
mod shadow;
mod solar;
mod solar_local;
mod solve;
mod theory;
mod track;

use thiserror::Error;

use crate::ephemeris::EphemerisError;
use crate::time::TimeError;

pub use discs::Cover;
pub use local::{LocalMoment, RISE_ALTITUDE};
pub use lunar::{LocalLunarEclipse, LunarContacts, LunarEclipse, LunarKind};
pub use search::{lunar_eclipses, solar_eclipses};
pub use solar::{SolarContacts, SolarEclipse, SolarKind};
pub use solar_local::{LocalSolarEclipse, SolarContact, SolarPhase};

/// What can keep eclipses from being found.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EclipseError {
    #[error(transparent)]
    Time(#[from] TimeError),
    #[error(transparent)]
    Ephemeris(#[from] EphemerisError),
}

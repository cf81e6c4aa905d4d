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
//! let total_s = (third.moment.instant.tt - second.moment.instant.tt) * 86_400.0;
//! assert!((60.0..130.0).contains(&total_s));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! *Theory.* [`lunar_eclipses`] and [`solar_eclipses`] go from new moon to new moon (or full to
//! full), leave out those far from the node, and follow Sun and Moon over eight hours about the
//! others. Apparent places are used: light time and aberration are in them. Radii and the
//! enlargement of the shadow of the Earth are those of the canons of Espenak & Meeus (`radii.rs`).
//!
//! *Accuracy.* Times are as good as the Moon: 2 s for each arcsecond, and
//! [`LunarEclipse::uncertainty_s`] and [`SolarEclipse::uncertainty_s`] tell. On places of DE440,
//! `tests/eclipses.rs` finds
//!
//! | against | times | magnitudes |
//! |---|---|---|
//! | DE440 with ERFA, greatest eclipses | 0.003 s | |
//! | DE440 with ERFA, contacts of solar eclipses at places (Bessel's elements) | 0.04 s | 0.0005 |
//! | DE440 with ERFA, contacts of shadows with the Earth | 0.3 s | |
//! | Swiss Ephemeris, 457 eclipses of the Moon 1901-2100 | 4.7 s | 0.0011 |
//! | Swiss Ephemeris, 452 eclipses of the Sun 1901-2100 | 9.6 s | 0.0019 |
//! | Swiss Ephemeris, solar eclipses at places | 0.6 s | 0.0005 |
//! | Skyfield, eclipses of the Moon | 6.7 s | 0.0017 |
//!
//! At places Delta-T is set aside: in a year for which it is predicted, two predictions shift
//! contacts by what they differ. The Swiss Ephemeris is farthest off where a shadow grazes the
//! Earth or the Moon the shadow. Contacts as they are seen differ by seconds more: the rim of the
//! Moon has mountains, and the rim of the shadow of the Earth is blurred, by 10 s and more.
//!
//! *Cost.* `benches/eclipses.rs` tells. An eclipse of the Moon takes 35 microseconds and one of
//! the Sun 90, beside eight instants for which the theories are asked for Sun and Moon: six for
//! each of the 1.3 lunations that must be looked at to find one.

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

//! Where bodies and stars are, by theories of motion of known error.
//!
//! Whoever asks says how good the answer must be; [`Ephemeris::choose`] finds the cheapest [`Tier`]
//! that is good enough. An [`Observation`] is one instant at one place: it says where each body is
//! seen ([`apparent`]) and what all stars share ([`stars`]). [`orientation`] knows how the Earth
//! stands, [`moon_orientation`] how the Moon does; [`resampled`] holds the tables.
//!
//! # Accuracy
//!
//! [`Tier::bound`]: the apparent direction is not farther off than this, in arcseconds, from the
//! year at the head of the column to the next head. The time is taken to be exact: what is unknown
//! of the rotation of the Earth (Delta T, hours at -4000) turns the sky as a whole and moves the
//! Moon by half an arcsecond for each second.
//!
//! | | -4000 | -3000 | -2000 | -1000 | 0 | 1000 | 1550 | 1800 | 2050 | 2650 | 3000 |
//! |---|---|---|---|---|---|---|---|---|---|---|---|
//! | Sun, DE431 | - | 0.1 | 0.1 | 0.1 | 0.1 | 0.1 | 0.1 | 0.1 | 0.1 | 0.1 | 0.1 |
//! | Moon, DE431 | - | 3 | 3 | 3 | 3 | 3 | 3 | 3 | 3 | 3 | 3 |
//! | Mercury, DE431 | - | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 |
//! | Venus, DE431 | - | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 |
//! | Mars, DE431 | - | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 |
//! | Jupiter, DE431 | - | 0.3 | 0.3 | 0.3 | 0.3 | 0.3 | 0.3 | 0.3 | 0.3 | 0.3 | 0.3 |
//! | Saturn, DE431 | - | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 | 0.2 |
//! | Uranus, DE431 | - | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 |
//! | Neptune, DE431 | - | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 |
//! | Pluto, DE431 | - | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 | 1 |
//! | Sun, paper | - | - | - | 1150 | 520 | 150 | 55 | 65 | 125 | 230 | 680 |
//! | Moon, paper | - | - | - | 10800 | 5100 | 1450 | 600 | 600 | 830 | 1600 | 5400 |
//! | Sun, series | 65 | 40 | 35 | 22 | 22 | 15 | 14 | 14 | 16 | 16 | 18 |
//! | Moon, series | 570 | 400 | 240 | 130 | 65 | 30 | 24 | 24 | 28 | 36 | 65 |
//! | Mercury, series | 100 | 60 | 55 | 36 | 28 | 21 | 20 | 20 | 23 | 24 | 28 |
//! | Venus, series | 260 | 130 | 110 | 62 | 62 | 48 | 42 | 42 | 42 | 50 | 75 |
//! | Mars, series | 580 | 370 | 180 | 145 | 145 | 120 | 85 | 85 | 110 | 105 | 115 |
//! | Jupiter, series | 1400 | 950 | 550 | 290 | 180 | 95 | 95 | 125 | 95 | 95 | 100 |
//! | Saturn, series | 2600 | 1900 | 1150 | 600 | 370 | 190 | 130 | 130 | 130 | 145 | 200 |
//! | Uranus, series | 650 | 560 | 520 | 380 | 350 | 150 | 110 | 120 | 135 | 120 | 220 |
//! | Neptune, series | 260 | 140 | 150 | 90 | 60 | 50 | 20 | 16 | 22 | 40 | 50 |
//! | Pluto, series | 14000 | 1000 | 400 | 1150 | 1050 | 1000 | 550 | 320 | 370 | 650 | 9000 |
//!
//! The tables of DE440, 1550 to 2650, keep 0.1, 0.01 and 0.001 arcseconds for every body, as deep as
//! they are read; distances at the deepest: Moon 1 m, Sun 0.3 km, Mercury to Mars 1 km, the others 20
//! km. The table of DE431 ends at -3000 and +3000; it follows DE431 within 0.12 arcseconds, the Moon
//! within 1 (`pack` prints it), and DE440 has moved Neptune by 1.7 since. What a place costs by each
//! tier, `cargo bench --bench ephemeris` prints; where a table serves, it is also the cheapest.
//!
//! The paper tier ends at -1000, where its Moon is three degrees off; everything else is served from
//! -4000 to +4000. Pluto's elements were made for -3000 to +3000, and it shows.
//!
//! Distances by series and paper, relative, in 1550-2650: Moon 0.00003 and 0.0016, Sun 0.00001 and
//! 0.0001, planets 0.0002, Pluto 0.0006 (the largest of 2000 places against DE440).

mod analytic;
pub mod apparent;
mod body;
pub mod comparison;
pub mod de431;
pub mod de440;
mod deep_moon;
mod galilean;
pub mod kernel;
mod moon;
pub mod moon_orientation;
mod observation;
pub mod orientation;
mod paper;
pub mod phase;
mod planets;
mod polynomial;
pub mod resampled;
mod solar_system;
pub mod stars;
mod tables;
mod tier;

pub use body::{Body, UnknownBody};
pub use galilean::{Galilean, JUPITER_EQUATORIAL_RADIUS_KM, JUPITER_POLAR_RADIUS_KM, jupiter_pole};
pub use observation::{Observation, Seen};
pub use planets::{north_pole, saturn_pole};
pub use resampled::Depth;
pub use tables::{EarthState, Ephemeris};
pub use tier::{EphemerisError, Tier, Tolerance};

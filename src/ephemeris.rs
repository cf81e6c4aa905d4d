//! Where bodies and stars are, by theories of motion of known error.
//!
//! Whoever asks says how good the answer must be; [`Ephemeris::choose`] finds the cheapest [`Tier`] that is
//! good enough. [`Ephemeris::geometric`] gives where a body is, [`apparent`] where it is seen from a place on
//! the turning Earth, [`stars`] does the same for a catalogue, [`orientation`] knows how the Earth
//! stands, [`moon_orientation`] how the Moon does.
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
//! The paper tier ends at -1000, where its Moon is three degrees off; everything else is served from
//! -4000 to +4000. Pluto's elements were made for -3000 to +3000, and it shows.
//!
//! Distances, relative, in 1550-2650: Moon 0.00003 (series) and 0.0016 (paper), Sun 0.00001 and
//! 0.0001, planets 0.0002, Pluto 0.0006 (the largest of 2000 places against DE440).

mod analytic;
pub mod apparent;
mod body;
pub mod de440;
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
pub use observation::{Observation, Seen};
pub use planets::saturn_pole;
pub use resampled::Depth;
pub use tables::{EarthState, Ephemeris};
pub use tier::{EphemerisError, Tier, Tolerance};

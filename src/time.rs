//! Clocks, calendars, and instants that all clocks agree on.
//!
//! **What it gives.** People write civil dates ([`CivilDateTime`], [`Written`]); the sky asks for
//! Julian dates on a clock that suits each motion ([`JulianDate`]). An [`Instant`] carries them all.
//!
//! **Conventions**, for civil years -4000 to +4000 (astronomical count: year 0 is 1 BCE):
//!
//! - Dates are Gregorian from 1582-10-15 and Julian before; the ten days between do not exist.
//! - Civil "UTC" is UTC from 1972-01-01 to the end of the IERS table (2027-11-04). Before and after,
//!   what people write is taken as UT1: the clock reads the rotation of the Earth. At both ends the
//!   civil clock steps by UT1 - UTC, some 0.05 s and 0.2 s; TT, TDB and UT1 run on smoothly.
//! - A day with a leap second is 86401 s long and its Julian date (UTC) is stretched to match, as in
//!   the SOFA library: 23:59:60.5 lies between 23:59:59 and midnight. Differences of UTC Julian dates
//!   across such a day are therefore not elapsed time; use [`Instant::plus_seconds`].
//! - TT = TAI + 32.184 s, UT1 = TT - Delta-T ([`delta_t`]), TDB = TT + a short series ([`tdb`]).
//!
//! **How sure.** UT1 is good to about 1 ms where the IERS measured it, to 0.7 s from 1900 to 1972,
//! to some seconds in 1650, to minutes in antiquity; at -4000 it is off by hours, one way or the other.
//! TDB is good to 10 microseconds from 1800 to 2200 and to 50 anywhere.

pub mod clock;
pub mod error;
pub mod leap_seconds;

pub mod calendar;
pub mod delta_t;
pub mod tdb;

pub mod instant;

pub mod local;
pub mod written;

pub use calendar::{CivilDateTime, days_in_month};
pub use clock::{J2000, JulianDate, Tai, Tdb, Tt, Ut1, Utc};
pub use error::TimeError;
pub use instant::Instant;
pub use local::{LocalTime, to_instant};
pub use written::{Written, parse};

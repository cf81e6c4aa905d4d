//! What can be wrong with a date or a time.

use thiserror::Error;

/// What can be wrong with a date or a time.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TimeError {
    #[error(
        "cannot read '{0}' as a date; write one like 2026-08-12T21:30-07:00, \
         2026-08-12 21:30, -0584-05-28, or now"
    )]
    Syntax(String),
    #[error("{field} {value} is outside {low} to {high}")]
    Field { field: &'static str, value: i64, low: i64, high: i64 },
    #[error("second {0} is outside 0 to 60 (60 only in a leap second)")]
    Second(f64),
    #[error("{year:04}-{month:02} has {days} days, so there is no day {day}")]
    Day { year: i32, month: u8, day: u8, days: u8 },
    #[error("1582-10-{0:02} never was: 1582-10-04 (Julian) was followed by 1582-10-15 (Gregorian)")]
    CalendarGap(u8),
    #[error("year {0} is outside -4000 to 4000, the years this sky can be computed for")]
    Year(i64),
    #[error("Julian date {0} is outside the years -4000 to 4000")]
    JulianDate(f64),
    #[error("there was no leap second at {0}; write second 59 or the next minute")]
    NoLeapSecond(String),
    #[error("offset '{0}' from UTC is outside -18:00 to +18:00")]
    Offset(String),
    #[error(
        "clocks in {zone} jumped over {local}; write a time before or after the jump, \
         or give its offset from UTC"
    )]
    Skipped { local: String, zone: String },
}

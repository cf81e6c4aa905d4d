//! The clock of the window: any instant, at any rate, forwards and back.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::time::{self, Instant};
use crate::units::DAY_S;

/// Seconds of the sky to a second of the viewer, upwards.
const RATES: [f64; 12] = [
    1.0,
    10.0,
    60.0,
    600.0,
    3600.0,
    21_600.0,
    DAY_S,
    7.0 * DAY_S,
    30.0 * DAY_S,
    JULIAN_YEAR_S,
    10.0 * JULIAN_YEAR_S,
    100.0 * JULIAN_YEAR_S,
];
const JULIAN_YEAR_S: f64 = 365.25 * DAY_S;

/// What is stepped over in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    Minute,
    Hour,
    Day,
    /// The stars stand as they did.
    SiderealDay,
    Week,
    /// The Moon has the phase that it had: a mean synodic month.
    Lunation,
    Year,
}

impl Step {
    /// SI seconds; the sidereal day after IAU 2006, the others mean values.
    pub fn seconds(self) -> f64 {
        match self {
            Step::Minute => 60.0,
            Step::Hour => 3600.0,
            Step::Day => DAY_S,
            Step::SiderealDay => 86_164.090_53,
            Step::Week => 7.0 * DAY_S,
            Step::Lunation => 29.530_588_86 * DAY_S,
            Step::Year => JULIAN_YEAR_S,
        }
    }
}

/// An instant that goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    pub instant: Instant,
    /// Seconds of the sky to a second of the viewer; negative back in time.
    pub rate: f64,
    pub is_playing: bool,
    /// Follows the clock of the machine.
    pub is_live: bool,
}

impl Clock {
    /// The clock of the machine.
    pub fn live() -> Clock {
        Clock { instant: now(), rate: 1.0, is_playing: true, is_live: true }
    }

    /// Stands at an instant.
    pub fn at(instant: Instant) -> Clock {
        Clock { instant, rate: 1.0, is_playing: false, is_live: false }
    }

    /// Lets time of the viewer pass. At the ends of the dates that are known it stops.
    pub fn advance(&mut self, passed_s: f64) {
        if self.is_live {
            self.instant = now();
        } else if self.is_playing {
            match self.instant.plus_seconds(self.rate * passed_s) {
                Ok(instant) => self.instant = instant,
                Err(_) => self.is_playing = false,
            }
        }
    }

    /// Whether the sky goes on by itself.
    pub fn runs(&self) -> bool {
        self.is_live || self.is_playing && self.rate != 0.0
    }

    /// Seconds of the sky to a second of the viewer, 0 when it stands.
    pub fn speed(&self) -> f64 {
        if self.runs() { self.rate } else { 0.0 }
    }

    /// Stands still, or goes on.
    pub fn toggle(&mut self) {
        (self.is_playing, self.is_live) = (!self.runs(), false);
    }

    /// Forwards as time goes.
    pub fn real_time(&mut self) {
        (self.rate, self.is_playing, self.is_live) = (1.0, true, false);
    }

    /// To the present, and on with it.
    pub fn to_now(&mut self) {
        *self = Clock::live();
    }

    /// The next rate up, `direction` positive, or down: from backwards through standing to forwards.
    pub fn change_rate(&mut self, direction: i32) {
        let place = match self.speed() {
            0.0 => 0,
            rate => {
                let nearest = |at: &f64| (at / rate.abs()).ln().abs();
                let by_nearness = |(_, a): &(usize, &f64), (_, b): &(usize, &f64)| {
                    nearest(a).total_cmp(&nearest(b))
                };
                let step = RATES.iter().enumerate().min_by(by_nearness).map_or(0, |(n, _)| n);
                (step as i32 + 1) * rate.signum() as i32
            }
        };
        let last = RATES.len() as i32;
        let place = (place + direction.signum()).clamp(-last, last);
        self.is_live = false;
        self.is_playing = place != 0;
        if place != 0 {
            self.rate = RATES[place.unsigned_abs() as usize - 1] * f64::from(place.signum());
        }
    }

    /// Another instant; the rate stays.
    pub fn set(&mut self, instant: Instant) {
        self.is_playing = self.runs();
        self.is_live = false;
        self.instant = instant;
    }

    /// Steps over so many of something; not beyond the dates that are known.
    pub fn step(&mut self, step: Step, many: i32) {
        if let Ok(instant) = self.instant.plus_seconds(step.seconds() * f64::from(many)) {
            self.set(instant);
        }
    }

    /// The rate in words: `real time`, `10 min/s back`.
    pub fn rate_in_words(&self) -> String {
        let speed = self.speed();
        let size = speed.abs();
        let amount = match size {
            0.0 => return "paused".to_owned(),
            1.0 => "real time".to_owned(),
            size if size < 60.0 => format!("{size:.0} s/s"),
            size if size < 3600.0 => format!("{:.0} min/s", size / 60.0),
            size if size < DAY_S => format!("{:.0} h/s", size / 3600.0),
            size if size < JULIAN_YEAR_S => format!("{:.0} d/s", size / DAY_S),
            size => format!("{:.0} a/s", size / JULIAN_YEAR_S),
        };
        if speed < 0.0 { format!("{amount} back") } else { amount }
    }
}

/// The present, by the clock of the machine, to the millisecond, as scene files have it.
pub fn now() -> Instant {
    let read = || time::to_instant(&time::parse("now").ok()?, None).ok();
    // A machine whose clock is out of all range shows the epoch.
    let epoch = || Instant::from_tt(time::JulianDate::from_jd(2_451_545.0));
    read().or_else(|| epoch().ok()).expect("J2000.0 is a date")
}

/// As files have it.
#[derive(Serialize, Deserialize)]
struct Kept {
    /// Left out by a clock that follows the machine's.
    #[serde(skip_serializing_if = "Option::is_none")]
    utc: Option<String>,
    rate: f64,
    is_playing: bool,
}

impl Serialize for Clock {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let utc = (!self.is_live).then(|| self.instant.to_string());
        Kept { utc, rate: self.rate, is_playing: self.is_playing }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Clock {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Clock, D::Error> {
        let kept = Kept::deserialize(deserializer)?;
        let Some(utc) = kept.utc else { return Ok(Clock::live()) };
        let error = |error: &dyn fmt::Display| serde::de::Error::custom(error.to_string());
        let written = time::parse(&utc).map_err(|e| error(&e))?;
        let instant = time::to_instant(&written, None).map_err(|e| error(&e))?;
        if !kept.rate.is_finite() {
            return Err(error(&"the rate of the clock is no number"));
        }
        Ok(Clock { instant, rate: kept.rate, is_playing: kept.is_playing, is_live: false })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noon() -> Instant {
        Instant::from_tt(time::JulianDate::from_jd(2_451_545.0)).unwrap()
    }

    #[test]
    fn rates_go_from_back_through_standing_to_forwards() {
        let mut clock = Clock::at(noon());
        let mut speeds = Vec::new();
        for direction in [1, 1, 1, -1, -1, -1, -1, -1] {
            clock.change_rate(direction);
            speeds.push(clock.speed());
        }
        assert_eq!(speeds, [1.0, 10.0, 60.0, 10.0, 1.0, 0.0, -1.0, -10.0]);
        for _ in 0..50 {
            clock.change_rate(1);
        }
        assert_eq!(clock.speed(), 100.0 * JULIAN_YEAR_S);
    }

    #[test]
    fn time_passes_at_its_rate_and_stops_at_the_ends() {
        let mut clock = Clock::at(noon());
        clock.advance(5.0);
        assert_eq!(clock.instant, noon());
        clock.real_time();
        clock.change_rate(1);
        clock.advance(6.0);
        assert!((clock.instant.tt.jd() - noon().tt.jd() - 60.0 / DAY_S).abs() < 1e-9);
        clock.rate = 100.0 * JULIAN_YEAR_S;
        (0..100).for_each(|_| clock.advance(1.0));
        assert!(!clock.runs());
        let before = clock.instant;
        clock.step(Step::Year, 1000);
        assert_eq!(clock.instant, before);
    }

    #[test]
    fn a_clock_survives_its_file() {
        let clock = Clock { rate: -600.0, is_playing: true, ..Clock::at(noon()) };
        let text = serde_json::to_string(&clock).unwrap();
        let read: Clock = serde_json::from_str(&text).unwrap();
        assert_eq!((read.rate, read.is_playing, read.is_live), (-600.0, true, false));
        assert!((read.instant.tt.jd() - clock.instant.tt.jd()).abs() * DAY_S < 0.002);
        let live: Clock =
            serde_json::from_str(&serde_json::to_string(&Clock::live()).unwrap()).unwrap();
        assert!(live.is_live);
    }
}

//! Nights without Sun and Moon: intervals in which both stay down.

use crate::almanac::event::{Event, What};
use crate::almanac::local::Switch;
use crate::ephemeris::Body;
use crate::time::Instant;

/// Follows the Sun and the Moon through time.
#[derive(Debug, Clone)]
pub struct Darkness {
    sun_is_up: bool,
    moon_is_up: bool,
    /// When the dark began that lasts.
    since: Option<Instant>,
}

impl Darkness {
    /// From an instant at which it is known who is up.
    pub fn from(start: &Instant, sun_is_up: bool, moon_is_up: bool) -> Darkness {
        let is_dark = !sun_is_up && !moon_is_up;
        Darkness { sun_is_up, moon_is_up, since: is_dark.then_some(*start) }
    }

    /// When the dark began that lasts; no earlier event is still to come.
    pub fn since(&self) -> Option<&Instant> {
        self.since.as_ref()
    }

    /// What is over now that a light came or went.
    pub fn note(&mut self, switch: &Switch) -> Option<Event> {
        match switch.light {
            Body::Sun => self.sun_is_up = switch.is_up,
            _ => self.moon_is_up = switch.is_up,
        }
        if self.sun_is_up || self.moon_is_up {
            return self.end(&switch.instant);
        }
        self.since.get_or_insert(switch.instant);
        None
    }

    /// Ends what lasts.
    pub fn end(&mut self, end: &Instant) -> Option<Event> {
        self.since.take().map(|instant| Event { instant, what: What::Dark { end: *end } })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::JulianDate;

    #[test]
    fn it_is_dark_while_both_are_down() {
        let at =
            |hour: f64| Instant::from_tt(JulianDate::from_parts(2_460_000.5, hour / 24.0)).unwrap();
        let mut darkness = Darkness::from(&at(0.0), true, false);
        let mut dark = Vec::new();
        for (hour, light, is_up) in [
            (1.0, Body::Sun, false),
            (3.0, Body::Moon, true),
            (9.0, Body::Moon, false),
            (11.0, Body::Sun, true),
            (12.0, Body::Moon, true),
            (13.0, Body::Sun, false),
        ] {
            dark.extend(darkness.note(&Switch { instant: at(hour), light, is_up }));
        }
        assert!(darkness.since().is_none());
        dark.extend(darkness.note(&Switch { instant: at(20.0), light: Body::Moon, is_up: false }));
        dark.extend(darkness.end(&at(24.0)));
        let hours = [(1.0, 3.0), (9.0, 11.0), (20.0, 24.0)];
        let expected =
            hours.map(|(from, to)| Event { instant: at(from), what: What::Dark { end: at(to) } });
        assert_eq!(dark, expected);
    }
}

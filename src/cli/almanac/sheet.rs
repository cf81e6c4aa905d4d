//! What all ways of writing an almanac share.

use std::io::{self, Write};

use crate::almanac::{Almanac, Event, delta_t_error_s};
use crate::ephemeris::Body;
use crate::place::Place;
use crate::time::{Instant, LocalTime};
use crate::units::Angle;

use super::CliError;

/// A way of writing events, one after the other.
pub trait Sheet {
    fn begin(&mut self, heading: &Heading, out: &mut dyn Write) -> io::Result<()>;
    fn event(&mut self, heading: &Heading, event: &Event, out: &mut dyn Write) -> io::Result<()>;
    fn end(&mut self, heading: &Heading, out: &mut dyn Write) -> io::Result<()>;
}

/// Where, from when to when, and how well it is known.
pub struct Heading {
    pub place: Option<Place>,
    pub from: Instant,
    pub to: Instant,
    /// What the words mean, a sentence each.
    pub definitions: Vec<String>,
    /// How well it is known.
    pub accuracy: Vec<String>,
}

/// Speed of the sky at the equator, and of the Moon from the Sun, arcseconds per second.
const SKY_ARCSEC_S: f64 = 15.04;
const MOON_ARCSEC_S: f64 = 0.508;

impl Heading {
    pub fn of(
        almanac: &Almanac,
        place: Option<Place>,
        from: Instant,
        to: Instant,
    ) -> Result<Heading, CliError> {
        let worse = |body: Body| -> Result<Angle, CliError> {
            Ok(almanac.error_bound(&from, body)?.max(almanac.error_bound(&to, body)?))
        };
        let [sun, moon] = [worse(Body::Sun)?.arcsec(), worse(Body::Moon)?.arcsec()];
        let error_s = delta_t_error_s(&from).max(delta_t_error_s(&to));
        let accuracy = vec![
            format!(
                "positions are within {sun:.3}\" (Sun) and {moon:.3}\" (Moon): {:.4} s and {:.4} s in rise and set at the equator, {:.3} s in phases",
                sun / SKY_ARCSEC_S,
                moon / SKY_ARCSEC_S,
                (sun + moon) / MOON_ARCSEC_S
            ),
            format!(
                "Delta-T (TT - UT1) is taken as {:.2} s at the beginning and {:.2} s at the end, with a standard error of up to {error_s:.3} s, which times in UT share: phases and seasons all of it, rise and set of the Moon 1/27, of the Sun 1/365",
                from.delta_t_s(),
                to.delta_t_s()
            ),
        ];
        Ok(Heading { place, from, to, definitions: almanac.definitions(), accuracy })
    }

    /// All sentences.
    pub fn notes(&self) -> impl Iterator<Item = &str> {
        self.definitions.iter().chain(&self.accuracy).map(String::as_str)
    }

    /// The name of the place, or its coordinates.
    pub fn place_name(&self) -> Option<String> {
        let place = self.place.as_ref()?;
        Some(place.name.clone().unwrap_or_else(|| coordinates(place.latitude, place.longitude)))
    }

    /// What clocks at the place show, if they are known.
    pub fn local(&self, instant: &Instant) -> Option<LocalTime> {
        let zone = self.place.as_ref()?.time_zone?;
        Some(instant.to_local(zone))
    }
}

/// `35.1983° N, 111.6513° W`.
pub fn coordinates(latitude: Angle, longitude: Angle) -> String {
    let part = |angle: Angle, positive: char, negative: char| {
        let wind = if angle < Angle::ZERO { negative } else { positive };
        format!("{:.4}° {wind}", angle.abs().deg())
    };
    format!("{}, {}", part(latitude, 'N', 'S'), part(longitude, 'E', 'W'))
}

/// The same instant where the seconds of UTC are whole.
pub fn to_the_second(instant: &Instant) -> Instant {
    let second = instant.utc_civil().second;
    // At the very end of all years there is no next second.
    instant.plus_seconds(second.round() - second).unwrap_or(*instant)
}

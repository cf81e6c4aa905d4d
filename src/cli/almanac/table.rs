//! An almanac to be read.

use std::io::{self, Write};

use crate::almanac::eclipse::LunarKind;
use crate::almanac::{Event, What};
use crate::cli::look::wind;
use crate::time::{CivilDateTime, Instant};
use crate::units::{AU_KM, DAY_S};

use super::sheet::{Heading, Sheet, coordinates, to_the_second};

/// One event a line; the definitions below.
pub struct Table;

impl Sheet for Table {
    fn begin(&mut self, heading: &Heading, out: &mut dyn Write) -> io::Result<()> {
        if let Some(place) = &heading.place {
            let name = heading.place_name().unwrap_or_default();
            let height_m = place.height_m;
            let point = coordinates(place.latitude, place.longitude);
            write!(out, "{name}: {point}, {height_m:.0} m")?;
            match place.time_zone {
                Some(zone) => writeln!(out, "; times of {} and UTC", zone.name())?,
                None => writeln!(out, "; times in UTC")?,
            }
        }
        Ok(())
    }

    fn event(&mut self, heading: &Heading, event: &Event, out: &mut dyn Write) -> io::Result<()> {
        let instant = to_the_second(&event.instant);
        match heading.local(&instant) {
            Some(local) => {
                let utc = clock(&instant.utc_civil());
                let date = date_and_clock(&local.civil);
                write!(out, "{date} {:<5} {utc} UTC  ", local.abbreviation)?;
            }
            None => write!(out, "{} UTC  ", date_and_clock(&instant.utc_civil()))?,
        }
        let details = details(heading, event);
        match details.is_empty() {
            true => writeln!(out, "{}", event.what),
            false => writeln!(out, "{:<38} {details}", event.what.to_string()),
        }
    }

    fn end(&mut self, heading: &Heading, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out)?;
        for line in heading.notes() {
            writeln!(out, "{line}")?;
        }
        Ok(())
    }
}

pub fn details(heading: &Heading, event: &Event) -> String {
    match &event.what {
        What::Transit { altitude, .. } => format!("altitude {:.2}°", altitude.deg()),
        What::Dark { end } => format!("until {}, {}", until(heading, end), lasting(event, end)),
        What::Apsis { distance_km, .. } if *distance_km > 0.1 * AU_KM => {
            format!("{:.7} au", distance_km / AU_KM)
        }
        What::Apsis { distance_km, .. } => format!("{distance_km:.0} km"),
        What::LunarEclipse { kind: LunarKind::Penumbral, penumbral_magnitude, .. } => {
            format!("penumbral magnitude {penumbral_magnitude:.4}{}", stands(&event.what))
        }
        What::LunarEclipse { umbral_magnitude, penumbral_magnitude, .. } => format!(
            "magnitude {umbral_magnitude:.4}, penumbral {penumbral_magnitude:.4}{}",
            stands(&event.what)
        ),
        What::SolarEclipse { magnitude, latitude, longitude, .. } => {
            let point = coordinates(*latitude, *longitude);
            format!("magnitude {magnitude:.4} at {point}")
        }
        What::SolarEclipseHere { magnitude, obscuration, .. } => {
            let percent = 100.0 * obscuration;
            format!("magnitude {magnitude:.4}, {percent:.1} % covered{}", stands(&event.what))
        }
        What::EclipseContact { .. } => stands(&event.what).trim_start_matches(", ").to_owned(),
        what => what.azimuth().map_or_else(String::new, |azimuth| {
            format!("azimuth {:.2}° {}", azimuth.deg(), wind(azimuth))
        }),
    }
}

/// Where something eclipsed stands, if there is a place.
fn stands(what: &What) -> String {
    let (Some(azimuth), Some(altitude)) = (what.azimuth(), what.altitude()) else {
        return String::new();
    };
    match altitude.deg() {
        deg if deg < -1.0 => ", below the horizon".to_owned(),
        deg => format!(", altitude {deg:.1}° {}", wind(azimuth)),
    }
}

/// The time of day of an end.
fn until(heading: &Heading, end: &Instant) -> String {
    let end = to_the_second(end);
    clock(&heading.local(&end).map_or_else(|| end.utc_civil(), |local| local.civil))
}

/// `7 h 41 min`.
fn lasting(event: &Event, end: &Instant) -> String {
    let minutes = ((end.tt - event.instant.tt) * DAY_S / 60.0).round() as i64;
    format!("{} h {:02} min", minutes / 60, minutes % 60)
}

fn date_and_clock(civil: &CivilDateTime) -> String {
    civil.to_string().replace('T', " ")
}

fn clock(civil: &CivilDateTime) -> String {
    let text = civil.to_string();
    text.split_once('T').map(|(_, clock)| clock.to_owned()).unwrap_or(text)
}

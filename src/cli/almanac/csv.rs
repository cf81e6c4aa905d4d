//! An almanac as comma-separated values.

use std::io::{self, Write};

use crate::almanac::Event;
use crate::units::DAY_S;

use super::sheet::{Heading, Sheet, coordinates};

/// Comments that begin with `#`, a line of names, one event a line.
pub struct Csv;

const COLUMNS: &str = "event,first,second,utc,local,jd_tt,jd_ut1,azimuth_deg,altitude_deg,\
                       separation_deg,distance_km,magnitude,obscuration,end_utc,duration_h";

impl Sheet for Csv {
    fn begin(&mut self, heading: &Heading, out: &mut dyn Write) -> io::Result<()> {
        if let Some(place) = &heading.place {
            let name = heading.place_name().unwrap_or_default();
            let point = coordinates(place.latitude, place.longitude);
            writeln!(out, "# {name}: {point}, {} m", place.height_m)?;
        }
        let lines = heading.notes();
        for line in lines {
            writeln!(out, "# {line}")?;
        }
        writeln!(out, "{COLUMNS}")
    }

    fn event(&mut self, heading: &Heading, event: &Event, out: &mut dyn Write) -> io::Result<()> {
        let what = &event.what;
        let targets = what.targets();
        let name =
            |index: usize| targets.get(index).map_or_else(String::new, |t| quoted(&t.name()));
        let number = |value: Option<f64>, digits: usize| {
            value.map_or_else(String::new, |value| format!("{value:.digits$}"))
        };
        let instant = &event.instant;
        let cells = [
            what.code().to_owned(),
            name(0),
            name(1),
            instant.to_string(),
            heading.local(instant).map_or_else(String::new, |local| local.to_string()),
            format!("{:.8}", instant.tt.jd()),
            format!("{:.8}", instant.ut1.jd()),
            number(what.azimuth().map(|angle| angle.deg()), 6),
            number(what.altitude().map(|angle| angle.deg()), 6),
            number(what.separation().map(|angle| angle.deg()), 6),
            number(what.distance_km(), 3),
            number(what.magnitude(), 6),
            number(what.obscuration(), 6),
            what.end().map_or_else(String::new, |end| end.to_string()),
            number(what.end().map(|end| (end.tt - instant.tt) * DAY_S / 3600.0), 6),
        ];
        writeln!(out, "{}", cells.join(","))
    }

    fn end(&mut self, _: &Heading, _: &mut dyn Write) -> io::Result<()> {
        Ok(())
    }
}

/// In quotes where it must be (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

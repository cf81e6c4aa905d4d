//! An almanac as one JSON object, one event a line.

use std::io::{self, Write};

use serde::Serialize;

use crate::almanac::Event;
use crate::units::{Angle, DAY_S};

use super::sheet::{Heading, Sheet};

/// An object whose last member is an array of events; written as they come.
#[derive(Default)]
pub struct Json {
    is_begun: bool,
}

#[derive(Serialize)]
struct Top<'a> {
    place: Option<PlaceRecord>,
    from_utc: String,
    to_utc: String,
    definitions: &'a [String],
    accuracy: &'a [String],
    events: [(); 0],
}

#[derive(Serialize)]
struct PlaceRecord {
    name: Option<String>,
    latitude_deg: f64,
    longitude_deg: f64,
    height_m: f64,
    time_zone: Option<&'static str>,
}

#[derive(Serialize)]
struct EventRecord {
    event: &'static str,
    title: String,
    targets: Vec<String>,
    utc: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    local: Option<String>,
    jd_tt: f64,
    jd_ut1: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    azimuth_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    altitude_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    separation_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    distance_km: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    magnitude: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    obscuration: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    end_utc: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    duration_h: Option<f64>,
}

impl Sheet for Json {
    fn begin(&mut self, heading: &Heading, out: &mut dyn Write) -> io::Result<()> {
        let place = heading.place.as_ref().map(|place| PlaceRecord {
            name: place.name.clone(),
            latitude_deg: place.latitude.deg(),
            longitude_deg: place.longitude.deg(),
            height_m: place.height_m,
            time_zone: place.time_zone.map(|zone| zone.name()),
        });
        let top = serde_json::to_string(&Top {
            place,
            from_utc: heading.from.to_string(),
            to_utc: heading.to.to_string(),
            definitions: &heading.definitions,
            accuracy: &heading.accuracy,
            events: [],
        })?;
        // The array stays open.
        write!(out, "{}", top.trim_end_matches("]}"))
    }

    fn event(&mut self, heading: &Heading, event: &Event, out: &mut dyn Write) -> io::Result<()> {
        let (what, instant) = (&event.what, &event.instant);
        let deg = |angle: Option<Angle>| angle.map(|angle| angle.deg());
        let record = serde_json::to_string(&EventRecord {
            event: what.code(),
            title: what.to_string(),
            targets: what.targets().iter().map(|target| target.name()).collect(),
            utc: instant.to_string(),
            local: heading.local(instant).map(|local| local.to_string()),
            jd_tt: instant.tt.jd(),
            jd_ut1: instant.ut1.jd(),
            azimuth_deg: deg(what.azimuth()),
            altitude_deg: deg(what.altitude()),
            separation_deg: deg(what.separation()),
            distance_km: what.distance_km(),
            magnitude: what.magnitude(),
            obscuration: what.obscuration(),
            end_utc: what.end().map(|end| end.to_string()),
            duration_h: what.end().map(|end| (end.tt - instant.tt) * DAY_S / 3600.0),
        })?;
        let comma = if self.is_begun { "," } else { "" };
        self.is_begun = true;
        write!(out, "{comma}\n{record}")
    }

    fn end(&mut self, _: &Heading, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "\n]}}")
    }
}

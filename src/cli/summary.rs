//! What is in a picture, in words.

use std::io::{self, Write};

use crate::ephemeris::Body;
use crate::frame::Dir;
use crate::light::night::{Kind, LitObject, Night};
use crate::plan::ledger::Ledger;
use crate::scene::Setting;
use crate::units::Angle;

use super::look::wind;

/// Stars that are named.
const NAMED_STARS: usize = 8;

/// Says what the picture of a night holds.
pub fn write(
    out: &mut dyn Write,
    setting: &Setting,
    night: &Night,
    ledger: Option<&Ledger>,
) -> io::Result<()> {
    let place = &setting.place;
    let name = place
        .name
        .clone()
        .unwrap_or_else(|| format!("{:.4}°, {:.4}°", place.latitude.deg(), place.longitude.deg()));
    let utc = setting.instant;
    match place.time_zone {
        Some(zone) => {
            let local = utc.to_local(zone);
            writeln!(out, "{name}, {local} ({}; {utc})", local.abbreviation)?;
        }
        None => writeln!(out, "{name}, {utc}")?,
    }
    let camera = &setting.camera;
    writeln!(
        out,
        "Looking {} at altitude {:.1}°, {:.4}° wide, {}, {} x {} pixels",
        wind(camera.azimuth),
        camera.altitude.deg(),
        camera.field_of_view.deg(),
        camera.projection.name(),
        camera.width_px,
        camera.height_px
    )?;
    write_sun(out, night)?;
    write_moon(out, setting, night)?;
    write_planets(out, setting, night)?;
    write_stars(out, setting, night, ledger)
}

fn in_view(object: &LitObject, setting: &Setting) -> bool {
    object.apparent.altitude() >= Angle::ZERO
        && setting
            .camera
            .pixel_from_apparent(object.apparent)
            .is_some_and(|pixel| setting.camera.contains(pixel))
}

/// Where something stands, as one would point at it.
fn where_it_is(object: &LitObject) -> String {
    format!("{} {:.0}°", wind(object.apparent.azimuth()), object.apparent.altitude().deg())
}

fn write_sun(out: &mut dyn Write, night: &Night) -> io::Result<()> {
    let altitude_deg = night.sky.sun.dir.altitude().deg();
    let state = match altitude_deg {
        a if a > 0.0 => "day",
        a if a > -6.0 => "civil twilight",
        a if a > -12.0 => "nautical twilight",
        a if a > -18.0 => "astronomical twilight",
        _ => "night",
    };
    let side = if altitude_deg > 0.0 { "above" } else { "below" };
    writeln!(out, "Sun: {:.1}° {side} the horizon, {state}", altitude_deg.abs())
}

fn write_moon(out: &mut dyn Write, setting: &Setting, night: &Night) -> io::Result<()> {
    let Some(moon) = night.body(Body::Moon) else { return Ok(()) };
    let phase = night.sky.moon.state.phase_angle;
    let lit = 50.0 * (1.0 + phase.cos());
    let place = if moon.apparent.altitude() < Angle::ZERO {
        "below the horizon".to_owned()
    } else if in_view(moon, setting) {
        format!("in view, {}", where_it_is(moon))
    } else {
        format!("out of view, {}", where_it_is(moon))
    };
    writeln!(out, "Moon: {lit:.0} % lit, magnitude {:.1}, {place}", moon.magnitude.0)
}

fn write_planets(out: &mut dyn Write, setting: &Setting, night: &Night) -> io::Result<()> {
    let is_planet = |object: &&LitObject| matches!(object.kind, Kind::Body(body) if !matches!(body, Body::Sun | Body::Moon));
    let seen: Vec<String> = night
        .objects
        .iter()
        .filter(is_planet)
        .filter(|object| in_view(object, setting))
        .map(|object| {
            format!("{} ({:.1}, {})", night.label(object), object.magnitude.0, where_it_is(object))
        })
        .collect();
    match seen.is_empty() {
        true => writeln!(out, "Planets in view: none"),
        false => writeln!(out, "Planets in view: {}", seen.join(", ")),
    }
}

fn write_stars(
    out: &mut dyn Write,
    setting: &Setting,
    night: &Night,
    ledger: Option<&Ledger>,
) -> io::Result<()> {
    let camera = &setting.camera;
    let centre = Dir::from_azimuth_altitude(camera.azimuth, camera.altitude);
    let mut stars = night.stars_in(centre, camera.reach(0.0), None);
    stars.retain(|star| in_view(star, setting));
    let number = |star: &LitObject| match star.kind {
        Kind::Star(number) => number,
        Kind::Body(_) | Kind::Satellite(_) => 0,
    };
    stars.sort_by(|a, b| {
        a.magnitude.0.total_cmp(&b.magnitude.0).then_with(|| number(a).cmp(&number(b)))
    });
    let brightest: Vec<String> = stars
        .iter()
        .take(NAMED_STARS)
        .map(|star| format!("{} ({:.1})", night.label(star), star.magnitude.0))
        .collect();
    let drawn = ledger.and_then(|ledger| ledger.of("stars")).map_or(stars.len(), |e| e.drawn);
    match brightest.is_empty() {
        true => writeln!(out, "Stars in view: none"),
        false => writeln!(out, "Stars in view: {drawn} drawn, brightest {}", brightest.join(", ")),
    }
}

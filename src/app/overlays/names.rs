//! Names of what shines: stars, Sun, Moon, planets, moons of Jupiter; and of places on the Moon.

use eframe::egui::Align2;

use super::Sketch;
use super::labels::{AROUND, Label, ON_OR_AROUND, id};
use crate::catalog::Star;
use crate::ephemeris::Body;
use crate::frame::{Apparent, Dir};
use crate::light::night::Kind;
use crate::sky::Target;
use crate::units::{Angle, Magnitude};

const STAR: [u8; 3] = [190, 200, 220];
const PLANET: [u8; 3] = [240, 200, 130];
const PLACE: [u8; 3] = [235, 215, 170];
/// What is selected is named before anything else.
const SELECTED: f32 = -100.0;
/// In a field of 60 degrees letters are given to stars no fainter than this.
const AT_60_DEG: f64 = 2.6;
/// Stars with a name of their own may be fainter by this.
const OWN_NAME: f64 = 1.0;
/// Stars come first by light, from here.
const STAR_RANK: f32 = 0.0;
/// Days in a Julian year, which proper motions count.
const JULIAN_YEAR_DAYS: f64 = 365.25;
/// Apparent places of stars are off their cells' by refraction, radians.
const BENT_RAD: f64 = 0.02;
/// Uranus, Neptune and Pluto are named in narrow fields: magnitude and field, degrees.
const FAINT_PLANETS: [(f64, f64); 3] = [(5.0, 360.0), (7.0, 40.0), (99.0, 12.0)];
/// Names of moons apart by less, points, would hide them.
const APART_POINTS: f32 = 10.0;
/// From this width of the Moon on, points, its places are named.
const MOON_POINTS: f64 = 150.0;
/// A place is named when it is as large as this, points.
const PLACE_POINTS: f64 = 11.0;

/// Draws what is switched on.
pub fn draw(sketch: &mut Sketch) {
    if sketch.on.star_names && sketch.layers.stars {
        stars(sketch);
    }
    if sketch.on.planet_names {
        bodies(sketch);
    }
    if sketch.on.moon_features && sketch.layers.moon {
        places_on_moon(sketch);
    }
}

fn stars(sketch: &mut Sketch) {
    let night = sketch.night;
    let by_field = AT_60_DEG + 4.5 * (60.0 / sketch.field_deg()).log10();
    let seen = sketch.faintest_seen.min(sketch.layers.magnitude_limit.unwrap_or(f64::INFINITY));
    let with_letters = by_field.min(seen);
    let limit = Magnitude((by_field + OWN_NAME).min(seen));
    let years = night.sky.instant.tdb.days_since_j2000() / JULIAN_YEAR_DAYS;
    for cell in night.stars.cells() {
        let axis: Dir<Apparent> =
            Dir::from_vector((night.sky.horizon_from_icrs * cell.axis()).vector());
        if !sketch.picture.may_hold(axis, cell.radius(years).rad() + BENT_RAD) {
            continue;
        }
        let count = night.stars.bright(cell, Some(limit));
        for (number, motion) in night.stars.brightest(cell, count) {
            let star = &night.stars[number];
            let v = star.magnitude.0;
            let Some(text) = short_name(star, v <= with_letters) else { continue };
            let seen = sketch.seen(night.sky.star(motion));
            let Some(at) = sketch.point(seen) else { continue };
            let own = star.name.is_some();
            let is_selected = sketch.is_selected(&Target::Star { hr: star.hr });
            sketch.labels.push(Label {
                id: id(("star", star.hr)),
                text: text.to_owned(),
                at,
                gap: 5.0 + (3.0 - v).clamp(0.0, 4.0) as f32,
                places: AROUND,
                size: if own { 12.0 } else { 11.0 },
                spacing: 0.0,
                colour: STAR,
                opacity: if own { 0.95 } else { 0.8 },
                rank: match is_selected {
                    true => SELECTED,
                    false => STAR_RANK + (v - if own { OWN_NAME } else { 0.0 }) as f32,
                },
            });
        }
    }
}

/// Its own name; else, if it may, the letter of Bayer or the number of Flamsteed.
fn short_name(star: &Star, may_have_letter: bool) -> Option<&str> {
    let letter = || star.designation.as_ref().or(star.flamsteed.as_ref());
    match (&star.name, may_have_letter) {
        (Some(name), _) => Some(name),
        (None, true) => letter()?.split(' ').next(),
        (None, false) => None,
    }
}

fn bodies(sketch: &mut Sketch) {
    let night = sketch.night;
    let mut moons = Vec::new();
    for object in &night.objects {
        let (target, angular_radius, name) = match object.kind {
            Kind::Body(body) => {
                let is_drawn = match body {
                    Body::Sun => sketch.layers.sun,
                    Body::Moon => sketch.layers.moon,
                    _ => sketch.layers.planets,
                };
                let Some(state) = night.sky.body(body).filter(|_| is_drawn) else { continue };
                (Target::Body(body), state.angular_radius, body.name())
            }
            Kind::Satellite(moon) => {
                let Some(state) = night.sky.satellite(moon) else { continue };
                if !sketch.layers.planets || state.share_seen == 0.0 {
                    continue;
                }
                (Target::Satellite(moon), state.angular_radius, moon.name())
            }
            Kind::Star(_) => continue,
        };
        let is_selected = sketch.is_selected(&target);
        let is_light = matches!(target, Target::Body(Body::Sun | Body::Moon));
        let v = object.magnitude.0;
        let is_wanted = match target {
            Target::Body(_) if is_light => true,
            Target::Body(_) => FAINT_PLANETS
                .iter()
                .any(|&(faintest, widest)| v < faintest && sketch.field_deg() < widest),
            _ => true,
        };
        if !is_wanted && !is_selected {
            continue;
        }
        let Some(at) = sketch.point(object.apparent) else { continue };
        let radius = (angular_radius.rad() * sketch.points_per_rad()) as f32;
        let is_moon = matches!(target, Target::Satellite(_));
        let label = Label {
            id: id(&target),
            text: name.to_owned(),
            at,
            gap: 6.0 + radius.min(2000.0),
            places: AROUND,
            size: if is_moon { 11.0 } else { 13.0 },
            spacing: 0.0,
            colour: PLANET,
            opacity: 1.0,
            rank: match (is_selected, is_light) {
                (true, _) => SELECTED,
                (false, true) => -20.0,
                (false, false) => -12.0 + 0.1 * v as f32,
            },
        };
        match is_moon {
            true => moons.push(label),
            false => sketch.labels.push(label),
        }
    }
    let jupiter = night.body(Body::Jupiter).and_then(|jupiter| sketch.point(jupiter.apparent));
    for moon in moons.iter().filter(|moon| moon.rank > SELECTED) {
        let is_apart = |other: eframe::egui::Pos2| moon.at.distance(other) > APART_POINTS;
        let others = moons.iter().filter(|other| other.id != moon.id);
        if jupiter.is_none_or(is_apart) && others.map(|other| other.at).all(is_apart) {
            // Below the disc of Jupiter there is room.
            sketch.labels.push(Label { places: BELOW_FIRST, rank: -5.0, ..moon.clone() });
        }
    }
    sketch.labels.extend(moons.into_iter().filter(|moon| moon.rank <= SELECTED));
}

/// The moons of Jupiter stand in a row.
const BELOW_FIRST: &[Align2] =
    &[Align2::CENTER_TOP, Align2::CENTER_BOTTOM, Align2::LEFT_CENTER, Align2::RIGHT_CENTER];

fn places_on_moon(sketch: &mut Sketch) {
    let night = sketch.night;
    let moon = &night.sky.moon.state;
    let points_per_km = sketch.points_per_rad() / moon.distance_km;
    let width = 2.0 * moon.angular_radius.rad() * sketch.points_per_rad();
    let seen = sketch.seen(moon.dir);
    if width < MOON_POINTS || !sketch.picture.may_hold(seen, 2.0 * moon.angular_radius.rad()) {
        return;
    }
    for feature in &night.moon_features {
        let across = feature.diameter_km * points_per_km;
        let target = Target::MoonFeature(feature.name.clone());
        let is_selected = sketch.is_selected(&target);
        // Landing sites have no size, and are named near by.
        let is_site = feature.diameter_km == 0.0 && width > 8.0 * MOON_POINTS;
        if across < PLACE_POINTS && !is_site && !is_selected {
            continue;
        }
        let (point, seen) = night.on_moon(feature);
        if point.observer_altitude < Angle::from_deg(6.0) {
            continue;
        }
        let Some(at) = sketch.point(seen) else { continue };
        let is_wide = feature.kind == "sea" || across > 90.0;
        sketch.labels.push(Label {
            id: id(&target),
            text: feature.name.clone(),
            at,
            gap: (0.5 * across as f32).min(60.0) + 3.0,
            places: if is_wide { ON_OR_AROUND } else { AROUND },
            size: (8.0 + across.max(1.0).ln()).clamp(9.5, 14.0) as f32,
            spacing: if feature.kind == "sea" { 1.5 } else { 0.0 },
            colour: PLACE,
            opacity: 0.95,
            rank: if is_selected { SELECTED } else { -1.0 - 0.001 * feature.diameter_km as f32 },
        });
    }
}

//! Where the observer stands: search, a map to click, coordinates, and places that are kept.

mod map;

use eframe::egui::{Context, ScrollArea, TextEdit, Ui};

use crate::app::action::Action;
use crate::app::data::Places;
use crate::background::Background;
use crate::place::gazetteer::{City, Gazetteer};
use crate::place::{HEIGHT_RANGE_M, Place};
use crate::scene::ScenePlace;

use super::Desk;
use super::typed::{Change, Field, Typed, named_button};
use map::Map;

/// So many places are listed.
const LISTED: usize = 12;
/// A town so near lends its clock and its height.
const NEAR_KM: f64 = 500.0;
/// A step of an arrow key: degrees, and metres.
const STEP_DEG: f64 = 0.1;
const STEP_M: f64 = 10.0;

/// The panel, with what is typed into it.
#[derive(Default)]
pub struct PlacePanel {
    query: String,
    finder: Option<Finder>,
    typed: Typed,
    map: Map,
}

/// Looks places up beside the window; answers are numbers of towns in the list.
type Finder = Background<String, Result<Vec<usize>, String>>;

impl PlacePanel {
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        ui.set_max_width(map::SIZE.x);
        self.search(ui, desk);
        ui.separator();
        let sun = desk.shown.map(|shown| (&shown.setting.place, shown.night.sky.sun.dir));
        let known = desk.data.places.known();
        let towns = known.and_then(Result::ok);
        if let Some([longitude_deg, latitude_deg]) =
            self.map.show(ui, towns, &desk.model.place, sun)
        {
            let there = ScenePlace {
                name: None,
                latitude_deg,
                longitude_deg,
                height_m: 0.0,
                time_zone: None,
            };
            desk.actions.push(Action::GoTo(furnished(there, towns, true)));
        }
        self.coordinates(ui, desk, towns);
        self.typed.say(ui);
        ui.separator();
        favourites(ui, desk);
    }

    fn search(&mut self, ui: &mut Ui, desk: &mut Desk) {
        ui.horizontal(|ui| {
            let label = ui.label("Search");
            let edit = TextEdit::singleline(&mut self.query).hint_text("Flagstaff; Paris, France");
            ui.add(edit.desired_width(260.0)).labelled_by(label.id);
        });
        let finder = self.finder.get_or_insert_with(|| finder(ui.ctx(), &desk.data.places));
        let query = self.query.trim();
        let latest = finder.latest();
        if latest.as_ref().is_none_or(|latest| latest.0 != query) {
            finder.ask(query.to_owned());
        }
        let (Some(latest), false) = (latest, query.is_empty()) else { return };
        let found = match &latest.1 {
            Ok(found) => found,
            Err(words) => {
                ui.label(words);
                return;
            }
        };
        let Some(Ok(gazetteer)) = desk.data.places.known() else { return };
        if found.is_empty() {
            ui.label(format!("No place is called '{}'; try another spelling.", latest.0));
        }
        ScrollArea::vertical().max_height(150.0).show(ui, |ui| {
            for city in found.iter().filter_map(|index| gazetteer.cities().get(*index)) {
                let country = city.country().unwrap_or(&city.region);
                let height = city.elevation_m.map_or(String::new(), |m| format!(", {m:.0} m"));
                let words = format!("{}, {country}{height}", city.label());
                if ui.button(words).clicked() {
                    desk.actions.extend(of_city(city).map(Action::GoTo));
                }
            }
        });
    }

    fn coordinates(&mut self, ui: &mut Ui, desk: &mut Desk, towns: Option<&Gazetteer>) {
        let here = desk.model.place.clone();
        let name = here.name.clone().unwrap_or_else(|| coordinates_in_words(&here));
        ui.strong(name);
        let latitude = format!("{:.4}", here.latitude_deg);
        let longitude = format!("{:.4}", here.longitude_deg);
        let height = format!("{:.0}", here.height_m);
        ui.horizontal_wrapped(|ui| {
            let field = Field { label: "Latitude", shown: &latitude, width: 70.0 };
            let read = |text: &str| read_degrees(text, ["N", "S"], 90.0);
            let changed = self.typed.field(ui, &field, read);
            if let Some(deg) = changed_to(changed, here.latitude_deg, STEP_DEG) {
                let latitude_deg = deg.clamp(-90.0, 90.0);
                let there = ScenePlace { latitude_deg, ..here.clone() };
                desk.actions.push(Action::GoTo(furnished(there, towns, false)));
            }
            let field = Field { label: "Longitude", shown: &longitude, width: 70.0 };
            let read = |text: &str| read_degrees(text, ["E", "W"], 360.0);
            let changed = self.typed.field(ui, &field, read);
            if let Some(deg) = changed_to(changed, here.longitude_deg, STEP_DEG) {
                let longitude_deg = (deg + 180.0).rem_euclid(360.0) - 180.0;
                let there = ScenePlace { longitude_deg, ..here.clone() };
                desk.actions.push(Action::GoTo(furnished(there, towns, false)));
            }
            let field = Field { label: "Elevation (m)", shown: &height, width: 50.0 };
            let changed = self.typed.field(ui, &field, read_height);
            if let Some(height_m) = changed_to(changed, here.height_m, STEP_M) {
                let height_m = height_m.clamp(*HEIGHT_RANGE_M.start(), *HEIGHT_RANGE_M.end());
                desk.actions.push(Action::GoTo(ScenePlace { height_m, ..here.clone() }));
            }
        });
        ui.horizontal(|ui| {
            let shown = here.time_zone.clone().unwrap_or_default();
            let field = Field { label: "Time zone", shown: &shown, width: 160.0 };
            if let Some(Change::Taken(zone)) = self.typed.field(ui, &field, read_zone) {
                desk.actions.push(Action::GoTo(ScenePlace { time_zone: zone, ..here.clone() }));
            }
        });
    }
}

fn finder(ctx: &Context, places: &Places) -> Finder {
    let (wake, places) = (ctx.clone(), places.clone());
    Background::new(move |query: &String, _| {
        let found = places.read().map_err(str::to_owned).map(|gazetteer| {
            let cities = gazetteer.cities();
            let index = |city: &City| cities.iter().position(|other| std::ptr::eq(other, city));
            match query.is_empty() {
                true => Vec::new(),
                false => gazetteer.search(query, LISTED).into_iter().filter_map(index).collect(),
            }
        });
        wake.request_repaint();
        Some(found)
    })
}

fn changed_to(change: Option<Change<f64>>, from: f64, step: f64) -> Option<f64> {
    match change? {
        Change::Taken(value) => Some(value),
        Change::Stepped(many) => Some(from + step * f64::from(many)),
    }
}

/// A town as scenes have it.
pub fn of_city(city: &City) -> Option<ScenePlace> {
    let Place { name, latitude, longitude, height_m, time_zone } = city.place().ok()?;
    Some(ScenePlace {
        name,
        latitude_deg: latitude.deg(),
        longitude_deg: longitude.deg(),
        height_m,
        time_zone: time_zone.map(|zone| zone.name().to_owned()),
    })
}

/// A place with a name of its coordinates, and the time zone of the nearest town; with its height too
/// where none is given. Far from all towns the zone is that of the longitude.
pub fn furnished(place: ScenePlace, towns: Option<&Gazetteer>, takes_height: bool) -> ScenePlace {
    let at = Place::new(place.latitude_deg, place.longitude_deg, 0.0).ok();
    let nearest = |has: &dyn Fn(&City) -> bool| {
        let around = towns?.around(at.as_ref()?, NEAR_KM);
        let near = around.filter(|town| has(town.city));
        let by_distance = near.min_by(|a, b| a.distance_km.total_cmp(&b.distance_km));
        by_distance.map(|town| (town.city.elevation_m, town.city.time_zone))
    };
    let zone = nearest(&|city| city.time_zone.is_some()).and_then(|(_, zone)| zone);
    let height_m = nearest(&|city| city.elevation_m.is_some()).and_then(|(height_m, _)| height_m);
    ScenePlace {
        name: Some(coordinates_in_words(&place)),
        height_m: if takes_height { height_m.unwrap_or(0.0) } else { place.height_m },
        time_zone: Some(match zone {
            Some(zone) => zone.name().to_owned(),
            None => zone_of_longitude(place.longitude_deg),
        }),
        ..place
    }
}

/// The clock of ships: a whole hour for each 15 degrees. Its names count westwards.
fn zone_of_longitude(longitude_deg: f64) -> String {
    let east = ((longitude_deg + 180.0).rem_euclid(360.0) - 180.0) / 15.0;
    match east.round() as i32 {
        0 => "Etc/GMT".to_owned(),
        hours => format!("Etc/GMT{:+}", -hours),
    }
}

/// `35.2° N 111.7° W`.
pub fn coordinates_in_words(place: &ScenePlace) -> String {
    let ScenePlace { latitude_deg, longitude_deg, .. } = place;
    let north = if *latitude_deg < 0.0 { 'S' } else { 'N' };
    let east = if *longitude_deg < 0.0 { 'W' } else { 'E' };
    format!("{:.1}° {north} {:.1}° {east}", latitude_deg.abs(), longitude_deg.abs())
}

/// Degrees, or degrees, minutes and seconds, with a sign or a letter: `-111.65`, `111 39 W`.
fn read_degrees(text: &str, [positive, negative]: [&str; 2], most: f64) -> Result<f64, String> {
    let nonsense = || {
        format!(
            "'{}' is no angle; write -35.2, 35.2 {negative} or 35 12 30 {negative}",
            text.trim()
        )
    };
    let plain = text.trim().to_uppercase().replace('\u{2212}', "-").replace(',', ".");
    let (number, letter_sign) = match plain.strip_suffix(negative) {
        Some(rest) => (rest, -1.0),
        None => (plain.strip_suffix(positive).unwrap_or(&plain), 1.0),
    };
    let (number, sign) = match number.trim().strip_prefix('-') {
        Some(rest) => (rest, -letter_sign),
        None => (number.trim(), letter_sign),
    };
    let signs = ['°', '′', '″', '\'', '"', ' '];
    let parts: Vec<f64> = number
        .split(signs)
        .filter(|part| !part.is_empty())
        .map(|part| part.parse().map_err(|_| nonsense()))
        .collect::<Result<_, _>>()?;
    let is_sound = (1..=3).contains(&parts.len())
        && parts.iter().all(|part| *part >= 0.0)
        && parts.iter().skip(1).all(|part| *part < 60.0);
    let deg: f64 = parts.iter().zip([1.0, 60.0, 3600.0]).map(|(part, share)| part / share).sum();
    match is_sound {
        true if deg <= most => Ok(sign * deg),
        true => Err(format!("{deg}° is more than {most}°; write fewer degrees")),
        false => Err(nonsense()),
    }
}

fn read_height(text: &str) -> Result<f64, String> {
    let plain = text.trim().trim_end_matches('m').trim().replace('\u{2212}', "-");
    let nonsense = || format!("'{}' is no height; write metres above the sea", text.trim());
    let height_m: f64 = plain.replace(',', ".").parse().map_err(|_| nonsense())?;
    Place::new(0.0, 0.0, height_m).map(|place| place.height_m).map_err(|error| error.to_string())
}

/// A time zone by its name; none for nothing written.
fn read_zone(text: &str) -> Result<Option<String>, String> {
    let name = text.trim();
    if name.is_empty() {
        return Ok(None);
    }
    let unknown = || format!("Time zone '{name}' is not known; write one like America/Phoenix");
    let zone: chrono_tz::Tz = name.parse().map_err(|_| unknown())?;
    Ok(Some(zone.name().to_owned()))
}

fn favourites(ui: &mut Ui, desk: &mut Desk) {
    let here = &desk.model.place;
    ui.horizontal(|ui| {
        ui.strong("Favourites");
        let is_new = !desk.model.favourites.contains(here);
        ui.add_enabled_ui(is_new, |ui| {
            if ui.button("Add this place").clicked() {
                let here = desk.model.place.clone();
                desk.model.favourites.push(here);
            }
        });
    });
    let mut removed = None;
    for (n, place) in desk.model.favourites.iter().enumerate() {
        let name = place.name.clone().unwrap_or_else(|| coordinates_in_words(place));
        ui.horizontal(|ui| {
            let response = ui.button(&name).on_hover_text(coordinates_in_words(place));
            if response.clicked() {
                desk.actions.push(Action::GoTo(place.clone()));
            }
            if named_button(ui, "×", &format!("Remove {name}")).clicked() {
                removed = Some(n);
            }
        });
    }
    if let Some(n) = removed {
        desk.model.favourites.remove(n);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_read_as_people_write_them() {
        let latitude = |text: &str| read_degrees(text, ["N", "S"], 90.0);
        for (text, deg) in [
            ("35.2", 35.2),
            ("-35,2", -35.2),
            ("35.2 S", -35.2),
            ("35° 12′ N", 35.2),
            ("35 12 0 s", -35.2),
        ] {
            assert!((latitude(text).unwrap() - deg).abs() < 1e-12, "{text}");
        }
        for text in ["", "north", "91", "35 60", "1 2 3 4", "NaN", "inf", "35 -2"] {
            assert!(latitude(text).is_err(), "{text}");
        }
    }

    #[test]
    fn ships_keep_the_hour_of_their_longitude() {
        for (deg, zone) in [
            (0.0, "Etc/GMT"),
            (-150.0, "Etc/GMT+10"),
            (91.0, "Etc/GMT-6"),
            (359.0, "Etc/GMT"),
            (-180.0, "Etc/GMT+12"),
        ] {
            assert_eq!(zone_of_longitude(deg), zone);
            assert!(zone.parse::<chrono_tz::Tz>().is_ok(), "{zone}");
        }
    }
}

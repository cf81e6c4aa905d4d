//! What the window was closed on, kept for the next time.
//!
//! The file is TOML with a version. One that cannot be read, or is newer than this program, is set aside
//! under another name; numbers in it that make no sense become those of a new window.

use std::ffi::OsString;
use std::fs::{self, read_to_string};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant as Stopwatch};

use chrono_tz::Tz;
use serde::{Deserialize, Serialize};

use crate::catalog::Catalogs;
use crate::export::OutputFile;
use crate::place::Place;
use crate::place::gazetteer::{City, Gazetteer};
use crate::scene::{Scene, ScenePlace};
use crate::time::{self, Instant};

use super::model::Model;
use super::panels::place::of_city;

/// Names another file than the platform's; empty for none.
pub const FILE_VARIABLE: &str = "NOCTURNE_STATE";
/// Version of the file.
const FORMAT: u32 = 1;
/// No state is so long.
const LONGEST_BYTES: u64 = 4 << 20;
/// What was changed is kept after so long.
const PAUSE: Duration = Duration::from_secs(30);
/// Text may be so small and so large.
const ZOOMS: std::ops::RangeInclusive<f32> = 0.6..=3.0;
/// A picture that a model can always be checked on, pixels.
const SIZE_PX: [u32; 2] = [640, 360];

/// As the file has it.
#[derive(Deserialize)]
struct Kept {
    model: Model,
}

/// The same, to be written.
#[derive(Serialize)]
struct Keeping<'a> {
    nocturne_window: u32,
    model: &'a Model,
}

/// The version alone, which is read first.
#[derive(Deserialize)]
struct Version {
    nocturne_window: u32,
}

/// Where the state is kept.
pub struct StateFile {
    path: Option<PathBuf>,
    /// What the file has.
    kept: Option<Model>,
    next: Stopwatch,
    writing: Option<JoinHandle<Result<(), String>>>,
}

impl StateFile {
    /// In a file; without one, nowhere.
    pub fn at(path: Option<PathBuf>) -> StateFile {
        StateFile { path, kept: None, next: Stopwatch::now() + PAUSE, writing: None }
    }

    /// In the user's folder for such things, or where `NOCTURNE_STATE` says.
    pub fn standard() -> StateFile {
        StateFile::at(StateFile::standard_path())
    }

    pub fn standard_path() -> Option<PathBuf> {
        match std::env::var_os(FILE_VARIABLE) {
            Some(named) => Some(PathBuf::from(named)).filter(|path| !path.as_os_str().is_empty()),
            None => dirs::state_dir()
                .or_else(dirs::config_dir)
                .map(|folder| folder.join("nocturne").join("window.toml")),
        }
    }

    /// What was kept; and a sentence if something was wrong with it. Without a file it is the first run.
    pub fn load(&self, catalogs: &Catalogs) -> (Model, Option<String>) {
        let first = || first_model(catalogs, iana_time_zone::get_timezone().ok().as_deref());
        let Some(path) = &self.path else { return (first(), None) };
        match read(path) {
            Ok(Some(model)) => (sound(model), None),
            Ok(None) => (first(), None),
            Err(Fault::Damaged(why)) => {
                let words = match set_aside(path) {
                    Ok(aside) => format!(
                        "The state of the window was not readable ({why}); it is kept as {}.",
                        aside.display()
                    ),
                    Err(error) => format!(
                        "The state of the window in {} is not readable ({why}), nor could it be set \
                         aside: {error}.",
                        path.display()
                    ),
                };
                (first(), Some(words))
            }
            Err(Fault::Unreachable(error)) => {
                let path = path.display();
                (first(), Some(format!("The state of the window in {path} was not read: {error}.")))
            }
        }
    }

    /// Keeps what has changed, now and then, beside the window. Gives how long it should be called again
    /// at the latest, if something waits; and a sentence when it could not be written.
    pub fn keep(&mut self, model: &Model) -> (Option<Duration>, Option<String>) {
        let Some(path) = self.path.clone() else { return (None, None) };
        let mut words = None;
        if self.writing.as_ref().is_some_and(JoinHandle::is_finished) {
            words = self.finish().err();
        }
        let is_kept = self.kept.as_ref().is_some_and(|kept| {
            // The clock alone is no reason to write.
            Model { clock: kept.clock, ..model.clone() } == *kept
        });
        if is_kept {
            return (None, words);
        }
        let now = Stopwatch::now();
        if now < self.next || self.writing.is_some() {
            let left = self.next.saturating_duration_since(now).max(Duration::from_secs(1));
            return (Some(left), words);
        }
        self.next = now + PAUSE;
        self.kept = Some(model.clone());
        let text = text(model);
        self.writing = Some(thread::spawn(move || text.and_then(|text| write(&path, &text))));
        (None, words)
    }

    /// Keeps it now. The error is a sentence.
    pub fn save(&mut self, model: &Model) -> Result<(), String> {
        // What was begun earlier must not end later.
        self.finish().ok();
        let Some(path) = &self.path else { return Ok(()) };
        self.kept = Some(model.clone());
        write(path, &text(model)?)
    }

    fn finish(&mut self) -> Result<(), String> {
        let failed = || "Writing the state of the window broke off.".to_owned();
        self.writing.take().map_or(Ok(()), |writing| writing.join().map_err(|_| failed())?)
    }
}

/// The window of somebody who has never opened it: the largest town of the time zone, now.
pub fn first_model(catalogs: &Catalogs, zone: Option<&str>) -> Model {
    let place = || {
        let zone: Tz = zone?.parse().ok()?;
        // Machines without a place keep universal time.
        if ["UTC", "UCT", "GMT", "Zulu"].iter().any(|name| zone.name().ends_with(name)) {
            return None;
        }
        let gazetteer = Gazetteer::parse(&catalogs.places_text().ok()?).ok()?;
        of_city(largest(&gazetteer, zone)?)
    };
    let usual = Model::default();
    Model { place: place().unwrap_or_else(|| usual.place.clone()), ..usual }
}

/// The largest town whose clocks are of a zone; else, for another name of a zone, whose clocks show the
/// same in January and in July.
fn largest(gazetteer: &Gazetteer, zone: Tz) -> Option<&City> {
    let cities = gazetteer.cities();
    let most = |is_it: &dyn Fn(Tz) -> bool| {
        let there = cities.iter().filter(|city| city.time_zone.is_some_and(is_it));
        there.max_by_key(|city| city.population)
    };
    let instants: Vec<Instant> = ["2026-01-15", "2026-07-15"]
        .into_iter()
        .filter_map(|day| time::to_instant(&time::parse(day).ok()?, None).ok())
        .collect();
    let offsets = |zone: Tz| -> Vec<i32> {
        instants.iter().map(|instant| instant.to_local(zone).offset_s).collect()
    };
    let wanted = offsets(zone);
    most(&|other| other == zone).or_else(|| most(&|other| offsets(other) == wanted))
}

/// Why there is no state.
enum Fault {
    /// The file is there, and is nonsense.
    Damaged(String),
    /// Nobody knows what is in it.
    Unreachable(io::Error),
}

fn read(path: &Path) -> Result<Option<Model>, Fault> {
    match path.metadata() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(Fault::Unreachable(error)),
        Ok(known) if known.is_file() && known.len() > LONGEST_BYTES => {
            return Err(Fault::Damaged("it is much too long".to_owned()));
        }
        Ok(_) => {}
    }
    let text = read_to_string(path).map_err(|error| match error.kind() {
        io::ErrorKind::InvalidData => Fault::Damaged("it is no text".to_owned()),
        _ => Fault::Unreachable(error),
    })?;
    let damaged = |error: toml::de::Error| {
        let message = error.message().lines().collect::<Vec<_>>().join("; ");
        Fault::Damaged(message)
    };
    let version: Version = toml::from_str(&text).map_err(damaged)?;
    if version.nocturne_window != FORMAT {
        let version = version.nocturne_window;
        return Err(Fault::Damaged(format!(
            "its version is {version}, and this program reads {FORMAT}"
        )));
    }
    let Kept { model } = toml::from_str(&text).map_err(damaged)?;
    Ok(Some(model))
}

/// Gives the file another name that is free, and says which.
fn set_aside(path: &Path) -> io::Result<PathBuf> {
    let named = |number: u32| {
        let mut name = OsString::from(path);
        name.push(".damaged");
        if number > 1 {
            name.push(format!(".{number}"));
        }
        PathBuf::from(name)
    };
    let free = (1..1000).map(named).find(|aside| !aside.exists()).unwrap_or_else(|| named(1000));
    fs::rename(path, &free)?;
    Ok(free)
}

fn text(model: &Model) -> Result<String, String> {
    let kept = Keeping { nocturne_window: FORMAT, model };
    let body = toml::to_string(&kept)
        .map_err(|error| format!("The state of the window cannot be written: {error}."))?;
    Ok(format!("# The state of the window of Nocturne, written when it changes.\n\n{body}"))
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    let words =
        |error: &dyn std::fmt::Display| format!("The state of the window is not kept: {error}");
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(|error| words(&error))?;
    }
    let file = OutputFile::create(path).map_err(|error| words(&error))?;
    file.write(|file| file.write_all(text.as_bytes())).map_err(|error| words(&error))
}

/// The model with every value that a scene would refuse as in a new window.
fn sound(read: Model) -> Model {
    let usual = Model::default();
    let is_sound = |model: &Model| {
        // Only what is used is checked.
        let scene = Scene { photo: Some(model.photo), ..model.scene(SIZE_PX) };
        scene.setting().is_ok()
    };
    let mut model = Model {
        clock: read.clock,
        favourites: read.favourites.into_iter().filter(is_a_place).collect(),
        overlays: read.overlays,
        moon: read.moon,
        uses_camera: read.uses_camera,
        selected: read.selected,
        panels: read.panels,
        zoom: if read.zoom.is_finite() {
            read.zoom.clamp(*ZOOMS.start(), *ZOOMS.end())
        } else {
            usual.zoom
        },
        ..usual
    };
    // Each part is tried on a model that is sound, the place first: what air there is depends on it.
    let mut keep = |change: &dyn Fn(&mut Model)| {
        let mut tried = model.clone();
        change(&mut tried);
        if is_sound(&tried) {
            model = tried;
        }
    };
    keep(&|model| model.place = read.place.clone());
    keep(&|model| {
        model.view = read.view.clone();
        // Brings it into its bounds.
        model.view.set_projection(read.view.projection);
    });
    keep(&|model| model.layers = read.layers.clone());
    keep(&|model| model.sky = read.sky);
    keep(&|model| model.scintillation = read.scintillation);
    keep(&|model| model.night = read.night);
    keep(&|model| model.air = read.air.clone());
    keep(&|model| model.eye = read.eye.clone());
    keep(&|model| model.photo = read.photo);
    keep(&|model| model.display = read.display);
    model
}

fn is_a_place(place: &ScenePlace) -> bool {
    let has_zone = place.time_zone.as_ref().is_none_or(|name| name.parse::<Tz>().is_ok());
    has_zone && Place::new(place.latitude_deg, place.longitude_deg, place.height_m).is_ok()
}

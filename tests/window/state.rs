//! What the window keeps between two runs.

use std::fs;
use std::path::Path;

use nocturne::app::clock::Clock;
use nocturne::app::model::{Model, Panel};
use nocturne::app::state::{StateFile, first_model};
use nocturne::catalog::Catalogs;
use nocturne::sky::Target;
use nocturne::time;

fn catalogs() -> Catalogs {
    Catalogs::locate(None).unwrap()
}

fn at(path: &Path) -> StateFile {
    StateFile::at(Some(path.to_owned()))
}

/// A model that differs from a new one in every part.
fn changed() -> Model {
    let evening = time::to_instant(&time::parse("-0584-05-28T14:00Z").unwrap(), None).unwrap();
    let mut model = first_model(&catalogs(), Some("Asia/Tokyo"));
    model.clock = Clock { rate: -3600.0, is_playing: true, ..Clock::at(evening) };
    model.favourites = vec![Model::default().place];
    model.view.set_field(12.5);
    model.view.follow = Some(Target::Star { hr: 2491 });
    model.layers.magnitude_limit = Some(5.5);
    model.overlays.constellation_lines = true;
    model.eye.adaptation_cd_m2 = Some(0.01);
    model.uses_camera = true;
    model.display.red = true;
    model.selected = Some("Jupiter/Io".parse().unwrap());
    model.panels.set(Panel::Layers, true);
    model.zoom = 1.25;
    model
}

#[test]
fn a_model_survives_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deep").join("window.toml");
    let model = changed();
    at(&path).save(&model).unwrap();
    assert_eq!(at(&path).load(&catalogs()), (model, None));
    // Written over, and nothing else is left in the folder.
    at(&path).save(&Model { clock: changed().clock, ..Model::default() }).unwrap();
    let (model, words) = at(&path).load(&catalogs());
    assert_eq!(words, None);
    assert_eq!(model, Model { clock: changed().clock, ..Model::default() });
    assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
}

#[test]
fn damaged_and_newer_files_are_set_aside() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("window.toml");
    at(&path).save(&changed()).unwrap();
    let good = fs::read_to_string(&path).unwrap();
    let newer = good.replace("nocturne_window = 1", "nocturne_window = 2");
    let misspelt = good.replace("Asia/Tokyo\"", "Asia/Tokyo");
    let broken: [&[u8]; 5] = [b"", b"[[[", b"\xff\xfe\x00", newer.as_bytes(), misspelt.as_bytes()];
    for (n, content) in broken.into_iter().enumerate() {
        fs::write(&path, content).unwrap();
        let (model, words) = at(&path).load(&catalogs());
        let words = words.expect("a sentence");
        assert!(words.contains("window.toml.damaged"), "{words}");
        assert!(model.clock.is_live && !path.exists());
        let number = if n == 0 { String::new() } else { format!(".{}", n + 1) };
        let aside = folder.path().join(format!("window.toml.damaged{number}"));
        assert_eq!(fs::read(aside).unwrap(), content);
    }
    // A folder in its place is no crash either.
    fs::create_dir(&path).unwrap();
    assert!(at(&path).load(&catalogs()).1.is_some());
    assert!(at(&path).save(&changed()).is_err());
}

#[test]
fn numbers_without_sense_become_those_of_a_new_window() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("window.toml");
    at(&path).save(&changed()).unwrap();
    let good = fs::read_to_string(&path).unwrap();
    let latitude = format!("latitude_deg = {}", changed().place.latitude_deg);
    for (from, to) in [
        (latitude.as_str(), "latitude_deg = 135.0"),
        ("field_deg = 12.5", "field_deg = nan"),
        ("zoom = 1.25", "zoom = inf"),
        ("adaptation_cd_m2 = 0.01", "adaptation_cd_m2 = -1.0"),
    ] {
        assert!(good.contains(from), "{from} in {good}");
        fs::write(&path, good.replace(from, to)).unwrap();
        let (model, words) = at(&path).load(&catalogs());
        assert_eq!(words, None, "{to}");
        assert!(model.scene([640, 360]).setting().is_ok(), "{to}");
        assert!(model.zoom.is_finite() && model.view.field_deg > 0.0, "{to}");
        // The rest is as it was.
        assert_eq!((model.overlays, model.clock), (changed().overlays, changed().clock));
        assert_eq!(model.layers, changed().layers, "{to}");
    }
}

#[test]
fn the_first_run_is_at_the_largest_town_of_the_time_zone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("window.toml");
    let (model, words) = at(&path).load(&catalogs());
    assert!(words.is_none() && model.clock.is_live && !path.exists());
    let name = |zone: Option<&str>| first_model(&catalogs(), zone).place.name.unwrap();
    assert_eq!(name(Some("America/Phoenix")), "Phoenix");
    assert_eq!(name(Some("Europe/Berlin")), "Berlin");
    // Another name of the same zone.
    assert_eq!(name(Some("US/Arizona")), "Phoenix");
    for nothing in [None, Some("Mars/Olympus"), Some("Etc/UTC"), Some("")] {
        assert_eq!(name(nothing), "Greenwich");
    }
}

//! Scene files that make no sense are refused by name, with the line or the value.

use std::sync::OnceLock;

use libtest_mimic::Trial;

use super::harness::{DARK, IMPOSSIBLE, NONSENSE, nocturne, trial, words};

/// Key, what is written instead of its value, and what the sentence must say.
const VALUES: [(&str, &str, &[&str]); 22] = [
    ("nocturne_scene", "7", &["nocturne_scene is 7", "version 2"]),
    ("nocturne_scene", "-1", &["line ", "-1"]),
    ("utc", "\"garbage\"", &["'garbage'", "2026-08-12"]),
    ("utc", "\"5000-01-01T00:00Z\"", &["year 5000", "-4000 to 4000"]),
    ("utc", "\"2026-02-30T00:00Z\"", &["2026-02 has 28 days"]),
    ("utc", "17", &["line ", "string"]),
    ("latitude_deg", "nan", &["latitude NaN°", "-90° to +90°"]),
    ("latitude_deg", "-90.5", &["latitude -90.5°", "-90° to +90°"]),
    ("latitude_deg", "\"north\"", &["line ", "north", "f64"]),
    ("longitude_deg", "inf", &["longitude inf°", "+360°"]),
    ("height_m", "nan", &["height NaN m", "-430 to 100000"]),
    ("time_zone", "\"Mars/Olympus\"", &["'Mars/Olympus'", "America/Phoenix"]),
    ("azimuth_deg", "nan", &["direction of view NaN°", "360°"]),
    ("altitude_deg", "91", &["altitude of view 91°", "-90° to 90°"]),
    ("roll_deg", "nan", &["roll NaN°", "360°"]),
    ("field_of_view_deg", "nan", &["field of view NaN°", "0.00028° to 340°"]),
    ("projection", "\"mercator\"", &["line ", "mercator", "stereographic"]),
    ("width_px", "0", &["size 0x", "1x1 to 16384x16384"]),
    ("width_px", "-3", &["line ", "-3"]),
    ("albedo", "nan", &["ground.albedo is NaN", "0 to 1"]),
    ("column_du", "1e9", &["ozone.column_du is 1000000000", "0 to 1000"]),
    ("exposure_stops", "nan", &["exposure_stops is NaN", "-40 to 40"]),
];

/// Lines put at the head of the file.
const LINES: [(&str, &str, &[&str]); 5] = [
    ("an_unknown_key", "exposure = 3", &["line 1", "exposure"]),
    ("a_key_twice", "utc = \"2026-01-01\"", &["line ", "duplicate key"]),
    ("no_toml", "camera [", &["line 1"]),
    ("tolerance_negative", "tolerance_arcsec = -1", &["tolerance_arcsec is -1", "0 to"]),
    ("tolerance_nan", "tolerance_arcsec = nan", &["tolerance_arcsec is NaN", "0 to"]),
];

pub fn trials() -> Vec<Trial> {
    let mut trials = vec![
        trial("scenes::missing", || {
            let run = nocturne(words("render --scene none.toml -o old.png"));
            run.refused(IMPOSSIBLE, &["--scene none.toml", "No such file", "--save-scene"]);
        }),
        trial("scenes::a_folder", || {
            let run = nocturne(words("render --scene . -o old.png"));
            run.refused(IMPOSSIBLE, &["--scene .", "--save-scene"]);
        }),
        trial("scenes::no_text", || refused(b"\xff\xfe\x00", IMPOSSIBLE, &["UTF-8"])),
        trial("scenes::empty", || refused(b"", NONSENSE, &["nocturne_scene"])),
        trial("scenes::a_key_too_few", || {
            let text = edited("latitude_deg", None);
            refused(text.as_bytes(), NONSENSE, &["line ", "latitude_deg"]);
        }),
        trial("scenes::an_unknown_key_in_a_table", || {
            let text = saved().replace("[eye]", "[eye]\nsunglasses = true");
            refused(text.as_bytes(), NONSENSE, &["line ", "sunglasses"]);
        }),
        trial("scenes::an_altitude_beside_an_object_is_honoured", || {
            let line = "render --at 2026-08-27T23:30-07:00 --place Flagstaff --look Moon \
                --altitude 12.5 --quiet --save-scene scene.toml";
            let run = nocturne(words(line)).done();
            let scene = String::from_utf8(run.read("scene.toml")).unwrap();
            assert!(scene.contains("\naltitude_deg = 12.5\n"), "{scene}");
        }),
        trial("scenes::options_are_checked_too", || {
            let run = nocturne(words("render --scene scene.toml --fov 400 --describe old.json"));
            run.with_file("scene.toml", saved()).refused(NONSENSE, &["field of view 400°"]);
        }),
        trial("scenes::options_change_what_the_file_says", || {
            let line =
                "render --scene scene.toml --quiet --altitude 45 --roll 3 --save-scene new.toml";
            let run = nocturne(words(line)).with_file("scene.toml", saved()).done();
            let new = String::from_utf8(run.read("new.toml")).unwrap();
            let expected = edited("altitude_deg", Some("45.0"));
            assert_eq!(new, expected.replace("roll_deg = 0.0", "roll_deg = 3.0"));
        }),
    ];
    for (key, value, said) in VALUES {
        trials.push(trial(format!("scenes::{key}_is_{}", value.trim_matches('"')), move || {
            refused(edited(key, Some(value)).as_bytes(), NONSENSE, said);
        }));
    }
    for (name, line, said) in LINES {
        trials.push(trial(format!("scenes::{name}"), move || {
            refused(format!("{line}\n{}", saved()).as_bytes(), NONSENSE, said);
        }));
    }
    trials
}

fn refused(scene: &[u8], code: i32, said: &[&str]) {
    let run = nocturne(words("render --scene bad.toml -o old.png --describe old.json"));
    run.with_file("bad.toml", scene).refused(code, &[&["--scene bad.toml"], said].concat());
}

/// A scene as the program writes it.
fn saved() -> &'static str {
    static SAVED: OnceLock<String> = OnceLock::new();
    SAVED.get_or_init(|| {
        let run = nocturne(DARK).and(words("--quiet --save-scene scene.toml")).done();
        String::from_utf8(run.read("scene.toml")).unwrap()
    })
}

/// The scene with another value of a key, or without it.
fn edited(key: &str, value: Option<&str>) -> String {
    let is_of_key = |line: &str| line.starts_with(&format!("{key} = "));
    assert_eq!(saved().lines().filter(|line| is_of_key(line)).count(), 1, "{key}\n{}", saved());
    let edit = |line: &str| match value {
        Some(value) if is_of_key(line) => format!("{key} = {value}\n"),
        None if is_of_key(line) => String::new(),
        _ => format!("{line}\n"),
    };
    saved().lines().map(edit).collect()
}

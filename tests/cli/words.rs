//! What needs no picture: lists, descriptions, help.

use libtest_mimic::Trial;
use serde_json::Value;

#[cfg(feature = "app")]
use super::harness::NONSENSE;
use super::harness::{DARK, IMPOSSIBLE, nocturne, trial, words};

/// Keys of a description that are promised for good.
const TOP_KEYS: [&str; 5] = ["instant_utc", "jd_tt", "place", "camera", "objects"];
const OBJECT_KEYS: [&str; 11] = [
    "name",
    "kind",
    "catalogue",
    "x_px",
    "y_px",
    "azimuth_deg",
    "altitude_deg",
    "apparent_altitude_deg",
    "magnitude_v",
    "illuminance_lx",
    "illuminance_ground_lx",
];
/// Keys of an object whose value is null out of view, and there only.
const IN_VIEW_KEYS: [&str; 3] = ["x_px", "y_px", "pixel_solid_angle_sr"];

pub fn trials() -> Vec<Trial> {
    let mut trials = vec![
        trial("words::a_description_keeps_its_promise", a_description_keeps_its_promise),
        trial("words::every_object_is_described", every_object_is_described),
        trial("words::null_means_out_of_view", null_means_out_of_view),
        trial("words::a_description_on_standard_output_is_not_mixed_with_words", || {
            let run = nocturne(DARK).and(words("--stats --describe -")).run();
            assert_eq!(run.code(), Some(0), "{run}");
            assert!(serde_json::from_str::<Value>(&run.stdout).is_ok(), "{run}");
            assert!(run.stderr.contains("Flagstaff, 2026-08-12T21:30:00-07:00"), "{run}");
        }),
        trial("words::time_without_an_offset_is_the_time_there", local_time),
        trial("words::quiet_says_nothing", || {
            let run = nocturne(DARK).and(words("-q --describe sky.json --save-scene sky.toml"));
            let run = run.done();
            assert_eq!(run.stdout, "");
            assert_eq!(run.files(), ["sky.json", "sky.toml"]);
        }),
        trial("words::place", || {
            let run = nocturne(["place", "Flagstaff"]).done();
            let first = run.stdout.lines().next().unwrap_or_default();
            let said = ["Flagstaff", "Arizona", "35.19", "-111.65", "America/Phoenix"];
            assert!(said.iter().all(|word| first.contains(word)), "{run}");
            let run = nocturne(words("place --limit 3")).done();
            assert_eq!(run.stdout.lines().count(), 3, "{run}");
            assert_eq!(nocturne(words("place --limit 0")).done().stdout, "");
        }),
        trial("words::objects", objects),
        trial("words::tonight_is_dark", || {
            let run = nocturne(words("objects Sun --kind sun --place Flagstaff --at tonight"));
            let run = run.done();
            let sun = run.stdout.lines().nth(1).expect("a line of the Sun");
            let altitude_deg: f64 = words(sun)[3].parse().expect("an altitude");
            assert!(altitude_deg < -14.9, "{run}");
        }),
        trial("words::help_of_everything", help_of_everything),
        trial("words::version", || {
            let run = nocturne(["--version"]).done();
            assert_eq!(run.stdout, format!("nocturne {}\n", env!("CARGO_PKG_VERSION")));
        }),
    ];
    #[cfg(not(feature = "app"))]
    trials.push(trial("words::no_command_gives_help_and_an_error", || {
        let run = nocturne([""; 0]).run();
        assert_eq!(run.code(), Some(2), "{run}");
        assert!(run.stdout.is_empty() && run.stderr.contains("Usage: nocturne"), "{run}");
    }));
    #[cfg(feature = "app")]
    trials.push(trial("words::the_window_refuses_nonsense", || {
        let cases: [(&str, &[&str]); 4] = [
            ("--size 7x7", &["--size", "1280x720"]),
            ("--at tomorrow", &["'tomorrow'", "2026-08-12"]),
            ("--place Xyzzyville", &["Xyzzyville"]),
            ("--full-screen render", &["render"]),
        ];
        for (line, said) in cases {
            nocturne(words(line)).with_variable("NOCTURNE_STATE", "").refused(NONSENSE, said);
        }
    }));
    #[cfg(all(feature = "app", target_os = "linux"))]
    trials.push(trial("words::no_command_opens_a_window_or_says_why_not", || {
        let run = ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "NOCTURNE_STATE"]
            .into_iter()
            .fold(nocturne([""; 0]), |run, variable| run.with_variable(variable, ""));
        run.refused(IMPOSSIBLE, &["no window", "desktop session", "nocturne render"]);
    }));
    #[cfg(target_os = "linux")]
    trials.push(trial("words::without_a_driver_only_pictures_fail", || {
        let without_driver = |line: &str| {
            let run = nocturne(words(line)).with_variable("VK_ICD_FILENAMES", "/nonexistent");
            run.with_variable("VK_DRIVER_FILES", "/nonexistent")
        };
        let said = ["no graphics adapter", "mesa-vulkan-drivers", "libvulkan1"];
        without_driver("adapter").refused(IMPOSSIBLE, &said);
        for output in ["-o old.png", "-o old.exr", "-o new.png --describe old.json"] {
            let line = format!("render --place Flagstaff {output}");
            without_driver(&line).refused(IMPOSSIBLE, &said);
        }
        let run = without_driver("render --place Flagstaff -q --describe sky.json").done();
        assert_eq!(run.files(), ["sky.json"]);
    }));
    trials
}

/// What `--describe` says of a dark sky, with more arguments.
fn description(arguments: &str) -> Value {
    let run = nocturne(DARK).and(words("--quiet --describe -")).and(words(arguments)).done();
    serde_json::from_str(&run.stdout).expect("JSON")
}

fn objects_of(description: &Value) -> &[Value] {
    description["objects"].as_array().expect("an array")
}

fn a_description_keeps_its_promise() {
    let sky = description("--look NW --altitude 20 --fov 60 --size 320x200");
    for key in TOP_KEYS {
        assert!(!sky[key].is_null(), "{key}");
    }
    for object in objects_of(&sky) {
        let object = object.as_object().expect("an object");
        for key in OBJECT_KEYS {
            assert!(object.contains_key(key), "{key} is missing: {object:?}");
        }
    }
    assert_eq!(sky["instant_utc"], "2026-08-13T04:30:00Z");
    // 2026-08-13T04:30 UTC + 37 s (TAI) + 32.184 s.
    let expected = 2_461_265.5 + (4.5 * 3600.0 + 69.184) / 86_400.0;
    assert!((sky["jd_tt"].as_f64().unwrap() - expected).abs() < 1e-8);
    assert_eq!(sky["place"]["name"], "Flagstaff");
    assert_eq!(
        (&sky["camera"]["width_px"], &sky["camera"]["height_px"]),
        (&320.into(), &200.into())
    );
    assert_eq!(sky["camera"]["projection"], "stereographic");
    let near = |key: &str, value: f64| (sky["camera"][key].as_f64().unwrap() - value).abs() < 1e-9;
    assert!(near("azimuth_deg", 315.0) && near("altitude_deg", 20.0), "{}", sky["camera"]);
    assert!(near("field_of_view_deg", 60.0) && near("roll_deg", 0.0), "{}", sky["camera"]);
}

fn every_object_is_described() {
    let sky = description("");
    let of_kind = |kind: &str| -> Vec<&Value> {
        objects_of(&sky).iter().filter(|object| object["kind"] == kind).collect()
    };
    let names = |kind: &str| -> Vec<&str> {
        of_kind(kind).iter().map(|object| object["name"].as_str().unwrap()).collect()
    };
    assert_eq!(names("sun"), ["Sun"]);
    assert_eq!(names("moon"), ["Moon"]);
    let planets = ["Mercury", "Venus", "Mars", "Jupiter", "Saturn", "Uranus", "Neptune", "Pluto"];
    assert_eq!(names("planet"), planets);
    assert_eq!(names("satellite"), ["Io", "Europa", "Ganymede", "Callisto"]);
    let stars = of_kind("star");
    assert_eq!(stars.len(), 9096);
    assert_eq!(objects_of(&sky).len(), 9096 + 14);
    let mut numbers: Vec<_> =
        stars.iter().map(|star| star["catalogue"].as_str().expect("a number")).collect();
    assert!(numbers.iter().all(|number| number.starts_with("HR ")));
    numbers.sort();
    numbers.dedup();
    assert_eq!(numbers.len(), 9096, "stars share numbers");
    let sirius = stars.iter().find(|star| star["catalogue"] == "HR 2491").unwrap();
    assert_eq!(sirius["name"], "Sirius");
    assert!((sirius["magnitude_v"].as_f64().unwrap() + 1.46).abs() < 1e-9);
}

/// A number that is not finite would be null too.
fn null_means_out_of_view() {
    let (width, height) = (640.0, 360.0);
    // South of the zenith, where most of the picture is sky and the rest is ground.
    let sky = description("--look S --altitude 25 --fov 90 --size 640x360");
    let mut seen = 0;
    for object in objects_of(&sky) {
        let number = |key: &str| object[key].as_f64();
        for (key, value) in object.as_object().unwrap() {
            let may_be_null = IN_VIEW_KEYS.contains(&key.as_str())
                || key == "catalogue" && object["kind"] != "star";
            assert!(may_be_null || !value.is_null(), "{key}: {object}");
        }
        let nulls = IN_VIEW_KEYS.iter().filter(|&&key| object[key].is_null()).count();
        assert!(nulls == 0 || nulls == IN_VIEW_KEYS.len(), "{object}");
        let altitude_deg = number("apparent_altitude_deg").unwrap();
        let is_lit = number("illuminance_ground_lx").unwrap() > 0.0;
        // An eye 2 m above the ground sees 2.5 arcminutes below the level.
        let is_up = altitude_deg > -2.5 / 60.0;
        assert!(is_lit == is_up, "light and horizon differ: {object}");
        if let (Some(x), Some(y)) = (number("x_px"), number("y_px")) {
            seen += 1;
            assert!((0.0..width).contains(&x) && (0.0..height).contains(&y), "{object}");
            assert!(is_up, "{object}");
        }
        // Nothing near the middle of the picture is out of view.
        let off_azimuth_deg = (number("azimuth_deg").unwrap() - 180.0).abs();
        if off_azimuth_deg < 20.0 && (10.0..40.0).contains(&altitude_deg) {
            assert!(nulls == 0, "{object}");
        }
    }
    assert!(seen > 500, "{seen} in view");
}

fn local_time() {
    for (at, place, utc) in [
        ("2026-08-12 21:30", "Flagstaff", "2026-08-13T04:30:00Z"),
        ("2026-08-12 21:30", "Denver", "2026-08-13T03:30:00Z"),
        ("2026-01-12 21:30", "Denver", "2026-01-13T04:30:00Z"),
        ("2026-08-12 21:30", "Kathmandu", "2026-08-12T15:45:00Z"),
        ("2026-08-12 21:30-07:00", "Kathmandu", "2026-08-13T04:30:00Z"),
    ] {
        let run =
            nocturne(["render", "--at", at, "--place", place, "-q", "--describe", "-"]).done();
        let sky: Value = serde_json::from_str(&run.stdout).expect("JSON");
        assert_eq!(sky["instant_utc"], utc, "{at} in {place}");
    }
    let line = words("render --lat 35.2 --lon -111.7 -q --describe - --at 2026-08-12T21:30");
    let run = nocturne(line).done();
    let sky: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(sky["instant_utc"], "2026-08-12T21:30:00Z", "no zone is known: UTC");
}

fn objects() {
    let at = words("--place Flagstaff --at 2026-08-12T21:30-07:00");
    let rows = |arguments: &str| {
        let run = nocturne(["objects"]).and(words(arguments)).and(at.iter()).done();
        let mut lines = run.stdout.lines().map(str::to_owned);
        assert!(lines.next().is_some_and(|head| head.starts_with("name ")), "{run}");
        lines.collect::<Vec<_>>()
    };
    assert_eq!(rows("--kind planet").len(), 8);
    assert_eq!(rows("").len(), 9096 + 14);
    assert_eq!(rows("--kind star").len(), 9096);
    let sirius = rows("Sirius");
    assert!(sirius.len() == 1 && sirius[0].contains("HR 2491"), "{sirius:?}");
    // The 21 stars that are called first-magnitude, Toliman (α Cen B) and Adhara (1.50).
    let bright = rows("--kind star --magnitude-limit 1.5");
    assert_eq!(bright.len(), 23, "{bright:?}");
    // Half of the sky is up.
    let up = rows("--up").len() as f64 / 9110.0;
    assert!((0.4..0.6).contains(&up), "{up}");
    // The Sun is down at night: known, and none that is up.
    assert_eq!(rows("Sun --kind sun --up").len(), 0);
}

fn help_of_everything() {
    let run = nocturne(["--help"]).done();
    let commands = run.stdout.split_once("Commands:").expect("a list of commands").1;
    let commands: Vec<String> = commands
        .lines()
        .skip(1)
        .take_while(|line| line.starts_with("  "))
        .filter(|line| !line.starts_with("   "))
        .map(|line| words(line)[0].to_owned())
        .collect();
    for known in ["render", "place", "objects", "adapter", "help"] {
        assert!(commands.iter().any(|command| command == known), "{known}: {commands:?}");
    }
    for command in commands.iter().filter(|command| *command != "help") {
        for line in [[command.as_str(), "--help"], [command.as_str(), "-h"], ["help", command]] {
            let run = nocturne(line).done();
            assert!(run.stdout.contains(&format!("Usage: nocturne {command}")), "{run}");
        }
    }
}

//! Pictures: what is written, what it holds, and that a scene file gives the same one again.

use std::collections::HashMap;

use libtest_mimic::Trial;
use nocturne::export::exr;

use super::harness::{DARK, Machine, nocturne, trial, words};

/// Lines that render a scene each: what it shows, and how.
const SCENES: [(&str, &str); 4] = [
    (
        "day",
        "--at 2026-08-12T15:00-07:00 --place Flagstaff --look SW --altitude 40 --fov 100 \
         --projection equal-area",
    ),
    ("moonlight", "--at 2026-08-27T23:30-07:00 --place Flagstaff --look Moon --fov 60 --roll 7.3"),
    (
        "night",
        "--at 2026-08-12T21:30-07:00 --lat 35.19807 --lon -111.65127 --height 2108 --look S \
         --magnitude-limit 4.7 --tolerance 3.3 --exposure 0.7 --no-marks",
    ),
    ("now", "--at now --place Flagstaff --look zenith --fov 180 --projection equidistant"),
];

pub fn trials(machine: &Machine) -> Vec<Trial> {
    let mut trials = vec![
        trial("pictures::all_outputs_are_written", all_outputs_are_written),
        trial("pictures::an_exr_says_what_it_is", an_exr_says_what_it_is),
        trial("pictures::quiet_says_nothing", || {
            let run = nocturne(DARK).and(words("--size 32x18 --quiet -o sky.png")).done();
            assert_eq!(run.stdout, "");
        }),
        trial("pictures::the_ends_of_every_range_are_drawn", the_ends_of_every_range_are_drawn),
        trial("pictures::statistics_name_what_was_skipped", statistics),
    ];
    for (name, line) in SCENES {
        let test = move || a_scene_file_gives_the_same_picture(line);
        trials.push(trial(format!("pictures::the_scene_file_of_{name}_gives_the_same"), test));
    }
    trials.into_iter().map(|trial| trial.with_ignored_flag(!machine.draws)).collect()
}

fn the_ends_of_every_range_are_drawn() {
    // By night, which needs no tables of sunlit air.
    for line in [
        "--size 1x1",
        "--size 16384x1",
        "--size 1x16384",
        "--fov 0.02",
        "--fov 340",
        "--projection perspective --fov 170",
        "--projection equirectangular --fov 360 --size 64x32",
        "--altitude -90 --roll -360",
        "--look zenith --tolerance 0",
        "--tolerance 360000 --magnitude-limit -30 --exposure -40",
        "--magnitude-limit 100 --exposure 40",
        "--lat 90 --lon 360 --height 100000 --at 2026-12-09T00:00Z",
        "--lat -90 --lon -180 --height -430 --at 2026-06-15T00:00Z",
        "--lat 0 --lon 0 --at -4000-01-01T00:00Z",
        "--lat 0 --lon 0 --at 4000-12-31T23:59:59Z",
    ] {
        let line = words(line);
        let mut arguments = vec!["render", "-q", "-o", "sky.png", "-o", "sky.exr"];
        // What the line does not say, these do.
        for (option, value) in [("--size", "24x24"), ("--at", "2026-08-12T21:30-07:00")] {
            if !line.contains(&option) {
                arguments.extend([option, value]);
            }
        }
        if !line.contains(&"--lat") {
            arguments.extend(["--place", "Flagstaff"]);
        }
        let run = nocturne(arguments).and(line).done();
        let (frame, _) = exr::read(&run.path("sky.exr")).unwrap();
        let is_light = |value: &f32| value.is_finite() && *value >= 0.0;
        assert!(frame.pixels().as_flattened().iter().all(is_light), "{run}");
    }
}

fn a_scene_file_gives_the_same_picture(line: &str) {
    let outputs = |name: &str| {
        words(&format!("--quiet -o {name}.png -o {name}.exr --save-scene {name}.toml"))
            .into_iter()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let first = nocturne(["render", "--size", "96x54"]).and(words(line)).and(outputs("first"));
    let first = first.done();
    let again = nocturne(["render", "--scene", "scene.toml"]).and(outputs("again"));
    let again = again.with_file("scene.toml", first.read("first.toml")).done();
    for kind in ["toml", "png", "exr"] {
        let (first, again) =
            (first.read(&format!("first.{kind}")), again.read(&format!("again.{kind}")));
        assert!(first == again, "the .{kind} of the scene file differs");
    }
}

fn all_outputs_are_written() {
    let line = "--size 48x27 -o a.png -o b.exr -o C.PNG --describe d.json --save-scene e.toml";
    let run = nocturne(DARK).and(words(line)).done();
    assert_eq!(run.files(), ["C.PNG", "a.png", "b.exr", "d.json", "e.toml"]);
    assert!(run.read("a.png").starts_with(b"\x89PNG\r\n\x1a\n"));
    assert_eq!(run.read("a.png"), run.read("C.PNG"));
    // Width and height stand at the head of a PNG, big-endian.
    assert_eq!(run.read("a.png")[16..24], [0, 0, 0, 48, 0, 0, 0, 27]);
    assert!(run.read("b.exr").starts_with(&[0x76, 0x2f, 0x31, 0x01]));
    for name in run.files() {
        let said = format!("Wrote {}", name.display());
        assert!(run.stdout.lines().any(|line| line == said), "{said}: {run}");
    }
}

fn an_exr_says_what_it_is() {
    let line = "--look 200 --altitude 31 --fov 70 --roll 2 --size 64x40 -q -o sky.exr";
    let run = nocturne(DARK).and(words(line)).done();
    // Reading fails if X, Y, Z or V is missing.
    let (frame, attributes) = exr::read(&run.path("sky.exr")).unwrap();
    assert_eq!((frame.width_px(), frame.height_px()), (64, 40));
    let names: Vec<String> = {
        let image = ::exr::meta::MetaData::read_from_file(run.path("sky.exr"), true).unwrap();
        image.headers[0].channels.list.iter().map(|channel| channel.name.to_string()).collect()
    };
    assert_eq!(names, ["V", "X", "Y", "Z"]);
    for (x, y) in [(0, 0), (32, 5), (63, 39)] {
        let light = frame.xyzv(x, y);
        // A starless sky is some 2e-4 cd/m2, and nothing here outshines a bright star's pixel.
        assert!((1e-6..10.0).contains(&light.y) && light.v > light.y, "{x},{y}: {light:?}");
    }
    let said: HashMap<_, _> = attributes.into_iter().collect();
    let said = |name: &str| said.get(name).unwrap_or_else(|| panic!("no {name}: {said:?}"));
    assert!(said("units").contains("cd/m2"));
    assert_eq!(said("instant_utc"), "2026-08-13T04:30:00Z");
    assert_eq!(said("place"), "Flagstaff");
    assert_eq!(said("projection"), "stereographic");
    for (name, value) in [
        ("jd_tt", 2_461_265.688_300_7),
        ("latitude_deg", 35.198),
        ("longitude_deg", -111.651),
        ("field_of_view_deg", 70.0),
        ("azimuth_deg", 200.0),
        ("altitude_deg", 31.0),
        ("roll_deg", 2.0),
    ] {
        let number: f64 = said(name).parse().expect("a number");
        assert!((number - value).abs() < 1e-3, "{name}: {number}");
    }
}

fn statistics() {
    let line = "--look S --size 48x27 --magnitude-limit 3 --stats -o sky.png";
    let run = nocturne(DARK).and(words(line)).done();
    let drawn = run.stdout.split_once("Drawn and skipped").expect("a ledger").1;
    for said in [
        "the Sun is more than 22° below the horizon",
        "skipped: below the horizon",
        "skipped: out of view",
        "skipped: fainter than the magnitude limit",
        "sunlit air               0 drawn",
    ] {
        assert!(drawn.contains(said), "{said}\n{run}");
    }
    // Every star is accounted for.
    let stars = drawn.lines().skip_while(|line| !line.trim().starts_with("stars "));
    let numbers = stars
        .take_while(|line| line.starts_with("  "))
        .flat_map(|line| words(line).into_iter().find_map(|word| word.parse::<u32>().ok()));
    assert_eq!(numbers.sum::<u32>(), 9096, "{run}");
}

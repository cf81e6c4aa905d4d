//! Catalogues that are not whole are refused with exit code 1, by name, and never half believed.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use libtest_mimic::Trial;

use super::harness::{DARK, IMPOSSIBLE, Machine, Nocturne, nocturne, trial, words};

const FILES: [&str; 9] = [
    "stars.bin",
    "places.csv",
    "moon_albedo.bin",
    "moon_relief.bin",
    "moon_hapke.bin",
    "de440.bin",
    "de431.bin",
    "nutation.bin",
    "libration.bin",
];

/// Of them, those that the Moon's face is drawn from.
const MOON_FILES: [&str; 3] = ["moon_albedo.bin", "moon_relief.bin", "moon_hapke.bin"];

/// The full Moon over Flagstaff, large enough to show its face.
const MOON: &str = "render --at 2026-08-27T23:30-07:00 --place Flagstaff --look Moon --fov 1 \
    --size 32x32 --quiet --save-scene moon.toml";

/// Does harm to a file.
type Harm = fn(&Path);

/// Ways to harm a file: in the middle, so that its beginning promises well.
const HARMS: [(&str, Harm); 4] = [
    ("cut", |path| {
        let bytes = fs::read(path).unwrap();
        fs::write(path, &bytes[..bytes.len() / 2]).unwrap();
    }),
    ("emptied", |path| fs::write(path, "").unwrap()),
    ("one_bit_flipped", |path| {
        let mut bytes = fs::read(path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(path, bytes).unwrap();
    }),
    ("removed", |path| fs::remove_file(path).unwrap()),
];

pub fn trials(machine: &Machine) -> Vec<Trial> {
    let mut trials = vec![
        trial("catalogs::a_whole_copy_is_as_good", || {
            let run = copied(nocturne(["place", "Flagstaff"])).and(["--catalogs", "copy"]).done();
            assert!(run.stdout.starts_with("Flagstaff "), "{run}");
        }),
        trial("catalogs::no_such_folder", || {
            let run = nocturne(["place", "--catalogs", "none"]);
            run.refused(IMPOSSIBLE, &["no stars.bin in none", "NOCTURNE_CATALOGS"]);
            let run = nocturne(["place"]).with_variable("NOCTURNE_CATALOGS", "none");
            run.refused(IMPOSSIBLE, &["no stars.bin in none", "NOCTURNE_CATALOGS"]);
        }),
        trial("catalogs::the_option_beats_the_environment", || {
            let run = copied(nocturne(["place", "Flagstaff", "--catalogs", "copy"]));
            run.with_variable("NOCTURNE_CATALOGS", "none").done();
            let run = copied(nocturne(["place", "--catalogs", "none"]));
            let run = run.with_variable("NOCTURNE_CATALOGS", "copy");
            run.refused(IMPOSSIBLE, &["no stars.bin in none"]);
        }),
        trial("catalogs::what_is_not_needed_is_not_read", || {
            let line = "render --lat 35 --lon -111 --quiet --describe sky.json --catalogs copy";
            let run = copied(nocturne(words(line)));
            for file in ["places.csv", "moon_albedo.bin", "moon_relief.bin", "moon_hapke.bin"] {
                fs::remove_file(run.path("copy").join(file)).unwrap();
            }
            run.done();
        }),
    ];
    for file in FILES {
        for (harm, do_harm) in HARMS {
            let needs_adapter = MOON_FILES.contains(&file);
            trials.push(
                trial(format!("catalogs::{file}_{harm}"), move || refused(file, harm, do_harm))
                    .with_ignored_flag(needs_adapter && !machine.draws),
            );
        }
    }
    trials
}

/// Harms a file, and expects that its reader says so, whichever way the folder is named.
fn refused(file: &str, harm: &str, do_harm: Harm) {
    let line = || match file {
        _ if MOON_FILES.contains(&file) => nocturne(words("render --scene moon.toml -o old.png"))
            .with_file("moon.toml", moon_without_air()),
        "de440.bin" | "de431.bin" | "nutation.bin" | "libration.bin" => {
            nocturne(words("ephemeris --body Moon --from 2026-01-01 --to 2026-01-02 -o old.csv"))
        }
        _ => nocturne(DARK).and(["--describe", "old.json"]),
    };
    let said: &[&str] = match (file, harm) {
        // The stars tell the folder of the catalogues from any other.
        ("stars.bin", "removed") => &["no stars.bin in copy", "NOCTURNE_CATALOGS"],
        _ => &["copy/", file, "run `cargo run --bin pack`, or fetch the file again"],
    };
    let harmed = |run: Nocturne| {
        let run = copied(run);
        do_harm(&run.path("copy").join(file));
        run
    };
    harmed(line()).and(["--catalogs", "copy"]).refused(IMPOSSIBLE, said);
    harmed(line()).with_variable("NOCTURNE_CATALOGS", "copy").refused(IMPOSSIBLE, said);
}

/// A scene of the Moon alone; the tables of moonlit air would take their time.
fn moon_without_air() -> &'static str {
    static SCENE: OnceLock<String> = OnceLock::new();
    SCENE.get_or_init(|| {
        let scene = nocturne(words(MOON)).done().read("moon.toml");
        String::from_utf8(scene).unwrap().replace("skylight = true", "skylight = false")
    })
}

/// With a copy of the catalogues in the folder `copy`.
fn copied(run: Nocturne) -> Nocturne {
    let from = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("catalogs");
    fs::create_dir(run.path("copy")).unwrap();
    for file in FILES.iter().chain(&["hipparcos.csv", "moon_features.csv"]).map(OsStr::new) {
        fs::copy(from.join(file), run.path("copy").join(file)).unwrap();
    }
    run
}

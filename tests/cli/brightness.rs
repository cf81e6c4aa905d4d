//! The sky as a measurement: keys, agreement of numbers, maps, and what is refused.

use libtest_mimic::Trial;
use nocturne::export::exr;
use serde_json::Value;

use super::harness::{IMPOSSIBLE, NONSENSE, nocturne, trial, words};

const PARANAL: &str = "brightness --lat -24.627 --lon -70.404 --height 2635 --at 2026-07-12T04:30Z";

fn measured(more: &str) -> Value {
    let run = nocturne(words(PARANAL)).and(words(more)).and(["--json"]).done();
    serde_json::from_str(&run.stdout).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} of {value}"))
}

pub fn trials() -> Vec<Trial> {
    let mut trials = vec![
        trial("brightness::adds_up", || {
            let sky = measured("--alt 60 --az 90 --bortle 4");
            let parts = sky["components"].as_object().unwrap();
            for key in
                ["airglow", "zodiacal", "starlight", "galactic", "cosmic", "sun", "moon", "town"]
            {
                assert!(parts.contains_key(key), "{key} of {sky}");
            }
            let sum: f64 = parts.values().map(|part| part.as_f64().unwrap()).sum();
            let luminance = number(&sky, "luminance_cd_m2");
            assert!((sum / luminance - 1.0).abs() < 1e-9, "{sky}");
            let ratio = number(&sky, "scotopic_luminance_cd_m2") / luminance;
            assert!((ratio - number(&sky, "sp_ratio")).abs() < 1e-9, "{sky}");
            // Magnitudes are integrated over the spectrum: near those that luminance alone tells.
            let mag = 12.58 - 2.5 * luminance.log10();
            assert!((mag - number(&sky, "mag_arcsec2_v")).abs() < 0.2, "{sky}");
            assert!((mag - number(&sky, "sqm_mag_arcsec2")).abs() < 0.4, "{sky}");
            assert!(sky["components"]["sun"] == 0.0 && sky["components"]["moon"] == 0.0);
        }),
        trial("brightness::follows_the_sun_the_towns_and_the_paper", || {
            let airglow = |more: &str| number(&measured(more)["components"], "airglow");
            assert!(airglow("--solar-flux 200") > 1.3 * airglow("--solar-flux 70"));
            let three_lines = measured("--paper");
            assert!(number(&three_lines["components"], "airglow") > 0.0);
            let city = measured("--zenith-brightness 18");
            assert!((number(&city, "mag_arcsec2_v") - 18.0).abs() < 0.25, "{city}");
            assert!(number(&city, "limiting_magnitude") < 5.2, "{city}");
        }),
        trial("brightness::of_day_and_of_moonlight", || {
            let day = "brightness --place Flagstaff --at 2026-08-15T17:00Z --alt 45 --az 0 --json";
            let day: Value = serde_json::from_str(&nocturne(words(day)).done().stdout).unwrap();
            assert!((300.0..20_000.0).contains(&number(&day, "luminance_cd_m2")), "{day}");
            assert_eq!(day["components"]["airglow"], 0.0);
            let full = "brightness --place Flagstaff --at 2026-07-29T07:00Z --json";
            let full: Value = serde_json::from_str(&nocturne(words(full)).done().stdout).unwrap();
            assert!((16.5..19.5).contains(&number(&full, "mag_arcsec2_v")), "{full}");
            let moon = number(&full["components"], "moon");
            assert!(moon > 0.8 * number(&full, "luminance_cd_m2"), "{full}");
            let total = "brightness --place Burgos --at 2026-08-12T18:29:40Z --json";
            let total: Value = serde_json::from_str(&nocturne(words(total)).done().stdout).unwrap();
            assert!((0.05..5.0).contains(&number(&total, "luminance_cd_m2")), "{total}");
        }),
        trial("brightness::is_told_to_people", || {
            let run = nocturne(words(PARANAL)).done();
            for said in ["mag/arcsec2", "Sky Quality Meter", "zodiacal light", "sfu"] {
                assert!(run.stdout.contains(said), "{said}: {run}");
            }
        }),
        trial("brightness::maps_hold_what_is_measured", || {
            let run = nocturne(words(PARANAL))
                .and(words("--map sky.exr --map sky.png --map-size 64"))
                .done();
            let (frame, _) = exr::read(&run.path("sky.exr")).unwrap();
            assert_eq!((frame.width_px(), frame.height_px()), (64, 64));
            // No sky in the corners; in the middle that of the zenith, 1.4 degrees a pixel.
            assert_eq!(frame.at(0, 0), [0.0; 4]);
            let zenith = number(&measured("--alt 88 --az 135"), "luminance_cd_m2");
            let drawn = frame.xyzv(32, 32).y;
            assert!((drawn / zenith - 1.0).abs() < 0.1, "{drawn} {zenith}");
            assert!(run.stdout.contains("Map: from black"), "{run}");
            assert!(run.read("sky.png").starts_with(b"\x89PNG"));
        }),
        trial("brightness::maps_that_cannot_be_written", || {
            let run = nocturne(words(PARANAL)).and(words("--map none/sky.exr"));
            run.refused(IMPOSSIBLE, &["none/sky.exr", "no folder"]);
        }),
    ];
    let wrong: [(&str, &str, &[&str]); 8] = [
        ("altitude", "--alt 91", &["--alt 91", "-90 to 90"]),
        ("no_number", "--az nan", &["--az NaN", "-360 to 360"]),
        ("bortle", "--bortle 12", &["Bortle class 12", "1"]),
        ("zenith", "--zenith-brightness 3", &["3 mag/arcsec2", "14 to 23"]),
        ("flux", "--solar-flux nan", &["solar_flux_sfu", "60 to 400"]),
        ("twice", "--bortle 4 --towns", &["--bortle", "--towns"]),
        ("map", "--map sky.jpg", &["sky.jpg", ".exr or .png"]),
        ("look", "--look Nibiru", &["Nibiru"]),
    ];
    trials.extend(wrong.map(|(name, more, said)| {
        trial(format!("brightness::refuses_{name}"), move || {
            nocturne(words(PARANAL)).and(words(more)).refused(NONSENSE, said);
        })
    }));
    trials.push(trial("brightness::refuses_nowhere", || {
        nocturne(["brightness"]).refused(NONSENSE, &["--place"]);
    }));
    trials
}

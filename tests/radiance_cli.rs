//! `nocturne radiance` as its users meet it: columns, tiers against an independent Monte Carlo, scenes,
//! refusals.

#[path = "cli/harness.rs"]
#[allow(dead_code, reason = "what draws is tested elsewhere")]
mod harness;

use std::collections::{BTreeMap, HashMap};

use harness::{IMPOSSIBLE, NONSENSE, Nocturne, nocturne, words};

const GRID: &str = include_str!("truth/sky_radiance_mc.csv");
const GROUND: &str = include_str!("truth/sky_radiance_ground_mc.csv");
const ZENITH: &str = include_str!("truth/sky_zenith_spectrum_mc.csv");
const ZENITH_LUMINANCE: &str = include_str!("truth/sky_zenith_luminance_mc.csv");

const RADIANCE: &str = "radiance_per_unit_toa_irradiance_sr-1";
const HEAD: &str = "case,wavelength_nm,sun_elevation_deg,view_elevation_deg,rel_azimuth_deg";

type Row<'a> = HashMap<&'a str, &'a str>;

fn csv(text: &str) -> Vec<Row<'_>> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let columns: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let row = |line: &'_ str| -> Vec<String> { line.split(',').map(str::to_owned).collect() };
    lines
        .map(|line| {
            assert_eq!(row(line).len(), columns.len(), "{line}");
            columns.iter().copied().zip(line.split(',')).collect()
        })
        .collect()
}

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} of {row:?} is no number"))
}

/// The program with rows in a file.
fn with_rows(rows: &str, options: &str) -> Nocturne {
    nocturne(words("radiance --rows rows.csv -q")).and(words(options)).with_file("rows.csv", rows)
}

/// Median and largest error by the Sun's elevation, per cent.
fn errors(tier: &str) -> BTreeMap<i64, (f64, f64)> {
    let run = with_rows(GRID, &format!("--tier {tier}")).done();
    let (asked, given) = (csv(GRID), csv(&run.stdout));
    assert_eq!(asked.len(), given.len());
    let mut errors: BTreeMap<i64, Vec<f64>> = BTreeMap::new();
    for (asked, given) in asked.iter().zip(&given) {
        for column in HEAD.split(',') {
            assert_eq!(asked[column], given[column]);
        }
        assert!(number(given, "luminance_cd_m2") > 0.0, "{given:?}");
        let error = 100.0 * (number(given, RADIANCE) / number(asked, "L_total_sr-1") - 1.0);
        errors.entry(number(asked, "sun_elevation_deg") as i64).or_default().push(error.abs());
    }
    let summary = |mut errors: Vec<f64>| {
        errors.sort_by(f64::total_cmp);
        (errors[errors.len() / 2], errors[errors.len() - 1])
    };
    errors.into_iter().map(|(sun, errors)| (sun, summary(errors))).collect()
}

/// Greatest median and single error by the Sun's elevation; the noise of the reference is in them.
fn assert_within(tier: &str, allowed: [(i64, f64, f64); 8]) {
    let errors = errors(tier);
    assert_eq!(errors.len(), allowed.len());
    for (sun, median, most) in allowed {
        let (mid, max) = errors[&sun];
        println!("{tier}, sun {sun:>3}: median {mid:.2} %, max {max:.2} %");
        assert!(mid <= median && max <= most, "{tier}, sun {sun}: {mid:.2} %, at most {max:.2} %");
    }
}

#[test]
fn tables_of_pictures_follow_the_reference() {
    assert_within(
        "render",
        [
            (45, 0.5, 2.5),
            (10, 0.5, 2.5),
            (2, 0.5, 2.5),
            (0, 0.5, 2.5),
            (-3, 1.0, 4.0),
            (-6, 1.5, 5.0),
            (-9, 2.5, 11.0),
            (-12, 3.0, 13.0),
        ],
    );
}

#[test]
fn coarse_tables_follow_the_reference_roughly() {
    assert_within(
        "fast",
        [
            (45, 1.5, 8.0),
            (10, 1.5, 8.0),
            (2, 2.0, 10.0),
            (0, 2.0, 10.0),
            (-3, 3.0, 15.0),
            (-6, 4.0, 20.0),
            (-9, 6.0, 35.0),
            (-12, 8.0, 40.0),
        ],
    );
}

#[test]
fn random_paths_state_their_error_and_repeat() {
    let truth = csv(GRID);
    let chosen = |row: &&Row| {
        let at = |column| number(row, column);
        row["case"].starts_with('B')
            && at("view_elevation_deg") >= 30.0
            && at("sun_elevation_deg") >= -3.0
            && at("wavelength_nm") == 550.0
    };
    let asked: Vec<&Row> = truth.iter().filter(chosen).step_by(2).collect();
    assert!(asked.len() > 3);
    let mut file = HEAD.to_owned() + "\n";
    for row in &asked {
        let cells: Vec<&str> = HEAD.split(',').map(|column| row[column]).collect();
        file += &(cells.join(",") + "\n");
    }
    let run = |options: &str| {
        with_rows(&file, &format!("--tier reference --paths 30000 {options}")).done().stdout
    };
    let first = run("--error 1%");
    for (given, asked) in csv(&first).iter().zip(asked) {
        let (got, error) = (number(given, RADIANCE), number(given, "std_error_sr-1"));
        assert!(error > 0.0 && error < 0.02 * got, "{given:?}");
        assert!((1.0..30_100.0).contains(&number(given, "n_paths")));
        let sigma = error.hypot(number(asked, "std_error_sr-1"));
        assert!((got - number(asked, "L_total_sr-1")).abs() < 4.0 * sigma, "{given:?} {asked:?}");
        let (light, error) = (number(given, "luminance_cd_m2"), number(given, "std_error_cd_m2"));
        assert!(error > 0.0 && error < 0.03 * light, "{given:?}");
    }
    assert_eq!(first, run("--error 1"));
    assert_ne!(first, run("--seed 2"));
}

#[test]
fn without_views_the_ground_is_asked_about() {
    for (tier, options, within) in
        [("render", "", 0.02), ("fast", "", 0.04), ("reference", "--paths 8000", 0.05)]
    {
        let run = with_rows(GROUND, &format!("--tier {tier} {options}")).done();
        let (asked, given) = (csv(GROUND), csv(&run.stdout));
        assert_eq!(asked.len(), given.len());
        for (asked, given) in asked.iter().zip(&given) {
            if number(asked, "sun_elevation_deg") <= 0.0 {
                continue;
            }
            let diffuse = "E_diffuse_horizontal_per_unit_TOA_irradiance";
            let noise = 3.0 * number(asked, "std_error") / number(asked, diffuse);
            let error = number(given, diffuse) / number(asked, diffuse) - 1.0;
            assert!(error.abs() < within + noise, "{tier}: {error}, {given:?}");
            let direct = "E_direct_horizontal";
            let error = number(given, direct) / number(asked, direct) - 1.0;
            assert!(error.abs() < 0.006, "{tier}: {error}, {given:?}");
            assert!(number(given, "E_direct_horizontal_lx") > 0.0);
        }
    }
}

#[test]
fn zeniths_have_their_spectra_and_luminances() {
    let run = with_rows(ZENITH, "--tier render").done();
    for (asked, given) in csv(ZENITH).iter().zip(csv(&run.stdout)) {
        let sigma = number(asked, "rel_std_error");
        let error = number(&given, RADIANCE) / number(asked, "L_total_sr-1") - 1.0;
        // The nodes of pictures end at 665 nm.
        assert!(error.abs() < 0.015 + 3.0 * sigma, "{error}, {given:?}");
    }
    let mut file = "case,sun_elevation_deg,view_elevation_deg,rel_azimuth_deg\n".to_owned();
    let truth = csv(ZENITH_LUMINANCE);
    for row in &truth {
        file += &format!("{},{},90,0\n", row["case"], row["sun_elevation_deg"]);
    }
    for (tier, within) in [("render", 0.02), ("fast", 0.08)] {
        let run = with_rows(&file, &format!("--tier {tier}")).done();
        let head = "case,sun_elevation_deg,view_elevation_deg,rel_azimuth_deg,luminance_cd_m2";
        assert_eq!(run.stdout.lines().next(), Some(head));
        for (asked, given) in truth.iter().zip(csv(&run.stdout)) {
            let (got, want) = (number(&given, "luminance_cd_m2"), number(asked, "luminance_cd_m2"));
            // Its own spectrum has 13 wavelengths, in deep twilight 7.
            let noise = 3.0 * number(asked, "rel_std_error");
            assert!((got / want - 1.0).abs() < within + noise, "{tier}: {got}, {asked:?}");
        }
    }
}

#[test]
fn an_atmosphere_stands_for_every_case_and_files_are_written_whole() {
    let rows = "rel_azimuth_deg,note,sun_elevation_deg,view_elevation_deg,observer_height_m\n\
                0,\"a, b\",20,90,0\n0,,20,90,5000\n";
    let run = with_rows(rows, "--tier fast --atmosphere desert -o out.csv").done();
    assert_eq!(run.stdout, "");
    let text = String::from_utf8(run.read("out.csv")).unwrap();
    let given = csv(&text);
    assert!(!given[0].contains_key("note") && !given[0].contains_key(RADIANCE));
    let [low, high] = [0, 1].map(|row| number(&given[row], "luminance_cd_m2"));
    assert!(high < 0.9 * low, "{high} cd/m2 at 5 km, {low} below");
    let clear = with_rows(rows, "--tier fast --atmosphere clear -o out.csv").done();
    assert_ne!(text.as_bytes(), clear.read("out.csv"));
    // Standard input and output.
    let piped = nocturne(words("radiance --rows - -q --tier fast --atmosphere desert -o -"))
        .with_file("rows.csv", rows)
        .through_shell("\"$@\" < rows.csv");
    assert_eq!(piped.done().stdout, text);
}

/// An afternoon on the equator at an equinox, and directions in its sky.
const SCENE: &str = "nocturne_scene = 2\nutc = \"2026-03-20T16:00:00Z\"\n\
    [place]\nlatitude_deg = 0.0\nlongitude_deg = 0.0\n\
    [camera]\nazimuth_deg = 0.0\naltitude_deg = 40.0\nfield_of_view_deg = 60.0\n\
    projection = \"stereographic\"\nwidth_px = 64\nheight_px = 48\n\
    [marks]\nhorizon = false\ncardinal_points = false\n";

#[test]
fn a_scene_is_asked_in_its_own_directions() {
    let rows = "azimuth_deg,altitude_deg\n270,10\n90,10\n90,60\n0,-20\n";
    let run = with_rows(rows, "--scene scene.toml").with_file("scene.toml", SCENE).done();
    assert_eq!(
        run.stdout.lines().next(),
        Some("altitude_deg,azimuth_deg,X_cd_m2,Y_cd_m2,Z_cd_m2,V_cd_m2")
    );
    let given = csv(&run.stdout);
    let y = |row: usize| number(&given[row], "Y_cd_m2");
    // The Sun stands in the west, half way up; the ground is darker than the low sky.
    assert!(y(0) > y(1) && y(1) > y(2) && y(3) > 1000.0 && y(3) < y(1), "{}", run.stdout);
    let blue = number(&given[2], "Z_cd_m2") / y(2);
    assert!(blue > 1.3, "{blue}");
}

#[test]
#[cfg(feature = "gpu")]
fn a_scene_is_what_its_picture_shows() {
    use nocturne::camera::Camera;
    use nocturne::export::exr;
    use nocturne::scene::Scene;

    if !harness::Machine::look_around().draws {
        return;
    }
    // Afternoon; dusk with the Moon, four days old, in the west; a dark night. Neither stars nor discs.
    for utc in ["2026-03-20T16:00:00Z", "2026-03-22T18:40:00Z", "2026-03-20T23:00:00Z"] {
        let scene =
            SCENE.replace("2026-03-20T16:00:00Z", utc).replace("width_px = 64", "width_px = 320");
        let scene = scene
            .replace("height_px = 48", "height_px = 240")
            .replace("azimuth_deg = 0.0", "azimuth_deg = 240.0")
            + "[layers]\nsun = false\nmoon = false\nplanets = false\nstars = false\n";
        let line = "render --scene scene.toml -q -o sky.exr";
        let drawn = nocturne(words(line)).with_file("scene.toml", &scene).done();
        let (frame, _) = exr::read(&drawn.path("sky.exr")).unwrap();
        let camera: Camera = Scene::parse(&scene).unwrap().setting().unwrap().camera;
        let mut rows = "altitude_deg,azimuth_deg\n".to_owned();
        let mut kept = Vec::new();
        for i in 0..220 {
            // Spread as evenly as irrational steps do.
            let spread =
                |step: f64, size: u32| ((f64::from(i) * step).fract() * f64::from(size)) as u32;
            let (x, y) = (spread(0.754_877_666, 320), spread(0.569_840_290, 240));
            let centre = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let Some(seen) = camera.view_from_pixel(centre) else { continue };
            let dir = camera.view_from_apparent().inverse() * seen;
            // The edge of the ground is drawn softly.
            if dir.altitude().deg().abs() > 0.5 {
                rows += &format!("{},{}\n", dir.altitude().deg(), dir.azimuth().deg());
                kept.push((x, y));
            }
        }
        assert!(kept.len() > 200);
        let run = with_rows(&rows, "--scene scene.toml").with_file("scene.toml", &scene).done();
        for (given, (x, y)) in csv(&run.stdout).iter().zip(kept) {
            let drawn = frame.xyzv(x, y);
            for (name, drawn) in [("X", drawn.x), ("Y", drawn.y), ("Z", drawn.z), ("V", drawn.v)] {
                let ratio = number(given, &format!("{name}_cd_m2")) / drawn;
                // Pictures are tiled to 0.2 %.
                assert!((ratio - 1.0).abs() < 0.0025, "{utc}, {name} at {x}, {y}: {ratio}");
            }
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused_in_a_sentence() {
    let row = format!("{HEAD}\nA,550,45,90,0\n");
    let refused = |rows: &str, options: &str, words: &[&str]| {
        with_rows(rows, &format!("{options} -o out.csv")).refused(NONSENSE, words);
    };
    refused(&format!("{row}C,550,1,90,0\n"), "", &["rows.csv, line 3", "case 'C'", "--atmosphere"]);
    refused(&format!("{row}A,55,1,90,0\n"), "", &["line 3", "wavelength_nm is 55", "360 to 830"]);
    refused("case,wavelength_nm\n", "", &["line 1", "sun_elevation_deg"]);
    refused("", "", &["there are no rows"]);
    refused(&row, "--error 1%", &["--error", "--tier reference"]);
    refused(&row, "--tier reference --error 0", &["--error", "0.001 to 100"]);
    refused(&row, "--atmosphere dessert", &["dessert", "did you mean desert"]);
    refused(&row, "--scene scene.toml --tier fast", &["--scene", "leave --tier out"]);
    nocturne(words("radiance --rows none.csv")).refused(IMPOSSIBLE, &["none.csv", "--rows"]);
    let run = nocturne(words("radiance --rows rows.csv -o none/out.csv"));
    run.with_file("rows.csv", &row).refused(IMPOSSIBLE, &["none/out.csv"]);
    nocturne(words("radiance")).refused(NONSENSE, &["--rows"]);
}

#[test]
fn bent_light_is_said_to_be_left_out() {
    let rows = "sun_elevation_deg,view_elevation_deg,rel_azimuth_deg\n30,90,0\n";
    let line = "radiance --rows rows.csv --tier reference --paths 500 --atmosphere clear";
    let run = nocturne(words(line)).with_file("rows.csv", rows).run();
    assert!(run.code() == Some(0) && run.stderr.contains("straight rays"), "{run}");
}

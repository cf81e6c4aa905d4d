//! Frames in a row: what a studio shares between them is what each would have made alone.

use std::sync::Arc;

use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Ephemeris, Tolerance};
use nocturne::light::night::Night;
use nocturne::plan::data::SkyData;
use nocturne::plan::lay::{Kept, lay, lay_in};
use nocturne::plan::{FramePlan, SourceSky};
use nocturne::scene::{Layers, Scene, Setting};
use nocturne::sky::SkyState;
use nocturne::store::Store;
use nocturne::studio::Studio;
use nocturne::time;
use nocturne::units::Xyzv;

fn scene(utc: &str, azimuth_deg: f64) -> Scene {
    Scene::parse(&format!(
        r#"
        nocturne_scene = 2
        utc = "{utc}"
        [place]
        latitude_deg = 35.198
        longitude_deg = -111.651
        height_m = 2106.0
        [camera]
        azimuth_deg = {azimuth_deg}
        altitude_deg = 35.0
        field_of_view_deg = 60.0
        projection = "stereographic"
        width_px = 320
        height_px = 180
        "#
    ))
    .expect("a scene")
}

fn later(utc: &str, seconds: f64) -> Scene {
    let instant = time::to_instant(&time::parse(utc).expect("a time"), None).expect("a date");
    scene(&instant.plus_seconds(seconds).expect("a date").to_string(), 150.0)
}

fn studio() -> (Catalogs, Studio) {
    let catalogs = Catalogs::locate(None).expect("the catalogues");
    let studio = Studio::open(&catalogs, Store::NONE).expect("a studio");
    (catalogs, studio)
}

fn frame(studio: &mut Studio, scene: &Scene) -> (Night, FramePlan) {
    let setting = scene.setting().expect("a setting");
    let night = studio.night(scene, &setting).expect("a night");
    let (plan, _) = studio.lay(scene, &setting, &night).expect("a plan");
    (night, plan)
}

/// The sky alone, the air of each solved once: nothing else is shared.
struct Afresh {
    kept: Kept,
}

impl Afresh {
    fn frame(&mut self, studio: &Studio, setting: &Setting, night: &Night) -> FramePlan {
        let layers = Layers { stars: false, planets: false, ..Layers::default() };
        self.kept.forget_tables();
        lay_in(setting, &layers, night, studio, &mut self.kept).expect("a plan").0
    }
}

/// A plan in words: numbers as they are written are exact.
fn words(plan: &FramePlan) -> String {
    format!("{:?} {:?} {:?}", plan.sky, plan.splats, plan.discs.len())
}

#[test]
fn the_first_frame_is_that_of_a_single_still() {
    let (catalogs, mut studio) = studio();
    let scene = scene("2026-08-26T06:00:00Z", 150.0);
    let setting = scene.setting().expect("a setting");
    let ephemeris = Ephemeris::load(&catalogs, setting.tolerance).expect("tables");
    let sky = SkyState::at(&ephemeris, &setting.instant, &setting.place, setting.tolerance);
    let stars = catalogs.stars().expect("stars");
    let alone = Night::of(sky.expect("a sky"), stars, &scene.air);
    let (night, plan) = frame(&mut studio, &scene);
    assert_eq!(night.objects, alone.objects);
    let (still, _) = lay(&setting, &scene.layers, &alone, &catalogs).expect("a plan");
    assert!(words(&plan) == words(&still), "the first frame of a studio differs");
    assert!(plan.sky.moon.is_some() && plan.milky_way.is_some() && !plan.splats.is_empty());
}

#[test]
fn another_camera_changes_no_light() {
    let utc = "2026-08-13T02:45:00Z";
    let (_, mut studio) = studio();
    // The second frame may be between tables, and what follows shows the same.
    let (_, first) = frame(&mut studio, &later(utc, 0.0));
    let (_, second) = frame(&mut studio, &later(utc, 2.0));
    let turned = Scene { camera: scene(utc, 250.0).camera, ..later(utc, 2.0) };
    let (_, third) = frame(&mut studio, &turned);
    assert_ne!(format!("{:?}", first.sky), format!("{:?}", second.sky));
    assert!(format!("{:?}", second.sky) == format!("{:?}", third.sky), "the sky differs");
    let (_, again) = frame(&mut studio, &turned);
    assert!(words(&third) == words(&again), "the same frame differs");
}

/// Largest relative differences of lights over a share of the brightest, and their mean.
fn apart(table: &[Xyzv], exact: &[Xyzv], over: f64) -> (f64, f64) {
    let brightest = exact.iter().map(|light| light.y).fold(0.0, f64::max);
    let pairs = table.iter().zip(exact).filter(|(_, exact)| exact.y > over * brightest);
    let errors: Vec<f64> = pairs
        .flat_map(|(a, b)| [(a.x, b.x), (a.y, b.y), (a.z, b.z), (a.v, b.v)])
        .map(|(a, b)| (a / b - 1.0).abs())
        .collect();
    let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
    (errors.into_iter().fold(0.0, f64::max), mean)
}

#[test]
fn tables_between_others_are_as_good_as_tables_made_afresh() {
    let (_, mut studio) = studio();
    let mut afresh = Afresh { kept: Kept::new(Store::NONE) };
    let mut bad = Vec::new();
    for (name, utc) in [
        ("noon", "2026-08-15T19:20:00Z"),
        ("afternoon", "2026-08-13T01:26:00Z"),
        ("sunset", "2026-08-13T02:20:00Z"),
        ("dusk", "2026-08-13T02:45:00Z"),
        ("late dusk", "2026-08-13T03:25:00Z"),
        ("moonrise", "2026-08-29T02:50:00Z"),
        ("moonlit night", "2026-08-26T06:00:00Z"),
        ("dark night", "2026-08-13T05:30:00Z"),
    ] {
        // In real time, then sixty times as fast.
        let slow = [0.0, 1.0, 3.0, 6.0, 10.0, 13.0, 17.0, 20.0, 24.0, 30.0];
        let fast = [90.0, 150.0, 210.0, 270.0, 330.0, 390.0];
        for second in slow.into_iter().chain(fast) {
            let scene = later(utc, second);
            let setting = scene.setting().expect("a setting");
            let night = studio.night(&scene, &setting).expect("a night");
            let (row, _) = studio.lay(&scene, &setting, &night).expect("a plan");
            let exact = afresh.frame(&studio, &setting, &night);
            let lights = |sky: &Option<SourceSky>| sky.as_ref().map(SourceSky::luminance);
            let source = |which: &str, a: Option<Vec<Xyzv>>, b: Option<Vec<Xyzv>>| {
                assert_eq!(a.is_some(), b.is_some());
                let (most, mean) = apart(&a.unwrap_or_default(), &b.unwrap_or_default(), 1e-3);
                println!("{name} {second} s, {which}: most {most:.2e}, mean {mean:.2e}");
                (most > 2e-3).then(|| format!("{name} {second} s, {which}: {most:.2e}"))
            };
            bad.extend(source("Sun", lights(&row.sky.sun), lights(&exact.sky.sun)));
            bad.extend(source("Moon", lights(&row.sky.moon), lights(&exact.sky.moon)));
            let (most, mean) = apart(&row.sky.dark, &exact.sky.dark, 1e-3);
            println!("{name} {second} s, dark: most {most:.2e}, mean {mean:.2e}");
            if most > 1e-2 || mean > 2e-3 {
                bad.push(format!("{name} {second} s, dark: {most:.2e}, mean {mean:.2e}"));
            }
            if second == 0.0 {
                assert!(words_of_sky(&row) == words_of_sky(&exact), "{name}: the first differs");
            }
        }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

#[test]
fn the_shadow_of_the_earth_is_kept_while_the_moon_is_as_far() {
    let utc = "2026-03-03T10:20:00Z";
    let (_, mut row) = studio();
    let night = |studio: &mut Studio, seconds: f64| {
        let scene = later(utc, seconds);
        studio.night(&scene, &scene.setting().expect("a setting")).expect("a night")
    };
    let first = night(&mut row, 0.0);
    let shadow = |night: &Night| night.eclipse.moon.clone().expect("an eclipse").shadow;
    for seconds in [1.0, 30.0, 60.0, 3600.0] {
        let next = night(&mut row, seconds);
        let is_kept = Arc::ptr_eq(&shadow(&first), &shadow(&next));
        assert_eq!(is_kept, seconds <= 60.0, "after {seconds} s");
        let (_, mut afresh) = studio();
        let exact = night(&mut afresh, seconds);
        for (a, b) in next.objects.iter().zip(&exact.objects) {
            let (a, b, kind) = (a.ground.y, b.ground.y, a.kind);
            assert!((a - b).abs() <= 1e-3 * b, "{kind:?} after {seconds} s: {a} for {b}");
        }
    }
}

#[test]
fn what_is_kept_does_not_grow() {
    let (_, mut studio) = studio();
    let mut counts = Vec::new();
    for (round, utc) in
        ["2026-08-26T06:00:00Z", "2026-08-13T02:45:00Z"].iter().cycle().take(4).enumerate()
    {
        for step in 0..20 {
            let pace_s = [0.0, 1.0, 60.0][(step + round) % 3];
            frame(&mut studio, &later(utc, pace_s * step as f64));
        }
        counts.push(studio.kept().tables());
    }
    assert!(counts.iter().all(|&count| count > 0 && count <= 12), "{counts:?}");
}

fn words_of_sky(plan: &FramePlan) -> String {
    format!("{:?}", plan.sky)
}

#[test]
fn files_are_read_once_and_ephemerides_as_deep_as_needed() {
    let (_, mut studio) = studio();
    let maps = studio.moon_maps().expect("maps");
    assert!(Arc::ptr_eq(&maps.albedo, &studio.moon_maps().expect("maps").albedo));
    let milky_way = studio.milky_way().expect("a map").expect("a map");
    assert!(Arc::ptr_eq(&milky_way, &studio.milky_way().expect("a map").expect("a map")));
    assert!(studio.gazetteer().expect("places").find("Flagstaff").is_ok());
    assert_eq!(studio.stars().len(), 9096);
    assert!(studio.features().iter().any(|feature| feature.name == "Tycho"));
    let (coarse, fine) = (Tolerance::from_arcsec(10.0), Tolerance::from_arcsec(0.002));
    assert!(!studio.ephemeris(coarse).expect("tables").serves(fine));
    assert!(studio.ephemeris(fine).expect("tables").serves(fine));
    assert!(studio.ephemeris(coarse).expect("tables").serves(fine), "what was read is kept");
}

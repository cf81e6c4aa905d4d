//! What a plan holds and what it leaves out, and that the ledger says why. Needs no GPU.

use std::cell::Cell;

use nocturne::air::Atmosphere;
use nocturne::catalog::{CatalogError, Catalogs, MoonMaps};
use nocturne::ephemeris::Ephemeris;
use nocturne::frame::{Apparent, Dir};
use nocturne::light::dark_sky::DarkSky;
use nocturne::light::night::Night;
use nocturne::light::night_lights::NightGlow;
use nocturne::light::scintillation::Scintillation;
use nocturne::plan::dark_sky::{self, KeptDarkSky};
use nocturne::plan::lay::{Kept, lay, lay_in};
use nocturne::plan::ledger::Ledger;
use nocturne::plan::skylight::{KeptAir, Origin, SolvedAir};
use nocturne::plan::{DARK_AZIMUTHS, FramePlan, SKY_SHAPE, SkyPlan, skylight};
use nocturne::scene::{Layers, Scene};
use nocturne::sky::{BodyState, SkyState};
use nocturne::store::Store;
use nocturne::units::{Angle, Xyzv};

const FLAGSTAFF: &str = r#"
nocturne_scene = 2
utc = "2026-01-18T06:00:00Z"
[place]
latitude_deg = 35.19807
longitude_deg = -111.65127
height_m = 2106.0
[camera]
azimuth_deg = 180.0
altitude_deg = 40.0
field_of_view_deg = 120.0
projection = "stereographic"
width_px = 640
height_px = 360
"#;

fn at(utc: &str) -> Scene {
    let mut scene = Scene::parse(FLAGSTAFF).unwrap();
    scene.utc = utc.to_owned();
    scene
}

fn night_of(scene: &Scene) -> Night {
    let catalogs = Catalogs::locate(None).unwrap();
    let setting = scene.setting().unwrap();
    let ephemeris = Ephemeris::load(&catalogs, setting.tolerance).unwrap();
    let sky =
        SkyState::at(&ephemeris, &setting.instant, &setting.place, setting.tolerance).unwrap();
    Night::of(sky, catalogs.stars().unwrap(), &scene.air)
}

/// The plan, the ledger, and whether the map of the Moon was read.
fn laid(scene: &Scene) -> (FramePlan, Ledger, bool) {
    let catalogs = Catalogs::locate(None).unwrap();
    let setting = scene.setting().unwrap();
    let night = night_of(scene);
    let asked = Cell::new(false);
    let moon_maps = || {
        asked.set(true);
        catalogs.moon_maps()
    };
    let (plan, ledger) = lay(&setting, &scene.layers, &night, &moon_maps).unwrap();
    (plan, ledger, asked.get())
}

fn skipped(ledger: &Ledger, layer: &str, reason: &str) -> usize {
    let entry = ledger.of(layer).unwrap_or_else(|| panic!("no layer {layer}"));
    entry.skipped.iter().filter(|(why, _)| why.contains(reason)).map(|(_, count)| count).sum()
}

#[test]
fn a_moonless_night_builds_no_table_and_reads_no_map() {
    let (plan, ledger, map_was_read) = laid(&at("2026-01-18T06:00:00Z"));
    assert!(plan.sky.sun.is_none() && plan.sky.moon.is_none() && plan.discs.is_empty());
    assert!(!map_was_read);
    assert_eq!(skipped(&ledger, "sunlit air", "below the horizon"), 1);
    assert_eq!(skipped(&ledger, "Moon", "below the horizon"), 1);
    let stars = ledger.of("stars").unwrap();
    let counted = stars.drawn + stars.skipped.iter().map(|(_, count)| count).sum::<usize>();
    assert_eq!(counted, 9096);
    assert!(stars.drawn > 1500, "{stars:?}");
    // The dark sky is as bright in the zenith as at a maximum of the Sun's activity: 21.4 to 22.
    let zenith = plan.sky.luminance(down_by(-90.0)).y;
    assert!((1.7e-4..3.0e-4).contains(&zenith), "{zenith}");
}

#[test]
fn by_day_the_stars_go_out() {
    let mut noon = at("2026-08-12T19:30:00Z");
    noon.camera.altitude_deg = 60.0;
    let (plan, ledger, _) = laid(&noon);
    assert!(plan.sky.sun.is_some() && plan.sky.moon.is_none());
    // Sirius alone gives a pixel a ten-thousandth of the blue behind it.
    assert!(ledger.of("stars").unwrap().drawn <= 1);
    assert!(skipped(&ledger, "stars", "of the sky behind it") > 1500);
    assert_eq!(ledger.of("Sun").unwrap().drawn, 1);
    assert_eq!(skipped(&ledger, "moonlit air", "outshines"), 1);
}

#[test]
fn the_full_moon_takes_stars_away_and_lights_the_air() {
    let scene = at("2026-08-28T06:00:00Z");
    let (plan, ledger, _) = laid(&scene);
    assert!(plan.sky.moon.is_some() && plan.sky.sun.is_none());
    assert_eq!(ledger.of("Moon").unwrap().drawn, 1);
    // A full Moon half-way up gives some tenths of a lux, and ground of albedo 0.1 shows it.
    let ground = plan.sky.luminance(down_by(90.0)).y;
    assert!((0.002..0.01).contains(&ground), "{ground}");
}

#[test]
fn what_is_switched_off_is_not_there() {
    let mut scene = at("2026-01-18T06:00:00Z");
    scene.layers.stars = false;
    scene.layers.planets = false;
    scene.layers.skylight = false;
    scene.layers.ground = false;
    let (plan, ledger, _) = laid(&scene);
    assert!(plan.splats.is_empty());
    assert!(plan.sky.dark.iter().all(|light| light.y == 0.0));
    assert_eq!(skipped(&ledger, "stars", "switched off"), 9096);
    scene.layers.stars = true;
    scene.layers.magnitude_limit = Some(2.0);
    let (plan, ledger, _) = laid(&scene);
    assert!((10..60).contains(&plan.splats.len()), "{}", plan.splats.len());
    assert!(skipped(&ledger, "stars", "magnitude limit") > 9000);
}

#[test]
fn a_panorama_repeats_what_lies_on_its_seam() {
    let mut scene = at("2026-01-18T06:00:00Z");
    scene.camera.projection = nocturne::camera::Projection::Equirectangular;
    scene.camera.field_of_view_deg = 360.0;
    scene.camera.altitude_deg = 0.0;
    let (plan, _, _) = laid(&scene);
    let width = f64::from(plan.camera.width_px);
    let seam: Vec<_> = plan.splats.iter().filter(|s| s.centre_px[0] < 2.0).collect();
    assert!(!seam.is_empty());
    for left in seam {
        let twin = plan.splats.iter().any(|right| {
            (right.centre_px[0] - left.centre_px[0] - width).abs() < 1e-6
                && right.centre_px[1] == left.centre_px[1]
        });
        assert!(twin, "{left:?} has no twin on the right");
    }
}

#[test]
fn the_moon_hides_what_stands_behind_it() {
    // Deep in the total eclipse of 2026 over Burgos nothing of the Sun is left beside the Moon.
    let mut scene = at("2026-08-12T18:29:30Z");
    (scene.place.latitude_deg, scene.place.longitude_deg) = (42.34106, -3.70184);
    scene.place.height_m = 867.0;
    (scene.camera.azimuth_deg, scene.camera.altitude_deg) = (283.0, 8.0);
    let (plan, ledger, _) = laid(&scene);
    let brightest = plan.splats.iter().map(|s| s.illuminance.y).fold(0.0, f64::max);
    assert!(brightest < 1.0, "{brightest} lx is the Sun's: {ledger:?}");
}

/// An apparent direction so many degrees below the horizontal.
fn down_by(degrees: f64) -> Dir<Apparent> {
    Dir::from_azimuth_altitude(Angle::from_deg(50.0), Angle::from_deg(-degrees))
}

/// The largest share that a source's light has of the rest of the sky, over both tables.
fn largest_share(of: &[Xyzv], among: impl Fn(usize) -> f64) -> f64 {
    let sky = &of[..SKY_SHAPE.above * SKY_SHAPE.azimuths];
    sky.iter().enumerate().map(|(texel, light)| light.y / among(texel)).fold(0.0, f64::max)
}

/// The first instant of a day, in steps of two minutes, that has a property.
fn first(scene: &mut Scene, holds: impl Fn(&Night) -> bool) -> Night {
    let setting = scene.setting().unwrap();
    let stars = Vec::new();
    for step in 0..720 {
        let instant = setting.instant.plus_seconds(120.0 * f64::from(step)).unwrap();
        let sky = SkyState::at(&Ephemeris::analytic(), &instant, &setting.place, setting.tolerance)
            .unwrap();
        let night = Night::of(sky, stars.clone(), &scene.air);
        if holds(&night) {
            return night;
        }
    }
    panic!("the day has no such instant");
}

#[test]
fn what_is_skipped_could_not_have_been_seen() {
    let altitude = |state: &BodyState| state.dir.altitude();
    // The Sun at the floor of its table, against the dark sky.
    let dusk = first(&mut at("2026-01-18T00:00:00Z"), |night| {
        altitude(&night.sky.sun) < skylight::SUN_SKY_FLOOR
    });
    let (mut sky, _) = skylight::sky_plan(&dusk, true, false, &mut unkept()).unwrap();
    lay_dark_sky(&dusk, &mut sky);
    let sun = sky.sun.as_ref().unwrap().luminance();
    let share = largest_share(&sun, |texel| darkest(&sky, texel / SKY_SHAPE.azimuths));
    assert!(share < 0.02, "sunlit air at its floor: {share} of the dark sky");
    // A bright Moon at the floor of its table, against the dark sky.
    let moonset = first(&mut at("2026-08-24T04:00:00Z"), |night| {
        altitude(&night.sky.moon.state) < skylight::MOON_SKY_FLOOR
            && altitude(&night.sky.sun) < skylight::SUN_SKY_FLOOR
    });
    let (mut sky, _) = skylight::sky_plan(&moonset, false, true, &mut unkept()).unwrap();
    lay_dark_sky(&moonset, &mut sky);
    let moon = sky.moon.as_ref().unwrap().luminance();
    let share = largest_share(&moon, |texel| darkest(&sky, texel / SKY_SHAPE.azimuths));
    assert!(share < 0.02, "moonlit air at its floor: {share} of the dark sky");
    // The full Moon of dusk against the twilight behind it.
    let rising = first(&mut at("2026-08-28T01:30:00Z"), |night| {
        altitude(&night.sky.sun) < skylight::MOON_SKY_SUN_LIMIT
    });
    let (sky, _) = skylight::sky_plan(&rising, true, true, &mut unkept()).unwrap();
    let sun = sky.sun.as_ref().unwrap().luminance();
    // The Moon stands opposite the Sun, so that its columns count from the other end.
    let opposite = |texel: usize| {
        texel / SKY_SHAPE.azimuths * SKY_SHAPE.azimuths + SKY_SHAPE.azimuths
            - 1
            - texel % SKY_SHAPE.azimuths
    };
    let moon = sky.moon.as_ref().unwrap().luminance();
    let share = largest_share(&moon, |texel| sun[opposite(texel)].y);
    assert!(share < 0.002, "moonlit air in twilight: {share} of the twilight");
}

/// The darkest of a row of the dark sky.
fn darkest(sky: &SkyPlan, row: usize) -> f64 {
    let row = &sky.dark[row * DARK_AZIMUTHS..][..DARK_AZIMUTHS];
    row.iter().map(|light| light.y).fold(f64::INFINITY, f64::min)
}

fn lay_dark_sky(night: &Night, sky: &mut SkyPlan) {
    let (glow, layers) = (NightGlow::default(), Layers::default());
    let catalogs = Catalogs::locate(None).unwrap();
    let mut kept = KeptDarkSky::default();
    let mut ledger = Ledger::default();
    let lights =
        dark_sky::lights(&glow, &layers, night, &catalogs, &mut kept, &mut ledger).unwrap();
    let air = kept.air(night).unwrap();
    dark_sky::lay(&DarkSky::new(&air, lights), sky);
}

fn unkept() -> KeptAir {
    KeptAir::new(Store::NONE)
}

#[test]
fn air_is_solved_once_and_the_ledger_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::in_folder(folder.path(), 1 << 28);
    let scene = at("2026-01-18T19:30:00Z");
    let night = night_of(&scene);
    let setting = scene.setting().unwrap();
    let origin = |kept: &mut Kept| {
        let map: &dyn Fn() -> Result<MoonMaps, CatalogError> =
            &|| unreachable!("the Moon is a point or hidden");
        let layers = Layers { moon: false, ..scene.layers };
        let (_, ledger) = lay_in(&setting, &layers, &night, &map, kept).unwrap();
        ledger.of("sunlit air").unwrap().how.clone()
    };
    let mut kept = Kept::new(store.clone());
    assert_eq!(origin(&mut kept), ["tables of the air: from solving it now"]);
    assert_eq!(origin(&mut kept), ["tables of the air: from the frame before"]);
    assert_eq!(origin(&mut Kept::new(store)), ["tables of the air: from the store"]);
}

#[test]
fn air_is_solved_in_the_background() {
    let folder = tempfile::tempdir().unwrap();
    let solving = SolvedAir::in_background(Store::in_folder(folder.path(), 1 << 28));
    assert!(solving.latest().is_none());
    let (clear, mut hazy) = (Atmosphere::molecular(), Atmosphere::default());
    hazy.aerosol.optical_depth_550 = 0.3;
    solving.ask((hazy.clone(), 0.0));
    solving.ask((clear.clone(), 0.0));
    // The first was overtaken: whether it was half-way or not, the last one is what remains.
    let answer = solving.wait().unwrap();
    let (_, solved) = &*answer;
    assert!(solved.as_ref().unwrap().is_of(&clear, 0.0));
    solving.ask((hazy.clone(), 0.0));
    // The old one stays until the new one is ready.
    let meanwhile = solving.latest().unwrap();
    assert!(meanwhile.1.is_ok());
    assert!(solving.wait().unwrap().1.as_ref().unwrap().is_of(&hazy, 0.0));
    let mut wrong = clear;
    wrong.ozone.column_du = f64::NAN;
    solving.ask((wrong, 0.0));
    assert!(solving.wait().unwrap().1.is_err());
}

#[test]
fn no_picture_ends_in_a_black_half() {
    // Noon, dusk, and a night without a Moon: the ground is lit.
    for utc in ["2026-01-18T19:30:00Z", "2026-01-18T01:10:00Z", "2026-01-18T06:00:00Z"] {
        let (plan, _, _) = laid(&at(utc));
        let sky = plan.sky.luminance(down_by(-20.0)).y;
        for below_deg in [1.0, 10.0, 90.0] {
            let ground = plan.sky.luminance(down_by(below_deg)).y;
            assert!(
                ground > 0.005 * sky && ground < 1.5 * sky,
                "{utc} {below_deg}: {ground} {sky}"
            );
        }
    }
}

#[test]
fn the_ground_fades_into_the_air_before_it() {
    // From a mountain of 2 km by the sea, at noon: the air makes the ground bluer to the horizon.
    let mut scene = at("2026-01-18T19:30:00Z");
    scene.air.ground.height_m = Some(0.0);
    let (plan, _, _) = laid(&scene);
    assert!((-1.5..-1.2).contains(&plan.sky.horizon.deg()), "{}", plan.sky.horizon.deg());
    let blue = |below_deg: f64| {
        let light = plan.sky.luminance(down_by(below_deg));
        light.z / light.x
    };
    // Through the longest paths the blue itself is thinned: bluest is what lies a little nearer.
    assert!(blue(1.6) > 1.2 * blue(90.0) && blue(3.0) > blue(1.6) && blue(3.0) > 1.2 * blue(90.0));
    // It meets the sky without a step: most of what is seen there is air.
    let luminance = |below_deg: f64| plan.sky.luminance(down_by(below_deg)).y;
    let horizon = -plan.sky.horizon.deg();
    let step = luminance(horizon + 0.001) / luminance(horizon - 0.001);
    assert!((step - 1.0).abs() < 0.2, "{step}");
}

#[test]
fn other_air_takes_the_place_of_the_air_before() {
    let night = first(&mut at("2026-01-18T00:00:00Z"), |_| true);
    let height_m = night.sky.place.height_m;
    let mut kept = unkept();
    let lit = |night: &Night, kept: &mut KeptAir| {
        let (sky, origin) = skylight::sky_plan(night, true, false, kept).unwrap();
        (sky.sun.unwrap().view, origin.unwrap())
    };
    let (thick, origin) = lit(&night, &mut kept);
    assert_eq!(origin, Origin::SolvedNow);
    let mut other = night.clone();
    other.air.ozone.column_du = 200.0;
    let (thin, origin) = lit(&other, &mut kept);
    assert_eq!(origin, Origin::SolvedNow);
    let (again, origin) = lit(&other, &mut kept);
    assert_eq!(origin, Origin::FrameBefore);
    assert!(thin == again && thin != thick);
    assert!(kept.of(&other.air, height_m).unwrap().0.is_of(&other.air, height_m));
    assert_eq!(kept.of(&other.air, height_m + 1.0).unwrap().1, Origin::SolvedNow);
}

#[test]
fn stars_twinkle_only_when_asked_and_alike_for_one_seed() {
    let mut scene = at("2026-01-18T06:00:00Z");
    scene.layers.magnitude_limit = Some(5.0);
    let lights = |scene: &Scene| -> Vec<f64> {
        laid(scene).0.splats.iter().map(|splat| splat.illuminance.y).collect()
    };
    let steady = lights(&scene);
    let mut with_seed = |seed| {
        scene.scintillation = Some(Scintillation { seed, ..Scintillation::default() });
        lights(&scene)
    };
    let (one, again, other) = (with_seed(1), with_seed(1), with_seed(2));
    assert_eq!(one, again);
    assert_ne!(one, other);
    let factors: Vec<f64> = one.iter().zip(&steady).map(|(a, b)| a / b).collect();
    let mean = factors.iter().sum::<f64>() / factors.len() as f64;
    // Some hundred stars, each 0.1 to 0.5 off in the rms: the mean is good to 0.02.
    assert!(factors.len() > 200 && (mean - 1.0).abs() < 0.05, "{} {mean}", factors.len());
    assert!(factors.iter().any(|factor| (factor - 1.0).abs() > 0.1));
}

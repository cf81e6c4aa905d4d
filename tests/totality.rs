//! The sky in a total eclipse of the Sun, against random paths and against what was measured.

use std::sync::LazyLock;

use glam::DVec3;
use nocturne::air::Atmosphere;
use nocturne::air::monte_carlo::{Effort, MonteCarlo};
use nocturne::air::scattering::SKY_NODES_NM;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::Ephemeris;
use nocturne::frame::Dir;
use nocturne::light::moon_shadow::MoonShadow;
use nocturne::light::night::Night;
use nocturne::light::night_lights::NightGlow;
use nocturne::place::Place;
use nocturne::plan::SkyPlan;
use nocturne::plan::brightness::{MeasuredSky, Source};
use nocturne::plan::lay::Kept;
use nocturne::plan::skylight::{KeptAir, SolvedAir, sky_plan};
use nocturne::scene::Layers;
use nocturne::sky::SkyState;
use nocturne::store::Store;
use nocturne::time::{self, Instant};
use nocturne::units::{Angle, Xyzv};

static EPHEMERIS: LazyLock<Ephemeris> = LazyLock::new(|| {
    let catalogs = Catalogs::locate(None).expect("the catalogues of this repository");
    Ephemeris::load(&catalogs, Angle::from_arcsec(0.1)).expect("tables that are whole")
});

fn instant(text: &str) -> Instant {
    time::to_instant(&time::parse(text).expect("a time"), None).expect("within range")
}

/// Near Torreon, on the line of the eclipse of 2024-04-08, Sun 70 degrees high.
const TORREON: (f64, f64, f64) = (25.54, -103.41, 1120.0);

fn night(utc: &str, (latitude, longitude, height_m): (f64, f64, f64)) -> Night {
    let place = Place::new(latitude, longitude, height_m).expect("a place");
    let tolerance = Angle::from_arcsec(0.1);
    let sky = SkyState::at(&EPHEMERIS, &instant(utc), &place, tolerance).expect("served");
    Night::of(sky, Vec::new(), &Atmosphere::default())
}

fn plan(night: &Night) -> SkyPlan {
    let mut kept = KeptAir::new(Store::NONE);
    sky_plan(night, true, false, &mut kept).expect("solved").0
}

fn luminance(plan: &SkyPlan, azimuth_deg: f64, altitude_deg: f64) -> f64 {
    let [azimuth, altitude] = [azimuth_deg, altitude_deg].map(Angle::from_deg);
    plan.luminance(Dir::from_azimuth_altitude(azimuth, altitude)).y
}

/// Illuminance of level ground by the sky, lux.
fn illuminance(plan: &SkyPlan) -> f64 {
    let mut sum = 0.0;
    for ring in 0..30 {
        let sine = (f64::from(ring) + 0.5) / 30.0;
        for turn in 0..36 {
            let light = luminance(plan, f64::from(turn) * 10.0, sine.asin().to_degrees());
            sum += light * sine / 30.0 * std::f64::consts::TAU / 36.0;
        }
    }
    sum
}

#[test]
fn totality_against_random_paths() {
    let night = night("2024-04-08T18:18:45Z", TORREON);
    let covered = night.eclipse.sun.expect("an eclipse");
    println!("magnitude {:.4}, Sun {:.1}", covered.magnitude(), night.sky.sun.dir.altitude().deg());
    assert!(covered.is_total());
    let height_m = night.sky.place.height_m;
    let solved = SolvedAir::solve(&night.air, height_m).expect("solved");

    let shadow = MoonShadow::of(&night.sky, SKY_NODES_NM);
    let sun = night.sky.sun.dir;
    let (sin, cos) = sun.azimuth().sin_cos();
    let (ahead, right) = (DVec3::new(sin, cos, 0.0), DVec3::new(cos, -sin, 0.0));
    let eye = DVec3::Z * (height_m / 1000.0);
    let left_at = |at: DVec3| shadow.left_at(ahead * at.x + right * at.y + DVec3::Z * at.z - eye);
    let paths = MonteCarlo::new(&night.air, height_m, &SKY_NODES_NM).expect("air");
    let eye_km = night.air.eye_km(height_m);
    let cos_zenith = sun.altitude().sin();
    let tables = solved.tables();
    let rays = tables.sky_rays(eye_km, nocturne::plan::skylight::COMPUTED_SHAPE);
    let view = tables.sky_view(&rays, cos_zenith);
    let shading = tables.shading(&view, eye_km, cos_zenith, &left_at).expect("eight nodes");
    let sides = [shading.of(&view, 0), shading.of(&view, 1)];
    let effort = Effort { relative_error: 0.05, most_paths: 400_000, seed: 3 };
    let mut worst = 0.0f64;
    for (azimuth_deg, altitude_deg) in [
        (0.0, 90.0),
        (0.0, 45.0),
        (180.0, 30.0),
        (90.0, 15.0),
        (0.0, 6.0),
        (-90.0, 2.0),
        (180.0, 2.0),
    ] {
        let [azimuth, altitude] = [azimuth_deg, altitude_deg].map(Angle::from_deg);
        let truth =
            paths.radiance_in_shade(eye_km, cos_zenith, (altitude, azimuth), &left_at, &effort);
        let plain = paths.radiance(
            eye_km,
            cos_zenith,
            altitude,
            azimuth,
            &Effort { relative_error: 0.01, ..effort },
        );
        let mut ours = [0.0; 8];
        sides[usize::from(azimuth_deg < 0.0)].sample(altitude, azimuth, &mut ours);
        for lane in [2, 4, 6] {
            let (truth, plain) = (&truth[lane], &plain[lane]);
            let ratio = ours[lane] / truth.total();
            println!(
                "{azimuth_deg:4} {altitude_deg:3} {} nm: {:.2e} of day, once {:.2}, ours/paths {ratio:.3} ± {:.3}",
                SKY_NODES_NM[lane],
                truth.total() / plain.total(),
                truth.first_order / truth.total(),
                truth.standard_error / truth.total(),
            );
            worst = worst.max(ratio.ln().abs());
        }
    }
    println!("worst: a factor of {:.2}", worst.exp());
    assert!(worst.exp() < 1.4);
}

#[test]
fn totality_is_as_dark_as_measured() {
    let dark = night("2024-04-08T18:18:45Z", TORREON);
    let bright = night("2024-04-07T18:18:45Z", TORREON);
    let (dark_plan, bright_plan) = (plan(&dark), plan(&bright));
    for (name, plan) in [("day", &bright_plan), ("totality", &dark_plan)] {
        println!(
            "{name}: zenith {:.3} cd/m2, 30° {:.3} {:.3} {:.3} {:.3}, 2° {:.3} {:.3} {:.3} {:.3}, ground {:.2} lx",
            luminance(plan, 0.0, 90.0),
            luminance(plan, 0.0, 30.0),
            luminance(plan, 90.0, 30.0),
            luminance(plan, 180.0, 30.0),
            luminance(plan, 270.0, 30.0),
            luminance(plan, 0.0, 2.0),
            luminance(plan, 90.0, 2.0),
            luminance(plan, 180.0, 2.0),
            luminance(plan, 270.0, 2.0),
            illuminance(plan),
        );
    }
    // Zenith by day some 3 to 7 thousand cd/m2; in totality 13 to 11.5 magnitudes per square second of arc
    // (recalled), and 1 to 10 lx on the ground.
    let zenith = |plan: &SkyPlan| luminance(plan, 0.0, 90.0);
    let share = zenith(&dark_plan) / zenith(&bright_plan);
    assert!((2e-5..3e-4).contains(&share), "{share:e}");
    assert!((1.0..10.0).contains(&illuminance(&dark_plan)), "{}", illuminance(&dark_plan));
    // A bright ring all around, and yellow: less blue in it than overhead.
    let light = |azimuth: f64, altitude: f64| {
        let [azimuth, altitude] = [azimuth, altitude].map(Angle::from_deg);
        dark_plan.luminance(Dir::from_azimuth_altitude(azimuth, altitude))
    };
    let blue = |light: Xyzv| light.z / light.y;
    for azimuth in [0.0, 60.0, 120.0, 180.0, 240.0, 300.0] {
        let (ring, high) = (light(azimuth, 2.0), light(azimuth, 90.0));
        assert!(ring.y > 3.0 * high.y, "{azimuth}: {} {}", ring.y, high.y);
        assert!(blue(ring) < 0.8 * blue(high), "{azimuth}: {} {}", blue(ring), blue(high));
    }
}

#[test]
fn the_sky_of_the_eclipsed_moon_is_that_of_a_moonless_night() {
    let flagstaff = (35.2, -111.65, 2106.0);
    let catalogs = Catalogs::locate(None).unwrap();
    // With the Moon, and the dark sky alone.
    let seen = |utc: &str| {
        let night = night(utc, flagstaff);
        assert!(night.sky.sun.dir.altitude().deg() < -18.0);
        assert!(night.sky.moon.state.dir.altitude().deg() > 15.0);
        let mut kept = Kept::new(Store::NONE);
        let (glow, layers) = (NightGlow::default(), Layers::default());
        let sky = MeasuredSky::of(&night, &glow, &layers, &catalogs, &mut kept).unwrap();
        [(0.0, 90.0), (0.0, 40.0), (180.0, 40.0)].map(|(azimuth, altitude)| {
            let dir =
                Dir::from_azimuth_altitude(Angle::from_deg(azimuth), Angle::from_deg(altitude));
            let seen = sky.at(dir, &mut kept).unwrap();
            let dark = seen.sources.iter().filter(|(source, _)| matches!(source, Source::Dark(_)));
            [seen.luminance().y, dark.map(|(_, light)| light.xyzv().y).sum()]
        })
    };
    let [before, dark] = ["2026-03-03T07:44:00Z", "2026-03-03T11:33:40Z"];
    for ([full, _], [eclipsed, moonless]) in seen(before).into_iter().zip(seen(dark)) {
        println!("cd/m2: full {full:.2e}, eclipsed {eclipsed:.3e}, moonless {moonless:.3e}");
        assert!(eclipsed > moonless && eclipsed < 1.03 * moonless);
        // By some 3 magnitudes per square second of arc.
        assert!(full > 8.0 * moonless);
    }
}

//! Town glow against published laws of its amount and its fall with distance, and against itself.

use nocturne::air::Atmosphere;
use nocturne::light::lamps::Lamps;
use nocturne::light::photometry::luminance_cd_m2;
use nocturne::light::town_glow::{
    GlowTables, MOST_TOWNS, NATURAL_ZENITH_MAG, Town, TownGlow, TownLight, bortle_zenith_mag,
    towns_around,
};
use nocturne::place::Place;
use nocturne::place::gazetteer::Gazetteer;
use nocturne::units::{Angle, Xyzv};

fn deg(deg: f64) -> Angle {
    Angle::from_deg(deg)
}

fn tables() -> GlowTables {
    GlowTables::solve(&Atmosphere::default(), 0.0).unwrap()
}

fn town(population: f64, distance_km: f64, bearing_deg: f64) -> Town {
    Town { name: "A".into(), population, bearing: deg(bearing_deg), distance_km }
}

fn glow_of(towns: Vec<Town>, tables: &GlowTables) -> TownGlow {
    TownGlow::new(&TownLight::Towns(towns), Lamps::Mixed, tables)
}

fn magnitude(artificial: Xyzv) -> f64 {
    let natural = luminance_cd_m2(NATURAL_ZENITH_MAG);
    NATURAL_ZENITH_MAG - 2.5 * ((artificial.y + natural) / natural).log10()
}

#[test]
fn towns_far_away_follow_walkers_law() {
    let tables = tables();
    // A dark sky half-way up.
    let natural = luminance_cd_m2(21.85);
    let mut ratios = Vec::new();
    for population in [2e4, 1e5, 1e6] {
        for distance_km in [20.0, 30.0, 40.0, 50.0, 60.0, 80.0] {
            let glow = glow_of(vec![town(population, distance_km, 70.0)], &tables);
            let got = glow.luminance(deg(45.0), deg(70.0)).y / natural;
            let walker = 0.01 * population * f64::powf(distance_km, -2.5);
            println!("{population:.0} at {distance_km} km: {:.3} of Walker's", got / walker);
            ratios.push(got / walker);
        }
    }
    let apart = |ratio: &&f64| !(1.0 / 1.5..1.5).contains(*ratio);
    assert_eq!(ratios.iter().find(apart), None, "{ratios:?}");
    let mean = ratios.iter().map(|r| r.ln()).sum::<f64>() / ratios.len() as f64;
    assert!(mean.abs() < 0.2, "{mean}");
}

#[test]
fn a_city_of_a_million_has_the_zenith_of_a_city() {
    let tables = tables();
    for (population, low, high) in [(1e6, 17.5, 18.5), (1e5, 18.6, 19.8), (1e4, 19.8, 21.0)] {
        let glow = glow_of(vec![town(population, 0.0, 0.0)], &tables);
        let zenith = magnitude(glow.luminance(deg(90.0), deg(0.0)));
        println!("{population}: {zenith:.2}");
        for altitude in [0.0, 5.0, 10.0, 30.0, 60.0] {
            println!("   {altitude}: {:.2}", magnitude(glow.luminance(deg(altitude), deg(0.0))));
        }
        assert!((low..high).contains(&zenith), "{population}: {zenith}");
        // In its middle all azimuths are alike, within what arcs of the even disc are.
        let at = |azimuth| glow.luminance(deg(20.0), deg(azimuth)).y;
        for azimuth in [77.0, 180.0, 301.0] {
            assert!((at(azimuth) / at(0.0) - 1.0).abs() < 1e-3);
        }
    }
}

#[test]
fn a_bortle_class_has_its_zenith() {
    let tables = tables();
    let mut before = 0.0;
    for class in 1..=9 {
        let wanted = bortle_zenith_mag(class).unwrap();
        for light in [TownLight::Bortle(class), TownLight::Zenith { mag_per_arcsec2: wanted }] {
            assert_eq!(light.validate(), Ok(()));
            for lamps in Lamps::ALL {
                let glow = TownGlow::new(&light, lamps, &tables);
                let zenith = magnitude(glow.luminance(deg(90.0), deg(123.0)));
                assert!((zenith - wanted).abs() < 0.02, "{class} {lamps:?}: {zenith}");
            }
        }
        let glow = TownGlow::new(&TownLight::Bortle(class), Lamps::Mixed, &tables);
        let at = |altitude| glow.luminance(deg(altitude), deg(0.0)).y;
        println!("{class}: {wanted} {:?}", [5.0, 10.0, 20.0, 45.0].map(|a| at(a) / at(90.0)));
        // Brighter by class, overhead and low; brightest low down, with the same all round.
        assert!(at(10.0) > before || class == 1, "{class}");
        before = at(10.0);
        if class > 1 {
            assert!(at(10.0) > 2.0 * at(90.0) && at(10.0) > at(30.0) && at(30.0) > at(60.0));
            let other = glow.luminance(deg(10.0), deg(234.0)).y;
            assert!((other / at(10.0) - 1.0).abs() < 1e-9);
        }
    }
    for dark in [TownLight::None, TownLight::Bortle(1), TownLight::Zenith { mag_per_arcsec2: 22.5 }]
    {
        let glow = TownGlow::new(&dark, Lamps::Mixed, &tables);
        assert_eq!(glow.ground_illuminance(), Xyzv::BLACK);
        assert_eq!(glow.luminance(deg(5.0), deg(5.0)), Xyzv::BLACK);
    }
}

#[test]
fn a_dome_stands_over_its_town() {
    let tables = tables();
    let glow = glow_of(vec![town(3e5, 35.0, 130.0)], &tables);
    let at = |altitude, azimuth| glow.luminance(deg(altitude), deg(azimuth)).y;
    for altitude in [3.0, 10.0, 30.0] {
        // Falls to both sides alike.
        let mut before = at(altitude, 130.0);
        for apart in [10.0, 30.0, 60.0, 120.0, 180.0] {
            let (left, right) = (at(altitude, 130.0 - apart), at(altitude, 130.0 + apart));
            assert!((left / right - 1.0).abs() < 1e-6, "{altitude} {apart}: {left:e} {right:e}");
            // Molecules send a little more back than aside.
            assert!(left < before * 1.02, "{altitude} {apart}: {left:e} {before:e}");
            before = left;
        }
    }
    // Brightest low down: ten times the zenith, which has no azimuth.
    assert!(at(5.0, 130.0) > 10.0 * at(90.0, 130.0) && at(5.0, 130.0) > at(15.0, 130.0));
    assert!((at(90.0, 0.0) / at(90.0, 130.0) - 1.0).abs() < 0.01);
    // Wherever it stands it sends as much, and two send twice as much as one.
    let ground = glow.ground_illuminance().y;
    let turned = glow_of(vec![town(3e5, 35.0, 11.3)], &tables).ground_illuminance().y;
    assert!((turned / ground - 1.0).abs() < 1e-3, "{turned:e} {ground:e}");
    let two = glow_of(vec![town(3e5, 35.0, 130.0), town(3e5, 35.0, 310.0)], &tables);
    assert!((two.ground_illuminance().y / ground / 2.0 - 1.0).abs() < 0.01);
    let sum = at(20.0, 100.0) + at(20.0, 280.0);
    assert!((two.luminance(deg(20.0), deg(100.0)).y / sum - 1.0).abs() < 0.01);
}

#[test]
fn towns_fade_with_distance_and_nothing_is_not_a_number() {
    let tables = tables();
    let altitudes = [0.0, 0.5, 1.0, 17.0, 89.9, 90.0].map(deg);
    let azimuths = [0.0, 90.0, 180.0, 359.9].map(deg);
    let mut before = f64::INFINITY;
    for distance_km in [0.0, 0.01, 1.0, 3.0, 10.0, 30.0, 90.0, 150.0, 240.0] {
        let glow = glow_of(vec![town(1e5, distance_km, 0.0)], &tables);
        let grid = glow.luminances(&altitudes, &azimuths);
        assert_eq!(grid.len(), 24);
        for light in &grid {
            let all = [light.x, light.y, light.z, light.v];
            assert!(all.iter().all(|v| v.is_finite() && *v >= 0.0), "{distance_km}: {light:?}");
        }
        let ground = glow.ground_illuminance().y;
        assert!(ground > 0.0 && ground < before * 1.01, "{distance_km} km: {ground:e}");
        before = ground;
        // The quick way is the spectrum's.
        for (i, light) in grid.iter().enumerate() {
            let slow = glow.radiance(altitudes[i / 4], azimuths[i % 4]).xyzv();
            assert!((slow.y - light.y).abs() <= 0.02 * light.y + 1e-12, "{slow:?} {light:?}");
            assert!((slow.v - light.v).abs() <= 0.02 * light.v + 1e-12, "{slow:?} {light:?}");
        }
    }
    // At 240 km a hundred thousand people are nothing beside the stars, 1e-3 lux in all.
    assert!(before < 1e-6, "{before:e}");
    let glow = glow_of(vec![town(1e5, 30.0, 0.0)], &tables);
    assert!(glow.luminance(deg(f64::NAN), deg(f64::NAN)).y.is_finite());
    assert!(glow_of(vec![town(0.0, 1.0, 0.0)], &tables).luminance(deg(9.0), deg(9.0)).y == 0.0);
}

#[test]
fn haze_dims_far_towns_and_heights_are_darker() {
    let mut hazy = Atmosphere::default();
    hazy.aerosol.optical_depth_550 = 0.5;
    let hazy = GlowTables::solve(&hazy, 0.0).unwrap();
    let far = |tables: &GlowTables| {
        glow_of(vec![town(1e6, 100.0, 0.0)], tables).luminance(deg(10.0), deg(0.0)).y
    };
    let clear = tables();
    assert!(far(&hazy) < 0.7 * far(&clear), "{:e} {:e}", far(&hazy), far(&clear));
    // From a mountain by the sea there is less air overhead.
    let mut air = Atmosphere::default();
    air.ground.height_m = Some(0.0);
    let high = GlowTables::solve(&air, 3000.0).unwrap();
    let near = |tables: &GlowTables| {
        glow_of(vec![town(1e5, 30.0, 0.0)], tables).luminance(deg(90.0), deg(0.0)).y
    };
    assert!(near(&high) < 0.7 * near(&clear), "{:e} {:e}", near(&high), near(&clear));
}

#[test]
fn sodium_is_dimmer_to_rods_than_diodes() {
    let tables = tables();
    let ratio = |lamps| {
        let light = TownLight::Towns(vec![town(1e5, 20.0, 0.0)]);
        let light = TownGlow::new(&light, lamps, &tables).luminance(deg(45.0), deg(0.0));
        light.v / light.y
    };
    let ratios =
        [Lamps::LowPressureSodium, Lamps::Sodium, Lamps::Mixed, Lamps::Led3000, Lamps::Led4000]
            .map(ratio);
    println!("{ratios:?}");
    assert!(ratios.windows(2).all(|pair| pair[0] < pair[1]), "{ratios:?}");
    // Scattered light is bluer than the lamps near the town: the air sends down more of the blue.
    assert!(ratios[4] > 1.6 && ratios[0] < 0.3, "{ratios:?}");
}

#[test]
fn towns_of_the_list_are_found_brightest_first() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/catalogs/places.csv"));
    let list = Gazetteer::parse(&text.unwrap()).unwrap();
    let place = Place::new(35.0, -111.5, 2100.0).unwrap();
    let towns = towns_around(&place, list.cities());
    let names: Vec<&str> = towns.iter().map(|town| town.name.as_str()).collect();
    println!("{names:?}");
    assert!(names[..2].contains(&"Flagstaff") && names.contains(&"Phoenix"), "{names:?}");
    let phoenix = towns.iter().find(|town| town.name == "Phoenix").unwrap();
    assert!((phoenix.distance_km - 180.0).abs() < 15.0, "{}", phoenix.distance_km);
    assert!((180.0..210.0).contains(&phoenix.bearing.deg()), "{}", phoenix.bearing.deg());
    // Among many no more than can be drawn; on the sea none.
    let ruhr = Place::new(51.5, 7.2, 100.0).unwrap();
    assert_eq!(towns_around(&ruhr, list.cities()).len(), MOST_TOWNS);
    let sea = Place::new(-48.0, -123.0, 0.0).unwrap();
    assert!(towns_around(&sea, list.cities()).is_empty());
}

#[test]
fn numbers_that_cannot_be_are_refused_with_a_way_out() {
    let says = |light: TownLight| light.validate().unwrap_err().to_string();
    assert_eq!(
        says(TownLight::Bortle(10)),
        "town light: there is no Bortle class 10; give one from 1 (dark) to 9 (inner city)"
    );
    assert!(says(TownLight::Bortle(0)).contains("class 0"));
    assert_eq!(
        says(TownLight::Zenith { mag_per_arcsec2: 9.0 }),
        "town light: a zenith of 9 mag/arcsec2 is outside 14 to 23; 22 is a dark sky, 18 a city"
    );
    assert!(says(TownLight::Zenith { mag_per_arcsec2: f64::NAN }).contains("NaN"));
    assert_eq!(
        says(TownLight::Towns(vec![town(f64::INFINITY, 1.0, 0.0)])),
        "town light: A has a population of inf; give a finite number, not negative"
    );
    assert!(says(TownLight::Towns(vec![town(1.0, -1.0, 0.0)])).contains("distance in km of -1"));
}

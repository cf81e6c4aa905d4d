//! Town glow against published laws of its amount and its fall with distance, and against itself.

use nocturne::air::Atmosphere;
use nocturne::light::diffuse::{NightSky, luminance_cd_m2};
use nocturne::light::lamps::Lamps;
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
    let natural = NightSky::default().through(&Atmosphere::default(), 0.0).unwrap();
    let natural = natural.luminance(0.0, deg(45.0)).y;
    let mut ratios = Vec::new();
    for population in [2e4, 1e5, 1e6] {
        for distance_km in [20.0, 30.0, 40.0, 50.0, 60.0, 80.0] {
            let glow = glow_of(vec![town(population, distance_km, 70.0)], &tables);
            let got = glow.luminance(deg(45.0), deg(70.0)).y / natural;
            let walker = 0.01 * population * f64::powf(distance_km, -2.5);
            println!("{population:.0} at {distance_km} km: {:.3} of Walker's", got / walker);
            ratios.push(got / walker);
            assert!((1.0 / 1.5..1.5).contains(&(got / walker)), "{population} {distance_km}");
        }
    }
    let mean = ratios.iter().map(|r| r.ln()).sum::<f64>() / ratios.len() as f64;
    assert!(mean.abs() < 0.2, "{mean}");
}

#[test]
fn a_city_of_a_million_has_the_zenith_of_a_city() {
    let tables = tables();
    for (population, low, high) in [(1e6, 17.3, 18.5), (1e5, 18.2, 19.6), (1e4, 19.3, 20.8)] {
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

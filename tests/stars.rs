//! The reduction of stars against ERFA, with the Earth given, so that nothing else is compared.

use std::collections::BTreeMap;

use glam::DVec3;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::apparent::Observer;
use nocturne::ephemeris::stars::{SpaceMotion, StarReduction};
use nocturne::ephemeris::{EarthState, Ephemeris};
use nocturne::frame::{Dir, Icrs, Pos};
use nocturne::place::Place;
use nocturne::time::{Instant, JulianDate};
use nocturne::units::Angle;

const ERFA: &str = include_str!("truth/stars_erfa.csv");

/// Arcseconds. ERFA brings Barnard's star from J1991.25 to J2000.0 with the light time of the star.
const TOLERANCES_ARCSEC: [(&str, f64); 3] =
    [("Sirius", 1e-5), ("Polaris", 1e-5), ("Barnard", 1e-3)];

#[test]
fn stars_stand_where_erfa_puts_them_given_the_earth() {
    let catalogue = Catalogs::locate(None).unwrap().astrometry().unwrap();
    let place = Place::new(0.0, 0.0, 0.0).unwrap();
    let mut largest: BTreeMap<&str, f64> = BTreeMap::new();
    let is_row = |line: &&str| !line.starts_with('#') && !line.starts_with("star,");
    for line in ERFA.lines().filter(is_row) {
        let (name, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|cell| cell.parse().unwrap()).collect();
        let vector = |first: usize| DVec3::from_slice(&numbers[first..]);
        let tdb = JulianDate::from_parts(numbers[0], numbers[1]);
        let tt = tdb.read_on(0.0);
        let instant = Instant { utc: tt.read_on(0.0), ut1: tt.read_on(0.0), tt, tdb };
        let observer = Observer::at(&Ephemeris::analytic(), &instant, &place, Angle::ZERO);
        let earth = EarthState {
            position: Pos::from_km(vector(2)),
            velocity_km_s: vector(5),
            sun: Pos::from_km(vector(8)),
        };
        let truth: Dir<Icrs> = Dir::from_vector(vector(11));
        let star = catalogue.iter().find(|star| star.names.iter().any(|n| n == name)).unwrap();
        let reduction = StarReduction::new(&observer, &earth);
        let error = reduction.geocentric(star).separation(observer.true_from_icrs * truth);
        let largest = largest.entry(name).or_default();
        *largest = largest.max(error.arcsec());
    }
    println!("{largest:?}");
    for (name, tolerance_arcsec) in TOLERANCES_ARCSEC {
        assert!(largest[name] < tolerance_arcsec, "{name}: {}\"", largest[name]);
    }
}

#[test]
fn a_place_on_the_earth_sees_stars_by_its_own_velocity_and_parallax() {
    let catalogs = Catalogs::locate(None).unwrap();
    let star = SpaceMotion::from(&catalogs.astrometry().unwrap()[0]);
    let tt = JulianDate::from_jd(2_451_545.0);
    let instant = Instant::from_tt(tt).unwrap();
    let earth = EarthState {
        position: Pos::ORIGIN,
        velocity_km_s: DVec3::ZERO,
        sun: Pos::from_km(DVec3::new(0.0, 0.0, -1.5e8)),
    };
    let place = Place::new(0.0, 0.0, 0.0).unwrap();
    let observer = Observer::at(&Ephemeris::analytic(), &instant, &place, Angle::ZERO);
    let reduction = StarReduction::new(&observer, &earth);
    let (centre, surface) = (reduction.geocentric(star), reduction.topocentric(star));
    // Diurnal aberration: 0.465 km/s at the equator over the speed of light is 0.320".
    let tilt = surface.vector() - centre.vector();
    let velocity = (observer.true_from_icrs * Pos::from_km(observer.velocity_km_s)).km();
    let expected = velocity / 299_792.458;
    let expected = expected - centre.vector() * expected.dot(centre.vector());
    assert!((velocity.length() - 0.465).abs() < 1e-3);
    // Sirius' parallax over an Earth's radius: 0.000016".
    assert!((tilt - expected).length() < 1e-10, "{}", (tilt - expected).length());
    let horizon = reduction.horizon(star);
    let back = observer.true_from_icrs * (observer.horizon_from_icrs.inverse() * horizon);
    assert!(back.separation(surface).arcsec() < 1e-8);
}

#[test]
fn a_catalogue_at_once_is_its_stars_one_by_one() {
    let stars = Catalogs::locate(None).unwrap().stars().unwrap();
    let instant = Instant::from_tt(JulianDate::from_jd(2_460_000.0)).unwrap();
    let observer = Observer::at(
        &Ephemeris::analytic(),
        &instant,
        &Place::new(35.0, -111.0, 2100.0).unwrap(),
        Angle::ZERO,
    );
    let ephemeris = nocturne::ephemeris::Ephemeris::analytic();
    let earth = ephemeris.earth(instant.tdb, nocturne::ephemeris::Tier::Series).unwrap();
    let reduction = StarReduction::new(&observer, &earth);
    let all = reduction.horizon_all(&stars);
    assert_eq!(all.len(), stars.len());
    assert!(stars.iter().zip(&all).all(|(star, dir)| reduction.horizon(star) == *dir));
}

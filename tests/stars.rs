//! The reduction of stars against ERFA, with the Earth given, so that nothing else is compared.

use std::collections::BTreeMap;

use glam::DVec3;
use nocturne::air::Atmosphere;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::apparent::Observer;
use nocturne::ephemeris::stars::{SpaceMotion, StarReduction};
use nocturne::ephemeris::{EarthState, Ephemeris};
use nocturne::frame::{Dir, Icrs, Pos};
use nocturne::light::night::{Kind, LitObject, Night, StarSearch};
use nocturne::place::Place;
use nocturne::sky::SkyState;
use nocturne::time::{self, Instant, JulianDate};
use nocturne::units::{Angle, Magnitude};

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

fn night(utc: &str, latitude_deg: f64) -> Night {
    let catalogs = Catalogs::locate(None).unwrap();
    let instant = time::to_instant(&time::parse(utc).unwrap(), None).unwrap();
    let place = Place::new(latitude_deg, -111.6, 2100.0).unwrap();
    let tolerance = Angle::from_arcmin(30.0);
    let sky = SkyState::at(&Ephemeris::analytic(), &instant, &place, tolerance);
    Night::of(sky.unwrap(), catalogs.stars().unwrap(), &Atmosphere::default())
}

#[test]
fn the_index_finds_every_star_of_a_view_and_no_other_in_any_millennium() {
    for utc in ["-3000-03-01T04:00:00Z", "2026-08-13T04:30:00Z", "3900-01-01T06:00:00Z"] {
        let night = night(utc, 35.0);
        let all: Vec<LitObject> = night.lit_stars().collect();
        for (azimuth_deg, altitude_deg, radius_deg, faintest) in [
            (0.0, 90.0, 180.0, None),
            (150.0, 35.0, 50.0, None),
            (300.0, 1.0, 4.0, None),
            (77.0, -4.0, 6.0, None),
            (200.0, 60.0, 0.7, None),
            (10.0, 20.0, 40.0, Some(Magnitude(4.5))),
            (180.0, -60.0, 30.0, None),
        ] {
            let centre = Dir::from_azimuth_altitude(
                Angle::from_deg(azimuth_deg),
                Angle::from_deg(altitude_deg),
            );
            let radius = Angle::from_deg(radius_deg);
            let number = |star: &LitObject| match star.kind {
                Kind::Star(number) => number,
                _ => panic!("{star:?} is no star"),
            };
            let mut found = night.stars_in(centre, radius, faintest);
            found.sort_by_key(number);
            let is_wanted = |star: &&LitObject| {
                star.apparent.separation(centre) <= radius
                    && star.apparent.altitude() >= night.horizon
                    && faintest.is_none_or(|limit| star.magnitude.0 <= limit.0)
            };
            let wanted: Vec<LitObject> = all.iter().filter(is_wanted).cloned().collect();
            found.retain(|star| star.apparent.altitude() >= night.horizon);
            let what = format!("{utc} {azimuth_deg} {altitude_deg} {radius_deg}");
            assert_eq!(found.len(), wanted.len(), "{what}");
            // The same stars, in the same places, with the same light.
            assert!(found == wanted, "{what}");
        }
    }
}

#[test]
fn every_star_of_a_search_is_found_or_accounted_for() {
    let night = night("2026-08-13T04:30:00Z", 35.0);
    let search = |altitude_deg, radius_deg, limit: Option<f64>, drowned: Option<f64>| {
        let centre = Dir::from_azimuth_altitude(Angle::ZERO, Angle::from_deg(altitude_deg));
        let radius = Angle::from_deg(radius_deg);
        let (limit, drowned) = (limit.map(Magnitude), drowned.map(Magnitude));
        let found = night.search_stars(&StarSearch { centre, radius, limit, drowned });
        let left = found.fainter_than_limit + found.below_horizon + found.out_of_view;
        assert_eq!(found.stars.len() + left + found.drowned, night.stars.len());
        found
    };
    let half = search(90.0, 180.0, None, None);
    assert!(half.stars.len() > 4000 && half.below_horizon > 4000 && half.out_of_view == 0);
    assert!(search(30.0, 40.0, Some(2.0), None).fainter_than_limit > 9000);
    let by_day = search(30.0, 40.0, None, Some(-4.0));
    assert!(by_day.stars.is_empty() && by_day.drowned > 500);
    assert!(search(-80.0, 30.0, None, None).stars.is_empty());
}

#[test]
fn light_of_stars_is_kept_for_the_same_air_and_place_alone() {
    let first = night("2026-08-13T04:30:00Z", 35.0);
    let kept: *const _ = first.starlight();
    let second = night("2026-08-13T04:31:00Z", 36.0).keeping_starlight_of(&first);
    assert!(std::ptr::eq(kept, second.starlight()));
    let mut hazy = night("2026-08-13T04:31:00Z", 35.0);
    hazy.air.aerosol.optical_depth_550 = 0.4;
    assert!(!std::ptr::eq(kept, hazy.keeping_starlight_of(&first).starlight()));
}

#[test]
fn arcturus_moves_through_space_for_millennia() {
    let stars = Catalogs::locate(None).unwrap().stars().unwrap();
    let arcturus = stars.iter().find(|star| star.name.as_deref() == Some("Arcturus")).unwrap();
    // In parsecs, with 4.740 47 km/s for one arcsecond a year at one parsec.
    let (ra, dec) = (arcturus.dir_j2000.longitude(), arcturus.dir_j2000.latitude());
    let (sin_ra, cos_ra) = ra.rad().sin_cos();
    let (sin_dec, cos_dec) = dec.rad().sin_cos();
    let out = DVec3::new(cos_dec * cos_ra, cos_dec * sin_ra, sin_dec);
    let east = DVec3::new(-sin_ra, cos_ra, 0.0);
    let north = DVec3::new(-sin_dec * cos_ra, -sin_dec * sin_ra, cos_dec);
    let parsecs = 1.0 / arcturus.parallax_arcsec;
    let across_km_s = |arcsec_yr: f64| 4.740_47 * arcsec_yr * parsecs;
    let velocity_km_s = out * arcturus.radial_velocity_km_s
        + east * across_km_s(arcturus.proper_motion_ra_arcsec_yr)
        + north * across_km_s(arcturus.proper_motion_dec_arcsec_yr);
    // A kilometre a second is 1.022 712e-6 parsecs a Julian year.
    let years = -5000.0;
    let then = out * parsecs + velocity_km_s * (1.022_712e-6 * years);
    let tdb = JulianDate::from_jd(2_451_545.0 + 365.25 * years);
    let moved = SpaceMotion::from(arcturus).direction(tdb);
    let off = moved.separation(Dir::from_vector(then));
    // The constants have six digits, the way is 3 degrees.
    assert!(off.arcsec() < 0.05, "{}", off.arcsec());
    let way = moved.separation(arcturus.dir_j2000).deg();
    assert!((3.0..3.3).contains(&way), "{way}");
}

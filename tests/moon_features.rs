//! Named places on the Moon, and the moons of Jupiter, as they stand in the sky of a place.

use nocturne::air::Atmosphere;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris, Galilean};
use nocturne::frame::Dir;
use nocturne::light::night::{Kind, Night};
use nocturne::place::Place;
use nocturne::sky::SkyState;
use nocturne::time::{self, Instant, JulianDate};
use nocturne::units::{Angle, MOON_RADIUS_KM};

const TOLERANCE: Angle = Angle::from_arcsec(0.1);

fn catalogs() -> Catalogs {
    Catalogs::locate(None).expect("the catalogues of the source tree")
}

fn ephemeris() -> Ephemeris {
    Ephemeris::load(&catalogs(), TOLERANCE).expect("the tables")
}

fn sky(ephemeris: &Ephemeris, at: &str) -> SkyState {
    let place = Place::new(35.2, -111.65, 2100.0).expect("a place");
    let instant = time::to_instant(&time::parse(at).expect("a time"), None).expect("an instant");
    SkyState::at(ephemeris, &instant, &place, TOLERANCE).expect("a sky")
}

fn night(at: &str) -> Night {
    Night::of(sky(&ephemeris(), at), Vec::new(), &Atmosphere::default())
        .with_moon_features(catalogs().moon_features().expect("the names"))
}

#[test]
fn the_well_known_are_there_and_found_by_name() {
    let night = night("2026-08-27T06:00Z");
    assert!(night.moon_features.len() >= 120, "{}", night.moon_features.len());
    for (name, longitude_deg, latitude_deg) in [
        ("tycho", -11.2, -43.3),
        ("Moon/Copernicus", -20.1, 9.6),
        ("Plato", -9.4, 51.6),
        ("Mare Crisium", 59.1, 16.2),
        ("Aristarchus", -47.5, 23.7),
        ("Apollo 11", 23.47, 0.67),
    ] {
        let feature = night.moon_feature(name).unwrap_or_else(|| panic!("no {name}"));
        assert!((feature.longitude.deg() - longitude_deg).abs() < 0.1, "{name}");
        assert!((feature.latitude.deg() - latitude_deg).abs() < 0.1, "{name}");
    }
    let mut names: Vec<&str> = night.moon_features.iter().map(|f| f.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), night.moon_features.len(), "two places share a name");
}

#[test]
fn libration_puts_places_where_it_says() {
    for at in ["2026-01-03T08:00Z", "2026-08-20T03:00Z", "2027-03-09T02:00Z"] {
        let night = night(at);
        let moon = &night.sky.moon;
        let radius = moon.state.angular_radius;
        // The point below the observer is seen in the middle of the disc, with the observer overhead.
        let middle = moon.surface_point(moon.libration.longitude, moon.libration.latitude);
        assert!(middle.dir.separation(moon.state.dir) < Angle::from_arcsec(0.5), "{at}");
        assert!(middle.observer_altitude.deg() > 89.9, "{at}");
        let below_sun = moon.surface_point(moon.subsolar.longitude, moon.subsolar.latitude);
        assert!(below_sun.sun_altitude.deg() > 89.9, "{at}");
        for feature in &night.moon_features {
            let point = moon.surface_point(feature.longitude, feature.latitude);
            let off = point.dir.separation(moon.state.dir);
            // By the triangle Moon, place, observer; the sine of the angle at the Moon's centre.
            let cos = feature.latitude.sin() * moon.libration.latitude.sin()
                + feature.latitude.cos()
                    * moon.libration.latitude.cos()
                    * (feature.longitude - moon.libration.longitude).cos();
            let sin = (1.0 - cos * cos).max(0.0).sqrt();
            let far_km = moon.state.distance_km - MOON_RADIUS_KM * cos;
            let wanted = Angle::from_rad((MOON_RADIUS_KM * sin).atan2(far_km));
            // 0.01 degrees on the Moon.
            assert!((off - wanted).abs() < radius * 1.7e-4, "{} {at}", feature.name);
            // Where the horizon of the Moon is to be seen from a finite distance.
            let is_near = cos > MOON_RADIUS_KM / moon.state.distance_km;
            assert_eq!(point.observer_altitude > Angle::ZERO, is_near, "{} {at}", feature.name);
        }
    }
}

/// Five observers from 1955 to 2049, by the librations of DE421, ERFA and a projection of its own.
#[test]
fn places_stand_where_another_program_puts_them() {
    let table = include_str!("truth/moon_features_de421.csv");
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(rows.len(), 50);
    let (ephemeris, names) = (ephemeris(), catalogs().moon_features().expect("the names"));
    let (mut farthest_deg, mut sun_off_deg) = (0.0f64, 0.0f64);
    for row in &rows {
        let number = |column: usize| -> f64 { row[column].parse().expect("a number") };
        let instant = Instant::from_tt_ut1(
            JulianDate::from_parts(number(0), number(1)),
            JulianDate::from_parts(number(0), number(2)),
        )
        .expect("a date");
        let place = Place::new(number(4), number(3), number(5)).expect("a place");
        let sky = SkyState::at(&ephemeris, &instant, &place, TOLERANCE).expect("a sky");
        let night =
            Night::of(sky, Vec::new(), &Atmosphere::default()).with_moon_features(names.clone());
        let moon = &night.sky.moon;
        for (what, got, wanted_deg) in [
            ("libration in longitude", moon.libration.longitude, number(6)),
            ("libration in latitude", moon.libration.latitude, number(7)),
            ("longitude of the Sun", moon.subsolar.longitude, number(8)),
            ("latitude of the Sun", moon.subsolar.latitude, number(9)),
        ] {
            let off_deg = (got - Angle::from_deg(wanted_deg)).signed().deg().abs();
            sun_off_deg = sun_off_deg.max(off_deg);
            assert!(off_deg < 1e-3, "{what}: off by {off_deg} degrees");
        }
        let name = row[10];
        let feature = night.moon_feature(name).expect("a place by name");
        assert!((feature.longitude.deg() - number(11)).abs() < 0.01, "{name}");
        assert!((feature.latitude.deg() - number(12)).abs() < 0.01, "{name}");
        let (point, _) = night.on_moon(feature);
        let wanted =
            Dir::from_azimuth_altitude(Angle::from_deg(number(13)), Angle::from_deg(number(14)));
        // Arc on the Moon, as in the middle of its disc.
        let off_deg = (point.dir.separation(wanted) / moon.state.angular_radius.rad()).deg();
        farthest_deg = farthest_deg.max(off_deg);
        assert!(off_deg < 0.02, "{name}: {off_deg} degrees of the Moon aside");
    }
    println!("places within {farthest_deg:.5} degrees of the Moon, angles within {sun_off_deg:.6}");
}

#[test]
fn the_sun_rises_over_tycho_after_first_quarter() {
    // First quarter of 2026-08-20T02:46Z: the Sun rises near longitude 0, Crisium has day.
    let night = night("2026-08-20T03:00Z");
    let sun = |name: &str| {
        let feature = night.moon_feature(name).expect("a name");
        night.on_moon(feature).0.sun_altitude.deg()
    };
    assert!(sun("Mare Crisium") > 40.0 && sun("Theophilus") > 15.0);
    assert!(sun("Copernicus") < -5.0 && sun("Aristarchus") < -30.0);
}

#[test]
fn moons_of_jupiter_stand_beside_it() {
    let night = night("2026-01-10T06:00Z");
    let jupiter = night.sky.body(Body::Jupiter).expect("Jupiter");
    for moon in Galilean::ALL {
        let object = night.find(moon.name()).expect("a moon by name");
        assert_eq!(object.kind, Kind::Satellite(moon));
        // Callisto keeps within 27 radii of Jupiter, Io within 6.
        let most = [6.0, 9.6, 15.2, 26.7][moon as usize];
        let off = object.dir.separation(jupiter.dir);
        assert!(off < jupiter.angular_radius * most, "{moon}: {}\"", off.arcsec());
        assert!((4.3..6.2).contains(&object.magnitude.0) || object.magnitude.0 > 10.0, "{moon}");
    }
}

/// In each revolution of 1.77 days Io is behind Jupiter, in its shadow and before its disc for two hours
/// or so.
#[test]
fn io_is_hidden_shaded_and_in_transit_once_in_each_round() {
    let (mut hidden, mut shaded, mut before) = (0, 0, 0);
    let steps = 170;
    let ephemeris = ephemeris();
    for step in 0..steps {
        // 1.77 days in steps of 15 minutes, two months after opposition: the shadow stands aside.
        let minutes = 15 * step;
        let (day, hour, minute) = (10 + minutes / 1440, minutes / 60 % 24, minutes % 60);
        let sky = sky(&ephemeris, &format!("2026-03-{day:02}T{hour:02}:{minute:02}Z"));
        let io = sky.satellite(Galilean::Io).expect("Io");
        hidden += usize::from(io.share_seen < 0.5);
        shaded += usize::from(io.share_sunlit < 0.5);
        before += usize::from(io.is_before_jupiter);
        assert!(!(io.is_before_jupiter && (io.share_seen < 1.0 || io.share_sunlit < 1.0)));
    }
    for (what, count) in [("hidden", hidden), ("shaded", shaded), ("before", before)] {
        let hours = count as f64 * 0.25;
        assert!((1.7..2.6).contains(&hours), "{what}: {hours} h");
    }
}

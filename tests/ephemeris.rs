//! Positions against authorities: DE440 reduced by ERFA, and DE431 over eight millennia.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use glam::DVec3;
use nocturne::catalog::{Catalogs, Star};
use nocturne::ephemeris::apparent::{ApparentPlace, Observer};
use nocturne::ephemeris::moon_orientation::MoonPhysical;
use nocturne::ephemeris::stars::StarReduction;
use nocturne::ephemeris::{Body, Depth, Ephemeris, EphemerisError, Observation, Tier};
use nocturne::frame::{Dir, Horizon, TrueOfDate};
use nocturne::place::Place;
use nocturne::sky::SkyState;
use nocturne::time::{Instant, JulianDate, Tt, Ut1};
use nocturne::units::{AU_KM, Angle, Magnitude};

const DE440: &str = include_str!("truth/ephemeris_de440.csv");
const DEEP_TIME: &str = include_str!("truth/ephemeris_deep_time.csv");

/// With every table, read in full.
static EPHEMERIS: LazyLock<Ephemeris> = LazyLock::new(|| {
    Ephemeris::load(&Catalogs::locate(None).unwrap(), Angle::from_arcsec(0.001)).unwrap()
});

/// One line of a table with named columns.
struct Row<'a> {
    columns: &'a [&'a str],
    cells: Vec<&'a str>,
}

impl Row<'_> {
    fn text(&self, column: &str) -> &str {
        let index = self.columns.iter().position(|name| *name == column);
        self.cells[index.unwrap_or_else(|| panic!("no column {column}"))]
    }
    fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap_or_else(|_| panic!("{column}: {:?}", self.text(column)))
    }
    fn angle(&self, column: &str) -> Angle {
        Angle::from_deg(self.number(column))
    }
    fn dir<F>(&self, longitude: &str, latitude: &str) -> Dir<F> {
        Dir::from_spherical(self.angle(longitude), self.angle(latitude))
    }
}

fn for_each_row(table: &str, mut check: impl FnMut(&Row)) {
    let mut lines = table.lines().filter(|line| !line.starts_with('#'));
    let columns: Vec<&str> = lines.next().expect("a header").split(',').collect();
    for line in lines {
        check(&Row { columns: &columns, cells: line.split(',').collect() });
    }
}

fn instant(tt: JulianDate<Tt>, ut1: JulianDate<Ut1>) -> Instant {
    Instant::from_tt_ut1(tt, ut1).unwrap()
}

fn de440_instant(row: &Row) -> Instant {
    instant(
        JulianDate::from_parts(row.number("jd_tt_1"), row.number("jd_tt_2")),
        JulianDate::from_parts(row.number("jd_ut1_1"), row.number("jd_ut1_2")),
    )
}

fn de440_place(row: &Row) -> Place {
    Place::new(row.number("lat_deg_N"), row.number("lon_deg_E"), row.number("height_m")).unwrap()
}

/// Keeps the largest value under each name, for the report.
#[derive(Default)]
struct Largest(BTreeMap<String, f64>);

impl Largest {
    fn note(&mut self, name: String, value: f64) {
        let largest = self.0.entry(name).or_default();
        *largest = largest.max(value.abs());
    }
    fn print(&self) {
        for (name, value) in &self.0 {
            println!("{name}: {value:.6}");
        }
    }
}

#[test]
fn bodies_stand_where_de440_puts_them_within_the_bound_of_each_tier() {
    let mut largest = Largest::default();
    let mut checked = 0;
    for_each_row(DE440, |row| {
        let Ok(body) = row.text("body").parse::<Body>() else { return };
        let instant = de440_instant(row);
        let observer = Observer::at(&EPHEMERIS, &instant, &de440_place(row), Angle::ZERO);
        // DE431 is measured against itself: DE440 has moved the outer planets since.
        let tiers = Tier::ALL.into_iter().filter(|&tier| tier != Tier::De431);
        for tier in tiers.filter(|tier| tier.knows(body)) {
            let bound = tier.bound(body, instant.tdb).unwrap();
            let seen = ApparentPlace::of(
                &EPHEMERIS,
                body,
                tier,
                &observer,
                &EPHEMERIS.earth(instant.tdb, tier).unwrap(),
            )
            .unwrap();
            let geocentric: Dir<TrueOfDate> = row.dir("geo_ra_app_deg", "geo_dec_app_deg");
            let topocentric: Dir<TrueOfDate> = row.dir("topo_ra_app_deg", "topo_dec_app_deg");
            let horizon: Dir<Horizon> =
                Dir::from_azimuth_altitude(row.angle("az_deg"), row.angle("alt_deg_airless"));
            let errors = [
                ("geocentric", seen.geocentric.separation(geocentric)),
                ("topocentric", seen.topocentric.separation(topocentric)),
                ("horizon", seen.horizon.separation(horizon)),
            ];
            for (which, error) in errors {
                largest.note(format!("{body} {tier} {which}, arcsec"), error.arcsec());
                assert!(
                    error <= bound,
                    "{body} {tier} {which} at {:?}: {}\" > {}\"",
                    instant.tt,
                    error.arcsec(),
                    bound.arcsec()
                );
            }
            let distance = seen.topocentric_distance_km / row.number("topo_dist_km") - 1.0;
            largest.note(format!("{body} {tier} distance, relative"), distance);
            let tolerance = match tier {
                // Along the line of sight as well as across.
                Tier::De440(_) | Tier::De431 => 2.0 * bound.rad(),
                Tier::Paper => 5e-3,
                Tier::Series => 1e-3,
            };
            assert!(distance.abs() < tolerance, "{body} {tier}: {distance}");
            checked += 1;
        }
    });
    largest.print();
    assert!(checked > 300, "{checked}");
}

#[test]
fn the_best_places_are_as_good_as_almanacs_need() {
    let mut largest = Largest::default();
    for_each_row(DE440, |row| {
        let Ok(body) = row.text("body").parse::<Body>() else { return };
        let instant = de440_instant(row);
        let near =
            (1950.0..2050.0).contains(&(2000.0 + instant.tt.centuries_since_j2000() * 100.0));
        let place = de440_place(row);
        let mut observation =
            Observation::at(&EPHEMERIS, &instant, &place, Angle::from_arcsec(0.001));
        let seen = observation.seen(body).unwrap().place;
        let geocentric: Dir<TrueOfDate> = row.dir("geo_ra_app_deg", "geo_dec_app_deg");
        let topocentric: Dir<TrueOfDate> = row.dir("topo_ra_app_deg", "topo_dec_app_deg");
        let horizon: Dir<Horizon> =
            Dir::from_azimuth_altitude(row.angle("az_deg"), row.angle("alt_deg_airless"));
        // The table is rounded to a nanodegree: 0.000004".
        let (limit_arcsec, limit_km) = match (body, near) {
            (Body::Sun, true) => (0.001, 0.3),
            (Body::Sun, false) => (0.0015, 0.3),
            (Body::Moon, true) => (0.001, 0.001),
            (Body::Moon, false) => (0.0015, 0.001),
            (Body::Mercury | Body::Venus | Body::Mars, true) => (0.001, 1.0),
            (Body::Mercury | Body::Venus | Body::Mars, false) => (0.0015, 1.0),
            (_, true) => (0.001, 20.0),
            (_, false) => (0.0015, 20.0),
        };
        let era = if near { "1950-2050" } else { "1550-2650" };
        for (which, error) in [
            ("geocentric", seen.geocentric.separation(geocentric)),
            ("topocentric", seen.topocentric.separation(topocentric)),
            ("horizon", seen.horizon.separation(horizon)),
        ] {
            let at = format!("{body} {which} {era}, arcsec");
            largest.note(at.clone(), error.arcsec());
            assert!(error.arcsec() < limit_arcsec, "{at} at {:?}: {}", instant.tt, error.arcsec());
        }
        for (which, error_km) in [
            ("geocentric", seen.geocentric_distance_km - row.number("geo_dist_km")),
            ("topocentric", seen.topocentric_distance_km - row.number("topo_dist_km")),
        ] {
            let at = format!("{body} {which} distance, km");
            largest.note(at.clone(), error_km);
            assert!(error_km.abs() < limit_km, "{at} at {:?}: {error_km}", instant.tt);
        }
    });
    largest.print();
    assert_eq!(largest.0.len(), 80);
}

#[test]
fn bodies_stay_within_their_bounds_over_eight_millennia() {
    let mut largest = Largest::default();
    let place = Place::new(0.0, 0.0, 0.0).unwrap();
    let mut checked = 0;
    for_each_row(DEEP_TIME, |row| {
        let body: Body = row.text("body").parse().unwrap();
        let tt = JulianDate::from_jd(row.number("jd_tt"));
        // The first dates lie before all calendars. TDB is within 2 ms of TT: 0.001" of the Moon.
        let instant =
            Instant { utc: tt.read_on(0.0), ut1: tt.read_on(0.0), tt, tdb: tt.read_on(0.0) };
        let observer = Observer::at(&EPHEMERIS, &instant, &place, Angle::ZERO);
        let truth: Dir<TrueOfDate> = row.dir("ra_deg", "dec_deg");
        // The Swiss Ephemeris, which the table comes from, errs by some milliarcseconds itself.
        for tier in [Tier::De431, Tier::Paper, Tier::Series] {
            let Some(bound) = tier.bound(body, instant.tdb) else { continue };
            let seen = ApparentPlace::of(
                &EPHEMERIS,
                body,
                tier,
                &observer,
                &EPHEMERIS.earth(instant.tdb, tier).unwrap(),
            )
            .unwrap();
            let error = seen.geocentric.separation(truth);
            largest.note(format!("{body} {tier}, part of the bound"), error.rad() / bound.rad());
            assert!(error <= bound, "{body} {tier} at {tt:?}: {}\"", error.arcsec());
            let distance = seen.geocentric_distance_km / (row.number("dist_au") * AU_KM) - 1.0;
            assert!(distance.abs() < 0.1, "{body} {tier} at {tt:?}: {distance}");
            checked += 1;
        }
    });
    largest.print();
    assert!(checked > 350, "{checked}");
    // A bound that nothing comes near would be no measure; the table of DE431 has one of its own
    // in `deep_time.rs`.
    let measured = largest.0.iter().filter(|(name, _)| !name.contains("DE431"));
    assert!(measured.map(|(_, part)| *part).all(|part| part > 0.2));
}

/// Hipparcos (ESA 1997), brought from J1991.25 to J2000.0 with space motion (ERFA `pmsafe`).
fn star(name: &str) -> Option<Star> {
    let (ra_deg, dec_deg, pm_ra, pm_dec, parallax, velocity) = match name {
        "sirius" => (
            101.287155360618,
            -16.716115874755,
            -0.546038888,
            -1.223121855,
            0.379217078,
            -5.499048564,
        ),
        "polaris" => (
            37.954515362320,
            89.264109507396,
            0.044218389,
            -0.011746486,
            0.007560009,
            -17.399944316,
        ),
        _ => return None,
    };
    Some(Star {
        hr: 0,
        hip: None,
        hd: None,
        designation: None,
        flamsteed: None,
        name: Some(name.into()),
        dir_j2000: Dir::from_spherical(Angle::from_deg(ra_deg), Angle::from_deg(dec_deg)),
        proper_motion_ra_arcsec_yr: pm_ra,
        proper_motion_dec_arcsec_yr: pm_dec,
        parallax_arcsec: parallax,
        radial_velocity_km_s: velocity,
        magnitude: Magnitude(0.0),
        b_v: 0.0,
        spectral_type: String::new(),
        variable: None,
        companion: None,
    })
}

#[test]
fn stars_stand_where_hipparcos_and_erfa_put_them() {
    let mut largest = Largest::default();
    for_each_row(DE440, |row| {
        let Some(star) = star(row.text("body")) else { return };
        let instant = de440_instant(row);
        let observer = Observer::at(&EPHEMERIS, &instant, &de440_place(row), Angle::ZERO);
        let topocentric: Dir<TrueOfDate> = row.dir("topo_ra_app_deg", "topo_dec_app_deg");
        let horizon: Dir<Horizon> =
            Dir::from_azimuth_altitude(row.angle("az_deg"), row.angle("alt_deg_airless"));
        let best = Tier::De440(Depth::Thousandth);
        for (tier, tolerance_arcsec) in [(best, 0.0005), (Tier::Series, 0.05), (Tier::Paper, 0.2)] {
            let stars = StarReduction::new(&observer, &EPHEMERIS.earth(instant.tdb, tier).unwrap());
            let equatorial = observer.true_from_icrs * stars.icrs(&star);
            let local = stars.horizon_all(std::slice::from_ref(&star))[0];
            for (which, error) in [
                ("topocentric", equatorial.separation(topocentric)),
                ("horizon", local.separation(horizon)),
            ] {
                let name = row.text("body");
                largest.note(format!("{name} {tier} {which}, arcsec"), error.arcsec());
                assert!(error.arcsec() < tolerance_arcsec, "{name} {tier}: {}\"", error.arcsec());
            }
        }
    });
    largest.print();
    assert_eq!(largest.0.len(), 12);
}

#[test]
fn the_moon_turns_as_its_integrated_librations_say() {
    let mut largest = Largest::default();
    for_each_row(DE440, |row| {
        if row.text("geo_libr_lon_deg").is_empty() {
            return;
        }
        let (instant, place) = (de440_instant(row), de440_place(row));
        for (ephemeris, name, tolerance_deg) in
            [(&*EPHEMERIS, "DE440, DE421", 0.0001), (&Ephemeris::analytic(), "series", 0.012)]
        {
            let mut observation = Observation::at(ephemeris, &instant, &place, Angle::ZERO);
            let seen = observation.seen(Body::Moon).unwrap().place;
            let MoonPhysical { geocentric, topocentric, subsolar, colongitude, phase } =
                observation.moon_physical(&seen);
            for (column, angle) in [
                ("geo_libr_lon_deg", geocentric.libration.longitude),
                ("geo_libr_lat_deg", geocentric.libration.latitude),
                ("axis_PA_deg", geocentric.axis_position_angle),
                ("topo_libr_lon_deg", topocentric.libration.longitude),
                ("topo_libr_lat_deg", topocentric.libration.latitude),
                ("topo_axis_PA_deg", topocentric.axis_position_angle),
                ("subsolar_lon_deg", subsolar.longitude),
                ("subsolar_lat_deg", subsolar.latitude),
                ("colongitude_deg", colongitude),
                ("phase_angle_deg", phase.angle),
            ] {
                let error_deg = (angle - row.angle(column)).signed().deg();
                largest.note(format!("{column} {name}, degrees"), error_deg);
                assert!(
                    error_deg.abs() < tolerance_deg,
                    "{column} at {:?}: {error_deg}",
                    instant.tt
                );
            }
        }
    });
    largest.print();
    assert_eq!(largest.0.len(), 20);
}

#[test]
fn the_sky_agrees_with_the_table_on_phase_and_size() {
    let mut moons = 0;
    for_each_row(DE440, |row| {
        if row.text("topo_ang_diam_arcsec").is_empty() {
            return;
        }
        let place = de440_place(row);
        let sky = SkyState::at(&EPHEMERIS, &de440_instant(row), &place, Angle::from_arcsec(60.0))
            .unwrap();
        let moon = &sky.moon;
        assert_eq!(moon.state.tier, Tier::De440(Depth::Tenth));
        let diameter_arcsec = 2.0 * moon.state.angular_radius.arcsec();
        assert!((diameter_arcsec - row.number("topo_ang_diam_arcsec")).abs() < 0.3);
        // Topocentric phase differs from the geocentric one of the table by the parallax at most.
        let phase = moon.state.phase_angle - row.angle("phase_angle_deg");
        assert!(phase.abs().deg() < 1.1, "{}", phase.deg());
        // The point below the Sun, found through the map, is where the direction to the Sun says.
        let subsolar: Dir<nocturne::frame::MoonFixed> =
            Dir::from_spherical(moon.subsolar.longitude, moon.subsolar.latitude);
        let to_sun = moon.horizon_from_moon_fixed * subsolar;
        assert!(to_sun.separation(moon.state.dir_to_sun).arcsec() < 1e-3);
        moons += 1;
    });
    assert!(moons > 10, "{moons}");
}

#[test]
fn the_sky_is_complete_and_each_body_is_as_good_as_was_asked() {
    let tt = JulianDate::from_jd(2_451_545.0);
    let instant = instant(tt, tt.read_on(-63.83));
    let place = Place::new(35.0, -111.0, 2100.0).unwrap();
    let analytic = Ephemeris::analytic();
    let sky = SkyState::at(&analytic, &instant, &place, Angle::from_deg(1.0)).unwrap();
    assert_eq!(sky.sun.tier, Tier::Paper);
    assert_eq!(sky.moon.state.tier, Tier::Paper);
    for body in Body::ALL {
        let state = sky.body(body).unwrap();
        assert_eq!(state.body, body);
        assert!(state.error_bound.deg() <= 1.0);
        assert_eq!(state.rings.is_some(), body == Body::Saturn);
    }
    // The Sun's semidiameter at perihelion, 16' 16"; Saturn's rings at -20 degrees
    // (Astronomical Almanac for 2000).
    assert!((sky.sun.angular_radius.arcsec() - 975.3).abs() < 1.0);
    let rings = sky.body(Body::Saturn).unwrap().rings.unwrap();
    assert!((rings.observer_latitude.deg() + 19.5).abs() < 1.0, "{rings:?}");
    let venus = sky.body(Body::Venus).unwrap();
    assert!(venus.phase_angle.deg() > 0.0 && venus.phase_angle.deg() < 180.0);
}

#[test]
fn the_rings_of_saturn_are_turned_as_meeus_has_them() {
    // Meeus 1998, example 45.a, 1992 December 16.0 TD, geocentric: B = 16.442, B' = 14.679, position
    // angle P = 6.741 degrees (recalled).
    let tt = JulianDate::from_jd(2_448_972.5);
    let instant = instant(tt, tt.read_on(-59.0));
    let place = Place::new(0.0, 0.0, 0.0).unwrap();
    let sky = SkyState::at(&EPHEMERIS, &instant, &place, Angle::from_arcsec(1.0)).unwrap();
    let saturn = sky.body(Body::Saturn).unwrap();
    let rings = saturn.rings.unwrap();
    assert!((rings.observer_latitude.deg() - 16.442).abs() < 0.01, "{rings:?}");
    assert!((rings.sun_latitude.deg() - 14.679).abs() < 0.01, "{rings:?}");
    // North of the axes of 2000 for that of date, 0.04 degrees.
    let north: Dir<Horizon> = sky.horizon_from_icrs * Dir::from_vector(DVec3::Z);
    let away = saturn.dir.vector();
    let across = |dir: Dir<Horizon>| dir.vector() - away * dir.vector().dot(away);
    let (north, pole) = (across(north), across(rings.pole));
    // Position angles grow to the east, which is left with north up.
    let east = north.cross(away);
    let turn = Angle::from_rad(f64::atan2(pole.dot(east), pole.dot(north)));
    assert!((turn.deg() - 6.741).abs() < 0.1, "{}", turn.deg());
}

#[test]
fn the_cheapest_tier_that_is_good_enough_is_chosen() {
    let (now, then) = (JulianDate::from_jd(2_460_000.5), JulianDate::from_jd(1_500_000.5));
    let chosen = |ephemeris: &Ephemeris, body, arcsec, tdb| {
        ephemeris.choose(body, Angle::from_arcsec(arcsec), tdb).unwrap().0
    };
    let analytic = Ephemeris::analytic();
    assert_eq!(chosen(&analytic, Body::Sun, 300.0, now), Tier::Paper);
    assert_eq!(chosen(&analytic, Body::Sun, 30.0, now), Tier::Series);
    assert_eq!(chosen(&analytic, Body::Moon, 300.0, now), Tier::Series);
    assert_eq!(chosen(&analytic, Body::Mars, 3600.0, now), Tier::Series);
    // Nothing is as good as this: the best there is.
    let (tier, bound) = analytic.choose(Body::Moon, Angle::from_arcsec(1e-3), now).unwrap();
    assert_eq!((tier, Some(bound)), (Tier::Series, Tier::Series.bound(Body::Moon, now)));

    for (arcsec, depth) in [
        (3600.0, Depth::Tenth),
        (0.1, Depth::Tenth),
        (0.05, Depth::Hundredth),
        (0.01, Depth::Hundredth),
        (0.001, Depth::Thousandth),
        (1e-6, Depth::Thousandth),
    ] {
        assert_eq!(chosen(&EPHEMERIS, Body::Venus, arcsec, now), Tier::De440(depth));
        assert_eq!(chosen(&EPHEMERIS, Body::Venus, arcsec, then), Tier::De431);
    }
    // Read no deeper than was asked.
    let coarse =
        Ephemeris::load(&Catalogs::locate(None).unwrap(), Angle::from_arcsec(5.0)).unwrap();
    assert_eq!(chosen(&coarse, Body::Venus, 0.001, now), Tier::De440(Depth::Tenth));
    let refused = coarse.geometric(Body::Venus, now, Tier::De440(Depth::Hundredth)).unwrap_err();
    assert!(refused.to_string().contains("not to that depth"), "{refused}");
    assert!(matches!(
        analytic.geometric(Body::Venus, now, Tier::De431),
        Err(EphemerisError::NotLoaded { .. })
    ));
}

#[test]
fn dates_and_bodies_without_a_theory_are_refused_in_words() {
    for jd in [2.0e5, 3.3e6, f64::NAN] {
        let far = JulianDate::from_jd(jd);
        assert!(matches!(
            EPHEMERIS.geometric(Body::Sun, far, Tier::Series),
            Err(EphemerisError::Date { .. })
        ));
        assert!(EPHEMERIS.choose(Body::Moon, Angle::from_deg(1.0), far).is_err());
    }
    let refused = EPHEMERIS.geometric(Body::Mars, JulianDate::from_jd(2_451_545.0), Tier::Paper);
    assert_eq!(
        refused.unwrap_err().to_string(),
        "Mars: the paper tier has no theory of it; use the series tier"
    );
    let early = EPHEMERIS.geometric(Body::Moon, JulianDate::from_jd(1_000_000.0), Tier::Paper);
    assert_eq!(
        early.unwrap_err().to_string(),
        "Moon: the year -1974.1 is outside -1000 to 4001, where the paper tier holds; choose a date \
         within"
    );
}

#[test]
fn the_earths_velocity_is_the_rate_of_its_position() {
    for tier in Tier::ALL.into_iter() {
        let at = JulianDate::from_jd(2_460_123.25);
        let state = |seconds: f64| EPHEMERIS.earth(at.plus_seconds(seconds), tier).unwrap();
        let rate: DVec3 = (state(600.0).position - state(-600.0).position).km() / 1200.0;
        assert!((rate - state(0.0).velocity_km_s).length() < 1e-4, "{tier}");
    }
}

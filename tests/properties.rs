//! What holds for any input: inverse pairs, positions that are finite and move without a jump,
//! light without nonsense.

use std::sync::Arc;

use nocturne::air::Atmosphere;
use nocturne::air::aerosol::{Aerosol, AerosolProfile, PhaseLaw};
use nocturne::air::refraction::Refraction;
use nocturne::air::standard::standard_pressure_mbar;
use nocturne::camera::{Camera, LARGEST_EDGE_PX, NARROWEST_FIELD_DEG, Projection};
use nocturne::catalog::{HapkeCell, MoonHapke, MoonMap, MoonMaps, MoonRelief, Star};
use nocturne::display::Display;
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::eye::Eye;
use nocturne::eye::glare::Glare;
use nocturne::frame::{Apparent, Dir, Horizon, Local, View};
use nocturne::image::Image;
use nocturne::light::moon::Reflectance;
use nocturne::light::night::Night;
use nocturne::light::night_lights::NightGlow;
use nocturne::place::{HEIGHT_RANGE_M, Place};
use nocturne::plan::FramePlan;
use nocturne::plan::lay::lay;
use nocturne::scene::{Layers, Setting};
use nocturne::sky::SkyState;
use nocturne::time::delta_t::utc_end_mjd;
use nocturne::time::leap_seconds::MJD_ZERO_JD;
use nocturne::time::{self, Instant, J2000, JulianDate, Utc};
use nocturne::units::{Angle, DAY_S, Magnitude, Xyzv};
use proptest::prelude::*;
use proptest::sample::select;

/// So many cases, or more by `PROPTEST_CASES`, which is 256 when not set. A failure is printed with
/// its smallest case, which then becomes a test of its own.
fn cases(cases: u32) -> ProptestConfig {
    let usual = ProptestConfig::default();
    let cases = (u64::from(cases) * u64::from(usual.cases) / 256).max(1) as u32;
    // The same cases on every machine: what fails for one fails for all.
    let rng_seed = proptest::test_runner::RngSeed::Fixed(2001);
    ProptestConfig { cases, rng_seed, failure_persistence: None, ..usual }
}

fn degrees(low: f64, high: f64) -> impl Strategy<Value = Angle> {
    (low..=high).prop_map(Angle::from_deg)
}

/// Poles, the antimeridian and the ends of the range of heights, and all between.
fn places() -> impl Strategy<Value = Place> {
    let latitude = prop_oneof![1 => select(vec![-90.0, 90.0, 0.0]), 3 => -90.0..=90.0];
    let longitude = prop_oneof![1 => select(vec![-180.0, 180.0, 360.0]), 3 => -180.0..=360.0];
    let height = prop_oneof![
        1 => select(vec![*HEIGHT_RANGE_M.start(), *HEIGHT_RANGE_M.end(), 0.0]),
        3 => HEIGHT_RANGE_M
    ];
    (latitude, longitude, height)
        .prop_map(|(latitude, longitude, height)| Place::new(latitude, longitude, height).unwrap())
}

/// From the first midnight of the year -4000 to the last of 4000.
fn instants() -> impl Strategy<Value = Instant> {
    (260_058..=3_182_394, -0.5..0.5)
        .prop_map(|(day, part)| JulianDate::from_parts(f64::from(day), part))
        .prop_map(|utc| Instant::from_utc(utc).unwrap())
}

fn cameras() -> impl Strategy<Value = Camera> {
    let fields = select(Projection::ALL.to_vec()).prop_flat_map(|projection| {
        // Evenly by ratio, from the narrowest to the widest.
        let (low, high) = (NARROWEST_FIELD_DEG.ln(), projection.widest_deg().ln());
        (Just(projection), (low..=high).prop_map(move |ln| ln.exp().min(projection.widest_deg())))
    });
    let pointing = (degrees(-360.0, 360.0), degrees(-90.0, 90.0), degrees(-360.0, 360.0));
    (fields, pointing, 1..=LARGEST_EDGE_PX, 1..=LARGEST_EDGE_PX).prop_map(
        |((projection, fov_deg), (azimuth, altitude, roll), width_px, height_px)| Camera {
            projection,
            field_of_view: Angle::from_deg(fov_deg),
            azimuth,
            altitude,
            roll,
            width_px,
            height_px,
        },
    )
}

fn directions<F>() -> impl Strategy<Value = Dir<F>> {
    (degrees(-180.0, 180.0), -1.0..=1.0f64)
        .prop_map(|(longitude, z)| Dir::from_spherical(longitude, Angle::from_rad(z.asin())))
}

fn azimuth_and_altitude_return<F: Local>(dir: Dir<F>) -> Angle {
    Dir::<F>::from_azimuth_altitude(dir.azimuth(), dir.altitude()).separation(dir)
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn azimuth_and_altitude_are_a_pair(
        dir in directions::<Horizon>(),
        azimuth in degrees(-720.0, 720.0),
        altitude in degrees(-90.0, 90.0),
    ) {
        prop_assert!(azimuth_and_altitude_return(dir).rad() < 1e-15 * 4.0);
        let there: Dir<Apparent> = Dir::from_azimuth_altitude(azimuth, altitude);
        prop_assert!((0.0..360.0).contains(&there.azimuth().deg()));
        prop_assert!((there.altitude() - altitude).abs().rad() < 1e-14);
        // On the ground the azimuth shrinks towards the poles.
        let off = (there.azimuth() - azimuth).signed() * altitude.cos();
        prop_assert!(off.abs().rad() < 1e-13);
    }

    #[test]
    fn refraction_is_a_pair(
        pressure_mbar in 0.0..1100.0,
        temperature_c in -90.0..60.0,
        dir in directions::<Horizon>(),
    ) {
        let refraction = Refraction::new(pressure_mbar, temperature_c);
        let seen = refraction.apparent_from_horizon(dir);
        prop_assert!(refraction.horizon_from_apparent(seen).separation(dir).deg() < 1e-9);
        prop_assert!(seen.altitude() >= dir.altitude() - Angle::from_deg(1e-9));
        let dir: Dir<Apparent> = Dir::from_vector(dir.vector());
        let stands = refraction.horizon_from_apparent(dir);
        prop_assert!(refraction.apparent_from_horizon(stands).separation(dir).deg() < 1e-9);
    }

    #[test]
    fn pixels_and_directions_are_a_pair(
        camera in cameras(),
        part in (0.0..=1.0, 0.0..=1.0),
        dir in directions::<View>(),
    ) {
        let camera = camera.checked().unwrap();
        let pixel = [part.0 * f64::from(camera.width_px), part.1 * f64::from(camera.height_px)];
        if let Some(view) = camera.view_from_pixel(pixel) {
            prop_assert!((view.vector().length() - 1.0).abs() < 1e-12);
            prop_assert!(camera.pixel_solid_angle_sr(pixel) >= 0.0);
            if let Some(back) = camera.pixel_from_view(view) {
                let off = (back[0] - pixel[0]).hypot(back[1] - pixel[1]);
                prop_assert!(off < 1e-5, "{pixel:?} {view:?} {back:?}");
            }
        }
        if let Some(pixel) = camera.pixel_from_view(dir) {
            prop_assert!(pixel.iter().all(|p| p.is_finite()));
            if let Some(back) = camera.view_from_pixel(pixel) {
                prop_assert!(back.separation(dir).arcsec() < 1e-3, "{pixel:?} {back:?}");
            }
        }
        let turned = camera.view_from_apparent();
        let there = turned.inverse() * dir;
        prop_assert!((turned * there).separation(dir).rad() < 1e-14);
    }
}

/// Refuses what is no place in the sky.
fn check_sky(sky: &SkyState) {
    for body in Body::ALL {
        let state = sky.body(body).expect("every body is in the sky");
        let unit = |dir: Dir<Horizon>| (dir.vector().length() - 1.0).abs() < 1e-12;
        assert!(unit(state.dir) && unit(state.dir_to_sun), "{state:?}");
        assert!(state.distance_km > 3e5 && state.distance_km < 1e10, "{state:?}");
        let from_sun = state.sun_distance_km;
        assert!(if body == Body::Sun { from_sun == 0.0 } else { from_sun > 4e7 }, "{state:?}");
        assert!(state.error_bound > Angle::ZERO && state.error_bound.deg() < 5.0, "{state:?}");
        assert!((0.0..=180.0).contains(&state.phase_angle.deg()), "{state:?}");
        assert!(state.angular_radius > Angle::ZERO && state.angular_radius.deg() < 0.3);
    }
    let moon = &sky.moon;
    assert!(moon.libration.longitude.signed().abs().deg() < 10.0, "{moon:?}");
    assert!(moon.libration.latitude.abs().deg() < 9.0, "{moon:?}");
    assert!(moon.subsolar.latitude.abs().deg() < 2.0, "{moon:?}");
}

/// The largest jump among the bodies whose theory is the same on both sides.
fn largest_jump(before: &SkyState, after: &SkyState) -> (Angle, String) {
    let mut largest = (Angle::ZERO, String::new());
    for body in Body::ALL {
        let (a, b) = (before.body(body).unwrap(), after.body(body).unwrap());
        let jump = a.dir.separation(b.dir);
        if a.tier == b.tier && jump > largest.0 {
            largest = (jump, format!("{body} jumps by {} arcsec", jump.arcsec()));
        }
        // Another theory may say otherwise, but both said how far off they may be.
        assert!(jump <= a.error_bound + b.error_bound + Angle::from_arcsec(0.1), "{a:?} {b:?}");
    }
    largest
}

const JUMP_ARCSEC: f64 = 0.1;

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn the_sky_is_finite_and_moves_without_a_jump(
        instant in instants(),
        place in places(),
        tolerance in (-1.0..5.0f64).prop_map(|log| Angle::from_arcsec(10f64.powf(log))),
    ) {
        let sky = SkyState::at(&Ephemeris::analytic(), &instant, &place, tolerance).unwrap();
        check_sky(&sky);
        let soon = SkyState::at(&Ephemeris::analytic(), &instant.plus_seconds(1e-3).unwrap(), &place, tolerance).unwrap();
        let (jump, which) = largest_jump(&sky, &soon);
        prop_assert!(jump.arcsec() < JUMP_ARCSEC, "{which}");
        // A millisecond is 0.015" of the turning sky.
        prop_assert!(jump.arcsec() > 1e-3);
    }
}

/// Half a millisecond before and after each of the milliseconds around an instant: TDB, which some
/// tables are in, is up to two of them away from TT.
fn around(at: Instant) -> impl Iterator<Item = [Instant; 2]> {
    (-3..=3).map(move |millisecond| {
        let seconds = 1e-3 * f64::from(millisecond);
        [-5e-4, 5e-4].map(|half| at.plus_seconds(seconds + half).unwrap())
    })
}

fn civil(text: &str) -> Instant {
    time::to_instant(&time::parse(text).unwrap(), None).unwrap()
}

#[test]
fn nothing_jumps_where_calendars_clocks_and_tables_change() {
    // The change of calendar, the beginning of UTC, leap seconds.
    let mut seams = [
        "1582-10-15T00:00Z",
        "1972-01-01T00:00Z",
        "1972-07-01T00:00Z",
        "2016-12-31T23:59:60Z",
        "2017-01-01T00:00Z",
    ]
    .map(civil)
    .to_vec();
    // The end of the measured rotation of the Earth, on both sides of the step of the civil clock.
    let table_end: JulianDate<Utc> = JulianDate::from_parts(MJD_ZERO_JD, utc_end_mjd() as f64);
    seams.push(Instant::from_utc(table_end).unwrap());
    seams.push(Instant::from_utc(table_end.plus_seconds(-1e-6)).unwrap());
    // Joins of the curve of Delta T and eras of the bounds, in Julian years.
    let joins = [
        -3000, -2000, -1520, -1000, -720, -100, 0, 400, 1000, 1150, 1300, 1500, 1550, 1600, 1650,
        1720, 1800, 1855, 1900, 1953, 1971, 2000, 2050, 2650, 2800, 3000,
    ];
    seams.extend(joins.map(|year| {
        let years = f64::from(year - 2000);
        Instant::from_tt(JulianDate::from_parts(J2000, years * 365.25)).unwrap()
    }));
    let places = [(0.0, 180.0), (90.0, 0.0), (52.0, 13.0)];
    for (latitude, longitude) in places {
        let place = Place::new(latitude, longitude, 0.0).unwrap();
        for tolerance_arcsec in [1.0, 130.0, 800.0] {
            let sky = |at| {
                SkyState::at(
                    &Ephemeris::analytic(),
                    &at,
                    &place,
                    Angle::from_arcsec(tolerance_arcsec),
                )
                .unwrap()
            };
            for pair in seams.iter().flat_map(|&seam| around(seam)) {
                let (jump, which) = largest_jump(&sky(pair[0]), &sky(pair[1]));
                assert!(jump.arcsec() < JUMP_ARCSEC, "{:?}: {which}", pair[0]);
            }
        }
    }
}

#[test]
fn a_millisecond_is_a_millisecond_across_the_steps_of_civil_time() {
    for (before, after) in [
        ("1582-10-04T23:59:59.9995Z", "1582-10-15T00:00:00.0005Z"),
        ("2016-12-31T23:59:59.9995Z", "2016-12-31T23:59:60.0005Z"),
        ("2016-12-31T23:59:60.9995Z", "2017-01-01T00:00:00.0005Z"),
        ("-0001-12-31T23:59:59.9995Z", "0000-01-01T00:00:00.0005Z"),
    ] {
        let passed_s = (civil(after).tt - civil(before).tt) * DAY_S;
        assert!((passed_s - 1e-3).abs() < 1e-6, "{before} to {after}: {passed_s} s");
    }
}

/// A few stars, some of them stranger than any in the catalogue.
fn stars() -> impl Strategy<Value = Vec<Star>> {
    let motion = (-10.0..10.0, -10.0..10.0, 0.0..1.0, -300.0..300.0);
    let star = (directions(), motion, -2.0..8.0, -1.0..3.0).prop_map(
        |(dir_j2000, (east, north, parallax_arcsec, radial_velocity_km_s), magnitude, b_v)| Star {
            hr: 1,
            hip: None,
            hd: None,
            designation: None,
            flamsteed: None,
            name: None,
            dir_j2000,
            proper_motion_ra_arcsec_yr: east,
            proper_motion_dec_arcsec_yr: north,
            parallax_arcsec,
            radial_velocity_km_s,
            magnitude: Magnitude(magnitude),
            b_v,
            spectral_type: String::new(),
            variable: None,
            companion: None,
        },
    );
    proptest::collection::vec(star, 0..40)
}

/// All air that a scene may hold.
fn airs() -> impl Strategy<Value = Atmosphere> {
    let aerosol =
        (prop_oneof![Just(0.0), 0.0..=3.0], -1.0..=4.0, 0.5..=10.0, 0.0..=1.0, -0.9..=0.9);
    let rest = (
        0.0..=1000.0,
        0.0..=1.0,
        proptest::option::of(1e-3..=1100.0),
        proptest::option::of(-20.0..=40.0),
    );
    (aerosol, rest).prop_map(|((depth, exponent, scale_km, albedo, asymmetry), rest)| {
        let (ozone_du, ground_albedo, pressure_mbar, temperature_c) = rest;
        let aerosol = Aerosol {
            optical_depth_550: depth,
            angstrom_exponent: Some(exponent),
            profile: AerosolProfile::Exponential { scale_height_km: scale_km },
            single_scattering_albedo: Some(albedo),
            phase: PhaseLaw::HenyeyGreenstein { g: asymmetry },
        };
        let mut air = Atmosphere { aerosol, ..Atmosphere::default() };
        (air.ozone.column_du, air.ground.albedo) = (ozone_du, ground_albedo);
        (air.observer.pressure_mbar, air.observer.temperature_c) = (pressure_mbar, temperature_c);
        air.validate().expect("air within the ranges of the scene");
        air
    })
}

fn layers() -> impl Strategy<Value = Layers> {
    let limit = proptest::option::of(-2.0..8.0);
    (any::<[bool; 5]>(), limit).prop_map(|([sun, moon, planets, stars, ground], limit)| Layers {
        sun,
        moon,
        planets,
        stars,
        ground,
        magnitude_limit: limit,
        ..Layers::default()
    })
}

type SmallScene = (Instant, Place, Camera, Atmosphere, Layers, Vec<Star>);

fn scenes() -> impl Strategy<Value = SmallScene> {
    (instants(), places(), cameras(), airs(), layers(), stars())
}

fn planned((instant, place, camera, mut air, layers, stars): SmallScene) -> FramePlan {
    // Denser air is refused.
    let densest = 2.99 * standard_pressure_mbar(place.height_m);
    air.observer.pressure_mbar = air.observer.pressure_mbar.map(|mbar| mbar.min(densest));
    air.validate_at(place.height_m).unwrap();
    let tolerance = camera.pixel_angle() * 0.1;
    let sky = SkyState::at(&Ephemeris::analytic(), &instant, &place, tolerance).unwrap();
    let night = Night::of(sky, stars, &air);
    let (width, height) = (8, 4);
    let cell = HapkeCell { w: 0.3, b: 0.25, c: 0.5, b_s0: 2.0, h_s: 0.07 };
    let maps = MoonMaps {
        albedo: Arc::new(MoonMap { width, height, reff: vec![[0.1, 0.12, 0.08]; 32] }),
        relief: Arc::new(MoonRelief { width, height, elevation_m: vec![0; 32] }),
        hapke: Arc::new(MoonHapke { width, height, cells: vec![[cell; 3]; 32] }),
    };
    let setting = Setting {
        instant,
        place,
        camera,
        tolerance,
        sky: None,
        night: NightGlow::default(),
        reflectance: Reflectance::Hapke,
        scintillation: None,
    };
    lay(&setting, &layers, &night, &|| Ok(maps.clone())).unwrap().0
}

fn is_light(light: Xyzv) -> bool {
    [light.x, light.y, light.z, light.v].iter().all(|part| part.is_finite() && *part >= 0.0)
}

fn check_plan(plan: &FramePlan) {
    let tables = [&plan.sky.sun, &plan.sky.moon].into_iter().flatten();
    for (which, table) in [("dark", plan.sky.dark.clone())]
        .into_iter()
        .chain(tables.map(|source| ("lit", source.luminance())))
    {
        let bad = table.iter().enumerate().find(|(_, light)| !is_light(**light));
        assert!(bad.is_none(), "{which} sky: {bad:?}");
    }
    for splat in &plan.splats {
        assert!(splat.centre_px.iter().all(|p| p.is_finite()), "{splat:?}");
        assert!(is_light(splat.illuminance), "{splat:?}");
    }
    for disc in &plan.discs {
        let [first, last] = disc.bounds_px;
        assert!(first[0] < last[0] && first[1] < last[1], "{disc:?}");
        assert!(!disc.bands.is_empty(), "{disc:?}");
        for node in disc.bands.iter().flat_map(|band| &band.nodes) {
            assert!(is_light(node.luminance), "{node:?}");
            assert!(node.above_centre.rad().is_finite() && node.rise.rad().is_finite(), "{node:?}");
        }
        assert!(disc.lowest.vector().is_finite() && disc.step.rad() > 0.0, "{disc:?}");
        let mean = disc.shape.mean();
        assert!(mean.is_finite() && mean >= 0.0, "{disc:?}");
    }
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn plans_hold_no_nonsense(mut scene in scenes()) {
        // Without the light of the air, which takes most of the time.
        scene.4.skylight = false;
        check_plan(&planned(scene));
    }
}

proptest! {
    #![proptest_config(cases(3))]

    #[test]
    fn plans_of_the_lit_air_hold_no_nonsense(
        scene in scenes(),
        looks in proptest::collection::vec(directions::<Apparent>(), 20),
    ) {
        let plan = planned(scene);
        check_plan(&plan);
        for dir in looks {
            prop_assert!(is_light(plan.sky.luminance(dir)), "{dir:?}");
        }
    }
}

/// The ranges of a scene file.
fn eyes() -> impl Strategy<Value = Eye> {
    let adaptation = proptest::option::of((-7.0..=10.0).prop_map(|log: f64| 10f64.powf(log)));
    (-40.0..=40.0, adaptation).prop_map(|(exposure_stops, adaptation_cd_m2)| Eye {
        exposure_stops,
        adaptation_cd_m2,
        // Glare spreads the light of one pixel over its neighbours, which then are what is seen.
        glare: Glare::None,
        ..Eye::default()
    })
}

/// No light, or between a starless sky and the Sun, cd/m2.
fn luminances() -> impl Strategy<Value = f32> {
    prop_oneof![1 => Just(0.0), 4 => (-8.0..10.0f32).prop_map(|log| 10f32.powf(log))]
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn eyes_see_order_in_whatever_is_shown(
        eye in eyes(),
        peak_cd_m2 in 1.0..=10_000.0,
        greys in proptest::collection::vec(luminances(), 1..60),
        scotopic_ratio in 0.5..3.0f32,
    ) {
        let pixels = greys.iter().map(|y| [0.9505 * y, *y, 1.089 * y, scotopic_ratio * y]).collect();
        let frame = Image::from_pixels(greys.len() as u32, 1, pixels).unwrap();
        let display = Display { peak_cd_m2, dither: false, ..Display::default() };
        let seen = eye.see(&frame, Angle::from_arcmin(3.0), &display);
        let adapted_to = seen.seeing.adaptation_cd_m2;
        prop_assert!(adapted_to.is_finite() && adapted_to > 0.0);
        let codes = seen.codes(&display);
        let mut shown: Vec<_> = greys.iter().copied().zip(codes.pixels()).collect();
        shown.sort_by(|a, b| a.0.total_cmp(&b.0));
        // What is no number is shown as black. Green is most of the luminance: blue may fade as the
        // cones take over. Rounding moves half a step up or down.
        for pair in shown.windows(2) {
            prop_assert!(pair[0].1[1] <= pair[1].1[1].saturating_add(1), "{pair:?}");
        }
    }

    #[test]
    fn eyes_see_any_colour(
        eye in eyes(),
        pixels in proptest::collection::vec([luminances(), luminances(), luminances(), luminances()], 1..40),
    ) {
        let frame = Image::from_pixels(pixels.len() as u32, 1, pixels).unwrap();
        let seen = eye.see(&frame, Angle::from_arcmin(3.0), &Display::default());
        let adapted_to = seen.seeing.adaptation_cd_m2;
        prop_assert!(adapted_to.is_finite() && adapted_to > 0.0, "{adapted_to}");
        for rgb in seen.light.pixels() {
            prop_assert!(rgb.iter().all(|share| (0.0..=1.0).contains(share)), "{rgb:?}");
        }
    }
}

//! The classic sky models against their own publications: shapes, levels, bounds, refusals.

use std::f64::consts::PI;

use nocturne::air::Atmosphere;
use nocturne::air::classic::cie::{Clear, Overcast};
use nocturne::air::classic::gradation::Direction;
use nocturne::air::classic::perez::{AllWeather, Weather};
use nocturne::air::classic::preetham::Daylight;
use nocturne::air::classic::{ClassicModel, ClassicSky, ClassicSkyError, SkyUnderSun};
use nocturne::light::spectrum::chromaticity_xy;
use nocturne::units::{Angle, Xyzv};

const SUNS_DEG: [f64; 7] = [1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 80.0];

fn deg(deg: f64) -> Angle {
    Angle::from_deg(deg)
}

fn under(model: ClassicModel, sun_deg: f64) -> SkyUnderSun {
    ClassicSky::new(model).under(&Atmosphere::default(), 0.0, deg(sun_deg)).unwrap()
}

fn zenith(sky: &SkyUnderSun) -> Xyzv {
    sky.luminance(deg(90.0), Angle::ZERO)
}

#[test]
fn the_overcast_sky_has_a_third_at_the_horizon_and_seven_ninths_on_the_ground() {
    for sun_deg in SUNS_DEG {
        let sky = under(ClassicModel::CieOvercast, sun_deg);
        let top = zenith(&sky).y;
        assert!((top / Overcast::under(deg(sun_deg)).zenith_cd_m2 - 1.0).abs() < 1e-12);
        for azimuth_deg in [0.0, 50.0, 180.0] {
            let horizon = sky.luminance(Angle::ZERO, deg(azimuth_deg)).y;
            assert!((horizon / top - 1.0 / 3.0).abs() < 1e-12);
        }
        let ground = sky.illuminance().y;
        assert!((ground / (7.0 / 9.0 * PI * top) - 1.0).abs() < 1e-3, "{sun_deg}: {ground}");
    }
    // Krochmann & Seidl 1974 say of the ground, apart: 300 + 21 000 sin h lux.
    let ground = under(ClassicModel::CieOvercast, 45.0).illuminance().y;
    assert!((ground / (300.0 + 21_000.0 * 0.5f64.sqrt()) - 1.0).abs() < 0.01, "{ground}");
}

#[test]
fn the_clear_sky_is_that_of_kittler() {
    for sun_deg in SUNS_DEG {
        let sun = deg(sun_deg);
        let (sky, sun_zenith) = (Clear::under(3.0, sun), PI / 2.0 - sun.rad());
        let f = |g: f64| 0.91 + 10.0 * (-3.0 * g).exp() + 0.45 * g.cos().powi(2);
        let p = |cosine: f64| 1.0 - (-0.32 / cosine).exp();
        for (altitude_deg, azimuth_deg) in [(90.0, 0.0), (30.0, 0.0), (45.0, 120.0), (2.0, 180.0)] {
            let direction = Direction::of(deg(altitude_deg), deg(azimuth_deg), sun);
            let relative =
                f(direction.from_sun.rad()) * p(direction.cos_zenith) / (f(sun_zenith) * p(1.0));
            let got = sky.cd_m2(&direction) / sky.zenith_cd_m2;
            assert!((got / relative - 1.0).abs() < 1e-9, "{sun_deg} {altitude_deg}: {got}");
        }
    }
    // (1376 T - 1810) tan 45 + 380 at the turbidity 2.45 of a clear day.
    let sky = Clear::under(2.45, deg(45.0));
    assert!((sky.zenith_cd_m2 - 1941.2).abs() < 0.1, "{}", sky.zenith_cd_m2);
}

#[test]
fn the_darkest_of_a_clear_sky_is_a_right_angle_from_the_sun() {
    for model in [ClassicModel::CieClear, ClassicModel::Perez, ClassicModel::Preetham] {
        let sky = under(model, 45.0);
        // Along the meridian of the Sun, from 5 degrees on its side to 20 on the other.
        let along = (5..=160).map(|along| {
            let along = f64::from(along);
            (along, sky.luminance(deg(along.min(180.0 - along)), side(along)).y)
        });
        let (darkest, _) = along.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        let from_sun = darkest - 45.0;
        assert!((65.0..105.0).contains(&from_sun), "{model:?}: {from_sun}");
    }
}

fn side(along_deg: f64) -> Angle {
    if along_deg <= 90.0 { Angle::ZERO } else { deg(180.0) }
}

#[test]
fn perez_knows_overcast_from_clear() {
    let sun = deg(40.0);
    let (dull, clear) = (
        AllWeather::under(Weather { clearness: 1.0, brightness: 0.2 }, sun),
        AllWeather::under(Weather { clearness: 8.0, brightness: 0.1 }, sun),
    );
    // Overcast: zenith and horizon stand as 1.66 to 1 abeam of the Sun, which hardly shows.
    let at = |sky: &AllWeather, altitude: f64, azimuth: f64| {
        sky.cd_m2(&Direction::of(deg(altitude), deg(azimuth), sun))
    };
    let gradation = at(&dull, 90.0, 0.0) / at(&dull, 1.0, 90.0);
    assert!((gradation - 1.66).abs() < 0.01, "{gradation}");
    let aureole = at(&dull, 40.0, 0.0) / at(&dull, 40.0, 180.0);
    assert!((1.0..2.0).contains(&aureole), "{aureole}");
    // Clear: the horizon brighter than the zenith, an aureole over ten times the sky opposite.
    assert!(at(&clear, 90.0, 0.0) < 0.7 * at(&clear, 2.0, 180.0));
    assert!(at(&clear, 40.0, 0.0) > 10.0 * at(&clear, 40.0, 180.0));
    // The coefficients of the eighth class by hand, from table 1 of the paper.
    let (z, q) = (50.0f64.to_radians(), 0.1);
    let [a, c, e] = [
        -1.05 + 0.0289 * z + q * (0.426 + 0.359 * z),
        31.0625 - 14.5 * z + q * (-46.1148 + 55.375 * z),
        1.5 - 0.6426 * z + q * (1.8564 + 0.5636 * z),
    ];
    let got = clear.gradation;
    assert!((got.a - a).abs() < 1e-9 && (got.c - c).abs() < 1e-9 && (got.e - e).abs() < 1e-9);
    // And of the first, which has formulas of its own.
    let c = (0.2 * (2.8 + 0.6004 * z)).powf(1.2375).exp() - 1.0;
    let d = -(0.2 * (1.8734 + 0.6297 * z)).exp() + 0.9738 + 0.2 * 0.2809;
    assert!((dull.gradation.c - c).abs() < 1e-9 && (dull.gradation.d - d).abs() < 1e-9);
}

#[test]
fn perez_lights_the_ground_with_what_it_was_scaled_to() {
    for sun_deg in SUNS_DEG {
        let sun = deg(sun_deg);
        for clearness in [1.0, 1.1, 1.3, 1.7, 2.2, 3.5, 5.0, 9.0] {
            let sky = ClassicSky {
                clearness: Some(clearness),
                brightness: Some(0.2),
                ..ClassicSky::new(ClassicModel::Perez)
            };
            let got = sky.under(&Atmosphere::default(), 0.0, sun).unwrap().illuminance().y;
            let wanted = Weather { clearness, brightness: 0.2 }.illuminance_lx(sun);
            assert!((got / wanted - 1.0).abs() < 1e-9, "{sun_deg} {clearness}: {got} {wanted}");
        }
    }
    // A cloudless sky at 60 degrees lights the ground with some 15 klx.
    let clear = under(ClassicModel::Perez, 60.0).illuminance().y;
    assert!((10_000.0..20_000.0).contains(&clear), "{clear}");
}

#[test]
fn preetham_has_the_zenith_of_its_paper() {
    // Yz = (4.0453 T - 4.9710) tan chi - 0.2155 T + 2.4192 kcd/m2, worked outside this program.
    for (turbidity, sun_deg, kcd_m2) in
        [(2.0, 60.0, 5.88674), (2.0, 30.0, 3.48733), (4.0, 30.0, 6.70542), (6.0, 60.0, 22.06671)]
    {
        let sky = Daylight::under(turbidity, deg(sun_deg));
        assert!((sky.zenith_cd_m2 / 1000.0 - kcd_m2).abs() < 1e-5, "{}", sky.zenith_cd_m2);
    }
    // Sun on the horizon: tan chi is zero, and only the rest is left.
    let sky = Daylight::under(3.0, Angle::ZERO);
    assert!((sky.zenith_cd_m2 - (2419.2 - 646.5)).abs() < 1e-6);
    // Sun in the zenith: the cubic is its last term.
    let (x, y) = Daylight::under(2.0, deg(90.0)).zenith_xy;
    assert!((x - (2.0 * 0.00394 + 0.25885)).abs() < 1e-9, "{x}");
    assert!((y - (2.0 * 0.00515 + 0.26688)).abs() < 1e-9, "{y}");
    // Haze whitens the sky.
    let x = |turbidity| Daylight::under(turbidity, deg(45.0)).zenith_xy.0;
    assert!(x(2.0) < x(4.0) && x(4.0) < x(6.0) && x(2.0) < 0.27);
}

#[test]
fn luminance_and_chromaticity_come_out_as_the_models_say() {
    let sun = deg(35.0);
    let sky = ClassicSky { turbidity: Some(3.0), ..ClassicSky::new(ClassicModel::Preetham) };
    let sky = sky.under(&Atmosphere::default(), 0.0, sun).unwrap();
    let paper = Daylight::under(3.0, sun);
    for (altitude, azimuth) in [(90.0, 0.0), (20.0, 60.0), (60.0, 180.0)] {
        let light = sky.luminance(deg(altitude), deg(azimuth));
        let direction = Direction::of(deg(altitude), deg(azimuth), sun);
        assert_eq!(light.y, paper.cd_m2(&direction));
        let (xy, expected) = (chromaticity_xy(light).unwrap(), paper.xy(&direction));
        assert!((xy.0 - expected.0).abs() < 1e-12 && (xy.1 - expected.1).abs() < 1e-12);
    }
}

#[test]
fn all_are_positive_finite_even_and_continuous() {
    for model in ClassicModel::ALL {
        for sun_deg in SUNS_DEG {
            let (low, high) = model.turbidities();
            let turbidities = match model {
                ClassicModel::CieOvercast => vec![None],
                _ => vec![None, Some(low.max(2.0)), Some(4.0), Some(high.min(6.0))],
            };
            for turbidity in turbidities {
                let sky = ClassicSky { turbidity, ..ClassicSky::new(model) };
                let sky = sky.under(&Atmosphere::default(), 0.0, deg(sun_deg)).unwrap();
                check_every_direction(&sky);
            }
        }
    }
}

fn check_every_direction(sky: &SkyUnderSun) {
    let what = || format!("{}, Sun at {}", sky.label(), sky.sun_altitude.deg());
    for azimuth_deg in (0..=180).step_by(10).map(f64::from) {
        let at = |altitude: f64| sky.luminance(deg(altitude), deg(azimuth_deg));
        for altitude_deg in 0..90 {
            let altitude = f64::from(altitude_deg);
            let light = at(altitude);
            for value in [light.x, light.y, light.z, light.v] {
                assert!(value.is_finite() && value >= 0.0, "{}: {light:?}", what());
            }
            assert!(light.y > 1.0 && light.y < 1e6, "{}: {light:?}", what());
            let mirrored = sky.luminance(deg(altitude), deg(-azimuth_deg));
            assert!((mirrored.y / light.y - 1.0).abs() < 1e-9);
            // A thousandth of a degree on, a thousandth of the light at most.
            let next = at(altitude + 1e-3);
            assert!((next.y / light.y - 1.0).abs() < 2e-3, "{} {altitude}", what());
            assert!((next.v / light.v - 1.0).abs() < 2e-3, "{} {altitude}", what());
        }
        assert_eq!(at(-0.01), Xyzv::BLACK);
    }
}

#[test]
fn what_makes_no_sense_is_refused_in_a_sentence() {
    let air = Atmosphere::default();
    for model in ClassicModel::ALL {
        for sun_deg in [0.0, -0.1, -18.0, f64::NAN] {
            let refused = ClassicSky::new(model).under(&air, 0.0, deg(sun_deg)).unwrap_err();
            assert!(matches!(refused, ClassicSkyError::SunDown { .. }));
            assert!(refused.to_string().contains("above the horizon"), "{refused}");
        }
    }
    // Molecules alone are below what Preetham was fitted to.
    let preetham = ClassicSky::new(ClassicModel::Preetham);
    let refused = preetham.under(&Atmosphere::molecular(), 0.0, deg(30.0)).unwrap_err();
    assert!(refused.to_string().starts_with("sky: turbidity of the air is 1.0"), "{refused}");
    for sky in [
        ClassicSky { turbidity: Some(f64::NAN), ..preetham },
        ClassicSky { turbidity: Some(0.9), ..ClassicSky::new(ClassicModel::CieClear) },
        ClassicSky { turbidity: Some(3.0), ..ClassicSky::new(ClassicModel::CieOvercast) },
        ClassicSky { clearness: Some(3.0), ..preetham },
        ClassicSky { brightness: Some(2.0), ..ClassicSky::new(ClassicModel::Perez) },
    ] {
        assert!(sky.validate().is_err(), "{sky:?}");
    }
}

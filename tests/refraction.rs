//! Refraction against other programs, published tables, and as a pair of inverses.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use nocturne::air::refraction::{ObserverAir, Refraction, Traced};
use nocturne::air::standard::{number_density_per_m3, standard_pressure_mbar};
use nocturne::air::{AIR_TOP_KM, AirError, EARTH_RADIUS_KM};
use nocturne::frame::{Dir, Horizon};
use nocturne::units::Angle;

const TRUTH: &str = include_str!("truth/refraction.csv");

/// The conditions of the Refraction Tables of Pulkovo Observatory, 5th edition (Abalakin 1985).
const PULKOVO: ObserverAir = ObserverAir {
    height_m: 0.0,
    pressure_mbar: 1013.25,
    temperature_c: 15.0,
    relative_humidity: 0.0,
    wavelength_nm: 590.0,
};

/// One line of the table: the air, the apparent altitude, refraction by two programs, arcseconds.
struct Row {
    air: ObserverAir,
    apparent_deg: f64,
    rays_arcsec: f64,
    erfa_arcsec: Option<f64>,
}

fn rows() -> Vec<Row> {
    let lines = TRUTH.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let row = |line: &str| {
        let cells: Vec<Option<f64>> = line.split(',').map(|cell| cell.parse().ok()).collect();
        let number = |at: usize| cells[at].unwrap_or_else(|| panic!("cell {at} of {line}"));
        Row {
            air: ObserverAir {
                height_m: number(0),
                pressure_mbar: number(1),
                temperature_c: number(2),
                relative_humidity: number(3),
                wavelength_nm: number(4),
            },
            apparent_deg: number(5),
            rays_arcsec: number(6),
            erfa_arcsec: cells[7],
        }
    };
    lines.map(row).collect()
}

fn traced(air: &ObserverAir) -> Traced {
    Traced::through(air).expect("air that can be")
}

/// Airs far apart, and as far as they may be.
fn airs() -> Vec<ObserverAir> {
    let mut airs = vec![
        PULKOVO,
        ObserverAir { height_m: 2635.0, pressure_mbar: 743.0, relative_humidity: 0.1, ..PULKOVO },
        ObserverAir { height_m: 8848.0, pressure_mbar: 330.0, temperature_c: -40.0, ..PULKOVO },
        ObserverAir { height_m: 35_000.0, pressure_mbar: 6.0, temperature_c: -36.0, ..PULKOVO },
        ObserverAir { height_m: 100_000.0, pressure_mbar: 3e-4, temperature_c: -80.0, ..PULKOVO },
        ObserverAir { height_m: -430.0, pressure_mbar: 1060.0, temperature_c: 40.0, ..PULKOVO },
        ObserverAir { pressure_mbar: 1100.0, temperature_c: -90.0, ..PULKOVO },
        ObserverAir {
            temperature_c: 60.0,
            relative_humidity: 1.0,
            wavelength_nm: 300.0,
            ..PULKOVO
        },
        ObserverAir { pressure_mbar: 0.0, ..PULKOVO },
        // More vapour than there is room for.
        ObserverAir { pressure_mbar: 2.0, relative_humidity: 1.0, ..PULKOVO },
        ObserverAir {
            height_m: 8000.0,
            pressure_mbar: 330.0,
            temperature_c: 60.0,
            relative_humidity: 1.0,
            ..PULKOVO
        },
    ];
    airs.extend(rows().iter().map(|row| row.air).step_by(12));
    airs
}

#[test]
fn rays_bend_as_other_programs_bend_them() {
    /// Apparent altitude in degrees; how far PAL and ERFA may be off, arcseconds.
    const WITHIN: [(f64, f64, f64); 6] = [
        (0.0, 2.5, 0.0),
        (1.0, 1.0, 0.0),
        (5.0, 0.2, 0.0),
        (15.0, 0.08, 0.08),
        (45.0, 0.025, 0.02),
        (90.0, 0.005, 0.005),
    ];
    let mut largest: BTreeMap<String, [f64; 3]> = BTreeMap::new();
    let rows = rows();
    assert_eq!(rows.len(), 96);
    for row in &rows {
        let deg = row.apparent_deg;
        let altitude = Angle::from_deg(deg);
        let rays = traced(&row.air).at_apparent_altitude(altitude).arcsec();
        let formula = Refraction::new(row.air.pressure_mbar, row.air.temperature_c)
            .at_apparent_altitude(altitude)
            .arcsec();
        let (pal, erfa) = (rays - row.rays_arcsec, row.erfa_arcsec.map_or(0.0, |a| rays - a));
        let &(_, pal_within, erfa_within) = WITHIN.iter().rfind(|w| w.0 <= deg).expect("from zero");
        assert!(pal.abs() < pal_within, "{:?}, {deg}°: PAL {pal}", row.air);
        assert!(erfa.abs() <= erfa_within, "{:?}, {deg}°: ERFA {erfa}", row.air);
        let largest = largest.entry(format!("{deg:04.1}°")).or_default();
        for (largest, value) in largest.iter_mut().zip([pal, erfa, rays - formula]) {
            *largest = largest.max(value.abs());
        }
    }
    for (altitude, [pal, erfa, formula]) in &largest {
        println!("{altitude}: PAL {pal:.3}\", ERFA {erfa:.3}\", Bennett {formula:.2}\"");
    }
}

#[test]
fn rays_bend_as_the_tables_of_pulkovo_say() {
    let rays = traced(&PULKOVO);
    let arcsec = |deg: f64| rays.at_apparent_altitude(Angle::from_deg(deg)).arcsec();
    // The printed horizon is 1977.97"; 1976.28" after Lovchy 2021, J. Opt. Technol. 88, 60.
    assert!((arcsec(0.0) - 1976.28).abs() < 1.5, "{}", arcsec(0.0));
    // Laplace's formula through the tables, good to 0.002" above 30 degrees.
    for deg in [30.0, 45.0, 60.0, 80.0f64] {
        let cotangent = deg.to_radians().tan().recip();
        let table = 57.085 * cotangent - 0.0666 * cotangent.powi(3);
        assert!((arcsec(deg) - table).abs() < 0.006, "{deg}°: {} {table}", arcsec(deg));
    }
}

#[test]
fn rays_that_dip_below_the_horizontal_bend_as_stepping_along_them_does() {
    // The standard atmosphere at 4205 m; its refractivity at sea level by `ref_index.ciddor` 1.0.
    const SEA_LEVEL_REFRACTIVITY: f64 = 2.778_376_354e-4;
    const HEIGHT_KM: f64 = 4.205;
    let refractivity = |height_km: f64| {
        SEA_LEVEL_REFRACTIVITY * number_density_per_m3(height_km) / number_density_per_m3(0.0)
    };
    let curvature = |position: DVec2, direction: DVec2| {
        let height_km = position.length() - EARTH_RADIUS_KM;
        let slope = (refractivity(height_km + 0.01) - refractivity(height_km - 0.01)) / 0.02;
        let gradient = position.normalize() * slope / (1.0 + refractivity(height_km));
        gradient - direction * direction.dot(gradient)
    };
    let step_along = |altitude: Angle| {
        const STEP_KM: f64 = 0.05;
        let (sin, cos) = altitude.sin_cos();
        let start = DVec2::new(cos, sin);
        let (mut position, mut direction) = (DVec2::new(0.0, EARTH_RADIUS_KM + HEIGHT_KM), start);
        while position.length() < EARTH_RADIUS_KM + AIR_TOP_KM {
            let middle = position + direction * (0.5 * STEP_KM);
            let along = direction + curvature(position, direction) * (0.5 * STEP_KM);
            direction = (direction + curvature(middle, along) * STEP_KM).normalize();
            position += along * STEP_KM;
        }
        Angle::from_rad(start.angle_to(direction).abs())
    };
    let geopotential_km = 6356.766 * HEIGHT_KM / (6356.766 + HEIGHT_KM);
    let rays = traced(&ObserverAir {
        height_m: HEIGHT_KM * 1000.0,
        pressure_mbar: standard_pressure_mbar(HEIGHT_KM * 1000.0),
        temperature_c: 15.0 - 6.5 * geopotential_km,
        relative_humidity: 0.0,
        wavelength_nm: 550.0,
    });
    // Nautical rule: 1.76' times the root of the height in metres.
    let horizon_deg = rays.horizon().deg();
    assert!((horizon_deg * 60.0 + 1.76 * 4205.0f64.sqrt()).abs() < 2.0, "{horizon_deg}");
    for deg in [20.0, 3.0, 0.0, -0.5, -1.0, -1.5, horizon_deg + 1e-3] {
        let altitude = Angle::from_deg(deg);
        let (fast, slow) = (rays.at_apparent_altitude(altitude), step_along(altitude));
        assert!((fast - slow).abs().arcsec() < 0.0003 * slow.arcsec(), "{deg}°: {fast:?} {slow:?}");
    }
    let true_horizon = rays.horizon() - step_along(rays.horizon());
    assert!((rays.true_horizon() - true_horizon).abs().arcsec() < 1.0, "{true_horizon:?}");
}

#[test]
fn true_and_apparent_invert_each_other_for_every_air() {
    let formulas = [(0.0, 15.0), (700.0, -20.0), (1010.0, 10.0), (1100.0, -90.0)];
    let formulas = formulas.map(|(mbar, celsius)| Refraction::new(mbar, celsius));
    let rays = airs().into_iter().map(|air| Refraction::traced(&air).expect("air that can be"));
    for refraction in formulas.into_iter().chain(rays) {
        let mut before_deg = f64::NEG_INFINITY;
        for step in -90_000..=90_000 {
            let altitude = Angle::from_deg(f64::from(step) / 1000.0);
            let stands = refraction.true_from_apparent(altitude);
            assert!(stands.deg() > before_deg, "order is lost at {}°", altitude.deg());
            before_deg = stands.deg();
            let back = refraction.apparent_from_true(stands);
            assert!((back - altitude).deg().abs() < 1e-9, "{}°", altitude.deg());
            let seen = refraction.apparent_from_true(altitude);
            let back = refraction.true_from_apparent(seen);
            assert!((back - altitude).deg().abs() < 1e-9, "{}°", altitude.deg());
        }
        let zenith = refraction.at_apparent_altitude(Angle::from_deg(90.0));
        assert!(zenith.abs().rad() < 1e-15, "{zenith:?}");
    }
}

#[test]
fn directions_keep_their_azimuth_and_come_back() {
    for refraction in [Refraction::new(1010.0, 10.0), Refraction::traced(&PULKOVO).unwrap()] {
        let dir = Dir::from_azimuth_altitude(Angle::from_deg(211.0), Angle::from_deg(-0.4));
        let seen = refraction.apparent_from_horizon(dir);
        assert!((seen.azimuth().deg() - 211.0).abs() < 1e-10);
        assert!(seen.altitude().deg() > 0.0, "refraction lifts it above the horizon");
        let back = refraction.horizon_from_apparent(seen);
        assert!(back.separation(dir).deg() < 1e-10);
        let zenith = Dir::<Horizon>::from_vector(DVec3::Z);
        assert!((refraction.apparent_from_horizon(zenith).vector().z - 1.0).abs() < 1e-15);
    }
    let none = Refraction::default().apparent_from_true(Angle::from_deg(0.3));
    assert!((none.deg() - 0.3).abs() < 1e-12);
}

#[test]
fn refraction_grows_without_a_step_down_to_the_horizon_and_on() {
    for air in airs() {
        let rays = traced(&air);
        let deg =
            |altitude_deg: f64| rays.at_apparent_altitude(Angle::from_deg(altitude_deg)).deg();
        let horizon = rays.horizon().deg();
        let step = 1e-5;
        let slope = |at: f64| (deg(at + step) - deg(at - step)) / (2.0 * step);
        let (above, below) = (slope(horizon + 2.0 * step), slope(horizon - 2.0 * step));
        assert!((above - below).abs() < 1e-3 * (1.0 + above.abs()), "{air:?}: {above} {below}");
        assert!(deg(90.0) <= deg(45.0) && deg(45.0) <= deg(5.0) && deg(5.0) <= deg(horizon));
        assert!(deg(-90.0).abs() < 1e-12);
    }
}

#[test]
fn blue_light_moist_air_and_cold_do_what_they_should() {
    let arcsec = |air: &ObserverAir, deg: f64| {
        traced(air).at_apparent_altitude(Angle::from_deg(deg)).arcsec()
    };
    // Ratios of refractivities at 15 degrees Celsius by `ref_index.ciddor` 1.0.
    let violet = arcsec(&ObserverAir { wavelength_nm: 400.0, ..PULKOVO }, 45.0);
    let red = arcsec(&ObserverAir { wavelength_nm: 700.0, ..PULKOVO }, 45.0);
    assert!((violet / red - 1.025_226).abs() < 1e-5, "{}", violet / red);
    let moist = arcsec(&ObserverAir { relative_humidity: 1.0, ..PULKOVO }, 45.0);
    let dry = arcsec(&PULKOVO, 45.0);
    assert!(moist < dry && moist > 0.995 * dry, "{moist} {dry}");
    let none = traced(&ObserverAir { pressure_mbar: 0.0, ..PULKOVO });
    assert_eq!(none.at_apparent_altitude(Angle::ZERO), Angle::ZERO);
}

#[test]
fn impossible_air_is_refused_in_words() {
    let damp = ObserverAir { relative_humidity: 1.2, ..PULKOVO };
    assert_eq!(
        Traced::through(&damp).unwrap_err().to_string(),
        "air: relative_humidity is 1.2, outside 0 to 1; choose a value inside"
    );
    for air in [
        ObserverAir { pressure_mbar: f64::NAN, ..PULKOVO },
        ObserverAir { temperature_c: -91.0, ..PULKOVO },
        ObserverAir { height_m: 1e6, ..PULKOVO },
        ObserverAir { wavelength_nm: 21.0, ..PULKOVO },
    ] {
        assert!(matches!(Traced::through(&air), Err(AirError::Range { .. })), "{air:?}");
    }
    let heavy = ObserverAir { height_m: 9000.0, temperature_c: -80.0, ..PULKOVO };
    assert_eq!(
        Traced::through(&heavy).unwrap_err().to_string(),
        "air: 1013.25 mbar at 9000 m make air on the ground that bends light around the Earth; give \
         the pressure at the height of the observer"
    );
}

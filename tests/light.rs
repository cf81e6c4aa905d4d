//! Light and air against authorities, and against a slow independent calculation.

use std::collections::HashMap;

use glam::DVec2;
use nocturne::air::cross_section::DOBSON_UNIT_PER_M2;
use nocturne::air::extinction::{horizon_altitude, slant_columns};
use nocturne::air::standard::number_density_per_m3;
use nocturne::air::{AIR_TOP_KM, Atmosphere, EARTH_RADIUS_KM};
use nocturne::light::moon::{self, MoonView};
use nocturne::light::planets::{self, Planet, PlanetView};
use nocturne::light::star_light::StarLight;
use nocturne::light::star_spectrum::StarShape;
use nocturne::units::{Angle, Magnitude};

/// The rows of a file in `tests/truth`, by column name.
fn rows(csv: &str) -> Vec<HashMap<&str, &str>> {
    let mut lines = csv.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    lines.map(|line| names.iter().copied().zip(line.split(',')).collect()).collect()
}

fn number(row: &HashMap<&str, &str>, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name} of {row:?} is not a number"))
}

#[test]
fn planets_have_the_magnitudes_of_their_authors() {
    // Their own program, and another that follows it over all of the ranges.
    let own = rows(include_str!("truth/light_planet_magnitudes.csv"));
    let other = rows(include_str!("truth/planet_magnitudes.csv"));
    assert_eq!((own.len(), other.len()), (21, 84));
    for row in own.iter().chain(&other) {
        let planet = match row["planet"] {
            "Mercury" => Planet::Mercury,
            "Venus" => Planet::Venus,
            "Mars" => Planet::Mars,
            "Jupiter" => Planet::Jupiter,
            "Saturn" => Planet::Saturn,
            "Uranus" => Planet::Uranus,
            "Neptune" => Planet::Neptune,
            other => panic!("no planet is called {other}"),
        };
        let view = PlanetView {
            sun_distance_au: number(row, "sun_distance_au"),
            observer_distance_au: number(row, "observer_distance_au"),
            phase: Angle::from_deg(number(row, "phase_deg")),
            sun_latitude: Angle::from_deg(number(row, "sun_latitude_deg")),
            observer_latitude: Angle::from_deg(number(row, "observer_latitude_deg")),
            year: number(row, "year"),
        };
        let got = planets::magnitude(planet, &view).magnitude.0;
        let (want, within) = (number(row, "v_mag"), number(row, "tolerance_mag"));
        assert!((got - want).abs() < within, "{planet:?}: {got}, not {want}");
    }
}

#[test]
fn moonlight_follows_the_published_phase_curve() {
    let rows = rows(include_str!("truth/light_moon_phase_curve.csv"));
    assert_eq!(rows.len(), 17);
    for row in &rows {
        let phase_deg = number(row, "phase_deg");
        let light = moon::irradiance(&MoonView::at_phase(Angle::from_deg(phase_deg))).xyzv();
        let lx = number(row, "photopic_lx");
        assert!((light.y / lx - 1.0).abs() < 5e-3, "{phase_deg}°: {} lx, not {lx}", light.y);
        let ratio = number(row, "scotopic_over_photopic");
        assert!((light.v / light.y / ratio - 1.0).abs() < 5e-3, "{phase_deg}°: S/P not {ratio}");
    }
}

/// What a ray meets on its way from the eye to space.
struct Traced {
    air_per_m2: f64,
    ozone_per_m2: f64,
    aerosol_550: f64,
    /// How far the ray has turned.
    bending: Angle,
}

/// A density that is linear between the nodes of the program's air: each kilometre to 30, each two to
/// 60, each five above.
fn layered(height_km: f64, density: impl Fn(f64) -> f64) -> f64 {
    let step_km = if height_km < 30.0 {
        1.0
    } else if height_km < 60.0 {
        2.0
    } else {
        5.0
    };
    let low_km = (height_km / step_km).floor() * step_km;
    let share = (height_km - low_km) / step_km;
    density(low_km) * (1.0 - share) + density(low_km + step_km) * share
}

/// Follows a ray step by step through the plane of the Earth's centre: `d(n t)/ds = grad n`.
fn trace(height_km: f64, altitude: Angle, step_km: f64) -> Traced {
    const REFRACTIVITY: f64 = 2.777e-4;
    let sea_level = number_density_per_m3(0.0);
    let refractivity = |height_km: f64| REFRACTIVITY * number_density_per_m3(height_km) / sea_level;
    // Curvature vector of the ray: the part of grad n / n across it.
    let turn = |position: DVec2, direction: DVec2| {
        let radius_km = position.length();
        let height_km = radius_km - EARTH_RADIUS_KM;
        let slope = (refractivity(height_km + 0.01) - refractivity(height_km - 0.01)) / 0.02;
        let gradient = position / radius_km * slope / (1.0 + refractivity(height_km));
        gradient - direction * direction.dot(gradient)
    };
    let (sin, cos) = altitude.sin_cos();
    let mut position = DVec2::new(0.0, EARTH_RADIUS_KM + height_km);
    let mut direction = DVec2::new(cos, sin);
    let start = direction;
    let mut sum =
        Traced { air_per_m2: 0.0, ozone_per_m2: 0.0, aerosol_550: 0.0, bending: Angle::ZERO };
    while position.length() < EARTH_RADIUS_KM + AIR_TOP_KM {
        // Midpoint rule for position and direction alike.
        let half_direction = direction + turn(position, direction) * (0.5 * step_km);
        let middle = position + direction * (0.5 * step_km);
        let height_km = middle.length() - EARTH_RADIUS_KM;
        sum.air_per_m2 += layered(height_km, number_density_per_m3) * step_km * 1000.0;
        let tent = (1.0 - (height_km - 25.0).abs() / 15.0).max(0.0) / 15.0;
        sum.ozone_per_m2 += 300.0 * DOBSON_UNIT_PER_M2 * tent * step_km;
        // Layers of a kilometre hold a little more than the exponential that they are drawn through.
        let coth = 0.5 / 1.2 / (0.5f64 / 1.2).tanh();
        let haze = layered(height_km, |km| if km > 30.0 { 0.0 } else { (-km / 1.2).exp() });
        sum.aerosol_550 += 0.1 / 1.2 * haze / coth * step_km;
        direction = (direction + turn(middle, half_direction) * step_km).normalize();
        position += half_direction * step_km;
    }
    sum.bending = Angle::from_rad(start.angle_to(direction).abs());
    sum
}

#[test]
fn columns_agree_with_stepping_along_the_ray() {
    let mut air = Atmosphere::default();
    air.ground.height_m = Some(0.0);
    for (height_m, altitudes_deg) in [
        (0.0, [90.0, 30.0, 10.0, 3.0, 1.0, 0.3, 0.0]),
        (2635.0, [60.0, 5.0, 1.0, 0.0, -0.5, -1.0, -1.4]),
    ] {
        // The standard weather of the height bends light as the standard atmosphere does.
        air.observer.temperature_c = Some(15.0 - 6.5e-3 * height_m);
        for altitude_deg in altitudes_deg {
            let altitude = Angle::from_deg(altitude_deg);
            assert!(altitude >= horizon_altitude(&air, height_m));
            let slow = trace(height_m / 1000.0, altitude, 0.05);
            let fast = slant_columns(&air, height_m, altitude);
            for (what, fast, slow) in [
                ("air", fast.air_per_m2, slow.air_per_m2),
                ("ozone", fast.ozone_per_m2, slow.ozone_per_m2),
                ("aerosol", fast.aerosols_550[0], slow.aerosol_550),
            ] {
                let error = fast / slow - 1.0;
                assert!(error.abs() < 3e-4, "{what}, {height_m} m, {altitude_deg}°: {error:e}");
            }
        }
    }
}

#[test]
fn bennett_agrees_with_the_bending_of_the_ray() {
    // The standard atmosphere at sea level: 1013.25 mbar, 15 degrees Celsius.
    let mut air = Atmosphere::default();
    air.observer.temperature_c = Some(15.0);
    let refraction = air.refraction_at(0.0);
    // The formula stays within 0.1' of this air down to 5 degrees; at the horizon its standard
    // air and this one differ by an arcminute.
    for (altitude_deg, within_arcmin) in
        [(60.0, 0.03), (30.0, 0.06), (10.0, 0.12), (5.0, 0.12), (1.0, 0.6), (0.0, 1.2)]
    {
        let altitude = Angle::from_deg(altitude_deg);
        let bennett = refraction.at_apparent_altitude(altitude).arcmin();
        let traced = trace(0.0, altitude, 0.05).bending.arcmin();
        let apart = bennett - traced;
        assert!(apart.abs() < within_arcmin, "{altitude_deg}°: {bennett}' and {traced}'");
    }
}

#[test]
fn a_star_fades_and_reddens_as_it_sinks() {
    let starlight = StarLight::new(&Atmosphere::default(), 0.0);
    let outside = Magnitude(0.0).illuminance();
    let at =
        |deg: f64| starlight.at_eye(StarShape::of_black_body(0.0), Angle::from_deg(deg), outside);
    // A quarter of a magnitude in the zenith and twice that at 30 degrees.
    let lost = |deg: f64| -2.5 * (at(deg).y / outside.lx()).log10();
    assert!((lost(90.0) - 0.245).abs() < 0.015, "{}", lost(90.0));
    assert!((lost(30.0) / lost(90.0) - 2.0).abs() < 0.03, "{}", lost(30.0));
    // At the horizon the losses are those at 550 nm, less what the surviving red makes up for.
    let columns = slant_columns(&Atmosphere::default(), 0.0, Angle::ZERO);
    let green = columns.optical_depths(&Atmosphere::default())[38].iter().sum::<f64>() * 2.5
        / std::f64::consts::LN_10;
    assert!((0.8..1.0).contains(&(lost(0.0) / green)), "{} {green}", lost(0.0));
    let s_p = |deg: f64| at(deg).v / at(deg).y;
    assert!(s_p(90.0) > s_p(10.0) && s_p(10.0) > s_p(0.0));
}

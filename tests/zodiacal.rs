//! The zodiacal light in named directions, its smoothness, its behaviour at the Sun, its colour.

use nocturne::light::zodiacal::{elongation, radiance, radiance_500, redness, spectra};
use nocturne::units::Angle;

/// 1e-8 W m-2 sr-1 um-1 in W m-2 sr-1 nm-1.
const UNIT: f64 = 1e-11;

fn deg(deg: f64) -> Angle {
    Angle::from_deg(deg)
}
fn at(longitude_deg: f64, latitude_deg: f64) -> f64 {
    radiance_500(deg(longitude_deg), deg(latitude_deg)) / UNIT
}

/// Leinert et al. 1998, Table 17, typed from the paper's grid: name, longitude, latitude, radiance.
const NAMED: [(&str, f64, f64, f64); 20] = [
    ("the cone, low", 15.0, 0.0, 11500.0),
    ("the cone at 20 degrees", 20.0, 0.0, 6400.0),
    ("the cone at 30 degrees", -30.0, 0.0, 2480.0),
    ("its northern flank", 30.0, 15.0, 845.0),
    ("its southern flank", 30.0, -15.0, 845.0),
    ("the cone at 45 degrees", -45.0, 0.0, 910.0),
    ("beside it", 45.0, 30.0, 250.0),
    ("the cone at 60 degrees", 60.0, 0.0, 505.0),
    ("square to the Sun", 90.0, 0.0, 259.0),
    ("square, north", -90.0, 30.0, 132.0),
    ("the bridge", 120.0, 0.0, 188.0),
    ("the bridge, darkest", 150.0, 0.0, 179.0),
    ("gegenschein", 180.0, 0.0, 230.0),
    ("gegenschein, 10 degrees up", 180.0, 10.0, 195.0),
    ("gegenschein, the other turn", -180.0, -10.0, 195.0),
    ("pole of the ecliptic", 0.0, 90.0, 77.0),
    ("south pole", 123.0, -90.0, 77.0),
    ("darkest of all", 180.0, 75.0, 72.0),
    ("above the Sun", 0.0, 15.0, 3140.0),
    ("far above the Sun", 0.0, 45.0, 275.0),
];

#[test]
fn named_directions_have_the_light_of_the_table() {
    for (name, longitude_deg, latitude_deg, expected) in NAMED {
        let got = at(longitude_deg, latitude_deg);
        assert!((got / expected - 1.0).abs() < 1e-6, "{name}: {got} {expected}");
    }
}

#[test]
fn it_is_symmetric_and_has_no_seam() {
    for longitude_deg in [0.0, 3.0, 17.0, 88.0, 133.3, 179.9] {
        for latitude_deg in [0.0, 2.0, 12.0, 51.0, 89.0] {
            let here = at(longitude_deg, latitude_deg);
            for other in [
                at(-longitude_deg, latitude_deg),
                at(longitude_deg, -latitude_deg),
                at(360.0 + longitude_deg, latitude_deg),
                at(longitude_deg - 720.0, -latitude_deg),
            ] {
                assert!((other / here - 1.0).abs() < 1e-9, "{longitude_deg} {latitude_deg}");
            }
        }
    }
    let pole = at(0.0, 90.0);
    for longitude_deg in 0..36 {
        assert!((at(f64::from(longitude_deg) * 10.0, 89.999) / pole - 1.0).abs() < 1e-4);
    }
}

/// On circles through the sky, whatever the lines of the table: the slope of the logarithm, per degree,
/// changes by little over a tenth of a degree. A kink of 1 % per degree would be told.
#[test]
fn it_has_no_kinks() {
    let step_rad = 0.1f64.to_radians();
    let (mut most, mut place) = (0.0f64, (0.0, 0.0));
    for circle in 0..40 {
        // Circles through a point of the ecliptic at many slopes, the table's own lines among them.
        let node_deg = f64::from(circle) * 9.0;
        let slope = (f64::from(circle % 8) * 12.5 + 2.5).to_radians();
        let direction = |k: i32| {
            let along = f64::from(k) * step_rad;
            let (x, y) = (along.cos(), along.sin());
            let latitude = (y * slope.sin()).asin();
            let longitude = (y * slope.cos()).atan2(x) + node_deg.to_radians();
            (Angle::from_rad(longitude), Angle::from_rad(latitude))
        };
        let ln = |k: i32| {
            let (longitude, latitude) = direction(k);
            radiance_500(longitude, latitude).ln()
        };
        for k in 0..3600 {
            let (longitude, latitude) = direction(k);
            if elongation(longitude, latitude).deg() < 12.0 {
                continue;
            }
            let change = (ln(k + 1) - 2.0 * ln(k) + ln(k - 1)).abs() / 0.1;
            if change > most {
                (most, place) = (change, (longitude.deg(), latitude.deg()));
            }
        }
    }
    assert!(most < 0.01, "the slope changes by {most} per degree at {place:?}");
}

#[test]
fn near_the_sun_it_grows_and_stays_finite() {
    // Steadily to the Sun, along the ecliptic and across it.
    for (along, up) in [(1.0, 0.0), (0.0, 1.0), (0.7, 0.7)] {
        let mut before = 0.0;
        for step in (0..=300).rev() {
            let away = f64::from(step) * 0.1;
            let here = at(along * away, up * away);
            // Within the core it is level.
            let slack = if away < 2.0 { 0.999 } else { 1.0 };
            assert!(here >= slack * before && here.is_finite(), "{along} {up} {away}: {here}");
            before = here;
        }
    }
    // The power of the F corona between 4 and 12 degrees.
    for (along, up, low, high) in [(1.0, 0.0, 1.9, 2.6), (0.0, 1.0, 1.9, 2.6)] {
        let power = (at(4.0 * along, 4.0 * up) / at(12.0 * along, 12.0 * up)).ln() / 3f64.ln();
        assert!((low..high).contains(&power), "{along} {up}: {power}");
    }
    // Within a factor of 2 of Baumbach's law, which the corona has, where that ends: 1.3e-10 of the
    // Sun's disc at 10 radii.
    let ratio = at(2.67, 0.0) * UNIT / (2.86e4 * 1.3e-10);
    assert!((0.5..2.0).contains(&ratio), "{ratio}");
}

#[test]
fn it_is_sunlight_reddened() {
    assert!((redness(deg(10.0)) - 1.0).abs() < 1e-12 && redness(deg(120.0)) == 0.0);
    assert!((redness(deg(60.0)) - 0.5).abs() < 1e-12);
    assert!((elongation(deg(60.0), deg(60.0)).deg() - 75.522_5).abs() < 1e-3);
    for spectrum in spectra() {
        assert!((spectrum.at_nm(500.0) - 1.0).abs() < 1e-12);
    }
    // Their Table 19, 90 degrees from the Sun in the ecliptic, W m-2 sr-1 um-1: two digits, and without
    // the lines of the Sun. Means over 20 nm; at 400 nm above the lines of calcium.
    let light = radiance(deg(90.0), deg(0.0));
    for (nm, from_nm, expected, within) in
        [(400, 400.0, 2.2e-6, 0.06), (500, 490.0, 2.6e-6, 0.02), (700, 690.0, 2.0e-6, 0.06)]
    {
        let nodes = [0.0, 5.0, 10.0, 15.0, 20.0].map(|off| light.at_nm(from_nm + off));
        let off = nodes.iter().sum::<f64>() / 5.0 * 1e3 / expected - 1.0;
        assert!(off.abs() < within, "{nm} nm: off by {off}");
    }
}

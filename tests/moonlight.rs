//! The light of the Moon's disc as its maps and Hapke's model tell it, against ROLO and against
//! plainer sums.

use std::sync::LazyLock;

use glam::DVec3;
use nocturne::air::Atmosphere;
use nocturne::catalog::moon::hapke::BANDS_NM;
use nocturne::catalog::{Catalogs, MoonHapke, MoonMap};
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::frame::{Dir, MoonFixed};
use nocturne::light::moon::{self, MoonSurface, MoonView, Reflectance, hapke};
use nocturne::light::night::Night;
use nocturne::light::spectrum::{LEN, Spectrum};
use nocturne::light::sun;
use nocturne::place::Place;
use nocturne::sky::SkyState;
use nocturne::time;
use nocturne::units::{AU_KM, Angle, MOON_RADIUS_KM};

static MAPS: LazyLock<(MoonMap, MoonHapke)> = LazyLock::new(|| {
    let catalogs = Catalogs::locate(None).expect("catalogues");
    (catalogs.moon_map().expect("albedo"), catalogs.moon_hapke().expect("parameters"))
});
static SURFACE: LazyLock<MoonSurface> = LazyLock::new(|| MoonSurface::new(&MAPS.0, &MAPS.1));

fn dir(longitude_deg: f64, latitude_deg: f64) -> Dir<MoonFixed> {
    Dir::from_spherical(Angle::from_deg(longitude_deg), Angle::from_deg(latitude_deg))
}

/// Without libration; the Sun in the east (waxing) for positive angles.
fn at_phase(phase_deg: f64) -> (MoonView, Dir<MoonFixed>, Dir<MoonFixed>) {
    let view = MoonView {
        sun_longitude: Some(Angle::from_deg(phase_deg)),
        ..MoonView::at_phase(Angle::from_deg(phase_deg.abs()))
    };
    (view, dir(phase_deg, 0.0), dir(0.0, 0.0))
}

/// Means of something over the disc as the observer sees it, pixel by pixel; 0 beside the disc is
/// not counted.
fn disc_mean<const N: usize>(
    observer: Dir<MoonFixed>,
    of: impl Fn(Dir<MoonFixed>) -> [f64; N],
) -> [f64; N] {
    let n = 400;
    let forward = observer.vector();
    let right = DVec3::Z.cross(forward).normalize();
    let up = forward.cross(right);
    let mut sum = [0.0; N];
    for row in 0..n {
        for column in 0..n {
            let [x, y] = [column, row].map(|at| (f64::from(at) + 0.5) / f64::from(n) * 2.0 - 1.0);
            let square = 1.0 - x * x - y * y;
            if square > 0.0 {
                let place = forward * square.sqrt() + right * x + up * y;
                for (sum, value) in sum.iter_mut().zip(of(Dir::from_vector(place))) {
                    *sum += value;
                }
            }
        }
    }
    sum.map(|sum| sum * 4.0 / (std::f64::consts::PI * f64::from(n * n)))
}

/// Rows: phase, then the disc's equivalent reflectance at 450, 550 and 650 nm.
fn rolo_rows() -> Vec<[f64; 4]> {
    let text = include_str!("truth/moon_rolo_albedo.csv");
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let numbers = rows.map(|row| row.split(',').map(|cell| cell.parse().expect("a number")));
    numbers.map(|row| row.collect::<Vec<f64>>().try_into().expect("four columns")).collect()
}

/// Rows of the whole phase curve: phase, lux, then equivalent reflectances at 450, 550 and 650 nm. It is
/// that of ROLO half-way between waxing and waning, without libration, at 384 400 km and 1 au.
fn phase_curve() -> Vec<[f64; 5]> {
    let text = include_str!("truth/rolo_phase_curve.csv");
    let columns = |row: &str| -> Vec<f64> {
        row.split(',').map(|cell| cell.parse().expect("a number")).collect()
    };
    let rows = text.lines().skip(1).map(columns);
    // Its order of the reflectances is 550, 450, 650.
    rows.map(|row| [row[0], row[1], row[8], row[7], row[9]]).collect()
}

/// How far from the curve the light of the disc may be: where the fit ends it goes on in its own way, and
/// the curve by the polynomials of the fit.
fn within(phase_deg: f64) -> f64 {
    match phase_deg {
        ..=97.0 => 0.001,
        ..=120.0 => 0.03,
        _ => 0.25,
    }
}

/// The illuminance of the curve at a phase angle within it, straight between the logarithms.
fn curve_lx(curve: &[[f64; 5]], phase_deg: f64) -> f64 {
    let row = curve.windows(2).find(|pair| (pair[0][0]..=pair[1][0]).contains(&phase_deg));
    let [low, high] = row.expect("within the curve") else { panic!("two rows") };
    let share = (phase_deg - low[0]) / (high[0] - low[0]);
    (low[1].ln() + (high[1] / low[1]).ln() * share).exp()
}

#[test]
fn the_light_of_the_disc_follows_the_phase_curve() {
    let curve = phase_curve();
    assert_eq!(curve.len(), 24);
    let mut worst = [0.0f64; 4];
    for [phase_deg, lx, a450, a550, a650] in curve {
        let plain = MoonView::at_phase(Angle::from_deg(phase_deg));
        let got = moon::irradiance(&plain).xyzv().y;
        let error = got / lx - 1.0;
        // Waxing and waning differ from it by as much as the seas do, to opposite sides.
        let sides = [phase_deg, -phase_deg]
            .map(|phase_deg| moon::irradiance(&at_phase(phase_deg).0).xyzv().y / lx);
        let mean = (sides[0] * sides[1]).sqrt() - 1.0;
        let albedo = |nm| moon::disc_reflectance_at(&plain, nm);
        let slopes = [
            albedo(450.0) / albedo(550.0) / (a450 / a550),
            albedo(650.0) / albedo(550.0) / (a650 / a550),
        ]
        .map(|ratio| ratio - 1.0);
        println!(
            "{phase_deg:5}°: {got:.6} lx, {:+.3} %; waxing {:+.2} %, waning {:+.2} %; 450/550 {:+.2} %, 650/550 {:+.2} %",
            100.0 * error,
            100.0 * (sides[0] - 1.0),
            100.0 * (sides[1] - 1.0),
            100.0 * slopes[0],
            100.0 * slopes[1]
        );
        assert!(error.abs() < within(phase_deg), "{phase_deg}°: {error}");
        assert!(mean.abs() < within(phase_deg) + 0.005, "{phase_deg}°: {mean}");
        if phase_deg <= 120.0 {
            assert!(slopes.iter().all(|slope| slope.abs() < 0.03), "{phase_deg}°: {slopes:?}");
            assert!(sides.iter().all(|side| (side - 1.0).abs() < 0.10), "{phase_deg}°: {sides:?}");
            for (worst, error) in worst.iter_mut().zip([error, mean, slopes[0], slopes[1]]) {
                *worst = worst.max(error.abs());
            }
        }
    }
    println!(
        "largest differences to 120 degrees: light, mean of both sides, blue, red: {worst:.4?}"
    );
}

/// The Moon of the sky, with its distances, librations and the light of the Earth, through one lunation.
#[test]
fn the_moon_of_the_sky_is_as_bright_as_the_curve() {
    let curve = phase_curve();
    let catalogs = Catalogs::locate(None).expect("catalogues");
    let tolerance = Angle::from_arcsec(1.0);
    let ephemeris = Ephemeris::load(&catalogs, tolerance).expect("tables");
    let place = Place::new(35.2, -111.65, 2100.0).expect("a place");
    let start = time::parse("2027-02-07T06:00Z").expect("a time");
    let start = time::to_instant(&start, None).expect("an instant");
    let mut seen = [[0.0f64; 2]; 2];
    let mut earthshine_of_thin = 0.0f64;
    println!("phase     lx        over the curve, sunlight alone; earthshine");
    for step in 0..59 {
        let instant = start.plus_seconds(43_200.0 * f64::from(step)).expect("an instant");
        let sky = SkyState::at(&ephemeris, &instant, &place, tolerance).expect("a sky");
        let night = Night::of(sky, Vec::new(), &Atmosphere::default());
        let state = &night.sky.moon.state;
        let phase_deg = state.phase_angle.deg();
        let object = night.body(Body::Moon).expect("the Moon");
        let (all, sunlit, earthlit) = (
            night.irradiance(state).xyzv().y,
            night.sunlit_moon().xyzv().y,
            night.earthlit_moon().xyzv().y,
        );
        assert!((all / (sunlit + earthlit) - 1.0).abs() < 1e-12);
        assert!((object.outside.lx() / all - 1.0).abs() < 1e-12);
        assert!((object.magnitude.0 - object.outside.magnitude().0).abs() < 1e-12);
        if !(3.0..=120.0).contains(&phase_deg) {
            if phase_deg > 165.0 {
                earthshine_of_thin = earthshine_of_thin.max(earthlit / all);
            }
            continue;
        }
        let nearness =
            (384_400.0 / state.distance_km).powi(2) * (AU_KM / state.sun_distance_km).powi(2);
        let wanted = curve_lx(&curve, phase_deg) * nearness;
        let waxing = usize::from(night.sky.moon.subsolar.longitude.signed() < Angle::ZERO);
        println!(
            "{}{phase_deg:6.1} {all:9.6} {:+.2} % {:+.2} %; {:.2} %",
            ["+", "-"][waxing],
            100.0 * (all / wanted - 1.0),
            100.0 * (sunlit / wanted - 1.0),
            100.0 * earthlit / all
        );
        seen[waxing][0] += (sunlit / wanted).ln();
        seen[waxing][1] += 1.0;
        // A side alone may be 7 % off the mean of both, and the librations 1 % more.
        assert!((all / wanted - 1.0).abs() < 0.10, "{phase_deg}°: {all} lx, not {wanted}");
        assert!(earthlit / all < 0.002, "{phase_deg}°: {earthlit} of {all}");
    }
    let mean = seen.map(|[sum, count]| sum / count);
    println!(
        "waxing {:+.4}, waning {:+.4}; earthshine at most {earthshine_of_thin:.3}",
        mean[0], mean[1]
    );
    assert!((0.5 * (mean[0] + mean[1])).abs() < 0.05 && mean[0] > 0.0 && mean[1] < 0.0);
    // Of the thinnest crescents the Earth lights the most.
    assert!(earthshine_of_thin > 0.5);
}

#[test]
fn beyond_the_measured_phases_the_light_goes_on_smoothly() {
    for side in [1.0, -1.0] {
        let at = |deg: f64| moon::irradiance(&at_phase(side * deg).0).xyzv().y;
        // Steps of a tenth of a degree: no jump, always fainter.
        for step in 0..1800 {
            let [here, next] = [0.0, 0.1].map(|more| at(0.1 * f64::from(step) + more));
            assert!(next < here && here.is_finite(), "{side} {step}: {here} {next}");
            assert!(next > 0.95 * here || step > 1650, "{side} {step}: {here} {next}");
        }
        // The surge: an eighth to a fifth more at 0 than where the measurements begin.
        let surge = at(0.0) / at(1.55);
        println!("surge over 1.55 degrees: {surge:.3}");
        assert!((1.08..1.25).contains(&surge));
        assert_eq!(at(180.0), 0.0);
    }
}

/// Straight between the bands, and on beyond the last.
fn at_nm(bands: [f64; 3], nm: f64) -> f64 {
    let k = usize::from(nm > BANDS_NM[1]);
    let share = (nm - BANDS_NM[k]) / (BANDS_NM[k + 1] - BANDS_NM[k]);
    bands[k] + (bands[k + 1] - bands[k]) * share
}

#[test]
fn the_sum_of_the_maps_is_that_of_rolo_before_any_scaling() {
    let rows = rolo_rows();
    assert_eq!(rows.len(), 19);
    println!("phase  450    550    650    Jensen at 550; waxing over waning at 550");
    for [phase_deg, rolo @ ..] in rows {
        let sum = |law| {
            let [waxing, waning] = [phase_deg, -phase_deg].map(|phase_deg| {
                let (_, sun, observer) = at_phase(phase_deg);
                SURFACE.disc_reflectance(law, sun, observer)
            });
            let mean: [f64; 3] = std::array::from_fn(|k| 0.5 * (waxing[k] + waning[k]));
            let ratio = at_nm(waxing, 550.0) / at_nm(waning, 550.0);
            ([450.0, 550.0, 650.0].map(|nm| at_nm(mean, nm)), ratio)
        };
        let (hapke, sides) = sum(Reflectance::Hapke);
        let (jensen, _) = sum(Reflectance::Jensen);
        let ratios: [f64; 3] = std::array::from_fn(|k| hapke[k] / rolo[k]);
        let [blue, green, red] = ratios;
        let plain = jensen[1] / rolo[1];
        println!("{phase_deg:5} {blue:6.3} {green:6.3} {red:6.3} {plain:6.3} {sides:6.3}");
        let within = match phase_deg {
            ..=20.0 => 0.06,
            ..=60.0 => 0.09,
            ..=90.0 => 0.13,
            _ => 0.18,
        };
        for ratio in ratios {
            assert!((ratio - 1.0).abs() < within, "{phase_deg}°: {ratios:?}");
        }
        // Colours: straight lines between three bands against ROLO's own.
        assert!((red / blue - 1.0).abs() < 0.05, "{phase_deg}°: {}", red / blue);
    }
}

#[test]
fn the_quick_sum_is_that_of_many_pixels() {
    for law in [Reflectance::Jensen, Reflectance::Hapke] {
        for (sun, observer) in [
            (dir(0.5, 0.5), dir(0.0, 0.0)),
            (dir(-20.0, 1.0), dir(6.0, -5.0)),
            (dir(70.0, -1.5), dir(-7.0, 6.0)),
            (dir(-92.0, 0.0), dir(0.0, 0.0)),
            (dir(130.0, 1.5), dir(5.0, 2.0)),
        ] {
            let quick = SURFACE.disc_reflectance(law, sun, observer);
            let slow =
                disc_mean(observer, |place| SURFACE.radiance_factor(law, place, sun, observer));
            for band in 0..3 {
                let ratio = quick[band] / slow[band];
                // Of the crescent the pixels themselves leave some.
                let within = if sun.dot(observer) < -0.5 { 8e-3 } else { 4e-3 };
                assert!((ratio - 1.0).abs() < within, "{law:?} {sun:?}, band {band}: {ratio}");
            }
        }
    }
}

#[test]
fn the_disc_sends_what_rolo_says_at_every_wavelength() {
    for law in [Reflectance::Jensen, Reflectance::Hapke] {
        for phase_deg in [2.0, -45.0, 90.0, 140.0] {
            let (view, sun, observer) = at_phase(phase_deg);
            let light = SURFACE.disc_light(law, &view, sun, observer);
            let factors =
                disc_mean(observer, |place| SURFACE.radiance_factor(law, place, sun, observer));
            let solid_angle_sr =
                sun::projected_solid_angle_sr(MOON_RADIUS_KM, view.observer_distance_km);
            let wanted: Spectrum = moon::irradiance(&view);
            for node in 0..LEN {
                let mean: f64 =
                    (0..3).map(|k| light.radiance_per_factor[k].values()[node] * factors[k]).sum();
                let ratio = mean * solid_angle_sr / wanted.values()[node];
                assert!((ratio - 1.0).abs() < 4e-3, "{law:?} {phase_deg}°, node {node}: {ratio}");
            }
        }
    }
    let (view, sun, observer) = at_phase(180.0);
    let dark = SURFACE.disc_light(Reflectance::Hapke, &view, sun, observer);
    let values = dark.radiance_per_factor.iter().flat_map(|part| part.values().iter());
    assert!(values.into_iter().all(|value| *value == 0.0), "{:?}", dark.rolo_over_maps);
}

#[test]
fn the_full_moon_has_no_limb_darkening() {
    let mut medians = MAPS.1.cells[0];
    for (band, median) in medians.iter_mut().enumerate() {
        let middle = |of: fn(&nocturne::catalog::moon::HapkeCell) -> f64| {
            let mut all: Vec<f64> = MAPS.1.cells.iter().map(|cell| of(&cell[band])).collect();
            all.sort_by(f64::total_cmp);
            all[all.len() / 2]
        };
        median.w = middle(|cell| cell.w);
        median.b = middle(|cell| cell.b);
        median.c = middle(|cell| cell.c);
        median.b_s0 = middle(|cell| cell.b_s0);
        median.h_s = middle(|cell| cell.h_s);
    }
    for law in [Reflectance::Jensen, Reflectance::Hapke] {
        for (band, cell) in medians.iter().enumerate() {
            let (_, sun, observer) = at_phase(1.0);
            let phase = sun.separation(observer);
            let [inner, inner_area, outer, outer_area] = disc_mean(observer, |place| {
                let (cos_i, cos_e) = (place.dot(sun), place.dot(observer));
                let from_centre = (1.0 - cos_e * cos_e).sqrt();
                let light = law.relative(cell, cos_i, cos_e, phase);
                match from_centre {
                    ..=0.333 => [light, 1.0, 0.0, 0.0],
                    ..=0.667 => [0.0; 4],
                    _ => [0.0, 0.0, light, 1.0],
                }
            });
            let ratio = (inner / inner_area) / (outer / outer_area);
            println!("{law:?}, band {band}: inner third over outer {ratio:.4}");
            assert!((0.95..1.05).contains(&ratio), "{law:?}, band {band}: {ratio}");
        }
    }
}

/// The colour map was fitted to the parameters: rms 0.0033, 0.0044 and 0.0057.
#[test]
fn the_parameters_give_the_reflectance_of_the_colour_map() {
    let (map, parameters) = &*MAPS;
    let mut squares = [0.0; 3];
    let mut means = [0.0; 3];
    let rows = 10..80;
    let count = (rows.len() * parameters.width) as f64;
    for row in rows {
        for column in 0..parameters.width {
            let cell = &parameters.cells[row * parameters.width + column];
            let place = |part: usize, cells: usize| (part as f64 + 0.5) / cells as f64;
            let mut reff = [0.0; 3];
            for part in 0..16 {
                let longitude = place(4 * column + part % 4, 4 * parameters.width) * 360.0 - 180.0;
                let latitude = 90.0 - place(4 * row + part / 4, 4 * parameters.height) * 180.0;
                let here = map.reff(Angle::from_deg(longitude), Angle::from_deg(latitude));
                for band in 0..3 {
                    reff[band] += here[2 - band] / 16.0;
                }
            }
            for band in 0..3 {
                let difference = hapke::reff_30_0_30(&cell[band]) - reff[band];
                squares[band] += difference * difference / count;
                means[band] += reff[band] / count;
            }
        }
    }
    for (band, rms) in [0.0033, 0.0044, 0.0057].into_iter().enumerate() {
        let got = squares[band].sqrt();
        println!("{} nm: rms {got:.4} of {:.4}", BANDS_NM[band], means[band]);
        assert!(got < 1.1 * rms, "{} nm: rms {got}", BANDS_NM[band]);
    }
}

//! The light of the Moon's disc as its maps and Hapke's model tell it, against ROLO and against
//! plainer sums.

use std::sync::LazyLock;

use glam::DVec3;
use nocturne::catalog::moon::hapke::BANDS_NM;
use nocturne::catalog::{Catalogs, MoonHapke, MoonMap};
use nocturne::frame::{Dir, MoonFixed};
use nocturne::light::moon::{self, MoonSurface, MoonView, Reflectance, hapke};
use nocturne::light::spectrum::{LEN, Spectrum};
use nocturne::light::sun;
use nocturne::units::{Angle, MOON_RADIUS_KM};

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

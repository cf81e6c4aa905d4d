//! Eight wavelengths against all: X, Y, Z and V of the sky from the spectrum that is rebuilt from eight,
//! and from the same sky solved every 5 nm.
//!
//! Most of what differs is where rays are sampled, which follows the mean of each eight wavelengths; with
//! the steps of pictures it is a third of that.

use nocturne::air::Atmosphere;
use nocturne::air::scattering::{Quality, SKY_NODES_NM, ScatteringTables, reconstruction_matrix};
use nocturne::light::moon::{self, MoonView};
use nocturne::light::spectrum::{FIRST_NM, LEN, STEP_NM, Spectrum, wavelength_nm};
use nocturne::light::sun;
use nocturne::units::{Angle, Xyzv};

/// Largest relative error of a channel that is allowed.
const MOST: f64 = 0.01;
/// Half of all errors lie below.
const MEDIAN: f64 = 0.002;

/// Five airs that differ in everything.
fn airs() -> [(&'static str, Atmosphere); 5] {
    let air = |ozone_du: f64, depth: f64, exponent: f64, albedo: f64| {
        let mut air = Atmosphere::default();
        air.ozone.column_du = ozone_du;
        air.aerosol.optical_depth_550 = depth;
        air.aerosol.angstrom_exponent = Some(exponent);
        air.ground.albedo = albedo;
        air
    };
    [
        ("molecules", air(300.0, 0.0, 1.3, 0.1)),
        ("clear", air(300.0, 0.1, 1.3, 0.1)),
        ("little ozone, haze", air(150.0, 0.3, 1.0, 0.0)),
        ("much ozone, snow", air(450.0, 0.05, 1.5, 0.5)),
        ("dust", air(250.0, 0.2, 0.2, 0.3)),
    ]
}

const SUNS_DEG: [f64; 12] = [70.0, 45.0, 20.0, 8.0, 2.0, 0.0, -2.0, -4.0, -6.0, -9.0, -13.0, -18.0];
const VIEWS_DEG: [(f64, f64); 5] =
    [(90.0, 0.0), (40.0, 90.0), (15.0, 10.0), (4.0, 180.0), (3.0, 30.0)];

#[test]
fn eight_wavelengths_see_the_colours_of_ninety_five() {
    let all: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
    let rebuild = reconstruction_matrix(&SKY_NODES_NM, &all);
    let lamps =
        [sun::irradiance_1au(), moon::irradiance(&MoonView::at_phase(Angle::from_deg(10.0)))];
    let luminance = |shares: &[f64], lamp: &Spectrum| {
        lamp.weighted(|nm| shares[((nm - FIRST_NM) / STEP_NM).round() as usize]).xyzv()
    };
    let mut errors = Vec::new();
    for (name, air) in airs() {
        let few = ScatteringTables::solve(&air, &SKY_NODES_NM, Quality::PREVIEW).unwrap();
        let every = ScatteringTables::solve(&air, &all, Quality::PREVIEW).unwrap();
        let mut worst = 0.0f64;
        for sun_deg in SUNS_DEG {
            for (elevation_deg, azimuth_deg) in VIEWS_DEG {
                let cos_sun = Angle::from_deg(sun_deg).sin();
                let (elevation, azimuth) =
                    (Angle::from_deg(elevation_deg), Angle::from_deg(azimuth_deg));
                let (mut nodes, mut exact) = ([0.0; 8], [0.0; LEN]);
                few.radiance(0.002, cos_sun, elevation, azimuth, &mut nodes);
                every.radiance(0.002, cos_sun, elevation, azimuth, &mut exact);
                let rebuilt = rebuild.spectrum(&nodes);
                for lamp in &lamps {
                    let (got, want) = (luminance(&rebuilt, lamp), luminance(&exact, lamp));
                    let error = largest_error(got, want);
                    assert!(
                        error < MOST,
                        "{name}, sun {sun_deg}, {elevation_deg} {azimuth_deg}: {got:?} {want:?}"
                    );
                    worst = worst.max(error);
                    errors.push(error);
                }
            }
        }
        println!("{name}: at most {:.2} %", 100.0 * worst);
    }
    errors.sort_by(f64::total_cmp);
    let median = errors[errors.len() / 2];
    println!("median of the worst channel {:.3} %", 100.0 * median);
    assert!(median < MEDIAN, "{median}");
}

fn largest_error(got: Xyzv, want: Xyzv) -> f64 {
    let channels = [(got.x, want.x), (got.y, want.y), (got.z, want.z), (got.v, want.v)];
    channels.iter().map(|(got, want)| (got / want - 1.0).abs()).fold(0.0, f64::max)
}

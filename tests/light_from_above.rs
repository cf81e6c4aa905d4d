//! Light that falls on the air from all of the sky: what goes in must come out, and in the right place.

use std::f64::consts::PI;

use nocturne::air::Atmosphere;
use nocturne::air::aerosol::PhaseLaw;
use nocturne::air::scattering::above::{
    DiffuseField, DiffuseQuality, DiffuseTables, DiffuseView, SkyHarmonics, glowing_layer,
};
use nocturne::air::scattering::{Quality, RaySteps, ScatteringTables};
use nocturne::units::Angle;

fn deg(deg: f64) -> Angle {
    Angle::from_deg(deg)
}

/// Air that absorbs nothing over ground that absorbs nothing.
fn white(mut air: Atmosphere) -> Atmosphere {
    air.ozone.column_du = 0.0;
    air.aerosol.single_scattering_albedo = Some(1.0);
    air.ground.albedo = 1.0;
    air
}

fn even(_height_km: f64, _cos_zenith: f64) -> f64 {
    1.0
}

fn radiance(field: &DiffuseField, view: &DiffuseView, azimuth: Angle) -> [f64; 3] {
    let mut out = [0.0; 3];
    field.radiance(view, azimuth, &mut out);
    out
}

fn transmittance(view: &DiffuseView) -> [f64; 3] {
    let mut out = [0.0; 3];
    view.transmittance(&mut out);
    out
}

/// Even light over white ground stays even: the unknowns are moments of the whole radiance, an even
/// one ends with degree 0, and what a step of a ray takes away is what it scatters. So no resolution
/// is asked for, but more directions than degrees, which make moments of an even light exact. What
/// remains is single precision.
#[test]
fn even_light_over_white_ground_is_even() {
    let mut thick = Atmosphere::default();
    thick.aerosol.optical_depth_550 = 1.0;
    for air in [Atmosphere::molecular(), Atmosphere::default(), thick] {
        let air = white(air);
        let tables =
            DiffuseTables::solve(&air, 0.0, &[400.0, 550.0, 700.0], DiffuseQuality::AXIAL).unwrap();
        let field = tables.lit_from(even);
        for irradiance in field.ground_irradiance() {
            assert!((irradiance / PI - 1.0).abs() < 2e-5, "{irradiance}");
        }
        for height_km in [0.0, 0.3, 3.0, 20.0, 100.0] {
            for elevation in (-90..=90).map(|e| deg(0.9999 * f64::from(e) + 0.003)) {
                let view = tables.view(height_km, elevation);
                let direct = transmittance(&view);
                let scattered = radiance(&field, &view, Angle::ZERO);
                for (d, s) in direct.iter().zip(scattered) {
                    let whole = d + s;
                    assert!(
                        (whole - 1.0).abs() < 5e-5,
                        "{height_km} km, {elevation:?}: {direct:?} {scattered:?}"
                    );
                }
            }
        }
    }
}

/// An even sky over the reference air, ground albedo 0.1, seen from the ground: direct and scattered,
/// from an independent program with harmonics to degree 6, its numbers given to 0.001.
#[test]
fn an_even_sky_through_the_reference_air() {
    let elevations = [90.0, 30.0, 10.0, 2.0];
    let expected = [
        [(0.703, 0.190), (0.494, 0.299), (0.137, 0.438), (0.001, 0.405)],
        [(0.798, 0.119), (0.638, 0.197), (0.284, 0.345), (0.009, 0.422)],
        [(0.863, 0.088), (0.745, 0.150), (0.437, 0.287), (0.042, 0.443)],
    ];
    let air = Atmosphere::default().straight();
    let tables =
        DiffuseTables::solve(&air, 0.0, &[450.0, 550.0, 650.0], DiffuseQuality::RENDER).unwrap();
    let field = tables.lit_from(even);
    for (i, elevation) in elevations.into_iter().enumerate() {
        let view = tables.view(0.001, deg(elevation));
        let direct = transmittance(&view);
        let scattered = radiance(&field, &view, Angle::ZERO);
        for (k, row) in expected.iter().enumerate() {
            let (d, s) = row[i];
            assert!((direct[k] - d).abs() < 1e-3, "{elevation}°: {direct:?}, not {d}");
            assert!((scattered[k] / s - 1.0).abs() < 0.01, "{elevation}°: {scattered:?}, not {s}");
        }
    }
}

/// Against many more heights, directions, degrees and steps.
#[test]
fn finer_tables_change_little() {
    let finest = DiffuseQuality {
        degree: 24,
        order: 0,
        altitudes: 80,
        above: 32,
        below: 25,
        steps: RaySteps { levels: 100, longest_km: 15.0, longest_in_aerosol_km: 3.0 },
        view: RaySteps { levels: 150, longest_km: 10.0, longest_in_aerosol_km: 1.0 },
    };
    let mut thick = Atmosphere::default();
    thick.aerosol.optical_depth_550 = 0.5;
    thick.aerosol.phase = PhaseLaw::HenyeyGreenstein { g: 0.8 };
    for (air, render, axial) in [
        (Atmosphere::molecular(), 0.002, 0.004),
        (Atmosphere::default(), 0.005, 0.01),
        (thick, 0.02, 0.03),
    ] {
        let air = air.straight();
        let solve = |quality| {
            let tables = DiffuseTables::solve(&air, 0.0, &[400.0, 550.0, 650.0], quality).unwrap();
            let field = tables.lit_from(glowing_layer(90.0));
            (tables, field)
        };
        let best = solve(finest);
        for (quality, within) in [(DiffuseQuality::RENDER, render), (DiffuseQuality::AXIAL, axial)]
        {
            let field = solve(quality);
            for height_km in [0.0, 3.0, 20.0] {
                for elevation in [90.0, 30.0, 10.0, 2.0, 0.5, -10.0, -50.0] {
                    let at = |(tables, field): &(DiffuseTables, DiffuseField)| {
                        radiance(field, &tables.view(height_km, deg(elevation)), Angle::ZERO)
                    };
                    for (got, want) in at(&field).into_iter().zip(at(&best)) {
                        let error = got / want - 1.0;
                        assert!(error.abs() < within, "{height_km} km, {elevation}°: {error}");
                    }
                }
            }
        }
    }
}

/// A sky is made of suns: the tables of a parallel beam, summed over all directions that it can come
/// from, must give what the field of the sky gives. Two solvers that share nothing but the cutting
/// of rays; and the sum knows that the zenith is another elsewhere, which the field leaves out.
#[test]
fn a_sky_is_the_sum_of_its_suns() {
    let air = Atmosphere::default().straight();
    let wavelengths = [450.0, 550.0, 650.0];
    let suns = ScatteringTables::solve(&air, &wavelengths, Quality::RENDER).unwrap();
    let tables = DiffuseTables::solve(&air, 0.0, &wavelengths, DiffuseQuality::RENDER).unwrap();
    let skies: [fn(Angle, Angle) -> f64; 3] = [
        |_, _| 1.0,
        // Bright on one side of the horizon.
        |e, a| 1.0 + 0.9 * e.cos() * a.sin(),
        // A band across the sky.
        |e, a| 0.3 + (1.0 - (e.cos() * a.cos()).powi(2)).powi(3),
    ];
    let fields = skies.map(|sky| tables.lit_by(&SkyHarmonics::from_fn(sky)));
    let view_azimuth = deg(40.0);
    const AZIMUTHS: usize = 16;
    for (height_km, elevation) in [(0.0, 90.0), (0.0, 5.0), (3.0, 10.0), (3.0, -10.0)] {
        let view = tables.view(height_km, deg(elevation));
        let mut sums = [[0.0; 3]; 3];
        let ratio: f64 = 6371.0 / (6371.0 + height_km);
        let horizon = -(1.0 - ratio * ratio).sqrt();
        // Suns above the horizon, and below it to where the air is dark; dense next to it.
        for (span, n) in [(1.0 - horizon, 128), (-0.33 - horizon, 32)] {
            for i in 0..n {
                let t = (i as f64 + 0.5) / n as f64;
                let cos_zenith = horizon + span * t * t;
                let width = span.abs() * 2.0 * t / n as f64;
                let sun = Angle::from_rad(cos_zenith.asin());
                for k in 0..AZIMUTHS {
                    let azimuth = Angle::from_rad(PI * (k as f64 + 0.5) / AZIMUTHS as f64);
                    let mut out = [0.0; 3];
                    suns.radiance(height_km, cos_zenith, deg(elevation), azimuth, &mut out);
                    for (sky, sums) in skies.iter().zip(&mut sums) {
                        let (a, b) = (
                            view_azimuth.rad() + azimuth.rad(),
                            view_azimuth.rad() - azimuth.rad(),
                        );
                        let seen = sky(sun, Angle::from_rad(a)) + sky(sun, Angle::from_rad(b));
                        for (sum, value) in sums.iter_mut().zip(out) {
                            *sum += value * seen * width * PI / AZIMUTHS as f64;
                        }
                    }
                }
            }
        }
        for ((field, sums), within) in fields.iter().zip(sums).zip([0.006, 0.01, 0.006]) {
            for (got, want) in radiance(field, &view, view_azimuth).into_iter().zip(sums) {
                let error = got / want - 1.0;
                assert!(error.abs() < within, "{height_km} km, {elevation}°: {got} {want}");
            }
        }
    }
}

#[test]
fn harmonics_and_functions_agree_and_turn_with_the_sky() {
    let air = Atmosphere::default().straight();
    let tables =
        DiffuseTables::solve(&air, 0.0, &[450.0, 550.0, 650.0], DiffuseQuality::RENDER).unwrap();
    let by_function = tables.lit_from(|_, cos_zenith| 1.0 + 0.5 * cos_zenith);
    let by_harmonics =
        tables.lit_by(&SkyHarmonics::from_elevation(|elevation| 1.0 + 0.5 * elevation.sin()));
    // The same shape twice, turned by 70 degrees.
    let shape =
        |e: Angle, a: f64| 1.0 + e.cos() * a.cos() + 0.5 * e.cos().powi(3) * (3.0 * a).sin();
    let north = tables.lit_by(&SkyHarmonics::from_fn(|e, a| shape(e, a.rad())));
    let turned = tables.lit_by(&SkyHarmonics::from_fn(|e, a| shape(e, a.rad() - deg(70.0).rad())));
    for (e, a) in [(90.0, 0.0), (20.0, 33.0), (1.0, 190.0), (-30.0, 300.0)] {
        let view = tables.view(0.5, deg(e));
        let [f, h, n, t] = [
            radiance(&by_function, &view, deg(a)),
            radiance(&by_harmonics, &view, deg(a)),
            radiance(&north, &view, deg(a)),
            radiance(&turned, &view, deg(a + 70.0)),
        ];
        for i in 0..3 {
            assert!((f[i] / h[i] - 1.0).abs() < 1e-5, "{e}° {a}°: {f:?} {h:?}");
            assert!((n[i] / t[i] - 1.0).abs() < 1e-4, "{e}° {a}°: {n:?} {t:?}");
        }
    }
}

#[test]
fn impossible_questions_are_refused() {
    let air = Atmosphere::default();
    let solve = |wavelengths: &[f64], quality| {
        DiffuseTables::solve(&air, 0.0, wavelengths, quality).map(|_| ()).unwrap_err().to_string()
    };
    assert!(solve(&[], DiffuseQuality::AXIAL).contains("no wavelengths"));
    assert!(solve(&[300.0], DiffuseQuality::AXIAL).contains("300 nm"));
    let order = DiffuseQuality { order: 9, ..DiffuseQuality::AXIAL };
    assert!(solve(&[550.0], order).contains("order of a sky"));
    let directions = DiffuseQuality { below: 8, ..DiffuseQuality::AXIAL };
    assert!(solve(&[550.0], directions).contains("more directions"));
    let degree = DiffuseQuality { degree: 1, ..DiffuseQuality::AXIAL };
    assert!(solve(&[550.0], degree).contains("degree"));
    let mut strange = air.clone();
    strange.ground.albedo = 2.0;
    assert!(DiffuseTables::solve(&strange, 0.0, &[550.0], DiffuseQuality::AXIAL).is_err());
}

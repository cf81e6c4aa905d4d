//! The phase functions: integrals, moments, limits. None is taken at its word.

use std::f64::consts::PI;

use nocturne::air::aerosol::{Aerosol, MieKind};
use nocturne::air::phase::{
    PhaseFunction, Tabulated, TabulatedError, king_factor, rayleigh, rayleigh_depolarised,
};

/// Twice pi times the integral of `f(nu) P_l(nu)` over `nu`, by Simpson's rule in the angle, finer
/// where light goes straight on: another quadrature than that of the library.
fn moment(f: impl Fn(f64) -> f64, l: usize) -> f64 {
    const STEPS: usize = 200_000;
    let at = |i: usize| {
        let t = i as f64 / STEPS as f64;
        let (angle, slope) = (PI * t * t, 2.0 * PI * t);
        let nu = angle.cos();
        let (mut p, mut q) = (1.0, nu);
        for k in 1..=l {
            (p, q) = (q, ((2 * k + 1) as f64 * nu * q - k as f64 * p) / (k + 1) as f64);
        }
        f(nu) * p * angle.sin() * slope
    };
    let inner: f64 = (1..STEPS).map(|i| at(i) * if i % 2 == 1 { 4.0 } else { 2.0 }).sum();
    2.0 * PI * (at(0) + inner + at(STEPS)) / (3.0 * STEPS as f64)
}

fn tabulated() -> PhaseFunction {
    let degrees = vec![0.0, 1.0, 5.0, 20.0, 60.0, 120.0, 170.0, 180.0];
    let values = vec![900.0, 500.0, 100.0, 12.0, 1.5, 0.6, 0.9, 1.4];
    PhaseFunction::Tabulated(Tabulated::new(degrees, values).unwrap())
}

fn all() -> Vec<PhaseFunction> {
    let mut all = vec![
        PhaseFunction::Isotropic,
        PhaseFunction::Rayleigh { depolarisation: 0.0 },
        PhaseFunction::Rayleigh { depolarisation: 0.0279 },
        PhaseFunction::DoubleHenyeyGreenstein {
            forward_g: 0.8,
            backward_g: -0.5,
            forward_share: 0.9,
        },
        tabulated(),
    ];
    for g in [-0.9, -0.3, 0.0, 5e-4, 0.2, 0.7, 0.9] {
        all.push(PhaseFunction::HenyeyGreenstein { g });
        all.push(PhaseFunction::Schlick { k: g });
        all.push(PhaseFunction::CornetteShanks { g });
    }
    all
}

#[test]
fn all_are_one_over_the_sphere_and_have_the_moments_they_tell() {
    for phase in all() {
        for l in [0, 1, 2, 3, 5, 8, 20] {
            let (got, want) = (phase.moment(l), moment(|nu| phase.value(nu), l));
            assert!((got - want).abs() < 1e-6, "{phase:?}, {l}: {got}, not {want}");
        }
        assert_eq!(phase.mean_cosine(), phase.moment(1));
    }
}

#[test]
fn none_is_negative() {
    for phase in all() {
        for i in 0..=2000 {
            let nu = f64::from(i) / 1000.0 - 1.0;
            let value = phase.value(nu);
            assert!(value > 0.0 && value.is_finite(), "{phase:?} at {nu}: {value}");
        }
    }
}

#[test]
fn they_meet_in_their_limits() {
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
    for i in 0..=20 {
        let nu = f64::from(i) / 10.0 - 1.0;
        let even = 1.0 / (4.0 * PI);
        assert!(near(PhaseFunction::HenyeyGreenstein { g: 0.0 }.value(nu), even));
        assert!(near(PhaseFunction::Schlick { k: 0.0 }.value(nu), even));
        assert!(near(PhaseFunction::CornetteShanks { g: 0.0 }.value(nu), rayleigh(nu)));
        assert!(near(rayleigh_depolarised(0.0, nu), rayleigh(nu)));
        let double = PhaseFunction::DoubleHenyeyGreenstein {
            forward_g: 0.6,
            backward_g: -0.6,
            forward_share: 0.5,
        };
        assert!(near(double.value(nu), double.value(-nu)));
        let one = PhaseFunction::HenyeyGreenstein { g: 0.6 };
        let turned = PhaseFunction::HenyeyGreenstein { g: -0.6 };
        assert!(near(one.value(nu), turned.value(-nu)));
    }
}

#[test]
fn published_numbers_come_back() {
    // Cornette & Shanks 1992: the mean cosine is 3 g (4 + g^2) / (5 (2 + g^2)).
    let g: f64 = 0.75;
    let want = 3.0 * g * (4.0 + g * g) / (5.0 * (2.0 + g * g));
    assert!((PhaseFunction::CornetteShanks { g }.mean_cosine() - want).abs() < 1e-14);
    // Air: King factor 1.049 at 0.0279 (Young 1980).
    assert!((king_factor(0.0279) - 1.0480).abs() < 2e-3);
    // Depolarisation is the ratio of the two intensities at a right angle: 1 + 3 gamma of 1 + 2 gamma.
    let gamma = 0.0279 / (2.0 - 0.0279);
    let want = 3.0 / (16.0 * PI) * (1.0 + 3.0 * gamma) / (1.0 + 2.0 * gamma);
    assert!((rayleigh_depolarised(0.0279, 0.0) - want).abs() < 1e-15);
}

#[test]
fn a_table_of_a_law_is_the_law() {
    let law = PhaseFunction::HenyeyGreenstein { g: 0.7 };
    let degrees: Vec<f64> = (0..=360).map(|i| f64::from(i) / 2.0).collect();
    // Any unit will do.
    let values = degrees.iter().map(|d| 1e200 * law.value(d.to_radians().cos())).collect();
    let table = Tabulated::new(degrees, values).unwrap();
    for i in 0..=1000 {
        let nu = f64::from(i) / 500.0 - 1.0;
        assert!((table.value(nu) / law.value(nu) - 1.0).abs() < 2e-4, "{nu}");
    }
    for l in 0..=30 {
        assert!((table.moment(l) - law.moment(l)).abs() < 1e-4, "{l}");
    }
}

#[test]
fn tables_that_are_none_are_refused_with_the_reason() {
    let error = |degrees: &[f64], values: &[f64]| {
        Tabulated::new(degrees.to_vec(), values.to_vec()).unwrap_err()
    };
    let lengths = TabulatedError::Lengths { degrees: 2, values: 3 };
    assert_eq!(error(&[0.0, 180.0], &[1.0, 2.0, 3.0]), lengths);
    assert_eq!(error(&[0.0, 170.0], &[1.0, 2.0]), TabulatedError::Ends);
    assert_eq!(error(&[], &[]), TabulatedError::Ends);
    assert_eq!(error(&[0.0, 90.0, 90.0, 180.0], &[1.0; 4]), TabulatedError::Order(90.0));
    let wrong = TabulatedError::Value { degrees: 180.0, value: -1.0 };
    assert_eq!(error(&[0.0, 180.0], &[1.0, -1.0]), wrong);
    for bad in [f64::NAN, f64::INFINITY, 0.0] {
        assert!(matches!(error(&[0.0, 180.0], &[1.0, bad]), TabulatedError::Value { .. }));
        let degrees = [0.0, if bad == 0.0 { -1.0 } else { bad }, 180.0];
        assert!(matches!(error(&degrees, &[1.0; 3]), TabulatedError::Order(_)), "{bad}");
    }
}

#[test]
fn shipped_kinds_scatter_as_their_sources_say() {
    // Exponent between 450 and 650 nm, albedo and mean cosine at 550 nm: OPAC, table 4, as far as
    // remembered (`clear`, `continental`, `maritime` at 80 % humidity).
    for (kind, exponent, albedo, cosine) in [
        (MieKind::Clear, 1.30, 0.972, 0.709),
        (MieKind::Continental, 1.30, 0.925, 0.703),
        (MieKind::Maritime, 0.10, 0.997, 0.772),
        (MieKind::Desert, 0.15, 0.885, 0.729),
        (MieKind::Volcanic, 0.52, 1.0, 0.748),
    ] {
        let aerosol = Aerosol::mie(kind, 1.0);
        assert!((aerosol.optical_depth(550.0) - 1.0).abs() < 1e-4, "{kind:?}");
        let ratio = aerosol.optical_depth(450.0) / aerosol.optical_depth(650.0);
        let slope = ratio.ln() / (650.0f64 / 450.0).ln();
        assert!((slope - exponent).abs() < 0.06, "{kind:?}: exponent {slope}");
        assert!((aerosol.albedo(550.0) - albedo).abs() < 0.005, "{kind:?}");
        let mean = aerosol.moment(550.0, 1);
        assert!((mean - cosine).abs() < 0.005, "{kind:?}: mean cosine {mean}");
        for nm in [360.0, 487.0, 550.0, 830.0] {
            for l in [0, 1, 8] {
                let want = moment(|nu| aerosol.phase(nm, nu), l);
                let got = aerosol.moment(nm, l);
                assert!((got - want).abs() < 1e-6, "{kind:?} at {nm} nm, {l}: {got}, not {want}");
            }
        }
        // What the file leaves open is the kind's; what it says is the file's.
        let told = Aerosol {
            angstrom_exponent: Some(2.0),
            single_scattering_albedo: Some(0.5),
            ..aerosol.clone()
        };
        assert!((told.optical_depth(1100.0) - 0.25).abs() < 1e-12);
        assert_eq!(told.albedo(400.0), 0.5);
    }
}

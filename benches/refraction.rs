//! What refraction costs: building the traced form, and one altitude by each form.
//!
//! `cargo bench --bench refraction --no-default-features`. Times are the least of
//! many runs, which other work on the machine disturbs least; ratios are to one evaluation of Bennett's
//! formula, so that machines compare.

use std::hint::black_box;
use std::time::Instant as Clock;

use nocturne::air::refraction::{ObserverAir, Refraction};
use nocturne::units::Angle;

/// Repetitions of which the quickest counts.
const REPETITIONS: usize = 101;

fn main() {
    let air = ObserverAir {
        height_m: 2635.0,
        pressure_mbar: 743.0,
        temperature_c: 12.0,
        relative_humidity: 0.1,
        wavelength_nm: 550.0,
    };
    let formula = Refraction::new(air.pressure_mbar, air.temperature_c);
    let traced = Refraction::traced(&air).expect("air that can be");
    let above: Vec<f64> = (0..1000).map(|n| 0.09 * f64::from(n)).collect();
    let below: Vec<f64> = (0..1000).map(|n| -5.0 - 0.08 * f64::from(n)).collect();
    let each = |altitudes: &[f64], call: &dyn Fn(Angle) -> Angle| {
        let all = || altitudes.iter().map(|deg| call(black_box(Angle::from_deg(*deg))).rad()).sum();
        least_ns(all) / altitudes.len() as f64
    };
    let baseline_ns = each(&above, &|altitude| formula.at_apparent_altitude(altitude));
    println!("                                                        ns    ratio");
    let line = |what: &str, ns: f64| println!("{what:48} {ns:11.1} {:8.1}", ns / baseline_ns);
    for (name, refraction) in [("Bennett", &formula), ("traced", &traced)] {
        for (where_, altitudes) in [("above", &above), ("below", &below)] {
            line(
                &format!("{name}, true from apparent, {where_} the horizon"),
                each(altitudes, &|altitude| refraction.true_from_apparent(altitude)),
            );
            line(
                &format!("{name}, apparent from true, {where_} the horizon"),
                each(altitudes, &|altitude| refraction.apparent_from_true(altitude)),
            );
        }
    }
    let build = || {
        let traced = Refraction::traced(black_box(&air)).expect("air that can be");
        traced.at_apparent_altitude(Angle::ZERO).rad()
    };
    line("traced, made", least_ns(build));
}

/// The quickest of the repetitions, after one to warm up.
fn least_ns(run: impl Fn() -> f64) -> f64 {
    black_box(run());
    let time = || {
        let start = Clock::now();
        black_box(run());
        start.elapsed().as_secs_f64() * 1e9
    };
    (0..REPETITIONS).map(|_| time()).fold(f64::INFINITY, f64::min)
}

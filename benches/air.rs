//! What the air costs beside how far it is off, by tier.
//!
//! `cargo bench --bench air`. Times are the least of several runs, milliseconds, on all cores; ratios are
//! to the quick tier of the same air in the same run. Errors are those of `tests/truth`, a Monte Carlo of
//! straight rays and parallel light whose own noise is in them (median 0.1 to 2 %, most 8 %); times are
//! those of bent rays and discs.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant as Clock;

use nocturne::air::Atmosphere;
use nocturne::air::scattering::{Quality, SKY_NODES_NM, ScatteringTables};
use nocturne::background::Interrupt;
use nocturne::frame::Dir;
use nocturne::light::sun;
use nocturne::plan::skylight::SolvedAir;
use nocturne::store::Store;
use nocturne::units::Angle;

const TIERS: [(&str, Quality); 2] = [("preview", Quality::PREVIEW), ("render", Quality::RENDER)];
const RUNS: usize = 5;
const TRUTH: &str = include_str!("../tests/truth/sky_radiance_mc.csv");
const TRUTH_NM: [f64; 3] = [450.0, 550.0, 650.0];
const SUNS_DEG: [i64; 8] = [45, 10, 2, 0, -3, -6, -9, -12];

fn main() -> Result<(), Box<dyn Error>> {
    let airs =
        [("molecules", "A_", Atmosphere::molecular()), ("with haze", "B_", Atmosphere::default())];
    println!("{:<11}{:<9}{:>10}{:>7}{:>12}", "air", "tier", "solve, ms", "ratio", "stored, ms");
    for (name, _, air) in &airs {
        let mut quick_ms = f64::NAN;
        for (tier, quality) in TIERS {
            let folder = tempfile::tempdir()?;
            let (store, never) = (Store::in_folder(folder.path(), 1 << 30), Interrupt::default());
            let get = |store: &Store| {
                ScatteringTables::stored(air, 0.0, &SKY_NODES_NM, quality, store, &never)
            };
            let solve_ms = least_ms(|| get(&Store::NONE));
            get(&store)?;
            let stored_ms = least_ms(|| get(&store));
            quick_ms = if quick_ms.is_nan() { solve_ms } else { quick_ms };
            let ratio = solve_ms / quick_ms;
            println!("{name:<11}{tier:<9}{solve_ms:>10.0}{ratio:>7.2}{stored_ms:>12.1}");
        }
    }

    println!("\nMoving the Sun in solved air, ms");
    for (name, _, air) in &airs {
        let solved = SolvedAir::solve(air, 0.0)?;
        let lamp = sun::irradiance_1au();
        for sun_deg in [40.0, 3.0, -6.0] {
            let sun = Dir::from_azimuth_altitude(Angle::ZERO, Angle::from_deg(sun_deg));
            let ms = least_ms(|| solved.sky(black_box(sun), &lamp));
            println!("{name:<11}Sun at {sun_deg:>3}°{ms:>8.2}");
        }
    }

    println!("\nError of radiance, %: median / most, by altitude of the Sun");
    print!("{:<20}", "");
    SUNS_DEG.iter().for_each(|sun| print!("{:>12}", format!("{sun}°")));
    println!();
    for (name, case, air) in airs {
        for (tier, quality) in TIERS {
            let air = air.clone().straight();
            let tables = ScatteringTables::solve(&air, &TRUTH_NM, quality)?;
            print!("{name:<11}{tier:<9}");
            for sun_deg in SUNS_DEG {
                let (median, most) = errors(&tables, case, sun_deg);
                print!("{:>12}", format!("{median:.2} / {most:.1}"));
            }
            println!();
        }
    }
    Ok(())
}

/// Median and greatest error against the truth under one Sun, per cent.
fn errors(tables: &ScatteringTables, case: &str, sun_deg: i64) -> (f64, f64) {
    let mut errors = Vec::new();
    for line in TRUTH.lines().filter(|line| line.starts_with(case)) {
        let row: Vec<f64> = line.split(',').skip(1).filter_map(|cell| cell.parse().ok()).collect();
        let [nm, sun, elevation, azimuth, _, _, truth, ..] = row[..] else { continue };
        if sun as i64 != sun_deg {
            continue;
        }
        let mut radiance = [0.0; 3];
        let (elevation, azimuth) = (Angle::from_deg(elevation), Angle::from_deg(azimuth));
        tables.radiance(0.001, Angle::from_deg(sun).sin(), elevation, azimuth, &mut radiance);
        let lane = TRUTH_NM.iter().position(|truth_nm| *truth_nm == nm).unwrap_or(0);
        errors.push(100.0 * (radiance[lane] / truth - 1.0).abs());
    }
    errors.sort_by(f64::total_cmp);
    (errors[errors.len() / 2], errors[errors.len() - 1])
}

/// Least time of some runs.
fn least_ms<T>(mut work: impl FnMut() -> T) -> f64 {
    let times = (0..RUNS).map(|_| {
        let start = Clock::now();
        black_box(work());
        start.elapsed().as_secs_f64() * 1000.0
    });
    times.fold(f64::MAX, f64::min)
}

//! What the air costs, by tier: solving it, moving the Sun in it.
//!
//! `cargo bench --bench air`. Times are the least of several runs, milliseconds, on all cores; ratios
//! are to the quick tier of the same air in the same run.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant as Clock;

use nocturne::air::Atmosphere;
use nocturne::air::scattering::{Quality, SKY_NODES_NM, ScatteringTables, SkyView};

const TIERS: [(&str, Quality); 2] = [("preview", Quality::PREVIEW), ("render", Quality::RENDER)];
const RUNS: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let airs = [("molecules", Atmosphere::molecular()), ("with haze", Atmosphere::default())];
    println!(
        "{:<12}{:<10}{:>12}{:>8}{:>12}{:>16}",
        "air", "tier", "solve, ms", "ratio", "rays, ms", "sky view, ms"
    );
    for (name, air) in &airs {
        let mut quick_ms = f64::NAN;
        for (tier, quality) in TIERS {
            let tables = ScatteringTables::solve(air, &SKY_NODES_NM, quality)?;
            let solve_ms = least_ms(|| ScatteringTables::solve(air, &SKY_NODES_NM, quality));
            let elevation = |i: usize| SkyView::elevation_of(i as f64 / 63.0);
            let elevations: Vec<_> = (0..64).map(elevation).collect();
            let rays_ms = least_ms(|| tables.view_rays(0.002, &elevations));
            let view_ms = least_ms(|| tables.sky_view(0.002, black_box(0.1), 49, 64));
            quick_ms = if quick_ms.is_nan() { solve_ms } else { quick_ms };
            let ratio = solve_ms / quick_ms;
            println!(
                "{name:<12}{tier:<10}{solve_ms:>12.1}{ratio:>8.2}{rays_ms:>12.2}{view_ms:>16.2}"
            );
        }
    }
    Ok(())
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

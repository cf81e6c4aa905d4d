//! What the axes of the Moon and its physical ephemeris cost.
//!
//! `cargo bench --bench moon --no-default-features`. Times are the least of many runs, which other work
//! on the machine disturbs least; ratios are to the axes by the table, so that machines compare.

use std::hint::black_box;
use std::time::Instant as Clock;

use glam::DVec3;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::moon_orientation::{MoonOrientation, MoonPhysical};
use nocturne::ephemeris::orientation::Orientation;
use nocturne::frame::Pos;
use nocturne::time::{Instant, JulianDate, Tdb};

/// Repetitions of which the quickest counts.
const REPETITIONS: usize = 101;
const DATES: usize = 1000;

fn main() {
    let catalogs = Catalogs::locate(None).expect("the catalogues of the source tree");
    let load = || MoonOrientation::load(&catalogs).expect("the table of the source tree");
    let dates: Vec<JulianDate<Tdb>> =
        (0..DATES).map(|n| JulianDate::from_jd(2_433_000.5 + 31.7 * n as f64)).collect();
    let axes = |orientation: &MoonOrientation| {
        let x = |date: &JulianDate<Tdb>| {
            orientation.moon_fixed_from_icrs(black_box(*date)).matrix().x_axis.x
        };
        dates.iter().map(x).sum::<f64>()
    };

    let first_ns = (0..REPETITIONS).map(|_| time_ns(&load(), axes)).fold(f64::INFINITY, f64::min);
    let (table, series) = (load(), MoonOrientation::series());
    let table_ns = least_ns(&table, axes);
    println!("                                                        ns    ratio");
    let line = |what: &str, ns: f64| {
        let ns = ns / DATES as f64;
        println!("{what:48} {ns:11.1} {:8.1}", ns / (table_ns / DATES as f64));
    };
    line("axes by table", table_ns);
    line("axes by table, first touch of a segment", first_ns);
    line("axes by series", least_ns(&series, axes));

    let now = JulianDate::from_jd(2_460_000.5);
    let instant = Instant::from_tt_ut1(now, now.read_on(-69.0)).expect("a date within range");
    let true_from_icrs = Orientation::at(&instant).true_from_icrs();
    let moon_fixed_from_icrs = table.moon_fixed_from_icrs(instant.tdb);
    let moon = DVec3::new(-166_076.0, -325_870.0, -107_116.0);
    let physical = |places: &Vec<DVec3>| {
        let libration = |place: &DVec3| {
            let from_earth = Pos::from_km(black_box(*place));
            let from_observer = from_earth - Pos::from_km(DVec3::new(-717.0, 4991.0, -3893.0));
            let from_sun = from_earth + Pos::from_km(DVec3::new(-6e6, -1.39e8, -6e7));
            MoonPhysical::of(
                moon_fixed_from_icrs,
                true_from_icrs,
                from_earth,
                from_observer,
                from_sun,
            )
        };
        places.iter().map(|place| black_box(libration(place)).phase.illuminated_fraction).sum()
    };
    let places: Vec<DVec3> = (0..DATES).map(|n| moon + DVec3::splat(n as f64)).collect();
    line("physical ephemeris, axes given", least_ns(&places, physical));
}

fn time_ns<I>(input: &I, run: impl Fn(&I) -> f64) -> f64 {
    let start = Clock::now();
    black_box(run(black_box(input)));
    start.elapsed().as_secs_f64() * 1e9
}

/// The quickest of the repetitions, after one to warm up.
fn least_ns<I>(input: &I, run: impl Fn(&I) -> f64) -> f64 {
    time_ns(input, &run);
    (0..REPETITIONS).map(|_| time_ns(input, &run)).fold(f64::INFINITY, f64::min)
}

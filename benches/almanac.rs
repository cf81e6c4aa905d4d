//! What a year of events costs, class by class, on one core.
//!
//! Milliseconds, the same relative to the phases, and how many events there are.

use std::time::Instant as Clock;

use nocturne::almanac::{Almanac, Class, Request};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::Ephemeris;
use nocturne::place::Place;
use nocturne::time::{parse, to_instant};

/// Repetitions, of which the fastest counts.
const REPETITIONS: usize = 5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // One core, so that the numbers do not depend on how many there are.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let request = Request::default();
    let ephemeris = Ephemeris::load(&Catalogs::locate(None)?, request.tolerance)?;
    let place = Place::new(35.198, -111.651, 2106.0)?;
    let [from, to] = ["2026-01-01", "2027-01-01"]
        .map(|text| parse(text).and_then(|written| to_instant(&written, None)));
    let (from, to) = (from?, to?);

    let year = |classes: Vec<Class>| -> Result<(f64, usize), Box<dyn std::error::Error>> {
        let request = Request { classes, ..Request::default() };
        let almanac = Almanac::new(&ephemeris, Some(&place), request)?;
        let mut best = (f64::INFINITY, 0);
        for _ in 0..REPETITIONS {
            let started = Clock::now();
            let mut count = 0;
            for event in almanac.events(&from, &to)? {
                event?;
                count += 1;
            }
            best = (best.0.min(started.elapsed().as_secs_f64() * 1e3), count);
        }
        Ok(best)
    };
    let (unit_ms, _) = year(vec![Class::Phase])?;
    println!("{:24} {:>9} {:>7} {:>7}", "a year of", "ms", "ratio", "events");
    for class in Class::ALL {
        let (ms, count) = year(vec![class])?;
        println!("{:24} {ms:9.2} {:7.2} {count:7}", class.name(), ms / unit_ms);
    }
    let (ms, count) = year(Request::default().classes)?;
    println!("{:24} {ms:9.2} {:7.2} {count:7}", "all that is usual", ms / unit_ms);
    Ok(())
}

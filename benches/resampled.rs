//! What a value of a resampled table costs: folded, unfolded, and on the first touch.
//!
//! `cargo bench --bench resampled --no-default-features`. Every channel of `de440.bin` at full depth.
//! Times are medians of nanoseconds; "in order" steps through ten years by half an hour, "anywhere"
//! jumps over the whole span, where the memory is slower than the sums. The ratio is to the Sun in
//! order in the same run, so that runs on different machines compare.

use std::hint::black_box;
use std::time::Instant as Clock;

use nocturne::catalog::Catalogs;
use nocturne::ephemeris::resampled::{Channel, Depth, Table};
use nocturne::time::{JulianDate, Tdb};

const FILE: &str = "de440.bin";
const CALLS: u32 = 4096;
const REPETITIONS: usize = 201;

fn main() {
    let table = |depth: Depth| -> Table {
        let layers = Catalogs::locate(None).and_then(|found| found.layers(FILE, depth.layers()));
        match layers.map_err(|error| error.to_string()).and_then(Table::open) {
            Ok(table) => table,
            Err(what) => panic!("{FILE}: {what}"),
        }
    };
    println!("Reading {FILE}                     ms    bytes");
    for depth in Depth::ALL {
        let start = Clock::now();
        let table = table(depth);
        let ms = start.elapsed().as_secs_f64() * 1e3;
        let bytes: usize =
            table.channels().map(|c| c.bytes()[..depth.layers()].iter().sum::<usize>()).sum();
        println!("{:28} {ms:8.2} {bytes:8}", format!("to a {depth:?}"));
    }

    let table = table(Depth::Thousandth);
    println!("\nchannel       value, in order   ratio  anywhere  and rate  unfolded  first touch");
    let mut baseline = None;
    for channel in table.channels() {
        let depth = Depth::Thousandth;
        let (first, last) = channel.span();
        // Each segment once, in an order that jumps.
        let segments = channel.recipe().segments;
        let start = Clock::now();
        for index in 0..segments {
            black_box(channel.value(anywhere(channel, index), depth));
        }
        let touch = start.elapsed().as_secs_f64() * 1e9 / f64::from(segments);
        // Now the rest of them.
        for index in 0..8 * segments {
            black_box(channel.value(anywhere(channel, index), depth));
        }
        let middle = first.plus_days(0.5 * (last - first));
        let ordered = |index: u32| middle.plus_days(f64::from(index) / 48.0);
        let anywhere = |index: u32| anywhere(channel, index);
        let value = |tdb| channel.value(tdb, depth);
        let in_order = median_ns(ordered, value);
        let baseline = *baseline.get_or_insert(in_order);
        println!(
            "{:14} {in_order:14.1} {:7.2} {:9.1} {:9.1} {:9.0} {touch:12.0}",
            channel.id(),
            in_order / baseline,
            median_ns(anywhere, value),
            median_ns(ordered, |tdb| channel.value_and_rate(tdb, depth)),
            median_ns(ordered, |tdb| channel.unfolded_value(tdb, depth)),
        );
    }
}

/// Dates spread over the span by the golden ratio.
fn anywhere(channel: &Channel, index: u32) -> JulianDate<Tdb> {
    let (first, last) = channel.span();
    let part = (f64::from(index) * 0.618_033_988_749_894_9 + 0.3).fract();
    first.plus_days(part * (last - first))
}

/// Median over repetitions of the mean over the calls; the dates are made beforehand.
fn median_ns<T>(date: impl Fn(u32) -> JulianDate<Tdb>, call: impl Fn(JulianDate<Tdb>) -> T) -> f64 {
    let dates: Vec<_> = (0..CALLS).map(date).collect();
    let mut times: Vec<f64> = (0..REPETITIONS)
        .map(|_| {
            let start = Clock::now();
            for &tdb in &dates {
                black_box(call(black_box(tdb)));
            }
            start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[REPETITIONS / 2]
}

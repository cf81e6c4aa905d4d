//! How good each theory is and what it costs: errors against DE440 beside nanoseconds.
//!
//! `cargo bench --bench positions --no-default-features`. Errors are the largest of the topocentric
//! places in `tests/truth/ephemeris_de440.csv`, 1550 to 2650, and the largest part that they take of
//! the bound that the theory states for their dates. Times are medians; ratios are to the Sun of the
//! paper in the same run, so that runs on different machines compare.

use std::hint::black_box;
use std::time::Instant as Clock;

use nocturne::catalog::Catalogs;
use nocturne::ephemeris::apparent::{ApparentPlace, Observer};
use nocturne::ephemeris::stars::{SpaceMotion, StarReduction};
use nocturne::ephemeris::{Body, EarthState, Ephemeris, Tier};
use nocturne::frame::{Dir, TrueOfDate};
use nocturne::place::Place;
use nocturne::sky::SkyState;
use nocturne::time::{Instant, JulianDate};
use nocturne::units::Angle;

const DE440: &str = include_str!("../tests/truth/ephemeris_de440.csv");
/// Repetitions whose median is taken.
const REPETITIONS: usize = 501;
/// Calls in each: too short together to be interrupted often, long enough for the clock.
const CALLS: usize = 16;
const COARSE: Angle = Angle::from_deg(1.0);
const BEST: Angle = Angle::from_arcsec(0.1);

/// A body seen from a place at an instant, and where DE440 has it.
struct Row {
    body: Body,
    instant: Instant,
    place: Place,
    truth: Dir<TrueOfDate>,
}

fn main() {
    let rows = rows();
    let baseline_ns = costs(&rows, Body::Sun, Tier::Paper).0;
    println!("One apparent place: alone, with the theory of the Earth; and where others share it");
    println!("body     tier    error, arcsec  of bound  alone, ns   ratio  sharing, ns  places");
    for tier in Tier::ALL {
        for body in Body::ALL.into_iter().filter(|&body| tier.knows(body)) {
            let (error, part, places) = worst(&rows, body, tier);
            let (alone_ns, sharing_ns) = costs(&rows, body, tier);
            let ratio = alone_ns / baseline_ns;
            println!(
                "{:8} {:7} {error:13.2} {:8.0}% {alone_ns:10.0} {ratio:7.2} {sharing_ns:12.0} {places:7}",
                body.to_string(),
                tier.to_string(),
                part * 100.0,
            );
        }
    }

    let line = |what: &str, ns: f64| {
        println!("{what:42} {ns:10.0} {:7.2}", ns / baseline_ns);
    };
    println!("\nWhat all share, and the whole                      ns   ratio");
    line("observer: precession, nutation, rotation", each(&rows, observer));
    for tier in Tier::ALL {
        let name = format!("Earth, position and velocity, {tier}");
        line(&name, each(&rows, |row| earth_of(row, tier)));
    }
    for (name, tolerance) in [("to 1 degree", COARSE), ("the best there is", BEST)] {
        line(&format!("SkyState::at, {name}"), each(&rows, |row| sky(row, tolerance)));
    }
    match Catalogs::locate(None).and_then(|catalogs| catalogs.stars()) {
        Ok(stars) => {
            let sky = sky(&rows[0], BEST);
            let ns = median_ns(1, || drop(black_box(sky.stars(black_box(&stars)))));
            line(&format!("SkyState::stars, each of {}", stars.len()), ns / stars.len() as f64);
            let row = &rows[0];
            let reduction = StarReduction::new(&observer(row), &earth_of(row, Tier::Series));
            let motions: Vec<SpaceMotion> = stars.iter().map(SpaceMotion::from).collect();
            let all = || reduction.horizon_all(black_box(&motions).iter().copied());
            let ns = median_ns(1, || drop(black_box(all())));
            line("the same, their motions worked out before", ns / stars.len() as f64);
        }
        Err(error) => println!("no stars: {error}"),
    }
}

fn rows() -> Vec<Row> {
    let mut lines = DE440.lines().filter(|line| !line.starts_with('#'));
    let columns: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let cell = |name: &str| cells[columns.iter().position(|c| *c == name).expect("a column")];
        let number = |name: &str| cell(name).parse::<f64>().expect("a number");
        let tt = JulianDate::from_parts(number("jd_tt_1"), number("jd_tt_2"));
        let ut1 = JulianDate::from_parts(number("jd_ut1_1"), number("jd_ut1_2"));
        let angle = |name: &str| Angle::from_deg(number(name));
        Some(Row {
            // The table has stars too.
            body: cell("body").parse().ok()?,
            instant: Instant::from_tt_ut1(tt, ut1).expect("a date within range"),
            place: Place::new(number("lat_deg_N"), number("lon_deg_E"), number("height_m"))
                .expect("a place"),
            truth: Dir::from_spherical(angle("topo_ra_app_deg"), angle("topo_dec_app_deg")),
        })
    };
    lines.filter_map(row).collect()
}

fn observer(row: &Row) -> Observer {
    Observer::at(&row.instant, &row.place)
}

fn earth_of(row: &Row, tier: Tier) -> EarthState {
    Ephemeris::analytic().earth(row.instant.tdb, tier).expect("within range")
}

fn sky(row: &Row, tolerance: Angle) -> SkyState {
    SkyState::at(&Ephemeris::analytic(), &row.instant, &row.place, tolerance).expect("within range")
}

fn apparent(body: Body, tier: Tier, observer: &Observer, earth: &EarthState) -> ApparentPlace {
    ApparentPlace::of(&Ephemeris::analytic(), body, tier, observer, earth).expect("within range")
}

/// Largest error, arcseconds; largest part of its bound; number of places.
fn worst(rows: &[Row], body: Body, tier: Tier) -> (f64, f64, usize) {
    let (mut error, mut part, mut places) = (0.0f64, 0.0f64, 0);
    for row in rows.iter().filter(|row| row.body == body) {
        let seen = apparent(body, tier, &observer(row), &earth_of(row, tier));
        let off = seen.topocentric.separation(row.truth);
        let bound = tier.bound(body, row.instant.tdb).expect("within range");
        error = error.max(off.arcsec());
        part = part.max(off.rad() / bound.rad());
        places += 1;
    }
    (error, part, places)
}

/// Nanoseconds of one apparent place at the dates of all rows: with its Earth, and with that given.
fn costs(rows: &[Row], body: Body, tier: Tier) -> (f64, f64) {
    let observed: Vec<_> = rows.iter().map(|row| (observer(row), row)).collect();
    let with_earth =
        |(observer, row): &(Observer, &Row)| apparent(body, tier, observer, &earth_of(row, tier));
    let given: Vec<_> = rows.iter().map(|row| (observer(row), earth_of(row, tier))).collect();
    let sharing =
        |(observer, earth): &(Observer, EarthState)| apparent(body, tier, observer, earth);
    (each(&observed, with_earth), each(&given, sharing))
}

/// Nanoseconds of one call, each with another input.
fn each<I, O>(inputs: &[I], call: impl Fn(&I) -> O) -> f64 {
    let mut inputs = inputs.iter().cycle();
    median_ns(CALLS, || {
        for input in inputs.by_ref().take(CALLS) {
            black_box(call(black_box(input)));
        }
    })
}

/// Median over repetitions, after one to warm up, divided by the calls in each.
fn median_ns(calls: usize, mut run: impl FnMut()) -> f64 {
    run();
    let mut times: Vec<f64> = (0..REPETITIONS)
        .map(|_| {
            let start = Clock::now();
            run();
            start.elapsed().as_secs_f64() * 1e9
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[REPETITIONS / 2] / calls as f64
}

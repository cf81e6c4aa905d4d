//! How good each theory is and what it costs: errors against DE440 beside nanoseconds.
//!
//! `cargo bench --bench ephemeris --no-default-features --features cli`; with `-- --json` a few
//! costs alone, for `scripts/peers.py`. Errors are the largest of the topocentric places in
//! `tests/truth/ephemeris_de440.csv`, 1550 to 2650, and the largest part that they take of the bound
//! that the theory states for their dates. Times are medians over random dates of that table, tables
//! warm; ratios are to the Sun of the paper in the same run, so that runs on different machines
//! compare.

use std::env;
use std::hint::black_box;
use std::sync::LazyLock;
use std::time::Instant as Clock;

use nocturne::catalog::Catalogs;
use nocturne::ephemeris::apparent::{ApparentPlace, Observer};
use nocturne::ephemeris::orientation::{NutationForm, Nutations, Orientation};
use nocturne::ephemeris::stars::{SpaceMotion, StarReduction};
use nocturne::ephemeris::{Body, Depth, EarthState, Ephemeris, Observation, Tier};
use nocturne::frame::{Dir, TrueOfDate};
use nocturne::place::Place;
use nocturne::sky::SkyState;
use nocturne::time::{Instant, JulianDate, Tt};
use nocturne::units::Angle;

const IAU_2006: &str = include_str!("../tests/truth/earth_iau2006.csv");
const DE440: &str = include_str!("../tests/truth/ephemeris_de440.csv");
/// Repetitions whose median is taken.
const REPETITIONS: usize = 501;
/// Calls in each: too short together to be interrupted often, long enough for the clock.
const CALLS: usize = 64;
const FINE: Angle = Angle::from_arcsec(0.01);
const BEST: Angle = Angle::from_arcsec(0.001);

static EPHEMERIS: LazyLock<Ephemeris> = LazyLock::new(|| {
    let catalogs = Catalogs::locate(None).expect("the catalogues of the repository");
    Ephemeris::load(&catalogs, BEST).expect("the tables of the repository")
});

/// A body seen from a place at an instant, and where DE440 has it.
struct Row {
    body: Body,
    instant: Instant,
    place: Place,
    truth: Dir<TrueOfDate>,
}

fn main() {
    let rows = rows();
    if env::args().any(|argument| argument == "--json") {
        return print_json(&rows);
    }
    let baseline_ns = costs(&rows, Body::Sun, Tier::Paper).0;
    println!("One apparent place: alone, with the theory of the Earth; and where others share it");
    println!(
        "body     tier             error, arcsec  of bound  alone, ns   ratio  sharing, ns  places"
    );
    for tier in Tier::ALL.into_iter().filter(|&tier| EPHEMERIS.has(tier)) {
        for body in Body::ALL.into_iter().filter(|&body| tier.knows(body)) {
            let (error, part, places) = worst(&rows, body, tier);
            let (alone_ns, sharing_ns) = costs(&rows, body, tier);
            let ratio = alone_ns / baseline_ns;
            println!(
                "{:8} {:16} {error:13.5} {:8.0}% {alone_ns:10.0} {ratio:7.2} {sharing_ns:12.0} {places:7}",
                body.to_string(),
                tier.to_string(),
                part * 100.0,
            );
        }
    }

    let line = |what: &str, ns: f64| {
        println!("{what:46} {ns:10.0} {:7.2}", ns / baseline_ns);
    };
    println!("\nWhat all share, and the whole                          ns   ratio");
    line("instant: UTC and TDB from TT and UT1", each(&rows, instant));
    line("observer: precession, nutation, rotation", each(&rows, |row| observer(row, FINE)));
    for tier in Tier::ALL.into_iter().filter(|&tier| EPHEMERIS.has(tier)) {
        let name = format!("Earth, position and velocity, {tier}");
        line(&name, each(&rows, |row| earth(row, tier)));
    }
    line("shared by all to 0.01\": instant, observer, Earth", shared_ns(&rows));
    line("Sun, Moon and eight planets to 0.01\"", all_ns(&rows));
    line("SkyState::at to 0.01\"", each(&rows, |row| sky(row, FINE)));
    earth_stands(&rows, baseline_ns);
    match Catalogs::locate(None).and_then(|catalogs| catalogs.stars()) {
        Ok(stars) => {
            let sky = sky(&rows[0], FINE);
            let ns = median_ns(1, || drop(black_box(sky.stars(black_box(&stars)))));
            line(
                &format!("stars to the horizon frame, each of {}", stars.len()),
                ns / stars.len() as f64,
            );
            let row = &rows[0];
            let reduction = StarReduction::new(&observer(row, FINE), &earth(row, fine_tier()));
            let motions: Vec<SpaceMotion> = stars.iter().map(SpaceMotion::from).collect();
            let all = || reduction.horizon_all(black_box(&motions).iter().copied());
            let ns = median_ns(1, || drop(black_box(all())));
            line("the same, their motions worked out before", ns / stars.len() as f64);
        }
        Err(error) => println!("no stars: {error}"),
    }
}

/// What other engines are compared with.
fn print_json(rows: &[Row]) {
    let tier = fine_tier();
    let (moon, mars) = (costs(rows, Body::Moon, tier), costs(rows, Body::Mars, tier));
    let shared_ns = shared_ns(rows);
    println!(
        "{{\"shared_ns\": {shared_ns:.0}, \"moon_ns\": {:.0}, \"mars_ns\": {:.0}, \
         \"moon_alone_ns\": {:.0}, \"mars_alone_ns\": {:.0}, \"ten_bodies_ns\": {:.0}}}",
        moon.1,
        mars.1,
        shared_ns + moon.1,
        shared_ns + mars.1,
        all_ns(rows),
    );
}

/// What an observation costs before the first body is asked: all but the body.
fn shared_ns(rows: &[Row]) -> f64 {
    each(rows, |row| {
        let instant = instant(row);
        (Observer::at(&EPHEMERIS, &instant, &row.place, FINE), earth(row, fine_tier()))
    })
}

/// All bodies of one instant and one place, from the two dates on.
fn all_ns(rows: &[Row]) -> f64 {
    each(rows, |row| {
        let mut observation = Observation::at(&EPHEMERIS, &instant(row), &row.place, FINE);
        Body::ALL.map(|body| observation.seen(body).expect("within range").place.horizon)
    })
}

fn fine_tier() -> Tier {
    Tier::De440(Depth::Hundredth)
}

/// Axes and rotation of the Earth by each form of nutation: the largest error against ERFA, and costs.
fn earth_stands(rows: &[Row], baseline_ns: f64) {
    let nutations = match Catalogs::locate(None).and_then(|catalogs| Nutations::load(&catalogs)) {
        Ok(nutations) => nutations,
        Err(error) => return println!("no table of nutation: {error}"),
    };
    let truth: Vec<(JulianDate<Tt>, Angle, Angle)> = IAU_2006
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| {
            let n: Vec<f64> = line.split(',').map(|n| n.parse().expect("a number")).collect();
            let tt = JulianDate::from_parts(n[0], n[1]);
            (tt, Angle::from_arcsec(n[4]), Angle::from_arcsec(n[5]))
        })
        .collect();
    println!(
        "\nHow the Earth stands        error, arcsec   nutation, ns   ratio  all axes, ns   ratio"
    );
    for form in NutationForm::ALL {
        let error = truth.iter().fold(0.0, |error: f64, &(tt, longitude, obliquity)| {
            let nutation = nutations.at(tt, form);
            let off = (nutation.longitude - longitude).abs();
            error.max(off.max((nutation.obliquity - obliquity).abs()).arcsec())
        });
        let nutation_ns = each(rows, |row| nutations.at(row.instant.tt, form));
        let all_ns =
            each(rows, |row| Orientation::at(&row.instant, &nutations.at(row.instant.tt, form)));
        println!(
            "nutation {:16} {error:16.6} {nutation_ns:14.0} {:7.2} {all_ns:13.0} {:7.2}",
            format!("{form:?}"),
            nutation_ns / baseline_ns,
            all_ns / baseline_ns,
        );
    }
    let antiquity: Vec<Instant> = (0..256)
        .filter_map(|i| {
            Instant::from_tt(JulianDate::from_jd(625_332.0 + 2_345.6 * f64::from(i))).ok()
        })
        .collect();
    let all_ns = each(&antiquity, |instant| {
        Orientation::at(instant, &nutations.within(Angle::from_deg(1.0), instant.tt))
    });
    let ratio = all_ns / baseline_ns;
    println!("the same in -3000 to -1400, to 1 degree {all_ns:45.0} {ratio:7.2}");
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

/// As a program makes it that was given TT and UT1.
fn instant(row: &Row) -> Instant {
    Instant::from_tt_ut1(row.instant.tt, row.instant.ut1).expect("within range")
}

fn observer(row: &Row, tolerance: Angle) -> Observer {
    Observer::at(&EPHEMERIS, &row.instant, &row.place, tolerance)
}

fn earth(row: &Row, tier: Tier) -> EarthState {
    EPHEMERIS.earth(row.instant.tdb, tier).expect("within range")
}

fn sky(row: &Row, tolerance: Angle) -> SkyState {
    SkyState::at(&EPHEMERIS, &row.instant, &row.place, tolerance).expect("within range")
}

fn apparent(body: Body, tier: Tier, observer: &Observer, earth: &EarthState) -> ApparentPlace {
    ApparentPlace::of(&EPHEMERIS, body, tier, observer, earth).expect("within range")
}

/// Largest error, arcseconds; largest part of its bound; number of places.
fn worst(rows: &[Row], body: Body, tier: Tier) -> (f64, f64, usize) {
    let (mut error, mut part, mut places) = (0.0f64, 0.0f64, 0);
    for row in rows.iter().filter(|row| row.body == body) {
        let seen = apparent(body, tier, &observer(row, BEST), &earth(row, tier));
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
    let observed: Vec<_> = rows.iter().map(|row| (observer(row, BEST), row)).collect();
    let with_earth =
        |(observer, row): &(Observer, &Row)| apparent(body, tier, observer, &earth(row, tier));
    let given: Vec<_> = rows.iter().map(|row| (observer(row, BEST), earth(row, tier))).collect();
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

//! What a row of a long table costs, reading and writing included.
//!
//! `cargo bench --bench tables --no-default-features --features cli`. Runs the program on rows with
//! random bodies, dates from 1550 to 2650 and places, and on rows of one body at one instant and
//! place, which share what there is to reckon: what is left is mostly reading and writing. The ratios
//! are to a copy of the finished CSV, so that runs on different machines compare.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use std::time::Instant as Clock;

const ROWS: usize = 1_000_000;
const HEAD: &str = "body,jd_tt_1,jd_tt_2,jd_ut1_1,jd_ut1_2,lon_deg_E,lat_deg_N,height_m\n";
const BODIES: [&str; 13] = [
    "sun", "moon", "mercury", "venus", "mars", "jupiter", "saturn", "uranus", "neptune", "pluto",
    "sirius", "polaris", "barnard",
];

fn main() {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let file = |name: &str| folder.path().join(name);
    std::fs::write(file("random.csv"), random_rows()).expect("a file");
    let same = "sun,2451545.0,0.123456789,2451545.0,0.122717123456,-111.65127,35.19807,2108.0\n";
    std::fs::write(file("same.csv"), HEAD.to_owned() + &same.repeat(ROWS)).expect("a file");
    println!("{ROWS} rows              seconds  microseconds a row     bytes  ratio to a copy");
    let mut copy_s = None;
    for (rows, format) in
        [("random", "csv"), ("random", "jsonl"), ("random", "parquet"), ("same", "csv")]
    {
        let out = file(&format!("out.{format}"));
        let seconds = seconds(|| run(&file(&format!("{rows}.csv")), &out));
        let copy_s = *copy_s.get_or_insert_with(|| {
            let copy = file("copy");
            self::seconds(|| {
                std::fs::copy(&out, &copy).expect("a copy");
            })
        });
        println!(
            "{rows:8} to {format:8} {seconds:14.2} {:19.2} {:9} {:16.1}",
            seconds / ROWS as f64 * 1e6,
            out.metadata().expect("a file").len(),
            seconds / copy_s
        );
    }
}

fn run(rows: &Path, out: &Path) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_nocturne"));
    let status = command.args(["ephemeris", "--quiet", "--rows"]).arg(rows).arg("-o").arg(out);
    assert!(status.status().expect("the program").success());
}

/// The least of three runs.
fn seconds(mut run: impl FnMut()) -> f64 {
    let time = |_| {
        let start = Clock::now();
        run();
        start.elapsed().as_secs_f64()
    };
    (0..3).map(time).fold(f64::INFINITY, f64::min)
}

fn random_rows() -> String {
    let mut text = String::from(HEAD);
    // Marsaglia 2003, *J. Stat. Softw.* 8, 14: xorshift with 13, 7, 17.
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut uniform = |low: f64, high: f64| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        low + (high - low) * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for _ in 0..ROWS {
        let body = BODIES[uniform(0.0, BODIES.len() as f64) as usize];
        let day = uniform(2_287_190.0, 2_688_970.0).floor() + 0.5;
        let (tt, ut1) = (uniform(-0.49, 0.49), uniform(-0.0009, -0.0007));
        let (lon, lat) = (uniform(-180.0, 180.0), uniform(-90.0, 90.0));
        let height = uniform(0.0, 3000.0);
        writeln!(
            text,
            "{body},{day:.1},{tt:.9},{day:.1},{:.12},{lon:.5},{lat:.5},{height:.1}",
            tt + ut1
        )
        .expect("memory takes all that is written");
    }
    text
}

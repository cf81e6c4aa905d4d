//! The table of deep time against DE431 itself, as the Earth sees it.

use std::collections::BTreeMap;

use glam::DVec3;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::resampled::{Channel, Depth, Table};
use nocturne::frame::{Dir, Icrs, Pos};
use nocturne::time::{JulianDate, Tdb};
use nocturne::units::{AU_KM, Angle};

/// Geometric places by Swiss Ephemeris: see `truth/de431_directions.py`.
const DIRECTIONS: &str = include_str!("truth/de431_directions.csv");
/// Of DE431.
const EARTH_MOON_MASS_RATIO: f64 = 81.300_569_074_190_62;

fn table(file: &str) -> Table {
    let catalogs = Catalogs::locate(None).unwrap();
    Table::open(catalogs.layers(file, 1).unwrap()).unwrap()
}

fn channel<'a>(table: &'a Table, name: &str) -> &'a Channel {
    table.channel(name).unwrap_or_else(|| panic!("no channel {name}"))
}

fn km(table: &Table, name: &str, tdb: JulianDate<Tdb>) -> DVec3 {
    channel(table, name).value(tdb, Depth::Tenth)
}

/// Geocentric geometric position.
fn seen(table: &Table, body: &str, tdb: JulianDate<Tdb>) -> Pos<Icrs> {
    let moon = km(table, "moon", tdb);
    let sun = km(table, "sun", tdb);
    let earth = sun + km(table, "earth-moon", tdb) - moon / (1.0 + EARTH_MOON_MASS_RATIO);
    Pos::from_km(match body {
        "moon" => moon,
        "sun" => sun - earth,
        "mercury" | "venus" | "mars" => sun + km(table, body, tdb) - earth,
        _ => km(table, body, tdb) - earth,
    })
}

/// Bound of the direction, arcseconds, and of the distance, kilometres, over all six millennia.
fn bounds(body: &str) -> (f64, f64) {
    match body {
        "sun" => (0.03, 30.0),
        "moon" => (1.2, 3.0),
        "mercury" | "venus" | "mars" => (0.15, 80.0),
        "jupiter" | "saturn" => (0.15, 1000.0),
        _ => (0.1, 2000.0),
    }
}

#[test]
fn bodies_stand_where_de431_puts_them() {
    let table = table("de431.bin");
    let mut largest: BTreeMap<(&str, i32), (f64, f64)> = BTreeMap::new();
    let mut rows = 0;
    for line in DIRECTIONS.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [body, numbers @ ..] = cells.as_slice() else { panic!("{line}") };
        let numbers: Vec<f64> = numbers.iter().map(|cell| cell.parse().unwrap()).collect();
        let [jd, ra_deg, dec_deg, distance_au] = numbers[..] else { panic!("{line}") };
        let tdb = JulianDate::from_jd(jd);
        let truth: Dir<Icrs> =
            Dir::from_spherical(Angle::from_deg(ra_deg), Angle::from_deg(dec_deg));
        let position = seen(&table, body, tdb);
        let direction = position.dir().separation(truth).arcsec();
        let distance_km = (position.distance_km() - distance_au * AU_KM).abs();
        let millennium = (tdb.centuries_since_j2000() / 10.0).floor() as i32 + 2;
        let entry = largest.entry((body, millennium)).or_default();
        *entry = (entry.0.max(direction), entry.1.max(distance_km));
        let (arcsec, km) = bounds(body);
        assert!(direction <= arcsec, "{body} at JD {jd}: {direction}\"");
        assert!(distance_km <= km, "{body} at JD {jd}: {distance_km} km");
        rows += 1;
    }
    for ((body, millennium), (arcsec, km)) in largest {
        println!(
            "{body}, {} to {}: {arcsec:.3}\" {km:.1} km",
            millennium * 1000,
            (millennium + 1) * 1000
        );
    }
    assert_eq!(rows, 2400);
}

/// What DE440 changed, at both ends of its span: where one table takes over from the other, bodies
/// jump by this. Largest of 200 dates in four years, arcseconds, with a tenth to spare.
const STEPS: [(&str, f64, f64); 10] = [
    ("sun", 0.036, 0.072),
    ("moon", 0.818, 1.781),
    ("mercury", 0.084, 0.134),
    ("venus", 0.063, 0.08),
    ("mars", 0.166, 0.106),
    ("jupiter", 0.139, 0.166),
    ("saturn", 0.037, 0.033),
    ("uranus", 0.54, 0.806),
    ("neptune", 1.171, 1.837),
    ("pluto", 1.531, 1.607),
];

#[test]
fn the_step_to_de440_is_known() {
    let (deep, modern) = (table("de431.bin"), table("de440.bin"));
    let (first, last) = channel(&modern, "sun").span();
    for (body, at_1550, at_2650) in STEPS {
        for (begin, bound) in [(first, at_1550), (last.plus_days(-1461.0), at_2650)] {
            let step = (0..200)
                .map(|index| begin.plus_days(f64::from(index) * 7.3))
                .map(|tdb| (seen(&deep, body, tdb).dir(), seen(&modern, body, tdb).dir()))
                .map(|(deep, modern)| deep.separation(modern).arcsec())
                .fold(0.0, f64::max);
            println!("{body} at JD {}: {step:.3}\"", begin.day());
            assert!(step <= bound && step > 0.5 * bound, "{body}: {step}\"");
        }
    }
}

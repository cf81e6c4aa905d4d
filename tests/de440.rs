//! The table `de440.bin` against DE440 itself, and against its own borders.

use std::collections::BTreeMap;

use glam::DVec3;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::resampled::{Depth, Table};
use nocturne::time::{JulianDate, Tdb};
use nocturne::units::Angle;

const TRUTH: &str = include_str!("truth/de440_positions.csv");
const FILE: &str = "de440.bin";
/// Mass of the Earth over mass of the Moon (DE440, EMRAT).
const EARTH_MOON_MASS_RATIO: f64 = 81.300_568_221_497_2;
/// Channels that are told from the Sun.
const FROM_SUN: [&str; 4] = ["earth-moon", "mercury", "venus", "mars"];

fn table(depth: Depth) -> Table {
    let layers = Catalogs::locate(None).unwrap().layers(FILE, depth.layers()).unwrap();
    Table::open(layers).unwrap()
}

/// Positions by name: the Moon from the Earth, all others from the barycentre.
type Positions = BTreeMap<String, DVec3>;

/// Every moment of the truth table, with all bodies.
fn truth() -> Vec<(JulianDate<Tdb>, Positions)> {
    let mut moments: Vec<(JulianDate<Tdb>, Positions)> = Vec::new();
    for line in TRUTH.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |index: usize| cells[index].parse::<f64>().unwrap();
        let tdb = JulianDate::from_parts(number(1), number(2));
        if moments.last().is_none_or(|last| last.0 != tdb) {
            moments.push((tdb, Positions::new()));
        }
        let position = DVec3::new(number(3), number(4), number(5));
        moments.last_mut().unwrap().1.insert(cells[0].into(), position);
    }
    assert_eq!(moments.len(), 36);
    assert!(moments.iter().all(|(_, positions)| positions.len() == 11));
    moments
}

fn positions(table: &Table, tdb: JulianDate<Tdb>, depth: Depth) -> Positions {
    let value = |id: &str| table.channel(id).unwrap().value(tdb, depth);
    let from_barycentre = |id: &str| match FROM_SUN.contains(&id) {
        true => value("sun") + value(id),
        false => value(id),
    };
    table.channels().map(|c| (c.id().to_owned(), from_barycentre(c.id()))).collect()
}

/// As the centre of the Earth sees them, without light time; the Sun in place of the barycentre of
/// Earth and Moon.
fn views(positions: &Positions) -> Positions {
    let moon = positions["moon"];
    let earth = positions["earth-moon"] - moon / (1.0 + EARTH_MOON_MASS_RATIO);
    let view = |(id, &position): (&String, &DVec3)| {
        let seen = if id == "moon" { moon } else { position - earth };
        (id.clone(), seen)
    };
    positions.iter().filter(|(id, _)| *id != "earth-moon").map(view).collect()
}

#[test]
fn bodies_are_seen_where_de440_has_them_at_every_depth() {
    let truth = truth();
    for (depth, bound_arcsec) in Depth::ALL.into_iter().zip([0.06, 0.006, 0.0006]) {
        let table = table(depth);
        assert_eq!(table.depth(), depth);
        let mut largest = BTreeMap::<String, (f64, f64)>::new();
        for (tdb, truth) in &truth {
            let seen = views(&positions(&table, *tdb, depth));
            for (id, truth) in views(truth) {
                let angle = seen[&id].cross(truth).length().atan2(seen[&id].dot(truth));
                let distance_km = (seen[&id].length() - truth.length()).abs();
                let entry = largest.entry(id).or_default();
                entry.0 = entry.0.max(Angle::from_rad(angle).arcsec());
                entry.1 = entry.1.max(distance_km);
            }
        }
        for (id, (arcsec, distance_km)) in largest {
            println!("{id} {depth:?}: {arcsec:.6}\", {distance_km:.4} km");
            assert!(arcsec < bound_arcsec, "{id} {depth:?}: {arcsec}\"");
            // At full depth; the others are as much coarser as their directions.
            let bound_km = match id.as_str() {
                "moon" => 0.0007,
                "sun" => 0.2,
                "mercury" | "venus" | "mars" => 0.5,
                _ => 10.0,
            } * bound_arcsec
                / 0.0006;
            assert!(distance_km < bound_km, "{id} {depth:?}: {distance_km} km");
            // A bound that nothing comes near would be no measure.
            assert!(id == "sun" || arcsec > 0.05 * bound_arcsec, "{id} {depth:?}: {arcsec}\"");
        }
    }
}

#[test]
fn the_span_is_that_of_the_kernel() {
    let table = table(Depth::Tenth);
    for channel in table.channels() {
        let (first, last) = channel.span();
        assert_eq!((first.jd(), last.jd()), (2_287_184.5, 2_688_976.5), "{}", channel.id());
    }
}

#[test]
fn no_border_makes_a_step() {
    let table = table(Depth::Thousandth);
    for channel in table.channels() {
        let recipe = channel.recipe();
        for depth in Depth::ALL {
            let pieces = recipe.folding[depth as usize].pieces;
            let borders = recipe.segments as usize * pieces - 1;
            let (mut step, mut rate_step) = (0.0f64, 0.0f64);
            for index in 0..400 {
                let border = 1 + index * 7_919 % borders;
                let days = border as f64 * recipe.segment_days / pieces as f64;
                let at = JulianDate::from_parts(recipe.start_jd, days);
                let beside = 1e-9;
                let [before, after] =
                    [-beside, beside].map(|days| channel.value_and_rate(at.plus_days(days), depth));
                let moved = (before.1 + after.1) * beside;
                let length = before.0.length();
                step = step.max((after.0 - before.0 - moved).length() / length);
                rate_step = rate_step.max((after.1 - before.1).length());
            }
            println!("{} {depth:?}: {step:.1e}, {rate_step:.1e} km/day", channel.id());
            // 1e-14 is 2e-9 arcseconds: rounding of 64-bit numbers.
            assert!(step < 1e-14, "{} {depth:?}: {step}", channel.id());
            // Of aberration 1 km a day makes 8e-6 arcseconds.
            let rate_bound = [100.0, 10.0, 1.0][depth as usize];
            assert!(rate_step < rate_bound, "{} {depth:?}: {rate_step}", channel.id());
        }
    }
}

#[test]
fn rates_are_the_slopes_of_positions() {
    let table = table(Depth::Thousandth);
    for channel in table.channels() {
        for (tdb, _) in truth().iter().skip(1).take(34) {
            let (_, rate) = channel.value_and_rate(*tdb, Depth::Thousandth);
            let step = 0.01;
            let [before, after] =
                [-step, step].map(|days| channel.value(tdb.plus_days(days), Depth::Thousandth));
            let slope = (after - before) / (2.0 * step);
            let error = (slope - rate).length() / rate.length();
            // The third derivative over the step, greatest for the Moon.
            assert!(error < 2e-6, "{} at {tdb:?}: {error}", channel.id());
        }
    }
}

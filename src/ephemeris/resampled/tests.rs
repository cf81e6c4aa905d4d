//! A small table of made-up motions: what goes in comes out, at every depth and nothing else.

use super::*;
use crate::catalog::layered::open_layers;

const START_JD: f64 = 2_451_536.5;
const SEGMENTS: u32 = 5;

/// Days from the begin of the span.
fn days(tdb: JulianDate<Tdb>) -> f64 {
    tdb - JulianDate::from_jd(START_JD)
}

fn at(days: f64) -> JulianDate<Tdb> {
    JulianDate::from_parts(START_JD, days)
}

fn orbit() -> Orbit {
    Orbit {
        axis_km: [384_000.0, 10.0, 0.0, 0.0],
        longitude_rad: [1.0, 8_400.0, 0.1, 0.0],
        eccentricity_cos: [0.05, 0.0, 0.0, 0.0],
        perihelion_turn_rad: [0.5, 71.0, 0.0, 0.0],
        inclination_cos: [0.045, 0.0, 0.0, 0.0],
        node_turn_rad: [2.0, -33.8, 0.0, 0.0],
        ..Orbit::default()
    }
}

fn curve(tdb: JulianDate<Tdb>) -> DVec3 {
    let t = days(tdb);
    DVec3::new(1e6 * (0.21 * t).sin(), 2e5 * (0.3 * t + 1.0).cos(), -3e3 + 40.0 * t)
}

fn around(tdb: JulianDate<Tdb>) -> DVec3 {
    let t = days(tdb);
    let wobble = DVec3::new((0.4 * t).sin(), (0.3 * t).cos(), (0.35 * t).sin());
    let station = Reference::Orbit(Box::new(orbit())).at(tdb);
    station.origin + station.axes * (wobble * DVec3::new(900.0, 2500.0, 80.0))
}

fn angle(tdb: JulianDate<Tdb>) -> DVec3 {
    DVec3::new(0.3 + 0.01 * (0.5 * days(tdb)).sin(), 0.0, 0.0)
}

fn recipe(id: &str) -> Recipe {
    let folding = |degree| Folding { pieces: 2, degree };
    Recipe {
        id: id.into(),
        start_jd: START_JD,
        segment_days: 8.0,
        segments: SEGMENTS,
        components: 3,
        degree: 14,
        quantum: [1e-3, 1e-3, 2e-4],
        omitted_bits: [7, 3],
        reference: Reference::None,
        folding: [folding(11), folding(13), folding(15)],
    }
}

fn file() -> Vec<u8> {
    let around_recipe = Recipe {
        start_jd: START_JD + 8.0,
        segment_days: 10.5,
        segments: 3,
        degree: 16,
        reference: Reference::Orbit(Box::new(orbit())),
        ..recipe("around")
    };
    let angle_recipe = Recipe {
        components: 1,
        quantum: [1e-10, 0.0, 0.0],
        omitted_bits: [0, 0],
        ..recipe("angle")
    };
    encode(&[
        ChannelSource { recipe: recipe("curve"), sample: &curve },
        ChannelSource { recipe: around_recipe, sample: &around },
        ChannelSource { recipe: angle_recipe, sample: &angle },
    ])
    .unwrap()
}

type Quantity = (&'static str, fn(JulianDate<Tdb>) -> DVec3);
const QUANTITIES: [Quantity; 3] = [("curve", curve), ("around", around), ("angle", angle)];

/// Moments over the span of a channel, the borders of its segments among them.
fn moments(channel: &Channel) -> impl Iterator<Item = JulianDate<Tdb>> {
    let (first, last) = channel.span();
    (0..=480).map(move |i| first.plus_days((last - first) * f64::from(i) / 480.0))
}

#[test]
fn values_come_back_within_a_few_quanta_of_each_depth() {
    let table = Table::from_bytes(&file(), Depth::Thousandth).unwrap();
    for (id, truth) in QUANTITIES {
        let channel = table.channel(id).unwrap();
        let recipe = channel.recipe();
        for depth in Depth::ALL {
            let omitted = recipe.omitted_bits.get(depth as usize).map_or(0, |bits| *bits);
            let axis = if id == "around" { 3f64.sqrt() } else { 1.0 };
            let mut largest = 0.0f64;
            for tdb in moments(channel) {
                let error = (channel.value(tdb, depth) - truth(tdb)).abs();
                for component in 0..recipe.components {
                    // Mixed axes: the largest quantum counts for all.
                    let quantum = if id == "around" { 1e-3 } else { recipe.quantum[component] };
                    let quanta = error[component] / (quantum * f64::from(1u32 << omitted));
                    largest = largest.max(quanta / axis);
                }
                assert_eq!(error.to_array()[recipe.components..].iter().sum::<f64>(), 0.0);
            }
            assert!((0.3..5.0).contains(&largest), "{id} {depth:?}: {largest} quanta");
        }
    }
}

#[test]
fn segments_meet_at_their_borders_at_every_depth() {
    let table = Table::from_bytes(&file(), Depth::Thousandth).unwrap();
    for (id, truth) in QUANTITIES {
        let channel = table.channel(id).unwrap();
        let recipe = channel.recipe();
        for depth in Depth::ALL {
            for segment in 1..recipe.segments as usize {
                let [before, after] = [(segment - 1, 1.0), (segment, -1.0)]
                    .map(|(segment, x)| channel.unfold(segment, depth.layers())(x));
                assert_eq!(before, after, "{id} {depth:?} border {segment}");
                // Unfolded, from both sides: no farther apart than rounding and the motion.
                let border = moment(recipe, segment, -1.0);
                let sides = [-1e-9, 1e-9].map(|days| channel.value(border.plus_days(days), depth));
                let moved = truth(border.plus_days(1e-9)) - truth(border.plus_days(-1e-9));
                let step = (sides[1] - sides[0] - moved).length() / before.length();
                assert!(step < 1e-13, "{id} {depth:?} border {segment}: {step}");
            }
        }
    }
}

#[test]
fn rates_are_those_of_the_values() {
    let table = Table::from_bytes(&file(), Depth::Thousandth).unwrap();
    for (id, _) in QUANTITIES {
        let channel = table.channel(id).unwrap();
        for depth in Depth::ALL {
            for tdb in moments(channel).skip(1).step_by(8) {
                let (value, rate) = channel.value_and_rate(tdb, depth);
                assert_eq!(value, channel.value(tdb, depth));
                // Never across a border: those lie at every 48th and every 80th moment.
                let side = |days: f64| channel.value(tdb.plus_days(days), depth);
                let step = 1e-3;
                let difference = (side(step) - side(-step)) / (2.0 * step);
                let scale = rate.length() + value.length() * 0.1;
                assert!(
                    (difference - rate).length() < 1e-7 * scale,
                    "{id} {depth:?} {tdb:?}: {difference} {rate}"
                );
            }
        }
    }
}

#[test]
fn a_prefix_serves_its_depth_as_the_whole_file_does() {
    let file = file();
    let whole = Table::from_bytes(&file, Depth::Thousandth).unwrap();
    for depth in Depth::ALL {
        // Of each layer 56 bytes are its header.
        let payloads = open_layers(&file[..], depth.layers()).unwrap();
        let length: usize = payloads.iter().map(|payload| payload.len() + 56).sum();
        assert_eq!(length == file.len(), depth == Depth::Thousandth);
        let part = Table::from_bytes(&file[..length], depth).unwrap();
        assert_eq!(part.depth(), depth);
        for (id, _) in QUANTITIES {
            let (part, whole) = (part.channel(id).unwrap(), whole.channel(id).unwrap());
            for tdb in moments(part) {
                assert_eq!(part.value(tdb, depth), whole.value(tdb, depth));
                assert_eq!(part.value(tdb, Depth::Thousandth), whole.value(tdb, depth));
            }
        }
    }
}

#[test]
fn the_last_border_belongs_to_the_last_segment() {
    let table = Table::from_bytes(&file(), Depth::Thousandth).unwrap();
    let channel = table.channel("curve").unwrap();
    assert_eq!(channel.span(), (at(0.0), at(40.0)));
    assert!(channel.holds(at(0.0)) && channel.holds(at(40.0)));
    assert!(!channel.holds(at(-1e-9)) && !channel.holds(at(40.0 + 1e-9)));
    let error = channel.value(at(40.0), Depth::Thousandth) - curve(at(40.0));
    assert!(error.length() < 2e-3, "{error}");
    assert!(table.channel("no such thing").is_none());
}

#[test]
fn nanoseconds_are_not_lost() {
    // 1e-9 day of a thing that moves with 2.1e5 a day.
    let table = Table::from_bytes(&file(), Depth::Thousandth).unwrap();
    let channel = table.channel("curve").unwrap();
    let (near, later) = (at(15.25), at(15.25).plus_days(1e-9));
    let moved = channel.value(later, Depth::Thousandth) - channel.value(near, Depth::Thousandth);
    let rate = channel.value_and_rate(near, Depth::Thousandth).1;
    assert!((moved.x / (rate.x * 1e-9) - 1.0).abs() < 1e-3, "{moved} {rate}");
}

#[test]
fn many_threads_see_one_table() {
    use rayon::prelude::*;
    let file = file();
    let alone = Table::from_bytes(&file, Depth::Thousandth).unwrap();
    let shared = Table::from_bytes(&file, Depth::Thousandth).unwrap();
    let value = |table: &Table, i: u32| {
        table.channel("around").unwrap().value(at(8.0 + f64::from(i) * 0.0625), Depth::Hundredth)
    };
    let together: Vec<DVec3> = (0..500u32).into_par_iter().map(|i| value(&shared, i)).collect();
    for (i, seen) in (0..500).zip(together) {
        assert_eq!(seen, value(&alone, i));
    }
}

#[test]
fn packing_is_repeatable() {
    assert_eq!(file(), file());
}

#[test]
fn every_flipped_byte_and_every_cut_is_refused() {
    let file = file();
    for at in 0..file.len() {
        let mut flipped = file.clone();
        flipped[at] ^= 0x10;
        assert!(Table::from_bytes(&flipped, Depth::Thousandth).is_err(), "byte {at}");
    }
    for length in 0..file.len() {
        assert!(Table::from_bytes(&file[..length], Depth::Thousandth).is_err(), "length {length}");
    }
}

#[test]
fn a_description_that_makes_no_sense_is_refused_in_words() {
    let payloads = open_layers(&file()[..], LAYERS).unwrap();
    let refused = |change: &dyn Fn(&mut Vec<Vec<u8>>)| {
        let mut payloads = payloads.clone();
        change(&mut payloads);
        Table::open(payloads).unwrap_err()
    };
    assert!(refused(&|p| p[0][7] = b'9').contains("no resampled quantities"));
    assert!(refused(&|p| p[0].truncate(30)).contains("ends within"));
    assert!(refused(&|p| p[1].push(0)).contains("in layer 2"));
    assert!(refused(&|p| p.clear()).contains("ask for 1 to 3"));
    // Any byte of the description may be any other: words, or another table, but no panic.
    for at in 0..600.min(payloads[0].len()) {
        for value in [0, 1, 0x3f, 0x7f, 0x80, 0xff] {
            let mut payloads = payloads.clone();
            payloads[0][at] = value;
            drop(Table::open(payloads));
        }
    }
    let wrong = |change: &dyn Fn(&mut Recipe)| {
        let mut recipe = recipe("wrong");
        change(&mut recipe);
        encode(&[ChannelSource { recipe, sample: &curve }]).unwrap_err()
    };
    assert!(wrong(&|r| r.quantum[1] = 0.0).contains("quantum"));
    assert!(wrong(&|r| r.quantum[0] = 1e-20).contains("enlarge"));
    assert!(wrong(&|r| r.start_jd = 0.3).contains("half day"));
    assert!(wrong(&|r| r.folding[0].degree = 8).contains("even"));
    assert!(wrong(&|r| r.folding[2].pieces = 3).contains("power of two"));
    assert!(wrong(&|r| r.omitted_bits = [2, 5]).contains("fall"));
    assert!(wrong(&|r| r.segments = 0).contains("segments"));
}

//! What eclipses cost, beside one apparent place of the Moon.

use std::hint::black_box;
use std::time::Instant as Clock;

use nocturne::almanac::eclipse::{LunarEclipse, SolarEclipse, lunar_eclipses, solar_eclipses};
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris, Observation};
use nocturne::place::Place;
use nocturne::time::{Instant, JulianDate};
use nocturne::units::Angle;

const REPETITIONS: usize = 15;
const BEST: Angle = Angle::from_arcsec(0.001);

fn main() {
    let ephemeris = Catalogs::locate(None).and_then(|catalogs| Ephemeris::load(&catalogs, BEST));
    let ephemeris = ephemeris.expect("the catalogues of this repository");
    let instant = |jd| Instant::from_tt(JulianDate::from_jd(jd)).expect("a date within range");
    let (from, to) = (instant(2_451_910.5), instant(2_488_434.5));
    let place = Place::new(42.341, -3.702, 860.0).expect("a place");

    let lunar = || -> Vec<LunarEclipse> {
        lunar_eclipses(&ephemeris, from, to, BEST).map(|e| e.expect("within range")).collect()
    };
    let solar = || -> Vec<SolarEclipse> {
        solar_eclipses(&ephemeris, from, to, BEST).map(|e| e.expect("within range")).collect()
    };
    let (of_moon, of_sun) = (lunar(), solar());
    println!(
        "2001 to 2100: {} eclipses of the Moon, {} of the Sun; times within {:.3} s",
        of_moon.len(),
        of_sun.len(),
        of_moon.iter().map(|e| e.uncertainty_s).fold(0.0, f64::max)
    );

    let seen = || Observation::at(&ephemeris, &from, &place, BEST).seen(Body::Moon);
    let place_us = median_us(|| drop(black_box(seen())));
    println!("                                              microseconds        ratio");
    let line = |what: &str, us: f64| println!("{what:44} {us:14.1} {:12.1}", us / place_us);
    line("one apparent place of the Moon", place_us);
    line("a century of lunar eclipses", median_us(|| drop(black_box(lunar()))));
    line("a century of solar eclipses", median_us(|| drop(black_box(solar()))));
    let locally = || of_moon.iter().for_each(|e| drop(black_box(e.at(&place))));
    line("a lunar eclipse at a place", median_us(locally) / of_moon.len() as f64);
    let locally = || of_sun.iter().for_each(|e| drop(black_box(e.at(&place))));
    line("a solar eclipse at a place", median_us(locally) / of_sun.len() as f64);
}

fn median_us(mut run: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..REPETITIONS)
        .map(|_| {
            let start = Clock::now();
            run();
            start.elapsed().as_secs_f64() * 1e6
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[REPETITIONS / 2]
}

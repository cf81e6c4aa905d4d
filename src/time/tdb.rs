//! TDB - TT: the clock of the barycentre against a clock on the Earth.

use crate::time::clock::{JulianDate, Tdb, Tt};

/// Amplitude in seconds, frequency in radians per Julian millennium, phase at J2000 in radians.
///
/// The terms above 2 microseconds of Fairhead & Bretagnon 1990, *A&A* 229, 240, in the order of
/// their size: the Earth's ellipse, the Moon-like beat with Venus and Jupiter, Saturn.
const TERMS: [(f64, f64, f64); 6] = [
    (1_656.674_564e-6, 6_283.075_849_991, 6.240_054_195),
    (22.417_471e-6, 5_753.384_884_897, 4.296_977_442),
    (13.839_792e-6, 12_566.151_699_983, 6.196_904_410),
    (4.770_086e-6, 529.690_965_095, 0.444_401_603),
    (4.676_740e-6, 6_069.776_754_553, 4.021_195_093),
    (2.256_707e-6, 213.299_095_438, 5.543_113_262),
];

/// The annual term's growth with the first and the second power of millennia, same source.
const GROWING_TERMS: [(f64, f64, f64); 2] = [
    (102.156_724e-6, 6_283.075_849_991, 4.249_032_005),
    (4.322_990e-6, 6_283.075_849_991, 2.642_893_748),
];

/// TDB - TT in seconds, at the centre of the Earth.
///
/// Within 10 microseconds of the full series from 1800 to 2200, 25 from -2000 to 4000, 50 before.
/// What an observer's place adds (2 microseconds at most) is left out.
pub fn tdb_minus_tt_s(tt: JulianDate<Tt>) -> f64 {
    let millennia = tt.centuries_since_j2000() / 10.0;
    let term = |&(amplitude_s, frequency, phase): &(f64, f64, f64)| {
        amplitude_s * (frequency * millennia + phase).sin()
    };
    let steady: f64 = TERMS.iter().map(term).sum();
    let growing: f64 = (1..).zip(&GROWING_TERMS).map(|(n, t)| millennia.powi(n) * term(t)).sum();
    steady + growing
}

/// TDB from TT.
pub fn tdb_from_tt(tt: JulianDate<Tt>) -> JulianDate<Tdb> {
    tt.read_on(tdb_minus_tt_s(tt))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_short_series_follows_the_full_one() {
        let table = include_str!("../../tests/truth/tdb_minus_tt.csv");
        let mut rows = 0;
        for line in table.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())) {
            let (jd, full_s) = line.split_once(',').unwrap();
            let tt = JulianDate::<Tt>::from_jd(jd.parse().unwrap());
            let error_s = (tdb_minus_tt_s(tt) - full_s.parse::<f64>().unwrap()).abs();
            let bound_s = match tt.centuries_since_j2000().abs() {
                ..=2.0 => 10e-6,
                ..=40.0 => 25e-6,
                _ => 50e-6,
            };
            assert!(error_s < bound_s, "{jd}: {error_s} s");
            rows += 1;
        }
        assert_eq!(rows, 48);
    }
}

//! The smallest difference of luminance that an adapted eye sees: threshold against intensity.
//!
//! *Source.* Cones and rods: Ferwerda, Pattanaik, Shirley & Greenberg 1996 (*SIGGRAPH*, 249), Eqs. 1
//! and 2, piecewise fits of the logarithms (base 10, cd/m2). Both together: Ward Larson, Rushmeier &
//! Piatko 1997 (*IEEE TVCG* 3, 291), table 1, the better of the two at each luminance. The rods' curve
//! is in scotopic cd/m2; the combined one takes photopic luminance for white light, and we give it
//! what rods and cones see together ([`crate::eye::receptors::seen_luminance_cd_m2`]).
//!
//! *Steps.* The published pieces do not quite meet. Where the luminance grows, the rods' curve and the
//! combined one fall by 0.0120 in the logarithm (2.7 %) at log L = -1.44, and the cones' and the
//! combined one by 0.0031 (0.7 %) at 1.9. All other joints are within 1e-4. The three functions keep
//! the published values; [`never_falling_cd_m2`] is the combined curve with a plateau behind each of
//! the two crests (12 and 3 thousandths of a decade long) and is continuous.
//!
//! *Omitted.* Time: these are thresholds of an eye that has adapted for long, and of large targets.

/// No light is darker than this for a logarithm, cd/m2.
const DARKEST_CD_M2: f64 = 1e-12;
/// Where the pieces of the rods' curve end, log10 of scotopic cd/m2.
const RODS_LOG: [f64; 2] = [-3.94, -1.44];
/// Where the pieces of the cones' curve end, log10 of cd/m2.
const CONES_LOG: [f64; 2] = [-2.6, 1.9];
/// Where cones become better than rods, log10 of cd/m2.
const CROSSING_LOG: f64 = -0.0184;

/// Threshold of the cones against a photopic luminance, both in cd/m2 (Ferwerda et al. 1996, Eq. 1).
pub fn cones_cd_m2(photopic_cd_m2: f64) -> f64 {
    10f64.powf(cones_log(log_of(photopic_cd_m2)))
}

/// Threshold of the rods against a scotopic luminance, both in scotopic cd/m2 (Ferwerda et al. 1996,
/// Eq. 2).
pub fn rods_cd_m2(scotopic_cd_m2: f64) -> f64 {
    10f64.powf(rods_log(log_of(scotopic_cd_m2)))
}

/// Threshold of the eye against a luminance, both in cd/m2 (Ward Larson et al. 1997, table 1).
pub fn combined_cd_m2(luminance_cd_m2: f64) -> f64 {
    10f64.powf(combined_log(log_of(luminance_cd_m2)))
}

/// [`combined_cd_m2`] without its two steps down: continuous, and never less for more light.
pub fn never_falling_cd_m2(luminance_cd_m2: f64) -> f64 {
    let log = log_of(luminance_cd_m2);
    let crest = |end: f64| if log >= end { combined_log(end.next_down()) } else { f64::MIN };
    let [rods, cones] = [crest(RODS_LOG[1]), crest(CONES_LOG[1])];
    10f64.powf(combined_log(log).max(rods).max(cones))
}

fn log_of(luminance_cd_m2: f64) -> f64 {
    luminance_cd_m2.max(DARKEST_CD_M2).log10()
}

fn cones_log(log: f64) -> f64 {
    if log <= CONES_LOG[0] {
        -0.72
    } else if log < CONES_LOG[1] {
        (0.249 * log + 0.65).powf(2.7) - 0.72
    } else {
        log - 1.255
    }
}

fn rods_log(log: f64) -> f64 {
    if log <= RODS_LOG[0] {
        -2.86
    } else if log < RODS_LOG[1] {
        (0.405 * log + 1.6).powf(2.18) - 2.86
    } else {
        log - 0.395
    }
}

fn combined_log(log: f64) -> f64 {
    if log < CROSSING_LOG { rods_log(log) } else { cones_log(log) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Luminances over a part of the range of sight: log10 from `first` to `last`, 500 a decade.
    fn ladder(first: i32, last: i32) -> impl Iterator<Item = f64> {
        (first * 500..=last * 500).map(|step| f64::from(step) / 500.0)
    }

    #[test]
    fn it_has_the_published_values() {
        // log10 of the luminance, and of the thresholds of cones, rods and both, worked out
        // from the published pieces.
        for (log, cones, rods, both) in [
            (-5.0, -0.72, -2.86, -2.86),
            (-3.0, -0.72, -2.735_17, -2.735_17),
            (-2.0, -0.713_82, -2.261_83, -2.261_83),
            (-1.0, -0.635_18, -1.395, -1.395),
            (0.0, -0.407_49, -0.395, -0.407_49),
            (1.0, 0.030_16, 0.605, 0.030_16),
            (2.0, 0.745, 1.605, 0.745),
            (4.0, 2.745, 3.605, 2.745),
        ] {
            let light = 10f64.powf(log);
            for (got, want) in [
                (cones_cd_m2(light), cones),
                (rods_cd_m2(light), rods),
                (combined_cd_m2(light), both),
            ] {
                let error = got / 10f64.powf(want) - 1.0;
                assert!(error.abs() < 1e-3, "{log}: {} {want}", got.log10());
            }
        }
    }

    #[test]
    fn the_steps_are_where_they_are_said() {
        let step = |curve: fn(f64) -> f64, at: f64| curve(at.next_up()) - curve(at.next_down());
        assert!((step(rods_log, -1.44) + 0.0120).abs() < 5e-5, "{}", step(rods_log, -1.44));
        assert!((step(cones_log, 1.9) + 0.0031).abs() < 5e-5, "{}", step(cones_log, 1.9));
        for (curve, at) in [
            (rods_log as fn(f64) -> f64, -3.94),
            (cones_log, -2.6),
            (combined_log, -3.94),
            (combined_log, -0.0184),
        ] {
            assert!(step(curve, at).abs() < 1e-4, "{at}: {}", step(curve, at));
        }
    }

    #[test]
    fn the_better_receptor_decides() {
        for log in ladder(-6, 6) {
            let best = cones_log(log).min(rods_log(log));
            assert!((combined_log(log) - best).abs() < 1e-4, "{log}: {best}");
        }
    }

    #[test]
    fn it_can_be_had_continuous_and_never_falling() {
        let mut before = never_falling_cd_m2(0.0).log10();
        for log in ladder(-8, 8) {
            let here = never_falling_cd_m2(10f64.powf(log)).log10();
            assert!(here >= before && here - before < 0.003, "{log}: {before} {here}");
            assert!((here - combined_log(log)).abs() < 0.0121, "{log}: {here}");
            before = here;
        }
        for log in [-1.5, -1.0, 0.0, 2.5] {
            assert!(
                (never_falling_cd_m2(10f64.powf(log)).log10() - combined_log(log)).abs() < 1e-9
            );
        }
    }
}

//! What an eye is adapted to, and how long it takes.
//!
//! *Level.* [`level_cd_m2`]: the logarithmic mean of what is seen, over samples of about the fovea, veil of
//! the glare included (Ward Larson, Rushmeier & Piatko 1997). What is darker than the eye's own noise, or
//! than a thousandth of the mean light, counts as that: the black around the Moon in a telescope is no night.
//!
//! *Time.* [`Adaptation`] has three parts, each the exact solution of its equation while the scene stays,
//! so that the steps of time do not matter:
//!
//! - *Neural*, and the pupil: the logarithm of the level follows the scene exponentially, in `BRIGHTER_S` or
//!   `DARKER_S`. It stands for the fast processes of Pattanaik et al. 2000 (*SIGGRAPH*, 47), which take
//!   0.08 s in cones and 0.15 s in rods (recalled), and the pupil, which takes seconds.
//! - *Cones*: the bleached share `B` of their pigment, `dB/dt = [(1 - B) L/L0 - B] / t0` (Rushton & Henry
//!   1968, *Vision Res.* 8, 617). In the dark the logarithm of their threshold is `CONES_RAISED` `B` above its
//!   least (Dowling-Rushton; recalled), and falls in two minutes to a third.
//! - *Rods*: pigment bleaches likewise but comes back otherwise: by Lamb & Pugh 2004 (*Prog. Retin. Eye Res.*
//!   23, 307) the free opsin raises the threshold in proportion, and it falls evenly in the logarithm,
//!   by `S2_PER_MINUTE` per minute and in the end by `S3_PER_MINUTE` (S2 and S3; S3 recalled).
//!
//! The threshold is that of the better of rods and cones, each the greater of its settled threshold at the neural
//! level and of what is left by the bleaching. After a full bleach the rods take over at 7.8 minutes
//! and settle at 28, as in Hecht, Haig & Chase 1937 (*J. Gen. Physiol.* 20, 831: break at 7 to 10, settled
//! in 30 to 40). The level is that at which a settled eye has this threshold.
//!
//! *Left out.* The first moments of dazzle after dark, in which thresholds are above the settled ones (the neural
//! level lags below and [`Adaptation::threshold_factor`] is 1); afterimages; age, which slows rods by
//! some 0.02 decades per minute in ten years; that pigment bleached by a flash is not one bleached slowly.

use super::threshold::{cones_cd_m2, never_falling_cd_m2, rods_cd_m2};

/// What an eye adapts to that sees nothing, cd/m2: its own noise, about that of a starless sky.
pub const DARKEST_CD_M2: f64 = 1e-4;
/// What an eye at most adapts to, cd/m2: far above all but the Sun's disc.
pub const BRIGHTEST_CD_M2: f64 = 1e7;
/// The share of the mean light that the darkest parts of a picture count as.
const DARKEST_SHARE: f64 = 1e-3;

/// Time constants of the neural level when the scene gets brighter and darker, seconds. Chosen.
const BRIGHTER_S: f64 = 2.0;
const DARKER_S: f64 = 8.0;

/// Pigment of cones comes back with this time constant, seconds, and half is bleached at this luminance,
/// cd/m2: 10^4.3 trolands (Rushton & Henry 1968) through a pupil of 2.4 mm.
const CONES_S: f64 = 120.0;
const CONES_HALF_CD_M2: f64 = 4500.0;
/// Pigment of rods is bleached with this time constant over the light, seconds, and half of it at this
/// luminance, cd/m2: some 10^4.4 scotopic trolands (Rushton 1965, recalled), for a light of day.
const RODS_S: f64 = 400.0;
const RODS_HALF_CD_M2: f64 = 2400.0;
/// How far a full bleach raises the thresholds in the dark, decades. That of the cones is recalled; that of
/// the rods makes the rods take over after 7.8 minutes.
const CONES_RAISED: f64 = 3.0;
const RODS_RAISED: f64 = 4.06;
/// Decades per minute by which the threshold of rods falls, and the decades left where S2 gives way to S3.
const S2_PER_MINUTE: f64 = 0.24;
const S3_PER_MINUTE: f64 = 0.06;
const S3_FROM: f64 = 0.75;
/// Decades that are not told from none: the light of a starry night too bleaches a little.
const NOTHING_RAISED: f64 = 0.01;

/// Log10 of the least visible difference, cd/m2, of cones and rods in the dark (Ferwerda et al. 1996).
const CONES_LEAST: f64 = -0.72;
const RODS_LEAST: f64 = -2.86;

/// What an eye that has long seen these samples (luminance in cd/m2, and weight) is adapted to, cd/m2.
pub fn level_cd_m2(samples: &[(f64, f64)]) -> f64 {
    let counts = |sample: &&(f64, f64)| sample.0 >= 0.0 && sample.1 > 0.0 && sample.1.is_finite();
    let lit = |luminance: f64| luminance.min(BRIGHTEST_CD_M2);
    let (light, total) = samples
        .iter()
        .filter(counts)
        .fold((0.0, 0.0), |(light, total), &(l, weight)| (light + lit(l) * weight, total + weight));
    if total <= 0.0 {
        return DARKEST_CD_M2;
    }
    let darkest = DARKEST_CD_M2.max(DARKEST_SHARE * light / total);
    let logs = samples.iter().filter(counts).map(|&(l, weight)| lit(l).max(darkest).ln() * weight);
    (logs.sum::<f64>() / total).exp().clamp(DARKEST_CD_M2, BRIGHTEST_CD_M2)
}

/// The state of an eye on its way to be adapted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adaptation {
    /// The luminance that is seen now, cd/m2.
    seen_cd_m2: f64,
    /// What the retina's circuits and the pupil are set to, cd/m2.
    neural_cd_m2: f64,
    /// Shares of the pigments that are bleached.
    cones_bleached: f64,
    rods_bleached: f64,
}

impl Adaptation {
    /// An eye that has seen a luminance (cd/m2) for an hour.
    pub fn settled(luminance_cd_m2: f64) -> Adaptation {
        let seen = seen(luminance_cd_m2);
        Adaptation {
            seen_cd_m2: seen,
            neural_cd_m2: seen,
            cones_bleached: bleached(seen, CONES_HALF_CD_M2),
            rods_bleached: bleached(seen, RODS_HALF_CD_M2),
        }
    }

    /// The eye after it has seen a luminance (cd/m2) for some seconds. No time passes for less than none.
    #[must_use]
    pub fn after(self, seconds: f64, to_cd_m2: f64) -> Adaptation {
        let to = seen(to_cd_m2);
        let seconds = if seconds > 0.0 { seconds } else { 0.0 };
        let neural_s = if to > self.neural_cd_m2 { BRIGHTER_S } else { DARKER_S };
        let behind = (self.neural_cd_m2 / to).ln() * (-seconds / neural_s).exp();
        let cones_to = bleached(to, CONES_HALF_CD_M2);
        let cones_s = CONES_S / (1.0 + to / CONES_HALF_CD_M2);
        let cones_behind = (self.cones_bleached - cones_to) * (-seconds / cones_s).exp();
        Adaptation {
            seen_cd_m2: to,
            neural_cd_m2: to * behind.exp(),
            cones_bleached: cones_to + cones_behind,
            rods_bleached: self.rods_after(seconds, to),
        }
    }

    fn rods_after(self, seconds: f64, to: f64) -> f64 {
        let target = bleached(to, RODS_HALF_CD_M2);
        let now = self.rods_bleached;
        if target >= now {
            let rods_s = RODS_S / (1.0 + to / RODS_HALF_CD_M2);
            return target + (now - target) * (-seconds / rods_s).exp();
        }
        // Down S2, and what time is left down S3.
        let raised = rods_raised(now);
        let minutes = seconds / 60.0;
        let steep = minutes.min(((raised - S3_FROM) / S2_PER_MINUTE).max(0.0));
        let left = raised - S2_PER_MINUTE * steep - S3_PER_MINUTE * (minutes - steep);
        rods_bleached(left.max(0.0)).max(target)
    }

    /// What the eye is adapted to, cd/m2: a settled eye that sees this has the same threshold. Above
    /// what is seen after light, and below it in the first seconds after dark.
    pub fn level_cd_m2(self) -> f64 {
        // Tilted a little, so that the least threshold too belongs to one level only.
        let tilted = |log_threshold: f64, log: f64| log_threshold + 1e-3 * log;
        let wanted = tilted(self.log_threshold(), self.neural_cd_m2.ln());
        let (mut low, mut high) = (self.neural_cd_m2.ln(), BRIGHTEST_CD_M2.ln());
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            let settled = tilted(never_falling_cd_m2(middle.exp()).log10(), middle);
            if settled < wanted { low = middle } else { high = middle }
        }
        low.exp()
    }

    /// How many times the least visible light exceeds that of an eye settled to what is seen now; 1 or more.
    pub fn threshold_factor(self) -> f64 {
        let settled = never_falling_cd_m2(self.seen_cd_m2);
        (10f64.powf(self.log_threshold()) / settled).max(1.0)
    }

    /// Log10 of the least visible difference, cd/m2.
    fn log_threshold(self) -> f64 {
        let neural = self.neural_cd_m2;
        let cones =
            cones_cd_m2(neural).log10().max(CONES_LEAST + CONES_RAISED * self.cones_bleached);
        let rods_raised = (rods_raised(self.rods_bleached) - NOTHING_RAISED).max(0.0);
        let rods = rods_cd_m2(neural).log10().max(RODS_LEAST + rods_raised);
        cones.min(rods).max(never_falling_cd_m2(neural).log10())
    }
}

/// A luminance to which an eye can adapt, cd/m2.
fn seen(luminance_cd_m2: f64) -> f64 {
    if luminance_cd_m2 > 0.0 {
        luminance_cd_m2.clamp(DARKEST_CD_M2, BRIGHTEST_CD_M2)
    } else {
        DARKEST_CD_M2
    }
}

/// The share of a pigment that is bleached when light and recovery are even.
fn bleached(luminance_cd_m2: f64, half_cd_m2: f64) -> f64 {
    luminance_cd_m2 / (luminance_cd_m2 + half_cd_m2)
}

/// Decades by which bleached pigment raises the threshold of rods in the dark, and its inverse.
fn rods_raised(bleached: f64) -> f64 {
    (10f64.powf(RODS_RAISED) * bleached).ln_1p() / std::f64::consts::LN_10
}
fn rods_bleached(raised: f64) -> f64 {
    (raised * std::f64::consts::LN_10).exp_m1() / 10f64.powf(RODS_RAISED)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEVELS: [f64; 8] = [1e-4, 1e-3, 0.03, 1.0, 50.0, 2e3, 5e4, 1e7];

    /// Minutes in the dark after a light, and the decades of the threshold above its least.
    fn raised(after: f64, minutes: f64) -> f64 {
        Adaptation::settled(after).after(60.0 * minutes, 0.0).log_threshold() - RODS_LEAST
    }

    #[test]
    fn a_settled_eye_is_adapted_to_what_it_sees() {
        for level in LEVELS {
            let eye = Adaptation::settled(level);
            assert!((eye.level_cd_m2() / level - 1.0).abs() < 1e-9, "{level}");
            assert!((eye.threshold_factor() - 1.0).abs() < 2e-3, "{level}");
            let waited = eye.after(100.0, level);
            assert!((waited.level_cd_m2() / level - 1.0).abs() < 1e-6, "{level}");
        }
    }

    #[test]
    fn rods_take_over_after_eight_minutes_and_settle_within_thirty() {
        // A bleach of nearly all pigment. The cones come to rest at the plateau, 2.14 decades up.
        let plateau = CONES_LEAST - RODS_LEAST;
        assert!(raised(1e7, 0.0) > 8.0);
        assert!((raised(1e7, 5.0) - plateau - 0.25).abs() < 0.05, "{}", raised(1e7, 5.0));
        assert!((raised(1e7, 7.0) - plateau).abs() < 0.12);
        let slope = |minutes| raised(1e7, minutes) - raised(1e7, minutes + 1.0);
        assert!(slope(6.5) < 0.1);
        for minutes in [8.0, 10.0, 12.0] {
            assert!((slope(minutes) - 0.24).abs() < 1e-3, "{minutes}: {}", slope(minutes));
        }
        assert!((slope(16.0) - 0.06).abs() < 1e-3);
        assert!(raised(1e7, 20.0) > 0.3 && raised(1e7, 28.0) < 0.01);
    }

    #[test]
    fn less_light_takes_less_time() {
        // Minutes until the threshold is twice the least.
        let minutes =
            |after| (0..400).find(|&i| raised(after, f64::from(i) / 10.0) < 0.3).map_or(99, |i| i);
        let all = [1e7, 1e3, 100.0, 10.0, 1.0, 0.1].map(minutes);
        assert!(all.windows(2).all(|pair| pair[0] > pair[1]), "{all:?}");
        // Tenths of minutes: 21 after a full bleach, below a minute after a light as of the full Moon's sky.
        assert!((200..220).contains(&all[0]) && all[5] < 10, "{all:?}");
        // Ten seconds of a lamp cost less than ten minutes of it.
        let night = Adaptation::settled(1e-3);
        let factor = |seconds| night.after(seconds, 300.0).after(120.0, 1e-3).threshold_factor();
        assert!(factor(10.0) > 2.0 && factor(600.0) > 3.0 * factor(10.0));
    }

    #[test]
    fn light_is_adapted_to_in_seconds() {
        let eye = Adaptation::settled(1e-4).after(10.0, 1e3);
        assert!((300.0..1e3).contains(&eye.level_cd_m2()), "{}", eye.level_cd_m2());
        assert_eq!(eye.threshold_factor(), 1.0);
        let later = eye.after(20.0, 1e3);
        assert!((later.level_cd_m2() / 1e3 - 1.0).abs() < 0.01);
    }

    #[test]
    fn steps_of_time_do_not_matter_and_nothing_turns_back() {
        for from in LEVELS {
            for to in LEVELS {
                let start = Adaptation::settled(from);
                for seconds in [0.5, 5.0, 60.0, 600.0, 1500.0] {
                    let once = start.after(seconds, to);
                    let twice = start.after(0.3 * seconds, to).after(0.7 * seconds, to);
                    let off = (once.level_cd_m2() / twice.level_cd_m2() - 1.0).abs();
                    assert!(off < 1e-6, "{from} to {to}, {seconds} s: {off}");
                    let off = (once.threshold_factor() / twice.threshold_factor() - 1.0).abs();
                    assert!(off < 1e-6, "{from} to {to}, {seconds} s: factor {off}");
                }
                let levels: Vec<f64> = (0..200)
                    .map(|i| start.after(f64::from(i * i) / 20.0, to).level_cd_m2())
                    .collect();
                let way = (to / from).ln().signum();
                for pair in levels.windows(2) {
                    assert!((pair[1] / pair[0]).ln() * way > -1e-6, "{from} to {to}: {pair:?}");
                }
                assert!((levels[199] / to).ln().abs() < 0.03, "{from} to {to}: {}", levels[199]);
            }
        }
    }

    #[test]
    fn any_input_gives_a_number() {
        for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 1e300, 1e-300] {
            let eye = Adaptation::settled(odd).after(odd, odd).after(30.0, odd);
            assert!(eye.level_cd_m2() > 0.0 && eye.level_cd_m2() < 1e8, "{odd}");
            assert!(eye.threshold_factor() >= 1.0 && eye.threshold_factor() < 1e10, "{odd}");
            for samples in [vec![(odd, 1.0)], vec![(1.0, odd)], vec![(odd, odd), (2.0, 1.0)]] {
                let level = level_cd_m2(&samples);
                assert!((1e-4..=1e7).contains(&level), "{odd}: {level}");
            }
        }
        assert_eq!(level_cd_m2(&[]), DARKEST_CD_M2);
    }

    #[test]
    fn the_level_is_the_logarithmic_mean() {
        assert!((level_cd_m2(&[(10.0, 1.0), (1000.0, 1.0)]) - 100.0).abs() < 1e-9);
        assert!((level_cd_m2(&[(10.0, 3.0), (1000.0, 1.0)]) - 10f64.powf(1.5)).abs() < 1e-9);
        // The Moon, one part of 4000, hardly matters; black counts as a thousandth of the mean.
        let mut night = vec![(0.01, 1.0); 4000];
        night.push((5000.0, 1.0));
        assert!((level_cd_m2(&night) / 0.01 - 1.0).abs() < 0.01);
        assert!(
            (level_cd_m2(&[(0.0, 1.0), (4000.0, 1.0)]) / 4000.0 - 0.0005f64.sqrt()).abs() < 1e-3
        );
        assert!((level_cd_m2(&[(0.0, 1.0), (1e-6, 5.0)]) / DARKEST_CD_M2 - 1.0).abs() < 1e-9);
    }
}

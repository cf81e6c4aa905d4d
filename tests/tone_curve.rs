//! What the screen shows of scenes from noon to a moonless night.

use nocturne::eye::histogram_adjustment::{ceiling, histogram_adjustment};
use nocturne::eye::paper;
use nocturne::eye::threshold::combined_cd_m2 as threshold_cd_m2;
use nocturne::eye::tone_curve::{Screen, ToneCurve, anchor_cd_m2};

const SCREEN: Screen = Screen::with_peak(100.0);

/// Luminances evenly spread in the logarithm over a range, each of weight 1.
fn spread(from: f64, to: f64, count: usize) -> Vec<(f64, f64)> {
    let at = |i| from * (to / from).powf((i as f64 + 0.5) / count as f64);
    (0..count).map(|i| (at(i), 1.0)).collect()
}

/// The logarithmic mean of samples, as an eye that has nothing else would adapt to.
fn mean(samples: &[(f64, f64)]) -> f64 {
    let sum: f64 = samples.iter().map(|(luminance, weight)| luminance.ln() * weight).sum();
    (sum / samples.iter().map(|(_, weight)| weight).sum::<f64>()).exp()
}

fn seen(samples: &[(f64, f64)]) -> ToneCurve {
    ToneCurve::of(samples, mean(samples), SCREEN)
}

/// From 1e-9 to 1e10 cd/m2, fifty a decade.
fn ladder() -> Vec<f64> {
    (-450..=500).map(|i| 10f64.powf(f64::from(i) / 50.0)).collect()
}

fn assert_sound(curve: &ToneCurve, name: &str) {
    assert_eq!(curve.shown(0.0), 0.0, "{name}");
    for pair in ladder().windows(2) {
        let (low, high) = (curve.shown(pair[0]), curve.shown(pair[1]));
        assert!(low > 0.0 && high < 1.0, "{name}: {} is shown as {low}, {high}", pair[0]);
        assert!((high as f32) < 1.0, "{name}: {} in 32 bits", pair[1]);
        assert!(high > low, "{name}: {pair:?} are shown as {low}, {high}");
        assert!(high / low < pair[1] / pair[0] * 1.000_001, "{name}: contrast at {pair:?} grew");
    }
}

/// The slope in the logarithm between two luminances.
fn slope(curve: &ToneCurve, low: f64, high: f64) -> f64 {
    (curve.shown(high) / curve.shown(low)).ln() / (high / low).ln()
}

#[test]
#[ignore = "prints the curves"]
fn print() {
    for l in [1e-4, 1.7e-4, 1e-3, 0.02, 0.1, 1.0, 10.0, 100.0, 1000.0, 5000.0, 1e5] {
        let ward = threshold_cd_m2(50.0) / threshold_cd_m2(l) * l;
        println!("anchor {l:e}: {:.3} ward {ward:.3}", anchor_cd_m2(l, SCREEN));
    }
    let mut noon = spread(2500.0, 1e4, 4000);
    let show = |name: &str, curve: &ToneCurve, at: &[f64]| {
        let all: Vec<String> = at
            .iter()
            .map(|&l| format!("{l:.1e}:{:.4}/{:.2}", curve.shown(l), slope(curve, l, l * 1.1)))
            .collect();
        println!("{name}: {}", all.join(" "));
    };
    let at = [100., 1e3, 2500., 5000., 7000., 1e4, 1e5, 1e6, 1e8, 1.6e9, 1e10];
    show("noon", &seen(&noon), &at);
    noon.push((1.6e9, 1.0));
    show("noon+sun", &seen(&noon), &at);
    let mut night = spread(5e-3, 2e-2, 4000);
    let at = [1e-4, 1e-3, 5e-3, 1e-2, 2e-2, 4e-2, 0.1, 1., 100., 2500., 3500., 5000., 1e10];
    show("night", &seen(&night), &at);
    night.push((3500.0, 1.0));
    show("night+moon", &seen(&night), &at);
    let mut sunset = spread(0.5, 5.0, 2000);
    sunset.extend(spread(50.0, 2e4, 2000));
    show("sunset", &seen(&sunset), &[0.1, 0.5, 1., 2., 5., 20., 50., 200., 1e3, 5e3, 2e4, 1e5]);
    println!("mean {}", mean(&sunset));
    show(
        "paper sunset",
        &paper::curve(&sunset, SCREEN),
        &[0.1, 0.5, 1., 2., 5., 20., 50., 200., 1e3, 5e3, 2e4, 1e5],
    );
    show("paper night", &paper::curve(&night, SCREEN), &at);
    let dark = spread(1e-4, 3e-4, 4000);
    show("dark", &seen(&dark), &[1e-6, 1e-5, 1e-4, 1.7e-4, 3e-4, 1e-3, 1e-2, 0.1, 1.0, 1e3]);
    let mut half = spread(1e-4, 3e-4, 4000);
    half.extend(spread(1e-5, 2e-5, 2000));
    let c = ToneCurve::of(&half, 1.5e-4, SCREEN);
    show("dark+ground", &c, &[1e-6, 1e-5, 2e-5, 1e-4, 1.7e-4, 3e-4, 1e-3, 1e-2]);
}

#[test]
#[ignore = "measures, and prints"]
fn time() {
    let samples = spread(1e-3, 1e5, 32_000);
    let start = std::time::Instant::now();
    let mut sum = 0.0;
    for _ in 0..100 {
        sum += ToneCurve::of(&samples, 10.0, SCREEN).shown(10.0);
    }
    println!("ToneCurve::of {:.3} ms", start.elapsed().as_secs_f64() * 10.0);
    let start = std::time::Instant::now();
    for _ in 0..100 {
        sum += histogram_adjustment(&samples, SCREEN).shown(10.0);
    }
    println!("histogram_adjustment {:.3} ms", start.elapsed().as_secs_f64() * 10.0);
    let curve = ToneCurve::of(&samples, 10.0, SCREEN);
    let start = std::time::Instant::now();
    for _ in 0..30 {
        sum += samples.iter().map(|(l, _)| curve.shown(*l)).sum::<f64>();
    }
    println!("shown {:.1} ns, {sum}", start.elapsed().as_secs_f64() / 960_000.0 * 1e9);
}

#[test]
fn the_ceiling_is_as_published() {
    // By day both thresholds are in proportion: a bin may hold its width's share of the screen's range.
    let even = ceiling(1000.0, 90.0, 0.1, 5.0);
    assert!((even / 0.02 - 1.0).abs() < 1e-12, "{even}");
    // At 0.01 cd/m2 an eye sees steps of 0.0059 cd/m2, of 59 %; at 50 cd/m2 on the screen of 6.2 %.
    let night = ceiling(0.01, 50.0, 0.1, 5.0);
    let by_hand = 10f64.powf((0.249 * 50f64.log10() + 0.65).powf(2.7) - 0.72)
        / 50.0
        / (10f64.powf((0.405 * -2.0 + 1.6f64).powf(2.18) - 2.86) / 0.01)
        * 0.02;
    assert!((night / by_hand - 1.0).abs() < 1e-9, "{night} {by_hand}");
}

#[test]
fn what_is_adapted_to_is_shown_darker_by_night() {
    let shown = |luminance| anchor_cd_m2(luminance, SCREEN);
    assert!((0.3..0.6).contains(&shown(1.7e-4)), "{}", shown(1.7e-4));
    assert!((4.0..7.0).contains(&shown(0.02)), "{}", shown(0.02));
    assert!((50.0..60.0).contains(&shown(5000.0)), "{}", shown(5000.0));
    for pair in ladder().windows(2).filter(|pair| pair[0] > 1e-6 && pair[1] < 1e8) {
        // The published thresholds jump by a thousandth where their pieces meet.
        assert!(shown(pair[1]) > shown(pair[0]) * 0.9995, "{pair:?}");
    }
}

#[test]
fn from_noon_to_night_every_step_is_darker() {
    let mut before = f64::INFINITY;
    for step in 0..19 {
        let middle = 8000.0 * 10f64.powf(-0.4 * f64::from(step));
        let samples = spread(middle / 2.0, middle * 2.0, 4000);
        let curve = seen(&samples);
        assert_sound(&curve, &format!("{middle}"));
        let shown = curve.shown(middle);
        assert!(shown < before * 0.995, "{middle} is shown as {shown} after {before}");
        before = shown;
        let (low, high) = (curve.shown(middle / 2.0), curve.shown(middle * 2.0));
        assert!(low > 0.001 && high < 0.9, "{middle}: {low} to {high}");
    }
    assert!(before < 0.009, "{before}");
}

#[test]
fn the_moon_shows_her_seas_over_a_sky_that_stays() {
    let mut samples = spread(0.005, 0.02, 4000);
    let without = seen(&samples);
    samples.push((3500.0, 1.0));
    let with = seen(&samples);
    assert_sound(&with, "with the Moon");
    let (seas, highlands) = (with.shown(2500.0), with.shown(5000.0));
    assert!(highlands > 1.1 * seas, "{seas} {highlands}");
    assert!(slope(&with, 2500.0, 3500.0) > 0.3);
    for sky in [0.005, 0.01, 0.02] {
        let change = with.shown(sky) / without.shown(sky);
        assert!((1.0 / 1.5..1.5).contains(&change), "{sky}: {change}");
    }
}

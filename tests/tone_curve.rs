//! What the screen shows of scenes from noon to a moonless night.

use nocturne::eye::histogram_adjustment::{ceiling, histogram_adjustment};
use nocturne::eye::paper;
use nocturne::eye::threshold::combined_cd_m2 as threshold_cd_m2;
use nocturne::eye::tone_curve::{Screen, ToneCurve, anchor_cd_m2};

const SCREEN: Screen = Screen::with_peak(100.0);

/// Luminances evenly spread in the logarithm over a range, each of weight 1.
fn spread(from: f64, to: f64, count: usize) -> Samples {
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
fn the_ceiling_is_as_published() {
    // By day both thresholds are in proportion: a bin may hold its width's share of the screen's range.
    let even = ceiling(1000.0, 90.0, 0.1, 5.0);
    assert!((even / 0.02 - 1.0).abs() < 1e-12, "{even}");
    // At 0.01 cd/m2 an eye sees steps of 0.0055 cd/m2, of 55 %; at 50 cd/m2 on the screen of 6.2 %.
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
    for pair in ladder().windows(2).filter(|pair| pair[0] > 1e-6 && pair[1] < 1e6) {
        // Steps of 4.7 %: never darker, and no jump.
        let grows = shown(pair[1]) / shown(pair[0]);
        assert!(grows > 1.001 && grows < 1.047, "{pair:?}: {grows}");
    }
}

#[test]
fn from_noon_to_night_every_step_is_darker() {
    let mut before = f64::INFINITY;
    for step in 0..20 {
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
    assert!(before < 0.005, "{before}");
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

/// Luminances in cd/m2 and their weights.
type Samples = Vec<(f64, f64)>;

/// Scenes of all kinds, and what the eye is adapted to in them, cd/m2.
fn scenes() -> Vec<(&'static str, Samples, f64)> {
    let with = |mut samples: Vec<(f64, f64)>, more: &[(f64, f64)]| {
        samples.extend_from_slice(more);
        samples
    };
    let sunset = with(spread(0.5, 50.0, 2000), &spread(50.0, 2e4, 2000));
    let noon = spread(2500.0, 1e4, 4000);
    let night = spread(1e-4, 4e-4, 4000);
    vec![
        ("noon", noon.clone(), 5000.0),
        ("noon with the Sun", with(noon.clone(), &[(1.6e9, 1.0)]), 5000.0),
        ("sunset", sunset.clone(), mean(&sunset)),
        ("moonlit", with(spread(5e-3, 2e-2, 4000), &[(3500.0, 1.0)]), 0.01),
        ("moonless over dark ground", with(night.clone(), &spread(3e-6, 3e-5, 3000)), 1.5e-4),
        ("moonless with a lamp", with(night.clone(), &[(1e4, 1.0)]), 2e-4),
        ("night for an eye of day", night, 5000.0),
        ("day for an eye of night", noon, 2e-4),
    ]
}

#[test]
fn every_scene_is_shown_from_black_to_white() {
    for (name, samples, adapted) in scenes() {
        let curve = ToneCurve::of(&samples, adapted, SCREEN);
        assert_sound(&curve, name);
        let brightest = samples.iter().fold(0.0, |high: f64, sample| high.max(sample.0));
        assert!(curve.shown(brightest) < 0.8502, "{name}: {}", curve.shown(brightest));
    }
    // An eye of day sees nothing at night; an eye of night is dazzled by day, but not blind.
    let shown = |adapted: f64, luminance: f64| {
        ToneCurve::of(&spread(luminance / 2.0, 2.0 * luminance, 400), adapted, SCREEN)
            .shown(luminance)
    };
    assert!(shown(5000.0, 2e-4) < 1e-6);
    assert!(shown(2e-4, 5000.0) > 0.35, "{}", shown(2e-4, 5000.0));
}

#[test]
fn a_scene_that_fits_is_shown_in_proportion() {
    for middle in [2e-4, 0.01, 1.0] {
        let curve = seen(&spread(middle / 2.0, middle * 2.0, 1000));
        for (low, high) in [(0.5, 1.0), (1.0, 2.0)] {
            let slope = slope(&curve, middle * low, middle * high);
            assert!((slope - 1.0).abs() < 1e-9, "{middle}: {slope}");
        }
        let anchor = anchor_cd_m2(middle, SCREEN) / 100.0;
        assert!((curve.shown(middle) / anchor - 1.0).abs() < 1e-9, "{middle}");
    }
}

#[test]
fn ground_and_sky_both_show_at_sunset() {
    let (_, samples, adapted) = scenes().swap_remove(2);
    let curve = ToneCurve::of(&samples, adapted, SCREEN);
    assert!(curve.shown(0.5) > 0.001, "the darkest ground: {}", curve.shown(0.5));
    assert!(curve.shown(10.0) > 0.03, "{}", curve.shown(10.0));
    for (low, high) in [(0.5, 5.0), (5.0, 50.0), (50.0, 500.0), (500.0, 5e3), (5e3, 2e4)] {
        let slope = slope(&curve, low, high);
        assert!(slope > 0.2, "{low} to {high}: {slope}");
    }
    // The Sun's disc in a sample of its own leaves a noon sky most of its contrast.
    let (_, samples, adapted) = scenes().swap_remove(1);
    let curve = ToneCurve::of(&samples, adapted, SCREEN);
    assert!(slope(&curve, 2500.0, 5000.0) > 0.8 && slope(&curve, 5000.0, 1e4) > 0.5);
    assert!(curve.shown(1.6e9) > 0.8);
}

/// The most by which one of the luminances changes on the screen, as a factor.
fn change(a: &ToneCurve, b: &ToneCurve, luminances: impl Iterator<Item = f64>) -> f64 {
    luminances.map(|l| (a.shown(l) / b.shown(l)).ln().abs()).fold(0.0, f64::max).exp()
}

#[test]
fn small_changes_of_the_scene_change_the_picture_little() {
    for (name, samples, adapted) in scenes() {
        let curve = ToneCurve::of(&samples, adapted, SCREEN);
        let low = samples.iter().fold(f64::INFINITY, |low: f64, sample| low.min(sample.0));
        let high = samples.iter().fold(0.0, |high: f64, sample| high.max(sample.0));
        // One part in a hundred more, somewhere among the others.
        let mut more = samples.clone();
        more.extend(std::iter::repeat_n((low * (high / low).powf(0.3), 1.0), samples.len() / 100));
        let there = || samples.iter().map(|sample| sample.0);
        let changed = change(&curve, &ToneCurve::of(&more, adapted, SCREEN), there());
        assert!(changed < 1.25, "{name}: 1 % more change by {changed}");
        // All light, and the eye with it, 1 % brighter.
        let brighter: Vec<_> = samples.iter().map(|(l, weight)| (1.01 * l, *weight)).collect();
        let next = ToneCurve::of(&brighter, 1.01 * adapted, SCREEN);
        for l in ladder().into_iter().filter(|l| (low..=high).contains(l)) {
            let ratio = next.shown(1.01 * l) / curve.shown(l);
            assert!((ratio - 1.0).abs() < 0.012, "{name}: {l} changes by {ratio}");
        }
        // The eye alone.
        let other = ToneCurve::of(&samples, 1.01 * adapted, SCREEN);
        assert!(change(&curve, &other, there()) < 1.03, "{name}: the eye changes it");
    }
}

#[test]
fn a_light_that_grows_changes_the_picture_smoothly() {
    // One sample of 4000 from the night sky to the Sun, 2 % at a time.
    let sky = spread(1e-4, 4e-4, 4000);
    let mut before: Option<ToneCurve> = None;
    for step in 0..1480 {
        let light = 3e-4 * 1.02f64.powi(step);
        let mut samples = sky.clone();
        samples.push((light, 1.0));
        let curve = ToneCurve::of(&samples, 2e-4, SCREEN);
        if let Some(before) = before {
            let changed = change(&curve, &before, ladder().into_iter().filter(|l| *l < light));
            assert!(changed < 1.03, "{light}: {changed}");
            let sky = change(&curve, &before, [1e-4, 2e-4, 4e-4].into_iter());
            assert!(sky < 1.005, "{light}: the sky by {sky}");
        }
        before = Some(curve);
    }
}

#[test]
fn any_input_gives_a_curve() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 1e-300, 1e-12, 1e12, 1e300];
    for a in odd {
        for b in odd {
            for samples in
                [vec![], vec![(a, 1.0)], vec![(a, b)], vec![(a, 1.0), (b, 1.0), (1.0, 1.0)]]
            {
                for adapted in [a, b, 0.01] {
                    assert_sound(
                        &ToneCurve::of(&samples, adapted, SCREEN),
                        &format!("{samples:?}"),
                    );
                }
                let paper = paper::curve(&samples, SCREEN);
                for luminance in ladder().into_iter().chain(odd) {
                    let shown = paper.shown(luminance);
                    assert!((0.0..1.0).contains(&shown), "{samples:?}: {luminance}: {shown}");
                }
            }
            let screen = Screen { peak_cd_m2: a, black_cd_m2: b };
            assert_sound(&ToneCurve::of(&[(1.0, 1.0)], 1.0, screen), &format!("{screen:?}"));
        }
    }
    for luminance in [f64::NAN, f64::NEG_INFINITY, -1.0] {
        assert_eq!(seen(&[(1.0, 1.0)]).shown(luminance), 0.0);
    }
    assert!(seen(&[(1.0, 1.0)]).shown(f64::INFINITY) < 1.0);
}

#[test]
fn screens_of_other_peaks_are_as_bright_as_they_can() {
    for peak in [10.0, 80.0, 300.0, 1000.0] {
        let screen = Screen::with_peak(peak);
        for (name, samples, adapted) in scenes() {
            assert_sound(&ToneCurve::of(&samples, adapted, screen), &format!("{name} at {peak}"));
        }
        let noon = anchor_cd_m2(5000.0, screen) / peak;
        assert!((0.45..0.75).contains(&noon), "{peak}: {noon}");
    }
}

#[test]
fn the_published_curve_fills_the_screen_and_stays_below_its_ceiling() {
    // A range of 1e5 on a screen of 1e3, all bins alike.
    let samples = spread(0.1, 1e4, 10_000);
    let curve = histogram_adjustment(&samples, SCREEN);
    assert!((curve.shown(0.1) / 0.001 - 1.0).abs() < 0.1, "{}", curve.shown(0.1));
    assert!((curve.shown(1e4) - 1.0).abs() < 0.02, "{}", curve.shown(1e4));
    assert!((curve.shown(1e-5) / 0.001 - 1.0).abs() < 1e-9 && curve.shown(1e9) > 0.999_99);
    // What the screen adds in contrast is never above what the thresholds allow, but for the 2.5 %.
    let mut above = 0;
    for (luminance, _) in &samples {
        let shown = 100.0 * curve.shown(*luminance);
        let steps = slope(&curve, *luminance, luminance * 1.001) * shown / luminance;
        let allowed = threshold_cd_m2(shown) / threshold_cd_m2(*luminance);
        above += usize::from(steps > 1.1 * allowed);
    }
    assert!(above <= samples.len() / 20, "{above}");
}

#[test]
fn the_published_curve_discounts_what_is_empty() {
    // Two fields, five decades apart.
    let mut samples = spread(0.1, 1.0, 5000);
    samples.extend(spread(1e5, 1e6, 5000));
    let curve = histogram_adjustment(&samples, SCREEN);
    assert!(slope(&curve, 2.0, 5e4) < 0.01);
    assert!(slope(&curve, 0.15, 0.7) > 0.5 && slope(&curve, 2e5, 7e5) > 0.5);
}

#[test]
fn the_published_curve_is_linear_where_the_screen_has_the_range() {
    // By the ratio of thresholds at 50 cd/m2, 3.09, and at the mean of 0.01 cd/m2, 0.00547.
    let curve = histogram_adjustment(&spread(0.005, 0.02, 1000), SCREEN);
    let shown = 100.0 * curve.shown(0.01);
    assert!((shown / 5.65 - 1.0).abs() < 0.005, "{shown}");
    assert!((curve.shown(0.004) / curve.shown(0.016) - 0.25).abs() < 1e-9);
    assert!(curve.shown(1.0) > 0.999_99);
}

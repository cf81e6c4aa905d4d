//! Histogram adjustment as published, with the ceiling of human contrast sensitivity.
//!
//! *Source.* Ward Larson, Rushmeier & Piatko 1997, *IEEE TVCG* 3, 291, sections 4.2 to 4.4; constants as in their
//! own program, `pcond` of Radiance (`pcond3.c`). The brightness on the screen, `Bd = ln Ld`, follows the
//! cumulative histogram `P` of the brightness `b = ln L` of the foveal samples (Eq. 4 of the paper, recalled):
//!
//! `Bd = ln Ldmin + (ln Ldmax - ln Ldmin) P(b)`.
//!
//! No bin may hold so much that a difference invisible in the scene would show on the screen:
//! `dLd/dL <= dLt(Ld) / dLt(L)`, which makes the ceiling of a bin of width `db` among `T` samples
//!
//! `f(b) <= [dLt(Ld) / dLt(L)] T db L / ((ln Ldmax - ln Ldmin) Ld)`.
//!
//! What is above is trimmed, and all is done anew until no more than `TOLERANCE` of the samples is trimmed at
//! once. If as little is left of them all, or the scene's range is no more than the screen's, the scene is shown
//! in proportion, by the scale of Ward 1994: `dLt(Lda) / dLt(La)`, `Lda` half the peak, `La` the
//! samples' logarithmic mean.
//!
//! *How we differ.* Nothing is random: `pcond` adds samples at random points. Samples at the very
//! ends of the range are counted, theirs are not. Its linear case takes the geometric mean of white and black for
//! `Lda`, the paper half the peak, as we do. The screen's white is shown as `WHITE`.

use super::threshold::combined_cd_m2 as threshold_cd_m2;
use super::tone_curve::{Below, Screen, ToneCurve};

/// Bins of the histogram.
const BINS: usize = 100;
/// What is darker or brighter than this is not told apart, cd/m2.
const RANGE_CD_M2: [f64; 2] = [1e-7, 1e7];
/// The share of the samples that may stay above the ceiling.
const TOLERANCE: f64 = 0.025;
/// The share of the peak that is shown as white: below 1, as every tone curve is.
const WHITE: f64 = 1.0 - 1e-6;
/// Rounds of trimming. Each but the last takes a fortieth of the samples or more.
const MOST_ROUNDS: usize = 50;

/// The curve for samples (luminance in cd/m2, and weight), as published.
pub fn histogram_adjustment(samples: &[(f64, f64)], screen: Screen) -> ToneCurve {
    let screen = screen.sane();
    let Some(scene) = Scene::of(samples) else {
        return linear(RANGE_CD_M2[0], screen);
    };
    let shown_range = (screen.peak_cd_m2 / screen.black_cd_m2).ln();
    if scene.range() <= shown_range {
        return linear(scene.mean_cd_m2, screen);
    }
    let mut bins = scene.bins.clone();
    // The curve that a round was tested with is the one it ends with.
    let mut edges = Vec::new();
    for _ in 0..MOST_ROUNDS {
        let total: f64 = bins.iter().sum();
        if total <= TOLERANCE * scene.total() {
            return linear(scene.mean_cd_m2, screen);
        }
        edges = shown(&bins, screen);
        let mut trimmed = 0.0;
        for (i, bin) in bins.iter_mut().enumerate() {
            let luminance = scene.middle(i).exp();
            let on_screen = (0.5 * (edges[i] + edges[i + 1])).exp() * screen.peak_cd_m2;
            let most = total * ceiling(luminance, on_screen, scene.step(), shown_range);
            trimmed += (*bin - most).max(0.0);
            *bin = bin.min(most);
        }
        if trimmed <= TOLERANCE * scene.total() {
            break;
        }
    }
    ToneCurve::through(scene.darkest, scene.step(), &edges, Below::Held)
}

/// The share of the samples that a bin of the histogram may hold: at the luminance in the scene and on the
/// screen in cd/m2, the bin's width and the range of the screen in e-folds.
pub fn ceiling(luminance_cd_m2: f64, shown_cd_m2: f64, bin: f64, screen_range: f64) -> f64 {
    threshold_cd_m2(shown_cd_m2) / threshold_cd_m2(luminance_cd_m2) * bin * luminance_cd_m2
        / (screen_range * shown_cd_m2)
}

/// The histogram of the samples' brightness.
struct Scene {
    bins: Vec<f64>,
    /// Natural logarithms of cd/m2: where the first bin begins and the last ends.
    darkest: f64,
    brightest: f64,
    mean_cd_m2: f64,
}

impl Scene {
    fn of(samples: &[(f64, f64)]) -> Option<Scene> {
        let [least, most] = RANGE_CD_M2;
        let lit = samples
            .iter()
            .filter(|(luminance, weight)| *luminance > 0.0 && *weight > 0.0 && weight.is_finite());
        let logs: Vec<(f64, f64)> =
            lit.map(|&(luminance, weight)| (luminance.clamp(least, most).ln(), weight)).collect();
        let total: f64 = logs.iter().map(|(_, weight)| weight).sum();
        if total <= 0.0 || !total.is_finite() {
            return None;
        }
        let lowest = logs.iter().fold(f64::INFINITY, |low, (log, _)| low.min(*log));
        let brightest = logs.iter().fold(lowest, |high, (log, _)| high.max(*log)) + 1.01f64.ln();
        // One more bin at the bottom, to share the lowest samples, unless the range ends there.
        let bottom = lowest > least.ln() + 1e-6;
        let wider = BINS as f64 / (BINS - 1) as f64;
        let range = (brightest - lowest) * if bottom { wider } else { 1.0 };
        let darkest = brightest - range;
        let mut bins = vec![0.0; BINS];
        for (log, weight) in &logs {
            let bin = ((log - darkest) / range * BINS as f64) as usize;
            bins[bin.min(BINS - 1)] += weight;
        }
        if bottom {
            bins[1] *= 0.5;
            bins[0] += bins[1];
        }
        let mean = logs.iter().map(|(log, weight)| log * weight).sum::<f64>() / total;
        Some(Scene { bins, darkest, brightest, mean_cd_m2: mean.exp() })
    }

    fn range(&self) -> f64 {
        self.brightest - self.darkest
    }

    fn step(&self) -> f64 {
        self.range() / BINS as f64
    }

    fn middle(&self, bin: usize) -> f64 {
        self.darkest + (bin as f64 + 0.5) * self.step()
    }

    fn total(&self) -> f64 {
        self.bins.iter().sum()
    }
}

/// The logarithm of the share of the peak at the edges of the bins.
fn shown(bins: &[f64], screen: Screen) -> Vec<f64> {
    let black = (screen.black_cd_m2 / screen.peak_cd_m2).ln();
    let white = WHITE.ln();
    let total: f64 = bins.iter().sum();
    let mut sum = 0.0;
    let mut edges = vec![black];
    edges.extend(bins.iter().map(|bin| {
        sum += bin;
        black + (white - black) * (sum / total).min(1.0)
    }));
    edges
}

/// In proportion to the light, by visibility matching (Ward 1994), up to the screen's white.
fn linear(mean_cd_m2: f64, screen: Screen) -> ToneCurve {
    let scale = threshold_cd_m2(screen.adaptation_cd_m2())
        / threshold_cd_m2(mean_cd_m2)
        / screen.peak_cd_m2;
    let white = WHITE.ln();
    ToneCurve::through(white - scale.ln() - 1.0, 1.0, &[white - 1.0, white], Below::Linear)
}

//! The tone curve: how bright the screen shows a luminance.
//!
//! *Theory.* Two ideas of Ward. A difference that an eye can just tell in the scene is shown as one that
//! the viewer can just tell on the screen (Ward 1994, *Graphics Gems IV*, VII.2): what the eye is adapted
//! to, `La`, is shown as `dLt(Lda) / dLt(La) La`, where `dLt` is the least visible difference and `Lda` half
//! the screen's peak. And where a scene has more range than the screen, the stretches of its histogram
//! where nothing is are given up first (Ward Larson, Rushmeier & Piatko 1997, *IEEE TVCG* 3, 291; as
//! published in [`histogram_adjustment`](super::histogram_adjustment)).
//!
//! *How we differ.* Their curve spreads each scene over the whole screen: every night would be as bright as
//! day, and frames of a film would flicker. [`ToneCurve::of`] is continuous in all its input, and absolute:
//!
//! 1. *Anchor.* `La` is shown at [`anchor_cd_m2`]. Ward's product is level where Weber's law holds, so that
//!    noon and dusk would look the same; we keep `VISIBILITY` of its range in the logarithm, and add the
//!    power `BRIGHTNESS` of the luminance. Chosen so that a moonless sky is just above a screen's black,
//!    0.3 cd/m2 of 100, and noon is where Ward has it, at 55. By day ten times the light is shown 12 % brighter.
//! 2. *Slope.* In the logarithm the slope is at most 1: contrast is never exaggerated, and what fits is shown
//!    linearly. What does not fit, above the anchor or below, is given the slopes `min(1, kappa p^GAMMA)`, where
//!    `p` is the share of the picture per e-fold of luminance, and `kappa` is such that it just fits.
//!    The small `GAMMA` is because one looks at what is bright however small it is: the Moon
//!    is one part of thousands and still has her seas. Where nothing is, `p` is `EMPTY`. Where
//!    much of the picture would be flattened so, the anchor gives way (`YIELDING`).
//! 3. *Ends.* The brightest sample is shown at `TOP_SHARE` of the peak or below; what is brighter
//!    (smaller than a sample) approaches the peak and never reaches it. Below the darkest sample the
//!    curve is linear, down to 0 at 0. What is too dark to be told from black takes no part in 2.
//!
//! *Left out.* The retina adapts in each place on its own; here what is far from `La` keeps its contrast in its
//! own place of the range instead, so that for the seconds in which an eye of night looks at
//! a day, the day is pale and not all white. The screen is taken to be seen in the dark.
//!
//! The constants of 1 to 3 are chosen, not measured. Slopes are smoothed, so that no edge shows in a gradient;
//! this can lower the curve by up to 10 %, where the brightest would otherwise be above its place.

use super::threshold::never_falling_cd_m2 as threshold_cd_m2;

/// What a screen can show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screen {
    /// Luminance of its white, cd/m2.
    pub peak_cd_m2: f64,
    /// Luminance of its black, cd/m2.
    pub black_cd_m2: f64,
}

impl Screen {
    /// A screen of this white, whose black is a thousandth of it.
    pub const fn with_peak(peak_cd_m2: f64) -> Screen {
        Screen { peak_cd_m2, black_cd_m2: peak_cd_m2 / 1000.0 }
    }

    /// The nearest screen that could exist: white of 1 to 1e5 cd/m2, black of 1e-6 to 0.1 of it.
    pub(super) fn sane(self) -> Screen {
        let peak = if self.peak_cd_m2 > 0.0 { self.peak_cd_m2.clamp(1.0, 1e5) } else { 100.0 };
        let black = if self.black_cd_m2 > 0.0 { self.black_cd_m2 } else { 0.0 };
        Screen { peak_cd_m2: peak, black_cd_m2: black.clamp(peak * 1e-6, peak * 0.1) }
    }

    /// What the viewer of the screen is adapted to, cd/m2: half its white (Ward 1994).
    pub fn adaptation_cd_m2(self) -> f64 {
        self.peak_cd_m2 / 2.0
    }

    /// Black as a share of the peak, in the natural logarithm.
    fn log_black(self) -> f64 {
        (self.black_cd_m2 / self.peak_cd_m2).ln()
    }
}

impl Default for Screen {
    fn default() -> Self {
        Screen::with_peak(100.0)
    }
}

/// The share of the range of Ward's product that the anchor keeps, in the logarithm.
const VISIBILITY: f64 = 0.85;
/// The power of luminance by which what is brighter is shown brighter, whatever can be told apart.
const BRIGHTNESS: f64 = 0.05;
/// The luminance where the anchor is as Ward has it, cd/m2: noon at sea level.
const NOON_CD_M2: f64 = 5000.0;
/// The anchor approaches this share of the peak and stays below it.
const ANCHOR_LIMIT: f64 = 0.75;
/// How late it starts to: at noon it is 1 % below what it would be.
const ANCHOR_KNEE: f64 = 8.0;
/// No eye is adapted to less or more than this, cd/m2.
const ADAPTED_CD_M2: [f64; 2] = [1e-6, 1e8];

/// How the slope follows the share of the picture.
const GAMMA: f64 = 0.3;
/// The share of the picture per e-fold where nothing is.
const EMPTY: f64 = 2e-6;
/// A stretch is empty in full only if beyond it there is this share of the picture.
const BEYOND: f64 = 1e-4;
/// The share of the peak at which the brightest sample is shown at most.
const TOP_SHARE: f64 = 0.85;
/// From this share of the peak on, what is brighter than any sample is compressed.
const SHOULDER_SHARE: f64 = 0.3;
/// How far the anchor gives way, in e-folds, where the picture would lose all of its contrast on one side of
/// it; this goes with the cube of what it loses.
const YIELDING: f64 = 8.0;
/// No slope is less.
const LEAST_SLOPE: f64 = 1e-4;
/// The range below the anchor has at least this much room, in e-folds, be it below the screen's black.
const LEAST_ROOM: f64 = 0.7;
/// Black to an adapted eye: this share of what it is adapted to, and this luminance in cd/m2 (the faintest
/// large field that is seen at all is about 1e-6 cd/m2, recalled). From there to [`FADE`] e-folds above,
/// samples count in part.
const BLACK_SHARE: f64 = 1e-4;
const BLACK_CD_M2: f64 = 3e-6;
const FADE: f64 = std::f64::consts::LN_10;

/// Nodes of the curve in the natural logarithm of cd/m2: the first, the step, and how many.
/// They go from 1e-7 to 1e12 cd/m2.
const FIRST: f64 = -16.118;
const STEP: f64 = 0.1;
const NODES: usize = 439;
/// Passes of \[1 2 1\]/4 over the histogram (it spreads by 0.17 e-folds) and over the slopes (by 0.28).
const HISTOGRAM_PASSES: usize = 6;
const SLOPE_PASSES: usize = 16;

/// The luminance on the screen of what an eye is adapted to, cd/m2; both in cd/m2.
pub fn anchor_cd_m2(adaptation_cd_m2: f64, screen: Screen) -> f64 {
    let screen = screen.sane();
    let [least, most] = ADAPTED_CD_M2;
    let adapted = if adaptation_cd_m2 > 0.0 { adaptation_cd_m2.clamp(least, most) } else { least };
    let matched = |luminance: f64| luminance / threshold_cd_m2(luminance);
    let noon = threshold_cd_m2(screen.adaptation_cd_m2()) * matched(NOON_CD_M2);
    let shown = noon
        * (matched(adapted) / matched(NOON_CD_M2)).powf(VISIBILITY)
        * (adapted / NOON_CD_M2).powf(BRIGHTNESS);
    let limit = ANCHOR_LIMIT * screen.peak_cd_m2;
    shown / (1.0 + (shown / limit).powf(ANCHOR_KNEE)).powf(1.0 / ANCHOR_KNEE)
}

/// How bright the screen shows a luminance.
#[derive(Debug, Clone, PartialEq)]
pub struct ToneCurve {
    /// Natural logarithm of the luminance of the first node, and nodes per e-fold.
    first: f64,
    nodes_per_fold: f64,
    /// Between a node and the next: logarithm of the share of the peak, and its first and second
    /// coefficient in the distance from the node, in steps.
    pieces: Vec<[f64; 3]>,
    below: Below,
    above: Above,
}

/// What is darker than the first node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Below {
    /// In proportion to its light.
    Linear,
    /// As the first node.
    Held,
}

/// What is brighter than the curve's end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Above {
    /// As the end of the last piece.
    Held,
    /// From `start` on (logarithm of the luminance), where the logarithm of the share of the peak is
    /// `-room` and its slope is `slope`.
    Shoulder { start: f64, room: f64, slope: f64 },
}

impl Above {
    /// The logarithm of the share of the peak, strictly growing and always below 0.
    fn log_share(room: f64, slope: f64, beyond: f64) -> f64 {
        // As it was until not much room is left.
        let knee = room.min(-SHOULDER_SHARE.ln());
        let straight = (room - knee) / slope;
        if beyond < straight {
            return slope * beyond - room;
        }
        -knee * (1.0 + slope * (beyond - straight) / (2.0 * knee)).powi(-2)
    }
}

impl ToneCurve {
    /// The curve for an eye that sees `samples` (luminance in cd/m2, veil of the glare included, and
    /// weight: its solid angle in any unit), and is adapted to a luminance in cd/m2. Samples without a
    /// meaning (not a number, no weight) are left out; the curve is good for any input.
    pub fn of(samples: &[(f64, f64)], adaptation_cd_m2: f64, screen: Screen) -> ToneCurve {
        let screen = screen.sane();
        let [least, most] = ADAPTED_CD_M2;
        let adapted = if adaptation_cd_m2 > 0.0 { adaptation_cd_m2 } else { least };
        let anchor = Anchor {
            at: adapted.clamp(least, most).ln(),
            shown: (anchor_cd_m2(adapted, screen) / screen.peak_cd_m2).ln(),
        };
        let histogram = Histogram::of(samples, anchor.at);
        let (slopes, anchor_shown) = slopes(&histogram, anchor, screen);
        let top = histogram.brightest;

        // Trapezia: between nodes the slope is linear, so that the curve has no corner.
        let mut pieces = Vec::with_capacity(NODES);
        let mut log_shown = 0.0;
        for pair in slopes.windows(2) {
            let (slope, bend) = (pair[0] * STEP, (pair[1] - pair[0]) * (STEP / 2.0));
            pieces.push([log_shown, slope, bend]);
            log_shown += slope + bend;
        }
        let mut curve = ToneCurve {
            first: FIRST,
            nodes_per_fold: 1.0 / STEP,
            pieces,
            below: Below::Linear,
            above: Above::Held,
        };
        let up = anchor_shown - curve.log_shown(anchor.at);
        let excess = (curve.log_shown(top) + up - TOP_SHARE.ln()).max(0.0);
        for piece in &mut curve.pieces {
            piece[0] += up - excess;
        }
        let room = -curve.log_shown(top);
        curve.above = Above::Shoulder { start: top, room, slope: curve.slope(top) };
        curve
    }

    /// A curve through the points `shown` (natural logarithm of the share of the peak), straight between
    /// them, at evenly spaced logarithms of luminance.
    pub(super) fn through(first: f64, step: f64, shown: &[f64], below: Below) -> ToneCurve {
        let piece = |pair: &[f64]| [pair[0], pair[1] - pair[0], 0.0];
        ToneCurve {
            first,
            nodes_per_fold: 1.0 / step,
            pieces: shown.windows(2).map(piece).collect(),
            below,
            above: Above::Held,
        }
    }

    /// The luminance on the screen as a share of its peak, 0 to below 1, of a luminance in cd/m2.
    pub fn shown(&self, luminance_cd_m2: f64) -> f64 {
        if luminance_cd_m2 > 0.0 {
            self.log_shown(luminance_cd_m2.min(1e30).ln()).exp()
        } else {
            0.0
        }
    }

    /// Logarithm of the share of the peak at a logarithm of luminance.
    fn log_shown(&self, log_luminance: f64) -> f64 {
        if let Above::Shoulder { start, room, slope } = self.above
            && log_luminance > start
        {
            return Above::log_share(room, slope, log_luminance - start);
        }
        let nodes = (log_luminance - self.first) * self.nodes_per_fold;
        if nodes < 0.0 {
            let [first, ..] = self.pieces[0];
            return match self.below {
                Below::Linear => first + (log_luminance - self.first),
                Below::Held => first,
            };
        }
        let piece = (nodes as usize).min(self.pieces.len() - 1);
        let along = (nodes - piece as f64).min(1.0);
        let [start, slope, bend] = self.pieces[piece];
        start + along * (slope + along * bend)
    }

    /// The slope in the logarithm, within the pieces.
    fn slope(&self, log_luminance: f64) -> f64 {
        let nodes = ((log_luminance - self.first) * self.nodes_per_fold).max(0.0);
        let piece = (nodes as usize).min(self.pieces.len() - 1);
        let [_, slope, bend] = self.pieces[piece];
        (slope + 2.0 * bend * (nodes - piece as f64).min(1.0)) * self.nodes_per_fold
    }
}

/// What the eye is adapted to and where it is shown, in the logarithm.
#[derive(Clone, Copy)]
struct Anchor {
    at: f64,
    shown: f64,
}

/// How much of the picture has which luminance, at the nodes.
struct Histogram {
    /// Share of the picture per e-fold.
    density: Vec<f64>,
    /// Share of the picture at this node and above, and at it and below.
    above: Vec<f64>,
    below: Vec<f64>,
    /// The darkest and the brightest sample, the anchor among them.
    darkest: f64,
    brightest: f64,
}

impl Histogram {
    fn of(samples: &[(f64, f64)], anchor: f64) -> Histogram {
        let black = (anchor + BLACK_SHARE.ln()).max(BLACK_CD_M2.ln());
        let last = FIRST + STEP * (NODES - 1) as f64;
        let mut counts = vec![0.0; NODES];
        let (mut total, mut darkest, mut brightest) = (0.0, anchor, anchor);
        for &(luminance, weight) in samples {
            if !(luminance >= 0.0 && weight > 0.0 && weight.is_finite()) {
                continue;
            }
            total += weight;
            let log = luminance.ln().clamp(FIRST, last);
            let seen = ((log - black) / FADE).clamp(0.0, 1.0);
            if seen == 0.0 {
                continue;
            }
            darkest = log.min(darkest);
            brightest = log.max(brightest);
            // Between two nodes, so that the histogram follows every change of the light.
            let nodes = (log - FIRST) / STEP;
            let node = (nodes as usize).min(NODES - 2);
            let next = (nodes - node as f64).min(1.0);
            counts[node] += weight * seen * (1.0 - next);
            counts[node + 1] += weight * seen * next;
        }
        if total > 0.0 {
            counts.iter_mut().for_each(|count| *count /= total);
        }
        let mut sum = 0.0;
        let mut summed = |&count: &f64| {
            sum += count;
            sum
        };
        let below: Vec<f64> = counts.iter().map(&mut summed).collect();
        let above = counts.iter().zip(&below).map(|(count, up_to)| sum - up_to + count).collect();
        for _ in 0..HISTOGRAM_PASSES {
            smooth(&mut counts);
        }
        counts.iter_mut().for_each(|count| *count /= STEP);
        Histogram { density: counts, above, below, darkest, brightest }
    }
}

/// One pass of \[1 2 1\]/4; the ends stay.
fn smooth(values: &mut [f64]) {
    let mut before = values[0];
    for i in 1..values.len() - 1 {
        let here = values[i];
        values[i] = 0.25 * (before + values[i + 1]) + 0.5 * here;
        before = here;
    }
}

/// A stretch of the curve to one side of the anchor.
struct Side {
    nodes: std::ops::RangeInclusive<usize>,
    /// Of each node: how much of its cell lies within the stretch, and the weight of its slope.
    cells: Vec<(f64, f64)>,
}

impl Side {
    /// Between two logarithms of luminance; `beyond` is the share of the picture farther from the anchor.
    fn of(histogram: &Histogram, from: f64, to: f64, beyond: &[f64]) -> Side {
        let node = |log: f64| (((log - FIRST) / STEP).round() as usize).min(NODES - 1);
        let nodes = node(from)..=node(to);
        let cell = |i: usize| {
            let start = FIRST + STEP * (i as f64 - 0.5);
            let length = to.min(start + STEP) - from.max(start);
            let empty = EMPTY * (beyond[i] / BEYOND).clamp(0.0, 1.0);
            (length.max(0.0), (histogram.density[i] + empty).powf(GAMMA))
        };
        Side { cells: nodes.clone().map(cell).collect(), nodes }
    }

    /// The slopes that fill the room, or 1 if all fits.
    fn slopes(&self, room: f64) -> Vec<f64> {
        let range: f64 = self.cells.iter().map(|(length, _)| length).sum();
        if range <= room {
            return vec![1.0; self.cells.len()];
        }
        let scale = fitting_scale(&self.cells, room);
        self.cells.iter().map(|(_, weight)| (scale * weight).clamp(LEAST_SLOPE, 1.0)).collect()
    }

    /// The contrast that the picture loses to these slopes, 0 to 1.
    fn lost(&self, histogram: &Histogram, slopes: &[f64]) -> f64 {
        let density = &histogram.density[self.nodes.clone()];
        let lost = self.cells.iter().zip(slopes).zip(density);
        lost.map(|(((length, _), slope), density)| length * density * (1.0 - slope)).sum()
    }
}

/// The slopes of the curve at the nodes, and where the anchor is to be shown.
fn slopes(histogram: &Histogram, anchor: Anchor, screen: Screen) -> (Vec<f64>, f64) {
    let up = Side::of(histogram, anchor.at, histogram.brightest, &histogram.above);
    let down = Side::of(histogram, histogram.darkest, anchor.at, &histogram.below);
    let room_up = TOP_SHARE.ln() - anchor.shown;
    let room_down = (anchor.shown - screen.log_black()).max(LEAST_ROOM);
    // The anchor gives way to the side on which more of the picture is lost.
    let lost = |side: &Side, room: f64| side.lost(histogram, &side.slopes(room)).powi(3);
    let wished = YIELDING * (lost(&up, room_up) - lost(&down, room_down));
    let lower = wished.clamp(-0.5 * room_up, 0.5 * room_down);
    let slopes_up = up.slopes(room_up + lower);
    let slopes_down = down.slopes(room_down - lower);

    let mut slopes = vec![1.0; NODES];
    slopes[down.nodes].copy_from_slice(&slopes_down);
    // The anchor's own cell belongs to both sides, to each as far as it reaches.
    let (shared, end) = up.nodes.into_inner();
    let share = (FIRST + STEP * (shared as f64 + 0.5) - anchor.at) / STEP;
    slopes[shared] += share.clamp(0.0, 1.0) * (slopes_up[0] - slopes[shared]);
    slopes[shared + 1..=end].copy_from_slice(&slopes_up[1..]);
    slopes[end + 1..].fill(slopes_up[slopes_up.len() - 1]);
    for _ in 0..SLOPE_PASSES {
        smooth(&mut slopes);
    }
    (slopes, anchor.shown - lower)
}

/// The scale of the slopes with which cells (length, weight) fill the room.
fn fitting_scale(cells: &[(f64, f64)], room: f64) -> f64 {
    let filled = |scale: f64| -> f64 {
        cells.iter().map(|(length, weight)| length * (scale * weight).min(1.0)).sum()
    };
    let (mut low, mut high) = (-12.0, 40.0f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if filled(middle.exp()) < room { low = middle } else { high = middle }
    }
    low.exp()
}

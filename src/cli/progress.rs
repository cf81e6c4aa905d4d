//! One line that says how far the work is, and how long each step took.

use std::time::{Duration, Instant as Stopwatch};

use indicatif::{ProgressBar, ProgressStyle};

/// Steps of the work and the time that each took.
pub struct Progress {
    bar: ProgressBar,
    times: Vec<(&'static str, Duration)>,
}

impl Progress {
    /// A line on standard error, if somebody looks at it.
    pub fn new(quiet: bool, steps: u64) -> Progress {
        let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(steps) };
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Progress { bar, times: Vec::new() }
    }

    /// A line about work that is counted in `what`, such as bytes.
    pub fn counting(quiet: bool, total: u64, what: &'static str) -> Progress {
        let progress = Progress::new(quiet, total);
        progress.bar.set_message(what);
        progress
    }

    /// So much more is done.
    pub fn advance(&self, count: u64) {
        self.bar.inc(count);
    }

    /// Does one step.
    pub fn step<T>(&mut self, name: &'static str, work: impl FnOnce() -> T) -> T {
        self.bar.set_message(name);
        let started = Stopwatch::now();
        let result = work();
        self.times.push((name, started.elapsed()));
        self.bar.inc(1);
        result
    }

    /// Takes the line away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    /// The steps done, in order.
    pub fn times(&self) -> &[(&'static str, Duration)] {
        &self.times
    }
}

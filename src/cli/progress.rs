//! One line that says how far the work is.

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

use crate::job::steps;

/// Positions of the line of a job.
const PARTS: u64 = 1000;

/// The line.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A line on standard error, if somebody looks at it.
    fn new(quiet: bool, total: u64, template: &str) -> Progress {
        let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(total) };
        let style = ProgressStyle::with_template(template);
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Progress { bar }
    }

    /// A line about a job.
    pub fn of_job(quiet: bool) -> Progress {
        Progress::new(quiet, PARTS, "{bar:30} {percent} % {msg}")
    }

    /// How far the job is now.
    pub fn show(&self, progress: &steps::Progress) {
        let message = match progress.left {
            Some(left) => format!("{}, {} to go", progress.what, HumanDuration(left)),
            None => progress.what.clone(),
        };
        self.bar.set_message(message);
        self.bar.set_position((progress.done * PARTS as f64) as u64);
    }

    /// A line about work that is counted in `what`, such as bytes.
    pub fn counting(quiet: bool, total: u64, what: &'static str) -> Progress {
        let progress = Progress::new(quiet, total, "{bar:30} {pos}/{len} {msg}");
        progress.bar.set_message(what);
        progress
    }

    /// So much more is done.
    pub fn advance(&self, count: u64) {
        self.bar.inc(count);
    }

    /// Takes the line away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

//! How far a job is, how long it still takes, and the places where it can be stopped.

use std::time::{Duration, Instant as Stopwatch};

use crate::background::Interrupt;

use super::JobError;

/// No time left is told before so much of the work is done, and so much time has passed: it would
/// jump about.
const ENOUGH_DONE: f64 = 0.02;
const ENOUGH_TIME: Duration = Duration::from_secs(1);

/// How far a job is.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    /// What is being done.
    pub what: String,
    /// Share of the whole work that is done, 0 to 1.
    pub done: f64,
    /// How long the rest will take if it goes on like this; none as long as nobody knows.
    pub left: Option<Duration>,
}

/// Steps of a job, or of a part of one. The shares of the steps and parts of each add up to 1.
pub struct Steps<'a> {
    tell: &'a mut dyn FnMut(Progress),
    interrupt: &'a Interrupt,
    begun: Stopwatch,
    /// Shares of the whole job at which this part begins and ends.
    span: [f64; 2],
    /// Share of this part that is done.
    done: f64,
    /// What stands before each step of this part.
    title: String,
    times: Vec<(&'static str, Duration)>,
}

impl<'a> Steps<'a> {
    /// Those of a whole job, told to whoever waits; the clock starts.
    pub fn new(tell: &'a mut dyn FnMut(Progress), interrupt: &'a Interrupt) -> Steps<'a> {
        Steps {
            tell,
            interrupt,
            begun: Stopwatch::now(),
            span: [0.0, 1.0],
            done: 0.0,
            title: String::new(),
            times: Vec::new(),
        }
    }

    /// Does one step, which takes a share of this part, unless the job has been stopped before it.
    pub fn step<T>(
        &mut self,
        what: &'static str,
        share: f64,
        work: impl FnOnce() -> T,
    ) -> Result<T, JobError> {
        self.check()?;
        self.tell(what);
        let started = Stopwatch::now();
        let result = work();
        self.times.push((what, started.elapsed()));
        self.advance(share);
        Ok(result)
    }

    /// The steps of a part, such as one frame of many; without a title it has that of the whole. The
    /// part counts as done when the next thing begins, and its times are its own: a row of frames
    /// keeps no list that grows.
    pub fn part(&mut self, title: &str, share: f64) -> Steps<'_> {
        let title = match title.is_empty() {
            true => self.title.clone(),
            false => self.titled(title),
        };
        let from = self.reached();
        self.advance(share);
        let to = self.reached();
        Steps {
            tell: &mut *self.tell,
            interrupt: self.interrupt,
            begun: self.begun,
            span: [from, to],
            done: 0.0,
            title,
            times: Vec::new(),
        }
    }

    /// An error if the job has been stopped.
    pub fn check(&self) -> Result<(), JobError> {
        if self.interrupt.is_raised() { Err(JobError::Interrupted) } else { Ok(()) }
    }

    /// The steps done, in order, and the time that each took.
    pub fn times(&self) -> &[(&'static str, Duration)] {
        &self.times
    }

    fn advance(&mut self, share: f64) {
        self.done = (self.done + share).clamp(0.0, 1.0);
    }

    /// Share of the whole job.
    fn reached(&self) -> f64 {
        let [from, to] = self.span;
        from + (to - from) * self.done
    }

    fn tell(&mut self, what: &str) {
        let (what, done) = (self.titled(what), self.reached());
        (self.tell)(Progress { what, done, left: left(self.begun.elapsed(), done) });
    }

    fn titled(&self, what: &str) -> String {
        match self.title.is_empty() {
            true => what.to_owned(),
            false => format!("{}: {what}", self.title),
        }
    }
}

/// The time that the rest takes if it goes as fast as what is done.
fn left(passed: Duration, done: f64) -> Option<Duration> {
    let knows = done >= ENOUGH_DONE && passed >= ENOUGH_TIME;
    knows.then(|| passed.mul_f64((1.0 - done) / done))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_parts_are_shares_of_the_whole() {
        let mut told = Vec::new();
        let mut tell = |progress: Progress| told.push((progress.what, progress.done));
        let interrupt = Interrupt::default();
        let mut steps = Steps::new(&mut tell, &interrupt);
        assert_eq!(steps.step("first", 0.5, || 7).unwrap(), 7);
        for frame in 1..=2 {
            let mut part = steps.part(&format!("frame {frame} of 2"), 0.25);
            part.part("", 0.5).step("drawing", 1.0, || ()).unwrap();
            part.step("writing", 0.5, || ()).unwrap();
            assert_eq!(part.times().len(), 1);
        }
        assert_eq!(steps.times().len(), 1);
        let meant = [
            ("first", 0.0),
            ("frame 1 of 2: drawing", 0.5),
            ("frame 1 of 2: writing", 0.625),
            ("frame 2 of 2: drawing", 0.75),
            ("frame 2 of 2: writing", 0.875),
        ];
        assert_eq!(told, meant.map(|(what, done)| (what.to_owned(), done)));
    }

    #[test]
    fn a_part_left_half_done_does_not_hold_up_the_rest() {
        let mut told = Vec::new();
        let mut tell = |progress: Progress| told.push(progress.done);
        let interrupt = Interrupt::default();
        let mut steps = Steps::new(&mut tell, &interrupt);
        steps.part("short", 0.5).step("half of it", 0.5, || ()).unwrap();
        steps.step("rest", 0.5, || ()).unwrap();
        assert_eq!(told, [0.0, 0.5]);
    }

    #[test]
    fn nothing_is_begun_after_an_interrupt() {
        let mut tell = |_: Progress| {};
        let interrupt = Interrupt::default();
        let mut steps = Steps::new(&mut tell, &interrupt);
        steps.step("raised in here", 0.5, || interrupt.raise()).unwrap();
        let mut begun = false;
        let stopped = steps.part("part", 0.5).step("never", 1.0, || begun = true);
        assert!(matches!(stopped, Err(JobError::Interrupted)) && !begun);
    }

    #[test]
    fn the_time_left_follows_what_is_done() {
        let seconds = Duration::from_secs;
        assert_eq!(left(seconds(30), 0.25), Some(seconds(90)));
        assert_eq!(left(seconds(30), 1.0), Some(seconds(0)));
        assert_eq!(left(seconds(30), 0.0), None);
        assert_eq!(left(Duration::from_millis(10), 0.5), None);
    }
}

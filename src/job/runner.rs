//! Does a job beside a window, which is never held up by it.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

use crate::background::Interrupt;

use super::steps::{Progress, Steps};
use super::{JobError, Written};

/// Called from the thread of the job whenever there is something new to show.
type Wake = Arc<dyn Fn() + Send + Sync>;

/// One job at a time, on a thread of its own.
pub struct Runner {
    wake: Wake,
    shared: Arc<Mutex<State>>,
    work: Option<Work>,
}

#[derive(Default)]
struct State {
    progress: Option<Progress>,
    result: Option<Result<Written, JobError>>,
}

struct Work {
    interrupt: Interrupt,
    thread: thread::JoinHandle<()>,
}

impl Runner {
    /// Nothing to do yet. `wake` is called on the thread of the job when its progress has changed and
    /// when it has ended, for a window that draws only when it must; it must not wait for the runner.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Runner {
        Runner { wake: Arc::new(wake), shared: Arc::default(), work: None }
    }

    /// Begins a job and returns at once. A result that nobody has asked for is dropped; while another
    /// job is under way this one is refused.
    pub fn start(
        &mut self,
        job: impl FnOnce(&mut Steps) -> Result<Written, JobError> + Send + 'static,
    ) -> Result<(), JobError> {
        if self.is_working() {
            return Err(JobError::Busy);
        }
        self.join();
        let what = "starting".to_owned();
        let progress = Some(Progress { what, done: 0.0, left: None });
        *lock(&self.shared) = State { progress, result: None };
        let interrupt = Interrupt::default();
        let (shared, wake, stop) =
            (Arc::clone(&self.shared), Arc::clone(&self.wake), interrupt.clone());
        let thread = thread::Builder::new().name("job".to_owned()).spawn(move || {
            let mut tell = |progress| {
                lock(&shared).progress = Some(progress);
                wake();
            };
            let result = catch_unwind(AssertUnwindSafe(|| job(&mut Steps::new(&mut tell, &stop))));
            let result = result.unwrap_or_else(|panic| Err(JobError::Fault(said(&*panic))));
            *lock(&shared) = State { progress: None, result: Some(result) };
            wake();
        });
        match thread {
            Ok(thread) => {
                self.work = Some(Work { interrupt, thread });
                Ok(())
            }
            Err(error) => {
                *lock(&self.shared) = State::default();
                Err(JobError::NoThread(error))
            }
        }
    }

    /// Whether a job is under way.
    pub fn is_working(&self) -> bool {
        lock(&self.shared).progress.is_some()
    }

    /// How far the job is; none when there is none.
    pub fn progress(&self) -> Option<Progress> {
        lock(&self.shared).progress.clone()
    }

    /// Asks the job to stop. It does so after the step that it is at, and then has its result: that
    /// it was stopped, or, if it was nearly done, what it has written.
    pub fn cancel(&self) {
        if let Some(work) = &self.work {
            work.interrupt.raise();
        }
    }

    /// What came of the job that has ended, told once.
    pub fn finished(&mut self) -> Option<Result<Written, JobError>> {
        let result = lock(&self.shared).result.take()?;
        self.join();
        Some(result)
    }

    /// Waits for the thread.
    fn join(&mut self) {
        if let Some(work) = self.work.take() {
            work.thread.join().ok();
        }
    }
}

impl Default for Runner {
    /// Wakes nobody.
    fn default() -> Runner {
        Runner::new(|| {})
    }
}

impl Drop for Runner {
    /// Stops the job, and waits for the end of the step that it is at.
    fn drop(&mut self) {
        self.cancel();
        self.join();
    }
}

fn lock(state: &Mutex<State>) -> MutexGuard<'_, State> {
    // Nothing here is left half-done by a panic.
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The words of a panic.
fn said(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    let words = text.unwrap_or("it gave no reason").split_whitespace();
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;
    use std::sync::mpsc;

    use super::*;

    /// A runner, and what tells that it has something new to show.
    fn runner() -> (Runner, mpsc::Receiver<()>) {
        let (wake, woken) = mpsc::channel();
        let wake = Mutex::new(wake);
        // When the test is over nobody listens.
        (Runner::new(move || wake.lock().unwrap().send(()).unwrap_or(())), woken)
    }

    fn wait(runner: &mut Runner, woken: &mpsc::Receiver<()>) -> Result<Written, JobError> {
        loop {
            if let Some(result) = runner.finished() {
                return result;
            }
            woken.recv().unwrap();
        }
    }

    fn written(name: &str) -> Written {
        Written { paths: vec![PathBuf::from(name)], ..Written::default() }
    }

    /// A job of two steps, which waits in the first until it is let go.
    fn gated(
        gate: mpsc::Receiver<()>,
    ) -> impl FnOnce(&mut Steps) -> Result<Written, JobError> + Send + 'static {
        move |steps| {
            steps.step("waiting", 0.5, || gate.recv().unwrap_or(()))?;
            steps.step("writing", 0.5, || written("sky.png"))
        }
    }

    #[test]
    fn a_job_is_followed_to_its_result_which_is_told_once() {
        let (mut runner, woken) = runner();
        assert!(runner.progress().is_none() && runner.finished().is_none());
        let (go, gate) = mpsc::channel();
        runner.start(gated(gate)).unwrap();
        woken.recv().unwrap();
        let progress = runner.progress().unwrap();
        assert_eq!((progress.what.as_str(), progress.done), ("waiting", 0.0));
        assert!(runner.is_working() && runner.finished().is_none());
        assert!(matches!(runner.start(|_| Ok(Written::default())), Err(JobError::Busy)));
        go.send(()).unwrap();
        let done = wait(&mut runner, &woken).unwrap();
        assert_eq!(done.paths, [PathBuf::from("sky.png")]);
        assert!(!runner.is_working() && runner.progress().is_none());
        assert!(runner.finished().is_none());
    }

    #[test]
    fn a_job_that_is_stopped_begins_no_further_step_and_the_next_is_not_stopped() {
        let (mut runner, woken) = runner();
        let (go, gate) = mpsc::channel();
        runner.start(gated(gate)).unwrap();
        woken.recv().unwrap();
        runner.cancel();
        go.send(()).unwrap();
        assert!(matches!(wait(&mut runner, &woken), Err(JobError::Interrupted)));
        runner.start(|steps| steps.step("writing", 1.0, || written("next.png"))).unwrap();
        assert!(wait(&mut runner, &woken).is_ok());
        runner.cancel();
    }

    #[test]
    fn a_panic_is_a_sentence_and_not_the_end() {
        let (mut runner, woken) = runner();
        runner.start(|_| panic!("index {} of\n 3", 7)).unwrap();
        let message = wait(&mut runner, &woken).unwrap_err().to_string();
        assert!(message.contains("index 7 of 3") && !message.contains('\n'), "{message}");
        runner.start(|_| Ok(written("after.png"))).unwrap();
        assert!(wait(&mut runner, &woken).is_ok());
    }

    #[test]
    fn closing_stops_the_job_and_waits_for_its_end() {
        let (mut runner, woken) = runner();
        let (ended, end) = mpsc::channel();
        runner
            .start(move |steps| {
                steps.step("waiting", 0.5, || ())?;
                while steps.check().is_ok() {
                    thread::yield_now();
                }
                ended.send(()).unwrap();
                steps.check().map(|()| Written::default())
            })
            .unwrap();
        woken.recv().unwrap();
        drop(runner);
        end.try_recv().expect("the job has ended before the runner has");
    }
}

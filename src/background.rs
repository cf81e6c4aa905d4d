//! Work that takes long, done beside what is seen: the old result stays until the new one is ready.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// Tells work that nobody waits for it any more.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Asks the work to stop.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// One thread that turns questions into answers, the latest question first; questions that were
/// overtaken are dropped, also half-way.
pub struct Background<Q, A> {
    shared: Arc<Shared<Q, A>>,
    thread: Option<thread::JoinHandle<()>>,
}

struct Shared<Q, A> {
    state: Mutex<State<Q, A>>,
    changed: Condvar,
}

struct State<Q, A> {
    /// Asked, and not begun.
    asked: Option<Q>,
    /// Being answered, and how to stop it.
    working: Option<(Q, Interrupt)>,
    /// The last answer, with its question.
    answer: Option<Arc<(Q, A)>>,
    is_closed: bool,
}

impl<Q, A> Shared<Q, A> {
    fn state(&self) -> MutexGuard<'_, State<Q, A>> {
        // Nothing here is left half-done by a panic.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<Q, A> Background<Q, A>
where
    Q: Clone + PartialEq + Send + Sync + 'static,
    A: Send + Sync + 'static,
{
    /// Starts the thread. The work gives nothing when it was interrupted.
    pub fn new(work: impl Fn(&Q, &Interrupt) -> Option<A> + Send + 'static) -> Background<Q, A> {
        let state = State { asked: None, working: None, answer: None, is_closed: false };
        let shared = Arc::new(Shared { state: Mutex::new(state), changed: Condvar::new() });
        let theirs = Arc::clone(&shared);
        let thread = thread::spawn(move || {
            while let Some((question, interrupt)) = theirs.next() {
                // A panic has been printed; for who waits it is no answer.
                let answer = catch_unwind(AssertUnwindSafe(|| work(&question, &interrupt)));
                let mut state = theirs.state();
                state.working = None;
                if let Ok(Some(answer)) = answer {
                    state.answer = Some(Arc::new((question, answer)));
                }
                drop(state);
                theirs.changed.notify_all();
            }
        });
        Background { shared, thread: Some(thread) }
    }

    /// Asks for an answer. What is known or under way already is not done again.
    pub fn ask(&self, question: Q) {
        let mut state = self.shared.state();
        if let Some((under_way, interrupt)) = &state.working {
            if *under_way == question && !interrupt.is_raised() {
                state.asked = None;
                return;
            }
            interrupt.raise();
        } else if state.answer.as_ref().is_some_and(|answer| answer.0 == question) {
            state.asked = None;
            return;
        }
        state.asked = Some(question);
        self.shared.changed.notify_all();
    }

    /// The last answer there is, with its question; not always that of the last question.
    pub fn latest(&self) -> Option<Arc<(Q, A)>> {
        self.shared.state().answer.clone()
    }

    /// Whether an answer is under way.
    pub fn is_working(&self) -> bool {
        let state = self.shared.state();
        state.asked.is_some() || state.working.is_some()
    }

    /// Waits until nothing is under way, and gives the last answer.
    pub fn wait(&self) -> Option<Arc<(Q, A)>> {
        let mut state = self.shared.state();
        while state.asked.is_some() || state.working.is_some() {
            state = self.shared.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        state.answer.clone()
    }
}

impl<Q: Clone, A> Shared<Q, A> {
    /// The next question, when there is one; none when the work is over.
    fn next(&self) -> Option<(Q, Interrupt)> {
        let mut state = self.state();
        loop {
            if state.is_closed {
                return None;
            }
            if let Some(question) = state.asked.take() {
                let interrupt = Interrupt::default();
                state.working = Some((question.clone(), interrupt.clone()));
                return Some((question, interrupt));
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl<Q, A> Drop for Background<Q, A> {
    fn drop(&mut self) {
        let mut state = self.shared.state();
        state.is_closed = true;
        if let Some((_, interrupt)) = &state.working {
            interrupt.raise();
        }
        drop(state);
        self.shared.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            thread.join().ok();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    /// Work that takes until it is let go or interrupted, and tells when it begins.
    fn slow() -> (Background<u32, u32>, mpsc::Receiver<u32>, mpsc::Sender<()>) {
        let (begun, begins) = mpsc::channel();
        let (go, gate) = mpsc::channel::<()>();
        let work = move |question: &u32, interrupt: &Interrupt| {
            begun.send(*question).unwrap();
            loop {
                if interrupt.is_raised() {
                    return None;
                }
                match gate.try_recv() {
                    Ok(()) => return Some(question * 10),
                    Err(mpsc::TryRecvError::Disconnected) => return None,
                    Err(mpsc::TryRecvError::Empty) => thread::yield_now(),
                }
            }
        };
        (Background::new(work), begins, go)
    }

    #[test]
    fn the_old_answer_stays_until_the_new_one_is_ready() {
        let (work, begins, go) = slow();
        assert!(work.latest().is_none());
        work.ask(1);
        assert_eq!(begins.recv().unwrap(), 1);
        go.send(()).unwrap();
        assert_eq!(*work.wait().unwrap(), (1, 10));
        work.ask(2);
        assert_eq!(begins.recv().unwrap(), 2);
        assert!(work.is_working());
        assert_eq!(*work.latest().unwrap(), (1, 10));
        go.send(()).unwrap();
        assert_eq!(*work.wait().unwrap(), (2, 20));
        assert!(!work.is_working());
    }

    #[test]
    fn overtaken_questions_are_dropped_and_known_ones_are_not_done_again() {
        let (work, begins, go) = slow();
        work.ask(1);
        assert_eq!(begins.recv().unwrap(), 1);
        for question in 2..=5 {
            work.ask(question);
        }
        // The first is interrupted; what came between is never begun, or interrupted too.
        let mut last = 0;
        while last != 5 {
            last = begins.recv().unwrap();
        }
        go.send(()).unwrap();
        assert_eq!(*work.wait().unwrap(), (5, 50));
        work.ask(5);
        assert!(!work.is_working() && begins.try_recv().is_err());
    }

    #[test]
    fn work_that_fails_leaves_the_last_answer() {
        let work = Background::new(|question: &u32, _: &Interrupt| (*question < 2).then_some(7));
        work.ask(1);
        assert_eq!(*work.wait().unwrap(), (1, 7));
        work.ask(2);
        assert_eq!(*work.wait().unwrap(), (1, 7));
    }

    #[test]
    fn closing_does_not_wait_for_the_work() {
        let (work, begins, _go) = slow();
        work.ask(1);
        begins.recv().unwrap();
        drop(work);
    }
}

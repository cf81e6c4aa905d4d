//! The events of any length of time in order, made a month at a time.
//!
//! Months are independent of each other and are looked through on all cores; what they yield is put
//! in order and given out. What is held at any time is a few months, and a dark that lasts.

use std::collections::VecDeque;

use rayon::prelude::*;

use super::dark::Darkness;
use super::event::{Class, Event};
use super::local::LocalFound;
use super::span::Stretch;
use super::{Almanac, AlmanacError};
use crate::ephemeris::Body;
use crate::time::Instant;
use crate::units::DAY_S;

/// Length of the stretches that are looked through one by one: four of the longest spans.
const STRETCH_DAYS: f64 = 32.0;
/// Stretches in hand for each core.
const STRETCHES_PER_CORE: usize = 2;

/// Events in the order of time. The first error is the last item.
#[derive(Debug)]
pub struct Events<'a> {
    almanac: &'a Almanac,
    from: Instant,
    to: Instant,
    /// Stretches looked through, and how many there are.
    done: usize,
    stretches: usize,
    darkness: Option<Darkness>,
    /// In order; those after `darkness.since()` may not yet be given out.
    waiting: VecDeque<Event>,
    is_over: bool,
}

impl<'a> Events<'a> {
    pub(super) fn between(
        almanac: &'a Almanac,
        from: &Instant,
        to: &Instant,
    ) -> Result<Events<'a>, AlmanacError> {
        let days = to.tt - from.tt;
        if days <= 0.0 {
            return Err(AlmanacError::Order { from: from.to_string(), to: to.to_string() });
        }
        let darkness = match almanac.local() {
            Some(local) if almanac.has(Class::Dark) => {
                let is_up = |light| local.is_up(almanac.theory(), from, light);
                Some(Darkness::from(from, is_up(Body::Sun)?, is_up(Body::Moon)?))
            }
            _ => None,
        };
        Ok(Events {
            almanac,
            from: *from,
            to: *to,
            done: 0,
            stretches: (days / STRETCH_DAYS).ceil() as usize,
            darkness,
            waiting: VecDeque::new(),
            is_over: false,
        })
    }

    /// Which part of the time has been looked through, 0 to 1.
    pub fn progress(&self) -> f64 {
        self.done as f64 / self.stretches as f64
    }

    fn border(&self, index: usize) -> Result<Instant, AlmanacError> {
        match index {
            0 => Ok(self.from),
            index if index == self.stretches => Ok(self.to),
            index => Ok(self.from.plus_seconds(index as f64 * STRETCH_DAYS * DAY_S)?),
        }
    }

    /// Looks through the next stretches, each on a core of its own.
    fn fetch(&mut self) -> Result<(), AlmanacError> {
        let last = (self.done + STRETCHES_PER_CORE * rayon::current_num_threads().max(1))
            .min(self.stretches);
        let stretches = (self.done..last)
            .map(|index| Ok(Stretch { start: self.border(index)?, end: self.border(index + 1)? }))
            .collect::<Result<Vec<_>, AlmanacError>>()?;
        let found: Result<Vec<_>, _> =
            stretches.par_iter().map(|stretch| self.almanac.look_through(stretch)).collect();
        self.done = last;
        for LocalFound { mut events, mut switches } in found? {
            switches.sort_by(|a, b| (a.instant.tt - b.instant.tt).total_cmp(&0.0));
            if let Some(darkness) = &mut self.darkness {
                events.extend(switches.iter().filter_map(|switch| darkness.note(switch)));
            }
            self.waiting.extend(events);
        }
        if self.done == self.stretches {
            let last = self.darkness.as_mut().and_then(|darkness| darkness.end(&self.to));
            self.waiting.extend(last);
        }
        let by_time = |a: &Event, b: &Event| (a.instant.tt - b.instant.tt).total_cmp(&0.0);
        self.waiting.make_contiguous().sort_by(by_time);
        Ok(())
    }

    /// Whether no event that is still to be found can come before this one.
    fn is_settled(&self, event: &Event) -> bool {
        let since = self.darkness.as_ref().and_then(Darkness::since);
        since.is_none_or(|since| event.instant.tt <= since.tt)
    }
}

impl Iterator for Events<'_> {
    type Item = Result<Event, AlmanacError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let first = self.waiting.front();
            if first.is_some_and(|event| self.is_settled(event)) {
                return self.waiting.pop_front().map(Ok);
            }
            if self.is_over || self.done == self.stretches {
                return None;
            }
            if let Err(error) = self.fetch() {
                self.is_over = true;
                self.waiting.clear();
                return Some(Err(error));
            }
        }
    }
}

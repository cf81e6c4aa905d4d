//! Which eclipses there are between two instants.

use super::EclipseError;
use super::lunar::LunarEclipse;
use super::lunation::{Lunation, Phase};
use super::solar::SolarEclipse;
use super::solve::minimum;
use super::track::{HALF_WIDTH_S, Positions, Track};
use crate::ephemeris::{Ephemeris, Tolerance};
use crate::time::{Instant, JulianDate, Tt};

/// How far the greatest eclipse may lie from the middle of its track, seconds.
///
/// 3.75 hours are left on either side, and no eclipse lasts longer than 3.2 hours to either side.
const OFF_MIDDLE_S: f64 = 900.0;

/// Days by which estimates are surely better.
const MARGIN_DAYS: f64 = 0.5;

/// The eclipses of the Moon that are greatest from `from` on and before `to`, in order.
///
/// Directions of Sun and Moon are within `tolerance`, or as good as they are known; the Moon moves 1"
/// in 2 s. After an error there is no further eclipse.
pub fn lunar_eclipses(
    ephemeris: &Ephemeris,
    from: Instant,
    to: Instant,
    tolerance: Tolerance,
) -> impl Iterator<Item = Result<LunarEclipse, EclipseError>> {
    Search {
        ephemeris,
        tolerance,
        from: from.tt,
        to: to.tt,
        next: Some(Lunation::before(from.tt, Phase::Full)),
        axis_distance_squared: LunarEclipse::axis_distance_squared,
        eclipse: LunarEclipse::of,
    }
}

/// The eclipses of the Sun that are greatest from `from` on and before `to`, in order.
///
/// Tolerance and errors as for [`lunar_eclipses`].
pub fn solar_eclipses(
    ephemeris: &Ephemeris,
    from: Instant,
    to: Instant,
    tolerance: Tolerance,
) -> impl Iterator<Item = Result<SolarEclipse, EclipseError>> {
    Search {
        ephemeris,
        tolerance,
        from: from.tt,
        to: to.tt,
        next: Some(Lunation::before(from.tt, Phase::New)),
        axis_distance_squared: SolarEclipse::axis_distance_squared,
        eclipse: SolarEclipse::of,
    }
}

struct Search<'a, E> {
    ephemeris: &'a Ephemeris,
    tolerance: Tolerance,
    from: JulianDate<Tt>,
    to: JulianDate<Tt>,
    /// Where to look next; `None` when all is done.
    next: Option<Lunation>,
    axis_distance_squared: fn(&Positions) -> f64,
    eclipse: fn(Lunation, Track, f64) -> Result<Option<E>, EclipseError>,
}

impl<E> Iterator for Search<'_, E> {
    type Item = Result<E, EclipseError>;

    fn next(&mut self) -> Option<Self::Item> {
        while let Some(lunation) = self.next {
            let estimate = lunation.estimate();
            self.next = (estimate - self.to < MARGIN_DAYS).then(|| lunation.next());
            if self.next.is_none() || self.from - estimate > MARGIN_DAYS || !lunation.is_near_node()
            {
                continue;
            }
            match self.look(lunation, estimate) {
                Ok(None) => {}
                Ok(Some(eclipse)) => return Some(Ok(eclipse)),
                Err(error) => {
                    self.next = None;
                    return Some(Err(error));
                }
            }
        }
        None
    }
}

impl<E> Search<'_, E> {
    /// The eclipse of one lunation, if there is one within the span.
    fn look(
        &self,
        lunation: Lunation,
        estimate: JulianDate<Tt>,
    ) -> Result<Option<E>, EclipseError> {
        let mut middle = estimate;
        loop {
            let track = Track::around(self.ephemeris, middle, self.tolerance)?;
            let distance_squared = |t: f64| (self.axis_distance_squared)(&track.at(t));
            // The slope is asked a few seconds outside.
            let end_s = HALF_WIDTH_S - 60.0;
            let Some(greatest_s) = minimum(distance_squared, -end_s, end_s) else {
                return Ok(None);
            };
            let greatest = track.tt(greatest_s);
            if greatest_s.abs() > OFF_MIDDLE_S {
                middle = greatest;
                continue;
            }
            if greatest < self.from || greatest >= self.to {
                return Ok(None);
            }
            return (self.eclipse)(lunation, track, greatest_s);
        }
    }
}

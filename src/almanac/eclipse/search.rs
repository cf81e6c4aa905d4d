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
/// Directions of Sun and Moon are within `tolerance`, or as good as they are known; the Moon moves
/// 1" in 2 s. After an error there is no further eclipse.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Angle;

    /// Starts of spans that are looked at, Julian dates: about -3995, -2000, 1000, 2000 and 3990.
    const SPANS: [f64; 5] = [262_000.0, 990_600.0, 2_086_300.0, 2_451_500.0, 3_178_000.0];
    const SPAN_DAYS: f64 = 4000.0;

    fn instant(jd: f64) -> Instant {
        Instant::from_tt(JulianDate::from_jd(jd)).unwrap()
    }

    #[test]
    fn estimates_are_near_enough_for_one_track() {
        let ephemeris = Ephemeris::analytic();
        let mut eclipses = 0;
        for start in SPANS {
            let (from, to) = (instant(start), instant(start + SPAN_DAYS));
            for eclipse in lunar_eclipses(&ephemeris, from, to, Angle::ZERO) {
                let eclipse = eclipse.unwrap();
                let lunation = Lunation { number: eclipse.lunation, phase: Phase::Full };
                let off_days = (eclipse.greatest.tt - lunation.estimate()).abs();
                assert!(off_days * 86_400.0 < OFF_MIDDLE_S, "{}", eclipse.greatest);
                eclipses += 1;
            }
        }
        assert!(eclipses > 100, "{eclipses}");
    }

    #[test]
    fn far_from_the_node_no_eclipse_is_left_out() {
        let ephemeris = Ephemeris::analytic();
        let search = |from: Instant, to: Instant| Search::<SolarEclipse> {
            ephemeris: &ephemeris,
            tolerance: Angle::ZERO,
            from: from.tt,
            to: to.tt,
            next: None,
            axis_distance_squared: SolarEclipse::axis_distance_squared,
            eclipse: SolarEclipse::of,
        };
        let (mut within, mut beyond) = (0, 0);
        for start in SPANS {
            let (from, to) = (instant(start), instant(start + SPAN_DAYS));
            let mut lunation = Lunation::before(from.tt, Phase::New);
            while lunation.estimate() < to.tt {
                let found = search(from, to).look(lunation, lunation.estimate()).unwrap();
                if lunation.is_near_node() {
                    within += i32::from(found.is_some());
                } else {
                    assert!(found.is_none(), "{lunation:?}");
                    beyond += 1;
                }
                lunation = lunation.next();
            }
        }
        assert!(within > 100 && beyond > 400, "{within} {beyond}");
    }

    #[test]
    fn spans_meet_without_gap_or_overlap() {
        let ephemeris = Ephemeris::analytic();
        let all = |from: f64, to: f64| -> Vec<JulianDate<Tt>> {
            let found = solar_eclipses(&ephemeris, instant(from), instant(to), Angle::ZERO);
            found.map(|eclipse| eclipse.unwrap().greatest.tt).collect()
        };
        let whole = all(2_451_545.0, 2_453_545.0);
        // A border at a greatest eclipse: it belongs to the later span.
        let border = whole[4].jd();
        let (before, after) = (all(2_451_545.0, border), all(border, 2_453_545.0));
        assert_eq!(before.len() + after.len(), whole.len());
        assert!((4..=5).contains(&before.len()));
        assert!(all(border + 1.0, border - 1.0).is_empty());
    }
}

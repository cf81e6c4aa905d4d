//! What a place on the Earth has to do with an eclipse: where the body stands, and when it is up.

use super::solve::root;
use super::track::{Positions, Track};
use crate::frame::{Dir, Horizon, Itrs, Pos, Rot, TrueOfDate};
use crate::place::Place;
use crate::time::{Instant, TimeError};
use crate::units::Angle;

/// Airless altitude of the centre at which the upper limb of the Sun or the Moon comes up: 34' of
/// refraction and 16' of radius.
pub const RISE_ALTITUDE: Angle = Angle::from_arcmin(-50.0);

/// How often one looks whether a body is up, seconds.
const LOOK_S: f64 = 300.0;

/// A moment of an eclipse at a place, and where the eclipsed body stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalMoment {
    /// On every clock.
    pub instant: Instant,
    /// Of the centre, topocentric, without air.
    pub altitude: Angle,
    /// From north through east.
    pub azimuth: Angle,
}

impl LocalMoment {
    /// Whether the upper limb stands above a level horizon, with refraction: see [`RISE_ALTITUDE`].
    pub fn is_up(&self) -> bool {
        self.altitude > RISE_ALTITUDE
    }
}

/// A place as it turns with the Earth.
#[derive(Debug, Clone, Copy)]
pub struct Site {
    itrs: Pos<Itrs>,
    horizon_from_itrs: Rot<Horizon, Itrs>,
}

/// Which of the two is looked at.
pub type Choice = fn(&Positions) -> Pos<TrueOfDate>;

impl Site {
    pub fn new(place: &Place) -> Site {
        Site { itrs: place.itrs(), horizon_from_itrs: place.horizon_from_itrs() }
    }

    /// From the place to what lies at `geocentric`.
    pub fn topocentric(
        &self,
        positions: &Positions,
        geocentric: Pos<TrueOfDate>,
    ) -> Pos<TrueOfDate> {
        geocentric - positions.itrs_from_true.inverse() * self.itrs
    }

    pub fn horizon_from_true(&self, positions: &Positions) -> Rot<Horizon, TrueOfDate> {
        self.horizon_from_itrs * positions.itrs_from_true
    }

    /// # Errors
    ///
    /// A date that no clock serves.
    pub fn moment(
        &self,
        track: &Track,
        seconds: f64,
        choice: Choice,
    ) -> Result<LocalMoment, TimeError> {
        let instant = track.instant(seconds)?;
        let dir = self.dir(track, seconds, choice);
        Ok(LocalMoment { instant, altitude: dir.altitude(), azimuth: dir.azimuth() })
    }

    /// The stretches between two times in which the body is up.
    pub fn up(&self, track: &Track, from_s: f64, to_s: f64, choice: Choice) -> Vec<[f64; 2]> {
        let height = |t: f64| (self.dir(track, t, choice).altitude() - RISE_ALTITUDE).rad();
        let looks = ((to_s - from_s) / LOOK_S).ceil().max(1.0);
        let step_s = (to_s - from_s) / looks;
        let mut stretches = Vec::new();
        let mut was_up = height(from_s) > 0.0;
        let mut risen = was_up.then_some(from_s);
        for look in 1..=looks as usize {
            let now_s = from_s + step_s * look as f64;
            let is_up = height(now_s) > 0.0;
            if is_up != was_up {
                let crossing_s = root(height, now_s - step_s, now_s).unwrap_or(now_s);
                match risen.take() {
                    Some(since_s) => stretches.push([since_s, crossing_s]),
                    None => risen = Some(crossing_s),
                }
            }
            was_up = is_up;
        }
        stretches.extend(risen.map(|since| [since, to_s]));
        stretches
    }

    fn dir(&self, track: &Track, seconds: f64, choice: Choice) -> Dir<Horizon> {
        let positions = track.at(seconds);
        let topocentric = self.topocentric(&positions, choice(&positions));
        self.horizon_from_true(&positions) * topocentric.dir()
    }
}

//! Where things are seen at an instant: the one place where the almanac asks the ephemeris.

use crate::almanac::AlmanacError;
use crate::almanac::event::Target;
use crate::ephemeris::{Body, Ephemeris, Observation, Tolerance};
use crate::frame::{Dir, EclipticOfDate, Horizon, TrueOfDate};
use crate::place::Place;
use crate::time::Instant;
use crate::units::Angle;

/// The ephemeris and how well it is asked to know.
#[derive(Debug, Clone)]
pub struct Theory {
    pub ephemeris: Ephemeris,
    pub tolerance: Tolerance,
    /// A place that the turning Earth does not carry along: what it sees is geocentric but for
    /// parallax, which stars do not have.
    pole: Place,
}

/// A target as a place sees it.
#[derive(Debug, Clone, Copy)]
pub struct FromPlace {
    /// Airless.
    pub dir: Dir<Horizon>,
    /// From the observer; infinite for stars.
    pub distance_km: f64,
}

/// A target as the centre of the Earth would see it.
#[derive(Debug, Clone, Copy)]
pub struct FromEarth {
    pub equatorial: Dir<TrueOfDate>,
    pub ecliptic: Dir<EclipticOfDate>,
    /// From the true equinox, which stands by the nutation in longitude before the mean one.
    pub longitude: Angle,
    /// Along the way of the light; infinite for stars.
    pub distance_km: f64,
}

impl Theory {
    pub fn new(ephemeris: &Ephemeris, tolerance: Tolerance) -> Result<Theory, AlmanacError> {
        let pole = Place::new(90.0, 0.0, 0.0)?;
        Ok(Theory { ephemeris: ephemeris.clone(), tolerance, pole })
    }

    /// What a place sees of some targets.
    pub fn seen_from_place(
        &self,
        instant: &Instant,
        place: &Place,
        targets: &[Target],
    ) -> Result<Vec<FromPlace>, AlmanacError> {
        let mut observation = Observation::at(&self.ephemeris, instant, place, self.tolerance);
        let mut stars = None;
        let mut seen = |target: &Target| match target {
            Target::Body(body) => {
                let place = observation.seen(*body)?.place;
                Ok(FromPlace { dir: place.horizon, distance_km: place.topocentric_distance_km })
            }
            Target::Star(star) => {
                if stars.is_none() {
                    stars = Some(observation.stars()?);
                }
                let dir = stars.as_ref().map(|stars| stars.horizon(star.as_ref()));
                Ok(FromPlace { dir: dir.expect("was made"), distance_km: f64::INFINITY })
            }
        };
        targets.iter().map(&mut seen).collect()
    }

    /// Where some targets are seen from the centre of the Earth.
    pub fn seen_from_earth(
        &self,
        instant: &Instant,
        targets: &[Target],
    ) -> Result<Vec<FromEarth>, AlmanacError> {
        let mut observation = Observation::at(&self.ephemeris, instant, &self.pole, self.tolerance);
        let observer = *observation.observer();
        let axes = observer.orientation;
        let ecliptic_from_true =
            axes.ecliptic_from_mean * axes.mean_from_icrs * observer.true_from_icrs.inverse();
        let of_date = |equatorial: Dir<TrueOfDate>, distance_km: f64| {
            let ecliptic = ecliptic_from_true * equatorial;
            let longitude = ecliptic.longitude() + axes.nutation.longitude;
            FromEarth { equatorial, ecliptic, longitude, distance_km }
        };
        targets
            .iter()
            .map(|target| match target {
                Target::Body(body) => {
                    let place = observation.seen(*body)?.place;
                    Ok(of_date(place.geocentric, place.geocentric_distance_km))
                }
                Target::Star(star) => {
                    let dir = observation.stars()?.geocentric(star.as_ref());
                    Ok(of_date(dir, f64::INFINITY))
                }
            })
            .collect()
    }

    /// Distance between the centres of the Earth and of a body at one moment, no light time.
    pub fn distance_km(&self, instant: &Instant, body: Body) -> Result<f64, AlmanacError> {
        let (tier, _) = self.ephemeris.choose(body, self.tolerance, instant.tdb)?;
        let earth = self.ephemeris.earth(instant.tdb, tier)?;
        let position = self.ephemeris.geometric(body, instant.tdb, tier)?;
        Ok((position - earth.position).distance_km())
    }

    /// Bound of the error of the direction to a body.
    pub fn error_bound(&self, instant: &Instant, body: Body) -> Result<Angle, AlmanacError> {
        Ok(self.ephemeris.choose(body, self.tolerance, instant.tdb)?.1)
    }
}

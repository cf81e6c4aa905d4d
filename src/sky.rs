//! Where everything stands in the sky of one place at one instant: directions, distances, phases
//! and sizes. Not how bright, and not refracted.

pub mod constellation;
pub mod finder;
mod moon_surface;
mod names;
mod satellites;
pub mod star_index;
mod target;

use crate::catalog::Star;
use crate::ephemeris::apparent::{ApparentPlace, Observer};
use crate::ephemeris::moon_orientation::Libration;
use crate::ephemeris::stars::{SpaceMotion, StarReduction};
use crate::ephemeris::{
    Body, Ephemeris, EphemerisError, Galilean, Observation, Seen, Tier, Tolerance, north_pole,
};
use crate::frame::{Dir, Horizon, Icrs, MoonFixed, Rot};
use crate::place::Place;
use crate::time::Instant;
use crate::units::Angle;

pub use moon_surface::SurfacePoint;
pub use satellites::SatelliteState;
pub use target::{Target, UnknownTarget};

/// The sky of one place at one instant, geometric: what stands there without air.
#[derive(Debug, Clone)]
pub struct SkyState {
    pub instant: Instant,
    pub place: Place,
    /// Axes alone: what is fixed in space and far away, such as the Milky Way, without aberration.
    pub horizon_from_icrs: Rot<Horizon, Icrs>,
    /// Angle from the mean equator to the mean ecliptic of date.
    pub mean_obliquity: Angle,
    pub sun: BodyState,
    pub moon: MoonState,
    /// Mercury to Pluto, outwards.
    pub planets: Vec<BodyState>,
    /// The great moons of Jupiter, outwards.
    pub satellites: Vec<SatelliteState>,
    stars: StarReduction,
}

/// One body as it stands in the sky.
#[derive(Debug, Clone, Copy)]
pub struct BodyState {
    pub body: Body,
    /// The theory that was good enough.
    pub tier: Tier,
    /// Bound of the error of `dir`.
    pub error_bound: Angle,
    /// Topocentric, with aberration, without air.
    pub dir: Dir<Horizon>,
    /// From the observer, along the way of the light.
    pub distance_km: f64,
    /// From the body to the Sun when the light left the body; zero for the Sun.
    pub sun_distance_km: f64,
    /// Angle Sun, body, observer; zero for the Sun.
    pub phase_angle: Angle,
    /// Angle between the centre and the limb: equatorial radius over distance.
    pub angular_radius: Angle,
    /// From the body to the Sun; for the Sun itself, to the observer.
    pub dir_to_sun: Dir<Horizon>,
    /// North pole in local axes, of the planets that are flattened.
    pub pole: Option<Dir<Horizon>>,
    /// For Saturn alone.
    pub rings: Option<RingTilt>,
}

/// How Saturn's rings are turned: heights above the ring plane, positive on its north side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingTilt {
    /// Latitude of the observer as seen from Saturn.
    pub observer_latitude: Angle,
    /// Latitude of the Sun as seen from Saturn.
    pub sun_latitude: Angle,
    /// Saturn's north pole in local axes.
    pub pole: Dir<Horizon>,
}

/// The Moon as it stands in the sky.
#[derive(Debug, Clone, Copy)]
pub struct MoonState {
    pub state: BodyState,
    /// Turns the Moon's map to where it is seen.
    pub horizon_from_moon_fixed: Rot<Horizon, MoonFixed>,
    /// Point of the Moon below the observer: topocentric libration.
    pub libration: Libration,
    /// Point of the Moon below the Sun.
    pub subsolar: Libration,
}

impl BodyState {
    /// Whether the disc of the body covers a direction.
    pub fn covers(&self, dir: Dir<Horizon>) -> bool {
        // Most are far away, which a product tells sooner than an angle.
        self.dir.dot(dir) > 0.5 && self.dir.separation(dir) < self.angular_radius
    }
}

impl SkyState {
    /// The sky at an instant and a place, each body within `tolerance` if any tier is as good, else
    /// by the best there is.
    pub fn at(
        ephemeris: &Ephemeris,
        instant: &Instant,
        place: &Place,
        tolerance: Tolerance,
    ) -> Result<SkyState, EphemerisError> {
        let mut observation = Observation::at(ephemeris, instant, place, tolerance);
        let observer = *observation.observer();
        let mut seen = |body: Body| -> Result<(BodyState, ApparentPlace), EphemerisError> {
            let seen = observation.seen(body)?;
            Ok((body_state(body, &seen, &observer), seen.place))
        };
        let (sun, _) = seen(Body::Sun)?;
        let (moon, moon_place) = seen(Body::Moon)?;
        let planets = Body::PLANETS
            .into_iter()
            .map(|planet| seen(planet).map(|(state, _)| state))
            .collect::<Result<Vec<_>, _>>()?;
        let satellites = satellites::of_jupiter(&mut observation)?;
        let stars = observation.stars()?;
        Ok(SkyState {
            instant: *instant,
            place: place.clone(),
            horizon_from_icrs: observer.horizon_from_icrs,
            mean_obliquity: observer.orientation.mean_obliquity,
            sun,
            moon: moon_state(moon, &moon_place, &observation),
            planets,
            satellites,
            stars,
        })
    }

    /// Where the stars stand: proper motion, parallax, aberration; no air.
    pub fn stars(&self, stars: &[Star]) -> Vec<Dir<Horizon>> {
        self.stars.horizon_all(stars)
    }

    /// Where one star stands, likewise.
    pub fn star(&self, star: impl Into<SpaceMotion>) -> Dir<Horizon> {
        self.stars.horizon(star)
    }

    /// The state of a moon of Jupiter.
    pub fn satellite(&self, satellite: Galilean) -> Option<&SatelliteState> {
        self.satellites.iter().find(|state| state.satellite == satellite)
    }

    /// The state of a body, whichever it is.
    pub fn body(&self, body: Body) -> Option<&BodyState> {
        match body {
            Body::Sun => Some(&self.sun),
            Body::Moon => Some(&self.moon.state),
            _ => self.planets.iter().find(|planet| planet.body == body),
        }
    }
}

fn body_state(body: Body, seen: &Seen, observer: &Observer) -> BodyState {
    let apparent = &seen.place;
    let to_observer = -apparent.from_observer.dir();
    let to_sun = if body == Body::Sun { to_observer } else { -apparent.from_sun.dir() };
    let distance_km = apparent.topocentric_distance_km;
    let pole = north_pole(body, observer.tdb);
    let rings = pole.filter(|_| body == Body::Saturn).map(|pole| RingTilt {
        observer_latitude: Angle::from_rad(pole.dot(to_observer).clamp(-1.0, 1.0).asin()),
        sun_latitude: Angle::from_rad(pole.dot(to_sun).clamp(-1.0, 1.0).asin()),
        pole: observer.horizon_from_icrs * pole,
    });
    BodyState {
        body,
        tier: seen.tier,
        error_bound: seen.error_bound,
        dir: apparent.horizon,
        distance_km,
        sun_distance_km: apparent.from_sun.distance_km(),
        phase_angle: to_sun.separation(to_observer),
        angular_radius: Angle::from_rad((body.radius_km() / distance_km).min(1.0).asin()),
        dir_to_sun: observer.horizon_from_icrs * to_sun,
        pole: pole.map(|pole| observer.horizon_from_icrs * pole),
        rings,
    }
}

fn moon_state(state: BodyState, apparent: &ApparentPlace, observation: &Observation) -> MoonState {
    let axes = observation.moon_fixed_from_icrs(apparent);
    MoonState {
        state,
        horizon_from_moon_fixed: observation.observer().horizon_from_icrs * axes.inverse(),
        libration: Libration::facing(axes, -apparent.from_observer.dir()),
        subsolar: Libration::facing(axes, -apparent.from_sun.dir()),
    }
}

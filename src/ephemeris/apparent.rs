//! From where bodies are to where they are seen: light time, deflection, aberration, parallax.
//!
//! *Theory.* Light time by iteration. Deflection by the Sun alone, from the finite distance of the
//! body (Explanatory Supplement 2013, eq. 7.63). Aberration by the Lorentz transformation (eq.
//! 7.66). The observer moves with the Earth and turns with it: the diurnal part (0.3") is in the
//! velocity, the parallax in the origin.
//!
//! *Omitted.* The Sun's potential in the aberration and the delay of light by gravity (below
//! 0.000001"), deflection by Jupiter (0.016" at its limb), polar motion (0.6" at most), air; and by
//! the analytic tiers the motion of the Sun about the barycentre (0.011" of aberration).

use glam::DVec3;

use super::body::Body;
use super::orientation::Orientation;
use super::tables::{Departure, EarthState, Ephemeris};
use super::tier::{EphemerisError, Tier, Tolerance};
use crate::frame::{Dir, Horizon, Icrs, Itrs, Pos, Rot, TrueOfDate};
use crate::place::Place;
use crate::time::{Instant, JulianDate, Tdb};
use crate::units::LIGHT_SPEED_KM_S;

/// Rotation of the Earth, radians per second (IERS Conventions 2010, table 1.2).
const EARTH_ROTATION_RAD_S: f64 = 7.292_115e-5;

/// Twice the gravitational radius of the Sun, `2 G M / c^2`, kilometres.
const SUN_SCHWARZSCHILD_RADIUS_KM: f64 = 2.953_250_077;

/// A place on the turning Earth at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Observer {
    pub tdb: JulianDate<Tdb>,
    pub orientation: Orientation,
    pub true_from_icrs: Rot<TrueOfDate, Icrs>,
    pub horizon_from_icrs: Rot<Horizon, Icrs>,
    /// From the centre of the Earth.
    pub position: Pos<Icrs>,
    /// With respect to the centre of the Earth, kilometres per second, ICRS axes.
    pub velocity_km_s: DVec3,
}

impl Observer {
    /// Axes within `tolerance`, if any form of nutation is as good.
    pub fn at(
        ephemeris: &Ephemeris,
        instant: &Instant,
        place: &Place,
        tolerance: Tolerance,
    ) -> Observer {
        // Half is left to the body.
        let nutation = ephemeris.nutation(tolerance / 2.0, instant.tt);
        let orientation = Orientation::at(instant, &nutation);
        let itrs_from_icrs = orientation.itrs_from_icrs();
        let icrs_from_itrs = itrs_from_icrs.inverse();
        let axis: Dir<Itrs> = Dir::from_vector(DVec3::Z);
        let itrs = place.itrs();
        let velocity: Pos<Itrs> =
            Pos::from_km(axis.vector().cross(itrs.km()) * EARTH_ROTATION_RAD_S);
        Observer {
            tdb: instant.tdb,
            orientation,
            true_from_icrs: orientation.true_from_icrs,
            horizon_from_icrs: place.horizon_from_itrs() * itrs_from_icrs,
            position: icrs_from_itrs * itrs,
            velocity_km_s: (icrs_from_itrs * velocity).km(),
        }
    }
}

/// Where a body is seen, from the centre of the Earth and from a place on it. No air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ApparentPlace {
    /// True equator and equinox of date: apparent right ascension and declination.
    pub geocentric: Dir<TrueOfDate>,
    /// The way that the light has travelled to the centre of the Earth.
    pub geocentric_distance_km: f64,
    pub topocentric: Dir<TrueOfDate>,
    /// The way that the light has travelled to the observer.
    pub topocentric_distance_km: f64,
    /// Topocentric, local axes.
    pub horizon: Dir<Horizon>,
    /// Where the body was when the light left it, from the observer now: no aberration.
    pub from_observer: Pos<Icrs>,
    /// The same from the centre of the Earth.
    pub from_earth: Pos<Icrs>,
    /// The same from the Sun.
    pub from_sun: Pos<Icrs>,
}

impl ApparentPlace {
    /// `earth` is the Earth at the observer's time by the same tier.
    pub fn of(
        ephemeris: &Ephemeris,
        body: Body,
        tier: Tier,
        observer: &Observer,
        earth: &EarthState,
    ) -> Result<ApparentPlace, EphemerisError> {
        let path = LightPath::to(earth.position, body, tier, ephemeris, observer.tdb)?;
        let from_earth = path.left_at(path.light_time_s) - earth.position;
        // The observer is up to 21 ms of light closer or farther: the body moves on for that time.
        let topocentric_light_time_s =
            (from_earth - observer.position).distance_km() / LIGHT_SPEED_KM_S;
        let moved = path.left_at(topocentric_light_time_s);
        let from_observer = moved - earth.position - observer.position;

        // The Sun drifts at 16 m/s: while light crosses the orbit of the Earth it is taken to stand.
        let earth_from_sun = (earth.position - earth.sun).km();
        let observer_from_sun = earth_from_sun + observer.position.km();
        let from_sun = moved - earth.sun;
        let source = from_sun.dir();
        let seen = |from: Pos<Icrs>, origin_from_sun: DVec3, velocity_km_s: DVec3| {
            let dir = match body {
                Body::Sun => from.dir(),
                _ => deflect(from.dir(), source, origin_from_sun),
            };
            aberrate(dir, velocity_km_s)
        };
        let geocentric = seen(from_earth, earth_from_sun, earth.velocity_km_s);
        let topocentric =
            seen(from_observer, observer_from_sun, earth.velocity_km_s + observer.velocity_km_s);
        Ok(ApparentPlace {
            geocentric: observer.true_from_icrs * geocentric,
            geocentric_distance_km: from_earth.distance_km(),
            topocentric: observer.true_from_icrs * topocentric,
            topocentric_distance_km: from_observer.distance_km(),
            horizon: observer.horizon_from_icrs * topocentric,
            from_observer,
            from_earth,
            from_sun,
        })
    }
}

/// The last of the way that a body went before the light left it that arrives now.
struct LightPath {
    departure: Departure,
    /// How long the light took to the centre of the Earth.
    light_time_s: f64,
}

impl LightPath {
    /// `tdb` is the time of arrival.
    fn to(
        earth: Pos<Icrs>,
        body: Body,
        tier: Tier,
        ephemeris: &Ephemeris,
        tdb: JulianDate<Tdb>,
    ) -> Result<LightPath, EphemerisError> {
        let light_time_s = |from: Pos<Icrs>| (from - earth).distance_km() / LIGHT_SPEED_KM_S;
        let departure = ephemeris.departure(body, tdb, tier, light_time_s)?;
        let mut path = LightPath { departure, light_time_s: departure.before_s };
        // Each round gains a factor of 10^4, the ratio of light to planets. The departure is wrong
        // by seconds at most, in which no body strays a metre from a straight line.
        for _ in 0..2 {
            path.light_time_s = light_time_s(path.left_at(path.light_time_s));
        }
        Ok(path)
    }

    /// Where the body was so many seconds before the light arrives, near the departure.
    fn left_at(&self, before_s: f64) -> Pos<Icrs> {
        let Departure { position, velocity_km_s, before_s: departure_s } = self.departure;
        position + velocity_km_s * (departure_s - before_s)
    }
}

/// Bends a ray around the Sun.
///
/// `dir` is the direction to the source, `source` the direction from the Sun to it, the observer
/// stands `observer_from_sun_km`. Behind the disc of the Sun the formula would go wild; it is held
/// at the value of the limb.
pub fn deflect(dir: Dir<Icrs>, source: Dir<Icrs>, observer_from_sun_km: DVec3) -> Dir<Icrs> {
    let distance_km = observer_from_sun_km.length();
    let (p, q, e) = (dir.vector(), source.vector(), observer_from_sun_km / distance_km);
    // 1 + cos of the angle between source and observer seen from the Sun; the limb is 1e-5.
    let opening = (1.0 + q.dot(e)).max(1e-5);
    let bending = SUN_SCHWARZSCHILD_RADIUS_KM / distance_km / opening;
    Dir::from_vector(p + bending * p.cross(e.cross(q)))
}

/// Tilts a direction into the motion of the observer: aberration, exact in special relativity.
pub fn aberrate(dir: Dir<Icrs>, velocity_km_s: DVec3) -> Dir<Icrs> {
    let beta = velocity_km_s / LIGHT_SPEED_KM_S;
    let inverse_gamma = (1.0 - beta.length_squared()).sqrt();
    let along = beta.dot(dir.vector());
    Dir::from_vector(dir.vector() * inverse_gamma + beta * (1.0 + along / (1.0 + inverse_gamma)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{AU_KM, Angle};

    #[test]
    fn aberration_is_that_of_special_relativity() {
        // tan(a'/2) = sqrt((1 - b) / (1 + b)) tan(a/2), Einstein 1905, for the angle to the motion.
        let beta = 0.6;
        let angle = Angle::from_deg(70.0);
        let dir: Dir<Icrs> = Dir::from_spherical(angle, Angle::ZERO);
        let seen = aberrate(dir, DVec3::X * beta * LIGHT_SPEED_KM_S);
        let expected = 2.0 * (((1.0 - beta) / (1.0 + beta)).sqrt() * (angle / 2.0).tan()).atan();
        assert!((seen.longitude().rad() - expected).abs() < 1e-14);
    }

    #[test]
    fn a_star_at_the_limb_is_bent_away_by_a_second_and_three_quarters() {
        let observer_from_sun_km = DVec3::X * AU_KM;
        let limb = Angle::from_rad((crate::units::SUN_RADIUS_KM / AU_KM).asin());
        let dir: Dir<Icrs> = Dir::from_spherical(Angle::from_deg(180.0) - limb, Angle::ZERO);
        let seen = deflect(dir, dir, observer_from_sun_km);
        let away = Angle::from_deg(180.0) - seen.longitude() - limb;
        assert!((away.arcsec() - 1.7505).abs() < 1e-3, "{}", away.arcsec());
        // 4.07 mas at right angles (Explanatory Supplement 2013, table 7.1).
        let side: Dir<Icrs> = Dir::from_spherical(Angle::from_deg(90.0), Angle::ZERO);
        let bent = deflect(side, side, observer_from_sun_km).separation(side);
        assert!((bent.arcsec() - 0.00407).abs() < 1e-5);
    }
}

//! One instant at one place: what all bodies share, reckoned once.

use super::apparent::{ApparentPlace, Observer, aberrate, deflect};
use super::body::Body;
use super::moon_orientation::MoonPhysical;
use super::stars::StarReduction;
use super::tables::{EarthState, Ephemeris};
use super::tier::{EphemerisError, Tier, Tolerance};
use crate::frame::{Dir, Icrs, MoonFixed, Pos, Rot};
use crate::place::Place;
use crate::time::Instant;
use crate::units::{Angle, LIGHT_SPEED_KM_S};

/// An observer who asks for one body after the other.
#[derive(Debug)]
pub struct Observation<'a> {
    ephemeris: &'a Ephemeris,
    tolerance: Tolerance,
    observer: Observer,
    /// The Earth by each tier that somebody asked for.
    earths: Vec<(Tier, EarthState)>,
}

/// Where a body is seen, and how well that is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    pub place: ApparentPlace,
    /// The theory that was good enough.
    pub tier: Tier,
    /// Bound of the error of the direction.
    pub error_bound: Angle,
}

impl<'a> Observation<'a> {
    /// Each body will be within `tolerance` if any tier is as good, else by the best there is.
    pub fn at(
        ephemeris: &'a Ephemeris,
        instant: &Instant,
        place: &Place,
        tolerance: Tolerance,
    ) -> Observation<'a> {
        let observer = Observer::at(ephemeris, instant, place, tolerance);
        Observation { ephemeris, tolerance, observer, earths: Vec::new() }
    }

    pub fn observer(&self) -> &Observer {
        &self.observer
    }

    /// Where a body is seen.
    ///
    /// # Errors
    ///
    /// A date that no theory of the body serves.
    pub fn seen(&mut self, body: Body) -> Result<Seen, EphemerisError> {
        let (tier, error_bound) = self.ephemeris.choose(body, self.tolerance, self.observer.tdb)?;
        let earth = self.earth(tier)?;
        let place = ApparentPlace::of(self.ephemeris, body, tier, &self.observer, &earth)?;
        Ok(Seen { place, tier, error_bound })
    }

    /// Where a companion of a planet is seen, and how far it stands: `offset` is its place from the
    /// planet when its light left it, and `planet` where that is seen.
    ///
    /// # Errors
    ///
    /// A date that no theory of the Earth serves.
    pub fn beside(
        &mut self,
        planet: &Seen,
        offset: Pos<Icrs>,
    ) -> Result<(Dir<Icrs>, Pos<Icrs>), EphemerisError> {
        let earth = self.earth(planet.tier)?;
        let from_observer = planet.place.from_observer + offset;
        let source = (planet.place.from_sun + offset).dir();
        let observer_from_sun = (earth.position - earth.sun).km() + self.observer.position.km();
        let bent = deflect(from_observer.dir(), source, observer_from_sun);
        let dir = aberrate(bent, earth.velocity_km_s + self.observer.velocity_km_s);
        Ok((dir, from_observer))
    }

    /// The axes of the Moon's map when the light left it that arrives from there.
    pub fn moon_fixed_from_icrs(&self, moon: &ApparentPlace) -> Rot<MoonFixed, Icrs> {
        let light_time_s = moon.geocentric_distance_km / LIGHT_SPEED_KM_S;
        let departure = self.observer.tdb.plus_seconds(-light_time_s);
        self.ephemeris.moon_orientation().moon_fixed_from_icrs(departure)
    }

    /// Librations, axis and phase of the Moon where it is seen.
    pub fn moon_physical(&self, moon: &ApparentPlace) -> MoonPhysical {
        MoonPhysical::of(
            self.moon_fixed_from_icrs(moon),
            self.observer.true_from_icrs,
            moon.from_earth,
            moon.from_observer,
            moon.from_sun,
        )
    }

    /// What all stars have in common.
    ///
    /// # Errors
    ///
    /// A date that no theory of the Earth serves.
    pub fn stars(&mut self) -> Result<StarReduction, EphemerisError> {
        // Aberration and parallax of stars ask for the velocity of the Earth: 0.5" by the paper.
        let (tier, _) = self.ephemeris.choose(Body::Sun, self.tolerance, self.observer.tdb)?;
        let earth = self.earth(tier)?;
        Ok(StarReduction::new(&self.observer, &earth))
    }

    fn earth(&mut self, tier: Tier) -> Result<EarthState, EphemerisError> {
        if let Some((_, state)) = self.earths.iter().find(|(known, _)| *known == tier) {
            return Ok(*state);
        }
        let state = self.ephemeris.earth(self.observer.tdb, tier)?;
        self.earths.push((tier, state));
        Ok(state)
    }
}

//! The solar system out of one table: where its bodies are, from the barycentre.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::body::Body;
use super::moon::EARTH_MOON_MASS_RATIO;
use super::resampled::{Channel, Depth, Table};
use super::tables::EarthState;
use crate::frame::{Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::DAY_S;

/// Names of the channels of the planets, in the order of [`Body::PLANETS`].
const PLANETS: [&str; 8] =
    ["mercury", "venus", "mars", "jupiter", "saturn", "uranus", "neptune", "pluto"];
/// The first of them are told from the Sun, the others from the barycentre.
const PLANETS_FROM_SUN: usize = 3;

/// Parts of the way from the Earth to the Moon on both sides of their barycentre.
const EARTH_FROM_BARYCENTRE: f64 = 1.0 / (1.0 + EARTH_MOON_MASS_RATIO);
const MOON_FROM_BARYCENTRE: f64 = 1.0 - EARTH_FROM_BARYCENTRE;

/// The channels of one table. Kilometres, ICRS.
#[derive(Debug)]
pub(super) struct SolarSystem {
    depth: Depth,
    /// From the barycentre of the solar system.
    sun: Channel,
    /// Barycentre of the Earth and the Moon, from the Sun.
    earth_moon: Channel,
    /// From the Earth.
    moon: Channel,
    planets: [Channel; 8],
}

impl SolarSystem {
    /// An error says what is wrong with the table, to be read behind its name. `days_jd` is what
    /// the table must hold.
    pub fn new(table: Table, days_jd: RangeInclusive<f64>) -> Result<SolarSystem, String> {
        let depth = table.depth();
        let mut channels: Vec<Channel> = table.into_channels();
        let mut take = |id: &str| -> Result<Channel, String> {
            let Some(at) = channels.iter().position(|channel| channel.id() == id) else {
                return Err(format!("has no channel {id:?}"));
            };
            let channel = channels.swap_remove(at);
            let (first, last) = channel.span();
            if first.jd() > *days_jd.start() || last.jd() < *days_jd.end() {
                return Err(format!("ends its channel {id:?} within the years it should hold"));
            }
            Ok(channel)
        };
        let [mercury, venus, mars, jupiter, saturn, uranus, neptune, pluto] =
            PLANETS.map(&mut take);
        Ok(SolarSystem {
            depth,
            sun: take("sun")?,
            earth_moon: take("earth-moon")?,
            moon: take("moon")?,
            planets: [mercury?, venus?, mars?, jupiter?, saturn?, uranus?, neptune?, pluto?],
        })
    }

    /// The depth to which the table was read.
    pub fn depth(&self) -> Depth {
        self.depth
    }

    /// Position from the barycentre.
    pub fn position(&self, body: Body, tdb: JulianDate<Tdb>, depth: Depth) -> Pos<Icrs> {
        let at = |channel: &Channel| channel.value(tdb, depth);
        let km = match body {
            Body::Sun => at(&self.sun),
            Body::Moon => {
                at(&self.sun) + at(&self.earth_moon) + at(&self.moon) * MOON_FROM_BARYCENTRE
            }
            planet => {
                let (channel, from_sun) = self.planet(planet);
                let origin = if from_sun { at(&self.sun) } else { DVec3::ZERO };
                origin + at(channel)
            }
        };
        Pos::from_km(km)
    }

    /// Position from the barycentre, and velocity in kilometres per second.
    pub fn state(&self, body: Body, tdb: JulianDate<Tdb>, depth: Depth) -> (Pos<Icrs>, Pos<Icrs>) {
        let at = |channel: &Channel, share: f64| {
            let (km, km_per_day) = channel.value_and_rate(tdb, depth);
            (km * share, km_per_day * (share / DAY_S))
        };
        let sum = |parts: &[(DVec3, DVec3)]| {
            let zero = (DVec3::ZERO, DVec3::ZERO);
            let (km, km_s) =
                parts.iter().fold(zero, |(p, v), (more_p, more_v)| (p + more_p, v + more_v));
            (Pos::from_km(km), Pos::from_km(km_s))
        };
        match body {
            Body::Sun => sum(&[at(&self.sun, 1.0)]),
            Body::Moon => sum(&[
                at(&self.sun, 1.0),
                at(&self.earth_moon, 1.0),
                at(&self.moon, MOON_FROM_BARYCENTRE),
            ]),
            planet => {
                let (channel, from_sun) = self.planet(planet);
                let origin = if from_sun { at(&self.sun, 1.0) } else { (DVec3::ZERO, DVec3::ZERO) };
                sum(&[origin, at(channel, 1.0)])
            }
        }
    }

    /// The channel of a planet, and whether it is told from the Sun.
    fn planet(&self, planet: Body) -> (&Channel, bool) {
        let index = planet as usize - Body::Mercury as usize;
        (&self.planets[index], index < PLANETS_FROM_SUN)
    }

    /// The Earth, its velocity and the Sun, from the barycentre.
    pub fn earth(&self, tdb: JulianDate<Tdb>, depth: Depth) -> EarthState {
        let (sun, sun_rate) = self.sun.value_and_rate(tdb, depth);
        let (earth_moon, earth_moon_rate) = self.earth_moon.value_and_rate(tdb, depth);
        let (moon, moon_rate) = self.moon.value_and_rate(tdb, depth);
        EarthState {
            position: Pos::from_km(sun + earth_moon - moon * EARTH_FROM_BARYCENTRE),
            velocity_km_s: (sun_rate + earth_moon_rate - moon_rate * EARTH_FROM_BARYCENTRE) / DAY_S,
            sun: Pos::from_km(sun),
        }
    }
}

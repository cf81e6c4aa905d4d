//! The solar system out of one table: where its bodies are, from the barycentre.

use std::ops::RangeInclusive;

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
                let from_barycentre = 1.0 - 1.0 / (1.0 + EARTH_MOON_MASS_RATIO);
                at(&self.sun) + at(&self.earth_moon) + at(&self.moon) * from_barycentre
            }
            planet => {
                let index = planet as usize - Body::Mercury as usize;
                let origin =
                    if index < PLANETS_FROM_SUN { at(&self.sun) } else { glam::DVec3::ZERO };
                origin + at(&self.planets[index])
            }
        };
        Pos::from_km(km)
    }

    /// The Earth, its velocity and the Sun, from the barycentre.
    pub fn earth(&self, tdb: JulianDate<Tdb>, depth: Depth) -> EarthState {
        let (sun, sun_rate) = self.sun.value_and_rate(tdb, depth);
        let (earth_moon, earth_moon_rate) = self.earth_moon.value_and_rate(tdb, depth);
        let (moon, moon_rate) = self.moon.value_and_rate(tdb, depth);
        let share = 1.0 / (1.0 + EARTH_MOON_MASS_RATIO);
        EarthState {
            position: Pos::from_km(sun + earth_moon - moon * share),
            velocity_km_s: (sun_rate + earth_moon_rate - moon_rate * share) / DAY_S,
            sun: Pos::from_km(sun),
        }
    }
}

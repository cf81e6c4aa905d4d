//! The theories at hand: what is compiled in, and the tables that were read.

use std::sync::Arc;

use glam::DVec3;

use super::analytic::Analytic;
use super::body::Body;
use super::moon_orientation::MoonOrientation;
use super::orientation::{Nutation, Nutations};
use super::resampled::{Depth, Table};
use super::solar_system::SolarSystem;
use super::tier::{EphemerisError, Tier, Tolerance};
use crate::catalog::{CatalogError, Catalogs};
use crate::frame::{Icrs, Pos};
use crate::time::{JulianDate, Tdb, Tt};
use crate::units::Angle;

const DE440_FILE: &str = "de440.bin";
const DE431_FILE: &str = "de431.bin";

/// Where the Earth is, how fast it moves, and where the Sun is meanwhile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EarthState {
    /// From the same origin as [`Ephemeris::geometric`].
    pub position: Pos<Icrs>,
    /// Kilometres per second with respect to that origin, ICRS axes.
    pub velocity_km_s: DVec3,
    /// The Sun at the same moment: the origin itself by the analytic tiers, off it by up to two
    /// radii of the Sun where the origin is the barycentre.
    pub sun: Pos<Icrs>,
}

/// Everything that knows where bodies are. Cheap to clone; one serves a whole program.
#[derive(Debug, Clone, Default)]
pub struct Ephemeris {
    de440: Option<Arc<SolarSystem>>,
    de431: Option<Arc<SolarSystem>>,
    nutations: Nutations,
    moon_orientation: MoonOrientation,
}

/// Where a body was, and how it moved on until now.
#[derive(Debug, Clone, Copy)]
pub(super) struct Departure {
    pub position: Pos<Icrs>,
    /// Kilometres per second.
    pub velocity_km_s: Pos<Icrs>,
    /// How long ago.
    pub before_s: f64,
}

/// Who serves a tier.
enum Theory<'a> {
    Table(&'a SolarSystem, Depth),
    Analytic(Analytic),
}

impl Ephemeris {
    /// What is compiled in: the formulas of the paper and the series. Reads nothing.
    pub fn analytic() -> Ephemeris {
        Ephemeris::default()
    }

    /// With the tables among the catalogues, read as deep as a tolerance asks.
    ///
    /// # Errors
    ///
    /// A table that is missing or damaged.
    pub fn load(catalogs: &Catalogs, tolerance: Tolerance) -> Result<Ephemeris, CatalogError> {
        let depth = Tier::depth_for(tolerance);
        let read = |file: &str, depth: Depth, tier: Tier| {
            let layers = catalogs.layers(file, depth.layers())?;
            Table::open(layers)
                .and_then(|table| SolarSystem::new(table, tier.days_jd()))
                .map(|system| Some(Arc::new(system)))
                .map_err(|what| catalogs.damaged(file, what))
        };
        Ok(Ephemeris {
            de440: read(DE440_FILE, depth, Tier::De440(depth))?,
            nutations: Nutations::load(catalogs)?,
            moon_orientation: MoonOrientation::load(catalogs)?,
            de431: read(DE431_FILE, Depth::Tenth, Tier::De431)?,
        })
    }

    /// Whether the tables were read as deep as a tolerance asks: loading them for it gives no more.
    pub fn serves(&self, tolerance: Tolerance) -> bool {
        let depth = Tier::depth_for(tolerance);
        self.de440.as_ref().is_some_and(|table| table.depth() >= depth)
    }

    /// Whether a tier can be asked.
    pub fn has(&self, tier: Tier) -> bool {
        self.theory(tier).is_some()
    }

    /// The cheapest tier at hand whose error stays within the tolerance, else the best there is;
    /// with the bound of its error.
    ///
    /// # Errors
    ///
    /// A date that no tier serves.
    pub fn choose(
        &self,
        body: Body,
        tolerance: Tolerance,
        tdb: JulianDate<Tdb>,
    ) -> Result<(Tier, Angle), EphemerisError> {
        // The series know every body and hold longest: whom they refuse, nobody serves.
        Tier::Series.check(body, tdb)?;
        let mut best = (Tier::Series, Angle::from_deg(180.0));
        for tier in Tier::ALL.into_iter().filter(|&tier| self.has(tier)) {
            if let Some(bound) = tier.bound(body, tdb) {
                if bound <= tolerance {
                    return Ok((tier, bound));
                }
                if bound < best.1 {
                    best = (tier, bound);
                }
            }
        }
        Ok(best)
    }

    /// Geometric position of a body: where it is at that moment, no light time, no aberration.
    ///
    /// The origin belongs to the tier, and [`Ephemeris::earth`] has the same one: the barycentre of
    /// the solar system for the tables, the centre of the Sun for the analytic tiers. Giant planets
    /// and Pluto are the barycentres of their systems.
    ///
    /// # Errors
    ///
    /// A date outside the range of the tier, or a tier whose table was not read.
    pub fn geometric(
        &self,
        body: Body,
        tdb: JulianDate<Tdb>,
        tier: Tier,
    ) -> Result<Pos<Icrs>, EphemerisError> {
        tier.check(body, tdb)?;
        let theory = self.theory(tier).ok_or(EphemerisError::NotLoaded { body, tier })?;
        Ok(theory.position(body, tdb))
    }

    /// Geometric position and velocity of the centre of the Earth, origin as in
    /// [`Ephemeris::geometric`].
    ///
    /// # Errors
    ///
    /// A date outside the range of the tier, or a tier whose table was not read.
    pub fn earth(&self, tdb: JulianDate<Tdb>, tier: Tier) -> Result<EarthState, EphemerisError> {
        // The Sun is asked: that is whom the range is about.
        tier.check(Body::Sun, tdb)?;
        let not_loaded = EphemerisError::NotLoaded { body: Body::Sun, tier };
        Ok(match self.theory(tier).ok_or(not_loaded)? {
            Theory::Table(table, depth) => table.earth(tdb, depth),
            Theory::Analytic(analytic) => analytic.earth(tdb),
        })
    }

    /// A body near the moment when the light left it that arrives now, which may lie a little outside
    /// the range of the tier.
    ///
    /// # Errors
    ///
    /// As [`Ephemeris::geometric`].
    pub(super) fn departure(
        &self,
        body: Body,
        tdb: JulianDate<Tdb>,
        tier: Tier,
        light_time_s: impl FnOnce(Pos<Icrs>) -> f64,
    ) -> Result<Departure, EphemerisError> {
        tier.check(body, tdb)?;
        let theory = self.theory(tier).ok_or(EphemerisError::NotLoaded { body, tier })?;
        // Sun and Moon keep their distance: how long the light takes is known before.
        let known_s = match body {
            Body::Sun => Some(499.0),
            Body::Moon => Some(1.28),
            _ => None,
        };
        if let (Theory::Table(table, depth), Some(before_s)) = (&theory, known_s) {
            let (position, velocity_km_s) = table.state(body, tdb.plus_seconds(-before_s), *depth);
            return Ok(Departure { position, velocity_km_s, before_s });
        }
        let now = theory.position(body, tdb);
        let before_s = light_time_s(now);
        let position = theory.position(body, tdb.plus_seconds(-before_s));
        Ok(Departure { position, velocity_km_s: (now - position) * before_s.recip(), before_s })
    }

    /// Nutation within a tolerance, at the least cost.
    pub fn nutation(&self, tolerance: Tolerance, tt: JulianDate<Tt>) -> Nutation {
        self.nutations.within(tolerance, tt)
    }

    /// How the Moon stands.
    pub fn moon_orientation(&self) -> &MoonOrientation {
        &self.moon_orientation
    }

    fn theory(&self, tier: Tier) -> Option<Theory<'_>> {
        match tier {
            Tier::De440(depth) => {
                let table = self.de440.as_ref().filter(|table| table.depth() >= depth)?;
                Some(Theory::Table(table, depth))
            }
            Tier::De431 => Some(Theory::Table(self.de431.as_ref()?, Depth::Tenth)),
            Tier::Paper => Some(Theory::Analytic(Analytic::Paper)),
            Tier::Series => Some(Theory::Analytic(Analytic::Series)),
        }
    }
}

impl Theory<'_> {
    fn position(&self, body: Body, tdb: JulianDate<Tdb>) -> Pos<Icrs> {
        match self {
            Theory::Table(table, depth) => table.position(body, tdb, *depth),
            Theory::Analytic(analytic) => analytic.position(body, tdb),
        }
    }
}

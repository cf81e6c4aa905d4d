//! From catalogues of stars to where they are seen.
//!
//! *Theory.* A star moves in a straight line at constant speed: proper motion and radial velocity
//! give its velocity in space in units of its distance (Klioner 2003, AJ 125, 1580, without the
//! light time of the star). Time runs at the barycentre: light reaches an observer who stands nearer
//! to the star earlier (Roemer). Then annual parallax, deflection and aberration, as for planets.
//!
//! *How we differ.* The light time of the star itself is left out, as the routine `pmpx` of ERFA
//! leaves it out; ERFA's `starpm`, which brings a catalogue to another epoch, has it (Stumpff 1985,
//! A&A 144, 232). For Barnard's star that makes 0.0008" from 1991 to 1619, for Sirius nothing.
//!
//! *Accuracy.* Given the Earth of DE440, within 0.00001" of ERFA for Sirius and Polaris and 0.001"
//! for Barnard's star, 1600 to 2200. [`reduction_bound`] says what the Earth of each tier costs,
//! [`SpaceMotion::error_bound`] what the catalogue does. Orbits of double stars are omitted.

use glam::DVec3;

use super::apparent::{Observer, aberrate, deflect};
use super::tables::EarthState;
use super::tier::Tier;
use crate::catalog::{Astrometry, Star};
use crate::frame::{Dir, Horizon, Icrs, TrueOfDate};
use crate::time::{JulianDate, Tdb};
use crate::units::{AU_KM, Angle, DAY_S, LIGHT_SPEED_KM_S};

/// Days in a Julian year, which proper motions count.
const JULIAN_YEAR_DAYS: f64 = 365.25;
const JULIAN_YEAR_S: f64 = JULIAN_YEAR_DAYS * DAY_S;
/// Epoch of the Hipparcos catalogue, Julian years from J2000.0.
const HIPPARCOS_EPOCH_YEARS: f64 = 1991.25 - 2000.0;
/// A radial velocity of 1 km/s in astronomical units a year.
const AU_YR_FROM_KM_S: f64 = JULIAN_YEAR_S / AU_KM;
/// No star is nearer than Proxima Centauri (0.7687"); larger parallaxes are misprints.
const PARALLAX_MAX_ARCSEC: f64 = 0.77;
/// No naked-eye star is faster; the escape velocity of the Galaxy is near 550 km/s.
const SPEED_MAX_KM_S: f64 = 600.0;

/// The Bright Star Catalogue rounds right ascensions to 0.1 s and declinations to 1", and its FK5
/// is the ICRS within 0.1".
const BSC_POSITION_ERROR: Angle = Angle::from_arcsec(1.0);
/// Its proper motions a year; companions in close orbits may do worse.
const BSC_MOTION_ERROR: Angle = Angle::from_arcsec(0.02);

/// Where a star is and how it moves, from the barycentre of the solar system at J2000.0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpaceMotion {
    dir: DVec3,
    /// Velocity per Julian year, in units of the star's distance.
    per_year: DVec3,
    /// What an astronomical unit is in units of the star's distance.
    parallax_rad: f64,
    /// What the catalogue may be off by at J2000.0, and by how much more each year.
    position_error: Angle,
    motion_error: Angle,
}

impl SpaceMotion {
    /// From what a catalogue says at its epoch; what cannot be true of a star (a parallax that is
    /// negative, not a number or nearer than Proxima, a velocity beyond the Galaxy's) is not believed.
    fn from_catalogue(
        dir: Dir<Icrs>,
        [motion_ra_arcsec_yr, motion_dec_arcsec_yr]: [f64; 2],
        parallax_arcsec: f64,
        radial_velocity_km_s: f64,
    ) -> SpaceMotion {
        let dir = dir.vector();
        // East, in the plane of the equator, and north. At a pole of the axes any east will do.
        let east = DVec3::new(-dir.y, dir.x, 0.0).try_normalize().unwrap_or(DVec3::Y);
        let north = dir.cross(east);
        let rad = |arcsec: f64| {
            if arcsec.is_finite() { Angle::from_arcsec(arcsec).rad() } else { 0.0 }
        };
        // A NaN is not larger than zero.
        let is_near = parallax_arcsec > 0.0;
        let parallax_rad =
            rad(if is_near { parallax_arcsec.min(PARALLAX_MAX_ARCSEC) } else { 0.0 });
        let is_bound = radial_velocity_km_s.abs() <= SPEED_MAX_KM_S;
        let radial_km_s = if is_bound { radial_velocity_km_s } else { 0.0 };
        let per_year = east * rad(motion_ra_arcsec_yr)
            + north * rad(motion_dec_arcsec_yr)
            + dir * (radial_km_s * AU_YR_FROM_KM_S * parallax_rad);
        let (position_error, motion_error) = (Angle::ZERO, Angle::ZERO);
        SpaceMotion { dir, per_year, parallax_rad, position_error, motion_error }
    }

    /// The same motion, told of the epoch `years` later.
    fn after(self, years: f64) -> SpaceMotion {
        let moved = self.dir + self.per_year * years;
        // The distance then, in units of the distance now.
        let distance = moved.length();
        SpaceMotion {
            dir: moved / distance,
            per_year: self.per_year / distance,
            parallax_rad: self.parallax_rad / distance,
            ..self
        }
    }

    /// Direction from the barycentre at a date: no parallax, no aberration.
    pub fn direction(&self, tdb: JulianDate<Tdb>) -> Dir<Icrs> {
        Dir::from_vector(self.dir + self.per_year * julian_years(tdb))
    }

    /// Speed per Julian year, in units of the star's distance: along the line of sight and across it.
    pub fn speed_per_year(&self) -> f64 {
        self.per_year.length()
    }

    /// How far off the catalogue may put the star at a date: its rounding and its proper motions.
    ///
    /// Zero for the milliarcsecond astrometry of [`Astrometry`], whose numbers are taken as they are.
    pub fn error_bound(&self, tdb: JulianDate<Tdb>) -> Angle {
        self.position_error + self.motion_error * julian_years(tdb).abs()
    }
}

impl From<&Star> for SpaceMotion {
    fn from(star: &Star) -> SpaceMotion {
        let motion = [star.proper_motion_ra_arcsec_yr, star.proper_motion_dec_arcsec_yr];
        let Star { dir_j2000, parallax_arcsec, radial_velocity_km_s, .. } = *star;
        SpaceMotion {
            position_error: BSC_POSITION_ERROR,
            motion_error: BSC_MOTION_ERROR,
            ..SpaceMotion::from_catalogue(dir_j2000, motion, parallax_arcsec, radial_velocity_km_s)
        }
    }
}

/// Brought from J1991.25 to J2000.0.
impl From<&Astrometry> for SpaceMotion {
    fn from(star: &Astrometry) -> SpaceMotion {
        let motion = [star.proper_motion_ra_arcsec_yr, star.proper_motion_dec_arcsec_yr];
        let Astrometry { dir_j1991_25, parallax_arcsec, radial_velocity_km_s, .. } = *star;
        SpaceMotion::from_catalogue(dir_j1991_25, motion, parallax_arcsec, radial_velocity_km_s)
            .after(-HIPPARCOS_EPOCH_YEARS)
    }
}

/// Julian years from J2000.0.
fn julian_years(tdb: JulianDate<Tdb>) -> f64 {
    tdb.days_since_j2000() / JULIAN_YEAR_DAYS
}

/// Bound of the error that the reduction adds to what the catalogue says, with the Earth of a tier.
///
/// Its velocity tilts the direction: by 0.011" too much or too little where the Sun stands for the
/// barycentre, as it does in the analytic tiers.
pub const fn reduction_bound(tier: Tier) -> Angle {
    match tier {
        Tier::De440(_) => Angle::from_arcsec(0.001),
        Tier::De431 => Angle::from_arcsec(0.01),
        Tier::Paper => Angle::from_arcsec(0.2),
        Tier::Series => Angle::from_arcsec(0.03),
    }
}

/// Where somebody is who looks at the stars, and how he moves.
#[derive(Debug, Clone, Copy)]
struct Station {
    /// From the origin of the theory: the barycentre, or the Sun where that stands for it.
    from_origin_km: DVec3,
    from_sun_km: DVec3,
    velocity_km_s: DVec3,
}

impl Station {
    #[inline]
    fn sees(&self, star: &SpaceMotion, years: f64) -> Dir<Icrs> {
        let earlier_s = self.from_origin_km.dot(star.dir) / LIGHT_SPEED_KM_S;
        let moved = star.dir + star.per_year * (years + earlier_s / JULIAN_YEAR_S);
        let parallactic = self.from_origin_km * (star.parallax_rad / AU_KM);
        let dir = Dir::from_vector(moved - parallactic);
        // A star is so far that it stands in the same direction from the Sun.
        aberrate(deflect(dir, dir, self.from_sun_km), self.velocity_km_s)
    }
}

/// What all stars have in common at one instant.
#[derive(Debug, Clone, Copy)]
pub struct StarReduction {
    observer: Observer,
    years: f64,
    centre: Station,
    surface: Station,
}

impl StarReduction {
    /// `earth` is the Earth at the observer's time.
    pub fn new(observer: &Observer, earth: &EarthState) -> StarReduction {
        let centre = Station {
            from_origin_km: earth.position.km(),
            from_sun_km: (earth.position - earth.sun).km(),
            velocity_km_s: earth.velocity_km_s,
        };
        let surface = Station {
            from_origin_km: centre.from_origin_km + observer.position.km(),
            from_sun_km: centre.from_sun_km + observer.position.km(),
            velocity_km_s: centre.velocity_km_s + observer.velocity_km_s,
        };
        StarReduction { observer: *observer, years: julian_years(observer.tdb), centre, surface }
    }

    /// Apparent topocentric direction in ICRS axes: no air.
    pub fn icrs(&self, star: impl Into<SpaceMotion>) -> Dir<Icrs> {
        self.surface.sees(&star.into(), self.years)
    }

    /// Apparent direction from the centre of the Earth.
    pub fn geocentric(&self, star: impl Into<SpaceMotion>) -> Dir<TrueOfDate> {
        self.observer.true_from_icrs * self.centre.sees(&star.into(), self.years)
    }

    /// Apparent direction from the observer's place: no air.
    pub fn topocentric(&self, star: impl Into<SpaceMotion>) -> Dir<TrueOfDate> {
        self.observer.true_from_icrs * self.icrs(star)
    }

    /// As [`StarReduction::topocentric`], in local axes.
    pub fn horizon(&self, star: impl Into<SpaceMotion>) -> Dir<Horizon> {
        self.observer.horizon_from_icrs * self.icrs(star)
    }

    /// As [`StarReduction::horizon`], for a whole catalogue.
    pub fn horizon_all<S: Into<SpaceMotion>>(
        &self,
        stars: impl IntoIterator<Item = S>,
    ) -> Vec<Dir<Horizon>> {
        stars.into_iter().map(|star| self.horizon(star)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Magnitude;

    fn star(proper_motion_ra_arcsec_yr: f64, parallax_arcsec: f64, velocity_km_s: f64) -> Star {
        Star {
            hr: 0,
            hip: None,
            hd: None,
            designation: None,
            flamsteed: None,
            name: None,
            dir_j2000: Dir::from_spherical(Angle::from_deg(40.0), Angle::ZERO),
            proper_motion_ra_arcsec_yr,
            proper_motion_dec_arcsec_yr: 0.0,
            parallax_arcsec,
            radial_velocity_km_s: velocity_km_s,
            magnitude: Magnitude(0.0),
            b_v: 0.0,
            spectral_type: String::new(),
            variable: None,
            companion: None,
        }
    }

    fn after_years(star: &Star, years: f64) -> Dir<Icrs> {
        SpaceMotion::from(star)
            .direction(JulianDate::from_jd(2_451_545.0 + years * JULIAN_YEAR_DAYS))
    }

    #[test]
    fn a_star_moves_in_a_straight_line() {
        // Across the line of sight: tan of the angle grows with time, towards east.
        let moved = after_years(&star(10.0, 0.0, 0.0), -6000.0);
        let angle = Angle::from_deg(40.0) - moved.longitude();
        assert!((angle.tan() - Angle::from_arcsec(60_000.0).rad()).abs() < 1e-12);
        // 100 km/s are 1.0227e-4 parsecs a year: of 10 parsecs a hundredth in a millennium, and what
        // moves across gains by as much.
        let moved = after_years(&star(1.0, 0.1, -100.0), 1000.0);
        let gain =
            Angle::from_arcsec(1000.0).rad() / (moved.longitude() - Angle::from_deg(40.0)).tan();
        assert!((gain - (1.0 - 0.010_227)).abs() < 1e-6, "{gain}");
    }

    #[test]
    fn what_cannot_be_measured_is_not_believed() {
        let still = star(0.0, 0.0, 0.0).dir_j2000;
        for nonsense in [
            star(f64::NAN, f64::NAN, f64::NAN),
            star(0.0, -0.05, 300.0),
            star(0.0, 0.1, 1e9),
            star(f64::INFINITY, 0.1, f64::INFINITY),
        ] {
            assert!(after_years(&nonsense, -6000.0).separation(still).arcsec() < 1e-9);
        }
        let near = SpaceMotion::from(&star(0.0, 12.0, 0.0));
        assert_eq!(near.parallax_rad, Angle::from_arcsec(PARALLAX_MAX_ARCSEC).rad());
    }
}

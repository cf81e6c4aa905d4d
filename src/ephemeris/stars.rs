//! From the catalogue of stars to where they are seen.
//!
//! *Theory.* A star moves in a straight line at constant speed: proper motion and radial velocity
//! give its velocity in space, in units of its distance (Klioner 2003 without light time). Then
//! annual parallax, deflection, aberration, as for planets.
//!
//! *Accuracy.* As good as the catalogue. A proper motion of the Bright Star Catalogue is good to
//! some 0.005" a year, so a bright star is uncertain by 30" at -4000. Orbits of double stars are
//! omitted. The Earth's place about the Sun stands for that about the barycentre: 0.008" at most in
//! the parallax.

use glam::DVec3;

use super::apparent::{Observer, aberrate, deflect};
use super::tables::EarthState;
use crate::catalog::Star;
use crate::frame::{Dir, Horizon, Icrs};
use crate::time::{JulianDate, Tdb};
use crate::units::{AU_KM, Angle, DAY_S};

/// Days in a Julian year, which proper motions count.
const JULIAN_YEAR_DAYS: f64 = 365.25;
/// A radial velocity of 1 km/s in astronomical units a year.
const AU_YR_FROM_KM_S: f64 = JULIAN_YEAR_DAYS * DAY_S / AU_KM;
/// No star is nearer than Proxima Centauri (0.7687"); larger parallaxes are misprints.
const PARALLAX_MAX_ARCSEC: f64 = 0.77;
/// No naked-eye star is faster; the escape velocity of the Galaxy is near 550 km/s.
const SPEED_MAX_KM_S: f64 = 600.0;

/// Parallax, with what cannot be one (negative, not a number, nearer than Proxima) made harmless.
fn parallax(star: &Star) -> Angle {
    if star.parallax_arcsec > 0.0 {
        Angle::from_arcsec(star.parallax_arcsec.min(PARALLAX_MAX_ARCSEC))
    } else {
        Angle::ZERO
    }
}

/// Velocity in space per Julian year, in units of the star's distance at J2000.0.
fn motion_per_year(star: &Star) -> DVec3 {
    let dir = star.dir_j2000.vector();
    // East, in the plane of the equator, and north. At a pole of the axes any east will do.
    let east = DVec3::new(-dir.y, dir.x, 0.0).try_normalize().unwrap_or(DVec3::Y);
    let north = dir.cross(east);
    let rad_from_arcsec = |arcsec: f64| {
        if arcsec.is_finite() { Angle::from_arcsec(arcsec).rad() } else { 0.0 }
    };
    let radial = if star.radial_velocity_km_s.abs() <= SPEED_MAX_KM_S {
        star.radial_velocity_km_s * AU_YR_FROM_KM_S * parallax(star).rad()
    } else {
        0.0
    };
    east * rad_from_arcsec(star.proper_motion_ra_arcsec_yr)
        + north * rad_from_arcsec(star.proper_motion_dec_arcsec_yr)
        + dir * radial
}

/// Barycentric direction of a star at a date: proper motion and motion along the line of sight, no
/// parallax, no aberration.
pub fn direction(star: &Star, tdb: JulianDate<Tdb>) -> Dir<Icrs> {
    let years = tdb.days_since_j2000() / JULIAN_YEAR_DAYS;
    Dir::from_vector(star.dir_j2000.vector() + motion_per_year(star) * years)
}

/// What all stars have in common at one instant.
#[derive(Debug, Clone, Copy)]
pub struct StarReduction {
    observer: Observer,
    years: f64,
    /// From the origin of the theory: the barycentre, or the Sun where that stands for it.
    observer_from_origin_km: DVec3,
    observer_from_sun_km: DVec3,
    velocity_km_s: DVec3,
}

impl StarReduction {
    /// `earth` is the Earth at the observer's time.
    pub fn new(observer: &Observer, earth: &EarthState) -> StarReduction {
        StarReduction {
            observer: *observer,
            years: observer.tdb.days_since_j2000() / JULIAN_YEAR_DAYS,
            observer_from_origin_km: (earth.position + observer.position).km(),
            observer_from_sun_km: (earth.position - earth.sun + observer.position).km(),
            velocity_km_s: earth.velocity_km_s + observer.velocity_km_s,
        }
    }

    /// Apparent topocentric direction in ICRS axes: aberration and parallax, no air.
    pub fn icrs(&self, star: &Star) -> Dir<Icrs> {
        let moved = star.dir_j2000.vector() + motion_per_year(star) * self.years;
        let parallactic = self.observer_from_origin_km * (parallax(star).rad() / AU_KM);
        let dir = Dir::from_vector(moved - parallactic);
        // A star is so far that it stands in the same direction from the Sun.
        aberrate(deflect(dir, dir, self.observer_from_sun_km), self.velocity_km_s)
    }

    /// Apparent topocentric direction in local axes, no air.
    pub fn horizon(&self, star: &Star) -> Dir<Horizon> {
        self.observer.horizon_from_icrs * self.icrs(star)
    }

    /// As [`StarReduction::horizon`], for a whole catalogue.
    pub fn horizon_all(&self, stars: &[Star]) -> Vec<Dir<Horizon>> {
        stars.iter().map(|star| self.horizon(star)).collect()
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
            designation: None,
            name: None,
            dir_j2000: Dir::from_spherical(Angle::from_deg(40.0), Angle::ZERO),
            proper_motion_ra_arcsec_yr,
            proper_motion_dec_arcsec_yr: 0.0,
            parallax_arcsec,
            radial_velocity_km_s: velocity_km_s,
            magnitude: Magnitude(0.0),
            b_v: 0.0,
            spectral_type: String::new(),
        }
    }

    fn after_years(star: &Star, years: f64) -> Dir<Icrs> {
        direction(star, JulianDate::from_jd(2_451_545.0 + years * JULIAN_YEAR_DAYS))
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
        assert_eq!(parallax(&star(0.0, 12.0, 0.0)).arcsec(), PARALLAX_MAX_ARCSEC);
    }
}

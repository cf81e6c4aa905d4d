//! Axes that grids are drawn in, and where a direction written in them is seen.
//!
//! Equator and ecliptic of date are geometric: apparent places have the aberration in their numbers.
//! Right ascension and declination of J2000.0 are those of catalogues: aberration moves the grid along with
//! the stars. Below the horizon what is drawn is bent as the air would bend it where it is drawn.

use glam::{DMat3, DVec3};

use crate::air::refraction::Refraction;
use crate::catalog::Astrometry;
use crate::ephemeris::orientation::ecliptic_from_icrs;
use crate::frame::{Apparent, Dir, Horizon, Icrs, Itrs, galactic_from_icrs};
use crate::light::night::Night;
use crate::sky::SkyState;
use crate::units::Angle;

/// Axes with a longitude and a latitude.
pub enum Axes<'a> {
    /// Azimuth and altitude as seen.
    Local,
    /// Turned against the horizon.
    Turned { horizon_from_axes: DMat3, refraction: &'a Refraction },
    /// Right ascension and declination of catalogues.
    Catalogue { sky: &'a SkyState, refraction: &'a Refraction },
}

impl<'a> Axes<'a> {
    /// True equator and equinox of date.
    pub fn equator(night: &'a Night) -> Axes<'a> {
        let sky = &night.sky;
        let itrs_pole: Dir<Itrs> = Dir::from_vector(DVec3::Z);
        let pole = (sky.place.horizon_from_itrs() * itrs_pole).vector();
        let ecliptic_pole = sky.horizon_from_icrs.matrix()
            * ecliptic_from_icrs(sky.instant.tt).matrix().transpose().z_axis;
        let equinox = pole.cross(ecliptic_pole).normalize();
        let horizon_from_axes = DMat3::from_cols(equinox, pole.cross(equinox), pole);
        Axes::Turned { horizon_from_axes, refraction: &night.refraction }
    }

    /// Mean ecliptic and equinox of date.
    pub fn ecliptic(night: &'a Night) -> Axes<'a> {
        Axes::turned(night, ecliptic_from_icrs(night.sky.instant.tt).matrix())
    }

    /// Galactic longitude and latitude.
    pub fn galactic(night: &'a Night) -> Axes<'a> {
        Axes::turned(night, galactic_from_icrs().matrix())
    }

    /// Equator and equinox of J2000.0.
    pub fn j2000(night: &'a Night) -> Axes<'a> {
        Axes::Catalogue { sky: &night.sky, refraction: &night.refraction }
    }

    fn turned(night: &'a Night, axes_from_icrs: DMat3) -> Axes<'a> {
        let horizon_from_axes = night.sky.horizon_from_icrs.matrix() * axes_from_icrs.transpose();
        Axes::Turned { horizon_from_axes, refraction: &night.refraction }
    }

    /// Where a longitude and latitude, radians, are seen.
    pub fn at(&self, longitude: f64, latitude: f64) -> Dir<Apparent> {
        let [longitude, latitude] = [longitude, latitude].map(Angle::from_rad);
        match self {
            Axes::Local => Dir::from_azimuth_altitude(longitude, latitude),
            Axes::Turned { horizon_from_axes, refraction } => {
                let dir: Dir<Horizon> = Dir::from_spherical(longitude, latitude);
                let turned = Dir::from_vector(*horizon_from_axes * dir.vector());
                refraction.apparent_from_horizon(turned)
            }
            Axes::Catalogue { sky, refraction } => {
                let dir = far_away(sky, Dir::from_spherical(longitude, latitude));
                refraction.apparent_from_horizon(dir)
            }
        }
    }

    /// Longitude and latitude, radians, of what is seen in a direction.
    pub fn of(&self, dir: Dir<Apparent>) -> (f64, f64) {
        let spherical = |v: DVec3| (v.y.atan2(v.x), v.z.atan2(v.x.hypot(v.y)));
        match self {
            Axes::Local => (dir.azimuth().rad(), dir.altitude().rad()),
            Axes::Turned { horizon_from_axes, refraction } => {
                let dir = refraction.horizon_from_apparent(dir).vector();
                spherical(horizon_from_axes.transpose() * dir)
            }
            Axes::Catalogue { sky, refraction } => {
                let seen = refraction.horizon_from_apparent(dir);
                let axes = sky.horizon_from_icrs.inverse();
                let guess: Dir<Icrs> = axes * seen;
                // What aberration does to the guess it does to what is meant, within 0.002".
                let moved = (axes * far_away(sky, guess)).vector() - guess.vector();
                spherical(guess.vector() - moved)
            }
        }
    }
}

/// Where something that stands still far away is: with aberration, without air.
pub fn far_away(sky: &SkyState, dir_j2000: Dir<Icrs>) -> Dir<Horizon> {
    sky.star(&Astrometry {
        names: Vec::new(),
        hip: 0,
        dir_j1991_25: dir_j2000,
        proper_motion_ra_arcsec_yr: 0.0,
        proper_motion_dec_arcsec_yr: 0.0,
        parallax_arcsec: 0.0,
        radial_velocity_km_s: 0.0,
    })
}

//! Where the Moon stands in the shadow of the Earth.
//!
//! *Theory.* Sun and Moon are taken where they are seen, with aberration, and the Earth where it is:
//! in its own frame sunlight comes from the apparent Sun, and what counts is who stands in its way.
//! The distance of the Moon from the axis of the shadow is then, but for the enlargement, that of
//! [`crate::almanac::eclipse`].

use glam::DVec3;

use super::ShadowDistances;
use crate::frame::{Horizon, Pos};
use crate::sky::SkyState;
use crate::units::{Angle, MOON_RADIUS_KM};

/// The Moon, the Sun and the Earth as seen from each other.
#[derive(Debug, Clone, Copy)]
pub struct ShadowedMoon {
    /// From the Moon's centre.
    pub distances: ShadowDistances,
    /// Between the centres of the Sun and of the Earth, seen from the Moon's centre.
    pub offset: Angle,
    /// From the Moon's centre, in local axes, kilometres.
    to_sun: Pos<Horizon>,
    to_earth: Pos<Horizon>,
}

impl ShadowedMoon {
    pub fn of(sky: &SkyState) -> ShadowedMoon {
        let place = &sky.place;
        let earth = place.horizon_from_itrs() * -place.itrs();
        let moon = sky.moon.state.dir.at_km(sky.moon.state.distance_km);
        let sun = sky.sun.dir.at_km(sky.sun.distance_km);
        let (to_sun, to_earth) = (sun - moon, earth - moon);
        ShadowedMoon {
            distances: ShadowDistances {
                sun_km: to_sun.distance_km(),
                earth_km: to_earth.distance_km(),
            },
            offset: to_sun.dir().separation(to_earth.dir()),
            to_sun,
            to_earth,
        }
    }

    /// How much the offset differs between the middle of the Moon's disc and its rim.
    pub fn disc_radius(&self) -> Angle {
        let ShadowDistances { sun_km, earth_km } = self.distances;
        Angle::from_rad(MOON_RADIUS_KM * (earth_km.recip() - sun_km.recip()))
    }

    /// Whether no point of the Moon is touched by the shadow.
    pub fn is_outside(&self) -> bool {
        self.offset - self.disc_radius() >= self.distances.outer_rim()
    }

    /// Offset at a point of the Moon, given from its centre in local axes, kilometres: what to ask the
    /// table for.
    ///
    /// A point nearer to the Earth sees it larger; its offset is lessened by as much.
    pub fn offset_at(&self, from_centre_km: DVec3) -> Angle {
        let point: Pos<Horizon> = Pos::from_km(from_centre_km);
        let (sun, earth) = (self.to_sun - point, self.to_earth - point);
        sun.dir().separation(earth.dir()) * (earth.distance_km() / self.distances.earth_km)
    }

    /// Directions from the Moon's centre to the Sun and to the Earth, local axes, kilometres.
    pub fn to_sun_and_earth_km(&self) -> [DVec3; 2] {
        [self.to_sun.km(), self.to_earth.km()]
    }
}

//! The light of the stars that are not drawn one by one, as a picture shows it: a map, and what the
//! air lets through of it at each altitude.

use std::sync::Arc;

use crate::frame::{Apparent, Dir, Galactic, Horizon, Rot};
use crate::light::dark_sky::{DarkSky, NightAir, OneS10};
use crate::light::starlight::{self, Starlight};
use crate::units::{Angle, Xyzv};

use super::SKY_SHAPE;

/// The Milky Way over a picture.
#[derive(Debug, Clone)]
pub struct MilkyWayPlan {
    /// Light outside the air.
    pub starlight: Starlight,
    axes: Rot<Galactic, Horizon>,
    air: NightAir,
    horizon: Angle,
    /// By the rows of [`SKY_SHAPE`] above the horizon.
    rows: Arc<[OneS10]>,
}

/// Where a direction looks in the Milky Way, and what arrives from there of 1 S10(V), with what the
/// dust sends back of it, cd/m2.
#[derive(Debug, Clone, Copy)]
pub struct MilkyWaySight {
    pub dir: Dir<Galactic>,
    /// Of the bluest and of the reddest mix of stars.
    pub of_one_s10: [Xyzv; 2],
}

impl MilkyWayPlan {
    /// None if it does not shine. Given the altitudes of the rows.
    pub fn of(sky: &DarkSky, horizon: Angle, altitudes: &[Angle]) -> Option<MilkyWayPlan> {
        let (starlight, axes) = sky.starlight()?.clone();
        let air = sky.air().clone();
        let rows = altitudes.iter().filter_map(|&altitude| air.of_one_s10(altitude)).collect();
        Some(MilkyWayPlan { starlight, axes, air, horizon, rows })
    }

    /// The same under a sky that has turned.
    pub(super) fn turned(&self, axes: Rot<Galactic, Horizon>) -> MilkyWayPlan {
        MilkyWayPlan { axes, ..self.clone() }
    }

    /// Apparent altitude at which the ground begins.
    pub fn horizon(&self) -> Angle {
        self.horizon
    }

    /// What a direction sees, were there no ground.
    pub fn sight(&self, dir: Dir<Apparent>) -> Option<MilkyWaySight> {
        let galactic = self.axes * self.air.outside(dir);
        let (row, up) = SKY_SHAPE.row_at(dir.altitude(), self.horizon, true);
        let (low, high) = (self.rows.get(row)?, self.rows.get(row + 1)?);
        let between = |of: fn(&OneS10) -> Xyzv| of(low) * (1.0 - up) + of(high) * up;
        let dust = between(|of| of.dust) * starlight::diffuse_share(galactic.latitude());
        let of_one_s10 = [between(|of| of.blue) + dust, between(|of| of.red) + dust];
        Some(MilkyWaySight { dir: galactic, of_one_s10 })
    }

    /// The light that comes straight from an apparent direction, cd/m2: the twin of
    /// `shaders/milky_way.wgsl`.
    pub fn luminance(&self, dir: Dir<Apparent>) -> Xyzv {
        let sight = self.sight(dir).filter(|_| dir.altitude() >= self.horizon);
        sight.map_or(Xyzv::BLACK, |MilkyWaySight { dir, of_one_s10: [blue, red] }| {
            let (s10, colour) = (self.starlight.s10(dir), self.starlight.colour(dir));
            (blue * (1.0 - colour) + red * colour) * s10
        })
    }
}

//! The shadow of the Earth on the globe.

use glam::{DMat3, DVec3};

use super::COLOURS_NM;
use crate::light::earth_shadow::{EarthShadow, ShadowedMoon};
use crate::units::{Angle, MOON_RADIUS_KM};

/// The shadow of the Earth on the Moon.
#[derive(Debug, Clone, PartialEq)]
pub struct UmbraTable {
    /// Of the Sun and of the Earth from the Moon's centre, in the Moon's own axes and radii.
    pub to_sun: DVec3,
    pub to_earth: DVec3,
    /// Angle between the two, seen from a point, at the last node.
    pub rim: Angle,
    /// What is left of the Sun's light at 643, 566 and 415 nm, from the axis to the rim in even steps, over
    /// the most that is left anywhere on the Moon.
    pub shares: Vec<[f64; 3]>,
}

impl UmbraTable {
    const NODES: usize = 512;

    pub fn of(shadow: &EarthShadow, place: &ShadowedMoon, body_from_horizon: &DMat3) -> UmbraTable {
        let radii = |km: DVec3| *body_from_horizon * km / MOON_RADIUS_KM;
        let [to_sun, to_earth] = place.to_sun_and_earth_km().map(radii);
        let rim = place.distances.outer_rim();
        let share = |offset: Angle| {
            let light = shadow.light_at(offset);
            COLOURS_NM.map(|nm| light.at_nm(nm))
        };
        let most = share(place.offset + place.disc_radius()).into_iter().fold(1e-9, f64::max);
        let node = |node: usize| {
            share(rim * (node as f64 / (UmbraTable::NODES - 1) as f64)).map(|share| share / most)
        };
        UmbraTable { to_sun, to_earth, rim, shares: (0..UmbraTable::NODES).map(node).collect() }
    }
}

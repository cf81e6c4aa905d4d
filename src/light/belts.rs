//! Bands of cloud along the parallels of Jupiter.
//!
//! *Theory.* A belt takes a share of the light that its law sends back; its edges are soft, a smooth step
//! in the sine of the planetographic latitude. A zone is what lies between belts.
//!
//! *Data.* Edges: mean latitudes of Rogers 1995, *The Giant Planet Jupiter*, appendix. Depths: rounded
//! from I/F near 550 nm, some 0.75 in zones and 0.6 in belts (Mendikoa et al. 2017, *Astron.
//! Astrophys.* 607, A72). Both recalled, not compared with the publications.
//!
//! *Omitted.* The Great Red Spot and all else along a parallel, the years in which belts fade, and
//! colour: belts are brown, and here as white as zones. Saturn's belts, of a twentieth.

use crate::ephemeris::Body;
use crate::units::Angle;

/// A band that is darker than what lies beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Belt {
    pub name: &'static str,
    /// Edges, planetographic latitude; a pole is beyond 90 degrees.
    pub south: Angle,
    pub north: Angle,
    /// Share of the light that it takes, 0 to 1.
    pub depth: f64,
}

/// Half of the width of an edge, in the sine of the latitude.
pub const EDGE: f64 = 0.03;

const fn belt(name: &'static str, [south_deg, north_deg]: [f64; 2], depth: f64) -> Belt {
    Belt { name, south: Angle::from_deg(south_deg), north: Angle::from_deg(north_deg), depth }
}

/// From south to north.
pub const JUPITER: [Belt; 8] = [
    belt("south polar region", [-100.0, -53.0], 0.16),
    belt("south south temperate", [-40.0, -36.0], 0.06),
    belt("south temperate", [-33.0, -27.0], 0.10),
    belt("south equatorial", [-20.0, -7.0], 0.20),
    belt("north equatorial", [7.0, 18.0], 0.23),
    belt("north temperate", [24.0, 31.0], 0.10),
    belt("north north temperate", [35.0, 39.0], 0.06),
    belt("north polar region", [48.0, 100.0], 0.15),
];

/// The belts of a planet; none but of Jupiter.
pub fn of(body: Body) -> &'static [Belt] {
    if body == Body::Jupiter { &JUPITER } else { &[] }
}

impl Belt {
    /// Sines of the edges. Beyond a pole there is no edge.
    pub fn sines(&self) -> [f64; 2] {
        [self.south, self.north].map(|edge| match edge.deg() {
            south if south < -90.0 => -2.0,
            north if north > 90.0 => 2.0,
            _ => edge.sin(),
        })
    }

    /// Share of the light that it leaves, given the sine of a planetographic latitude.
    pub fn leaves(&self, sin_latitude: f64) -> f64 {
        let [south, north] = self.sines();
        1.0 - self.depth * step(sin_latitude - south) * step(north - sin_latitude)
    }
}

/// From 0 to 1 across an edge.
fn step(beyond: f64) -> f64 {
    let t = (0.5 + 0.5 * beyond / EDGE).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn belts_lie_in_order_with_zones_between() {
        for pair in JUPITER.windows(2) {
            assert!(pair[0].south < pair[0].north && pair[0].north < pair[1].south, "{pair:?}");
        }
        let at = |latitude_deg: f64| {
            let sin = latitude_deg.to_radians().sin();
            of(Body::Jupiter).iter().map(|belt| belt.leaves(sin)).product::<f64>()
        };
        assert!(at(0.0) > 0.99 && at(21.5) > 0.9);
        assert!((at(12.5) - 0.77).abs() < 0.01 && (at(-13.5) - 0.80).abs() < 0.01);
        assert!((at(90.0) - 0.85).abs() < 1e-12 && (at(-90.0) - 0.84).abs() < 1e-12);
        assert!(of(Body::Saturn).is_empty());
    }
}

//! The shadow of the Moon in the air: what of the Sun is left at each place around an observer.
//!
//! *Theory.* Two circles, as in [`crate::light::solar_eclipse`], but seen from there: the Moon is shifted
//! by parallax, 0.9 arcminutes for 100 km across the line to it, while the Sun stays. Within the umbra,
//! some 100 km across, the corona alone is left; from its edge on the share grows as the power 1.5 of the
//! distance, and the penumbra reaches 3500 km.
//!
//! *Left out.* What [`crate::light::solar_eclipse`] leaves out: the Moon is round.
//!
//! *Accuracy.* 0.0002 of the whole Sun, between the nodes of a table (tested).

use glam::DVec3;

use crate::light::corona;
use crate::light::solar_eclipse::CoveredSun;
use crate::sky::SkyState;
use crate::units::{Angle, MOON_RADIUS_KM};

/// Nodes of the table of shares.
const NODES: usize = 256;

/// What is left of the Sun around an observer, at `N` wavelengths.
#[derive(Debug, Clone)]
pub struct MoonShadow<const N: usize> {
    /// From the observer, in local axes (east, north, up), kilometres.
    sun_km: DVec3,
    moon_km: DVec3,
    sun_radius_rad: f64,
    /// By [`CoveredSun::separation`], as [`place_of`] has it.
    shares: Vec<[f64; N]>,
}

/// Where a separation stands in the table, 0 where the Moon covers most to 1 where it covers nothing.
/// All in radians.
fn place_of(separation: f64, sun: f64, moon: f64) -> f64 {
    let deepest = (moon - sun).max(0.0);
    ((separation - deepest) / (sun + moon - deepest)).clamp(0.0, 1.0).sqrt()
}

impl<const N: usize> MoonShadow<N> {
    /// At wavelengths in nanometres.
    pub fn of(sky: &SkyState, wavelengths_nm: [f64; N]) -> MoonShadow<N> {
        let here = CoveredSun::of(sky);
        let (sun, moon) = (here.sun_radius.rad(), here.moon_radius.rad());
        let deepest = (moon - sun).max(0.0);
        // In totality all of the corona counts that the middle of the Moon's disc leaves.
        let corona = corona::TOTAL * corona::visible_share(moon / sun, 0.0);
        let share = |node: usize| {
            let place = node as f64 / (NODES - 1) as f64;
            let separation = deepest + (sun + moon - deepest) * place * place;
            let covered = CoveredSun { separation: Angle::from_rad(separation), ..here };
            let left = covered.visible();
            wavelengths_nm.map(|nm| (left.at_nm(nm) + corona).min(1.0))
        };
        let moon_state = &sky.moon.state;
        MoonShadow {
            sun_km: sky.sun.dir.vector() * sky.sun.distance_km,
            moon_km: moon_state.dir.vector() * moon_state.distance_km,
            sun_radius_rad: sun,
            shares: (0..NODES).map(share).collect(),
        }
    }

    /// What is left at a place, given from the observer in local axes (east, north, up), kilometres; as
    /// much as without any shadow is 1.
    pub fn left_at(&self, from_observer_km: DVec3) -> [f64; N] {
        let to_moon = self.moon_km - from_observer_km;
        let to_sun = self.sun_km - from_observer_km;
        let (moon_km, sun_km) = (to_moon.length(), to_sun.length());
        if to_moon.dot(to_sun) <= 0.0 {
            return [1.0; N];
        }
        let sine = to_moon.cross(to_sun).length() / (moon_km * sun_km);
        let separation = sine.min(1.0).asin();
        let moon = MOON_RADIUS_KM / moon_km;
        let place = place_of(separation, self.sun_radius_rad, moon) * (NODES - 1) as f64;
        let node = (place as usize).min(NODES - 2);
        let along = place - node as f64;
        let (low, high) = (&self.shares[node], &self.shares[node + 1]);
        std::array::from_fn(|k| low[k] + (high[k] - low[k]) * along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_between_nodes_are_those_of_two_circles() {
        let (sun, moon) = (Angle::from_arcmin(15.95), Angle::from_arcmin(16.6));
        let nm = [450.0, 650.0];
        let circles = |separation: Angle| {
            let covered = CoveredSun { sun_radius: sun, moon_radius: moon, separation };
            nm.map(|nm| covered.visible().at_nm(nm))
        };
        let moon_km = MOON_RADIUS_KM / moon.rad();
        let sun_km = 1.496e8;
        let deepest = (moon - sun).rad();
        let node = |node: usize| {
            let place = node as f64 / (NODES - 1) as f64;
            circles(Angle::from_rad(deepest + ((sun + moon).rad() - deepest) * place * place))
        };
        let shadow = MoonShadow {
            sun_km: DVec3::Z * sun_km,
            moon_km: DVec3::Z * moon_km,
            sun_radius_rad: sun.rad(),
            shares: (0..NODES).map(node).collect(),
        };
        for km in [0.0, 40.0, 75.0, 90.0, 130.0, 210.0, 480.0, 900.0, 1800.0, 3000.0, 4000.0] {
            let got = shadow.left_at(DVec3::X * km);
            let separation = (km / moon_km).atan() - (km / sun_km).atan();
            let wanted = circles(Angle::from_rad(separation));
            println!("{km} km: {got:?}");
            for (got, wanted) in got.into_iter().zip(wanted) {
                assert!((got - wanted).abs() < 2e-4, "{km} km: {got} {wanted}");
            }
        }
        // 68 km of umbra, then two per cent within a hundred.
        assert!(shadow.left_at(DVec3::X * 60.0)[0] == 0.0);
        assert!((0.005..0.03).contains(&shadow.left_at(DVec3::X * 170.0)[1]));
    }
}

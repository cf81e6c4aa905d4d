//! Light of the source on level ground, tabulated by its true altitude.

use super::lanes::Lanes;
use super::source::{Beams, SourceTable};
use crate::units::Angle;

/// Nodes of the table: in equal steps of the root of how far the cosine is past the first.
const NODES: usize = 512;
/// Cosine of the true zenith distance at which nothing of a refracted disc is left: 92 degrees.
const DARK: f64 = -0.035;

/// Irradiance of level ground by the source itself, per unit irradiance outside the air; one band.
#[derive(Debug, Clone)]
pub(crate) struct DirectOnGround {
    /// Cosine of the true zenith distance at which the ground is dark.
    dark: f64,
    nodes: Vec<Lanes>,
}

impl DirectOnGround {
    pub fn new(beams: &Beams, source: &SourceTable, ground_km: f64) -> DirectOnGround {
        let row = source.row(ground_km);
        // A point that nothing raises goes at once.
        let is_point = beams.disc_radius() == Angle::ZERO;
        let dark =
            if is_point && beams.refraction(ground_km, 0.0) == Angle::ZERO { 0.0 } else { DARK };
        let node = |i: usize| {
            let share = i as f64 / (NODES - 1) as f64;
            let mu = dark + (1.0 - dark) * share * share;
            let arriving = source.irradiance(&row, mu);
            if arriving == Lanes::ZERO {
                return Lanes::ZERO;
            }
            let altitude = Angle::from_rad(mu.asin()) + beams.refraction(ground_km, mu);
            arriving * visible_altitude(altitude, beams.disc_radius()).sin() as f32
        };
        DirectOnGround { dark, nodes: (0..NODES).map(node).collect() }
    }

    /// For a source whose true zenith distance has the cosine `mu`.
    #[inline(always)]
    pub fn at(&self, mu: f64) -> Lanes {
        if mu <= self.dark {
            return Lanes::ZERO;
        }
        let place = ((mu - self.dark) / (1.0 - self.dark)).min(1.0).sqrt() * (NODES - 1) as f64;
        let low = (place as usize).min(NODES - 2);
        self.nodes[low].lerp(self.nodes[low + 1], (place - low as f64) as f32)
    }
}

/// Mean apparent altitude of what is seen of a disc, given that of its centre.
fn visible_altitude(centre: Angle, radius: Angle) -> Angle {
    if centre >= radius { centre } else { ((centre + radius) * 0.5).max(Angle::ZERO) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::air::Atmosphere;
    use crate::air::scattering::profile::{Optics, Profile};

    #[test]
    fn light_on_the_ground_falls_with_the_sine_and_ends_after_sunset() {
        let air = Atmosphere::molecular();
        let profile = Profile::new(&air, 0.0);
        let optics = Optics::new(&air, 1.0, &[550.0]);
        let beams = Beams::new(&profile, 0.0, 2.777e-4, Angle::from_deg(0.2666));
        let source = SourceTable::new(&beams, &optics);
        let ground = DirectOnGround::new(&beams, &source, 0.0);
        let row = source.row(0.0);
        for altitude_deg in [90.0f64, 60.0, 30.0, 10.0, 3.0, 1.0, 0.1] {
            let mu = altitude_deg.to_radians().sin();
            let raised = beams.refraction(0.0, mu);
            let sine = (Angle::from_deg(altitude_deg) + raised).sin();
            let exact = source.irradiance(&row, mu).0[0] * sine as f32;
            let table = ground.at(mu).0[0];
            assert!((table / exact - 1.0).abs() < 5e-3, "{altitude_deg}°: {table} {exact}");
        }
        let at = |deg: f64| ground.at(deg.to_radians().sin()).0[0];
        // Half an hour of refraction: the Sun still shines a little when it is geometrically down.
        assert!(at(-0.5) > 0.0 && at(-0.5) < at(0.0) && at(-1.2) == 0.0 && at(-90.0) == 0.0);
    }
}

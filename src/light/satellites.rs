//! The great moons of Jupiter as points of light.
//!
//! Magnitudes: V at one astronomical unit from the Sun and from us, at full phase, and its growth with
//! the phase angle `a` in degrees, `b a + c a^2`, up to the 12 degrees that the Earth sees; colours
//! B-V. Morrison & Morrison 1977 in *Planetary Satellites*, as in the Explanatory Supplement to the
//! Astronomical Almanac 1992, table 5.3 and text (recalled; at a mean opposition they give 5.0, 5.3,
//! 4.6 and 5.6, as published). Left out: the turning of the moons, 0.1 mag either way.
//!
//! In the shadow of Jupiter a moon keeps [`UMBRA`] of its light, so that its magnitude stays a number;
//! what is bent into it by the air of Jupiter is of such a size and not modelled.

use crate::ephemeris::Galilean;
use crate::light::planets::tilted_sunlight;
use crate::light::point_light::PointLight;
use crate::sky::SatelliteState;
use crate::units::{AU_KM, Magnitude};

/// Share of the light of a moon that is wholly in the shadow of Jupiter.
pub const UMBRA: f64 = 1e-4;
/// Largest phase angle of the laws of phase, degrees.
const LARGEST_PHASE_DEG: f64 = 12.0;

/// V at full phase and unit distances, the two coefficients of phase, and B-V.
struct Photometry {
    v: f64,
    phase: [f64; 2],
    b_v: f64,
}

const fn photometry(satellite: Galilean) -> Photometry {
    match satellite {
        Galilean::Io => Photometry { v: -1.68, phase: [0.046, -0.0010], b_v: 1.17 },
        Galilean::Europa => Photometry { v: -1.41, phase: [0.0312, -0.00125], b_v: 0.87 },
        Galilean::Ganymede => Photometry { v: -2.09, phase: [0.0323, -0.00066], b_v: 0.83 },
        Galilean::Callisto => Photometry { v: -1.05, phase: [0.078, -0.00274], b_v: 0.86 },
    }
}

/// Johnson V of a moon in full sunlight, outside the air.
pub fn magnitude(satellite: Galilean, state: &SatelliteState) -> Magnitude {
    let Photometry { v, phase: [linear, square], .. } = photometry(satellite);
    let phase_deg = state.phase_angle.deg().clamp(0.0, LARGEST_PHASE_DEG);
    let distances = state.sun_distance_km * state.distance_km / (AU_KM * AU_KM);
    Magnitude(v + phase_deg * (linear + square * phase_deg) + 5.0 * distances.log10())
}

/// The light of a moon outside the air, as the shadow of Jupiter and Jupiter itself leave it.
pub fn light(state: &SatelliteState) -> PointLight {
    let share = (state.share_sunlit * state.share_seen).max(UMBRA);
    let full = magnitude(state.satellite, state);
    let dimmed = Magnitude(full.0 - 2.5 * share.log10());
    PointLight::from_shape(tilted_sunlight(photometry(state.satellite).b_v), dimmed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Dir;
    use crate::units::Angle;

    fn at_mean_opposition(satellite: Galilean) -> SatelliteState {
        SatelliteState {
            satellite,
            error_bound: Angle::ZERO,
            dir: Dir::from_azimuth_altitude(Angle::ZERO, Angle::ZERO),
            distance_km: 4.203 * AU_KM,
            sun_distance_km: 5.203 * AU_KM,
            phase_angle: Angle::ZERO,
            angular_radius: Angle::ZERO,
            share_seen: 1.0,
            share_sunlit: 1.0,
            is_before_jupiter: false,
        }
    }

    #[test]
    fn moons_have_their_published_magnitudes_at_opposition() {
        for (satellite, v) in Galilean::ALL.into_iter().zip([5.02, 5.29, 4.61, 5.65]) {
            let light = light(&at_mean_opposition(satellite));
            assert!((light.magnitude.0 - v).abs() < 0.02, "{satellite}: {:?}", light.magnitude);
            assert!((light.xyzv.y / light.magnitude.illuminance().lx() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn phase_and_shadow_dim() {
        for satellite in Galilean::ALL {
            let full = at_mean_opposition(satellite);
            let mut last = light(&full).magnitude.0;
            for deg in 1..13 {
                let phased =
                    SatelliteState { phase_angle: Angle::from_deg(f64::from(deg)), ..full };
                let next = light(&phased).magnitude.0;
                assert!(next > last, "{satellite} {deg}°");
                last = next;
            }
            let half = SatelliteState { share_sunlit: 0.5, ..full };
            let fainter = light(&half).magnitude.0 - light(&full).magnitude.0;
            assert!((fainter - 0.7526).abs() < 1e-4);
            let gone = SatelliteState { share_sunlit: 0.0, ..full };
            assert!((light(&gone).magnitude.0 - light(&full).magnitude.0 - 10.0).abs() < 1e-9);
        }
    }
}

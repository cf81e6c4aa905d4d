//! Spencer's glare: four parts of the eye's spread and their mixes by day, in twilight and by night.
//!
//! Source: Spencer, Shirley, Zimmerman & Greenberg 1995, *Physically-based glare effects for digital
//! images*, SIGGRAPH, 325. With the angle `t` in degrees and the wavelength `l` in nm:
//!
//! `f0 = 2.61e6 exp(-(t/0.02)^2)`, the core; `f1 = 20.91 / (t + 0.02)^3`, the bloom;
//! `f2 = 72.37 / (t + 0.02)^2`, the ciliary corona;
//! `f3 = 436.9 (568/l) exp(-19.75 (t - 3 l/568)^2)`, the lenticular halo.
//!
//! Some programs have 10e6 in place of the 1e6 in f0, and some texts leave out the 19.75 in f3: both
//! are errors, for with them the integrals over the hemisphere are 10 and 4.4. As it stands, each
//! part integrates to 1 within 0.1 %; in a mix they are normalised.
//!
//! How we differ: the needles of corona and halo are drawn by [`super::flare`].

use crate::units::Angle;

use super::spread::Shape;

/// Shapes of f0, f1 and f2.
pub(super) const SHAPES: [Shape; 3] = [
    Shape::Gauss { width_deg: 0.02 },
    Shape::Tail { offset_deg: 0.02, power: 3 },
    Shape::Tail { offset_deg: 0.02, power: 2 },
];
const HEIGHTS_PER_SR: [f64; 3] = [2.61e6, 20.91, 72.37];

/// Shares of core, bloom, corona and halo by day, in twilight and by night.
pub const PHOTOPIC: [f64; 4] = [0.384, 0.478, 0.138, 0.0];
pub const MESOPIC: [f64; 4] = [0.368, 0.478, 0.138, 0.016];
pub const SCOTOPIC: [f64; 4] = [0.282, 0.478, 0.207, 0.033];

/// Radius of the halo at a wavelength, and how sharp it is, per square degree.
const HALO_DEG: f64 = 3.0;
const HALO_NM: f64 = 568.0;
const HALO_SHARPNESS: f64 = 19.75;
const HALO_PER_SR: f64 = 436.9;

/// The core f0, per steradian, as published.
pub fn core_per_sr(from_source: Angle) -> f64 {
    HEIGHTS_PER_SR[0] * SHAPES[0].at(from_source.deg())
}

/// The bloom f1, per steradian, as published.
pub fn bloom_per_sr(from_source: Angle) -> f64 {
    HEIGHTS_PER_SR[1] * SHAPES[1].at(from_source.deg())
}

/// The ciliary corona f2, per steradian, as published.
pub fn corona_per_sr(from_source: Angle) -> f64 {
    HEIGHTS_PER_SR[2] * SHAPES[2].at(from_source.deg())
}

/// The lenticular halo f3 in light of a wavelength, per steradian, as published.
pub fn halo_per_sr(from_source: Angle, wavelength_nm: f64) -> f64 {
    let off = from_source.deg() - HALO_DEG * wavelength_nm / HALO_NM;
    HALO_PER_SR * HALO_NM / wavelength_nm * (-HALO_SHARPNESS * off * off).exp()
}

/// The shares between the mixes: 0 is photopic, 1 scotopic, and the mesopic stands where the halo
/// has grown by as much.
pub fn mix(night_part: f64) -> [f64; 4] {
    let mesopic = MESOPIC[3] / SCOTOPIC[3];
    let (from, to, at) = if night_part < mesopic {
        (PHOTOPIC, MESOPIC, night_part / mesopic)
    } else {
        (MESOPIC, SCOTOPIC, (night_part - mesopic) / (1.0 - mesopic))
    };
    let at = at.clamp(0.0, 1.0);
    std::array::from_fn(|n| from[n] + (to[n] - from[n]) * at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eye::glare::spread::integral_within;

    #[test]
    fn the_parts_are_the_published_ones() {
        let at = Angle::from_deg;
        for (value, expected) in [
            (core_per_sr(at(0.0)), 2.61e6),
            (core_per_sr(at(0.02)), 960_165.3),
            (bloom_per_sr(at(0.0)), 2.613_75e6),
            (bloom_per_sr(at(0.98)), 20.91),
            (corona_per_sr(at(0.08)), 7237.0),
            (corona_per_sr(at(9.98)), 0.7237),
            (halo_per_sr(at(3.0), 568.0), 436.9),
            (halo_per_sr(at(3.2), 568.0), 436.9 * 0.453_845),
            (halo_per_sr(at(2.0), 568.0 * 2.0 / 3.0), 655.35),
        ] {
            assert!((value / expected - 1.0).abs() < 1e-5, "{value} {expected}");
        }
    }

    /// All were meant to hold one unit.
    #[test]
    fn the_published_heights_are_nearly_normalised() {
        let whole = |per_sr: &dyn Fn(Angle) -> f64| {
            integral_within(90.0, |t_deg| per_sr(Angle::from_deg(t_deg)))
        };
        for (integral, expected) in [
            (whole(&core_per_sr), 1.0),
            (whole(&bloom_per_sr), 1.0),
            (whole(&corona_per_sr), 1.0),
            (whole(&|t| halo_per_sr(t, 568.0)), 1.0),
            (whole(&|t| halo_per_sr(t, 450.0)), 1.0),
        ] {
            assert!((integral - expected).abs() < 1e-3, "{integral} {expected}");
        }
    }

    #[test]
    fn mixes_hold_one_unit_and_pass_through_all_three() {
        for n in 0..=100 {
            let sum: f64 = mix(f64::from(n) / 100.0).iter().sum();
            assert!((sum - 1.0).abs() < 1e-12, "{n}: {sum}");
        }
        assert_eq!(mix(0.0), PHOTOPIC);
        for (share, expected) in mix(0.016 / 0.033).iter().zip(MESOPIC) {
            assert!((share - expected).abs() < 1e-12);
        }
        for (share, expected) in mix(1.0).iter().zip(SCOTOPIC) {
            assert!((share - expected).abs() < 1e-12);
        }
    }
}

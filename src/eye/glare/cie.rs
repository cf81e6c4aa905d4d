//! The glare functions of the CIE: the total one, from the core to 100 degrees, and the
//! Stiles-Holladay law for the veil alone.
//!
//! Source: Vos & van den Berg 1999, *CIE Collection* 135/1, the total glare function with age and
//! pigment; Vos 2003, *Clin Exp Optom* 86, 363, for the laws with restricted ranges. The pigment is
//! 0 for very dark eyes, 0.5 for brown, 1 for blue-green, 1.2 for very light blue.
//!
//! Range: 0 to 100 degrees, by day, ages up to about 100 years. All laws are for young eyes to
//! some 20 % from one observer to the next.

use crate::units::Angle;

use super::spread::Shape;

/// Parts of the total glare function; their heights are [`heights`].
pub(super) const SHAPES: [Shape; 7] = [
    Shape::Bell { width_deg: 0.0046, halves: 3 },
    Shape::Bell { width_deg: 0.045, halves: 3 },
    Shape::Bell { width_deg: 0.1, halves: 2 },
    Shape::Square,
    Shape::Bell { width_deg: 0.1, halves: 3 },
    Shape::Bell { width_deg: 0.1, halves: 1 },
    Shape::Even,
];

/// Heights of the parts per steradian, as published: their sum is not normalised.
pub(super) fn heights(age_years: f64, pigment: f64) -> [f64; 7] {
    let aged = (age_years.clamp(0.0, OLDEST_YEARS) / 70.0).powi(4);
    let (core, veil) = (1.0 - 0.08 * aged, 1.0 + 1.6 * aged);
    let whole = 1.0 + pigment * (0.0417 + 0.055 * aged);
    [
        core * 9.2e6,
        core * 1.5e5,
        veil * 400.0,
        veil * 3e-8,
        veil * pigment * 1300.0,
        veil * pigment * 0.8,
        2.5e-3 * pigment,
    ]
    .map(|height| height / whole)
}

/// Beyond, the published function would have the core turn dark.
const OLDEST_YEARS: f64 = 100.0;

/// The total glare function as published, per steradian; it holds some 1 % more than one unit.
pub fn total_glare_per_sr(from_source: Angle, age_years: f64, pigment: f64) -> f64 {
    let parts = heights(age_years, pigment).into_iter().zip(SHAPES);
    parts.map(|(height, shape)| height * shape.at(from_source.deg())).sum()
}

/// The age-adjusted Stiles-Holladay law: the veil in cd/m2 per lux at the eye, 1 to 30 degrees.
pub fn stiles_holladay_per_sr(from_source: Angle, age_years: f64) -> f64 {
    10.0 * (1.0 + (age_years / 70.0).powi(4)) / from_source.deg().powi(2)
}

/// The general disability glare equation, per steradian, 0.1 to 100 degrees (Vos 2003).
pub fn general_per_sr(from_source: Angle, age_years: f64, pigment: f64) -> f64 {
    let t = from_source.deg();
    let aged = 1.0 + (age_years / 62.5).powi(4);
    10.0 / t.powi(3) + (5.0 / t.powi(2) + 0.1 * pigment / t) * aged + 2.5e-3 * pigment
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand from the printed equation.
    #[test]
    fn the_total_function_is_the_published_one() {
        // At the source, of a newborn with dark eyes: all bells at their height.
        let centre = total_glare_per_sr(Angle::ZERO, 0.0, 0.0);
        assert!((centre / (9.2e6 + 1.5e5 + 400.0) - 1.0).abs() < 1e-9, "{centre}");
        // At one degree: 0.895463 + 13.627336 + 3.960396 + 3e-8.
        let degree = total_glare_per_sr(Angle::from_deg(1.0), 0.0, 0.0);
        assert!((degree / 18.483_2 - 1.0).abs() < 1e-4, "{degree}");
        // At 70 years the core keeps 0.92 of itself, the veil becomes 2.6 times as strong.
        let old = total_glare_per_sr(Angle::from_deg(1.0), 70.0, 0.0);
        assert!((old / (0.92 * 14.522_799 + 2.6 * 3.960_396) - 1.0).abs() < 1e-4, "{old}");
        // Pigment 1, at 10 degrees: 1300 / 10001^1.5 + 0.8 / 10001^0.5 + 2.5e-3 more, over 1.0417.
        let bright = total_glare_per_sr(Angle::from_deg(10.0), 0.0, 1.0);
        let dark = total_glare_per_sr(Angle::from_deg(10.0), 0.0, 0.0);
        let expected = (dark + 1.299_81e-3 + 7.999_6e-3 + 2.5e-3) / 1.0417;
        assert!((bright / expected - 1.0).abs() < 1e-4, "{bright} {expected}");
    }

    #[test]
    fn the_laws_agree_where_they_share_a_range() {
        for age_years in [25.0, 70.0] {
            for t in [0.1, 0.3, 1.0, 3.0, 10.0, 30.0].map(Angle::from_deg) {
                let total = total_glare_per_sr(t, age_years, 0.5);
                let ratio = total / general_per_sr(t, age_years, 0.5);
                assert!((1.0 / 1.5..1.5).contains(&ratio), "{age_years} {}: {ratio}", t.deg());
            }
            for t in [3.0, 10.0, 20.0].map(Angle::from_deg) {
                let veil = stiles_holladay_per_sr(t, age_years);
                let ratio = veil / general_per_sr(t, age_years, 0.5);
                assert!((1.0 / 2.1..2.1).contains(&ratio), "{age_years} {}: {ratio}", t.deg());
            }
        }
        assert_eq!(stiles_holladay_per_sr(Angle::from_deg(10.0), 70.0), 0.2);
    }
}

//! Spread functions: how the eye shares the light of a point among directions around it.
//!
//! Theory: a spread function gives light per steradian at an angle `t` from its source, for one
//! unit of light in all. Each published one is a sum of a few shapes in `t`; each shape is
//! integrated over the hemisphere in front of the eye (`2 pi sin t dt`, 0 to 90 degrees) once, and
//! a sum is made to hold one unit from these integrals.
//!
//! By night the pupil opens. Light that enters near its rim crosses the outer lens, whose fibres
//! stand in rays like a grating: they throw a coloured ring, the lenticular halo, and the grains in
//! the lens throw more fine needles, the ciliary corona (Simpson 1953, *Br J Ophthalmol* 37, 450;
//! Spencer et al. 1995). We take the part of the pupil's area outside 3 mm, relative to that of a
//! pupil of 7 mm, as the measure `u` of how far the eye has gone from Spencer's photopic mix
//! (u = 0) to the scotopic (u = 1). The mesopic mix stands at the u where the halo, whose light
//! must grow with the area that makes it, has the share that Spencer gives: 0.016 / 0.033, a pupil
//! of 3.9 mm. Between the three mixes the shares are straight in u. 3 mm is Simpson's (recalled).
//!
//! The CIE's function is that of daylight. With it, what Spencer's corona and halo gain by night is
//! added, and taken from its narrowest bell as Spencer takes it from his: 10 % of the light.
//!
//! How we differ: the spread here is the same for all colours. The halo, which is a ring of
//! another size for each colour, is no part of [`Spread::per_sr`]: its share stays in the source
//! until [`super::flare`] draws it. The loss of sight toward the rim of the pupil (Stiles-Crawford)
//! is left out.
//!
//! Accuracy: integrals 1e-6.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::units::Angle;

use super::{Optics, cie, spencer};

/// A function of the angle `t` from the source, in degrees; its height is 1 per steradian.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Shape {
    /// `(1 + (t/width)^2)^(-halves/2)`.
    Bell { width_deg: f64, halves: u8 },
    /// `exp(-(t/width)^2)`.
    Gauss { width_deg: f64 },
    /// `(t + offset)^-power`.
    Tail { offset_deg: f64, power: i32 },
    /// `t^2`.
    Square,
    /// 1.
    Even,
}

/// Straight ahead to the side: where a spread ends.
pub(super) const HEMISPHERE_DEG: f64 = 90.0;

impl Shape {
    pub(super) fn at(self, t_deg: f64) -> f64 {
        match self {
            Shape::Bell { width_deg, halves } => {
                let x = 1.0 + (t_deg / width_deg).powi(2);
                match halves {
                    1 => 1.0 / x.sqrt(),
                    2 => 1.0 / x,
                    _ => 1.0 / (x * x.sqrt()),
                }
            }
            Shape::Gauss { width_deg } => (-(t_deg / width_deg).powi(2)).exp(),
            Shape::Tail { offset_deg, power } => (t_deg + offset_deg).powi(-power),
            Shape::Square => t_deg * t_deg,
            Shape::Even => 1.0,
        }
    }

    /// Integral within an angle of the source.
    pub(super) fn within(self, t_deg: f64) -> f64 {
        integral_within(t_deg, |t_deg| self.at(t_deg))
    }
}

/// Integral of a function of the angle in degrees over the cap within an angle of its centre,
/// steradians: Simpson's rule in the logarithm of the angle.
pub(super) fn integral_within(t_deg: f64, per_sr: impl Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 2000;
    const CENTRE_DEG: f64 = 1e-6;
    let t_deg = t_deg.clamp(CENTRE_DEG, HEMISPHERE_DEG);
    let [low, high] = [CENTRE_DEG, t_deg].map(f64::ln);
    let step = (high - low) / STEPS as f64;
    let ring = |k: usize| {
        let t_deg = (low + step * k as f64).exp();
        let t = t_deg.to_radians();
        let weight = match k {
            0 | STEPS => 1.0,
            k if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        weight * per_sr(t_deg) * 2.0 * PI * t.sin() * t
    };
    let rings: f64 = (0..=STEPS).map(ring).sum();
    rings * step / 3.0 + per_sr(0.0) * PI * CENTRE_DEG.to_radians().powi(2)
}

/// Integrals of some shapes over the hemisphere.
pub(super) fn hemispheres<const N: usize>(shapes: [Shape; N]) -> [f64; N] {
    shapes.map(|shape| shape.within(HEMISPHERE_DEG))
}

/// Which published spread function the eye follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Glare {
    /// The CIE's total glare function, with Spencer's corona and halo where the pupil is wide.
    #[default]
    Cie,
    /// Spencer's mixes, for a young eye of any pigment.
    Spencer,
    /// An eye that scatters nothing.
    None,
}

/// How far a pupil has opened from the photopic mix, 0, to the scotopic, 1.
pub fn night_part(pupil_mm: f64) -> f64 {
    let outside = |pupil_mm: f64| 1.0 - (CLEAR_PUPIL_MM / pupil_mm.max(CLEAR_PUPIL_MM)).powi(2);
    (outside(pupil_mm) / outside(WIDE_PUPIL_MM)).min(1.0)
}

/// Diameter of the pupil through which the outer lens scatters nothing yet, mm.
const CLEAR_PUPIL_MM: f64 = 3.0;
/// Diameter of the pupil that belongs to the scotopic mix, mm.
const WIDE_PUPIL_MM: f64 = 7.0;

/// How an eye shares the light of a point among directions: one unit over the hemisphere.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Per steradian; together with the halo they hold one unit.
    terms: Vec<(f64, Shape)>,
    corona: f64,
    halo: f64,
}

impl Glare {
    /// The spread of an eye with a pupil of a diameter in mm; `None` if it scatters nothing.
    pub fn spread(self, optics: &Optics, pupil_mm: f64) -> Option<Spread> {
        static CIE: LazyLock<[f64; 7]> = LazyLock::new(|| hemispheres(cie::SHAPES));
        static SPENCER: LazyLock<[f64; 3]> = LazyLock::new(|| hemispheres(spencer::SHAPES));
        let day = spencer::PHOTOPIC;
        let mix = spencer::mix(night_part(pupil_mm));
        let [corona, halo] = [mix[2] - day[2], mix[3]];
        let spencer_term = |n: usize, share: f64| (share / SPENCER[n], spencer::SHAPES[n]);
        let terms = match self {
            Glare::None => return None,
            Glare::Spencer => (0..3).map(|n| spencer_term(n, mix[n])).collect(),
            Glare::Cie => {
                let mut heights = cie::heights(optics.age_years, optics.pigment);
                let whole: f64 = heights.iter().zip(&*CIE).map(|(h, integral)| h * integral).sum();
                heights.iter_mut().for_each(|height| *height /= whole);
                // An eye so old that its core holds less gives all of it.
                heights[0] = (heights[0] - (corona + halo) / CIE[0]).max(0.0);
                let mut terms: Vec<_> = heights.into_iter().zip(cie::SHAPES).collect();
                terms.push(spencer_term(2, corona));
                terms
            }
        };
        Some(Spread { terms, corona, halo })
    }
}

impl Spread {
    /// Light per steradian at an angle from the source, the halo left out; none beyond 90 degrees.
    pub fn per_sr(&self, from_source: Angle) -> f64 {
        self.at_deg(from_source.deg())
    }

    pub(super) fn at_deg(&self, t_deg: f64) -> f64 {
        if t_deg > HEMISPHERE_DEG {
            return 0.0;
        }
        self.terms.iter().map(|(height, shape)| height * shape.at(t_deg)).sum()
    }

    /// The share of the light within an angle of the source, without the halo.
    pub fn within(&self, from_source: Angle) -> f64 {
        integral_within(from_source.deg(), |t_deg| self.at_deg(t_deg))
    }

    /// The share of the light that the ciliary corona has more than by day.
    pub fn corona(&self) -> f64 {
        self.corona
    }

    /// The share of the light that goes into the lenticular halo.
    pub fn halo(&self) -> f64 {
        self.halo
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_holds_one_unit() {
        for glare in [Glare::Cie, Glare::Spencer] {
            for (age_years, pigment) in [(20.0, 0.0), (30.0, 0.5), (80.0, 1.2)] {
                for pupil_mm in [2.0, 3.5, 5.0, 7.5] {
                    let spread = glare.spread(&Optics { age_years, pigment }, pupil_mm).unwrap();
                    let sum = spread.within(Angle::from_deg(90.0)) + spread.halo();
                    assert!((sum - 1.0).abs() < 1e-6, "{glare:?} {age_years} {pupil_mm}: {sum}");
                }
            }
        }
        assert_eq!(Glare::None.spread(&Optics::default(), 5.0), None);
    }

    /// A bell of power 3/2 in the plane holds `2 pi a^2`; caps of an even light are known.
    #[test]
    fn integrals_are_those_in_closed_form() {
        let even = Shape::Even.within(60.0);
        assert!((even / PI - 1.0).abs() < 1e-6, "{even}");
        let width_deg = 0.0046;
        let bell = Shape::Bell { width_deg, halves: 3 }.within(1.0);
        let plane = 2.0 * PI * width_deg.to_radians().powi(2);
        let expected = plane * (1.0 - 1.0 / (1.0 + (1.0f64 / width_deg).powi(2)).sqrt());
        assert!((bell / expected - 1.0).abs() < 1e-4, "{bell} {expected}");
    }

    #[test]
    fn night_comes_with_the_pupil() {
        assert_eq!([2.0, 3.0, 7.0, 8.0].map(night_part), [0.0, 0.0, 1.0, 1.0]);
        assert!((night_part(3.8595) - 0.016 / 0.033).abs() < 1e-3, "{}", night_part(3.8595));
        let optics = Optics::default();
        let at =
            |pupil_mm: f64, t_deg: f64| Glare::Cie.spread(&optics, pupil_mm).unwrap().at_deg(t_deg);
        // Without a step anywhere; outside the core there is more light by night.
        for t_deg in [0.0, 0.1, 3.0] {
            for tenth in 20..79 {
                let pupil_mm = f64::from(tenth) / 10.0;
                let ratio = at(pupil_mm + 0.1, t_deg) / at(pupil_mm, t_deg);
                assert!((0.9..1.1).contains(&ratio), "{t_deg} {pupil_mm}: {ratio}");
            }
        }
        assert!(at(7.0, 2.0) > 1.2 * at(3.0, 2.0) && at(7.0, 0.0) < at(3.0, 0.0));
    }
}

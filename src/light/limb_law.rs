//! How the sunlit surface of a planet sends light back: its limb and its terminator.
//!
//! *Theory.* With the cosines `mu0` of incidence and `mu` of emission, Minnaert's law (1941,
//! *Astrophys. J.* 93, 403) is `mu0^k mu^(k-1)`; `k = 1` is Lambert's law, `k = 1/2` has no limb
//! darkening at full phase. Dark dust that scatters once follows the law of Lommel and Seeliger,
//! `2 mu0 / (mu0 + mu)`. All are one where `mu0 = mu = 1`.
//!
//! *Data.* Exponents in yellow light, recalled as typical values of the literature, not looked up:
//! clouds of Venus 1; Mars 0.7; Jupiter 0.95; Saturn 0.9; Uranus and Neptune, a guess, 0.75. Mercury
//! and Pluto follow Lommel and Seeliger as the Moon does.
//!
//! *Omitted.* That exponents grow with the wavelength and the phase; the glow of Venus' air beyond its
//! horns. How bright the whole disc is comes from [`crate::light::planets`], not from here.

use crate::ephemeris::Body;

/// Within this cosine of the limb Minnaert's law, which grows without end there, stays as it is.
pub const LIMB_COSINE: f64 = 0.02;

/// A law of reflection, one for light that falls and leaves straight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LimbLaw {
    LommelSeeliger,
    Minnaert { exponent: f64 },
}

impl LimbLaw {
    /// The law of a planet in yellow light.
    pub fn of(body: Body) -> LimbLaw {
        let exponent = match body {
            Body::Mercury | Body::Pluto | Body::Moon => return LimbLaw::LommelSeeliger,
            Body::Venus | Body::Sun => 1.0,
            Body::Mars => 0.7,
            Body::Jupiter => 0.95,
            Body::Saturn => 0.9,
            Body::Uranus | Body::Neptune => 0.75,
        };
        LimbLaw::Minnaert { exponent }
    }

    /// I/F for the cosines of incidence and emission, relative to 1 and 1; zero by night.
    pub fn reflectance(self, cos_incidence: f64, cos_emission: f64) -> f64 {
        if cos_incidence <= 0.0 {
            return 0.0;
        }
        match self {
            LimbLaw::LommelSeeliger => 2.0 * cos_incidence / (cos_incidence + cos_emission),
            LimbLaw::Minnaert { exponent } => {
                let emission = cos_emission.max(LIMB_COSINE);
                cos_incidence * (cos_incidence * emission).powf(exponent - 1.0)
            }
        }
    }

    /// Mean of it over the disc of a ball at full phase.
    pub fn full_mean(self) -> f64 {
        match self {
            LimbLaw::LommelSeeliger => 1.0,
            LimbLaw::Minnaert { exponent } => 2.0 / (2.0 * exponent + 1.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_are_one_in_the_middle_and_have_their_mean() {
        for law in Body::PLANETS.map(LimbLaw::of) {
            assert_eq!(law.reflectance(1.0, 1.0), 1.0);
            assert_eq!(law.reflectance(-0.1, 0.5), 0.0);
            let rings = 2000;
            let mean = (0..rings)
                .map(|ring| (1.0 - (f64::from(ring) + 0.5) / f64::from(rings)).sqrt())
                .map(|mu| law.reflectance(mu, mu))
                .sum::<f64>()
                / f64::from(rings);
            assert!((mean / law.full_mean() - 1.0).abs() < 1e-3, "{law:?}: {mean}");
        }
    }

    #[test]
    fn minnaert_is_lambert_for_one() {
        let law = LimbLaw::Minnaert { exponent: 1.0 };
        assert!((law.reflectance(0.3, 0.8) - 0.3).abs() < 1e-15);
    }
}

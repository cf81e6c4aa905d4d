//! What rods and cones make of a light together: how bright it is seen, and in what colour.
//!
//! *Level.* Brightness is the mesopic luminance of CIE 191 ([`super::mesopic`]), whatever the colour: by
//! night the scotopic luminance V, by day Y, and it is this that a tone curve maps. It grows with the
//! light, so a brighter light is never seen darker. (Jensen et al. show 0.4468 V by night: their level is
//! relative to other colours of a picture, and ours is on the scale of the thresholds of rods.)
//!
//! *Colour.* Two models, and none:
//!
//! - [`NightColour::Jensen`]: X, Y, Z of the cones weighted by `s`, the blue grey of the rods, of
//!   luminance `0.4468 V`, by `1 - s` (Jensen et al. 2000, see [`super::rods`]), all scaled to the level.
//!   They mix chromaticities; we mix lights, as light adds. The ends are the same. Below 0.01 cd/m2 no
//!   colour is left, as one finds under the stars.
//! - [`NightColour::Intrusion`]: cones and rods as they weigh in the mesopic luminance, rods in the
//!   blue-green that they have in the pathways of the cones ([`super::rod_intrusion`]). Colours live on
//!   down to 0.005 cd/m2 and cones count for more than with Jensen, 22 % at 0.01 cd/m2.
//! - [`NightColour::Day`]: the light itself.
//!
//! Jensen's is the default: it is what the paper does that this program follows, people take it for
//! night, and it lets go of colour where sight does. A source is seen by its own light here, not by what
//! the eye has adapted to: a bright star of a light above 4 cd/m2 at the retina has its colour by night.
//!
//! *Range.* Finite for all lights from 0 to 1e10 cd/m2. A light without any scotopic part, which no
//! spectrum has, counts as having 1 %.

use serde::{Deserialize, Serialize};

use super::{mesopic, rod_intrusion, rods};

/// How colour goes with the light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NightColour {
    /// Into a bluish grey: Jensen et al. 2000.
    #[default]
    Jensen,
    /// Into the blue-green of rods in the pathways of cones: after Cao et al. 2008.
    Intrusion,
    /// It does not: cones alone, the colours of day at any light.
    Day,
}

/// What is seen of a light: `cones * XYZ + rods * V`, cd/m2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mix {
    pub cones: f64,
    pub rods: [f64; 3],
}

impl Mix {
    /// X, Y and Z that are seen of a light.
    pub fn of(&self, [x, y, z]: [f64; 3], scotopic_cd_m2: f64) -> [f64; 3] {
        let seen = |own: f64, rods: f64| self.cones * own + rods * scotopic_cd_m2;
        [seen(x, self.rods[0]), seen(y, self.rods[1]), seen(z, self.rods[2])]
    }
}

/// The scotopic luminance of any light is taken to be at least this part of the photopic one where
/// rods alone give the colour.
const LEAST_RATIO: f64 = 0.01;

/// What rods and cones make of a light with given luminances, cd/m2. Continuous in both; for
/// a light of one colour the Y of the result grows with the light.
pub fn mix(colour: NightColour, photopic_cd_m2: f64, scotopic_cd_m2: f64) -> Mix {
    match colour {
        NightColour::Jensen => jensen(photopic_cd_m2, scotopic_cd_m2),
        NightColour::Intrusion => {
            let m = mesopic::adaptation_coefficient(photopic_cd_m2, scotopic_cd_m2);
            let [cones, rods] = mesopic::weights(m);
            let grey = rod_intrusion::rod_colour_xyz(photopic_cd_m2, scotopic_cd_m2);
            Mix { cones, rods: grey.map(|part| rods * part) }
        }
        NightColour::Day => Mix { cones: 1.0, rods: [0.0; 3] },
    }
}

/// Y of what is seen of a light with given luminances, all in cd/m2: what a tone curve maps. The same
/// for all colours of night; Y itself by [`NightColour::Day`].
pub fn seen_luminance_cd_m2(colour: NightColour, photopic_cd_m2: f64, scotopic_cd_m2: f64) -> f64 {
    match colour {
        NightColour::Jensen | NightColour::Intrusion => {
            mesopic::luminance_cd_m2(photopic_cd_m2, scotopic_cd_m2)
        }
        NightColour::Day => photopic_cd_m2,
    }
}

fn jensen(photopic_cd_m2: f64, scotopic_cd_m2: f64) -> Mix {
    let scotopic_cd_m2 = scotopic_cd_m2.max(LEAST_RATIO * photopic_cd_m2);
    let s = rods::cone_share(photopic_cd_m2);
    let rods = (1.0 - s) * rods::GAIN;
    let published = s * photopic_cd_m2 + rods * scotopic_cd_m2;
    let scale = if published > 0.0 {
        mesopic::luminance_cd_m2(photopic_cd_m2, scotopic_cd_m2) / published
    } else {
        1.0 / rods::GAIN
    };
    Mix { cones: s * scale, rods: rods::GREY_XYZ.map(|part| rods * scale * part) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [NightColour; 3] = [NightColour::Jensen, NightColour::Intrusion, NightColour::Day];
    const NIGHTLY: [NightColour; 2] = [NightColour::Jensen, NightColour::Intrusion];

    /// A light of a colour, seen: X, Y and Z per Y.
    fn colour_seen(colour: NightColour, [x, z, v]: [f64; 3], y: f64) -> [f64; 3] {
        let [x, y, z] = mix(colour, y, v * y).of([x * y, y, z * y], v * y);
        [x / y, 1.0, z / y]
    }

    /// Colours as X, Z and V for Y = 1: white of equal energy, an M star, the sky of twilight.
    const WHITE: [f64; 3] = [1.0, 1.0, 2.27];
    const ORANGE: [f64; 3] = [1.25, 0.35, 0.95];
    const BLUE: [f64; 3] = [1.0, 2.0, 3.3];

    #[test]
    fn its_level_is_the_mesopic_luminance() {
        for colour in NIGHTLY {
            for step in -160..=200 {
                let y = 10f64.powf(f64::from(step) / 20.0);
                for ratio in [0.02, 0.3, 1.0, 2.3, 6.0] {
                    let mix = mix(colour, y, ratio * y);
                    let seen = mix.cones * y + mix.rods[1] * ratio * y;
                    let want = mesopic::luminance_cd_m2(y, ratio * y);
                    assert!(
                        (seen / want - 1.0).abs() < 1e-9,
                        "{colour:?} {y} {ratio}: {seen} {want}"
                    );
                    assert_eq!(seen_luminance_cd_m2(colour, y, ratio * y), want);
                }
            }
        }
        assert_eq!(seen_luminance_cd_m2(NightColour::Day, 1e-3, 2e-3), 1e-3);
    }

    #[test]
    fn brighter_is_never_darker() {
        for colour in ALL {
            for ratio in [0.3, 0.5, 1.0, 1.4, 2.3, 2.6, 4.0, 6.0] {
                let mut before = 0.0;
                for step in -8000..=10_000 {
                    let y = 10f64.powf(f64::from(step) / 1000.0);
                    let [_, here, _] = mix(colour, y, ratio * y).of([y; 3], ratio * y);
                    assert!(here > before, "{colour:?} {ratio} {y}: {before} {here}");
                    before = here;
                }
            }
        }
    }

    #[test]
    fn it_is_continuous() {
        for colour in ALL {
            for ratio_step in 0..40 {
                let ratio = 0.3 * 1.08f64.powi(ratio_step);
                for step in -800..=300 {
                    let y = 10f64.powf(f64::from(step) / 100.0);
                    let here = mix(colour, y, ratio * y);
                    for near in
                        [mix(colour, y * 1.0001, ratio * y), mix(colour, y, ratio * y * 1.0001)]
                    {
                        let [a, b] = [here, near].map(|mix| [mix.cones, mix.rods[0], mix.rods[2]]);
                        let scale = 1.0 + mix_scale(&a);
                        let jump = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                        assert!(jump < 2e-3 * scale, "{colour:?} {y} {ratio}: {a:?} {b:?}");
                    }
                }
            }
        }
    }

    fn mix_scale(parts: &[f64; 3]) -> f64 {
        parts.iter().copied().fold(0.0, f64::max)
    }

    #[test]
    fn white_is_white_by_day_and_bluish_by_night() {
        for colour in ALL {
            let [x, _, z] = colour_seen(colour, WHITE, 100.0);
            assert!((x - 1.0).abs() < 0.01 && (z - 1.0).abs() < 0.01, "{colour:?}: {x} {z}");
            let [x, y, z] = mix(colour, 1e8, 2.27e8).of([1e8; 3], 2.27e8);
            assert!([x, y, z].iter().all(|part| (part / 1e8 - 1.0).abs() < 1e-9));
        }
        for colour in NIGHTLY {
            let [x, _, z] = colour_seen(colour, WHITE, 1e-3);
            // More blue than red, by 40 % at least.
            assert!(z / x > 1.4 && z > 1.05, "{colour:?}: {x} {z}");
        }
        assert_eq!(colour_seen(NightColour::Day, ORANGE, 1e-5), [1.25, 1.0, 0.35]);
    }

    #[test]
    fn red_fades_before_blue() {
        // Of the same Y, a red light is seen darker than a blue one by night, and as bright by day.
        for colour in NIGHTLY {
            let level = |[_, _, v]: [f64; 3], y: f64| seen_luminance_cd_m2(colour, y, v * y);
            assert!(level(ORANGE, 1e-3) < 0.3 * level(BLUE, 1e-3));
            assert!((level(ORANGE, 30.0) / level(BLUE, 30.0) - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn an_orange_star_is_orange_when_bright_and_grey_when_faint() {
        let jensen = |y| colour_seen(NightColour::Jensen, ORANGE, y);
        let [x, _, z] = jensen(1.0);
        assert!(x > 1.15 && z < 0.6, "{x} {z}");
        let [x, _, z] = jensen(0.01);
        assert!((x - 1.0).abs() < 1e-9 && (z - 2.0).abs() < 1e-9, "{x} {z}");
        let [x, _, z] = colour_seen(NightColour::Intrusion, ORANGE, 1.0);
        assert!(x > 1.15 && z < 0.6, "{x} {z}");
        // Paler and bluer with every step down.
        for colour in NIGHTLY {
            let blue = [10.0, 1.0, 0.3, 0.1, 0.03, 0.01].map(|y| colour_seen(colour, ORANGE, y)[2]);
            assert!(blue.windows(2).all(|pair| pair[1] > pair[0]), "{colour:?} {blue:?}");
        }
    }

    #[test]
    fn any_light_has_a_finite_mixture() {
        let lights = [0.0, 1e-30, 1e-8, 4e-3, 8e-3, 0.5, 5.0, 1e4, 1e10];
        for colour in ALL {
            for y in lights {
                for v in lights {
                    let Mix { cones, rods } = mix(colour, y, v);
                    let parts = [cones, rods[0], rods[1], rods[2]];
                    assert!(parts.iter().all(|part| part.is_finite() && *part >= 0.0), "{y} {v}");
                }
            }
        }
    }

    #[test]
    fn names_are_those_of_the_settings() {
        let name = serde_json::to_string(&NightColour::Intrusion).unwrap();
        assert_eq!(name, "\"intrusion\"");
        assert_eq!(NightColour::default(), NightColour::Jensen);
    }
}

//! The eye: from absolute light to what a screen shows of it.
//!
//! The eye is given the frame as half a degree of it is seen at a time, and makes of it what the GPU
//! needs for every pixel ([`Seeing`]): how much of the light it scatters and how far
//! ([`glare`]), what it resolves ([`acuity`]), what rods and cones make of a light together
//! ([`receptors`]), how bright that is shown ([`tone_curve`]), and which points of light are seen against
//! what ([`limiting_magnitude`]), and what it takes for white ([`white`]). All of it is reckoned in f64 into small tables over light
//! ([`light_table`]); the passes look them up.
//!
//! What is shown follows visibility matching (Ward Larson, Rushmeier & Piatko 1997, *IEEE TVCG* 3, 291):
//! what the eye can just tell apart there is shown as what the viewer of the screen can just tell apart.
//! Large things and points are matched apart, because the dark-adapted eye sums light over large things and
//! cannot over points: the night sky is lifted two thousand times, a star some tens of times. The points
//! are matched by Crumey's thresholds, so that a star is as far above the threshold of who looks at the
//! screen as it was above that of who looks at the sky, and one below it is not drawn.
//!
//! *Left out.* Adaptation is of the whole picture, but for the veil of glare; the eye does not move.

pub mod acuity;
pub mod adaptation;
pub mod foveal;
pub mod glare;
pub mod histogram_adjustment;
pub mod light_table;
pub mod limiting_magnitude;
pub mod mesopic;
pub mod paper;
pub mod pupil;
pub mod receptors;
pub mod rod_intrusion;
pub mod rods;
pub mod seeing;
pub mod threshold;
pub mod tone_curve;
pub mod twin;
pub mod white;

use serde::{Deserialize, Serialize};

use self::glare::{Glare, Optics};
use self::receptors::NightColour;

/// Whose eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Ours.
    #[default]
    Standard,
    /// The choice of Jensen et al. 2001, for comparison: [`paper`].
    Paper,
}

/// How the picture is seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Eye {
    pub model: Model,
    /// Brighter or darker than the eye would have it, in factors of two.
    pub exposure_stops: f64,
    /// What the eye has long been adapted to, cd/m2; to what it sees when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adaptation_cd_m2: Option<f64>,
    /// What it was adapted to before, cd/m2: it sees what is there since [`Eye::since_s`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coming_from_cd_m2: Option<f64>,
    /// Seconds since it came from elsewhere.
    pub since_s: f64,
    /// How colour goes with the light.
    pub night_colour: NightColour,
    /// How light is scattered in it.
    pub glare: Glare,
    /// Whether detail is lost that the eye does not resolve.
    pub acuity: bool,
    /// Whether it takes yellow light of the scene for white, in part.
    pub chromatic_adaptation: bool,
    /// Crumey's field factor: 1.4 for the keenest eyes, 2 for typical ones.
    pub field_factor: f64,
    /// Seed of the grain that few quanta of light make of the night; none when left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grain: Option<u64>,
    /// Of the observer.
    pub optics: Optics,
}

impl Default for Eye {
    fn default() -> Self {
        Eye {
            model: Model::Standard,
            exposure_stops: 0.0,
            adaptation_cd_m2: None,
            coming_from_cd_m2: None,
            since_s: 0.0,
            night_colour: NightColour::default(),
            glare: Glare::default(),
            acuity: true,
            chromatic_adaptation: true,
            field_factor: limiting_magnitude::TYPICAL_FIELD_FACTOR,
            grain: None,
            optics: Optics::default(),
        }
    }
}

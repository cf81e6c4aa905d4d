//! The options that say whose eye sees the picture, and how.

use clap::{Args, ValueEnum};

use crate::eye::glare::Glare;
use crate::eye::receptors::NightColour;
use crate::eye::{Eye, Model};

use super::error::CliError;

#[derive(Debug, Clone, Args)]
pub struct EyeArgs {
    /// Whose eye: ours, or the tone mapping of Jensen et al. 2001 [default: standard]
    #[arg(long, value_enum, value_name = "MODEL")]
    eye: Option<ModelArg>,
    /// Brighter (positive) or darker than the eye has it, in factors of two [default: 0]
    #[arg(long, value_name = "STOPS", allow_hyphen_values = true)]
    exposure: Option<f64>,
    /// Luminance that the eye is adapted to, cd/m2 [default: that of what it sees]
    #[arg(long, value_name = "CD_M2", allow_hyphen_values = true)]
    adapted_to: Option<f64>,
    /// Luminance that it was adapted to before it came here, cd/m2: a lit room has some 100
    #[arg(long, value_name = "CD_M2", allow_hyphen_values = true, requires = "after")]
    coming_from: Option<f64>,
    /// Minutes since it came here
    #[arg(long, value_name = "MINUTES", allow_hyphen_values = true, requires = "coming_from")]
    after: Option<f64>,
    /// How colour goes with the light [default: jensen]
    #[arg(long, value_enum, value_name = "MODEL")]
    night_colour: Option<ColourArg>,
    /// How light is scattered in the eye [default: cie]
    #[arg(long, value_enum, value_name = "MODEL")]
    glare: Option<GlareArg>,
    /// Show detail that the eye does not resolve
    #[arg(long)]
    no_acuity: bool,
    /// How well the observer sees faint stars: Crumey's field factor, 1.4 the keenest, 2 typical [default: 2]
    #[arg(long, value_name = "F", allow_hyphen_values = true)]
    field_factor: Option<f64>,
    /// Age of the observer, years [default: 30]
    #[arg(long, value_name = "YEARS", allow_hyphen_values = true)]
    age: Option<f64>,
    /// Grain of few quanta in the dark; the same seed gives the same grain
    #[arg(long, value_name = "SEED")]
    grain: Option<u64>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ModelArg {
    Standard,
    /// Jensen et al. 2001, for comparison
    Paper,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ColourArg {
    /// Jensen et al. 2000: into a bluish grey
    Jensen,
    /// After Cao et al. 2008: into the colour of rods in the pathways of cones
    Intrusion,
    /// Colours of day at any light
    Day,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum GlareArg {
    /// CIE 135/1
    Cie,
    /// Spencer et al. 1995
    Spencer,
    None,
}

impl EyeArgs {
    /// What a scene says, and what the options change.
    pub fn change(&self, base: Eye) -> Result<Eye, CliError> {
        let mut eye = base;
        if let Some(model) = self.eye {
            eye.model = match model {
                ModelArg::Standard => Model::Standard,
                ModelArg::Paper => Model::Paper,
            };
        }
        eye.exposure_stops = self.exposure.unwrap_or(eye.exposure_stops);
        eye.adaptation_cd_m2 = self.adapted_to.or(eye.adaptation_cd_m2);
        if let (Some(from), Some(minutes)) = (self.coming_from, self.after) {
            (eye.coming_from_cd_m2, eye.since_s) = (Some(from), 60.0 * minutes);
        }
        if let Some(colour) = self.night_colour {
            eye.night_colour = match colour {
                ColourArg::Jensen => NightColour::Jensen,
                ColourArg::Intrusion => NightColour::Intrusion,
                ColourArg::Day => NightColour::Day,
            };
        }
        if let Some(glare) = self.glare {
            eye.glare = match glare {
                GlareArg::Cie => Glare::Cie,
                GlareArg::Spencer => Glare::Spencer,
                GlareArg::None => Glare::None,
            };
        }
        eye.acuity &= !self.no_acuity;
        eye.field_factor = self.field_factor.unwrap_or(eye.field_factor);
        eye.optics.age_years = self.age.unwrap_or(eye.optics.age_years);
        eye.grain = self.grain.or(eye.grain);
        Ok(eye)
    }
}

//! The options that say how the picture is shown.

use clap::{Args, ValueEnum};

use crate::display::{ColourSpace, Display};
use crate::job::Bits;

use super::error::CliError;

#[derive(Debug, Clone, Args)]
pub struct DisplayArgs {
    /// Luminance of the screen's white, cd/m2 [default: 100]
    #[arg(long, value_name = "CD_M2", allow_hyphen_values = true)]
    display_peak: Option<f64>,
    /// Colours of the screen [default: srgb]
    #[arg(long, value_enum, value_name = "SPACE")]
    display: Option<SpaceArg>,
    /// Night mode: all light of the screen in red
    #[arg(long)]
    red: bool,
    /// Bits of each colour in the PNG: 8 or 16 [default: 8]
    #[arg(long, value_name = "BITS", allow_hyphen_values = true)]
    bits: Option<String>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SpaceArg {
    Srgb,
    /// Display P3
    #[value(alias = "display-p3")]
    P3,
    /// Primaries of sRGB, codes in proportion to light
    Linear,
}

impl From<SpaceArg> for ColourSpace {
    fn from(arg: SpaceArg) -> ColourSpace {
        match arg {
            SpaceArg::Srgb => ColourSpace::Srgb,
            SpaceArg::P3 => ColourSpace::DisplayP3,
            SpaceArg::Linear => ColourSpace::Linear,
        }
    }
}

impl DisplayArgs {
    /// What a scene says, and what the options change.
    pub fn change(&self, base: Display) -> Result<Display, CliError> {
        let display = Display {
            space: self.display.map_or(base.space, ColourSpace::from),
            peak_cd_m2: self.display_peak.unwrap_or(base.peak_cd_m2),
            red: base.red || self.red,
            ..base
        };
        display.validate().map_err(|error| CliError::Usage(error.to_string()))?;
        Ok(display)
    }

    /// How finely the PNG is written.
    pub fn bits(&self) -> Result<Bits, CliError> {
        match self.bits.as_deref() {
            None | Some("8") => Ok(Bits::Eight),
            Some("16") => Ok(Bits::Sixteen),
            Some(other) => Err(CliError::Usage(format!("--bits {other}: give 8 or 16"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Program {
        #[command(flatten)]
        display: DisplayArgs,
    }

    fn args(words: &[&str]) -> DisplayArgs {
        Program::try_parse_from(std::iter::once("nocturne").chain(words.iter().copied()))
            .unwrap_or_else(|error| panic!("{error}"))
            .display
    }

    #[test]
    fn options_change_what_they_name() {
        let base = Display { red: true, dither: false, ..Display::default() };
        assert_eq!(args(&[]).change(base).unwrap(), base);
        let shown = args(&["--display", "p3", "--display-peak", "250"]).change(base).unwrap();
        let meant = Display { space: ColourSpace::DisplayP3, peak_cd_m2: 250.0, ..base };
        assert_eq!(shown, meant);
        assert_eq!(args(&["--bits", "16"]).bits().unwrap(), Bits::Sixteen);
    }

    #[test]
    fn bad_values_are_refused_in_a_sentence() {
        let said = |error: CliError| error.message().unwrap_or_default();
        let error = args(&["--bits", "12"]).bits().unwrap_err();
        assert!(said(error).contains("8 or 16"));
        let error = args(&["--display-peak", "-5"]).change(Display::default()).unwrap_err();
        assert!(said(error).contains("peak_cd_m2"));
    }
}

//! The options that say how the dark sky glows.

use clap::{Args, ValueEnum};

use crate::light::lamps::Lamps;
use crate::light::night_lights::NightGlow;

use super::error::CliError;

#[derive(Debug, Clone, Args)]
pub struct NightGlowArgs {
    /// Flux of the Sun at 10.7 cm, solar flux units, which airglow follows [default: that of the
    /// solar cycle at the date]
    #[arg(long, value_name = "SFU", allow_hyphen_values = true)]
    solar_flux: Option<f64>,
    /// Glow of towns all around, by Bortle's class: 1, none, to 9, inner city
    #[arg(long, value_name = "CLASS")]
    bortle: Option<u8>,
    /// Glow of towns all around, by the brightness of the zenith of a moonless night in V,
    /// mag/arcsec2: 22, none, to 17, inner city
    #[arg(long, value_name = "MAG", allow_hyphen_values = true, conflicts_with = "bortle")]
    zenith_brightness: Option<f64>,
    /// Glow of the towns that are around the place
    #[arg(long, conflicts_with_all = ["bortle", "zenith_brightness"])]
    towns: bool,
    /// The lamps of towns [default: mixed]
    #[arg(long, value_enum)]
    lamps: Option<LampsArg>,
    /// Airglow as three lines, after Jensen et al. 2001
    #[arg(long)]
    paper: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum LampsArg {
    Mixed,
    /// White LED, 3000 K
    Led3000,
    /// White LED, 4000 K
    Led4000,
    /// Sodium at high pressure
    Sodium,
    /// Sodium at low pressure
    LowPressureSodium,
}

impl From<LampsArg> for Lamps {
    fn from(arg: LampsArg) -> Lamps {
        match arg {
            LampsArg::Mixed => Lamps::Mixed,
            LampsArg::Led3000 => Lamps::Led3000,
            LampsArg::Led4000 => Lamps::Led4000,
            LampsArg::Sodium => Lamps::Sodium,
            LampsArg::LowPressureSodium => Lamps::LowPressureSodium,
        }
    }
}

impl NightGlowArgs {
    /// What a scene says, and what the options change.
    pub fn change(&self, base: NightGlow) -> Result<NightGlow, CliError> {
        let mut glow = base;
        glow.solar_flux_sfu = self.solar_flux.or(base.solar_flux_sfu);
        if self.bortle.is_some() || self.zenith_brightness.is_some() || self.towns {
            glow.bortle = self.bortle;
            glow.zenith_mag_per_arcsec2 = self.zenith_brightness;
            glow.towns = self.towns;
        }
        glow.lamps = self.lamps.map_or(base.lamps, Lamps::from);
        glow.paper |= self.paper;
        glow.validate().map_err(|error| CliError::Usage(error.to_string()))?;
        Ok(glow)
    }
}

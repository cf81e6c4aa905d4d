//! From the words of the command line to an instant, a place, and the sky over it.

use crate::air::Atmosphere;
use crate::catalog::Catalogs;
use crate::ephemeris::{Ephemeris, EphemerisError};
use crate::job::skies;
use crate::light::earth_shadow::Danjon;
use crate::light::night::Night;
use crate::place::Place;
use crate::scene::{Scene, Setting};
use crate::sky::SkyState;
use crate::time::{self, Instant};
use crate::units::Angle;

use super::error::CliError;

/// The Sun this far below the horizon leaves the sky to the stars.
const DARK_ALTITUDE: Angle = Angle::from_deg(-15.0);
/// Good enough to tell day from night.
const DUSK_TOLERANCE: Angle = Angle::from_arcmin(10.0);
/// Steps in which the coming night is looked for.
const DUSK_STEP_S: f64 = 600.0;
const DAY_STEPS: usize = 144;

/// The instant that `--at` means at a place. Without an offset it is the time of clocks there.
pub fn instant(at: &str, place: &Place) -> Result<Instant, CliError> {
    let instant = match at.trim() {
        word if word.eq_ignore_ascii_case("tonight") => {
            tonight(time::to_instant(&time::parse("now")?, None)?, place)?
        }
        text => time::to_instant(&time::parse(text)?, place.time_zone)?,
    };
    // A scene file holds milliseconds; what is drawn now is what its file will draw.
    Ok(time::to_instant(&time::parse(&instant.to_string())?, None)?)
}

/// Now, if it is dark; the coming nightfall, if it is not; the darkest moment of the next day where
/// the Sun does not set far enough.
fn tonight(now: Instant, place: &Place) -> Result<Instant, CliError> {
    let ephemeris = Ephemeris::analytic();
    let altitude = |instant: &Instant| -> Result<Angle, EphemerisError> {
        Ok(SkyState::at(&ephemeris, instant, place, DUSK_TOLERANCE)?.sun.dir.altitude())
    };
    let mut darkest = (now, altitude(&now)?);
    for step in 0..=DAY_STEPS {
        let instant = now.plus_seconds(DUSK_STEP_S * step as f64)?;
        let altitude = altitude(&instant)?;
        if altitude < DARK_ALTITUDE {
            return Ok(instant);
        }
        if altitude < darkest.1 {
            darkest = (instant, altitude);
        }
    }
    Ok(darkest.0)
}

/// The sky with everything in it.
pub fn night(
    instant: &Instant,
    place: &Place,
    tolerance: Angle,
    air: &Atmosphere,
    danjon: Danjon,
    catalogs: &Catalogs,
) -> Result<Night, CliError> {
    Ok(skies::night(instant, place, tolerance, air, danjon, catalogs)?)
}

/// The sky of a scene, given what its values mean.
pub fn night_of(scene: &Scene, setting: &Setting, catalogs: &Catalogs) -> Result<Night, CliError> {
    let Setting { instant, place, tolerance, .. } = setting;
    night(instant, place, *tolerance, &scene.air, scene.moon.danjon, catalogs)
}

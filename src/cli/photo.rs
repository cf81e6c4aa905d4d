//! The options that say what a camera is set to.

use clap::{Args, ValueEnum};

use crate::camera::Projection;
use crate::photo::Photo;
use crate::photo::colour::WhiteBalance;
use crate::photo::lens::Lens;
use crate::photo::sensor::{Body, SensorKind};
use crate::scene::SceneCamera;
use crate::units::Angle;

use super::error::CliError;

#[derive(Debug, Clone, Args)]
pub struct PhotoArgs {
    /// Make the picture that a camera takes, not what an eye sees
    #[arg(long)]
    camera: bool,
    /// Sensor of the camera [default: full-frame]
    #[arg(long, value_enum, value_name = "SENSOR")]
    sensor: Option<SensorArg>,
    /// Focal length, millimetres; sets the field of view [default: 24, or that of --fov]
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    focal: Option<f64>,
    /// Aperture number [default: 2.8]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    aperture: Option<f64>,
    /// Time that the shutter is open: seconds, a fraction such as 1/60, or auto [default: auto]
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    shutter: Option<String>,
    /// Speed of the sensor: a number, or auto [default: auto]
    #[arg(long, value_name = "ISO", allow_hyphen_values = true)]
    iso: Option<String>,
    /// Brighter (positive) or darker than metered, in factors of two [default: 0]
    #[arg(long, value_name = "STOPS", allow_hyphen_values = true)]
    compensation: Option<f64>,
    /// Light that is recorded as white: daylight, tungsten, auto, or kelvin [default: daylight]
    #[arg(long, value_name = "WHITE", allow_hyphen_values = true)]
    white_balance: Option<String>,
    /// Whether less light falls beside the axis of the lens [default: on]
    #[arg(long, value_enum, value_name = "ON|OFF")]
    vignetting: Option<Switch>,
    /// Straight blades of the aperture, whose edges draw spikes; 0 for none [default: 0]
    #[arg(long, value_name = "BLADES", allow_hyphen_values = true)]
    spikes: Option<u32>,
    /// Of the noise: the same seed gives the same picture [default: 0]
    #[arg(long, value_name = "SEED")]
    noise_seed: Option<u32>,
    /// No noise
    #[arg(long, conflicts_with = "noise_seed")]
    no_noise: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Switch {
    On,
    Off,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SensorArg {
    /// 43.8 x 32.9 mm
    MediumFormat,
    /// 36 x 24 mm
    FullFrame,
    /// 23.5 x 15.6 mm
    ApsC,
    /// 17.3 x 13 mm
    MicroFourThirds,
    /// 9.8 x 7.3 mm
    Phone,
}

impl From<SensorArg> for SensorKind {
    fn from(arg: SensorArg) -> SensorKind {
        match arg {
            SensorArg::MediumFormat => SensorKind::MediumFormat,
            SensorArg::FullFrame => SensorKind::FullFrame,
            SensorArg::ApsC => SensorKind::ApsC,
            SensorArg::MicroFourThirds => SensorKind::MicroFourThirds,
            SensorArg::Phone => SensorKind::Phone,
        }
    }
}

impl PhotoArgs {
    /// What a scene says, and what the options change; none where an eye sees.
    pub fn change(&self, base: Option<Photo>) -> Result<Option<Photo>, CliError> {
        let base = match (base, self.camera) {
            (Some(base), _) => base,
            (None, true) => Photo::default(),
            (None, false) => return self.without_camera(),
        };
        let body = match self.sensor.map(SensorKind::from) {
            Some(sensor) if sensor != base.body.sensor => Body { sensor, ..Body::default() },
            _ => base.body,
        };
        let f_number = self.aperture.unwrap_or(base.lens.f_number);
        let photo = Photo {
            shutter_s: setting("--shutter", &self.shutter, base.shutter_s, "20, 1/60 or auto")?,
            iso: setting("--iso", &self.iso, base.iso, "3200 or auto")?,
            compensation_stops: self.compensation.unwrap_or(base.compensation_stops),
            noise: base.noise && !self.no_noise,
            seed: self.noise_seed.unwrap_or(base.seed),
            white_balance: self.white_balance(base.white_balance)?,
            body,
            lens: Lens {
                focal_mm: self.focal.unwrap_or(base.lens.focal_mm),
                f_number,
                // Whoever asks for a wider aperture has a lens that has it.
                widest_f_number: base.lens.widest_f_number.min(f_number),
                vignetting: self
                    .vignetting
                    .map_or(base.lens.vignetting, |switch| matches!(switch, Switch::On)),
                blades: self.spikes.unwrap_or(base.lens.blades),
                ..base.lens
            },
            ..base
        };
        photo.validate().map_err(|error| CliError::Usage(error.to_string()))?;
        Ok(Some(photo))
    }

    /// Brings lens and field of view together: one follows from the other.
    ///
    /// With `--focal`, or for a scene that had no camera and no field of its own, the field is that
    /// of the lens, and straight lines stay straight; otherwise the focal length is that of the field.
    pub fn aim(
        &self,
        photo: &mut Photo,
        view: &mut SceneCamera,
        field_is_given: bool,
    ) -> Result<(), CliError> {
        let sensor = photo.body.sensor();
        if self.focal.is_some() && field_is_given {
            return Err(CliError::Usage(
                "--focal and --fov both set the field of view; give one of them".to_owned(),
            ));
        }
        if self.focal.is_some() || !field_is_given {
            view.projection = Projection::Perspective;
            view.field_of_view_deg = photo.lens.field_of_view(&sensor).deg();
        } else if let Some(lens) =
            photo.lens.spanning(Angle::from_deg(view.field_of_view_deg), &sensor)
        {
            photo.lens = lens;
        }
        Ok(())
    }

    /// Options of a camera need one.
    fn without_camera(&self) -> Result<Option<Photo>, CliError> {
        let given = [
            ("--sensor", self.sensor.is_some()),
            ("--focal", self.focal.is_some()),
            ("--aperture", self.aperture.is_some()),
            ("--shutter", self.shutter.is_some()),
            ("--iso", self.iso.is_some()),
            ("--compensation", self.compensation.is_some()),
            ("--white-balance", self.white_balance.is_some()),
            ("--vignetting", self.vignetting.is_some()),
            ("--spikes", self.spikes.is_some()),
            ("--noise-seed", self.noise_seed.is_some()),
            ("--no-noise", self.no_noise),
        ];
        match given.iter().find(|(_, is_given)| *is_given) {
            Some((option, _)) => Err(CliError::Usage(format!(
                "{option} is for the picture of a camera; add --camera, or leave it out"
            ))),
            None => Ok(None),
        }
    }

    fn white_balance(&self, base: WhiteBalance) -> Result<WhiteBalance, CliError> {
        let Some(word) = self.white_balance.as_deref() else { return Ok(base) };
        match word {
            "daylight" => Ok(WhiteBalance::Daylight),
            "tungsten" => Ok(WhiteBalance::Tungsten),
            "auto" => Ok(WhiteBalance::Auto),
            number => number.trim_end_matches(['K', 'k']).trim().parse().map_or_else(
                |_| {
                    Err(CliError::Usage(format!(
                        "--white-balance {number}: give daylight, tungsten, auto, or a temperature such as 4000"
                    )))
                },
                |kelvin| Ok(WhiteBalance::Kelvin(kelvin)),
            ),
        }
    }
}

/// A number, a fraction, or none for `auto`.
fn setting(
    option: &str,
    given: &Option<String>,
    base: Option<f64>,
    examples: &str,
) -> Result<Option<f64>, CliError> {
    let Some(word) = given.as_deref() else { return Ok(base) };
    if word == "auto" {
        return Ok(None);
    }
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = match word.split_once('/') {
        Some((over, under)) => number(over).zip(number(under)).map(|(over, under)| over / under),
        None => number(word.trim_end_matches('s')),
    };
    match value {
        Some(value) => Ok(Some(value)),
        None => Err(CliError::Usage(format!("{option} {word}: give a number such as {examples}"))),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Program {
        #[command(flatten)]
        photo: PhotoArgs,
    }

    fn args(words: &[&str]) -> PhotoArgs {
        Program::try_parse_from(std::iter::once("nocturne").chain(words.iter().copied()))
            .unwrap_or_else(|error| panic!("{error}"))
            .photo
    }

    fn view() -> SceneCamera {
        SceneCamera {
            azimuth_deg: 0.0,
            altitude_deg: 30.0,
            roll_deg: 0.0,
            field_of_view_deg: 40.0,
            projection: Projection::Stereographic,
            width_px: 640,
            height_px: 360,
        }
    }

    #[test]
    fn options_set_the_camera() {
        assert_eq!(args(&[]).change(None).unwrap(), None);
        let words = "--camera --sensor aps-c --focal 50 --aperture 1.8 --shutter 1/60 --iso 800 \
                     --white-balance 3400K --vignetting off --spikes 7 --noise-seed 4";
        let photo = args(&words.split_whitespace().collect::<Vec<_>>()).change(None);
        let photo = photo.unwrap().unwrap();
        assert_eq!(photo.shutter_s, Some(1.0 / 60.0));
        assert_eq!((photo.iso, photo.seed), (Some(800.0), 4));
        assert_eq!(photo.white_balance, WhiteBalance::Kelvin(3400.0));
        assert_eq!(photo.body.sensor, SensorKind::ApsC);
        let lens = photo.lens;
        assert_eq!((lens.focal_mm, lens.f_number, lens.blades), (50.0, 1.8, 7));
        assert!(!lens.vignetting && lens.widest_f_number == 1.8);
        // A scene's camera stays as it is, but for what is said.
        let changed = args(&["--shutter", "auto", "--no-noise"]).change(Some(photo)).unwrap();
        assert_eq!(changed, Some(Photo { shutter_s: None, noise: false, ..photo }));
    }

    #[test]
    fn lens_and_field_follow_each_other() {
        let mut view = view();
        let focal = args(&["--camera", "--focal", "50"]);
        let mut photo = focal.change(None).unwrap().unwrap();
        focal.aim(&mut photo, &mut view, false).unwrap();
        assert!((view.field_of_view_deg - 39.6).abs() < 0.01);
        assert_eq!(view.projection, Projection::Perspective);
        assert!(focal.aim(&mut photo, &mut view, true).is_err());
        view.field_of_view_deg = 10.29;
        args(&["--camera"]).aim(&mut photo, &mut view, true).unwrap();
        assert!((photo.lens.focal_mm - 200.0).abs() < 0.1, "{}", photo.lens.focal_mm);
    }

    #[test]
    fn bad_values_are_refused_in_a_sentence() {
        for (words, part) in [
            (&["--iso", "800"][..], "--camera"),
            (&["--camera", "--iso", "fast"], "--iso fast"),
            (&["--camera", "--iso", "-3"], "photo.iso"),
            (&["--camera", "--shutter", "1/0"], "shutter_s"),
            (&["--camera", "--white-balance", "blue"], "daylight"),
            (&["--camera", "--white-balance", "20"], "white_balance"),
            (&["--camera", "--spikes", "2"], "blades"),
            (&["--camera", "--aperture", "0"], "f_number"),
        ] {
            let said = args(words).change(None).unwrap_err().message().unwrap_or_default();
            assert!(said.contains(part), "{words:?}: {said}");
        }
    }
}

//! The files that a render was asked for.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::export::describe::Description;
use crate::export::exif::About;
use crate::export::exr::{self, Attribute};
use crate::export::{OutputFile, png};
use crate::image::{Codes, HdrFrame};
use crate::light::night::Night;
use crate::photo::exposure::Exposure;
use crate::scene::{Scene, Setting};

use super::display::Bits;
use super::draw::Wanted;
use super::error::CliError;

/// The files, opened before the work begins, so that none of it is done for nothing.
pub struct Outputs {
    png: Vec<OutputFile>,
    exr: Vec<OutputFile>,
    scene: Option<OutputFile>,
    description: Option<OutputFile>,
    describe_to_stdout: bool,
}

/// A finished picture.
pub struct Picture {
    /// The light itself.
    pub frame: Option<HdrFrame>,
    /// What the eye or the camera made of it.
    pub codes: Option<Codes>,
    /// What the camera was set to.
    pub exposure: Option<Exposure>,
}

/// What was written.
pub struct Written {
    pub paths: Vec<PathBuf>,
    pub used_stdout: bool,
}

impl Outputs {
    pub fn open(
        pictures: &[PathBuf],
        description: &Option<PathBuf>,
        scene: &Option<PathBuf>,
    ) -> Result<Outputs, CliError> {
        let (mut png, mut exr) = (Vec::new(), Vec::new());
        for path in pictures {
            let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
            let kind = match extension.to_ascii_lowercase().as_str() {
                "png" => &mut png,
                "exr" => &mut exr,
                _ => {
                    return Err(CliError::Usage(format!(
                        "--output {}: the name must end in .png or .exr",
                        path.display()
                    )));
                }
            };
            kind.push(OutputFile::create(path)?);
        }
        let describe_to_stdout = description.as_deref() == Some(Path::new("-"));
        let open = |path: &Option<PathBuf>| path.as_deref().map(OutputFile::create).transpose();
        let outputs = Outputs {
            png,
            exr,
            scene: open(scene)?,
            description: if describe_to_stdout { None } else { open(description)? },
            describe_to_stdout,
        };
        outputs.check_apart()?;
        if !outputs.draws() && scene.is_none() && description.is_none() {
            return Err(CliError::Usage(
                "nothing to write: give --output FILE, --describe FILE or --save-scene FILE"
                    .to_owned(),
            ));
        }
        Ok(outputs)
    }

    /// Whether a picture has to be drawn at all.
    pub fn draws(&self) -> bool {
        !self.png.is_empty() || !self.exr.is_empty()
    }

    /// What of the drawing the files hold.
    pub fn wanted(&self, bits: Bits) -> Wanted {
        Wanted { frame: !self.exr.is_empty(), picture: (!self.png.is_empty()).then_some(bits) }
    }

    /// Refuses two outputs of the same name, one of which would be lost.
    fn check_apart(&self) -> Result<(), CliError> {
        let pictures = self.png.iter().chain(&self.exr);
        let files: Vec<_> = pictures.chain(&self.scene).chain(&self.description).collect();
        for (index, file) in files.iter().enumerate() {
            if files[..index].iter().any(|other| other.is_same_as(file)) {
                return Err(CliError::Usage(format!(
                    "{} is given for two outputs; give each a file of its own",
                    file.path().display()
                )));
            }
        }
        Ok(())
    }

    /// Steps of the work: positions and writing, and four of drawing.
    pub fn steps(&self) -> u64 {
        if self.draws() { 6 } else { 2 }
    }

    /// Writes everything.
    pub fn write(
        self,
        scene: &Scene,
        setting: &Setting,
        night: &Night,
        picture: Option<&Picture>,
        stdout: &mut impl Write,
    ) -> Result<Written, CliError> {
        let mut paths = Vec::new();
        let mut note = |file: &OutputFile| paths.push(file.path().to_owned());
        if let Some(picture) = picture {
            let about = About {
                instant: &setting.instant,
                place: &setting.place,
                exposure: picture.exposure.as_ref(),
            };
            for (file, codes) in self.png.into_iter().zip(picture.codes.iter().cycle()) {
                note(&file);
                png::write_with(file, codes, scene.display.space, Some(&about))?;
            }
            let mut attributes = attributes(setting);
            attributes.extend(picture.exposure.iter().flat_map(exr::of_exposure));
            for (file, frame) in self.exr.into_iter().zip(picture.frame.iter().cycle()) {
                note(&file);
                exr::write(file, frame, &attributes)?;
            }
        }
        if let Some(file) = self.scene {
            note(&file);
            file.write(|writer| writer.write_all(scene.to_toml().as_bytes()))?;
        }
        if let Some(file) = self.description {
            note(&file);
            Description::of(setting, night).write(file)?;
        }
        if self.describe_to_stdout {
            Description::of(setting, night).write_to(stdout)?;
        }
        Ok(Written { paths, used_stdout: self.describe_to_stdout })
    }
}

/// What an EXR says about its frame.
fn attributes(setting: &Setting) -> Vec<(&'static str, Attribute)> {
    let text = |text: &str| Attribute::Text(text.to_owned());
    let Setting { instant, place, camera, .. } = setting;
    vec![
        (
            "units",
            text("cd/m2; X, Y, Z: CIE 1931 with 683 lm/W; V: CIE 1951 scotopic with 1700 lm/W"),
        ),
        ("instant_utc", text(&instant.to_string())),
        ("jd_tt", Attribute::Number(instant.tt.jd())),
        ("jd_ut1", Attribute::Number(instant.ut1.jd())),
        ("place", text(place.name.as_deref().unwrap_or(""))),
        ("latitude_deg", Attribute::Number(place.latitude.deg())),
        ("longitude_deg", Attribute::Number(place.longitude.deg())),
        ("height_m", Attribute::Number(place.height_m)),
        ("projection", text(camera.projection.name())),
        ("field_of_view_deg", Attribute::Number(camera.field_of_view.deg())),
        ("azimuth_deg", Attribute::Number(camera.azimuth.deg())),
        ("altitude_deg", Attribute::Number(camera.altitude.deg())),
        ("roll_deg", Attribute::Number(camera.roll.deg())),
    ]
}

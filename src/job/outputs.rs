//! The files of a picture: opened before the work begins, so that none of it is done for nothing.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::export::describe::Description;
use crate::export::exif::About;
use crate::export::exr::{self, Attribute};
use crate::export::{OutputFile, png};
use crate::scene::Setting;

use super::picture::{Picture, Wanted};
use super::{Bits, JobError, Subject};

/// Files that are open. Those that are not written leave no trace.
#[derive(Debug)]
pub struct Outputs {
    png: Vec<OutputFile>,
    exr: Vec<OutputFile>,
    scene: Option<OutputFile>,
    description: Option<OutputFile>,
}

impl Outputs {
    /// Opens pictures, whose names say what they are, and files for the scene and for what is in it.
    pub fn open(
        pictures: &[PathBuf],
        scene: Option<&Path>,
        description: Option<&Path>,
    ) -> Result<Outputs, JobError> {
        let (mut png, mut exr) = (Vec::new(), Vec::new());
        for path in pictures {
            let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
            let kind = match extension.to_ascii_lowercase().as_str() {
                "png" => &mut png,
                "exr" => &mut exr,
                _ => return Err(JobError::Extension { path: path.display().to_string() }),
            };
            kind.push(OutputFile::create(path)?);
        }
        let open = |path: Option<&Path>| path.map(OutputFile::create).transpose();
        let outputs = Outputs { png, exr, scene: open(scene)?, description: open(description)? };
        outputs.check_apart()?;
        Ok(outputs)
    }

    /// Whether a picture has to be drawn at all.
    pub fn draws(&self) -> bool {
        !self.png.is_empty() || !self.exr.is_empty()
    }

    pub fn is_empty(&self) -> bool {
        !self.draws() && self.scene.is_none() && self.description.is_none()
    }

    /// What of the drawing the files hold.
    pub fn wanted(&self, bits: Bits) -> Wanted {
        Wanted { frame: !self.exr.is_empty(), picture: (!self.png.is_empty()).then_some(bits) }
    }

    /// Refuses two outputs of the same name, one of which would be lost.
    fn check_apart(&self) -> Result<(), JobError> {
        let pictures = self.png.iter().chain(&self.exr);
        let files: Vec<_> = pictures.chain(&self.scene).chain(&self.description).collect();
        for (index, file) in files.iter().enumerate() {
            if files[..index].iter().any(|other| other.is_same_as(file)) {
                return Err(JobError::Twice { path: file.path().display().to_string() });
            }
        }
        Ok(())
    }

    /// Writes everything, and says what.
    pub fn write(
        self,
        subject: &Subject,
        picture: Option<&Picture>,
    ) -> Result<Vec<PathBuf>, JobError> {
        let Subject { scene, setting, night } = *subject;
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
        Ok(paths)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_what_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let open = |names: &[&str]| {
            let paths: Vec<PathBuf> = names.iter().map(|name| path(name)).collect();
            Outputs::open(&paths, None, None)
        };
        let frame = open(&["sky.EXR"]).unwrap().wanted(Bits::Sixteen);
        assert!(frame.frame && frame.picture.is_none());
        let both = open(&["sky.png", "sky.exr"]).unwrap().wanted(Bits::Sixteen);
        assert!(both.frame && both.picture == Some(Bits::Sixteen));
        assert!(matches!(open(&["sky.jpg"]), Err(JobError::Extension { .. })));
        assert!(matches!(open(&["sky.png", "./sky.png"]), Err(JobError::Twice { .. })));
        let same = Outputs::open(&[path("a.png")], Some(&path("a.png")), None);
        assert!(matches!(same, Err(JobError::Twice { .. })));
        let nothing = open(&[]).unwrap();
        assert!(nothing.is_empty() && !nothing.draws());
        // Files that were opened and not written leave no trace.
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

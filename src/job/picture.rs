//! Draws the picture of a sky.

use crate::image::{Codes, HdrFrame};
use crate::photo::exposure::Exposure;
use crate::plan::ledger::Ledger;

use super::Bits;

/// What of the drawing is wanted.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// The frame itself.
    pub frame: bool,
    /// A picture of it.
    pub picture: Option<Bits>,
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

/// What was drawn, and what it cost.
#[derive(Debug)]
pub struct Drawn {
    pub ledger: Ledger,
    /// The graphics adapter.
    pub adapter: String,
    /// Milliseconds of the GPU, by pass.
    pub passes: Vec<(String, f64)>,
    /// What the eye or the camera was set to, in words; none where nobody looked.
    pub viewer: Option<String>,
}

#[cfg(feature = "gpu")]
pub use drawing::draw;

#[cfg(feature = "gpu")]
mod drawing {
    use super::{Drawn, Picture, Wanted};
    use crate::job::skies::Skies;
    use crate::job::steps::Steps;
    use crate::job::{Bits, JobError, Subject};
    use crate::overlay;
    use crate::render::picture::Depth;
    use crate::render::{Look, Made, Renderer, Viewer};

    /// Lays light and air, draws, and sees: three steps.
    pub fn draw(
        subject: &Subject,
        wanted: Wanted,
        skies: &mut dyn Skies,
        renderer: &Renderer,
        steps: &mut Steps,
    ) -> Result<(Picture, Drawn), JobError> {
        let Subject { scene, setting, night } = *subject;
        let (plan, ledger) = steps.step("light and air", 0.4, || skies.lay(subject))??;
        let mut picture = Picture { frame: None, codes: None, exposure: None };
        let mut viewer = None;
        let passes = match wanted.picture {
            None => {
                let rendered = steps.step("drawing", 0.6, || renderer.frame(&plan))??;
                picture.frame = Some(rendered.frame);
                rendered.times
            }
            Some(bits) => {
                let look = Look {
                    viewer: scene.photo.as_ref().map_or(Viewer::Eye(&scene.eye), Viewer::Photo),
                    display: &scene.display,
                    depth: match bits {
                        Bits::Eight => Depth::Codes,
                        Bits::Sixteen => Depth::Linear,
                    },
                };
                let looked =
                    steps.step("drawing", 0.5, || renderer.look(&plan, &look, wanted.frame))??;
                let codes = steps.step("seeing", 0.1, || {
                    let mut codes = looked.picture.into_codes(&scene.display);
                    overlay::draw(
                        scene.marks,
                        &mut codes,
                        &setting.camera,
                        night.horizon,
                        &scene.display,
                    );
                    codes
                })?;
                (picture.frame, picture.codes) = (looked.frame, Some(codes));
                match looked.made {
                    Made::Seen(seeing) => {
                        viewer = Some(format!(
                            "Eye adapted to {:.3e} cd/m2, pupil {:.1} mm",
                            seeing.adaptation_cd_m2, seeing.pupil_mm
                        ));
                    }
                    Made::Exposed(exposure) => {
                        viewer = Some(exposure.to_string());
                        picture.exposure = Some(*exposure);
                    }
                }
                looked.times
            }
        };
        let drawn = Drawn {
            ledger,
            adapter: renderer.adapter(),
            passes: passes.into_iter().map(|time| (time.pass, time.milliseconds)).collect(),
            viewer,
        };
        Ok((picture, drawn))
    }
}

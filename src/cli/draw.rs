//! Draws the picture of a night.

use crate::catalog::Catalogs;
use crate::light::night::Night;
use crate::plan::ledger::Ledger;
use crate::scene::{Scene, Setting};

use super::display::Bits;
use super::error::CliError;
use super::outputs::Picture;
use super::progress::Progress;

/// What of the drawing is wanted.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// The frame itself.
    pub frame: bool,
    /// A picture of it.
    pub picture: Option<Bits>,
}

/// A picture, and what it cost.
pub struct Drawn {
    pub picture: Picture,
    pub ledger: Ledger,
    /// The graphics adapter.
    pub adapter: String,
    /// Milliseconds of the GPU, by pass.
    pub passes: Vec<(String, f64)>,
    /// What the eye or the camera was set to, in words; none where nobody looked.
    pub viewer: Option<String>,
}

/// Draws it.
#[cfg(feature = "gpu")]
pub fn draw(
    scene: &Scene,
    setting: &Setting,
    night: &Night,
    catalogs: &Catalogs,
    wanted: Wanted,
    progress: &mut Progress,
) -> Result<Drawn, CliError> {
    use crate::overlay;
    use crate::plan::lay::{Kept, lay_in};
    use crate::render::picture::Depth;
    use crate::render::{Look, Made, Renderer, Viewer};
    use crate::store::Store;

    // Whether anything can be drawn is known soon, so ask before the long work.
    let renderer = progress.step("graphics adapter", Renderer::new)?;
    let mut kept = Kept::new(Store::of_user());
    let (plan, ledger) = progress
        .step("light and air", || lay_in(setting, &scene.layers, night, catalogs, &mut kept))?;
    let mut picture = Picture { frame: None, codes: None, exposure: None };
    let mut viewer = None;
    let passes = match wanted.picture {
        None => {
            let rendered = progress.step("drawing", || renderer.frame(&plan))?;
            picture.frame = Some(rendered.frame);
            progress.step("seeing", || ());
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
            let looked = progress.step("drawing", || renderer.look(&plan, &look, wanted.frame))?;
            let codes = progress.step("seeing", || {
                let mut codes = looked.picture.into_codes(&scene.display);
                overlay::draw(
                    scene.marks,
                    &mut codes,
                    &setting.camera,
                    night.horizon,
                    &scene.display,
                );
                codes
            });
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
    Ok(Drawn {
        picture,
        ledger,
        adapter: renderer.adapter(),
        passes: passes.into_iter().map(|time| (time.pass, time.milliseconds)).collect(),
        viewer,
    })
}

#[cfg(not(feature = "gpu"))]
pub fn draw(
    _scene: &Scene,
    _setting: &Setting,
    _night: &Night,
    _catalogs: &Catalogs,
    _wanted: Wanted,
    _progress: &mut Progress,
) -> Result<Drawn, CliError> {
    let message = "this program was built without its renderer; build it with the feature gpu";
    Err(CliError::Failure(message.to_owned()))
}

//! Draws the picture of a night.

use crate::catalog::Catalogs;
use crate::light::night::Night;
use crate::plan::ledger::Ledger;
use crate::scene::{Scene, Setting};

use super::error::CliError;
use super::progress::Progress;

/// A picture, and what it cost.
pub struct Drawn {
    pub picture: super::outputs::Picture,
    pub ledger: Ledger,
    /// The graphics adapter.
    pub adapter: String,
    /// Milliseconds of the GPU, by pass.
    pub passes: Vec<(String, f64)>,
    /// What the eye was adapted to, cd/m2.
    pub adaptation_cd_m2: f64,
}

/// Draws it.
#[cfg(feature = "gpu")]
pub fn draw(
    scene: &Scene,
    setting: &Setting,
    night: &Night,
    catalogs: &Catalogs,
    progress: &mut Progress,
) -> Result<Drawn, CliError> {
    use crate::overlay;
    use crate::plan::lay::{Kept, lay_in};
    use crate::render::Renderer;
    use crate::render::picture::{Depth, Picture};
    use crate::store::Store;

    // Whether anything can be drawn is known soon, so ask before the long work.
    let renderer = progress.step("graphics adapter", Renderer::new)?;
    let mut kept = Kept::new(Store::of_user());
    let (plan, ledger) = progress
        .step("light and air", || lay_in(setting, &scene.layers, night, catalogs, &mut kept))?;
    let rendered = progress.step("drawing", || renderer.frame(&plan))?;
    let frame = rendered.frame;
    let looked = renderer.seen(&plan, &scene.eye, &scene.display, Depth::Codes)?;
    let Picture::Codes(mut seen) = looked.picture else { unreachable!() };
    overlay::draw(scene.marks, &mut seen, &setting.camera, night.horizon);
    Ok(Drawn {
        picture: super::outputs::Picture { frame, seen },
        ledger,
        adapter: renderer.adapter(),
        passes: looked.times.into_iter().map(|time| (time.pass, time.milliseconds)).collect(),
        adaptation_cd_m2: looked.seeing.adaptation_cd_m2,
    })
}

#[cfg(not(feature = "gpu"))]
pub fn draw(
    _scene: &Scene,
    _setting: &Setting,
    _night: &Night,
    _catalogs: &Catalogs,
    _progress: &mut Progress,
) -> Result<Drawn, CliError> {
    let message = "this program was built without its renderer; build it with the feature gpu";
    Err(CliError::Failure(message.to_owned()))
}

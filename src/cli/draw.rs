//! Draws the picture of a night and writes it, where there is a renderer.

use crate::catalog::Catalogs;
use crate::job::outputs::Outputs;
use crate::job::steps::Steps;
use crate::job::{Bits, Subject, Written};

use super::error::CliError;

/// Draws and writes what is asked for.
#[cfg(feature = "gpu")]
pub fn finish(
    outputs: Outputs,
    subject: &Subject,
    bits: Bits,
    catalogs: &Catalogs,
    steps: &mut Steps,
) -> Result<Written, CliError> {
    use crate::job::skies::FromCatalogs;
    use crate::job::still;
    use crate::render::Renderer;
    use crate::store::Store;

    // Whether anything can be drawn is known soon, so ask before the long work.
    let renderer = steps.step("graphics adapter", 0.1, Renderer::new)??;
    let mut skies = FromCatalogs::new(catalogs, Store::of_user());
    let mut rest = steps.part("", 0.9);
    let written = still::finish(outputs, subject, bits, &mut skies, &renderer, &mut rest)?;
    let times = steps.times().iter().chain(&written.times).copied().collect();
    Ok(Written { times, ..written })
}

#[cfg(not(feature = "gpu"))]
pub fn finish(
    _outputs: Outputs,
    _subject: &Subject,
    _bits: Bits,
    _catalogs: &Catalogs,
    _steps: &mut Steps,
) -> Result<Written, CliError> {
    let message = "this program was built without its renderer; build it with the feature gpu";
    Err(CliError::Failure(message.to_owned()))
}

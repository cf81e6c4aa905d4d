//! One picture of one moment.

use std::path::PathBuf;

use crate::render::Renderer;
use crate::scene::Scene;

use super::outputs::Outputs;
use super::skies::Skies;
use super::steps::Steps;
use super::{Bits, JobError, Subject, Written, picture};

/// A picture, and the files that it goes to.
#[derive(Debug, Clone, PartialEq)]
pub struct Still {
    pub scene: Scene,
    /// Files that end in .png (as an eye sees it, or a camera) or .exr (cd/m2).
    pub outputs: Vec<PathBuf>,
    /// Of the PNG.
    pub bits: Bits,
    /// A file for the scene, from which the same picture can be drawn again.
    pub save_scene: Option<PathBuf>,
    /// A file for where every object is and how bright, as JSON.
    pub describe: Option<PathBuf>,
}

impl Still {
    /// Pictures alone, in 8 bits.
    pub fn new(scene: Scene, outputs: Vec<PathBuf>) -> Still {
        Still { scene, outputs, bits: Bits::default(), save_scene: None, describe: None }
    }
}

/// Makes a picture and writes it. Where it is stopped or fails before the writing, no file has
/// changed; after that each is whole, as it was or as it is now.
pub fn run(
    still: &Still,
    skies: &mut dyn Skies,
    renderer: &Renderer,
    steps: &mut Steps,
) -> Result<Written, JobError> {
    let scene = &still.scene;
    let setting = scene.setting()?;
    let Still { save_scene, describe, .. } = still;
    let outputs = Outputs::open(&still.outputs, save_scene.as_deref(), describe.as_deref())?;
    if outputs.is_empty() {
        return Err(JobError::NoOutput);
    }
    let night = steps.step("positions", 0.1, || skies.night(scene, &setting))??;
    let subject = Subject { scene, setting: &setting, night: &night };
    let mut rest = steps.part("", 0.9);
    let written = finish(outputs, &subject, still.bits, skies, renderer, &mut rest)?;
    let times = steps.times().iter().chain(&written.times).copied().collect();
    Ok(Written { times, ..written })
}

/// The same when the files are open and the sky is known.
pub fn finish(
    outputs: Outputs,
    subject: &Subject,
    bits: Bits,
    skies: &mut dyn Skies,
    renderer: &Renderer,
    steps: &mut Steps,
) -> Result<Written, JobError> {
    let mut times = Vec::new();
    let made = match outputs.draws() {
        true => {
            let mut part = steps.part("", 0.8);
            let wanted = outputs.wanted(bits);
            let made = picture::draw(subject, wanted, skies, renderer, &mut part)?;
            times.extend_from_slice(part.times());
            Some(made)
        }
        false => None,
    };
    let (picture, drawn) = made.unzip();
    let paths = steps.step("writing", 0.2, || outputs.write(subject, picture.as_ref()))??;
    times.extend_from_slice(steps.times());
    Ok(Written { paths, drawn, times })
}

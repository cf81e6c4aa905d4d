//! `nocturne` alone: the window.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::app::state::StateFile;
use crate::app::{self, Options};
use crate::catalog::Catalogs;
use crate::scene::{Scene, ScenePlace};
use crate::time;

use super::WhereArgs;
use super::error::CliError;

/// Edges that a window may have, points.
const EDGES: std::ops::RangeInclusive<u32> = 240..=16_384;

#[derive(Debug, Args)]
pub struct WindowArgs {
    /// Open the window on a scene file
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    #[command(flatten)]
    location: WhereArgs,
    /// Open the window at a time, which stands still; without an offset, the time of clocks at the
    /// place
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    at: Option<String>,
    /// Size of the window, such as 1280x720
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Open the window in full screen
    #[arg(long)]
    full_screen: bool,
    /// Write a line for each frame that was presented: seconds of the monotonic clock
    #[arg(long, value_name = "FILE")]
    frame_log: Option<PathBuf>,
    /// Draw frame after frame, also when nothing changes
    #[arg(long)]
    continuous: bool,
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let edges = text.split_once(['x', 'X', '×']);
    let edge = |text: &str| text.trim().parse().ok().filter(|edge| EDGES.contains(edge));
    let size = edges.and_then(|(width, height)| Some([edge(width)?, edge(height)?]));
    let [low, high] = [EDGES.start(), EDGES.end()];
    size.ok_or_else(|| format!("give width and height from {low} to {high}, such as 1280x720"))
}

pub fn run(args: &WindowArgs, catalogs: Option<&Path>) -> Result<(), CliError> {
    let catalogs = Catalogs::locate(catalogs)?;
    let read = |path: &PathBuf| {
        let text = std::fs::read_to_string(path)
            .map_err(|error| CliError::Failure(format!("{}: {error}", path.display())))?;
        Scene::parse(&text).map_err(|error| CliError::Usage(format!("{}: {error}", path.display())))
    };
    if let Some(at) = &args.at {
        // What makes no sense is told before a window is opened.
        time::parse(at)?;
    }
    let place = args.location.find(&catalogs)?.map(|place| ScenePlace {
        latitude_deg: place.latitude.deg(),
        longitude_deg: place.longitude.deg(),
        height_m: place.height_m,
        time_zone: place.time_zone.map(|zone| zone.name().to_owned()),
        name: place.name,
    });
    let options = Options {
        scene: args.scene.as_ref().map(read).transpose()?,
        place,
        at: args.at.clone(),
        size: args.size,
        state: StateFile::standard_path(),
        full_screen: args.full_screen,
        frame_log: args.frame_log.clone(),
        continuous: args.continuous,
    };
    app::run(options, catalogs).map_err(|error| CliError::Failure(error.to_string()))
}

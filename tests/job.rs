//! Jobs that draw: what they write, and what they leave when they are stopped. Without an adapter
//! every test here is reported as ignored.

#[path = "support/mod.rs"]
mod support;

use std::fs;
use std::path::Path;

use libtest_mimic::Failed;
use nocturne::background::Interrupt;
use nocturne::catalog::Catalogs;
use nocturne::export::exr;
use nocturne::job::skies::FromCatalogs;
use nocturne::job::steps::{Progress, Steps};
use nocturne::job::still::{self, Still};
use nocturne::job::{JobError, Written};
use nocturne::render::Renderer;
use nocturne::scene::Scene;
use nocturne::store::Store;
use support::{GpuTest, check, drawn};

fn main() {
    // A window shares its renderer with the thread of a job.
    fn is_shared<T: Send + Sync + 'static>() {}
    is_shared::<Renderer>();
    support::run([
        GpuTest::new("a_still_holds_the_light_of_its_scene", the_light_of_its_scene),
        GpuTest::new("the_saved_scene_gives_the_same_files", the_same_files),
        GpuTest::new("a_still_that_is_stopped_leaves_what_was", stopped),
        GpuTest::new("a_still_without_files_is_refused", without_files),
    ])
}

fn scene() -> Result<Scene, Failed> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/sunset.toml");
    Ok(Scene::parse(&fs::read_to_string(path)?)?)
}

/// Does the job, telling each step to `tell`, which may stop it.
fn run(
    renderer: &Renderer,
    still: &Still,
    mut tell: impl FnMut(&Progress, &Interrupt),
) -> Result<Written, JobError> {
    let catalogs = Catalogs::locate(None)?;
    let interrupt = Interrupt::default();
    let mut told = |progress: Progress| tell(&progress, &interrupt);
    let mut skies = FromCatalogs::new(&catalogs, Store::NONE);
    still::run(still, &mut skies, renderer, &mut Steps::new(&mut told, &interrupt))
}

fn the_light_of_its_scene(renderer: &Renderer) -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("sky.exr");
    let scene = scene()?;
    let mut reached = Vec::new();
    let still = Still::new(scene.clone(), vec![path.clone()]);
    let written =
        run(renderer, &still, |progress, _| reached.push((progress.what.clone(), progress.done)))?;
    check(written.paths == [path.clone()], || format!("{:?}", written.paths))?;
    check(exr::read(&path)?.0 == drawn(renderer, &scene)?.0, || "other light".to_owned())?;
    let drawn = written.drawn.ok_or("nothing is said of the drawing")?;
    check(!drawn.ledger.entries.is_empty() && drawn.viewer.is_none(), || format!("{drawn:?}"))?;
    let names: Vec<&str> = reached.iter().map(|(what, _)| what.as_str()).collect();
    let meant = ["positions", "light and air", "drawing", "writing"];
    check(names == meant, || format!("{names:?}"))?;
    let timed: Vec<&str> = written.times.iter().map(|(what, _)| *what).collect();
    check(timed == meant, || format!("{timed:?}"))?;
    check(reached.is_sorted_by(|a, b| a.1 < b.1) && reached[3].1 < 1.0, || format!("{reached:?}"))
}

fn the_same_files(renderer: &Renderer) -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    let first = Still {
        save_scene: Some(path("sky.toml")),
        describe: Some(path("sky.json")),
        ..Still::new(scene()?, vec![path("first.png"), path("first.exr")])
    };
    let written = run(renderer, &first, |_, _| {})?;
    let names = ["first.png", "first.exr", "sky.toml", "sky.json"];
    check(written.paths == names.map(path), || format!("{:?}", written.paths))?;
    check(written.drawn.is_some_and(|d| d.viewer.is_some()), || "no viewer".to_owned())?;
    let saved = Scene::parse(&fs::read_to_string(path("sky.toml"))?)?;
    let again = Still::new(saved, vec![path("again.png"), path("again.exr")]);
    run(renderer, &again, |_, _| {})?;
    for kind in ["png", "exr"] {
        let [first, again] =
            ["first", "again"].map(|name| fs::read(path(&format!("{name}.{kind}"))));
        check(first? == again?, || format!("another {kind}"))?;
    }
    check(fs::read_dir(folder.path())?.count() == 6, || "drafts are left".to_owned())
}

fn stopped(renderer: &Renderer) -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let [old, new] = ["old.png", "new.exr"].map(|name| folder.path().join(name));
    fs::write(&old, "old")?;
    let still = Still::new(scene()?, vec![old.clone(), new]);
    // Whatever was begun is done to its end, and what comes next is not begun.
    for last in ["positions", "light and air", "drawing", "seeing"] {
        let mut begun = String::new();
        let result = run(renderer, &still, |progress, interrupt| {
            begun.clone_from(&progress.what);
            if progress.what == last {
                interrupt.raise();
            }
        });
        check(matches!(result, Err(JobError::Interrupted)), || format!("{last}: {result:?}"))?;
        check(begun == last, || format!("{begun} after {last}"))?;
        check(fs::read(&old)? == b"old", || format!("{last}: the old file is gone"))?;
        check(fs::read_dir(folder.path())?.count() == 1, || format!("{last}: a draft is left"))?;
    }
    Ok(())
}

fn without_files(renderer: &Renderer) -> Result<(), Failed> {
    let result = run(renderer, &Still::new(scene()?, Vec::new()), |_, _| {});
    check(matches!(result, Err(JobError::NoOutput)), || format!("{result:?}"))
}

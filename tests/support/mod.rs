//! What the tests that draw have in common.

// Not every test that draws uses all of it.
#![allow(dead_code)]

use libtest_mimic::{Arguments, Failed, Trial};
use nocturne::camera::Camera;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::Ephemeris;
use nocturne::image::HdrFrame;
use nocturne::light::night::Night;
use nocturne::plan::FramePlan;
use nocturne::plan::lay::lay;
use nocturne::plan::ledger::Ledger;
use nocturne::render::Renderer;
use nocturne::scene::{Scene, Setting};
use nocturne::sky::SkyState;
use nocturne::units::Xyzv;

type Draws = dyn Fn(&Renderer) -> Result<(), Failed> + Send;

/// A test that draws.
pub struct GpuTest {
    name: String,
    draws: Box<Draws>,
}

impl GpuTest {
    pub fn new(
        name: impl Into<String>,
        draws: impl Fn(&Renderer) -> Result<(), Failed> + Send + 'static,
    ) -> GpuTest {
        GpuTest { name: name.into(), draws: Box::new(draws) }
    }
}

/// Runs tests with one renderer; without an adapter each of them is reported as ignored.
pub fn run(tests: impl IntoIterator<Item = GpuTest>) -> ! {
    let arguments = Arguments::from_args();
    let renderer: Option<&'static Renderer> = match Renderer::new() {
        Ok(renderer) => Some(Box::leak(Box::new(renderer))),
        Err(error) => {
            eprintln!("tests that draw are ignored: {error}");
            None
        }
    };
    let trials = tests
        .into_iter()
        .map(|GpuTest { name, draws }| {
            Trial::test(name, move || match renderer {
                Some(renderer) => draws(renderer),
                None => Err("no adapter".into()),
            })
            .with_ignored_flag(renderer.is_none())
        })
        .collect();
    libtest_mimic::run(&arguments, trials).exit()
}

/// Fails with a message unless something holds.
pub fn check(holds: bool, message: impl FnOnce() -> String) -> Result<(), Failed> {
    if holds { Ok(()) } else { Err(message().into()) }
}

/// A scene as it is laid on the picture, with the night that is in it.
pub fn laid(scene: &Scene) -> Result<(FramePlan, Ledger, Setting, Night), Failed> {
    let catalogs = Catalogs::locate(None)?;
    let setting = scene.setting()?;
    let sky = SkyState::at(
        &Ephemeris::load(&catalogs, setting.tolerance)?,
        &setting.instant,
        &setting.place,
        setting.tolerance,
    )?;
    let night = Night::of(sky, catalogs.stars()?, &scene.air);
    let (plan, ledger) = lay(&setting, &scene.layers, &night, &catalogs)?;
    Ok((plan, ledger, setting, night))
}

/// A scene, drawn, with the night that is in it.
pub fn drawn(renderer: &Renderer, scene: &Scene) -> Result<(HdrFrame, Setting, Night), Failed> {
    let (plan, _, setting, night) = laid(scene)?;
    Ok((renderer.frame(&plan)?.frame, setting, night))
}

/// All the light of a frame, lux on a plane that faces each pixel.
pub fn illuminance(frame: &HdrFrame, camera: &Camera) -> Xyzv {
    let mut sum = Xyzv::BLACK;
    for y in 0..frame.height_px() {
        for x in 0..frame.width_px() {
            let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            sum += frame.xyzv(x, y) * camera.pixel_solid_angle_sr(pixel);
        }
    }
    sum
}

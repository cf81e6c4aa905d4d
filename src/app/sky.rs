//! The sky of the window: one thread lays it, the latest wish first, while the window shows the picture
//! before. The window draws what is laid by itself: a device that two threads draw on cannot change the
//! size of its window.

use std::cell::RefCell;
use std::sync::Arc;
use std::time::Instant as Stopwatch;

use eframe::wgpu::TextureView;

use crate::background::Background;
use crate::catalog::Catalogs;
use crate::frame::{Apparent, Dir};
use crate::light::night::Night;
use crate::plan::FramePlan;
use crate::plan::ledger::Ledger;
use crate::render::gpu::PassTime;
use crate::render::picture::Depth;
use crate::render::{Look, Made, Renderer, Viewer};
use crate::scene::{Scene, Setting};
use crate::sky::Target;
use crate::store::Store;
use crate::studio::Studio;
use crate::units::{Angle, DAY_S};

use super::pointing;
use super::view::Mount;

/// The sky turns by so much in a second.
const TURN_ARCSEC_S: f64 = 15.041_07;
/// What moves by less than this share of a pixel does not need a new picture.
const UNSEEN_PX: f64 = 0.25;

/// A wish for a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyRequest {
    pub scene: Scene,
    /// What stays in the middle, in place of the direction of the scene.
    pub follow: Option<Target>,
    /// What is upright then.
    pub mount: Mount,
}

/// A sky that is laid.
pub struct Laid {
    /// With the camera that is to take it.
    pub setting: Setting,
    pub night: Arc<Night>,
    pub plan: Arc<FramePlan>,
    pub ledger: Arc<Ledger>,
    pub cost: Cost,
}

/// A picture, and all that is known of what is on it.
pub struct Shown {
    /// What was wished for.
    pub request: SkyRequest,
    /// With the camera that took it.
    pub setting: Setting,
    pub night: Arc<Night>,
    /// What was drawn; without a device it is all there is.
    pub plan: Arc<FramePlan>,
    pub ledger: Arc<Ledger>,
    /// On the device; none without one.
    pub codes: Option<TextureView>,
    pub made: Option<Made>,
    /// Of the GPU, by pass.
    pub passes: Vec<PassTime>,
    pub cost: Cost,
}

/// Milliseconds of the threads that make a picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cost {
    /// Where everything stands.
    pub night_ms: f64,
    /// What is drawn of it.
    pub lay_ms: f64,
    /// Until the picture is on the device.
    pub draw_ms: f64,
}

impl Cost {
    pub fn all_ms(&self) -> f64 {
        self.night_ms + self.lay_ms + self.draw_ms
    }
}

/// What became of a wish.
pub type Answer = Result<Laid, String>;

/// Lays skies beside the window.
pub struct Sky {
    background: Background<SkyRequest, Answer>,
    asked: Option<SkyRequest>,
}

impl SkyRequest {
    /// Whether another wish asks for a picture that a person could tell from this one.
    pub fn differs(&self, other: &SkyRequest, shown: &Setting, wished: &Setting) -> bool {
        let at = |request: &SkyRequest, utc: &str| SkyRequest {
            scene: Scene { utc: utc.to_owned(), ..request.scene.clone() },
            ..request.clone()
        };
        if *self == *other {
            return false;
        }
        let utc = &self.scene.utc;
        // What follows turns its camera by itself.
        if at(self, utc) != at(other, utc) {
            return true;
        }
        let passed_s = (wished.instant.tt.jd() - shown.instant.tt.jd()).abs() * DAY_S;
        let moved = Angle::from_arcsec(passed_s * TURN_ARCSEC_S);
        moved > wished.camera.pixel_angle() * UNSEEN_PX
    }
}

impl Sky {
    /// Starts the thread. `wake` is called from it when a sky is ready.
    pub fn new(catalogs: Catalogs, store: Store, wake: impl Fn() + Send + 'static) -> Sky {
        let layer = RefCell::new(Layer { catalogs, store: Some(store), studio: None });
        let background = Background::new(move |request: &SkyRequest, _| {
            let answer = layer.borrow_mut().lay(request);
            wake();
            Some(answer)
        });
        Sky { background, asked: None }
    }

    /// The last sky, with its wish.
    pub fn latest(&self) -> Option<Arc<(SkyRequest, Answer)>> {
        self.background.latest()
    }

    /// Wishes for a sky. One that is being laid is finished first.
    pub fn ask(&mut self, request: SkyRequest) {
        if self.asked.as_ref() == Some(&request) || self.background.is_working() {
            return;
        }
        self.background.ask(request.clone());
        self.asked = Some(request);
    }

    pub fn is_working(&self) -> bool {
        self.background.is_working()
    }

    /// Waits for the sky that is being laid.
    pub fn wait(&self) {
        self.background.wait();
    }
}

/// What the thread has.
struct Layer {
    catalogs: Catalogs,
    /// Until it is used.
    store: Option<Store>,
    studio: Option<Studio>,
}

impl Layer {
    fn lay(&mut self, request: &SkyRequest) -> Answer {
        let words = |error: &dyn std::error::Error| error.to_string();
        let studio = match &mut self.studio {
            Some(studio) => studio,
            None => {
                let store = self.store.take().unwrap_or(Store::NONE);
                let studio = Studio::open(&self.catalogs, store).map_err(|e| words(&e))?;
                self.studio.insert(studio)
            }
        };
        let mut watch = Stopwatch::now();
        let mut lap = || {
            let ms = watch.elapsed().as_secs_f64() * 1e3;
            watch = Stopwatch::now();
            ms
        };
        let scene = &request.scene;
        let mut setting = scene.setting().map_err(|e| words(&e))?;
        let night = studio.night(scene, &setting).map_err(|e| words(&e))?;
        if let Some(target) = &request.follow {
            let towards: Option<Dir<Apparent>> = pointing::towards(target, &night);
            if let Some(dir) = towards {
                let pose = request.mount.pose(dir, setting.place.latitude);
                let camera = &mut setting.camera;
                (camera.azimuth, camera.altitude, camera.roll) =
                    (pose.azimuth, pose.altitude, pose.roll);
            }
        }
        let night_ms = lap();
        let (plan, ledger) = studio.lay(scene, &setting, &night).map_err(|e| words(&e))?;
        let cost = Cost { night_ms, lay_ms: lap(), draw_ms: 0.0 };
        let (night, plan, ledger) = (Arc::new(night), Arc::new(plan), Arc::new(ledger));
        Ok(Laid { setting, night, plan, ledger, cost })
    }
}

impl Laid {
    /// Draws it for the screen, if there is something to draw with.
    pub fn shown(
        &self,
        request: &SkyRequest,
        renderer: Option<&Renderer>,
    ) -> Result<Shown, String> {
        let mut shown = Shown {
            request: request.clone(),
            setting: self.setting.clone(),
            night: Arc::clone(&self.night),
            plan: Arc::clone(&self.plan),
            ledger: Arc::clone(&self.ledger),
            codes: None,
            made: None,
            passes: Vec::new(),
            cost: self.cost,
        };
        let Some(renderer) = renderer else { return Ok(shown) };
        let watch = Stopwatch::now();
        let Scene { eye, photo, display, .. } = &request.scene;
        let viewer = photo.as_ref().map_or(Viewer::Eye(eye), Viewer::Photo);
        let look = Look { viewer, display, depth: Depth::Codes };
        let drawn = renderer.show(&self.plan, &look).map_err(|error| error.to_string())?;
        (shown.codes, shown.made) = (Some(drawn.codes), Some(drawn.made));
        shown.passes = drawn.times;
        shown.cost.draw_ms = watch.elapsed().as_secs_f64() * 1e3;
        Ok(shown)
    }
}

/// Seconds of the viewer after which a sky of a speed needs a new picture.
pub fn still_s(speed: f64, pixel_arcsec: f64) -> f64 {
    let moves_arcsec_s = TURN_ARCSEC_S * speed.abs();
    UNSEEN_PX * pixel_arcsec / moves_arcsec_s.max(1e-9)
}

//! The window: a sky to live in. It edits a [`Model`](model::Model), has its scene drawn beside it
//! ([`sky`]), lays lines and words over the picture ([`overlays`]) and panels over those ([`panels`]).
//!
//! Nothing is drawn twice that did not change: a still sky costs nothing.

pub mod action;
pub mod clock;
pub mod data;
pub mod errands;
pub mod keys;
pub mod knowledge;
pub mod local_clock;
pub mod model;
pub mod overlays;
pub mod panels;
pub mod pointing;
pub mod sky;
pub mod state;
pub mod view;

mod canvas;
mod frame_log;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant as Stopwatch};

use eframe::egui;
use eframe::egui_wgpu::{RenderState, WgpuSetup, WgpuSetupExisting};
use thiserror::Error;

use crate::camera::Camera;
use crate::catalog::Catalogs;
use crate::frame::Dir;
use crate::render::Renderer;
use crate::render::gpu::GpuError;
use crate::scene::{Scene, SceneError, ScenePlace, Setting};
use crate::store::Store;
use crate::time::{self, TimeError};

use action::{Action, Errand};
use canvas::Canvas;
use clock::Clock;
use data::Data;
use errands::Errands;
use frame_log::FrameLog;
use keys::Group;
use local_clock::LocalClock;
use model::Model;
use panels::{Desk, Panels};
use sky::{Answer, Shown, Sky, SkyRequest};
use state::StateFile;

/// Longer pauses between two frames do not count for the clock, seconds.
const LONGEST_PAUSE_S: f64 = 2.0;
/// The clock on the screen shows seconds.
const CLOCK_S: f64 = 1.0;

/// How the window begins.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// What it opens on; else what it was closed on.
    pub scene: Option<Scene>,
    /// Where it is looked from, in place of that.
    pub place: Option<ScenePlace>,
    /// When, as it is typed: by the clocks of the place, if it has no offset.
    pub at: Option<String>,
    /// Size in points.
    pub size: Option<[u32; 2]>,
    pub full_screen: bool,
    /// Gets a line for each frame that was presented.
    pub frame_log: Option<PathBuf>,
    /// Draws frame after frame, also when nothing changes.
    pub continuous: bool,
    /// Where the state is kept; none for nowhere.
    pub state: Option<PathBuf>,
}

/// Why there is no window.
#[derive(Debug, Error)]
pub enum AppError {
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Time(#[from] TimeError),
    #[error("{path}: {source}; choose another file for --frame-log")]
    FrameLog { path: PathBuf, source: std::io::Error },
    #[error(
        "no window could be opened: {0}; start it in a desktop session, or use `nocturne render` without one"
    )]
    Window(String),
}

/// The program in its window.
pub struct App {
    model: Model,
    options: Options,
    state: StateFile,
    data: Data,
    renderer: Option<Arc<Renderer>>,
    sky: Sky,
    /// The last picture that came out well.
    shown: Option<Arc<Shown>>,
    /// The last sky that was drawn, or could not be.
    taken: Option<Arc<(SkyRequest, Answer)>>,
    /// What went wrong with the last wish.
    failure: Option<String>,
    canvas: Canvas,
    panels: Panels,
    keys: Vec<Group>,
    errands: Errands,
    frame_log: Option<FrameLog>,
    /// How many were drawn so far.
    pictures: u64,
    last_frame: Stopwatch,
}

/// Opens the window, and returns when it is closed.
pub fn run(options: Options, catalogs: Catalogs) -> Result<(), AppError> {
    if !has_desktop() {
        return Err(AppError::Window("no display is known here".to_owned()));
    }
    let renderer = Arc::new(Renderer::new()?);
    let frame_log = options.frame_log.as_deref().map(FrameLog::create).transpose()?;
    let gpu = renderer.gpu();
    let setup = WgpuSetupExisting {
        instance: gpu.instance.clone(),
        adapter: gpu.adapter.clone(),
        device: gpu.device.clone(),
        queue: gpu.queue.clone(),
    };
    let size = options.size.unwrap_or([1280, 720]).map(|edge| edge as f32);
    let mut native = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Nocturne")
            .with_app_id("nocturne")
            .with_inner_size(size)
            .with_min_inner_size([320.0, 240.0])
            .with_fullscreen(options.full_screen),
        renderer: eframe::Renderer::Wgpu,
        // The picture is dithered as it is made.
        dithering: false,
        ..Default::default()
    };
    native.wgpu_options.wgpu_setup = WgpuSetup::Existing(setup);
    let state = StateFile::at(options.state.clone());
    let (mut model, notice) = match &options.scene {
        Some(scene) => (Model::of_scene(scene)?, None),
        None => state.load(&catalogs),
    };
    if let Some(place) = &options.place {
        model.place = place.clone();
    }
    if let Some(at) = &options.at {
        let instant = LocalClock::of(&model.place).instant_of(&time::parse(at)?)?;
        model.clock = Clock::at(instant);
    }
    eframe::run_native(
        "nocturne",
        native,
        Box::new(move |creation| {
            let ctx = creation.egui_ctx.clone();
            let mut app = App::new(&ctx, options, model, state, catalogs, Some(renderer));
            app.frame_log = frame_log;
            app.panels.notice = notice;
            Ok(Box::new(app))
        }),
    )
    .map_err(|error| AppError::Window(error.to_string()))
}

impl App {
    /// The program on a context; without a renderer there are lines and words alone.
    pub fn new(
        ctx: &egui::Context,
        options: Options,
        model: Model,
        state: StateFile,
        catalogs: Catalogs,
        renderer: Option<Arc<Renderer>>,
    ) -> App {
        ctx.options_mut(|options| options.zoom_with_keyboard = false);
        // Whatever is typed is no reason to stop.
        ctx.set_missing_glyph_policy(egui::epaint::text::MissingGlyphPolicy::Tofu);
        let mut panels = Panels::default();
        panels.dress(ctx, &model);
        panels.inspector.adapter = renderer.as_ref().map(|renderer| renderer.adapter());
        let wake = {
            let ctx = ctx.clone();
            move || ctx.request_repaint()
        };
        App {
            sky: Sky::new(catalogs.clone(), Store::of_user(), wake),
            renderer,
            data: Data::new(catalogs),
            model,
            options,
            state,
            shown: None,
            taken: None,
            failure: None,
            canvas: Canvas::default(),
            panels,
            keys: keys::groups(),
            errands: Errands::default(),
            frame_log: None,
            pictures: 0,
            last_frame: Stopwatch::now(),
        }
    }

    /// All that the user has set.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The same, for tests to set.
    pub fn model_mut(&mut self) -> &mut Model {
        &mut self.model
    }

    /// The picture that is seen.
    pub fn shown(&self) -> Option<&Shown> {
        self.shown.as_deref()
    }

    /// How many pictures were made so far.
    pub fn pictures(&self) -> u64 {
        self.pictures
    }

    /// Lines and words over it.
    pub fn overlays(&self) -> &overlays::Overlays {
        self.canvas.overlays()
    }

    /// Waits for the picture that is being made.
    pub fn wait(&self) {
        self.sky.wait();
    }

    /// One frame.
    pub fn draw(&mut self, ui: &mut egui::Ui, window: Option<&RenderState>) {
        if let Some(log) = &mut self.frame_log {
            log.note(self.pictures);
        }
        let passed_s = self.last_frame.elapsed().as_secs_f64().min(LONGEST_PAUSE_S);
        self.last_frame = Stopwatch::now();
        self.model.advance(passed_s);
        self.take_picture(window);

        let mut actions = keys::pressed(ui.ctx(), &self.keys);
        let shown = self.shown.clone();
        let mut desk = Desk {
            model: &mut self.model,
            shown: shown.as_deref(),
            data: &self.data,
            keys: &self.keys,
            errands: &self.errands,
            failure: self.failure.as_deref(),
            actions: &mut actions,
        };
        self.panels.bar(ui, &mut desk);
        let room = ui.available_rect_before_wrap();
        let size_px = self.canvas.show(ui, &mut desk, self.renderer.as_deref());
        self.panels.windows(ui, room, &mut desk);

        for action in actions {
            self.act(ui.ctx(), action);
        }
        self.panels.dress(ui.ctx(), &self.model);
        self.errands.go_on(ui.ctx(), &mut self.model, &self.data, shown.as_deref());
        self.ask(size_px);
        self.keep_state(ui.ctx());
        self.sleep(ui.ctx());
    }

    /// Has what was changed kept, now and then.
    fn keep_state(&mut self, ctx: &egui::Context) {
        let (again, words) = self.state.keep(&self.model);
        if let Some(pause) = again {
            ctx.request_repaint_after(pause);
        }
        if words.is_some() {
            self.panels.notice = words;
        }
    }

    /// Does what was asked for.
    pub fn act(&mut self, ctx: &egui::Context, action: Action) {
        let Some(errand) = self.model.apply(action) else { return };
        match errand {
            Errand::ToggleFullScreen => {
                let is_full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
                ctx.send_viewport_cmd(egui::ViewportCommand::Fullscreen(!is_full));
            }
            Errand::Measure(dir) => self.panels.info.measure(dir),
            Errand::Quit => ctx.send_viewport_cmd(egui::ViewportCommand::Close),
            other => self.errands.begin(ctx, other, &self.model, &self.data, self.canvas.size_px()),
        }
    }

    /// Draws the newest sky, if there is one.
    fn take_picture(&mut self, window: Option<&RenderState>) {
        let Some(newest) = self.sky.latest() else { return };
        if self.taken.as_ref().is_some_and(|taken| Arc::ptr_eq(taken, &newest)) {
            return;
        }
        let (request, laid) = &*newest;
        let renderer = self.renderer.as_deref();
        let shown = match laid {
            Ok(laid) => laid.shown(request, renderer),
            Err(words) => Err(words.clone()),
        };
        match shown {
            Ok(shown) => {
                self.failure = None;
                self.pictures += 1;
                self.canvas.take(&shown, renderer, window);
                if request.follow.is_some() && request.follow == self.model.view.follow {
                    let Camera { azimuth, altitude, .. } = shown.setting.camera;
                    let dir = Dir::from_azimuth_altitude(azimuth, altitude);
                    self.model.view.set(dir, shown.setting.place.latitude);
                }
                self.shown = Some(Arc::new(shown));
            }
            Err(words) => self.failure = Some(words),
        }
        self.taken = Some(newest);
    }

    /// Wishes for a picture, if another would look different.
    fn ask(&mut self, size_px: [u32; 2]) {
        if size_px.contains(&0) {
            return;
        }
        let wish = self.model.request(size_px);
        let differs = match (self.shown.as_deref(), wish.scene.setting()) {
            (Some(shown), Ok(setting)) => shown.request.differs(&wish, &shown.setting, &setting),
            _ => true,
        };
        if differs {
            self.sky.ask(wish);
        }
    }

    /// Says when the next frame is due.
    fn sleep(&self, ctx: &egui::Context) {
        if self.options.continuous || self.model.view.is_moving() {
            return ctx.request_repaint();
        }
        let Model { clock, .. } = &self.model;
        if clock.runs() && !self.sky.is_working() {
            let pixel = self.shown().map(|shown: &Shown| pixel_arcsec(&shown.setting));
            let still_s = sky::still_s(clock.speed(), pixel.unwrap_or(1.0));
            ctx.request_repaint_after(Duration::from_secs_f64(still_s.min(CLOCK_S)));
        }
    }
}

/// Whether there is somebody to open a window for, as far as one can tell beforehand.
fn has_desktop() -> bool {
    let is_named = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux")
        || ["WAYLAND_DISPLAY", "WAYLAND_SOCKET", "DISPLAY"].iter().any(is_named)
}

fn pixel_arcsec(setting: &Setting) -> f64 {
    setting.camera.pixel_angle().arcsec()
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        self.draw(ui, frame.wgpu_render_state());
    }

    fn on_exit(&mut self) {
        if let Err(words) = self.state.save(&self.model) {
            // There is no window left to say it in.
            eprintln!("nocturne: {words}");
        }
    }

    fn clear_color(&self, _: &egui::Visuals) -> [f32; 4] {
        [0.0, 0.0, 0.0, 1.0]
    }
}

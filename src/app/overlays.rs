//! Lines and words over the sky, drawn for the window, never into the picture.
//!
//! They are laid by the camera and the sky of the picture that is seen, and kept while both stay the same:
//! a still sky lays nothing anew.

pub mod axes;
pub mod curve;
pub mod ink;
pub mod labels;
pub mod selection;

mod constellations;
mod deep_sky;
mod great_circles;
mod grid;
mod horizon;
mod names;
mod trails;

use std::collections::HashMap;
use std::f64::consts::PI;
use std::hash::Hash;
use std::sync::Arc;
use std::time::Instant as Stopwatch;

use eframe::egui::epaint::{Mesh, TextShape};
use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Shape, Vec2};

use crate::eye::limiting_magnitude::{TYPICAL_FIELD_FACTOR, limiting_magnitude};
use crate::frame::{Apparent, Dir, Horizon};
use crate::light::night::Night;
use crate::render::Made;
use crate::scene::Layers;
use crate::sky::Target;
use crate::sky::star_index::StarIndex;

use super::canvas::Frame;
use super::model;
use super::panels::Desk;
use super::sky::Shown;

use curve::{Curve, Line, Picture, crossings};
use ink::{Ink, Pen, shade};
use labels::{Label, Memory, Placed};
use trails::{Trail, Trails};

/// Colour of marks, sRGB: the dim red that eyes in the dark tolerate best.
pub const MARK: Color32 = Color32::from_rgb(MARK_RGB[0], MARK_RGB[1], MARK_RGB[2]);
/// The same.
const MARK_RGB: [u8; 3] = [168, 72, 48];
/// What lies around letters, so that they are read on a bright sky too.
const SHADOW: Color32 = Color32::from_black_alpha(150);
/// All that lies over the sky, as it was laid last.
#[derive(Default)]
pub struct Overlays {
    laid: Option<Laid>,
    memory: Memory,
    trails: Trails,
    galleys: Galleys,
    numbers: Option<(StarIndex, Arc<Vec<Option<usize>>>)>,
    /// How often something was laid.
    count: u64,
    cost: Cost,
}

/// Milliseconds of the thread of the window.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cost {
    /// Laying lines and words anew, when it was last done.
    pub lay_ms: f64,
    /// Handing them over in the last frame that laid nothing.
    pub draw_ms: f64,
}

/// What lines and words depend on.
#[derive(Clone)]
struct Key {
    night: Arc<Night>,
    frame: Frame,
    on: model::Overlays,
    layers: Layers,
    selected: Option<Target>,
    is_red: bool,
    pixels_per_point: f32,
    trails: Option<Arc<(trails::Wish, Vec<Trail>)>>,
    /// Letters lie elsewhere in the atlas when this is another.
    letters: Arc<Galley>,
}

impl Key {
    fn is_same(&self, other: &Key) -> bool {
        let is_same_trails = match (&self.trails, &other.trails) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        // A night belongs to one picture.
        Arc::ptr_eq(&self.night, &other.night)
            && self.frame.camera == other.frame.camera
            && self.frame.rect == other.frame.rect
            && self.on == other.on
            && self.layers == other.layers
            && self.selected == other.selected
            && self.is_red == other.is_red
            && self.pixels_per_point == other.pixels_per_point
            && is_same_trails
            && Arc::ptr_eq(&self.letters, &other.letters)
    }
}

/// Words as letters, kept over frames in which nothing is laid too.
#[derive(Default)]
struct Galleys {
    known: HashMap<labels::Id, Arc<Galley>>,
    /// What they are good for: the letters of [`Key`].
    letters: Option<Arc<Galley>>,
}

impl Galleys {
    /// No more are kept.
    const MOST: usize = 4000;

    fn prepare(&mut self, letters: &Arc<Galley>) {
        let is_same = self.letters.as_ref().is_some_and(|known| Arc::ptr_eq(known, letters));
        if !is_same || self.known.len() > Galleys::MOST {
            self.known.clear();
            self.letters = Some(Arc::clone(letters));
        }
    }

    fn of(&mut self, label: &Label, painter: &Painter) -> Arc<Galley> {
        let id = labels::id((&label.text, label.size.to_bits(), label.spacing.to_bits()));
        let made = || {
            let format = TextFormat {
                font_id: FontId::proportional(label.size),
                color: Color32::WHITE,
                extra_letter_spacing: label.spacing,
                ..TextFormat::default()
            };
            painter.layout_job(LayoutJob::single_section(label.text.clone(), format))
        };
        Arc::clone(self.known.entry(id).or_insert_with(made))
    }
}

struct Laid {
    key: Key,
    mesh: Arc<Mesh>,
    labels: Vec<Placed<Arc<Galley>>>,
}

impl Overlays {
    /// Draws all that are switched on; the lines only if they are not put on the picture itself.
    pub fn draw(
        &mut self,
        painter: &Painter,
        frame: &Frame,
        shown: &Shown,
        desk: &Desk,
        with_lines: bool,
    ) {
        let began = Stopwatch::now();
        let model = &*desk.model;
        let wish =
            || trails::wish(model.selected.as_ref(), &shown.setting.instant, &shown.setting.place);
        let trails = match model.overlays.planet_trails {
            true => self.trails.of(painter.ctx(), &desk.data.catalogs, wish()),
            false => None,
        };
        let key = Key {
            night: Arc::clone(&shown.night),
            frame: *frame,
            on: model.overlays,
            layers: model.layers.clone(),
            selected: model.selected.clone(),
            is_red: model.display.red,
            pixels_per_point: painter.pixels_per_point(),
            trails,
            letters: painter.layout_no_wrap(
                "N".to_owned(),
                FontId::proportional(12.0),
                Color32::WHITE,
            ),
        };
        let differs = self.laid.as_ref().is_none_or(|laid| !laid.key.is_same(&key));
        if differs {
            self.laid = Some(self.lay(key, painter, faintest_seen(shown)));
            self.count += 1;
        }
        let Some(laid) = &self.laid else { return };
        if with_lines && !laid.mesh.is_empty() {
            painter.add(Shape::Mesh(Arc::clone(&laid.mesh)));
        }
        let is_red = laid.key.is_red;
        painter.extend(laid.labels.iter().flat_map(|Placed { label, rect, galley }| {
            let text = |moved: Vec2, colour: Color32| {
                let shape = TextShape::new(rect.min + moved, Arc::clone(galley), colour);
                Shape::Text(shape.with_override_text_color(colour))
            };
            let colour = shade(label.colour, label.opacity, is_red);
            [text(Vec2::splat(1.0), SHADOW), text(Vec2::ZERO, colour)]
        }));
        selection::draw(painter, frame, shown, desk);
        let passed_ms = began.elapsed().as_secs_f64() * 1e3;
        match differs {
            true => self.cost.lay_ms = passed_ms,
            false => self.cost.draw_ms = passed_ms,
        }
    }

    /// The words that are laid, and where.
    pub fn labels(&self) -> impl Iterator<Item = (&Label, Rect)> {
        let laid = self.laid.iter().flat_map(|laid| &laid.labels);
        laid.map(|placed| (&placed.label, placed.rect))
    }

    /// The lines, as triangles in points of the window.
    pub fn lines(&self) -> Option<&Arc<Mesh>> {
        self.laid.as_ref().map(|laid| &laid.mesh).filter(|mesh| !mesh.is_empty())
    }

    /// How many corners the lines have.
    pub fn corners(&self) -> usize {
        self.laid.as_ref().map_or(0, |laid| laid.mesh.vertices.len())
    }

    /// How often lines and words were laid anew.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// What lines and words cost.
    pub fn cost(&self) -> Cost {
        self.cost
    }

    /// Waits for trails that are being made.
    pub fn wait(&self) {
        self.trails.wait();
    }

    fn lay(&mut self, key: Key, painter: &Painter, faintest_seen: f64) -> Laid {
        let ink = Ink::new(key.pixels_per_point, key.is_red);
        let mut sketch = Sketch::new(&key.night, &key.frame, key.on, &key.layers, ink);
        sketch.selected = key.selected.as_ref();
        sketch.faintest_seen = faintest_seen;
        if key.on.constellation_lines {
            sketch.numbers = Some(self.numbers_of(&key.night.stars));
        }
        let trails = key.trails.as_ref().map_or(&[][..], |trails| &trails.1);
        sketch.draw(trails);
        let Sketch { ink, labels, .. } = sketch;
        self.galleys.prepare(&key.letters);
        let galleys = &mut self.galleys;
        let measure = |label: &Label| {
            let galley = galleys.of(label, painter);
            (galley.size(), galley)
        };
        let labels = labels::place(labels, key.frame.rect, &mut self.memory, measure);
        Laid { key, mesh: Arc::new(ink.mesh), labels }
    }

    /// Places of stars in the catalogue by their HR numbers.
    fn numbers_of(&mut self, stars: &StarIndex) -> Arc<Vec<Option<usize>>> {
        match &self.numbers {
            Some((known, numbers)) if known.is_same(stars) => Arc::clone(numbers),
            _ => {
                let most = stars.iter().map(|star| usize::from(star.hr)).max().unwrap_or(0);
                let mut numbers = vec![None; most + 1];
                for (number, star) in stars.iter().enumerate() {
                    numbers[usize::from(star.hr)] = Some(number);
                }
                let numbers = Arc::new(numbers);
                self.numbers = Some((stars.clone(), Arc::clone(&numbers)));
                numbers
            }
        }
    }
}

/// The faintest star that the eye of the picture sees; without one there is no limit.
fn faintest_seen(shown: &Shown) -> f64 {
    match &shown.made {
        Some(Made::Seen(seeing)) => {
            limiting_magnitude(seeing.adaptation_cd_m2, TYPICAL_FIELD_FACTOR)
        }
        _ => f64::INFINITY,
    }
}

/// What is being laid.
pub struct Sketch<'a> {
    night: &'a Night,
    frame: &'a Frame,
    picture: Picture,
    on: model::Overlays,
    layers: &'a Layers,
    selected: Option<&'a Target>,
    /// Johnson V.
    faintest_seen: f64,
    numbers: Option<Arc<Vec<Option<usize>>>>,
    ink: Ink,
    labels: Vec<Label>,
}

impl<'a> Sketch<'a> {
    /// An empty one, of a picture of a night.
    pub fn new(
        night: &'a Night,
        frame: &'a Frame,
        on: model::Overlays,
        layers: &'a Layers,
        ink: Ink,
    ) -> Sketch<'a> {
        let ground = layers.ground.then_some(night.horizon);
        Sketch {
            night,
            frame,
            picture: Picture::new(frame.camera, ground),
            on,
            layers,
            selected: None,
            faintest_seen: f64::INFINITY,
            numbers: None,
            ink,
            labels: Vec::new(),
        }
    }

    /// Draws all that is switched on.
    pub fn draw(&mut self, trails: &[Trail]) {
        grid::draw(self);
        great_circles::draw(self);
        constellations::draw(self);
        horizon::draw(self);
        deep_sky::draw(self);
        trails::draw(self, trails);
        names::draw(self);
    }

    fn is_selected(&self, target: &Target) -> bool {
        self.selected == Some(target)
    }

    /// The place of a star in the catalogue.
    fn number_of(&self, hr: u16) -> Option<usize> {
        *self.numbers.as_ref()?.get(usize::from(hr))?
    }

    fn field_deg(&self) -> f64 {
        self.frame.camera.field_of_view.deg()
    }

    /// Angle across the shorter side, radians.
    fn span_rad(&self) -> f64 {
        let camera = &self.frame.camera;
        let aspect = f64::from(camera.height_px) / f64::from(camera.width_px.max(1));
        (camera.field_of_view.rad() * aspect.min(1.0)).min(PI)
    }

    /// Scale in the middle of the picture.
    fn points_per_rad(&self) -> f64 {
        let px_per_point =
            f64::from(self.frame.camera.width_px) / f64::from(self.frame.rect.width());
        self.frame.camera.focal_px() / px_per_point.max(1e-6)
    }

    /// Through the air.
    fn seen(&self, dir: Dir<Horizon>) -> Dir<Apparent> {
        self.night.refraction.apparent_from_horizon(dir)
    }

    /// Where a direction is on the window, if it is on the picture and not below the ground.
    fn point(&self, dir: Dir<Apparent>) -> Option<Pos2> {
        Some(self.frame.point(self.picture.pixel(dir)?))
    }

    fn points(&self, line: &Line) -> Vec<Pos2> {
        line.iter().map(|&pixel| self.frame.point(pixel)).collect()
    }

    /// Draws a curve, and gives back its lines, pixels.
    fn curve<F: Fn(f64) -> Dir<Apparent>>(&mut self, curve: &Curve<F>, pen: &Pen) -> Vec<Line> {
        let lines = self.picture.trace(curve);
        for line in &lines {
            self.ink.line(&self.points(line), pen);
        }
        lines
    }

    /// Draws great circles from corner to corner.
    /// `free` of each corner, points, is left to the star that stands there.
    fn path(&mut self, corners: &[Dir<Horizon>], free: f64, pen: &Pen) {
        /// How far the air lifts what stands low, with room, radians.
        const LIFTED_RAD: f64 = 0.02;
        /// Of a short side this part at each end is left free at most.
        const MOST_FREE: f64 = 0.25;
        let mut whole: Line = Vec::new();
        for pair in corners.windows(2) {
            let [a, b] = [pair[0].vector(), pair[1].vector()];
            let along = pair[0].separation(pair[1]).rad();
            let middle: Dir<Apparent> = Dir::from_vector(a + b);
            if along == 0.0 || !self.picture.may_hold(middle, 0.5 * along + LIFTED_RAD) {
                continue;
            }
            let side = (b - a * a.dot(b)).normalize();
            let at = |angle: f64| {
                let dir: Dir<Horizon> = Dir::from_vector(a * angle.cos() + side * angle.sin());
                self.night.refraction.apparent_from_horizon(dir)
            };
            let free_rad = (free / self.points_per_rad()).min(MOST_FREE * along);
            let curve = Curve { at, from: free_rad, to: along - free_rad, rate_rad: 1.0 };
            for line in self.picture.trace(&curve) {
                let joins = whole.last().zip(line.first()).is_some_and(|(end, start)| {
                    (end[0] - start[0]).hypot(end[1] - start[1]) < 0.01
                });
                if !joins {
                    self.ink.line(&self.points(&whole), pen);
                    whole.clear();
                }
                whole.extend(&line[usize::from(joins)..]);
            }
        }
        self.ink.line(&self.points(&whole), pen);
    }

    /// Writes where lines leave the picture what they are; those that do not, on the longest.
    fn name_at_edges(
        &mut self,
        lines: &[Line],
        words: &str,
        name: impl Hash,
        pen: &Pen,
        rank: f32,
    ) {
        const LEFT: &[Align2] = &[Align2::LEFT_BOTTOM, Align2::LEFT_TOP];
        const RIGHT: &[Align2] = &[Align2::RIGHT_BOTTOM, Align2::RIGHT_TOP];
        const TOP: &[Align2] = &[Align2::LEFT_TOP, Align2::RIGHT_TOP];
        const BOTTOM: &[Align2] = &[Align2::LEFT_BOTTOM, Align2::RIGHT_BOTTOM];
        let camera = &self.frame.camera;
        let size = [camera.width_px, camera.height_px].map(f64::from);
        let inner = self.frame.rect.shrink(1.0);
        let name = labels::id((name, "edge"));
        let mut is_named = [false; 4];
        let mut found = Vec::new();
        for [x, y] in lines.iter().flat_map(|line| crossings(line, [0.0; 2], size)) {
            let away = [x, size[0] - x, y, size[1] - y];
            let edge = (0..4).min_by(|&a, &b| away[a].total_cmp(&away[b])).unwrap_or(0);
            // Two names are enough.
            if !is_named[edge] && found.len() < 2 {
                is_named[edge] = true;
                found.push((edge, self.frame.point([x, y]), [LEFT, RIGHT, TOP, BOTTOM][edge]));
            }
        }
        if found.is_empty()
            && let Some(line) = lines.iter().max_by_key(|line| line.len())
        {
            found.push((4, self.frame.point(line[line.len() / 2]), LEFT));
        }
        for (edge, at, places) in found {
            self.labels.push(Label {
                id: labels::id((name, edge)),
                text: words.to_owned(),
                at: inner.clamp(at),
                gap: 3.0,
                places,
                size: 10.5,
                spacing: 0.0,
                colour: pen.colour,
                opacity: 0.9,
                rank,
            });
        }
    }
}

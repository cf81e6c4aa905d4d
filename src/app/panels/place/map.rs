//! A small map of the world: the towns are dots, the night is dark, and a click goes there.

use eframe::egui::{
    self, Color32, ColorImage, Pos2, Rect, Sense, Stroke, TextureHandle, TextureOptions, Ui, Vec2,
    pos2, vec2,
};

use crate::frame::{Dir, Horizon};
use crate::place::Place;
use crate::place::gazetteer::Gazetteer;
use crate::scene::ScenePlace;
use crate::units::Angle;

/// Points: half a degree longitude to a point or so.
pub const SIZE: Vec2 = vec2(480.0, 240.0);
/// Texels of the towns.
const TOWNS_PX: [usize; 2] = [960, 480];
/// Texels of the shade of the night.
const SHADE_PX: [usize; 2] = [120, 60];
const SEA: Color32 = Color32::from_rgb(14, 18, 26);
const LINE: Color32 = Color32::from_rgba_premultiplied(26, 30, 38, 60);
/// The shade is laid anew when the Sun has moved by this much.
const SHADE_STEP_DEG: f64 = 0.5;
/// The Sun so low leaves no light.
const DARK_DEG: f64 = -18.0;
/// Alpha of the darkest shade.
const DARKEST: f64 = 150.0;

/// The map, with what was drawn of it.
#[derive(Default)]
pub struct Map {
    towns: Option<TextureHandle>,
    shade: Option<(TextureHandle, [f64; 2])>,
}

impl Map {
    /// Shows it, with the place that is looked from; gives longitude and latitude, degrees, of a click.
    /// `sun` is where the Sun is seen, and from where.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        towns: Option<&Gazetteer>,
        here: &ScenePlace,
        sun: Option<(&Place, Dir<Horizon>)>,
    ) -> Option<[f64; 2]> {
        let (rect, response) = ui.allocate_exact_size(SIZE, Sense::click());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Button, true, "World map: click to go there")
        });
        let painter = ui.painter_at(rect);
        painter.rect_filled(rect, 0.0, SEA);
        if self.towns.is_none() {
            self.towns = towns.map(|towns| {
                let image = dots(towns);
                ui.ctx().load_texture("towns", image, TextureOptions::LINEAR)
            });
        }
        let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        if let Some(towns) = &self.towns {
            painter.image(towns.id(), rect, whole, Color32::WHITE);
        }
        if let Some((place, dir)) = sun {
            let shade = self.shade(ui.ctx(), overhead(place, dir));
            painter.image(shade, rect, whole, Color32::WHITE);
        }
        for longitude_deg in (-150..=150).step_by(30) {
            painter.vline(
                point(rect, f64::from(longitude_deg), 0.0).x,
                rect.y_range(),
                (1.0, LINE),
            );
        }
        for latitude_deg in (-60..=60).step_by(30) {
            painter.hline(rect.x_range(), point(rect, 0.0, f64::from(latitude_deg)).y, (1.0, LINE));
        }
        let mark = point(rect, here.longitude_deg, here.latitude_deg);
        let stroke = Stroke::new(1.5, Color32::WHITE);
        painter.circle_stroke(mark, 5.0, stroke);
        painter.line_segment([mark - vec2(9.0, 0.0), mark + vec2(9.0, 0.0)], stroke);
        painter.line_segment([mark - vec2(0.0, 9.0), mark + vec2(0.0, 9.0)], stroke);
        if response.has_focus() {
            painter.rect_stroke(rect, 0.0, (2.0, Color32::WHITE), egui::StrokeKind::Inside);
        }
        let clicked = response.clicked().then(|| response.interact_pointer_pos()).flatten()?;
        let from = (clicked - rect.min) / rect.size();
        let longitude_deg = f64::from(from.x) * 360.0 - 180.0;
        let latitude_deg = 90.0 - f64::from(from.y) * 180.0;
        Some([longitude_deg.clamp(-180.0, 179.999), latitude_deg.clamp(-90.0, 90.0)])
    }

    fn shade(&mut self, ctx: &egui::Context, sun: [f64; 2]) -> egui::TextureId {
        let is_near = |[longitude, latitude]: [f64; 2]| {
            let turned = (longitude - sun[0] + 180.0).rem_euclid(360.0) - 180.0;
            turned.abs() < SHADE_STEP_DEG && (latitude - sun[1]).abs() < SHADE_STEP_DEG
        };
        match &mut self.shade {
            Some((texture, at)) if is_near(*at) => texture.id(),
            Some((texture, at)) => {
                texture.set(shaded(sun), TextureOptions::LINEAR);
                *at = sun;
                texture.id()
            }
            None => {
                let texture = ctx.load_texture("night", shaded(sun), TextureOptions::LINEAR);
                let id = texture.id();
                self.shade = Some((texture, sun));
                id
            }
        }
    }
}

fn point(rect: Rect, longitude_deg: f64, latitude_deg: f64) -> Pos2 {
    let longitude_deg = (longitude_deg + 180.0).rem_euclid(360.0);
    let share = vec2((longitude_deg / 360.0) as f32, ((90.0 - latitude_deg) / 180.0) as f32);
    rect.min + share * rect.size()
}

/// Each town a dot, the brighter the larger.
fn dots(towns: &Gazetteer) -> ColorImage {
    let [width, height] = TOWNS_PX;
    let mut image = ColorImage::filled(TOWNS_PX, Color32::TRANSPARENT);
    for city in towns.cities() {
        let x = ((city.longitude_deg + 180.0).rem_euclid(360.0) / 360.0 * width as f64) as usize;
        let y = ((90.0 - city.latitude_deg) / 180.0 * height as f64) as usize;
        let size = (city.population.max(1) as f64).log10();
        let light = (60.0 + 28.0 * size).min(255.0) as u8;
        let pixel = &mut image.pixels[y.min(height - 1) * width + x.min(width - 1)];
        *pixel = Color32::from_gray(light.max(pixel.r()));
    }
    image
}

/// Longitude and latitude, degrees, of where the Sun is overhead. Its parallax is nothing here.
fn overhead(place: &Place, dir: Dir<Horizon>) -> [f64; 2] {
    let [x, y, z] = (place.horizon_from_itrs().inverse() * dir).vector().to_array();
    [y.atan2(x).to_degrees(), z.clamp(-1.0, 1.0).asin().to_degrees()]
}

/// The shade of the night, deepest where twilight ends.
fn shaded([longitude_deg, latitude_deg]: [f64; 2]) -> ColorImage {
    let [width, height] = SHADE_PX;
    let (sin_sun, cos_sun) = Angle::from_deg(latitude_deg).sin_cos();
    let mut image = ColorImage::filled(SHADE_PX, Color32::TRANSPARENT);
    for (n, pixel) in image.pixels.iter_mut().enumerate() {
        let east_deg = ((n % width) as f64 + 0.5) * 360.0 / width as f64 - 180.0;
        let north_deg = 90.0 - ((n / width) as f64 + 0.5) * 180.0 / height as f64;
        let (sin, cos) = Angle::from_deg(north_deg).sin_cos();
        let hour_angle = Angle::from_deg(east_deg - longitude_deg);
        let sine = sin * sin_sun + cos * cos_sun * hour_angle.sin_cos().1;
        let altitude_deg = sine.clamp(-1.0, 1.0).asin().to_degrees();
        let share = (altitude_deg / DARK_DEG).clamp(0.0, 1.0);
        *pixel = Color32::from_black_alpha((share * DARKEST) as u8);
    }
    image
}

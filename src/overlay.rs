//! Marks that help to find one's way: the horizon and the cardinal points.
//!
//! They are drawn on the finished picture, never into the frame: the frame holds light alone.

use tiny_skia::{LineCap, Paint, PathBuilder, Pixmap, Stroke, Transform};

use crate::camera::Camera;
use crate::display::Display;
use crate::frame::{Apparent, Dir, WINDS};
use crate::image::{Codes, Image};
use crate::scene::Marks;
use crate::units::Angle;

/// Colour of the marks, sRGB: the dim red that eyes in the dark tolerate best.
const COLOUR: [u8; 3] = [168, 72, 48];

/// Draws marks on a picture taken by `camera`, given the apparent altitude of the horizon; on a screen
/// whose light is all red they are red too.
pub fn draw(
    wanted: Marks,
    picture: &mut Codes,
    camera: &Camera,
    horizon: Angle,
    display: &Display,
) {
    let red = display.red;
    match picture {
        Codes::Eight(picture) => {
            draw_on(wanted, picture, camera, horizon, red, |code, over, under| {
                (over + u32::from(code) * under / 255).min(255) as u8
            })
        }
        Codes::Sixteen(picture) => {
            draw_on(wanted, picture, camera, horizon, red, |code, over, under| {
                (over * 257 + u32::from(code) * under / 255).min(65_535) as u16
            })
        }
    }
}

/// Draws marks, given a code, the mark over it and how much of the code is left, both of 255.
fn draw_on<C: Copy>(
    wanted: Marks,
    picture: &mut Image<[C; 3]>,
    camera: &Camera,
    horizon: Angle,
    is_red: bool,
    laid: impl Fn(C, u32, u32) -> C,
) {
    let (width, height) = (picture.width_px(), picture.height_px());
    let Some(mut marks) = Pixmap::new(width, height) else { return };
    let size_px = (f64::from(width.min(height)) / 45.0).clamp(7.0, 48.0);
    if wanted.horizon {
        draw_horizon(&mut marks, camera, horizon, (size_px / 14.0) as f32);
    }
    if wanted.cardinal_points {
        draw_cardinal_points(&mut marks, camera, horizon, size_px);
    }
    for (pixel, mark) in picture.pixels_mut().iter_mut().zip(marks.pixels()) {
        // The marks are premultiplied with their own coverage.
        let under = 255 - u32::from(mark.alpha());
        let over = match is_red {
            true => [mark.red(), 0, 0],
            false => [mark.red(), mark.green(), mark.blue()],
        };
        for (channel, over) in pixel.iter_mut().zip(over) {
            *channel = laid(*channel, u32::from(over), under);
        }
    }
}

fn pixel_from_local(camera: &Camera, azimuth_deg: f64, altitude_deg: f64) -> Option<[f64; 2]> {
    let dir: Dir<Apparent> =
        Dir::from_azimuth_altitude(Angle::from_deg(azimuth_deg), Angle::from_deg(altitude_deg));
    camera.pixel_from_view(camera.view_from_apparent() * dir)
}

fn paint(opacity: f32) -> Paint<'static> {
    let [r, g, b] = COLOUR;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, (opacity * 255.0) as u8);
    paint
}

/// Draws lines through points in pixels; a gap ends a line and starts the next.
fn draw_lines(marks: &mut Pixmap, lines: &[Vec<[f64; 2]>], width_px: f32, opacity: f32) {
    let mut path = PathBuilder::new();
    for line in lines {
        for (index, [x, y]) in line.iter().enumerate() {
            match index {
                0 => path.move_to(*x as f32, *y as f32),
                _ => path.line_to(*x as f32, *y as f32),
            }
        }
    }
    let stroke = Stroke { width: width_px, line_cap: LineCap::Round, ..Stroke::default() };
    if let Some(path) = path.finish() {
        marks.stroke_path(&path, &paint(opacity), &stroke, Transform::identity(), None);
    }
}

fn draw_horizon(marks: &mut Pixmap, camera: &Camera, horizon: Angle, width_px: f32) {
    // Points further off the picture than this are not worth a line, and lines between points
    // further apart than this would cut across a seam of the projection.
    let reach_px = f64::from(marks.width() + marks.height());
    let steps = 1440;
    let mut lines = vec![Vec::new()];
    for step in 0..=steps {
        let azimuth_deg = 360.0 * f64::from(step) / f64::from(steps);
        let point = pixel_from_local(camera, azimuth_deg, horizon.deg());
        let point = point.filter(|[x, y]| x.abs() < 2.0 * reach_px && y.abs() < 2.0 * reach_px);
        let last: Option<[f64; 2]> = lines.last().and_then(|line| line.last().copied());
        match (point, last) {
            (Some(point), Some(last))
                if (point[0] - last[0]).hypot(point[1] - last[1]) > 0.5 * reach_px =>
            {
                lines.push(vec![point]);
            }
            (Some(point), _) => lines.last_mut().expect("never empty").push(point),
            (None, _) => lines.push(Vec::new()),
        }
    }
    draw_lines(marks, &lines, width_px, 0.7);
}

fn draw_cardinal_points(marks: &mut Pixmap, camera: &Camera, horizon: Angle, size_px: f64) {
    // Every other wind: the main ones and those half-way between.
    for (index, name) in WINDS.iter().step_by(2).enumerate() {
        let azimuth_deg = 45.0 * index as f64;
        let Some(foot) = pixel_from_local(camera, azimuth_deg, horizon.deg()) else { continue };
        if !camera.contains(foot) {
            continue;
        }
        // The letters stand on the horizon's own ground, upright along the local vertical.
        let below = camera.pixel_angle().deg() * size_px;
        let Some(down) = pixel_from_local(camera, azimuth_deg, horizon.deg() - below) else {
            continue;
        };
        let (dx, dy) = (down[0] - foot[0], down[1] - foot[1]);
        let length = dx.hypot(dy).max(1e-9);
        let (dx, dy) = (dx / length, dy / length);
        // Letters of the four main winds are larger than those between.
        let size_px = if name.len() == 1 { size_px } else { 0.7 * size_px };
        let width_px = 0.8 * size_px * name.len() as f64;
        let mut lines = vec![vec![
            [foot[0] - dx * size_px * 0.3, foot[1] - dy * size_px * 0.3],
            [foot[0] + dx * size_px * 0.3, foot[1] + dy * size_px * 0.3],
        ]];
        for (position, letter) in name.chars().enumerate() {
            for stroke in letter_strokes(letter) {
                let place = |&[u, v]: &[f64; 2]| {
                    let across = 0.8 * size_px * position as f64 + u * 0.6 * size_px
                        - width_px / 2.0
                        + 0.1 * size_px;
                    let along = size_px * (0.6 + v);
                    [foot[0] + dy * across + dx * along, foot[1] - dx * across + dy * along]
                };
                lines.push(stroke.iter().map(place).collect());
            }
        }
        draw_lines(marks, &lines, (size_px / 8.0) as f32, 1.0);
    }
}

/// Strokes of a letter in a unit box, x to the right and y down.
fn letter_strokes(letter: char) -> &'static [&'static [[f64; 2]]] {
    match letter {
        'N' => &[&[[0.0, 1.0], [0.0, 0.0], [1.0, 1.0], [1.0, 0.0]]],
        'E' => &[&[[1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [1.0, 1.0]], &[[0.0, 0.5], [0.8, 0.5]]],
        'W' => &[&[[0.0, 0.0], [0.25, 1.0], [0.5, 0.3], [0.75, 1.0], [1.0, 0.0]]],
        'S' => &[&[
            [1.0, 0.12],
            [0.75, 0.0],
            [0.25, 0.0],
            [0.0, 0.2],
            [0.1, 0.4],
            [0.9, 0.6],
            [1.0, 0.8],
            [0.75, 1.0],
            [0.25, 1.0],
            [0.0, 0.88],
        ]],
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Projection;

    #[test]
    fn marks_stand_at_the_horizon_and_nowhere_else() {
        let camera = Camera {
            projection: Projection::Equirectangular,
            field_of_view: Angle::from_deg(360.0),
            azimuth: Angle::from_deg(180.0),
            altitude: Angle::ZERO,
            roll: Angle::ZERO,
            width_px: 720,
            height_px: 360,
        };
        let mut codes = Codes::Eight(Image::filled(720, 360, [0; 3]));
        draw(Marks::default(), &mut codes, &camera, Angle::ZERO, &Display::default());
        let Codes::Eight(picture) = codes else { panic!("other codes") };
        for x in 1..719 {
            assert!(picture.at(x, 179)[0] > 0 || picture.at(x, 180)[0] > 0, "gap at {x}");
        }
        assert!((0..720).all(|x| picture.at(x, 150) == [0; 3] && picture.at(x, 230) == [0; 3]));
        // South stands in the middle, below the horizon.
        let south = (355..366).flat_map(|x| (184..194).map(move |y| (x, y)));
        assert!(south.clone().any(|(x, y)| picture.at(x, y)[0] > 100));
    }
}

//! Pens of the overlays: colours that the colour-blind tell apart, dashes, and the mesh they draw in.
//!
//! Colours are those of Okabe & Ito 2008 (recalled), told apart by dashes and weight too.

use eframe::egui::epaint::tessellator::Path;
use eframe::egui::epaint::{Mesh, PathStroke};
use eframe::egui::{Color32, Pos2, Vec2};

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// sRGB.
    pub colour: [u8; 3],
    /// 0 to 1.
    pub opacity: f32,
    /// Points.
    pub width: f32,
    /// Lengths drawn and left out in turn, points; nothing for a whole line.
    pub dashes: &'static [f32],
}

impl Pen {
    pub const fn new(colour: [u8; 3], opacity: f32, width: f32, dashes: &'static [f32]) -> Pen {
        Pen { colour, opacity, width, dashes }
    }
}

/// A colour for the screen; on one whose light is all red a red as bright.
pub fn shade([r, g, b]: [u8; 3], opacity: f32, is_red: bool) -> Color32 {
    let alpha = (opacity.clamp(0.0, 1.0) * 255.0) as u8;
    match is_red {
        // Red alone carries the mark, as bright as eyes in the dark can bear.
        true => Color32::from_rgba_unmultiplied(r.max(g).max(b).min(224), 0, 0, alpha),
        false => Color32::from_rgba_unmultiplied(r, g, b, alpha),
    }
}

/// Lines drawn so far.
pub struct Ink {
    pub mesh: Mesh,
    /// Width of the soft edge of lines, points.
    feather: f32,
    pub is_red: bool,
    path: Path,
}

impl Ink {
    pub fn new(pixels_per_point: f32, is_red: bool) -> Ink {
        let feather = 1.0 / pixels_per_point.max(0.1);
        Ink { mesh: Mesh::default(), feather, is_red, path: Path::default() }
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Pos2], pen: &Pen) {
        if points.len() < 2 {
            return;
        }
        let stroke = PathStroke::new(pen.width, shade(pen.colour, pen.opacity, self.is_red));
        if pen.dashes.is_empty() {
            self.stroke(points, &stroke);
            return;
        }
        let colour = shade(pen.colour, pen.opacity, self.is_red);
        let (mut index, mut left) = (0, pen.dashes[0]);
        for pair in points.windows(2) {
            let along = pair[1] - pair[0];
            let length = along.length();
            let mut done = 0.0;
            while done < length {
                let step = left.min(length - done);
                if index % 2 == 0 {
                    let at = |way: f32| pair[0] + along * (way / length);
                    self.dash([at(done), at(done + step)], pen.width, colour);
                }
                done += step;
                left -= step;
                if left <= 0.0 {
                    index += 1;
                    left = pen.dashes[index % pen.dashes.len()].max(0.5);
                }
            }
        }
    }

    /// A straight piece with soft sides. There are thousands: no more corners than it takes.
    fn dash(&mut self, [a, b]: [Pos2; 2], width: f32, colour: Color32) {
        let along = (b - a).normalized();
        let across = Vec2::new(-along.y, along.x);
        let outer = 0.5 * (width + self.feather);
        // Thin ones are a ridge, others have a flat top.
        let inner = 0.5 * (width - self.feather);
        let clear = Color32::TRANSPARENT;
        let ridge = [(-outer, clear), (0.0, colour), (outer, clear)];
        let flat = [(-outer, clear), (-inner, colour), (inner, colour), (outer, clear)];
        let columns = if inner < 0.25 * width { &ridge[..] } else { &flat[..] };
        let first = self.mesh.vertices.len() as u32;
        for &(offset, colour) in columns {
            self.mesh.colored_vertex(a + across * offset, colour);
            self.mesh.colored_vertex(b + across * offset, colour);
        }
        for strip in 0..columns.len() as u32 - 1 {
            let corner = first + 2 * strip;
            self.mesh.add_triangle(corner, corner + 1, corner + 2);
            self.mesh.add_triangle(corner + 1, corner + 2, corner + 3);
        }
    }

    /// A closed line around an ellipse, turned clockwise from the x axis by an angle in radians.
    pub fn ellipse(&mut self, centre: Pos2, radii: Vec2, turn: f32, pen: &Pen) {
        let corners = (radii.max_elem() * 1.5).clamp(16.0, 96.0) as usize;
        let (sin, cos) = turn.sin_cos();
        let points: Vec<Pos2> = (0..=corners)
            .map(|corner| {
                let angle = corner as f32 / corners as f32 * std::f32::consts::TAU;
                let (x, y) = (radii.x * angle.cos(), radii.y * angle.sin());
                centre + Vec2::new(x * cos - y * sin, x * sin + y * cos)
            })
            .collect();
        self.line(&points, pen);
    }

    fn stroke(&mut self, points: &[Pos2], stroke: &PathStroke) {
        self.path.clear();
        self.path.add_open_points(points);
        self.path.stroke_open(self.feather, stroke, &mut self.mesh);
    }
}

//! stub
use crate::units::Angle;
#[derive(Debug, Clone, PartialEq)]
pub struct MoonRelief {
    pub width: usize,
    pub height: usize,
    pub elevation_m: Vec<i16>,
}
impl MoonRelief {
    pub fn elevation_m(&self, longitude: Angle, latitude: Angle) -> f64 {
        let x = (longitude.rad() / std::f64::consts::TAU + 0.5) * self.width as f64 - 0.5;
        let y = ((0.5 - latitude.rad() / std::f64::consts::PI) * self.height as f64 - 0.5)
            .clamp(0.0, (self.height - 1) as f64);
        let (x0, y0) = (x.floor() as i64, (y as usize).min(self.height - 2));
        let at = |x: i64, y: usize| {
            f64::from(self.elevation_m[y * self.width + x.rem_euclid(self.width as i64) as usize])
        };
        let (ax, ay) = (x - x0 as f64, y - y0 as f64);
        (at(x0, y0) * (1.0 - ax) + at(x0 + 1, y0) * ax) * (1.0 - ay)
            + (at(x0, y0 + 1) * (1.0 - ax) + at(x0 + 1, y0 + 1) * ax) * ay
    }
}

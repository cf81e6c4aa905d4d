//! Where the picture looks, and how the sky is laid on its plane.
//!
//! Pixels are square, the origin is the top left corner of the picture, and the centre of the
//! first pixel is (0.5, 0.5). The field of view is the angle that the *width* of the picture
//! spans, measured through its centre, whatever the projection.
//!
//! Azimuthal projections lay a direction that stands `theta` away from the centre at the distance
//! `r(theta)` from it, in units of the focal length (Snyder 1987, *Map Projections*, USGS 1395):
//!
//! | projection    | r(theta)         | widest field | keeps           |
//! |---------------|------------------|--------------|-----------------|
//! | perspective   | tan theta        | below 180°   | straight lines  |
//! | stereographic | 2 tan(theta / 2) | below 360°   | shapes          |
//! | equidistant   | theta            | 360°         | distances       |
//! | equal-area    | 2 sin(theta / 2) | 360°         | areas           |
//!
//! The equirectangular projection lays longitude and latitude about the picture's own axes: with
//! the camera level they are azimuth and altitude.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::frame::{Apparent, Dir, Rot, View};
use crate::units::Angle;

/// How directions are laid on the plane of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Projection {
    /// Straight lines stay straight, as in a normal lens.
    Perspective,
    /// Circles stay circles: the gentlest for wide fields.
    Stereographic,
    /// Fisheye in which equal angles from the centre are equal distances.
    Equidistant,
    /// Fisheye in which equal areas of sky are equal areas of picture.
    EqualArea,
    /// Longitude and latitude as x and y: panoramas and environment maps.
    Equirectangular,
}

impl Projection {
    pub const ALL: [Projection; 5] = [
        Projection::Perspective,
        Projection::Stereographic,
        Projection::Equidistant,
        Projection::EqualArea,
        Projection::Equirectangular,
    ];

    pub const fn name(self) -> &'static str {
        match self {
            Projection::Perspective => "perspective",
            Projection::Stereographic => "stereographic",
            Projection::Equidistant => "equidistant",
            Projection::EqualArea => "equal-area",
            Projection::Equirectangular => "equirectangular",
        }
    }

    /// The widest field that the projection can show, degrees.
    pub const fn widest_deg(self) -> f64 {
        match self {
            Projection::Perspective => 170.0,
            Projection::Stereographic => 340.0,
            Projection::Equidistant | Projection::EqualArea | Projection::Equirectangular => 360.0,
        }
    }

    /// Distance from the centre, in focal lengths, of a direction `theta` away from it.
    fn radius_from_theta(self, theta: f64) -> f64 {
        match self {
            Projection::Perspective => theta.tan(),
            Projection::Stereographic => 2.0 * (theta / 2.0).tan(),
            Projection::Equidistant | Projection::Equirectangular => theta,
            Projection::EqualArea => 2.0 * (theta / 2.0).sin(),
        }
    }

    /// The inverse of [`Self::radius_from_theta`]; none where the plane has no sky.
    fn theta_from_radius(self, radius: f64) -> Option<f64> {
        match self {
            Projection::Perspective => Some(radius.atan()),
            Projection::Stereographic => Some(2.0 * (radius / 2.0).atan()),
            Projection::Equidistant | Projection::Equirectangular => {
                (radius <= PI).then_some(radius)
            }
            Projection::EqualArea => (radius <= 2.0).then(|| 2.0 * (radius / 2.0).asin()),
        }
    }

    /// Solid angle per unit of plane, `theta` away from the centre.
    fn solid_angle_per_area(self, theta: f64) -> f64 {
        match self {
            Projection::Perspective => theta.cos().powi(3),
            Projection::Stereographic => (theta / 2.0).cos().powi(4),
            Projection::Equidistant | Projection::Equirectangular => {
                if theta < 1e-4 {
                    1.0 - theta * theta / 6.0
                } else {
                    theta.sin() / theta
                }
            }
            Projection::EqualArea => 1.0,
        }
    }
}

/// The narrowest field of view: an arcsecond. What the GPU reckons in 32 bits is laid out so that edges
/// of discs stand within 0.06 pixels of where they do in 64, and ground on the Moon within 0.01 of where wider
/// fields have it, on 1280 pixels (`tests/narrow_fields.rs`).
pub const NARROWEST_FIELD_DEG: f64 = 1.0 / 3600.0;
/// The largest picture edge, pixels.
pub const LARGEST_EDGE_PX: u32 = 16_384;

/// What can be wrong with a camera.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CameraError {
    #[error(
        "field of view {fov_deg}° is outside {narrowest:.5}° to {widest}° of the {projection} projection; choose another field or projection",
        narrowest = NARROWEST_FIELD_DEG
    )]
    FieldOfView { fov_deg: f64, widest: f64, projection: &'static str },
    #[error("size {0}x{1} is outside 1x1 to {edge}x{edge} pixels", edge = LARGEST_EDGE_PX)]
    Size(u32, u32),
    #[error("{what} {value}° is outside {low}° to {high}°")]
    Pointing { what: &'static str, value: f64, low: f64, high: f64 },
}

/// A camera that stands at the observer's place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    pub projection: Projection,
    /// Angle spanned by the width of the picture, through its centre.
    pub field_of_view: Angle,
    /// Azimuth of the centre, from north through east.
    pub azimuth: Angle,
    /// Apparent altitude of the centre.
    pub altitude: Angle,
    /// Turn of the camera about the line of sight, clockwise as the photographer sees it.
    pub roll: Angle,
    pub width_px: u32,
    pub height_px: u32,
}

impl Camera {
    /// Checks that the camera can take a picture at all.
    pub fn checked(self) -> Result<Camera, CameraError> {
        let fov_deg = self.field_of_view.deg();
        let widest = self.projection.widest_deg();
        if !(NARROWEST_FIELD_DEG..=widest).contains(&fov_deg) {
            let projection = self.projection.name();
            return Err(CameraError::FieldOfView { fov_deg, widest, projection });
        }
        let edges = 1..=LARGEST_EDGE_PX;
        if !edges.contains(&self.width_px) || !edges.contains(&self.height_px) {
            return Err(CameraError::Size(self.width_px, self.height_px));
        }
        for (what, angle, high) in [
            ("direction of view", self.azimuth, 360.0),
            ("altitude of view", self.altitude, 90.0),
            ("roll", self.roll, 360.0),
        ] {
            let value = angle.deg();
            // A rounding error beyond the pole is no mistake of anybody's.
            if !(-high - 1e-9..=high + 1e-9).contains(&value) {
                return Err(CameraError::Pointing { what, value, low: -high, high });
            }
        }
        Ok(self)
    }

    /// Focal length in pixels: the scale of the plane at the centre of the picture.
    pub fn focal_px(&self) -> f64 {
        let half_width = f64::from(self.width_px) / 2.0;
        half_width / self.projection.radius_from_theta(self.field_of_view.rad() / 2.0)
    }

    /// The angle between neighbouring pixels at the centre of the picture.
    pub fn pixel_angle(&self) -> Angle {
        Angle::from_rad(1.0 / self.focal_px())
    }

    /// Camera axes: x right, y up, the line of sight is -z.
    pub fn view_from_apparent(&self) -> Rot<View, Apparent> {
        let (sin_az, cos_az) = self.azimuth.sin_cos();
        let forward: Dir<Apparent> = Dir::from_azimuth_altitude(self.azimuth, self.altitude);
        // The level right-hand side is well defined even when looking at the zenith.
        let level_right = DVec3::new(cos_az, -sin_az, 0.0);
        let level_up = level_right.cross(forward.vector());
        let (sin_roll, cos_roll) = self.roll.sin_cos();
        let right = level_right * cos_roll - level_up * sin_roll;
        let up = level_right * sin_roll + level_up * cos_roll;
        // The rows are the camera's axes written in local ones: orthonormal by construction.
        Rot::claim(DMat3::from_cols(right, up, -forward.vector()).transpose())
    }

    /// Where a direction falls, in pixels; none when the plane has no place for it.
    pub fn pixel_from_view(&self, dir: Dir<View>) -> Option<[f64; 2]> {
        let v = dir.vector();
        let plane = match self.projection {
            Projection::Equirectangular => [v.x.atan2(-v.z), dir_latitude_about_y(v)],
            azimuthal => {
                let off_axis = v.x.hypot(v.y);
                let theta = off_axis.atan2(-v.z);
                if theta.to_degrees() > azimuthal.widest_deg() / 2.0 + 1e-9 {
                    return None;
                }
                let radius = azimuthal.radius_from_theta(theta);
                let scale = if off_axis > 0.0 { radius / off_axis } else { 0.0 };
                [v.x * scale, v.y * scale]
            }
        };
        let focal = self.focal_px();
        Some([
            f64::from(self.width_px) / 2.0 + plane[0] * focal,
            f64::from(self.height_px) / 2.0 - plane[1] * focal,
        ])
    }

    /// Where an apparent direction falls, in pixels; none when the plane has no place for it.
    pub fn pixel_from_apparent(&self, dir: Dir<Apparent>) -> Option<[f64; 2]> {
        self.pixel_from_view(self.view_from_apparent() * dir)
    }

    /// The direction that a point of the picture looks in; none where the plane has no sky.
    pub fn view_from_pixel(&self, pixel: [f64; 2]) -> Option<Dir<View>> {
        let [x, y] = self.plane_from_pixel(pixel);
        match self.projection {
            Projection::Equirectangular => {
                if x.abs() > PI || y.abs() > PI / 2.0 {
                    return None;
                }
                let (sin_lon, cos_lon) = x.sin_cos();
                let (sin_lat, cos_lat) = y.sin_cos();
                Some(Dir::from_vector(DVec3::new(cos_lat * sin_lon, sin_lat, -cos_lat * cos_lon)))
            }
            azimuthal => {
                let radius = x.hypot(y);
                let theta = azimuthal.theta_from_radius(radius)?;
                let scale = if radius > 0.0 { theta.sin() / radius } else { 0.0 };
                Some(Dir::from_vector(DVec3::new(x * scale, y * scale, -theta.cos())))
            }
        }
    }

    /// Solid angle seen by the pixel whose centre is given, steradians; zero outside the sky.
    pub fn pixel_solid_angle_sr(&self, pixel: [f64; 2]) -> f64 {
        let [x, y] = self.plane_from_pixel(pixel);
        let per_area = match self.projection {
            Projection::Equirectangular => {
                if x.abs() > PI || y.abs() > PI / 2.0 {
                    0.0
                } else {
                    y.cos()
                }
            }
            azimuthal => match azimuthal.theta_from_radius(x.hypot(y)) {
                Some(theta) => azimuthal.solid_angle_per_area(theta),
                None => 0.0,
            },
        };
        per_area / (self.focal_px() * self.focal_px())
    }

    /// Whether a point lies on the picture.
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        (0.0..f64::from(self.width_px)).contains(&x)
            && (0.0..f64::from(self.height_px)).contains(&y)
    }

    /// The largest angle from the line of sight of what falls on the picture, or beside it by no more
    /// than some pixels.
    pub fn reach(&self, beside_px: f64) -> Angle {
        let edge = |px: u32| (f64::from(px) / 2.0 + beside_px) / self.focal_px();
        let (x, y) = (edge(self.width_px), edge(self.height_px));
        Angle::from_rad(match self.projection {
            Projection::Equirectangular => {
                let (across, up) = (x.min(PI).cos(), y.min(PI / 2.0).cos());
                // Behind the camera the level is farthest from the line of sight.
                let farthest = if across < 0.0 { across } else { across * up };
                farthest.acos()
            }
            azimuthal => azimuthal.theta_from_radius(x.hypot(y)).unwrap_or(PI),
        })
    }

    /// How far the picture repeats to the right, pixels: a full turn of an equirectangular one.
    pub fn wrap_px(&self) -> Option<f64> {
        (self.projection == Projection::Equirectangular).then(|| TAU * self.focal_px())
    }

    fn plane_from_pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let focal = self.focal_px();
        [
            (x - f64::from(self.width_px) / 2.0) / focal,
            (f64::from(self.height_px) / 2.0 - y) / focal,
        ]
    }
}

/// Latitude about the camera's upward axis.
fn dir_latitude_about_y(v: DVec3) -> f64 {
    v.y.atan2(v.x.hypot(v.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(projection: Projection, fov_deg: f64) -> Camera {
        Camera {
            projection,
            field_of_view: Angle::from_deg(fov_deg),
            azimuth: Angle::from_deg(200.0),
            altitude: Angle::from_deg(30.0),
            roll: Angle::from_deg(5.0),
            width_px: 640,
            height_px: 360,
        }
    }

    #[test]
    fn pixels_and_directions_are_inverse() {
        for projection in Projection::ALL {
            for fov_deg in [0.05, 20.0, 120.0] {
                let camera = camera(projection, fov_deg).checked().unwrap();
                for pixel in [[0.5, 0.5], [320.0, 180.0], [639.5, 0.5], [17.25, 300.75]] {
                    let dir = camera.view_from_pixel(pixel).unwrap();
                    let back = camera.pixel_from_view(dir).unwrap();
                    let off = (back[0] - pixel[0]).hypot(back[1] - pixel[1]);
                    assert!(off < 1e-8, "{projection:?} at {fov_deg}°: {pixel:?} -> {back:?}");
                }
            }
        }
    }

    #[test]
    fn what_is_on_the_picture_lies_within_its_reach() {
        for projection in Projection::ALL {
            for fov_deg in [0.05, 20.0, 120.0, 170.0] {
                let camera = camera(projection, fov_deg);
                let axis = Dir::from_vector(DVec3::NEG_Z);
                let mut farthest: f64 = 0.0;
                for step in 0..=640 {
                    for y in [0.0, 0.25, 0.5, 1.0].map(|share| share * 360.0) {
                        let dir = camera.view_from_pixel([f64::from(step), y]).unwrap();
                        farthest = farthest.max(dir.separation(axis).rad());
                    }
                }
                let reach = camera.reach(0.0).rad();
                assert!(farthest <= reach + 1e-12, "{projection:?} {fov_deg}");
                assert!(reach < farthest * 1.001, "{projection:?} {fov_deg}: {reach} {farthest}");
                assert!(camera.reach(2.0).rad() > reach);
            }
        }
    }

    #[test]
    fn the_width_spans_the_field_of_view() {
        for projection in Projection::ALL {
            let camera = camera(projection, 100.0);
            let left = camera.view_from_pixel([0.0, 180.0]).unwrap();
            let right = camera.view_from_pixel([640.0, 180.0]).unwrap();
            assert!((left.separation(right).deg() - 100.0).abs() < 1e-9, "{projection:?}");
        }
    }

    #[test]
    fn solid_angles_add_up_to_the_whole_sphere() {
        for (projection, fov, width_px, height_px) in [
            (Projection::Equirectangular, 360.0, 720, 360),
            (Projection::EqualArea, 360.0, 501, 501),
            (Projection::Equidistant, 360.0, 801, 801),
        ] {
            let camera = Camera { width_px, height_px, ..camera(projection, fov) };
            let mut sum = 0.0;
            for y in 0..height_px {
                for x in 0..width_px {
                    sum += camera.pixel_solid_angle_sr([f64::from(x) + 0.5, f64::from(y) + 0.5]);
                }
            }
            assert!((sum / (4.0 * PI) - 1.0).abs() < 2e-3, "{projection:?}: {sum}");
        }
    }

    #[test]
    fn a_pixel_sees_the_solid_angle_between_its_edges() {
        for projection in Projection::ALL {
            let camera = camera(projection, 120.0);
            let pixel = [600.5, 40.5];
            let edge = |dx: f64, dy: f64| {
                camera.view_from_pixel([pixel[0] + dx, pixel[1] + dy]).unwrap().vector()
            };
            let across = edge(0.5, 0.0) - edge(-0.5, 0.0);
            let along = edge(0.0, 0.5) - edge(0.0, -0.5);
            let area = across.cross(along).length();
            let stated = camera.pixel_solid_angle_sr(pixel);
            assert!((area / stated - 1.0).abs() < 1e-4, "{projection:?}: {area} {stated}");
        }
    }

    #[test]
    fn up_is_up_and_east_is_to_the_right_of_north() {
        let looking_north = Camera {
            azimuth: Angle::ZERO,
            altitude: Angle::ZERO,
            roll: Angle::ZERO,
            ..camera(Projection::Stereographic, 90.0)
        };
        let at = |azimuth, altitude| {
            let dir: Dir<Apparent> =
                Dir::from_azimuth_altitude(Angle::from_deg(azimuth), Angle::from_deg(altitude));
            looking_north.pixel_from_view(looking_north.view_from_apparent() * dir).unwrap()
        };
        assert!(at(10.0, 0.0)[0] > 330.0, "east is to the right when looking north");
        assert!(at(0.0, 10.0)[1] < 170.0, "higher in the sky is higher in the picture");
        let zenith = Camera { altitude: Angle::from_deg(90.0), ..looking_north };
        let south: Dir<Apparent> =
            Dir::from_azimuth_altitude(Angle::from_deg(180.0), Angle::from_deg(80.0));
        let south = zenith.pixel_from_view(zenith.view_from_apparent() * south).unwrap();
        assert!(south[1] < 170.0, "facing north, what lies south of the zenith is at the top");
    }

    #[test]
    fn impossible_cameras_are_refused() {
        assert!(camera(Projection::Perspective, 180.0).checked().is_err());
        assert!(camera(Projection::Equidistant, f64::NAN).checked().is_err());
        assert!(Camera { width_px: 0, ..camera(Projection::Equidistant, 90.0) }.checked().is_err());
        let over_the_top = Angle::from_deg(91.0);
        let camera = Camera { altitude: over_the_top, ..camera(Projection::Equidistant, 90.0) };
        assert!(camera.checked().is_err());
    }
}

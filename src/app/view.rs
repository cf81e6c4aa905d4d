//! Where the window looks, and how it turns.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::camera::Projection;
use crate::frame::{Apparent, Dir};
use crate::sky::Target;
use crate::units::{Angle, DAY_S};

/// The widest field of view that is offered, degrees.
pub const WIDEST_FIELD_DEG: f64 = 235.0;
/// Turns of the Earth against the stars in a second.
const TURN_RAD_S: f64 = std::f64::consts::TAU / 86_164.090_53;
/// What is left of a movement after a second.
const LEFT_AFTER_1_S: f64 = 1e-3;
/// Slower than this share of the field in a second, nothing moves.
const STILL: f64 = 2e-3;
/// No nearer to a pole of the mount: beyond it, left and right change places.
const HIGHEST_DEG: f64 = 89.999;

/// What stays upright, and what turning goes around.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Mount {
    /// The zenith is up, and the view stays with the ground.
    #[default]
    Altazimuth,
    /// The celestial pole is up, and the view stays with the stars.
    Equatorial,
}

/// The view of the window.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct View {
    /// About the axis of the mount: azimuth, from north through east; or 180 degrees more than the hour
    /// angle, so that north and south are the same on both.
    pub longitude_deg: f64,
    /// From the equator of the mount: apparent altitude, or declination as the sky turns here.
    pub latitude_deg: f64,
    /// Across the width of the window.
    pub field_deg: f64,
    pub projection: Projection,
    pub mount: Mount,
    /// Stays in the middle.
    pub follow: Option<Target>,
    #[serde(skip)]
    momentum: Momentum,
}

/// How the view goes on moving, per second.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Momentum {
    longitude_deg: f64,
    latitude_deg: f64,
    /// Powers of e of the field.
    zoom: f64,
}

/// Where a camera points, about the zenith.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    pub azimuth: Angle,
    pub altitude: Angle,
    pub roll: Angle,
}

impl Default for View {
    fn default() -> View {
        View {
            longitude_deg: 180.0,
            latitude_deg: 25.0,
            field_deg: 90.0,
            projection: Projection::Stereographic,
            mount: Mount::Altazimuth,
            follow: None,
            momentum: Momentum::default(),
        }
    }
}

impl Mount {
    /// Along the axis, to where longitudes begin, and a quarter turn on: x is east, y north, z up.
    fn axes(self, latitude: Angle) -> [DVec3; 3] {
        let (sin, cos) = latitude.sin_cos();
        match self {
            Mount::Altazimuth => [DVec3::Z, DVec3::Y, DVec3::X],
            // From the lower meridian through east.
            Mount::Equatorial => [DVec3::new(0.0, cos, sin), DVec3::new(0.0, sin, -cos), DVec3::X],
        }
    }

    /// The direction of a longitude and a latitude about its axis, at a place.
    fn direction(self, [longitude, latitude]: [Angle; 2], at: Angle) -> Dir<Apparent> {
        let [axis, first, second] = self.axes(at);
        let (sin, cos) = longitude.sin_cos();
        let level = first * cos + second * sin;
        Dir::from_vector(axis * latitude.sin() + level * latitude.cos())
    }

    /// Longitude and latitude of a direction.
    fn coordinates(self, dir: Dir<Apparent>, at: Angle) -> [Angle; 2] {
        let [axis, first, second] = self.axes(at).map(|unit| unit.dot(dir.vector()));
        [
            Angle::from_rad(second.atan2(first)).positive(),
            Angle::from_rad(axis.clamp(-1.0, 1.0).asin()),
        ]
    }

    /// How a camera stands that looks in a direction, its axis upright, at a place of a latitude.
    pub fn pose(self, dir: Dir<Apparent>, latitude: Angle) -> Pose {
        let (azimuth, altitude) = (dir.azimuth(), dir.altitude());
        let (sin, cos) = azimuth.sin_cos();
        let level_right = DVec3::new(cos, -sin, 0.0);
        let level_up = level_right.cross(dir.vector());
        let [axis, ..] = self.axes(latitude);
        let roll = Angle::from_rad(axis.dot(level_right).atan2(axis.dot(level_up)));
        let roll = if self == Mount::Altazimuth { Angle::ZERO } else { roll };
        Pose { azimuth, altitude, roll }
    }
}

impl View {
    /// Where it looks, from a place of a latitude.
    pub fn direction(&self, latitude: Angle) -> Dir<Apparent> {
        let about = [self.longitude_deg, self.latitude_deg].map(Angle::from_deg);
        self.mount.direction(about, latitude)
    }

    pub fn pose(&self, latitude: Angle) -> Pose {
        self.mount.pose(self.direction(latitude), latitude)
    }

    /// Looks in a direction, and stops following and moving.
    pub fn look(&mut self, dir: Dir<Apparent>, latitude: Angle) {
        self.set(dir, latitude);
        self.follow = None;
        self.momentum = Momentum::default();
    }

    /// Looks where a picture was made that followed something.
    pub fn set(&mut self, dir: Dir<Apparent>, latitude: Angle) {
        let [about, up] = self.mount.coordinates(dir, latitude);
        (self.longitude_deg, self.latitude_deg) = (about.deg(), up.deg());
        self.keep_within();
    }

    /// The same direction on another mount.
    pub fn set_mount(&mut self, mount: Mount, latitude: Angle) {
        let dir = self.direction(latitude);
        self.mount = mount;
        self.set(dir, latitude);
        self.momentum = Momentum::default();
    }

    /// Another projection; a field that it cannot show becomes its widest.
    pub fn set_projection(&mut self, projection: Projection) {
        self.projection = projection;
        self.keep_within();
    }

    pub fn set_field(&mut self, field_deg: f64) {
        self.field_deg = field_deg;
        self.momentum.zoom = 0.0;
        self.keep_within();
    }

    /// Turns by angles on the sky in the middle of the picture: to the right, and up.
    pub fn turn(&mut self, right_deg: f64, up_deg: f64) {
        self.follow = None;
        self.longitude_deg += right_deg / self.narrowing();
        self.latitude_deg += up_deg;
        self.keep_within();
    }

    /// Goes on turning so fast, degrees on the sky in a second.
    pub fn push(&mut self, right_deg_s: f64, up_deg_s: f64) {
        self.momentum.longitude_deg = right_deg_s / self.narrowing();
        self.momentum.latitude_deg = up_deg_s;
    }

    /// Goes on zooming by so many powers of e of the field, all in all.
    pub fn push_zoom(&mut self, powers: f64) {
        // The integral of what decays.
        self.momentum.zoom += powers * -LEFT_AFTER_1_S.ln();
    }

    pub fn stop(&mut self) {
        self.momentum = Momentum::default();
    }

    /// Whether it moves by itself.
    pub fn is_moving(&self) -> bool {
        self.momentum != Momentum::default()
    }

    /// Lets time of the viewer pass.
    pub fn advance(&mut self, passed_s: f64) {
        if !self.is_moving() {
            return;
        }
        let left = LEFT_AFTER_1_S.powf(passed_s);
        // The way within the time, of what decays.
        let way_s = (1.0 - left) / -LEFT_AFTER_1_S.ln();
        let Momentum { longitude_deg, latitude_deg, zoom } = self.momentum;
        self.longitude_deg += longitude_deg * way_s;
        self.latitude_deg += latitude_deg * way_s;
        self.field_deg *= (zoom * way_s).exp();
        self.momentum = Momentum {
            longitude_deg: longitude_deg * left,
            latitude_deg: latitude_deg * left,
            zoom: zoom * left,
        };
        let turning = (longitude_deg * self.narrowing()).hypot(latitude_deg) / self.field_deg;
        if turning < STILL && zoom.abs() < STILL {
            self.momentum = Momentum::default();
        }
        self.keep_within();
    }

    /// Lets time of the sky pass: an equatorial mount goes with the stars.
    pub fn turn_with_sky(&mut self, sky_s: f64) {
        if self.mount == Mount::Equatorial {
            let turns = (TURN_RAD_S * sky_s.rem_euclid(DAY_S * 365_250.0)).to_degrees();
            self.longitude_deg += turns;
            self.keep_within();
        }
    }

    /// How much narrower a circle of latitude is here than the equator.
    fn narrowing(&self) -> f64 {
        self.latitude_deg.to_radians().cos().max(0.02)
    }

    fn keep_within(&mut self) {
        let finite = |value: f64, usual: f64| if value.is_finite() { value } else { usual };
        let usual = View::default();
        self.longitude_deg = finite(self.longitude_deg, usual.longitude_deg).rem_euclid(360.0);
        let latitude_deg = finite(self.latitude_deg, usual.latitude_deg);
        self.latitude_deg = latitude_deg.clamp(-HIGHEST_DEG, HIGHEST_DEG);
        let widest_deg = self.projection.widest_deg().min(WIDEST_FIELD_DEG);
        self.field_deg = finite(self.field_deg, usual.field_deg)
            .clamp(crate::camera::NARROWEST_FIELD_DEG, widest_deg);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: Angle = Angle::from_deg(35.2);

    #[test]
    fn mounts_look_the_same_way() {
        for azimuth_deg in [0.0, 63.0, 180.0, 271.0] {
            for altitude_deg in [-20.0, 5.0, 70.0] {
                let dir = Dir::from_azimuth_altitude(
                    Angle::from_deg(azimuth_deg),
                    Angle::from_deg(altitude_deg),
                );
                let mut view = View::default();
                view.look(dir, HERE);
                assert!(view.direction(HERE).separation(dir).arcsec() < 1e-3);
                view.set_mount(Mount::Equatorial, HERE);
                assert!(view.direction(HERE).separation(dir).arcsec() < 1e-3);
            }
        }
    }

    #[test]
    fn the_pole_is_up_on_an_equatorial_mount_and_stars_stand_still() {
        let mut view = View { mount: Mount::Equatorial, ..View::default() };
        // Due south the meridian is upright on both mounts.
        view.look(Dir::from_azimuth_altitude(Angle::from_deg(180.0), Angle::from_deg(40.0)), HERE);
        assert!(view.pose(HERE).roll.deg().abs() < 1e-9);
        assert!((view.longitude_deg - 180.0).abs() < 1e-9);
        // In the east the pole is to the left: the camera is turned against the clock, and a star
        // that rises moves up and to the right.
        view.look(Dir::from_azimuth_altitude(Angle::from_deg(90.0), Angle::from_deg(10.0)), HERE);
        assert!(view.pose(HERE).roll.deg() < -40.0, "{:?}", view.pose(HERE));
        let before = view.direction(HERE);
        view.turn_with_sky(3600.0);
        let after = view.direction(HERE);
        assert!(after.altitude() > before.altitude() && after.azimuth() > before.azimuth());
        assert!((before.separation(after).deg() - 15.0).abs() < 0.5);
    }

    #[test]
    fn momentum_ends_and_views_stay_possible() {
        let mut view = View::default();
        view.push(100.0, 30.0);
        view.push_zoom(-1.0);
        let mut frames = 0;
        while view.is_moving() {
            view.advance(1.0 / 60.0);
            frames += 1;
            assert!(frames < 1000);
        }
        assert!((view.field_deg - 90.0 / std::f64::consts::E).abs() < 1.0, "{}", view.field_deg);
        for (right, up) in [(1e9, 1e9), (f64::NAN, f64::INFINITY), (-400.0, -1e300)] {
            view.turn(right, up);
            view.set_field(up);
            assert!((0.0..360.0).contains(&view.longitude_deg) && view.latitude_deg.abs() < 90.0);
            assert!(view.field_deg <= WIDEST_FIELD_DEG && view.field_deg > 0.0);
        }
        view.set_field(1e6);
        view.set_projection(Projection::Perspective);
        assert!(view.field_deg <= Projection::Perspective.widest_deg());
    }
}

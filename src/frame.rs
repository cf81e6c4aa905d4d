//! Directions, positions and rotations that know the axes they are written in.
//!
//! A product of rotations and directions whose frames do not meet does not compile:
//! `horizon_from_icrs = horizon_from_true * true_from_icrs` reads like dominoes.
//!
//! ```compile_fail
//! use nocturne::frame::{Dir, Horizon, Icrs, Rot};
//! let horizon_from_icrs: Rot<Horizon, Icrs> = Rot::claim(glam::DMat3::IDENTITY);
//! let up: Dir<Horizon> = Dir::from_spherical(nocturne::units::Angle::ZERO, nocturne::units::Angle::ZERO);
//! let wrong = horizon_from_icrs * up; // the direction is not written in Icrs axes
//! ```
//!
//! The axes, all right-handed unless the line says so:
//!
//! ```text
//! Icrs        x to the origin of right ascension, z to the celestial pole of the ICRS
//! EclipticOfDate  x to the mean equinox of date, z to the pole of the ecliptic of date
//! Helioecliptic  x to the longitude of the Sun, z to the pole of the ecliptic of J2000.0
//! MeanOfDate  x to the mean equinox of date, z to the mean pole of date
//! TrueOfDate  x to the true equinox of date, z to the true pole (precession and nutation)
//! Galactic    x to the galactic centre, y to l = 90 degrees (Cygnus), z to the north galactic pole
//! Itrs        x to the prime meridian, z to the geographic pole; turns with the Earth
//! Horizon     x east, y north, z up. Geometric: what stands there without air
//! Apparent    x east, y north, z up. Refracted: where the light is seen to come from
//! MoonFixed   x to the mean sub-Earth point, z to the lunar north pole (mean Earth, rotation)
//! View        x to the right of the picture, y to its top, z towards the viewer
//!             (the line of sight is -z)
//!
//!        Horizon, Apparent                    View
//!             z up                             y top
//!             |   y north                      |
//!             |  /                             |
//!             | /   azimuth from north         |_______ x right
//!             |/_____ x east, through east    /
//!                                            z towards the viewer
//! ```

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Add, Mul, Neg, Sub};

use glam::{DMat3, DVec3};

use crate::units::Angle;

/// The axes of the International Celestial Reference System: what catalogues are written in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Icrs {}
/// Galactic longitude and latitude of the IAU 1958: x to the centre, z to the north pole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Galactic {}
/// Mean ecliptic and mean equinox of date.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EclipticOfDate {}
/// Ecliptic of J2000.0, x towards the longitude of the Sun.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Helioecliptic {}
/// Mean equator and mean equinox of date: precession, no nutation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MeanOfDate {}
/// True equator and true equinox of date: precession and nutation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TrueOfDate {}
/// Axes that turn with the Earth: prime meridian and geographic pole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Itrs {}
/// Local axes, x east, y north, z up. Geometric: no refraction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Horizon {}
/// Local axes, x east, y north, z up. As seen: refracted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Apparent {}
/// Axes fixed in the Moon: mean Earth and rotation axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MoonFixed {}
/// Camera axes: x right, y up, the line of sight is -z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum View {}

/// A unit direction written in the axes of `F`.
pub struct Dir<F>(DVec3, PhantomData<F>);
/// A position or a displacement in kilometres, written in the axes of `F`.
pub struct Pos<F>(DVec3, PhantomData<F>);
/// Takes what is written in `From` axes to the same thing in `To` axes.
pub struct Rot<To, From>(DMat3, PhantomData<(To, From)>);

// Derives would ask that the frame markers themselves be Clone, Copy and so on.
impl<F> Clone for Dir<F> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<F> Copy for Dir<F> {}
impl<F> PartialEq for Dir<F> {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}
impl<F> fmt::Debug for Dir<F> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Dir({}, {}, {})", self.0.x, self.0.y, self.0.z)
    }
}
impl<F> Clone for Pos<F> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<F> Copy for Pos<F> {}
impl<F> PartialEq for Pos<F> {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}
impl<F> fmt::Debug for Pos<F> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Pos({}, {}, {}) km", self.0.x, self.0.y, self.0.z)
    }
}
impl<To, From> Clone for Rot<To, From> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<To, From> Copy for Rot<To, From> {}
impl<To, From> fmt::Debug for Rot<To, From> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Rot({})", self.0)
    }
}

impl<F> Dir<F> {
    /// A direction from any vector that is not zero; it is brought to unit length.
    pub fn from_vector(vector: DVec3) -> Self {
        Dir(vector.normalize(), PhantomData)
    }
    /// From longitude (counter-clockwise from x about z) and latitude (from the xy plane to z):
    /// right ascension and declination, ecliptic longitude and latitude, and so on.
    pub fn from_spherical(longitude: Angle, latitude: Angle) -> Self {
        let (sin_lon, cos_lon) = longitude.sin_cos();
        let (sin_lat, cos_lat) = latitude.sin_cos();
        Dir(DVec3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat), PhantomData)
    }
    pub const fn vector(self) -> DVec3 {
        self.0
    }
    /// Longitude in `[0, 2 pi)`, counter-clockwise from x about z.
    pub fn longitude(self) -> Angle {
        Angle::from_rad(self.0.y.atan2(self.0.x)).positive()
    }
    /// Latitude in `[-pi/2, pi/2]`; exact at the poles too, where an arcsine loses half its digits.
    pub fn latitude(self) -> Angle {
        Angle::from_rad(self.0.z.atan2(self.0.x.hypot(self.0.y)))
    }
    pub fn dot(self, other: Self) -> f64 {
        self.0.dot(other.0)
    }
    /// The angle between two directions, exact for small and for large ones.
    pub fn separation(self, other: Self) -> Angle {
        Angle::from_rad(self.0.cross(other.0).length().atan2(self.0.dot(other.0)))
    }
    /// The position at a distance in this direction.
    pub fn at_km(self, distance_km: f64) -> Pos<F> {
        Pos(self.0 * distance_km, PhantomData)
    }
}

/// Names of the sixteen winds, from north through east: azimuths in steps of 22.5 degrees.
pub const WINDS: [&str; 16] = [
    "N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW", "NW",
    "NNW",
];

/// Azimuth and altitude belong to the two local frames alone.
pub trait Local {}
impl Local for Horizon {}
impl Local for Apparent {}

impl<F: Local> Dir<F> {
    /// From azimuth (from north through east) and altitude.
    pub fn from_azimuth_altitude(azimuth: Angle, altitude: Angle) -> Self {
        let (sin_az, cos_az) = azimuth.sin_cos();
        let (sin_alt, cos_alt) = altitude.sin_cos();
        Dir(DVec3::new(cos_alt * sin_az, cos_alt * cos_az, sin_alt), PhantomData)
    }
    /// Azimuth in `[0, 2 pi)`, from north through east.
    pub fn azimuth(self) -> Angle {
        Angle::from_rad(self.0.x.atan2(self.0.y)).positive()
    }
    /// The direction of the same azimuth at another altitude, in this local frame or the other; straight
    /// up, where there is no azimuth, north.
    pub fn raised_to<G: Local>(self, altitude: Angle) -> Dir<G> {
        let (sin_alt, cos_alt) = altitude.sin_cos();
        let across = self.0.x.hypot(self.0.y);
        let (east, north) =
            if across > 0.0 { (self.0.x / across, self.0.y / across) } else { (0.0, 1.0) };
        Dir(DVec3::new(cos_alt * east, cos_alt * north, sin_alt), PhantomData)
    }
    /// Altitude above the horizontal plane.
    pub fn altitude(self) -> Angle {
        self.latitude()
    }
}

impl<F> Neg for Dir<F> {
    type Output = Dir<F>;
    fn neg(self) -> Dir<F> {
        Dir(-self.0, PhantomData)
    }
}

impl<F> Pos<F> {
    pub const ORIGIN: Pos<F> = Pos(DVec3::ZERO, PhantomData);

    pub const fn from_km(vector: DVec3) -> Self {
        Pos(vector, PhantomData)
    }
    pub const fn km(self) -> DVec3 {
        self.0
    }
    pub fn distance_km(self) -> f64 {
        self.0.length()
    }
    /// The direction of a position that is not the origin.
    pub fn dir(self) -> Dir<F> {
        Dir::from_vector(self.0)
    }
}

impl<F> Add for Pos<F> {
    type Output = Pos<F>;
    fn add(self, other: Pos<F>) -> Pos<F> {
        Pos(self.0 + other.0, PhantomData)
    }
}
impl<F> Sub for Pos<F> {
    type Output = Pos<F>;
    fn sub(self, other: Pos<F>) -> Pos<F> {
        Pos(self.0 - other.0, PhantomData)
    }
}
impl<F> Neg for Pos<F> {
    type Output = Pos<F>;
    fn neg(self) -> Pos<F> {
        Pos(-self.0, PhantomData)
    }
}
impl<F> Mul<f64> for Pos<F> {
    type Output = Pos<F>;
    fn mul(self, factor: f64) -> Pos<F> {
        Pos(self.0 * factor, PhantomData)
    }
}

impl<To, From> Rot<To, From> {
    /// The one door: a bare matrix is *claimed* to take `From` axes to `To` axes. Say why at the
    /// call. The matrix must be orthogonal.
    pub fn claim(matrix: DMat3) -> Self {
        debug_assert!(
            (matrix * matrix.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-9),
            "not a rotation: {matrix}"
        );
        Rot(matrix, PhantomData)
    }
    pub const fn matrix(self) -> DMat3 {
        self.0
    }
    pub fn inverse(self) -> Rot<From, To> {
        Rot(self.0.transpose(), PhantomData)
    }
}

impl<A, B, C> Mul<Rot<B, C>> for Rot<A, B> {
    type Output = Rot<A, C>;
    fn mul(self, other: Rot<B, C>) -> Rot<A, C> {
        Rot(self.0 * other.0, PhantomData)
    }
}
impl<To, From> Mul<Dir<From>> for Rot<To, From> {
    type Output = Dir<To>;
    fn mul(self, dir: Dir<From>) -> Dir<To> {
        Dir(self.0 * dir.0, PhantomData)
    }
}
impl<To, From> Mul<Pos<From>> for Rot<To, From> {
    type Output = Pos<To>;
    fn mul(self, pos: Pos<From>) -> Pos<To> {
        Pos(self.0 * pos.0, PhantomData)
    }
}

/// Galactic from ICRS axes, by the definition of the Hipparcos catalogue, vol. 1, 1.5.3: north pole at
/// right ascension 192.85948 and declination 27.12825 degrees, ascending node of the galactic plane
/// at galactic longitude 32.93192 degrees. Agrees with the matrix printed there (eq. 1.5.11) to 1e-10.
pub fn galactic_from_icrs() -> Rot<Galactic, Icrs> {
    let [pole_ra, pole_dec, node] = [192.859_48, 27.128_25, 32.931_92].map(Angle::from_deg);
    let quarter = Angle::from_deg(90.0);
    // To the node of the plane on the equator, up to the plane, along it to the centre.
    let matrix =
        turn_axes_z(-node) * turn_axes_x(quarter - pole_dec) * turn_axes_z(pole_ra + quarter);
    Rot::claim(matrix)
}

/// Takes coordinates to axes turned by `angle` about x (the astronomer's `R1`).
pub fn turn_axes_x(angle: Angle) -> DMat3 {
    DMat3::from_rotation_x(-angle.rad())
}
/// Takes coordinates to axes turned by `angle` about y (the astronomer's `R2`).
pub fn turn_axes_y(angle: Angle) -> DMat3 {
    DMat3::from_rotation_y(-angle.rad())
}
/// Takes coordinates to axes turned by `angle` about z (the astronomer's `R3`).
pub fn turn_axes_z(angle: Angle) -> DMat3 {
    DMat3::from_rotation_z(-angle.rad())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuth_runs_from_north_through_east() {
        let east: Dir<Horizon> = Dir::from_azimuth_altitude(Angle::from_deg(90.0), Angle::ZERO);
        assert!(east.vector().abs_diff_eq(DVec3::X, 1e-15));
        let dir: Dir<Horizon> =
            Dir::from_azimuth_altitude(Angle::from_deg(217.0), Angle::from_deg(-12.5));
        assert!((dir.azimuth().deg() - 217.0).abs() < 1e-12);
        assert!((dir.altitude().deg() + 12.5).abs() < 1e-12);
    }

    #[test]
    fn turning_the_axes_turns_coordinates_back() {
        // A point on the y axis lies on the new x axis once the axes have turned by 90 degrees.
        let quarter = Angle::from_deg(90.0);
        assert!((turn_axes_z(quarter) * DVec3::Y).abs_diff_eq(DVec3::X, 1e-15));
        assert!((turn_axes_x(quarter) * DVec3::Z).abs_diff_eq(DVec3::Y, 1e-15));
        assert!((turn_axes_y(quarter) * DVec3::X).abs_diff_eq(DVec3::Z, 1e-15));
    }

    #[test]
    fn the_galaxy_lies_as_hipparcos_says() {
        // Rows of the transpose of its eq. 1.5.11.
        let printed = DMat3::from_cols_array_2d(&[
            [-0.0548755604, 0.4941094279, -0.8676661490],
            [-0.8734370902, -0.4448296300, -0.1980763734],
            [-0.4838350155, 0.7469822445, 0.4559837762],
        ]);
        assert!(galactic_from_icrs().matrix().abs_diff_eq(printed, 1e-9));
        // Sagittarius A*, and Deneb to the left of it along the plane.
        let centre: Dir<Icrs> =
            Dir::from_spherical(Angle::from_deg(266.41684), Angle::from_deg(-29.00781));
        let centre = galactic_from_icrs() * centre;
        assert!((centre.longitude().signed().deg() + 0.0558).abs() < 1e-3);
        assert!((centre.latitude().deg() + 0.0462).abs() < 1e-3);
        let deneb: Dir<Icrs> =
            Dir::from_spherical(Angle::from_deg(310.35798), Angle::from_deg(45.28034));
        let deneb = galactic_from_icrs() * deneb;
        assert!((deneb.longitude().deg() - 84.285).abs() < 0.01);
        assert!((deneb.latitude().deg() - 1.998).abs() < 0.01);
    }

    #[test]
    fn what_is_raised_keeps_its_azimuth() {
        for (azimuth, altitude) in [(10.0, 3.0), (200.0, -40.0), (359.9, 89.999)] {
            let [azimuth, altitude, other] = [azimuth, altitude, 12.5].map(Angle::from_deg);
            let dir: Dir<Horizon> = Dir::from_azimuth_altitude(azimuth, altitude);
            let raised: Dir<Apparent> = dir.raised_to(other);
            assert!((raised.azimuth() - azimuth).signed().abs().rad() < 1e-11);
            assert!((raised.altitude() - other).abs().rad() < 1e-15);
            assert!(raised.raised_to::<Horizon>(altitude).separation(dir).rad() < 1e-15);
        }
        let up: Dir<Horizon> = Dir::from_vector(DVec3::Z);
        assert_eq!(up.raised_to::<Apparent>(Angle::ZERO).azimuth(), Angle::ZERO);
    }

    #[test]
    fn separation_keeps_its_digits_when_small() {
        let a: Dir<Icrs> = Dir::from_spherical(Angle::ZERO, Angle::ZERO);
        let b: Dir<Icrs> = Dir::from_spherical(Angle::from_arcsec(1e-4), Angle::ZERO);
        assert!((a.separation(b).arcsec() - 1e-4).abs() < 1e-12);
    }
}

//! Bodies that show a disc, as the picture needs them.
//!
//! *Theory.* The air keeps radiance and bends light: in each apparent direction the disc is as bright
//! as its surface in the true direction is, times the transmittance. A disc is therefore drawn from the
//! picture back to the body, by nodes across it that give the true altitude and the luminance for an
//! apparent one. Flattening, the light that is lost by it, and the sliver above the horizon follow.
//!
//! *Colour.* Air bends blue light more than red, by 26" at the horizon between 450 and 650 nm: the limb
//! has a green rim above and a red one below. Where that shows, the disc is the sum of several bands of
//! colour, each with its own refraction and its own limb darkening; the bands share the spectrum out
//! so that their sum is the light of a single one. Where it does not show there is one band.

use std::sync::Arc;

use glam::{DMat3, DVec2, DVec3};

use crate::catalog::MoonMap;
use crate::frame::{Apparent, Dir, Horizon, View};
use crate::light::corona;
use crate::light::disc_light::disc_axes;
use crate::units::{Angle, Xyzv};

use super::globe::{CHANNELS, SeenGlobe};
use super::planet::PlanetDisc;

/// Number of altitudes across a disc at which the air is looked through.
pub const NODES: usize = 33;

/// How the light of a disc is spread over it.
#[derive(Debug, Clone, PartialEq)]
pub enum SurfaceLaw {
    /// Shines by itself; `I(mu) / I(1)` is the polynomial with these coefficients.
    Sun { limb_darkening: [f64; 6] },
    /// Lommel and Seeliger's law times the reflectance of the map: for points, a larger Moon is a globe.
    Moon { map: Arc<MoonMap> },
    /// Lambert's law.
    Lambert,
    /// A flattened globe with its own law, and rings.
    Planet(PlanetDisc),
    /// Light around the Sun, over the mean radiance of its disc; dark within.
    Corona,
}

/// Where a body's light falls from, and how it is spread over its disc.
#[derive(Debug, Clone, PartialEq)]
pub struct DiscShape {
    /// Geometric direction of the centre, without air.
    pub centre: Dir<Horizon>,
    pub angular_radius: Angle,
    pub dir_to_sun: Dir<Horizon>,
    /// Takes local axes to the body's own.
    pub body_from_horizon: DMat3,
    pub law: SurfaceLaw,
}

/// The air that a disc is seen through, at one apparent altitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscNode {
    /// True altitude of what is seen there, less that of the centre.
    pub above_centre: Angle,
    /// How much it grows from this node to the next, by its slope here.
    pub rise: Angle,
    /// Luminance of a surface whose shape is one, seen through the air, cd/m2.
    pub luminance: Xyzv,
}

/// A disc in one band of colour.
#[derive(Debug, Clone, PartialEq)]
pub struct DiscBand {
    /// Coefficients of the limb darkening, for the Sun; of the corona its [law](crate::light::corona::law).
    pub limb_darkening: [f64; 6],
    /// Lowest first, at equal steps of the apparent altitude.
    pub nodes: Vec<DiscNode>,
}

/// A disc that is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Disc {
    pub label: &'static str,
    pub shape: DiscShape,
    /// Top left and bottom right corner of the pixels that it can touch.
    pub bounds_px: [[f64; 2]; 2],
    /// Where the lowest node is seen: at the azimuth of the centre, on the lower limb or at the
    /// horizon.
    pub lowest: Dir<Apparent>,
    /// The same direction in the axes of the camera.
    pub lowest_in_view: Dir<View>,
    /// Apparent altitude from one node to the next.
    pub step: Angle,
    /// One, or some from red to blue; their light adds up. Where there is a globe, each in as many parts
    /// as it has channels, one after the other.
    pub bands: Vec<DiscBand>,
    /// Whether the lowest node is where the ground begins.
    pub is_cut_by_horizon: bool,
    /// What its surface looks like, if not like its shape.
    pub globe: Option<SeenGlobe>,
    /// Samples in a pixel: inside the disc, and near its edges.
    pub samples: [Lattice; 2],
    /// How far from an edge the samples are those of the edge, in radii of the disc.
    pub edge: f64,
    /// What stands in front of it: geometric direction and angular radius.
    pub occluder: Option<(Dir<Horizon>, Angle)>,
}

impl Disc {
    /// Bands of light for each band of colour.
    pub fn channels(&self) -> usize {
        if self.globe.is_some() { CHANNELS } else { 1 }
    }
}

/// Points spread evenly over a pixel: the lattice of Fibonacci, in which no two points share a column
/// or a row, so that a level edge is seen in steps of `1 / points`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lattice {
    /// A number of Fibonacci, and the one before it.
    pub points: u32,
    pub turn: u32,
}

/// A point of a disc and its share of the disc's light outside the air; the shares sum to one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscSample {
    pub dir: Dir<Horizon>,
    pub share: f64,
}

impl DiscShape {
    /// How far the body reaches from its middle, radii: more than 1 with rings.
    pub fn reach(&self) -> f64 {
        match &self.law {
            SurfaceLaw::Planet(planet) => planet.reach(),
            _ => 1.0,
        }
    }

    /// The shape of the light at an outward normal of a ball in local axes: the twin of `shape` in
    /// `shaders/discs.wgsl`. Of a planet, what is seen at the same point of the disc.
    pub fn shape(&self, normal: DVec3, cos_emission: f64) -> f64 {
        if let SurfaceLaw::Planet(planet) = &self.law {
            let [level, up, _] = disc_axes(self.centre);
            return planet.shape(DVec2::new(normal.dot(level), normal.dot(up)));
        }
        if let SurfaceLaw::Sun { limb_darkening } = &self.law {
            return limb_darkening.iter().rev().fold(0.0, |sum, a| sum * cos_emission + a);
        }
        if self.law == SurfaceLaw::Corona {
            let sine = (1.0 - cos_emission * cos_emission).max(0.0).sqrt();
            return corona::relative_radiance(sine * corona::OUTER_RADII);
        }
        let cos_incidence = normal.dot(self.dir_to_sun.vector());
        if cos_incidence <= 0.0 {
            return 0.0;
        }
        match &self.law {
            SurfaceLaw::Moon { map } => {
                let lit = cos_incidence / (cos_incidence + cos_emission);
                lit * luminance(map, self.body_from_horizon * normal)
            }
            _ => cos_incidence,
        }
    }

    /// Points spread evenly in solid angle over as much as the body reaches, `rings` rings of them,
    /// with the shape of the light at each.
    fn points(&self, rings: usize) -> Vec<(Dir<Horizon>, f64)> {
        let centre = self.centre.vector();
        let side = centre.any_orthonormal_vector();
        let across = centre.cross(side);
        let sin_radius = self.angular_radius.sin();
        let reach = self.reach();
        let mut points = Vec::with_capacity(3 * rings * rings);
        for ring in 0..rings {
            // Ring `ring` holds 6 ring + 3 points, so that each stands for the same area.
            let radius = (ring as f64 + 0.5) / rings as f64 * reach;
            let count = 6 * ring + 3;
            for step in 0..count {
                let turn = (step as f64 + 0.5) / count as f64 * std::f64::consts::TAU;
                let off_centre = (side * turn.cos() + across * turn.sin()) * radius;
                let cos_emission = (1.0 - radius * radius).max(0.0).sqrt();
                let normal = off_centre - centre * cos_emission;
                let dir = Dir::from_vector(centre + off_centre * sin_radius);
                points.push((dir, self.shape(normal, cos_emission)));
            }
        }
        points
    }

    /// Sum of the shape over all that it reaches, as a mean over the disc of its equator. Zero when
    /// nothing of it is lit.
    pub fn mean(&self) -> f64 {
        // Rings have many edges, a crescent has few points.
        let points = self.points(if matches!(self.law, SurfaceLaw::Planet(_)) { 160 } else { 64 });
        let mean = points.iter().map(|(_, shape)| shape).sum::<f64>() / points.len() as f64;
        mean * self.reach() * self.reach()
    }

    /// The disc as points of light.
    pub fn samples(&self, rings: usize) -> Vec<DiscSample> {
        let points = self.points(rings);
        let sum: f64 = points.iter().map(|(_, shape)| shape).sum();
        points
            .into_iter()
            .filter(|(_, shape)| *shape > 0.0)
            .map(|(dir, shape)| DiscSample { dir, share: shape / sum })
            .collect()
    }

    /// Solid angle of the whole disc without rings, as a ball, steradians.
    pub fn solid_angle_sr(&self) -> f64 {
        // 2 pi (1 - cos r), written so that it keeps its digits for a small disc.
        4.0 * std::f64::consts::PI * (self.angular_radius.rad() / 2.0).sin().powi(2)
    }
}

/// The reflectance at an outward normal in the Moon's own axes, as photopic eyes weigh the three bands
/// (Rec. 709 luminance).
fn luminance(map: &MoonMap, normal: DVec3) -> f64 {
    let longitude = Angle::from_rad(normal.y.atan2(normal.x));
    let latitude = Angle::from_rad(normal.z.atan2(normal.x.hypot(normal.y)));
    let [red, green, blue] = map.reff(longitude, latitude);
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(law: SurfaceLaw, phase_deg: f64) -> DiscShape {
        let centre: Dir<Horizon> =
            Dir::from_azimuth_altitude(Angle::from_deg(90.0), Angle::from_deg(45.0));
        // At phase zero the Sun stands behind the observer.
        let toward = -centre.vector();
        let aside = centre.vector().any_orthonormal_vector();
        let (sin, cos) = Angle::from_deg(phase_deg).sin_cos();
        DiscShape {
            centre,
            angular_radius: Angle::from_arcmin(16.0),
            dir_to_sun: Dir::from_vector(toward * cos + aside * sin),
            body_from_horizon: DMat3::IDENTITY,
            law,
        }
    }

    #[test]
    fn lambert_sphere_has_its_closed_form() {
        // Mean over the disc of a Lambert sphere: 2 / (3 pi) ((pi - a) cos a + sin a).
        for phase_deg in [0.0f64, 40.0, 90.0, 130.0] {
            let a = phase_deg.to_radians();
            let pi = std::f64::consts::PI;
            let exact = 2.0 / (3.0 * pi) * ((pi - a) * a.cos() + a.sin());
            let mean = disc(SurfaceLaw::Lambert, phase_deg).mean();
            assert!((mean - exact).abs() < 2e-3, "{phase_deg}: {mean} {exact}");
        }
    }

    #[test]
    fn full_moon_has_no_limb_darkening() {
        let map = Arc::new(MoonMap { width: 4, height: 2, reff: vec![[1.0; 3]; 8] });
        let shape = disc(SurfaceLaw::Moon { map }, 0.0);
        let samples = shape.samples(16);
        let mean = 1.0 / samples.len() as f64;
        assert!(samples.iter().all(|s| (s.share / mean - 1.0).abs() < 1e-9));
    }

    #[test]
    fn shares_sum_to_one_and_the_lit_side_faces_the_sun() {
        let shape = disc(SurfaceLaw::Lambert, 100.0);
        let samples = shape.samples(16);
        assert!((samples.iter().map(|s| s.share).sum::<f64>() - 1.0).abs() < 1e-12);
        let pull: DVec3 = samples.iter().map(|s| s.dir.vector() * s.share).sum();
        assert!((pull - shape.centre.vector()).dot(shape.dir_to_sun.vector()) > 0.0);
    }
}

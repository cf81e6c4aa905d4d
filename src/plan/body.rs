//! The Sun, the Moon and planets as the camera has them: as a point, a few points, or a disc.

use glam::DMat3;

use crate::air::extinction::transmittance;
use crate::air::refraction::Refraction;
use crate::camera::Camera;
use crate::catalog::{CatalogError, MoonMap};
use crate::ephemeris::Body;
use crate::frame::{Apparent, Dir, Horizon};
use crate::light::night::{LitObject, Night};
use crate::light::sun::LimbDarkening;
use crate::sky::BodyState;
use crate::units::{Angle, Xyzv};

use super::disc::{AlbedoMap, Disc, DiscNode, DiscShape, NODES, SurfaceLaw};

/// A disc smaller than this is a point.
const POINT_PX: f64 = 0.5;
/// A disc smaller than this is a handful of points.
const SMALL_PX: f64 = 8.0;
/// Rings of points in a small disc: 3 n^2 points.
pub const SMALL_DISC_RINGS: usize = 12;
/// Samples across a disc that is just not small; larger ones have more, one a pixel at least.
const SAMPLES_ACROSS: f64 = 48.0;
/// Wavelength whose limb darkening stands for all: near the peak of photopic sight.
const LIMB_NM: f64 = 555.0;
/// Points of the limb that find out where on the picture a disc lies.
const LIMB_POINTS: usize = 64;

/// A body, its light, and the camera that looks at it.
pub struct SeenBody<'a> {
    state: &'a BodyState,
    object: &'a LitObject,
    night: &'a Night,
    camera: &'a Camera,
    refraction: Refraction,
    across_px: f64,
    nodes: Nodes,
}

/// Light of the whole body through the air, by apparent altitude across its disc.
struct Nodes {
    lowest: Angle,
    step: Angle,
    light: [Xyzv; NODES],
}

impl<'a> SeenBody<'a> {
    pub fn of(
        state: &'a BodyState,
        object: &'a LitObject,
        night: &'a Night,
        camera: &'a Camera,
    ) -> SeenBody<'a> {
        let height_m = night.sky.place.height_m;
        let refraction = night.air.refraction_at(height_m);
        let spectrum = night.irradiance(state);
        let pixel_sr = camera
            .pixel_from_apparent(object.apparent)
            .map_or(0.0, |pixel| camera.pixel_solid_angle_sr(pixel));
        // Where the plane has no place for the centre, the scale of the picture's own centre.
        let px_per_rad = if pixel_sr > 0.0 { pixel_sr.sqrt().recip() } else { camera.focal_px() };
        let limb = |sign: f64| {
            let altitude = state.dir.altitude() + state.angular_radius * sign;
            let quarter = std::f64::consts::FRAC_PI_2;
            refraction.apparent_from_true(Angle::from_rad(altitude.rad().clamp(-quarter, quarter)))
        };
        let lowest = limb(-1.0);
        let step = (limb(1.0) - lowest) / (NODES - 1) as f64;
        let light = std::array::from_fn(|node| {
            let altitude = lowest + step * node as f64;
            (spectrum * transmittance(&night.air, height_m, altitude)).xyzv()
        });
        SeenBody {
            across_px: 2.0 * state.angular_radius.rad() * px_per_rad,
            nodes: Nodes { lowest, step, light },
            state,
            object,
            night,
            camera,
            refraction,
        }
    }

    pub fn is_point(&self) -> bool {
        self.across_px < POINT_PX
    }
    pub fn is_small(&self) -> bool {
        self.across_px < SMALL_PX
    }
    pub fn apparent(&self) -> Dir<Apparent> {
        self.object.apparent
    }
    /// Light of the whole body at its centre's altitude, lux.
    pub fn light(&self) -> Xyzv {
        self.object.ground
    }
    pub fn apparent_from_horizon(&self, dir: Dir<Horizon>) -> Dir<Apparent> {
        self.refraction.apparent_from_horizon(dir)
    }

    /// Light of the whole body if all of it stood at this apparent altitude, lux.
    pub fn light_at(&self, altitude: Angle) -> Xyzv {
        let nodes = &self.nodes;
        if nodes.step.rad() <= 0.0 {
            return nodes.light[0];
        }
        let place =
            ((altitude - nodes.lowest).rad() / nodes.step.rad()).clamp(0.0, (NODES - 1) as f64);
        let low = (place as usize).min(NODES - 2);
        let along = place - low as f64;
        nodes.light[low] * (1.0 - along) + nodes.light[low + 1] * along
    }

    /// Whether the Moon stands in front of this direction, and this is not the Moon.
    pub fn is_hidden(&self, dir: Dir<Horizon>) -> bool {
        self.state.body != Body::Moon && self.night.sky.moon.state.covers(dir)
    }

    /// The rectangle of whole pixels that the disc can touch; none when it is out of view.
    pub fn bounds_px(&self) -> Option<[[f64; 2]; 2]> {
        let (width, height) = (f64::from(self.camera.width_px), f64::from(self.camera.height_px));
        let everything = Some([[0.0, 0.0], [width, height]]);
        let centre = self.state.dir.vector();
        let side = centre.any_orthonormal_vector();
        let across = centre.cross(side);
        let (sin_radius, cos_radius) = self.state.angular_radius.sin_cos();
        let (mut first, mut last) = ([f64::MAX; 2], [f64::MIN; 2]);
        for step in 0..LIMB_POINTS {
            let turn = std::f64::consts::TAU * step as f64 / LIMB_POINTS as f64;
            let limb = centre * cos_radius + (side * turn.cos() + across * turn.sin()) * sin_radius;
            let apparent = self.apparent_from_horizon(Dir::from_vector(limb));
            let Some(pixel) = self.camera.pixel_from_apparent(apparent) else {
                // Some of it is where the plane ends. If the centre is too, there is nothing.
                return self.camera.pixel_from_apparent(self.apparent()).and(everything);
            };
            for axis in 0..2 {
                first[axis] = f64::min(first[axis], pixel[axis]);
                last[axis] = f64::max(last[axis], pixel[axis]);
            }
        }
        // Across the seam of a panorama, or around its pole, the limb spans the whole width.
        if self.camera.wrap_px().is_some_and(|wrap| last[0] - first[0] > 0.5 * wrap) {
            return everything;
        }
        let first = [(first[0] - 1.0).floor().max(0.0), (first[1] - 1.0).floor().max(0.0)];
        let last = [(last[0] + 1.0).ceil().min(width), (last[1] + 1.0).ceil().min(height)];
        (first[0] < last[0] && first[1] < last[1]).then_some([first, last])
    }

    /// How the body's light is spread over its disc.
    pub fn shape(
        &self,
        moon_map: impl FnOnce() -> Result<Option<MoonMap>, CatalogError>,
    ) -> Result<DiscShape, CatalogError> {
        let law = match self.state.body {
            Body::Sun => {
                let limb_darkening = LimbDarkening::at_nm(LIMB_NM).coefficients();
                SurfaceLaw::Sun { limb_darkening }
            }
            Body::Moon => match moon_map()? {
                Some(map) => SurfaceLaw::Moon { map: albedo_map(&map) },
                None => SurfaceLaw::Lambert,
            },
            _ => SurfaceLaw::Lambert,
        };
        let body_from_horizon = match self.state.body {
            Body::Moon => self.night.sky.moon.horizon_from_moon_fixed.inverse().matrix(),
            _ => DMat3::IDENTITY,
        };
        Ok(DiscShape {
            centre: self.state.dir,
            angular_radius: self.state.angular_radius,
            dir_to_sun: self.state.dir_to_sun,
            body_from_horizon,
            law,
        })
    }

    /// The disc that the GPU draws.
    pub fn disc(&self, shape: DiscShape, bounds_px: [[f64; 2]; 2]) -> Disc {
        let (mean, solid_angle_sr) = (shape.mean(), shape.solid_angle_sr());
        let nodes = &self.nodes;
        let node = |index: usize| DiscNode {
            geometric_altitude: self
                .refraction
                .true_from_apparent(nodes.lowest + nodes.step * index as f64),
            // Nothing of a new Moon is lit, and nothing of it is drawn.
            luminance: if mean > 0.0 {
                nodes.light[index] * (1.0 / (mean * solid_angle_sr))
            } else {
                Xyzv::BLACK
            },
        };
        let moon = &self.night.sky.moon.state;
        Disc {
            label: self.state.body.name(),
            bounds_px,
            lowest: nodes.lowest,
            step: nodes.step,
            nodes: std::array::from_fn(node),
            samples: ((SAMPLES_ACROSS / self.across_px).ceil() as u32).clamp(2, 8),
            occluder: (self.state.body != Body::Moon).then_some((moon.dir, moon.angular_radius)),
            shape,
        }
    }
}

/// Relative albedo of the Moon, as photopic eyes weigh its three bands (Rec. 709 luminance).
fn albedo_map(map: &MoonMap) -> AlbedoMap {
    let luminance = |[r, g, b]: &[f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    AlbedoMap { width: map.width, albedo: map.reff.iter().map(luminance).collect() }
}

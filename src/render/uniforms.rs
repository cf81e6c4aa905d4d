//! What crosses to the GPU: f64 becomes f32 here and nowhere else. The layouts are those of the
//! structs of the same names in `shaders/`.

use bytemuck::{Pod, Zeroable};
use glam::DMat3;

use crate::air::scattering::PHASE_VALUES;
use crate::camera::{Camera, Projection};
use crate::frame::{Apparent, Dir};
use crate::plan::disc::{Disc, NODES, SurfaceLaw};
use crate::plan::{SKY_SHAPE, SkyPlan, SourceSky};

/// `Camera` of `shaders/lib/camera.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct CameraUniform {
    pub apparent_from_view: [[f32; 4]; 3],
    pub size_px: [f32; 2],
    pub focal_px: f32,
    pub projection: u32,
}

/// `Sky` of `shaders/skylight.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct SkyUniform {
    pub sources: [[f32; 4]; 2],
    pub shines: [u32; 2],
    pub azimuths: u32,
    pub above: u32,
    pub below: u32,
    pub phases: u32,
    pub horizon: f32,
    pub half_pixel: f32,
}

/// `Disc` of `shaders/discs.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct DiscUniform {
    pub first_px: [f32; 2],
    pub last_px: [f32; 2],
    pub centre: [f32; 4],
    pub to_sun: [f32; 4],
    pub body_from_horizon: [[f32; 4]; 3],
    pub limb: [[f32; 4]; 2],
    pub lowest_rad: f32,
    pub step_rad: f32,
    pub samples: u32,
    pub map_width: u32,
    pub occluder: [f32; 4],
    pub luminance: [[f32; 4]; NODES],
    pub geometric_altitude: [[f32; 4]; NODES],
}

/// One instance of `shaders/splats.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct SplatInstance {
    pub centre_px: [f32; 2],
    pub illuminance: [f32; 4],
}

impl CameraUniform {
    pub fn of(camera: &Camera) -> Self {
        CameraUniform {
            apparent_from_view: columns(camera.view_from_apparent().inverse().matrix()),
            size_px: [camera.width_px as f32, camera.height_px as f32],
            focal_px: camera.focal_px() as f32,
            projection: match camera.projection {
                Projection::Perspective => 0,
                Projection::Stereographic => 1,
                Projection::Equidistant => 2,
                Projection::EqualArea => 3,
                Projection::Equirectangular => 4,
            },
        }
    }
}

impl SkyUniform {
    /// Given the height of a pixel, radians.
    pub fn of(sky: &SkyPlan, pixel_rad: f64) -> Self {
        let sources = [&sky.sun, &sky.moon];
        let dir = |source: &SourceSky| -> [f32; 4] {
            let to_source: Dir<Apparent> =
                Dir::from_azimuth_altitude(source.azimuth, source.view.source_elevation);
            direction(to_source, source.azimuth.rad())
        };
        let shines = |source: &SourceSky| if source.view.haze.is_empty() { 1 } else { 2 };
        SkyUniform {
            sources: sources.map(|s| s.as_ref().map_or([0.0; 4], dir)),
            shines: sources.map(|s| s.as_ref().map_or(0, shines)),
            azimuths: SKY_SHAPE.azimuths as u32,
            above: SKY_SHAPE.above as u32,
            below: SKY_SHAPE.below as u32,
            phases: PHASE_VALUES as u32,
            horizon: sky.horizon.rad() as f32,
            half_pixel: (pixel_rad / 2.0) as f32,
        }
    }
}

/// A direction and a number that goes with it.
pub fn direction<F>(dir: Dir<F>, with: f64) -> [f32; 4] {
    let v = dir.vector();
    [v.x as f32, v.y as f32, v.z as f32, with as f32]
}

impl DiscUniform {
    pub fn of(disc: &Disc) -> Self {
        let shape = &disc.shape;
        let pixel = |p: [f64; 2]| p.map(|v| v as f32);
        let with = |v: glam::DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
        let (law, limb, map_width) = match &shape.law {
            SurfaceLaw::Sun { limb_darkening: a } => (0.0, *a, 0),
            SurfaceLaw::Moon { map } => (1.0, [0.0; 6], map.width),
            SurfaceLaw::Lambert => (2.0, [0.0; 6], 0),
        };
        let limb = limb.map(|a| a as f32);
        DiscUniform {
            first_px: pixel(disc.bounds_px[0]),
            last_px: pixel(disc.bounds_px[1]),
            centre: with(shape.centre.vector(), shape.angular_radius.sin()),
            to_sun: with(shape.dir_to_sun.vector(), law),
            body_from_horizon: columns(shape.body_from_horizon),
            limb: [[limb[0], limb[1], limb[2], limb[3]], [limb[4], limb[5], 0.0, 0.0]],
            lowest_rad: disc.lowest.rad() as f32,
            step_rad: disc.step.rad() as f32,
            samples: disc.samples,
            map_width: map_width as u32,
            // A radius of zero hides nothing.
            occluder: disc
                .occluder
                .map_or([0.0; 4], |(dir, radius)| with(dir.vector(), radius.sin())),
            luminance: disc.nodes.map(|node| node.luminance.to_f32()),
            geometric_altitude: disc
                .nodes
                .map(|node| [node.geometric_altitude.rad() as f32, 0.0, 0.0, 0.0]),
        }
    }
}

/// Columns of a 3 x 3 matrix, each padded to 16 bytes as WGSL wants them.
fn columns(m: DMat3) -> [[f32; 4]; 3] {
    [m.x_axis, m.y_axis, m.z_axis].map(|c| [c.x as f32, c.y as f32, c.z as f32, 0.0])
}

//! What crosses to the GPU: f64 becomes f32 here and nowhere else. The layouts are those of the
//! structs of the same names in `shaders/`.

use bytemuck::{Pod, Zeroable};
use glam::DMat3;

use crate::camera::{Camera, Projection};
use crate::plan::SkyPlan;
use crate::plan::disc::{Disc, NODES, SurfaceLaw};
use crate::plan::{SKY_ALTITUDES, SKY_AZIMUTHS};

/// `Camera` of `shaders/lib/camera.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct CameraUniform {
    pub apparent_from_view: [[f32; 4]; 3],
    pub size_px: [f32; 2],
    pub focal_px: f32,
    pub projection: u32,
}

/// `Sky` of `shaders/sky.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct SkyUniform {
    pub source_azimuth: [f32; 2],
    pub source_shines: [u32; 2],
    pub azimuths: u32,
    pub altitudes: u32,
    pub half_pixel: f32,
    pub padding: f32,
    pub ground: [f32; 4],
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
    pub fn of(sky: &SkyPlan, camera: &Camera) -> Self {
        let sources = [&sky.sun, &sky.moon];
        SkyUniform {
            source_azimuth: sources.map(|s| s.as_ref().map_or(0.0, |s| s.azimuth.rad() as f32)),
            source_shines: sources.map(|s| u32::from(s.is_some())),
            azimuths: SKY_AZIMUTHS as u32,
            altitudes: SKY_ALTITUDES as u32,
            half_pixel: (camera.pixel_angle().rad() / 2.0) as f32,
            padding: 0.0,
            ground: sky.ground.to_f32(),
        }
    }
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

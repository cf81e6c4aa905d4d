//! What crosses to the GPU: f64 becomes f32 here and nowhere else. The layouts are those of the
//! structs of the same names in `shaders/`.
//!
//! They are bound as read-only storage: the software driver compiles a shader whose branches hang on
//! a uniform anew for every frame, some 10 ms for the sky.

use bytemuck::{Pod, Zeroable};
use glam::DMat3;

use crate::air::scattering::PHASE_VALUES;
use crate::camera::{Camera, Projection};
use crate::frame::{Apparent, Dir, Horizon};
use crate::light::disc_light::disc_axes;
use crate::plan::disc::{Disc, DiscBand, NODES, SurfaceLaw};
use crate::plan::globe::{EXTENT, Globe, Ground, MeshBand, Shadows};
use crate::plan::{SKY_SHAPE, Side, SkyPlan, SourceSky};

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
    pub lowest_in_view: [f32; 4],
    pub lowest: [f32; 4],
    pub centre: [f32; 4],
    pub to_sun: [f32; 4],
    pub body_from_disc: [[f32; 4]; 3],
    pub occluder: [f32; 4],
    pub samples: [u32; 4],
    pub per_step: f32,
    pub edge: f32,
    pub bands: u32,
    pub map_width: u32,
}

/// `Band` of `shaders/discs.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct DiscBandUniform {
    pub limb: [[f32; 4]; 2],
    pub luminance: [[f32; 4]; NODES],
    pub above_centre: [[f32; 4]; NODES],
}

/// `Globe` of `shaders/globe.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct GlobeUniform {
    pub body_from_disc: [[f32; 4]; 3],
    pub body_from_sun: [[f32; 4]; 3],
    pub distance: f32,
    pub extent: f32,
    pub first_shadow: f32,
    pub last_shadow: f32,
    pub darkness: [f32; 4],
    pub sun: [f32; 4],
    pub earth: [f32; 4],
}

/// `MeshBand` of `shaders/globe.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct MeshBandUniform {
    pub first: f32,
    pub last: f32,
    pub rings: u32,
    pub sectors: u32,
}

/// `Mean` of `shaders/globe_mean.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct MeanUniform {
    pub pixel_share: f32,
    pub tiles: u32,
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
        let sources = sky.sources();
        let dir = |source: &SourceSky| -> [f32; 4] {
            let to_source: Dir<Apparent> =
                Dir::from_azimuth_altitude(source.azimuth, source.view.source_elevation);
            direction(to_source, source.azimuth.rad())
        };
        let shines = |source: &SourceSky, side: Side| {
            let of_side = match side {
                Side::Both => 0,
                Side::Clockwise => 4,
                Side::Other => 8,
            };
            of_side + if source.view.haze.is_empty() { 1 } else { 2 }
        };
        SkyUniform {
            sources: sources.map(|s| s.map_or([0.0; 4], |(s, _)| dir(s))),
            shines: sources.map(|s| s.map_or(0, |(s, side)| shines(s, side))),
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

/// Of the tiles that a globe is drawn in: edge in pixels, columns and rows.
pub fn globe_tiles(disc: &Disc) -> [u32; 3] {
    let [first, last] = disc.bounds_px;
    let of_frame = |globe: &Globe| f64::from(globe.picture_px) / f64::from(globe.fineness);
    let radius_px = disc.globe.as_ref().map_or(1.0, |globe| 0.5 * of_frame(globe));
    // Straight across a tile, a point of the disc is off by a twentieth of a pixel.
    let tile_px = (0.4 * radius_px).sqrt().clamp(4.0, 32.0).floor();
    let [columns, rows] =
        [0, 1].map(|axis| ((last[axis] - first[axis]) / tile_px).ceil().max(0.0) as u32);
    [tile_px as u32, columns, rows]
}

impl GlobeUniform {
    pub fn of(globe: &Globe) -> Self {
        GlobeUniform {
            body_from_disc: columns(globe.body_from_disc),
            body_from_sun: columns(globe.shadows.body_from_sun),
            distance: globe.distance as f32,
            extent: EXTENT as f32,
            first_shadow: Shadows::FIRST.rad() as f32,
            last_shadow: Shadows::LAST.rad() as f32,
            darkness: darkness(&globe.ground),
            sun: globe.shadow.as_ref().map_or([0.0; 4], |s| with(s.to_sun, s.rim.rad())),
            earth: globe
                .shadow
                .as_ref()
                .map_or([0.0; 4], |s| with(s.to_earth, s.to_earth.length())),
        }
    }
}

/// Mean single-scattering albedo over that at 566 nm, at 643, 566 and 415 nm.
fn darkness(ground: &Ground) -> [f32; 4] {
    let sum = |band: usize| ground.cells.iter().map(|cell| cell[band].w).sum::<f64>();
    let green = sum(1);
    let ratio = |band| if green > 0.0 { (sum(band) / green) as f32 } else { 1.0 };
    [ratio(2), 1.0, ratio(0), 0.0]
}

impl MeshBandUniform {
    pub fn of(band: &MeshBand) -> Self {
        let rad = |deg: u32| f64::from(deg).to_radians() as f32;
        MeshBandUniform {
            first: rad(band.from_deg),
            last: rad(band.to_deg),
            rings: band.rings,
            sectors: band.sectors,
        }
    }
}

impl DiscUniform {
    pub fn of(disc: &Disc) -> Self {
        let shape = &disc.shape;
        let pixel = |p: [f64; 2]| p.map(|v| v as f32);
        let (law, map_width) = match &shape.law {
            SurfaceLaw::Sun { .. } => (0.0, 0),
            SurfaceLaw::Moon { map } => (1.0, map.width),
            SurfaceLaw::Lambert => (2.0, 0),
            SurfaceLaw::Corona => (3.0, 0),
        };
        let horizon_from_disc = DMat3::from_cols_array_2d(&disc_axes(shape.centre).map(Into::into));
        let in_disc = |dir: Dir<Horizon>| horizon_from_disc.transpose() * dir.vector();
        let (view, lowest) = (disc.lowest_in_view.vector(), disc.lowest.vector());
        let (sin, cos) = shape.centre.altitude().sin_cos();
        let sin_radius = shape.angular_radius.sin();
        let samples = match &disc.globe {
            Some(globe) => {
                let [tile_px, columns, _] = globe_tiles(disc);
                [tile_px, columns, globe.fineness, u32::from(disc.is_cut_by_horizon)]
            }
            None => {
                let [inside, edge] = disc.samples;
                [inside.points, inside.turn, edge.points, edge.turn]
            }
        };
        DiscUniform {
            first_px: pixel(disc.bounds_px[0]),
            last_px: pixel(disc.bounds_px[1]),
            // One less the cosine of the angle from the axis keeps its digits, the cosine does not.
            lowest_in_view: with(glam::DVec3::new(view.x, view.y, 1.0 + view.z), 0.0),
            lowest: with(lowest, lowest.x.hypot(lowest.y)),
            centre: [sin as f32, cos as f32, sin_radius as f32, EXTENT as f32],
            to_sun: with(in_disc(shape.dir_to_sun), law),
            body_from_disc: columns(shape.body_from_horizon * horizon_from_disc),
            // A chord of zero hides nothing.
            occluder: disc.occluder.map_or([0.0; 4], |(dir, radius)| {
                let at = in_disc(dir);
                let chord = 2.0 * (radius.rad() / 2.0).sin();
                with(glam::DVec3::new(at.x, at.y, 1.0 - at.z), chord)
            }),
            samples,
            per_step: (1.0 / disc.step.rad()) as f32,
            edge: disc.edge as f32,
            bands: (disc.bands.len() / disc.channels()) as u32,
            map_width: map_width as u32,
        }
    }
}

impl DiscBandUniform {
    pub fn of(band: &DiscBand) -> Self {
        let limb = band.limb_darkening.map(|a| a as f32);
        let node = |at: usize| &band.nodes[at];
        DiscBandUniform {
            limb: [[limb[0], limb[1], limb[2], limb[3]], [limb[4], limb[5], 0.0, 0.0]],
            luminance: std::array::from_fn(|at| node(at).luminance.to_f32()),
            above_centre: std::array::from_fn(|at| {
                [node(at).above_centre.rad() as f32, node(at).rise.rad() as f32, 0.0, 0.0]
            }),
        }
    }
}

fn with(v: glam::DVec3, w: f64) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w as f32]
}

/// Columns of a 3 x 3 matrix, each padded to 16 bytes as WGSL wants them.
fn columns(m: DMat3) -> [[f32; 4]; 3] {
    [m.x_axis, m.y_axis, m.z_axis].map(|c| [c.x as f32, c.y as f32, c.z as f32, 0.0])
}

//! What crosses to the GPU: f64 becomes f32 here and nowhere else. The layouts are those of the
//! structs of the same names in `shaders/`.
//!
//! They are bound as read-only storage: the software driver compiles a shader whose branches hang on
//! a uniform anew for every frame, some 10 ms for the sky. It reads storage slowly, lane by lane, so that
//! what is read for every pixel and never branched on is a uniform: that of the globe.

use bytemuck::{Pod, Zeroable};
use glam::{DMat3, DVec2, DVec3};

use crate::air::scattering::PHASE_VALUES;
use crate::camera::{Camera, Projection};
use crate::display::Display;
use crate::frame::{Apparent, Dir, Horizon};
use crate::light::belts;
use crate::light::disc_light::disc_axes;
use crate::light::limb_law::{LIMB_COSINE, LimbLaw};
use crate::light::saturn_rings::RINGS;
use crate::photo::exposure::Exposure;
use crate::photo::lens::Spike;
use crate::plan::disc::{Disc, DiscBand, NODES, SurfaceLaw};
use crate::plan::globe::Globe;
use crate::plan::globe::mesh::MeshBand;
use crate::plan::near::{Near, NearBand};
use crate::plan::planet::PlanetDisc;
use crate::plan::{DARK_AZIMUTHS, SKY_SHAPE, Side, SkyPlan, SourceSky};
use crate::units::Angle;

use super::picture::Depth;

/// `Camera` of `shaders/lib/camera.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct CameraUniform {
    pub apparent_from_view: [[f32; 4]; 3],
    pub size_px: [f32; 2],
    pub focal_px: f32,
    pub projection: u32,
}

/// `DisplayRows` of `shaders/eye.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct DisplayUniform {
    pub rows: [[f32; 4]; 3],
}

impl DisplayUniform {
    /// With the matrix that takes X, Y and Z as they are seen to linear RGB.
    pub fn of(display: &Display, rgb_from_seen: DMat3) -> DisplayUniform {
        let luminance = display.rgb_from_xyz().inverse().row(1);
        DisplayUniform {
            rows: [0, 1, 2].map(|primary| {
                let row = rgb_from_seen.row(primary);
                [row.x, row.y, row.z, luminance[primary]].map(|v| v as f32)
            }),
        }
    }
}

/// Values for the constants that `shaders/lib/display.wgsl` leaves open.
pub fn picture_constants(display: &Display, depth: Depth) -> [(&'static str, f64); 2] {
    let (is_encoded, steps) = match depth {
        Depth::Codes => (display.space.is_encoded(), if display.dither { 255.0 } else { 0.0 }),
        Depth::Linear => (false, 0.0),
    };
    [("IS_ENCODED", f64::from(u8::from(is_encoded))), ("CODE_STEPS", steps)]
}

/// `Setting` of `shaders/photo.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct PhotoUniform {
    pub balanced_from_xyz: [[f32; 4]; 3],
    pub rgb_from_balanced: [[f32; 4]; 3],
    pub luminance_from_balanced: [f32; 3],
    pub natural: f32,
    pub shot: [f32; 3],
    pub mechanical_root: f32,
    pub read: [f32; 3],
    pub seed: u32,
    pub luminance_from_rgb: [f32; 3],
    pub pad: f32,
    pub centre_px: [f32; 2],
    pub end: [f32; 2],
}

impl PhotoUniform {
    pub fn of(exposure: &Exposure, display: &Display) -> PhotoUniform {
        let [width, height] = exposure.size_px;
        let falloff = exposure.falloff;
        let to_corner = (width * width + height * height) / 4.0;
        let balance = exposure.balance;
        let rgb_from_balanced = display.rgb_from_xyz() * exposure.xyz_from_balanced;
        let luminance_from_rgb = display.rgb_from_xyz().inverse().row(1);
        let triple = |v: DVec3| v.as_vec3().to_array();
        PhotoUniform {
            balanced_from_xyz: columns(DMat3::from_diagonal(balance) * exposure.raw_from_xyz),
            rgb_from_balanced: columns(rgb_from_balanced),
            luminance_from_balanced: triple(exposure.xyz_from_balanced.row(1)),
            natural: (falloff.natural / (exposure.focal_px * exposure.focal_px)) as f32,
            shot: triple(balance * exposure.shot),
            mechanical_root: (falloff.mechanical.sqrt() / to_corner) as f32,
            read: triple(balance * balance * exposure.read),
            seed: exposure.seed,
            luminance_from_rgb: triple(luminance_from_rgb),
            pad: 0.0,
            centre_px: [(width / 2.0) as f32, (height / 2.0) as f32],
            end: [0.0; 2],
        }
    }
}

/// `Spike` of `shaders/spikes.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct SpikeInstance {
    pub centre_px: [f32; 2],
    pub direction: [f32; 2],
    pub half_size_px: [f32; 2],
    pub amplitude: [f32; 4],
}

impl SpikeInstance {
    pub fn of(spike: &Spike) -> SpikeInstance {
        let pair = |pair: [f64; 2]| pair.map(|v| v as f32);
        SpikeInstance {
            centre_px: pair(spike.centre_px),
            direction: pair(spike.direction),
            half_size_px: pair([spike.half_length_px, spike.half_width_px]),
            amplitude: spike.amplitude.to_f32(),
        }
    }
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
    pub dark_azimuths: u32,
    pub middle_over: f32,
    pub over_right: f32,
    pub over_down: f32,
}

/// `Corner` of `shaders/milky_way.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct MilkyWayCorner {
    pub pixel: [f32; 2],
    pub dir: [f32; 3],
    pub blue: [f32; 4],
    pub red: [f32; 4],
    pub over: f32,
}

impl MilkyWayCorner {
    /// Where there is no sky.
    pub fn black(pixel: [f64; 2]) -> MilkyWayCorner {
        let pixel = pixel.map(|v| v as f32);
        MilkyWayCorner { pixel, dir: [0.0, 0.0, 1.0], blue: [0.0; 4], red: [0.0; 4], over: -1.0 }
    }
}

/// `Step` of `shaders/pyramid.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct PyramidStepUniform {
    pub share: f32,
    pub coarser: f32,
    pub level: f32,
    pub in_place: f32,
    pub within: [[f32; 4]; 2],
}

/// `Retina` of `shaders/lib/retina.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct RetinaUniform {
    pub in_place: f32,
    pub spread: f32,
    pub size_px: [f32; 2],
    pub soft_scale: [f32; 2],
    pub around_scale: [f32; 2],
}

/// `Grain` of `shaders/eye.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct GrainUniform {
    pub place: [f32; 2],
    pub size_px: f32,
    pub strength: f32,
}

/// `Halo` of `shaders/points.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct HaloUniform {
    pub rows_per_octave: f32,
    pub first_log2_px: f32,
    pub rows: f32,
    pub pad: f32,
}

/// `Flare` of `shaders/flare.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct FlareUniform {
    pub radius_px: f32,
    pub pad: [f32; 7],
}

/// A point with a flare for `shaders/flare.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct FlareInstance {
    pub centre_px: [f32; 2],
    pub radius_px: f32,
    pub illuminance: [f32; 4],
}

/// `Level` of `shaders/point_light.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct LevelUniform {
    pub size: [f32; 2],
    pub scale: f32,
    pub per_lux: f32,
}

/// A point of light for `shaders/points.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct PointInstance {
    pub centre_px: [f32; 2],
    pub colour: [f32; 3],
    pub illuminance: f32,
    pub parts: [f32; 2],
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
    pub occluder: [f32; 4],
    pub samples: [u32; 4],
    pub per_step: f32,
    pub edge: f32,
    pub north: [f32; 2],
    pub bands: u32,
    pub pad: [u32; 3],
}

/// `Band` of `shaders/discs.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct DiscBandUniform {
    pub limb: [[f32; 4]; 2],
    pub luminance: [[f32; 4]; NODES],
    pub above_centre: [[f32; 4]; NODES],
}

/// `Near` of `shaders/lib/disc_near.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct NearUniform {
    pub anchor_px: [f32; 2],
    pub place: f32,
    pub pixel: f32,
    pub place_gain: [f32; 2],
    pub place_bend: [f32; 3],
    pub texels: f32,
    pub outline_steps: f32,
    pub radius: f32,
    pub first: [f32; 2],
    pub pad: [f32; 2],
    pub shift: [[f32; 4]; 2],
    pub outline: [f32; 260],
}

/// `NearBand` of `shaders/lib/disc_near.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct NearBandUniform {
    pub at: [f32; 2],
    pub over: f32,
    pub beside: f32,
    pub right: [f32; 2],
    pub down: [f32; 2],
    pub bend_xx: [f32; 2],
    pub bend_xy: [f32; 2],
    pub bend_yy: [f32; 2],
    pub from_occluder: [f32; 2],
    pub texel: [i32; 2],
    pub texel_part: [f32; 2],
    pub from_first: [f32; 2],
}

/// `Ring` of `shaders/planet.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
pub struct RingUniform {
    pub inner: f32,
    pub outer: f32,
    pub brightness: f32,
    pub to_observer: f32,
    pub from_sun: f32,
    pub padding: [f32; 3],
}

/// `Planet` of `shaders/planet.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct PlanetUniform {
    pub pole: [f32; 4],
    pub albedo: f32,
    pub exponent: f32,
    pub limb_cosine: f32,
    pub reach: f32,
    pub ring_count: u32,
    pub is_lommel_seeliger: u32,
    pub belt_count: u32,
    pub belt_edge: f32,
    pub belts: [[f32; 4]; belts::JUPITER.len()],
    pub rings: [RingUniform; RINGS.len()],
}

/// `Globe` of `shaders/globe.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct GlobeUniform {
    pub body_from_picture: [[f32; 4]; 3],
    pub body_from_sun: [[f32; 4]; 3],
    pub observer: [f32; 4],
    pub sun: [f32; 4],
    pub earth: [f32; 4],
    pub alike: [f32; 4],
}

/// `MeshBand` of `shaders/globe.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub struct MeshBandUniform {
    pub first: f32,
    pub last: f32,
    pub rings: u32,
    pub sectors: u32,
    pub is_skirt: u32,
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
    /// For a camera, or for directions alone.
    pub fn of(sky: &SkyPlan, camera: Option<&Camera>) -> Self {
        let pixel_rad = camera.map_or(0.0, |camera| camera.pixel_angle().rad());
        let [middle_over, over_right, over_down] =
            camera.and_then(|camera| over_horizon_px(sky, camera)).unwrap_or_default();
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
            dark_azimuths: DARK_AZIMUTHS as u32,
            middle_over: middle_over as f32,
            over_right: over_right as f32,
            over_down: over_down as f32,
        }
    }
}

/// On a narrow picture on which the horizon is, how high over it the middle is and what a pixel gains to the
/// right and down, pixels.
fn over_horizon_px(sky: &SkyPlan, camera: &Camera) -> Option<[f64; 3]> {
    if camera.field_of_view >= Near::WIDEST {
        return None;
    }
    let middle = [camera.width_px, camera.height_px].map(|px| 0.5 * f64::from(px));
    let apparent_from_view = camera.view_from_apparent().inverse();
    let over = |right: f64, down: f64| {
        let view = camera.view_from_pixel([middle[0] + right, middle[1] + down])?;
        let over = (apparent_from_view * view).altitude() - sky.horizon;
        Some(over.rad() / camera.pixel_angle().rad())
    };
    let here = over(0.0, 0.0)?;
    let gain = |right: f64, down: f64, px: f64| {
        Some((over(right * px, down * px)? - over(-right * px, -down * px)?) / (2.0 * px))
    };
    let gains = [here, gain(1.0, 0.0, middle[0])?, gain(0.0, 1.0, middle[1])?];
    let reach = gains[1].abs() * middle[0] + gains[2].abs() * middle[1];
    // Elsewhere 32 bits are enough.
    (here.abs() < 2.0 * reach).then_some(gains)
}

/// A direction and a number that goes with it.
pub fn direction<F>(dir: Dir<F>, with: f64) -> [f32; 4] {
    let v = dir.vector();
    [v.x as f32, v.y as f32, v.z as f32, with as f32]
}

/// The square tiles that a globe is drawn in.
pub struct GlobeTiles {
    pub first_px: [f64; 2],
    pub edge_px: u32,
    pub columns: u32,
    pub rows: u32,
}

impl GlobeTiles {
    /// How far a point of the disc may be off where it is taken straight across a tile, pixels.
    const ERROR_PX: f64 = 0.03;
    /// Blocks that the software driver shades as one.
    const BLOCK_PX: f64 = 8.0;
    const LARGEST_PX: f64 = 64.0;

    pub fn of(disc: &Disc) -> GlobeTiles {
        let px_per_rad = match &disc.globe {
            Some(globe) => globe.radius_px / disc.shape.angular_radius.rad(),
            None => 1.0,
        };
        // Meridians draw together, and refraction bends what is low: both per radian.
        let converging = disc.shape.centre.altitude().rad().tan().abs();
        let step = disc.step.rad();
        let bends = disc.bands.iter().flat_map(|band| band.nodes.windows(3)).map(|nodes| {
            let [low, middle, high] = [0, 1, 2].map(|node: usize| nodes[node].above_centre.rad());
            (high - 2.0 * middle + low).abs() / (step * step)
        });
        let bend = bends.fold(1.0 + converging, f64::max);
        let edge_px = (8.0 * GlobeTiles::ERROR_PX * px_per_rad / bend).sqrt();
        let edge_px = edge_px.clamp(GlobeTiles::BLOCK_PX, GlobeTiles::LARGEST_PX);
        let edge_px = (edge_px / GlobeTiles::BLOCK_PX).floor() * GlobeTiles::BLOCK_PX;
        let [first, last] = disc.bounds_px;
        let first_px = first.map(|px| (px / GlobeTiles::BLOCK_PX).floor() * GlobeTiles::BLOCK_PX);
        let [columns, rows] =
            [0, 1].map(|axis| ((last[axis] - first_px[axis]) / edge_px).ceil().max(0.0) as u32);
        GlobeTiles { first_px, edge_px: edge_px as u32, columns, rows }
    }
}

impl GlobeUniform {
    pub fn of(globe: &Globe) -> Self {
        let view = &globe.view;
        GlobeUniform {
            body_from_picture: columns(view.body_from_picture()),
            body_from_sun: columns(globe.shadows.body_from_sun),
            observer: with(view.to_observer * view.distance, view.distance),
            sun: view.shadow.as_ref().map_or([0.0; 4], |s| with(s.to_sun, s.rim.rad())),
            earth: view.shadow.as_ref().map_or([0.0; 4], |s| with(s.to_earth, s.to_earth.length())),
            alike: [view.hidden_alike() as f32, 0.0, 0.0, 0.0],
        }
    }
}

impl MeshBandUniform {
    pub fn of(band: &MeshBand) -> Self {
        let rad = |deg: u32| f64::from(deg).to_radians() as f32;
        MeshBandUniform {
            first: rad(band.from_deg),
            last: rad(band.to_deg),
            rings: band.rings,
            sectors: band.sectors,
            is_skirt: u32::from(band.is_skirt),
        }
    }
}

impl DiscUniform {
    pub fn of(disc: &Disc) -> Self {
        let shape = &disc.shape;
        let pixel = |p: [f64; 2]| p.map(|v| v as f32);
        let tiles = disc.globe.as_ref().map(|globe| (globe, GlobeTiles::of(disc)));
        let first_px = tiles.as_ref().map_or(disc.bounds_px[0], |(_, tiles)| tiles.first_px);
        let law = match &shape.law {
            SurfaceLaw::Sun { .. } => 0.0,
            // A Moon that shows a disc is a globe, whose own picture is what is drawn.
            SurfaceLaw::Moon { .. } | SurfaceLaw::Lambert => 2.0,
            SurfaceLaw::Corona => 3.0,
            // In `shaders/planet.wgsl`.
            SurfaceLaw::Planet(_) => 4.0,
        };
        let horizon_from_disc = DMat3::from_cols_array_2d(&disc_axes(shape.centre).map(Into::into));
        let in_disc = |dir: Dir<Horizon>| horizon_from_disc.transpose() * dir.vector();
        let (view, lowest) = (disc.lowest_in_view.vector(), disc.lowest.vector());
        let (sin, cos) = shape.centre.altitude().sin_cos();
        let sin_radius = shape.angular_radius.sin();
        let north = disc.globe.as_ref().map_or(Angle::ZERO, |globe| globe.north);
        let (sin_north, cos_north) = north.sin_cos();
        let samples = match &tiles {
            Some((globe, tiles)) => {
                let is_cut = u32::from(disc.is_cut_by_horizon);
                [tiles.edge_px, tiles.columns, globe.fineness(), is_cut]
            }
            None => {
                let [inside, edge] = disc.samples;
                [inside.points, inside.turn, edge.points, edge.turn]
            }
        };
        DiscUniform {
            first_px: pixel(first_px),
            last_px: pixel(disc.bounds_px[1]),
            // One less the cosine of the angle from the axis keeps its digits, the cosine does not.
            lowest_in_view: with(glam::DVec3::new(view.x, view.y, 1.0 + view.z), 0.0),
            lowest: with(lowest, lowest.x.hypot(lowest.y)),
            centre: [sin as f32, cos as f32, sin_radius as f32, 0.0],
            to_sun: with(in_disc(shape.dir_to_sun), law),
            // A chord of zero hides nothing.
            occluder: disc.occluder.map_or([0.0; 4], |(dir, radius)| {
                let at = in_disc(dir);
                let chord = 2.0 * (radius.rad() / 2.0).sin();
                with(glam::DVec3::new(at.x, at.y, 1.0 - at.z), chord)
            }),
            samples,
            per_step: (1.0 / disc.step.rad()) as f32,
            edge: disc.edge as f32,
            north: [sin_north as f32, cos_north as f32],
            bands: (disc.bands.len() / disc.channels()) as u32,
            pad: [0; 3],
        }
    }
}

impl NearUniform {
    pub fn of(near: &Near) -> Self {
        let [right, down, bends @ ..] = near.place.gains.map(|v| v as f32);
        let mut uniform = NearUniform {
            anchor_px: near.anchor_px.map(|v| v as f32),
            place: near.place.middle as f32,
            pixel: near.pixel as f32,
            place_gain: [right, down],
            place_bend: bends,
            ..Zeroable::zeroed()
        };
        if let Some(globe) = &near.globe {
            let first = globe.turned[0];
            uniform.texels = globe.texels_per_radius as f32;
            uniform.outline_steps = globe.outline_steps as f32;
            uniform.radius = first.length() as f32;
            uniform.first = pair(first);
            uniform.shift = [with(globe.shift[0], globe.growth), with(globe.shift[1], 0.0)];
            for (node, outline) in uniform.outline.iter_mut().zip(&globe.outline) {
                *node = *outline as f32;
            }
        }
        uniform
    }
}

impl NearBandUniform {
    /// Those of a disc, one for each of its bands.
    pub fn all(near: &Near) -> Vec<Self> {
        let band = |(number, band): (usize, &NearBand)| {
            let globe = near.globe.as_ref();
            let (texel, texel_part) = globe.map_or(([0.0; 2], DVec2::ZERO), |g| g.texels[number]);
            let from_first = globe.map_or(DVec2::ZERO, |g| g.turned[number] - g.turned[0]);
            let [right, down, bend_xx, bend_xy, bend_yy] = band.at.gains.map(pair);
            NearBandUniform {
                at: pair(band.at.middle),
                over: band.over as f32,
                beside: band.beside as f32,
                right,
                down,
                bend_xx,
                bend_xy,
                bend_yy,
                from_occluder: pair(band.from_occluder),
                texel: texel.map(|v| v as i32),
                texel_part: pair(texel_part),
                from_first: pair(from_first),
            }
        };
        near.bands.iter().enumerate().map(band).collect()
    }
}

impl PlanetUniform {
    pub fn of(planet: &PlanetDisc) -> Self {
        let (exponent, is_lommel_seeliger) = match planet.law {
            LimbLaw::LommelSeeliger => (1.0, 1),
            LimbLaw::Minnaert { exponent } => (exponent, 0),
        };
        let mut rings = [RingUniform::default(); RINGS.len()];
        for (uniform, ring) in rings.iter_mut().zip(&planet.rings) {
            *uniform = RingUniform {
                inner: ring.inner as f32,
                outer: ring.outer as f32,
                brightness: ring.brightness as f32,
                to_observer: ring.to_observer as f32,
                from_sun: ring.from_sun as f32,
                padding: [0.0; 3],
            };
        }
        let mut belts = [[0.0; 4]; belts::JUPITER.len()];
        for (uniform, belt) in belts.iter_mut().zip(planet.belts) {
            let [south, north] = belt.sines().map(|sine| sine as f32);
            *uniform = [south, north, belt.depth as f32, 0.0];
        }
        PlanetUniform {
            pole: with(planet.pole, planet.polar_ratio),
            albedo: planet.albedo as f32,
            exponent: exponent as f32,
            limb_cosine: LIMB_COSINE as f32,
            reach: planet.reach() as f32,
            ring_count: planet.rings.len() as u32,
            is_lommel_seeliger,
            belt_count: planet.belts.len() as u32,
            belt_edge: belts::EDGE as f32,
            belts,
            rings,
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

fn pair(v: DVec2) -> [f32; 2] {
    [v.x as f32, v.y as f32]
}

fn with(v: glam::DVec3, w: f64) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w as f32]
}

/// Columns of a 3 x 3 matrix, each padded to 16 bytes as WGSL wants them.
fn columns(m: DMat3) -> [[f32; 4]; 3] {
    [m.x_axis, m.y_axis, m.z_axis].map(|c| [c.x as f32, c.y as f32, c.z as f32, 0.0])
}

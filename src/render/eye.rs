//! The picture that an eye sees: what the retina gets of the frame, through the tables of
//! [`Seeing`](crate::eye::seeing::Seeing), and the points of light that are not in it.

use std::sync::{Mutex, PoisonError};

use half::f16;

use crate::camera::Camera;
use crate::display::{ColourSpace, Display};
use crate::eye::Eye;
use crate::eye::foveal::{Foveal, View};
use crate::eye::glare::pyramid::finest_spread;
use crate::eye::glare::{Flare, Halo, flare, point};
use crate::eye::light_table;
use crate::eye::seeing::{Seeing, SeenPoint};
use crate::image::HdrFrame;
use crate::plan::Splat;
use crate::units::Angle;

use super::eye_tiles::{EyeTiles, Tile};
use super::gpu::{FRAME_FORMAT, Gpu, GpuError, Stage};
use super::picture::{Depth, PictureTarget};
use super::pyramid::{Pyramid, PyramidPass, Screen, Up, tile_layout};
use super::shaders;
use super::target::Target;
use super::uniforms::{
    DisplayUniform, FlareInstance, FlareUniform, GrainUniform, HaloUniform, LevelUniform,
    PointInstance, RetinaUniform, SplatInstance, picture_constants,
};

/// Edge of the picture of noise, texels; `shaders/eye.wgsl` knows it too.
pub const NOISE_PX: u32 = 256;
/// The grain is as fine as what a dark-adapted eye resolves, and no finer than a pixel.
const GRAIN: Angle = Angle::from_arcmin(5.0);
/// Root of the luminance at which counts vary by as much as their mean, cd/m2.
const GRAIN_STRENGTH: f32 = 0.004;

pub struct EyePass {
    pyramid: PyramidPass,
    point_light: wgpu::RenderPipeline,
    repeated: wgpu::Sampler,
    /// Goes round from the right edge to the left.
    turning: wgpu::Sampler,
    /// Made when first asked for, by what the picture is made of.
    pipelines: Mutex<Vec<(Kind, Pipelines)>>,
    /// The textures of the last size.
    kept: Mutex<Option<Pyramid>>,
    /// The grain of the last seed.
    noise: Mutex<Option<(Option<u64>, wgpu::TextureView)>>,
}

/// What the shaders are made for.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Kind {
    depth: Depth,
    space: ColourSpace,
    /// Of [`picture_constants`].
    constants: [(&'static str, f64); 2],
    is_red: bool,
    has_grain: bool,
}

#[derive(Clone)]
struct Pipelines {
    plain: wgpu::RenderPipeline,
    sharp: wgpu::RenderPipeline,
    soft: wgpu::RenderPipeline,
    points: wgpu::RenderPipeline,
    flares: wgpu::RenderPipeline,
}

/// What is drawn, and how.
pub struct Scene<'a> {
    pub eye: &'a Eye,
    pub display: &'a Display,
    pub camera: &'a Camera,
    pub points: &'a [Splat],
}

/// One picture on its way.
struct Work<'a> {
    scene: &'a Scene<'a>,
    seeing: &'a Seeing,
    pyramid: &'a Pyramid,
    pipelines: Pipelines,
    picture: &'a PictureTarget,
    retina: RetinaUniform,
    screen: Screen,
    levels_resolved: wgpu::TextureView,
    /// Between pixels, as they appear.
    pixel: Angle,
}

impl EyePass {
    pub fn new(gpu: &Gpu) -> EyePass {
        let instance = wgpu::VertexBufferLayout {
            array_stride: size_of::<SplatInstance>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x4],
        };
        EyePass {
            pyramid: PyramidPass::new(gpu),
            point_light: gpu.chain_pipeline(&Stage {
                label: "light of points",
                source: shaders::assembled("point-light"),
                entries: ["vertex", "fragment"],
                constants: &[],
                targets: &[FRAME_FORMAT],
                buffers: &[Some(instance)],
                adds: true,
            }),
            repeated: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                address_mode_u: wgpu::AddressMode::Repeat,
                address_mode_v: wgpu::AddressMode::Repeat,
                mag_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
            turning: gpu.linear_sampler(wgpu::AddressMode::Repeat),
            pipelines: Mutex::default(),
            kept: Mutex::default(),
            noise: Mutex::default(),
        }
    }

    /// Makes the picture of a frame; the points apart are not in the frame.
    pub fn picture(
        &self,
        frame: &mut Target,
        scene: &Scene,
        picture: &PictureTarget,
    ) -> Result<Seeing, GpuError> {
        let gpu = frame.gpu;
        let camera = scene.camera;
        let size_px = [camera.width_px, camera.height_px];
        // A poisoned lock holds whole textures or none.
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let pyramid = match kept.take() {
            Some(pyramid) if pyramid.size_px() == size_px => kept.insert(pyramid),
            _ => kept.insert(Pyramid::new(gpu, size_px)),
        };
        let view = View::new(size_px, camera.pixel_angle());
        let with_points = match scene.points.is_empty() {
            true => None,
            false => Some(point::wide_level(view.pixel, pyramid.len())).filter(|level| *level > 0),
        };
        let joined = with_points.unwrap_or(pyramid.len());
        self.pyramid.down(frame, pyramid, 1..=joined);
        let foveal = view.foveal_level();
        // Points are no part of what is finished here: the light that tells what is smooth is without them.
        let mut without_points = None;
        if with_points.is_some() {
            if joined <= foveal {
                self.pyramid.down(frame, pyramid, joined + 1..=foveal);
                without_points = Some(pyramid.read(frame, foveal)?);
            }
            self.point_light(frame, scene, pyramid, joined);
        }
        self.pyramid.down(frame, pyramid, joined + 1..=pyramid.len());
        let gathered = pyramid.read(frame, foveal)?;
        let seeing = scene.eye.seeing(&gathered, &view, scene.display);
        let without_points =
            without_points.map(|light| Foveal::of(&light, &view, foveal, &seeing.glare_shares));

        let tiles = EyeTiles::of(
            size_px,
            pyramid.len(),
            &seeing.foveal,
            without_points.as_ref().unwrap_or(&seeing.foveal),
            seeing.levels_resolved.as_deref(),
            !seeing.glare_shares.is_empty(),
        );
        let kind = Kind {
            depth: picture.depth(),
            space: scene.display.space,
            constants: picture_constants(scene.display, picture.depth()),
            is_red: scene.display.red,
            has_grain: scene.eye.grain.is_some(),
        };
        let around = finest_spread(size_px[0], size_px[1]);
        let spread_from = |level: usize| match tiles.scatters {
            true => seeing.glare_shares.iter().skip(level - 1).sum::<f64>(),
            false => 0.0,
        };
        let work = Work {
            scene,
            seeing: &seeing,
            pyramid,
            pipelines: self.pipelines(gpu, kind),
            picture,
            retina: RetinaUniform {
                // What level 1 would spread is not worth a pass over half the picture.
                in_place: (1.0 - spread_from(around)) as f32,
                spread: if tiles.scatters { 1.0 } else { 0.0 },
                size_px: size_px.map(|edge| edge as f32),
                soft_scale: [0.0; 2],
                around_scale: pyramid.pixel_on(around),
            },
            screen: screen(gpu, scene.display, &seeing),
            pixel: view.pixel,
            levels_resolved: row_texture(gpu, seeing.levels_resolved.as_deref().unwrap_or(&[0.0])),
        };
        self.pixels(frame, &work, &tiles, around);
        self.points(frame, &work, around);
        // The textures are the next picture's as soon as this returns.
        frame.submit();
        Ok(seeing)
    }

    /// Puts the light of points into a level, from where it is spread widely.
    fn point_light(&self, frame: &mut Target, scene: &Scene, pyramid: &Pyramid, level: usize) {
        if scene.points.is_empty() {
            return;
        }
        let gpu = frame.gpu;
        let instances: Vec<SplatInstance> = scene
            .points
            .iter()
            .map(|point| SplatInstance {
                centre_px: point.centre_px.map(|v| v as f32),
                illuminance: point.illuminance.to_f32(),
            })
            .collect();
        let bytes = bytemuck::cast_slice(&instances);
        let instances = gpu.buffer("light of points", bytes, wgpu::BufferUsages::VERTEX);
        let texel = scene.camera.pixel_angle().rad() * f64::from(1 << level);
        let uniform = LevelUniform {
            size: pyramid.level_px(level).map(|edge| edge as f32),
            scale: 0.5f32.powi(level as i32),
            per_lux: texel.powi(-2) as f32,
        };
        let bytes = bytemuck::bytes_of(&uniform);
        let uniform = gpu.buffer("level", bytes, wgpu::BufferUsages::UNIFORM);
        let layout = self.point_light.get_bind_group_layout(0);
        let group = gpu.bind(&layout, &[(0, &uniform)]);
        frame.adding_pass("light of points", pyramid.light(level), |pass| {
            pass.set_pipeline(&self.point_light);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, instances.slice(..));
            pass.draw(0..4, 0..scene.points.len() as u32);
        });
    }

    /// What the retina gets of a frame without points, with the glare of all of it: for measurements.
    pub fn retina(
        &self,
        frame: &mut Target,
        eye: &Eye,
        camera: &Camera,
    ) -> Result<HdrFrame, GpuError> {
        let size_px = [camera.width_px, camera.height_px];
        let pyramid = Pyramid::new(frame.gpu, size_px);
        let view = View::new(size_px, camera.pixel_angle());
        self.pyramid.down(frame, &pyramid, 1..=pyramid.len());
        let gathered = pyramid.read(frame, view.foveal_level())?;
        let shares = eye.seeing(&gathered, &view, &Display::default()).glare_shares;
        let around = finest_spread(size_px[0], size_px[1]);
        let levels_resolved = row_texture(frame.gpu, &[0.0]);
        let up = Up { shares: &shares, levels_resolved: &levels_resolved, blurs: false };
        self.pyramid.up(frame, &pyramid, &up, (around..=pyramid.len()).rev());
        let in_place = 1.0 - shares.iter().skip(around - 1).sum::<f64>();
        self.pyramid.retina(frame, &pyramid, around, in_place)
    }

    /// All pixels, each as far as it needs.
    fn pixels(&self, frame: &mut Target, work: &Work, tiles: &EyeTiles, around: usize) {
        let gpu = frame.gpu;
        let view = wgpu::BindingResource::TextureView;
        let pyramid = work.pyramid;
        let no_glare: &[f64] = &[];
        let up = Up {
            shares: if tiles.scatters { &work.seeing.glare_shares } else { no_glare },
            levels_resolved: &work.levels_resolved,
            blurs: tiles.blurs,
        };
        if tiles.scatters || tiles.blurs {
            self.pyramid.up(frame, pyramid, &up, (around..=pyramid.len()).rev());
        }
        let uniform = |label, bytes: &[u8]| gpu.buffer(label, bytes, wgpu::BufferUsages::UNIFORM);
        let grain = uniform("grain", bytemuck::bytes_of(&grain(work.scene)));
        let noise = self.noise(gpu, work.scene.eye.grain);
        let frame_view = frame.view();
        let pipelines = &work.pipelines;
        let mut kinds: Vec<(&wgpu::RenderPipeline, &[Tile], &[u32], usize)> = vec![
            (&pipelines.plain, &tiles.plain, &[0, 1, 2, 3, 4, 7, 8, 9, 10], 0),
            (&pipelines.sharp, &tiles.sharp, &[0, 1, 2, 3, 4, 5, 7, 8, 9, 10], 0),
        ];
        for (level, soft) in (1..).zip(&tiles.soft) {
            kinds.push((&pipelines.soft, soft, &[0, 1, 2, 6, 8, 9, 10], level));
        }
        kinds.retain(|(_, tiles, ..)| !tiles.is_empty());
        let mut draws = Vec::new();
        for (pipeline, tiles, needed, level) in kinds {
            let mut retina = work.retina;
            let mut coarse = None;
            if level > 0 {
                let screen = &work.screen;
                coarse = self.pyramid.seen(frame, pyramid, &up, level, tiles, screen);
                retina.soft_scale = pyramid.pixel_on(level);
            }
            let retina = uniform("retina", bytemuck::bytes_of(&retina));
            let everything = [
                (0, self.pyramid.sampler()),
                (1, retina.as_entire_binding()),
                (2, work.screen.display.as_entire_binding()),
                (3, view(&work.screen.shown)),
                (4, view(&frame_view)),
                (5, view(pyramid.spread(around))),
                (6, view(coarse.unwrap_or(&work.screen.shown))),
                (7, wgpu::BindingResource::Sampler(&self.pyramid.nearest)),
                (8, grain.as_entire_binding()),
                (9, view(&noise)),
                (10, wgpu::BindingResource::Sampler(&self.repeated)),
            ];
            let bound: Vec<_> =
                everything.into_iter().filter(|(number, _)| needed.contains(number)).collect();
            let group = gpu.bind_mixed(&pipeline.get_bind_group_layout(0), &bound);
            let bytes = bytemuck::cast_slice(tiles);
            let instances = gpu.buffer("tiles", bytes, wgpu::BufferUsages::VERTEX);
            draws.push((pipeline, group, instances, tiles.len() as u32));
        }
        frame.picture_pass("seeing", &[work.picture.codes()], |pass| {
            for (pipeline, group, instances, count) in &draws {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, group, &[]);
                pass.set_vertex_buffer(0, instances.slice(..));
                pass.draw(0..4, 0..*count);
            }
        });
    }

    /// The noise of a seed, made once.
    fn noise(&self, gpu: &Gpu, seed: Option<u64>) -> wgpu::TextureView {
        // A poisoned lock holds a whole texture or none.
        let mut kept = self.noise.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some((known, view)) if *known == seed => view.clone(),
            _ => kept.insert((seed, noise_texture(gpu, seed))).1.clone(),
        }
    }

    /// Points of light, those that are seen.
    fn points(&self, frame: &mut Target, work: &Work, around: usize) {
        let Work { scene, seeing, pyramid, .. } = work;
        if scene.points.is_empty() {
            return;
        }
        let gpu = frame.gpu;
        let view = wgpu::BindingResource::TextureView;
        let seen: Vec<SeenPoint> = scene
            .points
            .iter()
            .map(|point| seeing.point(point.illuminance, scene.display))
            .collect();
        let brightest_lx = seen.iter().map(|seen| seen.illuminance_lx).fold(0.0, f64::max);
        let flare = seeing.flare(brightest_lx);
        let mut flares = Vec::new();
        let parts = |flare: Option<&Flare>| match &seeing.halo {
            Some(halo) => {
                let parts = halo.parts(flare);
                [parts.core as f32, parts.smooth as f32]
            }
            None => [1.0, 0.0],
        };
        let (alone, beside_flare) = (parts(None), parts(flare.as_ref()));
        let mut instances = Vec::with_capacity(seen.len());
        for (point, seen) in scene.points.iter().zip(&seen) {
            let centre_px = point.centre_px.map(|v| v as f32);
            let radius = flare.as_ref().and_then(|flare| {
                flare.visible_radius(seen.illuminance_lx, seeing.adaptation_cd_m2)
            });
            if let Some(radius) = radius {
                flares.push(FlareInstance {
                    centre_px,
                    radius_px: (radius.rad() / work.pixel.rad()) as f32,
                    illuminance: (point.illuminance * seen.gathered).to_f32(),
                });
            }
            instances.push(PointInstance {
                centre_px,
                colour: seen.colour.map(|v| v as f32),
                illuminance: seen.illuminance_lx as f32,
                parts: if radius.is_some() { beside_flare } else { alone },
            });
        }
        let bytes = bytemuck::cast_slice(&instances);
        let instances = gpu.buffer("points", bytes, wgpu::BufferUsages::VERTEX);
        let visible = exact_table_texture(gpu, "visible", &seeing.visible);
        let uniform = |label, bytes: &[u8]| gpu.buffer(label, bytes, wgpu::BufferUsages::UNIFORM);
        let retina = uniform("retina", bytemuck::bytes_of(&work.retina));
        let rows = halo_rows(seeing.halo.as_ref());
        let halo = HaloUniform {
            rows_per_octave: point::PER_OCTAVE as f32,
            first_log2_px: point::FIRST_PX.log2() as f32,
            rows: rows.len() as f32,
            pad: 0.0,
        };
        let halo = uniform("halo", bytemuck::bytes_of(&halo));
        let reaches = row_texture(gpu, &halo_reaches(&rows));
        let rows = row_texture(gpu, &rows);
        let pipeline = &work.pipelines.points;
        let group = gpu.bind_mixed(
            &pipeline.get_bind_group_layout(0),
            &[
                (0, self.pyramid.sampler()),
                (1, retina.as_entire_binding()),
                (2, halo.as_entire_binding()),
                (3, view(&visible)),
                (4, view(pyramid.light(around))),
                (5, view(pyramid.spread(around))),
                (6, view(&rows)),
                (7, work.screen.display.as_entire_binding()),
                (8, view(&work.screen.shown)),
                (9, view(&reaches)),
            ],
        );
        frame.adding_pass("points", work.picture.light(), |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, instances.slice(..));
            pass.draw(0..4, 0..scene.points.len() as u32);
        });
        if let Some(flare) = flare.filter(|_| !flares.is_empty()) {
            self.flares(frame, work, around, &flare, &flares);
        }
    }

    /// Needles and rings around the brightest points.
    fn flares(
        &self,
        frame: &mut Target,
        work: &Work,
        around: usize,
        flare: &Flare,
        flares: &[FlareInstance],
    ) {
        let gpu = frame.gpu;
        let view = wgpu::BindingResource::TextureView;
        let uniform = |label, bytes: &[u8]| gpu.buffer(label, bytes, wgpu::BufferUsages::UNIFORM);
        let retina = uniform("retina", bytemuck::bytes_of(&work.retina));
        let radius_px = (flare.radius().rad() / work.pixel.rad()) as f32;
        let whole = FlareUniform { radius_px, pad: [0.0; 7] };
        let whole = uniform("flare", bytemuck::bytes_of(&whole));
        let texels: Vec<[f32; 4]> =
            flare.texels().iter().map(|light| light.map(|light| light as f32)).collect();
        let size = wgpu::Extent3d {
            width: flare::AZIMUTHS as u32,
            height: flare::RADII as u32,
            depth_or_array_layers: 1,
        };
        let pattern = gpu.texture_of("flare", size, FRAME_FORMAT, bytemuck::cast_slice(&texels));
        let pattern = pattern.create_view(&Default::default());
        let pipeline = &work.pipelines.flares;
        let group = gpu.bind_mixed(
            &pipeline.get_bind_group_layout(0),
            &[
                (0, self.pyramid.sampler()),
                (1, retina.as_entire_binding()),
                (2, whole.as_entire_binding()),
                (3, work.screen.display.as_entire_binding()),
                (4, view(&work.screen.shown)),
                (5, view(work.pyramid.light(around))),
                (6, view(work.pyramid.spread(around))),
                (7, view(&pattern)),
                (8, wgpu::BindingResource::Sampler(&self.turning)),
            ],
        );
        let bytes = bytemuck::cast_slice(flares);
        let instances = gpu.buffer("flares", bytes, wgpu::BufferUsages::VERTEX);
        frame.adding_pass("flares", work.picture.light(), |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_vertex_buffer(0, instances.slice(..));
            pass.draw(0..4, 0..flares.len() as u32);
        });
    }

    fn pipelines(&self, gpu: &Gpu, kind: Kind) -> Pipelines {
        // A poisoned lock holds whole pipelines or none.
        let mut made = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, pipelines)) = made.iter().find(|(known, _)| *known == kind) {
            return pipelines.clone();
        }
        let mut constants = kind.constants.to_vec();
        let is = |truth: bool| f64::from(u8::from(truth));
        constants.push(("IS_RED", is(kind.is_red)));
        let of_screen = constants.clone();
        constants.push(("HAS_GRAIN", is(kind.has_grain)));
        let pixels = |entry| {
            gpu.chain_pipeline(&Stage {
                label: "seeing",
                source: shaders::assembled("eye"),
                entries: ["vertex", entry],
                constants: &constants,
                targets: &[kind.depth.codes_format()],
                buffers: &[Some(tile_layout())],
                adds: false,
            })
        };
        let instance = wgpu::VertexBufferLayout {
            array_stride: size_of::<PointInstance>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![
                0 => Float32x2, 1 => Float32x3, 2 => Float32, 3 => Float32x2
            ],
        };
        let of_flares = wgpu::VertexBufferLayout {
            array_stride: size_of::<FlareInstance>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32, 2 => Float32x4],
        };
        let flares = gpu.chain_pipeline(&Stage {
            label: "flares",
            source: shaders::assembled("flare"),
            entries: ["vertex", "fragment"],
            constants: &of_screen,
            targets: &[kind.depth.light_format(kind.space)],
            buffers: &[Some(of_flares)],
            adds: true,
        });
        let points = gpu.chain_pipeline(&Stage {
            label: "points",
            source: shaders::assembled("points"),
            entries: ["vertex", "fragment"],
            constants: &of_screen,
            targets: &[kind.depth.light_format(kind.space)],
            buffers: &[Some(instance)],
            adds: true,
        });
        let pipelines = Pipelines {
            plain: pixels("plain"),
            sharp: pixels("sharp"),
            soft: pixels("soft"),
            points,
            flares,
        };
        made.push((kind, pipelines.clone()));
        pipelines
    }
}

/// The screen as the passes know it.
fn screen(gpu: &Gpu, display: &Display, seeing: &Seeing) -> Screen {
    let rows = DisplayUniform::of(display, seeing.rgb_from_seen);
    let bytes = bytemuck::bytes_of(&rows);
    Screen {
        shown: table_texture(gpu, "shown", &seeing.shown),
        display: gpu.buffer("display", bytes, wgpu::BufferUsages::UNIFORM),
        is_red: display.red,
    }
}

/// Light of the halo per square pixel, by rows of the radius; none without a halo.
fn halo_rows(halo: Option<&Halo>) -> Vec<f32> {
    let rows = halo.map_or(&[] as &[f64], Halo::table);
    let rows: Vec<f32> = rows.iter().map(|&light| light as f32).collect();
    if rows.is_empty() { vec![0.0] } else { rows }
}

/// Light per square pixel of the first column of the table of reaches, log2, columns to an octave, and how
/// many there are; `shaders/points.wgsl` knows them too.
const LEAST_LOG2: f64 = -48.0;
const REACHES_PER_OCTAVE: f64 = 2.0;
const REACHES: usize = 129;

/// Where the halo has no more than so much light per square pixel, pixels, from its rows, which fall.
fn halo_reaches(rows: &[f32]) -> Vec<f32> {
    let reach_px = |column: usize| {
        let least = (LEAST_LOG2 + column as f64 / REACHES_PER_OCTAVE).exp2() as f32;
        let row = rows.iter().rposition(|light| *light > least).map_or(0.0, |last| {
            let next = rows.get(last + 1).copied().unwrap_or(0.0);
            last as f64 + f64::from((rows[last] - least) / (rows[last] - next))
        });
        (point::FIRST_PX * (row / point::PER_OCTAVE as f64).exp2()) as f32
    };
    (0..REACHES).map(reach_px).collect()
}

fn grain(scene: &Scene) -> GrainUniform {
    GrainUniform {
        place: [0.0; 2],
        size_px: (GRAIN.rad() / scene.camera.pixel_angle().rad()).max(1.0) as f32,
        strength: GRAIN_STRENGTH,
    }
}

/// Even noise of a mean of zero and a variance of one, from a seed; a single grey texel without.
fn noise_texture(gpu: &Gpu, seed: Option<u64>) -> wgpu::TextureView {
    let edge = if seed.is_some() { NOISE_PX } else { 1 };
    let texels: Vec<f32> = match seed {
        None => vec![0.0],
        Some(seed) => (0..u64::from(edge * edge)).map(|n| normal(seed, n) as f32).collect(),
    };
    let size = wgpu::Extent3d { width: edge, height: edge, depth_or_array_layers: 1 };
    let format = wgpu::TextureFormat::R32Float;
    let texture = gpu.texture_of("noise", size, format, bytemuck::cast_slice(&texels));
    texture.create_view(&Default::default())
}

/// A sum of twelve even numbers less six: nearly normal.
fn normal(seed: u64, number: u64) -> f64 {
    let mut state = seed ^ number.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let sum: f64 = (0..12)
        .map(|_| {
            // SplitMix64 (Steele, Lea & Flood 2014).
            state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = state;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
        })
        .sum();
    sum - 6.0
}

/// The size of tables over light.
const TABLE_SIZE: wgpu::Extent3d = wgpu::Extent3d {
    width: light_table::COLUMNS as u32,
    height: light_table::ROWS as u32,
    depth_or_array_layers: 1,
};

/// A table over light, in halves: smaller, and sooner read.
fn table_texture(gpu: &Gpu, label: &str, table: &[[f32; 4]]) -> wgpu::TextureView {
    let halves: Vec<u16> =
        table.as_flattened().iter().map(|&value| f16::from_f32(value).to_bits()).collect();
    let format = wgpu::TextureFormat::Rgba16Float;
    let texture = gpu.texture_of(label, TABLE_SIZE, format, bytemuck::cast_slice(&halves));
    texture.create_view(&Default::default())
}

/// The same in 32 bits, for values beyond the range of halves.
fn exact_table_texture(gpu: &Gpu, label: &str, table: &[[f32; 4]]) -> wgpu::TextureView {
    let texture = gpu.texture_of(label, TABLE_SIZE, FRAME_FORMAT, bytemuck::cast_slice(table));
    texture.create_view(&Default::default())
}

/// A table in one row.
fn row_texture(gpu: &Gpu, row: &[f32]) -> wgpu::TextureView {
    let size = wgpu::Extent3d { width: row.len() as u32, height: 1, depth_or_array_layers: 1 };
    let format = wgpu::TextureFormat::R32Float;
    let texture = gpu.texture_of("row", size, format, bytemuck::cast_slice(row));
    texture.create_view(&Default::default())
}

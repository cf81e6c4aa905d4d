//! What the GPU draws, by measured radiance. Without an adapter every test here is reported as
//! ignored.

#[path = "support/mod.rs"]
mod support;

use glam::DMat3;
use libtest_mimic::Failed;
use nocturne::air::Atmosphere;
use nocturne::air::aerosol::PhaseLaw;
use nocturne::air::scattering::{Phase, SkyView};
use nocturne::camera::{Camera, Projection};
use nocturne::frame::{Apparent, Dir, Horizon};
use nocturne::image::HdrFrame;
use nocturne::plan::disc::{Disc, DiscBand, DiscNode, DiscShape, Lattice, NODES, SurfaceLaw};
use nocturne::plan::{DARK_AZIMUTHS, FramePlan, SKY_SHAPE, SkyPlan, SourceSky, Splat};
use nocturne::render::Renderer;
use nocturne::render::sky_tiles::{SkyDetail, tiles};
use nocturne::units::{Angle, Xyzv};
use support::{GpuTest, check};

const PROJECTIONS: [(Projection, f64); 6] = [
    (Projection::Perspective, 20.0),
    (Projection::Perspective, 120.0),
    (Projection::Stereographic, 120.0),
    (Projection::Equidistant, 180.0),
    (Projection::EqualArea, 180.0),
    (Projection::Equirectangular, 360.0),
];

fn main() {
    support::run([
        GpuTest::new("splats_conserve_flux_and_place", splats_conserve_flux_and_place),
        GpuTest::new("an_empty_plan_is_black", an_empty_plan_is_black),
        GpuTest::new("the_sky_is_looked_up_where_the_camera_looks", the_sky_table_is_looked_up),
        GpuTest::new("the_sky_of_the_gpu_is_its_twins", the_sky_is_its_twins),
        GpuTest::new("tiles_differ_little_from_every_pixel", tiles_are_close),
        GpuTest::new("discs_conserve_flux_at_any_size", discs_conserve_flux_at_any_size),
        GpuTest::new("the_frame_holds_a_faint_sky_and_the_sun", the_frame_holds_a_faint_sky),
    ])
}

fn camera(projection: Projection, fov_deg: f64, width_px: u32, height_px: u32) -> Camera {
    Camera {
        projection,
        field_of_view: Angle::from_deg(fov_deg),
        azimuth: Angle::from_deg(130.0),
        altitude: Angle::from_deg(35.0),
        roll: Angle::ZERO,
        width_px,
        height_px,
    }
}

fn dark_plan(camera: Camera) -> FramePlan {
    let sky = SkyPlan::black(Angle::ZERO);
    FramePlan { camera, sky, milky_way: None, discs: Vec::new(), splats: Vec::new() }
}

fn drawn(renderer: &Renderer, plan: &FramePlan) -> Result<HdrFrame, Failed> {
    Ok(renderer.frame(plan).map_err(|error| error.to_string())?.frame)
}

/// Illuminance of a window of pixels, and the centroid of its luminance times solid angle.
fn measured(
    frame: &HdrFrame,
    camera: &Camera,
    centre: [f64; 2],
    reach_px: f64,
) -> (Xyzv, [f64; 2]) {
    let (mut sum, mut centroid) = (Xyzv::BLACK, [0.0, 0.0]);
    for y in 0..frame.height_px() {
        for x in 0..frame.width_px() {
            let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            if (pixel[0] - centre[0]).abs() > reach_px || (pixel[1] - centre[1]).abs() > reach_px {
                continue;
            }
            let light = frame.xyzv(x, y) * camera.pixel_solid_angle_sr(pixel);
            sum += light;
            centroid[0] += pixel[0] * light.y;
            centroid[1] += pixel[1] * light.y;
        }
    }
    (sum, centroid.map(|c| c / sum.y))
}

fn splats_conserve_flux_and_place(renderer: &Renderer) -> Result<(), Failed> {
    let illuminance = Xyzv::new(3e-7, 2.54e-7, 2e-7, 5e-7);
    for (projection, fov_deg) in PROJECTIONS {
        for (width_px, height_px) in [(640, 360), (1920, 1080)] {
            let camera = camera(projection, fov_deg, width_px, height_px);
            let (w, h) = (f64::from(width_px), f64::from(height_px));
            let centres = [
                [0.5 * w, 0.5 * h],
                [0.31 * w + 0.123, 0.52 * h + 0.877],
                [0.55 * w + 0.5, 0.21 * h],
                [0.68 * w + 0.25, 0.78 * h + 0.75],
            ];
            let splats = centres.map(|centre_px| Splat::star(centre_px, illuminance)).to_vec();
            let frame = drawn(renderer, &FramePlan { splats, ..dark_plan(camera) })?;
            for centre in centres {
                let (sum, at) = measured(&frame, &camera, centre, 4.0);
                let error =
                    (sum.y / illuminance.y - 1.0).abs().max((sum.v / illuminance.v - 1.0).abs());
                check(error < 1e-4, || {
                    format!("{projection:?} {fov_deg}°: flux is off by {error}")
                })?;
                let off = (at[0] - centre[0]).hypot(at[1] - centre[1]);
                check(off < 0.01, || format!("{projection:?} {fov_deg}°: off by {off} px"))?;
            }
        }
    }
    Ok(())
}

fn an_empty_plan_is_black(renderer: &Renderer) -> Result<(), Failed> {
    let plan = dark_plan(camera(Projection::Perspective, 60.0, 65, 33));
    let frame = drawn(renderer, &plan)?;
    check((frame.width_px(), frame.height_px()) == (65, 33), || "wrong size".to_owned())?;
    check(frame.pixels().iter().all(|p| *p == [0.0; 4]), || "not black".to_owned())
}

fn the_sky_table_is_looked_up(renderer: &Renderer) -> Result<(), Failed> {
    // Tables that hold their own coordinates: X the azimuth from the Sun, Y that from the Moon,
    // Z the altitude, all in degrees.
    let (sun_azimuth, moon_azimuth) = (Angle::from_deg(75.0), Angle::from_deg(290.0));
    let source = |azimuth: Angle, channel: fn(f32) -> [f32; 4]| SourceSky {
        azimuth,
        view: SkyView {
            smooth: (0..SKY_SHAPE.nodes())
                .flat_map(|node| channel(SKY_SHAPE.azimuth(node % SKY_SHAPE.azimuths).deg() as f32))
                .collect(),
            ..black_view(Angle::ZERO)
        },
    };
    let dark = |node: usize| {
        let row = node / DARK_AZIMUTHS;
        let altitude = SKY_SHAPE.elevation(row, Angle::ZERO).deg();
        if SKY_SHAPE.is_above(row) {
            Xyzv::new(0.0, 0.0, altitude, 1.0)
        } else {
            Xyzv::new(-1.0, -1.0, -1.0, 2.0)
        }
    };
    let sky = SkyPlan {
        horizon: Angle::ZERO,
        sun: Some(source(sun_azimuth, |a| [a, 0.0, 0.0, 0.0])),
        sun_left: None,
        moon: Some(source(moon_azimuth, |a| [0.0, a, 0.0, 0.0])),
        dark: (0..SKY_SHAPE.rows() * DARK_AZIMUTHS).map(dark).collect(),
    };
    for (projection, fov_deg) in PROJECTIONS {
        let camera = camera(projection, fov_deg, 320, 180);
        let plan = FramePlan { sky: sky.clone(), ..dark_plan(camera) };
        let detail = SkyDetail::EveryPixel;
        let frame = renderer.frame_with(&plan, detail).map_err(|error| error.to_string())?.frame;
        for (x, y) in [(5u32, 3u32), (160, 90), (300, 20), (40, 120), (250, 170), (160, 179)] {
            let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let Some(view) = camera.view_from_pixel(pixel) else {
                check(frame.at(x, y) == [0.0; 4], || format!("{projection:?}: light off the sky"))?;
                continue;
            };
            let dir: Dir<Apparent> = camera.view_from_apparent().inverse() * view;
            if dir.altitude().deg() < -1.0 {
                check(frame.at(x, y)[3] == 2.0, || {
                    format!("{projection:?}: no ground at {x} {y}")
                })?;
                continue;
            }
            if dir.altitude().deg() < 1.0 {
                continue;
            }
            let from = |azimuth: Angle| (dir.azimuth() - azimuth).signed().abs().deg();
            let seen = frame.xyzv(x, y);
            // Azimuths are linear in the table; altitudes go with the square of the row, so the
            // straight line between two rows errs by up to an eighth of a step's curvature.
            let near = (seen.x - from(sun_azimuth)).abs() < 0.02
                && (seen.y - from(moon_azimuth)).abs() < 0.02
                && (seen.z - dir.altitude().deg()).abs() < 0.01;
            check(near && seen.v == 1.0, || {
                format!(
                    "{projection:?} {x},{y}: {seen:?}, expected {} {} {}",
                    from(sun_azimuth),
                    from(moon_azimuth),
                    dir.altitude().deg()
                )
            })?;
        }
    }
    Ok(())
}

fn black_view(source_elevation: Angle) -> SkyView {
    SkyView {
        shape: SKY_SHAPE,
        horizon: Angle::ZERO,
        source_elevation,
        channels: 4,
        smooth: vec![0.0; 4 * SKY_SHAPE.nodes()],
        haze: Vec::new(),
        phase: None,
    }
}

/// A sky with haze, in the shapes that skies have: bright at the horizon and around the source,
/// darkest a right angle away from it.
fn hazy_sky(sun_azimuth: Angle, sun_elevation: Angle) -> SkyPlan {
    let horizon = Angle::from_deg(-0.045);
    let light = |node: usize| -> [f32; 4] {
        let (row, column) = (node / SKY_SHAPE.azimuths, node % SKY_SHAPE.azimuths);
        let elevation = SKY_SHAPE.elevation(row, horizon);
        let nu = elevation.sin() * sun_elevation.sin()
            + elevation.cos() * sun_elevation.cos() * SKY_SHAPE.azimuth(column).cos();
        let airmass = 1.0 / (elevation.sin().abs() + 0.05);
        [1.0, 1.1, 1.6, 2.0].map(|colour: f64| {
            let sky = (1.0 - (-0.1 * colour * airmass).exp()) * (1.0 + nu * nu);
            (1e3 * if SKY_SHAPE.is_above(row) { sky } else { 0.1 + 0.3 * sky }) as f32
        })
    };
    let smooth: Vec<f32> = (0..SKY_SHAPE.nodes()).flat_map(light).collect();
    let mut air = Atmosphere::default();
    air.aerosol.phase = PhaseLaw::HenyeyGreenstein { g: 0.85 };
    let source = |azimuth: Angle, elevation: Angle, share: f32| SourceSky {
        azimuth,
        view: SkyView {
            smooth: smooth.iter().map(|value| value * share).collect(),
            haze: smooth.iter().map(|value| 0.5 * value * share).collect(),
            phase: Phase::of(&air),
            horizon,
            ..black_view(elevation)
        },
    };
    SkyPlan {
        horizon,
        sun: Some(source(sun_azimuth, sun_elevation, 1.0)),
        sun_left: None,
        moon: Some(source(sun_azimuth + Angle::from_deg(100.0), Angle::from_deg(20.0), 0.3)),
        dark: (0..SKY_SHAPE.rows() * DARK_AZIMUTHS).map(dark_light).collect(),
    }
}

/// A dark sky that is brightest in the east-south-east, by the node of its table.
fn dark_light(node: usize) -> Xyzv {
    let azimuth = Angle::from_deg(360.0 * (node % DARK_AZIMUTHS) as f64 / DARK_AZIMUTHS as f64);
    let wave = (azimuth - Angle::from_deg(110.0)).cos();
    Xyzv::new(20.0 + 9.0 * wave, 20.0 + 8.0 * wave, 20.0 - 3.0 * wave, 40.0 + 10.0 * wave)
}

/// The largest relative difference of two lights, in any of X, Y, Z and V.
fn difference(a: Xyzv, b: Xyzv) -> f64 {
    [(a.x, b.x), (a.y, b.y), (a.z, b.z), (a.v, b.v)]
        .map(|(a, b)| (a / b - 1.0).abs())
        .into_iter()
        .fold(0.0, f64::max)
}

fn the_sky_is_its_twins(renderer: &Renderer) -> Result<(), Failed> {
    let sun = (Angle::from_deg(140.0), Angle::from_deg(30.0));
    let sky = hazy_sky(sun.0, sun.1);
    let mut dirs: Vec<Dir<Apparent>> = (0..2000)
        .map(|i| {
            let sine = 1.0 - (2.0 * f64::from(i) + 1.0) / 2000.0;
            let azimuth = Angle::from_deg(137.507_764 * f64::from(i));
            Dir::from_azimuth_altitude(azimuth, Angle::from_rad(sine.asin()))
        })
        .collect();
    // The aureole, down to the centre.
    let beside = |degrees: f64| Dir::from_azimuth_altitude(sun.0 + Angle::from_deg(degrees), sun.1);
    dirs.extend([0.0, 0.01, 0.1, 0.3, 1.0, 3.0].map(beside));
    let lights = renderer.sky_in(&sky, &dirs).map_err(|error| error.to_string())?;
    check(lights.len() == dirs.len(), || format!("{} lights", lights.len()))?;
    for (dir, light) in dirs.iter().zip(lights) {
        let twin = sky.luminance(*dir);
        let error = difference(light, twin);
        check(error < 2e-4, || format!("{dir:?}: {light:?}, its twin {twin:?}"))?;
    }
    Ok(())
}

fn tiles_are_close(renderer: &Renderer) -> Result<(), Failed> {
    for (projection, fov_deg, altitude_deg) in [
        (Projection::Perspective, 60.0, 5.0),
        (Projection::Perspective, 1.0, 0.1),
        (Projection::Stereographic, 120.0, 35.0),
        (Projection::Equidistant, 180.0, 90.0),
        (Projection::EqualArea, 220.0, 60.0),
        (Projection::Equirectangular, 360.0, 0.0),
    ] {
        let mut camera = camera(projection, fov_deg, 960, 540);
        camera.altitude = Angle::from_deg(altitude_deg);
        let sky = hazy_sky(Angle::from_deg(140.0), Angle::from_deg(25.0));
        let plan = FramePlan { sky, ..dark_plan(camera) };
        let cut = tiles(&plan.sky, &camera, SkyDetail::Tiles);
        let area = |[x0, y0, x1, y1]: &[u32; 4]| f64::from((x1 - x0) * (y1 - y0)) / (960.0 * 540.0);
        let exact: f64 = cut.exact.iter().map(area).sum();
        check(exact < 0.5 && !cut.smooth.is_empty(), || {
            format!("{projection:?} {fov_deg}: {exact} of the picture is exact")
        })?;
        let draw = |detail| renderer.frame_with(&plan, detail).map_err(|error| error.to_string());
        let (tiled, every) = (draw(SkyDetail::Tiles)?.frame, draw(SkyDetail::EveryPixel)?.frame);
        let mut worst = (0.0, 0, 0);
        for y in 0..540 {
            for x in 0..960 {
                if every.at(x, y) == [0.0; 4] {
                    check(tiled.at(x, y) == [0.0; 4], || {
                        format!("{projection:?}: {x} {y} is lit")
                    })?;
                    continue;
                }
                let error = difference(tiled.xyzv(x, y), every.xyzv(x, y));
                if error > worst.0 {
                    worst = (error, x, y);
                }
            }
        }
        check(worst.0 < 2e-3, || {
            let (error, x, y) = worst;
            format!("{projection:?} {fov_deg}: {error} at {x} {y}; {exact} of the pixels exact")
        })?;
    }
    Ok(())
}

/// A body without air in the middle of the picture.
fn disc_plan(camera: Camera, law: SurfaceLaw, radius: Angle, phase_deg: f64) -> FramePlan {
    let altitude = camera.altitude;
    let centre: Dir<Horizon> = Dir::from_azimuth_altitude(camera.azimuth, altitude);
    // The Sun stands to the right of the body, and nearer to the observer the smaller the phase.
    let right: Dir<Horizon> =
        Dir::from_azimuth_altitude(camera.azimuth + Angle::from_deg(90.0), Angle::ZERO);
    let (sin, cos) = Angle::from_deg(phase_deg).sin_cos();
    let up = right.vector().cross(centre.vector());
    let shape = DiscShape {
        centre,
        angular_radius: radius,
        dir_to_sun: Dir::from_vector(right.vector() * sin - centre.vector() * cos),
        // The body's x axis points at the observer and its z axis to the top of the picture.
        body_from_horizon: DMat3::from_cols(-centre.vector(), right.vector(), up).transpose(),
        law,
    };
    let step = radius * (2.0 / (NODES - 1) as f64);
    let lowest = Dir::from_azimuth_altitude(camera.azimuth, altitude - radius);
    let node = |index: usize| DiscNode {
        above_centre: step * index as f64 - radius,
        rise: step,
        luminance: Xyzv::new(0.9, 1.0, 1.1, 2.0),
    };
    let limb_darkening = match &shape.law {
        SurfaceLaw::Sun { limb_darkening } => *limb_darkening,
        _ => [0.0; 6],
    };
    let half = radius.rad() * camera.focal_px() * 1.1 + 2.0;
    let middle = [f64::from(camera.width_px) / 2.0, f64::from(camera.height_px) / 2.0];
    let across_px = 2.0 * radius.rad() * camera.focal_px();
    let disc = Disc {
        is_cut_by_horizon: false,
        globe: None,
        label: "body",
        shape,
        bounds_px: [middle.map(|m| m - half), middle.map(|m| m + half)],
        lowest,
        lowest_in_view: camera.view_from_apparent() * lowest,
        step,
        bands: vec![DiscBand { limb_darkening, nodes: (0..NODES).map(node).collect() }],
        samples: [Lattice { points: 13, turn: 8 }, Lattice { points: 55, turn: 34 }],
        edge: 2.0 / across_px,
        occluder: None,
    };
    FramePlan { discs: vec![disc], ..dark_plan(camera) }
}

fn discs_conserve_flux_at_any_size(renderer: &Renderer) -> Result<(), Failed> {
    let sun = SurfaceLaw::Sun { limb_darkening: [0.3, 0.93, -0.23, 0.0, 0.0, 0.0] };
    for (law, phase_deg) in [(sun, 0.0), (SurfaceLaw::Lambert, 70.0)] {
        for across_px in [6.0, 13.0, 60.0, 200.0] {
            let camera = camera(Projection::Stereographic, 40.0, 320, 320);
            let radius = Angle::from_rad(across_px / 2.0 / camera.focal_px());
            let plan = disc_plan(camera, law.clone(), radius, phase_deg);
            let shape = &plan.discs[0].shape;
            let expected = shape.mean() * shape.solid_angle_sr();
            let frame = drawn(renderer, &plan)?;
            let (sum, _) = measured(&frame, &camera, [160.0, 160.0], 160.0);
            let error = (sum.y / expected - 1.0).abs();
            check(error < 0.01, || format!("{law:?} {across_px} px: flux is off by {error}"))?;
        }
    }
    Ok(())
}

fn the_frame_holds_a_faint_sky(renderer: &Renderer) -> Result<(), Failed> {
    let camera = camera(Projection::Perspective, 40.0, 320, 180);
    let luminance = 2e9;
    let faint = Xyzv::new(1e-6, 1e-6, 1e-6, 1e-6);
    let mut plan = disc_plan(
        camera,
        SurfaceLaw::Sun { limb_darkening: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0] },
        Angle::from_deg(1.0),
        0.0,
    );
    for node in &mut plan.discs[0].bands[0].nodes {
        node.luminance = Xyzv::new(luminance, luminance, luminance, luminance);
    }
    plan.sky.dark.fill(faint);
    let frame = drawn(renderer, &plan)?;
    let sun = frame.xyzv(160, 90).y;
    check((sun / luminance - 1.0).abs() < 1e-6, || format!("the Sun is {sun}"))?;
    let sky = frame.xyzv(5, 5).y;
    check((sky / 1e-6 - 1.0).abs() < 1e-6, || format!("the sky is {sky}"))
}

//! Planets that show a disc, drawn and measured: their light, their limbs, the rings of Saturn. Without
//! an adapter every test here is reported as ignored.

#[path = "support/mod.rs"]
mod support;

use libtest_mimic::Failed;
use nocturne::camera::Projection;
use nocturne::ephemeris::Body;
use nocturne::frame::{Dir, Horizon};
use nocturne::light::night::Night;
use nocturne::plan::disc::{Disc, SurfaceLaw};
use nocturne::render::Renderer;
use nocturne::scene::{Scene, Setting};
use nocturne::units::Xyzv;
use support::{GpuTest, check, drawn, illuminance, laid};

/// Flagstaff by night and by day alike: the air is not lit.
const SCENE: &str = r#"
nocturne_scene = 2
utc = "2026-01-18T06:00:00Z"
[place]
name = "Flagstaff"
latitude_deg = 35.19807
longitude_deg = -111.65127
height_m = 2106.0
[camera]
azimuth_deg = 190.0
altitude_deg = 42.0
field_of_view_deg = 1.0
projection = "perspective"
width_px = 64
height_px = 64
"#;

/// A planet and a day: rings wide to the north, to the south, and edge-on with the Sun on their other side;
/// Venus as a thin crescent, Mars gibbous.
const VIEWS: [(Body, &str); 8] = [
    (Body::Saturn, "2017-06-15"),
    (Body::Saturn, "2032-11-20"),
    (Body::Saturn, "2026-10-04"),
    (Body::Saturn, "2025-03-25"),
    (Body::Jupiter, "2026-01-10"),
    (Body::Venus, "2025-03-10"),
    (Body::Mars, "2024-12-01"),
    (Body::Mercury, "2026-06-15"),
];

fn main() {
    support::run([
        GpuTest::new("planets_have_their_light_at_any_size", planets_have_their_light),
        GpuTest::new("a_planet_is_that_of_its_plan", a_planet_is_that_of_its_plan),
    ])
}

/// A planet alone in the middle of a square picture at the hour at which it is highest, its equator so
/// many pixels across; through air, or through air that does not bend rays.
fn scene(body: Body, date: &str, across_px: f64, is_straight: bool) -> Result<Scene, Failed> {
    let mut scene = Scene::parse(SCENE)?;
    (scene.layers.skylight, scene.layers.ground, scene.layers.stars) = (false, false, false);
    (scene.layers.sun, scene.layers.moon) = (false, false);
    if is_straight {
        scene.air = scene.air.straight();
    }
    let mut best: Option<(f64, String, Night)> = None;
    for hour in (0..24).step_by(2) {
        scene.utc = format!("{date}T{hour:02}:00:00Z");
        let (_, _, _, night) = laid(&scene)?;
        let height_deg = night.body(body).ok_or("no planet")?.apparent.altitude().deg();
        if best.as_ref().is_none_or(|(highest, ..)| height_deg > *highest) {
            best = Some((height_deg, scene.utc.clone(), night));
        }
    }
    let (_, utc, night) = best.ok_or("no hours")?;
    scene.utc = utc;
    let apparent = night.body(body).ok_or("no planet")?.apparent;
    let radius = night.sky.body(body).ok_or("no planet")?.angular_radius;
    let camera = &mut scene.camera;
    camera.projection = Projection::Perspective;
    (camera.azimuth_deg, camera.altitude_deg) =
        (apparent.azimuth().deg(), apparent.altitude().deg());
    // Room for the rings. Where no field is as narrow, so many pixels as the narrowest has.
    let width_px = (2.5 * across_px).ceil() + 8.0;
    let field_deg = 2.0 * radius.deg() * width_px / across_px;
    camera.field_of_view_deg = field_deg.max(0.02);
    let width_px = (width_px * camera.field_of_view_deg / field_deg).ceil();
    (camera.width_px, camera.height_px) = (width_px as u32, width_px as u32);
    Ok(scene)
}

fn planets_have_their_light(renderer: &Renderer) -> Result<(), Failed> {
    let mut wrong = Vec::new();
    for (body, date) in VIEWS {
        // One of each kind in its largest.
        let largest = match (body, date) {
            (Body::Saturn, "2017-06-15") | (Body::Venus, _) => 800.0,
            _ => 240.0,
        };
        for across_px in [5.0, 8.5, 30.0, largest] {
            // Large ones in one colour: a software driver takes its time.
            let scene = scene(body, date, across_px, across_px > 100.0)?;
            let (frame, setting, night) = drawn(renderer, &scene)?;
            let sum = illuminance(&frame, &setting.camera);
            // Through the air, at its middle. The moons of Jupiter, of a thousandth each, may be in the sum.
            let expected = night.body(body).ok_or("no planet")?.ground;
            println!("{body} {date} {across_px}: {:.5}", sum.y / expected.y - 1.0);
            for (got, wanted) in [(sum.x, expected.x), (sum.y, expected.y), (sum.z, expected.z)] {
                let error = got / wanted - 1.0;
                if error.abs() > 0.01 {
                    wrong.push(format!("{body}, {date}, {across_px} px: off by {error:.4}"));
                }
            }
        }
    }
    check(wrong.is_empty(), || wrong.join("; "))
}

/// The light of a disc in the middle of a pixel, in 64 bits.
fn twin(disc: &Disc, setting: &Setting, pixel: [f64; 2]) -> Option<Xyzv> {
    let SurfaceLaw::Planet(_) = &disc.shape.law else { return None };
    let camera = &setting.camera;
    let dir = camera.view_from_apparent().inverse() * camera.view_from_pixel(pixel)?;
    let place = (dir.altitude() - disc.lowest.altitude()).rad() / disc.step.rad();
    let mut light = Xyzv::BLACK;
    for band in &disc.bands {
        let node = (place.max(0.0) as usize).min(band.nodes.len() - 2);
        let along = place - node as f64;
        let (low, high) = (&band.nodes[node], &band.nodes[node + 1]);
        let above = low.above_centre * (1.0 - along) + high.above_centre * along;
        let shape = &disc.shape;
        let altitude = shape.centre.altitude() + above;
        let stands: Dir<Horizon> = Dir::from_azimuth_altitude(dir.azimuth(), altitude);
        let centre = shape.centre.vector();
        let off =
            (stands.vector() - centre * stands.dot(shape.centre)) / shape.angular_radius.sin();
        let bright = low.luminance * (1.0 - along) + high.luminance * along;
        light += bright * shape.shape(off, 0.0);
    }
    Some(light)
}

fn a_planet_is_that_of_its_plan(renderer: &Renderer) -> Result<(), Failed> {
    // The crescent of Venus is steep everywhere.
    for (body, date) in VIEWS.into_iter().filter(|(body, _)| *body != Body::Venus) {
        // Rays run straight: one band, no colours apart.
        let scene = scene(body, date, 240.0, true)?;
        let (plan, _, setting, _) = laid(&scene)?;
        let frame = renderer.frame(&plan)?.frame;
        let disc = plan.discs.first().ok_or("no disc")?;
        let (width, height) = (frame.width_px(), frame.height_px());
        let light = |x: u32, y: u32| {
            twin(disc, &setting, [f64::from(x) + 0.5, f64::from(y) + 0.5]).map(|light| light.y)
        };
        let brightest = (0..width * height)
            .map(|index| frame.xyzv(index % width, index / width).y)
            .fold(0.0, f64::max);
        let (mut smooth, mut off, mut lit) = (0, 0, 0);
        for (x, y) in (2..height - 2).flat_map(|y| (2..width - 2).map(move |x| (x, y))) {
            let Some(middle) = light(x, y) else { return Err("no planet".into()) };
            // Where neighbours are alike no edge runs through the pixel.
            let around = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
            let around = around.map(|(x, y)| light(x, y).unwrap_or(0.0));
            let apart = around.map(|v| (v - middle).abs()).into_iter().fold(0.0, f64::max);
            if apart > 0.02 * brightest {
                continue;
            }
            smooth += 1;
            lit += u32::from(middle > 0.01 * brightest);
            off += u32::from((frame.xyzv(x, y).y - middle).abs() > 0.01 * brightest);
        }
        println!("{body} {date}: {smooth} smooth pixels, {lit} lit, {off} off");
        check(lit > 500, || format!("{body}, {date}: only {lit} pixels are lit"))?;
        // Encke's gap, thinner than a pixel, falls between the middles of pixels that are alike.
        check(off * 50 <= lit, || format!("{body}, {date}: {off} of {lit} lit pixels are off"))?;
    }
    Ok(())
}

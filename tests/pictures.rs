//! Whole pictures by measured light: the flux of stars, and where they fall. Without an adapter
//! every test here is reported as ignored.

#[path = "support/mod.rs"]
mod support;

use libtest_mimic::Failed;
use nocturne::camera::Projection;
use nocturne::ephemeris::Body;
use nocturne::export::describe::{DescribedObject, Description};
use nocturne::frame::{Apparent, Dir, Horizon};
use nocturne::image::HdrFrame;
use nocturne::light::sun::LimbDarkening;
use nocturne::plan::disc::Disc;
use nocturne::render::Renderer;
use nocturne::scene::{Scene, Setting};
use nocturne::units::Xyzv;
use support::{GpuTest, check, drawn, illuminance, laid};

/// A moonless winter night: Orion, Sirius and Jupiter high in the south.
const NIGHT: &str = r#"
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
field_of_view_deg = 90.0
projection = "stereographic"
width_px = 640
height_px = 360
"#;

/// Light is measured in a square of this many pixels to each side of its middle.
const REACH: u32 = 3;

/// Azimuth and apparent altitude of the belt of Orion in that night, degrees.
const BELT: [f64; 2] = [198.2, 51.9];

fn main() {
    support::run([
        GpuTest::new(
            "fifty_stars_have_their_flux_at_any_size_and_field",
            fifty_stars_have_their_flux,
        ),
        GpuTest::new("objects_stand_where_the_description_says", objects_stand_where_described),
        GpuTest::new("moon_and_sun_have_their_flux_at_any_size", moon_and_sun_have_their_flux),
        GpuTest::new("a_globe_has_the_light_of_the_moon_at_any_size", globe_has_its_light),
        GpuTest::new("a_disc_is_that_of_its_plan", disc_is_that_of_its_plan),
        GpuTest::new("limbs_stand_right_in_the_narrowest_field", limbs_in_the_narrowest_field),
        GpuTest::new("the_setting_sun_has_its_flux_and_its_rims", setting_sun_has_its_rims),
        GpuTest::new("the_sky_is_that_of_its_tables", sky_is_that_of_its_tables),
    ])
}

fn scene() -> Scene {
    Scene::parse(NIGHT).expect("the scene of this test")
}

/// The frame without its stars and planets: what is behind them.
fn backdrop(renderer: &Renderer, scene: &Scene) -> Result<HdrFrame, Failed> {
    let mut scene = scene.clone();
    (scene.layers.stars, scene.layers.planets) = (false, false);
    Ok(drawn(renderer, &scene)?.0)
}

/// Light of a window above what is behind it: illuminance in lux and centroid in pixels.
fn measured(
    [frame, behind]: [&HdrFrame; 2],
    setting: &Setting,
    centre: [f64; 2],
) -> (f64, [f64; 2]) {
    let middle = centre.map(|c| c.floor() as u32);
    let (mut sum, mut centroid) = (0.0, [0.0, 0.0]);
    for y in middle[1] - REACH..=middle[1] + REACH {
        for x in middle[0] - REACH..=middle[0] + REACH {
            let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let above = frame.xyzv(x, y).y - behind.xyzv(x, y).y;
            let light = above * setting.camera.pixel_solid_angle_sr(pixel);
            sum += light;
            centroid = [centroid[0] + light * pixel[0], centroid[1] + light * pixel[1]];
        }
    }
    (sum, centroid.map(|c| c / sum))
}

/// The brightest objects in view that stand alone and not at the edge, with their pixels.
fn lonely(picture: &Description, most: usize) -> Vec<(&DescribedObject, [f64; 2])> {
    let camera = &picture.camera;
    let reach = f64::from(REACH);
    let mut seen: Vec<_> = picture
        .objects
        .iter()
        .filter_map(|object| Some((object, [object.x_px?, object.y_px?])))
        .collect();
    seen.sort_by(|a, b| a.0.magnitude_v.total_cmp(&b.0.magnitude_v));
    let inside = |v: f64, edge: u32| v > reach + 2.0 && v < f64::from(edge) - reach - 2.0;
    let alone = |object: &DescribedObject, at: [f64; 2]| {
        seen.iter().all(|(other, place)| {
            let apart = (place[0] - at[0]).abs().max((place[1] - at[1]).abs());
            // What is fainter than a thousandth disturbs nothing here.
            apart > reach + 3.0
                || other.catalogue == object.catalogue && other.name == object.name
                || other.illuminance_ground_lx < 1e-3 * object.illuminance_ground_lx
        })
    };
    let is_point = |object: &DescribedObject| matches!(object.kind, "star" | "planet");
    seen.iter()
        .filter(|(object, [x, y])| {
            is_point(object)
                && inside(*x, camera.width_px)
                && inside(*y, camera.height_px)
                && alone(object, [*x, *y])
        })
        .take(most)
        .copied()
        .collect()
}

fn fifty_stars_have_their_flux(renderer: &Renderer) -> Result<(), Failed> {
    for (width_px, height_px) in [(640, 360), (3840, 2160)] {
        for fov_deg in [20.0, 120.0] {
            let mut scene = scene();
            let camera = &mut scene.camera;
            (camera.width_px, camera.height_px) = (width_px, height_px);
            camera.field_of_view_deg = fov_deg;
            let (frame, setting, night) = drawn(renderer, &scene)?;
            let picture = Description::of(&setting, &night);
            let behind = backdrop(renderer, &scene)?;
            let mut stars = lonely(&picture, 60);
            stars.retain(|(object, _)| object.kind == "star");
            stars.truncate(50);
            check(stars.len() == 50, || format!("only {} stars at {fov_deg}°", stars.len()))?;
            for (star, at) in stars {
                let (through_air, _) = measured([&frame, &behind], &setting, at);
                // The air undone: what it left of the light is in the description.
                let outside = through_air * star.illuminance_lx / star.illuminance_ground_lx;
                let expected = 2.54e-6 * 10f64.powf(-0.4 * star.magnitude_v);
                let error = outside / expected - 1.0;
                check(error.abs() < 0.005, || {
                    format!("{width_px} px, {fov_deg}°: {} is off by {error:.4}", star.name)
                })?;
            }
        }
    }
    Ok(())
}

fn objects_stand_where_described(renderer: &Renderer) -> Result<(), Failed> {
    for (projection, fov_deg) in [
        (Projection::Perspective, 60.0),
        (Projection::Stereographic, 120.0),
        (Projection::Equidistant, 180.0),
        (Projection::EqualArea, 180.0),
        (Projection::Equirectangular, 360.0),
        (Projection::Perspective, 4.0),
    ] {
        let mut scene = scene();
        let camera = &mut scene.camera;
        (camera.width_px, camera.height_px) = (1200, 800);
        (camera.projection, camera.field_of_view_deg) = (projection, fov_deg);
        camera.roll_deg = 7.0;
        if fov_deg < 10.0 {
            // Towards the belt of Orion.
            (camera.azimuth_deg, camera.altitude_deg) = (BELT[0], BELT[1]);
        }
        if projection == Projection::Equirectangular {
            (camera.altitude_deg, camera.roll_deg) = (0.0, 0.0);
        }
        let (frame, setting, night) = drawn(renderer, &scene)?;
        let picture = Description::of(&setting, &night);
        let behind = backdrop(renderer, &scene)?;
        let objects = lonely(&picture, 40);
        let enough = if fov_deg < 10.0 { 3 } else { 25 };
        check(objects.len() >= enough, || format!("{projection:?}: {} objects", objects.len()))?;
        for (object, at) in objects {
            let (_, centroid) = measured([&frame, &behind], &setting, at);
            let off = (centroid[0] - at[0]).hypot(centroid[1] - at[1]);
            check(off < 0.1, || format!("{projection:?}: {} is off by {off:.3} px", object.name))?;
        }
    }
    Ok(())
}

fn moon_and_sun_have_their_flux(renderer: &Renderer) -> Result<(), Failed> {
    // The Moon on a dark night, the Sun in an airless sky made by switching the skylight off.
    for (utc, name, azimuth_deg, altitude_deg) in [
        ("2026-08-25T05:30:00Z", "Moon", 181.0, 32.0),
        ("2026-08-12T19:30:00Z", "Sun", 180.0, 69.0),
    ] {
        for (fov_deg, width_px) in [(10.0, 640), (60.0, 640), (120.0, 640), (60.0, 2400)] {
            let mut scene = scene();
            scene.utc = utc.to_owned();
            scene.layers.skylight = false;
            scene.layers.stars = false;
            scene.layers.planets = false;
            scene.layers.ground = false;
            let camera = &mut scene.camera;
            (camera.width_px, camera.height_px) = (width_px, width_px / 2);
            camera.field_of_view_deg = fov_deg;
            (camera.azimuth_deg, camera.altitude_deg) = (azimuth_deg, altitude_deg);
            let (frame, setting, night) = drawn(renderer, &scene)?;
            let picture = Description::of(&setting, &night);
            let body = picture.objects.iter().find(|object| object.name == name);
            let body = body.ok_or("not described")?;
            check(body.x_px.is_some(), || format!("{name} is not in view: {body:?}"))?;
            let sum = illuminance(&frame, &setting.camera).y;
            let error = sum / body.illuminance_ground_lx - 1.0;
            check(error.abs() < 0.005, || {
                format!("{name}, {fov_deg}° on {width_px} px: off by {error:.4}")
            })?;
        }
    }
    Ok(())
}

/// The Moon alone in the middle of a square picture.
fn moon(utc: &str, field_deg: f64, width_px: u32) -> Result<Scene, Failed> {
    let mut scene = scene();
    scene.utc = utc.to_owned();
    (scene.layers.skylight, scene.layers.ground) = (false, false);
    (scene.layers.stars, scene.layers.planets, scene.layers.sun) = (false, false, false);
    let (_, _, _, night) = laid(&scene)?;
    let apparent = night.body(Body::Moon).ok_or("no Moon")?.apparent;
    let camera = &mut scene.camera;
    (camera.azimuth_deg, camera.altitude_deg) =
        (apparent.azimuth().deg(), apparent.altitude().deg());
    (camera.field_of_view_deg, camera.width_px, camera.height_px) = (field_deg, width_px, width_px);
    Ok(scene)
}

fn globe_has_its_light(renderer: &Renderer) -> Result<(), Failed> {
    // Crescent, first quarter, nearly full, in an eclipse; from 8 pixels across to 2000.
    for utc in [
        "2026-08-17T01:30:00Z",
        "2026-08-20T03:30:00Z",
        "2026-08-27T06:00:00Z",
        "2026-03-03T10:30:00Z",
    ] {
        for (field_deg, width_px) in
            [(15.9, 256), (12.0, 256), (7.3, 256), (4.0, 256), (1.0, 256), (0.7, 700), (0.56, 2100)]
        {
            let (frame, setting, night) = drawn(renderer, &moon(utc, field_deg, width_px)?)?;
            let sum = illuminance(&frame, &setting.camera);
            let expected = night.body(Body::Moon).ok_or("no Moon")?.ground;
            for (got, wanted) in [(sum.x, expected.x), (sum.y, expected.y), (sum.z, expected.z)] {
                let error = got / wanted - 1.0;
                check(error.abs() < 0.005, || {
                    format!("{utc}, {field_deg}° on {width_px} px: off by {error:.4}")
                })?;
            }
        }
    }
    Ok(())
}

/// The Sun over the sea at an equinox, its centre a third of a degree above the horizon, and nothing
/// else.
fn sunset() -> Scene {
    let mut scene = scene();
    scene.utc = "2026-03-20T18:08:10Z".to_owned();
    (scene.place.latitude_deg, scene.place.longitude_deg, scene.place.height_m) = (0.0, 0.0, 0.0);
    (scene.layers.skylight, scene.layers.ground) = (false, false);
    (scene.layers.stars, scene.layers.planets, scene.layers.moon) = (false, false, false);
    let camera = &mut scene.camera;
    camera.projection = Projection::Perspective;
    (camera.azimuth_deg, camera.altitude_deg) = (270.0, 0.3);
    (camera.field_of_view_deg, camera.width_px, camera.height_px) = (0.7, 300, 300);
    scene
}

/// The light of a disc in the middle of a pixel, in 64 bits, by the way that the shader goes.
fn twin(disc: &Disc, setting: &Setting, pixel: [f64; 2]) -> Option<(Xyzv, f64)> {
    let camera = &setting.camera;
    let dir = camera.view_from_apparent().inverse() * camera.view_from_pixel(pixel)?;
    let place = (dir.altitude() - disc.lowest.altitude()).rad() / disc.step.rad();
    let mut light = Xyzv::BLACK;
    let mut farthest = 0.0f64;
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
        farthest = farthest.max(off.length());
        if off.length() < 1.0 && place >= 0.0 {
            let mu = (1.0 - off.length_squared()).sqrt();
            let darkened = band.limb_darkening.iter().rev().fold(0.0, |sum, a| sum * mu + a);
            light += (low.luminance * (1.0 - along) + high.luminance * along) * darkened;
        }
    }
    Some((light, farthest))
}

fn disc_is_that_of_its_plan(renderer: &Renderer) -> Result<(), Failed> {
    for projection in [
        Projection::Perspective,
        Projection::Stereographic,
        Projection::Equidistant,
        Projection::EqualArea,
        Projection::Equirectangular,
    ] {
        // Low and in many colours, and high near the zenith, turned and aside in a wide field.
        for (utc, azimuth_deg, altitude_deg, fov_deg) in
            [("2026-03-20T18:08:10Z", 270.0, 0.3, 0.7), ("2026-03-20T12:10:00Z", 240.0, 75.0, 40.0)]
        {
            let mut scene = sunset();
            scene.utc = utc.to_owned();
            scene.camera.projection = projection;
            scene.camera.roll_deg =
                if projection == Projection::Equirectangular { 0.0 } else { 20.0 };
            (scene.camera.azimuth_deg, scene.camera.altitude_deg) = (azimuth_deg, altitude_deg);
            scene.camera.field_of_view_deg = fov_deg;
            if fov_deg > 10.0 {
                (scene.camera.width_px, scene.camera.height_px) = (1600, 1600);
            }
            let (plan, _, setting, _) = laid(&scene)?;
            let frame = renderer.frame(&plan)?.frame;
            let disc = plan.discs.first().ok_or_else(|| format!("{projection:?}: no disc"))?;
            let mut compared = 0;
            for y in 0..frame.height_px() {
                for x in 0..frame.width_px() {
                    let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                    let Some((expected, farthest)) = twin(disc, &setting, pixel) else { continue };
                    let drawn = frame.xyzv(x, y);
                    // The limb itself is for the other tests.
                    if farthest > 1.0 + disc.edge {
                        check(drawn.y == 0.0, || format!("{projection:?}: light at {x}, {y}"))?;
                    } else if farthest < 1.0 - disc.edge && expected.y > 0.0 {
                        compared += 1;
                        let error = (drawn.y / expected.y - 1.0).abs();
                        let within = if fov_deg > 10.0 { 0.02 } else { 0.004 };
                        check(error < within, || {
                            format!("{projection:?}, {utc}: {x}, {y} is off by {error:.5}")
                        })?;
                    }
                }
            }
            check(compared > 60, || format!("{projection:?}, {utc}: {compared} pixels"))?;
        }
    }
    Ok(())
}

fn limbs_in_the_narrowest_field(renderer: &Renderer) -> Result<(), Failed> {
    // Rays run straight, so that the limb is where the circle is.
    let mut scene = sunset();
    scene.utc = "2026-03-20T14:30:00Z".to_owned();
    scene.air = scene.air.straight();
    (scene.camera.width_px, scene.camera.height_px) = (960, 160);
    let (_, _, _, night) = laid(&scene)?;
    let sun = &night.sky.sun;
    let law = LimbDarkening::at_nm(555.0);
    let centre = sun.dir.vector();
    let side = centre.any_orthonormal_vector();
    let across = centre.cross(side);
    for turn_deg in [0.0f64, 77.0, 190.0, 281.0] {
        let (sin, cos) = turn_deg.to_radians().sin_cos();
        let radial = side * cos + across * sin;
        let (sin_radius, cos_radius) = sun.angular_radius.sin_cos();
        let limb: Dir<Apparent> = Dir::from_vector(centre * cos_radius + radial * sin_radius);
        let camera = &mut scene.camera;
        (camera.azimuth_deg, camera.altitude_deg) = (limb.azimuth().deg(), limb.altitude().deg());
        camera.field_of_view_deg = 0.02;
        // Turned so that the limb runs upright through the picture.
        for roll_deg in [0.0, 90.0] {
            scene.camera.roll_deg = roll_deg;
            let (plan, _, setting, _) = laid(&scene)?;
            let frame = renderer.frame(&plan)?.frame;
            let band = &plan.discs.first().ok_or("no Sun")?.bands[0];
            let middle = band.nodes[band.nodes.len() / 2].luminance;
            let camera = &setting.camera;
            // Cosine of the emission angle, where there is Sun.
            let emission = |pixel: [f64; 2]| -> Option<f64> {
                let view = camera.view_from_pixel(pixel)?;
                let dir = camera.view_from_apparent().inverse() * view;
                let off = dir.vector() - centre * dir.vector().dot(centre);
                let share = off.length() / sin_radius;
                (share < 1.0).then(|| (1.0 - share * share).sqrt())
            };
            let inside = |pixel: [f64; 2]| emission(pixel).is_some();
            for x in (3..camera.width_px - 3).step_by(97) {
                // Light of the column, in pixels as bright as the middle of the disc.
                let (mut lit, mut expected) = (0.0, 0.0);
                for y in 0..camera.height_px {
                    lit += frame.xyzv(x, y).y / middle.y;
                    const STEPS: u32 = 50;
                    for step in 0..STEPS {
                        let row = f64::from(y) + (f64::from(step) + 0.5) / f64::from(STEPS);
                        let mu = emission([f64::from(x) + 0.5, row]);
                        expected +=
                            mu.map_or(0.0, |mu| law.relative_to_centre(mu)) / f64::from(STEPS);
                    }
                }
                let within = 0.01 * expected + 0.1;
                check((lit - expected).abs() < within, || {
                    format!("{turn_deg}°, column {x}: {lit:.2} px lit, not {expected:.2}")
                })?;
                // The row in which the limb is, from how much of its pixel is lit.
                let edges: Vec<u32> = (1..camera.height_px - 1)
                    .filter(|&y| {
                        let pixel = |row: f64| inside([f64::from(x) + 0.5, f64::from(y) + row]);
                        pixel(0.0) != pixel(1.0)
                    })
                    .collect();
                for y in edges {
                    let beyond = [frame.xyzv(x, y - 1).y, frame.xyzv(x, y + 1).y];
                    let full = beyond[0].max(beyond[1]);
                    if full <= 0.0 || beyond[0] > 0.0 && beyond[1] > 0.0 {
                        continue;
                    }
                    let share = frame.xyzv(x, y).y / full;
                    let steps = 200;
                    let expected = (0..steps)
                        .filter(|step| {
                            let row = f64::from(y) + (f64::from(*step) + 0.5) / f64::from(steps);
                            inside([f64::from(x) + 0.5, row])
                        })
                        .count() as f64
                        / f64::from(steps);
                    check((share - expected).abs() < 0.1, || {
                        format!("{turn_deg}°, {x}, {y}: {share:.3} of the pixel, not {expected:.3}")
                    })?;
                }
            }
        }
    }
    Ok(())
}

fn setting_sun_has_its_rims(renderer: &Renderer) -> Result<(), Failed> {
    // Whole, cut by the horizon, and almost gone. `expected` knows one refraction: red, which stands
    // lower, loses a little more.
    for (utc, field_deg, within) in [
        ("2026-03-20T18:08:10Z", 0.7, 0.015),
        ("2026-03-20T18:09:20Z", 0.7, 0.025),
        ("2026-03-20T18:10:20Z", 0.7, 0.05),
        ("2026-03-20T18:09:20Z", 6.0, 0.025),
        ("2026-03-20T18:09:20Z", 30.0, 0.03),
    ] {
        let mut scene = sunset();
        scene.utc = utc.to_owned();
        scene.camera.field_of_view_deg = field_deg;
        let (frame, setting, night) = drawn(renderer, &scene)?;
        let mut sum = Xyzv::BLACK;
        let mut rows = Vec::new();
        for y in 0..frame.height_px() {
            let mut row = Xyzv::BLACK;
            for x in 0..frame.width_px() {
                let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                row += frame.xyzv(x, y) * setting.camera.pixel_solid_angle_sr(pixel);
            }
            sum += row;
            rows.push(row);
        }
        let expected = night.body(Body::Sun).ok_or("no Sun")?.ground;
        check(expected.y > 0.0, || format!("{utc}: the Sun has set"))?;
        for (got, wanted) in [(sum.x, expected.x), (sum.y, expected.y), (sum.v, expected.v)] {
            let error = got / wanted - 1.0;
            check(error.abs() < within, || format!("{utc}, {field_deg}°: off by {error:.4}"))?;
        }
        if field_deg > 1.0 || within > 0.03 {
            continue;
        }
        // Along the middle: green above, red below, and the colour of the Sun between. The upper rim is
        // some pixels of 8" high.
        let redness = |light: Xyzv| light.x / light.y;
        let lit: Vec<usize> = (0..rows.len()).filter(|&y| rows[y].y > 1e-4 * sum.y).collect();
        let (first, last) = (lit[0], lit[lit.len() - 1]);
        let middle = redness(rows[(first + last) / 2]);
        let top = redness(rows[first]);
        check(top < 0.9 * middle, || format!("{utc}: the upper rim is not green: {top} {middle}"))?;
        if utc.ends_with("08:10Z") {
            let bottom = redness(rows[last]);
            let rise = |outer: f64, inner: usize| outer / redness(rows[last - inner]) - 1.0;
            let (at_rim, inside) = (rise(bottom, 2), rise(redness(rows[last - 6]), 8));
            check(at_rim > 0.02 && inside < 0.25 * at_rim, || {
                format!("{utc}: the lower rim is not red: {at_rim} {inside}")
            })?;
        }
    }
    Ok(())
}

fn sky_is_that_of_its_tables(renderer: &Renderer) -> Result<(), Failed> {
    // Twilight with a Moon: all three tables are at work. And the Milky Way in summer, whose map the
    // GPU holds in half floats.
    for (utc, within) in [("2026-08-24T02:45:00Z", 2e-3), ("2026-08-12T04:30:00Z", 5e-3)] {
        let mut scene = scene();
        scene.utc = utc.to_owned();
        (scene.camera.azimuth_deg, scene.camera.altitude_deg) = (225.0, 30.0);
        (scene.layers.stars, scene.layers.planets, scene.layers.moon) = (false, false, false);
        sky_is_that_of_its_plan(renderer, &scene, within)?;
    }
    Ok(())
}

fn sky_is_that_of_its_plan(renderer: &Renderer, scene: &Scene, within: f64) -> Result<(), Failed> {
    let (plan, _, setting, _) = laid(scene)?;
    check(plan.sky.dark.iter().all(|light| light.y > 0.0), || "no dark sky".to_owned())?;
    let milky_way = plan.milky_way.as_ref().ok_or("no Milky Way")?;
    let frame = renderer.frame(&plan)?.frame;
    let camera = &setting.camera;
    for x in (7..camera.width_px).step_by(31) {
        for y in (5..camera.height_px).step_by(17) {
            let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let view = camera.view_from_pixel(pixel).ok_or("no sky there")?;
            let dir = camera.view_from_apparent().inverse() * view;
            if dir.altitude().deg() < 0.2 {
                continue;
            }
            let expected = plan.sky.luminance(dir) + milky_way.luminance(dir);
            let drawn = frame.xyzv(x, y);
            let error = (drawn.y / expected.y - 1.0).abs().max((drawn.v / expected.v - 1.0).abs());
            check(error < within, || format!("pixel {x}, {y} is off by {error:.5}"))?;
        }
    }
    Ok(())
}

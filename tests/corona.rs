//! Total eclipses of the Sun as they are drawn: the corona, and the sky that differs on both sides of it.

#[path = "support/mod.rs"]
mod support;

use libtest_mimic::Failed;
use nocturne::ephemeris::Body;
use nocturne::frame::{Apparent, Dir};
use nocturne::render::Renderer;
use nocturne::scene::Scene;
use nocturne::units::Angle;
use support::{GpuTest, check, drawn, illuminance, laid};

/// Near Torreon in the middle of totality on 2024-04-08, and the day before.
const TOTALITY: &str = "2024-04-08T18:18:45Z";
const DAY_BEFORE: &str = "2024-04-07T18:18:45Z";
/// Thirty seconds before and after the contacts.
const BEFORE: &str = "2024-04-08T18:16:00Z";

fn main() {
    support::run([
        GpuTest::new("the_corona_has_its_light", the_corona_has_its_light),
        GpuTest::new("it_is_dark_behind_the_moon", it_is_dark_behind_the_moon),
        GpuTest::new("no_corona_without_totality", no_corona_without_totality),
        GpuTest::new("both_sides_of_the_sky_are_drawn_as_laid", both_sides_are_drawn_as_laid),
    ])
}

/// The Sun alone in the middle of a square picture.
fn sun(utc: &str, field_of_view_deg: f64, width_px: u32) -> Result<Scene, Failed> {
    let text = format!(
        "nocturne_scene = 2\nutc = \"{utc}\"\n[place]\nlatitude_deg = 25.54\nlongitude_deg = -103.41\nheight_m = 1120.0\n\
         [camera]\nazimuth_deg = 180.0\naltitude_deg = 70.0\nfield_of_view_deg = {field_of_view_deg}\nprojection = \"perspective\"\n\
         width_px = {width_px}\nheight_px = {width_px}\n"
    );
    let mut scene = Scene::parse(&text)?;
    (scene.layers.skylight, scene.layers.ground) = (false, false);
    (scene.layers.stars, scene.layers.planets, scene.layers.moon) = (false, false, false);
    let (_, _, _, night) = laid(&scene)?;
    let apparent = night.body(Body::Sun).ok_or("no Sun")?.apparent;
    (scene.camera.azimuth_deg, scene.camera.altitude_deg) =
        (apparent.azimuth().deg(), apparent.altitude().deg());
    Ok(scene)
}

fn the_corona_has_its_light(renderer: &Renderer) -> Result<(), Failed> {
    for (field_deg, width_px) in [(11.0, 900), (14.0, 300), (50.0, 300), (100.0, 400)] {
        let (frame, setting, night) = drawn(renderer, &sun(TOTALITY, field_deg, width_px)?)?;
        let covered = night.eclipse.sun.ok_or("no eclipse")?;
        check(covered.is_total(), || format!("{covered:?}"))?;
        let sum = illuminance(&frame, &setting.camera);
        // In totality the Sun has the light of its corona, as far as it is not hidden, and no other.
        let expected = night.body(Body::Sun).ok_or("no Sun")?.ground;
        let off = sum.y / expected.y - 1.0;
        println!("{field_deg}° on {width_px} px: {:.4} lx, off by {off:+.4}", sum.y);
        check(off.abs() < 0.02, || format!("{field_deg}° on {width_px} px: off by {off:.4}"))?;
    }
    Ok(())
}

fn it_is_dark_behind_the_moon(renderer: &Renderer) -> Result<(), Failed> {
    let (frame, _, night) = drawn(renderer, &sun(TOTALITY, 3.0, 301)?)?;
    let radius_px = night.sky.moon.state.angular_radius.deg() * 301.0 / 3.0;
    let light = |off_px: f64| frame.xyzv((150.0 + off_px) as u32, 150).y;
    check(light(0.0) == 0.0, || format!("{}", light(0.0)))?;
    let (near, far) = (light(1.15 * radius_px), light(3.0 * radius_px));
    // Some thousand cd/m2 at the limb; a hundredth of it two radii out.
    check((300.0..10_000.0).contains(&near), || format!("{near} cd/m2"))?;
    check(far > 0.0 && far < 0.1 * near, || format!("{far} cd/m2"))
}

fn both_sides_are_drawn_as_laid(renderer: &Renderer) -> Result<(), Failed> {
    let mut scene = sun(TOTALITY, 60.0, 64)?;
    (scene.layers.skylight, scene.layers.ground) = (true, true);
    // To the south of the line, where it is darker to the north.
    scene.place.latitude_deg -= 0.6;
    let (plan, _, _, night) = laid(&scene)?;
    check(plan.sky.sun_left.is_some(), || "no shadow in the air".to_owned())?;
    let azimuth = night.sky.sun.dir.azimuth();
    let dirs: Vec<Dir<Apparent>> = (0..72)
        .map(|k| {
            (f64::from(k % 12) * 30.0 - 165.0, [-30.0, -2.0, 1.0, 8.0, 30.0, 70.0][k as usize / 12])
        })
        .map(|(from_sun, altitude)| {
            Dir::from_azimuth_altitude(
                azimuth + Angle::from_deg(from_sun),
                Angle::from_deg(altitude),
            )
        })
        .collect();
    let drawn = renderer.sky_in(&plan.sky, &dirs).map_err(|error| error.to_string())?;
    let mut most = 1.0f64;
    for (k, (dir, drawn)) in dirs.iter().zip(&drawn).enumerate() {
        let laid = plan.sky.luminance(*dir);
        check((drawn.y / laid.y - 1.0).abs() < 2e-3, || {
            format!("{:.0}°: {} drawn, {} laid", dir.altitude().deg(), drawn.y, laid.y)
        })?;
        // The mirror image of the direction beside the Sun is another light.
        let mirrored = plan.sky.luminance(dirs[k / 12 * 12 + 11 - k % 12]);
        most = most.max(mirrored.y / laid.y);
    }
    check(most > 1.2, || format!("both sides are alike within {most}"))
}

fn no_corona_without_totality(_: &Renderer) -> Result<(), Failed> {
    for (utc, is_drawn) in
        [(TOTALITY, true), (DAY_BEFORE, false), ("2024-04-08T17:30:00Z", false), (BEFORE, true)]
    {
        let (plan, ledger, _, _) = laid(&sun(utc, 12.0, 100)?)?;
        let drawn = ledger.of("corona").map_or(0, |entry| entry.drawn);
        check((drawn == 1) == is_drawn, || format!("{utc}: {:?}", ledger.of("corona")))?;
        let discs = plan.discs.iter().filter(|disc| disc.label == "corona").count();
        check(discs == drawn, || format!("{utc}: {discs} discs"))?;
    }
    Ok(())
}

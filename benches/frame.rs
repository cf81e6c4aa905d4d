//! What a frame costs: the plan on the CPU, the passes on the GPU, and the long computations.
//!
//! `cargo bench --bench frame`; `cargo bench --bench frame -- stars` for what stars cost alone, and
//! `-- eye` for what an eye and a camera cost. Times are medians, in milliseconds; ratios are to the
//! trivial pass of the same run and size, the sky of a plan without any light, so that machines compare.
//! Without a graphics adapter only the CPU's part is printed, and the reason.

use std::borrow::Borrow;
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant as Clock;

use nocturne::air::Atmosphere;
use nocturne::air::scattering::{Quality, SKY_NODES_NM, ScatteringTables};
use nocturne::camera::Camera;
use nocturne::catalog::{CatalogError, Catalogs, MilkyWay, MoonMaps, Star};
use nocturne::display::Display;
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::eye::{Eye, Model};
use nocturne::frame::Dir;
use nocturne::light::night::Night;
use nocturne::light::star_light::StarLight;
use nocturne::light::sun;
use nocturne::photo::Photo;
use nocturne::plan::data::SkyData;
use nocturne::plan::lay::{Kept, lay_in};
use nocturne::plan::skylight::{COMPUTED_SHAPE, SolvedAir};
use nocturne::plan::{FramePlan, SkyPlan, Splat};
use nocturne::render::picture::Depth;
use nocturne::render::sky_tiles::{SkyDetail, tiles};
use nocturne::render::{Look, Renderer, Viewer};
use nocturne::scene::{Layers, Scene, Setting};
use nocturne::sky::SkyState;
use nocturne::sky::star_index::StarIndex;
use nocturne::store::Store;
use nocturne::units::{AU_KM, Angle, Magnitude};

/// Flagstaff, by new Moon, by full Moon, and in the forenoon; UTC.
const SKIES: [(&str, &str); 3] = [
    ("dark night", "2026-08-13T04:30:00Z"),
    ("moonlit night", "2026-08-28T06:00:00Z"),
    ("day", "2026-08-15T17:00:00Z"),
];
/// Moons, by phase, UTC and field, degrees.
const MOONS: [(&str, &str, f64); 4] = [
    ("nine days old", "2026-08-22T04:00:00Z", 90.0),
    ("nine days old", "2026-08-22T04:00:00Z", 10.0),
    ("nine days old", "2026-08-22T04:00:00Z", 1.0),
    ("nearly full", "2026-08-27T06:00:00Z", 1.0),
];
/// What viewers look at: the same skies, and dusk.
const VIEWED: [(&str, &str); 4] = [SKIES[0], SKIES[1], ("dusk", "2026-08-13T02:45:00Z"), SKIES[2]];
/// The passes of viewers.
const VIEWING: [&str; 10] = [
    "half",
    "light of points",
    "coarser",
    "glare",
    "retina",
    "seen",
    "seeing",
    "points",
    "meter",
    "photo",
];
const SIZES: [(u32, u32); 2] = [(1280, 720), (1920, 1080)];
const SPLATS: [usize; 3] = [1000, 9096, 90_960];
/// Repetitions whose median is taken: of frames, and of what takes a second.
const FRAMES: usize = 15;
const SLOW: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let catalogs = Catalogs::locate(None)?;
    if std::env::args().any(|argument| argument == "stars") {
        return stars(&Renderer::new()?, &catalogs);
    }
    let moon_maps = catalogs.moon_maps()?;
    if std::env::args().any(|argument| argument == "eye") {
        return viewers(&Renderer::new()?, &catalogs, &moon_maps);
    }
    computations();
    println!("\nPlans, ms                          size   Night::of         lay  splats  discs");
    let mut plans = Vec::new();
    for size in SIZES {
        for (name, utc) in SKIES {
            plans.push((name, plan(name, utc, size, &catalogs, &moon_maps)?));
        }
    }
    let renderer = match Renderer::new() {
        Ok(renderer) => renderer,
        Err(error) => {
            println!("\nNo passes: {error}");
            return Ok(());
        }
    };
    println!("\nPasses on {}", renderer.adapter());
    for (width_px, height_px) in SIZES {
        let of_size: Vec<_> =
            plans.iter().filter(|(_, plan)| plan.camera.width_px == width_px).collect();
        let (_, night) = of_size[0];
        let trivial_ms = passes(&renderer, &empty(night.camera))?.of("sky");
        println!("{width_px}x{height_px}: trivial pass {trivial_ms:.2} ms");
        let line = |name: &str, pass: &str, ms: f64| {
            println!("  {name:24} {pass:20} {ms:9.2} ms {:7.2}", ms / trivial_ms);
        };
        for (name, plan) in &of_size {
            let cost = passes(&renderer, plan)?;
            for (pass, ms) in &cost.passes {
                line(name, pass, *ms);
            }
            line(name, "with the way back", cost.wall_ms);
            let cut = || tiles(&plan.sky, &plan.camera, SkyDetail::Tiles);
            line(name, "cutting tiles, CPU", median_ms(FRAMES, cut));
            let exact: u32 = cut().exact.iter().map(|[x0, y0, x1, y1]| (x1 - x0) * (y1 - y0)).sum();
            let share = f64::from(exact) / f64::from(width_px * plan.camera.height_px);
            println!(
                "  {name:24} {} smooth tiles, {:.1} % of the pixels exact",
                cut().smooth.len(),
                100.0 * share
            );
            let every_pixel = passes_with(&renderer, plan, SkyDetail::EveryPixel)?.of("sky");
            line(name, "sky, every pixel", every_pixel);
        }
        for count in SPLATS {
            let splats: Vec<Splat> = night.splats.iter().copied().cycle().take(count).collect();
            let cost = passes(&renderer, &FramePlan { splats, ..empty(night.camera) })?;
            line(&format!("{count} splats"), "splats", cost.of("splats"));
        }
    }
    stars(&renderer, &catalogs)?;
    viewers(&renderer, &catalogs, &moon_maps)?;
    for (phase, utc, field_deg) in MOONS {
        println!("The Moon, {phase}, in a field of {field_deg}°, 1920x1080");
        moon(&renderer, utc, field_deg, &catalogs, &moon_maps)?;
    }
    Ok(())
}

/// What an eye and a camera cost, after the frame.
fn viewers(
    renderer: &Renderer,
    catalogs: &Catalogs,
    moon_maps: &MoonMaps,
) -> Result<(), Box<dyn Error>> {
    println!("\nPlans, ms                          size   Night::of         lay  splats  discs");
    let mut plans = Vec::new();
    for size in [(960, 540), (1920, 1080), (3840, 2160)] {
        if std::env::var_os("EYE8_DEBUG").is_some() && size.0 != 1920 {
            continue;
        }
        for (name, utc) in VIEWED {
            plans.push((name, plan(name, utc, size, catalogs, moon_maps)?));
        }
    }
    println!("Viewers on {}: medians of the passes after the frame, ms", renderer.adapter());
    let (eye, paper) = (Eye::default(), Eye { model: Model::Paper, ..Eye::default() });
    let (camera, display) = (Photo::default(), Display::default());
    let viewers = [
        ("eye", Viewer::Eye(&eye)),
        ("paper", Viewer::Eye(&paper)),
        ("camera", Viewer::Photo(&camera)),
    ];
    for (name, plan) in &plans {
        let size = format!("{}x{}", plan.camera.width_px, plan.camera.height_px);
        let trivial_ms = passes(renderer, &empty(plan.camera))?.of("sky");
        for (who, viewer) in viewers {
            let look = Look { viewer, display: &display, depth: Depth::Codes };
            renderer.look(plan, &look, false)?;
            if std::env::var_os("EYE8_DEBUG").is_some() {
                if who == "paper" {
                    continue;
                }
                let cpu = || -> f64 {
                    let mut sum = 0.0;
                    for task in std::fs::read_dir("/proc/self/task").unwrap().flatten() {
                        let stat = std::fs::read_to_string(task.path().join("schedstat"));
                        let ns = stat.ok().and_then(|s| s.split(' ').next()?.parse::<f64>().ok());
                        sum += ns.unwrap_or(0.0) * 1e-6;
                    }
                    sum
                };
                let mut most = Vec::new();
                for _ in 0..8 {
                    let before = cpu();
                    renderer.look(plan, &look, false)?;
                    most.push(cpu() - before);
                }
                let mut frames = Vec::new();
                for _ in 0..8 {
                    let before = cpu();
                    renderer.frame_with(plan, SkyDetail::Tiles)?;
                    frames.push(cpu() - before);
                }
                most.sort_by(f64::total_cmp);
                frames.sort_by(f64::total_cmp);
                println!(
                    "CPU {name} {who}: look {:.1} {:.1}, frame {:.1} {:.1}",
                    most[0], most[4], frames[0], frames[4]
                );
            }
            let mut runs = Vec::new();
            for _ in 0..FRAMES {
                let mut by_pass: Vec<(String, f64)> = Vec::new();
                for time in renderer.look(plan, &look, false)?.times {
                    match by_pass.iter_mut().find(|(pass, _)| *pass == time.pass) {
                        Some((_, ms)) => *ms += time.milliseconds,
                        None => by_pass.push((time.pass, time.milliseconds)),
                    }
                }
                by_pass.retain(|(pass, _)| VIEWING.contains(&pass.as_str()));
                runs.push(by_pass);
            }
            let total_ms = median(runs.iter().map(|run| run.iter().map(|(_, ms)| ms).sum()));
            print!(
                "  {name:14} {size:>9} {who:7} {total_ms:7.1} ms {:6.2}:",
                total_ms / trivial_ms
            );
            for (number, (pass, _)) in runs[0].iter().enumerate() {
                print!(" {pass} {:.1}", median(runs.iter().map(|run| run[number].1)));
            }
            println!();
        }
    }
    Ok(())
}

/// What stars add to a frame: light, lay and splats, by what is in view.
fn stars(renderer: &Renderer, catalogs: &Catalogs) -> Result<(), Box<dyn Error>> {
    println!("Stars, 1920x1080, tables kept");
    let air = Atmosphere::default();
    let starlight = || StarLight::new(&air, 2106.0);
    println!("  StarLight::new {:19.2} ms", median_ms(SLOW, starlight));
    let bright = catalogs.stars()?;
    let index = || StarIndex::new(bright.clone());
    println!("  StarIndex::new {:19.2} ms", median_ms(SLOW, index));
    // All of them in one field of 90 degrees: right ascensions and polar distances drawn together.
    let crowded: Vec<Star> = bright.iter().map(crowd).collect();
    // Nine more of each star, turned about the pole, fainter by 2.5 magnitudes.
    let many: Vec<Star> =
        (0..10).flat_map(|turn| bright.iter().map(move |s| turned(s, turn))).collect();
    let mut setting = setting("2026-08-13T04:30:00Z", 1920, 1080)?;
    setting.camera.field_of_view = Angle::from_deg(90.0);
    let north = Camera { azimuth: Angle::ZERO, altitude: Angle::from_deg(35.2), ..setting.camera };
    let down = Camera { altitude: Angle::from_deg(-80.0), ..setting.camera };
    let narrow = Camera { field_of_view: Angle::from_deg(2.0), ..setting.camera };
    let sky = SkyState::at(
        &Ephemeris::load(catalogs, setting.tolerance)?,
        &setting.instant,
        &setting.place,
        setting.tolerance,
    )?;
    let mut kept = Kept::new(Store::NONE);
    println!(
        "  catalogue, field               in view   light and lay   splat pass   together   first frame"
    );
    for (name, stars, camera, limit) in [
        ("9096, all in one field", &crowded, north, None),
        ("9096, 90°", &bright, setting.camera, None),
        ("9096, none in view", &bright, down, None),
        ("9096, 2°", &bright, narrow, None),
        ("90 960, 90° to 6.5 mag", &many, setting.camera, Some(6.5)),
        ("90 960, 90°", &many, setting.camera, None),
        ("90 960, none in view", &many, down, None),
        ("90 960, 2°", &many, narrow, None),
    ] {
        setting.camera = camera;
        let night = Night::of(sky.clone(), stars.clone(), &air);
        let layers = Layers { magnitude_limit: limit, ..Layers::default() };
        // Beside a sky of tens of milliseconds that of stars would be lost in its noise.
        let alone = Layers { skylight: false, ground: false, ..layers.clone() };
        let without = Layers { stars: false, ..alone.clone() };
        let no_moon = || Err(nocturne::catalog::CatalogError::NoSource { file: "moon" });
        let first = Clock::now();
        let (plan, ledger) = lay_in(&setting, &layers, &night, &no_moon, &mut kept)?;
        let first_ms = first.elapsed().as_secs_f64() * 1e3;
        let mut lay = |layers: &Layers| {
            median_ms(FRAMES, || lay_in(&setting, layers, &night, &no_moon, &mut kept))
        };
        let lay_ms = lay(&alone) - lay(&without);
        let splats = plan.splats.clone();
        let pass_ms = match splats.is_empty() {
            true => 0.0,
            false => passes(renderer, &FramePlan { splats, ..empty(camera) })?.of("splats"),
        };
        let drawn = ledger.of("stars").map_or(0, |entry| entry.drawn);
        let both_ms = lay_ms + pass_ms;
        println!(
            "  {name:28} {drawn:9} {lay_ms:12.2} ms {pass_ms:9.2} ms {both_ms:7.2} ms {first_ms:9.2} ms"
        );
    }
    Ok(())
}

/// A star drawn towards the pole, so that a whole catalogue stands within 26 degrees of it.
fn crowd(star: &Star) -> Star {
    let from_pole = 90.0 - star.dir_j2000.latitude().deg();
    let latitude = Angle::from_deg(90.0 - from_pole * 26.0 / 180.0);
    Star { dir_j2000: Dir::from_spherical(star.dir_j2000.longitude(), latitude), ..star.clone() }
}

/// A star turned about the pole by some tenths of a turn, fainter unless it is where it was.
fn turned(star: &Star, tenths: u8) -> Star {
    let longitude = star.dir_j2000.longitude() + Angle::from_deg(36.0 * f64::from(tenths));
    let fainter = if tenths == 0 { 0.0 } else { 2.5 };
    Star {
        dir_j2000: Dir::from_spherical(longitude, star.dir_j2000.latitude()),
        magnitude: Magnitude(star.magnitude.0 + fainter),
        ..star.clone()
    }
}

/// The Moon alone in the middle of a picture.
fn moon(
    renderer: &Renderer,
    utc: &str,
    field_deg: f64,
    catalogs: &Catalogs,
    maps: &MoonMaps,
) -> Result<(), Box<dyn Error>> {
    let mut setting = setting(utc, 1920, 1080)?;
    let ephemeris = Ephemeris::load(catalogs, setting.tolerance)?;
    let sky = SkyState::at(&ephemeris, &setting.instant, &setting.place, setting.tolerance)?;
    let night = Night::of(sky, Vec::new(), &Atmosphere::default());
    let apparent = night.body(Body::Moon).ok_or("no Moon")?.apparent;
    (setting.camera.azimuth, setting.camera.altitude) = (apparent.azimuth(), apparent.altitude());
    setting.camera.field_of_view = Angle::from_deg(field_deg);
    let layers = Layers { skylight: false, ground: false, ..Layers::default() };
    let mut kept = Kept::new(Store::NONE);
    let mut lay = || lay_in(&setting, &layers, &night, &|| Ok(maps.clone()), &mut kept);
    let (plan, _) = lay()?;
    let globe = plan.discs.first().and_then(|disc| disc.globe.as_ref());
    let triangles: u32 =
        globe.iter().flat_map(|seen| seen.globe.mesh()).map(|b| b.triangles()).sum();
    println!("  {triangles} triangles");
    println!("  laying it, CPU {:24.2} ms", median_ms(SLOW, lay));
    let empty = passes(renderer, &FramePlan { discs: Vec::new(), ..plan.clone() })?;
    println!("  frame without it {:22.2} ms", empty.of("sky"));
    // The same globe shows its kept picture; an equal one is drawn.
    let equal = || {
        let mut plan = plan.clone();
        for seen in plan.discs.iter_mut().filter_map(|disc| disc.globe.as_mut()) {
            seen.globe = Arc::new((*seen.globe).clone());
        }
        plan
    };
    let kept = passes(renderer, &plan)?;
    let anew = passes_of(renderer, equal, SkyDetail::Tiles)?;
    for (when, cost) in [("kept", kept), ("anew", anew)] {
        for (pass, ms) in cost.passes.iter().skip(1) {
            println!("  {when} {pass:20} {ms:13.2} ms");
        }
    }
    Ok(())
}

/// What is computed before a frame, or after it, whatever the frame shows.
fn computations() {
    println!("Computations, ms");
    let air = Atmosphere::default();
    let solve =
        || ScatteringTables::solve(&air, &SKY_NODES_NM, Quality::RENDER).expect("the default air");
    println!("  ScatteringTables::solve {:10.1}", median_ms(SLOW, solve));
    let tables = solve();
    let rays = tables.sky_rays(0.002, COMPUTED_SHAPE);
    for sun_deg in [40.0f64, -6.0] {
        let view = || tables.sky_view(&rays, sun_deg.to_radians().sin());
        println!("  sky_view, Sun at {sun_deg:3}° {:9.1}", median_ms(SLOW, view));
    }
    let solved = SolvedAir::solve(&air, 0.0).expect("the default air");
    let sun = sun::irradiance(AU_KM);
    for sun_deg in [40.0, -6.0] {
        let dir = Dir::from_azimuth_altitude(Angle::ZERO, Angle::from_deg(sun_deg));
        let moved = || solved.sky(dir, &sun);
        println!("  moving the Sun to {sun_deg:3}° {:6.1}", median_ms(SLOW, moved));
    }
    let starlight = || StarLight::new(&Atmosphere::default(), 0.0);
    println!("  StarLight::new {:19.2}", median_ms(SLOW, starlight));
}

/// The catalogues, with the maps of the Moon read already.
struct Maps<'a> {
    catalogs: &'a Catalogs,
    moon: &'a MoonMaps,
}

impl SkyData for Maps<'_> {
    fn moon_maps(&self) -> Result<MoonMaps, CatalogError> {
        Ok(self.moon.clone())
    }
    fn milky_way(&self) -> Result<Option<Arc<MilkyWay>>, CatalogError> {
        SkyData::milky_way(self.catalogs)
    }
}

/// Lays a night or a day, and prints what that takes.
fn plan(
    name: &str,
    utc: &str,
    (width_px, height_px): (u32, u32),
    catalogs: &Catalogs,
    moon_maps: &MoonMaps,
) -> Result<FramePlan, Box<dyn Error>> {
    let setting = setting(utc, width_px, height_px)?;
    let layers = Layers::default();
    let air = Atmosphere::default();
    let stars = StarIndex::new(catalogs.stars()?);
    let sky = SkyState::at(
        &Ephemeris::load(catalogs, setting.tolerance)?,
        &setting.instant,
        &setting.place,
        setting.tolerance,
    )?;
    let light = || Night::of(sky.clone(), stars.clone(), &air);
    let night = light();
    let mut kept = Kept::new(Store::NONE);
    // The air is solved once; what follows is what a second frame takes.
    let data = Maps { catalogs, moon: moon_maps };
    let mut lay = || lay_in(&setting, &layers, &night, &data, &mut kept);
    let (plan, _) = lay()?;
    println!(
        "  {name:22} {:>14} {:11.1} {:11.1} {:7} {:6}",
        format!("{width_px}x{height_px}"),
        median_ms(SLOW, light),
        median_ms(SLOW, lay),
        plan.splats.len(),
        plan.discs.len(),
    );
    Ok(plan)
}

/// Looks south-east from Flagstaff, where the Moon of the one night and the Sun of the day stand.
fn setting(utc: &str, width_px: u32, height_px: u32) -> Result<Setting, Box<dyn Error>> {
    let scene = format!(
        r#"
        nocturne_scene = 2
        utc = "{utc}"
        [place]
        latitude_deg = 35.198
        longitude_deg = -111.651
        height_m = 2106.0
        [camera]
        azimuth_deg = 150.0
        altitude_deg = 35.0
        field_of_view_deg = 100.0
        projection = "stereographic"
        width_px = {width_px}
        height_px = {height_px}
        "#
    );
    Ok(Scene::parse(&scene)?.setting()?)
}

/// A plan without any light.
fn empty(camera: Camera) -> FramePlan {
    let sky = SkyPlan::black(Angle::ZERO);
    FramePlan { camera, sky, milky_way: None, discs: Vec::new(), splats: Vec::new() }
}

/// Medians of the passes of a plan, and of the whole with its way back to memory.
struct Cost {
    passes: Vec<(String, f64)>,
    wall_ms: f64,
}

impl Cost {
    /// A pass; the whole, where the adapter keeps no time.
    fn of(&self, name: &str) -> f64 {
        let found = self.passes.iter().find(|(pass, _)| pass == name);
        found.map_or(self.wall_ms, |(_, ms)| *ms)
    }
}

fn passes(renderer: &Renderer, plan: &FramePlan) -> Result<Cost, Box<dyn Error>> {
    passes_with(renderer, plan, SkyDetail::Tiles)
}

fn passes_with(
    renderer: &Renderer,
    plan: &FramePlan,
    detail: SkyDetail,
) -> Result<Cost, Box<dyn Error>> {
    passes_of(renderer, || plan, detail)
}

/// The same with a plan for each frame.
fn passes_of<P: Borrow<FramePlan>>(
    renderer: &Renderer,
    plan: impl Fn() -> P,
    detail: SkyDetail,
) -> Result<Cost, Box<dyn Error>> {
    let mut runs = Vec::new();
    renderer.frame_with(plan().borrow(), detail)?;
    for _ in 0..FRAMES {
        let plan = plan();
        let start = Clock::now();
        let times = renderer.frame_with(plan.borrow(), detail)?.times;
        runs.push((start.elapsed().as_secs_f64() * 1e3, times));
    }
    let of_pass = |number: usize| median(runs.iter().map(|run| run.1[number].milliseconds));
    let names = runs[0].1.iter().map(|time| time.pass.clone());
    Ok(Cost {
        passes: names.enumerate().map(|(number, name)| (name, of_pass(number))).collect(),
        wall_ms: median(runs.iter().map(|run| run.0)),
    })
}

/// Median of repetitions, after one to warm up.
fn median_ms<T>(repetitions: usize, mut run: impl FnMut() -> T) -> f64 {
    black_box(run());
    median((0..repetitions).map(|_| {
        let start = Clock::now();
        black_box(run());
        start.elapsed().as_secs_f64() * 1e3
    }))
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

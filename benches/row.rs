//! What the second and later frames of a row cost before they are drawn: night and plan in a studio.
//!
//! `cargo bench --bench row`; medians and means in milliseconds, of the wall clock and of the CPU in all
//! threads (Linux alone). Means hold the frames that make tables for those after them.

use std::error::Error;
use std::time::Instant as Clock;

use nocturne::catalog::Catalogs;
use nocturne::scene::Scene;
use nocturne::store::Store;
use nocturne::studio::Studio;
use nocturne::time;

/// Flagstaff; UTC.
const SKIES: [(&str, &str); 4] = [
    ("dark night", "2026-08-13T05:30:00Z"),
    ("moonlit night", "2026-08-26T06:00:00Z"),
    ("dusk", "2026-08-13T02:45:00Z"),
    ("day", "2026-08-15T17:00:00Z"),
];
/// What changes from frame to frame: seconds of time; a degree of azimuth if none.
const ROWS: [(&str, f64); 3] = [("camera alone", 0.0), ("1 s later", 1.0), ("60 s later", 60.0)];
const FRAMES: u32 = 30;

fn main() -> Result<(), Box<dyn Error>> {
    let catalogs = Catalogs::locate(None)?;
    println!("1280x720, 60 degrees, all layers: median and mean, ms");
    println!(
        "                                    night, wall     lay, wall    both, CPU of all threads"
    );
    for (sky, utc) in SKIES {
        for (row, step_s) in ROWS {
            let mut studio = Studio::open(&catalogs, Store::of_user())?;
            let begin = time::to_instant(&time::parse(utc)?, None)?;
            let (mut night_ms, mut lay_ms, mut cpu_ms) = (Vec::new(), Vec::new(), Vec::new());
            for frame in 0..=FRAMES {
                let at = begin.plus_seconds(step_s * f64::from(frame))?;
                let turn = if step_s == 0.0 { f64::from(frame) } else { 0.0 };
                let scene = scene(&at.to_string(), 150.0 + turn)?;
                let setting = scene.setting()?;
                let (cpu, start) = (cpu_now_ms(), Clock::now());
                let night = studio.night(&scene, &setting)?;
                let between = Clock::now();
                let plan = studio.lay(&scene, &setting, &night)?;
                let end = Clock::now();
                drop(plan);
                if frame > 0 {
                    night_ms.push((between - start).as_secs_f64() * 1e3);
                    lay_ms.push((end - between).as_secs_f64() * 1e3);
                    cpu_ms.push(cpu_now_ms() - cpu);
                }
            }
            let [night, lay, cpu] = [night_ms, lay_ms, cpu_ms].map(middle);
            println!("  {sky:14} {row:14} {night:>16} {lay:>16} {cpu:>16}");
        }
    }
    Ok(())
}

/// Median and mean.
fn middle(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    format!("{:.2} {mean:.2}", values[values.len() / 2])
}

/// What all threads of this program have computed so far; 0 where the system does not say.
fn cpu_now_ms() -> f64 {
    let Ok(tasks) = std::fs::read_dir("/proc/self/task") else { return 0.0 };
    let of_task = |task: std::fs::DirEntry| -> Option<f64> {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    };
    tasks.flatten().filter_map(of_task).sum::<f64>() / 1e6
}

fn scene(utc: &str, azimuth_deg: f64) -> Result<Scene, Box<dyn Error>> {
    Ok(Scene::parse(&format!(
        r#"
        nocturne_scene = 2
        utc = "{utc}"
        [place]
        latitude_deg = 35.198
        longitude_deg = -111.651
        height_m = 2106.0
        [camera]
        azimuth_deg = {azimuth_deg}
        altitude_deg = 35.0
        field_of_view_deg = 60.0
        projection = "stereographic"
        width_px = 1280
        height_px = 720
        "#
    ))?)
}

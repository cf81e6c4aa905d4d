//! The program in a real window: opened, played with by keys and a mouse, read, photographed, closed.
//!
//! Needs Xvfb, xdotool, xclip and a graphics adapter; without them it is reported as ignored.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant as Stopwatch};

use libtest_mimic::{Arguments, Failed, Trial};
use nocturne::camera::{Camera, Projection};
use nocturne::catalog::Catalogs;
use nocturne::scene::Scene;
use nocturne::studio::Studio;
use nocturne::units::Angle;

const TOOLS: [&str; 3] = ["Xvfb", "xdotool", "xclip"];
/// The sky of the window: Vega high in the south of an August evening.
const SCENE: &str = r#"
nocturne_scene = 2
utc = "2026-08-13T04:30:00Z"

[place]
latitude_deg = 35.198
longitude_deg = -111.651
height_m = 2106.0
time_zone = "America/Phoenix"

[camera]
azimuth_deg = 80.0
altitude_deg = 75.0
field_of_view_deg = 60.0
projection = "stereographic"
width_px = 1280
height_px = 720
"#;
/// The window is slow where drivers are.
const PATIENCE: Duration = Duration::from_secs(60);

fn main() {
    let has = |tool: &&str| {
        let mut look = Command::new("sh");
        look.args(["-c", &format!("command -v {tool}")]);
        look_quietly(&mut look).status().is_ok_and(|status| status.success())
    };
    let has_tools = TOOLS.iter().all(has);
    let program = env!("CARGO_BIN_EXE_nocturne");
    let has_adapter = look_quietly(Command::new(program).arg("adapter"))
        .status()
        .is_ok_and(|status| status.success());
    let trial = Trial::test("a_window_is_opened_used_and_closed", opened_used_and_closed)
        .with_ignored_flag(!has_tools || !has_adapter);
    libtest_mimic::run(&Arguments::from_args(), vec![trial]).exit();
}

fn look_quietly(command: &mut Command) -> &mut Command {
    command.stdout(Stdio::null()).stderr(Stdio::null())
}

/// A process that ends with the test.
struct Guest(Child);

impl Drop for Guest {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn opened_used_and_closed() -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    // It chooses a display that nobody else has, and says which.
    let screen = ["-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten", "tcp"];
    let mut server = Command::new("Xvfb");
    let server = server.args(screen).stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?;
    let mut server = Guest(server);
    let mut number = String::new();
    let said = server.0.stdout.take().ok_or("the screen says nothing")?;
    BufReader::new(said).read_line(&mut number)?;
    let display = format!(":{}", number.trim());

    let [scene, state, log] =
        ["scene.toml", "state.toml", "frames.log"].map(|name| folder.join(name));
    fs::write(&scene, SCENE)?;
    fs::create_dir(folder.join("Pictures"))?;
    fs::write(folder.join("user-dirs.dirs"), "XDG_PICTURES_DIR=\"$HOME/Pictures\"\n")?;
    let mut program = Command::new(env!("CARGO_BIN_EXE_nocturne"));
    program.arg("--scene").arg(&scene).arg("--frame-log").arg(&log).arg("--full-screen");
    program.env("DISPLAY", &display).env_remove("WAYLAND_DISPLAY");
    program.env("NOCTURNE_STATE", &state).env("HOME", folder).env("XDG_CONFIG_HOME", folder);
    program.env("NOCTURNE_CATALOGS", Catalogs::locate(None)?.directory());
    let mut window = Guest(program.stderr(Stdio::piped()).spawn()?);
    let pictures = || {
        let log = fs::read_to_string(&log).unwrap_or_default();
        let last = log.lines().last().and_then(|line| line.split_whitespace().nth(1));
        last.and_then(|count| count.parse::<u64>().ok()).unwrap_or(0)
    };
    until("the first sky is there", || pictures() > 0)?;

    let hand = |words: &[&str]| -> Result<(), Failed> {
        let done = Command::new("xdotool").args(words).env("DISPLAY", &display).status()?;
        if done.success() { Ok(()) } else { Err(format!("xdotool {words:?}").into()) }
    };
    // Constellations, a grid, and a day on and back.
    for key in ["c", "v", "e", "equal", "minus"] {
        hand(&["key", key])?;
        sleep(Duration::from_millis(300));
    }
    // What is clicked is a star that the core says is there.
    let [x, y] = pixel_of("Vega")?;
    hand(&["mousemove", &format!("{x:.0}"), &format!("{y:.0}"), "click", "1"])?;
    sleep(Duration::from_millis(1500));
    hand(&["key", "ctrl+c"])?;
    let panel = || {
        let read = Command::new("timeout")
            .args(["2", "xclip", "-selection", "clipboard", "-o"])
            .env("DISPLAY", &display)
            .stderr(Stdio::null())
            .output();
        read.map(|read| String::from_utf8_lossy(&read.stdout).into_owned()).unwrap_or_default()
    };
    until("the panel of Vega is read", || panel().contains("HR 7001"))?;
    let panel = panel();
    for words in ["Vega", "Lyra", "0.03"] {
        if !panel.contains(words) {
            return Err(format!("no '{words}' in the panel:\n{panel}").into());
        }
    }
    // A picture for a file, while the window goes on.
    hand(&["key", "ctrl+s"])?;
    let written = || {
        let files = fs::read_dir(folder.join("Pictures")).into_iter().flatten().flatten();
        files.map(|file| file.path()).find(|path| path.extension().is_some_and(|e| e == "png"))
    };
    until("a picture is written", || written().is_some())?;
    let picture = image::open(written().ok_or("no picture")?)?;
    // Without the bar below it.
    if picture.width() != 1280 || !(600..720).contains(&picture.height()) {
        return Err(format!("{}x{}", picture.width(), picture.height()).into());
    }
    hand(&["key", "ctrl+q"])?;
    let mut exit = None;
    until("the window is closed", || {
        exit = window.0.try_wait().ok().flatten();
        exit.is_some()
    })?;
    if !exit.is_some_and(|exit| exit.success()) {
        return Err(format!("it ended with {exit:?}").into());
    }
    let state = fs::read_to_string(&state)?;
    for words in ["selected = \"HR 7001\"", "constellation_lines = true", "equatorial_grid = true"]
    {
        if !state.contains(words) {
            return Err(format!("no '{words}' in the state:\n{state}").into());
        }
    }
    Ok(())
}

/// Where something is seen on the window of [`SCENE`], pixels: the bar takes a strip below the sky, and the
/// camera of the window has the same field over the same width.
fn pixel_of(name: &str) -> Result<[f64; 2], Failed> {
    let scene = Scene::parse(SCENE)?;
    let setting = scene.setting()?;
    let mut studio = Studio::open(&Catalogs::locate(None)?, nocturne::store::Store::NONE)?;
    let night = studio.night(&scene, &setting)?;
    let found = night.find(name).ok_or("no such star")?;
    let bar_px = 25.0;
    let camera = Camera {
        projection: Projection::Stereographic,
        field_of_view: Angle::from_deg(60.0),
        ..setting.camera
    };
    let [x, y] = camera.pixel_from_apparent(found.apparent).ok_or("out of view")?;
    Ok([x, y - bar_px / 2.0])
}

fn until(what: &str, mut is_so: impl FnMut() -> bool) -> Result<(), Failed> {
    let begun = Stopwatch::now();
    while begun.elapsed() < PATIENCE {
        if is_so() {
            return Ok(());
        }
        sleep(Duration::from_millis(100));
    }
    Err(format!("it never came to pass that {what}").into())
}

//! `nocturne render`: a picture of the sky, and what is in it.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::air::Atmosphere;
use crate::air::classic::{ClassicModel, ClassicSky};
use crate::background::Interrupt;
use crate::camera::Projection;
use crate::catalog::Catalogs;
use crate::display::Display;
use crate::export::describe::Description;
use crate::eye::Eye;
use crate::job::outputs::Outputs;
use crate::job::steps::Steps;
use crate::job::{Subject, Written};
use crate::light::earth_shadow::Danjon;
use crate::light::moon::Reflectance;
use crate::light::night_lights::NightGlow;
use crate::light::scintillation::Scintillation;
use crate::plan::classic::ClassicLight;
use crate::scene::{FORMAT, Layers, Marks, Scene, SceneCamera, SceneMoon, ScenePlace};

use super::WhereArgs;
use super::display::DisplayArgs;
use super::error::CliError;
use super::eye::EyeArgs;
use super::look::{self, Look};
use super::night_glow::NightGlowArgs;
use super::photo::PhotoArgs;
use super::progress::Progress;
use super::{atmosphere, draw, stage, stats, summary};

#[derive(Debug, Args)]
pub struct RenderArgs {
    /// Instant: 2026-08-12T21:30-07:00, 2026-08-12 21:30 (local time there), now, or tonight
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    at: Option<String>,
    #[command(flatten)]
    location: WhereArgs,
    /// Direction of view: N, SSW, an azimuth in degrees, zenith, or an object such as Moon or Sirius
    #[arg(long, value_name = "WHERE", allow_hyphen_values = true)]
    look: Option<Look>,
    /// Altitude of the middle of the picture, degrees [default: 30]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    altitude: Option<f64>,
    /// Turn of the camera about the line of sight, degrees, clockwise [default: 0]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    roll: Option<f64>,
    /// Field of view across the width of the picture, degrees, from 0.00028 (an arcsecond) [default: 90]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    fov: Option<f64>,
    /// How the sky is laid on the picture [default: stereographic]
    #[arg(long, value_enum)]
    projection: Option<ProjectionArg>,
    /// Width and height in pixels [default: 1280x720]
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    size: Option<(u32, u32)>,
    /// The air: a name that `nocturne atmosphere` lists, or a file [default: clear, with less haze on heights]
    #[arg(long, value_name = "NAME|FILE")]
    atmosphere: Option<String>,
    /// Leave out stars and planets fainter than this
    #[arg(long, value_name = "V", allow_hyphen_values = true)]
    magnitude_limit: Option<f64>,
    /// How far off positions may be, arcseconds [default: a tenth of a pixel]
    #[arg(long, value_name = "ARCSEC", allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// How the daylit sky is made; all but `solved` are classic models, for comparison [default: solved]
    #[arg(long, value_enum, value_name = "MODEL")]
    sky: Option<SkyArg>,
    /// Turbidity of a classic model [default: that of the aerosol]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    turbidity: Option<f64>,
    #[command(flatten)]
    glow: NightGlowArgs,
    /// How dark an eclipsed Moon is, Danjon's number: 0, very dark, to 4, bright orange [default: 2.5]
    #[arg(long, value_name = "L", allow_hyphen_values = true)]
    danjon: Option<f64>,
    /// How the ground of the Moon sends light back [default: hapke]
    #[arg(long, value_enum, value_name = "LAW")]
    moon: Option<MoonArg>,
    /// Let stars and planets twinkle as for the naked eye; the same seed gives the same twinkling
    #[arg(long, value_name = "SEED")]
    scintillation: Option<u64>,
    #[command(flatten)]
    eye: EyeArgs,
    #[command(flatten)]
    photo: PhotoArgs,
    #[command(flatten)]
    display: DisplayArgs,
    /// No horizon line and cardinal points on the PNG
    #[arg(long)]
    no_marks: bool,
    /// Start from a scene file; other options change what it says
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Write the scene, from which the same picture can be drawn again
    #[arg(long, value_name = "FILE")]
    save_scene: Option<PathBuf>,
    /// Picture to write: .png (as an eye sees it, or a camera) or .exr (cd/m2, channels X, Y, Z, V); may be repeated
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Write where every object is and how bright, as JSON; - for standard output
    #[arg(long, value_name = "FILE")]
    describe: Option<PathBuf>,
    /// Say what was drawn, what was not and why, and what it cost
    #[arg(long)]
    stats: bool,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ProjectionArg {
    Perspective,
    Stereographic,
    /// Fisheye, equal angles
    #[value(alias = "fisheye")]
    Equidistant,
    /// Fisheye, equal areas
    EqualArea,
    /// Azimuth and altitude as x and y
    Equirectangular,
}

impl From<ProjectionArg> for Projection {
    fn from(arg: ProjectionArg) -> Projection {
        match arg {
            ProjectionArg::Perspective => Projection::Perspective,
            ProjectionArg::Stereographic => Projection::Stereographic,
            ProjectionArg::Equidistant => Projection::Equidistant,
            ProjectionArg::EqualArea => Projection::EqualArea,
            ProjectionArg::Equirectangular => Projection::Equirectangular,
        }
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum MoonArg {
    /// Hapke 2012, with the parameters of each place after Sato et al. 2014
    Hapke,
    /// Jensen et al. 2001
    Jensen,
}

impl MoonArg {
    fn law(self) -> Reflectance {
        match self {
            MoonArg::Hapke => Reflectance::Hapke,
            MoonArg::Jensen => Reflectance::Jensen,
        }
    }
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SkyArg {
    /// The air itself, by scattering
    Solved,
    /// Moon & Spencer 1942
    CieOvercast,
    /// Kittler 1967, CIE 1973
    CieClear,
    /// Perez, Seals & Michalsky 1993
    Perez,
    /// Preetham, Shirley & Smits 1999
    Preetham,
}

impl SkyArg {
    fn model(self) -> Option<ClassicModel> {
        match self {
            SkyArg::Solved => None,
            SkyArg::CieOvercast => Some(ClassicModel::CieOvercast),
            SkyArg::CieClear => Some(ClassicModel::CieClear),
            SkyArg::Perez => Some(ClassicModel::Perez),
            SkyArg::Preetham => Some(ClassicModel::Preetham),
        }
    }
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let wrong = || "give width and height in pixels, such as 1920x1080".to_owned();
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_| wrong());
    Ok((number(width)?, number(height)?))
}

pub fn run(args: &RenderArgs, catalogs: &Catalogs, out: &mut impl Write) -> Result<(), CliError> {
    let mut scene = scene(args, catalogs)?;
    let mut setting = scene.setting()?;
    let bits = args.display.bits()?;
    let describe_to_stdout = args.describe.as_deref() == Some(Path::new("-"));
    let description = args.describe.as_deref().filter(|_| !describe_to_stdout);
    let outputs = Outputs::open(&args.output, args.save_scene.as_deref(), description)?;
    if outputs.is_empty() && !describe_to_stdout {
        return Err(CliError::Usage(
            "nothing to write: give --output FILE, --describe FILE or --save-scene FILE".to_owned(),
        ));
    }
    let progress = Progress::of_job(args.quiet);
    let mut tell = |reached| progress.show(&reached);
    // Whoever stops this program ends it, and its drafts with it.
    let interrupt = Interrupt::default();
    let mut steps = Steps::new(&mut tell, &interrupt);

    let night = steps.step("positions", 0.1, || stage::night_of(&scene, &setting, catalogs))??;
    if let Some(Look::Object(name)) = &args.look {
        let towards = look::towards(name, &night)?;
        scene.camera.azimuth_deg = towards.azimuth().deg();
        scene.camera.altitude_deg = args.altitude.unwrap_or(towards.altitude().deg());
        setting = scene.setting()?;
    }
    // Refused before the long work.
    let classic = scene.sky.filter(|_| outputs.draws());
    let classic = classic.map(|sky| ClassicLight::of(&sky, &night)).transpose()?;
    let subject = Subject { scene: &scene, setting: &setting, night: &night };
    let mut rest = steps.part("", 0.9);
    let written = match outputs.draws() {
        true => draw::finish(outputs, &subject, bits, catalogs, &mut rest)?,
        false => {
            let paths = rest.step("writing", 1.0, || outputs.write(&subject, None))??;
            Written { paths, drawn: None, times: rest.times().to_vec() }
        }
    };
    if describe_to_stdout {
        Description::of(&setting, &night).write_to(out)?;
    }
    progress.finish();

    // What describes the picture on standard output is not mixed with words.
    let mut standard_error = std::io::stderr();
    let report: &mut dyn Write = if describe_to_stdout { &mut standard_error } else { &mut *out };
    if !args.quiet {
        let ledger = written.drawn.as_ref().map(|drawn| &drawn.ledger);
        summary::write(report, &setting, &night, ledger)?;
        for path in &written.paths {
            writeln!(report, "Wrote {}", path.display())?;
        }
    }
    if args.stats {
        let sky = classic.map(|light| light.sky);
        let times: Vec<_> = steps.times().iter().chain(&written.times).copied().collect();
        stats::write(report, &night, sky.as_ref(), written.drawn.as_ref(), &times)?;
    }
    Ok(())
}

/// The scene that the options describe, or the scene file with what the options change.
fn scene(args: &RenderArgs, catalogs: &Catalogs) -> Result<Scene, CliError> {
    let base = args.scene.as_deref().map(read_scene).transpose()?;
    let found = args.location.find(catalogs)?;
    let place = match (&found, &base) {
        (Some(place), _) => ScenePlace {
            name: place.name.clone(),
            latitude_deg: place.latitude.deg(),
            longitude_deg: place.longitude.deg(),
            height_m: place.height_m,
            time_zone: place.time_zone.map(|zone| zone.name().to_owned()),
        },
        (None, Some(base)) => {
            let height_m = args.location.height.unwrap_or(base.place.height_m);
            ScenePlace { height_m, ..base.place.clone() }
        }
        (None, None) => {
            return Err(CliError::Usage("say where: --place NAME, or --lat and --lon".to_owned()));
        }
    };
    let mut scene = base.unwrap_or_else(|| Scene {
        nocturne_scene: FORMAT,
        utc: String::new(),
        tolerance_arcsec: None,
        place: place.clone(),
        camera: SceneCamera {
            azimuth_deg: 180.0,
            altitude_deg: 30.0,
            roll_deg: 0.0,
            field_of_view_deg: 90.0,
            projection: Projection::Stereographic,
            width_px: 1280,
            height_px: 720,
        },
        layers: Layers::default(),
        sky: None,
        scintillation: None,
        night: NightGlow::default(),
        moon: SceneMoon::default(),
        air: Atmosphere::clear_over(place.height_m),
        eye: Eye::default(),
        photo: None,
        display: Display::default(),
        marks: Marks::default(),
    });
    let had_photo = scene.photo.is_some();
    scene.place = place;
    let at = args.at.as_deref().or(scene.utc.is_empty().then_some("now"));
    if let Some(at) = at {
        // Checked by making the place, which the zone comes with.
        let place = Scene { utc: "2000-01-01T00:00Z".to_owned(), ..scene.clone() }.setting()?.place;
        scene.utc = stage::instant(at, &place)?.to_string();
    }
    change_camera(args, &mut scene.camera);
    if let Some(words) = &args.atmosphere {
        scene.air = atmosphere::find(words)?;
    }
    scene.sky = sky(args, scene.sky)?;
    if let Some(number) = args.danjon {
        scene.moon.danjon =
            Danjon::new(number).map_err(|error| CliError::Usage(format!("--danjon: {error}")))?;
    }
    scene.night = args.glow.change(scene.night)?;
    scene.moon.reflectance = args.moon.map_or(scene.moon.reflectance, MoonArg::law);
    if let Some(seed) = args.scintillation {
        let base = scene.scintillation.unwrap_or_default();
        scene.scintillation = Some(Scintillation { seed, ..base });
    }
    scene.tolerance_arcsec = args.tolerance.or(scene.tolerance_arcsec);
    scene.layers.magnitude_limit = args.magnitude_limit.or(scene.layers.magnitude_limit);
    scene.eye = args.eye.change(scene.eye)?;
    scene.display = args.display.change(scene.display)?;
    scene.photo = args.photo.change(scene.photo)?;
    if let Some(photo) = &mut scene.photo {
        let field_is_given = args.fov.is_some() || (args.scene.is_some() && had_photo);
        args.photo.aim(photo, &mut scene.camera, field_is_given)?;
    }
    if args.no_marks {
        scene.marks = Marks { horizon: false, cardinal_points: false };
    }
    Ok(scene)
}

/// The classic sky that the options ask for, or that of the scene file with what they change.
fn sky(args: &RenderArgs, base: Option<ClassicSky>) -> Result<Option<ClassicSky>, CliError> {
    let sky = match args.sky.map(SkyArg::model) {
        None => base,
        Some(model) => model.map(|model| match base {
            Some(base) if base.model == model => base,
            _ => ClassicSky::new(model),
        }),
    };
    match (sky, args.turbidity) {
        (Some(sky), Some(_)) => Ok(Some(ClassicSky { turbidity: args.turbidity, ..sky })),
        (None, Some(_)) => Err(CliError::Usage(
            "--turbidity is for a classic sky; add --sky preetham, or leave it out".to_owned(),
        )),
        (sky, None) => Ok(sky),
    }
}

/// The scene of a file, checked.
pub fn read_scene(path: &Path) -> Result<Scene, CliError> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        CliError::Failure(format!(
            "cannot read --scene {}: {error}; --save-scene writes such a file",
            path.display()
        ))
    })?;
    // Checked here, where it is known that the values come from the file.
    Scene::parse(&text)
        .and_then(|scene| scene.setting().map(|_| scene))
        .map_err(|error| CliError::Usage(format!("--scene {}: {error}", path.display())))
}

fn change_camera(args: &RenderArgs, camera: &mut SceneCamera) {
    match args.look {
        Some(Look::Azimuth(azimuth)) => camera.azimuth_deg = azimuth.deg(),
        Some(Look::Zenith) => (camera.azimuth_deg, camera.altitude_deg) = (0.0, 90.0),
        Some(Look::Object(_)) | None => {}
    }
    camera.altitude_deg = args.altitude.unwrap_or(camera.altitude_deg);
    camera.roll_deg = args.roll.unwrap_or(camera.roll_deg);
    camera.field_of_view_deg = args.fov.unwrap_or(camera.field_of_view_deg);
    camera.projection = args.projection.map_or(camera.projection, Projection::from);
    (camera.width_px, camera.height_px) = args.size.unwrap_or((camera.width_px, camera.height_px));
}

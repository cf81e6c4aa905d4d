//! Compares the classic sky models with the sky of this program: writes `docs/classic_skies.md` and the
//! picture in it.
//!
//! `cargo run --release --example 5_classic_skies --no-default-features --features cli`, or
//! `make classic`.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

use nocturne::air::Atmosphere;
use nocturne::air::classic::{ClassicModel, ClassicSky, SkyUnderSun};
use nocturne::air::scattering::{
    Matrix, Quality, SKY_NODES_NM, ScatteringTables, reconstruction_matrix,
};
use nocturne::display::Display;
use nocturne::export::{OutputFile, png};
use nocturne::eye::Eye;
use nocturne::eye::glare::Glare;
use nocturne::image::{HdrFrame, Image};
use nocturne::light::spectrum::{FIRST_NM, LEN, STEP_NM, Spectrum, chromaticity_xy, wavelength_nm};
use nocturne::light::sun;
use nocturne::units::{Angle, Xyzv};

const SUNS_DEG: [f64; 4] = [60.0, 30.0, 10.0, 2.0];
/// Along the meridian of the Sun, from the horizon under it over the zenith.
const ALONG_DEG: [f64; 9] = [2.0, 15.0, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0, 175.0];
/// Width of one sky in the picture, pixels.
const SKY_PX: u32 = 180;

const HEAD: &str = "\
# Classic skies

Four models of the daylit sky that people know, beside the sky of Nocturne, in the same air: the default
one, haze of optical depth 0.10 at 550 nm, straight rays, an observer at sea level. `make classic` makes
this page. `nocturne render --sky cie-overcast|cie-clear|perez|preetham` draws any picture with one of
them, `--turbidity` sets its haze, and a scene may say

```toml
[sky]
model = \"perez\"
clearness = 1.3
brightness = 0.3
```

All know only a Sun above the horizon; with the Sun below it the program refuses in a sentence.

![From left to right: CIE overcast, CIE clear, Perez, Preetham, Nocturne; the Sun at 60, 30, 10 and 2 \
degrees from top to bottom](classic_skies.png)

From left to right CIE overcast, CIE clear, Perez, Preetham and Nocturne, from top to bottom the Sun at
60, 30, 10 and 2 degrees, to the right of the zenith; each row has one exposure.

## Where they fail

";

const NOTES: &str = "
Turbidity comes from the aerosol of the air: Linke's by Ineichen 2008 with 2 cm of water, Preetham's by
the haze of his own paper. The overcast sky is scaled by Krochmann & Seidl 1974, the clear one by the
zenith luminance that Radiance uses, Perez by his diffuse illuminance, and without a given weather he is
given a cloudless one (Rigollier et al. 2000). The three without a colour are drawn in the light of D65.
The scotopic light of all is that of CIE daylight of the same chromaticity. Below the horizon the ground
shines through the air of Hoffman & Preetham 2002. The disc of the Sun is drawn before all of them, the
overcast one too; `layers.sun = false` in the scene leaves it out. Sources, equations and what is
recalled rather than looked up: `src/air/classic.rs` and the files below it.

";

/// The sky of this program.
struct Ours {
    tables: ScatteringTables,
    spectrum_from_nodes: Matrix,
    sun: Spectrum,
}

impl Ours {
    fn seen(&self, nodes: &[f64]) -> Xyzv {
        let shares = self.spectrum_from_nodes.spectrum(nodes);
        self.sun.weighted(|nm| shares[((nm - FIRST_NM) / STEP_NM).round() as usize]).xyzv()
    }

    fn luminance(&self, sun: Angle, altitude: Angle, azimuth: Angle) -> Xyzv {
        let mut nodes = [0.0; SKY_NODES_NM.len()];
        self.tables.radiance(0.0, sun.sin(), altitude, azimuth, &mut nodes);
        self.seen(&nodes)
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let air = Atmosphere::default().straight();
    let wavelengths: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
    let ours = Ours {
        tables: ScatteringTables::solve(&air, &SKY_NODES_NM, Quality::RENDER)?,
        spectrum_from_nodes: reconstruction_matrix(&SKY_NODES_NM, &wavelengths),
        sun: sun::irradiance_1au(),
    };
    let mut page = HEAD.to_owned();
    for model in ClassicModel::ALL {
        writeln!(page, "- **{}**: {}", model.name(), model.fails())?;
    }
    page.push_str(NOTES);
    let mut rows = Vec::new();
    for sun_deg in SUNS_DEG {
        let sun = Angle::from_deg(sun_deg);
        let skies = ClassicModel::ALL
            .map(|model| ClassicSky::new(model).under(&air, 0.0, sun))
            .into_iter()
            .collect::<Result<Vec<SkyUnderSun>, _>>()?;
        write_tables(&mut page, &skies, &ours, sun)?;
        rows.push(picture_row(&skies, &ours, sun));
    }
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    std::fs::write(docs.join("classic_skies.md"), page)?;
    png::write(OutputFile::create(&docs.join("classic_skies.png"))?, &stacked(&rows))?;
    Ok(())
}

/// Luminance along the meridian, the colour of the zenith, and what the ground gets.
fn write_tables(
    page: &mut String,
    skies: &[SkyUnderSun],
    ours: &Ours,
    sun: Angle,
) -> Result<(), std::fmt::Error> {
    writeln!(page, "## Sun at {:.0} degrees\n", sun.deg())?;
    writeln!(
        page,
        "Luminance along the meridian of the Sun, from the horizon under it, kcd/m2:\n"
    )?;
    writeln!(page, "| degrees | CIE overcast | CIE clear | Perez | Preetham | Nocturne |")?;
    writeln!(page, "|---|---|---|---|---|---|")?;
    let degrees = ALONG_DEG.into_iter().filter(|along| (along - sun.deg()).abs() > 0.5);
    for along in degrees {
        let (altitude, azimuth) = match along <= 90.0 {
            true => (Angle::from_deg(along), Angle::ZERO),
            false => (Angle::from_deg(180.0 - along), Angle::from_deg(180.0)),
        };
        let cells = skies
            .iter()
            .map(|sky| sky.luminance(altitude, azimuth))
            .chain([ours.luminance(sun, altitude, azimuth)]);
        let cells: Vec<String> = cells.map(|light| format!("{:.3}", light.y / 1000.0)).collect();
        writeln!(page, "| {along:.0} | {} |", cells.join(" | "))?;
    }
    let zenith = Angle::from_deg(90.0);
    let zeniths = skies.iter().map(|sky| sky.luminance(zenith, Angle::ZERO));
    let zeniths = zeniths.chain([ours.luminance(sun, zenith, Angle::ZERO)]);
    let colours: Vec<String> = zeniths
        .map(|light| {
            let (x, y) = chromaticity_xy(light).unwrap_or_default();
            format!("{x:.3} {y:.3}, {:.2}", light.v / light.y)
        })
        .collect();
    writeln!(page, "| x y, V/Y of the zenith | {} |", colours.join(" | "))?;
    let (diffuse, _) = ours.tables.ground_irradiance(sun.sin());
    let grounds = skies.iter().map(SkyUnderSun::illuminance).chain([ours.seen(&diffuse)]);
    let grounds: Vec<String> = grounds.map(|light| format!("{:.2}", light.y / 1000.0)).collect();
    writeln!(page, "| ground by the sky, klx | {} |", grounds.join(" | "))?;
    let ratios: Vec<String> =
        skies.iter().map(|sky| format!("{:.2}", median_ratio(sky, ours, sun))).collect();
    writeln!(page, "| median over Nocturne's | {} | 1 |\n", ratios.join(" | "))
}

/// Median of the luminance of a model over ours, 10 degrees and more from the Sun, even over the sky.
fn median_ratio(sky: &SkyUnderSun, ours: &Ours, sun: Angle) -> f64 {
    const ROWS: u32 = 16;
    let mut ratios = Vec::new();
    for row in 0..ROWS {
        let altitude = Angle::from_rad(((f64::from(row) + 0.5) / f64::from(ROWS)).asin());
        for azimuth_deg in (0..=180).step_by(12) {
            let azimuth = Angle::from_deg(azimuth_deg.into());
            let cosine = altitude.sin() * sun.sin() + altitude.cos() * sun.cos() * azimuth.cos();
            if cosine < Angle::from_deg(10.0).cos() {
                let light = ours.luminance(sun, altitude, azimuth);
                ratios.push(sky.luminance(altitude, azimuth).y / light.y);
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    ratios[ratios.len() / 2]
}

/// All skies under one Sun side by side, zenith in the middle, as an eye sees them.
fn picture_row(skies: &[SkyUnderSun], ours: &Ours, sun: Angle) -> Image<[u8; 3]> {
    let mut frame = HdrFrame::filled(SKY_PX * (skies.len() as u32 + 1), SKY_PX, [0.0; 4]);
    let width = frame.width_px();
    let radius = f64::from(SKY_PX) / 2.0 - 2.0;
    for (place, pixel) in (0..).zip(frame.pixels_mut()) {
        let (column, y): (u32, u32) = (place % width, place / width);
        let middle = f64::from(SKY_PX) / 2.0;
        let (right, down) =
            (f64::from(column % SKY_PX) + 0.5 - middle, f64::from(y) + 0.5 - middle);
        // Equal angles from the zenith outwards.
        let from_zenith = Angle::from_deg(90.0) * (right.hypot(down) / radius);
        let altitude = Angle::from_deg(90.0) - from_zenith;
        if altitude >= Angle::ZERO {
            let azimuth = Angle::from_rad(down.atan2(right));
            let light = match skies.get((column / SKY_PX) as usize) {
                Some(sky) => sky.luminance(altitude, azimuth),
                None => ours.luminance(sun, altitude, azimuth),
            };
            *pixel = light.to_f32();
        }
    }
    let eye = Eye { glare: Glare::None, ..Eye::default() };
    let display = Display::default();
    eye.see(&frame, Angle::from_deg(1.0), &display).codes(&display)
}

/// Pictures of one width below each other.
fn stacked(rows: &[Image<[u8; 3]>]) -> Image<[u8; 3]> {
    let (width, height) = rows.first().map_or((0, 0), |row| (row.width_px(), row.height_px()));
    let mut all = Image::filled(width, height * rows.len() as u32, [0; 3]);
    for (pixel, of_rows) in
        all.pixels_mut().iter_mut().zip(rows.iter().flat_map(|row| row.pixels()))
    {
        *pixel = *of_rows;
    }
    all
}

//! Makes the files in `catalogs/` out of the raw tables, or checks that they are what packing
//! makes.

mod aerosols;
mod kernels;
mod mie;
mod milky_way;

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use nocturne::catalog::pack::{self, Packed, SOURCES_FILE};
use nocturne::catalog::sha256_hex;
use nocturne::ephemeris::orientation::nutation::table as nutation_table;
use nocturne::export::OutputFile;

/// The maps of the Moon are not in the repository: SOURCES.toml says where they come from.
const MOON_PICTURE: &str = "moon_lroc_color_4096x2048.jpg";
const MOON_RELIEF: &str = "moon_dem_8ppd_u16.png";
const MOON_HAPKE: &str = "moon_hapke_sato2014_3x140x360x5.f16le";
/// Nor is the picture of the Milky Way.
const MILKY_WAY: &str = "milkyway_gaia_edr3_rgb_3600x1800.jpg";

/// Pack the raw tables into the catalogues that nocturne reads.
#[derive(Parser)]
struct Args {
    /// Directory of the raw tables.
    #[arg(long, value_name = "DIR", default_value = "catalogs/raw")]
    raw: PathBuf,
    /// Directory of the catalogues, with its SOURCES.toml.
    #[arg(long, value_name = "DIR", default_value = "catalogs")]
    out: PathBuf,
    /// Picture of the Moon; without one the packed map stays as it is
    /// [default: moon_lroc_color_4096x2048.jpg among the raw tables, if it is there]
    #[arg(long, value_name = "FILE")]
    moon: Option<PathBuf>,
    /// Picture of the Moon's heights, 16 bits [default: moon_dem_8ppd_u16.png, likewise]
    #[arg(long, value_name = "FILE")]
    relief: Option<PathBuf>,
    /// Hapke parameters of the Moon
    /// [default: moon_hapke_sato2014_3x140x360x5.f16le, likewise]
    #[arg(long, value_name = "FILE")]
    hapke: Option<PathBuf>,
    /// Gaia's sky in colour
    /// [default: milkyway_gaia_edr3_rgb_3600x1800.jpg, likewise]
    #[arg(long, value_name = "FILE")]
    milky_way: Option<PathBuf>,
    /// Table of places (name,l_deg,b_deg) whose starlight is told from that picture before it is
    /// packed; the file is written anew, and nothing is packed
    #[arg(long, value_name = "FILE", requires = "milky_way")]
    starlight_table: Option<PathBuf>,
    /// Directory of the kernels; the table of one that is not there stays as it is
    #[arg(long, value_name = "DIR", default_value = "target/kernels")]
    kernels: PathBuf,
    /// Write nothing; say whether packing gives the same bytes.
    #[arg(long)]
    check: bool,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("pack: {message}");
            ExitCode::from(2)
        }
    }
}

/// Packs one file of maps.
type PackMap<'a> = &'a dyn Fn(&Path) -> Result<Packed, String>;

/// True if all is well: written, or found to be the same.
fn run(args: &Args) -> Result<bool, String> {
    if let (Some(table), Some(picture)) = (&args.starlight_table, &args.milky_way) {
        put(table, milky_way::table(picture, table)?.as_bytes())?;
        return Ok(true);
    }
    let mut packed = vec![
        pack::stars(&args.raw).map_err(|error| error.to_string())?,
        pack::places(&args.raw).map_err(|error| error.to_string())?,
        nutation()?,
    ];
    let maps: [(_, _, PackMap<'_>); 4] = [
        (MOON_PICTURE, &args.moon, &|path| moon(&args.raw, path)),
        (MOON_RELIEF, &args.relief, &relief),
        (MOON_HAPKE, &args.hapke, &hapke),
        (MILKY_WAY, &args.milky_way, &milky_way::pack),
    ];
    for (usual, given, pack) in maps {
        let among_raw = args.raw.join(usual);
        match given.clone().or_else(|| among_raw.is_file().then_some(among_raw)) {
            Some(path) => packed.push(pack(&path)?),
            None => {
                println!("no {usual} among the raw tables: what is packed of it stays as it is")
            }
        }
    }
    packed.extend(kernels::tables(&args.kernels)?);
    packed.extend(aerosols::tables());
    if args.check {
        return Ok(check(&args.out, &packed));
    }
    write(&args.out, &packed)?;
    Ok(true)
}

/// The table of nutation needs no raw table: the series is compiled in.
fn nutation() -> Result<Packed, String> {
    let summary = "IAU 2000A, 1550 to 2650, as what IAU 2000B leaves out".into();
    Ok(Packed { file: nutation_table::FILE, bytes: nutation_table::encode()?, summary })
}

fn moon(raw: &Path, picture: &Path) -> Result<Packed, String> {
    let rgb = image::open(picture)
        .map_err(|error| format!("{}: {error}; give a JPEG or PNG", picture.display()))?
        .into_rgb8();
    let size = (rgb.width() as usize, rgb.height() as usize);
    pack::moon(raw, rgb.as_raw(), size).map_err(|error| error.to_string())
}

fn relief(picture: &Path) -> Result<Packed, String> {
    let metres = image::open(picture)
        .map_err(|error| format!("{}: {error}; give a PNG of 16 bits", picture.display()))?
        .into_luma16();
    let size = (metres.width() as usize, metres.height() as usize);
    pack::moon_relief(metres.as_raw(), size).map_err(|error| error.to_string())
}

fn hapke(table: &Path) -> Result<Packed, String> {
    let bytes = fs::read(table).map_err(|error| format!("{}: {error}", table.display()))?;
    pack::moon_hapke(&bytes).map_err(|error| error.to_string())
}

fn check(out: &Path, packed: &[Packed]) -> bool {
    let mut same = true;
    for packed in packed {
        let path = out.join(packed.file);
        let verdict = match fs::read(&path) {
            Ok(bytes) if bytes == packed.bytes => "the same",
            Ok(_) => "DIFFERENT; run `cargo run --bin pack`",
            Err(_) => "MISSING; run `cargo run --bin pack`",
        };
        same &= verdict == "the same";
        println!("{}: {verdict} ({})", path.display(), packed.summary);
    }
    same
}

fn write(out: &Path, packed: &[Packed]) -> Result<(), String> {
    let sources_path = out.join(SOURCES_FILE);
    let sources = fs::read_to_string(&sources_path)
        .map_err(|error| format!("{}: {error}", sources_path.display()))?;
    let sources = pack::refresh_sources(&sources, packed).map_err(|error| error.to_string())?;
    for packed in packed {
        let path = out.join(packed.file);
        put(&path, &packed.bytes)?;
        println!(
            "{}: {} bytes, SHA-256 {}… ({})",
            path.display(),
            packed.bytes.len(),
            &sha256_hex(&packed.bytes)[..12],
            packed.summary
        );
    }
    put(&sources_path, sources.as_bytes())
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let written = OutputFile::create(path).and_then(|file| file.write(|out| out.write_all(bytes)));
    written.map_err(|error| error.to_string())
}

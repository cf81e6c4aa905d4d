//! Tables of motion out of the kernels that `scripts/fetch_kernels.sh` fetches.
//!
//! A kernel is too large for the repository; without it its table stays as it is.

use std::fs;
use std::path::Path;

use nocturne::catalog::pack::Packed;
use nocturne::ephemeris::de440;
use nocturne::ephemeris::kernel::Kernel;
use nocturne::ephemeris::moon_orientation::{self, LIBRATION_FILE};
use nocturne::ephemeris::resampled::{Depth, LAYERS, Table};

/// Dates at which a table is compared with its kernel.
const DATES: u32 = 100_000;

/// A table: its file, its kernel, and what makes the one out of the other.
type Plan = (&'static str, &'static str, fn(&Path) -> Result<Packed, String>);

const PLANS: [Plan; 2] =
    [("de440.bin", "de440.bsp", de440), (LIBRATION_FILE, "jpl-librations.npy", librations)];

/// Every table whose kernel lies in the directory.
pub fn tables(kernels: &Path) -> Result<Vec<Packed>, String> {
    let mut packed = Vec::new();
    for (file, kernel, pack) in PLANS {
        let path = kernels.join(kernel);
        if path.is_file() {
            packed.push(pack(&path)?);
        } else {
            println!("{file}: no {}, the packed table stays as it is", path.display());
        }
    }
    Ok(packed)
}

fn de440(path: &Path) -> Result<Packed, String> {
    let named = |what: String| format!("{}: {what}", path.display());
    let bytes = fs::read(path).map_err(|error| named(error.to_string()))?;
    let kernel = Kernel::open(bytes).map_err(named)?;
    let bytes = de440::table(&kernel).map_err(named)?;
    let table = Table::from_bytes(&bytes, Depth::Thousandth).map_err(named)?;
    println!("de440.bin against the kernel, the largest of {DATES} dates, as the Earth sees it:");
    println!(
        "channel         bytes  depth        direction, \"  distance, km  position, km   folding, km"
    );
    for row in de440::errors(&kernel, &table, DATES).map_err(named)? {
        let channel = table.channel(row.id);
        let layer = row.depth.layers() - 1;
        println!(
            "{:12} {:8}  {:10} {:14.5} {:13.4} {:13.4} {:13.6}",
            row.id,
            channel.map_or(0, |channel| channel.bytes()[layer]),
            format!("{:?}", row.depth),
            row.direction.arcsec(),
            row.distance_km,
            row.position_km,
            row.folding_km
        );
    }
    let sum = |layer: usize| table.channels().map(|channel| channel.bytes()[layer]).sum::<usize>();
    let layers: Vec<_> = (0..LAYERS).map(|layer| sum(layer).to_string()).collect();
    let summary = format!("layers of {} bytes", layers.join(", "));
    Ok(Packed { file: "de440.bin", bytes, summary })
}

fn librations(path: &Path) -> Result<Packed, String> {
    let named = |what: String| format!("{}: {what}", path.display());
    let npy = fs::read(path).map_err(|error| named(error.to_string()))?;
    let table = moon_orientation::pack(&npy).map_err(named)?;
    let summary = format!("within {:.3}\" of DE421", table.largest_error.arcsec());
    Ok(Packed { file: LIBRATION_FILE, bytes: table.bytes, summary })
}

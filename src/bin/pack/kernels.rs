//! Tables of motion out of the kernels that `scripts/fetch_kernels.sh` fetches.
//!
//! A kernel is too large for the repository; without it its table stays as it is.

use std::fs;
use std::path::Path;

use nocturne::catalog::pack::Packed;
use nocturne::ephemeris::comparison::{self, Truth};
use nocturne::ephemeris::kernel::Kernel;
use nocturne::ephemeris::moon_orientation::{self, LIBRATION_FILE};
use nocturne::ephemeris::resampled::{Depth, LAYERS, Table};
use nocturne::ephemeris::{de431, de440};

/// Dates at which a table is compared with its kernel.
const DATES: u32 = 100_000;

/// A table: its file, its kernel, and what makes the one out of the bytes of the other.
type Plan = (&'static str, &'static str, fn(Vec<u8>) -> Result<Packed, String>);

const PLANS: [Plan; 3] = [
    ("de440.bin", "de440.bsp", de440),
    ("de431.bin", "de431_samples.bin", de431),
    (LIBRATION_FILE, "jpl-librations.npy", librations),
];

/// Every table whose kernel lies in the directory.
pub fn tables(kernels: &Path) -> Result<Vec<Packed>, String> {
    let mut packed = Vec::new();
    for (file, kernel, pack) in PLANS {
        let path = kernels.join(kernel);
        if path.is_file() {
            let named = |what: String| format!("{}: {what}", path.display());
            let bytes = fs::read(&path).map_err(|error| named(error.to_string()))?;
            packed.push(pack(bytes).map_err(named)?);
        } else {
            println!("{file}: no {}, the packed table stays as it is", path.display());
        }
    }
    Ok(packed)
}

fn de440(kernel: Vec<u8>) -> Result<Packed, String> {
    let kernel = Kernel::open(kernel)?;
    let bytes = de440::table(&kernel)?;
    let truth: &Truth = &|channel, tdb| de440::position_km(&kernel, channel, tdb);
    packed("de440.bin", bytes, truth, &Depth::ALL)
}

fn de431(samples: Vec<u8>) -> Result<Packed, String> {
    let samples = de431::Samples::open(samples)?;
    let bytes = de431::table(&samples)?;
    let truth: &Truth = &|channel, tdb| samples.position_km(channel, tdb);
    packed("de431.bin", bytes, truth, &[Depth::Tenth])
}

/// Prints how far the table is from the truth.
fn packed(
    file: &'static str,
    bytes: Vec<u8>,
    truth: &Truth,
    depths: &[Depth],
) -> Result<Packed, String> {
    let table = Table::from_bytes(&bytes, Depth::Thousandth)?;
    println!("{file} against its source, the largest of {DATES} dates, as the Earth sees it:");
    println!(
        "channel         bytes  depth        direction, \"  distance, km  position, km   folding, km"
    );
    for row in comparison::errors(&table, truth, depths, DATES)? {
        let layer = row.depth.layers() - 1;
        println!(
            "{:12} {:8}  {:10} {:14.5} {:13.4} {:13.4} {:13.6}",
            row.id,
            table.channel(&row.id).map_or(0, |channel| channel.bytes()[layer]),
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
    Ok(Packed { file, bytes, summary })
}

fn librations(npy: Vec<u8>) -> Result<Packed, String> {
    let table = moon_orientation::pack(&npy)?;
    let summary = format!("within {:.3}\" of DE421", table.largest_error.arcsec());
    Ok(Packed { file: LIBRATION_FILE, bytes: table.bytes, summary })
}

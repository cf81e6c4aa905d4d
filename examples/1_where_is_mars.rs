//! Where a planet stands: a time, a place, and the sky over it.
//!
//! `cargo run --example 1_where_is_mars --no-default-features`

use std::error::Error;

use nocturne::catalog::Catalogs;
use nocturne::ephemeris::{Body, Ephemeris};
use nocturne::place::Place;
use nocturne::sky::SkyState;
use nocturne::time;
use nocturne::units::Angle;

fn main() -> Result<(), Box<dyn Error>> {
    // An offset from UTC says which midnight is meant: Flagstaff keeps -07:00 all year.
    let instant = time::to_instant(&time::parse("2026-12-24T23:00-07:00")?, None)?;
    let flagstaff = Place::new(35.198, -111.651, 2106.0)?;

    // Say how far off an answer may be, and the cheapest theory that is good enough gives it.
    let tolerance = Angle::from_arcsec(0.01);
    let ephemeris = Ephemeris::load(&Catalogs::locate(None)?, tolerance)?;
    let sky = SkyState::at(&ephemeris, &instant, &flagstaff, tolerance)?;

    for body in [Body::Mars, Body::Moon, Body::Sun] {
        let Some(state) = sky.body(body) else { continue };
        println!(
            "{body} at {instant}: azimuth {:.6}°, altitude {:.6}° without air, within {}\"",
            state.dir.azimuth().deg(),
            state.dir.altitude().deg(),
            state.error_bound.arcsec(),
        );
    }
    Ok(())
}

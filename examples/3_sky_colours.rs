//! The colours of the clear sky, along the meridian through the Sun, from day to night.
//!
//! `cargo run --release --example 3_sky_colours --no-default-features`

use std::error::Error;

use nocturne::air::Atmosphere;
use nocturne::ephemeris::Ephemeris;
use nocturne::frame::{Apparent, Dir};
use nocturne::light::night::Night;
use nocturne::place::Place;
use nocturne::plan::skylight::{KeptAir, sky_plan};
use nocturne::sky::SkyState;
use nocturne::store::Store;
use nocturne::time;
use nocturne::units::Angle;

fn main() -> Result<(), Box<dyn Error>> {
    let greenwich = Place::new(51.478, 0.0, 47.0)?;
    // The air is solved once for all times.
    let mut kept = KeptAir::new(Store::of_user());
    // What is compiled in is good enough for colours.
    let ephemeris = Ephemeris::analytic();
    // Around the equinox the Sun sets at six; five times of one evening.
    for clock in ["12:00", "17:00", "18:05", "18:45", "20:30"] {
        let instant = time::to_instant(&time::parse(&format!("2027-03-20T{clock}Z"))?, None)?;
        let sky = SkyState::at(&ephemeris, &instant, &greenwich, Angle::from_arcmin(10.0))?;
        let sun = sky.sun.dir;
        let night = Night::of(sky, Vec::new(), &Atmosphere::default());
        let (with_sun, with_moon) = (true, false);
        let (plan, _) = sky_plan(&night, with_sun, with_moon, &mut kept)?;

        println!("Sun at {:.1}°: luminance in cd/m2, chromaticity x y", sun.altitude().deg());
        // From the horizon below the Sun over the zenith to the horizon on the other side.
        for from_horizon_deg in [1.0, 15.0, 30.0, 60.0, 90.0, 120.0, 150.0, 179.0] {
            let along = Angle::from_deg(from_horizon_deg);
            let dir: Dir<Apparent> = Dir::from_azimuth_altitude(sun.azimuth(), along);
            let light = plan.luminance(dir);
            let sum = light.x + light.y + light.z;
            let (x, y) = (light.x / sum, light.y / sum);
            println!("  {from_horizon_deg:5}°  {:12.6}  {x:.3} {y:.3}", light.y);
        }
    }
    Ok(())
}

//! How dark is the zenith of Paranal on a moonless night, and what lights it?
//!
//! `cargo run --release --example 7_how_dark_is_the_sky`

use std::error::Error;

use nocturne::air::Atmosphere;
use nocturne::catalog::Catalogs;
use nocturne::ephemeris::Ephemeris;
use nocturne::frame::Dir;
use nocturne::light::night::Night;
use nocturne::light::night_lights::NightGlow;
use nocturne::light::photometry::Band;
use nocturne::place::Place;
use nocturne::plan::brightness::MeasuredSky;
use nocturne::plan::lay::Kept;
use nocturne::scene::Layers;
use nocturne::sky::SkyState;
use nocturne::store::Store;
use nocturne::time;
use nocturne::units::Angle;

fn main() -> Result<(), Box<dyn Error>> {
    let catalogs = Catalogs::locate(None)?;
    let place = Place::new(-24.627, -70.404, 2635.0)?;
    let instant = time::to_instant(&time::parse("2026-03-19T04:30Z")?, None)?;
    let tolerance = Angle::from_arcsec(10.0);
    let sky = SkyState::at(&Ephemeris::load(&catalogs, tolerance)?, &instant, &place, tolerance)?;
    let night = Night::of(sky, catalogs.stars()?, &Atmosphere::clear_over(place.height_m));

    let mut kept = Kept::new(Store::NONE);
    let (glow, layers) = (NightGlow::default(), Layers::default());
    let measured = MeasuredSky::of(&night, &glow, &layers, &catalogs, &mut kept)?;
    let zenith = Dir::from_azimuth_altitude(Angle::ZERO, Angle::from_deg(90.0));
    let seen = measured.at(zenith, &mut kept)?;

    let v = seen.mag_per_arcsec2(Band::V).ok_or("no light at all")?;
    println!("{:.3e} cd/m2, {v:.2} mag/arcsec2 in V, of which", seen.luminance().y);
    for (source, light) in &seen.sources {
        println!("{:>10}: {:.3e} cd/m2", source.name(), light.xyzv().y);
    }
    println!("faintest star for the naked eye: {:.1}", seen.limiting_magnitude().0);
    Ok(())
}

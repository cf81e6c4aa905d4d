//! How bright a star is: its light outside the air, and what is left of it at each altitude.
//!
//! `cargo run --example 2_how_bright_is_sirius --no-default-features`

use std::error::Error;

use nocturne::air::Atmosphere;
use nocturne::air::extinction::{air_masses, transmittance};
use nocturne::catalog::Catalogs;
use nocturne::light::star_spectrum;
use nocturne::units::{Angle, Illuminance};

fn main() -> Result<(), Box<dyn Error>> {
    let stars = Catalogs::locate(None)?.stars()?;
    let is_sirius = |name: &Option<String>| name.as_deref() == Some("Sirius");
    let sirius = stars.iter().find(|star| is_sirius(&star.name)).ok_or("no Sirius")?;
    // A spectrum, W m-2 nm-1, with the illuminance of its magnitude and the shape of its type.
    let light = star_spectrum::star(sirius);
    println!("Outside the air: V = {:.2}, {:.3} microlux", sirius.magnitude.0, light.xyzv.y * 1e6);

    let (air, height_m) = (Atmosphere::default(), 0.0);
    println!("altitude  air mass  microlux  magnitude  chromaticity");
    for altitude_deg in [90.0, 60.0, 30.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.0] {
        let altitude = Angle::from_deg(altitude_deg);
        // The air dims each wavelength by its own share; the eye weighs what is left.
        let seen = (light.spectrum * transmittance(&air, height_m, altitude)).xyzv();
        let magnitude = Illuminance::from_lx(seen.y).magnitude().0;
        let sum = seen.x + seen.y + seen.z;
        let air_mass = air_masses(&air, height_m, altitude).air;
        println!(
            "{altitude_deg:7}°  {air_mass:8.2}  {:8.4}  {magnitude:9.2}  {:.3} {:.3}",
            seen.y * 1e6,
            seen.x / sum,
            seen.y / sum,
        );
    }
    Ok(())
}

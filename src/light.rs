//! How bright things shine, outside the air, in SI: spectra of the Sun, the Moon, the planets, the
//! stars and the dark sky.
//!
//! Plain numbers in (distances, angles, magnitudes), light out. Where things stand is the business
//! of the ephemeris; what the air takes away is folded in by [`star_light`] and by
//! [`crate::air::extinction`].

pub mod airglow;
pub mod belts;
pub mod clear_view;
pub mod corona;
pub mod dark_sky;
pub mod disc_light;
pub mod earth_shadow;
pub mod earthshine;
pub mod lamps;
pub mod limb_law;
pub mod moon;
pub mod moon_shadow;
pub mod night;
pub mod night_lights;
pub mod photometry;
pub mod planets;
pub mod point_light;
pub mod satellites;
pub mod saturn_rings;
pub mod scintillation;
pub mod solar_cycle;
pub mod solar_eclipse;
pub mod spectrum;
pub mod star_colour;
pub mod star_light;
pub mod star_spectrum;
pub mod starlight;
pub mod sun;
pub mod town_glow;
pub mod zodiacal;

pub use point_light::PointLight;

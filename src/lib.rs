//! The night sky as it would really look: where everything stands, and how bright it is.
//!
//! The modules in the order in which light comes to be seen; a file uses only what stands above
//! it. From [`frame`] to [`scene`] nothing knows of a GPU or of a window.
//!
//! ```
//! use nocturne::air::Atmosphere;
//! use nocturne::catalog::Catalogs;
//! use nocturne::ephemeris::Ephemeris;
//! use nocturne::light::night::Night;
//! use nocturne::place::Place;
//! use nocturne::sky::SkyState;
//! use nocturne::time;
//! use nocturne::units::Angle;
//!
//! // A date and a place become directions ...
//! let instant = time::to_instant(&time::parse("2026-01-18T06:00Z")?, None)?;
//! let place = Place::new(35.198, -111.651, 2106.0)?;
//! let catalogs = Catalogs::locate(None)?;
//! let tolerance = Angle::from_arcmin(1.0);
//! let ephemeris = Ephemeris::load(&catalogs, tolerance)?;
//! let sky = SkyState::at(&ephemeris, &instant, &place, tolerance)?;
//! // ... directions become light ...
//! let night = Night::of(sky, catalogs.stars()?, &Atmosphere::default());
//! let sirius = night.find("Sirius").expect("it is in the catalogue");
//! assert!((sirius.magnitude.0 + 1.46).abs() < 0.01);
//! // ... and the air takes its share.
//! assert!(sirius.ground.y < sirius.outside.lx());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What follows is for those who draw: [`plan::lay`] lays a night on the picture, `render` draws
//! it into an [`image::HdrFrame`] in cd/m2, an [`eye`] sees it or a camera records it ([`photo`]), a
//! [`display`] shows it, and [`export`] writes it down.

// What everything is said in.
pub mod frame;
pub mod image;
pub mod units;

// What takes long: beside what is seen, and once.
pub mod background;
pub mod memory;
pub mod store;

// When, where, with what eyes and from what data.
pub mod camera;
pub mod catalog;
pub mod place;
pub mod time;

// Where bodies are, and where they stand in the sky of a place.
pub mod ephemeris;
pub mod sky;

// What happens there, and when.
pub mod almanac;

// What lies between, how bright things shine, and what an eye or a camera makes of it for a screen.
pub mod air;
pub mod display;
pub mod eye;
pub mod light;
pub mod photo;

// A picture: described, planned, drawn.
pub mod plan;
#[cfg(feature = "gpu")]
pub mod render;
pub mod scene;
pub mod studio;

// Files, what makes them, and the program.
#[cfg(feature = "app")]
pub mod app;
#[cfg(feature = "cli")]
pub mod cli;
pub mod export;
#[cfg(feature = "cli")]
pub mod job;
#[cfg(feature = "cli")]
pub mod overlay;

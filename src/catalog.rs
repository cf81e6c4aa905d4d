//! The data that the project ships: found, checked and read here and nowhere else.
//!
//! [`Catalogs::locate`] finds the directory, and each reader gives the whole of one file or one
//! sentence that says what is wrong with it. `catalogs/SOURCES.toml` says where every file comes
//! from; [`pack`] makes the files out of the raw tables.

use std::env;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;

use crate::frame::{Dir, Icrs};
use crate::units::Magnitude;

mod bsc5;
mod colour;
mod constellations;
mod csv;
mod hipparcos;
pub mod layered;
mod messier;
pub mod milky_way;
pub mod moon;
mod moon_features;
pub mod pack;
pub mod places;
mod rice;
mod seal;
pub mod stars;

pub use colour::{Luminosity, spectral_class};
pub use constellations::{Constellation, ConstellationId, Corner, FigureStar, constellations};
pub use hipparcos::Astrometry;
pub use messier::{MessierObject, messier, messier_objects};
pub use milky_way::MilkyWay;
pub use moon::{HapkeCell, MoonHapke, MoonMap, MoonRelief};
pub use moon_features::MoonFeature;
pub use seal::sha256_hex;

const STARS_FILE: &str = "stars.bin";
const ASTROMETRY_FILE: &str = "hipparcos.csv";
const PLACES_FILE: &str = "places.csv";
const MOON_FILE: &str = "moon_albedo.bin";
const RELIEF_FILE: &str = "moon_relief.bin";
const HAPKE_FILE: &str = "moon_hapke.bin";
const MILKY_WAY_FILE: &str = "milky_way.bin";
const MOON_FEATURES_FILE: &str = "moon_features.csv";
const ENVIRONMENT_VARIABLE: &str = "NOCTURNE_CATALOGS";

/// Maps of the Moon, shared by the frames that show it.
#[derive(Debug, Clone, PartialEq)]
pub struct MoonMaps {
    pub albedo: Arc<MoonMap>,
    pub relief: Arc<MoonRelief>,
    pub hapke: Arc<MoonHapke>,
}

/// A star of the Yale Bright Star Catalogue, 5th edition (Hoffleit & Warren 1991).
#[derive(Debug, Clone, PartialEq)]
pub struct Star {
    /// Number in the Harvard Revised catalogue: `HR 2491` is Sirius.
    pub hr: u16,
    /// Number in the Hipparcos catalogue, if it has one.
    pub hip: Option<u32>,
    /// Number in the Henry Draper catalogue.
    pub hd: Option<u32>,
    /// Bayer designation as people write it, such as `α CMa`; Flamsteed's, such as `61 Cyg`, if there is
    /// no letter.
    pub designation: Option<String>,
    /// Flamsteed designation, whether there is a letter too or not: `9 CMa`.
    pub flamsteed: Option<String>,
    /// Name approved by the IAU, such as `Sirius`.
    pub name: Option<String>,
    /// Direction at epoch and equinox J2000.0 (FK5, which is ICRS within 0.1 arcsecond). The
    /// catalogue rounds it to 0.1 s of right ascension and 1 arcsecond of declination.
    pub dir_j2000: Dir<Icrs>,
    /// Proper motion in right ascension times the cosine of declination, arcseconds a year.
    pub proper_motion_ra_arcsec_yr: f64,
    /// Proper motion in declination, arcseconds a year.
    pub proper_motion_dec_arcsec_yr: f64,
    /// Annual parallax, arcseconds; zero when the catalogue has none.
    pub parallax_arcsec: f64,
    /// Radial velocity, kilometres per second, positive away from us; zero when unknown.
    pub radial_velocity_km_s: f64,
    /// Johnson V.
    pub magnitude: Magnitude,
    /// Johnson B-V, measured or estimated from the spectral type.
    pub b_v: f64,
    /// Spectral type as the catalogue writes it.
    pub spectral_type: String,
    /// Name as a variable star, `NSV` and a number in the catalogue of suspected ones, or `Var` and
    /// `Var?` where the catalogue has no more. No amplitude and no period is known here: its magnitude is
    /// drawn as it is.
    pub variable: Option<String>,
    /// The companion that the catalogue lists, if any.
    pub companion: Option<Companion>,
}

/// A companion of a star: of a double star the fainter one. The catalogue has no position angle, so
/// that it is not drawn apart; where the two share a line of the catalogue its light is in that of the star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Companion {
    /// Distance on the sky, arcseconds; 0.0 when closer than the catalogue writes.
    pub separation_arcsec: f64,
    /// How much fainter it is, mag; none when unknown.
    pub magnitude_difference: Option<f64>,
}

/// What can be wrong with the data files.
#[derive(Debug, Error)]
pub enum CatalogError {
    #[error(
        "no {STARS_FILE} in {looked}; set {ENVIRONMENT_VARIABLE} to the directory of the catalogues"
    )]
    NotFound { looked: String },
    #[error("{path}: {source}; run `cargo run --bin pack`, or fetch the file again")]
    Unreadable { path: PathBuf, source: io::Error },
    #[error("{path} {what}; run `cargo run --bin pack`, or fetch the file again")]
    Damaged { path: PathBuf, what: String },
    #[error("{path}: {source}; fetch the raw table again from where SOURCES.toml says")]
    RawUnreadable { path: PathBuf, source: io::Error },
    #[error("{path}, line {line}: {what}; fetch the raw table again, or mend the packing")]
    Raw { path: PathBuf, line: usize, what: String },
    #[error("the picture {what}; give the one named in SOURCES.toml")]
    Picture { what: String },
    #[error("SOURCES.toml has no path and sha256 for {file}; add a [[file]] table for it")]
    NoSource { file: &'static str },
}

/// The directory that holds the catalogues.
#[derive(Debug, Clone, PartialEq)]
pub struct Catalogs {
    directory: PathBuf,
}

impl Catalogs {
    /// Finds the directory: the one given; else the one that the environment variable
    /// `NOCTURNE_CATALOGS` names; else `catalogs/` beside the program, `../share/nocturne/catalogs`
    /// from it, or `catalogs/` in the source tree that it was built from.
    ///
    /// A directory that is given or named in the environment must hold the catalogues: there is no
    /// silent step to the next.
    pub fn locate(explicit: Option<&Path>) -> Result<Catalogs, CatalogError> {
        let environment = env::var_os(ENVIRONMENT_VARIABLE).filter(|value| !value.is_empty());
        let program = env::current_exe().ok();
        Catalogs::locate_among(&candidates(
            explicit,
            environment.as_ref().map(Path::new),
            program.as_deref(),
        ))
    }

    fn locate_among(candidates: &[PathBuf]) -> Result<Catalogs, CatalogError> {
        match candidates.iter().find(|directory| directory.join(STARS_FILE).is_file()) {
            Some(directory) => Ok(Catalogs { directory: directory.clone() }),
            None => {
                let looked: Vec<_> =
                    candidates.iter().map(|path| path.display().to_string()).collect();
                Err(CatalogError::NotFound { looked: looked.join(" or ") })
            }
        }
    }

    /// Where the catalogues are.
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// All 9096 stars of the Bright Star Catalogue, in the order of HR.
    pub fn stars(&self) -> Result<Vec<Star>, CatalogError> {
        let records = self.read(STARS_FILE, |bytes| stars::decode(&bytes))?;
        Ok(records.into_iter().map(Star::from).collect())
    }

    /// The few stars whose places are known to the milliarcsecond here.
    pub fn astrometry(&self) -> Result<Vec<Astrometry>, CatalogError> {
        self.read(ASTROMETRY_FILE, |bytes| {
            let text = std::str::from_utf8(&bytes).map_err(|_| "is not UTF-8")?;
            hipparcos::parse(text).map_err(|(line, what)| format!("line {line}: {what}"))
        })
    }

    /// The gazetteer as a table: a line with [`places::COLUMNS`], then one line per place.
    pub fn places_text(&self) -> Result<String, CatalogError> {
        self.read(PLACES_FILE, places::open)
    }

    /// The maps that the Moon is drawn from.
    pub fn moon_maps(&self) -> Result<MoonMaps, CatalogError> {
        Ok(MoonMaps {
            albedo: Arc::new(self.moon_map()?),
            relief: Arc::new(self.moon_relief()?),
            hapke: Arc::new(self.moon_hapke()?),
        })
    }

    /// The reflectance of the Moon.
    pub fn moon_map(&self) -> Result<MoonMap, CatalogError> {
        self.read(MOON_FILE, |bytes| moon::albedo::decode(&bytes))
    }

    /// The heights of the Moon.
    pub fn moon_relief(&self) -> Result<MoonRelief, CatalogError> {
        self.read(RELIEF_FILE, |bytes| moon::relief::decode(&bytes))
    }

    /// How the ground of the Moon sends light back.
    pub fn moon_hapke(&self) -> Result<MoonHapke, CatalogError> {
        self.read(HAPKE_FILE, |bytes| moon::hapke::decode(&bytes))
    }

    /// The light of the stars that are not in the Bright Star Catalogue.
    pub fn milky_way(&self) -> Result<MilkyWay, CatalogError> {
        self.read(MILKY_WAY_FILE, |bytes| milky_way::decode(&bytes))
    }

    /// The best-known places on the Moon.
    pub fn moon_features(&self) -> Result<Vec<MoonFeature>, CatalogError> {
        self.read(MOON_FEATURES_FILE, |bytes| {
            let text = std::str::from_utf8(&bytes).map_err(|_| "is not UTF-8")?;
            moon_features::parse(text).map_err(|(line, what)| format!("line {line}: {what}"))
        })
    }

    /// The payloads of the first `depth` layers of a layered file; the rest of it is not read.
    pub fn layers(&self, file: &str, depth: usize) -> Result<Vec<Vec<u8>>, CatalogError> {
        let path = self.directory.join(file);
        match File::open(&path) {
            Ok(file) => layered::open_layers(file, depth)
                .map_err(|what| CatalogError::Damaged { path, what }),
            Err(source) => Err(CatalogError::Unreadable { path, source }),
        }
    }

    /// The error that a file which was read says nothing sensible.
    pub fn damaged(&self, file: &str, what: String) -> CatalogError {
        CatalogError::Damaged { path: self.directory.join(file), what }
    }

    fn read<T>(
        &self,
        file: &str,
        decode: impl Fn(Vec<u8>) -> Result<T, String>,
    ) -> Result<T, CatalogError> {
        let path = self.directory.join(file);
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(source) => return Err(CatalogError::Unreadable { path, source }),
        };
        decode(bytes).map_err(|what| CatalogError::Damaged { path, what })
    }
}

/// The directories to look into, the first that holds the catalogues wins.
fn candidates(
    explicit: Option<&Path>,
    environment: Option<&Path>,
    program: Option<&Path>,
) -> Vec<PathBuf> {
    if let Some(named) = explicit.or(environment) {
        return vec![named.to_owned()];
    }
    let beside = program.and_then(Path::parent).into_iter().flat_map(|directory| {
        [directory.join("catalogs"), directory.join("../share/nocturne/catalogs")]
    });
    beside.chain([Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs")]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_directory_that_was_named_is_the_only_candidate() {
        let (given, environment) = (Path::new("given"), Path::new("environment"));
        let program = Some(Path::new("bin/nocturne"));
        assert_eq!(candidates(Some(given), Some(environment), program), [given]);
        assert_eq!(candidates(None, Some(environment), program), [environment]);
        let usual = candidates(None, None, program);
        assert_eq!(usual[0], Path::new("bin/catalogs"));
        assert_eq!(usual[1], Path::new("bin/../share/nocturne/catalogs"));
        assert_eq!(usual[2], Path::new(env!("CARGO_MANIFEST_DIR")).join("catalogs"));
        assert_eq!(usual.len(), 3);
    }

    #[test]
    fn the_first_candidate_that_holds_the_stars_wins() {
        let root = tempfile::tempdir().unwrap();
        let [empty, first, second] = ["empty", "first", "second"].map(|name| {
            let directory = root.path().join(name);
            fs::create_dir(&directory).unwrap();
            directory
        });
        fs::write(first.join(STARS_FILE), "").unwrap();
        fs::write(second.join(STARS_FILE), "").unwrap();
        let found = Catalogs::locate_among(&[empty.clone(), first.clone(), second]).unwrap();
        assert_eq!(found.directory(), first);
        let message = Catalogs::locate_among(&[empty]).unwrap_err().to_string();
        assert!(message.contains("empty") && message.contains("NOCTURNE_CATALOGS"), "{message}");
    }
}

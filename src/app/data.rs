//! What the panels look things up in, read when it is first asked for.

use std::sync::{Arc, OnceLock};

use crate::catalog::Catalogs;
use crate::place::gazetteer::Gazetteer;
use crate::sky::finder::Finder;
use crate::sky::star_index::StarIndex;

use super::knowledge::{Days, LightMeter};

/// Catalogues and indices of the window.
pub struct Data {
    pub catalogs: Catalogs,
    pub places: Places,
    /// When things rise and set.
    pub days: Days,
    /// How bright the sky is.
    pub light: LightMeter,
    finder: OnceLock<Result<Finder, String>>,
}

/// The places of the world, read once; copies share it, also between threads.
#[derive(Clone)]
pub struct Places {
    catalogs: Catalogs,
    gazetteer: Arc<OnceLock<Result<Gazetteer, String>>>,
}

impl Data {
    pub fn new(catalogs: Catalogs) -> Data {
        let places = Places { catalogs: catalogs.clone(), gazetteer: Arc::default() };
        Data {
            days: Days::new(catalogs.clone()),
            light: LightMeter::new(catalogs.clone()),
            finder: OnceLock::new(),
            catalogs,
            places,
        }
    }

    /// Everything in the sky that has a name, or why there is no list of it.
    pub fn finder(&self) -> Result<&Finder, &str> {
        let read = || {
            let stars = self.catalogs.stars().map_err(|error| error.to_string())?;
            let features = self.catalogs.moon_features().map_err(|error| error.to_string())?;
            Ok(Finder::new(&StarIndex::new(stars), &features))
        };
        self.finder.get_or_init(read).as_ref().map_err(String::as_str)
    }

    /// The places of the world, or why there are none.
    pub fn gazetteer(&self) -> Result<&Gazetteer, &str> {
        self.places.read()
    }
}

impl Places {
    /// Reads them, if nobody has.
    pub fn read(&self) -> Result<&Gazetteer, &str> {
        let read = || {
            let text = self.catalogs.places_text().map_err(|error| error.to_string())?;
            Gazetteer::parse(&text).map_err(|error| error.to_string())
        };
        self.gazetteer.get_or_init(read).as_ref().map_err(String::as_str)
    }

    /// Those that have been read.
    pub fn known(&self) -> Option<Result<&Gazetteer, &str>> {
        Some(self.gazetteer.get()?.as_ref().map_err(String::as_str))
    }
}

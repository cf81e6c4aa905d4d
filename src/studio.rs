//! What frames in a row share: data read once, and tables of the frame before where they are the same.
//!
//! A [`Studio`] turns scenes into nights and plans, one after the other, for a window or for thousands of
//! frames. A frame costs what has changed since the one before: another camera alone costs the stars and
//! bodies in view; another instant their places and what the sky of Sun, Moon and stars has moved. What
//! it keeps does not grow with the frames.
//!
//! Night and plan together, CPU of all threads of a two-core machine that others used too, median (and mean,
//! which holds the frames that make tables), milliseconds, of a dark night, a moonlit one, dusk and day: of
//! another camera 1.3, 2.5, 2.1, 4.0; a second later 1.7 (10), 3.1 (13), 2.9 (17), 4.0 (5.3); a minute later,
//! when the dark sky has a table of its own, 47, 50, 64, 5.4 (`cargo bench --bench row`).
//!
//! The first frame of a studio is that of [`crate::plan::lay::lay`], number for number. A frame of the same
//! instant shows the same tables of the sky, whatever its camera.

use std::sync::{Arc, OnceLock};

use thiserror::Error;

use crate::catalog::{CatalogError, Catalogs, MilkyWay, MoonFeature, MoonMaps};
use crate::ephemeris::{Ephemeris, EphemerisError, Tolerance};
use crate::light::clear_view::ClearView;
use crate::light::night::Night;
use crate::light::town_glow::{Town, towns_around};
use crate::place::Place;
use crate::place::gazetteer::{Gazetteer, GazetteerError};
use crate::plan::data::SkyData;
use crate::plan::lay::{Kept, lay_in};
use crate::plan::ledger::Ledger;
use crate::plan::{FramePlan, PlanError};
use crate::scene::{Scene, Setting};
use crate::sky::SkyState;
use crate::sky::star_index::StarIndex;
use crate::store::Store;

/// Why there is no night, or no plan of it.
#[derive(Debug, Error)]
pub enum StudioError {
    #[error(transparent)]
    Catalog(#[from] CatalogError),
    #[error(transparent)]
    Ephemeris(#[from] EphemerisError),
    #[error(transparent)]
    Places(#[from] GazetteerError),
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// Everything that frames in a row share.
pub struct Studio {
    files: Files,
    stars: StarIndex,
    features: Vec<MoonFeature>,
    /// Read as deep as the finest tolerance so far asked.
    ephemeris: Option<Ephemeris>,
    view: Option<ClearView>,
    kept: Kept,
}

impl Studio {
    /// Reads what every frame needs; what few need is read when it is first needed. Solved air is taken
    /// from the store and kept there.
    pub fn open(catalogs: &Catalogs, store: Store) -> Result<Studio, StudioError> {
        Ok(Studio {
            stars: StarIndex::new(catalogs.stars()?),
            features: catalogs.moon_features()?,
            files: Files::of(catalogs),
            ephemeris: None,
            view: None,
            kept: Kept::new(store),
        })
    }

    /// The sky of a scene, given what its values mean.
    pub fn night(&mut self, scene: &Scene, setting: &Setting) -> Result<Night, StudioError> {
        let Setting { instant, place, tolerance, .. } = setting;
        let view = match self.view.take_if(|view| view.is_of(&scene.air, place.height_m)) {
            Some(view) => view,
            None => ClearView::new(&scene.air, place.height_m),
        };
        let view = self.view.insert(view).clone();
        let ephemeris = self.ephemeris(*tolerance)?;
        let sky = SkyState::at(ephemeris, instant, place, *tolerance)?;
        let night = Night::seen_through(&view, sky, self.stars.clone(), scene.moon.danjon);
        Ok(night.with_moon_features(self.features.clone()))
    }

    /// The plan of a frame of a night, and the ledger of what is in it.
    pub fn lay(
        &mut self,
        scene: &Scene,
        setting: &Setting,
        night: &Night,
    ) -> Result<(FramePlan, Ledger), StudioError> {
        Ok(lay_in(setting, &scene.layers, night, &self.files, &mut self.kept)?)
    }

    /// The stars of the catalogue.
    pub fn stars(&self) -> &StarIndex {
        &self.stars
    }

    /// The best-known places on the Moon.
    pub fn features(&self) -> &[MoonFeature] {
        &self.features
    }

    /// The list of places; read when it is first asked for.
    pub fn gazetteer(&mut self) -> Result<&Gazetteer, StudioError> {
        Ok(self.files.gazetteer()?)
    }

    /// Where bodies are, as well as a tolerance asks or better.
    pub fn ephemeris(&mut self, tolerance: Tolerance) -> Result<&Ephemeris, StudioError> {
        let ephemeris = match self.ephemeris.take_if(|known| known.serves(tolerance)) {
            Some(known) => known,
            None => Ephemeris::load(&self.files.catalogs, tolerance)?,
        };
        Ok(self.ephemeris.insert(ephemeris))
    }

    /// What frames share of their plans.
    pub fn kept(&mut self) -> &mut Kept {
        &mut self.kept
    }
}

impl SkyData for Studio {
    fn moon_maps(&self) -> Result<MoonMaps, CatalogError> {
        self.files.moon_maps()
    }

    fn milky_way(&self) -> Result<Option<Arc<MilkyWay>>, CatalogError> {
        self.files.milky_way()
    }

    fn towns_around(&self, place: &Place) -> Result<Vec<Town>, PlanError> {
        self.files.towns_around(place)
    }
}

/// The catalogues, each file read once at most.
struct Files {
    catalogs: Catalogs,
    moon: OnceLock<MoonMaps>,
    milky_way: OnceLock<Arc<MilkyWay>>,
    gazetteer: OnceLock<Gazetteer>,
}

impl Files {
    fn of(catalogs: &Catalogs) -> Files {
        Files {
            catalogs: catalogs.clone(),
            moon: OnceLock::new(),
            milky_way: OnceLock::new(),
            gazetteer: OnceLock::new(),
        }
    }

    fn gazetteer(&self) -> Result<&Gazetteer, PlanError> {
        once(&self.gazetteer, || Ok(Gazetteer::parse(&self.catalogs.places_text()?)?))
    }
}

impl SkyData for Files {
    fn moon_maps(&self) -> Result<MoonMaps, CatalogError> {
        once(&self.moon, || self.catalogs.moon_maps()).cloned()
    }

    fn milky_way(&self) -> Result<Option<Arc<MilkyWay>>, CatalogError> {
        let map = once(&self.milky_way, || Ok(Arc::new(self.catalogs.milky_way()?)))?;
        Ok(Some(map.clone()))
    }

    fn towns_around(&self, place: &Place) -> Result<Vec<Town>, PlanError> {
        Ok(towns_around(place, self.gazetteer()?.cities()))
    }
}

/// What is made once; what failed is tried again.
fn once<T, E>(cell: &OnceLock<T>, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    if let Some(made) = cell.get() {
        return Ok(made);
    }
    let made = make()?;
    Ok(cell.get_or_init(|| made))
}

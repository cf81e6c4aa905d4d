//! What a frame asks of the catalogues, if it shows it.

use std::sync::Arc;

use crate::catalog::{CatalogError, Catalogs, MilkyWay, MoonMaps};
use crate::light::town_glow::{Town, towns_around};
use crate::place::Place;
use crate::place::gazetteer::Gazetteer;

use super::PlanError;

/// The maps and tables that are read when something in the picture needs them.
pub trait SkyData {
    /// The maps of the Moon.
    fn moon_maps(&self) -> Result<MoonMaps, CatalogError>;
    /// The light of the stars that are in no catalogue; none if it is not to be drawn.
    fn milky_way(&self) -> Result<Option<Arc<MilkyWay>>, CatalogError> {
        Ok(None)
    }
    /// The towns around a place whose glow is seen.
    fn towns_around(&self, _: &Place) -> Result<Vec<Town>, PlanError> {
        Ok(Vec::new())
    }
}

impl SkyData for Catalogs {
    fn moon_maps(&self) -> Result<MoonMaps, CatalogError> {
        Catalogs::moon_maps(self)
    }

    fn milky_way(&self) -> Result<Option<Arc<MilkyWay>>, CatalogError> {
        Ok(Some(Arc::new(Catalogs::milky_way(self)?)))
    }

    fn towns_around(&self, place: &Place) -> Result<Vec<Town>, PlanError> {
        let gazetteer = Gazetteer::parse(&self.places_text()?)?;
        Ok(towns_around(place, gazetteer.cities()))
    }
}

/// The Moon alone, from whoever has her maps.
impl<F: Fn() -> Result<MoonMaps, CatalogError>> SkyData for F {
    fn moon_maps(&self) -> Result<MoonMaps, CatalogError> {
        self()
    }
}

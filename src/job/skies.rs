//! Where a job gets its sky and its light from.

use crate::air::Atmosphere;
use crate::catalog::Catalogs;
use crate::ephemeris::Ephemeris;
use crate::light::earth_shadow::Danjon;
use crate::light::night::Night;
use crate::place::Place;
use crate::plan::FramePlan;
use crate::plan::lay::{Kept, lay_in};
use crate::plan::ledger::Ledger;
use crate::scene::{Scene, Setting};
use crate::sky::SkyState;
use crate::store::Store;
use crate::studio::Studio;
use crate::time::Instant;
use crate::units::Angle;

use super::{JobError, Subject};

/// Makes skies and plans, frame by frame; what frames in a row share it may keep.
pub trait Skies {
    /// The sky of a scene, given what its values mean.
    fn night(&mut self, scene: &Scene, setting: &Setting) -> Result<Night, JobError>;
    /// What is to be drawn of it.
    fn lay(&mut self, subject: &Subject) -> Result<(FramePlan, Ledger), JobError>;
}

/// Skies that are read from the catalogues each time; light and air are kept from frame to frame.
pub struct FromCatalogs<'a> {
    catalogs: &'a Catalogs,
    kept: Kept,
}

impl FromCatalogs<'_> {
    /// Nothing kept yet, but for air in a store.
    pub fn new(catalogs: &Catalogs, store: Store) -> FromCatalogs<'_> {
        FromCatalogs { catalogs, kept: Kept::new(store) }
    }
}

impl Skies for FromCatalogs<'_> {
    fn night(&mut self, scene: &Scene, setting: &Setting) -> Result<Night, JobError> {
        let Setting { instant, place, tolerance, .. } = setting;
        let Scene { air, moon, .. } = scene;
        night(instant, place, *tolerance, air, moon.danjon, self.catalogs)
    }

    fn lay(&mut self, subject: &Subject) -> Result<(FramePlan, Ledger), JobError> {
        let Subject { scene, setting, night } = subject;
        Ok(lay_in(setting, &scene.layers, night, self.catalogs, &mut self.kept)?)
    }
}

/// Skies that share whatever frames in a row have in common.
impl Skies for Studio {
    fn night(&mut self, scene: &Scene, setting: &Setting) -> Result<Night, JobError> {
        Ok(Studio::night(self, scene, setting)?)
    }

    fn lay(&mut self, subject: &Subject) -> Result<(FramePlan, Ledger), JobError> {
        Ok(Studio::lay(self, subject.scene, subject.setting, subject.night)?)
    }
}

/// The sky with everything in it.
pub fn night(
    instant: &Instant,
    place: &Place,
    tolerance: Angle,
    air: &Atmosphere,
    danjon: Danjon,
    catalogs: &Catalogs,
) -> Result<Night, JobError> {
    let ephemeris = Ephemeris::load(catalogs, tolerance)?;
    let sky = SkyState::at(&ephemeris, instant, place, tolerance)?;
    let features = catalogs.moon_features()?;
    let night = Night::with_danjon(sky, catalogs.stars()?, air, danjon);
    Ok(night.with_moon_features(features))
}

//! Lays a night on the plane of the picture.

use rayon::prelude::*;

use crate::camera::Camera;
use crate::ephemeris::Body;
use crate::frame::{Apparent, Dir};
use crate::light::moon::Reflectance;
use crate::light::night::{Kind, LitObject, Night, StarSearch};
use crate::scene::{Layers, Setting};
use crate::sky::BodyState;
use crate::store::Store;
use crate::units::{Angle, Illuminance, Magnitude, Xyzv};

use super::body::SeenBody;
use super::classic::ClassicLight;
use super::corona::{self, Corona};
use super::dark_sky::{self, KeptDarkSky};
use super::data::SkyData;
use super::globe::KeptGlobe;
use super::ledger::Ledger;
use super::milky_way::MilkyWayPlan;
use super::skylight::{self, KeptAir, Origin, Shines};
use super::{DARK_AZIMUTHS, FramePlan, PlanError, SKY_SHAPE, SkyPlan, Splat};

/// Reach of a splat from its centre, pixels.
const SPLAT_REACH_PX: f64 = 2.0;
/// Share of a splat's light in its brightest pixel, at most: the square of the B-spline's 2/3.
const SPLAT_PEAK: f64 = 4.0 / 9.0;
/// A point whose brightest pixel is fainter than this share of the sky behind it is not drawn.
const DROWNED: f64 = 1e-4;

/// How much higher than its yellow light the blue light of a limb may stand.
const BLUE_RIM: Angle = Angle::from_arcmin(1.0);

const OUT_OF_VIEW: &str = "out of view";
const BELOW_HORIZON: &str = "below the horizon";
pub(super) const SWITCHED_OFF: &str = "switched off";
const NOT_IN_MODEL: &str = "not in the classic model of the sky";
const TOO_FAINT: &str = "fainter than the magnitude limit";
const OUTSHONE: &str = "under 1/10 000 of the sky behind it";
const HIDDEN: &str = "behind the Moon or the Sun";

const BEHIND_JUPITER: &str = "behind Jupiter";
/// Its disc is about as bright as theirs.
const BEFORE_JUPITER: &str = "before the disc of Jupiter";

/// What frames in a row share: the solved air, the globe of the Moon.
pub struct Kept {
    pub air: KeptAir,
    pub globe: KeptGlobe,
    pub dark_sky: KeptDarkSky,
}

impl Kept {
    /// Nothing yet, but for air in a store.
    pub fn new(store: Store) -> Kept {
        Kept {
            air: KeptAir::new(store),
            globe: KeptGlobe::default(),
            dark_sky: KeptDarkSky::default(),
        }
    }

    /// Forgets the tables of the sky: the next frame makes its own, as the first one does. The air that
    /// was solved is kept.
    pub fn forget_tables(&mut self) {
        self.air.forget_skies();
        self.dark_sky.forget_tables();
    }

    /// How many tables of the sky are kept: a number that does not grow with the frames.
    pub fn tables(&self) -> usize {
        self.air.skies() + self.dark_sky.tables()
    }
}

/// Makes the plan of a frame and the ledger of what is in it. The Moon's maps are asked for only if
/// the Moon shows a disc, that of the Milky Way only if it is dark.
pub fn lay(
    setting: &Setting,
    layers: &Layers,
    night: &Night,
    data: &impl SkyData,
) -> Result<(FramePlan, Ledger), PlanError> {
    lay_in(setting, layers, night, data, &mut Kept::new(Store::NONE))
}

/// The same with what a frame before made, which is used again where it is the same.
pub fn lay_in(
    setting: &Setting,
    layers: &Layers,
    night: &Night,
    data: &impl SkyData,
    kept: &mut Kept,
) -> Result<(FramePlan, Ledger), PlanError> {
    let camera = setting.camera;
    let mut ledger = Ledger::default();
    let classic = setting.sky.map(|sky| ClassicLight::of(&sky, night)).transpose()?;
    let mut sky = lay_sky(layers, night, classic.as_ref(), &mut ledger, &mut kept.air)?;
    let milky_way = match classic {
        Some(_) => {
            ledger.skip("dark sky", NOT_IN_MODEL);
            None
        }
        None => lay_dark_sky(setting, layers, night, data, &mut ledger, kept, &mut sky)?,
    };
    let sky = without_ground(sky, layers);
    let mut plan = FramePlan { camera, sky, milky_way, discs: Vec::new(), splats: Vec::new() };

    for object in &night.objects {
        if object.kind == Kind::Body(Body::Sun) && layers.sun {
            match corona::seen(object, night, &camera) {
                Ok(Corona::Disc(disc)) => {
                    ledger.draw("corona");
                    plan.discs.push(*disc);
                }
                Ok(Corona::Point(light)) => {
                    match lay_point(&camera, object.apparent, light, &mut plan.splats) {
                        true => ledger.draw("corona"),
                        false => ledger.skip("corona", OUT_OF_VIEW),
                    }
                }
                Err(reason) => ledger.skip("corona", reason),
            }
        }
        let (layer, wanted) = layer_of(object, layers);
        let visible = visible(object, layers, wanted, night, &plan);
        if let Err(reason) = visible {
            ledger.skip(layer, reason);
            continue;
        }
        let drawn = match state_of(object, night) {
            Some(state) => {
                let seen = SeenBody::of(state, object, night, &camera);
                let twinkle = twinkle(setting, night, object);
                let law = setting.reflectance;
                lay_body(&seen, data, law, twinkle, &mut plan, &mut kept.globe)?
            }
            None => {
                let light = object.ground * twinkle(setting, night, object);
                match lay_point(&camera, object.apparent, light, &mut plan.splats) {
                    true => Laid::Points,
                    false => Laid::Not(OUT_OF_VIEW),
                }
            }
        };
        match drawn {
            Laid::Points => ledger.draw(layer),
            Laid::Disc { bands } => {
                ledger.draw(layer);
                let plural = if bands == 1 { "" } else { "s" };
                ledger.tell(layer, format!("{}: {bands} band{plural}", night.label(object)));
            }
            Laid::Not(reason) => ledger.skip(layer, reason),
        }
    }
    lay_stars(setting, layers, night, &mut plan, &mut ledger);
    Ok((plan, ledger))
}

/// Lays the stars that can be told from the sky, and accounts for all others.
fn lay_stars(
    setting: &Setting,
    layers: &Layers,
    night: &Night,
    plan: &mut FramePlan,
    ledger: &mut Ledger,
) {
    if !layers.stars {
        return ledger.skip_many("stars", SWITCHED_OFF, night.stars.len());
    }
    let camera = plan.camera;
    let behind = Behind::of(plan);
    let found = night.search_stars(&StarSearch {
        centre: Dir::from_azimuth_altitude(camera.azimuth, camera.altitude),
        radius: camera.reach(SPLAT_REACH_PX),
        limit: layers.magnitude_limit.map(Magnitude),
        drowned: behind.drowning_magnitude(),
    });
    for (reason, many) in [
        (TOO_FAINT, found.fainter_than_limit),
        (BELOW_HORIZON, found.below_horizon),
        (OUT_OF_VIEW, found.out_of_view),
        (OUTSHONE, found.drowned),
    ] {
        ledger.skip_many("stars", reason, many);
    }
    let view_from_apparent = camera.view_from_apparent();
    let so_far = &*plan;
    let seen: Vec<Result<([f64; 2], Xyzv), &'static str>> = found
        .stars
        .par_iter()
        .with_min_len(256)
        .map(|star| {
            if star.apparent.altitude() < night.horizon {
                return Err(BELOW_HORIZON);
            }
            let pixel = camera.pixel_from_view(view_from_apparent * star.apparent);
            let first = repeats_of(&camera, pixel).next();
            let (Some(pixel), Some(first)) = (pixel, first) else { return Err(OUT_OF_VIEW) };
            stands_out(star, first, night, so_far, &behind)?;
            Ok((pixel, star.ground * twinkle(setting, night, star)))
        })
        .collect();
    let mut drawn = 0;
    plan.splats.reserve(seen.len());
    for star in seen {
        match star {
            Ok((pixel, illuminance)) => {
                let repeats = repeats_of(&camera, Some(pixel));
                plan.splats.extend(repeats.map(|centre_px| Splat::star(centre_px, illuminance)));
                drawn += 1;
            }
            Err(reason) => ledger.skip("stars", reason),
        }
    }
    ledger.draw_many("stars", drawn);
}

/// What the turbulence of the air makes of the light of a point; 1 if nobody asked for it.
fn twinkle(setting: &Setting, night: &Night, object: &LitObject) -> f64 {
    let Some(scintillation) = setting.scintillation else { return 1.0 };
    let (id, radius) = match object.kind {
        Kind::Body(Body::Sun | Body::Moon) => return 1.0,
        Kind::Star(index) => (u64::from(night.stars[index].hr), Angle::ZERO),
        Kind::Body(body) => {
            let state = night.sky.body(body);
            ((1 << 32) + body as u64, state.map_or(Angle::ZERO, |state| state.angular_radius))
        }
        Kind::Satellite(moon) => ((1 << 33) + moon as u64, Angle::ZERO),
    };
    let key = scintillation.key(&night.sky.instant);
    let (altitude, height_m) = (object.apparent.altitude(), night.sky.place.height_m);
    scintillation.factor_of_disc(id, key, altitude, height_m, radius * 2.0)
}

/// What stands behind stars, from some pixels of the picture.
struct Behind {
    /// The least light of a pixel of the sky, lux.
    darkest_lx: f64,
    /// The brightest of them, cd/m2.
    brightest_cd_m2: f64,
}

impl Behind {
    const UNKNOWN: Behind = Behind { darkest_lx: 0.0, brightest_cd_m2: f64::INFINITY };

    fn of(plan: &FramePlan) -> Behind {
        /// Pixels that are looked at, along each edge of the picture.
        const ACROSS: u32 = 9;
        let camera = &plan.camera;
        let apparent_from_view = camera.view_from_apparent().inverse();
        let at = |step: u32, edge: u32| f64::from(step) / f64::from(ACROSS - 1) * f64::from(edge);
        let mut behind = Behind { darkest_lx: f64::INFINITY, brightest_cd_m2: 0.0 };
        for step in 0..ACROSS * ACROSS {
            let (x, y) = (step % ACROSS, step / ACROSS);
            let pixel = [at(x, camera.width_px), at(y, camera.height_px)];
            let Some(view) = camera.view_from_pixel(pixel) else { continue };
            let apparent = apparent_from_view * view;
            if apparent.altitude() < plan.sky.horizon {
                continue;
            }
            let cd_m2 = plan.sky.luminance(apparent).y;
            behind.brightest_cd_m2 = behind.brightest_cd_m2.max(cd_m2);
            let lx = cd_m2 * camera.pixel_solid_angle_sr(pixel);
            behind.darkest_lx = behind.darkest_lx.min(lx);
        }
        behind
    }

    /// A magnitude beyond which every star drowns, wherever it stands. None where there is no light.
    fn drowning_magnitude(&self) -> Option<Magnitude> {
        /// How much darker than the darkest of the pixels any other may be.
        const DARKER: f64 = 4.0;
        let faintest_lx = DROWNED * self.darkest_lx / (SPLAT_PEAK * DARKER);
        let is_lit = faintest_lx > 0.0 && faintest_lx.is_finite();
        is_lit.then(|| Illuminance::from_lx(faintest_lx).magnitude())
    }

    /// Whether a point whose brightest pixel has this luminance, cd/m2, stands out wherever it is.
    fn is_outshone_by(&self, peak_cd_m2: f64) -> bool {
        /// How much brighter than the brightest of the pixels any other may be.
        const BRIGHTER: f64 = 1000.0;
        peak_cd_m2 > DROWNED * BRIGHTER * self.brightest_cd_m2
    }
}

fn lay_sky(
    layers: &Layers,
    night: &Night,
    classic: Option<&ClassicLight>,
    ledger: &mut Ledger,
    kept: &mut KeptAir,
) -> Result<SkyPlan, PlanError> {
    let switched = |on: bool, shines: Shines| if on { shines } else { Shines::No(SWITCHED_OFF) };
    let sun = switched(layers.skylight, skylight::sun_shines(night));
    let known = |shines: Shines| classic.map_or(shines, |_| Shines::No(NOT_IN_MODEL));
    let moon = switched(layers.skylight, known(skylight::moon_shines(night)));
    let ground = switched(layers.ground, Shines::Yes);
    for (layer, shines) in [("sunlit air", sun), ("moonlit air", moon), ("ground", ground)] {
        match shines {
            Shines::Yes => ledger.draw(layer),
            Shines::No(reason) => ledger.skip(layer, reason),
        }
    }
    let sky = match classic.filter(|_| layers.skylight) {
        Some(light) => light.plan(night),
        None => {
            let (sun, moon) = (sun == Shines::Yes, moon == Shines::Yes);
            let (sky, origin) = skylight::sky_plan(night, sun, moon, kept)?;
            if let Some(origin) = origin {
                let from = match origin {
                    Origin::FrameBefore => "the frame before",
                    Origin::Store => "the store",
                    Origin::SolvedNow => "solving it now",
                };
                let layer = if sun { "sunlit air" } else { "moonlit air" };
                ledger.tell(layer, format!("tables of the air: from {from}"));
            }
            sky
        }
    };
    Ok(sky)
}

/// Lays the dark sky if it is not outshone; the Milky Way before it is apart.
fn lay_dark_sky(
    setting: &Setting,
    layers: &Layers,
    night: &Night,
    data: &dyn SkyData,
    ledger: &mut Ledger,
    kept: &mut Kept,
    sky: &mut SkyPlan,
) -> Result<Option<MilkyWayPlan>, PlanError> {
    let lights = dark_sky::lights(&setting.night, layers, night, data, &mut kept.dark_sky, ledger)?;
    if lights.are_out() {
        return Ok(None);
    }
    Ok(kept.dark_sky.lay(night, lights, sky)?)
}

/// A sky with its ground black where there is to be none.
fn without_ground(mut sky: SkyPlan, layers: &Layers) -> SkyPlan {
    if !layers.ground {
        sky.dark[SKY_SHAPE.above * DARK_AZIMUTHS..].fill(Xyzv::BLACK);
        for source in [&mut sky.sun, &mut sky.sun_left, &mut sky.moon].into_iter().flatten() {
            source.view.blacken_ground();
        }
    }
    sky
}

fn layer_of(object: &LitObject, layers: &Layers) -> (&'static str, bool) {
    match object.kind {
        Kind::Body(Body::Sun) => ("Sun", layers.sun),
        Kind::Body(Body::Moon) => ("Moon", layers.moon),
        Kind::Body(_) => ("planets", layers.planets),
        Kind::Satellite(_) => ("moons of Jupiter", layers.planets),
        Kind::Star(_) => ("stars", layers.stars),
    }
}

fn state_of<'n>(object: &LitObject, night: &'n Night) -> Option<&'n BodyState> {
    match object.kind {
        Kind::Body(body) => night.sky.body(body),
        Kind::Satellite(_) | Kind::Star(_) => None,
    }
}

/// Whether an object can be seen at all, and if not, why.
fn visible(
    object: &LitObject,
    layers: &Layers,
    wanted: bool,
    night: &Night,
    plan: &FramePlan,
) -> Result<(), &'static str> {
    if !wanted {
        return Err(SWITCHED_OFF);
    }
    let is_lamp = matches!(object.kind, Kind::Body(Body::Sun | Body::Moon));
    if !is_lamp && layers.magnitude_limit.is_some_and(|limit| object.magnitude.0 > limit) {
        return Err(TOO_FAINT);
    }
    // A disc may show its upper limb when its centre has set.
    let radius = state_of(object, night).map_or(Angle::ZERO, |state| state.angular_radius);
    let margin = if radius > Angle::ZERO { radius + BLUE_RIM } else { Angle::ZERO };
    if object.apparent.altitude() + margin < night.horizon {
        return Err(BELOW_HORIZON);
    }
    if is_lamp {
        return Ok(());
    }
    let camera = &plan.camera;
    let pixel = match object.kind {
        // The disc of a planet may reach into the picture when its centre does not.
        Kind::Body(_) => camera.pixel_from_apparent(object.apparent),
        Kind::Satellite(_) | Kind::Star(_) => repeats_px(camera, object.apparent).next(),
    };
    let Some(pixel) = pixel else { return Err(OUT_OF_VIEW) };
    stands_out(object, pixel, night, plan, &Behind::UNKNOWN)?;
    match object.kind {
        Kind::Satellite(moon) => match night.sky.satellite(moon) {
            Some(state) if state.share_seen <= 0.0 => Err(BEHIND_JUPITER),
            Some(state) if state.is_before_jupiter => Err(BEFORE_JUPITER),
            _ => Ok(()),
        },
        _ => Ok(()),
    }
}

/// Whether a point of light at a pixel can be told from the sky, and nothing stands before it.
fn stands_out(
    object: &LitObject,
    pixel: [f64; 2],
    night: &Night,
    plan: &FramePlan,
    behind: &Behind,
) -> Result<(), &'static str> {
    let peak = object.ground.y * SPLAT_PEAK / plan.camera.pixel_solid_angle_sr(pixel);
    if !behind.is_outshone_by(peak) && peak < DROWNED * plan.sky.luminance(object.apparent).y {
        return Err(OUTSHONE);
    }
    if night.sky.sun.covers(object.dir) || night.sky.moon.state.covers(object.dir) {
        return Err(HIDDEN);
    }
    Ok(())
}

/// What became of a body on the picture.
enum Laid {
    Points,
    /// As a disc in so many bands of colour.
    Disc {
        bands: usize,
    },
    Not(&'static str),
}

/// Brighter than any star or planet, lux: magnitude -6.5.
const BRIGHTEST_STAR_LX: f64 = 1e-3;

/// Draws a body as a disc, or as points of light, which twinkle, when it is small.
fn lay_body(
    seen: &SeenBody,
    data: &impl SkyData,
    law: Reflectance,
    twinkle: f64,
    plan: &mut FramePlan,
    kept: &mut KeptGlobe,
) -> Result<Laid, PlanError> {
    let points = |any: bool| if any { Laid::Points } else { Laid::Not(OUT_OF_VIEW) };
    let first = plan.splats.len();
    let is_of_disc = seen.light().y > BRIGHTEST_STAR_LX;
    let marked = |splats: &mut [Splat]| {
        splats.iter_mut().for_each(|splat| splat.is_of_disc = is_of_disc);
    };
    if seen.is_point() {
        if seen.is_below_horizon() {
            return Ok(Laid::Not(BELOW_HORIZON));
        }
        let light = seen.light() * twinkle;
        let any = lay_point(&plan.camera, seen.apparent(), light, &mut plan.splats);
        marked(&mut plan.splats[first..]);
        return Ok(points(any));
    }
    let Some(bounds_px) = seen.bounds_px() else { return Ok(Laid::Not(OUT_OF_VIEW)) };
    let Some(air) = seen.air() else { return Ok(Laid::Not(BELOW_HORIZON)) };
    let surface = if seen.is_moon() { Some(data.moon_maps()?) } else { None };
    if seen.is_small() {
        let shape = seen.shape(surface.as_ref());
        let mut any = false;
        for (apparent, light) in seen.points(&shape, &air) {
            any |= lay_point(&plan.camera, apparent, light * twinkle, &mut plan.splats);
        }
        marked(&mut plan.splats[first..]);
        return Ok(points(any));
    }
    let shape = seen.shape(None);
    let globe = surface.as_ref().and_then(|surface| seen.globe(surface, law, kept));
    plan.discs.push(seen.disc(shape, globe, &air, bounds_px));
    Ok(Laid::Disc { bands: air.bands() })
}

/// Adds a point of light, again where the picture repeats. False when it is out of view.
fn lay_point(
    camera: &Camera,
    apparent: Dir<Apparent>,
    illuminance: Xyzv,
    splats: &mut Vec<Splat>,
) -> bool {
    let before = splats.len();
    let repeats = repeats_px(camera, apparent);
    splats.extend(repeats.map(|centre_px| Splat::star(centre_px, illuminance)));
    splats.len() > before
}

/// Where a point of light touches the picture: once, or again a full turn of a panorama away.
fn repeats_px(camera: &Camera, apparent: Dir<Apparent>) -> impl Iterator<Item = [f64; 2]> {
    repeats_of(camera, camera.pixel_from_apparent(apparent))
}

/// The same of the pixel that the plane of the picture has for it.
fn repeats_of(camera: &Camera, pixel: Option<[f64; 2]>) -> impl Iterator<Item = [f64; 2]> {
    let inside =
        |v: f64, edge: u32| (-SPLAT_REACH_PX..f64::from(edge) + SPLAT_REACH_PX).contains(&v);
    let (width_px, height_px) = (camera.width_px, camera.height_px);
    let turn_px = camera.wrap_px();
    pixel.into_iter().flat_map(move |[x, y]| {
        let turns = [Some(0.0), turn_px.map(|turn| -turn), turn_px];
        turns
            .into_iter()
            .flatten()
            .map(move |shift| [x + shift, y])
            .filter(move |&[x, y]| inside(x, width_px) && inside(y, height_px))
    })
}

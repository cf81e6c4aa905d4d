//! The dark sky: what glows where no Sun and no Moon shine, in absolute units, as seen through the
//! air.
//!
//! Six lights ([`Component`]): airglow in layers of the high air ([`super::airglow`]); zodiacal light
//! ([`super::zodiacal`]); the stars that no catalogue here holds, and those of the catalogue that are
//! not drawn ([`super::starlight`]); starlight that the dust of the Galaxy sends back; what is left of
//! far galaxies; and towns ([`super::town_glow`]).
//!
//! What comes from outside reaches an eye in two ways. Straight: the light of a direction times what
//! the air lets through. And scattered, all orders, by the air and the ground
//! ([`crate::air::scattering::above`]): clear air gives back most of what it takes, so that a sky of
//! light loses far less than a star. For the latter a sky is a sum of harmonics to degree 8 about the
//! zenith (airglow a function of zenith distance and height). Stars that are drawn one by one still
//! scatter.
//!
//! Each light has one spectrum while it is scattered: zodiacal light the middle of its reddening,
//! stars the middle of their colours. Zodiacal light nearer than [`SCATTERED_FROM`] to the Sun is as
//! bright as there while it is scattered: nearer light is the Sun's twilight.
//!
//! How: the scattered light is solved at eight wavelengths and rebuilt between them; what comes
//! straight is reckoned at all.
//!
//! Accuracy: for given light outside, luminance errs by 1 % in clear air, 3 % in thick haze; the
//! lights themselves err by more, each as its module says, airglow by a factor of 2 from night to
//! night. Bending of rays is not in van Rhijn's factor: 1 % at the horizon.

use std::borrow::Cow;
use std::fmt;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::airglow::GlowLayer;
use super::spectrum::{LEN, Spectrum, Transmittance, wavelength_nm};
use super::starlight::{self, StarGlow, Starlight};
use super::town_glow::TownGlow;
use super::zodiacal;
use crate::air::Atmosphere;
use crate::air::extinction::SightLines;
use crate::air::refraction::Refraction;
use crate::air::scattering::above::{
    DiffuseField, DiffuseQuality, DiffuseTables, DiffuseView, SkyHarmonics, glowing_layer,
};
use crate::air::scattering::{
    Matrix, SKY_NODES_NM, ScatteringError, horizon, reconstruction_matrix,
};
use crate::frame::{Apparent, Dir, Galactic, Helioecliptic, Horizon, Rot};
use crate::units::{Angle, Xyzv};

/// Nearer to the Sun zodiacal light is scattered as if it were this far from it.
pub const SCATTERED_FROM: Angle = Angle::from_deg(20.0);
/// Redness of the zodiacal light that is scattered: that of an elongation of 60 degrees.
const SCATTERED_REDNESS: f64 = 0.5;
/// Colour of the starlight that is scattered, and of the stars of the catalogue that are not drawn:
/// half-way between the bluest and the reddest mix.
const MIDDLE_COLOUR: f64 = 0.5;

/// Galactic latitude of the dust whose light is scattered.
const MIDDLE_LATITUDE: Angle = Angle::from_deg(20.0);

/// A light of the dark sky.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Component {
    Airglow,
    Zodiacal,
    /// Stars that are not drawn one by one.
    Starlight,
    /// Starlight that the dust of the Galaxy sends back.
    Galactic,
    /// Galaxies far away.
    Cosmic,
    Town,
}

impl Component {
    pub const ALL: [Component; 6] = [
        Component::Airglow,
        Component::Zodiacal,
        Component::Starlight,
        Component::Galactic,
        Component::Cosmic,
        Component::Town,
    ];

    /// As it is written for programs.
    pub fn name(self) -> &'static str {
        match self {
            Component::Airglow => "airglow",
            Component::Zodiacal => "zodiacal",
            Component::Starlight => "starlight",
            Component::Galactic => "galactic",
            Component::Cosmic => "cosmic",
            Component::Town => "town",
        }
    }
}

/// What some air makes of light from outside, for an observer of a height. Takes some 60 ms; cheap to
/// clone.
#[derive(Clone)]
pub struct NightAir {
    inner: Arc<Inner>,
}

struct Inner {
    air: Atmosphere,
    height_m: f64,
    eye_km: f64,
    tables: DiffuseTables,
    sight: SightLines,
    horizon: Angle,
    refraction: Refraction,
    /// Of the table that was asked for first: pictures ask for the same again.
    grid: OnceLock<Grid>,
    /// The field of a sky of 1 all round.
    even: OnceLock<DiffuseField>,
    /// Fields of glowing layers by their height, km; the last that were asked for.
    layers: Mutex<Vec<(f64, DiffuseField)>>,
}

impl fmt::Debug for NightAir {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "NightAir({:?}, {} m)", self.inner.air, self.inner.height_m)
    }
}

impl NightAir {
    /// Degrees to 10, orders to 8.
    const QUALITY: DiffuseQuality =
        DiffuseQuality { order: SkyHarmonics::DEGREE, ..DiffuseQuality::AXIAL };

    /// Height above sea level in metres.
    pub fn solve(air: &Atmosphere, height_m: f64) -> Result<NightAir, ScatteringError> {
        let tables = DiffuseTables::solve(air, height_m, &SKY_NODES_NM, NightAir::QUALITY)?;
        let sight = SightLines::over(air, height_m);
        let inner = Inner {
            air: air.clone(),
            height_m,
            eye_km: air.eye_km(height_m),
            tables,
            horizon: horizon(air, height_m, air.eye_km(height_m)),
            sight,
            refraction: air.refraction_at(height_m),
            grid: OnceLock::new(),
            even: OnceLock::new(),
            layers: Mutex::default(),
        };
        Ok(NightAir { inner: Arc::new(inner) })
    }

    /// Whether this is the air around an observer of a height above sea level, metres.
    pub fn is_of(&self, air: &Atmosphere, height_m: f64) -> bool {
        self.inner.air == *air && self.inner.height_m == height_m
    }

    /// Whether both have the same tables.
    pub fn is_same(&self, other: &NightAir) -> bool {
        Arc::ptr_eq(&self.inner, &other.inner)
    }

    /// Apparent elevation at which the ground begins.
    pub fn horizon(&self) -> Angle {
        self.inner.horizon
    }

    /// What part of the light of an apparent altitude arrives; nothing from below the horizon.
    fn transmittance(&self, altitude: Angle) -> Option<Transmittance> {
        (altitude >= self.horizon()).then(|| self.inner.sight.transmittance(altitude))
    }

    /// The ray of a view.
    fn view(&self, altitude: Angle) -> DiffuseView {
        self.inner.tables.view(self.inner.eye_km, altitude)
    }

    /// A table of these altitudes and azimuths.
    fn grid(&self, altitudes: &[Angle], azimuths: &[Angle]) -> Cow<'_, Grid> {
        let known = self.inner.grid.get_or_init(|| self.new_grid(altitudes, azimuths));
        match known.is_of(altitudes, azimuths) {
            true => Cow::Borrowed(known),
            false => Cow::Owned(self.new_grid(altitudes, azimuths)),
        }
    }

    fn new_grid(&self, altitudes: &[Angle], azimuths: &[Angle]) -> Grid {
        let row = |&altitude: &Angle| Row {
            altitude,
            view: self.view(altitude),
            clear: self.transmittance(altitude).map(|passed| {
                let from =
                    |&azimuth: &Angle| self.outside(Dir::from_azimuth_altitude(azimuth, altitude));
                Clear::of(passed, azimuths.iter().map(from).collect())
            }),
        };
        Grid {
            rows: altitudes.par_iter().map(row).collect(),
            turns: azimuths.iter().map(|azimuth| turn(*azimuth)).collect(),
            azimuths: azimuths.to_vec(),
        }
    }

    /// The field of a sky of 1 all round.
    fn lit_evenly(&self) -> DiffuseField {
        let make = || self.inner.tables.lit_from(|_, _| 1.0);
        self.inner.even.get_or_init(make).clone()
    }

    /// The field of a layer of a height that glows with 1 in the zenith.
    fn lit_by_layer(&self, height_km: f64) -> DiffuseField {
        /// More than any night has.
        const MOST: usize = 8;
        // Whoever failed while it was locked left it whole.
        let lock = || self.inner.layers.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if let Some((_, field)) = lock().iter().find(|(height, _)| *height == height_km) {
            return field.clone();
        }
        let field = self.inner.tables.lit_from(glowing_layer(height_km));
        let mut layers = lock();
        layers.truncate(MOST - 1);
        layers.insert(0, (height_km, field.clone()));
        field
    }

    /// What arrives of starlight of 1 S10(V) at an apparent altitude, of the bluest and of the reddest
    /// mix of stars, and of what dust sends back, cd/m2; nothing from below the horizon.
    pub fn of_one_s10(&self, altitude: Angle) -> Option<OneS10> {
        self.transmittance(altitude).map(one_s10)
    }

    /// Where light comes from that is seen in an apparent direction.
    pub fn outside(&self, dir: Dir<Apparent>) -> Dir<Horizon> {
        self.inner.refraction.horizon_from_apparent(dir)
    }
}

/// What shines on a dark night. What is left out does not shine.
#[derive(Debug, Clone, Default)]
pub struct NightLights {
    pub airglow: Vec<GlowLayer>,
    /// Axes of the zodiacal light.
    pub helioecliptic_from_horizon: Option<Rot<Helioecliptic, Horizon>>,
    /// The Milky Way, and its axes.
    pub starlight: Option<(Starlight, Rot<Galactic, Horizon>)>,
    /// All stars of the catalogue: they scatter, drawn or not.
    pub catalogue: Option<Arc<StarGlow>>,
    /// Those of them that are not drawn one by one.
    pub undrawn: Option<Arc<StarGlow>>,
    pub towns: Option<TownGlow>,
}

impl NightLights {
    /// Whether nothing shines.
    pub fn are_out(&self) -> bool {
        let is_starlit = self.starlight.is_some() || self.undrawn.is_some();
        let natural = is_starlit || self.helioecliptic_from_horizon.is_some();
        !natural && self.airglow.is_empty() && self.towns.is_none()
    }
}

/// Lights of one shape while they are scattered.
#[derive(Debug, Clone)]
struct Scattered {
    field: DiffuseField,
    /// What the field is a factor of.
    spectra: Vec<(Component, Spectrum)>,
    /// All these lights together.
    spectrum: Spectrum,
}

impl Scattered {
    fn new(field: DiffuseField, spectra: Vec<(Component, Spectrum)>) -> Scattered {
        let spectrum = spectra.iter().map(|(_, spectrum)| *spectrum).sum();
        Scattered { field, spectra, spectrum }
    }
}

/// What some air makes of every node of a table, whatever shines.
#[derive(Clone)]
struct Grid {
    azimuths: Vec<Angle>,
    turns: Vec<Turn>,
    rows: Vec<Row>,
}

impl Grid {
    fn is_of(&self, altitudes: &[Angle], azimuths: &[Angle]) -> bool {
        self.azimuths == azimuths
            && self.rows.len() == altitudes.len()
            && self.rows.iter().zip(altitudes).all(|(row, altitude)| row.altitude == *altitude)
    }
}

/// An altitude of a table.
#[derive(Clone)]
struct Row {
    altitude: Angle,
    view: DiffuseView,
    /// Nothing from below the horizon.
    clear: Option<Clear>,
}

/// What the air lets through at an altitude.
#[derive(Clone)]
struct Clear {
    passed: Transmittance,
    /// Where light comes from, by azimuth.
    outside: Vec<Dir<Horizon>>,
    cosmic: Xyzv,
    /// Of a radiance of 1 at 500 nm, reddest and least red.
    zodiacal: [Xyzv; 2],
    /// Of 1 S10(V) of the catalogue's stars, and of dust that sends all of it back.
    star: Xyzv,
    dust: Xyzv,
}

impl Clear {
    fn of(passed: Transmittance, outside: Vec<Dir<Horizon>>) -> Clear {
        Clear {
            outside,
            cosmic: (starlight::cosmic() * passed).xyzv(),
            zodiacal: zodiacal::spectra().map(|spectrum| (spectrum * passed).xyzv()),
            star: (star_spectrum(MIDDLE_COLOUR) * passed).xyzv(),
            dust: one_s10(passed).dust,
            passed,
        }
    }
}

/// The dark sky over one observer.
#[derive(Debug, Clone)]
pub struct DarkSky {
    air: NightAir,
    lights: NightLights,
    scattered: Vec<Scattered>,
}

impl DarkSky {
    /// The lights through the air. Takes some 10 ms.
    pub fn new(air: &NightAir, lights: NightLights) -> DarkSky {
        let tables = &air.inner.tables;
        let mut scattered = Vec::new();
        for layer in &lights.airglow {
            let field = air.lit_by_layer(layer.height_km);
            scattered.push(Scattered::new(field, vec![(Component::Airglow, layer.zenith)]));
        }
        if let Some(axes) = lights.helioecliptic_from_horizon {
            let sky = SkyHarmonics::from_fn(|elevation, azimuth| {
                let dir = axes * Dir::from_azimuth_altitude(azimuth, elevation);
                let dir = not_nearer(dir, SCATTERED_FROM);
                zodiacal::radiance_500(dir.longitude(), dir.latitude())
            });
            let spectrum = zodiacal_spectrum(1.0, SCATTERED_REDNESS);
            let light = vec![(Component::Zodiacal, spectrum)];
            scattered.push(Scattered::new(tables.lit_by(&sky), light));
        }
        if let Some((stars, axes)) = &lights.starlight {
            let mut of_galaxy = stars.harmonics().clone();
            if let Some(catalogue) = &lights.catalogue {
                let stars = catalogue.harmonics();
                for l in 0..=SkyHarmonics::DEGREE {
                    (0..=l).for_each(|m| of_galaxy.add(l, m, stars.coefficients(l, m)));
                }
            }
            let sky = SkyHarmonics::from_fn(|elevation, azimuth| {
                let dir = *axes * Dir::from_azimuth_altitude(azimuth, elevation);
                of_galaxy.radiance(dir.latitude(), dir.longitude())
            });
            let field = tables.lit_by(&sky);
            let of_dust = starlight::diffuse_galactic(1.0, MIDDLE_LATITUDE);
            let of_stars = star_spectrum(MIDDLE_COLOUR);
            let lights = vec![(Component::Galactic, of_dust), (Component::Starlight, of_stars)];
            scattered.push(Scattered::new(field, lights));
            let light = vec![(Component::Cosmic, starlight::cosmic())];
            scattered.push(Scattered::new(air.lit_evenly(), light));
        }
        DarkSky { air: air.clone(), lights, scattered }
    }

    /// The same sky with other stars of the catalogue that are not drawn one by one; what is scattered
    /// does not change.
    pub fn with_undrawn(&self, undrawn: Option<Arc<StarGlow>>) -> DarkSky {
        let mut sky = self.clone();
        sky.lights.undrawn = undrawn;
        sky
    }

    /// All stars of the catalogue, if they shine.
    pub fn catalogue(&self) -> Option<Arc<StarGlow>> {
        self.lights.catalogue.clone()
    }

    /// What comes straight from outside in a direction, without the air; airglow as seen from the
    /// height of the eye.
    fn outside(&self, dir: Dir<Horizon>) -> impl Iterator<Item = (Component, Spectrum)> {
        let lights = &self.lights;
        let airglow = lights.airglow.iter().map(move |layer| {
            let shape = glowing_layer(layer.height_km)(self.air.inner.eye_km, dir.altitude().sin());
            (Component::Airglow, layer.zenith * shape)
        });
        let zodiacal = lights.helioecliptic_from_horizon.map(|axes| {
            let dir = axes * dir;
            (Component::Zodiacal, zodiacal::radiance(dir.longitude(), dir.latitude()))
        });
        let stars = lights.starlight.iter().flat_map(move |(stars, axes)| {
            let dir = *axes * dir;
            let s10 = stars.s10(dir);
            let s10_of = |glow: &Option<Arc<StarGlow>>| glow.as_ref().map_or(0.0, |g| g.s10(dir));
            let undrawn = s10_of(&lights.undrawn);
            let all_stars = s10 + s10_of(&lights.catalogue);
            let dust = starlight::diffuse_galactic(all_stars, dir.latitude());
            [
                (Component::Starlight, stars.spectrum(dir)),
                (Component::Starlight, star_spectrum(MIDDLE_COLOUR) * undrawn),
                (Component::Galactic, dust),
                (Component::Cosmic, starlight::cosmic()),
            ]
        });
        airglow.chain(zodiacal).chain(stars)
    }

    /// Spectral radiance of each light in an apparent direction, W m-2 sr-1 nm-1; below the horizon
    /// that of the ground, seen through the air.
    pub fn radiance(&self, dir: Dir<Apparent>) -> Vec<(Component, Spectrum)> {
        let mut sums = Component::ALL.map(|component| (component, Spectrum::DARK));
        let mut add = |component: Component, light: Spectrum| {
            sums[component as usize].1 += light;
        };
        let altitude = dir.altitude();
        let view = self.air.view(altitude);
        for light in &self.scattered {
            let mut nodes = [0.0; SKY_NODES_NM.len()];
            light.field.radiance(&view, dir.azimuth(), &mut nodes);
            for (component, spectrum) in &light.spectra {
                add(*component, at_nodes(spectrum, &nodes));
            }
        }
        if let Some(passed) = self.air.transmittance(altitude) {
            let outside = self.outside(self.air.outside(dir));
            outside.for_each(|(component, light)| add(component, light * passed));
        }
        if let Some(towns) = &self.lights.towns {
            add(Component::Town, self.town_radiance(towns, dir));
        }
        sums.to_vec()
    }

    /// That of towns; their ground is lit by their own glow.
    fn town_radiance(&self, towns: &TownGlow, dir: Dir<Apparent>) -> Spectrum {
        if dir.altitude() >= self.air.horizon() {
            return towns.radiance(dir.altitude(), dir.azimuth());
        }
        let on_ground = towns.radiance(Angle::from_deg(90.0), Angle::ZERO);
        on_ground.scaled_to_photopic(self.town_ground().y)
    }

    /// The Milky Way and its axes, if it shines.
    pub fn starlight(&self) -> Option<&(Starlight, Rot<Galactic, Horizon>)> {
        self.lights.starlight.as_ref()
    }

    /// The air that all is seen through.
    pub fn air(&self) -> &NightAir {
        &self.air
    }

    /// Luminance at a grid of apparent altitudes and of azimuths, rows first, cd/m2: all that
    /// [`DarkSky::radiance`] tells, but for what comes straight from stars that are in no catalogue
    /// and from the dust that they light, whose detail is finer.
    pub fn luminances(&self, altitudes: &[Angle], azimuths: &[Angle]) -> Vec<Xyzv> {
        let towns = self.lights.towns.as_ref().map(|towns| towns.luminances(altitudes, azimuths));
        let town_ground = self.town_ground();
        let grid = self.air.grid(altitudes, azimuths);
        let of_row = |(row, at): (usize, &Row)| {
            let around = self.scattered_around(&at.view);
            let even = at.clear.as_ref().map(|clear| (clear, self.even(at.altitude, clear)));
            let mut lights = Vec::with_capacity(azimuths.len());
            for (column, turn) in grid.turns.iter().enumerate() {
                let mut light = around.at(turn);
                if let Some((clear, even)) = even {
                    light += self.straight(clear, even, clear.outside[column]);
                }
                if let Some(towns) = &towns {
                    light += match even {
                        Some(_) => towns[row * azimuths.len() + column],
                        None => town_ground,
                    };
                }
                lights.push(light);
            }
            lights
        };
        let rows: Vec<Vec<Xyzv>> = grid.rows.par_iter().enumerate().map(of_row).collect();
        rows.concat()
    }

    /// Luminance of the ground in the light of towns, cd/m2.
    fn town_ground(&self) -> Xyzv {
        let albedo = self.air.inner.air.ground.albedo;
        let on_ground = self.lights.towns.as_ref().map(TownGlow::ground_illuminance);
        on_ground.unwrap_or(Xyzv::BLACK) * (albedo / std::f64::consts::PI)
    }

    /// The scattered light of an altitude, in all azimuths.
    fn scattered_around(&self, view: &DiffuseView) -> Waves {
        let mut waves = vec![[Xyzv::BLACK; 2]; SkyHarmonics::DEGREE + 1];
        for light in &self.scattered {
            let of_light = light.field.around(view).waves();
            let Some([mean, _]) = of_light.first() else { continue };
            let weights = weights(&light.spectrum, mean);
            for (sum, wave) in waves.iter_mut().zip(&of_light) {
                for (sum, wave) in sum.iter_mut().zip(wave) {
                    for (factor, weight) in wave.iter().zip(&weights) {
                        *sum += *weight * *factor;
                    }
                }
            }
        }
        Waves(waves)
    }

    /// What shines straight at an altitude in all azimuths alike, through the air.
    fn even(&self, altitude: Angle, clear: &Clear) -> Xyzv {
        let dir = self.air.outside(Dir::from_azimuth_altitude(Angle::ZERO, altitude));
        let even = self.lights.airglow.iter().map(|layer| {
            let shape = glowing_layer(layer.height_km)(self.air.inner.eye_km, dir.altitude().sin());
            (layer.zenith * clear.passed).xyzv() * shape
        });
        let mut even: Xyzv = even.sum();
        if self.lights.starlight.is_some() {
            even += clear.cosmic;
        }
        even
    }

    /// All that shines straight from a direction outside, of which some is even.
    fn straight(&self, clear: &Clear, even: Xyzv, outside: Dir<Horizon>) -> Xyzv {
        let mut light = even;
        if let Some(axes) = self.lights.helioecliptic_from_horizon {
            let dir = axes * outside;
            let (longitude, latitude) = (dir.longitude(), dir.latitude());
            let level = zodiacal::radiance_500(longitude, latitude);
            let redness = zodiacal::redness(zodiacal::elongation(longitude, latitude));
            let [reddest, least] = clear.zodiacal;
            light += (reddest * redness + least * (1.0 - redness)) * level;
        }
        if let Some((_, axes)) = &self.lights.starlight {
            let dir = *axes * outside;
            if let Some(glow) = &self.lights.undrawn {
                light += clear.star * glow.s10(dir);
            }
            if let Some(stars) = &self.lights.catalogue {
                light += clear.dust * (stars.s10(dir) * starlight::diffuse_share(dir.latitude()));
            }
        }
        light
    }
}

/// What arrives of starlight of 1 S10(V), cd/m2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OneS10 {
    /// Of the bluest and the reddest mix of stars.
    pub blue: Xyzv,
    pub red: Xyzv,
    /// Of dust that sends back all of it; see [`starlight::diffuse_share`].
    pub dust: Xyzv,
}

fn one_s10(passed: Transmittance) -> OneS10 {
    let [blue, red] = starlight::spectra_of_s10().map(|spectrum| (spectrum * passed).xyzv());
    let in_plane = starlight::diffuse_galactic(1.0, Angle::ZERO) * passed;
    let dust = in_plane.xyzv() * starlight::diffuse_share(Angle::ZERO).recip();
    OneS10 { blue, red, dust }
}

/// Cosines and sines of an azimuth, by order.
type Turn = [(f64, f64); SkyHarmonics::DEGREE + 1];

fn turn(azimuth: Angle) -> Turn {
    std::array::from_fn(|order| {
        let (sine, cosine) = (azimuth * order as f64).sin_cos();
        (cosine, sine)
    })
}

/// Light that changes with the azimuth as a few waves do.
struct Waves(Vec<[Xyzv; 2]>);

impl Waves {
    fn at(&self, turn: &Turn) -> Xyzv {
        let wave =
            |([cos, sin], (cosine, sine)): (&[Xyzv; 2], &(f64, f64))| *cos * *cosine + *sin * *sine;
        self.0.iter().zip(turn).map(wave).sum()
    }
}

/// A direction, moved away from the Sun's longitude and the ecliptic to this angle, if it is nearer.
fn not_nearer(dir: Dir<Helioecliptic>, least: Angle) -> Dir<Helioecliptic> {
    let vector = dir.vector();
    if vector.x <= least.cos() {
        return dir;
    }
    let away = DVec3::new(0.0, vector.y, vector.z).normalize_or(DVec3::Y);
    Dir::from_vector(DVec3::X * least.cos() + away * least.sin())
}

/// Zodiacal light by its radiance at 500 nm.
fn zodiacal_spectrum(at_500_nm: f64, redness: f64) -> Spectrum {
    let [reddest, least] = zodiacal::spectra();
    (*reddest * redness + *least * (1.0 - redness)) * at_500_nm
}

/// Starlight of 1 S10(V) by its colour, 0 to 1.
fn star_spectrum(colour: f64) -> Spectrum {
    let [blue, red] = starlight::spectra_of_s10();
    blue * (1.0 - colour) + red * colour
}

/// From the wavelengths that are solved for to all.
static SPECTRUM_FROM_NODES: LazyLock<Matrix> = LazyLock::new(|| {
    let wavelengths: Vec<f64> = (0..LEN).map(wavelength_nm).collect();
    reconstruction_matrix(&SKY_NODES_NM, &wavelengths)
});

/// A spectrum times a factor that is known at the wavelengths that are solved for.
pub fn at_nodes(spectrum: &Spectrum, factors: &[f64]) -> Spectrum {
    let factors = SPECTRUM_FROM_NODES.spectrum(factors);
    spectrum.by_node(|node| factors[node])
}

/// What X, Y, Z and V make of each of these factors, for factors near some mean: a spectrum is rebuilt
/// from logarithms, and light changes little in colour around the horizon.
fn weights(spectrum: &Spectrum, mean: &[f64]) -> Vec<Xyzv> {
    let light = at_nodes(spectrum, mean);
    let weight = |(solved, mean): (usize, &f64)| {
        if *mean <= 0.0 {
            return Xyzv::BLACK;
        }
        light.by_node(|node| SPECTRUM_FROM_NODES.row(node)[solved] / mean).xyzv()
    };
    mean.iter().enumerate().map(weight).collect()
}

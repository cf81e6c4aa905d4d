//! Spectra of stars, from their spectral types and colours.
//!
//! Theory: the shape is that of the nearest type in the library of Pickles 1998 (*PASP* 110, 863), lines,
//! bands and all: dwarfs, subgiants, giants and supergiants have their own sequences, and M giants go by
//! their subtype, for their B-V stands still at 1.5 while titanium oxide takes their green light. The shape
//! is then reddened by the dust law of Cardelli, Clayton & Mathis 1989 (*ApJ* 345, 245, eqs. 3a and 3b,
//! R = 3.1, recalled), or made bluer by its inverse, until its B-V is that of the catalogue. Of most stars
//! that is a correction of some hundredths (the type is rounded, the star not quite like its kind), of
//! supergiants the real dust. V sets the level: the star gives the illuminance of its magnitude.
//!
//! B-V is synthetic, by the passbands of Bessell 1990 (*PASP* 102, 1181, table 2, recalled; they weigh
//! energy), with its zero where the Sun of Wehrli has 0.653 (Ramírez et al. 2012, *ApJ* 752, 5, recalled).
//!
//! Choices: stars of class S take the giant M5, whose bands are alike. Carbon stars, Wolf-Rayet stars and
//! what has no class at all are [black bodies](crate::light::star_colour) reddened to their B-V, which of
//! carbon stars is far redder than their temperature: blue light is taken away as their bands of C3 and CN
//! take it, without the bands themselves.
//!
//! Accuracy: the synthetic B-V is that of the catalogue within 0.001 mag (tested over the whole
//! catalogue; three carbon stars redder than E(B-V) = 3 can make a black body are brought to that).
//! Illuminance follows V with no term of colour, as everywhere in this program. Integrated over both bands,
//! O and B stars would give the eye 4 % less than V says and K5 dwarfs 6 % more (zero at the Sun; M giants
//! -2 to 5 %).

use std::sync::LazyLock;

use crate::catalog::{Luminosity, Star, spectral_class};
use crate::light::photometry::Band;
use crate::light::point_light::PointLight;
use crate::light::spectrum::{LEN, Spectrum, wavelength_nm};
use crate::light::star_colour::{B_V_RANGE, black_body};
use crate::light::sun;

const PICKLES: &str = include_str!("../../catalogs/spectra/pickles.csv");

/// Of the Sun.
const SUN_B_V: f64 = 0.653;

/// Total to selective extinction of the dust.
const DUST_R: f64 = 3.1;
/// Reddenings E(B-V) at which tables are kept: from the first by steps.
pub(super) const FIRST_REDDENING: f64 = -1.0;
pub(super) const REDDENING_STEP: f64 = 0.5;
pub(super) const REDDENINGS: usize = 9;

/// Colours of the black bodies among the templates.
const BLACK_BODIES: usize = 9;
/// Class S is drawn as this.
const CLASS_S: (f64, Luminosity) = (65.0, Luminosity::Giant);

/// The shape of the spectrum of a star: a template and how much it is reddened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StarShape {
    pub(super) template: usize,
    /// E(B-V) of the dust before the template, mag; below zero where the star is bluer.
    pub(super) reddening: f64,
}

impl StarShape {
    /// Of a star as the catalogue has it.
    pub fn of(star: &Star) -> StarShape {
        let class = spectral_class(&star.spectral_type);
        let s = || star.spectral_type.starts_with('S').then_some(CLASS_S);
        match class.or_else(s) {
            Some((class, luminosity)) => {
                StarShape::reddened_to(TEMPLATES.nearest(class, luminosity), star.b_v)
            }
            None => StarShape::of_black_body(star.b_v),
        }
    }

    /// Of a black body that has a B-V; beyond [`B_V_RANGE`] a reddened one.
    pub fn of_black_body(b_v: f64) -> StarShape {
        let b_v = if b_v.is_nan() { 0.65 } else { b_v };
        let (low, high) = (*B_V_RANGE.start(), *B_V_RANGE.end());
        let place = (b_v.clamp(low, high) - low) / (high - low) * (BLACK_BODIES - 1) as f64;
        let first = TEMPLATES.shapes.len() - BLACK_BODIES;
        StarShape::reddened_to(first + place.round() as usize, b_v)
    }

    fn reddened_to(template: usize, b_v: f64) -> StarShape {
        StarShape { template, reddening: TEMPLATES.reddening_of(template, b_v) }
    }

    /// The spectrum, in no particular unit.
    pub fn spectrum(&self) -> Spectrum {
        let shape = TEMPLATES.shapes[self.template];
        shape.weighted(|nm| dust(nm, self.reddening))
    }

    /// How many templates there are.
    pub(super) fn templates() -> usize {
        TEMPLATES.shapes.len()
    }

    /// A template at a reddening of the tables, with the illuminance of one lux.
    pub(super) fn tabulated(template: usize, reddening: usize) -> Spectrum {
        let reddening = reddening_of_node(reddening);
        StarShape { template, reddening }.spectrum().scaled_to_photopic(1.0)
    }
}

/// The light of a star of the catalogue outside the air.
pub fn star(star: &Star) -> PointLight {
    PointLight::from_shape(StarShape::of(star).spectrum(), star.magnitude)
}

/// B-V of a spectrum per unit of wavelength, mag, on the scale of Johnson.
pub fn b_v(spectrum: &Spectrum) -> f64 {
    let zero = *ZERO;
    raw_b_v(spectrum) - zero
}

/// What [`raw_b_v`] is for B-V = 0.
static ZERO: LazyLock<f64> = LazyLock::new(|| raw_b_v(&sun::irradiance_1au()) - SUN_B_V);

fn raw_b_v(spectrum: &Spectrum) -> f64 {
    -2.5 * (Band::B.mean(spectrum) / Band::V.mean(spectrum)).log10()
}

/// The share of light that passes dust of E(B-V), mag; more than 1 where E(B-V) is below zero.
fn dust(nm: f64, reddening: f64) -> f64 {
    10f64.powf(-0.4 * reddening * dust_magnitudes(nm))
}

/// Extinction by dust of E(B-V) = 1, mag: Cardelli et al. 1989, eqs. 3a and 3b, 303 to 909 nm.
fn dust_magnitudes(nm: f64) -> f64 {
    const A: [f64; 8] =
        [1.0, 0.176_99, -0.504_47, -0.024_27, 0.720_85, 0.019_79, -0.775_30, 0.329_99];
    const B: [f64; 8] =
        [0.0, 1.413_38, 2.283_05, 1.072_33, -5.384_34, -0.622_51, 5.302_60, -2.090_02];
    let y = 1000.0 / nm - 1.82;
    let polynomial = |c: &[f64; 8]| c.iter().rev().fold(0.0, |sum, c| sum * y + c);
    DUST_R * polynomial(&A) + polynomial(&B)
}

fn reddening_of_node(node: usize) -> f64 {
    FIRST_REDDENING + REDDENING_STEP * node as f64
}

/// The library: sequences by luminosity, then black bodies.
struct Templates {
    shapes: Vec<Spectrum>,
    /// Classes as numbers, rising, and their shapes: dwarfs, subgiants, giants, supergiants.
    sequences: [Vec<(f64, usize)>; 4],
    /// B-V of each shape at the reddenings of the tables.
    colours: Vec<[f64; REDDENINGS]>,
}

static TEMPLATES: LazyLock<Templates> = LazyLock::new(Templates::read);

impl Templates {
    fn read() -> Templates {
        let mut shapes = Vec::new();
        let mut sequences: [Vec<(f64, usize)>; 4] = Default::default();
        for line in PICKLES.lines().skip(1) {
            let Some((name, values)) = line.split_once(',') else { continue };
            let Some((class, luminosity)) = class_of_template(name) else { continue };
            let mut values = values.split(',').map(|cell| cell.parse().unwrap_or(0.0));
            let mut nodes = [0.0; LEN];
            nodes.fill_with(|| values.next().unwrap_or(0.0));
            sequences[luminosity as usize].push((class, shapes.len()));
            shapes.push(Spectrum::from_nodes(nodes));
        }
        // The coolest subgiants and supergiants of the library end before the giants do.
        for short in [Luminosity::Subgiant, Luminosity::Supergiant] {
            let last = sequences[short as usize].last().map_or(0.0, |&(class, _)| class);
            let giants = sequences[Luminosity::Giant as usize].clone();
            sequences[short as usize].extend(giants.iter().filter(|(class, _)| *class > last));
        }
        let (low, high) = (B_V_RANGE.start(), B_V_RANGE.end());
        shapes.extend((0..BLACK_BODIES).map(|k| {
            let share = k as f64 / (BLACK_BODIES - 1) as f64;
            black_body(low + (high - low) * share).scaled_to_photopic(1.0)
        }));
        let dusts: [[f64; LEN]; REDDENINGS] = std::array::from_fn(|node| {
            std::array::from_fn(|nm| dust(wavelength_nm(nm), reddening_of_node(node)))
        });
        let colour = |shape: &Spectrum, dust: &[f64; LEN]| {
            b_v(&Spectrum::from_nodes(std::array::from_fn(|k| shape.values()[k] * dust[k])))
        };
        let colours = shapes
            .iter()
            .map(|shape| std::array::from_fn(|node| colour(shape, &dusts[node])))
            .collect();
        Templates { shapes, sequences, colours }
    }

    fn nearest(&self, class: f64, luminosity: Luminosity) -> usize {
        let distance = |(known, _): &&(f64, usize)| (known - class).abs();
        let sequence = &self.sequences[luminosity as usize];
        let nearest = sequence.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.map_or(0, |&(_, template)| template)
    }

    /// The reddening that gives a template a B-V, brought to what the tables hold.
    fn reddening_of(&self, template: usize, b_v: f64) -> f64 {
        let colours = &self.colours[template];
        // Not a number leaves the template as it is.
        if b_v.is_nan() {
            return 0.0;
        }
        let b_v = b_v.clamp(colours[0], colours[REDDENINGS - 1]);
        let middle = colours.partition_point(|&c| c < b_v).clamp(1, REDDENINGS - 2);
        let middle = if middle > 1 && b_v - colours[middle - 1] < colours[middle] - b_v {
            middle - 1
        } else {
            middle
        };
        // Where the parabola through three nodes has the colour, in steps from the middle one.
        let [before, here, after] = [middle - 1, middle, middle + 1].map(|node| colours[node]);
        let (slope, bend) = (0.5 * (after - before), 0.5 * (after + before) - here);
        let root = (slope * slope + 4.0 * bend * (b_v - here)).max(0.0).sqrt();
        let steps = 2.0 * (b_v - here) / (slope + root);
        reddening_of_node(middle) + REDDENING_STEP * steps.clamp(-1.0, 1.0)
    }
}

/// `B57V` is a dwarf between B5 and B7. Bright giants but the last have a place in no sequence: the
/// catalogue's count as giants.
fn class_of_template(name: &str) -> Option<(f64, Luminosity)> {
    let decade = "OBAFGKM".find(name.chars().next()?)? as f64;
    let digits: Vec<f64> = name.chars().filter_map(|c| c.to_digit(10)).map(f64::from).collect();
    let class = 10.0 * decade + digits.iter().sum::<f64>() / digits.len().max(1) as f64;
    let luminosity = match name.trim_start_matches(|c: char| !matches!(c, 'I' | 'V')) {
        "V" => Luminosity::Dwarf,
        "IV" => Luminosity::Subgiant,
        "III" => Luminosity::Giant,
        "I" => Luminosity::Supergiant,
        _ => return None,
    };
    Some((class, luminosity))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::Catalogs;
    use crate::units::Magnitude;

    fn stars() -> Vec<Star> {
        Catalogs::locate(None).unwrap().stars().unwrap()
    }

    #[test]
    fn the_library_is_whole() {
        let count = |l: Luminosity| TEMPLATES.sequences[l as usize].len();
        // Bright giants have no sequence of their own; all other types have a place.
        let named = PICKLES.lines().skip(1).filter_map(|l| class_of_template(l.split(',').next()?));
        assert_eq!(named.count() + BLACK_BODIES, TEMPLATES.shapes.len());
        assert_eq!(count(Luminosity::Dwarf), 35);
        assert!(count(Luminosity::Giant) >= 29, "{}", count(Luminosity::Giant));
        for sequence in &TEMPLATES.sequences {
            assert!(sequence.windows(2).all(|pair| pair[0].0 < pair[1].0), "{sequence:?}");
        }
        for shape in &TEMPLATES.shapes[..TEMPLATES.shapes.len() - BLACK_BODIES] {
            assert!(shape.values().iter().all(|&value| value > 0.0));
            // Bands of cool giants are steep there.
            assert!((0.5..2.0).contains(&shape.at_nm(555.0)), "{}", shape.at_nm(555.0));
        }
    }

    #[test]
    fn dust_has_its_ratio_of_extinctions() {
        // A(V) at 1/1.82 um is R by definition; A(B) at 440 nm is 1 mag more.
        assert!((dust_magnitudes(1000.0 / 1.82) - 3.1).abs() < 1e-12);
        assert!((dust_magnitudes(440.0) - dust_magnitudes(548.0) - 1.0).abs() < 0.03);
        assert!((360..=830).all(|nm| dust_magnitudes(f64::from(nm)) > 1.0));
    }

    #[test]
    fn templates_have_the_colours_of_their_types() {
        // Intrinsic colours, Schmidt-Kaler 1982; the library has 0.05 about them.
        for (written, expected) in [
            ("A0V", 0.0),
            ("F5V", 0.44),
            ("G2V", 0.63),
            ("K5V", 1.15),
            ("K0III", 1.0),
            ("B5III", -0.17),
            ("G2I", 0.87),
        ] {
            let (class, luminosity) = spectral_class(written).unwrap();
            let shape = TEMPLATES.shapes[TEMPLATES.nearest(class, luminosity)];
            assert!((b_v(&shape) - expected).abs() < 0.07, "{written}: {}", b_v(&shape));
        }
    }

    #[test]
    fn every_star_has_the_b_v_of_the_catalogue() {
        let (mut worst, mut black, mut small, mut beyond) = (0.0f64, 0, 0, 0);
        let stars = stars();
        for star in &stars {
            let shape = StarShape::of(star);
            black += usize::from(shape.template >= TEMPLATES.shapes.len() - BLACK_BODIES);
            small += usize::from(shape.reddening.abs() < 0.2);
            let off = (b_v(&shape.spectrum()) - star.b_v).abs();
            let last = reddening_of_node(REDDENINGS - 1);
            match FIRST_REDDENING < shape.reddening && shape.reddening < last {
                true => worst = worst.max(off),
                false => {
                    println!("HR {} {} {} off {off}", star.hr, star.spectral_type, star.b_v);
                    beyond += 1;
                }
            }
        }
        println!("worst {worst}, {black} black bodies, {small} within 0.2 of their type");
        // HR 423, R Leporis (HR 1607, B-V 5.74) and HR 7220 are beyond the tables.
        assert!(worst < 0.001 && beyond == 3, "{worst} {beyond}");
        assert!(black < 60, "{black}");
        assert!(small > 7500, "{small}");
    }

    #[test]
    fn bands_of_titanium_oxide_show_in_betelgeuse_and_not_in_arcturus() {
        let stars = stars();
        let of = |name: &str| {
            let star = stars.iter().find(|star| star.name.as_deref() == Some(name)).unwrap();
            StarShape::of(star).spectrum()
        };
        // The band head at 616 nm and the clear stretch before it.
        let band = |s: Spectrum| s.at_nm(620.0) / s.at_nm(610.0);
        assert!(band(of("Betelgeuse")) < 0.92, "{}", band(of("Betelgeuse")));
        assert!(band(of("Arcturus")) > 0.95, "{}", band(of("Arcturus")));
    }

    #[test]
    fn odd_stars_have_some_spectrum() {
        let mut star = stars().swap_remove(0);
        for (written, b_v) in [
            ("", 0.5),
            ("C5II", 3.5),
            ("S5,8", 1.9),
            ("WC8", -0.3),
            ("M9III", f64::NAN),
            ("B", 99.0),
        ] {
            star.spectral_type = written.to_owned();
            star.b_v = b_v;
            let light = super::star(&star);
            assert!(light.xyzv.y > 0.0 && light.xyzv.y.is_finite(), "{written} {b_v}");
        }
        let Magnitude(v) = star.magnitude;
        assert!((super::star(&star).magnitude.0 - v).abs() < 1e-9);
    }
}

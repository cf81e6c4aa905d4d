//! The sky's own light in a direction, in words.

use crate::frame::{Apparent, Dir};
use crate::light::dark_sky::Component;
use crate::light::night::Night;
use crate::light::photometry::Band;
use crate::plan::brightness::{SkyBrightness, Source};
use crate::units::Angle;

use super::facts::{Axes, Facts};

/// A pointer is so good.
const POINTED: Angle = Angle::from_arcmin(1.0);
/// Shares smaller than this are left out, percent.
const LEAST_PERCENT: f64 = 0.05;

/// A direction in all frames, and the constellation there.
pub fn direction(dir: Dir<Apparent>, pixel: Angle, night: &Night) -> Facts {
    let mut facts = Facts::default();
    let axes = Axes::of(night);
    let geometric = night.refraction.horizon_from_apparent(dir);
    if dir.altitude() < night.horizon {
        facts.add("Here is", "the ground");
    }
    let error = if pixel < POINTED { pixel } else { POINTED };
    axes.add_directions(&mut facts, geometric, dir, error);
    facts.add("Constellation", axes.constellation(geometric));
    facts
}

/// How bright it is, and what makes it so.
pub fn light(seen: &SkyBrightness) -> Facts {
    let mut facts = Facts::default();
    let light = seen.luminance();
    let mag =
        |mag: Option<f64>| mag.map_or("no light".to_owned(), |mag| format!("{mag:.2} mag/arcsec²"));
    facts.add("Brightness in V", mag(seen.mag_per_arcsec2(Band::V)));
    facts.add("Sky Quality Meter", mag(seen.sqm_mag_per_arcsec2()));
    facts.add("Luminance", luminance(light.y));
    let faintest = seen.limiting_magnitude().0;
    if faintest.is_finite() {
        facts.add("Faintest star seen", super::written::number(faintest, 0.1));
    }
    let mut parts: Vec<(Source, f64)> =
        seen.sources.iter().map(|(source, part)| (*source, part.xyzv().y)).collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    for (source, part) in parts {
        let percent = 100.0 * part / light.y;
        if percent >= LEAST_PERCENT {
            facts.add(title(source), format!("{percent:.1} %"));
        }
    }
    facts
}

/// Three digits, and no more zeros than can be read.
fn luminance(cd_m2: f64) -> String {
    match cd_m2 {
        y if y <= 0.0 => "0 cd/m²".to_owned(),
        y if y >= 1.0 => format!("{} cd/m²", super::written::relative(y, 1e-2)),
        y if y >= 1e-3 => format!("{} mcd/m²", super::written::relative(y * 1e3, 1e-2)),
        y => format!("{} µcd/m²", super::written::relative(y * 1e6, 1e-2)),
    }
}

/// What each source is called where people read it.
fn title(source: Source) -> &'static str {
    match source {
        Source::Sun => "Sunlight in the air",
        Source::Moon => "Moonlight in the air",
        Source::Dark(Component::Airglow) => "Airglow",
        Source::Dark(Component::Zodiacal) => "Zodiacal light",
        Source::Dark(Component::Starlight) => "Starlight of the Milky Way",
        Source::Dark(Component::Galactic) => "Dust of the Galaxy",
        Source::Dark(Component::Cosmic) => "Far galaxies",
        Source::Dark(Component::Town) => "Towns",
    }
}

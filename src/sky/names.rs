//! Names of stars as people type them: `α CMa`, `alpha cma`, `alp Canis Majoris`, `9 CMa`.

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::catalog::ConstellationId;
use crate::place::gazetteer::folded;

/// Greek letters: sign, name, and what astronomers shorten it to.
const GREEK: [(char, &str, &[&str]); 24] = [
    ('α', "alpha", &["alp", "alf"]),
    ('β', "beta", &["bet"]),
    ('γ', "gamma", &["gam"]),
    ('δ', "delta", &["del"]),
    ('ε', "epsilon", &["eps"]),
    ('ζ', "zeta", &["zet"]),
    ('η', "eta", &[]),
    ('θ', "theta", &["the", "tet"]),
    ('ι', "iota", &["iot"]),
    ('κ', "kappa", &["kap"]),
    ('λ', "lambda", &["lam"]),
    ('μ', "mu", &[]),
    ('ν', "nu", &[]),
    ('ξ', "xi", &["ksi"]),
    ('ο', "omicron", &["omi"]),
    ('π', "pi", &[]),
    ('ρ', "rho", &[]),
    ('σ', "sigma", &["sig"]),
    ('τ', "tau", &[]),
    ('υ', "upsilon", &["ups"]),
    ('φ', "phi", &[]),
    ('χ', "chi", &[]),
    ('ψ', "psi", &[]),
    ('ω', "omega", &["ome"]),
];
const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// Words of small plain letters and figures: no accents, no punctuation, Greek letters by name,
/// superscripts as figures.
pub fn plain(text: &str) -> String {
    let mut written = String::with_capacity(text.len());
    for c in text.chars() {
        let small = match c {
            // A sign of its own in old fonts, and the other sigma and theta and phi.
            'µ' => 'μ',
            'ς' => 'σ',
            'ϑ' => 'θ',
            'ϕ' => 'φ',
            c => c.to_lowercase().next().unwrap_or(c),
        };
        if let Some((_, name, _)) = GREEK.iter().find(|(sign, ..)| *sign == small) {
            written.push_str(name);
            // The constellation may follow without a blank: `αCMa`.
            written.push(' ');
        } else if let Some(figure) = SUPERSCRIPTS.iter().position(|&sign| sign == c) {
            // It belongs to the letter before it.
            written.truncate(written.trim_end().len());
            written.push_str(&figure.to_string());
            written.push(' ');
        } else {
            written.push(c);
        }
    }
    folded(&written)
}

/// A designation after Bayer or Flamsteed.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Designation {
    /// Greek letter by name, or the number of Flamsteed.
    pub sign: String,
    /// What tells apart stars of one letter: the 2 of `α² Cen`.
    pub index: Option<u8>,
    pub constellation: ConstellationId,
}

/// The beginning of designations.
#[derive(Debug, Clone, PartialEq)]
pub struct Beginning {
    pub sign: String,
    pub index: Option<u8>,
    /// The constellations that may follow.
    pub constellations: Vec<ConstellationId>,
}

/// Constellations by what they are called in designations, [plain]: three letters, Latin name, genitive.
static BY_NAME: LazyLock<HashMap<String, ConstellationId>> = LazyLock::new(|| {
    let mut by_name = HashMap::new();
    for id in ConstellationId::all() {
        let one = id.get();
        for name in [one.abbreviation, one.latin, one.genitive] {
            by_name.entry(plain(name)).or_insert(id);
        }
    }
    by_name
});

impl Designation {
    /// Of a text in any usual form; none if it is no designation.
    pub fn parse(text: &str) -> Option<Designation> {
        let (sign, index, rest) = Designation::begin(&plain(text))?;
        let constellation = *BY_NAME.get(&rest)?;
        Some(Designation { sign, index, constellation })
    }

    /// All that a text which is [plain] may be the beginning of.
    pub fn begun(text: &str) -> Option<Beginning> {
        let (sign, index, rest) = Designation::begin(text)?;
        let named = BY_NAME.iter().filter(|(name, _)| name.starts_with(&rest));
        let mut constellations: Vec<ConstellationId> = named.map(|(_, &id)| id).collect();
        constellations.sort_unstable();
        constellations.dedup();
        Some(Beginning { sign, index, constellations })
    }

    /// Sign and index, and what follows them.
    fn begin(text: &str) -> Option<(String, Option<u8>, String)> {
        let (first, mut rest) = text.split_once(' ').unwrap_or((text, ""));
        // `61cyg`, `alpha2`.
        let figures = first.len() - first.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        if figures > 0 {
            let constellation = [&first[figures..], rest].join(" ");
            return Some((first[..figures].to_owned(), None, constellation.trim().to_owned()));
        }
        let letter = first.trim_end_matches(|c: char| c.is_ascii_digit());
        let mut index = first[letter.len()..].trim_start_matches('0').parse().ok();
        let is_it =
            |(_, name, short): &&(char, &str, &[&str])| *name == letter || short.contains(&letter);
        let (_, name, _) = GREEK.iter().find(is_it)?;
        // `alpha 2 cen`
        if index.is_none() {
            let (next, after) = rest.split_once(' ').unwrap_or((rest, ""));
            if let Ok(number) = next.parse() {
                (index, rest) = (Some(number), after);
            }
        }
        Some(((*name).to_owned(), index, rest.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_star_is_written_in_many_ways() {
        let read = |text: &str| {
            let read = Designation::parse(text).unwrap_or_else(|| panic!("{text}"));
            (read.sign, read.index, read.constellation.get().abbreviation)
        };
        for text in ["α CMa", "αCMa", "alpha CMa", "ALP Canis Majoris", "alf canis major", "Α cma"]
        {
            assert_eq!(read(text), ("alpha".into(), None, "CMa"), "{text}");
        }
        for text in ["α² Cen", "alpha2 Cen", "alp02 cen", "alpha 2 centauri", "α²Cen"] {
            assert_eq!(read(text), ("alpha".into(), Some(2), "Cen"), "{text}");
        }
        for text in ["61 Cyg", "61cyg", " 61  Cygni"] {
            assert_eq!(read(text), ("61".into(), None, "Cyg"), "{text}");
        }
        assert_eq!(read("µ Cas").0, "mu");
        assert_eq!(read("eta Bootis").2, "Boo");
        for wrong in ["", "alpha", "alpha xyz", "cma", "61", "sirius"] {
            assert_eq!(Designation::parse(wrong), None, "{wrong}");
        }
        let begun = Designation::begun("bet or").unwrap();
        assert_eq!((begun.sign.as_str(), begun.constellations.len()), ("beta", 1));
        assert_eq!(Designation::begun("bet").unwrap().constellations.len(), 88);
    }

    #[test]
    fn plain_text_has_no_accents_and_no_marks() {
        assert_eq!(plain("Bode's Galaxy"), "bodes galaxy");
        assert_eq!(plain("  BOÖTES "), "bootes");
        assert_eq!(plain("τ⁹ Eri"), "tau9 eri");
    }
}

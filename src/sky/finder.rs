//! One list of everything that has a name, and what people mean when they type a part of one.
//!
//! What is found stands in this order: the whole name, number or designation; names that begin so;
//! designations that begin so (`bet or`); words that begin so; names that hold it somewhere; and, if no
//! name begins so, names that differ by a slip of the fingers. Within each what is better known stands
//! first: brightness tells, with a few planets, constellations and places on the Moon put where
//! people look for them.

use std::collections::HashMap;

use strsim::osa_distance;

use super::names::{Designation, plain};
use super::star_index::StarIndex;
use super::target::Target;
use crate::catalog::{ConstellationId, MoonFeature, Star, messier_objects};
use crate::ephemeris::{Body, Galilean};

/// Something that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    pub target: Target,
    /// What people call it: `Betelgeuse`, `Orion`, `M 31`.
    pub name: String,
    /// What it is, in a word or two: `star`, `planet`, `crater on the Moon`, `spiral galaxy`.
    pub kind: &'static str,
    /// Its other names, with commas between; empty if it has none.
    pub also: String,
}

/// How well a name fits a query: the smaller the better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fit {
    Whole,
    Beginning,
    Designation,
    Word,
    Inside,
    Slip,
}

/// Everything that has a name.
#[derive(Debug, Clone)]
pub struct Finder {
    entries: Vec<Entry>,
    /// Entries of stars by sign and index of their designations.
    designations: HashMap<(String, ConstellationId), Vec<Lettered>>,
}

/// The index of a designation, and whose it is.
type Lettered = (Option<u8>, usize);

#[derive(Debug, Clone)]
struct Entry {
    found: Found,
    names: Vec<Name>,
    /// Like a magnitude: the smaller, the better known.
    fame: f64,
}

/// A name as it is compared.
#[derive(Debug, Clone)]
struct Name {
    /// Plain, without blanks.
    joined: String,
    /// Where its words begin.
    words: Vec<usize>,
    spelling: Spelling,
}

/// What may be wrong or missing in a name that is typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Spelling {
    /// Nothing: a number.
    Exact,
    /// It is not compared as a name: a designation, which is compared by what it means.
    Parsed,
    /// A short form, never better than a name that begins so.
    Short,
    /// What it is called otherwise: whole not better than a name that begins so, in part not better than a
    /// word.
    Aside,
    /// The end, the beginning or a letter.
    Free,
}

impl Name {
    fn new(name: &str, spelling: Spelling) -> Name {
        if spelling == Spelling::Exact && name.is_ascii() {
            let letters = name.chars().filter(char::is_ascii_alphanumeric);
            let joined = letters.map(|c| c.to_ascii_lowercase()).collect();
            return Name { joined, words: Vec::new(), spelling };
        }
        let mut joined = String::new();
        let mut words = Vec::new();
        for word in plain(name).split(' ').filter(|word| !word.is_empty()) {
            words.push(joined.len());
            joined.push_str(word);
        }
        Name { joined, words, spelling }
    }

    fn fit(&self, query: &Name) -> Option<Fit> {
        let asked = query.joined.as_str();
        match self.spelling {
            Spelling::Parsed => return None,
            Spelling::Exact => return (self.joined == asked).then_some(Fit::Whole),
            Spelling::Short => return (self.joined == asked).then_some(Fit::Beginning),
            Spelling::Aside | Spelling::Free => {}
        }
        let fit = self.free_fit(query)?;
        match self.spelling {
            Spelling::Aside if fit == Fit::Whole => Some(Fit::Beginning),
            Spelling::Aside => Some(fit.max(Fit::Word)),
            _ => Some(fit),
        }
    }

    fn free_fit(&self, query: &Name) -> Option<Fit> {
        let asked = query.joined.as_str();
        if self.joined == asked {
            Some(Fit::Whole)
        } else if self.joined.starts_with(asked) {
            Some(Fit::Beginning)
        } else if self.has_word(asked) || query.each_word().all(|word| self.has_word(word)) {
            Some(Fit::Word)
        } else if asked.len() >= SHORTEST_INSIDE && self.joined.contains(asked) {
            Some(Fit::Inside)
        } else {
            None
        }
    }

    fn has_word(&self, begun: &str) -> bool {
        self.words.iter().any(|&at| self.joined[at..].starts_with(begun))
    }

    fn each_word(&self) -> impl Iterator<Item = &str> {
        let ends = self.words.iter().skip(1).copied().chain([self.joined.len()]);
        self.words.iter().zip(ends).map(|(&at, end)| &self.joined[at..end])
    }

    /// How many slips of the fingers lie between, if they are few for its length. What is typed may be
    /// the beginning of the name.
    fn slips(&self, query: &Name) -> Option<usize> {
        let asked = query.joined.as_str();
        let letters = asked.chars().count();
        let most = match letters {
            0..=3 => return None,
            4..=5 => 1,
            _ => 2,
        };
        if !matches!(self.spelling, Spelling::Free | Spelling::Aside) {
            return None;
        }
        let beginning = self.joined.char_indices().nth(letters).map_or(self.joined.len(), |c| c.0);
        let whole = osa_distance(&self.joined, asked);
        let begun = match letters >= SHORTEST_BEGUN {
            true => osa_distance(&self.joined[..beginning], asked),
            false => whole,
        };
        Some(whole.min(begun)).filter(|&slips| slips <= most)
    }
}

/// What else people call some of them; recalled. They are found by these names and not shown by them.
const NICKNAMES: [(&str, &str); 14] = [
    ("Evening Star", "Venus"),
    ("Morning Star", "Venus"),
    ("Red Planet", "Mars"),
    ("North Star", "HR 424"),
    ("Pole Star", "HR 424"),
    ("Dog Star", "HR 2491"),
    ("Demon Star", "HR 936"),
    ("Big Dipper", "Constellation/UMa"),
    ("Plough", "Constellation/UMa"),
    ("Little Dipper", "Constellation/UMi"),
    ("Northern Cross", "Constellation/Cyg"),
    ("Teapot", "Constellation/Sgr"),
    ("Sickle", "Constellation/Leo"),
    ("Great Square", "Constellation/Peg"),
];

/// So many letters at least are looked for inside names.
const SHORTEST_INSIDE: usize = 3;
/// So many letters at least may be the beginning of a name and have a slip in it.
const SHORTEST_BEGUN: usize = 6;

impl Finder {
    /// Of the stars, the places on the Moon, and everything else that has a name.
    pub fn new(stars: &StarIndex, features: &[MoonFeature]) -> Finder {
        let mut finder = Finder { entries: Vec::new(), designations: HashMap::new() };
        finder.add_bodies();
        finder.add_constellations(stars);
        finder.add_messier();
        for feature in features {
            finder.add_feature(feature);
        }
        for star in stars.iter() {
            finder.add_star(star);
        }
        for (nickname, target) in NICKNAMES {
            let mut entries = finder.entries.iter_mut();
            if let Some(entry) = entries.find(|e| e.found.target.to_string() == target) {
                entry.names.push(Name::new(nickname, Spelling::Aside));
            }
        }
        finder
    }

    /// What people may mean by this, the likeliest first, no more than `limit`.
    pub fn search(&self, query: &str, limit: usize) -> Vec<Found> {
        let asked = Name::new(query, Spelling::Free);
        if asked.joined.is_empty() {
            return Vec::new();
        }
        let mut hits: HashMap<usize, Fit> = HashMap::new();
        let mut hit = |entry: usize, fit: Fit| {
            hits.entry(entry).and_modify(|old| *old = (*old).min(fit)).or_insert(fit);
        };
        for (number, entry) in self.entries.iter().enumerate() {
            if let Some(fit) = entry.names.iter().filter_map(|name| name.fit(&asked)).min() {
                hit(number, fit);
            }
        }
        for (number, fit) in self.by_designation(query) {
            hit(number, fit);
        }
        if !hits.values().any(|&fit| fit <= Fit::Designation) {
            let slips = self.entries.iter().enumerate().filter_map(|(number, entry)| {
                Some((number, entry.names.iter().filter_map(|name| name.slips(&asked)).min()?))
            });
            let slips: Vec<(usize, usize)> = slips.collect();
            let fewest = slips.iter().map(|&(_, slips)| slips).min();
            for (number, _) in slips.into_iter().filter(|&(_, slips)| Some(slips) == fewest) {
                hits.entry(number).or_insert(Fit::Slip);
            }
        }
        let mut order: Vec<(Fit, usize)> = hits.into_iter().map(|(n, fit)| (fit, n)).collect();
        order.sort_by(|(fit_a, a), (fit_b, b)| {
            let fame = |n: &usize| self.entries[*n].fame;
            fit_a.cmp(fit_b).then(fame(a).total_cmp(&fame(b))).then(a.cmp(b))
        });
        order.into_iter().take(limit).map(|(_, n)| self.entries[n].found.clone()).collect()
    }

    /// What is known by name of a target, if it is in the list.
    pub fn get(&self, target: &Target) -> Option<&Found> {
        self.entries.iter().map(|entry| &entry.found).find(|found| found.target == *target)
    }

    fn by_designation(&self, query: &str) -> Vec<(usize, Fit)> {
        let whole = Designation::parse(query);
        let Some(begun) = Designation::begun(&plain(query)) else {
            return Vec::new();
        };
        let mut found = Vec::new();
        for constellation in begun.constellations {
            let stars = self.designations.get(&(begun.sign.clone(), constellation));
            let is_whole = whole.as_ref().is_some_and(|whole| whole.constellation == constellation);
            for &(own, number) in stars.into_iter().flatten() {
                if begun.index.is_none() || begun.index == own {
                    found.push((number, if is_whole { Fit::Whole } else { Fit::Designation }));
                }
            }
        }
        found
    }

    fn add(
        &mut self,
        target: Target,
        name: &str,
        kind: &'static str,
        fame: f64,
        also: Vec<(String, Spelling)>,
    ) {
        let mut names = vec![(name.to_owned(), Spelling::Free)];
        names.extend(also);
        self.add_named(target, kind, fame, &names);
    }

    /// The first of the names is what it is shown by.
    fn add_named(
        &mut self,
        target: Target,
        kind: &'static str,
        fame: f64,
        names: &[(String, Spelling)],
    ) {
        let mut shown = names.iter().map(|(name, _)| name.as_str());
        let name = shown.next().unwrap_or_default().to_owned();
        let also = shown.collect::<Vec<&str>>().join(", ");
        let compared = names.iter().filter(|(_, spelling)| *spelling != Spelling::Parsed);
        let names = compared.map(|(name, spelling)| Name::new(name, *spelling)).collect();
        self.entries.push(Entry { found: Found { target, name, kind, also }, names, fame });
    }

    fn add_bodies(&mut self) {
        for body in Body::ALL {
            let (kind, fame) = match body {
                Body::Sun => ("star", -27.0),
                Body::Moon => ("moon", -13.0),
                Body::Mercury => ("planet", -1.0),
                Body::Venus => ("planet", -4.5),
                Body::Mars => ("planet", -2.0),
                Body::Jupiter => ("planet", -2.5),
                Body::Saturn => ("planet", -1.5),
                // People look for these by name, however faint they are.
                Body::Uranus | Body::Neptune => ("planet", 0.0),
                Body::Pluto => ("dwarf planet", 0.5),
            };
            self.add(Target::Body(body), body.name(), kind, fame, Vec::new());
        }
        for moon in Galilean::ALL {
            self.add(Target::Satellite(moon), moon.name(), "moon of Jupiter", 1.0, Vec::new());
        }
    }

    /// A constellation is as famous as its brightest star, less one magnitude.
    fn add_constellations(&mut self, stars: &[Star]) {
        let mut brightest = vec![f64::INFINITY; ConstellationId::all().count()];
        for star in stars {
            if let Some(read) = star.designation.as_deref().and_then(Designation::parse) {
                let brightest = &mut brightest[read.constellation.index()];
                *brightest = brightest.min(star.magnitude.0);
            }
        }
        for id in ConstellationId::all() {
            let one = id.get();
            let mut names = vec![
                (one.abbreviation.to_owned(), Spelling::Short),
                (one.genitive.to_owned(), Spelling::Aside),
                (one.english.to_owned(), Spelling::Aside),
            ];
            names.retain(|(name, _)| name != one.latin);
            let fame = brightest[id.index()].min(6.0) + 1.0;
            self.add(Target::Constellation(id), one.latin, "constellation", fame, names);
        }
    }

    fn add_messier(&mut self) {
        for object in messier_objects() {
            let number = format!("M {}", object.number);
            let names = object.name.iter().chain(&object.also);
            let mut also: Vec<_> = names.map(|name| (name.clone(), Spelling::Free)).collect();
            also.extend(object.designation.iter().map(|name| (name.clone(), Spelling::Exact)));
            let fame = object.magnitude.0;
            self.add(Target::Messier(object.number), &number, object.kind, fame, also);
            if let Some(entry) = self.entries.last_mut() {
                let long = format!("Messier {}", object.number);
                entry.names.push(Name::new(&long, Spelling::Exact));
            }
        }
    }

    /// Large ones are better known; the landing sites, which are points, come last.
    fn add_feature(&mut self, feature: &MoonFeature) {
        let kind = match feature.kind.as_str() {
            "crater" => "crater on the Moon",
            "sea" => "sea on the Moon",
            "mountain" => "mountain on the Moon",
            "valley" => "valley on the Moon",
            "scarp" => "scarp on the Moon",
            "swirl" => "swirl on the Moon",
            "landing site" => "landing site on the Moon",
            _ => "place on the Moon",
        };
        let fame = 5.0 - feature.diameter_km.max(1.0).log10();
        let target = Target::MoonFeature(feature.name.clone());
        self.add(target, &feature.name, kind, fame, Vec::new());
    }

    fn add_star(&mut self, star: &Star) {
        let number = self.entries.len();
        let hr = format!("HR {}", star.hr);
        let mut names: Vec<(String, Spelling)> = Vec::new();
        names.extend(star.name.iter().map(|name| (name.clone(), Spelling::Free)));
        let flamsteed = star.flamsteed.iter().filter(|&own| star.designation.as_ref() != Some(own));
        for designation in star.designation.iter().chain(flamsteed) {
            let mut spelling = Spelling::Exact;
            if let Some(read) = Designation::parse(designation) {
                let stars = self.designations.entry((read.sign, read.constellation)).or_default();
                stars.push((read.index, number));
                spelling = Spelling::Parsed;
            }
            names.push((designation.clone(), spelling));
        }
        let variable = star.variable.iter().filter(|name| name.contains(' '));
        let (suspected, variable): (Vec<&String>, Vec<&String>) =
            variable.partition(|name| name.starts_with("NSV"));
        names.extend(variable.into_iter().map(|name| (name.clone(), Spelling::Exact)));
        names.push((hr, Spelling::Exact));
        let numbers = [("HD", star.hd), ("HIP", star.hip)];
        let numbers = numbers.into_iter().filter_map(|(list, n)| Some(format!("{list} {}", n?)));
        names.extend(numbers.map(|number| (number, Spelling::Exact)));
        names.extend(suspected.into_iter().map(|name| (name.clone(), Spelling::Exact)));
        self.add_named(Target::Star { hr: star.hr }, "star", star.magnitude.0, &names);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::Catalogs;

    fn finder() -> Finder {
        let catalogs = Catalogs::locate(None).unwrap();
        let stars = StarIndex::new(catalogs.stars().unwrap());
        Finder::new(&stars, &catalogs.moon_features().unwrap())
    }

    #[test]
    fn what_people_mean_stands_first() {
        let finder = finder();
        for (query, wanted) in [
            ("jup", "Jupiter"),
            ("sun", "Sun"),
            ("mo", "Moon"),
            ("mar", "Mars"),
            ("io", "Jupiter/Io"),
            ("sir", "HR 2491"),
            ("bet", "HR 2061"),
            ("betelguese", "HR 2061"),
            ("Betelgeux", "HR 2061"),
            ("vega", "HR 7001"),
            ("polaris", "HR 424"),
            ("cap", "HR 1708"),
            ("m31", "M 31"),
            ("M 31", "M 31"),
            ("messier 31", "M 31"),
            ("m3", "M 3"),
            ("ngc 224", "M 31"),
            ("NGC224", "M 31"),
            ("andromeda g", "M 31"),
            ("pleiades", "M 45"),
            ("praesepe", "M 44"),
            ("bodes", "M 81"),
            ("nebula orion", "M 42"),
            ("orion", "Constellation/Ori"),
            ("ori", "Constellation/Ori"),
            ("bootes", "Constellation/Boo"),
            ("Boötes", "Constellation/Boo"),
            ("great bear", "Constellation/UMa"),
            ("southern cross", "Constellation/Cru"),
            ("cassiopia", "Constellation/Cas"),
            ("swan", "Constellation/Cyg"),
            ("big dipper", "Constellation/UMa"),
            ("north star", "HR 424"),
            ("evening", "Venus"),
            ("jupitr", "Jupiter"),
            ("procyn", "HR 2943"),
            ("r leo", "HR 3882"),
            ("tycho", "Moon/Tycho"),
            ("copernicus", "Moon/Copernicus"),
            ("crisium", "Moon/Mare Crisium"),
            ("apollo 11", "Moon/Apollo 11"),
            ("stofler", "Moon/Stöfler"),
            ("hd 48915", "HR 2491"),
            ("HD48915", "HR 2491"),
            ("hip 32349", "HR 2491"),
            ("hr 2491", "HR 2491"),
            ("9 cma", "HR 2491"),
            ("61 cyg", "HR 8085"),
            ("beta ori", "HR 1713"),
            ("bet Ori", "HR 1713"),
            ("β Ori", "HR 1713"),
            ("β orionis", "HR 1713"),
            ("beta or", "HR 1713"),
            ("alpha cen", "HR 5459"),
            ("alpha2 cen", "HR 5460"),
        ] {
            let found = finder.search(query, 5);
            let first = found.first().map(|found| found.target.to_string());
            let all: Vec<_> = found.iter().map(|found| &found.name).collect();
            assert_eq!(first.as_deref(), Some(wanted), "{query}: {all:?}");
        }
    }

    #[test]
    fn what_is_found_says_what_it_is() {
        let finder = finder();
        let one = |query| finder.search(query, 1).remove(0);
        let sirius = one("sirius");
        assert_eq!((sirius.name.as_str(), sirius.kind), ("Sirius", "star"));
        assert_eq!(sirius.also, "α CMa, 9 CMa, HR 2491, HD 48915, HIP 32349");
        let galaxy = one("m31");
        assert_eq!((galaxy.name.as_str(), galaxy.kind), ("M 31", "spiral galaxy"));
        assert_eq!(galaxy.also, "Andromeda Galaxy, NGC 224");
        assert_eq!(one("tycho").kind, "crater on the Moon");
        assert_eq!(one("orion").also, "Ori, Orionis, Hunter");
        assert_eq!(finder.get(&"Jupiter/Io".parse().unwrap()), Some(&one("io")));
        assert_eq!(finder.get(&Target::MoonFeature("Utopia".into())), None);
    }

    #[test]
    fn no_more_than_asked_and_nothing_for_nothing() {
        let finder = finder();
        assert_eq!(finder.search("alpha", 7).len(), 7);
        for query in ["", "  ", "'", "hd 1234567", "xqzwv", "300 cma"] {
            assert_eq!(finder.search(query, 9), [], "{query:?}");
        }
        assert_eq!(finder.search("sirius", 0), []);
        // The brightest of a letter first, whatever its constellation.
        assert_eq!(finder.search("procyn", 5).len(), 1);
        let betas = finder.search("beta", 3);
        assert!(betas.iter().all(|found| found.kind == "star"), "{betas:?}");
    }

    #[test]
    fn each_target_stands_in_the_list_once_and_keeps_its_text() {
        let finder = finder();
        let mut seen = std::collections::HashSet::new();
        for entry in &finder.entries {
            let text = entry.found.target.to_string();
            assert_eq!(text.parse(), Ok(entry.found.target.clone()));
            assert!(seen.insert(text), "{:?}", entry.found);
        }
        assert!(seen.len() > 9096 + 88 + 110 + 14 + 100);
    }
}

//! Named places: a list of cities and observatories, and finding one by what people call it.
//!
//! The list is a CSV text in UTF-8 with the columns of [`COLUMNS`]. Names are compared without case,
//! accents and punctuation. A qualifier after a comma narrows the choice: a first-level division
//! (`Portland, Maine`), a country (`Paris, France`; known by the time zone), a region of the world
//! or a part of the time zone. Among several the most populous wins.

mod country;
mod csv;
mod fold;

use std::cmp::Reverse;
use std::collections::HashMap;
use std::sync::Arc;

use chrono_tz::Tz;
use thiserror::Error;

use crate::place::{HEIGHT_RANGE_M, Place, PlaceError};
use crate::units::Angle;
pub use fold::folded;
use fold::{folded_german, has_word_start, has_words};

/// The columns of a gazetteer, in order; the first line of the text.
pub const COLUMNS: [&str; 9] = [
    "name",
    "admin1",
    "region",
    "kind",
    "population",
    "lat_deg",
    "lon_deg",
    "elevation_m",
    "timezone",
];

/// Of a sphere as large as the Earth, kilometres.
const MEAN_RADIUS_KM: f64 = 6371.0;

/// How many near matches a message names.
const SUGGESTIONS: usize = 5;

/// What can be wrong with a gazetteer, or with a question to it.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GazetteerError {
    #[error("gazetteer line {line}: the columns are '{found}'; they must be {}", COLUMNS.join(","))]
    Header { line: usize, found: String },
    #[error("gazetteer line {line}: {found} columns where {} belong", COLUMNS.len())]
    Columns { line: usize, found: usize },
    #[error("gazetteer line {line}: a quote is opened and not closed")]
    Quote { line: usize },
    #[error("gazetteer line {line}, column {column}: '{value}' is not {expected}")]
    Value { line: usize, column: &'static str, value: String, expected: &'static str },
    #[error(
        "no place called '{query}'{} `nocturne place` lists all, or give --lat and --lon",
        did_you_mean(suggestions)
    )]
    Unknown { query: String, suggestions: Vec<String> },
}

fn did_you_mean(suggestions: &[String]) -> String {
    match suggestions {
        [] => ";".to_string(),
        names => format!("; did you mean {}?", names.join(", ")),
    }
}

/// A row of the gazetteer.
#[derive(Debug, Clone, PartialEq)]
pub struct City {
    pub name: String,
    /// First-level division: a state, a province.
    pub admin1: String,
    /// Part of the world, after the United Nations: `Western Europe`.
    pub region: String,
    /// `city`, `capital`, `regional_capital`, `observatory`.
    pub kind: String,
    /// Zero where nobody lives, or nobody counted.
    pub population: u64,
    /// North positive.
    pub latitude_deg: f64,
    /// East positive.
    pub longitude_deg: f64,
    /// Above sea level, if known. The list writes -9999 for what nobody knows, and -2000 for an
    /// observatory in a mine: nothing below the lowest land is an elevation of a sky.
    pub elevation_m: Option<f64>,
    pub time_zone: Option<Tz>,
    /// The name as it is compared, whole and without what stands in brackets.
    key: String,
    stem: String,
    /// Folded division, region and time zone, with bars between; shared by neighbours.
    area: Arc<str>,
}

impl City {
    /// The name with its first-level division: `Flagstaff (Arizona)`.
    pub fn label(&self) -> String {
        if self.admin1.is_empty() || self.name.contains('(') {
            return self.name.clone();
        }
        format!("{} ({})", self.name, self.admin1)
    }

    /// The country, known by the time zone.
    pub fn country(&self) -> Option<&'static str> {
        country::name(self.time_zone?.name())
    }

    /// The place itself; at sea level if the elevation is not known.
    pub fn place(&self) -> Result<Place, PlaceError> {
        let height_m = self.elevation_m.unwrap_or(0.0);
        let place = Place::new(self.latitude_deg, self.longitude_deg, height_m)?;
        Ok(Place { name: Some(self.name.clone()), time_zone: self.time_zone, ..place })
    }

    /// Whether people may mean it by this folded name: `new york` is New York City.
    fn is_called(&self, name: &str) -> bool {
        let rest = self.stem.strip_prefix(name);
        self.key == name || matches!(rest, Some("" | " city" | " observatory"))
    }

    /// Whether it lies in a division, country, region or time zone of this folded name.
    fn is_in(&self, area: &str) -> bool {
        let is_country = |zone: Tz| country::is_named(zone.name(), area);
        has_words(&self.area, area) || self.time_zone.is_some_and(is_country)
    }
}

/// A place of the list as seen from another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbour<'a> {
    pub city: &'a City,
    /// Along the ground.
    pub distance_km: f64,
    /// The azimuth in which it lies, north through east, in `[0, 360)` degrees.
    pub bearing: Angle,
}

impl City {
    /// How far away and in which azimuth it lies from a place: on a sphere, 0.5 % and 0.3 degrees at
    /// most from the ellipsoid.
    pub fn seen_from(&self, place: &Place) -> Neighbour<'_> {
        let (sin_here, cos_here) = place.latitude.sin_cos();
        let (sin_there, cos_there) = Angle::from_deg(self.latitude_deg).sin_cos();
        let (sin_east, cos_east) =
            (Angle::from_deg(self.longitude_deg) - place.longitude).sin_cos();
        let east = cos_there * sin_east;
        let north = cos_here * sin_there - sin_here * cos_there * cos_east;
        let up = sin_here * sin_there + cos_here * cos_there * cos_east;
        Neighbour {
            city: self,
            distance_km: MEAN_RADIUS_KM * east.hypot(north).atan2(up),
            bearing: Angle::from_rad(east.atan2(north)).positive(),
        }
    }
}

/// A name and what narrows it, folded.
struct Query {
    /// With accents dropped; and with umlauts written out, if that is something else.
    names: Vec<String>,
    areas: Vec<String>,
}

impl Query {
    fn new(name: &str, areas: &str) -> Query {
        let areas = areas.split(',').map(folded).filter(|area| !area.is_empty()).collect();
        let mut names = vec![folded(name), folded_german(name)];
        names.dedup();
        names.retain(|name| !name.is_empty());
        Query { names, areas }
    }

    fn any_name(&self, test: impl Fn(&str) -> bool) -> bool {
        self.names.iter().any(|name| test(name))
    }

    fn is_around(&self, city: &City) -> bool {
        self.areas.iter().all(|area| city.is_in(area))
    }
}

/// A list of named places.
#[derive(Debug, Clone, PartialEq)]
pub struct Gazetteer {
    cities: Vec<City>,
}

impl Gazetteer {
    /// Reads a CSV text whose first line is [`COLUMNS`]. Lines that are empty or begin with `#` are
    /// passed over.
    pub fn parse(text: &str) -> Result<Gazetteer, GazetteerError> {
        let mut rows = csv::rows(text);
        match rows.next() {
            Some((line, row)) if csv::fields(line, row)? != COLUMNS => {
                return Err(GazetteerError::Header { line, found: row.to_string() });
            }
            None => return Err(GazetteerError::Header { line: 1, found: String::new() }),
            Some(_) => {}
        }
        let mut areas = Areas::default();
        let city = |(line, row)| read_city(line, row, &mut areas);
        let cities = rows.map(city).collect::<Result<_, _>>()?;
        Ok(Gazetteer { cities })
    }

    /// All places, in the order of the list.
    pub fn cities(&self) -> &[City] {
        &self.cities
    }

    /// All places within some kilometres of one, in the order of the list.
    pub fn around<'a>(
        &'a self,
        place: &'a Place,
        within_km: f64,
    ) -> impl Iterator<Item = Neighbour<'a>> {
        // A degree of latitude is 111 km: most of the list needs no trigonometry.
        let within_deg = within_km / 110.0;
        self.cities
            .iter()
            .filter(move |city| (city.latitude_deg - place.latitude.deg()).abs() <= within_deg)
            .map(|city| city.seen_from(place))
            .filter(move |neighbour| neighbour.distance_km <= within_km)
    }

    /// The place that people call by this name; the most populous if there are several.
    pub fn find(&self, query: &str) -> Result<Place, GazetteerError> {
        let unknown = || {
            let suggestions =
                self.search(query, SUGGESTIONS).into_iter().map(City::label).collect();
            GazetteerError::Unknown { query: query.trim().to_string(), suggestions }
        };
        let city = self.find_city(query).ok_or_else(unknown)?;
        // Rows that make no place were refused when they were read.
        city.place().map_err(|_| unknown())
    }

    fn find_city(&self, query: &str) -> Option<&City> {
        // A name may have a comma of its own; otherwise the first one ends it.
        self.best(&Query::new(query, "")).or_else(|| {
            query.split_once(',').and_then(|(name, areas)| self.best(&Query::new(name, areas)))
        })
    }

    fn best(&self, query: &Query) -> Option<&City> {
        let is_called = |city: &&City| query.any_name(|name| city.is_called(name));
        let called = self.cities.iter().filter(is_called).filter(|city| query.is_around(city));
        // The first of equals, so that the order of the list decides.
        called.min_by_key(|city| Reverse(city.population)).or_else(|| {
            // The beginning of a name will do if no other name begins so.
            let begins = |city: &&City| query.any_name(|name| begins_with_words(&city.stem, name));
            let mut begun = self.cities.iter().filter(begins).filter(|city| query.is_around(city));
            begun.next().filter(|_| begun.next().is_none())
        })
    }

    /// Places that people may mean, likeliest first: of this name, of a name that begins with it or
    /// contains it, in an area of this name; if there are none, spelt alike. An area after a comma
    /// that fits none of them is left aside. Nothing asked lists all, the most populous first.
    pub fn search(&self, query: &str, limit: usize) -> Vec<&City> {
        let (name, areas) = query.split_once(',').unwrap_or((query, ""));
        let narrow = Query::new(name, areas);
        let wide = Query::new(name, "");
        let tries: &[(&Query, Rank)] =
            &[(&narrow, rank), (&narrow, misspelling), (&wide, rank), (&wide, misspelling)];
        let tries = if narrow.areas.is_empty() { &tries[2..] } else { tries };
        let found = tries.iter().map(|(query, rank)| self.ranked(query, *rank));
        let found = found.into_iter().find(|found| !found.is_empty()).unwrap_or_default();
        found.into_iter().take(limit).collect()
    }

    /// The places that have a rank, lowest first, then the most populous.
    fn ranked(&self, query: &Query, rank: Rank) -> Vec<&City> {
        let around = self.cities.iter().filter(|city| query.is_around(city));
        let mut ranked: Vec<(usize, &City)> =
            around.filter_map(|city| Some((rank(city, query)?, city))).collect();
        ranked.sort_by_key(|(rank, city)| (*rank, Reverse(city.population)));
        ranked.into_iter().map(|(_, city)| city).collect()
    }
}

/// How far a place is from what was asked, 0 nearest; `None` if it is something else.
type Rank = fn(&City, &Query) -> Option<usize>;

fn rank(city: &City, query: &Query) -> Option<usize> {
    if query.names.is_empty() || query.any_name(|name| city.is_called(name)) {
        Some(0)
    } else if query.any_name(|name| city.stem.starts_with(name)) {
        Some(1)
    } else if query.any_name(|name| has_word_start(&city.stem, name)) {
        Some(2)
    } else {
        query.any_name(|name| city.is_in(name)).then_some(3)
    }
}

/// How many letters are wrong, missing, too many or swapped; up to a third of the name.
fn misspelling(city: &City, query: &Query) -> Option<usize> {
    let errors = |name: &String| {
        let most = (name.chars().count() / 3).max(1);
        // Words of very different length need no comparison.
        let is_near = name.len().abs_diff(city.stem.len()) <= most;
        is_near.then(|| strsim::osa_distance(name, &city.stem)).filter(|&errors| errors <= most)
    };
    query.names.iter().filter_map(errors).min()
}

fn begins_with_words(text: &str, words: &str) -> bool {
    text.strip_prefix(words).is_some_and(|rest| rest.starts_with(' '))
}

/// The areas met so far, folded once: many places share each.
#[derive(Default)]
struct Areas {
    folded_by_raw: HashMap<String, Arc<str>>,
}

impl Areas {
    fn folded(&mut self, parts: [&str; 3]) -> Arc<str> {
        let fold_all = || parts.map(folded).join(" | ").into();
        self.folded_by_raw.entry(parts.join("|")).or_insert_with(fold_all).clone()
    }
}

fn read_city(line: usize, row: &str, areas: &mut Areas) -> Result<City, GazetteerError> {
    let fields = csv::fields(line, row)?;
    let found = fields.len();
    let Ok([name, admin1, region, kind, population, latitude, longitude, elevation, zone]) =
        <[String; 9]>::try_from(fields)
    else {
        return Err(GazetteerError::Columns { line, found });
    };
    let wrong = |column: usize, value: &str, expected| GazetteerError::Value {
        line,
        column: COLUMNS[column],
        value: value.to_string(),
        expected,
    };
    let number = |column: usize, value: &str| {
        let number = value.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| wrong(column, value, "a number"))
    };
    if name.trim().is_empty() {
        return Err(wrong(0, &name, "a name"));
    }
    let elevation_m = match elevation.as_str() {
        "" => None,
        text => Some(number(7, text)?).filter(|m| m >= HEIGHT_RANGE_M.start()),
    };
    let time_zone = match zone.as_str() {
        "" => None,
        name => Some(name.parse().map_err(|_| wrong(8, name, "a time zone"))?),
    };
    let (latitude_deg, longitude_deg) = (number(5, &latitude)?, number(6, &longitude)?);
    Place::new(latitude_deg, longitude_deg, elevation_m.unwrap_or(0.0)).map_err(|e| match e {
        PlaceError::Latitude(_) => wrong(5, &latitude, "a latitude in degrees"),
        PlaceError::Longitude(_) => wrong(6, &longitude, "a longitude in degrees"),
        PlaceError::Height(_) => wrong(7, &elevation, "a height on the Earth in metres"),
    })?;
    let key = folded(&name);
    let stem = match name.find(" (") {
        Some(bracket) => folded(&name[..bracket]),
        None => key.clone(),
    };
    Ok(City {
        key,
        stem,
        area: areas.folded([&admin1, &region, &zone]),
        population: population.parse().map_err(|_| wrong(4, &population, "a whole number"))?,
        latitude_deg,
        longitude_deg,
        elevation_m,
        time_zone,
        name,
        admin1,
        region,
        kind,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = "\
# Rows of GeoNames, CC BY 4.0; the observatories from Stellarium's list of locations.
name,admin1,region,kind,population,lat_deg,lon_deg,elevation_m,timezone
Tokyo,Tokyo,Eastern Asia,capital,8336599,35.6895,139.69171,44,Asia/Tokyo
London,England,Northern Europe,capital,8961989,51.50853,-0.12574,25,Europe/London
New York City,New York,Northern America,city,8804190,40.71427,-74.00597,57,America/New_York
Sao Paulo,Sao Paulo,Southern America,regional_capital,10021295,-23.5475,-46.63611,769,America/Sao_Paulo
Paris,Ile-de-France,Western Europe,capital,2138551,48.85341,2.3488,42,Europe/Paris
Koeln,North Rhine-Westphalia,Western Europe,city,963395,50.93333,6.95,58,Europe/Berlin
\"Washington (Washington, D.C.)\",\"Washington, D.C.\",Northern America,capital,689545,38.89511,-77.03637,6,America/New_York
Athens,Attica,Southern Europe,capital,664046,37.98376,23.72784,84,Europe/Athens
London,Ontario,Northern America,city,346765,42.98339,-81.23304,252,America/Toronto
Zurich,Zurich,Western Europe,regional_capital,341730,47.36667,8.55,429,Europe/Zurich
St. Louis,Missouri,Northern America,city,315685,38.62727,-90.19789,149,America/Chicago
Athens (Georgia),Georgia,Northern America,city,116714,33.96095,-83.37794,232,America/New_York
Flagstaff,Arizona,Northern America,city,70320,35.19807,-111.65127,2108,America/Phoenix
Washington,England,Northern Europe,city,53526,54.9,-1.51667,59,Europe/London
Tromso,Troms og Finnmark,Northern Europe,regional_capital,52436,69.6489,18.95508,-9999,Europe/Oslo
Paris,Texas,Northern America,city,24782,33.66094,-95.55551,190,America/Chicago
\"Sant Pere, Santa Caterina i La Ribera\",Catalonia,Southern Europe,city,22856,41.3845,2.18152,22,Europe/Madrid
Palomar Observatory,California,Northern America,observatory,0,33.35583,-116.86389,1712,America/Los_Angeles
Kitt Peak National Observatory,Arizona,Northern America,observatory,0,31.95833,-111.59666,2096,America/Phoenix
Coats Observatory,Scotland,Northern Europe,observatory,0,55.84562,-4.43117,0,
";

    fn list() -> Gazetteer {
        Gazetteer::parse(LIST).unwrap()
    }

    #[test]
    fn a_place_is_found_by_what_people_call_it() {
        let list = list();
        let cases = [
            ("Flagstaff", 35.19807),
            ("  flagstaff, arizona ", 35.19807),
            ("Flagstaff, US", 35.19807),
            ("Paris", 48.85341),
            ("PARIS, FRANCE", 48.85341),
            ("Paris, Texas", 33.66094),
            ("Paris, Northern America", 33.66094),
            ("London", 51.50853),
            ("London, UK", 51.50853),
            ("London, Ontario, Canada", 42.98339),
            ("Tokyo, Japan", 35.6895),
            ("New York", 40.71427),
            ("São Paulo", -23.5475),
            ("Köln", 50.93333),
            ("Zürich", 47.36667),
            ("Tromsø", 69.6489),
            ("Saint Louis", 38.62727),
            ("Washington", 38.89511),
            ("Washington, D.C.", 38.89511),
            ("Washington, England", 54.9),
            ("Athens, Georgia", 33.96095),
            ("Athens, Europe/Athens", 37.98376),
            ("Sant Pere, Santa Caterina i La Ribera", 41.3845),
            ("Palomar", 33.35583),
            ("Kitt Peak", 31.95833),
        ];
        for (query, latitude_deg) in cases {
            let place = list.find(query).unwrap_or_else(|e| panic!("{query}: {e}"));
            assert!((place.latitude.deg() - latitude_deg).abs() < 1e-9, "{query}: {place:?}");
        }
    }

    #[test]
    fn a_place_brings_its_name_height_and_clock() {
        let place = list().find("flagstaff").unwrap();
        assert_eq!(place.name.as_deref(), Some("Flagstaff"));
        assert!((place.longitude.deg() + 111.65127).abs() < 1e-9);
        assert_eq!(place.height_m, 2108.0);
        assert_eq!(place.time_zone, Some(chrono_tz::America::Phoenix));
        // Neither the elevation of Tromso nor the clock of Coats Observatory is known.
        assert_eq!(list().find("Tromso").unwrap().height_m, 0.0);
        assert_eq!(list().find("Coats").unwrap().time_zone, None);
    }

    #[test]
    fn places_around_have_distance_and_bearing() {
        let list = list();
        let flagstaff = list.find("flagstaff").unwrap();
        let around: Vec<Neighbour> = list.around(&flagstaff, 400.0).collect();
        let names: Vec<&str> = around.iter().map(|n| n.city.name.as_str()).collect();
        assert_eq!(names, ["Flagstaff", "Kitt Peak National Observatory"]);
        assert!(around[0].distance_km < 1e-6);
        // Nearly along a meridian: 3.2397 degrees of 110.93 km on WGS84, and 5.2 km to the east.
        assert!((around[1].distance_km - 359.4).abs() < 1.5, "{}", around[1].distance_km);
        assert!((around[1].bearing.deg() - 179.2).abs() < 0.1, "{}", around[1].bearing.deg());
        // Over the date line and over the pole there is a way as well.
        let chatham = Place::new(-44.0, -176.5, 0.0).unwrap();
        let tokyo = &list.cities()[0];
        let seen = tokyo.seen_from(&chatham);
        assert!((9000.0..10_500.0).contains(&seen.distance_km), "{}", seen.distance_km);
        assert!((300.0..340.0).contains(&seen.bearing.deg()), "{}", seen.bearing.deg());
        let pole = Place::new(90.0, 0.0, 0.0).unwrap();
        let quarter = tokyo.seen_from(&pole).distance_km;
        assert!((quarter - (90.0 - 35.6895) * 111.195).abs() < 1.0, "{quarter}");
    }

    #[test]
    fn an_unknown_place_is_answered_with_near_ones() {
        let says = |query, sentence: &str| {
            assert_eq!(list().find(query).unwrap_err().to_string(), sentence);
        };
        let way_out = "`nocturne place` lists all, or give --lat and --lon";
        let likely = |names| format!("did you mean {names}? {way_out}");
        says("Flagstaf", &format!("no place called 'Flagstaf'; {}", likely("Flagstaff (Arizona)")));
        says(
            "Falgstaff",
            &format!("no place called 'Falgstaff'; {}", likely("Flagstaff (Arizona)")),
        );
        says(
            "Paris, Nevada",
            &format!(
                "no place called 'Paris, Nevada'; {}",
                likely("Paris (Ile-de-France), Paris (Texas)")
            ),
        );
        says(
            "Londn, Canada",
            &format!("no place called 'Londn, Canada'; {}", likely("London (Ontario)")),
        );
        says("Xqzzy", &format!("no place called 'Xqzzy'; {way_out}"));
    }

    #[test]
    fn a_search_lists_the_likeliest_first() {
        let list = list();
        let names = |query, limit| -> Vec<String> {
            list.search(query, limit).into_iter().map(City::label).collect()
        };
        assert_eq!(names("paris", 9), ["Paris (Ile-de-France)", "Paris (Texas)"]);
        assert_eq!(names("arizona", 1), ["Flagstaff (Arizona)"]);
        assert_eq!(names("peak", 9), ["Kitt Peak National Observatory (Arizona)"]);
        assert_eq!(names("wash, england", 9), ["Washington (England)"]);
        assert_eq!(names("", 2), ["Sao Paulo (Sao Paulo)", "London (England)"]);
        assert_eq!(names(",,,", 1), ["Sao Paulo (Sao Paulo)"]);
        assert_eq!(names("paris", 0), [""; 0]);
        assert_eq!(list.cities().len(), 20);
    }

    #[test]
    fn faults_are_named_with_their_line_and_column() {
        let says = |row: &str, sentence: &str| {
            let text = format!("{}\n\n{row}\n", COLUMNS.join(","));
            assert_eq!(Gazetteer::parse(&text).unwrap_err().to_string(), sentence);
        };
        says("A,B,C,city,1,2,3,4", "gazetteer line 3: 8 columns where 9 belong");
        says("\"A,B,C", "gazetteer line 3: a quote is opened and not closed");
        let column = |column, value, expected| {
            format!("gazetteer line 3, column {column}: '{value}' is not {expected}")
        };
        says(" ,B,C,city,1,2,3,4,", &column("name", " ", "a name"));
        says("A,B,C,city,many,2,3,4,", &column("population", "many", "a whole number"));
        says("A,B,C,city,1,x,3,4,", &column("lat_deg", "x", "a number"));
        says("A,B,C,city,1,95,3,4,", &column("lat_deg", "95", "a latitude in degrees"));
        says("A,B,C,city,1,2,nan,4,", &column("lon_deg", "nan", "a number"));
        says("A,B,C,city,1,2,361,4,", &column("lon_deg", "361", "a longitude in degrees"));
        let height = "a height on the Earth in metres";
        says("A,B,C,city,1,2,3,1e9,", &column("elevation_m", "1e9", height));
        says("A,B,C,city,1,2,3,4,Mars/Base", &column("timezone", "Mars/Base", "a time zone"));
        let message = |text| Gazetteer::parse(text).unwrap_err().to_string();
        let columns = COLUMNS.join(",");
        assert_eq!(
            message("name,lat\n"),
            format!("gazetteer line 1: the columns are 'name,lat'; they must be {columns}")
        );
        assert!(message("").contains("the columns are ''"));
    }
}

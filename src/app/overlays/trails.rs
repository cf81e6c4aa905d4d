//! Trails of planets among the stars: where they are seen for two months before and after now.
//!
//! Places are astrometric and geocentric, each two days, within an arcminute; between them runs a cubic.
//! They are reckoned beside the window, once for each body and day.

use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::sync::Arc;

use eframe::egui::{Context, vec2};

use super::Sketch;
use super::axes::far_away;
use super::curve::Curve;
use super::ink::Pen;
use super::labels::{AROUND, Label, id};
use crate::background::Background;
use crate::catalog::Catalogs;
use crate::ephemeris::{Body, Ephemeris, Observation};
use crate::frame::{Dir, Icrs};
use crate::place::Place;
use crate::sky::Target;
use crate::time::calendar::date_from_julian_day_number;
use crate::time::{Instant, JulianDate};
use crate::units::Angle;

/// How far a trail runs each way.
const SPAN_DAYS: i64 = 60;
const STEP_DAYS: i64 = 2;
const TICK_DAYS: i64 = 10;
const TOLERANCE: Angle = Angle::from_arcmin(1.0);
/// Places that are kept.
const KEPT: usize = 20_000;
/// What was is dashed, what will be is whole.
const PAST: Pen = Pen::new([240, 200, 130], 0.6, 1.2, &[4.0, 3.0]);
const FUTURE: Pen = Pen::new([240, 200, 130], 0.8, 1.4, &[]);
/// Dates are written where a degree is as long as this, points.
const DATED_POINTS: f64 = 6.0;
const MONTHS: [&str; 12] =
    ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];

/// What is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    bodies: Vec<Body>,
    /// Julian day number, even: the middle.
    day: i64,
    place: Place,
}

/// The way of one body.
#[derive(Debug, Clone)]
pub struct Trail {
    pub body: Body,
    /// Julian day numbers, whose 0h TT is meant, and where the body is seen from the Earth then.
    pub days: Vec<(i64, Dir<Icrs>)>,
}

/// Trails, made beside the window.
#[derive(Default)]
pub struct Trails {
    background: OnceCell<Background<Wish, Vec<Trail>>>,
}

impl Trails {
    /// Those that are there; what is wished for is made if it is not.
    pub fn of(
        &self,
        ctx: &Context,
        catalogs: &Catalogs,
        wish: Wish,
    ) -> Option<Arc<(Wish, Vec<Trail>)>> {
        let background = self.background.get_or_init(|| {
            let (ctx, catalogs) = (ctx.clone(), catalogs.clone());
            let reckoner =
                RefCell::new(Reckoner { catalogs, ephemeris: None, known: HashMap::new() });
            Background::new(move |wish: &Wish, _| {
                let trails = reckoner.borrow_mut().trails(wish);
                ctx.request_repaint();
                Some(trails)
            })
        });
        let latest = background.latest();
        if latest.as_ref().is_none_or(|latest| latest.0 != wish) {
            background.ask(wish.clone());
        }
        // Yesterday's trail does until today's is there.
        latest
            .filter(|latest| latest.0.bodies == wish.bodies && (latest.0.day - wish.day).abs() < 10)
    }

    /// Waits for what is being made.
    pub fn wait(&self) {
        if let Some(background) = self.background.get() {
            background.wait();
        }
    }
}

/// The trails for a selection and a time: of the selected planet, else of all that eyes see.
pub fn wish(selected: Option<&Target>, instant: &Instant, place: &Place) -> Wish {
    let bodies = match selected {
        Some(&Target::Body(body)) if Body::PLANETS.contains(&body) => vec![body],
        _ => Body::PLANETS.into_iter().take(5).collect(),
    };
    let day = (instant.tt.jd() + 0.5).floor() as i64;
    Wish { bodies, day: day - day.rem_euclid(STEP_DAYS), place: place.clone() }
}

/// What the thread has.
struct Reckoner {
    catalogs: Catalogs,
    ephemeris: Option<Ephemeris>,
    known: HashMap<(Body, i64), Option<Dir<Icrs>>>,
}

impl Reckoner {
    fn trails(&mut self, wish: &Wish) -> Vec<Trail> {
        if self.known.len() > KEPT {
            self.known.clear();
        }
        let ephemeris = self.ephemeris.get_or_insert_with(|| {
            // Without tables the series do as well for an arcminute.
            Ephemeris::load(&self.catalogs, TOLERANCE).unwrap_or_else(|_| Ephemeris::analytic())
        });
        let days = (wish.day - SPAN_DAYS..=wish.day + SPAN_DAYS).step_by(STEP_DAYS as usize);
        let trail = |&body: &Body| {
            let place = |day| {
                let known = self.known.entry((body, day));
                let dir = *known.or_insert_with(|| seen(ephemeris, body, day, &wish.place));
                Some((day, dir?))
            };
            Trail { body, days: days.clone().filter_map(place).collect() }
        };
        wish.bodies.iter().map(trail).collect()
    }
}

/// Where a body is seen from the middle of the Earth; none on dates that no theory serves.
fn seen(ephemeris: &Ephemeris, body: Body, day: i64, place: &Place) -> Option<Dir<Icrs>> {
    let instant = Instant::from_tt(JulianDate::from_parts(day as f64, -0.5)).ok()?;
    let mut observation = Observation::at(ephemeris, &instant, place, TOLERANCE);
    Some(observation.seen(body).ok()?.place.from_earth.dir())
}

/// Draws trails.
pub fn draw(sketch: &mut Sketch, trails: &[Trail]) {
    let now = sketch.night.sky.instant.tt.jd() + 0.5;
    for trail in trails {
        // A gap ends a trail.
        for days in trail.days.chunk_by(|a, b| b.0 - a.0 == STEP_DAYS) {
            draw_one(sketch, trail.body, days, now);
        }
    }
}

fn draw_one(sketch: &mut Sketch, body: Body, days: &[(i64, Dir<Icrs>)], now: f64) {
    let (Some(first), Some(last)) = (days.first(), days.last()) else { return };
    let steps = (days.len() - 1) as f64;
    let (night, first_day) = (sketch.night, first.0 as f64);
    let at = |u: f64| {
        let dir = between(days, u);
        night.refraction.apparent_from_horizon(far_away(&night.sky, dir))
    };
    let fastest = days.windows(2).map(|pair| pair[0].1.separation(pair[1].1).rad());
    let rate_rad = 1.5 * fastest.fold(1e-9, f64::max);
    let today = ((now - first_day) / STEP_DAYS as f64).clamp(0.0, steps);
    for (from, to, pen) in [(0.0, today, &PAST), (today, steps, &FUTURE)] {
        if to > from {
            sketch.curve(&Curve { at, from, to, rate_rad }, pen);
        }
    }
    let is_dated = sketch.points_per_rad().to_radians() > DATED_POINTS;
    let ticks = (first.0..=last.0).filter(|day| day % TICK_DAYS == 0);
    for day in ticks {
        let u = (day - first.0) as f64 / STEP_DAYS as f64;
        let (Some(here), Some(ahead)) = (sketch.point(at(u)), sketch.point(at(u + 1e-3))) else {
            continue;
        };
        let along = (ahead - here).normalized();
        let across = vec2(-along.y, along.x) * 4.0;
        sketch.ink.line(&[here - across, here + across], &Pen { dashes: &[], ..PAST });
        if is_dated {
            let (_, month, of_month) = date_from_julian_day_number(day);
            sketch.labels.push(Label {
                id: id(("trail", body, day)),
                text: format!("{of_month} {}", MONTHS[usize::from(month - 1) % 12]),
                at: here,
                gap: 6.0,
                places: AROUND,
                size: 10.0,
                spacing: 0.0,
                colour: PAST.colour,
                opacity: 0.85,
                rank: 9.0,
            });
        }
    }
}

/// The cubic of Catmull and Rom through places on the sphere, by their numbers.
fn between(days: &[(i64, Dir<Icrs>)], u: f64) -> Dir<Icrs> {
    let last = days.len() - 1;
    let number = (u.max(0.0) as usize).min(last.saturating_sub(1));
    let t = u - number as f64;
    let [p1, p2] = [number, (number + 1).min(last)].map(|n| days[n].1.vector());
    // At the ends it runs on as it came.
    let p0 = if number > 0 { days[number - 1].1.vector() } else { 2.0 * p1 - p2 };
    let p3 = if number + 2 <= last { days[number + 2].1.vector() } else { 2.0 * p2 - p1 };
    let (m1, m2) = (0.5 * (p2 - p0), 0.5 * (p3 - p1));
    let (t2, t3) = (t * t, t * t * t);
    Dir::from_vector(
        p1 * (2.0 * t3 - 3.0 * t2 + 1.0)
            + m1 * (t3 - 2.0 * t2 + t)
            + p2 * (3.0 * t2 - 2.0 * t3)
            + m2 * (t3 - t2),
    )
}

//! A month of days to choose from, with the phases of the Moon.

use eframe::egui::{self, Button, Context, Grid, Pos2, Role, Ui, WidgetInfo};

use crate::almanac::{Almanac, Class, Quarter, Request, What};
use crate::app::local_clock::{LocalClock, days_of, month_name, plus_months, weekday};
use crate::app::panels::typed::named_button;
use crate::background::Background;
use crate::ephemeris::Ephemeris;
use crate::time::CivilDateTime;
use crate::units::DAY_S;

const WEEKDAYS: [&str; 7] = ["Mo", "Tu", "We", "Th", "Fr", "Sa", "Su"];
/// Of the sign of a phase, points.
const MOON_RADIUS: f32 = 3.5;
/// Longer than any month.
const LONGEST_MONTH_DAYS: f64 = 33.0;

/// A month of a clock.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Page {
    year: i32,
    month: u8,
    clock: LocalClock,
}

/// Days on which the Moon has a phase.
type Phases = Vec<(u8, Quarter)>;

/// The month that is looked at.
#[derive(Default)]
pub struct Month {
    /// Year and month; none for those of the clock.
    turned_to: Option<(i32, u8)>,
    /// What the clock had then: it goes back to its month when that changes.
    of_clock: Option<(i32, u8)>,
    almanac: Option<Background<Page, Phases>>,
}

impl Month {
    /// Shows it, and gives the date that was clicked.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        clock: LocalClock,
        now: &CivilDateTime,
    ) -> Option<(i32, u8, u8)> {
        let of_clock = Some((now.year, now.month));
        if self.of_clock != of_clock {
            (self.of_clock, self.turned_to) = (of_clock, None);
        }
        let (year, month) = self.turned_to.unwrap_or((now.year, now.month));
        self.head(ui, year, month);
        let phases = self.phases(ui.ctx(), Page { year, month, clock });
        let mut chosen = None;
        Grid::new("month").num_columns(7).spacing([2.0, 2.0]).show(ui, |ui| {
            for name in WEEKDAYS {
                ui.weak(name);
            }
            ui.end_row();
            let mut column = 0;
            for day in days_of(year, month) {
                let place = weekday(year, month, day);
                if place < column {
                    ui.end_row();
                    column = 0;
                }
                (column..place).for_each(|_| _ = ui.label(""));
                column = place + 1;
                let is_now = (year, month, day) == (now.year, now.month, now.day);
                let phase = phases.iter().find(|(other, _)| *other == day);
                if day_button(ui, (year, month, day), is_now, phase.map(|(_, phase)| *phase)) {
                    chosen = Some((year, month, day));
                }
            }
        });
        chosen
    }

    /// The name of the month, between buttons to turn the page.
    fn head(&mut self, ui: &mut Ui, year: i32, month: u8) {
        let first = CivilDateTime { year, month, day: 1, hour: 0, minute: 0, second: 0.0 };
        ui.horizontal(|ui| {
            for (sign, name, months) in [("«", "Previous year", -12), ("‹", "Previous month", -1)]
            {
                self.turn(ui, sign, name, plus_months(first, months));
            }
            ui.label(format!("{} {year}", month_name(month)));
            for (sign, name, months) in [("›", "Next month", 1), ("»", "Next year", 12)] {
                self.turn(ui, sign, name, plus_months(first, months));
            }
        });
    }

    fn turn(&mut self, ui: &mut Ui, sign: &str, name: &str, to: CivilDateTime) {
        let is_known = crate::time::calendar::YEARS.contains(&to.year);
        let clicked = ui.add_enabled_ui(is_known, |ui| named_button(ui, sign, name).clicked());
        if clicked.inner {
            self.turned_to = Some((to.year, to.month));
        }
    }

    /// The phases that are known, and asks for those that are not.
    fn phases(&mut self, ctx: &Context, page: Page) -> Phases {
        let almanac = self.almanac.get_or_insert_with(|| {
            let wake = ctx.clone();
            Background::new(move |page: &Page, _| {
                let phases = phases_of(page);
                wake.request_repaint();
                Some(phases)
            })
        });
        let known = almanac.latest();
        match known.as_deref() {
            Some((whose, phases)) if *whose == page => phases.clone(),
            _ => {
                almanac.ask(page);
                Phases::new()
            }
        }
    }
}

/// None where no theory reaches.
fn phases_of(page: &Page) -> Phases {
    let Page { year, month, clock } = *page;
    let find = || {
        let from = clock.instant(CivilDateTime::midnight(year, month, 1).ok()?).ok()?;
        let to = from.plus_seconds(LONGEST_MONTH_DAYS * DAY_S).ok()?;
        let request = Request { classes: vec![Class::Phase], ..Request::default() };
        let almanac = Almanac::new(&Ephemeris::analytic(), None, request).ok()?;
        let events = almanac.events(&from, &to).ok()?.filter_map(Result::ok);
        let day = |event: crate::almanac::Event| {
            let civil = clock.read(&event.instant).civil;
            let What::MoonPhase(quarter) = event.what else { return None };
            ((civil.year, civil.month) == (year, month)).then_some((civil.day, quarter))
        };
        Some(events.filter_map(day).collect())
    };
    find().unwrap_or_default()
}

fn day_button(
    ui: &mut Ui,
    (year, month, day): (i32, u8, u8),
    is_now: bool,
    phase: Option<Quarter>,
) -> bool {
    let name = match phase {
        None => "",
        Some(Quarter::New) => ", new Moon",
        Some(Quarter::First) => ", first quarter",
        Some(Quarter::Full) => ", full Moon",
        Some(Quarter::Last) => ", last quarter",
    };
    let button = Button::selectable(is_now, day.to_string());
    let response = ui.add(button.min_size(egui::vec2(38.0, 18.0)));
    let date = format!("{day} {} {year}{name}", month_name(month));
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_now, &date));
    if let Some(phase) = phase {
        let middle = response.rect.right_center() - egui::vec2(MOON_RADIUS + 1.0, 0.0);
        draw_moon(ui, middle, phase);
    }
    response.on_hover_text(date).clicked()
}

/// A small Moon, as the north sees it.
fn draw_moon(ui: &Ui, middle: Pos2, phase: Quarter) {
    let color = ui.visuals().strong_text_color();
    let painter = ui.painter();
    painter.circle_stroke(middle, MOON_RADIUS, (1.0, color));
    // On which side the lit half lies.
    let side = match phase {
        Quarter::New => return,
        Quarter::Full => {
            painter.circle_filled(middle, MOON_RADIUS, color);
            return;
        }
        Quarter::First => 1.0,
        Quarter::Last => -1.0,
    };
    let rim = (0..=8).map(|n| {
        let (sin, cos) = (n as f32 / 8.0 * std::f32::consts::PI).sin_cos();
        middle + egui::vec2(side * sin, -cos) * MOON_RADIUS
    });
    painter.add(egui::Shape::convex_polygon(rim.collect(), color, egui::Stroke::NONE));
}

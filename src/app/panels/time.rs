//! Date and time: fields, a calendar, steps, and jumps to what happens in the sky.

mod month;

use eframe::egui::{Grid, Ui};

use crate::app::action::{Action, Jump};
use crate::app::clock::Step;
use crate::app::local_clock::{
    LocalClock, Reading, before_christ, plus_days, plus_months, read_year, signed_offset,
    with_month,
};
use crate::sky::Target;
use crate::time::{CivilDateTime, Instant, JulianDate};

use super::Desk;
use super::bar;
use super::typed::{Change, Field, Typed, named_button};
use month::Month;

/// A part of a date, as it is typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Year,
    Month,
    Day,
    Hour,
    Minute,
    Second,
}

/// The panel, with what is typed into it.
#[derive(Default)]
pub struct TimePanel {
    /// UTC in place of the clock of the place.
    uses_utc: bool,
    typed: Typed,
    month: Month,
}

impl TimePanel {
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk) {
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.set_max_width(290.0);
                self.date(ui, desk);
            });
            ui.separator();
            ui.vertical(|ui| {
                ui.horizontal(|ui| bar::rates(ui, desk));
                ui.separator();
                steps(ui, desk);
                ui.separator();
                jumps(ui, desk);
            });
        });
    }

    fn clock(&self, desk: &Desk) -> LocalClock {
        if self.uses_utc { LocalClock::UTC } else { LocalClock::of(&desk.model.place) }
    }

    fn date(&mut self, ui: &mut Ui, desk: &mut Desk) {
        ui.horizontal(|ui| {
            ui.radio_value(&mut self.uses_utc, false, "Local time")
                .on_hover_text("As clocks at the place show it");
            ui.radio_value(&mut self.uses_utc, true, "UTC");
        });
        let clock = self.clock(desk);
        let instant = desk.model.clock.instant;
        let reading = clock.read(&instant);
        for parts in
            [[Part::Year, Part::Month, Part::Day], [Part::Hour, Part::Minute, Part::Second]]
        {
            ui.horizontal(|ui| {
                for part in parts {
                    self.part(ui, desk, clock, &reading, part);
                }
            });
        }
        let offset = signed_offset(reading.offset_s);
        let era = before_christ(reading.civil.year).map_or(String::new(), |era| format!("{era}, "));
        ui.label(format!("{era}{} (UTC{offset})", reading.abbreviation));
        self.julian_date(ui, desk, &instant);
        self.typed.say(ui);
        ui.separator();
        if let Some(date) = self.month.show(ui, clock, &reading.civil) {
            let (year, month, day) = date;
            set(desk, clock, CivilDateTime { year, month, day, ..reading.civil });
        }
    }

    fn part(
        &mut self,
        ui: &mut Ui,
        desk: &mut Desk,
        clock: LocalClock,
        reading: &Reading,
        part: Part,
    ) {
        let civil = reading.civil;
        let (label, shown, width) = part.looks(&civil);
        let field = Field { label, shown: &shown, width };
        match self.typed.field(ui, &field, |text| part.read(text, &civil, clock)) {
            Some(Change::Taken(instant)) => desk.actions.push(Action::SetInstant(instant)),
            Some(Change::Stepped(many)) => part.step(desk, clock, &civil, many),
            None => {}
        }
    }

    fn julian_date(&mut self, ui: &mut Ui, desk: &mut Desk, instant: &Instant) {
        let shown = format!("{:.5}", instant.utc.jd());
        let field = Field { label: "Julian date (UTC)", shown: &shown, width: 110.0 };
        let read = |text: &str| {
            let nonsense = || format!("'{}' is no Julian date; write 2461265.5", text.trim());
            let jd: f64 = text.trim().parse().map_err(|_| nonsense())?;
            Instant::from_utc(JulianDate::from_jd(jd)).map_err(|error| error.to_string())
        };
        ui.horizontal(|ui| match self.typed.field(ui, &field, read) {
            Some(Change::Taken(instant)) => desk.actions.push(Action::SetInstant(instant)),
            Some(Change::Stepped(many)) => desk.actions.push(Action::Step(Step::Day, many)),
            None => {}
        });
        ui.weak(format!("TT − UT1 {:.1} s", instant.delta_t_s()));
    }
}

impl Part {
    /// What it is called, what is in it, and how wide it is.
    fn looks(self, civil: &CivilDateTime) -> (&'static str, String, f32) {
        match self {
            Part::Year => ("Year", civil.year.to_string(), 54.0),
            Part::Month => ("Month", civil.month.to_string(), 36.0),
            Part::Day => ("Day", civil.day.to_string(), 36.0),
            Part::Hour => ("Hour", format!("{:02}", civil.hour), 36.0),
            Part::Minute => ("Minute", format!("{:02}", civil.minute), 36.0),
            Part::Second => ("Second", format!("{:02.0}", civil.second.floor()), 36.0),
        }
    }

    /// The instant when this part is as it was typed.
    fn read(self, text: &str, civil: &CivilDateTime, clock: LocalClock) -> Result<Instant, String> {
        let number = || {
            let nonsense = || format!("'{}' is no number; write whole digits", text.trim());
            text.trim().parse::<u8>().map_err(|_| nonsense())
        };
        let civil = match self {
            Part::Year => with_month(*civil, read_year(text)?, civil.month),
            Part::Month => match number()? {
                month @ 1..=12 => with_month(*civil, civil.year, month),
                month => CivilDateTime { month, ..*civil },
            },
            Part::Day => CivilDateTime { day: number()?, ..*civil },
            Part::Hour => CivilDateTime { hour: number()?, ..*civil },
            Part::Minute => CivilDateTime { minute: number()?, ..*civil },
            Part::Second => {
                let nonsense = || format!("'{}' is no second; write 0 to 59.999", text.trim());
                let second = text.trim().replace(',', ".").parse().map_err(|_| nonsense())?;
                CivilDateTime { second, ..*civil }
            }
        };
        civil.check().and_then(|()| clock.instant(civil)).map_err(|error| error.to_string())
    }

    /// Goes so many up; a time of the day runs on into the next.
    fn step(self, desk: &mut Desk, clock: LocalClock, civil: &CivilDateTime, many: i32) {
        let by_seconds = |desk: &mut Desk, seconds: f64| {
            let instant = desk.model.clock.instant.plus_seconds(seconds * f64::from(many));
            desk.actions.extend(instant.ok().map(Action::SetInstant));
        };
        match self {
            Part::Year => set(desk, clock, plus_months(*civil, 12 * many)),
            Part::Month => set(desk, clock, plus_months(*civil, many)),
            Part::Day => set(desk, clock, plus_days(*civil, many)),
            Part::Hour => by_seconds(desk, 3600.0),
            Part::Minute => by_seconds(desk, 60.0),
            Part::Second => by_seconds(desk, 1.0),
        }
    }
}

/// Sets the clock. Where clocks jumped over the time, an hour later; beyond all dates, not at all.
fn set(desk: &mut Desk, clock: LocalClock, civil: CivilDateTime) {
    let later = || {
        let hour = civil.hour + 1;
        (hour < 24).then(|| clock.instant(CivilDateTime { hour, ..civil }).ok()).flatten()
    };
    let instant = clock.instant(civil).ok().or_else(later);
    desk.actions.extend(instant.map(Action::SetInstant));
}

fn steps(ui: &mut Ui, desk: &mut Desk) {
    ui.strong("Step");
    let steps = [
        (Step::Minute, "minute"),
        (Step::Hour, "hour"),
        (Step::Day, "day"),
        (Step::SiderealDay, "sidereal day"),
        (Step::Week, "week"),
        (Step::Lunation, "lunation"),
        (Step::Year, "year"),
    ];
    Grid::new("steps").num_columns(3).min_col_width(0.0).show(ui, |ui| {
        for (step, name) in steps {
            let article = if step == Step::Hour { "An" } else { "A" };
            for (sign, many, way) in [("−", -1, "back"), ("+", 1, "on")] {
                if named_button(ui, sign, &format!("{article} {name} {way}")).clicked() {
                    desk.actions.push(Action::Step(step, many));
                }
            }
            ui.label(name);
            ui.end_row();
        }
    });
}

fn jumps(ui: &mut Ui, desk: &mut Desk) {
    ui.strong("Jump to");
    let mut rows: Vec<(Jump, String)> = [
        Jump::Sunrise,
        Jump::Sunset,
        Jump::Moonrise,
        Jump::Moonset,
        Jump::NewMoon,
        Jump::FullMoon,
        Jump::LunarEclipse,
        Jump::LunarEclipseHere,
        Jump::SolarEclipse,
        Jump::SolarEclipseHere,
    ]
    .map(|jump| (jump, jump.name().to_owned()))
    .to_vec();
    if let Some(selected) = &desk.model.selected
        && rises(selected)
    {
        for jump in [Jump::Rise, Jump::Transit, Jump::Set] {
            rows.push((jump, format!("{} of {selected}", jump.name())));
        }
    }
    Grid::new("jumps").num_columns(3).min_col_width(0.0).show(ui, |ui| {
        for (jump, name) in rows {
            for (sign, direction, which) in [("‹", -1, "Previous"), ("›", 1, "Next")] {
                if named_button(ui, sign, &format!("{which} {name}")).clicked() {
                    desk.actions.push(Action::Jump(jump, direction));
                }
            }
            ui.label(name);
            ui.end_row();
        }
    });
    if desk.errands.is_jumping() {
        ui.spinner();
    }
}

/// Whether its rise can be looked for.
fn rises(target: &Target) -> bool {
    !matches!(target, Target::Constellation(_) | Target::Messier(_))
}

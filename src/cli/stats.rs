//! What was drawn, what was not and why, and what it cost.

use std::io::{self, Write};
use std::time::Duration;

use crate::air::classic::SkyUnderSun;
use crate::job::picture::Drawn;
use crate::light::night::Night;

/// Writes the statistics of a render.
pub fn write(
    out: &mut dyn Write,
    night: &Night,
    sky: Option<&SkyUnderSun>,
    drawn: Option<&Drawn>,
    steps: &[(&'static str, Duration)],
) -> io::Result<()> {
    writeln!(out, "\nPositions (tier, stated error)")?;
    for state in night.bodies() {
        let error = state.error_bound.arcsec();
        writeln!(
            out,
            "  {:<18} {:<8} {error:>9.1} arcsec",
            state.body.name(),
            state.tier.to_string()
        )?;
    }
    if let Some(sky) = sky {
        writeln!(out, "Sky\n  {}\n  {}", sky.label(), sky.model.fails())?;
    }
    if let Some(drawn) = drawn {
        writeln!(out, "Drawn and skipped")?;
        for entry in &drawn.ledger.entries {
            writeln!(out, "  {:<18} {:>7} drawn", entry.layer, entry.drawn)?;
            for how in &entry.how {
                writeln!(out, "  {:<18} {:>7} {how}", "", "")?;
            }
            for (reason, count) in &entry.skipped {
                writeln!(out, "  {:<18} {count:>7} skipped: {reason}", "")?;
            }
        }
        if let Some(viewer) = &drawn.viewer {
            writeln!(out, "{viewer}")?;
        }
        writeln!(out, "Passes on {}", drawn.adapter)?;
        for (pass, milliseconds) in &drawn.passes {
            writeln!(out, "  {pass:<18} {milliseconds:>9.2} ms")?;
        }
        if drawn.passes.is_empty() {
            writeln!(out, "  not timed: this adapter keeps no time")?;
        }
    }
    writeln!(out, "Steps")?;
    for (step, time) in steps {
        writeln!(out, "  {step:<18} {:>9.2} ms", time.as_secs_f64() * 1e3)?;
    }
    Ok(())
}

//! How the panels and the lines look: pictures of them, kept in `tests/window/pictures`. `make goldens` draws
//! them again; look at them before they are committed. Without a graphics adapter there is nothing to compare.

use egui_kittest::{SnapshotOptions, SnapshotResults};
use nocturne::app::clock::Clock;
use nocturne::app::model::{Model, Overlays, Panel};
use nocturne::render::gpu::Gpu;
use nocturne::time;

use crate::{settle, window_of};

/// Pixels that may differ between drivers: letters have edges.
const FEW: usize = 400;

fn evening() -> Model {
    let instant = time::to_instant(&time::parse("2026-08-13T04:30Z").unwrap(), None).unwrap();
    Model { clock: Clock::at(instant), ..Model::default() }
}

/// What came of it is told when it is dropped, with that of others.
fn compare(results: &mut SnapshotResults, name: &str, model: Model, size: [f32; 2]) {
    if Gpu::new().is_err() {
        return;
    }
    let mut harness = window_of(model, size);
    settle(&mut harness);
    // What is found out beside the window is there.
    for _ in 0..20 {
        std::thread::sleep(std::time::Duration::from_millis(50));
        harness.run_steps(2);
    }
    let options =
        SnapshotOptions::new().output_path("tests/window/pictures").max_failed_pixels(FEW);
    harness.snapshot_options(name, &options);
    results.extend(harness.take_snapshot_results());
}

#[test]
fn panels_look_as_they_did() {
    let mut results = SnapshotResults::new();
    // The inspector tells of the machine.
    let panels = Panel::ALL.into_iter().filter(|panel| *panel != Panel::Inspector);
    for panel in panels {
        let mut model = evening();
        model.panels.set(panel, true);
        let name = format!("panel_{panel:?}").to_lowercase();
        compare(&mut results, &name, model, [820.0, 760.0]);
    }
}

#[test]
fn lines_look_as_they_did() {
    let overlays = Overlays {
        constellation_lines: true,
        constellation_names: true,
        equatorial_grid: true,
        ecliptic: true,
        ..Overlays::default()
    };
    let mut results = SnapshotResults::new();
    compare(&mut results, "lines", Model { overlays, ..evening() }, [1000.0, 640.0]);
    let mut model = Model { overlays, ..evening() };
    model.display.red = true;
    compare(&mut results, "lines_in_red_light", model, [1000.0, 640.0]);
}

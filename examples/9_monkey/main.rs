//! Random input for the window, for as long as one likes: `cargo run --release --example 9_monkey -- 600 1`
//! plays for 600 seconds from seed 1, with pictures drawn but no screen. Twenty times it rests at the sky that
//! it began with, and its memory is measured. It fails on a panic, on a number that is none, and if at the
//! end it rests with a tenth more memory than after the first fifth of the time.

mod monkey;

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use egui_kittest::Harness;
use nocturne::app::model::Model;
use nocturne::app::state::StateFile;
use nocturne::app::{App, Options};
use nocturne::catalog::Catalogs;
use nocturne::memory;
use nocturne::render::Renderer;

use monkey::{Monkey, nonsense};

fn main() -> ExitCode {
    memory::give_back();
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse::<u64>().ok());
    let (seconds, seed) = (numbers.next().unwrap_or(60), numbers.next().unwrap_or(1));
    let catalogs = match Catalogs::locate(None) {
        Ok(catalogs) => catalogs,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    let renderer = Renderer::new().ok().map(Arc::new);
    println!("seed {seed}, {}", renderer.as_ref().map_or("no adapter".to_owned(), |r| r.adapter()));
    let mut harness = Harness::builder().with_size([1280.0, 720.0]).build_eframe(|creation| {
        let state = StateFile::at(None);
        App::new(
            &creation.egui_ctx,
            Options::default(),
            Model::default(),
            state,
            catalogs,
            renderer,
        )
    });
    let begin = Instant::now();
    let mut monkey = Monkey::new(seed);
    let mut acts = 0u64;
    let mut rests_mb: Vec<f64> = Vec::new();
    while rests_mb.len() < RESTS {
        let act = monkey.act(&mut harness);
        harness.run_steps(1);
        acts += 1;
        if let Some(what) = nonsense(harness.state().model()) {
            println!("after act {acts}, {act}: {what}");
            return ExitCode::FAILURE;
        }
        let passed_s = begin.elapsed().as_secs_f64();
        if passed_s >= seconds as f64 * (rests_mb.len() + 1) as f64 / RESTS as f64 {
            rest(&mut harness);
            monkey.size = [1280.0, 720.0];
            rests_mb.push(memory::resident_mib().unwrap_or(0.0));
            let (mb, pictures) = (rests_mb[rests_mb.len() - 1], harness.state().pictures());
            println!(
                "{passed_s:>5.0} s  {acts:>7} acts  {pictures:>6} pictures  {mb:>5.0} MB at rest"
            );
        }
    }
    let (early, late) = rests_mb.split_at(RESTS / 5);
    let most = |rests: &[f64]| rests.iter().copied().fold(0.0, f64::max);
    // The last rest alone: what is given back is no growth.
    let (early_mb, late_mb) = (most(early), late[late.len() - 1]);
    if late_mb > 1.1 * early_mb {
        println!("memory grew from {early_mb:.0} to {late_mb:.0} MB in {acts} acts");
        return ExitCode::FAILURE;
    }
    println!("sound after {acts} acts: {early_mb:.0} MB, then {late_mb:.0} MB");
    ExitCode::SUCCESS
}

/// How often memory is measured.
const RESTS: usize = 20;

/// Shows the sky of the beginning.
fn rest(harness: &mut Harness<App>) {
    *harness.state_mut().model_mut() = Model::default();
    harness.set_size([1280.0, 720.0].into());
    for _ in 0..4 {
        harness.run_steps(2);
        harness.state().wait();
    }
    harness.run_steps(2);
}

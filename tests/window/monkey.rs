//! Random input does no harm. For longer plays see the example `9_monkey`.

#[path = "../../examples/9_monkey/monkey.rs"]
mod hands;

use nocturne::app::model::Model;

use crate::window;
use hands::{Monkey, nonsense};

#[test]
fn a_monkey_does_no_harm() {
    for seed in 1..=3 {
        let mut harness = window(Model::default());
        let mut monkey = Monkey::new(seed);
        for act in 0..150 {
            let what = monkey.act(&mut harness);
            harness.run_steps(1);
            let wrong = nonsense(harness.state().model());
            assert_eq!(wrong, None, "seed {seed}, act {act}: {what}");
        }
    }
}

//! Instructions of the right-hand side, of one step of each method, of the method's own part of it, and of fmi2DoStep,
//! with the compiled-in scene. `cargo xtask bench` counts and prints them.

#![allow(missing_docs, reason = "the macros make public items")]
#![allow(non_snake_case, reason = "the name of the standard")]

#[macro_use]
mod cases;

use cases::{At, Copied, Expanding, Hosted, Stepping, copied, rotor};
use gungraun::{Callgrind, LibraryBenchmarkConfig, library_benchmark, library_benchmark_group, main};
use split_rotor::abi::Status;
use split_rotor::scene::Effects;
use split_rotor_model::integrate::tableau::Tableau;
use split_rotor_model::rotor::Rotor;

/// What a bench works on outlives it: to move it and to free it is not counted.
fn kept<T>(it: T) -> &'static mut T {
    Box::leak(Box::new(it))
}

fn before_a_step<const N: usize>(tableau: &'static Tableau) -> &'static mut Stepping<Rotor<'static, Effects>, N> {
    kept(rotor::<N>().before_a_step(tableau))
}

fn after_a_step(tableau: &'static Tableau) -> &'static mut Stepping<Rotor<'static, Effects>, 12> {
    let stepping = before_a_step(tableau);
    stepping.step();
    stepping
}

fn before_a_free_step(tableau: &'static Tableau) -> &'static mut Stepping<Copied, 12> {
    kept(copied().before_a_step(tableau))
}

#[library_benchmark]
#[bench::equations_12(kept(rotor()))]
fn right_hand_side(at: &mut At<Rotor<'static, Effects>, 12>) -> [f64; 12] {
    at.rates()
}

#[library_benchmark]
#[bench::equations_14(kept(rotor()))]
fn right_hand_side_with_work(at: &mut At<Rotor<'static, Effects>, 14>) -> [f64; 14] {
    at.rates()
}

macro_rules! of_each_method {
    ($($name:ident $tableau:expr,)*) => {
        #[library_benchmark]
        $(#[bench::$name(before_a_step($tableau))])*
        fn step(it: &mut Stepping<Rotor<'static, Effects>, 12>) {
            it.step();
        }

        #[library_benchmark]
        $(#[bench::$name(before_a_step($tableau))])*
        fn step_with_work(it: &mut Stepping<Rotor<'static, Effects>, 14>) {
            it.step();
        }

        #[library_benchmark]
        $(#[bench::$name(after_a_step($tableau))])*
        fn prepare_dense_output(it: &mut Stepping<Rotor<'static, Effects>, 12>) {
            it.prepare_dense();
        }

        #[library_benchmark]
        $(#[bench::$name(before_a_free_step($tableau))])*
        fn step_without_rates(it: &mut Stepping<Copied, 12>) {
            it.step();
        }

        #[library_benchmark]
        $(#[bench::$name(before_a_free_step($tableau))])*
        fn fixed_step_without_rates(it: &mut Stepping<Copied, 12>) {
            it.fixed_step(1e-3);
        }
    };
}

methods!(of_each_method);

#[library_benchmark]
#[bench::order_14(kept(Expanding::at(1e-3)))]
#[bench::order_22(kept(Expanding::at(1e-6)))]
#[bench::order_24(kept(Expanding::at(1e-10)))]
fn step_by_series(it: &mut Expanding) {
    it.step();
}

#[library_benchmark]
#[bench::within_a_step_of_the_solver(kept(Hosted::within_a_step()))]
#[bench::over_a_tenth_of_a_second(kept(Hosted::before_many_steps()))]
fn fmi2DoStep(it: &mut Hosted) -> Status {
    it.do_step()
}

library_benchmark_group!(name = rates, benchmarks = [right_hand_side, right_hand_side_with_work]);
library_benchmark_group!(
    name = steps,
    benchmarks =
        [step, step_with_work, prepare_dense_output, step_without_rates, fixed_step_without_rates, step_by_series]
);
library_benchmark_group!(name = calls, benchmarks = fmi2DoStep);

main!(
    // Where each instruction stands, so that operations can be told from moves.
    config = LibraryBenchmarkConfig::default().tool(Callgrind::with_args(["--dump-instr=yes", "--cache-sim=no"])),
    library_benchmark_groups = [rates, steps, calls]
);

//! Times of what `instructions` counts, with the compiled-in scene. `cargo xtask bench` runs and prints them.

#[macro_use]
mod cases;

use cases::{At, Hosted, LONG, rotor};
use criterion::{BatchSize, Criterion};
use split_rotor::scene::Effects;
use split_rotor_model::integrate::tableau::Tableau;
use split_rotor_model::rotor::Rotor;
use std::hint::black_box;

macro_rules! list {
    ($($name:ident $tableau:expr,)*) => {
        [$((stringify!($name), $tableau)),*]
    };
}

/// The methods.
const METHODS: [(&str, &Tableau); 2] = methods!(list);

fn main() {
    let mut criterion = Criterion::default().without_plots().configure_from_args();
    rates(&mut criterion);
    steps(&mut criterion);
    calls(&mut criterion);
}

fn rates(criterion: &mut Criterion) {
    let mut at: At<Rotor<'static, Effects>, 12> = rotor();
    criterion.bench_function("right hand side, one after another", |bencher| {
        bencher.iter(|| black_box(&at).rates());
    });
    criterion.bench_function("right hand side, each from the last", |bencher| {
        bencher.iter(|| {
            let rates = black_box(&at).rates();
            // So little that the motion stays where it is.
            at.y.iter_mut().zip(rates).for_each(|(y, rate)| *y += 1e-30 * rate);
        });
    });
}

fn steps(criterion: &mut Criterion) {
    for (name, tableau) in METHODS {
        let mut stepping = rotor::<12>().before_a_step(tableau);
        criterion.bench_function(&format!("step on and on, {name}"), |bencher| bencher.iter(|| stepping.step()));
    }
}

fn calls(criterion: &mut Criterion) {
    criterion.bench_function(&format!("fmi2DoStep over {LONG} s"), |bencher| {
        bencher.iter_batched_ref(Hosted::before_many_steps, Hosted::do_step, BatchSize::SmallInput);
    });
}

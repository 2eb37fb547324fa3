//! ode_solvers: DOP853 and DOPRI5, with their defaults. Its dense output extrapolates to the end before it gets there
//! (0.6.2), so it shows its own steps instead, of which only the end counts here: less work than that of others.

use crate::equations::Rotor;
use crate::task::{Motion, Shown, Task};
use ode_solvers::{Dop853, Dopri5, OutputType, SVector, System};

type Vector = SVector<f64, 13>;

impl System<f64, Vector> for Rotor {
    fn system(&self, _t: f64, y: &Vector, dy: &mut Vector) {
        self.rates(&y.data.0[0], &mut dy.data.0[0]);
    }
}

/// Answers the task.
pub fn answer(task: &Task) {
    let times = &task.times;
    let (from, to) = (times[0], times[times.len() - 1]);
    let begin = Vector::from(task.start);
    macro_rules! run {
        ($method:ident) => {
            |tolerance: f64| {
                let mut solver = $method::new(task.rotor, from, to, to - from, begin, tolerance, tolerance);
                solver.set_output(OutputType::Sparse);
                let stats = solver.integrate().map_err(|error| error.to_string())?;
                let end = solver.y_out().last().ok_or("there is no last step")?.data.0[0];
                let (steps, evaluations) = (stats.accepted_steps.into(), stats.num_eval.into());
                Ok(Motion { shown: Shown::End(end), steps, evaluations })
            }
        };
    }
    task.answer("DOP853", run!(Dop853));
    task.answer("DOPRI5", run!(Dopri5));
}

//! differential-equations: DOP853, with its defaults.

use crate::equations::{Rotor, State};
use crate::task::{Motion, Shown, Task};
use differential_equations::prelude::*;

impl ODE<f64, State> for Rotor {
    fn diff(&self, _t: f64, y: &State, dy: &mut State) {
        self.rates(y, dy);
    }
}

/// Answers the task.
pub fn answer(task: &Task) {
    let times = &task.times;
    let (from, to) = (times[0], times[times.len() - 1]);
    task.answer("DOP853", |tolerance| {
        let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(usize::MAX);
        let problem = IVP::ode(&task.rotor, from, to, task.start).t_eval(&times[1..]);
        let solved = problem.method(method).solve().map_err(|error| format!("{error:?}"))?;
        let (steps, evaluations) = (solved.steps.accepted as f64, solved.evals.function as f64);
        Ok(Motion { shown: Shown::All(solved.y), steps, evaluations })
    });
}

//! What `auto` takes, and how much dearer it is than the best.

use super::motion::Errors;
use super::reference::Reference;
use super::row::{Measured, OURS, Row};
use super::sweep::AUTO;
use super::table::{power, short};
use model::scene::{Experiment, Scene};
use model::simulation::{Integrator, Simulation};

/// By what a whole run is judged.
enum Judged {
    /// The worst of axis [rad] and r_c over `l` [m].
    ByPlace { l: f64 },
    /// The worst of the energy [J]: `auto` keeps it in long conservative runs.
    ByEnergy,
}

impl Judged {
    fn of(scene: &Scene, experiment: Experiment) -> Option<Self> {
        let said = said(scene, experiment, None)?;
        if said.contains("keeps the energy") {
            return Some(Self::ByEnergy);
        }
        let l = scene.parameters().setup.rotor.l.abs();
        Some(Self::ByPlace { l: if l > 0.0 { l } else { 1.0 } })
    }

    fn size(&self, worst: &Errors) -> f64 {
        match self {
            Self::ByPlace { l } => worst.axis.max(worst.r_c / l),
            Self::ByEnergy => worst.energy,
        }
    }

    fn words(&self) -> &'static str {
        match self {
            Self::ByPlace { .. } => "the worst of axis [rad] and r_c [l]",
            Self::ByEnergy => "energy",
        }
    }
}

/// What `auto` takes from its loosest to its tightest tolerance, and what it costs beside the cheapest setting that errs no
/// more.
pub fn sentence(scene: &Scene, experiment: Experiment, rows: &[Row], reference: &Reference) -> Option<String> {
    let judged = Judged::of(scene, experiment)?;
    let floor = judged.size(&reference.floor());
    let dearest = dearest(rows, |worst| judged.size(worst).max(floor))?;
    let mut taken: Vec<(String, f64, f64)> = Vec::new();
    for row in rows.iter().filter(|row| row.method == AUTO && row.outcome.is_ok()) {
        let name = choice(scene, experiment, row.value)?;
        match taken.last_mut() {
            Some((last, _, until)) if *last == name => *until = row.value,
            _ => taken.push((name, row.value, row.value)),
        }
    }
    let taken: Vec<_> = taken
        .into_iter()
        .map(|(name, from, until)| match from == until {
            true => format!("{name} at {}", power(from)),
            false => format!("{name} from {} to {}", power(from), power(until)),
        })
        .collect();
    let (row, ratio, best) = dearest;
    Some(format!(
        "auto takes {}. At most, at {}, it is {} times as dear as the cheapest that errs no more in {}: {best}.",
        taken.join(", "),
        power(row.value),
        short(ratio),
        judged.words(),
    ))
}

/// The row of `auto` that is dearest beside the cheapest that errs no more, how much dearer [1], and that one's name.
fn dearest<'r>(rows: &'r [Row], size: impl Fn(&Errors) -> f64) -> Option<(&'r Row, f64, String)> {
    let measured = |row: &'r Row| Some((row, row.outcome.as_ref().ok()?));
    let ours = || rows.iter().filter(|row| row.tool == OURS).filter_map(measured);
    let beside = |(row, m): (&'r Row, &'r Measured)| {
        let good = ours().filter(|(other, o)| other.method != AUTO && size(&o.worst) <= size(&m.worst));
        let (best, b) = good.min_by(|(_, a), (_, b)| a.cpu_time.total_cmp(&b.cpu_time))?;
        Some((row, m.cpu_time / b.cpu_time, format!("{} with {}", best.method, super::table::setting(best))))
    };
    let all = ours().filter(|(row, _)| row.method == AUTO).filter_map(beside);
    all.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// What `auto` says at this tolerance [1], or the scene's.
fn said(scene: &Scene, experiment: Experiment, tolerance: Option<f64>) -> Option<String> {
    let mut parameters = scene.parameters();
    parameters.setup.solver.method_number = model::variables::numbers::AUTO;
    let simulation = Simulation::with(Integrator::Method, parameters);
    simulation.choice(experiment.start, tolerance, Some(experiment.stop))
}

/// The name of the method that it takes at this tolerance [1].
fn choice(scene: &Scene, experiment: Experiment, tolerance: f64) -> Option<String> {
    let said = said(scene, experiment, Some(tolerance))?;
    let name = said.strip_prefix("auto takes ")?.split([':', ' ']).next()?;
    let order = said.split(" in steps of").next()?.rsplit(' ').next().filter(|_| name == "symplectic");
    Some(order.map_or(name.to_owned(), |order| format!("{name} of order {order}")))
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn exact_the_best_errs_no_more_and_is_another() {
        let rows = [
            row(OURS, "a", 1e-3, 1e-2, 1.0),
            row(OURS, "b", 1e-4, 1e-5, 2.0),
            row("peer", "c", 1e-4, 1e-9, 0.1),
            row(OURS, AUTO, 1e-4, 1e-4, 3.0),
            row(OURS, AUTO, 1e-5, 1e-1, 1.25),
            // Nothing else is as good.
            row(OURS, AUTO, 1e-6, 1e-7, 9.0),
        ];
        let (row, ratio, best) = dearest(&rows, |worst| worst.axis).unwrap();
        assert_eq!((row.value, ratio, best.as_str()), (1e-4, 1.5, "b with tolerance = 1e-4"));
    }
}

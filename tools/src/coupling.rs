//! Error and energy error of a machine whose bearings are other models, versus the communication step: for each scheme of coupling and
//! each setting of the FMU, beside the same machine in one model.

pub mod exchange;
pub mod limit;
mod pair;
mod partner;
mod recipe;
mod table;

pub use pair::{SETTINGS, Setting};

use crate::speeds::HIGHEST;
use crate::{rows, run, scenes};
use anyhow::{Context, Result, ensure};
use exchange::{Exact, Outcome, Scheme};
use limit::Linear;
use pair::Pair;
use serde_json::{Value, json};
use split_rotor_model::scene::Scene;
use split_rotor_model::simulation::ORDERS;

/// A run lasts so many periods of the fastest mode, and so many of the slowest, but no more than so many of the fastest.
const PERIODS: f64 = 20.0;
const SLOW_PERIODS: f64 = 1.0;
const MOST_PERIODS: f64 = 100.0;

/// Steps are from this part of the shortest limit of stability to that of the longest one \[1], over two decades at most.
const OF_LIMITS: [f64; 2] = [0.2, 2.5];
const WIDEST: f64 = 100.0;

/// Where there is no limit, from the first to the second of these parts of the fastest period \[1].
const OF_PERIOD: [f64; 2] = [0.004, 0.45];

/// Steps that are easily read: these times powers of ten.
const ROUND: [f64; 6] = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0];

/// A run has at least so many steps.
const FEWEST: f64 = 20.0;

/// A run has at most so many steps.
const MOST: f64 = 200_000.0;

/// Nor are steps longer than so many periods of the fastest mode, which runs must follow.
const MOST_PERIODS_A_STEP: f64 = 20.0;

/// A run of a scheme under a setting at a communication step.
pub struct Tried {
    /// The scheme of coupling.
    pub scheme: Scheme,
    /// The FMU's setting.
    pub setting: Setting,
    /// The communication step \[s].
    pub step: f64,
    /// What the run came to.
    pub outcome: Outcome,
}

/// An error that a user accepts.
pub struct Bound {
    /// As tables call it.
    pub name: &'static str,
    /// \[1].
    pub most: f64,
    /// The error that it bounds.
    pub read: fn(&Outcome) -> Option<f64>,
}

/// What was found.
pub struct Found<'s> {
    /// The scene.
    pub scene: &'s Scene,
    /// The spin at the start [rad/s].
    pub speed: f64,
    /// How long the runs are \[s].
    pub span: f64,
    /// The periods of the fastest and the slowest mode \[s].
    pub periods: [f64; 2],
    /// The communication steps \[s], ascending.
    pub steps: Vec<f64>,
    /// All runs, by scheme, setting and step.
    pub tried: Vec<Tried>,
    /// The longest steps at which the exchange makes nothing grow, by scheme and order \[s]; None where none was found.
    pub longest: [[Option<f64>; ORDERS]; 2],
    pair: Pair,
}

impl<'s> Found<'s> {
    /// Of a scene at a speed [rad/s], else at that of its start or the fastest that it comes to; at these communication steps \[s],
    /// else at some that suit its fastest mode. Before each of the parts, how many there are and which this is are `told`.
    pub fn of(
        scene: &'s Scene,
        speed: Option<f64>,
        steps: Option<Vec<f64>>,
        mut told: impl FnMut(usize, usize),
    ) -> Result<Self> {
        let file = || scene.file.display().to_string();
        let speed = speed.unwrap_or_else(|| usual(scene));
        ensure!(speed.abs() <= HIGHEST, "--speed {speed:?}: a speed must be within ±{HIGHEST:e} rad/s");
        let pair = Pair::of(scene, speed)?;
        let linear = Linear::of(&pair).with_context(file)?;
        let periods = [linear.fastest, linear.slowest];
        ensure!(
            periods[0].is_finite() && periods[0] > 0.0,
            "{}: nothing in this machine moves by itself, so no communication step is too long: give the bearings stiffness or damping",
            file()
        );
        let longest = Scheme::ALL.map(|scheme| std::array::from_fn(|order| linear.longest(scheme, order)));
        let mut steps = steps.unwrap_or_else(|| round(ends(&longest, periods[0])));
        steps.sort_by(f64::total_cmp);
        steps.dedup();
        let [shortest, largest] = [steps[0], steps[steps.len() - 1]];
        ensure!(
            shortest > 0.0 && largest.is_finite(),
            "--steps {shortest}: a communication step must be more than 0 s"
        );
        let slow = (SLOW_PERIODS * periods[1]).min(MOST_PERIODS * periods[0]);
        let span = (PERIODS * periods[0]).max(slow).max(FEWEST * largest);
        ensure!(
            span / shortest <= MOST,
            "--steps {shortest:?} s: a run of {span:.3e} s would take {:.0} steps, and {MOST:.0} are the most: leave out the shortest or the \
             longest steps",
            span / shortest
        );
        let mut tried = Vec::new();
        for (n, &step) in steps.iter().enumerate() {
            told(n, steps.len());
            let exact = Exact::of(&pair, step, span).with_context(file)?;
            ensure!(
                exact.moves(&pair),
                "{}: the motion does not change the loads of {}, so there is nothing to compare: give the scene gravity ([effects.gravity]), \
                 an unbalance ([[effects.unbalance]]), or a start off the middle (start.r_c, start.gamma)",
                file(),
                pair.partners.iter().map(|partner| &*partner.name).collect::<Vec<_>>().join(" and ")
            );
            let settings = || SETTINGS.into_iter().filter(|setting| pair.allows(setting));
            for (scheme, setting) in
                Scheme::ALL.into_iter().flat_map(|scheme| settings().map(move |setting| (scheme, setting)))
            {
                let outcome = exact.beside(&pair, scheme, &setting).with_context(file)?;
                tried.push(Tried { scheme, setting, step, outcome });
            }
        }
        Ok(Self { scene, speed, span, periods, steps, tried, longest, pair })
    }

    /// The runs of a scheme under a setting, by step.
    pub fn series(&self, scheme: Scheme, setting: &Setting) -> impl Iterator<Item = &Tried> {
        self.tried.iter().filter(move |one| one.scheme == scheme && one.setting == *setting)
    }

    /// The longest step that was tried \[s] up to which all errors are within a bound and the FMU never warned.
    pub fn within(&self, scheme: Scheme, setting: &Setting, Bound { most, read, .. }: &Bound) -> Option<f64> {
        let is_within =
            |one: &&Tried| read(&one.outcome).is_some_and(|error| error <= *most) && one.outcome.warned.is_none();
        self.series(scheme, setting).take_while(is_within).last().map(|one| one.step)
    }

    /// For people, in Markdown, with the recipe at its end.
    pub fn table(&self) -> String {
        table::table(self) + &recipe::recipe(self)
    }

    /// A row for each run.
    pub fn rows(&self) -> Vec<rows::Row> {
        let row = |one: &Tried| {
            let Outcome { error, whole, energy, reported, ended, warned, learnt } = &one.outcome;
            vec![
                ("scheme", json!(one.scheme.name())),
                ("setting", json!(one.setting.name)),
                ("step_s", json!(one.step)),
                ("error", json!(error)),
                ("error_whole_run", json!(whole)),
                ("energy_error", json!(energy)),
                ("energy_error_of_ports", json!(reported)),
                ("warned_at_s", json!(warned)),
                ("ports_that_learnt", json!(learnt)),
                ("ended", json!(ended)),
            ]
        };
        self.tried.iter().map(row).collect()
    }

    /// All of it.
    pub fn json(&self) -> Value {
        let partner = |(partner, port): (&partner::Partner, &u32)| {
            let coefficients = partner::NAMES.into_iter().zip(partner.at(self.speed));
            let coefficients: serde_json::Map<_, _> =
                coefficients.map(|(name, value)| (name.to_owned(), json!(value))).collect();
            json!({ "effect": partner.name, "port": port, "position_m": partner.position, "coefficients": coefficients })
        };
        let limits = Scheme::ALL.into_iter().zip(self.longest).flat_map(|(scheme, orders)| {
            let of_order = move |(order, longest)| json!({ "scheme": scheme.name(), "order": order, "longest_stable_step_s": longest });
            orders.into_iter().enumerate().map(of_order)
        });
        json!({
            "scene": self.scene.name,
            "title": self.scene.title,
            "speed_rad_s": self.speed,
            "span_s": self.span,
            "fastest_period_s": self.periods[0],
            "slowest_period_s": self.periods[1],
            "partners": self.pair.partners.iter().zip(&self.pair.ports).map(partner).collect::<Vec<_>>(),
            "limits": limits.collect::<Vec<_>>(),
            "runs": rows::objects(self.rows()),
        })
    }
}

/// The spin of a scene's start, or the fastest that it comes to from rest [rad/s].
fn usual(scene: &Scene) -> f64 {
    let value = scenes::values(scene);
    let imposed = value("imposed_speed.w").filter(|_| value("effects.imposed_speed") != Some(0.0));
    let start = imposed.or(value("start.omega.x")).unwrap_or_default();
    if start == 0.0 { run::fastest(scene) } else { start }
}

/// The shortest and the longest step \[s] that are worth trying, by the limits of stability and the fastest period \[s].
fn ends(longest: &[[Option<f64>; ORDERS]; 2], period: f64) -> [f64; 2] {
    let limits = || longest.iter().flatten().flatten().copied().filter(|limit| *limit > 0.0);
    let [short, long] = [limits().fold(f64::INFINITY, f64::min), limits().fold(0.0, f64::max)];
    if long == 0.0 {
        return OF_PERIOD.map(|part| part * period);
    }
    let to = (OF_LIMITS[1] * long).min(MOST_PERIODS_A_STEP * period);
    [(OF_LIMITS[0] * short).max(to / WIDEST), to]
}

/// Round numbers between these two.
fn round([from, to]: [f64; 2]) -> Vec<f64> {
    let [first, last] = [from, to].map(|end| libm::floor(libm::log10(end)) as i32);
    let all = (first..=last).flat_map(|power| ROUND.map(|digit| format!("{digit}e{power}").parse::<f64>()));
    all.flatten().filter(|step| (from..=to).contains(step)).collect()
}

#[cfg(test)]
mod tests;

//! Whirl frequencies and damping against the spin, critical speeds, and where the machine begins to whirl by itself.

mod sums;
mod table;
mod turning;

use crate::{doubts, rows, speeds};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use split_rotor_model::linear::{Campbell, Crossing, Machine, Obstacle, Point};
use split_rotor_model::scene::Scene;
pub use turning::{Turning, exponents};

/// Speeds that are looked at, unless the user says how many.
pub const STEPS: u32 = 201;

/// Multiples of the speed whose lines are crossed, unless the user says which.
pub const ORDERS: [f64; 2] = [1.0, 2.0];

/// What was found.
pub enum View<'m> {
    /// Of a body that is symmetric about its axis.
    Diagram(Diagram<'m>),
    /// Of one that is not.
    Turning(Turning<'m>),
}

/// Modes against the spin.
pub struct Diagram<'m> {
    /// The scene.
    pub scene: &'m Scene,
    /// Its modes.
    pub campbell: Campbell<'m>,
    /// Of each multiple of the speed, where modes cross it.
    pub critical: Vec<(f64, Vec<Crossing>)>,
    /// Where modes begin or cease to grow.
    pub thresholds: Vec<Crossing>,
}

impl<'m> View<'m> {
    /// Of a scene and its machine, between these speeds [rad/s], at so many of them, with the lines of these multiples of the speed.
    pub fn of(
        scene: &'m Scene,
        machine: &'m Result<Machine, Obstacle>,
        ends: Option<[f64; 2]>,
        steps: u32,
        orders: &[f64],
    ) -> Result<Self> {
        ensure!(orders.iter().all(|order| *order > 0.0), "orders: each must be more than 0");
        let file = || scene.file.display().to_string();
        let machine = match machine {
            Err(Obstacle::Asymmetric) => return Ok(Self::Turning(Turning::of(scene, ends, steps)?)),
            machine => machine.as_ref().map_err(Clone::clone).with_context(file)?,
        };
        let speeds = speeds::on_its_side(scene, Some(machine), ends, steps).with_context(file)?;
        let campbell = Campbell::of(machine, &speeds).with_context(file)?;
        let crossed = |order: &f64| Ok((*order, campbell.critical_speeds(*order).with_context(file)?));
        let critical = orders.iter().map(crossed).collect::<Result<_>>()?;
        let thresholds = campbell.thresholds().with_context(file)?;
        Ok(Self::Diagram(Diagram { scene, campbell, critical, thresholds }))
    }

    /// For people, in Markdown.
    pub fn table(&self) -> String {
        match self {
            Self::Diagram(diagram) => table::table(diagram),
            Self::Turning(turning) => turning.table(),
        }
    }

    /// A row for each mode at each speed.
    pub fn rows(&self) -> Vec<rows::Row> {
        match self {
            Self::Diagram(diagram) => modes(diagram),
            Self::Turning(turning) => turning.rows(),
        }
    }

    /// All of it.
    pub fn json(&self) -> Value {
        match self {
            Self::Diagram(diagram) => json(diagram),
            Self::Turning(turning) => turning.json(),
        }
    }
}

/// A mode's number, as people count.
fn number(branch: usize) -> usize {
    branch + 1
}

impl Diagram<'_> {
    /// On which side of a threshold its mode grows: `above` or `below`.
    fn grows(&self, threshold: &Crossing) -> &'static str {
        let points = &self.campbell.branches[threshold.branch].points;
        let above = points.iter().find(|point| point.speed > threshold.speed);
        if above.is_some_and(|point| point.mode.grows()) { "above" } else { "below" }
    }

    /// Each mode at each speed, with the number of its branch.
    fn points(&self) -> impl Iterator<Item = (usize, &Point)> {
        let branches = self.campbell.branches.iter().enumerate();
        branches.flat_map(|(branch, of)| of.points.iter().map(move |point| (branch, point)))
    }

    /// The mode that grows fastest at any of the speeds, and the number of its branch; None where none grows.
    fn fastest_growth(&self) -> Option<(usize, &Point)> {
        let growing = self.points().filter(|(_, point)| point.mode.grows());
        growing.max_by(|(_, a), (_, b)| a.mode.eigenvalue.re.total_cmp(&b.mode.eigenvalue.re))
    }
}

/// A row for each mode at each speed.
fn modes(diagram: &Diagram) -> Vec<rows::Row> {
    let row = |(branch, point): (usize, &Point)| {
        vec![
            ("speed_rad_s", json!(point.speed)),
            ("mode", json!(number(branch))),
            ("frequency_rad_s", json!(point.mode.frequency())),
            ("damping_ratio", json!(point.mode.damping_ratio())),
            ("direction", json!(point.mode.direction.name())),
            ("growth_rate_1_s", json!(point.mode.eigenvalue.re)),
        ]
    };
    diagram.points().map(row).collect()
}

fn json(diagram: &Diagram) -> Value {
    let crossing = |crossing: &Crossing| {
        json!({
            "mode": number(crossing.branch),
            "speed_rad_s": crossing.speed,
            "frequency_rad_s": crossing.mode.frequency(),
            "damping_ratio": crossing.mode.damping_ratio(),
            "direction": crossing.mode.direction.name(),
            "sense": crossing.mode.sense,
            "held": doubts::held(diagram.scene, [crossing.speed; 2]),
        })
    };
    let threshold = |one: &Crossing| {
        let mut row = crossing(one);
        row["grows"] = json!(diagram.grows(one));
        row
    };
    let all = |crossings: &[Crossing]| crossings.iter().map(crossing).collect::<Vec<_>>();
    let critical = diagram.critical.iter().map(|(order, speeds)| json!({ "order": order, "speeds": all(speeds) }));
    let steady = diagram.campbell.steady.iter().map(|steady| {
        json!({
            "speed_rad_s": steady.speed,
            "r_m": steady.r.as_slice(),
            "gamma_rad": steady.gamma.as_slice(),
            "torque_N_m": steady.torque,
        })
    });
    json!({
        "scene": diagram.scene.name,
        "title": diagram.scene.title,
        "tables": doubts::tables(diagram.scene),
        "critical_speeds": critical.collect::<Vec<_>>(),
        "thresholds": diagram.thresholds.iter().map(threshold).collect::<Vec<_>>(),
        "steady_states": steady.collect::<Vec<_>>(),
        "modes": rows::objects(modes(diagram)),
    })
}

#[cfg(test)]
mod tests {
    use super::View;
    use split_rotor_model::linear::Machine;
    use split_rotor_model::scene::Scene;
    use std::path::Path;

    #[test]
    fn regress_an_unstable_rotor_is_not_called_stable() {
        let text = "[rotor]\nm = 6.0\nJa = 0.01\nJt = 0.06\n[start]\nomega.x = 100.0\n\
            [[effects.bearing]]\nposition = 0.15\nkyy = -2e5\nkzz = -2e5\n";
        let scene = Scene::parse(Path::new("unseen.toml"), text).expect("a scene");
        let machine = Machine::of(&scene.parameters());
        let view = View::of(&scene, &machine, Some([50.0, 500.0]), 201, &[1.0]).expect("a view");
        let table = view.table();
        assert!(!table.contains("No mode grows") && table.contains("grows from 50.0000 to 500.000 rad/s"), "{table}");
        let View::Diagram(diagram) = &view else { panic!("it is symmetric") };
        let at_100 = diagram.campbell.branches.iter().flat_map(|branch| &branch.points);
        let at_100 = at_100.filter(|point| (point.speed - 100.0).abs() < 2.3);
        let fastest = at_100.map(|point| point.mode.eigenvalue.re).fold(0.0, f64::max);
        assert!((fastest / 329.0 - 1.0).abs() < 0.01, "{fastest}");
        assert!(table.contains("Looked at 201 speeds from 50.0000 to 500.000 rad/s"), "{table}");
    }

    /// Nothing holds it along its axis and hardly anything against tilt: most eigenvalues are 0, several times.
    #[test]
    fn regress_modes_of_a_rotor_that_little_holds_are_found() {
        let text = "[rotor]\nm = 0.04137062437606416\nJa = 3.276427728927653e-07\nJt = 9.047750476222938e-06\n\
            [start]\nomega.x = -4.3766854485207025\n[[effects.bearing]]\nposition = -0.00020838291646904156\n\
            kyy = -240.70443706475228\nkzz = -240.70443706475228\n";
        let scene = Scene::parse(Path::new("little.toml"), text).expect("a scene");
        let machine = Machine::of(&scene.parameters());
        for steps in [11, 101, 500] {
            let View::Diagram(diagram) = View::of(&scene, &machine, None, steps, &[1.0]).expect("a view") else {
                panic!("it is symmetric")
            };
            let points = diagram.campbell.branches.iter().flat_map(|branch| &branch.points);
            let fastest = points.map(|point| point.mode.eigenvalue.re).fold(0.0, f64::max);
            // sqrt(k/m), but for how little the spring is off c
            let exact = (240.70443706475228_f64 / 0.04137062437606416).sqrt();
            assert!((fastest / exact - 1.0).abs() < 1e-2, "{steps} steps: {fastest} for {exact}");
        }
    }
}

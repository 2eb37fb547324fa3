//! A scene with what comes in over time, as a value and as a text that a user can run.

use crate::harness::named::toml;
use oracles::machine::{Input, Machine};
use std::fmt::Write;

/// An input that is set at a communication point: its value there and two derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Change {
    /// When [s].
    pub t: f64,
    /// Which.
    pub input: Input,
    /// In the input's unit, per second and per second².
    pub terms: [f64; 3],
}

/// Springs and dampers of another model at the ports: f = −k q − c dq/dt across e, reckoned from what the ports show.
#[derive(Clone, Debug)]
pub struct Partner {
    /// Loads are exchanged every so often [s].
    pub every: f64,
    /// Stiffness [N/m] and damping [N·s/m] at each port.
    pub springs: Vec<[f64; 2]>,
    /// Whether loads are exchanged at the start too; else they are 0 until the first exchange.
    pub from_start: bool,
}

/// A scene to be tried.
#[derive(Clone, Debug)]
pub struct Trial {
    /// What it is, in a word or two.
    pub name: String,
    /// The rotor and what acts on it.
    pub machine: Machine,
    /// Where probes look along t [m].
    pub probes: Vec<f64>,
    /// What is set, in the order of time.
    pub changes: Vec<Change>,
    /// Who answers at the ports.
    pub partner: Option<Partner>,
    /// When it is looked at [s]; the last is the end.
    pub points: Vec<f64>,
    /// Whether the run is told its end.
    pub knows_end: bool,
    /// It is judged by what it shows from here on [s], by how far it moves there.
    pub judged_from: f64,
}

/// A communication point.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// [s].
    pub t: f64,
    /// Whether it is looked at there.
    pub shown: bool,
    /// Whether loads are exchanged there.
    pub exchanged: bool,
}

impl Trial {
    /// Of a machine that is left alone, looked at these times.
    pub fn new(name: &str, machine: Machine, points: Vec<f64>) -> Self {
        Self {
            name: name.into(),
            machine,
            probes: Vec::new(),
            changes: Vec::new(),
            partner: None,
            points,
            knows_end: true,
            judged_from: 0.0,
        }
    }

    /// The end [s].
    pub fn end(&self) -> f64 {
        *self.points.last().expect("a trial is looked at")
    }

    /// All communication points from 0 on.
    pub fn grid(&self) -> Vec<Point> {
        let end = self.end();
        let at = |t: f64, shown: bool, exchanged: bool| Point { t, shown, exchanged };
        let mut all = vec![at(0.0, true, self.partner.as_ref().is_some_and(|partner| partner.from_start))];
        all.extend(self.points.iter().map(|t| at(*t, true, false)));
        all.extend(self.changes.iter().map(|change| at(change.t, false, false)));
        if let Some(Partner { every, .. }) = self.partner {
            all.extend((1..).map(|k| every * f64::from(k)).take_while(|t| *t < end).map(|t| at(t, false, true)));
        }
        all.sort_by(|a, b| a.t.total_cmp(&b.t));
        all.dedup_by(|next, before| {
            let same = next.t == before.t;
            before.shown |= same && next.shown;
            before.exchanged |= same && next.exchanged;
            same
        });
        all
    }

    /// The scene as a text; what is set over time stands in comments.
    pub fn text(&self) -> String {
        let mut text = format!("title = \"{}\"\n{}", self.name, toml(&self.machine.settings()));
        let mut line = |what: String| writeln!(text, "{what}").expect("a text can be written to");
        for position in &self.probes {
            line(format!("[[effects.probe]]\nposition = {position:?}"));
        }
        line(format!("[experiment]\nstop = {:?}\nstep = {:?}", self.end(), self.end() / 100.0));
        for Change { t, input, terms: [value, slope, curvature] } in &self.changes {
            let derivatives = match (slope, curvature) {
                (0.0, 0.0) => String::new(),
                _ => format!(", derivatives {slope:?}, {curvature:?}"),
            };
            line(format!("# at t = {t:?}: {} = {value:?}{derivatives}", input.name()));
        }
        if let Some(Partner { every, springs, from_start }) = &self.partner {
            let first = if *from_start { "from t = 0 on" } else { "but not at t = 0" };
            line(format!("# every {every:?} s, {first}:"));
            for (n, [k, c]) in springs.iter().enumerate() {
                line(format!("# port[{0}].f.y, z = -{k:?} port[{0}].r.y, z - {c:?} port[{0}].v.y, z", n + 1));
            }
        }
        let known = if self.knows_end { "is told its end" } else { "is not told its end" };
        line(format!("# {} communication points; the run {known}", self.grid().len()));
        text
    }
}

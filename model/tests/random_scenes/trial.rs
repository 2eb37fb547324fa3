//! A scene with what comes in over time, as a value and as a text that a user can run.

use crate::oracles::machine::{Input, Machine, Unbalance};
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
        let Machine { m, Ja, Jt, l, start, .. } = &self.machine;
        let mut text =
            format!("title = \"{}\"\n\n[rotor]\nm = {m:?}\nJa = {Ja:?}\nJt = {Jt:?}\nl = {l:?}\n", self.name);
        let vector = |v: &[f64]| {
            let named: Vec<_> = ["x", "y", "z"].iter().zip(v).map(|(name, x)| format!("{name} = {x:?}")).collect();
            format!("{{ {} }}", named.join(", "))
        };
        let mut line = |what: String| writeln!(text, "{what}").expect("a text can be written to");
        line(format!("\n[start]\nr_c = {}\nv_c = {}", vector(start.r_c.as_slice()), vector(start.v_c.as_slice())));
        line(format!("phi = {:?}\ngamma = {{ y = {:?}, z = {:?} }}", start.phi, start.gamma.x, start.gamma.y));
        line(format!("omega = {}", vector(start.omega.as_slice())));
        let machine = &self.machine;
        if let Some(g) = &machine.gravity {
            line(format!("\n[effects.gravity]\ng = {}", vector(g.as_slice())));
        }
        if let Some(support) = machine.support {
            let ([c1, c2], [d1, d2]) = (support.c, support.d);
            line(format!("\n[effects.support]\nc1 = {c1:?}\nc2 = {c2:?}\nd1 = {d1:?}\nd2 = {d2:?}"));
        }
        if machine.drive {
            line(format!("\n[effects.{DRIVE}]\ntau = {:?}", self.at_start(Input::Torque)));
        }
        if let Some(other) = machine.Jt2 {
            line(format!("\n[effects.asymmetry]\nJt2 = {other:?}"));
        }
        for Unbalance { mass, radius, angle, position } in &machine.unbalances {
            line(format!("\n[[effects.unbalance]]\nmass = {mass:?}\nradius = {radius:?}"));
            line(format!("angle = {angle:?}\nposition = {position:?}"));
        }
        for bearing in &machine.bearings {
            line(format!("\n[[effects.bearing]]\nposition = {:?}", bearing.position));
            for (name, [[yy, yz], [zy, zz]]) in [("k", bearing.k), ("c", bearing.c)] {
                line(format!("{name}yy = {yy:?}\n{name}yz = {yz:?}\n{name}zy = {zy:?}\n{name}zz = {zz:?}"));
            }
            let ([kxx, cxx], [kt, ct]) = (bearing.axial, bearing.tilt);
            line(format!("kxx = {kxx:?}\ncxx = {cxx:?}\nkt = {kt:?}\nct = {ct:?}"));
        }
        if let Some([d, position]) = machine.rotating_damping {
            line(format!("\n[effects.rotating_damping]\nd = {d:?}\nposition = {position:?}"));
        }
        if let Some([linear, quadratic]) = machine.drag {
            line(format!("\n[effects.drag]\nlinear = {linear:?}\nquadratic = {quadratic:?}"));
        }
        for position in &self.probes {
            line(format!("\n[[effects.probe]]\nposition = {position:?}"));
        }
        for (n, position) in machine.ports.iter().enumerate() {
            let f = [0, 1, 2].map(|axis| self.at_start(Input::Force(n, axis)));
            let m = [0, 1, 2].map(|axis| self.at_start(Input::Moment(n, axis)));
            line(format!("\n[[effects.port]]\nposition = {position:?}\nf = {}\nm = {}", vector(&f), vector(&m)));
        }
        if machine.imposed_speed {
            let [w, a] = [Input::Speed, Input::Acceleration].map(|input| self.at_start(input));
            line(format!("\n[effects.imposed_speed]\nw = {w:?}\na = {a:?}"));
        }
        if let Some([order, lag]) = machine.extrapolation {
            line(format!("\n[effects.extrapolation]\norder = {order}\nlag = {lag}"));
        }
        line(format!("\n[experiment]\nstop = {:?}\nstep = {:?}", self.end(), self.end() / 100.0));
        for Change { t, input, terms: [value, slope, curvature] } in &self.changes {
            let derivatives = match (slope, curvature) {
                (0.0, 0.0) => String::new(),
                _ => format!(", derivatives {slope:?}, {curvature:?}"),
            };
            line(format!("# at t = {t:?}: {} = {value:?}{derivatives}", name_of(*input)));
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

    /// An input at the start.
    fn at_start(&self, input: Input) -> f64 {
        self.machine.inputs.iter().find(|(name, _)| *name == input).map_or(0.0, |(_, value)| *value)
    }
}

/// The effect that passes on a torque.
const DRIVE: &str = "drive";

/// The name of an input's variable.
pub fn name_of(input: Input) -> String {
    let axis = |n: usize| ["x", "y", "z"][n];
    match input {
        Input::Torque => format!("{DRIVE}.tau"),
        Input::Speed => "imposed_speed.w".into(),
        Input::Acceleration => "imposed_speed.a".into(),
        Input::Force(port, n) => format!("port[{}].f.{}", port + 1, axis(n)),
        Input::Moment(port, n) => format!("port[{}].m.{}", port + 1, axis(n)),
    }
}

//! Rotors with several effects in the general FMU, beside the oracle that knows all laws.

use super::bench::{Bench, Rotor};
use super::case::{Found, Task};
use anyhow::{Result, ensure};
use nalgebra::Vector3;
use oracles::machine::{Machine, Pace, Run, Shown};
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// A step of the oracle errs by so much of the motion \[1].
const STEP: f64 = 1e-13;

/// A rotor, when it is looked at, and what partners do at its ports.
pub struct Scene {
    /// The rotor.
    pub machine: Machine,
    /// When it is looked at \[s].
    pub times: Vec<f64>,
    /// Springs [N/m] and dampers [N·s/m] at the ports, f = −k r − c v across e, reckoned at each time from what the ports
    /// show there; zero until the first.
    pub partners: Vec<[f64; 2]>,
}

/// What a partner answers to place \[m] and velocity [m/s] of its port: force along y and z \[N].
fn answer([r, v]: &[Vector3<f64>; 2], [k, c]: &[f64; 2]) -> [f64; 2] {
    let force = -(r * *k + v * *c);
    [force.y, force.z]
}

impl Scene {
    /// Of a rotor without partners.
    pub fn alone(machine: Machine, times: Vec<f64>) -> Self {
        Self { machine, times, partners: Vec::new() }
    }

    /// What the oracle shows at the start and at all times.
    pub fn exact(&self) -> Result<Vec<Shown>> {
        use oracles::machine::Input::Force;
        let mut run = Run::new(&self.machine, Pace::Adaptive(STEP));
        let mut shown = vec![run.show()];
        for t in &self.times {
            ensure!(run.advance(*t), "the oracle has no motion at {t} s");
            shown.push(run.show());
            for (n, partner) in self.partners.iter().enumerate() {
                for (axis, force) in answer(&run.port(n), partner).into_iter().enumerate() {
                    run.set(Force(n, axis + 1), [force, 0.0, 0.0]);
                }
            }
        }
        Ok(shown)
    }

    /// The same in the FMU, from a rotor that is set and started.
    pub fn shown(&self, rotor: &mut Rotor) -> Result<Vec<Shown>> {
        let mut shown = vec![shown(rotor)?];
        for t in &self.times {
            rotor.advance(*t)?;
            shown.push(self::shown(rotor)?);
            for (n, partner) in self.partners.iter().enumerate() {
                let at = |what: &str| ["x", "y", "z"].map(|axis| format!("port[{}].{what}.{axis}", n + 1));
                let [r, v] = [rotor.read(&at("r"))?, rotor.read(&at("v"))?].map(Vector3::from);
                for (axis, force) in ["y", "z"].iter().zip(answer(&[r, v], partner)) {
                    rotor.set(&format!("port[{}].f.{axis}", n + 1), force)?;
                }
            }
        }
        Ok(shown)
    }

    /// The task to run it beside the oracle, whose motion `known` must be true of.
    pub fn task(self, known: impl Fn(&[Shown]) -> Result<()> + Sync + 'static) -> Task {
        let exact = OnceLock::new();
        Box::new(move |bench| {
            let mut rotor = started(bench, &self.machine, self.times[self.times.len() - 1])?;
            let shown = self.shown(&mut rotor)?;
            if exact.get().is_none() {
                let shown = self.exact()?;
                known(&shown)?;
                let _ = exact.set(shown);
            }
            Ok(error(&shown, exact.get().expect("it was set")))
        })
    }
}

/// A rotor with the settings of a machine, started for a run to `stop` \[s].
pub fn started<'b>(bench: &'b Bench<'b>, machine: &Machine, stop: f64) -> Result<Rotor<'b>> {
    let mut rotor = bench.rotor(&[("effects.gravity", 0.0), ("effects.support", 0.0)])?;
    for (name, value) in machine.settings() {
        let effect = name.split('.').next().unwrap_or_default();
        if !["rotor", "start"].contains(&effect) {
            rotor.set(&format!("effects.{effect}"), 1.0)?;
        }
        rotor.set(&name, value)?;
    }
    for port in 1..=machine.ports.len() {
        // The oracle holds loads.
        rotor.set(&format!("port[{port}].learn"), 0.0)?;
    }
    rotor.start(0.0, stop)?;
    Ok(rotor)
}

/// What the FMU shows, as the oracle does but for the velocities.
pub fn shown(rotor: &Rotor) -> Result<Shown> {
    let shown = rotor.shown()?;
    ensure!(shown.residual.is_finite(), "no number");
    let phi = TAU * shown.turns + shown.angle;
    Ok(Shown { r_c: shown.r_c, v_c: Vector3::zeros(), axis: shown.axis, omega: Vector3::zeros(), phi })
}

/// How far apart two motions are.
type Apart<'a> = &'a dyn Fn(&Shown, &Shown) -> f64;

/// The largest error of place across e and of the axis over how far each goes, and of φ over how far it turns, but 1 rad at
/// least.
pub fn error(shown: &[Shown], exact: &[Shown]) -> Found {
    let across = |v: Vector3<f64>| libm::hypot(v.y, v.z);
    let most = |of: Apart, pairs: &mut dyn Iterator<Item = (&Shown, &Shown)>| {
        pairs.map(|(a, b)| of(a, b)).fold(0.0, |most: f64, x| if x > most || x.is_nan() { x } else { most })
    };
    let mut found = Found::nothing();
    let ways: [(&str, f64, Apart); 3] = [
        ("place over its size", 0.0, &|a, b| across(a.r_c - b.r_c)),
        ("axis over its size", 0.0, &|a, b| (a.axis - b.axis).norm()),
        ("φ over its size", 1.0, &|a, b| (a.phi - b.phi).abs()),
    ];
    for (of, least, way) in ways {
        let size = most(way, &mut exact.iter().map(|now| (now, &exact[0]))).max(least);
        let off = most(way, &mut shown.iter().zip(exact));
        found = found.or(if off == 0.0 { 0.0 } else { off / size }, of);
    }
    found
}

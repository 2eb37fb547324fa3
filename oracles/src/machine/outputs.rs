//! What a machine shows beside its motion: loads, torques, energies and stations, by the names that the library gives them.

use super::laws::{Laws, Motion, State, at, vector};
use super::{Machine, Run};
use crate::rigid_body::joint;
use crate::rotation;
use nalgebra::Vector3;

/// What an output is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    /// How far it goes from its first value.
    Excursion,
    /// How large it is.
    Size,
    /// How large the kinetic energy is and how far the potential one goes.
    Energy,
}

impl Machine {
    /// How far the mass centre may be off the axis at most \[m].
    pub fn eccentricity(&self) -> f64 {
        self.unbalances.iter().map(|one| one.mass / self.m * one.radius).sum()
    }

    /// The names of its outputs, vectors without their axes, in the order of [`Run::outputs`], and with what each is compared; probes stand
    /// at these places \[m].
    pub fn outputs(&self, probes: &[f64]) -> Vec<(String, Beside)> {
        let each = |kind: &str, count: usize, of: &[&str]| -> Vec<_> {
            (1..=count).flat_map(|n| of.iter().map(move |of| format!("{kind}[{n}].{of}")).collect::<Vec<_>>()).collect()
        };
        let mut loads: Vec<String> = Vec::new();
        if self.support.is_some() {
            loads.extend(["support.F", "support.M"].map(String::from));
        }
        loads.extend(each("bearing", self.bearings.len(), &["F"]));
        loads.extend(each("rub", self.rubs.len(), &["F"]));
        let torques = [(self.motor.is_some(), "motor.tau"), (self.imposed_speed, "imposed_speed.tau")];
        loads.extend(torques.iter().filter(|(acts, _)| *acts).map(|(_, name)| String::from(*name)));
        let stations = [each("port", self.ports.len(), &["r", "v"]), each("probe", probes.len(), &["r", "v"])].concat();
        let excursions = loads.into_iter().chain(["v_c".into()]).chain(stations).map(|name| (name, Beside::Excursion));
        let sizes = ["omega", "omega_phi"].map(|name| (name.into(), Beside::Size));
        let energies = ["energy.kinetic", "energy.potential"].map(|name| (name.into(), Beside::Energy));
        excursions.chain(sizes).chain(energies).collect()
    }
}

impl Run {
    /// The outputs now; a number stands along x, and what a vector does not have is 0.
    pub fn outputs(&self, machine: &Machine, probes: &[f64]) -> Vec<Vector3<f64>> {
        let (laws, y) = (&self.laws, &self.y);
        let motion = laws.motion(y);
        let number = |value: f64| Vector3::new(value, 0.0, 0.0);
        let mut all = laws.loads_shown(machine, &motion);
        if machine.motor.is_some() {
            all.push(number(laws.motor(self.t, &motion, &self.inputs, y[at::TORQUE])[0]));
        }
        if machine.imposed_speed {
            all.push(number(laws.imposing(self.t, y, &self.inputs)));
        }
        // Along e only rounding may move it.
        all.push(Vector3::new(0.0, motion.v_c.y, motion.v_c.z));
        all.extend(machine.ports.iter().flat_map(|p| motion.station(*p)));
        // A probe looks across e.
        all.extend(probes.iter().flat_map(|p| motion.station(*p).map(|v| Vector3::new(0.0, v.y, v.z))));
        all.extend([motion.omega, number(motion.speed())]);
        let [kinetic, potential] = laws.energies(y);
        all.extend([kinetic, potential].map(number));
        all
    }
}

impl Laws {
    /// The loads of supports, bearings and rings, as [`Run::outputs`] begins with them.
    pub(super) fn loads_shown(&self, machine: &Machine, motion: &Motion) -> Vec<Vector3<f64>> {
        let (mut all, axis) = (Vec::new(), motion.axis());
        let gamma = rotation::gamma(&axis);
        let lean = Vector3::new(0.0, gamma.x, gamma.y);
        if let Some(support) = machine.support {
            all.push(self.spring_force(self.springs.len() - 1, motion));
            all.push(-(lean * support.c[1] + axis.cross(&motion.t_rate) * support.d[1]));
        }
        let mut tables = self.tables.iter();
        for (n, bearing) in machine.bearings.iter().enumerate() {
            let table = if bearing.table.is_empty() { None } else { tables.next() };
            let of_table = table.map(|table| table.force(&motion.station(table.p), motion.speed()));
            all.push(self.spring_force(n, motion) + of_table.unwrap_or_default());
        }
        for (rub, presses) in &self.rubs {
            all.push(if *presses {
                rub.load(&motion.station(rub.position), motion.speed()).0
            } else {
                Vector3::zeros()
            });
        }
        all
    }

    /// Kinetic and potential energy \[J].
    fn energies(&self, y: &State) -> [f64; 2] {
        let motion = self.motion(y);
        let (v, k) = (vector(y, at::V), vector(y, at::K));
        let kinetic = 0.5 * (self.mass * v.norm_squared() + motion.omega.dot(&k));
        let mut potential = -self.mass * self.gravity.dot(&vector(y, at::R));
        for spring in &self.springs {
            let [r, _] = motion.station(spring.p);
            let x = r.x - spring.x;
            let [[kyy, kyz], [kzy, kzz]] = spring.k;
            // The skew part has no energy.
            let across = kyy * r.y * r.y + kzz * r.z * r.z + (kyz + kzy) * r.y * r.z;
            potential += 0.5 * (spring.axial[0] * x * x + across);
        }
        potential += 0.5 * self.tilt[0] * rotation::gamma(&motion.axis()).norm_squared();
        for (rub, _) in &self.rubs {
            let [r, _] = motion.station(rub.position);
            let depth = (libm::hypot(r.y, r.z) - rub.gap).max(0.0);
            potential += 0.5 * rub.stiffness * depth * depth;
        }
        [kinetic, potential]
    }

    /// The torque along n of what imposes the speed \[N·m].
    fn imposing(&self, t: f64, y: &State, inputs: &super::inputs::Inputs) -> f64 {
        // dK/dt is all moments about G; the rest of them is that of the same machine which nothing imposes.
        let free = self.unimposed();
        let moment = |laws: &Self| vector(&laws.rates(t, y, inputs), at::K);
        let n = joint(&self.motion(y).axis());
        (moment(self) - moment(&free)).dot(&n) / n.norm_squared()
    }
}

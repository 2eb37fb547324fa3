//! What a machine is called in a scene: the names of its variables, and their values.

use super::{Bearing, Input, Machine, Motor, Node, Rub, Support, Unbalance};
use nalgebra::Vector3;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Of a table.
const COLUMNS: [&str; 8] = ["kyy", "kyz", "kzy", "kzz", "cyy", "cyz", "czy", "czz"];

impl Input {
    /// The name of its variable.
    pub fn name(self) -> String {
        match self {
            Self::Torque => "drive.tau".into(),
            Self::Command => "motor.command".into(),
            Self::Speed => "imposed_speed.w".into(),
            Self::Acceleration => "imposed_speed.a".into(),
            Self::Force(port, n) => format!("port[{}].f.{}", port + 1, AXES[n]),
            Self::Moment(port, n) => format!("port[{}].m.{}", port + 1, AXES[n]),
        }
    }
}

/// Names and values so far.
#[derive(Default)]
struct Settings(Vec<(String, f64)>);

impl Settings {
    fn of(&mut self, what: &str, values: &[(&str, f64)]) {
        self.0.extend(values.iter().map(|(name, value)| (format!("{what}.{name}"), *value)));
    }

    /// Column by column, the nodes counted from 1.
    fn table(&mut self, of: &str, table: &[Node]) {
        let mut column = |name: &str, value: &dyn Fn(&Node) -> f64| {
            (1..).zip(table).for_each(|(n, node)| self.0.push((format!("{of}.{name}[{n}]"), value(node))));
        };
        column("speed", &|node| node.speed);
        for (n, name) in COLUMNS.iter().enumerate() {
            column(name, &|node| node.values()[n]);
        }
    }

    fn vector(&mut self, name: &str, v: &Vector3<f64>) {
        self.0.extend(AXES.iter().zip(v).map(|(axis, value)| (format!("{name}.{axis}"), *value)));
    }
}

impl Machine {
    /// Its parameters and the inputs that it starts with; those of an effect stand together, each effect has one at least.
    pub fn settings(&self) -> Vec<(String, f64)> {
        let mut all = Settings::default();
        let Self { m, Ja, Jt, l, start, .. } = self;
        all.of("rotor", &[("m", *m), ("Ja", *Ja), ("Jt", *Jt), ("l", *l)]);
        all.vector("start.r_c", &start.r_c);
        all.vector("start.v_c", &start.v_c);
        all.of("start", &[("phi", start.phi), ("gamma.y", start.gamma.x), ("gamma.z", start.gamma.y)]);
        all.vector("start.omega", &start.omega);
        if let Some(g) = &self.gravity {
            all.vector("gravity.g", g);
        }
        if let Some(Support { c: [c1, c2], d: [d1, d2] }) = self.support {
            all.of("support", &[("c1", c1), ("c2", c2), ("d1", d1), ("d2", d2)]);
        }
        if let Some(other) = self.Jt2 {
            all.of("asymmetry", &[("Jt2", other)]);
        }
        for (n, Unbalance { mass, radius, angle, position }) in (1..).zip(&self.unbalances) {
            let values = [("mass", *mass), ("radius", *radius), ("angle", *angle), ("position", *position)];
            all.of(&format!("unbalance[{n}]"), &values);
        }
        for (n, Bearing { position, k, c, axial, tilt, table }) in (1..).zip(&self.bearings) {
            let bearing = format!("bearing[{n}]");
            all.of(&bearing, &[("position", *position), ("kxx", axial[0]), ("cxx", axial[1])]);
            all.of(&bearing, &[("kt", tilt[0]), ("ct", tilt[1])]);
            for (name, [[yy, yz], [zy, zz]]) in [("k", k), ("c", c)] {
                let values = [("yy", *yy), ("yz", *yz), ("zy", *zy), ("zz", *zz)];
                values.iter().for_each(|(axes, value)| all.of(&bearing, &[(&format!("{name}{axes}"), *value)]));
            }
            all.table(&bearing, table);
        }
        if let Some([d, position]) = self.rotating_damping {
            all.of("rotating_damping", &[("d", d), ("position", position)]);
        }
        if let Some([linear, quadratic]) = self.drag {
            all.of("drag", &[("linear", linear), ("quadratic", quadratic)]);
        }
        for (n, rub) in (1..).zip(&self.rubs) {
            let Rub { position, gap, stiffness, damping, friction, radius, v0 } = *rub;
            let ring = [("position", position), ("gap", gap), ("stiffness", stiffness), ("damping", damping)];
            all.of(&format!("rub[{n}]"), &ring);
            all.of(&format!("rub[{n}]"), &[("friction", friction), ("radius", radius), ("v0", v0)]);
        }
        if let Some(Motor { stall_torque, synchronous_speed, time_constant }) = self.motor {
            let values = [("stall_torque", stall_torque), ("synchronous_speed", synchronous_speed)];
            all.of("motor", &values);
            all.of("motor", &[("time_constant", time_constant)]);
            let command = self.inputs.iter().find(|(input, _)| *input == Input::Command);
            command.into_iter().for_each(|(input, value)| all.0.push((input.name(), *value)));
        }
        if let Some([order, lag]) = self.extrapolation {
            all.of("extrapolation", &[("order", order as f64), ("lag", lag as f64)]);
        }
        let mut inputs = Vec::new();
        if self.drive {
            inputs.push(Input::Torque);
        }
        if self.imposed_speed {
            inputs.extend([Input::Speed, Input::Acceleration]);
        }
        let of_start = |input: Input| self.inputs.iter().find(|(known, _)| *known == input).map(|(_, value)| *value);
        all.0.extend(inputs.into_iter().map(|input| (input.name(), of_start(input).unwrap_or(0.0))));
        for (n, position) in self.ports.iter().enumerate() {
            all.of(&format!("port[{}]", n + 1), &[("position", *position)]);
            let loads = [0, 1, 2].map(|axis| [Input::Force(n, axis), Input::Moment(n, axis)]).concat();
            all.0.extend(loads.into_iter().filter_map(|load| Some((load.name(), of_start(load)?))));
        }
        all.0
    }
}

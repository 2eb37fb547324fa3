//! Rotors that are unbalanced or not symmetric, as an oracle and as a scene.

use super::named::{Named, toml};
use nalgebra::{Vector2, Vector3};
use oracles::machine::{Machine, Start, Support, Unbalance};
use oracles::rigid_body::{Moving, RigidBody};
use split_rotor_model::body::{Body, Shape};
use split_rotor_model::variables::Reading;

/// A rotor, how it starts, and the same as a scene.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "the names of the variables")]
pub struct Case {
    pub body: RigidBody,
    pub r: Vector3<f64>,
    pub v: Vector3<f64>,
    pub phi: f64,
    pub gamma: Vector2<f64>,
    pub omega: Vector3<f64>,
}

impl Case {
    /// The paper's rotor, of another Jt2, with two masses that balance nothing, on its damped springs.
    pub fn held() -> Self {
        let masses = vec![(0.3, Vector3::new(0.1, 0.05, 0.0)), (0.2, Vector3::new(-0.2, -0.03, 0.08))];
        Self {
            body: RigidBody {
                masses,
                g: Vector3::new(0.0, 0.0, -9.81),
                c: [2000.0, 500.0],
                d: [20.0, 0.5],
                ..RigidBody::free(5.0, [0.15625, 0.078125, 0.1], 0.75)
            },
            r: Vector3::new(0.75, 0.0, 0.0),
            v: Vector3::zeros(),
            phi: 0.3,
            gamma: Vector2::new(0.1, -0.2),
            omega: Vector3::new(50.0, 0.0, 0.0),
        }
    }

    /// The same without dampers.
    pub fn undamped() -> Self {
        let mut case = Self::held();
        case.body.d = [0.0; 2];
        case
    }

    /// The same with nothing acting on it, tumbling past −e.
    pub fn tumbling() -> Self {
        let mut case = Self::held();
        (case.body.g, case.body.c, case.body.d) = (Vector3::zeros(), [0.0; 2], [0.0; 2]);
        Self { gamma: Vector2::new(1.2, 0.3), omega: Vector3::new(4.0, 9.0, -3.0), ..case }
    }

    /// A free body of these moments of inertia.
    pub fn free(moments: [f64; 3], gamma: Vector2<f64>, omega: Vector3<f64>) -> Self {
        let body = RigidBody::free(5.0, moments, 0.75);
        Self { body, r: Vector3::zeros(), v: Vector3::zeros(), phi: 0.4, gamma, omega }
    }

    /// Its body, as the model has it.
    pub fn shape(&self) -> Shape {
        let [axial, transverse, other] = self.body.moments.into();
        let mut shape = Shape::of(Body { m: self.body.m, Ja: axial, Jt: transverse, l: self.body.l });
        shape.Jt2 = Some(other);
        self.body.masses.iter().for_each(|(mass, place)| shape.add(*mass, place));
        shape
    }

    /// As a scene's TOML.
    pub fn text(&self, solver: &str) -> String {
        let body = &self.body;
        let unbalance = |(mass, place): &(f64, Vector3<f64>)| Unbalance {
            mass: *mass,
            radius: libm::hypot(place.y, place.z),
            angle: libm::atan2(place.z, place.y),
            position: place.x,
        };
        let machine = Machine {
            m: body.m,
            Ja: body.moments.x,
            Jt: body.moments.y,
            Jt2: Some(body.moments.z),
            l: body.l,
            start: Start { r_c: self.r, v_c: self.v, phi: self.phi, gamma: self.gamma, omega: self.omega },
            gravity: Some(body.g),
            support: Some(Support { c: body.c, d: body.d }),
            unbalances: body.masses.iter().map(unbalance).collect(),
            ..Machine::default()
        };
        format!("{}[solver]\n{solver}\n", toml(&machine.settings()))
    }

    /// Its simulation, started.
    pub fn started(&self, solver: &str) -> Named {
        Named::started(&self.text(solver))
    }

    /// Its start, for the oracle.
    pub fn start(&self) -> Moving {
        self.body.start(self.r, self.v, self.phi, self.gamma, self.omega)
    }
}

/// What it shows at time `t` [s].
pub fn at(named: &mut Named, t: f64) -> Reading {
    named.simulation.advance(t).expect("a possible motion");
    *named.simulation.read().expect("possible parameters")
}

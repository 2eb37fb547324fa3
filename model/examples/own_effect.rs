//! A law of one's own, a mount that hardens, on a rotor on two of them:
//! `cargo run -p split-rotor-model --example own_effect`.

use nalgebra::Vector3;
use split_rotor_model::body::Body;
use split_rotor_model::effects;
use split_rotor_model::effects::{Act, Called, Effect, Entry, Facts, Motion, Row, Wrench, gravity::Gravity};
use split_rotor_model::scalar::Scalar;
use split_rotor_model::simulation::Simulation;
use split_rotor_model::variable::units::{METRE, NEWTON, NEWTON_PER_METRE};
use split_rotor_model::variable::{Bound, output, parameter};
use split_rotor_model::variables::{Parameters, Setup};

/// A mount that pulls a station back to the stator line, the harder the further it is off.
#[derive(Clone, Debug, Default)]
struct Mount {
    /// Where it is, along t from c [m].
    position: f64,
    /// Stiffness at the line [N/m].
    k: f64,
    /// Distance at which the stiffness has doubled [m].
    doubled: f64,
}

impl Mount {
    /// How far the station is off the line (y, z) [m].
    fn displacement<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        let r = motion.station(self.position);
        Vector3::new(S::zero(), r.y, r.z)
    }

    /// Force on the rotor [N].
    fn force<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        let q = self.displacement(motion);
        // F = −k (1 + |q|²/(3 d²)) q, whose slope along q has doubled at |q| = d
        q * (S::constant(-self.k) - q.dot(&q) * S::constant(self.k / (3.0 * self.doubled * self.doubled)))
    }
}

impl Effect for Mount {
    const ROWS: &'static [Row<Self>] = &[
        parameter!(position, &METRE, None, Bound::Finite, "axial position from the mass centre"),
        parameter!(k, &NEWTON_PER_METRE, None, Bound::Positive, "stiffness at the line"),
        parameter!(doubled, &METRE, None, Bound::Positive, "distance at which the stiffness has doubled"),
        output!("F.z", &NEWTON, "force on the rotor, z", |mount, motion| mount.force(motion).z),
    ];

    const FACTS: Facts = Facts { could_work: false, ..Facts::USUAL };

    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let q = self.displacement(motion);
        let square = q.dot(&q);
        Act {
            load: Wrench::at_station(motion, self.position, self.force(motion)),
            // V = ½ k |q|² + k |q|⁴/(12 d²)
            stored: square * S::constant(0.5 * self.k)
                + square * square * S::constant(self.k / (12.0 * self.doubled * self.doubled)),
            ..Act::none()
        }
    }
}

impl Entry for Mount {
    const NAME: &'static str = "mount";
    // The catalogue's own numbers begin with 1.
    const NUMBER: u32 = 1000;
    const SEVERAL: bool = true;
}

type Mounted = (Called<Gravity>, (Called<Mount, 1>, (Called<Mount, 2>, ())));

/// A rotor of 12 kg that is let go on two mounts at 300 rad/s.
fn on_two_mounts() -> Simulation<Mounted> {
    let mut setup = Setup::of(Body { m: 12.0, Ja: 0.06, Jt: 0.3, l: 0.25 });
    setup.start.omega.x = 300.0;
    let gravity = Gravity { g: Vector3::new(0.0, 0.0, -9.81) };
    let [left, right] = [-0.25, 0.2].map(|position| Mount { position, k: 1e5, doubled: 0.5e-3 });
    Parameters { setup, effects: effects![gravity, left => 1, right => 2] }.into()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut rotor = on_two_mounts();
    rotor.start(0.0, Some(1e-9))?;
    let force = Parameters::<Mounted>::place("mount[2].F.z").ok_or("no such variable")?;
    println!("t [s]  z_c [mm]  F.z of the right mount [N]  residual [J]");
    for step in 0..=20 {
        rotor.advance(1e-3 * f64::from(step))?;
        let f_z = rotor.get(force)?.unwrap_or_default();
        let shown = rotor.read()?;
        println!(
            "{:.3} {:10.4} {:27.2} {:13.1e}",
            shown.motion.t,
            1e3 * shown.motion.r_c().z,
            f_z,
            shown.ledger.residual()
        );
    }
    Ok(())
}

/// A force that is not the slope of the energy would break the ledger; a mount that is not there would let the rotor fall.
#[test]
fn the_mounts_keep_the_energy() {
    let mut rotor = on_two_mounts();
    rotor.start(0.0, Some(1e-12)).unwrap();
    rotor.advance(1.0).unwrap();
    let shown = rotor.read().unwrap();
    assert!(shown.ledger.residual().abs() < 1e-9, "{:e} J", shown.ledger.residual());
    assert!(shown.motion.r_c().z.abs() < 2e-3 && shown.motion.r_c().z != 0.0, "{} m", shown.motion.r_c().z);
}

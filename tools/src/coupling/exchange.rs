//! A run of a machine and its partners, as a master couples them, beside the machine in one model.

use super::pair::{Pair, Setting, place};
use super::partner::{Partner, Shown};
use anyhow::{Context, Result, anyhow};
use nalgebra::{Vector2, Vector3};
use split_rotor_model::effects::All;
use split_rotor_model::simulation::General;
use split_rotor_model::variable::Place;
use split_rotor_model::variables::Parameters;

/// When the answers of a partner without states reach the rotor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Before the step: the partner is shown the motion, and its answer is set.
    Fresh,
    /// One step later: the master reads all outputs before it sets inputs.
    Late,
}

impl Scheme {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Fresh, Self::Late];

    /// As tables call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fresh => "fresh",
            Self::Late => "late",
        }
    }

    /// When answers reach the rotor.
    pub fn words(self) -> &'static str {
        match self {
            Self::Fresh => "before the step (fresh)",
            Self::Late => "one step late",
        }
    }

    /// Which masters do so.
    pub fn masters(self) -> &'static str {
        match self {
            Self::Fresh => {
                "a script that shows the partner the motion before the step, or a Gauss-Seidel master that steps the rotor first"
            }
            Self::Late => "libcosim, ecos, FMPy's SSP",
        }
    }

    /// How many steps answers are late.
    pub fn lag(self) -> u32 {
        u32::from(self == Self::Late)
    }
}

/// A run that is so many times further off than the motion is large ends \[1].
const LOST: f64 = 1e4;

/// The last part of a run, in which errors count \[1].
const LAST: f64 = 0.1;

/// Loads that change by less than this part of what the motion could change \[1] change by rounding.
const STILL: f64 = 1e-9;

/// What ports show at a communication point.
type Point = Vec<Shown>;

/// A machine in one model, at communication points.
pub struct Exact {
    step: f64,
    points: Vec<Point>,
    /// How far a station moves at most \[m], tilts times [`Pair::length`] included where partners answer them.
    size: f64,
    /// The energy of the motion at each point without that of the spin \[J].
    energies: Vec<f64>,
}

/// What a coupled run came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// The largest error over the last tenth, relative to the largest motion \[1]; None where the run ended early.
    pub error: Option<f64>,
    /// The largest error at any time, relative to the largest motion \[1]; None where the run ended early.
    pub whole: Option<f64>,
    /// By how much the energy of the motion is off over the last tenth, relative to the largest energy of the motion \[1]; None where the
    /// run ended early.
    pub energy: Option<f64>,
    /// The sum of `port[i].energy_error` at the end, relative to the same \[1]; None where the run ended early.
    pub reported: Option<f64>,
    /// Why it ended early.
    pub ended: Option<String>,
    /// When the FMU warned that the exchange is wrong \[s].
    pub warned: Option<f64>,
    /// How many ports went on by a law that they learnt.
    pub learnt: u32,
}

/// A started rotor and where its ports are.
struct Run {
    simulation: General,
    ports: Vec<PortPlaces>,
    values: Vec<f64>,
}

struct PortPlaces {
    shown: [u32; 11],
    loads: [Place; 6],
    energy: Place,
}

impl PortPlaces {
    fn of(port: u32) -> Self {
        let at = |name: &str| place("port", port, name);
        const SHOWN: [&str; 11] =
            ["r.x", "r.y", "r.z", "v.x", "v.y", "v.z", "theta.y", "theta.z", "omega.x", "omega.y", "omega.z"];
        Self {
            shown: SHOWN.map(|name| at(name).value_reference()),
            loads: ["f.x", "f.y", "f.z", "m.x", "m.y", "m.z"].map(at),
            energy: at("energy_error"),
        }
    }
}

impl Run {
    fn started(pair: &Pair, parameters: Parameters<All>) -> Result<Self> {
        let mut simulation = General::from(parameters);
        simulation.start(0.0, None).map_err(|invalid| anyhow!("{invalid}"))?;
        Ok(Self {
            simulation,
            ports: pair.ports.iter().map(|port| PortPlaces::of(*port)).collect(),
            values: vec![0.0; 11],
        })
    }

    /// What the ports show now.
    fn shown(&mut self) -> Result<Point> {
        self.simulation.read().map_err(|invalid| anyhow!("{invalid}"))?;
        let Self { simulation, ports, values } = self;
        let one = |port: &PortPlaces| {
            if !simulation.reals_at_hand(&port.shown, values) {
                for (reference, value) in port.shown.iter().zip(values.iter_mut()) {
                    *value = simulation.value(Place::of(*reference)).context("a port shows its motion")?;
                }
            }
            let vector = |n: usize| Vector3::new(values[n], values[n + 1], values[n + 2]);
            Ok(Shown { r: vector(0), v: vector(3), theta: [values[6], values[7]].into(), omega: vector(8) })
        };
        ports.iter().map(one).collect()
    }
}

/// The energy of the motion without that of the spin, with the energy in the springs of the partners \[J].
fn energy(pair: &Pair, point: &[Shown]) -> f64 {
    let (rotor, shown) = (&pair.whole.setup.rotor, &point[0]);
    // dt/dt = ω×t; v_c = v_s − p dt/dt
    let rate = shown.turn().cross(&shown.axis());
    let v_c = shown.v - rate * pair.partners[0].position;
    let moving = 0.5 * (rotor.m * v_c.norm_squared() + rotor.Jt * rate.norm_squared());
    moving + pair.partners.iter().zip(point).map(|(partner, shown)| partner.stored(shown)).sum::<f64>()
}

/// The number of communication steps of a span \[s].
pub fn steps(span: f64, step: f64) -> usize {
    (span / step).round() as usize
}

/// How far two motions of a station are apart along x, across and by tilt \[m].
fn apart(pair: &Pair, partner: &Partner, one: &Shown, other: &Shown) -> f64 {
    let along = if partner.is_axial() { 1.0 } else { 0.0 };
    let tilting = if partner.is_tilted() { pair.length() } else { 0.0 };
    let (r, theta) = (one.r - other.r, (one.theta - other.theta) * tilting);
    [along * r.x, r.y, r.z, theta.x, theta.y].iter().fold(0.0, |most, x| if x.abs() <= most { most } else { x.abs() })
}

impl Exact {
    /// A machine with its bearings inside, at the points of these communication steps \[s].
    pub fn of(pair: &Pair, step: f64, span: f64) -> Result<Self> {
        let mut run = Run::started(pair, pair.whole.clone())?;
        let mut points = vec![run.shown()?];
        for n in 1..=steps(span, step) {
            run.simulation.advance(n as f64 * step).map_err(|fault| anyhow!("the machine in one model: {fault}"))?;
            points.push(run.shown()?);
        }
        let centred = |partner: &Partner| Shown { r: Vector3::x() * partner.rest, ..Shown::default() };
        let of_point = |point: &Point| {
            let sizes = pair.partners.iter().zip(point);
            sizes.map(|(partner, shown)| apart(pair, partner, shown, &centred(partner))).fold(0.0, f64::max)
        };
        let size = points.iter().map(of_point).fold(0.0, f64::max);
        let energies = points.iter().map(|point| energy(pair, point)).collect();
        Ok(Self { step, points, size, energies })
    }

    /// Whether the motion changes the loads of the partners by more than rounding.
    pub fn moves(&self, pair: &Pair) -> bool {
        let length = pair.length();
        let apart = |[force, moment]: [Vector3<f64>; 2], [other, turning]: [Vector3<f64>; 2]| {
            (force - other).norm() + (moment - turning).norm() / length
        };
        pair.partners.iter().enumerate().any(|(n, partner)| {
            let first = self.points[0][n];
            let change = |to: &Shown| apart(partner.answer(to), partner.answer(&first));
            let (across, tilt) = (Vector3::new(0.0, self.size, self.size), self.size / length);
            let pushed = Shown { r: first.r + across, theta: first.theta + Vector2::repeat(tilt), ..first };
            let hurled = Shown { v: first.v + across / self.step, ..first };
            let most = self.points.iter().map(|point| change(&point[n])).fold(0.0, f64::max);
            most > STILL * change(&pushed).max(change(&hurled))
        })
    }

    /// The same machine with its bearings at ports, under a setting.
    pub fn beside(&self, pair: &Pair, scheme: Scheme, setting: &Setting) -> Result<Outcome> {
        let mut run = Run::started(pair, pair.open(setting, scheme.lag()))?;
        let mut outcome = Outcome::default();
        let mut last = run.shown()?;
        let from = self.points.len() - libm::ceil(self.points.len() as f64 * LAST) as usize;
        let most = self.energies.iter().copied().fold(0.0, f64::max);
        let (mut error, mut whole, mut missing) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut shown = last.clone();
        for (n, exact) in self.points.iter().enumerate().skip(1) {
            let answered = if scheme == Scheme::Late { &last } else { &shown };
            for ((partner, port), shown) in pair.partners.iter().zip(&run.ports).zip(answered) {
                let [force, moment] = partner.answer(shown);
                for (place, load) in port.loads.iter().zip(force.iter().chain(moment.iter())) {
                    run.simulation.set_input(*place, *load);
                }
            }
            let advanced = run.simulation.advance(n as f64 * self.step);
            outcome.warned = outcome.warned.or(run.simulation.coupling().map(|coupling| coupling.t));
            if let Err(fault) = advanced {
                outcome.ended = Some(fault.to_string());
                return Ok(outcome);
            }
            last = std::mem::replace(&mut shown, run.shown()?);
            let off = pair.partners.iter().zip(shown.iter().zip(exact));
            let off = off.map(|(partner, (one, other))| apart(pair, partner, one, other) / self.size);
            // A NaN stays.
            let off = off.fold(0.0, |most: f64, x| if x <= most { most } else { x });
            if off.is_nan() || off > LOST {
                outcome.ended =
                    Some(format!("off by more than {LOST:.0} times the motion after {:.3e} s", n as f64 * self.step));
                return Ok(outcome);
            }
            whole = whole.max(off);
            if n >= from {
                error = error.max(off);
                missing = missing.max((energy(pair, &shown) - self.energies[n]).abs() / most);
            }
        }
        outcome.learnt = run.simulation.learnt().count_ones();
        let brought: f64 = run.ports.iter().filter_map(|port| run.simulation.value(port.energy)).sum();
        (outcome.error, outcome.whole) = (Some(error), Some(whole));
        (outcome.energy, outcome.reported) = (Some(missing), Some(brought / most));
        Ok(outcome)
    }
}

//! In which directions nothing holds a rotor that is held in others: it drifts there, whether or not a motion grows.

use super::growth::PORT;
use super::rest::{Free, Spinning, UNKNOWNS, rounding, settled};
use crate::effects::Effects;
use crate::integrate::stiff::Differentiable;
use crate::rotor::{Frame, Rotor};
use crate::state::Coordinates;
use nalgebra::{SVector, Vector2, Vector3};
use std::fmt::{self, Display, Formatter};

/// What nothing holds, where something holds the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Unheld {
    /// Directions of O along which nothing holds the rotor \[1].
    pub along: Vec<Vector3<f64>>,
    /// Directions of O about which it can tilt \[1].
    pub about: Vec<Vector3<f64>>,
    /// The force \[N] along the directions of `along`, and the moment [N·m] of a turn about those of `about`: what acts at the start and does not
    /// balance.
    pub load: [f64; 2],
    /// Whether something holds it there, if only so weakly that what acts at the start takes it far away.
    pub is_weak: bool,
    /// Whether the search for these directions failed, so that none is known.
    pub is_unknown: bool,
}

/// Stiffness against which a load would take the rotor so far is none, in radii of gyration or \[rad]; where the rotor leans no farther than
/// this \[rad]: the weight of a top that lies has next to no stiffness, and its spin holds it.
const LOST: f64 = 100.0;
const LEANS: f64 = 1.0;

/// A direction that is no other by more than this \[1].
const SAME: f64 = 1e-6;

/// Loads that are less than this part of all that acts are rounding \[1].
const ROUNDING: f64 = 1e-9;

/// What stops a rotor that has gone some way.
const RING: &str = "rub";

impl Unheld {
    /// Of a rotor at time `t` \[s] and state `y`; None where something holds it in all directions, or nothing holds or damps it in
    /// any, or other models may, through ports.
    ///
    /// Stiffness is that where the forces balance, so far as springs hold the rotor: a weight on a point counts.
    pub(super) fn of<E: Effects, const N: usize>(rotor: &Rotor<'_, E>, t: f64, y: &[f64; N]) -> Option<Self> {
        let is_active = |name: &str| rotor.effects.active().any(|block| block.kind().name == name);
        if is_active(PORT) {
            return None;
        }
        // The balanced rotor: what an unbalance adds turns with it.
        let Frame { body, chart, turns } = rotor.frame;
        let balanced = Rotor::new(body.symmetric(), rotor.effects, chart, turns);
        let body = balanced.frame.body;
        let (about_axis, speed) = (1.0 / (body.spin + body.per_jt), rotor.motion(t, y).axial_rate());
        let spinning = Spinning { rotor: &balanced, own: *y, about_axis, speed, t };
        let Coordinates { r, gamma, .. } = rotor.at(&settled(&balanced, t, y));
        let balance = spinning.balance(r, gamma);
        // What acts where it begins: the forces balance where a weak spring has let it go far.
        let begun = rotor.at(y);
        let begun = spinning.balance(begun.r, begun.gamma).left;
        let lost = if gamma.norm() < LEANS { LOST } else { f64::INFINITY };
        let Some(Free { directions: free, held, is_weak, largest }) = balance.unheld(&begun, lost) else {
            // Where forces overflow the motion itself cannot go on, and says so.
            if balanced.jacobian(t, y).as_flattened().iter().any(|slope| !slope.is_finite()) {
                return None;
            }
            return Some(Self {
                along: Vec::new(),
                about: Vec::new(),
                load: [0.0; 2],
                is_weak: false,
                is_unknown: true,
            });
        };
        // A free body is meant to be free; one in bearings that only damp is not.
        if free.is_empty() || held == 0 && !balance.damps::<E>() {
            return None;
        }
        let (inertia, length) = spinning.across();
        let [mut about, mut along] = parted(free);
        let is_weak = is_weak && !is_active(RING);
        if is_active(RING) {
            // A ring holds what touches it.
            about.clear();
            along.retain(is_axial);
        }
        // The power of what is left, for a unit of each direction.
        let loads = |directions: &[SVector<f64, UNKNOWNS>], size: f64| {
            let left = if is_weak { begun } else { balance.left };
            let of = |direction: &SVector<f64, UNKNOWNS>| {
                let turn = balance.axis.cross(&(balance.turning * direction.fixed_rows::<2>(3)));
                let force = left.fixed_rows::<3>(0).dot(&direction.fixed_rows::<3>(0));
                (force + left.fixed_rows::<3>(3).dot(&turn)) * size
            };
            let all = directions.iter().map(of).map(|load| load * load).sum::<f64>().sqrt();
            if all > size * (ROUNDING * left.norm()).max(rounding(largest, r, length)) { all } else { 0.0 }
        };
        let load = [loads(&along, length / body.per_m), loads(&about, inertia)];
        let along: Vec<_> = along.iter().map(|direction| direction.fixed_rows::<3>(0).into_owned()).collect();
        let about: Vec<_> = about.iter().map(|direction| Vector3::new(0.0, direction[3], direction[4])).collect();
        let is_none = along.is_empty() && about.is_empty();
        (!is_none).then_some(Self { along, about, load, is_weak, is_unknown: false })
    }

    /// Whether it is nothing to warn of: the rotor is free along its axis, where nothing pushes it.
    pub fn is_mere_axial(&self) -> bool {
        let Self { along, about, load, is_unknown, .. } = self;
        !is_unknown && about.is_empty() && load[0] == 0.0 && along.iter().all(|way| (way.x.abs() - 1.0).abs() < SAME)
    }
}

fn is_axial(direction: &SVector<f64, UNKNOWNS>) -> bool {
    (direction[0].abs() - 1.0).abs() < SAME
}

/// Directions in which something can go, as turns and ways along: turns first, of one radian each, with what goes along with them; each along y
/// and z or x, y and z where it can be.
fn parted(mut free: Vec<SVector<f64, UNKNOWNS>>) -> [Vec<SVector<f64, UNKNOWNS>>; 2] {
    let (mut about, mut along) = (Vec::new(), Vec::new());
    for (parts, found) in [([4, 3].as_slice(), &mut about), ([2, 1, 0].as_slice(), &mut along)] {
        for part in parts {
            // As in Gauss's elimination: one of them keeps this part, of 1.
            let size = |n: &usize| free[*n][*part].abs();
            let Some(first) = (0..free.len()).max_by(|a, b| size(a).total_cmp(&size(b))).filter(|n| size(n) > SAME)
            else {
                continue;
            };
            let kept = free.swap_remove(first);
            let kept = kept / kept[*part];
            let less = |other: &mut SVector<f64, UNKNOWNS>| *other -= kept * other[*part];
            free.iter_mut().for_each(less);
            found.iter_mut().for_each(less);
            found.push(kept);
        }
    }
    // What remains of a turn along a way that is free is no part of it.
    for way in &along {
        let pivot = way.iamax();
        for turn in &mut about {
            *turn -= way * (turn[pivot] / way[pivot]);
        }
    }
    about.reverse();
    along.reverse();
    for way in &mut along {
        way.normalize_mut();
    }
    for turn in &mut about {
        *turn /= Vector2::new(turn[3], turn[4]).norm();
    }
    [about, along]
}

/// Directions in words: "y and z", or as a vector.
fn words(directions: &[Vector3<f64>]) -> String {
    let word = |way: &Vector3<f64>| match ["x", "y", "z"]
        .iter()
        .zip(way.iter())
        .find(|(_, part)| (part.abs() - 1.0).abs() < SAME)
    {
        Some((name, _)) => (*name).to_owned(),
        None => format!("({:.2}, {:.2}, {:.2})", way.x, way.y, way.z),
    };
    let words: Vec<_> = directions.iter().map(word).collect();
    match &words[..] {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => words.concat(),
    }
}

impl Display for Unheld {
    /// What to warn of.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { along, about, load, is_weak, is_unknown } = self;
        if *is_unknown {
            return write!(
                f,
                "whether something holds the rotor in all directions is not known: the search for the singular values of its \
                 stiffness did not converge"
            );
        }
        if self.is_mere_axial() {
            return write!(
                f,
                "nothing holds the rotor along x, its axis, and no load acts there: it is free to move along x"
            );
        }
        let pushed = |load: f64, unit: &str| match load {
            0.0 => "any push there moves it away".to_owned(),
            _ => format!("a load of {load:.3} {unit} acts there"),
        };
        let ways = (!along.is_empty()).then(|| format!("along {} ({})", words(along), pushed(load[0], "N")));
        let turns =
            (!about.is_empty()).then(|| format!("against tilt about {} ({})", words(about), pushed(load[1], "N.m")));
        let all: Vec<_> = ways.into_iter().chain(turns).collect();
        let mut remedies = Vec::new();
        if along.iter().any(|way| way.x.abs() > SAME) {
            remedies.push("kxx of a bearing along x");
        }
        if along.iter().any(|way| way.yz().norm() > SAME) {
            remedies.push("kyy and kzz of a bearing along y and z");
        }
        // A tilt about y moves what is off the middle along z.
        if !about.is_empty() {
            let turned = about.iter().fold(Vector3::zeros(), |sum, way| sum + way.abs());
            remedies.push(match (turned.y > SAME, turned.z > SAME) {
                (true, false) => "kzz of two bearings apart, or kt of one, against tilt",
                (false, true) => "kyy of two bearings apart, or kt of one, against tilt",
                _ => "kyy and kzz of two bearings apart, or kt of one, against tilt",
            });
        }
        let nothing = if *is_weak { "hardly anything" } else { "nothing" };
        write!(f, "{nothing} holds the rotor {}: give it {}", all.join(" and "), remedies.join(", "))
    }
}

//! Detects a motion that diverges: something holds the rotor, and yet it is further away than any machine is large.

use crate::body::ROTOR;
use crate::effects::{Block, Effects};
use crate::integrate::stiff::Differentiable;
use crate::rotor::{Frame, Rotor};
use crate::state::GAMMA;
use crate::stored::stored;
use crate::variable::Place;
use std::fmt::{self, Display, Formatter};

/// A motion that diverges, as it was when that was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Divergence {
    /// When \[s].
    pub t: f64,
    /// How far the mass centre was from the reference axis \[m], in the directions in which something holds it.
    pub deflection: f64,
    /// The size of the rotor \[m]: the largest of its positions, gaps, `rotor.l` and √(Jt/m).
    pub size: f64,
}

stored!(Divergence { t, deflection, size });

impl Display for Divergence {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { t, deflection, size } = self;
        write!(
            f,
            "the motion diverges: at t = {t:.4e} s the rotor is {deflection:.1e} m off, more than {FAR:e} times its size of \
             {size:.2e} m, the largest of all positions, gaps, rotor.l and sqrt(Jt/m); look for a negative stiffness, for a \
             cross stiffness without damping, or for the controller that an [[effects.port]] lacks"
        )
    }
}

/// A held rotor diverges from so many sizes on \[1].
const FAR: f64 = 1e6;

/// Where a direction is free, what holds the rotor is looked at again so many times further away \[1].
const FURTHER: f64 = 10.0;

/// The directions of O.
const DIRECTIONS: usize = 3;

/// Looks whether a motion diverges.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bounds {
    /// That of the rotor \[m].
    size: f64,
    /// What holds the rotor is looked at beyond these \[m], each direction on its own.
    limits: [f64; DIRECTIONS],
    found: Option<Divergence>,
}

stored!(Bounds { size, limits, found });

impl Bounds {
    /// Those of this rotor.
    pub fn of<E: Effects>(rotor: &Rotor<'_, E>) -> Self {
        let body = &rotor.frame.body;
        let size = rotor.effects.active().flat_map(lengths).fold(body.radius().max(body.l.abs()), f64::max);
        Self { size, limits: [FAR * size; DIRECTIONS], found: None }
    }

    /// The divergence that was found first; None where the motion does not diverge.
    pub fn found(&self) -> Option<Divergence> {
        self.found
    }

    /// Looks at the rotor at time `t` \[s] and state `y`.
    #[inline(always)]
    pub fn look<E: Effects, const N: usize>(&mut self, rotor: &Rotor<'_, E>, t: f64, y: &[f64; N]) {
        let place = &y[E::layout::<N>().body(ROTOR)];
        if (0..DIRECTIONS).any(|n| place[n].abs() > self.limits[n]) && self.found.is_none() {
            self.judge(rotor, t, y);
        }
    }

    /// Where nothing holds the rotor it may fly away.
    #[cold]
    #[inline(never)]
    fn judge<E: Effects, const N: usize>(&mut self, rotor: &Rotor<'_, E>, t: f64, y: &[f64; N]) {
        let Frame { body, chart, turns } = rotor.frame;
        let balanced = Rotor::new(body.symmetric(), rotor.effects, chart, turns);
        let (jacobian, at) = (balanced.jacobian(t, y), E::layout::<N>().body(ROTOR));
        let (first, place) = (at.start, &y[at]);
        // A load that depends on the place: the rates of velocity and angular momentum do.
        let is_held = |n: usize| (DIRECTIONS..GAMMA.start).any(|rate| jacobian[first + rate][first + n] != 0.0);
        let held = (0..DIRECTIONS).filter(|n| is_held(*n));
        let deflection = held.map(|n| place[n] * place[n]).sum::<f64>().sqrt();
        if deflection > FAR * self.size {
            self.found = Some(Divergence { t, deflection, size: self.size });
        }
        for (limit, place) in self.limits.iter_mut().zip(place) {
            *limit = limit.max(FURTHER * place.abs());
        }
    }
}

/// The positions and gaps of an effect \[m].
fn lengths(block: &dyn Block) -> impl Iterator<Item = f64> {
    let rows = (0..Place::SWITCH).filter_map(|row| Some((row, (block.kind().meta)(row)?)));
    let lengths = rows.filter(|(_, meta)| matches!(meta.name, "position" | "gap"));
    lengths.filter_map(|(row, _)| block.value(row, 0.0, None, None)).map(f64::abs)
}

//! How another model answers the motion of the place where it is coupled: stiffness and damping, given or learnt.

use crate::scalar::Scalar;
use crate::signal::NODES;
use crate::stored::stored;
use nalgebra::{SMatrix, SVector};

/// What a partner answers with has so many components: a force, x to z \[N], and a moment, y and z [N·m].
pub const LOADS: usize = 5;

/// What it is shown: place, x to z \[m], and lean, y and z \[rad]; then velocity [m/s] and how fast the axis turns, t×dt/dt [rad/s],
/// the same components.
pub const SHOWN: usize = 2 * LOADS;

/// Force and moment of a partner.
pub type Loads<S = f64> = SVector<S, LOADS>;

/// What is shown at an instant.
pub type Shown<S = f64> = SVector<S, SHOWN>;

/// How the loads change with what is shown.
pub type Slopes = SMatrix<f64, LOADS, SHOWN>;

/// Values of inputs may be so many communication steps late.
pub const LATEST: usize = 8;

/// The row of the field `lag`: that of one effect, negative where it is not known.
macro_rules! lag {
    () => {
        $crate::variable::parameter!(
            lag,
            &$crate::variable::units::ONE,
            Some(-1.0),
            $crate::variable::Bound::Within(-1.0, $crate::effects::partner::LATEST as f64),
            "how many communication steps the values of its inputs are late; negative: as extrapolation.lag says or the answers look"
        )
    };
}

#[allow(unused_imports, reason = "of a list, neither port nor drive may be one")]
pub(super) use lag;

/// Loads go on by laws as polynomials of degree 2.
pub const POWERS: usize = 3;

/// What inputs are from some time on, as coefficients of the powers of the time since.
pub type Acting = [Loads; NODES];

/// The loads of a partner beside its last answer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Law {
    /// Whether it is in force.
    pub is_on: bool,
    /// Whether it says anything of moments and leans.
    pub turns: bool,
    /// How the loads change with what is shown.
    pub slopes: Slopes,
    /// What was shown, to which the loads that were set last are the answer.
    pub shown: Shown,
    /// How what is left of the loads, which no motion of the place changes, goes on: by powers 0 to 2 of the time since.
    pub rest: [Loads; POWERS],
    /// When it came into force \[s], and what place and motion were then.
    pub since: f64,
    /// See `since`.
    pub at: Shown,
    /// What is shown is so far ahead of the motion \[s].
    pub ahead: f64,
    /// The energy that the exchange brought into the motion so far \[J].
    pub error: f64,
}

stored!(Law { is_on, turns, slopes, shown, rest, since, at, ahead, error });

impl Law {
    /// Whether it makes the same loads as another one.
    pub fn is_like(&self, other: &Self) -> bool {
        Self { error: 0.0, ..*self } == Self { error: 0.0, ..*other }
    }

    /// Whether loads go on by time alone.
    pub fn has_no_slopes(&self) -> bool {
        self.slopes == Slopes::zeros()
    }

    /// What is shown of this place and motion: the place ahead, as it goes on.
    pub fn shows(&self, at: Shown) -> Shown {
        let mut shown = at;
        for n in 0..LOADS {
            shown[n] += self.ahead * at[LOADS + n];
        }
        shown
    }

    /// By how much the loads differ from the last answer at time `t` \[s] where this is shown. Written out: where a law may be called, what is
    /// summed up so far goes through memory in every evaluation.
    #[inline(always)]
    pub fn change<S: Scalar>(&self, t: S, shown: Shown<S>) -> Loads<S> {
        let s = t - S::constant(self.since);
        let [value, rate, bend] = self.rest.map(|rest| rest.map(S::constant));
        // eq. 124: J (x − x_s) + Σ g_n s^n
        self.slopes.map(S::constant) * (shown - self.shown.map(S::constant)) + value + (rate + bend * s) * s
    }
}

/// Place and motion at a communication point, and what was set there.
#[derive(Clone, Copy, Debug)]
pub struct Exchange {
    /// Place and motion.
    pub at: Shown,
    /// What was set, which may be the answer to what was shown before.
    pub loads: Loads,
    /// The slopes of the partner, where they are known.
    pub given: Option<Slopes>,
    /// Whether the partner turns along with the rotor, so that how late its answers are cannot be seen in them.
    pub turns_along: bool,
    /// Whether they may be learnt.
    pub learns: bool,
    /// By what part of the last communication step things are to be shown ahead \[1].
    pub ahead: f64,
    /// By how much a force accelerates the place at most [1/kg].
    pub yielding: f64,
    /// Radius of gyration √(Jt/m) \[m]: leans times this count as ways, moments over this as forces.
    pub gyration: f64,
}

impl Exchange {
    /// How many communication steps the partner itself is late, where it answers what was shown so many before.
    pub fn late(&self, lag: usize) -> usize {
        // A partner that holds what it is shown has states of its own, and answers with those of now.
        if self.ahead == 0.0 { lag } else { 0 }
    }
}

//! `auto`: `taylor` (or dop853 where there is no series), and `stiff` as long as stability alone holds these to short steps; and
//! `taylor`, which takes dop853 as long as stability holds a series.
//!
//! Where stiffness is suspected, `stiff` is tried, and what both spend is compared: by evaluations, so that every machine takes
//! the same way (Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.2; Petzold 1983).

use crate::integrate::stiff::spectrum::spectral_radius;
use crate::stored::stored;

/// What is known of the stiffness of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Auto {
    /// Whether `stiff` may be taken.
    may_be_stiff: bool,
    /// Steps until it is looked at again.
    rest: u32,
    /// Steps between two looks that found nothing.
    pause: u32,
    /// When the look began \[s], and after how many evaluations.
    since: f64,
    spent: f64,
    /// The fastest rate of the linear equations, when it was last looked at [rad/s].
    fastest: f64,
    /// Whether stability held explicit steps there, and whether these are tried for the first time since.
    held: bool,
    is_trial: bool,
    /// How often the method was changed.
    changes: u32,
}

stored!(Auto { may_be_stiff, rest, pause, since, spent, fastest, held, is_trial, changes });

/// Steps between two looks; at first, and at most.
const LOOK: u32 = 128;
const LONGEST_PAUSE: u32 = 4096;

/// A trial of `stiff` takes about as long as so many steps, and none is made where no more are left.
const WORTH: f64 = 512.0;

/// `stiff` is measured over so many steps, after as many to find its own step.
const TRIAL: u32 = 8;

/// Dop853 is stable where a step spans less than this \[rad], on the imaginary axis and on the negative one.
pub(super) const STABLE: f64 = 6.0;

/// Stability may hold a step that spans this part of what is stable: one of dop853, which stability refuses now and then, and one of
/// taylor, which stays near it.
pub(super) const SUSPECT: [f64; 2] = [0.5, 0.75];

/// A step of dop853 takes so many evaluations.
const STAGES: f64 = 12.0;

/// An evaluation of `stiff`, with the linear equations that go with it, takes so many times that of dop853: measured.
const DEARER: f64 = 6.0;

/// It must pay by this before the method is changed \[1].
const GAIN: f64 = 1.25;

/// What is to be done next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    /// Go on with the method that is at work.
    Stay,
    /// Go on with the other one.
    Change,
}

impl Default for Auto {
    /// At the start of a run without `stiff`.
    fn default() -> Self {
        let [may_be_stiff, held, is_trial] = [false; 3];
        Self {
            may_be_stiff,
            rest: LOOK,
            pause: LOOK,
            since: f64::NAN,
            spent: 0.0,
            fastest: 0.0,
            held,
            is_trial,
            changes: 0,
        }
    }
}

impl Auto {
    /// At the start of a run that may take `stiff`.
    pub fn with_stiff() -> Self {
        Self { may_be_stiff: true, ..Self::default() }
    }

    /// The fastest rate of the linear equations, when it was last looked at [rad/s].
    pub fn fastest(&self) -> f64 {
        self.fastest
    }

    /// Whether stability held explicit steps, when it was last looked at.
    pub fn holds_steps(&self) -> bool {
        self.held
    }

    /// How often the method was changed.
    pub fn changes(&self) -> u32 {
        self.changes
    }

    /// The longest step for which dop853 is stable \[s].
    pub fn stable_step(&self) -> f64 {
        STABLE / self.fastest
    }

    /// Whether it is time to look at the run, after each step.
    #[inline(always)]
    pub fn is_due(&mut self) -> bool {
        self.rest = self.rest.saturating_sub(1);
        self.rest == 0
    }

    /// Of a method whose next step is `h` \[s], with `left` \[s] to go, where the linear equations are these, and where one that spans
    /// less than `suspect` \[rad] is not held by stability.
    pub fn look_at_explicit<const N: usize>(
        &mut self,
        [h, left, suspect]: [f64; 3],
        jacobian: &[[f64; N]; N],
        size: usize,
    ) -> Verdict {
        self.fastest = spectral_radius(jacobian, size);
        self.held = h * self.fastest >= suspect;
        if std::mem::take(&mut self.is_trial) {
            self.rest = self.pause;
        } else if !self.held {
            self.rest = self.paused(2);
        } else if !self.may_be_stiff || left < WORTH * h {
            self.try_explicit(2);
        } else {
            return self.change(TRIAL);
        }
        Verdict::Stay
    }

    /// Of `stiff`, which has reached time `t` \[s] after so many evaluations.
    pub fn look_at_stiff<const N: usize>(
        &mut self,
        t: f64,
        evaluations: f64,
        jacobian: &[[f64; N]; N],
        size: usize,
    ) -> Verdict {
        let is_trial = self.since.is_nan();
        let (since, spent) = (std::mem::replace(&mut self.since, t), std::mem::replace(&mut self.spent, evaluations));
        self.rest = TRIAL;
        if is_trial {
            return Verdict::Stay;
        }
        self.fastest = spectral_radius(jacobian, size);
        // eq. 86
        let [stiff, explicit] = [DEARER * (evaluations - spent) / (t - since), STAGES / self.stable_step()];
        if stiff * GAIN <= explicit {
            self.pause = LOOK;
            return Verdict::Stay;
        }
        self.try_explicit(4);
        self.change(self.rest)
    }

    /// Explicit steps are tried; the pause after that is so many times as long as the last.
    fn try_explicit(&mut self, times: u32) {
        self.paused(times);
        (self.rest, self.is_trial) = (2 * TRIAL, true);
    }

    fn change(&mut self, rest: u32) -> Verdict {
        (self.rest, self.since) = (rest, f64::NAN);
        self.changes = self.changes.saturating_add(1);
        Verdict::Change
    }

    /// A pause so many times as long as the last.
    fn paused(&mut self, times: u32) -> u32 {
        self.pause = times.saturating_mul(self.pause).min(LONGEST_PAUSE);
        self.pause
    }
}

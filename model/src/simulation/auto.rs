//! `auto`: dop853, and `stiff` as long as stability alone holds dop853 to short steps.
//!
//! Where stiffness is suspected, `stiff` is tried, and what both spend is compared: by evaluations, so that every machine takes
//! the same way (Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.2; Petzold 1983).

use crate::integrate::stiff::spectrum::spectral_radius;
use crate::stored::stored;

/// What is known of the stiffness of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Auto {
    /// Steps until it is looked at again.
    rest: u32,
    /// Steps between two looks at a run of dop853 that found nothing.
    pause: u32,
    /// When the look began \[s], and after how many evaluations.
    since: f64,
    spent: f64,
    /// The fastest rate of the linear equations, when it was last looked at [rad/s].
    fastest: f64,
    /// How often the method was changed.
    changes: u32,
}

stored!(Auto { rest, pause, since, spent, fastest, changes });

/// Steps between two looks; at first, and at most.
const LOOK: u32 = 16;
const LONGEST_PAUSE: u32 = 4096;

/// `stiff` is measured over so many steps, after as many to find its own step.
const TRIAL: u32 = 8;

/// Dop853 is stable where a step spans less than this \[rad], on the imaginary axis and on the negative one.
const STABLE: f64 = 6.0;

/// Stability may hold a step that spans this part of it.
const SUSPECT: f64 = 0.5;

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
    /// At the start of a run.
    fn default() -> Self {
        Self { rest: LOOK, pause: LOOK, since: f64::NAN, spent: 0.0, fastest: 0.0, changes: 0 }
    }
}

impl Auto {
    /// The fastest rate of the linear equations, when it was last looked at [rad/s].
    pub fn fastest(&self) -> f64 {
        self.fastest
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

    /// Of dop853, whose next step is `h` \[s] where the linear equations are these.
    pub fn look_at_explicit<const N: usize>(&mut self, h: f64, jacobian: &[[f64; N]; N], size: usize) -> Verdict {
        self.fastest = spectral_radius(jacobian, size);
        if h * self.fastest < SUSPECT * STABLE {
            self.rest = self.paused(2);
            return Verdict::Stay;
        }
        self.change(TRIAL)
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
        let rest = self.paused(4);
        self.change(rest)
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

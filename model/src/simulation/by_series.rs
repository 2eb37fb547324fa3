//! `taylor` and `auto`: by series where the motion has one, with dop853 where it has none.

use super::method::Method;
use crate::effects::Effects;
use crate::rotor::Rotor;
use crate::stored::stored;

/// What is known of the series of a run.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BySeries {
    /// Whether all laws are analytic, in the branches that they have.
    analytic: bool,
    /// Whether the next step is tried by series, and whether the last one went so.
    tried: bool,
    at_work: bool,
    /// Whether stability would hold its steps.
    held: bool,
    /// Steps until the series is tried again, and after how many it then was.
    rest: u32,
    pause: u32,
    /// How often the method was changed.
    changes: u32,
}

stored!(BySeries { analytic, tried, at_work, held, rest, pause, changes });

/// Steps with dop853 until the series is tried again; at first, and at most.
const PAUSE: u32 = 16;
const LONGEST_PAUSE: u32 = 1024;

impl BySeries {
    /// At the start of a run.
    pub fn new<E: Effects>(rotor: &Rotor<'_, E>) -> Self {
        let analytic = rotor.has_series();
        Self { analytic, tried: analytic, at_work: analytic, held: false, rest: 0, pause: PAUSE, changes: 0 }
    }

    /// A law has switched.
    pub fn look<E: Effects>(&mut self, rotor: &Rotor<'_, E>) {
        (self.analytic, self.rest) = (rotor.has_series(), 0);
    }

    /// An input was set, or a port goes on by another law: looks again where that decides.
    pub fn look_again<E: Effects>(&mut self, rotor: &Rotor<'_, E>) {
        if rotor.has_series() != self.analytic {
            self.look(rotor);
        }
    }

    /// The method of the next step; `held` tells whether stability holds explicit steps, of which those of dop853 are cheaper then.
    pub fn choose<E: Effects, const N: usize>(&mut self, method: &mut Method<N>, rotor: &Rotor<'_, E>, held: bool) {
        self.held = held;
        match (method.is_series(), self.analytic && !held, self.rest) {
            (true, false, _) => method.leave_series(rotor),
            (false, true, 0) => method.take_series(rotor),
            (false, true, _) => self.rest -= 1,
            (true, true, _) | (false, false, _) => {}
        }
        self.tried = method.is_series();
    }

    /// Whether the step that was done went by series.
    pub fn hear(&mut self, by_series: bool) {
        if by_series {
            self.pause = PAUSE;
        } else if self.tried {
            // It lasts for too short a time.
            self.rest = self.pause;
            self.pause = (2 * self.pause).min(LONGEST_PAUSE);
        }
        if by_series != self.at_work {
            (self.at_work, self.changes) = (by_series, self.changes.saturating_add(1));
        }
    }

    /// How often the method was changed.
    pub fn changes(&self) -> u32 {
        self.changes
    }

    /// Why it goes by series or by dop853.
    pub fn words<E: Effects>(&self, by_series: bool, rotor: &Rotor<'_, E>) -> String {
        match (by_series, rotor.no_series()) {
            (true, _) => "the motion has a power series".into(),
            (false, None) if self.held => "stability would hold the steps of its power series".into(),
            (false, None) => "its power series lasts for too short a time here".into(),
            (false, Some(cause)) => format!("the motion has no power series while {cause}"),
        }
    }
}

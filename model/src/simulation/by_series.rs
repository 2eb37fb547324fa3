//! `taylor`: by series where the motion has one, with dop853 where it has none.

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
    /// Steps until the series is tried again, and after how many it then was.
    rest: u32,
    pause: u32,
    /// How often the method was changed.
    changes: u32,
}

stored!(BySeries { analytic, tried, at_work, rest, pause, changes });

/// Steps with dop853 until the series is tried again; at first, and at most.
const PAUSE: u32 = 16;
const LONGEST_PAUSE: u32 = 1024;

/// Why a motion has none.
const NO_SERIES: &str = "the motion has no power series while a contact presses, a table is followed, a speed is imposed or the body \
    is unbalanced or not symmetric";

impl BySeries {
    /// At the start of a run.
    pub fn new<E: Effects>(rotor: &Rotor<'_, E>) -> Self {
        let analytic = rotor.has_series();
        Self { analytic, tried: analytic, at_work: analytic, rest: 0, pause: PAUSE, changes: 0 }
    }

    /// A law has switched.
    pub fn look<E: Effects>(&mut self, rotor: &Rotor<'_, E>) {
        (self.analytic, self.rest) = (rotor.has_series(), 0);
    }

    /// The method of the next step.
    pub fn choose<E: Effects, const N: usize>(&mut self, method: &mut Method<N>, rotor: &Rotor<'_, E>) {
        match (method.is_series(), self.analytic, self.rest) {
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

    /// What it does from time `t` \[s] on, and why.
    pub fn words(&self, by_series: bool, t: f64) -> String {
        match (by_series, self.analytic) {
            (true, _) if self.changes == 0 => "taylor takes power series, and dop853 where the motion has none".into(),
            (true, _) => format!("taylor goes on with power series from t = {t:?} s"),
            (false, true) => format!(
                "taylor goes on with dop853 from t = {t:?} s: a size passes zero here, where its law has no power series"
            ),
            (false, false) if self.changes == 0 => format!("taylor takes dop853: {NO_SERIES}"),
            (false, false) => format!("taylor goes on with dop853 from t = {t:?} s: {NO_SERIES}"),
        }
    }
}

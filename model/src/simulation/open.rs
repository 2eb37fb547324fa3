//! A motion that somebody else integrates: states, rates, and the events at which its chart changes.

use super::start::Motion;
use crate::effects::Effects;
use crate::integrate::{Cost, Refusal};
use crate::rotation::chart::crossed_exactly;
use crate::rotor::{LIMIT, Rotor};
use crate::state::{Coordinates, DISSIPATED, GAMMA, PHI, SUPPLIED, WITH_WORK, Whole};
use crate::stored::stored;
use crate::variables::Reading;
use nalgebra::Vector2;

/// A rotor whose state a host sets.
#[derive(Clone)]
pub struct Open<E> {
    rotor: Rotor<E>,
    /// [s]
    t: f64,
    /// φ with all its turns but those that it gains beside the chart from −e, which the rotor's `turns` count.
    state: Whole<f64>,
    /// γ [rad] at the end of the last completed step.
    gamma: Vector2<f64>,
    /// Total energy at the start [J].
    total_at_start: f64,
    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π.
    tilted: bool,
}

stored!(Open<E: Effects> { rotor, t, state, gamma, total_at_start, tilted });

impl<E: Effects> Open<E> {
    /// From a motion that shows `reading` at its start.
    pub(super) fn start(start: Motion<E>, reading: &Reading) -> Self {
        let Motion { rotor, state } = start;
        let total_at_start = reading.ledger.total_at_start;
        let mut open = Self { rotor, t: reading.motion.t, state, gamma: gamma(&state), total_at_start, tilted: false };
        open.watch_tilt();
        open
    }

    /// Nothing yet: a place for what was stored.
    pub(super) fn blank() -> Self {
        let state = [0.0; WITH_WORK];
        Self { rotor: Rotor::default(), t: 0.0, state, gamma: gamma(&state), total_at_start: 0.0, tilted: false }
    }

    /// The time [s].
    pub fn time(&self) -> f64 {
        self.t
    }

    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π.
    pub(super) fn has_tilted(&self) -> bool {
        self.tilted
    }

    /// The host's time [s].
    pub fn set_time(&mut self, t: f64) {
        self.t = t;
    }

    /// The host's state: its first numbers, or all.
    pub fn set_state(&mut self, state: &[f64]) {
        self.state[..state.len()].copy_from_slice(state);
    }

    /// Takes the inputs of these effects.
    pub fn hear(&mut self, effects: &E) {
        self.rotor.effects.hear(effects);
    }

    /// Whether anything can be calculated of the present state.
    pub fn admits(&self) -> Result<(), Refusal> {
        if !self.state.iter().all(|number| number.is_finite()) {
            return Err(Refusal("a state is infinite or not a number"));
        }
        self.rotor.reaches(gamma(&self.state), LIMIT)
    }

    /// The host completed a step: counts turns. Whether the chart should now be changed, at an event.
    pub fn complete_step(&mut self) -> bool {
        let now = gamma(&self.state);
        self.rotor.turns = self.turns();
        self.gamma = now;
        self.watch_tilt();
        self.rotor.chart.is_left_at(now)
    }

    /// At an event: goes on in the other chart where this one is left, which changes the state. Whether it did.
    pub fn settle_chart(&mut self) -> bool {
        let chart = self.rotor.chart;
        let now = gamma(&self.state);
        if !chart.is_left_at(now) {
            return false;
        }
        let phi = chart.axial_angle(self.turns(), self.state[PHI], now);
        let crossed = crossed_exactly(now);
        self.rotor.chart = chart.other();
        self.state[PHI] = self.rotor.chart.own_angle(phi, crossed).radians();
        self.state[GAMMA].copy_from_slice(crossed.as_slice());
        self.rotor.turns = 0.0;
        self.gamma = crossed;
        true
    }

    /// What the present state shows.
    pub(super) fn read(&self) -> Reading {
        let motion = self.rotor.motion(self.t, &self.state).when(self.t, self.turns());
        let work = [self.state[SUPPLIED], self.state[DISSIPATED]];
        Reading::new(motion, &self.rotor.effects, work, self.total_at_start, Cost::default())
    }

    /// The turns that go with the present γ, which came from that of the last completed step by the shorter way.
    fn turns(&self) -> f64 {
        self.rotor.turns + self.rotor.chart.turns_gained(self.gamma, gamma(&self.state))
    }

    fn watch_tilt(&mut self) {
        let tilted = self.rotor.motion(self.t, &self.state).axis().x < 0.0;
        self.tilted |= tilted && self.rotor.effects.needs_gamma();
    }
}

fn gamma(state: &Whole<f64>) -> Vector2<f64> {
    Coordinates::from_slice(state).gamma
}

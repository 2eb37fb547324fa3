//! What inputs are over the communication step that begins: what partners did so far, and polynomials through the last values.

use super::coupling::Coupling;
use super::partners::{Partner, Told};
use super::{Run, Simulation};
use crate::effects::{Block, Effects, Motion as Seen, follows_all_inputs};
use crate::energy::moving;
use crate::state::Kinematics;
use crate::variables::Instant;

impl<E: Effects, const N: usize> Simulation<E, N> {
    /// Adds what was exchanged at the communication point to what is known of the partners, and goes on by their laws to time `to` \[s].
    pub(super) fn update_partners(&mut self, to: f64) {
        let t = self.time().unwrap_or_default();
        let is_answered = self.parameters.effects.active().any(|block| block.is_answered(t));
        if !is_answered && !self.partners.iter().any(Partner::follows_polynomial) {
            return;
        }
        let Ok(&Instant { reading, .. }) = self.instant() else { return };
        // The communication point moves on: the reading would be stale.
        self.instant = None;
        let (told, partners) = (Told::by(&self.parameters.effects, to - t), &mut self.partners);
        let mut changes = false;
        self.parameters.effects.for_each_partner(|number, block| {
            let (partner, own) = (&mut partners[number], []);
            let before = *partner.law();
            if !(block.is_active() && block.is_answered(t)) {
                partner.go_unanswered(t);
            } else if let Some(exchange) = block.exchange(&Seen::new(&reading.motion, &own)) {
                partner.add(t, &exchange, &told.to(block));
            }
            changes |= !partner.law().is_like(&before);
        });
        if changes {
            self.hold();
        }
        let partners = &self.partners;
        self.parameters.effects.set_laws(|number| partners[number].law());
        if self.coupling.is_none() {
            self.look_at_coupling(&reading.motion, to - t);
        }
    }

    /// Shows the partners how their inputs go on.
    pub(super) fn show_partners_inputs(&mut self) {
        let (t, partners) = (self.time().unwrap_or_default(), &mut self.partners);
        self.parameters.effects.for_each_partner(|number, block| partners[number].begin(t, || block.acting(t)));
    }

    /// Whether the exchange with partners is wrong, where inputs are exchanged after this step \[s]; looked at where that is due.
    fn look_at_coupling(&mut self, motion: &Kinematics<f64>, step: f64) {
        let (mut is_doubted, mut is_fed, mut period) = (false, false, step);
        for partner in self.partners.iter_mut().filter(|partner| partner.is_due(motion.t)) {
            is_doubted |= partner.is_doubted();
            is_fed |= partner.feeds(moving(motion));
            period = partner.period(step).max(period);
        }
        let (true, Some(Run::Method(integration))) = (is_doubted || is_fed, &self.run) else { return };
        let (effects, partners) = (&self.parameters.effects, &self.partners);
        let told = Told::by(effects, step);
        let answers = |number: usize, block: &dyn Block| {
            let exchange = block.exchange(&Seen::new(motion, &[])).filter(|_| block.is_active());
            exchange.and_then(|exchange| partners[number].answers(&exchange, &told.to(block)))
        };
        let (bodies, t, state) = integration.reached();
        // Of steps that are done again, growth is not known.
        let found = match told.redone {
            true => Coupling { t, step, ..Coupling::default() },
            false => Coupling::of(&bodies.under(effects), t, state, answers, period, is_fed),
        };
        let wrong = partners.iter().map(Partner::wrong).fold(0.0, f64::max);
        let is_wrong = found.growth > 0.0 || partners.iter().any(Partner::is_wrong);
        self.coupling = is_wrong.then_some(Coupling { wrong, ..found });
    }

    /// Extrapolates inputs over the step that begins, where an effect does so.
    pub(super) fn extrapolate(&mut self) {
        const { assert!(follows_all_inputs::<E>(), "extrapolation.rs: MOST is less than this list has inputs") };
        let effects = &mut self.parameters.effects;
        let (mut extrapolated, mut number, mut changes) = (effects.clone(), 0, false);
        extrapolated.for_each_extrapolated(&mut |lag, signal| {
            let before = *signal;
            effects.extrapolate(number, lag, signal);
            if signal.goes_on_like(&before) {
                *signal = before;
            }
            changes |= *signal != before;
            number += 1;
        });
        if changes {
            self.hold();
        }
        self.parameters.effects.take_extrapolated(&extrapolated);
    }
}

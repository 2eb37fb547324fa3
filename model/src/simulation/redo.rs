//! Communication steps that are done again with what inputs were in them, once that is known. A run is kept as it was at the last point up to
//! which that is so.

use super::largest::Looks;
use super::partners::Told;
use super::{Run, Simulation};
use crate::effects::{Effects, Motion as Seen};
use crate::integrate::Fault;
use crate::variables::Instant;

impl<E: Effects, const N: usize> Simulation<E, N> {
    /// [`Simulation::advance_to`] from the time up to which inputs are `known` \[s]: what comes before is done again with what they were.
    pub(super) fn advance_from<L: Looks>(&mut self, known: f64, t: f64, looks: &mut L) -> Result<(), Fault> {
        self.hold();
        let (Some(Run::Method(before)), effects) = (self.run, self.parameters.effects.clone()) else {
            panic!("no run of a method was started");
        };
        let outcome = self.redo(known, &effects).and_then(|()| self.advance_to(t, looks));
        if let (Err(_), Some(Run::Method(integration))) = (&outcome, &mut self.run)
            && integration.time() < before.time()
        {
            integration.take_back(&before, &mut self.parameters.effects);
            self.parameters.effects = effects;
        }
        outcome
    }

    /// Goes back to the run up to which inputs were known before, and on from there to where they are `known` now \[s]. After that they are
    /// `extrapolated` again.
    fn redo(&mut self, known: f64, extrapolated: &E) -> Result<(), Fault> {
        let Self { run: Some(Run::Method(integration)), parameters, scratch, partners, .. } = self else {
            return Ok(());
        };
        if self.known.is_empty() {
            self.known.push(*integration);
        }
        let from = &mut self.known[0];
        let effects = &mut parameters.effects;
        let (mut interpolated, mut number) = (extrapolated.clone(), 0);
        interpolated.for_each_extrapolated(&mut |lag, signal| {
            effects.interpolate(number, lag, known, signal);
            number += 1;
        });
        effects.take_extrapolated(&interpolated);
        integration.take_back(from, effects);
        if from.time() < known {
            integration.advance(effects, scratch, known, &mut ())?;
            integration.hold(effects);
            *from = *integration;
        }
        if E::FACTS.partners > 0 {
            let Instant { reading, .. } = integration.read(effects);
            // No step begins here.
            let told = Told::by(effects, 0.0);
            effects.for_each_partner(|number, block| {
                if let Some(exchange) = block.exchange(&Seen::new(&reading.motion, &[])).filter(|_| block.is_active()) {
                    partners[number].redo(known, &exchange, &block.acting(known), &told.to(block));
                }
            });
            effects.set_laws(|number| partners[number].law());
        }
        effects.take_extrapolated(extrapolated);
        Ok(())
    }
}

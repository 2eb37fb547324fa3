//! A whole run without FMI: the scene's parameters and inputs, a method that steps ahead or a host that integrates, and
//! what the communication point shows.

mod auto;
mod by_series;
mod closest;
mod coupling;
mod divergence;
mod events;
mod exchange;
#[cfg(feature = "general")]
mod general;
mod growth;
mod inputs;
mod integration;
mod largest;
mod met;
mod method;
mod nominals;
mod partners;
mod plan;
mod rattle;
mod redo;
pub(crate) mod rest;
pub(crate) mod start;
mod tangents;
mod unheld;

pub use coupling::{Coupled, Coupling, LEAST_GROWTH, ORDERS};
pub use divergence::Divergence;
use exchange::Exchange;
pub use exchange::Settled;
#[cfg(feature = "general")]
pub use general::General;
pub use growth::{Growth, LINEAR, Linear, Unjudged};
pub use largest::{Deflection, Largest};
pub use partners::LAGS;
pub use rattle::Rattle;
pub use tangents::Tangents;
pub use unheld::Unheld;

use crate::body::frame::Frame;
use crate::effects::{Effects, InputSet, MOST_INDICATORS};
use crate::error::Invalid;
use crate::integrate::sizes::LEAST;
use crate::integrate::taylor::Scratch;
use crate::integrate::{Fault, Refusal};
use crate::rotation::Chart;
use crate::rotor;
use crate::signal::Signal;
use crate::state::{Layout, WITH_WORK};
use crate::stored::{Damaged, Stored, Walk, choice};
use crate::variable::Place;
use crate::variables::{Instant, Parameters, Reading, Start};
use integration::Integration;
use largest::Looks;
use nominals::Nominals;
use partners::Partner;
use start::{BESIDE, Motion};

/// Who integrates a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// A method of ours: co-simulation.
    #[default]
    Method,
    /// Somebody else, who asks for rates: model exchange.
    Host,
}

/// A rotor of the scene `E`, from its parameters to its motion, whose state has N numbers: [`WITH_WORK`] and the own states of
/// its effects. The effects live in the parameters, and everything that runs reads them there.
#[derive(Default)]
pub struct Simulation<E, const N: usize = WITH_WORK> {
    integrator: Integrator,
    parameters: Parameters<E>,
    run: Option<Run<N>>,
    /// Of each port.
    partners: Vec<Partner>,
    /// Whether an input was set since the last communication step: only then may a partner have answered.
    is_set: bool,
    /// That the exchange with partners is wrong, once that was found.
    coupling: Option<Coupling>,
    /// Where steps are done again with what inputs were in them: the run at the last time up to which that is known. One at most.
    known: Vec<Integration<N>>,
    /// What the communication point shows, once somebody asked.
    instant: Option<Instant<N>>,
    scratch: Scratch,
}

impl<E: Clone, const N: usize> Clone for Simulation<E, N> {
    fn clone(&self) -> Self {
        let &Self { integrator, ref parameters, run, ref partners, is_set, coupling, ref known, instant, scratch: _ } =
            self;
        let (parameters, partners, known) = (parameters.clone(), partners.clone(), known.clone());
        Self { integrator, parameters, run, partners, is_set, coupling, known, instant, scratch: Scratch::default() }
    }

    /// In place: by far the most of it is a run, which is else copied three times on its way.
    fn clone_from(&mut self, source: &Self) {
        let Self { integrator, parameters, run, partners, is_set, coupling, known, instant, scratch: _ } = source;
        self.parameters.clone_from(parameters);
        self.partners.clone_from(partners);
        self.known.clone_from(known);
        (self.integrator, self.run, self.is_set) = (*integrator, *run, *is_set);
        (self.coupling, self.instant) = (*coupling, *instant);
    }
}

/// A motion under way.
#[derive(Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "a run is kept in place, so that it needs no allocation")]
enum Run<const N: usize> {
    Method(Integration<N>),
    Exchange(Exchange<N>),
}

/// So many indicators of events are always there.
pub const ALWAYS_INDICATED: usize = Frame::INDICATORS;

/// Until it locates an event, a host may try states beyond the chart: to nearly 2π \[rad] their rates are smooth.
const TRIAL: f64 = 6.0;

/// A rotor of any scene. `General` is the same for programs that only run it.
#[cfg(feature = "scenes")]
pub type Any = Simulation<crate::effects::All, { numbers_of_state::<crate::effects::All>() }>;

/// How many numbers the state of a rotor under these effects has: without room for the work, where none of them could work or has own
/// states.
pub const fn numbers_of_state<E: Effects>() -> usize {
    Layout::new(E::FACTS.own, E::FACTS.could_work || E::FACTS.own > 0).count()
}

impl<E: Effects, const N: usize> From<Parameters<E>> for Simulation<E, N> {
    fn from(parameters: Parameters<E>) -> Self {
        Self::with(Integrator::Method, parameters)
    }
}

impl<E: Effects, const N: usize> Simulation<E, N> {
    /// How many continuous states a host integrates: the coordinates, the work integrals where an effect could work, and the own
    /// states of the effects.
    pub const STATES: usize = {
        let layout = E::FACTS.layout(N);
        assert!(layout.has_work() || !E::FACTS.could_work, "N is numbers_of_state::<E>()");
        layout.count_of_host(E::FACTS.could_work)
    };

    /// How many indicators of events a host sees: [`ALWAYS_INDICATED`] and those of the effects.
    pub const INDICATORS: usize = ALWAYS_INDICATED + {
        assert!(E::FACTS.indicators <= MOST_INDICATORS, "MOST_INDICATORS is less than this list has");
        E::FACTS.indicators
    };

    /// A simulation with these parameters.
    pub fn with(integrator: Integrator, parameters: Parameters<E>) -> Self {
        Self { integrator, parameters, ..Self::default() }
    }

    /// Who integrates.
    pub fn integrator(&self) -> Integrator {
        self.integrator
    }

    /// The parameters and inputs.
    pub fn parameters(&self) -> &Parameters<E> {
        &self.parameters
    }

    /// Sets a parameter; false where there is none at this place. It acts at the next [`Simulation::start`].
    pub fn set_parameter(&mut self, place: Place, value: f64) -> bool {
        self.instant = None;
        self.parameters.set(place, value)
    }

    /// Sets an input from the communication point on; false where there is none at this place.
    pub fn set_input(&mut self, place: Place, value: f64) -> bool {
        self.change_input(place, 0, |signal, t| signal.set(t, value))
    }

    /// Sets a derivative of an input, of order 1 to 3, at the communication point; false where there is no input.
    pub fn set_input_derivative(&mut self, place: Place, order: u32, value: f64) -> bool {
        self.change_input(place, order, |signal, t| signal.set_derivative(t, order, value))
    }

    fn change_input(&mut self, place: Place, order: u32, change: impl Fn(&mut Signal, f64)) -> bool {
        let t = self.time().unwrap_or_default();
        let (set, change) =
            (InputSet { row: place.row, order, t, goes_on: false }, |signal: &mut Signal| change(signal, t));
        let Some((block, _)) = self.parameters.effects.at(place) else { return false };
        let Some(changes) = block.would_change(set, &change) else { return false };
        if changes {
            self.hold();
        }
        let block = self.parameters.effects.at_mut(place).expect("it was there");
        block.change_input(set, &change);
        self.is_set = true;
        true
    }

    /// Before an input changes: a method keeps the communication point as it was. What is shown follows the input at once.
    fn hold(&mut self) {
        if let Some(Run::Method(integration)) = &mut self.run {
            integration.hold(&self.parameters.effects);
        }
        self.instant = None;
    }

    /// Starts the motion at time `t` \[s]; a relative tolerance \[1] given here stands in for that of the parameters.
    ///
    /// # Panics
    /// Where `t` is not finite.
    pub fn start(&mut self, t: f64, relative_tolerance: Option<f64>) -> Result<(), Invalid> {
        self.start_until(t, relative_tolerance, None)
    }

    /// [`Simulation::start`] of a run that is known to stop at `stop` \[s]: no step runs ahead of that, and no more
    /// motion is expected than comes about by then.
    pub fn start_until(&mut self, t: f64, relative_tolerance: Option<f64>, stop: Option<f64>) -> Result<(), Invalid> {
        self.begin(t, relative_tolerance, stop, None)
    }

    /// [`Simulation::start`] with another motion than that of the parameters; what effects measure from the start they measure from
    /// there.
    pub fn start_elsewhere(&mut self, t: f64, motion: &Start) -> Result<(), Invalid> {
        self.begin(t, None, None, Some(motion))
    }

    fn begin(
        &mut self,
        t: f64,
        relative_tolerance: Option<f64>,
        stop: Option<f64>,
        elsewhere: Option<&Start>,
    ) -> Result<(), Invalid> {
        assert!(t.is_finite(), "a run starts at a finite time, not at {t:?}");
        let mut parameters = self.parameters.clone();
        let solver = &mut parameters.setup.solver;
        solver.relative_tolerance = relative_tolerance.unwrap_or(solver.relative_tolerance);
        parameters.effects.for_each_signal(&mut |signal| signal.begin(t));
        parameters.check()?;
        let (start, instant) = match elsewhere {
            None => self.at_start(&mut parameters, t)?,
            Some(motion) => {
                let start = Motion::elsewhere(&mut parameters, motion, t);
                let instant = start.shows(&parameters.effects, t);
                (start, instant)
            }
        };
        let span = stop.map(|stop| stop - t);
        // From here on nothing is refused any more: what is refused leaves everything as it was.
        let effects = &parameters.effects;
        self.run = Some(match self.integrator {
            Integrator::Host => Run::Exchange(Exchange::start(effects, &start, &instant)),
            Integrator::Method => Run::Method(Integration::start(effects, &start, &instant, &parameters.setup, span)),
        });
        self.parameters.effects = parameters.effects;
        self.partners = vec![Partner::default(); E::FACTS.partners];
        (self.coupling, self.instant) = (None, None);
        self.known.clear();
        self.known.reserve_exact(usize::from(self.parameters.effects.known_until().is_some()));
        Ok(())
    }

    /// What the method goes on with and why, such as another one that `auto` takes; None where it is what the parameters say.
    pub fn auto(&self) -> Option<String> {
        match self.run.as_ref()? {
            Run::Method(integration) => integration.goes_on(&self.parameters),
            Run::Exchange(_) => None,
        }
    }

    /// How often that has changed.
    pub fn changes_of_method(&self) -> u32 {
        match &self.run {
            Some(Run::Method(integration)) => integration.changes(),
            Some(Run::Exchange(_)) | None => 0,
        }
    }

    /// Moves the communication point to time `t` \[s]. On a fault it stands at the last time reached.
    ///
    /// # Panics
    /// Before [`Simulation::start`], where a host integrates, or where `t` lies before the communication point or is not
    /// a number.
    pub fn advance(&mut self, t: f64) -> Result<(), Fault> {
        self.advance_seen(t, &mut ())
    }

    /// [`Simulation::advance`], where each step is looked at for the `largest` deflections, if there are any, and where the run ends where
    /// it diverges. Before an input is set, and at its end, [`Simulation::look`].
    ///
    /// # Panics
    /// As [`Simulation::advance`].
    pub fn advance_looking(&mut self, t: f64, largest: &mut Option<Largest>) -> Result<(), Fault> {
        self.advance_seen(t, largest)
    }

    /// Looks at the motion up to the communication point, where a method integrates.
    pub fn look(&self, largest: &mut Largest) {
        if let Some(Run::Method(integration)) = &self.run {
            largest.follow(integration, &self.parameters.effects, integration.time());
        }
    }

    fn advance_seen<L: Looks>(&mut self, t: f64, looks: &mut L) -> Result<(), Fault> {
        self.instant = None;
        let is_set = E::FACTS.partners > 0 && std::mem::take(&mut self.is_set);
        if is_set || self.partners.iter().any(Partner::follows_polynomial) {
            self.update_partners(t);
        }
        let from = self.time().unwrap_or_default();
        self.parameters.effects.step_from(from);
        if self.parameters.effects.extrapolates() {
            if let (true, Some(Run::Method(integration))) = (looks.looks(), &self.run) {
                looks.look(integration, &self.parameters.effects, integration.time());
            }
            self.extrapolate();
            if is_set {
                self.show_partners_inputs();
            }
        }
        match self.parameters.effects.known_until() {
            Some(known) => self.advance_from(known, t, looks)?,
            None => self.advance_to(t, looks)?,
        }
        if E::FACTS.imposes && self.parameters.effects.imposed::<f64>(t).is_some() {
            self.tell_of_step();
        }
        Ok(())
    }

    /// Moves the communication point to time `t` \[s] under the present inputs.
    fn advance_to<L: Looks>(&mut self, t: f64, looks: &mut L) -> Result<(), Fault> {
        let Some(Run::Method(integration)) = &mut self.run else {
            panic!("no run of a method was started");
        };
        if integration.advance_within_step(t) {
            return Ok(());
        }
        integration.advance(&mut self.parameters.effects, &mut self.scratch, t, looks)
    }

    /// [`Simulation::advance`], if the last step of the method reaches so far and no effect minds communication steps: then nothing
    /// but the time changes.
    ///
    /// # Panics
    /// Where `t` lies before the communication point or is not a number.
    #[inline(always)]
    pub fn advance_within_step(&mut self, t: f64) -> bool {
        if E::FACTS.imposes || self.parameters.effects.extrapolates() {
            return false;
        }
        let Some(Run::Method(integration)) = &mut self.run else { return false };
        let reaches = integration.advance_within_step(t);
        if reaches {
            self.instant = None;
        }
        reaches
    }

    /// Effects hear where a communication step ended.
    fn tell_of_step(&mut self) {
        if let Ok(Instant { reading, state }) = self.instant().copied() {
            self.parameters.effects.step_to(&reading.motion, &state[E::layout::<N>().own()]);
        }
    }

    /// The ports that go on by a law which they learnt, each as the bit of its number among them.
    pub fn learnt(&self) -> u32 {
        let learnt = self.partners.iter().enumerate().filter(|(_, partner)| partner.has_learnt());
        learnt.fold(0, |bits, (number, _)| bits | 1 << number)
    }

    /// The communication point \[s]; None before the start.
    #[inline(always)]
    pub fn time(&self) -> Option<f64> {
        match self.run.as_ref()? {
            Run::Method(integration) => Some(integration.time()),
            Run::Exchange(exchange) => Some(exchange.time()),
        }
    }

    /// The lowest and the highest ω_φ so far [rad/s]; None where the laws of all effects are known at every speed, or before the start.
    /// What is doubtful of them there: [`Effects::doubts`].
    pub fn speeds_met(&self) -> Option<[f64; 2]> {
        match self.run.as_ref()? {
            Run::Method(integration) => integration.speeds_met(&self.parameters.effects),
            Run::Exchange(exchange) => exchange.speeds_met(),
        }
    }

    /// Whether |γ| ever exceeded π/2 under a law that has no limit at π: a warning is due.
    pub fn has_tilted(&self) -> bool {
        match &self.run {
            Some(Run::Method(integration)) => integration.has_tilted(),
            Some(Run::Exchange(exchange)) => exchange.has_tilted(),
            None => false,
        }
    }

    /// What of the linear motion about the present state grows, as it was when that was seen first; looked at again where the spin
    /// has changed by some per cent.
    pub fn growth(&self) -> Option<Growth> {
        match self.run.as_ref()? {
            Run::Method(integration) => integration.growth(),
            Run::Exchange(exchange) => exchange.growth(),
        }
    }

    /// That the exchange with models at the ports is wrong, as that was when it was found.
    pub fn coupling(&self) -> Option<Coupling> {
        self.coupling
    }

    /// Where the motion diverges though something holds the rotor, as it was when that was found.
    pub fn divergence(&self) -> Option<Divergence> {
        match self.run.as_ref()? {
            Run::Method(integration) => integration.divergence(),
            Run::Exchange(exchange) => exchange.divergence(),
        }
    }

    /// Where contacts with a ring are chaotic, as that was when it was found. Where a host integrates, nobody looks.
    pub fn rattle(&self) -> Option<Rattle> {
        match self.run.as_ref()? {
            Run::Method(integration) => integration.rattle(),
            Run::Exchange(_) => None,
        }
    }

    /// In which directions nothing holds the rotor, while something does in others; asked where the run begins.
    pub fn unheld(&self) -> Option<Unheld> {
        let (bodies, t, state) = match self.run.as_ref()? {
            Run::Method(integration) => integration.reached(),
            Run::Exchange(exchange) => exchange.reached(),
        };
        Unheld::of(&bodies.under(&self.parameters.effects), t, state)
    }

    /// Where the search for what grows last failed, so that nobody knows whether the rotor is stable; None where a later one succeeded.
    pub fn unjudged(&self) -> Option<Unjudged> {
        match self.run.as_ref()? {
            Run::Method(integration) => integration.unjudged(),
            Run::Exchange(exchange) => exchange.unjudged(),
        }
    }

    /// What to warn of where the tilt ever was large and that matters ([`Simulation::has_tilted`]).
    pub fn warns_of_tilt(&self) -> Option<&'static str> {
        let words = "the tilt |gamma| exceeds pi/2; a spring or torque that follows gamma has no limit at pi, and beyond 3.1 rad no \
                     step is possible";
        self.has_tilted().then_some(words)
    }

    /// The value of a variable at the communication point, before the start as the parameters have it; None where there
    /// is none at this place. An error where the parameters are not possible.
    pub fn get(&mut self, place: Place) -> Result<Option<f64>, Invalid> {
        if Parameters::<E>::meta(place).is_some_and(|meta| !meta.has_start()) {
            self.read()?;
        }
        Ok(self.value(place))
    }

    /// [`Simulation::get`] without asking for a reading; None of a calculated variable where there was none.
    #[inline(always)]
    pub fn value(&self, place: Place) -> Option<f64> {
        self.parameters.value(place, self.time().unwrap_or_default(), self.instant.as_ref())
    }

    /// The values of Real variables that are at hand, by their value references; false, and the values are void, where one
    /// is not, or is not finite.
    #[inline(always)]
    pub fn reals_at_hand(&self, references: &[u32], values: &mut [f64]) -> bool {
        let Some(instant) = &self.instant else { return false };
        self.parameters.reals(references, values, instant)
    }

    /// What the communication point shows; before the start, what the parameters make of it.
    #[inline(always)]
    pub fn read(&mut self) -> Result<&Reading, Invalid> {
        Ok(&self.instant()?.reading)
    }

    /// The same with the state behind it.
    #[inline(always)]
    fn instant(&mut self) -> Result<&Instant<N>, Invalid> {
        if self.instant.is_none() {
            let effects = &self.parameters.effects;
            self.instant = Some(match &mut self.run {
                Some(Run::Method(integration)) => integration.read(effects),
                Some(Run::Exchange(exchange)) => exchange.read(effects),
                None => {
                    self.parameters.check()?;
                    let mut parameters = self.parameters.clone();
                    let (_, instant) = self.at_start(&mut parameters, 0.0)?;
                    self.parameters.effects = parameters.effects;
                    instant
                }
            });
        }
        Ok(self.instant.as_ref().expect("just made"))
    }

    /// The state at the communication point as a host sees it: coordinates, work where an effect could do some, own states of the
    /// effects, [`Simulation::STATES`] numbers.
    pub fn state(&mut self) -> Result<[f64; N], Invalid> {
        let state = match &self.run {
            Some(Run::Exchange(exchange)) => *exchange.state(),
            _ => self.instant()?.state,
        };
        Ok(Self::to_host(state))
    }

    /// The rates of the state at the communication point, units per second, as a host sees them.
    pub fn rates(&mut self) -> Result<[f64; N], Invalid> {
        self.rates_inside().map(Self::to_host)
    }

    fn rates_inside(&mut self) -> Result<[f64; N], Invalid> {
        let Instant { reading, state } = *self.instant()?;
        if self.admits().is_err() {
            // A state that a host only tries is not shown.
            self.instant = None;
        }
        Ok(rotor::whole_rates(&self.parameters.effects, &reading.motion, &state))
    }

    /// A state in the order of a host.
    fn to_host(state: [f64; N]) -> [f64; N] {
        std::array::from_fn(|n| state[Self::number_of_host(n)])
    }

    /// Where the state of a host's number stands.
    fn number_of_host(n: usize) -> usize {
        E::layout::<N>().of_host(n, E::FACTS.could_work)
    }

    /// How states and inputs differ from what they are, as derivatives go with them: of each place that is named, by its
    /// seed. Places of other variables count for nothing.
    pub fn tangents(&mut self, seeds: impl Iterator<Item = (Place, f64)>) -> Result<Tangents<E, N>, Invalid> {
        let instant = *self.instant()?;
        Ok(Tangents::new(&self.parameters, &instant, seeds))
    }

    /// How everything changes with time at the communication point, per second.
    pub fn time_derivatives(&mut self) -> Result<Tangents<E, N>, Invalid> {
        let rates = self.rates_inside()?;
        let instant = *self.instant()?;
        Ok(Tangents::along_motion(&self.parameters, &instant, &rates))
    }

    /// The motion that a host integrates, once it was started; None where a method of ours does.
    pub fn exchange(&mut self) -> Option<Hosted<'_, E, N>> {
        let Some(Run::Exchange(exchange)) = &mut self.run else { return None };
        self.instant = None;
        Some(Hosted { exchange, effects: &mut self.parameters.effects })
    }

    /// Whether anything can be calculated of the present state; always, where a method of ours reached it.
    #[inline(always)]
    pub fn admits(&self) -> Result<(), Refusal> {
        match &self.run {
            Some(Run::Exchange(exchange)) => exchange.admits(&self.parameters.effects, Chart::LIMIT),
            _ => Ok(()),
        }
    }

    /// What each continuous state of the host's counts with, in its unit.
    pub fn nominals(&self) -> [f64; N] {
        Self::to_host(self.nominals_inside(f64::INFINITY))
    }

    /// The indicators of events of a motion that a host integrates or will integrate: the first [`Simulation::INDICATORS`] count.
    pub fn indicators(&self) -> Result<[f64; ALWAYS_INDICATED + MOST_INDICATORS], Invalid> {
        let effects = &self.parameters.effects;
        if let Some(Run::Exchange(exchange)) = &self.run {
            return Ok(exchange.indicators(effects));
        }
        self.parameters.check()?;
        let mut parameters = self.parameters.clone();
        let (start, instant) = self.at_start(&mut parameters, 0.0)?;
        Ok(Exchange::start(&parameters.effects, &start, &instant).indicators(&parameters.effects))
    }

    /// Whether rates and indicators can be calculated of the present state, which may be one that a host only tries.
    pub fn admits_trial(&self) -> Result<(), Refusal> {
        match &self.run {
            Some(Run::Exchange(exchange)) => exchange.admits(&self.parameters.effects, TRIAL),
            _ => Ok(()),
        }
    }

    /// Whether a continuous state stands at this place.
    pub fn is_state(&self, place: Place) -> bool {
        self.parameters.number_in_state::<N>(place).is_some()
    }

    /// What the continuous state at this place counts with; None where there is none.
    pub fn nominal(&self, place: Place) -> Option<f64> {
        self.parameters.number_in_state::<N>(place).map(|n| self.nominals_inside(f64::INFINITY)[n])
    }

    fn nominals_inside(&self, span: f64) -> [f64; N] {
        let t = self.time().unwrap_or_default();
        let mut parameters = self.parameters.clone();
        let start = Motion::<N>::begins(&mut parameters, t).unwrap_or_else(|_| Motion::at_start(&mut parameters, t));
        Nominals::of(&parameters.effects, &start, t, span).each::<E>()
    }

    /// Below which place \[m], velocity [m/s], angular momentum [kg·m²/s] and tilt \[rad] errors are not compared with a smaller
    /// motion.
    pub fn least_sizes(&self) -> [f64; 4] {
        let span = match &self.run {
            Some(Run::Method(integration)) => integration.span(),
            _ => f64::INFINITY,
        };
        let nominals = Self::to_host(self.nominals_inside(span));
        [0, 3, 6, 9].map(|n| LEAST * BESIDE * nominals[n])
    }

    /// The start as the parameters make it, of which their effects hear, and what it shows. An error where it overflows.
    fn at_start(&self, parameters: &mut Parameters<E>, t: f64) -> Result<(Motion<N>, Instant<N>), Invalid> {
        let mut start = Motion::begins(parameters, t)?;
        if self.integrator == Integrator::Host {
            start.unwrap_turns::<E>();
        }
        let instant = start.shows(&parameters.effects, t);
        if !instant.reading.ledger.total().is_finite() {
            let total = |parameters: &Parameters<E>| {
                let mut parameters = parameters.clone();
                Motion::<N>::at_start(&mut parameters, t).shows(&parameters.effects, t).reading.ledger.total()
            };
            return Err(parameters.blamed(|parameters| total(parameters).is_finite()));
        }
        Ok((start, instant))
    }
}

/// A motion that a host integrates, under its effects.
pub struct Hosted<'s, E, const N: usize> {
    exchange: &'s mut Exchange<N>,
    effects: &'s mut E,
}

impl<E: Effects, const N: usize> Hosted<'_, E, N> {
    /// The host's time \[s].
    pub fn set_time(&mut self, t: f64) {
        self.exchange.set_time(t);
    }

    /// The host's state: its first numbers, or all.
    pub fn set_state(&mut self, state: &[f64]) {
        for (n, number) in state.iter().enumerate() {
            self.exchange.state_mut()[Simulation::<E, N>::number_of_host(n)] = *number;
        }
    }

    /// The host completed a step: counts turns. Whether the chart should now be changed, at an event.
    pub fn complete_step(&mut self) -> bool {
        self.exchange.complete_step(self.effects)
    }

    /// An event begins.
    pub fn enter_event(&mut self) {
        self.exchange.enter_event(self.effects);
    }

    /// The event is over.
    pub fn leave_event(&mut self) {
        self.exchange.leave_event();
    }

    /// At an event: goes on in the other chart where this one is left, and books the work of a jump. What of the state
    /// that changed.
    pub fn settle(&mut self) -> Settled {
        self.exchange.settle(self.effects)
    }
}

impl<E: Effects, const N: usize> Stored for Simulation<E, N> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { integrator, parameters, run, partners, is_set, coupling, known, instant, scratch: _ } = self;
        choice(integrator, &[Integrator::Method, Integrator::Host], walk)?;
        parameters.walk(walk)?;
        partners.resize(E::FACTS.partners, Partner::default());
        partners.iter_mut().try_for_each(|partner| partner.walk(walk))?;
        parameters.effects.set_laws(|number| partners[number].law());
        is_set.walk(walk)?;
        coupling.walk(walk)?;
        let mut redoes = !known.is_empty();
        redoes.walk(walk)?;
        known.resize(usize::from(redoes), Integration::blank());
        known.iter_mut().try_for_each(|known| known.walk(walk))?;
        // What it shows follows from the rest.
        *instant = None;
        let mut kind = match run {
            None => 0,
            Some(Run::Method(_)) => 1,
            Some(Run::Exchange(_)) => 2,
        };
        kind.walk(walk)?;
        match (kind, &run) {
            (0, _) => *run = None,
            (1, Some(Run::Method(_))) | (2, Some(Run::Exchange(_))) => {}
            (1, _) => *run = Some(Run::Method(Integration::blank())),
            (2, _) => *run = Some(Run::Exchange(Exchange::blank())),
            _ => return Err(Damaged),
        }
        let (integrates, fits) = match run {
            None => return Ok(()),
            Some(Run::Method(integration)) => {
                integration.walk(walk)?;
                (Integrator::Method, known.iter().chain([&*integration]).all(|run| run.is_of(parameters)))
            }
            Some(Run::Exchange(exchange)) => {
                exchange.walk(walk)?;
                (Integrator::Host, exchange.is_of(parameters))
            }
        };
        // A run begins with parameters that were checked.
        if integrates == *integrator && fits && parameters.check().is_ok() { Ok(()) } else { Err(Damaged) }
    }
}

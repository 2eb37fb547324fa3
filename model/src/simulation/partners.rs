//! What the partners at ports do between communication points, from how they answered so far.
//!
//! A master holds the load of a port over a communication step, and many deliver it a step late. With a partner that answers the motion, as a
//! bearing does, that feeds a whirl. So each port keeps what it showed and what was answered, fits the slopes of the loads to that, and goes
//! on by them where they predicted the last answers better than anything else, or by the polynomial through the last loads where that did.

mod work;

use crate::effects::partner::{LOADS, Loads, POWERS, SHOWN, Shown, Slopes};
use crate::effects::{Acting, Block, Effects, Exchange, Law};
use crate::signal::{NODES, goes_on};
use crate::stored::{Damaged, Stored, Walk, stored};
use nalgebra::{SMatrix, SVector};
use std::ops::Range;
use work::{End, Path, Work};

/// A partner: what it was shown, what it answered, and what is made of that.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Partner {
    exchanges: Exchanges,
    /// Of each lag, by each ridge.
    fits: [[Fit; RIDGES.len()]; LAGS],
    /// How far the last loads were off as polynomials of degree 0, 1 and 2 through those before, squared \[N²].
    polynomials: [f64; 3],
    law: Law,
    /// Whether the law was given.
    is_given: bool,
    work: Work,
    /// How often it answered, where it is watched.
    answered: u32,
    /// Energy of the motion without the spin, and what the exchange had brought in, when that was last looked at \[J].
    energies: [f64; 2],
}

stored!(Partner { exchanges, fits, polynomials, law, is_given, work, answered, energies });

/// A partner as its answers look, where no law of it is in force.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answers {
    /// How they change with what it is shown.
    pub slopes: Slopes,
    /// How many communication steps they are late.
    pub lag: usize,
    /// What it is shown now.
    pub shown: Shown,
}

/// The last exchanges, the latest first.
#[derive(Clone, Copy, Debug, Default)]
struct Exchanges {
    /// How many are known.
    known: usize,
    /// When they were \[s].
    t: [f64; POINTS],
    shown: [Shown; POINTS],
    /// By how much places were shown ahead \[s].
    ahead: [f64; POINTS],
    /// By their [measures](Measures).
    loads: [Loads; POINTS],
}

impl Stored for Exchanges {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let mut known = self.known as u32;
        known.walk(walk)?;
        self.known = known as usize;
        self.t.walk(walk)?;
        self.shown.walk(walk)?;
        self.ahead.walk(walk)?;
        self.loads.walk(walk)?;
        if self.known <= POINTS { Ok(()) } else { Err(Damaged) }
    }
}

/// Slopes by their [measures](Measures), and how far the last loads were off by them, squared \[N²].
#[derive(Clone, Copy, Debug, Default)]
struct Fit {
    slopes: Slopes,
    missed: f64,
}

stored!(Fit { slopes, missed });

/// Loads may be the answer to what is shown now, or was shown a communication step before.
pub const LAGS: usize = 2;

/// So many changes are fitted at a time, and so many exchanges are kept for that.
const CHANGES: usize = 7;
const POINTS: usize = CHANGES + LAGS;

/// So many of the loads are forces, the rest moments; and so much of what is shown is a place, the rest a lean.
const WAYS: usize = 3;

/// What is shown of leans, and of how they change.
const TURNS: [usize; 4] = [3, 4, LOADS + 3, LOADS + 4];

/// What changes may leave over in a fit, relative to their size \[1]: little suits linear bearings, much suits films.
const RIDGES: [f64; 3] = [1e-8, 1e-3, 1e-1];

/// A change counts by this part of the one after it in a fit, and in what was missed \[1].
const FADES: f64 = 0.8;
const FORGETS: f64 = 0.5;

/// Velocities count as the ways of this time \[s].
const TIME: f64 = 1e-3;

/// A fit is trusted where it missed the last loads by at most this part of what holding them did, and a line and a parabola through those
/// before: a script's forces, to which the rotor answers, look like a partner's \[1].
const TRUSTED: f64 = 0.3;

/// Fits that missed less than this part of that are alike \[1].
const ALIKE: f64 = 1e-6;

/// A polynomial is not trusted over a step that is so much longer than the last one, or shorter: steps without an answer may follow \[1].
const LONGER: f64 = 1.5;

/// Answers that are later than a fit takes them for look as if something drove the place: by its velocity times the delay and the stiffness. This
/// part of a step is enough to say so \[1].
const TOO_EARLY: f64 = 0.3;

/// So many exchanges must be known before a fit is trusted.
const ENOUGH: usize = 6;

/// Number of answers after which a coupling is looked at, and again whenever that number has doubled.
const LOOKED_AT: u32 = 16;

/// Error of the work at a port, relative to the work exchanged, from which on the coupling is checked \[1].
const LARGE: f64 = 0.15;

/// A motion whose energy has become larger by this factor between two looks, of which a port brought in this part, is fed by the exchange \[1].
const GAINED: f64 = 4.0;
const FED: f64 = 0.1;

/// Error that proves a wrong coupling by itself \[1]: in a short run, after [`STEADY`] answers, and under a learnt law or where steps are done
/// again.
const BEYOND_DOUBT: f64 = 0.7;
const STEADY: u32 = 64;
const BEYOND_DOUBT_STEADILY: f64 = 0.4;
const BEYOND_DOUBT_LEARNT: f64 = 0.2;

/// A law may drive the place so strongly at most: acceleration by way times the step squared, and by velocity times the step \[1].
const DRIVES: f64 = 0.05;

impl Partner {
    /// The law to go on with.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// Whether it is one that was learnt.
    pub fn has_learnt(&self) -> bool {
        self.law.is_on && !self.is_given
    }

    /// Whether it is a polynomial that was learnt: loads go on whatever the place does.
    pub fn follows_polynomial(&self) -> bool {
        self.has_learnt() && self.law.has_no_slopes()
    }

    /// Is called when nothing was answered at the communication point `t` \[s]: loads no longer go on as a polynomial.
    pub fn go_unanswered(&mut self, t: f64) {
        if self.follows_polynomial() && t > self.law.since {
            self.law = Law { is_on: false, rest: Default::default(), ..self.law };
        }
    }

    /// Adds what was exchanged at the communication point `t` \[s].
    pub fn add(&mut self, t: f64, exchange: &Exchange, told: &Told) {
        let step = t - self.exchanges.t[0];
        if self.exchanges.known > 0 && step <= 0.0 {
            // A step that is done again begins where it began.
            return;
        }
        let measures = Measures::of(exchange);
        if self.exchanges.add(t, &self.law, exchange, &measures) {
            (self.fits, self.polynomials) = Default::default();
            self.work.forget();
            self.answered = 0;
        }
        let known = self.exchanges.known;
        let lags = told.lags(exchange);
        let given = exchange.given.map(|slopes| measures.measured(&slopes));
        // Of a drive nothing is learnt, and it is not watched.
        if !exchange.turns_along {
            self.answered = self.answered.saturating_add(1);
            for (degree, missed) in self.polynomials.iter_mut().enumerate() {
                // No polynomial goes through more points than there are.
                let points = (degree + 1).min(known - 1);
                *missed = FORGETS * *missed + if points > 0 { self.exchanges.off(points) } else { 0.0 };
            }
            for lag in lags.clone().filter(|_| known > 1) {
                self.exchanges.fit(lag, given, &measures, &mut self.fits[lag]);
            }
        }
        let mut error = self.law.error;
        if known > 1 && !told.redone {
            // A law is the answer to what its own lag says.
            let of_law = || self.best(lags.clone(), |_| true).map(|(lag, _)| lag).filter(|_| self.law.is_on);
            let lag = told.lag().or_else(of_law).or_else(|| self.late_by(lags.clone())).unwrap_or_default();
            let late = exchange.late(lag);
            let [excess, exchanged] = self.work.count(&self.exchanges, &self.law, &measures.loads, [lag, late]);
            error += excess;
            if !exchange.turns_along {
                self.work.sum(excess, exchanged);
            }
        }
        let ahead = if known > 1 { exchange.ahead * step } else { 0.0 };
        let law = self.chosen(told, exchange, &measures).unwrap_or_default();
        if law.is_on && !law.has_no_slopes() {
            self.work.follow_law();
        }
        self.law = if law.is_on || ahead != 0.0 { Law { since: t, at: exchange.at, ahead, ..law } } else { law };
        self.law.error = error;
        self.is_given = given.is_some();
        self.work.begin([exchange.loads, Loads::zeros(), Loads::zeros(), Loads::zeros()]);
    }

    /// What the inputs are from `t` \[s] on, where they are extrapolated, as coefficients of the powers of the time.
    pub fn begin(&mut self, t: f64, acting: impl FnOnce() -> Acting) {
        if self.exchanges.known > 0 && self.exchanges.t[0] == t {
            self.work.begin(acting());
        }
    }

    /// Is called after the step up to time `t` \[s] was done again under these inputs, with what is shown there.
    pub fn redo(&mut self, t: f64, exchange: &Exchange, acting: &Acting, told: &Told) {
        let (measures, [held, ..]) = (Measures::of(exchange), self.polynomials);
        let lag = told.lag().or_else(|| self.late_by(told.lags(exchange))).unwrap_or_default();
        let best = self.best(lag..LAGS.min(lag + 1), |fit| fit.missed < TRUSTED * TRUSTED * held);
        let slopes = best.map_or(Slopes::zeros(), |(_, fit)| measures.in_units(&fit.slopes));
        // The last answer, had the partner been shown this: f + J (x − x_s)
        let change = slopes * (exchange.at - self.exchanges.shown[lag]);
        let answer = self.exchanges.loads[0].component_div(&measures.loads) + change;
        let [excess, exchanged] = self.work.redo(End { t, at: exchange.at, answer }, acting);
        self.law.error += excess;
        if !exchange.turns_along {
            self.work.sum(excess, exchanged);
        }
    }

    /// Whether the coupling is to be looked at where it answered at the communication point `t` \[s]; at its first answer, to know with which
    /// energy the motion began.
    pub fn is_due(&self, t: f64) -> bool {
        let is_time = self.answered == 1 || self.answered >= LOOKED_AT;
        is_time && self.answered.is_power_of_two() && self.exchanges.t[0] == t
    }

    /// The time between its answers \[s], where a communication step takes `step` \[s]: it may answer seldom.
    pub fn period(&self, step: f64) -> f64 {
        let last = self.exchanges.t[0] - self.exchanges.t[1];
        if self.exchanges.known > 1 && last > LONGER * step { last } else { step }
    }

    /// Whether it does much work too much or too little.
    pub fn is_doubted(&self) -> bool {
        self.wrong() > LARGE
    }

    /// Whether it brought in a good part of what the motion has gained since it was last looked at: its energy without the spin is `moving` now
    /// \[J].
    pub fn feeds(&mut self, moving: f64) -> bool {
        let [before, error] = std::mem::replace(&mut self.energies, [moving, self.law.error]);
        moving > GAINED * before && self.law.error - error > FED * (moving - before)
    }

    /// The part by which the coupling does too much or too little work, of what goes through \[1].
    pub fn wrong(&self) -> f64 {
        self.work.wrong()
    }

    /// Whether that alone says that the coupling is wrong.
    pub fn is_wrong(&self) -> bool {
        let beyond_doubt = match self {
            _ if self.work.is_redone() || self.has_learnt() && !self.follows_polynomial() => BEYOND_DOUBT_LEARNT,
            _ if self.answered >= STEADY => BEYOND_DOUBT_STEADILY,
            _ => BEYOND_DOUBT,
        };
        self.wrong() > beyond_doubt
    }

    /// Its answers as they look; None where a law is in force, or where they were not predicted well.
    pub fn answers(&self, exchange: &Exchange, told: &Told) -> Option<Answers> {
        let (lag, fit) = self.best(told.lags(exchange), |_| true)?;
        let [held, ..] = self.polynomials;
        let counts = !self.law.is_on && fit.missed < TRUSTED * TRUSTED * held;
        let slopes = Measures::of(exchange).in_units(&fit.slopes);
        counts.then_some(Answers { slopes, lag, shown: exchange.at })
    }

    /// What was learnt: how many steps answers are late, slopes, and as a polynomial of which degree what these leave goes on.
    fn learnt(&self, told: &Told, exchange: &Exchange, measures: &Measures) -> Option<(usize, Slopes, usize)> {
        // Where inputs are extrapolated, somebody has decided how loads go on.
        if !exchange.learns || told.order > 0 || told.redone || self.exchanges.known < ENOUGH {
            return None;
        }
        let step = self.exchanges.t[0] - self.exchanges.t[1];
        let best = self.best(told.lags(exchange), |fit| {
            let is_best = self.polynomials.iter().all(|missed| fit.missed < TRUSTED * TRUSTED * missed);
            is_best && drives(&fit.slopes, step) * exchange.yielding <= DRIVES && !looks_too_early(&fit.slopes, step)
        });
        if let Some((lag, fit)) = best {
            return Some((lag, measures.in_units(&fit.slopes), 0));
        }
        let [held, line, parabola] = self.polynomials;
        let degree = if parabola < TRUSTED * TRUSTED * line { 2 } else { 1 };
        let is_even = told.step <= LONGER * step && step <= LONGER * told.step;
        let is_trusted = line.min(parabola) < TRUSTED * TRUSTED * held && is_even;
        is_trusted.then(|| (told.lag().unwrap_or_default(), Slopes::zeros(), degree))
    }

    /// Of the fits that count, the one that predicted the last answers best, and its lag.
    fn best(&self, lags: Range<usize>, counts: impl Fn(&Fit) -> bool) -> Option<(usize, &Fit)> {
        let fits = lags.flat_map(|lag| self.fits[lag].iter().map(move |fit| (lag, fit))).filter(|(_, fit)| counts(fit));
        fits.min_by(|(_, one), (_, other)| one.missed.total_cmp(&other.missed))
    }

    /// By how many steps its answers are late: the least number that predicts them, since of a plain vibration each does.
    fn late_by(&self, lags: Range<usize>) -> Option<usize> {
        let [held, ..] = self.polynomials;
        let least = |lag: usize| self.fits[lag].iter().map(|fit| fit.missed).fold(f64::INFINITY, f64::min);
        let missed = |lag: &usize| least(*lag).max(ALIKE * ALIKE * held);
        lags.min_by(|one, other| missed(one).total_cmp(&missed(other)))
    }

    /// The law to go on with; None where none is to be trusted.
    fn chosen(&self, told: &Told, exchange: &Exchange, measures: &Measures) -> Option<Law> {
        let (lag, slopes, order) = match exchange.given {
            None => self.learnt(told, exchange, measures)?,
            Some(slopes) => {
                let best = self.best(told.lags(exchange), |_| true).map(|(lag, _)| lag);
                (told.lag().or(best)?, slopes, told.order)
            }
        };
        let leans = TURNS.iter().any(|n| slopes.column(*n).iter().any(|slope| *slope != 0.0));
        let turns = leans || slopes.fixed_rows::<2>(3).iter().any(|slope| *slope != 0.0);
        let (shown, late) = (self.exchanges.shown[lag], exchange.late(lag));
        let rest = match order.min((self.exchanges.known - 1).saturating_sub(late)).min(POINTS - 1 - lag) {
            0 if exchange.turns_along => {
                // g = −J v_s s
                let rate = -slopes.fixed_columns::<LOADS>(0) * shown.fixed_rows::<LOADS>(LOADS);
                [rate * (self.exchanges.t[0] - self.exchanges.t[late]), rate, Loads::zeros()]
            }
            0 => Default::default(),
            degree => self.exchanges.rest(degree, late, |n| {
                // g = f_s − J x_s
                self.exchanges.loads[n].component_div(&measures.loads) - slopes * self.exchanges.shown[n + lag]
            }),
        };
        Some(Law { is_on: true, turns, slopes, shown, rest, ..Law::default() })
    }
}

/// What is said of inputs.
pub(super) struct Told {
    /// By how many communication steps they are late, where that is given \[1].
    lag: Option<f64>,
    /// As polynomials of which degree they go on.
    order: usize,
    /// Whether steps are done again with what they were.
    pub redone: bool,
    /// The communication step that begins \[s].
    step: f64,
}

impl Told {
    /// By these effects, at the start of this communication step \[s].
    pub fn by(effects: &impl Effects, step: f64) -> Self {
        Self { lag: effects.lag(), order: effects.order(), redone: effects.known_until().is_some(), step }
    }

    /// What holds for this one, which may have a lag of its own.
    pub fn to(&self, block: &dyn Block) -> Self {
        Self { lag: block.lag().or(self.lag), ..*self }
    }

    /// By how many whole communication steps they are late, where that is given.
    fn lag(&self) -> Option<usize> {
        // No more steps are remembered.
        self.lag.map(|lag| (lag.round() as usize).min(POINTS - 1))
    }

    /// By how many steps answers may be late; none that is fitted where it is later.
    fn lags(&self, exchange: &Exchange) -> Range<usize> {
        match self.lag() {
            None if exchange.turns_along => 0..1,
            None => 0..LAGS,
            Some(lag) => lag..LAGS.min(lag + 1),
        }
    }
}

impl Exchanges {
    /// Adds one; returns whether those before say nothing of the partner.
    fn add(&mut self, t: f64, law: &Law, exchange: &Exchange, measures: &Measures) -> bool {
        let shown = law.shows(exchange.at);
        let loads = exchange.loads.component_mul(&measures.loads);
        if self.known == 0 {
            // Before the first exchange all was as it is there.
            (self.t, self.shown, self.loads) = ([t; POINTS], [shown; POINTS], [loads; POINTS]);
            self.ahead = [law.ahead; POINTS];
        }
        self.t.rotate_right(1);
        self.shown.rotate_right(1);
        self.ahead.rotate_right(1);
        self.loads.rotate_right(1);
        (self.t[0], self.shown[0], self.ahead[0], self.loads[0]) = (t, shown, law.ahead, loads);
        self.known = (self.known + 1).min(POINTS);
        if exchange.given.is_some() {
            return false;
        }
        // Who answers with forces alone is a bearing at a point.
        if !self.loads.iter().any(has_moment) {
            self.shown.iter_mut().for_each(|shown| TURNS.iter().for_each(|n| shown[*n] = 0.0));
        }
        // Loads that stay while the place moves are no answer: a script's, or samples. The first may be late.
        let stays = self.known > 2 && self.loads[0] == self.loads[1] && self.shown[0] != self.shown[1];
        let begins_to_turn = has_moment(&self.loads[0]) && !has_moment(&self.loads[1]);
        if stays || begins_to_turn {
            self.known = 1;
        }
        stays || begins_to_turn
    }

    /// Place and motion, without what is shown ahead.
    fn at(&self, n: usize) -> Shown {
        let shown = &self.shown[n];
        Shown::from_fn(|m, _| if m < LOADS { shown[m] - self.ahead[n] * shown[LOADS + m] } else { shown[m] })
    }

    /// The way to this one from the one before.
    fn path(&self, to: usize) -> Path {
        Path { from: self.at(to + 1), to: self.at(to), step: self.t[to] - self.t[to + 1] }
    }

    /// How what a law leaves of the loads goes on, which is so much at the last exchanges, late by so many communication steps: by powers of the
    /// time from the last exchange on.
    fn rest(&self, degree: usize, late: usize, left: impl Fn(usize) -> Loads) -> [Loads; POWERS] {
        let back = |n: usize| n.min(degree);
        let times = std::array::from_fn(|n| self.t[back(n) + late]);
        let left: [Loads; NODES] = std::array::from_fn(|n| left(back(n)));
        let mut rest = [Loads::zeros(); POWERS];
        for load in 0..LOADS {
            let powers = goes_on(self.t[0], times, left.map(|left| left[load]), degree);
            rest.iter_mut().zip(powers).for_each(|(rest, power)| rest[load] = power);
        }
        rest
    }

    /// How far the last loads are off the polynomial through so many before, squared \[N²].
    fn off(&self, points: usize) -> f64 {
        // Newton's differences
        let mut differences = self.loads;
        for order in 1..=points {
            for n in 0..=points - order {
                differences[n] -= differences[n + 1];
            }
        }
        differences[0].norm_squared()
    }

    /// Judges the slopes of loads that are late by `lag` communication steps by the last loads, and fits them, unless they are given.
    fn fit(&self, lag: usize, given: Option<Slopes>, measures: &Measures, fits: &mut [Fit]) {
        let change = |n: usize| (self.shown[n] - self.shown[n + 1]).component_mul(&measures.shown);
        let (last, answer) = (change(lag), self.loads[0] - self.loads[1]);
        for fit in &mut *fits {
            fit.slopes = given.unwrap_or(fit.slopes);
            fit.missed = FORGETS * fit.missed + (answer - fit.slopes * last).norm_squared();
        }
        if given.is_some() {
            return;
        }
        // A bearing at a point answers places with forces; what is left out is 0.
        let turns = |fit: &Fit| fit.slopes.fixed_rows::<2>(3).iter().any(|slope| *slope != 0.0);
        if self.loads.iter().any(has_moment) || fits.iter().any(turns) {
            self.fit_to::<LOADS, SHOWN>(lag, change, fits);
        } else {
            self.fit_to::<WAYS, { 2 * WAYS }>(lag, change, fits);
        }
    }

    /// Fits the first `L` loads to the first `L` places and their velocities, by these changes of what was shown.
    fn fit_to<const L: usize, const S: usize>(&self, lag: usize, change: impl Fn(usize) -> Shown, fits: &mut [Fit]) {
        let number = |n: usize| if n < L { n } else { LOADS + n - L };
        let mut changes = SMatrix::<f64, S, CHANGES>::zeros();
        let mut answers = SMatrix::<f64, L, CHANGES>::zeros();
        let mut weight = 1.0;
        for n in 0..CHANGES.min(self.known - lag - 1) {
            let change = change(lag + n);
            let size = change.norm();
            if size > 0.0 {
                let (part, answer) = (weight / size, self.loads[n] - self.loads[n + 1]);
                changes.set_column(n, &SVector::<f64, S>::from_fn(|row, _| change[number(row)] * part));
                answers.set_column(n, &(answer.fixed_rows::<L>(0) * part));
            }
            weight *= FADES;
        }
        let products = changes.transpose() * changes;
        for (fit, ridge) in fits.iter_mut().zip(RIDGES) {
            // eq. 125: J + (Δf − J Δx)(Δxᵀ Δx + ε)⁻¹ Δxᵀ, the least change that fits
            let Some(solved) = (products + SMatrix::identity() * ridge).cholesky() else { continue };
            let slopes = SMatrix::<f64, L, S>::from_fn(|load, n| fit.slopes[(load, number(n))]);
            let left = answers - slopes * changes;
            let fitted = slopes + (changes * solved.solve(&left.transpose())).transpose();
            if !fitted.iter().all(|slope| slope.is_finite()) {
                fit.slopes = Slopes::zeros();
                continue;
            }
            for n in 0..S {
                fit.slopes.fixed_view_mut::<L, 1>(0, number(n)).copy_from(&fitted.column(n));
            }
        }
    }
}

/// Whether loads have a moment.
fn has_moment(loads: &Loads) -> bool {
    loads[WAYS] != 0.0 || loads[WAYS + 1] != 0.0
}

/// In which measures all that is shown, and all loads, count alike: leans times the radius of gyration and moments over it, velocities
/// times [`TIME`].
struct Measures {
    shown: Shown,
    loads: Loads,
}

impl Measures {
    fn of(exchange: &Exchange) -> Self {
        let turned = |n: usize| n % LOADS >= 3;
        let way = |n: usize| if turned(n) { exchange.gyration } else { 1.0 };
        Self {
            shown: Shown::from_fn(|n, _| if n < LOADS { way(n) } else { way(n) * TIME }),
            loads: Loads::from_fn(|n, _| 1.0 / way(n)),
        }
    }

    /// Slopes in these measures.
    fn measured(&self, slopes: &Slopes) -> Slopes {
        Slopes::from_fn(|load, n| slopes[(load, n)] * self.loads[load] / self.shown[n])
    }

    /// Measured slopes in their units.
    fn in_units(&self, slopes: &Slopes) -> Slopes {
        Slopes::from_fn(|load, n| slopes[(load, n)] * self.shown[n] / self.loads[load])
    }
}

/// Whether a fit of measured slopes looks as if answers were later, by a good part of this step \[s].
fn looks_too_early(slopes: &Slopes, step: f64) -> bool {
    let drives = (0..LOADS).map(|n| slopes[(n, LOADS + n)]).fold(f64::NEG_INFINITY, f64::max) * TIME;
    let stiffness = slopes.fixed_columns::<LOADS>(0).norm();
    drives > TOO_EARLY * stiffness * step
}

/// How strongly a law drives the place in this step \[s], at most, by measured slopes \[kg].
fn drives(slopes: &Slopes, step: f64) -> f64 {
    let strongest = |from: usize| {
        let half = slopes.fixed_columns::<LOADS>(from);
        let symmetric = (half + half.transpose()) * 0.5;
        // Gershgorin: no eigenvalue is larger.
        let bounds = (0..LOADS).map(|n| {
            symmetric[(n, n)] + symmetric.row(n).iter().map(|a| a.abs()).sum::<f64>() - symmetric[(n, n)].abs()
        });
        bounds.fold(f64::NEG_INFINITY, f64::max)
    };
    (strongest(0) * step * step).max(strongest(LOADS) * TIME * step)
}

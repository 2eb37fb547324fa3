//! Random scenes: whatever a scene is, `auto` answers within its tolerance of how far the motion goes, or says that it cannot.
//!
//! `SPLIT_ROTOR_SCENE_SEED=14017 cargo test -p split-rotor-model --test all auto_keeps -- --nocapture` tells all of one
//! scene, whose number the table has: three digits that count it within its seed, before them the seed. Seed 0 are those that
//! are always among them. `UPDATE_GOLDEN=1` writes the table of `docs/random-scenes.md`.

mod cost;
pub mod dice;
mod draw;
mod fixed;
mod judge;
mod mutants;
mod newer;
mod play;
mod report;
mod timing;
mod trial;
mod truth;

use crate::harness::largest;
use judge::{TOLERANCES, Verdict};
use play::Method;
use report::Row;
use std::collections::BTreeMap;
use std::time::{Duration, Instant, SystemTime};
use trial::Trial;
use truth::Truth;

/// The seeds that are always drawn from, the first in every run, the others in the long ones; and how many scenes each draws.
const SEEDS: [u64; 3] = [14, 2018, 31415];
const OF_A_SEED: u64 = 250;

/// What the scenes of a day found: speeds that fall through nodes of a table at once, an input that makes a shaft slide on its ring while
/// `stiff` follows it, friction that turns within nanoseconds, long series of a rotor that wobbles, a jump past a contact, an end before
/// a spring gives way, a shaft that sticks to its ring, a small nutation of an axis that drifts, which a probe sees, a whirl that has decayed between two points.
const FOUND: [u64; 10] =
    [505_566, 507_845, 501_449, 20_782_623, 502_827, 507_266, 20_784_466, 20_786_799, 20_787_157, 10_238_165_185];

/// Scenes that are drawn in the long test, and how long it goes on to draw where a machine is slow.
const OF_A_DRAW: u64 = 500;
const DRAWN_FOR: Duration = Duration::from_secs(150);

/// A scene is drawn anew so often until one is fit.
const ATTEMPTS: u64 = 50;

/// The number of a scene: its seed, and three digits within it.
fn number(seed: u64, n: u64) -> u64 {
    1000 * seed + n
}

/// The scene of this number and its reference.
fn fit(number: u64) -> (Trial, Truth) {
    let (seed, n) = (number / 1000, number % 1000);
    if seed == 0 {
        let trial = fixed::all().swap_remove(n as usize);
        let truth = Truth::of(&trial).unwrap_or_else(|unfit| panic!("{}: {unfit:?}", trial.name));
        return (trial, truth);
    }
    for attempt in 0..ATTEMPTS {
        let trial = draw::draw(seed, n, attempt);
        match Truth::of(&trial) {
            Ok(truth) => return (trial, truth),
            Err(unfit) => println!("{number}, {}: {unfit:?}, drawn anew", trial.name),
        }
    }
    panic!("no scene is fit of the number {number}");
}

/// An environment variable's number.
fn asked(name: &str) -> Option<u64> {
    let value = std::env::var(name).ok()?;
    Some(value.parse().unwrap_or_else(|_| panic!("{name} is a number, not {value:?}")))
}

/// A scene of this number, tried with these methods.
fn row(number: u64, methods: &[Method]) -> Row {
    let (trial, truth) = fit(number);
    let tried = |method: &Method| TOLERANCES.map(|tolerance| Verdict::of(&trial, &truth, *method, tolerance));
    let verdicts = methods.iter().flat_map(tried).collect();
    Row { number, trial, truth, verdicts }
}

/// Refused may be so many pairs of a scene and a tolerance [1].
const REFUSED: f64 = 0.02;

/// Tries the scenes of these numbers with this method, and asserts what must be true of all.
fn judge(numbers: impl Iterator<Item = u64>, method: Method) {
    if let Some(number) = asked("SPLIT_ROTOR_SCENE_SEED") {
        return println!("{}", report::whole(&row(number, &Method::ALL)));
    }
    let began = Instant::now();
    let rows: Vec<_> = numbers.map(|number| row(number, &[method])).collect();
    let pairs = || rows.iter().flat_map(|row| row.verdicts.iter().map(move |verdict| (row, verdict)));
    let spent = pairs().map(|(_, verdict)| verdict.seconds).sum::<f64>();
    println!("{} scenes in {:.1} s, {spent:.1} s of them ours", rows.len(), began.elapsed().as_secs_f64());
    println!("\n{}\n", report::worst(&rows));
    if report::is_to_write() && method == Method::Auto {
        report::write("random-scenes.md", "<!-- worst -->", &report::worst(&rows));
    }
    let (mut wrong, mut refused) = (Vec::new(), 0);
    for (row, verdict) in pairs() {
        let mut tell = |why: &str| wrong.push(format!("{}{why}", report::line(row, verdict)));
        if verdict.is_refused() {
            refused += 1;
            let solves = |method: &&Method| Verdict::of(&row.trial, &row.truth, **method, verdict.tolerance).is_right();
            if let Some(method) = Method::ALL[1..].iter().find(solves) {
                tell(&format!(" refused, but {} solves it", method.name()));
            }
        } else if !verdict.is_right() {
            tell("");
        }
    }
    let all = rows.len() * TOLERANCES.len();
    println!("{refused} are refused");
    assert!(
        wrong.is_empty(),
        "{} of {all} pairs of a scene and a tolerance are wrong:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
    assert!(refused as f64 <= REFUSED * all as f64, "{refused} of {all} pairs of a scene and a tolerance are refused");
}

#[test]
fn exact_auto_keeps_its_tolerance() {
    let fixed = (0..fixed::all().len() as u64).map(|n| number(0, n));
    // The table is of all.
    let seeds = if report::is_to_write() { &SEEDS[..] } else { &SEEDS[..1] };
    judge(fixed.chain(drawn(seeds)).chain(FOUND), Method::Auto);
}

#[test]
#[ignore = "long"]
fn exact_auto_keeps_its_tolerance_in_the_scenes_of_other_seeds() {
    judge(drawn(&SEEDS[1..]), Method::Auto);
}

fn drawn(seeds: &[u64]) -> impl Iterator<Item = u64> {
    seeds.iter().flat_map(|seed| (0..OF_A_SEED).map(move |n| number(*seed, n)))
}

#[test]
fn exact_taylor_keeps_its_tolerance() {
    let fixed = (0..fixed::all().len() as u64).map(|n| number(0, n));
    judge(fixed.chain(drawn(&SEEDS[..1])), Method::Taylor);
}

#[test]
#[ignore = "long"]
fn exact_auto_keeps_its_tolerance_in_scenes_drawn_anew() {
    let day = || SystemTime::UNIX_EPOCH.elapsed().expect("a date").as_secs() / 86_400;
    let seed = asked("SPLIT_ROTOR_SEED").unwrap_or_else(day);
    println!("SPLIT_ROTOR_SEED={seed}");
    let began = Instant::now();
    judge((0..OF_A_DRAW).map(|n| number(seed, n)).take_while(|_| began.elapsed() < DRAWN_FOR), Method::Auto);
}

/// Scenes whose cost is measured.
const COSTED: u64 = 200;

#[test]
#[ignore = "it measures times"]
fn what_auto_costs_beside_the_best_method() {
    let count = asked("SPLIT_ROTOR_COUNT").unwrap_or(COSTED);
    let numbers = (0..count).map(|n| number(SEEDS[1], n * OF_A_SEED / count));
    let mut costs: Vec<_> = numbers
        .flat_map(|number| {
            let (trial, truth) = fit(number);
            cost::of(number, &trial, &truth)
        })
        .collect();
    let table = cost::table(&mut costs);
    println!("{table}");
    if report::is_to_write() {
        report::write("accuracy.md", "<!-- auto -->", &table);
    }
}

/// Where what acts alone made `auto` and `symplectic` drift on: so many of the scenes that are always there.
const DRIFTED: u64 = 9;

#[test]
fn exact_symplectic_of_its_own_step_is_right() {
    let rows = (0..DRIFTED).map(|n| row(number(0, n), &[Method::Symplectic]));
    for row in rows {
        assert!(row.verdicts.iter().all(Verdict::is_right), "{}", report::whole(&row));
    }
}

#[test]
fn exact_stiff_follows_a_small_nutation() {
    let n = fixed::all().iter().position(|trial| trial.name == "a small nutation").expect("one of them");
    let row = row(number(0, n as u64), &[Method::Stiff]);
    assert!(row.verdicts.iter().all(Verdict::is_right), "{}", report::whole(&row));
}

/// A tolerance at which a method errs far less than laws that differ would.
const TIGHT: f64 = 1e-12;

/// In nominals: below that ours takes steps without end where a number passes 0.
const LEAST_ABSOLUTE: f64 = 1e-17;

/// What place, axis and φ may err then over their sizes, and over A where that is more than 1 [1].
const LAWS: f64 = 2e-9;

/// What the ledger may leave over then [1]: measured 2.5e-12.
const LEDGER: f64 = 1e-11;

/// Scenes of a seed that hold every effect.
const WITH_ALL: [std::ops::Range<u64>; 2] = [0..70, 200..240];

/// Their numbers.
fn with_all() -> impl Iterator<Item = u64> {
    WITH_ALL.into_iter().flatten().map(|n| number(SEEDS[0], n))
}

#[test]
fn exact_every_law_is_that_of_the_reference() {
    let mut wrong = Vec::new();
    for number in with_all() {
        let (trial, truth) = fit(number);
        let smallest = truth.sizes.iter().copied().filter(|size| *size > 0.0).fold(1.0, f64::min);
        let tolerances = [TIGHT, (TIGHT * smallest).max(LEAST_ABSOLUTE)];
        for method in [Method::Dop853, Method::Taylor] {
            let verdict = Verdict::within(&trial, &truth, method, tolerances);
            let worst = largest(verdict.errors.clone().unwrap_or([f64::NAN; 3])) / truth.growth.max(1.0);
            if !(worst <= LAWS && verdict.residual <= LEDGER) {
                println!("{number}: {worst:e}, the ledger leaves over {:e}", verdict.residual);
                let (trial, truth) = fit(number);
                wrong.push(report::line(&Row { number, trial, truth, verdicts: Vec::new() }, &verdict));
            }
        }
    }
    assert!(wrong.is_empty(), "{} scenes are another motion:\n{}", wrong.len(), wrong.join("\n"));
}

/// A tolerance at which another scene must be told from the right one.
const TELLING: f64 = 1e-8;

/// Of the scenes with an effect so many must tell that a number of it is off by 1 % [1]; in the others it does too little: measured
/// 0.67 (drag) and more, allow 0.6.
const TOLD: f64 = 0.6;

#[test]
fn a_scene_with_a_wrong_number_is_wrong() {
    let mut told = BTreeMap::<_, [u32; 2]>::new();
    for number in with_all() {
        let (trial, truth) = fit(number);
        for (effect, mutant) in mutants::of(&trial) {
            let verdict = Verdict::of(&mutant, &truth, Method::Auto, TELLING);
            let [found, all] = told.entry(effect).or_default();
            (*found, *all) = (*found + u32::from(verdict.errors.is_ok() && !verdict.is_right()), *all + 1);
        }
    }
    println!("{told:?}");
    assert_eq!(told.len(), 15, "an effect without a mutant");
    for (effect, [found, all]) in told {
        assert!(f64::from(found) >= TOLD * f64::from(all), "{effect}: {found} of {all}");
    }
}

/// A from a start that is off by 1e-6 and by 1e-7 of the motion may differ by this part, or it is that of rounding or of a wide way.
const LINEAR: f64 = 0.05;

#[test]
fn growth_is_that_of_small_shifts() {
    for number in with_all() {
        let (trial, truth) = fit(number);
        let nearer = Truth::with(&trial, 1e-7).expect("a fit scene").growth;
        let differ = (truth.growth - nearer).abs() / nearer.max(1.0);
        assert!(differ <= LINEAR, "{number}: {} or {nearer}", truth.growth);
    }
}

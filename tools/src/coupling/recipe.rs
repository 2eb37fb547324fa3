//! The recipe: what to set in which master, and how long steps may be.

use super::exchange::Scheme;
use super::partner::NAMES;
use super::table::milliseconds;
use super::{Bound, Found, SETTINGS, Setting};

/// Errors that users accept.
const BOUNDS: [Bound; 3] = [
    Bound { name: "1 % at the end", most: 1e-2, read: |outcome| outcome.error },
    Bound { name: "0.1 % at the end", most: 1e-3, read: |outcome| outcome.error },
    Bound { name: "1 % at all times", most: 1e-2, read: |outcome| outcome.whole },
];

/// What is to be set, in Markdown.
pub fn recipe(found: &Found) -> String {
    let mut text = "## What to set\n\n".to_owned();
    for scheme in Scheme::ALL.into_iter().rev() {
        text += &of_scheme(found, scheme);
    }
    text += &given(found);
    text += "\nIn every master:\n\n\
             - Compare a run with one at half the step: what differs is the error. The table holds for this machine, this speed and partners \
             without states.\n\
             - A partner with a state of its own needs more. A motor or a shaft on a torsion spring: give the drive its spring, `drive.k` and \
             `drive.d`, and let it show its angle ahead, `drive.ahead` (docs/cosimulation.md). A pedestal: give the port \
             the coefficients of what lies between, `ahead` = 0.5 (-0.5 in a Gauss-Seidel master), and an order of 1.\n\
             - A partner that repeats its answers, or a force that a script sets: `learn = false`.\n";
    text
}

fn of_scheme(found: &Found, scheme: Scheme) -> String {
    let mut text = match scheme {
        Scheme::Late => format!("In {} (answers are one step late):\n\n", scheme.masters()),
        Scheme::Fresh => format!("In {}:\n\n", scheme.masters()),
    };
    text += "Longest step [ms] for an error of at most so much, without a warning of the FMU:\n\n| setting | lines of the scene |";
    BOUNDS.iter().for_each(|bound| text += &format!(" {} |", bound.name));
    text += &format!("\n|---|---|{}\n", "--:|".repeat(BOUNDS.len()));
    for setting in SETTINGS.iter().rev().filter(|setting| found.pair.allows(setting)) {
        text += &format!("| {} | {} |", setting.name, lines(setting, scheme));
        BOUNDS.iter().for_each(|bound| text += &format!(" {} |", longest(found, scheme, setting, bound)));
        text += "\n";
    }
    text + "\n" + &advice(found, scheme) + "\n"
}

/// What stands in the scene for a setting.
fn lines(setting: &Setting, scheme: Scheme) -> String {
    let lag = if scheme == Scheme::Late { " lag = 1" } else { "" };
    let redo = if setting.redoes { "redo = true" } else { "" };
    match (setting.order, setting.is_given, setting.learns) {
        (_, true, _) if lag.is_empty() => "port: the coefficients below".into(),
        (_, true, _) => format!("port: the coefficients below; extrapolation:{lag}"),
        (0, _, true) => "none".into(),
        (0, _, false) => "port: learn = false".into(),
        (order, ..) => {
            let of_each = [format!("order = {order}"), lag.trim().into(), redo.into()];
            format!(
                "extrapolation: {}",
                of_each.into_iter().filter(|words| !words.is_empty()).collect::<Vec<_>>().join(", ")
            )
        }
    }
}

/// The longest step that was tried and is within a bound.
fn longest(found: &Found, scheme: Scheme, setting: &Setting, bound: &Bound) -> String {
    match found.within(scheme, setting, bound) {
        None => format!("below {}", milliseconds(found.steps[0])),
        Some(step) if step == found.steps[found.steps.len() - 1] => {
            format!("{}, the longest tried", milliseconds(step))
        }
        Some(step) => milliseconds(step),
    }
}

/// Which to take, where the coefficients are known and where not.
fn advice(found: &Found, scheme: Scheme) -> String {
    let [end, _, always] = &BOUNDS;
    let reach = |setting: &&Setting| found.within(scheme, setting, end).unwrap_or(0.0);
    let (given, others): (Vec<_>, Vec<_>) = SETTINGS.iter().partition(|setting| setting.is_given);
    // Of equal ones the last: it asks for the least.
    let best = others.into_iter().max_by(|one, other| reach(one).total_cmp(&reach(other)));
    let words = |setting: &Setting| match [end, always].map(|bound| found.within(scheme, setting, bound)) {
        [None, _] => "no step that was tried is within 1 % without a warning".to_owned(),
        [Some(long), Some(short)] if short == long => format!("steps up to {} ms are within 1 %", milliseconds(long)),
        [Some(long), Some(short)] => format!(
            "steps up to {} ms are within 1 % at the end of the run, and up to {} ms at all times",
            milliseconds(long),
            milliseconds(short)
        ),
        [Some(long), None] => {
            format!("steps up to {} ms are within 1 % at the end of the run, but not at its start", milliseconds(long))
        }
    };
    let ([given], Some(best)) = (&given[..], best) else { return String::new() };
    if reach(given) == 0.0 && reach(&best) == 0.0 {
        return "No step that was tried is within 1 % without a warning: try shorter ones (--steps).\n".to_owned();
    }
    let extrapolated = |setting: &Setting| {
        format!("give `[effects.extrapolation]` {}", lines(setting, scheme).trim_start_matches("extrapolation: "))
    };
    let what = match (best.order, best.learns) {
        (0, true) => "set nothing, and the ports learn from the first answers".to_owned(),
        (0, false) => "hold the loads (`learn = false`)".to_owned(),
        _ => extrapolated(best),
    };
    let mut text = if reach(given) >= reach(&best) {
        let first =
            format!("1. If you know the coefficients of the partner, give them to the ports: {}.\n", words(given));
        first + &format!("2. If not, {what}: {}.\n", words(best))
    } else {
        let (initial, rest) = what.split_at(1);
        let first = format!("1. {}{rest}: {}.\n", initial.to_uppercase(), words(best));
        first + &format!("2. The coefficients of the partner do not help here: with them {}.\n", words(given))
    };
    let from_start = |setting: &Setting| found.within(scheme, setting, always).unwrap_or(0.0);
    if let Some(redone) = SETTINGS.iter().find(|setting| setting.redoes && from_start(setting) > from_start(best)) {
        text += &format!(
            "3. Where the start of a run counts too and the coefficients are not known, {}: {}.\n",
            extrapolated(redone),
            words(redone)
        );
    }
    text
}

/// The ports with the coefficients of their partners, as lines of a scene.
fn given(found: &Found) -> String {
    let mut text =
        "The ports of these partners, in place of the effects, with their coefficients:\n\n```toml\n".to_owned();
    for partner in &found.pair.partners {
        text += &format!("[[effects.port]] # {}\nposition = {:?}\n", partner.name, partner.position);
        let given = NAMES.into_iter().zip(partner.at(found.speed)).filter(|(_, value)| *value != 0.0);
        given.for_each(|(name, value)| text += &format!("{name} = {value:?}\n"));
    }
    text += "```\n";
    let tabled: Vec<_> = found.pair.partners.iter().filter(|one| one.has_table()).map(|one| &*one.name).collect();
    if !tabled.is_empty() {
        text += &format!("\nThe coefficients of {} are those at {:?} rad/s.\n", tabled.join(" and "), found.speed);
    }
    text
}

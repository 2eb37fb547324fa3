//! The table: errors of each scheme and setting versus the communication step, and the limits of stability.

use super::exchange::Scheme;
use super::{Found, SETTINGS, Tried};
use crate::doubts::below;
use crate::numbers::{rounded, rpm};
use crate::scenes;
use split_rotor_model::simulation::ORDERS;

/// A number with so many digits that count.
pub fn digits(value: f64, count: usize) -> String {
    format!("{value:.*e}", count - 1).parse::<f64>().map_or_else(|_| value.to_string(), |short| short.to_string())
}

/// A communication step \[s] in ms.
pub fn milliseconds(step: f64) -> String {
    digits(1e3 * step, 3)
}

/// All but the recipe, in Markdown.
pub fn table(found: &Found) -> String {
    let mut text = format!("{}: {}\n\n", found.scene.name, found.scene.title);
    text += &setting_out(found);
    for (n, scheme) in Scheme::ALL.into_iter().enumerate() {
        text += &format!("Answers {}: {}.\n\n", scheme.words(), scheme.masters());
        errors(found, scheme, &mut text);
        text += "\n";
        limits(found, n, &mut text);
    }
    below(text, found.scene, &[found.speed])
}

fn setting_out(found: &Found) -> String {
    let named = found.pair.partners.iter().zip(&found.pair.ports).map(|(partner, port)| {
        format!("{} at {} m as the partner of port[{port}]", partner.name, digits(partner.position, 6))
    });
    let mut text = format!(
        "Coupled: {}. The machine starts at {} rad/s ({} rpm) out of equilibrium (--speed sets another speed), and inputs keep their start \
         values. Runs of {} ms; the fastest mode has a period of {} ms. Exact: the scene, with these effects inside.\n\n",
        named.collect::<Vec<_>>().join(", "),
        rounded(found.speed),
        rounded(rpm(found.speed)),
        milliseconds(found.span),
        milliseconds(found.periods[0]),
    );
    if scenes::values(found.scene)("drive.k").is_some_and(|k| k != 0.0) {
        text += "The spring at the drive (drive.k) has no partner here.\n\n";
    }
    match found.pair.own_ports() {
        0 => {}
        1 => text += "The scene's own port gets no loads here.\n\n",
        count => text += &format!("The scene's own {count} ports get no loads here.\n\n"),
    }
    text += "Largest error over the last tenth of a run, relative to the largest motion of the stations; in brackets the error of the energy of \
             the motion, relative to its largest. `!`: the FMU warned; fails: the solver stopped, or the error exceeded 1e4. coupling.csv has the errors over whole runs and the sums of \
             port[i].energy_error too.\n\n";
    text
}

fn errors(found: &Found, scheme: Scheme, text: &mut String) {
    *text += "| step [ms] |";
    SETTINGS.iter().for_each(|setting| *text += &format!(" {} |", setting.name));
    *text += &format!("\n|--:|{}\n", "--:|".repeat(SETTINGS.len()));
    for &step in &found.steps {
        *text += &format!("| {} |", milliseconds(step));
        for setting in &SETTINGS {
            let tried = found.series(scheme, setting).find(|one| one.step == step);
            *text += &format!(" {} |", tried.map_or_else(String::new, cell));
        }
        *text += "\n";
    }
}

fn cell(tried: &Tried) -> String {
    let warned = if tried.outcome.warned.is_some() { " !" } else { "" };
    match (tried.outcome.error, tried.outcome.energy) {
        (Some(error), Some(energy)) => format!("{error:.1e} ({energy:.0e}){warned}"),
        _ => format!("fails{warned}"),
    }
}

fn limits(found: &Found, scheme: usize, text: &mut String) {
    *text += "Longest step at which the exchange makes nothing grow (by more than 0.01 % a step):";
    for order in 0..ORDERS {
        let name = if order == 0 { " held ".into() } else { format!(", order {order} ") };
        *text += &name;
        *text += &limit(found.longest[scheme][order]);
    }
    *text += ".\n\n";
}

/// A limit \[s] in words.
pub fn limit(longest: Option<f64>) -> String {
    match longest {
        None => "has no limit".into(),
        Some(0.0) => "0 (grows at every step)".into(),
        Some(longest) => format!("{} ms", milliseconds(longest)),
    }
}

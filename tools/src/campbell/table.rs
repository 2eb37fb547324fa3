//! The table: critical speeds, thresholds, and the modes at a few speeds.

use super::{Diagram, number};
use crate::doubts::{below, mark_within, marked};
use crate::numbers::{SHOWN, rounded, rpm, spread};
use split_rotor_model::linear::{Branch, Crossing, Direction, Mode, Point};
use std::fmt::Write;

/// All of it, in Markdown.
pub fn table(diagram: &Diagram) -> String {
    let mut text = format!("{}: {}\n\n", diagram.scene.name, diagram.scene.title);
    let speeds: Vec<_> = diagram.campbell.steady.iter().map(|steady| steady.speed).collect();
    text += &crate::speeds::told(&speeds);
    text += "Balanced, drives off, the spin held; about the steady state at each speed.\n\n";
    critical_speeds(diagram, &mut text);
    stability(diagram, &mut text);
    modes(diagram, &mut text);
    below(text, diagram.scene, &speeds)
}

fn critical_speeds(diagram: &Diagram, text: &mut String) {
    let all = diagram.critical.iter().flat_map(|(order, speeds)| speeds.iter().map(move |crossing| (order, crossing)));
    let rows: Vec<_> = all.collect();
    if rows.is_empty() {
        *text += "No critical speed in this range.\n\n";
        return;
    }
    *text +=
        "| critical speed [rad/s] | [rpm] | line | mode | direction | damping ratio |\n|--:|--:|--:|--:|---|--:|\n";
    for (order, Crossing { branch, speed, mode }) in rows {
        let (number, direction, ratio) = (number(*branch), mode.direction.name(), ratio(mode, 4));
        let (speed, rpm) = (marked(diagram.scene, *speed), rounded(rpm(*speed)));
        let _ = writeln!(text, "| {speed} | {rpm} | {order}X | {number} | {direction} | {ratio:.4} |");
    }
    if diagram
        .critical
        .iter()
        .any(|(_, speeds)| speeds.iter().any(|crossing| crossing.mode.direction == Direction::Axial))
    {
        *text += "\nAn unbalance does not drive a mode along the axis.\n";
    }
    *text += "\n";
}

fn stability(diagram: &Diagram, text: &mut String) {
    for threshold @ Crossing { branch, speed, mode } in &diagram.thresholds {
        let _ = writeln!(
            text,
            "Mode {} ({}, {} rad/s) grows {} {} rad/s ({} rpm).",
            number(*branch),
            mode.direction.name(),
            rounded(mode.eigenvalue.im),
            diagram.grows(threshold),
            marked(diagram.scene, *speed),
            rounded(rpm(*speed))
        );
    }
    let grows_always = |(_, branch): &(usize, &Branch)| branch.points.iter().all(|point| point.mode.grows());
    for (branch, Branch { points }) in diagram.campbell.branches.iter().enumerate().filter(grows_always) {
        let [from, to] = [0, points.len() - 1].map(|end| marked(diagram.scene, points[end].speed));
        let _ = writeln!(text, "Mode {} ({}) grows from {from} to {to} rad/s.", number(branch), directions(points));
    }
    if let Some((branch, Point { speed, mode })) = diagram.fastest_growth() {
        let _ = writeln!(
            text,
            "Fastest growth: mode {} ({}) at {} rad/s, by a factor of e in {} s.",
            number(branch),
            mode.direction.name(),
            marked(diagram.scene, *speed),
            rounded(1.0 / mode.eigenvalue.re)
        );
    }
    if !diagram.campbell.grows() {
        let speeds = &diagram.campbell.steady;
        let mark = mark_within(diagram.scene, [speeds[0].speed, speeds[speeds.len() - 1].speed]);
        let _ = writeln!(text, "No mode grows at any of these speeds{mark}.");
    }
    *text += "\n";
}

fn modes(diagram: &Diagram, text: &mut String) {
    let steady = &diagram.campbell.steady;
    let shown: Vec<_> = spread(steady.len(), SHOWN).map(|n| steady[n].speed).collect();
    *text += "| mode |";
    shown.iter().for_each(|speed| *text += &format!(" at {} rad/s |", marked(diagram.scene, *speed)));
    *text += &format!("\n|--:|{}\n", "--:|".repeat(shown.len()));
    for (branch, of) in diagram.campbell.branches.iter().enumerate() {
        *text += &format!("| {} |", number(branch));
        for speed in &shown {
            let point = of.at(*speed);
            *text += &format!(" {} |", point.map_or(String::new(), |point| told(&point.mode)));
        }
        *text += "\n";
    }
    *text += "\nFrequency [rad/s], negative where it whirls backward, and damping ratio in brackets; of a mode that creeps, its growth, \
              negative where it decays.\n";
}

/// The directions that a mode has one after another.
fn directions(points: &[Point]) -> String {
    let runs = points.chunk_by(|a, b| a.mode.direction == b.mode.direction);
    runs.map(|run| run[0].mode.direction.name()).collect::<Vec<_>>().join(", then ")
}

fn told(mode: &Mode) -> String {
    match mode.direction {
        Direction::Creep => format!("creep, {} 1/s", rounded(mode.eigenvalue.re)),
        _ => format!("{} ({:.3})", rounded(mode.frequency()), ratio(mode, 3)),
    }
}

/// A damping ratio, which is not a zero with a minus sign where it is rounded to so many places.
fn ratio(mode: &Mode, places: i32) -> f64 {
    let ratio = mode.damping_ratio();
    if ratio.abs() < 0.5 * libm::pow(10.0, f64::from(-places)) { 0.0 } else { ratio }
}

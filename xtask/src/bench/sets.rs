//! Scenes for counting: a rotor with one effect or with a set drawn at random, each effect with values that act.

use anyhow::Result;
use fastrand::Rng;
use split_rotor_model::effects::{CATALOGUE, Info};
use std::fmt::Write;
use std::path::Path;

/// Effects, each so many times.
pub type Set = Vec<(&'static Info, usize)>;

/// So likely is an effect in a set \[1].
const LIKELY: f64 = 0.4;

/// The general FMU has so many of a kind.
const OF_A_KIND: usize = 2;

/// Sets drawn with this seed. One that excludes itself is drawn again.
pub fn drawn(seed: u64) -> impl Iterator<Item = Set> {
    let mut random = Rng::with_seed(seed);
    std::iter::repeat_with(move || {
        let mut number = |info: &Info| if info.several { random.usize(1..=OF_A_KIND) } else { 1 };
        let all: Set = CATALOGUE.iter().map(|info| (info, number(info))).collect();
        all.into_iter().filter(|_| random.f64() < LIKELY).collect()
    })
    .filter(|set: &Set| !set.iter().any(|(info, _)| info.excludes.iter().any(|other| holds(set, other))))
}

fn holds(set: &Set, name: &str) -> bool {
    set.iter().any(|(info, _)| info.name == name)
}

/// The set in words.
pub fn words(set: &Set) -> String {
    let words = set
        .iter()
        .map(|(info, number)| if *number == 1 { info.name.into() } else { format!("{number} {}", info.name) });
    words.collect::<Vec<_>>().join(", ")
}

/// Writes the scene of a set into `folder`, and where that is; `head` stands before all tables.
pub fn written(folder: &Path, name: &str, head: &str, set: &Set) -> Result<String> {
    let mut text = format!(
        "{head}[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.75\n[start]\nr_c = {{ x = 0.75, y = 0.01 }}\n\
         omega = {{ x = 50.0, y = 1.0 }}\n[solver]\nmethod = \"dop853\"\nrelative_tolerance = 1e-10\n"
    );
    for (info, number) in set {
        let (open, close) = if info.several { ("[[", "]]") } else { ("[", "]") };
        for _ in 0..*number {
            write!(text, "{open}effects.{}{close}\n{}\n", info.name, values(info.name))?;
        }
    }
    std::fs::create_dir_all(folder)?;
    let file = folder.join(format!("{name}.toml"));
    std::fs::write(&file, text)?;
    Ok(file.display().to_string())
}

/// Values with which an effect acts.
fn values(effect: &str) -> &'static str {
    match effect {
        "gravity" => "g = { z = -9.81 }",
        "support" => "c1 = 2000.0\nc2 = 500.0\nd1 = 2.0",
        "drive" => "tau = 0.5",
        "asymmetry" => "Jt2 = 0.09",
        "unbalance" => "mass = 0.1\nradius = 0.1\nposition = 0.1",
        "bearing" => "position = -0.3\nkyy = 2e3\nkzz = 2e3\nkxx = 1e3\ncyy = 5.0\nczz = 5.0\nkt = 50.0",
        "rotating_damping" => "d = 1.0",
        "drag" => "linear = 1e-3",
        "probe" => "position = 0.1",
        "port" => "position = 0.1\nf = { y = 1.0 }",
        "imposed_speed" => "w = 50.0",
        "extrapolation" => "order = 1",
        "motor" => "stall_torque = 0.5\nsynchronous_speed = 100.0\ntime_constant = 0.1",
        "rub" => "position = -0.3\ngap = 0.02\nstiffness = 1e4\nradius = 0.05\nv0 = 0.01",
        _ => "",
    }
}

//! What the general FMU costs beside a scene of the same effects, and what an effect costs that is switched off.

use super::sets::{self, Set};
use super::spending::{packaged, spent};
use super::{head, target};
use crate::{paths, scenes};
use anyhow::{Result, ensure};
use split_rotor_model::effects;
use split_rotor_model::scene::Scene;
use split_rotor_tools::general;

/// fmi2DoStep of the general FMU over that of the scene of the same effects \[1]: the target, and what fails. The target is missed since
/// the errors of loads count, of effects that are off too: measured 1.333.
const GENERAL: f64 = 1.3;
const GENERAL_FAILS: f64 = 1.4;

/// So many sets are drawn.
const SETS: usize = 3;

/// With which seed, where none is given.
pub const SEED: u64 = 8;

/// Instructions of an evaluation that an effect costs which is switched off, the mean beside all that acts: the target, and what fails. Beside
/// one of these it depends on how the compiler gives out registers: one library had from 1.07 to 5.49.
const OFF: f64 = 4.0;
const OFF_FAILS: f64 = 4.2;

/// Prints what a second of each set drawn with this seed takes in the general FMU and in its own, and what is off; what is
/// beyond its limit.
pub fn print(seed: u64) -> Result<Vec<String>> {
    let mut broken = Vec::new();
    let folder = paths::target().join("general");
    let sets: Vec<_> = sets::drawn(seed).take(SETS).collect();
    let written = (1..).zip(&sets).map(|(number, set)| sets::written(&folder, &format!("set{number}"), "", set));
    let scenes = std::iter::once(Ok("rotor".into())).chain(written).collect::<Result<Vec<_>>>()?;
    let fmus = packaged(&scenes, &folder)?;
    println!("{}", head(&["a second of", "scene", "general", "ratio", "at most"]));
    for ((set, scene), own) in sets.iter().zip(&scenes[1..]).zip(&fmus[1..]) {
        let values = values(&scenes::find("rotor")?, &scenes::find(scene)?)?;
        let [own, all] = [spent(own, &[])?, spent(&fmus[0], &values)?];
        let (words, ratio) = (sets::words(set), all.instructions / own.instructions);
        let target = target(Some(GENERAL), ratio);
        println!("| {words} | {} | {} | {ratio:.3} | {target} |", own.instructions, all.instructions);
        ensure!(own.evaluations == all.evaluations, "{words}: other steps, {} evaluations", all.evaluations);
        if ratio > GENERAL_FAILS {
            broken.push(format!("the general FMU with {words}: {ratio:.3} times its scene"));
        }
    }
    Ok(broken)
}

/// General FMUs with so many bearings and ports, all of them off: what there may be several of and has a law.
const FEWER: usize = 2;
const MORE: usize = 4;

/// What acts meanwhile: one pass over the list or both, at a place or not.
const ACTING: [&[&str]; 3] = [&["gravity"], &["drag"], &["support", "drag"]];

/// Prints what an effect costs that is switched off, as what more of them cost more; what is beyond its limit.
pub fn print_off() -> Result<Vec<String>> {
    let mut sum = 0.0;
    let folder = paths::target().join("general");
    let generals = [("fewer", FEWER), ("more", MORE)].map(|(name, number)| {
        let set = set(&[("bearing", number), ("port", number)]);
        sets::written(&folder, name, "general = true\n", &set)
    });
    let generals = generals.into_iter().collect::<Result<Vec<_>>>()?;
    let fmus = packaged(&generals, &folder)?;
    println!("{}", head(&["a bearing or port that is off beside", "instructions an evaluation", "at most"]));
    for names in ACTING {
        let acting = set(&names.iter().map(|name| (*name, 1)).collect::<Vec<_>>());
        let scene = scenes::find(&sets::written(&folder, "acting", "", &acting)?)?;
        let each = |of: usize| Ok(spent(&fmus[of], &values(&scenes::find(&generals[of])?, &scene)?)?.each());
        let [fewer, more]: [Result<f64>; 2] = [0, 1].map(each);
        let each = (more? - fewer?) / (2 * (MORE - FEWER)) as f64;
        println!("| {} | {each:.2} | - |", sets::words(&acting));
        sum += each;
    }
    let mean = sum / ACTING.len() as f64;
    println!("| the mean | {mean:.2} | {} |", target(Some(OFF), mean));
    Ok(if mean > OFF_FAILS { vec![format!("an effect that is off: {mean:.2} instructions")] } else { Vec::new() })
}

/// These effects, each so many times.
fn set(names: &[(&str, usize)]) -> Set {
    names.iter().filter_map(|(name, number)| Some((effects::named(name)?, *number))).collect()
}

/// What a general FMU must be told to be this scene, as `NAME=VALUE`.
fn values(general: &Scene, scene: &Scene) -> Result<Vec<String>> {
    let values = general::values(general, scene)?;
    Ok(values.into_iter().map(|(variable, value)| format!("{}={value:?}", variable.name)).collect())
}

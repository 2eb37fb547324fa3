//! `accuracy`: error against time for every method, for any scene.

mod files;
mod interleaved;
mod machine;
mod peers;
mod tolerances;

use crate::progress::Progress;
use crate::unpacked::unpack;
use crate::{package, scenes};
use anyhow::Result;
use split_rotor_tools::accuracy::run::Subject;
use split_rotor_tools::accuracy::{measure, span, sweep};
use std::path::Path;

/// Which peers are measured beside ours, and for how long.
#[derive(Clone, Copy, PartialEq)]
pub enum Peers {
    /// None.
    Absent,
    /// All, for their numbers.
    Measured,
    /// All, only whether they run: the loosest settings of each method, of ours too.
    Tried,
}

/// Where peers are only tried, so many settings of a method.
const TRIED: usize = 4;
pub use tolerances::tolerances;

/// The names of the peers.
pub fn peers() -> impl Iterator<Item = &'static str> {
    peers::PEERS.iter().map(|(name, _)| *name)
}

/// Packages the scene, measures it, and writes into the folder `out`, or target/accuracy/SCENE; which peers were left out, and why.
pub fn accuracy(scene: &str, peers: Peers, out: Option<&Path>) -> Result<Vec<String>> {
    let found = scenes::find(scene)?;
    let fmu = package::package(&[scene.to_owned()], None)?.remove(0);
    let (scene, unpacked) = (found, unpack(&fmu)?);
    let mut subject = Subject::load(&scene, &unpacked.library)?;
    span::shorten(&mut subject);
    let mut curves = sweep::curves(&subject);
    if peers == Peers::Tried {
        curves.iter_mut().for_each(|curve| curve.truncate(TRIED));
    }
    let progress = Progress::of(curves.iter().map(Vec::len).sum());
    let begins = |method: &str| {
        progress.tell(&format!("measuring {method}"));
        Ok(())
    };
    let result = measure(
        &scene,
        &subject,
        &curves,
        begins,
        || progress.inc(1),
        |reference, rows| {
            progress.finish_and_clear();
            match peers {
                Peers::Absent => Vec::new(),
                _ => peers::measure(&subject, reference, rows, peers == Peers::Tried),
            }
        },
    )?;
    files::write(&scene, &result, out)?;
    Ok(result.left_out)
}

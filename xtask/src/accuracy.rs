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
pub use tolerances::tolerances;

/// Packages the scene, measures it, and writes into the folder `out`, or target/accuracy/SCENE; which peers were left out, and why.
pub fn accuracy(scene: &str, with_peers: bool, out: Option<&Path>) -> Result<Vec<String>> {
    let found = scenes::find(scene)?;
    let fmu = package::package(&[scene.to_owned()], None)?.remove(0);
    let (scene, unpacked) = (found, unpack(&fmu)?);
    let mut subject = Subject::load(&scene, &unpacked.library)?;
    span::shorten(&mut subject);
    let curves = sweep::curves(&subject);
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
            if with_peers { peers::measure(&subject, reference, rows) } else { Vec::new() }
        },
    )?;
    files::write(&scene, &result, out)?;
    Ok(result.left_out)
}

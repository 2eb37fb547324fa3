//! `accuracy`: error against time for every method, for any scene.

mod files;
mod interleaved;
mod machine;
mod peers;
mod tolerances;

use crate::unpacked::unpack;
use crate::{package, scenes};
use anyhow::{Result, ensure};
use indicatif::{ProgressBar, ProgressStyle};
use split_rotor_tools::accuracy::run::Subject;
use split_rotor_tools::accuracy::{measure, span, sweep};
pub use tolerances::tolerances;

/// Packages the scene, measures it, and writes target/accuracy/SCENE/; which peers were left out, and why.
pub fn accuracy(scene: &str, with_peers: bool) -> Result<Vec<String>> {
    let found = scenes::find(scene)?;
    ensure!(
        found.inputs.is_empty(),
        "{}: has [[input]], which `run` and `demo` follow: accuracy is measured with inputs that stay as they start",
        found.file.display()
    );
    let fmu = package::package(&[scene.to_owned()], None)?.remove(0);
    let (scene, unpacked) = (found, unpack(&fmu)?);
    let mut subject = Subject::load(&scene, &unpacked.library)?;
    span::shorten(&mut subject);
    let curves = sweep::curves(&subject);
    let progress = bar(curves.iter().map(Vec::len).sum());
    let begins = |method: &str| {
        tell(&progress, method);
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
            if !with_peers {
                return Vec::new();
            }
            let progress = bar(peers::PEERS.len());
            let left_out = peers::measure(&subject, reference, rows, &progress);
            progress.finish_and_clear();
            left_out
        },
    )?;
    files::write(&scene, &result)?;
    Ok(result.left_out)
}

/// A bar where a person watches.
pub fn bar(length: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}").expect("a valid template");
    ProgressBar::new(length as u64).with_style(style)
}

/// Says what is measured now: on the bar, or as a line where there is none.
pub fn tell(progress: &ProgressBar, what: &str) {
    progress.set_message(what.to_owned());
    if progress.is_hidden() {
        println!("measuring {what}");
    }
}

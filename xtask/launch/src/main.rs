//! What `cargo xtask` starts. It builds the commands, which takes two minutes at first, and runs them. cargo says nothing while it compiles
//! one crate, for a minute: here a line now and then says that work goes on.

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// How often a line tells that work goes on.
const SIGN_OF_LIFE: Duration = Duration::from_secs(8);

fn main() -> ExitCode {
    match build().and_then(|program| program.map_or(Ok(ExitCode::FAILURE), run)) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: cargo xtask cannot start: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Builds xtask; its program, or None where cargo has said what is wrong.
fn build() -> io::Result<Option<PathBuf>> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let (began, (done, end)) = (Instant::now(), channel::<()>());
    let signs = thread::spawn(move || {
        while end.recv_timeout(SIGN_OF_LIFE) == Err(RecvTimeoutError::Timeout) {
            eprintln!("  building the commands: {} s", began.elapsed().as_secs());
        }
    });
    // Of the workspace and as its tests are built, so that neither builds anew what the other has.
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../Cargo.toml");
    let built = Command::new(cargo).args(["build", "--bin", "xtask", "--manifest-path"]).arg(workspace).status();
    drop(done);
    // What panicked there was a line that could not be written.
    let _ = signs.join();
    // Beside this program.
    let xtask = env::current_exe()?.with_file_name(format!("xtask{}", env::consts::EXE_SUFFIX));
    Ok(built?.success().then_some(xtask))
}

/// Runs it with the words that this program was given.
fn run(program: PathBuf) -> io::Result<ExitCode> {
    let ended = Command::new(program).args(env::args_os().skip(1)).status()?;
    Ok(ended.code().and_then(|code| u8::try_from(code).ok()).map_or(ExitCode::FAILURE, ExitCode::from))
}

//! What is shown while something takes long: on a terminal a bar or a spinner with the time that has passed, elsewhere a line for each
//! stage and one now and then, so that work is not taken for a standstill.

use crate::run::shown;
use anyhow::{Context, Result, bail};
use indicatif::{ProgressBar, ProgressStyle};
use std::ops::Deref;
use std::process::{Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// How often a line tells, where there is no terminal, that work goes on.
const SIGN_OF_LIFE: Duration = Duration::from_secs(8);

/// A bar or a spinner, until it is dropped.
pub struct Progress {
    bar: ProgressBar,
    lines: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Of work in so many parts.
    pub fn of(parts: usize) -> Self {
        Self::shown(ProgressBar::new(parts as u64), "{bar:30} {pos}/{len} {msg} ({elapsed})")
    }

    fn shown(bar: ProgressBar, template: &str) -> Self {
        bar.set_style(ProgressStyle::with_template(template).expect("a valid template"));
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(100));
            return Self { bar, lines: None };
        }
        let (end, ended) = channel();
        let watched = bar.clone();
        let lines = thread::spawn(move || {
            while ended.recv_timeout(SIGN_OF_LIFE) == Err(RecvTimeoutError::Timeout) {
                let of_all = watched.length().map(|parts| format!(", {} of {parts} done", watched.position()));
                eprintln!("  {}: {} s{}", watched.message(), watched.elapsed().as_secs(), of_all.unwrap_or_default());
            }
        });
        Self { bar, lines: Some((end, lines)) }
    }

    /// Says what is done now.
    pub fn tell(&self, what: &str) {
        self.bar.set_message(what.to_owned());
        if self.bar.is_hidden() {
            eprintln!("{what}");
        }
    }
}

impl Deref for Progress {
    type Target = ProgressBar;

    fn deref(&self) -> &ProgressBar {
        &self.bar
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
        if let Some((end, lines)) = self.lines.take() {
            drop(end);
            // What panicked there was a line that could not be written.
            let _ = lines.join();
        }
    }
}

/// Does what takes seconds or more, and says so meanwhile.
pub fn stage<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let progress = Progress::shown(ProgressBar::new_spinner(), "{spinner} {msg} ({elapsed})");
    progress.tell(what);
    let done = work();
    if !progress.is_hidden() {
        progress.suspend(|| eprintln!("{what}: {:.1} s", progress.elapsed().as_secs_f64()));
    }
    done
}

/// Runs a program that takes long, and shows what it printed at its end; what fails is an error that shows the command.
pub fn program(what: &str, command: &mut Command) -> Result<()> {
    let shown = shown(command);
    let output = stage(what, || command.stdin(Stdio::null()).stderr(Stdio::inherit()).output());
    let output = output.with_context(|| format!("cannot run `{shown}`"))?;
    print!("{}", String::from_utf8_lossy(&output.stdout));
    if !output.status.success() {
        bail!("`{shown}` failed ({})", output.status);
    }
    Ok(())
}

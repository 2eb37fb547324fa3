//! Running other programs.

use anyhow::{Context, Result, bail};
use std::io::{BufRead, BufReader, Lines, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, JoinHandle};

/// The cargo that runs us, in the project's folder.
pub fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
    command.current_dir(crate::paths::root());
    command
}

/// Runs a command with our standard streams; what fails is an error that shows the command.
pub fn run(command: &mut Command) -> Result<()> {
    let shown = shown(command);
    let status = command.status().with_context(|| format!("cannot run `{shown}`"))?;
    if !status.success() {
        bail!("`{shown}` failed ({status})");
    }
    Ok(())
}

/// Runs a command and returns what it prints; what fails is an error that shows the command.
pub fn output(command: &mut Command) -> Result<String> {
    let shown = shown(command);
    let output = command.stderr(Stdio::inherit()).output().with_context(|| format!("cannot run `{shown}`"))?;
    if !output.status.success() {
        bail!("`{shown}` failed ({})", output.status);
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// Does all of these, as many at a time as there are processors; each is told which of so many workers has it. After the first
/// error no other is begun.
pub fn side_by_side<T: Sync>(all: &[T], work: impl Fn(usize, &T) -> Result<()> + Sync) -> Result<()> {
    let next = AtomicUsize::new(0);
    let works = |worker| {
        while let Some(one) = all.get(next.fetch_add(1, Ordering::Relaxed)) {
            work(worker, one).inspect_err(|_| next.store(all.len(), Ordering::Relaxed))?;
        }
        Ok(())
    };
    let workers = thread::available_parallelism()?.get().min(all.len());
    thread::scope(|scope| {
        let works = &works;
        let workers: Vec<_> = (0..workers).map(|worker| scope.spawn(move || works(worker))).collect();
        workers.into_iter().try_for_each(|worker| worker.join().expect("a worker does not panic"))
    })
}

/// A program that is asked and answers line by line.
pub struct Conversation {
    shown: String,
    child: Child,
    asked: ChildStdin,
    answers: Lines<BufReader<ChildStdout>>,
    /// What it complains of, read beside the answers, or it would wait for that.
    complaint: JoinHandle<std::io::Result<String>>,
}

impl Conversation {
    /// Starts the program.
    pub fn with(command: &mut Command) -> Result<Self> {
        let shown = shown(command);
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().with_context(|| format!("cannot run `{shown}`"))?;
        let asked = child.stdin.take().expect("it is piped");
        let answers = BufReader::new(child.stdout.take().expect("it is piped")).lines();
        let complaint = child.stderr.take().expect("it is piped");
        let complaint = std::thread::spawn(move || std::io::read_to_string(complaint));
        Ok(Self { shown, child, asked, answers, complaint })
    }

    /// Says a line.
    pub fn say(&mut self, line: &str) {
        // Where it does not want to know, its exit code tells.
        let _ = writeln!(self.asked, "{line}");
    }

    /// Its lines up to an empty one, or to the end.
    pub fn paragraph(&mut self) -> Result<Vec<String>> {
        let lines = self.answers.by_ref().take_while(|line| line.as_ref().map_or(true, |line| !line.is_empty()));
        Ok(lines.collect::<std::io::Result<_>>()?)
    }

    /// Its answer to a line, a line.
    pub fn ask(&mut self, line: &str) -> Result<String> {
        self.say(line);
        self.answers.next().with_context(|| format!("`{}` does not answer", self.shown))?.map_err(Into::into)
    }

    /// Nothing more is asked; what fails is an error that shows the end of what it complained of.
    pub fn end(mut self) -> Result<()> {
        drop(self.asked);
        let status = self.child.wait()?;
        if !status.success() {
            let complaint = self.complaint.join().expect("reading does not panic")?;
            let last = complaint.lines().last().unwrap_or("it did not say why");
            bail!("`{}` failed ({status}): {last}", self.shown);
        }
        Ok(())
    }
}

/// A program of this crate and version, installed into target/tools.
pub fn installed(name: &str, version: &str) -> Result<PathBuf> {
    let tools = crate::paths::target().join("tools");
    // It only starts others: nothing is gained by a release build.
    run(cargo()
        .args(["install", "--quiet", "--debug", "--locked", "--version", version, name])
        .arg("--root")
        .arg(&tools))?;
    Ok(tools.join("bin").join(name))
}

/// The words of a command.
pub fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::{Conversation, side_by_side};
    use anyhow::ensure;
    use std::process::Command;
    use std::sync::Mutex;

    #[test]
    fn all_are_done_once_and_the_first_error_is_told() {
        let done = Mutex::new(Vec::new());
        side_by_side(&[3, 1, 2], |_, one| {
            done.lock().unwrap().push(*one);
            Ok(())
        })
        .unwrap();
        let mut done = done.into_inner().unwrap();
        done.sort_unstable();
        assert_eq!(done, [1, 2, 3]);
        let refused = side_by_side(&[1, 2, 3], |_, one| {
            ensure!(*one != 2, "not two");
            Ok(())
        });
        assert_eq!(refused.unwrap_err().to_string(), "not two");
    }

    #[test]
    #[cfg(unix)] // It asks a shell, as the next.
    fn a_program_is_asked_line_by_line() {
        let script = r#"read task; echo "$task 1"; echo "$task 2"; echo; while read n; do echo $((n * n)); done"#;
        let mut program = Conversation::with(Command::new("sh").args(["-c", script])).unwrap();
        program.say("task");
        assert_eq!(program.paragraph().unwrap(), ["task 1", "task 2"]);
        assert_eq!([3, 4].map(|n| program.ask(&n.to_string()).unwrap()), ["9", "16"]);
        program.end().unwrap();
    }

    #[test]
    #[cfg(unix)]
    fn a_program_that_fails_is_an_error_with_its_last_words() {
        let mut program =
            Conversation::with(Command::new("sh").args(["-c", "echo one; echo why >&2; exit 3"])).unwrap();
        assert_eq!(program.paragraph().unwrap(), ["one"]);
        assert!(program.ask("more").is_err());
        let refused = program.end().unwrap_err().to_string();
        assert!(refused.contains("3") && refused.ends_with(": why"), "{refused}");
    }
}

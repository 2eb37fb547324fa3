//! Jobs that run others' programs for minutes, and are left out where nothing has changed of what they test: tests/golden/jobs holds what
//! each found when it last ran, and the digest of what it ran on.

use crate::run::output;
use crate::{library, paths};
use anyhow::{Context, Result, ensure};
use sha1_smol::Sha1;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a job stands on.
pub struct Basis<'b> {
    /// Files that git knows, as its pathspecs.
    pub tracked: &'b [&'b str],
    /// Files that were made anew for this run.
    pub made: &'b [PathBuf],
    /// Programs that it runs beside the compiler, by their versions.
    pub programs: &'b [&'b str],
}

/// Prints the output in this file where it is that of the same basis, and else runs the job, prints what it found, and stores that; with
/// `all` the job runs in any case.
pub fn unless_unchanged(file: &Path, basis: &Basis, all: bool, run: impl FnOnce() -> Result<String>) -> Result<()> {
    let digest = basis.digest()?;
    if let Some(found) = stored(file, &digest).filter(|_| !all) {
        println!("unchanged since {}:\n{found}", since(file)?);
        return Ok(());
    }
    // A run that fails leaves none.
    let _ = fs::remove_file(file);
    let found = run()?;
    ensure!(!found.trim().is_empty(), "the job found nothing");
    println!("{found}");
    store(file, &digest, &found)
}

/// Where the output of a job is stored.
pub fn file(job: &str) -> PathBuf {
    paths::root().join("tests/golden/jobs").join(format!("{job}.txt"))
}

impl Basis<'_> {
    /// Of the names and contents of all files, of the compiler and its settings, and of the programs.
    fn digest(&self) -> Result<String> {
        let mut digest = Sha1::from(output(Command::new("rustc").arg("-vV"))?);
        digest.update(format!("{:?}", library::settings()).as_bytes());
        for program in self.programs {
            // One that is not here makes the job fail, or makes another run than before.
            digest.update(output(Command::new(program).arg("--version")).unwrap_or_default().as_bytes());
        }
        digest.update(self.contents()?.as_bytes());
        Ok(digest.digest().to_string())
    }

    /// Of the names and contents of all files, those that git does not know yet too.
    fn contents(&self) -> Result<String> {
        let root = paths::root();
        let mut git = Command::new("git");
        git.current_dir(root).args([
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
            "--deduplicate",
            "--",
        ]);
        let listed = output(git.args(self.tracked))?;
        let tracked = listed.split_terminator('\0').map(|name| (name.to_owned(), root.join(name)));
        let made =
            self.made.iter().map(|file| (file.file_name().unwrap_or_default().display().to_string(), file.clone()));
        let mut digest = Sha1::new();
        // What was removed here is still in git's list.
        for (name, file) in tracked.filter(|(_, file)| file.is_file()).chain(made) {
            let bytes = fs::read(&file).with_context(|| file.display().to_string())?;
            digest.update(format!("{name} {}\n", Sha1::from(bytes).digest()).as_bytes());
        }
        Ok(digest.digest().to_string())
    }
}

/// The first line of a stored output: the digests of its basis and of the output itself.
fn head(basis: &str, found: &str) -> String {
    format!("basis {basis} output {}", Sha1::from(found).digest())
}

/// The output in this file, where it is whole and of this basis.
fn stored(file: &Path, basis: &str) -> Option<String> {
    let text = fs::read_to_string(file).ok()?;
    let (first, found) = text.split_once('\n')?;
    let found = found.trim_end();
    (first == head(basis, found)).then(|| found.to_owned())
}

fn store(file: &Path, basis: &str, found: &str) -> Result<()> {
    let found = found.trim_end();
    fs::create_dir_all(file.parent().context("it lies in a folder")?)?;
    Ok(fs::write(file, format!("{}\n{found}\n", head(basis, found)))?)
}

/// The commit with which this output was stored.
fn since(file: &Path) -> Result<String> {
    let git = |arguments: &[&str]| output(Command::new("git").current_dir(paths::root()).args(arguments).arg(file));
    let (commit, changed) = (git(&["log", "-1", "--format=%h", "--"])?, git(&["status", "--porcelain", "--"])?);
    Ok(if commit.is_empty() || !changed.is_empty() {
        "the last run here, whose output is not committed".into()
    } else {
        commit.trim().into()
    })
}

#[cfg(test)]
mod tests {
    use super::{Basis, fs, paths, stored, unless_unchanged};
    use std::cell::Cell;

    #[test]
    fn a_job_runs_where_its_basis_or_its_output_has_changed_or_where_all_is_asked_for() {
        let folder = paths::target().join("tests/unchanged");
        let record = folder.join("job.txt");
        fs::create_dir_all(&folder).unwrap();
        let (made, runs) = (folder.join("made.txt"), Cell::new(0));
        let run = |tracked: &[&str], all| {
            let before = runs.get();
            let basis = Basis { tracked, made: std::slice::from_ref(&made), programs: &[] };
            unless_unchanged(&record, &basis, all, || {
                runs.set(before + 1);
                Ok("7 of 7\n".into())
            })
            .unwrap();
            runs.get() > before
        };
        fs::write(&made, "one").unwrap();
        let _ = fs::remove_file(&record);
        assert!(run(&["scenes"], false), "it never ran");
        assert!(!run(&["scenes"], false) && run(&["scenes"], true), "all");
        fs::write(&made, "two").unwrap();
        assert!(run(&["scenes"], false) && !run(&["scenes"], false), "another file");
        assert!(run(&["scenes", ":!scenes/paper.toml"], false), "a file less");
        let text = fs::read_to_string(&record).unwrap();
        fs::write(&record, text.replace("7 of 7", "8 of 8")).unwrap();
        assert!(run(&["scenes", ":!scenes/paper.toml"], false), "an output that no run found");
        fs::remove_file(&record).unwrap();
        assert_eq!(stored(&record, ""), None);
    }
}

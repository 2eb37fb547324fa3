//! Tests of the documents: each block of code does what it says, or is of a kind that nobody runs; each page is on the site, and an
//! afternoon holds them all.

use crate::{Arguments, paths, scenes};
use clap::CommandFactory;
use split_rotor_model::scene::Scene;
use std::fs;
use std::path::{Path, PathBuf};

/// A page has at most so many words, but for those that are looked things up in.
const MOST_WORDS: usize = 3000;
const LONG: [&str; 3] = ["theory.md", "CHANGELOG.md", "scene-reference.md"];

/// A block of code of a page.
struct Block {
    page: String,
    language: String,
    text: String,
}

/// The pages for people: those of the root and of docs/, with their texts.
fn pages() -> Vec<(PathBuf, String)> {
    let folders = [paths::root().to_owned(), paths::root().join("docs")];
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap()).map(|entry| entry.unwrap().path());
    let pages = files.filter(|file| file.extension().is_some_and(|end| end == "md"));
    pages.map(|page| (page.clone(), fs::read_to_string(page).unwrap())).collect()
}

fn name(page: &Path) -> String {
    page.file_name().unwrap().to_str().unwrap().to_owned()
}

/// The blocks of code of a page, between lines of three backticks.
fn blocks(page: &str, text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let code: Vec<_> = lines.by_ref().take_while(|line| *line != "```").collect();
            blocks.push(Block { page: page.to_owned(), language: language.to_owned(), text: code.join("\n") });
        }
    }
    blocks
}

/// All blocks of these languages.
fn all(languages: &[&str]) -> Vec<Block> {
    let blocks = pages().into_iter().flat_map(|(page, text)| blocks(&name(&page), &text));
    blocks.filter(|block| languages.contains(&&*block.language)).collect()
}

/// Why a line of a shell cannot be run as it stands, where it cannot.
fn complaint(line: &str) -> Option<String> {
    let Some(words) = shlex::split(line) else { return Some("it has no end".into()) };
    let commands = words.split(|word| word == "&&").map(|words| {
        let words: Vec<_> = words.iter().map(String::as_str).skip_while(|word| word.contains('=')).collect();
        complaint_of_command(&words)
    });
    commands.into_iter().find_map(|complaint| complaint)
}

fn complaint_of_command(words: &[&str]) -> Option<String> {
    let missing =
        |file: PathBuf| (!paths::root().join(&file).exists()).then(|| format!("{} is not there", file.display()));
    let after = |option: &str| words.iter().skip_while(|word| **word != option).nth(1).copied();
    match words {
        [] | ["cargo", "fmt" | "clippy", ..] | ["rustfmt" | "clang-format" | "pip" | "gdb" | "addr2line", ..] => None,
        ["cargo", "xtask", rest @ ..] => complaint_of_xtask(rest),
        ["cargo", "test", ..] => {
            let test = after("--test")?;
            let folder = if after("-p") == Some("split-rotor-model") { "model/tests" } else { "tests" };
            let is_folder = paths::root().join(folder).join(test).is_dir();
            missing(Path::new(folder).join(if is_folder { test.to_owned() } else { format!("{test}.rs") }))
        }
        ["cargo", "run", ..] => missing(Path::new("model/examples").join(format!("{}.rs", after("--example")?))),
        ["python" | "bash", file, ..] => missing(PathBuf::from(file)),
        [program, ..] => Some(format!("nobody knows {program}")),
    }
}

/// A command must parse; a scene is one of ours, or a file of the reader's.
fn complaint_of_xtask(words: &[&str]) -> Option<String> {
    let given = match Arguments::command().try_get_matches_from(["cargo xtask"].iter().chain(words)) {
        Ok(given) => given,
        Err(error) => return Some(error.to_string()),
    };
    let (_, given) = given.subcommand()?;
    let named = ["scene", "scenes"].into_iter().filter_map(|id| given.try_get_many::<String>(id).ok().flatten());
    let ours = named.flatten().filter(|scene| !scene.ends_with(".toml"));
    ours.filter_map(|scene| scenes::find(scene).err()).map(|error| error.to_string()).next()
}

#[test]
fn every_line_of_a_shell_can_be_run() {
    let blocks = all(&["sh"]);
    assert!(blocks.iter().any(|block| block.page == "README.md"));
    for Block { page, text, .. } in blocks {
        for line in text.lines() {
            assert_eq!(complaint(line), None, "{page}: {line}");
        }
    }
}

#[test]
fn a_line_that_cannot_be_run_is_seen() {
    for line in [
        "cargo xtask demmo",
        "cargo xtask run --reprt",
        "cargo xtask run nosuchscene   # words",
        "cargo xtask scenes && cargo xtask package paper nosuchscene",
        "A=1 cargo test --test nosuchtest",
        "cargo test -p split-rotor-model --test nosuchtest",
        "cargo run -p split-rotor-model --example nosuchexample",
        "python docs/pictures/nosuchfile.py",
        "echo it",
        "cargo xtask run 'paper",
    ] {
        assert!(complaint(line).is_some(), "{line}");
    }
}

#[test]
fn every_scene_can_be_read() {
    let paper = fs::read_to_string(paths::scenes().join("paper.toml")).unwrap();
    let mut read = 0;
    // That of the page on effects needs the page's effect: `copies::example_is_right`.
    for Block { page, text, .. } in all(&["toml"]).into_iter().filter(|block| block.page != "adding-an-effect.md") {
        // What is no whole scene is what one may hold besides.
        let scene = if text.contains("[rotor]") { text } else { format!("{paper}\n{text}") };
        Scene::parse(Path::new(&page), &scene).unwrap_or_else(|error| panic!("{page}: {error}"));
        read += 1;
    }
    assert!(read > 0);
}

/// All texts below a folder whose names end so.
fn texts(folder: &Path, end: &str) -> String {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let text = |path: PathBuf| match path.is_dir() {
        true => texts(&path, end),
        false if path.to_string_lossy().ends_with(end) => fs::read_to_string(path).unwrap(),
        false => String::new(),
    };
    entries.map(text).collect()
}

#[test]
fn what_only_another_test_can_run_has_one() {
    let folders = [("tests", ".py"), ("python/tests", ".py"), ("xtask/src", "copies.rs")];
    let tests = folders.map(|(folder, end)| texts(&paths::root().join(folder), end)).concat();
    for (page, text) in pages() {
        for Block { page, language, .. } in blocks(&name(&page), &text) {
            match &*language {
                "sh" | "toml" | "text" => {}
                "python" | "rust" => assert!(tests.contains(&page), "{page}: no test runs its {language}"),
                _ => panic!("{page}: what is a block of {language:?}?"),
            }
        }
    }
}

#[test]
fn every_page_is_on_the_site_and_short_enough() {
    let summary = fs::read_to_string(paths::root().join("docs/SUMMARY.md")).unwrap();
    for (page, text) in pages() {
        let name = name(&page);
        let is_linked = summary.contains(&format!("({name})")) || summary.contains(&format!("(../{name})"));
        assert!(is_linked || name == "SUMMARY.md", "docs/SUMMARY.md does not link to {name}");
        let words = text.split_whitespace().count();
        assert!(words <= MOST_WORDS || LONG.contains(&&*name), "{name} has {words} words, more than {MOST_WORDS}");
    }
}

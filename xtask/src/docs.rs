//! `docs`: the documents as a site.

use crate::run::run;
use crate::{paths, python};
use anyhow::Result;

/// Makes target/book of the pages of docs/SUMMARY.md.
pub fn docs() -> Result<()> {
    run(python::book()?.arg("xtask/python/book.py"))?;
    println!("{}", paths::target().join("book/index.html").display());
    Ok(())
}

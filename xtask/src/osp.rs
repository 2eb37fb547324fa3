//! `package --osp`: the OspModelDescription.xml of scenes beside their FMUs, where libcosim looks for it.

use crate::{paths, scenes};
use anyhow::{Context, Result};
use split_rotor_tools::osp::osp_model_description;
use std::fs;
use std::path::Path;

/// Writes those of these scenes into the folder of their FMUs.
pub fn write(names: &[String], out: Option<&Path>) -> Result<()> {
    let out = out.map_or_else(paths::fmus, Path::to_owned);
    names.iter().try_for_each(|name| {
        let scene = scenes::find(name)?;
        let file = out.join(format!("{}_OspModelDescription.xml", scene.name));
        fs::write(&file, osp_model_description(&scene)?).with_context(|| format!("cannot write {}", file.display()))?;
        println!("{}", file.display());
        Ok(())
    })
}

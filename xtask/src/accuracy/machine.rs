//! On what was measured: times mean nothing without it.

use anyhow::Result;
use serde_json::{Value, json};
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};
use sysinfo::{CpuRefreshKind, RefreshKind, System};

use crate::run::output;

/// The machine, the versions and the time.
pub fn described() -> Result<Value> {
    let system = System::new_with_specifics(RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing()));
    let cpu = system.cpus().first().map_or("an unknown processor", |cpu| cpu.brand().trim());
    let rustc = output(Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into())).arg("--version"))?;
    Ok(json!({
        "cpu": cpu,
        "cores": std::thread::available_parallelism()?.get(),
        "system": System::long_os_version().unwrap_or(std::env::consts::OS.into()),
        "rustc": rustc.split(' ').nth(1),
        "measured_at": SystemTime::now().duration_since(UNIX_EPOCH)?.as_secs(),
    }))
}

//! What a program did in floating point: callgrind tells how often each instruction ran, objdump which one it is.

use crate::c;
use crate::run::output;
use anyhow::{Context, Result, ensure};
use split_rotor_model::integrate::tableau::{DOP853, DOPRI5};
use split_rotor_model::state::COORDINATES;
use std::collections::HashMap;
use std::path::Path;

/// Operations in floating point; one of a packed instruction counts by itself.
#[derive(Default)]
pub struct Operations {
    multiplications: u64,
    /// And subtractions.
    additions: u64,
}

impl Operations {
    /// Of the run of `program` that callgrind's `account` is of (`--dump-instr=yes`).
    pub fn read(program: &Path, account: &Path) -> Result<Self> {
        ensure!(cfg!(target_arch = "x86_64"), "operations are told apart in x86-64 code only");
        let listing = output(c::tool("objdump", "binutils")?.args(["-d", "--no-show-raw-insn"]).arg(program))?;
        let code = mnemonics(&listing);
        let account = std::fs::read_to_string(account).with_context(|| account.display().to_string())?;
        let mut sum = Self::default();
        for (address, times) in executed(&account, program) {
            sum.add(code.get(&address).context("callgrind and objdump speak of different programs")?, times);
        }
        ensure!(sum.multiplications > 0 && sum.additions > 0, "nothing was calculated");
        Ok(sum)
    }

    /// The instructions that a portable build calculates with: of one number or of two.
    fn add(&mut self, mnemonic: &str, times: u64) {
        match mnemonic {
            "mulsd" => self.multiplications += times,
            "mulpd" => self.multiplications += 2 * times,
            "addsd" | "subsd" => self.additions += times,
            "addpd" | "subpd" => self.additions += 2 * times,
            _ => {}
        }
    }

    /// As if each multiplication went with an addition.
    pub fn multiply_adds(&self) -> f64 {
        0.5 * (self.multiplications + self.additions) as f64
    }
}

/// The instruction at each address of a listing by objdump.
fn mnemonics(listing: &str) -> HashMap<u64, &str> {
    let lines = listing.lines().filter_map(|line| line.split_once(":\t"));
    lines
        .filter_map(|(address, code)| {
            Some((u64::from_str_radix(address.trim(), 16).ok()?, code.split_whitespace().next()?))
        })
        .collect()
}

/// Addresses in the program, and how often each was executed.
fn executed<'a>(account: &'a str, program: &'a Path) -> impl Iterator<Item = (u64, u64)> + 'a {
    let (mut object, mut is_a_call) = ("", false);
    account.lines().filter_map(move |line| {
        if let Some(name) = line.strip_prefix("ob=") {
            object = name;
        }
        // The line after `calls=` tells what was spent in the function called, which has lines of its own.
        let after_call = std::mem::replace(&mut is_a_call, line.starts_with("calls="));
        let mut fields = line.strip_prefix("0x")?.split(' ');
        let address = u64::from_str_radix(fields.next()?, 16).ok()?;
        let times = fields.nth(1)?.parse().ok()?;
        (!after_call && Path::new(object) == program).then_some((address, times))
    })
}

/// The multiply-adds of the recurrences of the axis up to this order, where the spin is constant and nothing follows the tilt: eqs. 104
/// to 106 of docs/theory.md.
pub fn of_recurrences(order: usize) -> f64 {
    let of_power = |n: usize| {
        // Of λ t and q e·t, n; of each pair of powers that n + 2 is made of, t_a×t_b (weighed) and t_a·t_b.
        let pairs = n.div_ceil(2);
        4 * n + 12 * pairs
    };
    (0..order).map(of_power).sum::<usize>() as f64
}

/// The multiply-adds of a step's stages: each coefficient that is not zero, in each equation.
pub fn own_multiply_adds(method: &str) -> Result<f64> {
    let tableaux = [("dopri5", &DOPRI5), ("dop853", &DOP853)];
    let (_, tableau) = tableaux.into_iter().find(|(name, _)| *name == method).context("a method without a tableau")?;
    let coefficients: usize = tableau.stages.iter().map(|stage| stage.a.len()).sum();
    Ok((coefficients * COORDINATES) as f64)
}

//! Tables of a scene: arrays, each of a column, as long as that of the speeds.

use super::toml_reader::Wrong;
use crate::effects::table::MOST_NODES;
use crate::variables::Variable;

/// The column that says where the nodes are.
const SPEED: &str = "speed";

/// The columns that a file gives.
#[derive(Default)]
pub(super) struct Columns(Vec<Column>);

struct Column {
    /// The block of its effect.
    block: u32,
    /// Its name, and that of its key in the file.
    name: &'static str,
    in_file: String,
    /// How many numbers it has.
    length: usize,
    line: usize,
}

impl Columns {
    /// One more, of which this is the first number, as long as the file has it.
    pub(super) fn add(&mut self, first: &Variable, in_file: String, length: usize, line: usize) -> Result<(), Wrong> {
        if !(1..=MOST_NODES).contains(&length) {
            return Err((Some(line), format!("{in_file} must have from 1 to {MOST_NODES} numbers, not {length}")));
        }
        let (name, _) = first.meta.node().expect("it stands in a table");
        self.0.push(Column { block: first.place.block, name, in_file, length, line });
        Ok(())
    }

    /// All columns of a table are as long as that of its speeds.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        self.0.iter().try_for_each(|column| {
            let Column { in_file, length, .. } = column;
            let message = match self.nodes(column.block) {
                nodes if nodes == *length => return Ok(()),
                0 => format!("{in_file} is a table: give the speeds of its nodes in rad/s as `{SPEED} = [...]`"),
                nodes => format!("{in_file} must have as many numbers as {SPEED}, {nodes}, not {length}"),
            };
            Err((Some(column.line), message))
        })
    }

    /// Whether there is such a variable: in a table, that it has so many nodes.
    pub(super) fn hold(&self, variable: &Variable) -> bool {
        variable.meta.node().is_none_or(|(_, node)| node <= self.nodes(variable.place.block))
    }

    /// How many speeds the table of a block has.
    fn nodes(&self, block: u32) -> usize {
        let speeds = self.0.iter().find(|column| column.block == block && column.name == SPEED);
        speeds.map_or(0, |speeds| speeds.length)
    }
}

//! Tables of a scene: arrays, each of a column, as long as that of the speeds.

use super::problem::Problem;
use crate::effects::table::MOST_NODES;
use crate::variables::Variable;
use std::ops::Range;

/// The column that says where the nodes are.
pub(super) const SPEED: &str = "speed";

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
    place: Range<usize>,
}

impl Columns {
    /// One more, of which this is the first number, as long as the file has it; what is wrong with that.
    pub(super) fn add(
        &mut self,
        first: &Variable,
        in_file: String,
        length: usize,
        place: Range<usize>,
    ) -> Option<Problem> {
        let (name, _) = first.meta.node().expect("it stands in a table");
        let is_wrong = !(1..=MOST_NODES).contains(&length);
        let wrong = is_wrong.then(|| {
            let right = format!("it must be from 1 to {MOST_NODES} numbers long");
            Problem::at(place.clone(), format!("{in_file} is {length} long"), right)
        });
        self.0.push(Column { block: first.place.block, name, in_file, length, place });
        wrong
    }

    /// The columns that are not as long as that of the speeds of their table.
    pub(super) fn problems(&self) -> impl Iterator<Item = Problem> {
        self.0.iter().filter_map(|column| {
            let Column { in_file, length, place, .. } = column;
            let tell = |wrong: String, right: String| Some(Problem::at(place.clone(), wrong, right));
            match self.speeds(column.block) {
                None => tell(
                    format!("{in_file} is a table without speeds"),
                    format!("give the speeds of its nodes in rad/s as `{SPEED} = [...]`"),
                ),
                Some(nodes) if nodes == *length || nodes == 0 => None,
                Some(nodes) => {
                    tell(format!("{in_file} is {length} long"), format!("it must be as long as {SPEED}, {nodes}"))
                }
            }
        })
    }

    /// Whether there is such a variable: in a table, that it has so many nodes.
    pub(super) fn hold(&self, variable: &Variable) -> bool {
        variable
            .meta
            .node()
            .is_none_or(|(_, node)| self.speeds(variable.place.block).is_some_and(|nodes| node <= nodes))
    }

    /// How many speeds the table of a block has, where it has any.
    fn speeds(&self, block: u32) -> Option<usize> {
        let speeds = self.0.iter().find(|column| column.block == block && column.name == SPEED);
        speeds.map(|speeds| speeds.length)
    }
}

//! Coefficients against a speed: monotone cubics between the nodes of a table, held beyond them. A table is given for positive speeds; at
//! negative ones some of its columns, the mirrored ones, have the other sign.

use crate::error::Invalid;
use crate::scalar::Scalar;

/// A table has at most so many nodes.
pub const MOST_NODES: usize = 16;

/// Coefficients at the nodes of a speed. The bits of `MIRRORED` are the columns that change their sign with the speed: below a first node
/// above 0 they go to 0 with it; with a node at 0 they jump there, unless they are 0.
#[derive(Clone, Debug)]
pub struct Table<const COLUMNS: usize, const NODES: usize, const MIRRORED: u32 = 0> {
    /// Speeds of the nodes [rad/s], ascending from at least 0.
    speed: [f64; NODES],
    /// The coefficients of each node.
    values: [[f64; COLUMNS]; NODES],
    /// The stretch that the motion is in; None before it begins, and where no coefficient is given.
    stretch: Option<Stretch<COLUMNS>>,
}

/// The speeds between two neighbouring nodes, about rest, or beyond the last node.
#[derive(Clone, Debug)]
struct Stretch<const COLUMNS: usize> {
    /// Whether its speeds are negative: all else here is of the speed with the other sign then.
    backward: bool,
    /// Its ends [rad/s].
    low: f64,
    high: f64,
    /// Where the powers count from [rad/s].
    origin: f64,
    /// Of each power of the speed beyond `origin`, the coefficient in each column.
    cubics: [[f64; COLUMNS]; 4],
}

/// A stretch is left where the speed is beyond its end by this part of it: rounding about a node is no event \[1].
const EDGE: f64 = 1e-9;

impl<const COLUMNS: usize, const NODES: usize, const MIRRORED: u32> Default for Table<COLUMNS, NODES, MIRRORED> {
    /// Nodes at speeds that nothing reaches, and sums of which do not overflow: what is held up to them is held for ever.
    fn default() -> Self {
        Self {
            speed: std::array::from_fn(|n| f64::MAX * ((n + 1) as f64 / (8 * MOST_NODES) as f64)),
            values: [[0.0; COLUMNS]; NODES],
            stretch: None,
        }
    }
}

impl<const COLUMNS: usize, const NODES: usize, const MIRRORED: u32> Table<COLUMNS, NODES, MIRRORED> {
    /// A table of these speeds [rad/s] and the coefficients there.
    pub fn new(speed: [f64; NODES], values: [[f64; COLUMNS]; NODES]) -> Self {
        Self { speed, values, stretch: None }
    }

    /// Whether any coefficient is given.
    pub fn is_given(&self) -> bool {
        self.values.as_flattened().iter().any(|value| *value != 0.0)
    }

    /// Whether a motion follows it.
    pub fn is_followed(&self) -> bool {
        self.stretch.is_some()
    }

    /// A number of a node, counted from 1: its speed in column 0, then its coefficients; 0 where there is no such node.
    pub fn number(&self, node: usize, column: usize) -> f64 {
        let number = match column {
            0 => self.speed.get(node - 1),
            _ => self.values.get(node - 1).map(|values| &values[column - 1]),
        };
        number.copied().unwrap_or_default()
    }

    /// Sets such a number.
    pub fn set(&mut self, node: usize, column: usize, value: f64) {
        let number = match column {
            0 => self.speed.get_mut(node - 1),
            _ => self.values.get_mut(node - 1).map(|values| &mut values[column - 1]),
        };
        number.into_iter().for_each(|number| *number = value);
    }

    /// Speeds ascend, and between them every curve is finite; the columns after that of the speeds have these names.
    pub fn check(&self, names: &[&str; COLUMNS]) -> Result<(), Invalid> {
        if let Some(n) = (1..NODES).find(|n| self.speed[*n] <= self.speed[n - 1]) {
            return Err(self.falling(n));
        }
        let of_first = |column: &usize| self.stretch(0, false).cubics[1][*column].is_finite();
        if let Some(column) = (0..COLUMNS).find(|column| !self.begins_at_rest() && !of_first(column)) {
            let bound = format!("0 or larger: the line of {} from 0 to it overflows", names[column]);
            return Err(Invalid::new("speed[1]", self.speed[0], bound));
        }
        let mut all = (1..NODES).flat_map(|nodes| (0..COLUMNS).map(move |column| (nodes, column)));
        match all.find(|(nodes, column)| !self.is_finite(*nodes, *column)) {
            None => Ok(()),
            Some((nodes, column)) => Err(self.blamed(nodes, column, names)),
        }
    }

    /// The speed at the node of this number, from 0, is not above that before.
    #[cold]
    fn falling(&self, n: usize) -> Invalid {
        let [before, here] = [self.speed[n - 1], self.speed[n]];
        // A node that nobody gave stands where no speed is.
        if here == Self::default().speed[n] {
            return Invalid::new(format!("speed[{n}]"), before, format!("less than {here:?} rad/s"));
        }
        Invalid::new(format!("speed[{}]", n + 1), here, format!("more than that of the node before, {before:?} rad/s"))
    }

    /// Whether the curve of a column is finite above so many nodes, up to the next one.
    fn is_finite(&self, nodes: usize, column: usize) -> bool {
        let stretch = self.stretch(nodes, false);
        let powers = stretch.cubics.iter().all(|of_power| of_power[column].is_finite());
        powers && stretch.at(stretch.high)[column].is_finite()
    }

    /// What makes the curve of a column overflow above so many nodes: of the speeds and rises that its slopes are made of, the shortest or
    /// the steepest, or a speed that is near the largest number that there is.
    #[cold]
    fn blamed(&self, nodes: usize, column: usize, names: &[&str; COLUMNS]) -> Invalid {
        // Three times two neighbours are added up (eq. 100).
        const LONGEST: f64 = f64::MAX / 6.0;
        let speed = |n: usize| ("speed", n, [self.speed[n - 1], self.speed[n]]);
        let value = |n: usize| (names[column], n, [n - 1, n].map(|n| self.values[n][column]));
        let extremity = |[from, to]: [f64; 2], is_speed: bool| match to - from {
            rise if !is_speed => rise.abs(),
            span if span > LONGEST => f64::INFINITY,
            span => span.recip(),
        };
        let near = (nodes.max(2) - 1..=(nodes + 1).min(NODES - 1)).flat_map(|n| [(speed(n), true), (value(n), false)]);
        // Of two alike, the first.
        let furthest = near.rev().max_by(|((.., one), of_one), ((.., other), of_other)| {
            extremity(*one, *of_one).total_cmp(&extremity(*other, *of_other))
        });
        let ((name, n, [from, to]), _) = furthest.expect("a stretch ends at two nodes");
        let bound = format!(
            "nearer to or further from that of the node before, {from:?}: the curve of {} between them overflows",
            names[column]
        );
        Invalid::new(format!("{name}[{}]", n + 1), to, bound)
    }

    /// The coefficients that a motion with a speed [rad/s] meets; None where none is given.
    #[inline(always)]
    pub fn at<S: Scalar>(&self, speed: S) -> Option<[S; COLUMNS]> {
        let stretch = self.stretch.as_ref()?;
        if stretch.holds(speed.re()) {
            return Some(stretch.at(speed));
        }
        // A stage of a method, or a host that knows no events, may be further on than the motion. About a node at rest, where mirrored columns
        // may jump, the motion keeps its side.
        if self.begins_at_rest() && stretch.low == 0.0 && stretch.holds(-speed.re()) {
            return Some(stretch.at(-speed));
        }
        Some(self.stretch(self.nodes_up_to(speed.re().abs()), speed.re() < 0.0).at(speed))
    }

    /// The first and the last speed for which coefficients are known [rad/s]; None where none is given.
    pub fn known(&self) -> Option<[f64; 2]> {
        // A node that nobody gave stands where no speed is.
        let is_told = |n: &usize| self.speed[*n] < Self::default().speed[0];
        let last = (0..NODES).rev().find(is_told)?;
        self.is_given().then(|| [self.speed[0], self.speed[last]])
    }

    /// The coefficients of the speed with the other sign.
    pub fn mirrored(of: [f64; COLUMNS]) -> [f64; COLUMNS] {
        std::array::from_fn(|column| if is_mirrored(MIRRORED, column) { -of[column] } else { of[column] })
    }

    /// Speeds ≥ 0 [rad/s] and the coefficients there: at the nodes, and at so many speeds between two.
    pub fn samples(&self, between: u32) -> impl Iterator<Item = (f64, [f64; COLUMNS])> {
        let from_to = self.speed.iter().zip(self.speed.iter().skip(1));
        let speeds = from_to.flat_map(move |(from, to)| {
            (0..=between).map(move |k| from + (to - from) * (f64::from(k) / f64::from(between + 1)))
        });
        let speeds = speeds.chain(self.speed.last().copied());
        speeds.map(|speed| (speed, self.stretch(self.nodes_up_to(speed), false).at(speed)))
    }

    /// How many nodes are not above a speed.
    fn nodes_up_to(&self, speed: f64) -> usize {
        self.speed.partition_point(|node| *node <= speed)
    }

    /// The slope in each column at the node of this number: harmonic means keep what is monotone between nodes monotone
    /// (Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300); none at the ends.
    fn slopes(&self, n: usize) -> [f64; COLUMNS] {
        if n == 0 || n + 1 >= NODES {
            return [0.0; COLUMNS];
        }
        let [before, after] = [n, n + 1].map(|n| self.speed[n] - self.speed[n - 1]);
        std::array::from_fn(|column| {
            let rise = |n: usize| self.values[n][column] - self.values[n - 1][column];
            let [left, right] = [rise(n) / before, rise(n + 1) / after];
            if left * right <= 0.0 {
                return 0.0;
            }
            let [w_left, w_right] = [before + 2.0 * after, 2.0 * before + after];
            // eq. 100: d = (w₁ + w₂)/(w₁/δ₁ + w₂/δ₂), w₁ = h₁ + 2h₂, w₂ = 2h₁ + h₂
            (w_left + w_right) / (w_left / left + w_right / right)
        })
    }

    /// The ends of the stretch above so many nodes [rad/s].
    fn ends(&self, nodes: usize) -> [f64; 2] {
        let low = if nodes == 0 { 0.0 } else { self.speed[nodes - 1] };
        [low, self.speed.get(nodes).copied().unwrap_or(f64::INFINITY)]
    }

    /// The stretch above so many nodes, forward or backward.
    fn stretch(&self, nodes: usize, backward: bool) -> Stretch<COLUMNS> {
        let [low, high] = self.ends(nodes);
        let mut cubics = [[0.0; COLUMNS]; 4];
        cubics[0] = self.values[nodes.saturating_sub(1)];
        if nodes == 0 {
            // What is mirrored goes through 0.
            for column in (0..COLUMNS).filter(|column| is_mirrored(MIRRORED, *column)) {
                cubics[1][column] = cubics[0][column] / high;
                cubics[0][column] = 0.0;
            }
            return Stretch { backward: false, low: -high, high, origin: 0.0, cubics };
        }
        if nodes < NODES {
            self.bend(nodes, high - low, &mut cubics);
        }
        if backward {
            cubics = cubics.map(Self::mirrored);
        }
        Stretch { backward, low, high, origin: low, cubics }
    }

    /// The powers above the first of the cubics above so many nodes, which are `h` long [rad/s].
    fn bend(&self, nodes: usize, h: f64, cubics: &mut [[f64; COLUMNS]; 4]) {
        let [from, to] = [nodes - 1, nodes].map(|n| self.slopes(n));
        for column in 0..COLUMNS {
            let rise = self.values[nodes][column] - self.values[nodes - 1][column];
            let ([d1, d2], secant) = ([from[column], to[column]], rise / h);
            // eq. 100: c₁ = d₁, c₂ = (3δ − 2d₁ − d₂)/h, c₃ = (d₁ + d₂ − 2δ)/h²
            cubics[1][column] = d1;
            cubics[2][column] = (3.0 * secant - 2.0 * d1 - d2) / h;
            cubics[3][column] = (d1 + d2 - 2.0 * secant) / h / h;
        }
    }

    /// Whether the first node is at rest: then what rises from there bends where the speed changes its sign.
    fn begins_at_rest(&self) -> bool {
        self.speed[0] == 0.0
    }

    /// How many nodes are below a stretch, which are numbered through both directions of the speed: 0, or −1 and 0 where the table
    /// [begins at rest](Self::begins_at_rest), are about rest.
    fn nodes_below(&self, number: f64) -> usize {
        let backward = number < 0.0;
        number.abs() as usize + usize::from(self.begins_at_rest() && !backward)
    }

    /// The number of the stretch with a speed [rad/s].
    fn stretch_of(&self, speed: f64) -> f64 {
        let nodes = self.nodes_up_to(speed.abs()) as f64;
        if speed < 0.0 { 0.0 - nodes } else { nodes - f64::from(self.begins_at_rest()) }
    }

    /// How far a speed is within a stretch [rad/s], negative for stretches of odd numbers: where it goes over to the next one, it
    /// changes its sign.
    pub fn within(&self, number: f64, speed: f64) -> f64 {
        let [low, high] = self.ends(self.nodes_below(number));
        let about_rest = number == 0.0 && !self.begins_at_rest();
        let forward = if number < 0.0 { -speed } else { speed };
        let low = if about_rest { -high } else { low };
        let above_low = forward - low + self.edge(low.abs());
        let below_high = if high.is_finite() { high + self.edge(high) - forward } else { above_low };
        let inside = if above_low < below_high { above_low } else { below_high };
        if number % 2.0 == 0.0 { inside } else { -inside }
    }

    /// So far beyond the end of a stretch at this speed, the next one begins [rad/s].
    fn edge(&self, end: f64) -> f64 {
        let least = match self.speed.get(usize::from(self.begins_at_rest())) {
            Some(speed) => *speed,
            // What jumps at its only node, at rest, has no other speed.
            None => 1.0,
        };
        EDGE * end.max(least)
    }

    /// Goes on in the stretch of a speed [rad/s]; where [`within`](Self::within) of that is not as `positive` says, in the nearer of its
    /// neighbours: an event is found to what the tolerance allows, not to rounding. Its number.
    pub fn follow(&mut self, speed: f64, positive: Option<bool>) -> f64 {
        let here = self.stretch_of(speed);
        let is_right = |number: f64| positive.is_none_or(|positive| (number % 2.0 == 0.0) == positive);
        let lacks = |number: f64| if self.exists(number) { self.within(number, speed).abs() } else { f64::INFINITY };
        let number = match [here - 1.0, here + 1.0] {
            _ if is_right(here) => here,
            [below, above] if lacks(below) < lacks(above) => below,
            [_, above] => above,
        };
        self.enter(number);
        number
    }

    /// Whether there is a stretch of this number.
    fn exists(&self, number: f64) -> bool {
        let last = NODES as f64 - f64::from(self.begins_at_rest());
        number.fract() == 0.0 && (-(NODES as f64)..=last).contains(&number)
    }

    /// Goes on in a stretch that was remembered; whether there is one of this number.
    pub fn restore(&mut self, number: f64) -> bool {
        let exists = self.exists(number);
        if exists {
            self.enter(number);
        }
        exists
    }

    fn enter(&mut self, number: f64) {
        self.stretch = self.is_given().then(|| self.stretch(self.nodes_below(number), number < 0.0));
    }
}

/// Whether a column is one of these, whose sign is that of the speed.
const fn is_mirrored(these: u32, column: usize) -> bool {
    (these >> column) & 1 == 1
}

impl<const COLUMNS: usize> Stretch<COLUMNS> {
    /// Whether a speed [rad/s] is in it.
    #[inline(always)]
    fn holds(&self, speed: f64) -> bool {
        let forward = if self.backward { -speed } else { speed };
        (self.low..=self.high).contains(&forward)
    }

    #[inline(always)]
    fn at<S: Scalar>(&self, speed: S) -> [S; COLUMNS] {
        let forward = if self.backward { -speed } else { speed };
        let x = forward - S::constant(self.origin);
        let [c0, c1, c2, c3] = &self.cubics;
        std::array::from_fn(|n| {
            let [c0, c1, c2, c3] = [c0[n], c1[n], c2[n], c3[n]].map(S::constant);
            // eq. 100: c₀ + c₁ x + c₂ x² + c₃ x³
            c0 + x * (c1 + x * (c2 + x * c3))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One coefficient at these speeds.
    fn table<const NODES: usize>(speeds: [f64; NODES]) -> Table<1, NODES> {
        let mut table = Table::default();
        for (n, speed) in (1..).zip(speeds) {
            table.set(n, 0, speed);
            table.set(n, 1, speed * speed + 1.0);
        }
        table
    }

    /// Stretches are numbered one after another from backward to forward, the sign changes from one to the next, and each is left at
    /// an edge beyond its end only.
    fn passes<const NODES: usize>(speeds: [f64; NODES], numbers: std::ops::RangeInclusive<i32>) {
        let mut table = table(speeds);
        let mut ends: Vec<f64> = speeds.iter().flat_map(|speed| [-speed, *speed]).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|one, other| one == other);
        let last = speeds[NODES - 1];
        assert_eq!(numbers.clone().count(), ends.len() + 1);
        for (number, place) in numbers.zip(0..) {
            let number = f64::from(number);
            let from = if place == 0 { -2.0 * last } else { ends[place - 1] };
            let to = ends.get(place).copied().unwrap_or(2.0 * last);
            let middle = 0.5 * (from + to);
            assert_eq!(table.follow(middle, None), number, "{middle} rad/s");
            let sign = if number % 2.0 == 0.0 { 1.0 } else { -1.0 };
            for inside in [from, middle, to] {
                assert!(sign * table.within(number, inside) > 0.0, "{inside} rad/s in {number}");
            }
            let Some(edge) = ends.get(place).map(|end| end + 1.5 * table.edge(end.abs())) else { continue };
            assert!(sign * table.within(number, edge) < 0.0, "{edge} rad/s is beyond {number}");
            // At the edge the sign says which of both it is.
            for (positive, expected) in [(sign > 0.0, number), (sign < 0.0, number + 1.0)] {
                assert_eq!(table.follow(edge, Some(positive)), expected);
                assert!(table.restore(expected));
            }
        }
    }

    #[test]
    fn stretches_follow_one_another() {
        passes([0.0, 20.0, 50.0], -3..=2);
        passes([10.0, 20.0, 50.0], -3..=3);
        passes([10.0], -1..=1);
    }

    #[test]
    fn a_stretch_that_is_not_there_is_refused() {
        for number in [-4.0, 3.0, 0.5, f64::NAN, f64::INFINITY] {
            assert!(!table([0.0, 20.0, 50.0]).restore(number), "{number}");
        }
    }

    #[test]
    fn where_the_speed_is_not_in_the_stretch_the_table_says_the_same() {
        let mut far = table([0.0, 20.0, 50.0]);
        let mut near = far.clone();
        far.follow(70.0, None);
        for speed in [0.0, 13.0, 20.0, 49.0, 50.0, 70.0] {
            near.follow(speed, None);
            assert_eq!(far.at(speed), near.at(speed), "{speed} rad/s");
        }
    }
}

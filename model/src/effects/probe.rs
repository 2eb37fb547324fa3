//! `probe`: what sensors at a station see; they do nothing to the rotor.

use super::{Effect, Facts, Row};
use crate::variable::units::{METRE, METRE_PER_SECOND, RADIAN};
use crate::variable::{Bound, output, parameter};

/// A pair of sensors across the x axis, and the direction of one that stands between them.
#[derive(Clone, Debug, Default)]
pub struct Probe {
    /// Where it looks, along t from c \[m].
    pub position: f64,
    /// Direction of its sensor, from y towards z \[rad]: the unbalance response lists what that sees.
    pub angle: f64,
}

impl Effect for Probe {
    const LAW: &'static str = "place and velocity of a station; no load";

    const ROWS: &'static [Row<Self>] = &[
        parameter!(position, &METRE, None, Bound::Finite, "axial position from the mass centre"),
        parameter!(
            angle,
            &RADIAN,
            Some(0.0),
            Bound::Finite,
            "direction from y towards z in which response lists peaks, beside y and z"
        ),
        output!("r.y", &METRE, "position of the station, y", |p, m| m.station(p.position).y),
        output!("r.z", &METRE, "position of the station, z", |p, m| m.station(p.position).z),
        output!("v.y", &METRE_PER_SECOND, "velocity of the station, y", |p, m| m.station_velocity(p.position).y),
        output!("v.z", &METRE_PER_SECOND, "velocity of the station, z", |p, m| m.station_velocity(p.position).z),
    ];

    const FACTS: Facts = Facts { shows_velocity: true, pushes: false, could_work: false, ..Facts::USUAL };
}

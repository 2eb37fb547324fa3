//! How far and when an unbalance makes the stations of a machine whirl, against the spin; by the linear equations, and by
//! the laws as they stand.

pub mod nonlinear;
mod table;

use crate::{doubts, peaks, rows, scenes, speeds};
use anyhow::{Context, Result, bail, ensure};
use nalgebra::ComplexField;
use serde_json::{Value, json};
use split_rotor_model::linear::{Machine, Obstacle, Orbit, Response};
use split_rotor_model::periodic::{self, Branch};
use split_rotor_model::scene::Scene;

/// What was found.
pub struct Found<'s> {
    /// The scene.
    pub scene: &'s Scene,
    /// Where it was looked at.
    pub stations: Vec<Station>,
    /// [rad/s].
    pub speeds: Vec<f64>,
    /// By the linear equations, where they hold.
    pub linear: Result<Linear, Obstacle>,
    /// By the laws as they stand, where that was asked for.
    pub nonlinear: Option<Vec<Result<Branch, periodic::Obstacle>>>,
}

/// By the linear equations.
pub struct Linear {
    /// By speed.
    pub points: Vec<Point>,
    /// Of each station, where what is seen of its orbit is larger than beside it.
    pub peaks: Vec<Vec<Peak>>,
}

/// What of a station's orbit is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sight {
    /// What a fixed probe along y sees.
    Y,
    /// What a fixed probe along z sees.
    Z,
    /// What a fixed probe in this direction sees, from y towards z \[rad].
    Along(f64),
    /// The larger semi-axis, which no fixed probe sees unless it stands along that.
    Major,
}

impl Sight {
    /// As tables call it.
    pub fn name(self) -> String {
        match self {
            Self::Y => "y".into(),
            Self::Z => "z".into(),
            Self::Along(angle) => format!("{}° from y towards z", (angle.to_degrees() * 1e4).round() / 1e4),
            Self::Major => "larger semi-axis".into(),
        }
    }

    /// How far the orbit goes from its middle there, 0-to-peak \[m].
    pub fn of(self, orbit: &Orbit) -> f64 {
        match self {
            Self::Y => orbit.y.modulus(),
            Self::Z => orbit.z.modulus(),
            Self::Along(angle) => (orbit.y * angle.cos() + orbit.z * angle.sin()).modulus(),
            Self::Major => orbit.major(),
        }
    }
}

/// Where what is seen of an orbit is larger than beside it.
#[derive(Clone)]
pub struct Peak {
    /// What is seen.
    pub sight: Sight,
    /// Where.
    pub point: Point,
}

/// A speed [rad/s] that was looked at, and how the machine whirls there; None without bound, where nothing damps a resonance.
#[derive(Clone)]
pub struct Point {
    /// [rad/s].
    pub speed: f64,
    response: Option<Response>,
}

impl Point {
    fn of(machine: &Machine, speed: f64, near: Option<&Self>) -> Result<Self, Obstacle> {
        let steady = near.and_then(|near| near.response.as_ref()).map(|response| &response.steady);
        match machine.response(speed, steady) {
            Err(Obstacle::Resonant { speed }) => Ok(Self { speed, response: None }),
            response => Ok(Self { speed, response: Some(response?) }),
        }
    }

    /// The orbit there, where it has a bound.
    pub fn orbit(&self, station: &Station) -> Option<Orbit> {
        self.response.as_ref().map(|response| response.orbit(station.position))
    }

    /// The larger half axis of the orbit there \[m].
    pub fn size(&self, station: &Station) -> f64 {
        self.seen(station, Sight::Major)
    }

    /// What is seen of the orbit there, 0-to-peak \[m].
    pub fn seen(&self, station: &Station, sight: Sight) -> f64 {
        self.orbit(station).map_or(f64::INFINITY, |orbit| sight.of(&orbit))
    }
}

/// By how much y is behind the rotor's mark at a speed [rad/s] \[°].
pub fn lag(speed: f64, orbit: &Orbit) -> f64 {
    -orbit.y.argument().to_degrees() * speed.signum()
}

/// A place on the axis that is looked at.
pub struct Station {
    /// Of the effect that stands there, or c.
    pub name: String,
    /// From c, along t \[m].
    pub position: f64,
    /// The direction of its sensor, from y towards z \[rad].
    angle: f64,
}

impl Station {
    /// What is looked at there.
    pub fn sights(&self) -> impl Iterator<Item = Sight> + use<> {
        let (sine, cosine) = self.angle.sin_cos();
        // What is as good as along y or z is there already.
        let along = (sine.abs().min(cosine.abs()) > 1e-9).then_some(Sight::Along(self.angle));
        [Sight::Y, Sight::Z].into_iter().chain(along).chain([Sight::Major])
    }

    /// As tables and pictures call it.
    pub fn title(&self) -> String {
        format!("{} at {} m", self.name, self.position)
    }
}

impl<'s> Found<'s> {
    /// The response of a scene between these speeds [rad/s], at so many of them; whether also by the laws as they stand.
    pub fn of(scene: &'s Scene, ends: Option<[f64; 2]>, steps: u32, exact: bool) -> Result<Self> {
        let file = || scene.file.display().to_string();
        let unbalance = scene.parameters().shape().unbalance();
        ensure!(
            unbalance.iter().any(|off| off.norm() > 0.0),
            "{}: nothing is out of balance (effects.unbalance)",
            file()
        );
        let machine = Machine::of(&scene.parameters());
        let speeds = speeds::range(scene, machine.as_ref().ok(), ends, steps).with_context(file)?;
        let stations = stations(scene);
        let linear = machine.and_then(|machine| Linear::of(&machine, &speeds, &stations));
        if let (Err(obstacle), false) = (&linear, exact) {
            bail!("{}: {obstacle}", file());
        }
        let nonlinear = exact.then(|| nonlinear::branches(scene, &speeds));
        Ok(Self { scene, stations, speeds, linear, nonlinear })
    }

    /// For people, in Markdown.
    pub fn table(&self) -> String {
        table::table(self)
    }

    /// A row for each station at each speed at which it has a bound, by the linear equations.
    pub fn rows(&self) -> Vec<rows::Row> {
        let points = self.linear.iter().flat_map(|linear| &linear.points);
        let all = points.flat_map(|point| self.stations.iter().map(move |station| (point, station)));
        let row = |(point, station): (&Point, &Station)| {
            let place = vec![
                ("speed_rad_s", json!(point.speed)),
                ("station", json!(station.name)),
                ("position_m", json!(station.position)),
            ];
            Some([place, once(point.orbit(station)?)].concat())
        };
        all.filter_map(row).collect()
    }

    /// A row for each peak of a station, by the linear equations; without an amplitude where that has no bound.
    pub fn peaks(&self) -> Vec<rows::Row> {
        let peaks = self.linear.iter().flat_map(|linear| self.stations.iter().zip(&linear.peaks));
        let all = peaks.flat_map(|(station, peaks)| peaks.iter().map(move |peak| (station, peak)));
        let row = |(station, Peak { sight, point }): (&Station, &Peak)| {
            let orbit = point.orbit(station);
            vec![
                ("station", json!(station.name)),
                ("position_m", json!(station.position)),
                ("seen_along", json!(sight.name())),
                ("speed_rad_s", json!(point.speed)),
                ("amplitude_m", json!(orbit.map(|orbit| sight.of(&orbit)))),
                ("major_m", json!(orbit.map(|orbit| orbit.major()))),
                ("minor_m", json!(orbit.map(|orbit| orbit.minor()))),
            ]
        };
        all.map(row).collect()
    }

    /// All of it.
    pub fn json(&self) -> Value {
        json!({
            "scene": self.scene.name,
            "title": self.scene.title,
            "tables": doubts::tables(self.scene),
            "peaks": rows::objects(self.peaks()),
            "responses": rows::objects(self.rows()),
            "nonlinear": rows::objects(nonlinear::rows(self)),
        })
    }
}

impl Linear {
    fn of(machine: &Machine, speeds: &[f64], stations: &[Station]) -> Result<Self, Obstacle> {
        let mut points: Vec<Point> = Vec::new();
        for speed in speeds {
            points.push(Point::of(machine, *speed, points.last())?);
        }
        let peaks = stations.iter().map(|station| peaks_of(machine, station, &points)).collect::<Result<_, _>>()?;
        Ok(Self { points, peaks })
    }
}

/// c, and what looks at the rotor or touches it: probes, or bearings and rings where there are none.
fn stations(scene: &Scene) -> Vec<Station> {
    let value = scenes::values(scene);
    let of = |kinds: &[&str]| -> Vec<Station> {
        let blocks = scene.effects.iter().filter(|(info, _)| kinds.contains(&info.name));
        // In a general scene an effect may be off.
        let blocks = blocks.filter(|(info, index)| value(&info.switch_name(*index)) != Some(0.0));
        let names = blocks.map(|(info, index)| info.block_name(*index));
        let station = |name: String| {
            let of = |what| value(&format!("{name}.{what}"));
            Some(Station { position: of("position")?, angle: of("angle").unwrap_or(0.0), name })
        };
        names.filter_map(station).collect()
    };
    let probes = of(&["probe"]);
    let rest = if probes.is_empty() { of(&["bearing", "rub"]) } else { probes };
    std::iter::once(Station { name: "c".into(), position: 0.0, angle: 0.0 }).chain(rest).collect()
}

/// Where what is seen of the orbit of a station is larger than beside it.
fn peaks_of(machine: &Machine, station: &Station, points: &[Point]) -> Result<Vec<Peak>, Obstacle> {
    let at = |speed: f64, near: &Point| Point::of(machine, speed, Some(near));
    let mut all = Vec::new();
    for sight in station.sights() {
        let found = peaks::of(points, |point| (point.speed, point.seen(station, sight)), at)?;
        all.extend(found.into_iter().map(|point| Peak { sight, point }));
    }
    Ok(all)
}

/// A station's harmonic that goes round with the spin, as columns.
fn once(orbit: Orbit) -> rows::Row {
    let Orbit { y, z } = orbit;
    vec![
        ("major_m", json!(orbit.major())),
        ("minor_m", json!(orbit.minor())),
        ("amplitude_y_m", json!(y.modulus())),
        ("phase_y_rad", json!(y.argument())),
        ("amplitude_z_m", json!(z.modulus())),
        ("phase_z_rad", json!(z.argument())),
    ]
}

#[cfg(test)]
mod tests {
    use super::{Found, Peak, Sight};
    use nalgebra::{Complex, ComplexField};
    use split_rotor_model::scene::Scene;
    use std::path::Path;

    /// Two equal bearings at ±0.8 m: m q̈ + 2c q̇ + 2k q = ω² m e in each direction on its own.
    const TEXT: &str = "[rotor]\nm = 1000.0\nJa = 60.0\nJt = 150.0\n\
        [[effects.bearing]]\nposition = -0.8\nkyy = 0.9e7\nkzz = 1.4e7\ncyy = 2e4\nczz = 2e4\nkxx = 1e7\ncxx = 1e4\n\
        [[effects.bearing]]\nposition = 0.8\nkyy = 0.9e7\nkzz = 1.4e7\ncyy = 2e4\nczz = 2e4\n\
        [[effects.unbalance]]\nmass = 1e-3\nradius = 40.0\nposition = 0.0\n[[effects.probe]]\nposition = 0.0\nangle = \"30 deg\"\n";

    #[test]
    fn regress_each_direction_of_a_probe_has_its_peak() {
        let scene = Scene::parse(Path::new("probes.toml"), TEXT).expect("a scene");
        let found = Found::of(&scene, None, 201, false).expect("a response");
        let linear = found.linear.as_ref().expect("linear equations");
        let probe = found.stations.iter().position(|station| station.name == "probe[1]").expect("it has one");
        for (sight, k, at, size) in [(Sight::Y, 1.8e7, 137.24, 135.7e-6), (Sight::Z, 2.8e7, 169.76, 168.5e-6)] {
            let [peak] = &linear.peaks[probe].iter().filter(|peak| peak.sight == sight).collect::<Vec<_>>()[..] else {
                panic!("one peak is expected along {}", sight.name());
            };
            // Of U ω²/(k − m ω² + 2icω) the largest is where ω² = k²/(m k − 2c²), c being of one bearing.
            let exact = k / (1000.0 * k - 2.0 * 2e4 * 2e4_f64).sqrt();
            assert!((peak.point.speed / exact - 1.0).abs() < 2e-6, "{} {exact}", peak.point.speed);
            assert!((exact - at).abs() < 0.02, "{exact} {at}");
            let largest = 0.04 * exact * exact / Complex::new(k - 1000.0 * exact * exact, 4e4 * exact).modulus();
            let seen = peak.point.seen(&found.stations[probe], sight);
            // The mass of the unbalance adds to the rotor's by a part of 1e-6.
            assert!((seen / largest - 1.0).abs() < 1e-5 && (seen / size - 1.0).abs() < 1e-3, "{seen} {largest} {size}");
        }
        // Along 30° from y: U ω² (cos 30°/(k_y − m ω² + 2icω) + sin 30° (−i)/(k_z − m ω² + 2icω)).
        let sensor = |speed: f64| {
            let [along_y, along_z] = [1.8e7, 2.8e7]
                .map(|k: f64| 0.04 * speed * speed / Complex::new(k - 1000.0 * speed * speed, 4e4 * speed));
            (along_y * 0.75_f64.sqrt() - Complex::<f64>::i() * along_z * 0.5).modulus()
        };
        let of_sensor = |peak: &&Peak| peak.sight == Sight::Along(30_f64.to_radians());
        let seen: Vec<_> = linear.peaks[probe].iter().filter(of_sensor).collect();
        let speeds: Vec<_> = (1..4000).map(|n| 0.1 * f64::from(n)).collect();
        let peaks = speeds.windows(3).filter(|at| sensor(at[1]) > sensor(at[0]).max(sensor(at[2]))).count();
        assert_eq!(seen.len(), peaks);
        for peak in seen {
            let (speed, size) = (peak.point.speed, peak.point.seen(&found.stations[probe], peak.sight));
            assert!((size / sensor(speed) - 1.0).abs() < 1e-4, "{size} {}", sensor(speed));
            assert!(sensor(speed) > sensor(speed * 1.001) && sensor(speed) > sensor(speed * 0.999), "{speed}");
        }
        assert!(linear.peaks[probe].iter().any(|peak| peak.sight == Sight::Major), "the larger semi-axis is kept");
        let table = found.table();
        assert!(
            table.contains("0-to-peak")
                && table.contains("| 30° from y towards z |")
                && table.contains("| y | 135.68")
                && table.contains("| z | 168.54"),
            "{table}"
        );
        assert!(found.peaks().iter().any(|row| row.contains(&("seen_along", "y".into()))));
    }
}

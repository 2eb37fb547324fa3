//! When the motion is read, and how long the runs of a scene may be.

use super::run::Subject;
use super::sweep;
use split_rotor_model::scene::Experiment;

/// The motion is read so many times; the start does not count.
pub const POINTS: usize = 100;

/// It is read at the ends of some of so many equal parts of the span: a prime, so that the parts are no multiple of a period
/// that somebody would type.
pub const PARTS: usize = 997;

/// After how many parts it is read the `n`th time. Irregular, or a method could gain where a mode is always met in one phase.
pub fn part(n: usize) -> usize {
    if n == 0 || n == POINTS {
        return n * PARTS / POINTS;
    }
    // n² golden ratios: they keep far apart from each other, and show no period.
    let jitter = ((n * n) as f64 * 0.618_033_988_749_894_9).fract();
    ((n as f64 - 0.9 + 0.8 * jitter) * PARTS as f64 / POINTS as f64) as usize + 1
}

/// When it is read the `n`th time \[s].
pub fn time(experiment: &Experiment, n: usize) -> f64 {
    end_of_part(experiment, part(n))
}

/// The end of the `k`th part \[s].
pub fn end_of_part(experiment: &Experiment, k: usize) -> f64 {
    let Experiment { start, stop, .. } = *experiment;
    if k == PARTS { stop } else { start + (stop - start) * k as f64 / PARTS as f64 }
}

/// The check of the reference may take so many evaluations, two or three seconds. All that is measured of a scene takes some
/// twenty times as long. Counted, not timed, so that every machine cuts alike.
const AFFORDABLE: f64 = 2e7;

/// The first communication step of the trial, as a part of the span, and how much longer each is than the one before it.
const FIRST: f64 = 1e-9;
const LONGER: f64 = 1.1;

/// Shortens the runs of a scene to what a minute holds: to where the check of the reference, which is the dearest run that
/// always must be made, comes in its time. Where it is refused, nothing is known, and nothing shortened.
pub fn shorten(subject: &mut Subject) {
    for tolerance in sweep::tolerances().into_iter().rev().step_by(3) {
        let setting = sweep::with_tolerance(sweep::DOPRI5, tolerance);
        let Experiment { start, stop, .. } = subject.experiment;
        let whole = stop - start;
        let mut step = FIRST * whole;
        let times = std::iter::successors(Some(start), |t| {
            let next = t + step;
            step *= LONGER;
            (*t < stop).then_some(if next < stop { next } else { stop })
        });
        if let Ok(reached) = subject.reach(&setting, times.skip(1), AFFORDABLE) {
            subject.experiment.stop = cut(&subject.experiment, reached);
            return;
        }
    }
}

/// The stop of runs that are to end where a trial came to \[s].
fn cut(experiment: &Experiment, reached: f64) -> f64 {
    let Experiment { start, stop, .. } = *experiment;
    if reached < stop { start + round(reached - start) } else { stop }
}

/// One of ten numbers in a power of ten, not longer than this span \[s].
fn round(span: f64) -> f64 {
    let exponent = span.log10().floor() as i32;
    let digits = ["8", "6", "5", "4", "3", "2.5", "2", "1.5", "1.2", "1"];
    let sizes = [exponent, exponent - 1].into_iter().flat_map(|n| digits.map(|m| format!("{m}e{n}")));
    // Written out and read, so that it is the number that a user would type.
    sizes.map(|text| text.parse().expect("a number")).find(|size| *size <= span).expect("one is shorter")
}

/// That a part of the scene is run, if so.
pub fn told(run: &Experiment, scene: &Experiment) -> Option<String> {
    let ([some, all], stop) = ([run, scene].map(|experiment| experiment.stop - experiment.start), run.stop);
    (some < all).then(|| {
        format!("Of the {all} s of the scene {some} s are run, to t = {stop} s: more does not fit into a minute of CPU time.")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_read_at_irregular_times_to_the_very_end() {
        let parts: Vec<_> = (0..=POINTS).map(part).collect();
        assert_eq!((parts[0], parts[POINTS]), (0, PARTS));
        assert!(parts.is_sorted_by(|a, b| a < b), "{parts:?}");
        // Of any period the points see every phase: no phase occurs to the exclusion of its opposite.
        for period in 3..200 {
            let mean = |phase: fn(f64) -> f64| {
                let of = |part: &usize| phase(std::f64::consts::TAU * *part as f64 / f64::from(period));
                parts.iter().map(of).sum::<f64>() / parts.len() as f64
            };
            let gathered = mean(f64::cos).hypot(mean(f64::sin));
            assert!(gathered < 0.5, "{gathered} with a period of {period} parts");
        }
        let experiment = Experiment { start: 1.0, stop: 3.3, step: 0.1, tolerance: 1e-6 };
        assert_eq!((time(&experiment, 0), time(&experiment, POINTS)), (1.0, 3.3));
    }

    #[test]
    fn a_span_is_cut_to_a_number_that_a_user_would_type() {
        let scene = Experiment { start: 3.0, stop: 13.0, step: 0.1, tolerance: 1e-6 };
        assert_eq!([3.7, 12.9, 13.0].map(|reached| cut(&scene, reached)), [3.6, 11.0, 13.0]);
        for (span, cut) in [(2270.0, 2000.0), (0.49, 0.4), (5.0, 5.0), (1e-3, 1e-3), (9.99, 8.0), (123.0, 120.0)] {
            assert_eq!(round(span), cut);
        }
    }

    #[test]
    fn a_cut_span_is_told() {
        let scene = Experiment { start: 0.0, stop: 60.0, step: 0.01, tolerance: 1e-8 };
        assert_eq!(told(&scene, &scene), None);
        let some = told(&Experiment { stop: 5.0, ..scene }, &scene).unwrap();
        assert!(some.starts_with("Of the 60 s of the scene 5 s are run, to t = 5 s"), "{some}");
    }
}

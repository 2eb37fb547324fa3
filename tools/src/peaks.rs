//! Where something that was looked at point by point is larger than beside it.

/// What is higher by no more than this part is level but for rounding \[1].
const FLAT: f64 = 1e-9;

/// Between two points a peak is narrowed down so often: until rounding decides.
const NARROWED: u32 = 60;

const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The peaks between these points, which ascend, by the golden section: `seen` says where a point is and its size, `at` makes another one,
/// near the best so far.
pub fn of<P: Clone, E>(
    points: &[P],
    seen: impl Fn(&P) -> (f64, f64),
    at: impl Fn(f64, &P) -> Result<P, E>,
) -> Result<Vec<P>, E> {
    let size = |point: &P| seen(point).1;
    let is_peak = |three: &&[P]| {
        let [before, at, after] = [0, 1, 2].map(|n| size(&three[n]));
        at > before * (1.0 + FLAT) && at >= after
    };
    let narrowed = |three: &[P]| {
        let ([mut from, best, mut to], mut largest) = ([0, 1, 2].map(|n| seen(&three[n]).0), three[1].clone());
        let mut best = best;
        for _ in 0..NARROWED {
            if !size(&largest).is_finite() {
                break;
            }
            // The larger part beside the best is divided; the better one stays within, the other is an end.
            let is_below = best - from > to - best;
            let place = if is_below { to - GOLDEN * (to - from) } else { from + GOLDEN * (to - from) };
            let tried = at(place, &largest)?;
            let worse = if size(&tried) > size(&largest) {
                largest = tried;
                std::mem::replace(&mut best, place)
            } else {
                place
            };
            if worse < best {
                from = worse;
            } else {
                to = worse;
            }
        }
        Ok(largest)
    };
    points.windows(3).filter(is_peak).map(narrowed).collect()
}

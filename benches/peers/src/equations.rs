//! The rotor as dy/dt = f(y), y = (r_c, v_c, K_c, t, φ): the equations of `xtask/python/peers/equations.py`, for numbers.

/// r_c \[m], v_c [m/s], K_c [kg·m²/s], t \[1], φ \[rad].
pub type State = [f64; 13];

/// The scene: parameters in SI units, zero where the scene lacks the effect.
#[derive(Clone, Copy)]
pub struct Rotor {
    pub m: f64,
    pub ja: f64,
    pub jt: f64,
    pub l: f64,
    pub g: [f64; 3],
    pub c1: f64,
    pub c2: f64,
    pub d1: f64,
    pub d2: f64,
    pub tau: f64,
}

/// θ/sinθ, from the axis: as a series in u = 1 − cosθ where that is short.
fn stretch(axis: [f64; 3]) -> f64 {
    let u = 1.0 - axis[0];
    if u < 0.02 {
        // The next term is below 1e-17.
        const SERIES: [f64; 8] = {
            let mut series = [1.0; 8];
            let mut k = 1;
            while k < 8 {
                series[k] = series[k - 1] * k as f64 / (2 * k + 1) as f64;
                k += 1;
            }
            series
        };
        return SERIES.iter().rev().fold(0.0, |sum, coefficient| sum * u + coefficient);
    }
    let sine = axis[1].hypot(axis[2]);
    sine.atan2(axis[0]) / sine
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// r_c, v_c, K_c, t.
fn vectors(y: &State) -> [[f64; 3]; 4] {
    std::array::from_fn(|n| [y[3 * n], y[3 * n + 1], y[3 * n + 2]])
}

impl Rotor {
    /// ω [rad/s].
    fn omega(&self, k: [f64; 3], t: [f64; 3]) -> [f64; 3] {
        // eq. 11: ω = K/Jt + (1/Ja − 1/Jt)(K·t) t
        let spin = (1.0 / self.ja - 1.0 / self.jt) * dot(k, t);
        std::array::from_fn(|i| k[i] / self.jt + spin * t[i])
    }

    /// y from what a scene gives.
    pub fn start(&self, [r_c, v_c, omega, t]: [[f64; 3]; 4], phi: f64) -> State {
        // eq. 11: K = Jt ω + (Ja − Jt)(ω·t) t
        let spin = (self.ja - self.jt) * dot(omega, t);
        let k: [f64; 3] = std::array::from_fn(|i| self.jt * omega[i] + spin * t[i]);
        let mut y = [phi; 13];
        y[..12].copy_from_slice([r_c, v_c, k, t].as_flattened());
        y
    }

    /// Kinetic and potential energy \[J].
    pub fn energy(&self, y: &State) -> f64 {
        let [r_c, v_c, k, t] = vectors(y);
        let r_a: [f64; 3] = std::array::from_fn(|i| r_c[i] - self.l * t[i]);
        let theta = t[1].hypot(t[2]).atan2(t[0]);
        let doubled =
            self.m * dot(v_c, v_c) + dot(k, self.omega(k, t)) + self.c1 * dot(r_a, r_a) + self.c2 * theta * theta;
        0.5 * doubled - self.m * dot(self.g, r_c)
    }

    /// dy/dt.
    #[inline]
    pub fn rates(&self, y: &State, dy: &mut State) {
        let Self { m, l, g, c1, c2, d1, d2, tau, .. } = *self;
        let [r_c, v_c, k, t] = vectors(y);
        let w = self.omega(k, t);
        let dt = cross(w, t);
        // eq. 6: ω_φ = ω·n, n = (e + t)/(1 + e·t)
        let n = [1.0, t[1] / (1.0 + t[0]), t[2] / (1.0 + t[0])];
        // eq. 14: F = −c1 r_a − d1 v_a, M_c = −l t×F − c2 γ − d2 t×(dt/dt)
        let f: [f64; 3] = std::array::from_fn(|i| -c1 * (r_c[i] - l * t[i]) - d1 * (v_c[i] - l * dt[i]));
        let at_a = cross(f, t);
        let along = dot(w, t);
        // eq. 2: t = e cosθ + (sinθ/θ) γ×e, so γ = (θ/sinθ) e×t
        let c2 = c2 * stretch(t);
        let gamma = [0.0, -t[2], t[1]];
        for i in 0..3 {
            dy[i] = v_c[i];
            dy[3 + i] = f[i] / m + g[i];
            dy[6 + i] = l * at_a[i] - c2 * gamma[i] - d2 * (w[i] - along * t[i]) + tau * n[i];
            dy[9 + i] = dt[i];
        }
        dy[12] = dot(w, n);
    }
}

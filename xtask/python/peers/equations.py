"""The rotor as dy/dt = f(t, y), y = (r_c, v_c, K_c, t, phi): 13 numbers; symbols and equations as in docs/theory.md.

The axis t stands for gamma: its rate omega x t is shorter than eq. 8 and regular everywhere, so it serves peers better.
"""

import math

import numpy as np


def start(rotor):
    """y at the start."""
    # eq. 11: K = Jt ω + (Ja − Jt)(ω·t) t
    spin = (rotor.Ja - rotor.Jt) * sum(w * t for w, t in zip(rotor.omega, rotor.axis))
    K_c = [rotor.Jt * w + spin * t for w, t in zip(rotor.omega, rotor.axis)]
    return [*rotor.r_c, *rotor.v_c, *K_c, *rotor.axis, rotor.phi]


def stretch(axis):
    """theta / sin(theta), by which gamma = e x t is to be stretched."""
    sine = math.hypot(axis[1], axis[2])
    return math.atan2(sine, axis[0]) / sine if sine else 1.0


def rates(rotor, y, stretch):
    """dy/dt, in numbers or in symbols; `stretch` as above."""
    m, Jt, l, c1, c2, d1, d2, tau = (getattr(rotor, name) for name in ("m", "Jt", "l", "c1", "c2", "d1", "d2", "tau"))
    x, y_, z, v_x, v_y, v_z, K_x, K_y, K_z, t_x, t_y, t_z, _ = y
    # eq. 11: ω = K/Jt + (1/Ja − 1/Jt)(K·t) t
    spin = (1.0 / rotor.Ja - 1.0 / Jt) * (K_x * t_x + K_y * t_y + K_z * t_z)
    w_x, w_y, w_z = K_x * (1.0 / Jt) + spin * t_x, K_y * (1.0 / Jt) + spin * t_y, K_z * (1.0 / Jt) + spin * t_z
    dt_x, dt_y, dt_z = w_y * t_z - w_z * t_y, w_z * t_x - w_x * t_z, w_x * t_y - w_y * t_x
    # eq. 6: ω_φ = ω·n, n = (e + t)/(1 + e·t)
    n_y, n_z = t_y / (1.0 + t_x), t_z / (1.0 + t_x)
    dphi = w_x + n_y * w_y + n_z * w_z
    # eq. 14: F = −c1 r_a − d1 v_a, M_c = −l t×F − c2 γ − d2 t×(dt/dt)
    F_x, F_y, F_z = -c1 * (x - l * t_x), -c1 * (y_ - l * t_y), -c1 * (z - l * t_z)
    if d1:
        F_x, F_y, F_z = F_x - d1 * (v_x - l * dt_x), F_y - d1 * (v_y - l * dt_y), F_z - d1 * (v_z - l * dt_z)
    M_x, M_y, M_z = l * (F_y * t_z - F_z * t_y), l * (F_z * t_x - F_x * t_z), l * (F_x * t_y - F_y * t_x)
    if c2:
        # eq. 2: t = e cosθ + (sinθ/θ) γ×e, so γ = (θ/sinθ) e×t
        f = c2 * stretch
        M_y, M_z = M_y + f * t_z, M_z - f * t_y
    if d2:
        along = w_x * t_x + w_y * t_y + w_z * t_z
        M_x, M_y, M_z = M_x - d2 * (w_x - along * t_x), M_y - d2 * (w_y - along * t_y), M_z - d2 * (w_z - along * t_z)
    if tau:
        # eq. 32: M = τ n
        M_x, M_y, M_z = M_x + tau, M_y + tau * n_y, M_z + tau * n_z
    g_x, g_y, g_z = rotor.g
    dv = F_x * (1.0 / m) + g_x, F_y * (1.0 / m) + g_y, F_z * (1.0 / m) + g_z
    return [v_x, v_y, v_z, *dv, M_x, M_y, M_z, dt_x, dt_y, dt_z, dphi]


def in_numbers(rotor):
    """f(t, y) for solvers that call Python: plain numbers are faster than arrays of three."""

    def f(t, y):
        y = y.tolist()
        return rates(rotor, y, stretch(y[9:12]))

    return f


def motion(rotor, states):
    """The states at the communication points, as the columns that `task.Motion` wants."""
    r_c, v_c, K_c, axis, phi = np.split(np.asarray(states), [3, 6, 9, 12], axis=1)
    # eq. 11: ω = K/Jt + (1/Ja − 1/Jt)(K·t) t
    spin = (1.0 / rotor.Ja - 1.0 / rotor.Jt) * np.sum(K_c * axis, axis=1, keepdims=True)
    return {"r_c": r_c, "v_c": v_c, "omega": K_c / rotor.Jt + spin * axis, "axis": axis, "phi": phi[:, 0]}

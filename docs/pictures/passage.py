"""Draws passage.svg: a free rotor passes −e at the distance δ = 0.02 rad.

Its axis moves at Ω = 10 rad/s and it has no axial spin, so ω is constant and the motion is L(ωs)·L(0), exactly.
Left:  φ and ω_φ. Right: γ, whose direction turns by nearly half a turn, and γ′, which goes straight through.

Needs numpy and matplotlib:  python passage.py
Equation numbers are those of ../theory.md.
"""

import matplotlib.pyplot as plt
import numpy as np
from style import BLUE, GREY, ORANGE, save

RATE = 10.0  # Ω [rad/s]
DELTA = 0.02  # δ [rad]
HEADING = np.radians(25.0)  # direction of γ′ along the passage, from y towards z
SPAN = 0.05  # half of the time shown [s]

E = np.array([1.0, 0.0, 0.0])
# Along and across the passage in the plane normal to e, as γ′ shows them; t has γ′×e with the sign reversed (eq. 29).
ALONG = np.cross(E, [0.0, np.cos(HEADING), np.sin(HEADING)])
ACROSS = np.cross(E, [0.0, np.sin(HEADING), -np.cos(HEADING)])
NEAREST = -np.cos(DELTA) * E + np.sin(DELTA) * ACROSS  # t at time 0
OMEGA = RATE * np.cross(NEAREST, ALONG)

# Times so close together that neither γ nor γ′ turns by much from one to the next.
time = SPAN * np.linspace(-1.0, 1.0, 4001)
angle = RATE * time
t = np.outer(np.cos(angle), NEAREST) + np.outer(np.sin(angle), ALONG)

across = np.hypot(t[:, 1], t[:, 2])
theta = np.arctan2(across, t[:, 0])
gamma = (theta / across)[:, None] * np.column_stack([-t[:, 2], t[:, 1]])  # eq. 2, backwards
gamma_2 = gamma * (-(np.pi - theta) / theta)[:, None]  # eq. 26

# φ′ of the free motion by the trapezoidal rule (eq. 29), then φ = φ′ + 2β (eq. 27)
theta_2 = np.pi - theta
g_2 = np.column_stack([gamma_2[:, 1], -gamma_2[:, 0]])
tau_2 = np.tan(0.5 * theta_2) / theta_2
rate_2 = -(OMEGA[0] + tau_2 * (g_2 @ OMEGA[1:]))
phi_2 = np.concatenate([[0.0], np.cumsum(0.5 * (rate_2[1:] + rate_2[:-1]) * np.diff(time))])
beta = np.unwrap(np.arctan2(gamma_2[:, 1], gamma_2[:, 0]))
phi = phi_2 + 2.0 * beta
phi -= phi[0]

rate = OMEGA[0] - (g_2 @ OMEGA[1:]) / (np.tan(0.5 * theta_2) * theta_2)  # eq. 30
gap = E + t
assert np.allclose(rate, (gap @ OMEGA) / (0.5 * (gap**2).sum(axis=1)), rtol=1e-9)  # eq. 6
assert abs(np.max(np.abs(rate)) / (2.0 * RATE / DELTA) - 1.0) < 1e-3  # eq. 25

figure, panels = plt.subplots(2, 2, figsize=(9.0, 4.6), layout="constrained", sharex=True)
((top_left, top_right), (low_left, low_right)) = panels
milliseconds = 1e3 * time

top_left.plot(milliseconds, phi, color=BLUE, lw=1.8)
top_left.axhline(2.0 * np.pi, color=GREY, lw=0.8, ls=":")
top_left.set(yticks=[0.0, np.pi, 2.0 * np.pi], yticklabels=["0", "π", "2π"], ylabel="φ  [rad]")
top_left.set_title("φ gains nearly a whole turn", fontsize=11)

low_left.plot(milliseconds, rate, color=BLUE, lw=1.8)
low_left.axhline(2.0 * RATE / DELTA, color=GREY, lw=0.8, ls=":")
low_left.text(milliseconds[0], 2.0 * RATE / DELTA, "2Ω/δ", color=GREY, va="bottom")
low_left.set(ylim=(-40.0, 1150.0), ylabel="ω_φ  [rad/s]", xlabel="time  [ms]")
low_left.set_title("Its rate", fontsize=11)

for axes, values, prime, title in (
    (top_right, gamma, "", "γ turns about"),
    (low_right, gamma_2, "′", "γ′ goes straight through"),
):
    axes.axhline(0.0, color=GREY, lw=0.8)
    axes.plot(milliseconds, values[:, 0], color=BLUE, lw=1.8, label=f"γ{prime}_y")
    axes.plot(milliseconds, values[:, 1], color=ORANGE, lw=1.8, label=f"γ{prime}_z")
    axes.set_ylabel(f"γ{prime}  [rad]")
    axes.set_title(title, fontsize=11)
    axes.legend(frameon=False, loc="upper left" if prime else "lower left")
low_right.set(yticks=[-0.4, 0.0, 0.4], xlabel="time  [ms]")

save(figure, "passage.svg")

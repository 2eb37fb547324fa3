"""Draws singular-point.svg: why the split rotation has its singular point at |γ| = π.

Left:  the denominator of eq. 5, (θ/2)·cot(θ/2), from θ = 0 to 2π.
Right: the peak of |dφ/dt| while a torque-free rotor without axial spin tumbles
       at the rate Ω past −e at the distance δ, found on the exact motion.

Needs numpy and matplotlib:  python singular_point.py
Equation numbers are those of ../theory.md.
"""

import matplotlib.pyplot as plt
import numpy as np
from style import BLUE, GREY, ORANGE, save


def rotate(k, angle, v):
    """L(angle·k)·v for a unit vector k (Rodrigues)."""
    return (
        v * np.cos(angle)
        + np.cross(k, v) * np.sin(angle)
        + k * (k @ v) * (1.0 - np.cos(angle))
    )


def peak_rate(delta):
    """max |dφ/dt|/Ω over the passage; ω is constant, the axis is t = L(ωs)·t(0)."""
    e = np.array([1.0, 0.0, 0.0])
    k = np.array([np.sin(delta), np.cos(delta), 0.0])  # ω/Ω, normal to the great circle
    nearest = np.array([-np.cos(delta), np.sin(delta), 0.0])
    rates = []
    for angle in delta * np.linspace(-5.0, 5.0, 2001):
        t = rotate(k, angle, nearest)
        gap = e + t  # 1 + e·t = |e + t|²/2, without cancellation
        rates.append(abs(k @ gap) / (0.5 * (gap @ gap)))  # eq. 6
    return max(rates)


def tick(value, _position):
    """A power of ten as plain text."""
    digits = str(round(np.log10(value)))
    return "10" + digits.translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.6), layout="constrained")

theta = np.linspace(1e-6, 2.0 * np.pi - 1e-3, 800)
left.plot(theta, 0.5 * theta / np.tan(0.5 * theta), color=BLUE, lw=1.8)
left.axhline(0.0, color=GREY, lw=0.8)
left.axvline(2.0 * np.pi, color=GREY, lw=0.8, ls=":")
left.plot([np.pi], [0.0], "o", color=ORANGE, ms=7, zorder=3)
left.annotate(
    "zero at θ = π,\nwhere the axis is −e",
    xy=(np.pi, 0.0),
    xytext=(np.pi + 0.3, 0.5),
    color=ORANGE,
)
left.set(
    xlim=(0.0, 2.0 * np.pi),
    ylim=(-4.0, 1.4),
    xticks=[0.0, 0.5 * np.pi, np.pi, 1.5 * np.pi, 2.0 * np.pi],
    xticklabels=["0", "π/2", "π", "3π/2", "2π"],
    xlabel="θ = |γ|  [rad]",
    ylabel="(θ/2)·cot(θ/2)",
)
left.set_title("Denominator of dφ/dt", fontsize=11)

delta = np.geomspace(1.0, 1e-4, 17)
right.loglog(delta, 2.0 / delta, color=GREY, lw=1.2, label="2/δ")
right.loglog(
    delta,
    [peak_rate(d) for d in delta],
    "o",
    color=BLUE,
    ms=5,
    label="exact free motion",
)
right.invert_xaxis()
right.xaxis.set_major_formatter(tick)
right.yaxis.set_major_formatter(tick)
right.minorticks_off()
right.set(xlabel="δ, distance of passage from −e  [rad]", ylabel="peak |dφ/dt| / Ω")
right.set_title("Tumbling past −e", fontsize=11)
right.legend(frameon=False, loc="upper left")

save(figure, "singular-point.svg")

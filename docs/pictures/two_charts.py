"""Draws two-charts.svg: the sphere of axes t under its two charts, and a tumbling path in both.

Left:  the sphere from the side, e to the right. The chart from e is kept up to θ = 2.0 rad, the one from −e up to
       θ′ = 2.0 rad; between the two edges either may be in use.
Right: the same path in the γ-plane and in the γ′-plane, to scale; bold where that chart is in use.

Needs numpy and matplotlib:  python two_charts.py
Equation numbers are those of ../theory.md.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle
from style import BLUE, GREY, ORANGE, save

BLACK = "#222222"

SWITCH = 2.0  # |γ| at which the other chart takes over [rad]
DELTA = 0.45  # distance at which the path passes −e [rad]


def path(angle):
    """The axis t of a free rotor after it has turned about K by an angle; it starts at e. One row a time."""
    half = 0.5 * DELTA
    k = np.array([np.sin(half), *(-np.cos(half) * np.array([0.77, 0.64]))])
    k /= np.linalg.norm(k)
    e = np.array([1.0, 0.0, 0.0])
    return (
        np.outer(np.cos(angle), e)
        + np.outer(np.sin(angle), np.cross(k, e))
        + np.outer(1.0 - np.cos(angle), k * (k @ e))
    )


def transverse(t, sign):
    """γ (sign +1) or γ′ (sign −1) of an axis t, its y and z components: eq. 2 or eq. 29, backwards."""
    across = np.hypot(t[:, 1], t[:, 2])
    theta = np.arctan2(across, sign * t[:, 0])
    ratio = sign * theta / np.where(across > 0.0, across, 1.0)
    return np.column_stack([-ratio * t[:, 2], ratio * t[:, 1]])


def pieces(t):
    """The path cut where the chart is switched: (chart, first, last) for each piece."""
    chart, cuts, start = 1, [], 0
    for i, x in enumerate(t[:, 0]):
        if np.arccos(np.clip(chart * x, -1.0, 1.0)) > SWITCH:
            cuts.append((chart, start, i))
            chart, start = -chart, i
    return [*cuts, (chart, start, len(t) - 1)]


def arrow(axes, points, at, colour):
    """An arrow head along a curve."""
    axes.annotate(
        "",
        xy=points[at + 6],
        xytext=points[at - 6],
        arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 0.0, "mutation_scale": 13},
        zorder=5,
    )


angle = np.linspace(0.0, 2.0 * np.pi, 2001)
t = path(angle)
cuts = pieces(t)
colours = {1: BLUE, -1: ORANGE}

figure, (left, middle, right) = plt.subplots(
    1, 3, figsize=(9.0, 3.7), layout="constrained", width_ratios=[1.08, 1.0, 1.0]
)

# The sphere: x to the right, z up, seen from −y.
edge = np.cos(SWITCH)
disc = Circle((0.0, 0.0), 1.0, fc="none", ec=GREY, lw=1.0)
left.add_patch(disc)
for sign in (1, -1):
    area = left.axvspan(sign * edge, sign * 1.1, color=colours[sign], alpha=0.16, lw=0.0)
    area.set_clip_path(disc)
    rim = np.sqrt(1.0 - edge**2)
    left.plot([sign * edge] * 2, [-rim, rim], color=colours[sign], lw=1.0, ls="--")
for chart, first, last in cuts:
    piece = t[first : last + 1]
    front = piece[:, 1] <= 1e-9
    for visible, style in ((front, {"lw": 2.2}), (~front, {"lw": 1.3, "ls": (0, (3, 2))})):
        line = np.where(visible[:, None], piece, np.nan)
        left.plot(line[:, 0], line[:, 2], color=colours[chart], **style)
for _, _, last in cuts[:-1]:
    left.plot(*t[last, [0, 2]], "o", color=BLACK, ms=5, zorder=6)
arrow(left, t[:, [0, 2]], 330, BLUE)
arrow(left, t[:, [0, 2]], 880, ORANGE)
for x, name, side in ((1.0, "e", "left"), (-1.0, "−e", "right")):
    left.plot([x], [0.0], "o", color=BLACK, ms=4, zorder=6, clip_on=False)
    left.text(x * 1.07, 0.0, name, ha=side, va="center", fontsize=12)
left.text(edge, 1.02, "θ = 2.0", color=BLUE, ha="center", va="bottom", fontsize=9)
left.text(-edge, 1.02, "θ′ = 2.0", color=ORANGE, ha="center", va="bottom", fontsize=9)
left.text(0.0, -1.04, "either", color=GREY, ha="center", va="top", fontsize=9)
left.text(0.72, -1.04, "chart from e", color=BLUE, ha="center", va="top", fontsize=9)
left.text(-0.72, -1.04, "chart from −e", color=ORANGE, ha="center", va="top", fontsize=9)
left.set(xlim=(-1.22, 1.22), ylim=(-1.22, 1.22), aspect="equal")
left.set_title("Axes t, seen from the side", fontsize=11)
left.axis("off")

for axes, sign, prime in ((middle, 1, ""), (right, -1, "′")):
    mine, other = colours[sign], colours[-sign]
    axes.add_patch(Circle((0.0, 0.0), SWITCH, fc=mine, alpha=0.16, lw=0.0))
    axes.add_patch(Circle((0.0, 0.0), SWITCH, fc="none", ec=mine, lw=1.0, ls="--"))
    axes.add_patch(Circle((0.0, 0.0), np.pi - SWITCH, fc="none", ec=other, lw=1.0, ls="--"))
    axes.add_patch(Circle((0.0, 0.0), np.pi, fc="none", ec=GREY, lw=1.0, ls=":"))
    points = transverse(t, sign)
    points[[0, -1]] = np.nan if sign < 0 else 0.0  # t = e has no γ′
    for chart, first, last in cuts:
        line = points[first : last + 1]
        used = chart == sign
        axes.plot(line[:, 0], line[:, 1], color=colours[chart], lw=2.2 if used else 1.0, alpha=1.0 if used else 0.7)
    for _, _, last in cuts[:-1]:
        axes.plot(*points[last], "o", color=BLACK, ms=5, zorder=6)
    arrow(axes, points, 330, BLUE)
    arrow(axes, points, 880, ORANGE)
    for radius, label, colour in ((SWITCH, "2.0", mine), (np.pi - SWITCH, "1.14", other), (np.pi, "π", GREY)):
        axes.text(
            radius * np.cos(-0.95),
            radius * np.sin(-0.95),
            label,
            color=colour,
            ha="center",
            va="center",
            fontsize=8,
            bbox={"fc": "white", "ec": "none", "pad": 1.0},
        )
    axes.plot([0.0], [0.0], "+", color=BLACK, ms=6)
    axes.set(xlim=(-3.3, 3.3), ylim=(-3.3, 3.3), aspect="equal", xlabel=f"γ{prime}_y  [rad]")
    axes.set_ylabel(f"γ{prime}_z  [rad]", labelpad=0)
    axes.set(xticks=[-2, 0, 2], yticks=[-2, 0, 2])
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_title("γ, from e" if sign > 0 else "γ′, from −e", fontsize=11)

save(figure, "two-charts.svg")

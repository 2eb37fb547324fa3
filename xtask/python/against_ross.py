"""Draw what ROSS finds beside what we do: ross.svg from the ross.json that `peers/ross.py` wrote beside it."""

import argparse
import json
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from looks import BLUE, GREEN, STYLE, VERMILLION

INK = "#808080"
"""Read on white and on black."""
LOOKS = {"1": (VERMILLION, "none"), "1000": (GREEN, GREEN)}
"""Edge and face of ROSS's marks, by how much stiffer than steel its shaft is."""
EVERY = 5
"""Of so many speeds one has a mark."""
SIZE = 6.0, 9.6  # [in]


def against_speed(axes, found, part):
    """Curves of ours, and marks of ROSS's."""
    speeds = np.array(found["speeds"])
    for curve in found["ours"][part]:
        axes.plot(speeds, curve, color=BLUE, linewidth=1.4)
    for stiffer, (edge, face) in LOOKS.items():
        for curve in np.array(found["theirs"][stiffer][part])[:, ::EVERY]:
            axes.plot(speeds[::EVERY], curve, "o", markersize=3.2, markeredgecolor=edge, markerfacecolor=face)
    axes.set(xlabel="spin [rad/s]", xlim=(speeds[0], speeds[-1]))


def campbell(axes, found):
    against_speed(axes, found, 0)
    axes.axline((0, 0), slope=1.0, color=INK, linestyle=(0, (6, 3)))
    for critical, (edge, face), size in [
        (found["ours"][1], (BLUE, "none"), 9.0),
        *((found["theirs"][stiffer][1], look, 5.0) for stiffer, look in LOOKS.items()),
    ]:
        axes.plot(critical, critical, "D", markersize=size, markeredgecolor=edge, markerfacecolor=face)
    axes.set(ylabel="whirl frequency [rad/s]", ylim=(0, None), title="Campbell diagram; diamonds: critical speeds, on the dashed line")


def response(axes, found):
    against_speed(axes, found, 2)
    stations = ", ".join(f"{station:g}" for station in found["stations"])
    axes.yaxis.set_major_formatter(lambda half_axis, _: f"{1e6 * half_axis:g}")
    axes.set(ylabel="larger half axis [µm]", ylim=(0, None), title=f"Unbalance response at {stations} m from the mass centre")


def difference(axes, found):
    stiffer, *columns = np.array(found["rows"]).T
    for name, theirs, bound, limit, colour in zip(
        ("modes", "critical speeds", "response"), columns[:3], columns[3:], found["limit"], (BLUE, VERMILLION, GREEN)
    ):
        axes.loglog(stiffer, theirs, "o-", color=colour, markersize=3.6, label=name)
        axes.loglog(stiffer, bound, ":", color=colour)
        axes.plot(2.5 * stiffer[-1], limit, "<", color=colour, markersize=6.0, clip_on=False)
    axes.axhline(found["agreed"], color=INK, linestyle=(0, (6, 3)))
    axes.set(xlabel="Young's modulus over that of steel", ylabel="largest difference / size", ylim=(1e-10, 3.0))
    axes.set_title(
        "Differences, and dotted what the shaft explains (red that of modes too)\n"
        "triangles: extrapolated to a rigid shaft, dashed: allowed there"
    )
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 0.24))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="where ross.json lies")
    folder = parser.parse_args().folder
    found = json.loads((folder / "ross.json").read_text(encoding="utf-8"))
    inks = {f"{part}color": INK for part in ("axes.edge", "axes.label", "axes.title", "xtick.", "ytick.", "text.", "legend.label")}
    with rc_context(STYLE | inks | {"grid.alpha": 0.3, "grid.color": INK, "savefig.transparent": True}):
        figure = Figure(figsize=SIZE, layout="constrained")
        upper, middle, lower = figure.subplots(3, 1, height_ratios=(1.25, 1.0, 1.1))
        campbell(upper, found)
        response(middle, found)
        difference(lower, found)
        marks = [
            Line2D([], [], linestyle="none", marker="o", markeredgecolor=edge, markerfacecolor=face, label=f"ROSS, {name}")
            for (edge, face), name in zip(LOOKS.values(), ("steel shaft", "a thousand times as stiff"))
        ]
        figure.legend(handles=[Line2D([], [], color=BLUE, label="split-rotor"), *marks], loc="outside upper left", ncols=3)
        figure.savefig(folder / "ross.svg", metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))


if __name__ == "__main__":
    main()

"""Draw error against time: accuracy.svg from the accuracy.json beside it. `cargo xtask accuracy` runs it.

A curve is a tool's method, a point one of its settings; those at powers of ten have a marker. Our curves are drawn full
and in strong colours, those of peers dashed and muted.
"""

import argparse
import json
import math
from datetime import datetime, timezone
from itertools import groupby
from pathlib import Path

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterSciNotation, LogLocator

from report.figures import BLACK, BLUE, GREEN, PURPLE, STYLE, VERMILLION

OURS = "split-rotor"
COLOURS = (BLUE, VERMILLION, GREEN, PURPLE)
MUTED = ("#7a8fa6", "#b08d57", "#7d9b76", "#a3839b", "#8c8c8c", "#5f9ea0", "#b5838d", "#9a9a5b", "#6d7f99", "#a0795c")
MARKERS = "sD^vPX<>ph"
SIZE = 8.3, 5.2  # [in]; 830 px wide where 100 px make an inch
GREY = "#666666"


def curves(rows):
    """((tool, method), rows of it that were measured), in the order of the file."""
    measured = [row for row in rows if row["failure"] is None and row["axis_error_rad"]]
    for name, of_it in groupby(measured, lambda row: (row["tool"], row["method"])):
        yield name, list(of_it)


def is_power_of_ten(value):
    return math.isclose(math.log10(value), round(math.log10(value)), abs_tol=1e-9)


def draw(figure, found):
    """The picture of an accuracy.json."""
    axes = figure.add_subplot()
    axes.set(xscale="log", yscale="log")
    ours, peers = iter(COLOURS), iter(zip(MUTED, MARKERS))
    for (tool, method), rows in curves(found["rows"]):
        times = [1e3 * row["cpu_time_s"] for row in rows]
        errors = [row["axis_error_rad"] for row in rows]
        marked = [i for i, row in enumerate(rows) if is_power_of_ten(row["value"])]
        if tool == OURS:
            look = {"color": next(ours), "linewidth": 2.0, "marker": "o", "markersize": 5, "zorder": 4}
        else:
            colour, marker = next(peers)
            look = {"color": colour, "linewidth": 1.1, "linestyle": (0, (4, 1.6)), "marker": marker, "markersize": 4}
        axes.plot(times, errors, markevery=marked, label=f"{tool} {method}", **look)
    floor = found["reference"]["agreement_at_worst"]["axis_rad"]
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, floor / 10.0), high)
    axes.axhspan(axes.get_ylim()[0], floor, color="#eeeeee", zorder=0, linewidth=0)
    axes.annotate("the references agree no closer", (0.01, floor), xycoords=("axes fraction", "data"),
                  xytext=(0, -3), textcoords="offset points", va="top", color=GREY, fontsize=8)
    stop = found["experiment"]["stop_s"]
    axes.set(xlabel="CPU time [ms]", ylabel=f"error of the rotor axis at t = {stop:g} s [rad]")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_major_locator(LogLocator(numticks=20))
    axes.yaxis.set_major_formatter(LogFormatterSciNotation())
    axes.yaxis.set_minor_locator(LogLocator(numticks=1))
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), labelcolor="linecolor")
    axes.set_title(f"{found['title']}: {stop - found['experiment']['start_s']:g} s", color=BLACK, fontsize=10.5)
    figure.supxlabel(caption(found["machine"]), x=0.01, ha="left", fontsize=7.5, color=GREY)


def caption(machine):
    """The machine, the versions, the day."""
    day = datetime.fromtimestamp(machine["measured_at"], timezone.utc).date().isoformat()
    return (
        f"least of many repeats on one of {machine['cores']} cores, {machine['cpu']}, {machine['system']}; "
        f"split-rotor {machine['version']}, rustc {machine['rustc']}; {day}"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="where accuracy.json lies")
    folder = parser.parse_args().folder
    found = json.loads((folder / "accuracy.json").read_text(encoding="utf-8"))
    with rc_context(STYLE):
        figure = Figure(figsize=SIZE, layout="constrained")
        draw(figure, found)
        figure.savefig(folder / "accuracy.svg", metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))


if __name__ == "__main__":
    main()

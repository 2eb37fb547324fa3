"""Draw error against time: accuracy.svg from the accuracy.json beside it. `cargo xtask accuracy` runs it.

The error is the worst of place across e, axis and phi over the run, each over the motion's own size.

A curve is a tool's method, a point one of its settings, if no other setting of the same method is better in both. Our
curves are drawn full and in strong colours, those of peers dashed and muted; `auto`, which is one of our others, is marks
only. Orders of a method are one curve.
"""

import argparse
import json
import math
import textwrap
from datetime import datetime, timezone
from itertools import groupby
from pathlib import Path

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterSciNotation, LogLocator, NullFormatter

from report.figures import BLACK, BLUE, GREEN, ORANGE, PURPLE, STYLE, VERMILLION

OURS = "split-rotor"
AUTO = "auto"
COLOURS = (VERMILLION, BLUE, GREEN, PURPLE, ORANGE)
MUTED = ("#3d3d3d", "#b08d57", "#6f9a6a", "#a3839b", "#8c8c8c", "#4f9ea0", "#b5737d", "#8f8f4b", "#6d7f99")
MARKERS = "sD^vPX<>p"
SIZE = 8.3, 5.0  # [in]; 830 px wide where 100 px make an inch
GREY = "#666666"
LARGEST = 1.0
"""Errors beyond the motion's own size are no results."""
LEAST = 1e-16
"""Where errors of 0 are drawn: a double has no more digits."""
FEW = 16
"""A curve of fewer points has a marker at each, one of more at powers of ten."""


def curves(rows):
    """((tool, method), rows of it to be drawn, from loose to tight), in the order of the file."""
    measured = [row for row in rows if row["failure"] is None and row["error"] is not None and row["error"] < LARGEST]
    for name, of_it in groupby(measured, lambda row: (row["tool"], row["method"])):
        best, least = [], math.inf
        for row in sorted(of_it, key=lambda row: row["cpu_time_s"]):
            if row["error"] < least:
                least = row["error"]
                best.append(row)
        yield name, best


def is_power_of_ten(value):
    return math.isclose(math.log10(value), round(math.log10(value)), abs_tol=1e-9)


def draw(figure, found):
    """The picture of an accuracy.json."""
    axes = figure.add_subplot()
    axes.set(xscale="log", yscale="log")
    ours, peers = iter(COLOURS), iter(zip(MUTED, MARKERS))
    for (tool, method), rows in curves(found["rows"]):
        times = [1e3 * row["cpu_time_s"] for row in rows]
        errors = [max(row["error"], LEAST) for row in rows]
        marked = [i for i, row in enumerate(rows) if len(rows) < FEW or is_power_of_ten(row["value"])]
        if method == AUTO:
            look = {"color": BLACK, "linewidth": 0.0, "marker": "o", "markersize": 9, "fillstyle": "none", "zorder": 5}
        elif tool == OURS:
            look = {"color": next(ours), "linewidth": 2.2, "marker": "o", "markersize": 5, "zorder": 4}
        else:
            colour, marker = next(peers)
            look = {"color": colour, "linewidth": 1.0, "linestyle": (0, (4, 1.6)), "marker": marker, "markersize": 3.8}
        told = "" if rows[0]["points_told"] == found["experiment"]["points"] else " (its end only)"
        axes.plot(times, errors, markevery=marked, label=f"{tool} {method}{told}", **look)
    if not axes.lines:
        axes.set(xlim=(0.1, 10.0), ylim=(1e-16, 1.0))
        axes.text(0.5, 0.5, "no method errs by less than the motion itself", transform=axes.transAxes, ha="center", color=GREY)
    shade_what_cannot_be_told(axes, found["reference"]["agreement"]["error"])
    axes.set(xlabel=f"CPU time for {span(found['experiment'])} [ms]", ylabel="worst error over the motion's own size")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_locator(LogLocator(numticks=20))
    axes.yaxis.set_major_formatter(LogFormatterSciNotation())
    axes.yaxis.set_minor_locator(LogLocator(numticks=1))
    if axes.lines:
        legend = axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8.5, handlelength=3.0)
        for text in legend.get_texts():
            text.set_fontweight("bold" if text.get_text().startswith(OURS) else "normal")
    axes.set_title(found["title"], color=BLACK, fontsize=11, fontweight="bold", parse_math=False)
    note = figure.supxlabel(caption(found), x=0.01, ha="left", fontsize=7.5, color=GREY)
    note.set_linespacing(1.4)


def shade_what_cannot_be_told(axes, floor):
    """Below what the two references agree on."""
    if not floor:
        return
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, floor / 10.0), high)
    axes.axhspan(axes.get_ylim()[0], floor, color="#eeeeee", zorder=0, linewidth=0)
    axes.text(0.01, 0.015, "cannot be told: the references agree no closer", transform=axes.transAxes, fontsize=8, color=GREY)


def span(experiment):
    """What was run, and of how much."""
    start, stop, whole = (experiment[name] for name in ("start_s", "stop_s", "scene_stop_s"))
    part = f" (of the scene's {whole - start:g} s)" if stop < whole else ""
    return f"the first {stop - start:g} s{part}" if part else f"{stop - start:g} s of motion"


def caption(found):
    """The machine, the day, the versions."""
    machine = found["machine"]
    day = datetime.fromtimestamp(machine["measured_at"], timezone.utc).date().isoformat()
    versions = dict.fromkeys(f"{row['tool']} {row['version']}" for row in found["rows"])
    text = (
        f"Least CPU time of many repeats on one of {machine['cores']} cores, {machine['cpu']}, {machine['system']}, "
        f"{day}. {', '.join(versions)}, rustc {machine['rustc']}."
    )
    return "\n".join(textwrap.wrap(text, 152))


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

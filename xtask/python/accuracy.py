"""Draw time against error, a work-precision diagram: accuracy.svg from the accuracy.json beside it. `cargo xtask accuracy` runs it.

The error is the worst of place across e, axis and phi over the run, each over the motion's own size. A curve is a method, a
point one of its settings, if no other setting of the same method is better in both; orders of a method are one curve. It is
to be read on a telephone, so curves are few: `auto`, which is one of our others, is left out unless it is cheaper than all settings
of these, and so are peers that show their end only, and of a peer's methods all but the cheapest. Ours are full and in strong colours, others dashed and muted.
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
from matplotlib.lines import Line2D
from matplotlib.ticker import LogFormatterSciNotation, LogLocator, NullFormatter, NullLocator

from looks import BLACK, BLUE, GREEN, ORANGE, PURPLE, STYLE, VERMILLION, svg

OURS = "split-rotor"
AUTO = "auto"
COLOURS = (GREEN, BLUE, PURPLE, ORANGE, VERMILLION, BLACK)
MUTED = ("#3d3d3d", "#b08d57", "#6f9a6a", "#a3839b", "#8c8c8c", "#4f9ea0", "#b5737d", "#8f8f4b")
MARKERS = "sD^vPX<>"
SIZE = 4.5, 5.6  # [in]; on a telephone an inch is some 80 px wide
GREY = "#666666"
LARGEST = 1.0
"""Errors beyond the motion's own size are no results."""
LEAST = 1e-16
"""Where errors of 0 are drawn: a double has no more digits."""
MIDDLE = 1e-6
"""The error at which methods are compared."""
CHEAPER = 0.9
"""Times that differ by less are the same."""


def curves(found):
    """((tool, method), rows of it to be drawn, from cheap to dear), in the order of the file."""
    points = found["experiment"]["points"]
    measured = [row for row in found["rows"] if row["points_told"] == points and row["error"] < LARGEST]
    for name, of_it in groupby(measured, lambda row: (row["tool"], row["method"])):
        best, least = [], math.inf
        for row in sorted(of_it, key=lambda row: row["cpu_time_s"]):
            if row["error"] < least:
                least = row["error"]
                best.append(row)
        yield name, best


def few(found):
    """Of these curves ours, `auto` only where it is cheaper than they are, and of each peer one."""
    for tool, of_it in groupby(curves(found), lambda curve: curve[0][0]):
        if tool != OURS:
            yield min(of_it, key=lambda curve: time_for(curve[1], MIDDLE))
            continue
        of_it = list(of_it)
        others = [curve for curve in of_it if curve[0][1] != AUTO]
        yield from others
        least = min((time_for(rows, MIDDLE) for _, rows in others), default=math.inf)
        yield from (curve for curve in of_it if curve[0][1] == AUTO and time_for(curve[1], MIDDLE) < CHEAPER * least)


def time_for(rows, error):
    """The least time for this error [s]."""
    return min((row["cpu_time_s"] for row in rows if row["error"] <= error), default=math.inf)


def draw(figure, found):
    """The picture of an accuracy.json."""
    axes = figure.add_subplot()
    axes.set(xscale="log", yscale="log")
    ours, peers = iter(COLOURS), iter(zip(MUTED, MARKERS))
    for (tool, method), rows in few(found):
        errors = [max(row["error"], LEAST) for row in rows]
        times = [1e3 * row["cpu_time_s"] for row in rows]
        if tool == OURS:
            look = {"color": next(ours), "linewidth": 2.2, "marker": "o", "markersize": 3.5, "zorder": 4}
        else:
            colour, marker = next(peers)
            look = {"color": colour, "linewidth": 1.0, "linestyle": (0, (4, 1.6)), "marker": marker, "markersize": 4}
        axes.plot(errors, times, label=method if tool == OURS else f"{tool} {method}", **look)
    if not axes.lines:
        axes.set(xlim=(1e-16, 1.0), ylim=(0.1, 10.0))
        axes.text(0.5, 0.5, "no method errs by less\nthan the motion itself", transform=axes.transAxes, ha="center", color=GREY)
    shade_what_cannot_be_told(axes, found["reference"]["agreement"]["error"])
    axes.set(xlabel="worst error over the motion's own size", ylabel=f"CPU time [ms] for {span(found['experiment'])}")
    axes.xaxis.set_major_locator(LogLocator(numticks=8))
    axes.xaxis.set_major_formatter(LogFormatterSciNotation())
    axes.xaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_title("\n".join(textwrap.wrap(found["title"], 44)), color=BLACK, fontsize=10, fontweight="bold", parse_math=False)
    legend(figure, axes.lines, caption(found["machine"]))


def legend(figure, lines, title):
    """Below the picture: what the curves are, ours in a column and peers in another."""
    ours = [line for line in lines if line.get_linestyle() == "-"]
    peers = [line for line in lines if line not in ours]
    # Columns are filled one after another, so the shorter one ends with lines that are not seen.
    rows = max(len(ours), len(peers))
    columns = [[*of_it, *[Line2D([], [], alpha=0.0, label="")] * (rows - len(of_it))] for of_it in (ours, peers) if of_it]
    shown = figure.legend(
        handles=sum(columns, []),
        loc="outside lower left",
        ncols=2 if peers else 3,
        title=title,
        title_fontsize=7.5,
        alignment="left",
    )
    shown.get_title().set(color=GREY, linespacing=1.4)


def shade_what_cannot_be_told(axes, floor):
    """Below what the two references agree on."""
    if not floor:
        return
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, floor / 10.0), high)
    axes.axvspan(axes.get_xlim()[0], floor, color="#eeeeee", zorder=0, linewidth=0)


def span(experiment):
    """What was run, and of how much."""
    start, stop, whole = (experiment[name] for name in ("start_s", "stop_s", "scene_stop_s"))
    return f"the first {stop - start:g} of {whole - start:g} s" if stop < whole else f"{stop - start:g} s of motion"


def caption(machine):
    """The machine and the day."""
    day = datetime.fromtimestamp(machine["measured_at"], timezone.utc).date().isoformat()
    text = f"least of many runs on {machine['cpu']}, {machine['system']}, rustc {machine['rustc']}, {day}"
    return "\n".join(textwrap.wrap(text, 76))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="where accuracy.json lies")
    folder = parser.parse_args().folder
    found = json.loads((folder / "accuracy.json").read_text(encoding="utf-8"))
    with rc_context(STYLE | {"font.size": 10}):
        figure = Figure(figsize=SIZE, layout="constrained")
        draw(figure, found)
        (folder / "accuracy.svg").write_text(svg(figure), encoding="utf-8")


if __name__ == "__main__":
    main()

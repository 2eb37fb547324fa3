"""Put what `cargo xtask hard-cases --short --mutants` found last into docs/hard-cases/gallery.csv, and draw from that file the table
of families of docs/hard-cases.md and its picture, beside this file; with --again only draw.

The picture: the first method of each case with its error, its bound, and the error of its mutant.
Needs matplotlib:  python hard_cases.py [--again]
"""

import argparse
import csv
import json
import shutil
from pathlib import Path

import matplotlib.pyplot as plt
from page import put
from style import BLUE, GREY, ORANGE, save

HERE = Path(__file__).parent
FOUND = HERE.parents[1] / "target" / "hard-cases"
PAGE = HERE.parent / "hard-cases.md"
ROWS = HERE.parent / "hard-cases" / "gallery.csv"
LEAST = 1e-16  # what is less, and zero, stands at the edge


def read():
    """The rows, errors and bounds as numbers; the error of a mutant that was refused, or failed, stays None."""
    with ROWS.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        row["error"], row["bound"] = float(row["error"]), float(row["bound"])
        try:
            row["mutant_error"] = float(row["mutant_error"])
        except ValueError:
            row["mutant_error"] = None
    return rows


def is_measured(row):
    """Whether the error says how well a motion was followed, and not whether, and when, it was refused."""
    return row["bound"] > 0.0 and row["error_of"] != "time"


def families(rows):
    """A line a family: its cases and rows, who knows the answers, the worst error and the least of a mutant, over their bounds."""
    lines = ["| family | cases | rows | oracle | error / bound | mutant / bound |", "|---|--:|--:|---|--:|--:|"]
    for family in dict.fromkeys(row["family"] for row in rows):
        members = [row for row in rows if row["family"] == family]
        cases = {row["case"] for row in members}
        oracles = dict.fromkeys(part for row in members for part in row["oracle"].split("; "))
        errors = [row["error"] / row["bound"] for row in members if row["bound"] > 0.0]
        mutants = [row["mutant_error"] / row["bound"] for row in members if is_measured(row) and row["mutant_error"] is not None]
        worst, least = f"{max(errors):.2f}", f"{float(f'{min(mutants):.1g}'):.0f}" if mutants else "refused"
        lines.append(f"| {family} | {len(cases)} | {len(members)} | {'; '.join(oracles)} | {worst} | {least} |")
    cases = len({row["case"] for row in rows})
    return "\n".join([*lines, f"| all | {cases} | {len(rows)} | | | |"])


def picture(rows):
    """One line a case that has a number for its error."""
    first = {row["case"]: row for row in reversed(rows) if is_measured(row)}
    shown = [row for row in rows if first.get(row["case"]) is row]
    figure, axes = plt.subplots(figsize=(9.0, 0.22 * len(shown) + 1.0), layout="constrained")
    for height, row in enumerate(reversed(shown)):
        axes.plot([LEAST, row["bound"]], [height, height], color=GREY, lw=0.6)
        axes.plot(row["bound"], height, "|", color=GREY, ms=9, mew=2, label="bound")
        axes.plot(max(row["error"], LEAST), height, "o", color=BLUE, ms=4, label="error")
        if row["mutant_error"] is not None:
            axes.plot(row["mutant_error"], height, "x", color=ORANGE, ms=5, label="error of the mutant")
    axes.set(xscale="log", xlabel="error  [rad, m or as gallery.csv says]", ylim=(-1, len(shown)))
    axes.set_yticks(range(len(shown)), [f"{row['case']}, {row['method']}" for row in reversed(shown)], fontsize=7)
    handles, labels = axes.get_legend_handles_labels()
    entries = dict(zip(labels, handles))
    figure.legend(entries.values(), entries.keys(), frameon=False, ncols=3, loc="outside upper right")
    save(figure, "hard-cases.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--again", action="store_true")
    if not parser.parse_args().again:
        found = json.loads((FOUND / "hard-cases.json").read_text(encoding="utf-8"))
        assert found["mutants"] and not found["part"], "run `cargo xtask hard-cases --short --mutants` first"
        shutil.copyfile(FOUND / "hard-cases.csv", ROWS)
    rows = read()
    put(PAGE, "gallery", families(rows))
    picture(rows)


if __name__ == "__main__":
    main()

"""Put what `cargo xtask hard-cases --mutants` found last into docs/hard-cases.md, and its picture beside this file.

The picture: the first method of each case with its error, its bound, and the error of its mutant.
Needs matplotlib:  python hard_cases.py
"""

import json
from pathlib import Path

import matplotlib.pyplot as plt
from page import put
from style import BLUE, GREY, ORANGE, save

HERE = Path(__file__).parent
FOUND = HERE.parents[1] / "target" / "hard-cases"
PAGE = HERE.parent / "hard-cases.md"
LEAST = 1e-16  # what is less, and zero, stands at the edge


def picture(rows):
    """One line a case that has a number for its error."""
    first = {row["case"]: row for row in reversed(rows) if row["bound"] > 0.0 and row["error_of"] != "time"}
    shown = [row for row in rows if first.get(row["case"]) is row]
    figure, axes = plt.subplots(figsize=(9.0, 0.22 * len(shown) + 1.0), layout="constrained")
    for height, row in enumerate(reversed(shown)):
        mutant = row["mutant_error"]
        axes.plot([LEAST, row["bound"]], [height, height], color=GREY, lw=0.6)
        axes.plot(row["bound"], height, "|", color=GREY, ms=9, mew=2, label="bound")
        axes.plot(max(row["error"], LEAST), height, "o", color=BLUE, ms=4, label="error")
        if isinstance(mutant, float):
            axes.plot(mutant, height, "x", color=ORANGE, ms=5, label="error of the mutant")
    axes.set(xscale="log", xlabel="error  [rad, m or as the table says]", ylim=(-1, len(shown)))
    axes.set_yticks(range(len(shown)), [f"{row['case']}, {row['method']}" for row in reversed(shown)], fontsize=7)
    handles, labels = axes.get_legend_handles_labels()
    entries = dict(zip(labels, handles))
    figure.legend(entries.values(), entries.keys(), frameon=False, ncols=3, loc="outside upper right")
    save(figure, "hard-cases.svg")


def main():
    found = json.loads((FOUND / "hard-cases.json").read_text(encoding="utf-8"))
    assert found["mutants"] and not found["part"], "run `cargo xtask hard-cases --mutants` first"
    picture(found["rows"])
    put(PAGE, "gallery", (FOUND / "hard-cases.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()

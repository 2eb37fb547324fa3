"""Put what `cargo xtask accuracy` found last of these scenes into docs/accuracy/, its pictures beside this file and its comparison
with heyoka into docs/accuracy.md; then draw the table of settings there from the files of all scenes. With --again only draw.

    python accuracy.py [--again] [SCENE …]
"""

import argparse
import csv
import shutil
from pathlib import Path

from page import put

SCENES = ("paper", "tumbling", "driven", "high_spin", "stiff_support", "long_run")
GOALS = ("1e-3", "1e-6", "1e-9")
SAME_TIME = 1.05  # as in tools/src/accuracy/advice.rs
OURS = "split-rotor"
HERE = Path(__file__).parent
FOUND = HERE.parents[1] / "target" / "accuracy"
PAGE = HERE.parent / "accuracy.md"
ROWS = HERE.parent / "accuracy"


def take(scene):
    """Take over what was found last: all rows, the picture, and where heyoka was timed beside it the second of its tables."""
    shutil.copyfile(FOUND / scene / "accuracy.svg", HERE / f"accuracy-{scene}.svg")
    shutil.copyfile(FOUND / scene / "accuracy.csv", ROWS / f"{scene}.csv")
    tables = (FOUND / scene / "accuracy.md").read_text(encoding="utf-8").partition("\n- ")[0].strip().split("\n\n")
    if len(tables) > 1:
        put(PAGE, f"{scene} beside heyoka", tables[1])


def read(scene):
    """The rows of a scene that show the whole motion, error and time [s] as numbers."""
    with (ROWS / f"{scene}.csv").open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if not row["failure"]]
    most = max(int(row["points_told"]) for row in rows)
    numbers = ({**row, "error": float(row["error"]), "time": float(row["cpu_time_s"])} for row in rows)
    return [row for row in numbers if int(row["points_told"]) == most]


def cheapest(rows, goal):
    """The cheapest row that errs by no more than `goal`; of those that take the same time, the most accurate."""
    reached = [row for row in rows if row["error"] <= goal]
    least = min((row["time"] for row in reached), default=None)
    return min((row for row in reached if row["time"] <= SAME_TIME * least), key=lambda row: row["error"], default=None)


def short(value):
    """Two digits, as in tools/src/accuracy/table.rs."""
    if not 0.1 <= value < 1000.0:
        return power(f"{value:.1e}")
    return f"{value:.2f}" if value < 1.0 else f"{value:.1f}" if value < 10.0 else f"{value:.0f}"


def power(text):
    """A number as Rust writes it: `1e-7`, not `1e-07`."""
    digits, _, exponent = text.partition("e")
    return f"{digits}e{int(exponent)}"


def setting(row):
    """What chooses the accuracy: `1e-7`, or `order 4, 2e-3`."""
    exact = next(text for n in range(17) if float(text := f"{float(row['value']):.{n}e}") == float(row["value"]))
    value = power(exact) if len(power(exact)) <= 8 else short(float(row["value"]))
    return f"order {row['order']}, {value}" if row["order"] else value


def cell(row, *words):
    """What a row takes, and with which method and setting."""
    return f"{short(1e3 * row['time'])} ms, {' '.join(words)}"


def table():
    """Three lines a scene: the cheapest of our methods, `auto`, and the cheapest peer."""
    lines = ["| scene | error | cheapest method | `auto` | cheapest peer |", "|---|--:|---|---|---|"]
    for scene in SCENES:
        rows = read(scene)
        ours = [row for row in rows if row["tool"] == OURS]
        peers = [row for row in rows if row["tool"] != OURS]
        for goal in GOALS:

            def of(method):
                return cheapest((row for row in ours if row["method"] == method), float(goal))

            methods = dict.fromkeys(row["method"] for row in ours if row["method"] != "auto")
            best = min(filter(None, map(of, methods)), key=lambda row: row["time"], default=None)
            auto, peer = of("auto"), cheapest(peers, float(goal))
            cells = [
                cell(best, best["method"], setting(best)) if best else "-",
                cell(auto, setting(auto), f"({auto['taken']})") if auto else "-",
                cell(peer, peer["tool"], peer["method"], setting(peer)) if peer else "",
            ]
            name = f"`{scene}`" if goal == GOALS[0] else ""
            lines.append(f"| {name} | {goal} | {' | '.join(cells)} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--again", action="store_true")
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    arguments = parser.parse_args()
    for scene in () if arguments.again else arguments.scenes:
        take(scene)
    put(PAGE, "settings", table())


if __name__ == "__main__":
    main()

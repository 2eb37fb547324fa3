"""Put what `cargo xtask accuracy` found last of these scenes into docs/accuracy.md, its rows into docs/accuracy/, and its
pictures beside this file."""

import argparse
import shutil
from pathlib import Path

from page import put

SCENES = ("paper", "tumbling", "driven", "high_spin", "stiff_support", "long_run")
HERE = Path(__file__).parent
FOUND = HERE.parents[1] / "target" / "accuracy"
PAGE = HERE.parent / "accuracy.md"
ROWS = HERE.parent / "accuracy"
DECADES = "| method | setting |"
"""How the table begins whose rows the CSV has too."""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    for scene in parser.parse_args().scenes:
        shutil.copyfile(FOUND / scene / "accuracy.svg", HERE / f"accuracy-{scene}.svg")
        ROWS.mkdir(exist_ok=True)
        shutil.copyfile(FOUND / scene / "accuracy.csv", ROWS / f"{scene}.csv")
        report = (FOUND / scene / "accuracy.md").read_text(encoding="utf-8").partition(DECADES)[0]
        put(PAGE, scene, f"{report.rstrip()}\n\nAll rows: [{scene}.csv](accuracy/{scene}.csv).")


if __name__ == "__main__":
    main()

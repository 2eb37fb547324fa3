"""Put what `cargo xtask accuracy` found last of these scenes into docs/accuracy.md, all its rows into docs/accuracy/, and its
pictures beside this file."""

import argparse
import json
import shutil
from pathlib import Path

from page import put

SCENES = ("paper", "tumbling", "driven", "high_spin", "stiff_support", "long_run")
HERE = Path(__file__).parent
FOUND = HERE.parents[1] / "target" / "accuracy"
PAGE = HERE.parent / "accuracy.md"
ROWS = HERE.parent / "accuracy"


def block(folder):
    """The tables, with which the report begins, what `auto` does, and where the rest stands."""
    tables = (folder / "accuracy.md").read_text(encoding="utf-8").partition("\n- ")[0]
    sentences = json.loads((folder / "accuracy.json").read_text(encoding="utf-8"))["sentences"]
    auto = [sentence for sentence in sentences if sentence.startswith("auto takes ")]
    return "\n\n".join([tables.strip(), *auto, f"All settings: [{folder.name}.csv](accuracy/{folder.name}.csv)."])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    for scene in parser.parse_args().scenes:
        shutil.copyfile(FOUND / scene / "accuracy.svg", HERE / f"accuracy-{scene}.svg")
        shutil.copyfile(FOUND / scene / "accuracy.csv", ROWS / f"{scene}.csv")
        put(PAGE, scene, block(FOUND / scene))


if __name__ == "__main__":
    main()

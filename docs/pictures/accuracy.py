"""Put what `cargo xtask accuracy` found last of these scenes into docs/accuracy.md, and its pictures beside this file."""

import argparse
import shutil
from pathlib import Path

from page import put

SCENES = ("paper", "tumbling", "driven", "high_spin", "stiff_support", "long_run")
HERE = Path(__file__).parent
FOUND = HERE.parents[1] / "target" / "accuracy"
PAGE = HERE.parent / "accuracy.md"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    for scene in parser.parse_args().scenes:
        shutil.copyfile(FOUND / scene / "accuracy.svg", HERE / f"accuracy-{scene}.svg")
        put(PAGE, scene, (FOUND / scene / "accuracy.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()

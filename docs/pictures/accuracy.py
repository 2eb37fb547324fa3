"""Put what `cargo xtask accuracy` found last of these scenes into docs/accuracy.md, and its pictures beside this file."""

import argparse
import re
import shutil
from pathlib import Path

SCENES = ("paper", "tumbling", "driven", "high_spin", "stiff_support", "long_run")
HERE = Path(__file__).parent
FOUND = HERE.parents[1] / "target" / "accuracy"
PAGE = HERE.parent / "accuracy.md"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    page = PAGE.read_text(encoding="utf-8")
    for scene in parser.parse_args().scenes:
        shutil.copyfile(FOUND / scene / "accuracy.svg", HERE / f"accuracy-{scene}.svg")
        report = (FOUND / scene / "accuracy.md").read_text(encoding="utf-8")
        # What stands between the marks is replaced.
        block = rf"(<!-- {scene} -->\n).*?(\n<!-- end -->)"
        page, count = re.subn(block, lambda match: f"{match[1]}\n{report.strip()}\n{match[2]}", page, flags=re.DOTALL)
        assert count == 1, f"{PAGE.name} has no place for {scene}"
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()

"""Report on a run that is there already.

    python run.py FOLDER [--linear FILE | --no-linear WHY]

reads FOLDER/modelDescription.xml and FOLDER/result.csv, columns `time` and every output by its name, and writes
FOLDER/report.html. Exit code 1 where they are not such files or the energy does not add up, with the reason on stderr.
"""

import argparse
import sys
from pathlib import Path

from report.deliver import add_options, deliver
from report.result import NotAResult, read


def main():
    """The command line; returns the exit code."""
    sys.stdout.reconfigure(errors="replace")  # a title may hold what the terminal cannot show
    parser = argparse.ArgumentParser(description="Report on a run of a scene.")
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="with modelDescription.xml and result.csv")
    add_options(parser)
    arguments = parser.parse_args()
    try:
        result = read(arguments.folder)
    except NotAResult as failure:
        print(f"error: {failure}", file=sys.stderr)
        return 1
    return deliver(result, arguments, arguments.folder)


if __name__ == "__main__":
    sys.exit(main())

"""Report on a run that is there already.

    python run.py FOLDER [--table NAME] [--solver SECONDS] [--linear FILE | --no-linear WHY]

reads FOLDER/modelDescription.xml and a table there, result.csv by default, with columns `time` and every output by its name, and writes
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
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="with modelDescription.xml and the table")
    parser.add_argument("--table", default="result.csv", metavar="NAME", help="the table of the run in FOLDER")
    parser.add_argument("--solver", type=float, metavar="SECONDS", help="CPU time that the run took")
    add_options(parser)
    arguments = parser.parse_args()
    try:
        result = read(arguments.folder, arguments.table, arguments.solver)
    except NotAResult as failure:
        print(f"error: {failure}", file=sys.stderr)
        return 1
    return deliver(result, arguments, arguments.folder, brief=True)


if __name__ == "__main__":
    sys.exit(main())

"""The command line."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Callable, List, Sequence

from kinds import RAY_KINDS

DESCRIPTION = """\
raywise beside Python's ray libraries: the same NumPy arrays in one process, taking turns, medians.

Table 1, rays: a scene that is built is asked; Mray/s.
Table 2, totals: from arrays to answers, building included; raywise is told how many rays are coming and chooses.

Libraries that are slow are asked fewer of the same rays (*), and what they would take in all is reckoned from
that. Ends with 1, after everything is written, where libraries disagree about more than 1 in 1,000 rays.

EXPORTER is raywise_bench with its options, to write the scenes into FOLDER first; without it they are there."""

EPILOG = """\
examples:
  bench_python.py FOLDER --scene bunny --rays random
  bench_python.py FOLDER --threads all --json all-threads.json
  bench_python.py FOLDER --count 100000 -- raywise_bench --library libraywise.so.1 --meshes meshes"""

QUICK_SCENES = ["bunny", "soup"]
SCENES = ["bunny", "dragon", "soup"]


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="bench_python.py",
        usage="%(prog)s [options] FOLDER [-- EXPORTER ...]",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="where the files of the scenes are")
    parser.add_argument(
        "--scene", type=words, metavar="A,B", help=f"only these (default: {','.join(SCENES)}; box, stadium ... as well)"
    )
    parser.add_argument(
        "--rays",
        type=words_of(list(RAY_KINDS)),
        default=["random", "camera", "shadow"],
        metavar="A,B",
        help=f"only these kinds of {', '.join(RAY_KINDS)} (default: all but diffuse); totals have random ones",
    )
    parser.add_argument(
        "--library", type=words, metavar="A,B", help="only these beside raywise, by the names in the tables"
    )
    parser.add_argument("--count", type=positive, metavar="N", help="how many rays of each kind (default: 1000000)")
    parser.add_argument(
        "--threads",
        choices=("1", "all"),
        default="1",
        help="1: all libraries on one processor, in processor time; all: what each does by itself, in wall time",
    )
    parser.add_argument("--vertices", choices=("float32", "float64"), default="float32", help="the type of vertices")
    parser.add_argument("--repetitions", type=positive, metavar="N", help="of each timing (default: 5)")
    parser.add_argument("--quick", action="store_true", help="fewer rays, short timings: that it runs, not how fast")
    parser.add_argument("--quiet", action="store_true", help="no progress on standard error")
    parser.add_argument("--json", type=Path, metavar="FILE", help="where the report goes")
    parser.add_argument("--commit", default="unknown", help="of the sources, for the report")
    parser.add_argument("--command", default=" ".join(sys.argv), help="what was typed, for the report")
    end = arguments.index("--") if "--" in arguments else len(arguments)
    options = parser.parse_args(arguments[:end])
    options.exporter = list(arguments[end + 1 :])
    options.scene = options.scene or (QUICK_SCENES if options.quick else SCENES)
    options.count = options.count or (100_000 if options.quick else 1_000_000)
    options.repetitions = options.repetitions or (3 if options.quick else 5)
    return options


def words(text: str) -> List[str]:
    return [word for word in text.split(",") if word]


def words_of(known: Sequence[str]) -> Callable[[str], List[str]]:
    def convert(text: str) -> List[str]:
        for word in words(text):
            if word not in known:
                raise argparse.ArgumentTypeError(f"{word!r} is not one of {', '.join(known)}")
        return words(text)

    return convert


def positive(text: str) -> int:
    number = int(text) if text.isdigit() else 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number above 0")
    return number

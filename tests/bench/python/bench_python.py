#!/usr/bin/env python3
"""raywise beside Python's ray libraries (make bench-python); --help tells how."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import Sequence

import facts
from export import export
from options import parse
from timing import clock_of


def main(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    # The same choices whatever profiles lie around, unless one is asked for.
    os.environ.setdefault("RAYWISE_CALIBRATION", "builtin")
    machine = facts.machine()
    if options.exporter:
        try:
            export(options.exporter, options.folder, options.scene, options.count)
        except (OSError, subprocess.CalledProcessError) as error:
            print(f"bench_python.py: the scenes could not be written: {error}", file=sys.stderr)
            return 2
    clock = clock_of(options.threads)
    # NumPy's threads of OpenBLAS, which trimesh wakes, go on asking for work for a while, beside whoever is measured then.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # Not before: NumPy starts threads when it is loaded, as many as there are processors for it.
    from session import run

    return run(options, clock, machine)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

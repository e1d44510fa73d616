"""One run of the benchmark: scenes, libraries, measurements, report."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any, Dict, List, Sequence

import facts
from bench import Bench, progress_to_stderr
from cells import OUR_NAMES, cells_of, summary_of
from libraries import OURS, all_libraries, those_there
from scenes import read_scene
from tables import notes, rays_text, totals_text
from timing import Clock

FAILED, IMPOSSIBLE = 1, 2


def scene_files(options: argparse.Namespace, left_out: List[str]) -> List[Path]:
    paths = []
    for name in options.scene:
        path = options.folder / f"{name}.scene"
        if path.is_file():
            paths.append(path)
        else:
            left_out.append(f"scene {name}: there is no such file, as there is no mesh for it or the name is wrong")
    return paths


def measure(bench: Bench, options: argparse.Namespace, told: Dict[str, Any], paths: Sequence[Path]) -> None:
    for path in paths:
        scene = read_scene(path, options.vertices)
        scene.rays.update((kind, rays.fewer(options.count)) for kind, rays in scene.rays.items())
        for kind in options.rays:
            if kind in scene.rays:
                bench.rays(scene, kind)
        if "random" in options.rays and "random" in scene.rays:
            bench.totals(scene)
        if options.json:  # after each scene: the work of minutes should not hang on the last of them
            save(options, told, bench, [])


def save(options: argparse.Namespace, told: Dict[str, Any], bench: Bench, left_out: Sequence[str]) -> None:
    cells = cells_of(bench.rows)
    report = {
        "target": "bench-python",
        "commit": options.commit,
        "date": facts.now(),
        "command": options.command,
        "quick": options.quick,
        "threads": options.threads,
        "repetitions": options.repetitions,
        "vertices": options.vertices,
        **facts.software(),
        **told,
        "rows": [asdict(row) for row in bench.rows],
        "summary": summary_of(cells),
        "left_out": left_out,
        "warnings": bench.warnings,
    }
    options.json.parent.mkdir(parents=True, exist_ok=True)
    options.json.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")


def show(options: argparse.Namespace, told: Dict[str, Any], bench: Bench, left_out: Sequence[str]) -> None:
    cells = cells_of(bench.rows)
    machine, software = told["machine"], facts.software()
    clock = "one processor, processor time" if options.threads == "1" else "all threads, wall time"
    print(f"{machine['brand']}, {machine['threads']} threads, Python {software['python']}, NumPy {software['numpy']}")
    print(f"{facts.now()}, commit {options.commit}, {clock}, medians of {options.repetitions}")
    print(f"float32 rays, {options.vertices} vertices, uint32 triangles; " + ", ".join(told["versions"]))
    names = [library.name for library in bench.libraries]
    print(rays_text(cells, [library.name for library in bench.libraries if not library.totals_only]), end="")
    print(totals_text(cells, names), end="")
    print()
    for line in notes(cells, options.threads):
        print(line)
    for line in left_out:
        print(f"left out: {line}")
    for line in bench.warnings:
        print(f"warning: {line}")


def run(options: argparse.Namespace, clock: Clock, machine: Dict[str, Any]) -> int:
    """Returns what the program ends with: FAILED where libraries disagree, IMPOSSIBLE where nothing can be measured."""
    left_out: List[str] = []
    paths = scene_files(options, left_out)
    if not paths:
        print(f"bench_python.py: there are no such scenes in {options.folder}", file=sys.stderr)
        return IMPOSSIBLE
    wanted = [
        library
        for library in all_libraries()
        if not options.library or library.name in OUR_NAMES or library.name in options.library
    ]
    libraries, versions, absent = those_there(wanted)
    left_out += absent
    if all(library.name != OURS for library in libraries):
        print(f"bench_python.py: {absent[0]}", file=sys.stderr)
        return IMPOSSIBLE

    told = {"machine": machine, "versions": versions}
    bench = Bench(
        libraries,
        clock,
        threads=1 if options.threads == "1" else 0,
        repetitions=options.repetitions,
        longest_pass=0.1 if options.quick else 1.0,
        progress=(lambda text: None) if options.quiet else progress_to_stderr,
    )
    measure(bench, options, told, paths)
    if options.json:  # before anything is shown: a closed pipe is not to lose it
        save(options, told, bench, left_out)
    show(options, told, bench, left_out)
    return FAILED if bench.warnings else 0

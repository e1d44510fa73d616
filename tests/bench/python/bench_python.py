#!/usr/bin/env python3
"""raywise beside Python's ray libraries: the same NumPy arrays in one process, taking turns, medians.

Table 1: rays against a scene that is built, where raywise is told that very many are coming. Table 2: from arrays to answers, building and all that the rays go through included; raywise
is told how many rays are coming and chooses. Libraries that are slow are asked fewer of the same rays (*). Ends with 1, after all is
written, where the numbers of hits differ by more than 1 in 1,000.
"""

import argparse
import datetime
import platform
import sys
from pathlib import Path

import libraries
import numpy as np
import report
import scenes
import timing

SLOW_AFTER = 2.0  # seconds that one pass may take; rays are fewer beyond
MANY = 100_000_000  # rays that raywise is told of where only rays count: those of a scene that is asked over and over
TRIED = 1000  # rays that tell how fast a library is
TOTALS = (1, 100, 10_000, 1_000_000)


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="scenes that raywise_bench --export wrote")
    parser.add_argument("--scene", type=lambda text: text.split(","), help="only these, by commas")
    parser.add_argument("--rays", type=lambda text: text.split(","), default=["random", "camera", "shadow", "diffuse"],
                        help="only these kinds: random, camera, shadow (any hit), diffuse")
    parser.add_argument("--threads", choices=("1", "all"), default="1",
                        help="1: one processor, processor time; all: as many as the machine has, wall time")
    parser.add_argument("--repetitions", type=int, default=5, help="of each timing (default 5)")
    parser.add_argument("--quick", action="store_true", help="two repetitions: that it runs, not how fast")
    parser.add_argument("--json", type=Path, help="where the report goes")
    parser.add_argument("--commit", default="unknown", help="of the sources, for the report")
    parser.add_argument("--command", default=" ".join(sys.argv), help="what was typed, for the report")
    options = parser.parse_args(arguments)
    unknown = set(options.rays) - set(scenes.RAY_KINDS)
    if unknown:
        parser.error(f"--rays: there are no {', '.join(sorted(unknown))} rays")
    if options.repetitions < 1:
        parser.error("--repetitions: at least 1")
    if options.quick:
        options.repetitions = 2
    return options


class Bench:
    def __init__(self, options, taking_part):
        self.options = options
        self.taking_part = taking_part
        self.clock = timing.use_threads(options.threads == "1")
        self.threads = 1 if options.threads == "1" else 0
        self.rows = []
        self.warnings = []
        self.left_out = []

    def progress(self, text):
        print(f"    {text}", file=sys.stderr, flush=True)

    def those_for(self, scene):
        those = []
        for library in self.taking_part:
            why_not = library.why_not(scene)
            if why_not is None:
                those.append(library)
            else:
                self.left_out.append(f"{library.name}, {scene.name}: {why_not}")
        return those

    def affordable(self, ask, built, rays):
        """As many of the rays as take no longer than a pass may."""
        some = rays.thinned(TRIED)
        ready = built.prepare(some)
        start = self.clock()
        ask(ready)
        each = (self.clock() - start) / len(some)
        return rays.thinned(max(1, min(len(rays), int(SLOW_AFTER / max(each, 1e-9)))))

    def compare(self, hits, where):
        """hits: library -> flags of its rays."""
        reference = hits[report.OURS]
        for name, flags in hits.items():
            step = -(-len(reference) // len(flags))
            differ = np.count_nonzero(flags != reference[::step])
            if differ > max(1, len(flags) / 1000):
                self.warnings.append(f"{where}: {name} and raywise differ in {differ:,} of {len(flags):,} rays")

    def rays_of(self, scene):
        for kind, rays in scene.rays.items():
            if kind not in self.options.rays:
                continue
            question = scenes.RAY_KINDS[kind]
            subjects, hits, counts, structures = {}, {}, {}, {}
            for library in self.those_for(scene):
                self.progress(f"{scene.name}, {kind} rays, {library.name}")
                built = library.build(scene, MANY, kind, self.threads)
                ask = built.closest if question == "closest" else built.occluded
                if ask is None:
                    continue
                some = self.affordable(ask, built, rays)
                ready = built.prepare(some)
                hits[library.name] = ask(ready)()
                counts[library.name] = len(some)
                structures[library.name] = built.what()
                subjects[library.name] = lambda ask=ask, ready=ready: ask(ready)
            self.compare(hits, f"{scene.name}, {kind} rays")
            seconds = timing.take_turns(subjects, self.clock, self.options.repetitions)
            for name, value in seconds.items():
                rate = counts[name] / value * 1e-6
                self.rows.append(report.Row("rays", scene.name, kind, question, counts[name], name, rate, "Mray/s",
                                            structures[name]))

    def totals_of(self, scene):
        rays = scene.rays["random"]
        rates = {row.library: row.value * 1e6 for row in self.rows
                 if (row.section, row.scene, row.rays) == ("rays", scene.name, "random")}
        for count in TOTALS:
            if count > len(rays):
                continue
            some = rays.thinned(count)
            subjects, structures = {}, {}
            for library in self.those_for(scene):
                # Who has been slow, with fewer rays, is not waited for.
                if library.name in rates and count / rates[library.name] > 2 * SLOW_AFTER:
                    continue
                self.progress(f"{scene.name}, {count:,} rays from arrays to answers, {library.name}")

                def total(library=library, some=some, count=count, structures=structures):
                    built = library.build(scene, count, "random", self.threads)
                    structures[library.name] = built.what()
                    return built, built.closest(built.prepare(some))

                subjects[library.name] = total
            seconds = timing.take_turns(subjects, self.clock, self.options.repetitions)
            for name, value in seconds.items():
                self.rows.append(report.Row("total", scene.name, "random", "closest", count, name, value * 1e3, "ms",
                                            structures[name]))

    def measure(self, path):
        scene = scenes.read_scene(path)
        self.rays_of(scene)
        if "random" in self.options.rays and "random" in scene.rays:
            self.totals_of(scene)


def processor():
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def those_there(all_of_them, left_out):
    """Libraries that can be loaded, with their versions."""
    there, versions = [], []
    for library in all_of_them:
        try:
            version = library.version()
        except ImportError as error:
            left_out.append(f"{library.name}: {error}")
            continue
        there.append(library)
        if version not in versions:
            versions.append(version)
    return there, versions


def main(arguments):
    options = parse(arguments)
    import raywise

    absent = []
    taking_part, versions = those_there(libraries.all_libraries(raywise), absent)
    bench = Bench(options, taking_part)
    bench.left_out.extend(absent)
    paths = [path for path in sorted(options.folder.glob("*.scene")) if not options.scene or path.stem in options.scene]
    if not paths:
        sys.exit(f"bench_python.py: there are no such scenes in {options.folder}")
    facts = {
        "benchmark": "bench-python",
        "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "commit": options.commit,
        "command": options.command,
        "processor": processor(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "versions": versions,
        "threads": options.threads,
        "repetitions": options.repetitions,
    }
    for path in paths:
        bench.measure(path)
    cells = report.add_ratios(bench.rows)
    left_out = sorted(set(bench.left_out))
    if options.json:  # before anything is shown: a closed pipe is not to lose it
        report.write_json(options.json, facts, bench.rows, bench.warnings, left_out)
    print(f"{facts['processor']}, Python {facts['python']}, NumPy {facts['numpy']}, threads: {options.threads}")
    print("beside " + ", ".join(version for version in versions if not version.startswith("raywise")))
    columns = [library.name for library in taking_part]
    print(report.table_of(cells, "rays", "Rays against a built scene: Mray/s", columns))
    print(report.table_of(cells, "total", "From arrays to answers: ms", columns))
    print()
    print("raywise gives all outputs, as its peers do; under 't, uv, id' it is asked for those alone. *: asked fewer rays")
    for line in left_out:
        print(f"left out: {line}")
    for line in bench.warnings:
        print(f"warning: {line}")
    return 1 if bench.warnings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

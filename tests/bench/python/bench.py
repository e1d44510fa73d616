"""The two measurements."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Sequence, Tuple

import numpy as np
from agreement import Difference, compare_flags, compare_hits, warnings_of
from cells import Row
from kinds import RAY_KINDS
from libraries import OURS
from libraries.library import Built, Library, Plan
from scenes import Array, RayArrays, Scene, evenly
from timing import Clock, Seconds, Step, run, take_turns

TOTALS = (1, 1_000, 100_000, 1_000_000)

# A trial of so many rays tells how fast a library is; each next one is so many times larger.
TRIED, GROWTH = 10, 4


@dataclass
class Subject:
    """One library in one cell: what is timed, and what it answered when it was run for the first time."""

    steps: Sequence[Step]
    which: Array  # the rays of the cell that it was asked
    answer: Any  # Hits or flags
    structure: str


@dataclass
class Bench:
    libraries: List[Library]
    clock: Clock
    threads: int
    repetitions: int
    longest_pass: float  # seconds; a library is asked fewer rays where one pass would take longer
    progress: Callable[[str], None]
    rows: List[Row] = field(default_factory=list)
    warnings: List[str] = field(default_factory=list)

    # --- rays against a scene that is built ---------------------------------------------------------------------------

    def rays(self, scene: Scene, kind: str) -> None:
        rays, query = scene.rays[kind], RAY_KINDS[kind]
        subjects: Dict[str, Subject] = {}
        for library in self.libraries:
            if library.totals_only or query not in library.questions:
                continue
            self.progress(f"{scene.name}, {kind} rays, {library.name}")
            built = library.build(scene.mesh, Plan(len(rays), kind, self.threads, build_counts=False))
            subjects[library.name] = self.asking(built, query, rays)
        self.add_rows("rays", scene, kind, len(rays), subjects)

    def asking(self, built: Built, query: str, rays: RayArrays) -> Subject:
        count = self.affordable(built, query, rays)
        some = rays.fewer(count)
        prepared = built.prepare(some)
        ask = built.occluded if query == "any" else built.closest
        read: Callable[[Any, RayArrays], Any] = built.flags if query == "any" else built.hits
        steps: List[Step] = [(lambda _: ask(prepared), 1.0)]
        return Subject(steps, evenly(count, len(rays)), read(ask(prepared), some), built.structure)

    def affordable(self, built: Built, query: str, rays: RayArrays) -> int:
        """How many of the rays can be asked in a pass. In small steps: who is slow may be slow beyond measure."""
        ask = built.occluded if query == "any" else built.closest
        ask(built.prepare(rays.fewer(1)))  # some build only now
        tried = min(TRIED, len(rays))
        while True:
            prepared = built.prepare(rays.fewer(tried))
            start = self.clock.now()
            ask(prepared)
            seconds = self.clock.now() - start
            if tried == len(rays) or GROWTH * seconds > self.longest_pass:
                break
            tried = min(GROWTH * tried, len(rays))
        fitting = int(tried * self.longest_pass / max(seconds, 1e-9))
        return max(1, min(fitting, GROWTH * tried, len(rays)))

    # --- from arrays to answers ---------------------------------------------------------------------------------------

    def totals(self, scene: Scene, kind: str = "random") -> None:
        limits: Dict[str, int] = {}  # of slow libraries
        for count in TOTALS:
            rays = scene.rays[kind].fewer(count)
            if len(rays) < count:
                continue
            subjects: Dict[str, Subject] = {}
            for library in self.libraries:
                self.progress(f"{scene.name}, from arrays to {count:,} answers, {library.name}")
                plan = Plan(count, kind, self.threads, build_counts=True)
                if library.slow and library.name not in limits:
                    limits[library.name] = self.affordable(library.build(scene.mesh, plan), "closest", scene.rays[kind])
                asked = min(count, limits.get(library.name, count))
                subjects[library.name] = self.from_arrays(library, scene, plan, asked)
            self.add_rows("total", scene, kind, count, subjects)

    def from_arrays(self, library: Library, scene: Scene, plan: Plan, asked: int) -> Subject:
        rays = scene.rays[plan.kind].fewer(plan.count).fewer(asked)

        def build(_: Any) -> Built:
            return library.build(scene.mesh, plan)

        def ask(built: Built) -> Tuple[Built, Any]:
            return built, built.closest(built.prepare(rays))

        steps: List[Step] = [(build, 1.0), (ask, plan.count / asked)]
        built, answer = run(steps)
        return Subject(steps, evenly(asked, plan.count), built.hits(answer, rays), built.structure)

    # --- both ---------------------------------------------------------------------------------------------------------

    def add_rows(self, section: str, scene: Scene, kind: str, count: int, subjects: Dict[str, Subject]) -> None:
        query = "closest" if section == "total" else RAY_KINDS[kind]
        differences = self.compare(f"{scene.name}, {section}, {count:,} {kind} rays", query, subjects)
        self.progress(f"{scene.name}, {section}, {count:,} {kind} rays, in turns")
        seconds = take_turns({name: subject.steps for name, subject in subjects.items()}, self.clock, self.repetitions)
        for name, subject in subjects.items():
            self.rows.append(
                Row(
                    section=section,
                    scene=scene.name,
                    triangles=len(scene.mesh.triangles),
                    rays=kind,
                    query=query,
                    count=count,
                    asked=len(subject.which),
                    library=name,
                    structure=subject.structure,
                    hit_rate=float((subject.answer if query == "any" else subject.answer.hit).mean()),
                    differing_hits=differences[name].hit,
                    differing_t=differences[name].t,
                    differing_primitives=differences[name].primitive,
                    **figures(section, len(subject.which), seconds[name]),
                )
            )

    def compare(self, where: str, query: str, subjects: Dict[str, Subject]) -> Dict[str, Difference]:
        """Each library beside raywise."""
        ours = subjects[OURS]
        differences = {}
        for name, subject in subjects.items():
            _, mine, other = np.intersect1d(ours.which, subject.which, assume_unique=True, return_indices=True)
            if query == "any":
                differences[name] = compare_flags(ours.answer[mine], subject.answer[other])
            else:
                differences[name] = compare_hits(ours.answer.at(mine), subject.answer.at(other))
        self.warnings += warnings_of(where, list(differences.items()), OURS)
        return differences


def figures(section: str, asked: int, seconds: Seconds) -> Dict[str, Any]:
    """The columns of a row that come from the clock."""
    value = 1e-6 * asked / seconds.median if section == "rays" else 1e3 * seconds.median
    return {
        "value": value,
        "unit": "Mray/s" if section == "rays" else "ms",
        "fastest": 1e-6 * asked / seconds.fastest if section == "rays" else 1e3 * seconds.fastest,
        "spread": seconds.spread,
        "repetitions": len(seconds.counted),
        "busy_threads": seconds.threads,
    }


def progress_to_stderr(text: str) -> None:
    print(f"    {text}", file=sys.stderr, flush=True)

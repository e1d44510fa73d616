"""Time of several subjects that take turns: what disturbs one disturbs all."""

from __future__ import annotations

import gc
import os
import random
import statistics
import time
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Sequence, Tuple

# What is shorter is called several times in one timing.
SHORTEST_TIMING = 0.01

# A subject is called once before its turn, unless it takes longer than this: whoever follows one that leaves caches and
# heap in another state would pay for it, with a million rays as much as for the rays themselves.
LONGEST_WARM_UP = 0.5

# A subject that has used up so many seconds in one cell is not asked again, once there are three timings.
PATIENCE = 8.0

# What to call with what the step before has returned, and how many times its seconds count: more than once where a
# slow library is asked a part of the rays.
Step = Tuple[Callable[[Any], Any], float]


@dataclass
class Seconds:
    """Of one subject. `counted` are by the clock that was asked for, `busy` is processor time over wall time."""

    counted: List[float] = field(default_factory=list)
    busy: List[float] = field(default_factory=list)

    @property
    def median(self) -> float:
        return statistics.median(self.counted)

    @property
    def fastest(self) -> float:
        return min(self.counted)

    @property
    def spread(self) -> float:
        """From the fastest to the slowest, as a part of the median."""
        return (max(self.counted) - min(self.counted)) / self.median

    @property
    def threads(self) -> float:
        """How many threads were at work, on average."""
        return statistics.median(self.busy)


@dataclass(frozen=True)
class Clock:
    """Processor time, in which other programs' turns do not count, or wall time, in which threads help."""

    now: Callable[[], float]


def clock_of(threads: str) -> Clock:
    """For "1" this process and all threads that it will have go to one processor. Before anything is loaded that starts
    threads, NumPy among it."""
    if threads != "1":
        return Clock(time.perf_counter)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})  # the first one serves interrupts
    return Clock(time.process_time)


def run(steps: Sequence[Step]) -> Any:
    """What the last step returns."""
    value = None
    for call, _ in steps:
        value = call(value)
    return value


def one_timing(steps: Sequence[Step], clock: Clock) -> Tuple[float, float]:
    """Seconds by the clock, and processor time over wall time. Giving back what was made is not counted."""
    counted = wall = processor = 0.0
    calls = 0
    while counted < SHORTEST_TIMING:
        value = None
        for call, weight in steps:
            wall_start, processor_start, start = time.perf_counter(), time.process_time(), clock.now()
            value = call(value)
            counted += weight * (clock.now() - start)
            processor += time.process_time() - processor_start
            wall += time.perf_counter() - wall_start
        calls += 1
        del value
    return counted / calls, processor / max(wall, 1e-9)


def take_turns(subjects: Dict[str, Sequence[Step]], clock: Clock, repetitions: int) -> Dict[str, Seconds]:
    """In another order each time, the same in every run. All have been run before: first calls start threads."""
    names = list(subjects)
    order = random.Random(1)
    seconds = {name: Seconds() for name in names}  # in the order of the subjects
    gc.collect()
    gc.disable()
    try:
        for _ in range(repetitions):
            order.shuffle(names)
            for name in names:
                so_far = seconds[name]
                if len(so_far.counted) >= 3 and sum(so_far.counted) > PATIENCE:
                    continue
                if not so_far.counted or so_far.counted[-1] < LONGEST_WARM_UP:
                    run(subjects[name])
                counted, busy = one_timing(subjects[name], clock)
                so_far.counted.append(counted)
                so_far.busy.append(busy)
    finally:
        gc.enable()
    return seconds

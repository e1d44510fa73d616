"""Time of several subjects that take turns: what disturbs one disturbs all."""

import os
import statistics
import time


def use_threads(one):
    """One: this process and all its threads run on one processor, and processor time counts; else wall time does."""
    if one and hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    return time.process_time if one else time.perf_counter


def take_turns(subjects, clock, repetitions):
    """subjects: name -> a call. Another one begins each time. Returns name -> median of the seconds."""
    names = list(subjects)
    seconds = {name: [] for name in names}
    for repetition in range(repetitions):
        begin = repetition % len(names)
        for name in names[begin:] + names[:begin]:
            start = clock()
            result = subjects[name]()
            seconds[name].append(clock() - start)
            del result  # giving back is not counted
    return {name: statistics.median(values) for name, values in seconds.items()}

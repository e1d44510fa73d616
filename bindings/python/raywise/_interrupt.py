"""Ctrl-C during a batch: the C library looks between blocks of rays whether to go on."""

from __future__ import annotations

import ctypes
import threading
from typing import Iterator, List

from . import _declarations as c
from ._errors import check

# Without arguments, which C's calling conventions allow for a function that is called with some: see Interrupt._go_on.
_LOOK = ctypes.CFUNCTYPE(ctypes.c_int32)


class Interrupt:
    """Lets signal handlers of Python run while a batch does. Keep it until the C call is over, then ask `finish`.

    Python runs them in the main thread alone, at the next piece of Python it executes there: the progress callback, which
    a batch calls from the thread that asked. What a handler raises, such as KeyboardInterrupt, stops the batch and comes
    out of `finish`. Batches of other threads need none of it.
    """

    def __init__(self, options: c.rw_query_options) -> None:
        self._errors: List[BaseException] = []
        self._is_watching = threading.current_thread() is threading.main_thread()
        if not self._is_watching:
            return
        looks = go_on(self._errors)
        next(looks)
        self._look = _LOOK(looks.__next__)
        options.progress = ctypes.cast(self._look, c.rw_progress)

    def finish(self, status: int) -> None:
        """Raises what a signal handler raised, or else what the status says."""
        if not self._errors:
            check(status)
            return
        error = self._errors.pop()
        try:
            raise error
        finally:
            del error  # its traceback leads back to this frame


def go_on(errors: List[BaseException]) -> Iterator[int]:
    """0 with each look, 1 from the first exception on.

    A generator and no function: a function's first instruction may already run signal handlers, before any `try` in it,
    and ctypes would drop what they raise. A generator that goes on is inside its `try` at once.
    """
    stop = 0
    while True:
        try:
            while True:
                yield stop
        except GeneratorExit:
            return
        except BaseException as error:
            error.__traceback__ = None  # it leads to this frame, and this one to the error
            errors[:] = errors or [error]
            stop = 1

"""Progress callbacks: no exception crosses the C library."""

from __future__ import annotations

from typing import Callable, Optional

from . import _declarations as c
from ._errors import check
from ._words import REFITS, Count, constant, sized, unsigned

ProgressCallback = Callable[[float, str], object]


class Progress:
    """rw_commit_options with a Python callback. Keep it until the C call is over, then ask `finish`."""

    def __init__(self, threads: Count, callback: Optional[ProgressCallback], refit: str = "where_it_pays") -> None:
        if callback is not None and not callable(callback):
            raise TypeError(f"progress has to be callable, not {type(callback).__name__}")
        self._callback = callback
        self._error: Optional[BaseException] = None
        self.options = sized(c.rw_commit_options)
        self.options.threads = unsigned(threads, "threads", 32)
        self.options.refit = constant(REFITS, refit, "refit")
        self._trampoline = c.rw_progress(self._call) if callback is not None else c.rw_progress()
        self.options.progress = self._trampoline

    def _call(self, user: Optional[int], fraction: float, stage: Optional[bytes]) -> int:
        if self._error is not None:
            return 1
        assert self._callback is not None
        try:
            return 1 if self._callback(fraction, (stage or b"").decode("utf-8", "replace")) else 0
        except BaseException as error:  # even KeyboardInterrupt: it continues in finish()
            self._error = error
            return 1

    def finish(self, status: int) -> None:
        """Raises what the callback raised, or else what the status says. The object is used up."""
        error = self._error
        del self._error, self._trampoline, self.options  # the callback leads back to this object: no cycle may stay
        if error is None:
            check(status)
            return
        try:
            raise error
        finally:
            del error  # its traceback leads back to this frame

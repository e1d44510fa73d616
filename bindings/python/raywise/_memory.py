"""Memory that is kept for scenes to come."""

from __future__ import annotations

import ctypes

from ._errors import check
from ._library import lib
from ._words import Count, unsigned


def keep_memory(size: Count) -> None:
    """Says how many bytes of closed scenes, and of builds that are done, the process keeps for scenes to come.

    Whoever makes a scene, asks it and closes it, over and over, need not wait for the system to clear the same pages
    again; frames made by Scene.refit keep theirs by themselves. At first 0. What is kept beyond that goes back at once,
    so 0 gives back all there is. C: rw_memory_keep.
    """
    check(lib.rw_memory_keep(unsigned(size, "size", 64)))


def kept_memory() -> int:
    """How many bytes are kept right now. C: rw_memory_kept."""
    size = ctypes.c_uint64()
    check(lib.rw_memory_kept(ctypes.byref(size)))
    return size.value

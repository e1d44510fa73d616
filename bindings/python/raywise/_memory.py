"""Memory that is kept for scenes and batches to come."""

from __future__ import annotations

import ctypes

from ._errors import check
from ._handle import Handle, Reference
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


class Workspace(Handle):
    """The memory that batches take while they run, kept from one to the next.

    For programs that ask in a loop: hand it to Scene.intersect, Scene.occluded or Scene.intersect_all, of any scene. A
    batch like the one before then takes nothing from the system but its answers. It grows to what the largest of its
    batches took: 48 bytes a ray, 80 where not all of their numbers are float32, for at most 2^20 rays, and 1 MiB for
    each thread. It serves one batch at a time: another one at the same time raises InUse.
    """

    def __init__(self) -> None:
        """An empty one. Raises MemoryError.

        C: rw_batch_workspace_create; close() is rw_batch_workspace_release.
        """
        address = ctypes.c_void_p()
        check(lib.rw_batch_workspace_create(ctypes.byref(address)))
        assert address.value is not None
        super().__init__(Reference(address.value, lib.rw_batch_workspace_release))

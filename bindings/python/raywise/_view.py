"""Views: a scene seen from a point or along a direction."""

from __future__ import annotations

import ctypes
from typing import List, Optional

import numpy.typing as npt

from . import _declarations as c
from ._arrays import as_floats
from ._handle import Reference
from ._library import lib
from ._progress import Progress, ProgressCallback
from ._queries import Queries
from ._text import c_text
from ._words import RAY_KINDS, Count, constant, ray_count, seconds, sized

VIEW_KINDS = {kind: RAY_KINDS[kind] for kind in ("camera", "shadow")}


class View(Queries):
    """A scene seen from a point (camera, point light) or along a direction (sun).

    Rays that do start at the point, or do run along the direction, can be answered faster; all others are answered as
    by the scene. Either way with the same bits. A view keeps what it needs of its scene, which may be closed before it.
    """

    def __init__(
        self,
        scene: Queries,
        *,
        origin: Optional[npt.ArrayLike] = None,
        direction: Optional[npt.ArrayLike] = None,
        half_angle: Optional[float] = None,
        expected_rays: Optional[Count] = None,
        kind: str = "camera",
        structure: Optional[str] = None,
        threads: Count = 0,
        progress: Optional[ProgressCallback] = None,
    ) -> None:
        """Makes a view of a committed scene, and builds a structure for it when that pays.

        scene: a Scene; or a View, for another one of its scene.
        origin: shape (3,): the point that rays start at, or aim at. None: the view is along `direction`.
        direction: shape (3,), any length but zero. With an origin: where the view looks; None: all around.
        half_angle: with both: radians from the direction to the farthest ray, below pi/2; None: pi/4.
        expected_rays: 1 ... 10^15; None: nobody knows. kind: "camera" or "shadow".
        structure: forces one of raywise.structures(); None: the library chooses, the scene's own one included.
        threads, progress: as for Scene.commit.

        Raises NotCommitted, ClosedError, RayCount, UnknownStructure, NotFinite (origin or direction), MemoryLimit,
        Cancelled, ValueError, TypeError, MemoryError, and what `progress` raises. Threads: any.

        C: rw_scene_view; close() is rw_scene_release.
        """
        options = sized(c.rw_view_options)
        options.kind = c.RW_VIEW_POINT if origin is not None else c.RW_VIEW_DIRECTION
        if origin is None and direction is None:
            raise TypeError("origin or direction: a view needs one of them")
        if origin is not None:
            options.origin[:] = three_numbers(origin, "origin")
        if direction is not None:
            options.direction[:] = three_numbers(direction, "direction")
        if half_angle is not None:
            options.half_angle = seconds(half_angle, "half_angle")
        options.count = ray_count(expected_rays, "expected_rays")
        options.ray_kind = constant(VIEW_KINDS, kind, "kind")
        options.structure = c_text(structure, "structure")
        seen = scene._committed()
        build = Progress(threads, progress)
        address = ctypes.c_void_p()
        status = lib.rw_scene_view(seen.address, options, build.options, ctypes.byref(address))
        if address.value is not None:
            reference = Reference(address.value, lib.rw_scene_release)
            reference.kept.append(seen)  # arrays that the scene shares have to outlive the view as well
            super().__init__(reference)
        build.finish(status)

    def __repr__(self) -> str:
        return "<View, closed>" if self.closed else "<View>"


def three_numbers(values: npt.ArrayLike, name: str) -> List[float]:
    array = as_floats(values, name)
    if array.shape != (3,):
        raise ValueError(f"{name} has to have the shape (3,), not {array.shape}")
    numbers: List[float] = array.tolist()
    return numbers

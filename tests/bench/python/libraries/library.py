"""What a library is asked to do, and in what steps: what is measured is apart from what is not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, FrozenSet, Optional

import numpy as np
from scenes import Array, Mesh, RayArrays


@dataclass(frozen=True)
class Plan:
    """What is going to be asked. Only raywise wants to know."""

    count: int
    kind: str  # of rays
    threads: int  # 1, or 0: as many as the library takes by itself
    build_counts: bool  # whether the time to build is measured too


@dataclass(frozen=True)
class Hits:
    """Closest hits in one form, to be compared."""

    hit: Array  # bool
    t: Array  # inf for a miss
    primitive: Array  # int64, -1 for a miss
    uv: Optional[Array]  # (n, 2), where the library gives them

    def at(self, which: Array) -> "Hits":
        uv = None if self.uv is None else self.uv[which]
        return Hits(self.hit[which], self.t[which], self.primitive[which], uv)


class Built:
    """A mesh that can be asked."""

    structure = ""  # how the triangles are kept, where the library says so

    def prepare(self, rays: RayArrays) -> Any:
        """The rays in the form that the library reads. Measured in totals only."""
        return rays

    def closest(self, rays: Any) -> Any:
        """The closest hit of each ray, with all that the library gives by itself. Measured."""
        raise NotImplementedError

    def occluded(self, rays: Any) -> Any:
        """Whether each ray hits anything before its end. Measured."""
        raise NotImplementedError

    def hits(self, answer: Any, rays: RayArrays) -> Hits:
        """What closest() has returned. Not measured."""
        raise NotImplementedError

    def flags(self, answer: Any, rays: RayArrays) -> Array:
        """What occluded() has returned, as bool. Not measured."""
        raise NotImplementedError


class Library:
    name = ""
    questions: FrozenSet[str] = frozenset({"closest", "any"})
    totals_only = False
    # Whether a part of the rays stands for all in totals. build() must leave nothing to the first rays then.
    slow = False

    def version(self) -> str:
        """Loads the library. Raises ImportError or OSError where it cannot be."""
        raise NotImplementedError

    def build(self, mesh: Mesh, plan: Plan) -> Built:
        """Some leave a part of the work to the first rays."""
        raise NotImplementedError


def hits_of(t: Array, primitive: Array, hit: Array, uv: Optional[Array]) -> Hits:
    """Hits with what libraries write for a miss made alike."""
    return Hits(
        hit,
        np.where(hit, t, np.inf).astype(np.float64),
        np.where(hit, primitive.astype(np.int64), -1),
        uv,
    )

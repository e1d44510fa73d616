"""Whether libraries that were asked the same gave the same."""

from __future__ import annotations

from dataclasses import dataclass
from typing import List, Tuple

import numpy as np
from libraries.library import Hits
from scenes import Array

# Part of the rays. float32 libraries decide differently at edges and at grazing angles, which fewer rays meet.
TOLERANCE = 1e-3

# Relative; float32 libraries lose digits of t where rays start far away.
T_TOLERANCE = 1e-3


@dataclass(frozen=True)
class Difference:
    """Of one library beside the reference, over the rays that both were asked."""

    rays: int
    hit: int  # one hits, the other misses
    t: int  # both hit, in different places
    primitive: int  # both hit, different triangles: often neighbours, or two in the same place

    @property
    def too_much(self) -> bool:
        return max(self.hit, self.t) > max(1.0, TOLERANCE * self.rays)


def compare_hits(reference: Hits, other: Hits) -> Difference:
    """Both of the same rays."""
    both = reference.hit & other.hit
    t, other_t = reference.t[both], other.t[both]
    return Difference(
        rays=len(reference.hit),
        hit=int(np.count_nonzero(reference.hit != other.hit)),
        t=int(np.count_nonzero(np.abs(t - other_t) > T_TOLERANCE * np.abs(t) + 1e-6)),
        primitive=int(np.count_nonzero(reference.primitive[both] != other.primitive[both])),
    )


def compare_flags(reference: Array, other: Array) -> Difference:
    return Difference(len(reference), int(np.count_nonzero(reference != other)), 0, 0)


def warnings_of(where: str, differences: List[Tuple[str, Difference]], reference: str) -> List[str]:
    return [
        f"{where}: of {difference.rays:,} rays {name} and {reference} disagree about {difference.hit:,} hits and"
        f" {difference.t:,} distances"
        for name, difference in differences
        if difference.too_much
    ]

"""What a scene or view tells about itself, as plain data."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any, Dict, Tuple, Type, TypeVar

from . import _declarations as c

Facts = TypeVar("Facts")


def facts(kind: Type[Facts], struct: Any) -> Facts:
    """A dataclass from the members of a C struct that have the same names."""
    values = {}
    for field in dataclasses.fields(kind):  # type: ignore[arg-type]
        value = getattr(struct, field.name)
        if isinstance(value, bytes):
            value = value.decode("utf-8", "replace")
        elif hasattr(value, "__len__") and not isinstance(value, str):
            value = tuple(value)
        values[field.name] = value
    return kind(**values)


@dataclass(frozen=True)
class SceneStatistics:
    """What is in a scene and what it has cost: rw_scene_statistics."""

    geometry_count: int
    triangle_count: int  # all, degenerate and invalid ones included
    degenerate_triangles: int  # without area: never hit
    invalid_triangles: int  # skipped by skip_invalid: never hit
    structure: str  # the one in use
    decide_ns: float  # time spent on choosing
    build_ns: float  # time spent on building what is in use
    structure_bytes: int
    geometry_bytes: int  # memory of copied meshes
    rays: int  # answered in batches so far
    invalid_rays: int  # rays with a NaN so far, single calls included
    rays_ns: float  # wall time of those batches
    refits: int  # how often the structure was refitted since it was built


@dataclass(frozen=True)
class GridStatistics:
    """Statistics over the cells of a uniform grid (Hapala, Karlik, Havran 2011, eq. 1 to 6): rw_grid_statistics."""

    resolution: Tuple[int, int, int]
    cells: int
    empty_cells: int
    references: int
    max_references: int  # eq. 2
    sparseness: float  # eq. 1: empty cells / cells
    mean: float  # eq. 3: references per cell
    variance: float  # eq. 4: squares over cells - 1
    standard_deviation: float
    skewness: float  # eq. 5; 0 when the variance is 0
    kurtosis: float  # eq. 6: excess, minus 3; 0 when the variance is 0


@dataclass(frozen=True)
class Candidate:
    """One structure as the decision saw it; NaN stands for a figure that is not known: rw_candidate."""

    structure: str
    flags: int  # RW_CANDIDATE_; the properties below say the same
    predicted_build_ns: float
    predicted_ray_ns: float  # per ray of the expected kind
    predicted_error: float  # relative residual of the calibration, 0.2 = 20 %
    predicted_total_ns: float  # build + expected rays; NaN when their number is unknown
    break_even_rays: float  # from so many rays on it beats the chosen one; inf: never; NaN for the chosen one
    predicted_bytes: int
    actual_bytes: int  # 0: not known
    actual_build_ns: float
    actual_ray_ns: float  # of the batches so far, or of the sample while choosing

    @property
    def chosen(self) -> bool:
        """It is the one in use."""
        return bool(self.flags & c.RW_CANDIDATE_CHOSEN)

    @property
    def forced(self) -> bool:
        """It was chosen because the caller named it."""
        return bool(self.flags & c.RW_CANDIDATE_FORCED)

    @property
    def over_limit(self) -> bool:
        """It would not fit the memory limit."""
        return bool(self.flags & c.RW_CANDIDATE_OVER_LIMIT)

    @property
    def measured(self) -> bool:
        """It was built and timed while choosing."""
        return bool(self.flags & c.RW_CANDIDATE_MEASURED)

    @property
    def applicable(self) -> bool:
        """It has a meaning here; a projected structure has none without a view."""
        return not self.flags & c.RW_CANDIDATE_NOT_APPLICABLE


@dataclass(frozen=True, repr=False)
class Explanation:
    """Why a structure was chosen: str() is the table for people, `json` the same as a dict."""

    text: str
    json: Dict[str, Any]

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return self.text
